#include <sightline/io/ply.h>

#include <sightline/io/binary.h>
#include <sightline/io/decimal.h>
#include <sightline/io/exact_text.h>
#include <sightline/io/format.h>
#include <sightline/io/input.h>
#include <sightline/io/text.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/quoted.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sightline {
namespace {

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

std::optional<std::size_t> Ply_element::find(std::initializer_list<std::string_view> names) const {
  for (std::size_t i = 0; i < properties.size(); ++i)
    if (std::find(names.begin(), names.end(), properties[i].name) != names.end()) return i;
  return std::nullopt;
}

Ply_header Ply_header_reader::read() {
  if (const std::string_view word = next_line(); word != "ply")
    text_.fail(word, "unexpected " + quoted(word) + "; a PLY file begins with a line ply");
  expect_end_of_line();
  read_encoding();
  for (;;) {
    const std::string_view word = next_line();
    if (word == "end_header") break;
    if (word == "comment" || word == "obj_info") continue;
    if (word == "element") read_element();
    else if (word == "property") read_property(word);
    else text_.fail(word, "unknown header line " + quoted(word) + "; write element, property, comment or end_header");
  }
  expect_end_of_line();
  check();
  return std::move(header_);
}

void Ply_header_reader::expect_end_of_line() {
  if (const std::string_view token = text_.next_token(); !token.empty())
    text_.fail(token, "unexpected " + quoted(token) + "; end the header line before it");
}

void Ply_header_reader::read_encoding() {
  std::string_view word = next_line();
  if (word != "format")
    text_.fail(word, "unexpected " + quoted(word) + "; the second line of a PLY file is its format");
  word = text_.next_token();
  if (word == "ascii") header_.encoding = Ply_encoding::text;
  else if (word == "binary_little_endian") header_.encoding = Ply_encoding::little_endian;
  else if (word == "binary_big_endian") header_.encoding = Ply_encoding::big_endian;
  else text_.fail(word, "unknown format " + quoted(word) + "; write ascii, binary_little_endian or binary_big_endian");
  word = text_.next_token();
  if (word != "1.0") text_.fail(word, "unknown version " + quoted(word) + "; only PLY 1.0 is supported");
  expect_end_of_line();
}

void Ply_header_reader::read_element() {
  const std::string_view name = text_.next_token(), count = text_.next_token();
  if (name.empty()) text_.fail(name, "the name of the element is missing; write element NAME COUNT");
  for (const Ply_element& other : header_.elements)
    if (other.name == name) text_.fail(name, "element " + quoted(name) + " comes twice; remove one");
  if (name == "tristrips") text_.fail(name, "triangle strips are not supported; convert them to faces");
  header_.elements.push_back({name, count, read_count(text_, count, "elements", 1), {}});
  expect_end_of_line();
}

void Ply_header_reader::read_property(std::string_view word) {
  if (header_.elements.empty())
    text_.fail(word, "a property before the first element; write element NAME COUNT before it");
  Ply_property property{};
  std::string_view token = text_.next_token();
  if (token == "list") {
    token = text_.next_token();
    property.count_type = read_type(token);
    if (!is_integer(*property.count_type))
      text_.fail(token, "a list's length cannot be " + quoted(token) + "; write an integer type such as uchar");
    token = text_.next_token();
  }
  property.type = read_type(token);
  property.name = text_.next_token();
  if (property.name.empty()) text_.fail(property.name, "the name of the property is missing; write property TYPE NAME");
  Ply_element& element = header_.elements.back();
  if (element.find({property.name}))
    text_.fail(property.name, "property " + quoted(property.name) + " comes twice; remove one");
  const bool is_corners =
      element.name == "face" && (property.name == "vertex_indices" || property.name == "vertex_index");
  if (is_corners && !(property.count_type && is_integer(property.type)))
    text_.fail(property.name,
               quoted(property.name) + " is not a list of integers; write property list uchar int vertex_indices");
  const bool is_coordinate =
      element.name == "vertex" && (property.name == "x" || property.name == "y" || property.name == "z");
  if (is_coordinate && property.count_type)
    text_.fail(property.name,
               quoted(property.name) + " is a list; write property double " + std::string(property.name));
  expect_end_of_line();
  element.properties.push_back(property);
}

Ply_type Ply_header_reader::read_type(std::string_view token) {
  constexpr std::array<std::array<std::string_view, 2>, 8> names{{{"char", "int8"},
                                                                  {"uchar", "uint8"},
                                                                  {"short", "int16"},
                                                                  {"ushort", "uint16"},
                                                                  {"int", "int32"},
                                                                  {"uint", "uint32"},
                                                                  {"float", "float32"},
                                                                  {"double", "float64"}}};
  for (std::size_t i = 0; i < names.size(); ++i)
    if (token == names[i][0] || token == names[i][1]) return static_cast<Ply_type>(i);
  text_.fail(token, "unknown type " + quoted(token) + "; write char, uchar, short, ushort, int, uint, float or double");
}

void Ply_header_reader::check() {
  bool has_points = false;
  for (const Ply_element& element : header_.elements) {
    const auto need = [&](std::initializer_list<std::string_view> names) {
      if (!element.find(names))
        text_.fail(element.name, "element " + std::string(element.name) + " has no property " +
                                     std::string(*names.begin()) + "; add it to the header and the data");
    };
    if (element.name == "vertex") {
      need({"x"});
      need({"y"});
      need({"z"});
      has_points = true;
    }
    if (element.name == "face") need({"vertex_indices", "vertex_index"});
  }
  if (!has_points)
    text_.fail({text_.cursor(), 0}, "the header has no element vertex; add it and its properties x, y and z");
}

void Ply_text_values::begin(const Ply_element& element, std::size_t i) {
  if (!text_.next_line())
    text_.fail_at_end("the file ends after " + std::to_string(i) + " of " + std::to_string(element.count) +
                      " elements " + quoted(element.name) +
                      "; correct the count, or fetch the file again if it is cut off");
}

std::int64_t Ply_text_values::integer(Ply_type) {
  token_ = text_.next_token();
  if (token_.empty()) text_.fail(token_, "a number is missing; an element has all its properties on one line");
  const std::optional<std::int64_t> value = parse_integer(token_);
  if (!value) text_.fail(token_, quoted(token_) + " is not an integer; write one");
  return *value;
}

void Ply_text_values::end() {
  if (token_ = text_.next_token(); !token_.empty())
    fail("unexpected " + quoted(token_) + "; an element has no more properties in the header");
}

void Ply_text_values::end_all() {
  if (text_.next_line()) {
    token_ = text_.next_token();
    fail("more lines than the header announces; correct its counts");
  }
}

std::size_t Ply_text_values::room(const Ply_element& element) const {
  return element.properties.empty() ? std::numeric_limits<std::size_t>::max()
                                    : text_.bytes_left() / (2 * element.properties.size());
}

Number Ply_binary_values::coordinate(Ply_type type) {
  if (is_integer(type)) return Decimal{integer(type), 0};
  take(type);
  const double value = type == Ply_type::float32 ? double{load<float>(input_.bytes, last_, order_)}
                                                 : load<double>(input_.bytes, last_, order_);
  if (!std::isfinite(value)) fail("a coordinate is not a finite number; repair or remove the point");
  return value;
}

std::int64_t Ply_binary_values::integer(Ply_type type) {
  take(type);
  const auto value = [this]<class Value>(Value) { return std::int64_t{load<Value>(input_.bytes, last_, order_)}; };
  switch (type) {
    case Ply_type::int8: return value(std::int8_t{});
    case Ply_type::uint8: return value(std::uint8_t{});
    case Ply_type::int16: return value(std::int16_t{});
    case Ply_type::uint16: return value(std::uint16_t{});
    case Ply_type::int32: return value(std::int32_t{});
    default: return value(std::uint32_t{});
  }
}

std::size_t Ply_binary_values::room(const Ply_element& element) const {
  std::size_t bytes = 0;
  for (const Ply_property& property : element.properties)
    bytes += bytes_of(property.count_type.value_or(property.type));
  return bytes == 0 ? std::numeric_limits<std::size_t>::max() : (input_.bytes.size() - next_) / bytes;
}

void Ply_binary_values::take(Ply_type type, std::size_t count) {
  if (count > room(type))
    input_.fail_at_byte(input_.bytes.size(), "the file ends within its data; fetch it again if it is cut off");
  last_ = next_;
  next_ += count * bytes_of(type);
}

double double_that_is(const Rational& value, Point_id p) {
  const double nearest = nearest_double(value);
  if (!std::isfinite(nearest) || exact(nearest) != value)
    throw Not_representable("binary PLY cannot hold the coordinate " + printable(to_string(value), 40, true) +
                            " of point " + std::to_string(p) +
                            ", which is no double; write .qoff, or text where it is a finite decimal");
  return nearest;
}

}  // namespace

