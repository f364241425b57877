#pragma once
// What all targets share: how a finding is reported, and numbers from bytes.

#include <sightline/harness/generate/random.h>
#include <sightline/kernel/number.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace fuzz {

using namespace sightline;

/// An answer that is wrong, or a law that does not hold.
class Finding : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

inline void require(bool holds, const char* law) {
  if (!holds) throw Finding(law);
}

/// Whether it throws such an error, and nothing else.
template <class Error, class Run>
bool is_refused(Run run) {
  try {
    run();
  } catch (const Error&) {
    return true;
  }
  return false;
}

/// Numbers from bytes; zeros when these are used up.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : rest_(bytes) {}

  bool empty() const { return rest_.empty(); }
  std::uint8_t byte() {
    if (rest_.empty()) return 0;
    const auto value = static_cast<std::uint8_t>(rest_.front());
    rest_.remove_prefix(1);
    return value;
  }
  /// Below n. Pre: 0 < n <= 256.
  std::size_t below(std::size_t n) { return byte() % n; }
  std::uint64_t word() {
    std::uint64_t value = 0;
    for (int k = 0; k < 8; ++k) value = value << 8 | byte();
    return value;
  }
  /// |n| < 2^bits. One byte may stand for a small number or for a power of two and a little, so that coincidences come
  /// about often.
  Integer integer(int bits) {
    const std::uint8_t kind = byte();
    Integer n = 0;
    if (kind < 128) {
      n = kind / 2 % 16;
    } else if (kind < 160) {
      mpz_setbit(n.get_mpz_t(), byte() % static_cast<unsigned>(bits));
      n += kind / 2 % 4 - 2;
    } else {
      for (int k = 0; k < bits; k += 8) n = (n << 8) + byte();
    }
    n = abs(n);
    mpz_fdiv_r_2exp(n.get_mpz_t(), n.get_mpz_t(), static_cast<mp_bitcnt_t>(bits));
    return kind % 2 == 0 ? n : Integer(-n);
  }

 private:
  std::string_view rest_;
};

/// One of some laws, of what a generator draws.
template <std::size_t count>
void ask_one_of(const std::array<void (*)(generate::Random&), count>& laws, std::string_view bytes) {
  Bytes from(bytes);
  const auto law = laws[from.below(count)];
  generate::Random random(from.word());
  law(random);
}

}  // namespace fuzz
