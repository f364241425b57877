#include <sightline/io/ply.h>

#include <sightline/io/binary.h>
#include <sightline/io/exact_text.h>

#include <cmath>
#include <limits>
#include <span>

namespace sightline {
namespace detail {

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

}  // namespace detail

Polygon_soup read_ply(const Input& input, const Read_options& options) {
  Text_reader text(input, Text_reader::Comments::none);
  const detail::Ply_header header = detail::Ply_header_reader(text).read();
  if (header.encoding == detail::Ply_encoding::text)
    return detail::Ply_reader(text, header, detail::Ply_text_values(text, options)).read();
  // The data begin behind the header's last line end. If the lines end with \r alone, a \n behind it is data.
  text.finish_line();
  auto begin = static_cast<std::size_t>(text.cursor() - input.bytes.data());
  const std::size_t first_end = input.bytes.find_first_of("\r\n");
  const bool only_carriage_return = input.bytes[first_end] == '\r' && input.bytes[first_end + 1] != '\n';
  if (only_carriage_return && input.bytes[begin - 1] == '\n') --begin;
  const std::endian order =
      header.encoding == detail::Ply_encoding::little_endian ? std::endian::little : std::endian::big;
  return detail::Ply_reader(text, header, detail::Ply_binary_values(input, begin, order)).read();
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
      for (const Rational& coordinate : soup.point(p)) store(bytes, detail::double_that_is(coordinate, p));
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
