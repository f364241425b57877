#pragma once
// Stanford PLY: text, and binary of either byte order.

#include <sightline/io/decimal.h>
#include <sightline/io/format.h>
#include <sightline/io/input.h>
#include <sightline/io/text.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/quoted.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sightline {

namespace detail {

enum class Ply_encoding { text, little_endian, big_endian };
enum class Ply_type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

inline constexpr std::array<std::size_t, 8> ply_type_bytes{1, 1, 2, 2, 4, 4, 4, 8};
inline std::size_t bytes_of(Ply_type type) { return ply_type_bytes[static_cast<std::size_t>(type)]; }
inline bool is_integer(Ply_type type) { return type < Ply_type::float32; }

struct Ply_property {
  std::string_view name;
  Ply_type type;                       // of the value, or of the items of a list
  std::optional<Ply_type> count_type;  // of a list's length
};

struct Ply_element {
  std::string_view name, count_token;
  std::size_t count;
  std::vector<Ply_property> properties;

  /// The place of the first property of one of these names, or nothing.
  std::optional<std::size_t> find(std::initializer_list<std::string_view> names) const;
};

struct Ply_header {
  Ply_encoding encoding;
  std::vector<Ply_element> elements;
};

/// Reads a PLY header, up to and with the line end_header. Throws on what is not one, or is one of another kind of
/// surface.
class Ply_header_reader {
 public:
  explicit Ply_header_reader(Text_reader& text) : text_(text) {}

  Ply_header read();

 private:
  std::string_view next_line() {
    if (!text_.next_line()) text_.fail_at_end("the file ends within the header; fetch it again if it is cut off");
    return text_.next_token();
  }
  void expect_end_of_line();

  void read_encoding();

  void read_element();

  void read_property(std::string_view word);

  Ply_type read_type(std::string_view token);

  /// Points need x, y and z, faces a list of corners, and there must be points.
  void check();

  Text_reader& text_;
  Ply_header header_{};
};

/// The values of a PLY file in text, an element a line. Their types say nothing: a decimal is what it is.
class Ply_text_values {
 public:
  Ply_text_values(Text_reader& text, const Read_options& options) : text_(text), options_(options) {}

  void begin(const Ply_element& element, std::size_t i);
  Number coordinate(Ply_type) {
    return read_coordinate(text_, token_ = text_.next_token(), Number_syntax::decimal, options_);
  }
  std::int64_t integer(Ply_type);
  void skip(Ply_type, std::size_t count) {
    while (count-- > 0) skip_number(text_, token_ = text_.next_token());
  }
  void end();
  void end_all();
  /// How many values there is room for, at most.
  std::size_t room(Ply_type) const { return text_.bytes_left() / 2; }
  std::size_t room(const Ply_element& element) const;
  [[noreturn]] void fail(const std::string& message) const { text_.fail(token_, message); }

 private:
  Text_reader& text_;
  const Read_options& options_;
  std::string_view token_;  // the last one
};

/// The values of a PLY file in binary.
class Ply_binary_values {
 public:
  Ply_binary_values(const Input& input, std::size_t offset, std::endian order)
      : input_(input), next_(offset), last_(offset), order_(order) {}

  void begin(const Ply_element&, std::size_t) {}
  Number coordinate(Ply_type type);
  std::int64_t integer(Ply_type type);
  void skip(Ply_type type, std::size_t count) { take(type, count); }
  void end() {}
  void end_all() {
    last_ = next_;
    if (input_.bytes.find_first_not_of(" \t\r\n", next_) != std::string_view::npos)
      fail("more data than the header announces; correct its counts");
  }
  std::size_t room(Ply_type type) const { return (input_.bytes.size() - next_) / bytes_of(type); }
  std::size_t room(const Ply_element& element) const;
  [[noreturn]] void fail(const std::string& message) const { input_.fail_at_byte(last_, message); }

 private:
  void take(Ply_type type, std::size_t count = 1);

  const Input& input_;
  std::size_t next_, last_;  // offsets
  std::endian order_;
};

/// Reads the elements of a PLY file into a soup.
template <class Values>
class Ply_reader {
 public:
  Ply_reader(const Text_reader& text, const Ply_header& header, Values values)
      : text_(text), header_(header), values_(std::move(values)) {}

