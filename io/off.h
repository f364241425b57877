#pragma once
// Geomview's OFF, and OFF with rational coordinates (.qoff).

#include <sightline/io/decimal.h>
#include <sightline/io/format.h>
#include <sightline/io/input.h>
#include <sightline/io/text.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <cstdint>
#include <ostream>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace sightline {

/// The common denominator of a soup's coordinates has at most this many bits, or every number of the scene, scaled to
/// integers, would have them. Decimals and doubles never need more (2^1100 5^1100 has 3655), p/q may.
inline constexpr std::size_t largest_common_denominator_bits = 8192;

namespace detail {

/// The least common multiple of denominators as they come along, up to the limit. Cost: a division by the new one; a
/// look into a table where it has come before.
class Common_denominator {
 public:
  /// Takes one more in; false once the multiple needs more bits than allowed.
  bool include(const Integer& denominator);

 private:
  Integer common_ = 1;
  std::unordered_set<std::int64_t> seen_;
};

/// Reads OFF line by line: [OFF], the counts V F [E], V lines of points, F lines of faces.
class Off_reader {
 public:
  Off_reader(const Input& input, Number_syntax syntax, const Read_options& options)
      : text_(input, Text_reader::Comments::hash), syntax_(syntax), options_(options) {}

  Polygon_soup read();

 private:
  /// Reads [ST][C][N][4][n]OFF, of which the last two and BINARY are refused, and gives the first count, which may
  /// stand on its line or the next. As Geomview has it, the word may be missing.
  std::string_view read_header();

  void read_counts(std::string_view token);

  void read_point(std::size_t i);

  void read_face(std::size_t i);

  /// Passes over at most so many numbers. Throws on any others.
  void expect_end_of_line(int numbers);

  [[noreturn]] void fail_cut_off(std::size_t found, std::size_t announced, const std::string& what);

  Text_reader text_;
  Number_syntax syntax_;
  const Read_options& options_;
  bool attributes_ = false;
  std::size_t points_ = 0, faces_ = 0;
  Common_denominator denominator_;
  Polygon_soup soup_;
  std::vector<Point_id> corners_;
};

void write_off(const Polygon_soup& soup, std::ostream& out, bool rational);

}  // namespace detail

/// Reads OFF in text, with or without colours, normals and texture coordinates (COFF, NOFF, STOFF, ...), which are
/// passed over. Throws Input_error. Exact: yes. Cost: one pass.
inline Polygon_soup read_off(const Input& input, const Read_options& options = {}) {
  return detail::Off_reader(input, Number_syntax::decimal, options).read();
}

/// Reads OFF whose coordinates are integers or p/q. Throws Input_error, also where the common denominator gets too
/// long. Exact: yes.
inline Polygon_soup read_qoff(const Input& input, const Read_options& options = {}) {
  return detail::Off_reader(input, Number_syntax::rational, options).read();
}

/// Writes OFF. Throws Not_representable where a coordinate is no finite decimal or a face has holes. Exact: yes.
inline void write_off(const Polygon_soup& soup, std::ostream& out) { detail::write_off(soup, out, false); }

/// Writes OFF with coordinates p or p/q. Throws Not_representable where a face has holes. Exact: yes.
inline void write_qoff(const Polygon_soup& soup, std::ostream& out) { detail::write_off(soup, out, true); }

}  // namespace sightline
