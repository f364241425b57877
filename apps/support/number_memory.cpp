#include "number_memory.h"

#include <gmp.h>

#include <array>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

namespace sightline::app {

namespace {

void (*end_where_memory_ran_out)() = nullptr;

void* checked(void* memory) {
  if (memory == nullptr) end_where_memory_ran_out();
  return memory;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif
#if defined(__GLIBC__)
constexpr bool has_small_blocks = true;
#else
constexpr bool has_small_blocks = false;
#endif

// Blocks of 24, 40, 56, ... bytes: as much as glibc's malloc gives at least for what is asked for. So numbers that were
// made before the lists may come to them too.
constexpr std::size_t least_block = 24, step_size = 16, size_classes = 16, at_once = std::size_t{1} << 16;

constexpr std::size_t place_of(std::size_t size) {
  return size <= least_block ? 0 : (size - least_block + step_size - 1) / step_size;
}
constexpr std::size_t block_size(std::size_t place) { return least_block + place * step_size; }

struct Block {
  Block* next;
};

/// Free blocks of one size, at most `most_at_hand`.
struct Blocks {
  Block* first = nullptr;
  std::size_t count = 0;
};
constexpr std::size_t most_at_hand = 1024;

/// Two lists of a thread for each size, so that threads meet once in a thousand times: one from which it takes and to
/// which it gives, and one that is full or empty. They outlive whatever the thread still has to destroy.
thread_local std::array<Blocks, size_classes> at_hand{}, in_reserve{};

/// What threads have too much of, and what those that have ended left.
struct Left_over {
  std::mutex mutex;
  std::array<std::vector<Blocks>, size_classes> lists;

  void add(std::size_t place, Blocks& blocks) {
    const std::lock_guard lock(mutex);
    if (blocks.first != nullptr) lists[place].push_back(std::exchange(blocks, {}));
  }
  Blocks take(std::size_t place) {
    const std::lock_guard lock(mutex);
    if (lists[place].empty()) return {};
    const Blocks blocks = lists[place].back();
    lists[place].pop_back();
    return blocks;
  }
};
Left_over& left_over() {
  static auto* const blocks = new Left_over;  // never destroyed, as threads may end late
  return *blocks;
}

struct At_end_of_thread {
  ~At_end_of_thread() {
    for (std::size_t place = 0; place < size_classes; ++place)
      for (Blocks* blocks : {&at_hand[place], &in_reserve[place]}) left_over().add(place, *blocks);
  }
};

Blocks new_blocks(std::size_t place) {
  const std::size_t size = block_size(place);
  Blocks blocks{nullptr, at_once / size < most_at_hand ? at_once / size : most_at_hand};
  char* const memory = static_cast<char*>(checked(std::malloc(blocks.count * size)));
  for (std::size_t k = blocks.count; k-- > 0;) blocks.first = new (memory + k * size) Block{blocks.first};
  return blocks;
}

/// Pre: there are none at hand. Post: there are.
void fetch_blocks(std::size_t place) {
  thread_local const At_end_of_thread at_end;
  static_cast<void>(at_end);
  at_hand[place] = std::exchange(in_reserve[place], {});
  if (at_hand[place].first == nullptr) at_hand[place] = left_over().take(place);
  if (at_hand[place].first == nullptr) at_hand[place] = new_blocks(place);
}

/// Pre: as many are at hand as may be. Post: none are.
void put_away_blocks(std::size_t place) {
  left_over().add(place, in_reserve[place]);
  in_reserve[place] = std::exchange(at_hand[place], {});
}

}  // namespace

extern "C" {
static void* allocated(std::size_t size) {
  const std::size_t place = place_of(size);
  if (!has_small_blocks || place >= size_classes) return checked(std::malloc(size));
  if (at_hand[place].first == nullptr) fetch_blocks(place);
  Block* const block = at_hand[place].first;
  at_hand[place].first = block->next;
  --at_hand[place].count;
  return block;
}

static void released(void* memory, std::size_t size) {
  const std::size_t place = place_of(size);
  if (!has_small_blocks || place >= size_classes) {
    std::free(memory);
    return;
  }
  if (at_hand[place].count == most_at_hand) put_away_blocks(place);
  at_hand[place].first = new (memory) Block{at_hand[place].first};
  ++at_hand[place].count;
}

static void* reallocated(void* before, std::size_t old_size, std::size_t size) {
  const std::size_t old_place = place_of(old_size), place = place_of(size);
  if (!has_small_blocks || (old_place >= size_classes && place >= size_classes))
    return checked(std::realloc(before, size));
  if (old_place == place) return before;
  void* const memory = allocated(size);
  std::memcpy(memory, before, old_size < size ? old_size : size);
  released(before, old_size);
  return memory;
}
}

void keep_numbers_in_small_blocks(void (*end_without_memory)()) {
  if (is_sanitized) return;
  end_where_memory_ran_out = end_without_memory;
  mp_set_memory_functions(allocated, reallocated, released);
}

}  // namespace sightline::app