  Polygon_soup read() {
    for (const Ply_element& element : header_.elements)
      if (element.name == "vertex") points_ = element.count;
    for (const Ply_element& element : header_.elements) {
      if (element.properties.empty()) continue;
      if (element.count > values_.room(element))
        text_.fail(element.count_token, std::to_string(element.count) + " elements " + quoted(element.name) +
                                            " are announced, but there is room for " +
                                            std::to_string(values_.room(element)) +
                                            " at most; correct the count, or fetch the file again if it is cut off");
      if (element.name == "vertex") read_points(element);
      else if (element.name == "face") read_faces(element);
      else read_others(element);
    }
    values_.end_all();
    return std::move(soup_);
  }

 private:
  void read_points(const Ply_element& element) {
    const std::array<std::size_t, 3> xyz{*element.find({"x"}), *element.find({"y"}), *element.find({"z"})};
    std::array<Number, 3> point;
    soup_.coordinates.reserve(3 * element.count);
    for (std::size_t i = 0; i < element.count; ++i) {
      values_.begin(element, i);
      for (std::size_t k = 0; k < element.properties.size(); ++k) {
        const auto place = std::find(xyz.begin(), xyz.end(), k);
        if (place == xyz.end()) skip(element.properties[k]);
        else point[static_cast<std::size_t>(place - xyz.begin())] = values_.coordinate(element.properties[k].type);
      }
      values_.end();
      for (const Number& coordinate : point) push(soup_.coordinates, coordinate);
    }
  }

  void read_faces(const Ply_element& element) {
    const std::size_t corners = *element.find({"vertex_indices", "vertex_index"});
    for (std::size_t i = 0; i < element.count; ++i) {
      values_.begin(element, i);
      for (std::size_t k = 0; k < element.properties.size(); ++k) {
        if (k == corners) read_corners(element.properties[k]);
        else skip(element.properties[k]);
      }
      values_.end();
      soup_.add_face(corners_);
    }
  }

  void read_corners(const Ply_property& list) {
    const std::size_t count = list_length(list);
    corners_.clear();
    for (std::size_t k = 0; k < count; ++k) {
      const std::int64_t index = values_.integer(list.type);
      if (index < 0 || index >= static_cast<std::int64_t>(points_))
        values_.fail("vertex index " + std::to_string(index) + " is out of range; there are " +
                     std::to_string(points_) + " vertices, counted from 0");
      corners_.push_back(static_cast<Point_id>(index));
    }
  }

  void read_others(const Ply_element& element) {
    for (std::size_t i = 0; i < element.count; ++i) {
      values_.begin(element, i);
      for (const Ply_property& property : element.properties) skip(property);
      values_.end();
    }
  }

  void skip(const Ply_property& property) {
    values_.skip(property.type, property.count_type ? list_length(property) : 1);
  }

  std::size_t list_length(const Ply_property& list) {
    const std::int64_t length = values_.integer(*list.count_type);
    if (static_cast<std::size_t>(length) > values_.room(list.type))  // one below 0 is beyond any room, too
      values_.fail("a list of " + std::to_string(length) + " numbers, but there is room for " +
                   std::to_string(values_.room(list.type)) +
                   " at most; correct the length, or fetch the file again if it is cut off");
    return static_cast<std::size_t>(length);
  }

  const Text_reader& text_;
  const Ply_header& header_;
  Values values_;
  std::size_t points_ = 0;
  Polygon_soup soup_;
  std::vector<Point_id> corners_;
};

/// The double that a coordinate of point p is. Throws Not_representable where it is none.
double double_that_is(const Rational& value, Point_id p);

}  // namespace detail

/// Reads PLY 1.0: of each vertex x, y and z, of each face vertex_indices (or vertex_index); everything else is passed
/// over. Throws Input_error. Exact: yes (decimals in text, floats in binary data as they are). Cost: one pass.
Polygon_soup read_ply(const Input& input, const Read_options& options = {});

/// Writes PLY, as text or as little-endian doubles. Throws Not_representable where a coordinate is no finite decimal
/// (text) or no double (binary), or a face has holes. Exact: yes.
void write_ply(const Polygon_soup& soup, std::ostream& out, bool binary);

}  // namespace sightline