Polygon_soup read_ply(const Input& input, const Read_options& options) {
  Text_reader text(input, Text_reader::Comments::none);
  const Ply_header header = Ply_header_reader(text).read();
  if (header.encoding == Ply_encoding::text) return Ply_reader(text, header, Ply_text_values(text, options)).read();
  // The data begin behind the header's last line end. If the lines end with \r alone, a \n behind it is data.
  text.finish_line();
  auto begin = static_cast<std::size_t>(text.cursor() - input.bytes.data());
  const std::size_t first_end = input.bytes.find_first_of("\r\n");
  const bool only_carriage_return = input.bytes[first_end] == '\r' && input.bytes[first_end + 1] != '\n';
  if (only_carriage_return && input.bytes[begin - 1] == '\n') --begin;
  const std::endian order = header.encoding == Ply_encoding::little_endian ? std::endian::little : std::endian::big;
  return Ply_reader(text, header, Ply_binary_values(input, begin, order)).read();
}

void write_ply(const Polygon_soup& soup, std::ostream& out, bool binary) {
  check_no_holes(soup, "PLY");
  std::size_t most_corners = 0;
  for (Face_id f = 0; f < soup.face_count(); ++f) most_corners = std::max(most_corners, soup.loop(f).size());
  const bool short_lists = most_corners < 256;
  out << std::string("ply\nformat ") + (binary ? "binary_little_endian" : "ascii") + " 1.0\nelement vertex " +
             std::to_string(soup.point_count()) +
             "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
             std::to_string(soup.face_count()) + "\nproperty list " + (short_lists ? "uchar" : "uint") +
             " uint vertex_indices\nend_header\n";
  for (Point_id p = 0; p < soup.point_count(); ++p) {
    std::string bytes;
    if (binary)
      for (const Rational& coordinate : soup.point(p)) store(bytes, double_that_is(coordinate, p));
    else bytes = decimal_texts(soup, p, "PLY").substr(1) + "\n";
    out << bytes;
  }
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    const std::span<const Point_id> corners = soup.loop(f);
    std::string bytes;
    if (!binary) {
      bytes = std::to_string(corners.size());
      for (const Point_id p : corners) (bytes += ' ') += std::to_string(p);
      bytes += '\n';
    } else {
      if (short_lists) store(bytes, static_cast<std::uint8_t>(corners.size()));
      else store(bytes, static_cast<std::uint32_t>(corners.size()));
      for (const Point_id p : corners) store(bytes, p);
    }
    out << bytes;
  }
}

}  // namespace sightline
