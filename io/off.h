#pragma once
// Geomview's OFF, and OFF with rational coordinates (.qoff).

#include <sightline/io/format.h>
#include <sightline/io/input.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <unordered_set>

namespace sightline {

/// The common denominator of a soup's coordinates has at most this many bits, or every number of the scene, scaled to
/// integers, would have them. Decimals and doubles never need more (2^1100 5^1100 has 3655), p/q may.
inline constexpr std::size_t largest_common_denominator_bits = 8192;

/// The least common multiple of denominators as they come along, up to the limit. Cost: a division by the new one; a
/// look into a table where it has come before.
class Common_denominator {
 public:
  /// Takes one more in; false once the multiple needs more bits than allowed.
  bool include(const Integer& denominator);
  /// The same of a coordinate, which may not be larger than that either: why not, for a message, which ends with what
  /// to do `instead` of a longer multiple; empty where it may be there.
  std::string why_not(const Rational& coordinate, std::string_view instead);

 private:
  Integer common_ = 1;
  std::unordered_set<std::int64_t> seen_;
};

/// Reads OFF in text, with or without colours, normals and texture coordinates (COFF, NOFF, STOFF, ...), which are
/// passed over. Throws Input_error. Exact: yes. Cost: one pass.
Polygon_soup read_off(const Input& input, const Read_options& options = {});

/// Reads OFF whose coordinates are integers or p/q. Throws Input_error, also where the common denominator gets too
/// long. Exact: yes.
Polygon_soup read_qoff(const Input& input, const Read_options& options = {});

/// Writes OFF. Throws Not_representable where a coordinate is no finite decimal or a face has holes. Exact: yes.
void write_off(const Polygon_soup& soup, std::ostream& out);

/// Writes OFF with coordinates p or p/q. Throws Not_representable where a face has holes. Exact: yes.
void write_qoff(const Polygon_soup& soup, std::ostream& out);

}  // namespace sightline
