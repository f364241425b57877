// A part of the libraries where SIGHTLINE_UNWATCHED_NUMBERS asks for it, as `check` does: the digits of GMP's numbers
// come from glibc's own malloc, not from the address sanitizer's. GMP is not compiled with sanitizers, so they saw no
// more of these digits than that they are given back, once; and took three fifths of the time of all tests. A number
// itself, and what holds it, are watched as ever; that digits are given back twice glibc sees, that they never are
// nobody does here.

#include <gmp.h>

#include <cstddef>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void __libc_free(void* memory);

static void* digits(std::size_t size) { return __libc_malloc(size); }
static void* other_digits(void* before, std::size_t, std::size_t size) { return __libc_realloc(before, size); }
static void no_digits(void* memory, std::size_t) { __libc_free(memory); }

/// Before any number is made, in this library or by who is linked with it.
__attribute__((constructor(101))) static void leave_digits_unwatched() {
  mp_set_memory_functions(digits, other_digits, no_digits);
}
}
