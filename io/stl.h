#pragma once
// STL, text and binary: triangles, of which equal points are made one.

#include <sightline/io/decimal.h>
#include <sightline/io/format.h>
#include <sightline/io/input.h>
#include <sightline/io/text.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/quoted.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

namespace sightline {

namespace detail {

/// Gives points their ids, one to each exact value, in the order of first appearance. Value: == and hash of equal
/// numbers agree.
template <class Value>
class Point_merger {
 public:
  using Point = std::array<Value, 3>;

  /// The id of the point; fresh says whether it has not come before.
  std::pair<Point_id, bool> id(const Point& point) {
    const auto [place, fresh] = ids_.try_emplace(point, static_cast<Point_id>(ids_.size()));
    return {place->second, fresh};
  }

 private:
  struct Hash {
    static std::size_t hash(float value) { return std::hash<float>()(value); }  // 0 for -0, too
    static std::size_t hash(const Number& number) {
      if (const auto* decimal = std::get_if<Decimal>(&number))
        return std::hash<std::int64_t>()(decimal->mantissa) + static_cast<std::size_t>(decimal->exponent);
      if (const auto* floating = std::get_if<double>(&number)) return std::hash<double>()(*floating);
      const Rational& value = std::get<Rational>(number);
      return mpz_get_ui(value.get_num().get_mpz_t()) + 31 * mpz_get_ui(value.get_den().get_mpz_t());
    }
    std::size_t operator()(const Point& point) const {
      std::uint64_t mixed = 0;
      for (const Value& value : point) {
        mixed = (mixed ^ hash(value)) * 0x9E3779B97F4A7C15u;
        mixed ^= mixed >> 32;
      }
      return mixed;
    }
  };
  std::unordered_map<Point, Point_id, Hash> ids_;
};

/// Reads `solid NAME`, facets, `endsolid NAME`, any number of times. Words in upper or lower case; line ends are blanks
/// except behind a name.
class Stl_text_reader {
 public:
  Stl_text_reader(const Input& input, const Read_options& options)
      : text_(input, Text_reader::Comments::none), options_(options) {}

  Polygon_soup read() {
    while (text_.next_line()) read_solid();
    return std::move(soup_);
  }

 private:
  void read_solid();

  void read_facet();

  Point_id read_vertex();

  std::string_view next_word(const std::string& expected);
  static bool is(std::string_view word, std::string_view lower);
  void expect(const std::string& lower) {
    if (const std::string_view word = next_word(lower); !is(word, lower)) fail_unexpected(word, lower);
  }
  [[noreturn]] void fail_unexpected(std::string_view word, const std::string& expected) {
    text_.fail(word, "unexpected " + quoted(word) + "; write " + expected + " here");
  }

  Text_reader text_;
  const Read_options& options_;
  Polygon_soup soup_;
  Point_merger<Number> merger_;
  std::vector<Point_id> corners_;
};

/// After the header a count of 4 bytes; a facet is a normal, three points, 2 spare bytes.
inline constexpr std::size_t stl_header_bytes = 80, stl_facet_bytes = 50;

/// Whether the bytes are a binary STL file, by their number; also where they begin with "solid", as they should not but
/// do. Text is not mistaken: four characters of it, taken for a count, mean 0x09090909 facets or more, a file of 7.5
/// GB.
bool has_binary_stl_size(std::string_view bytes);

/// Whether the bytes begin with the word "solid", in upper or lower case, and hold no zero byte near the beginning.
bool looks_like_stl_text(const Input& input);

Polygon_soup read_stl_binary(const Input& input);

}  // namespace detail

/// Reads STL, text or binary. Points are merged by exact value; facet normals, names and spare bytes are passed over.
/// Throws Input_error. Exact: yes (the floats of binary data as they are). Cost: one pass, and a hash table of the
/// points.
Polygon_soup read_stl(const Input& input, const Read_options& options = {});

/// Writes STL in text; normals are written as 0 0 0, which stands for "as the points say". Reading gives the same
/// triangles, but only the points in use, and each once. Throws Not_representable where a face is no triangle or a
/// coordinate no finite decimal. Exact: yes.
void write_stl(const Polygon_soup& soup, std::ostream& out);

}  // namespace sightline
