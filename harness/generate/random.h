#pragma once
// Random numbers that are the same with every compiler and standard library.

#include <cstddef>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sightline::generate {

/// std::mt19937_64, whose output the standard fixes, with integer ranges of its own: the standard's distributions
/// differ between libraries. The same seed gives the same numbers everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// A number in [0, n), all equally likely (by rejection). Pre: n > 0.
  std::uint64_t below(std::uint64_t n);
  /// A number in [least, most]. Pre: least <= most, most - least < 2^63.
  std::int64_t between(std::int64_t least, std::int64_t most) {
    return least + static_cast<std::int64_t>(below(static_cast<std::uint64_t>(most - least) + 1));
  }
  /// True with probability part / whole.
  bool chance(std::uint64_t part, std::uint64_t whole) { return below(whole) < part; }

  /// Puts a sequence in random order, all orders equally likely (Fisher and Yates).
  template <class T>
  void shuffle(std::vector<T>& items) {
    using std::swap;
    for (std::size_t i = items.size(); i > 1; --i) swap(items[i - 1], items[below(i)]);
  }

  /// Where the sequence of numbers is, as text; and from there on.
  std::string state() const;
  /// Errors: std::invalid_argument where the text is none of state().
  void set_state(const std::string& text);

 private:
  std::mt19937_64 engine_;
};

/// Fails as every generator does on a size that it cannot make.
inline void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(what);
}

}  // namespace sightline::generate
