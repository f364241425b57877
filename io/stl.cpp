#include <sightline/io/stl.h>

#include <sightline/io/binary.h>

#include <sightline/io/exact_text.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace sightline {
namespace detail {

void Stl_text_reader::read_solid() {
  expect("solid");
  text_.finish_line();
  for (;;) {
    const std::string_view word = next_word("facet");
    if (is(word, "endsolid")) break;
    if (!is(word, "facet")) fail_unexpected(word, "facet or endsolid");
    read_facet();
  }
  text_.finish_line();
}

void Stl_text_reader::read_facet() {
  expect("normal");
  for (int i = 0; i < 3; ++i) skip_number(text_, next_word("a normal"));
  expect("outer");
  expect("loop");
  corners_.clear();
  for (;;) {
    const std::string_view word = next_word("vertex");
    if (is(word, "endloop")) break;
    if (!is(word, "vertex")) fail_unexpected(word, "vertex or endloop");
    corners_.push_back(read_vertex());
  }
  expect("endfacet");
  soup_.add_face(corners_);
}

Point_id Stl_text_reader::read_vertex() {
  std::array<Number, 3> point;
  for (Number& coordinate : point)
    coordinate = read_coordinate(text_, next_word("a coordinate"), Number_syntax::decimal, options_);
  const auto [id, fresh] = merger_.id(point);
  if (fresh)
    for (const Number& coordinate : point) push(soup_.coordinates, coordinate);
  return id;
}

std::string_view Stl_text_reader::next_word(const std::string& expected) {
  const std::string_view word = text_.next_token_of_any_line();
  if (word.empty())
    text_.fail_at_end("the file ends where " + expected + " should follow; fetch it again if it is cut off");
  return word;
}

bool Stl_text_reader::is(std::string_view word, std::string_view lower) {
  return std::equal(word.begin(), word.end(), lower.begin(), lower.end(),
                    [](char c, char l) { return c == l || (c >= 'A' && c <= 'Z' && c + 32 == l); });
}

bool has_binary_stl_size(std::string_view bytes) {
  constexpr std::size_t facets_begin = stl_header_bytes + 4;
  return bytes.size() >= facets_begin &&
         bytes.size() - facets_begin ==
             stl_facet_bytes * std::size_t{load<std::uint32_t>(bytes, stl_header_bytes, std::endian::little)};
}

bool looks_like_stl_text(const Input& input) {
  Text_reader text(input, Text_reader::Comments::none);
  std::string word(text.next_token_of_any_line().substr(0, 6));
  for (char& c : word) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
  return word == "solid" && input.bytes.substr(0, stl_header_bytes + 4).find('\0') == std::string_view::npos;
}

Polygon_soup read_stl_binary(const Input& input) {
  constexpr std::size_t facets_begin = stl_header_bytes + 4;
  const std::string_view bytes = input.bytes;
  if (bytes.size() < facets_begin)
    input.fail_at_byte(bytes.size(),
                       "the file ends within the header of 84 bytes of a binary STL file; fetch it again if it is cut "
                       "off (text begins with solid)");
  const std::size_t count = load<std::uint32_t>(bytes, stl_header_bytes, std::endian::little);
  const std::size_t room = bytes.size() - facets_begin;
  if (count > room / stl_facet_bytes)
    input.fail_at_byte(bytes.size(), std::to_string(count) + " facets are announced, but the file ends after " +
                                         std::to_string(room / stl_facet_bytes) +
                                         "; fetch it again if it is cut off (text begins with solid)");
  if (count * stl_facet_bytes != room)
    input.fail_at_byte(facets_begin + count * stl_facet_bytes,
                       "the file goes on after the " + std::to_string(count) +
                           " facets that are announced; correct the count at byte 80");

  Polygon_soup soup;
  Point_merger<float> merger;
  for (std::size_t facet = 0; facet < count; ++facet) {
    std::array<Point_id, 3> corners;
    std::size_t offset = facets_begin + facet * stl_facet_bytes + 12;  // behind the normal
    for (Point_id& corner : corners) {
      std::array<float, 3> point;
      for (float& coordinate : point) {
        coordinate = load<float>(bytes, offset, std::endian::little);
        if (!std::isfinite(coordinate))
          input.fail_at_byte(offset, "a coordinate is not a finite number; repair or remove the facet");
        offset += sizeof(float);
      }
      const auto [id, fresh] = merger.id(point);
      if (fresh) soup.add_point(double{point[0]}, double{point[1]}, double{point[2]});
      corner = id;
    }
    soup.add_face(corners);
  }
  return soup;
}

}  // namespace detail

Polygon_soup read_stl(const Input& input, const Read_options& options) {
  // The size has the last word beyond 16 million facets; a smaller count has a zero byte, which text has not.
  if (!detail::has_binary_stl_size(input.bytes) && detail::looks_like_stl_text(input))
    return detail::Stl_text_reader(input, options).read();
  return detail::read_stl_binary(input);
}

void write_stl(const Polygon_soup& soup, std::ostream& out) {
  check_no_holes(soup, "STL");
  out << "solid sightline\n";
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    if (soup.loop(f).size() != 3)
      throw Not_representable("STL cannot hold face " + std::to_string(f) + ", which has " +
                              std::to_string(soup.loop(f).size()) +
                              " corners; triangulate it first, or write .obj, .off, .ply or .qoff");
    out << "facet normal 0 0 0\nouter loop\n";
    for (const Point_id p : soup.loop(f)) out << "vertex" + decimal_texts(soup, p, "STL") + "\n";
    out << "endloop\nendfacet\n";
  }
  out << "endsolid sightline\n";
}

}  // namespace sightline
