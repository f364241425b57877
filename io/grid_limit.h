#pragma once
// What readers refuse that make points of a file's numbers: where planes of a .map meet, or nodes of a glTF put them.

#include <sightline/kernel/number.h>

#include <cstddef>

namespace sightline {

/// The common denominator of a file's points, as they are made: all lie on one grid, on which each coordinate is as
/// long. What is made of few bytes may be longer than they are, but not by any factor.
class Grid_limit {
 public:
  /// Whether a file of so many bytes may have so many points with numbers of so many bits.
  static bool allows(std::size_t points, std::size_t bits, std::size_t bytes) {
    constexpr std::size_t bits_of_a_byte = 512, bits_beside = std::size_t{1} << 27;
    return 3 * points * bits <= bits_of_a_byte * bytes + bits_beside;
  }
  /// Takes a denominator in; whether so many points may lie on the grid.
  bool include(const Integer& denominator, std::size_t points, std::size_t bytes) {
    if (denominator != 1) common_ = lcm(common_, denominator);
    return allows(points, bit_length(common_), bytes);
  }
  static constexpr const char* words =
      "points whose numbers on a common grid are long out of all proportion to the file";

 private:
  Integer common_ = 1;
};

}  // namespace sightline
