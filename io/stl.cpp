#include <sightline/io/stl.h>

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
#include <functional>
#include <ostream>
#include <random>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

namespace sightline {
namespace {

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
    /// Another one in each process, so that nobody makes up points that have the same.
    static std::uint64_t mixed(std::uint64_t a, std::uint64_t b) {
      static const std::array<std::uint64_t, 2> secret = [] {
        std::random_device random;
        std::array<std::uint64_t, 2> words;
        for (std::uint64_t& word : words) word = std::uint64_t{random()} << 32 | random();
        return words;
      }();
      const unsigned __int128 product = static_cast<unsigned __int128>(a ^ secret[0]) * (b ^ secret[1]);
      return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
    }
    static std::size_t hash(float value) { return std::hash<float>()(value); }  // 0 for -0, too
    static std::size_t hash(const Number& number) {
      if (const auto* decimal = std::get_if<Decimal>(&number))
        return mixed(static_cast<std::uint64_t>(decimal->mantissa), static_cast<std::uint64_t>(decimal->exponent));
      if (const auto* floating = std::get_if<double>(&number)) return std::hash<double>()(*floating);
      const Rational& value = std::get<Rational>(number);
      std::uint64_t all = 0;
      for (const Integer* part : {&value.get_num(), &value.get_den()}) {
        all = mixed(all, mpz_size(part->get_mpz_t()));  // where the one ends and the other begins
        for (std::size_t k = 0; k < mpz_size(part->get_mpz_t()); ++k)
          all = mixed(all, mpz_getlimbn(part->get_mpz_t(), static_cast<mp_size_t>(k)));
      }
      return mixed(all, sgn(value) < 0 ? 1 : 0);
    }
    std::size_t operator()(const Point& point) const {
      std::uint64_t all = 0;
      for (const Value& value : point) {
        all = mixed(all, hash(value));
      }
      return all;
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

void Stl_text_reader::read_solid() {
  expect("solid");
  // A name may have any words, but what follows it on its line would be lost.
  for (std::string_view word = text_.next_token(), before; !word.empty(); before = word, word = text_.next_token())
    if (is(word, "normal") && is(before, "facet")) text_.fail(before, "a facet on the line of a name; break the line");
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

}  // namespace

bool is_stl(const Input& input) { return has_binary_stl_size(input.bytes) || looks_like_stl_text(input); }

Polygon_soup read_stl(const Input& input, const Read_options& options) {
  // The size has the last word beyond 16 million facets; a smaller count has a zero byte, which text has not.
  if (!has_binary_stl_size(input.bytes) && looks_like_stl_text(input)) return Stl_text_reader(input, options).read();
  return read_stl_binary(input);
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
