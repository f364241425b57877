#include <sightline/io/off.h>

#include <sightline/io/decimal.h>
#include <sightline/io/exact_text.h>
#include <sightline/io/format.h>
#include <sightline/io/input.h>
#include <sightline/io/text.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/quoted.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <variant>
#include <vector>

namespace sightline {

bool Common_denominator::include(const Integer& denominator) {
  if (bit_length(denominator) > largest_common_denominator_bits) return false;  // at once, however long it is
  if (fits_int64(denominator) && !seen_.insert(denominator.get_si()).second) return true;
  if (!mpz_divisible_p(common_.get_mpz_t(), denominator.get_mpz_t())) common_ = lcm(common_, denominator);
  return bit_length(common_) <= largest_common_denominator_bits;
}

std::string Common_denominator::why_not(const Rational& coordinate, std::string_view instead) {
  const std::string most = std::to_string(largest_common_denominator_bits);
  if (bit_length(coordinate.get_num()) > bit_length(coordinate.get_den()) + largest_common_denominator_bits)
    return "a coordinate beyond 2^" + most + "; scale the scene so that it is less";
  if (include(coordinate.get_den())) return {};
  return "common denominator of the coordinates needs more than " + most + " bits; " + std::string(instead);
}

namespace {

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

Polygon_soup Off_reader::read() {
  read_counts(read_header());
  soup_.coordinates.reserve(3 * points_);
  for (std::size_t i = 0; i < points_; ++i) read_point(i);
  for (std::size_t i = 0; i < faces_; ++i) read_face(i);
  if (text_.next_line())
    text_.fail(text_.next_token(), "more lines than the " + std::to_string(points_) + " vertices and " +
                                       std::to_string(faces_) +
                                       " faces that are announced; correct the counts in the header");
  return std::move(soup_);
}

std::string_view Off_reader::read_header() {
  if (!text_.next_line())
    text_.fail_at_end("no header; begin the file with a line OFF, then the counts of vertices, faces and edges");
  const std::string_view word = text_.next_token();
  if (parse_integer(word)) return word;
  std::string_view kind = word;
  const auto skip = [&kind](std::string_view prefix) {
    if (!kind.starts_with(prefix)) return false;
    kind.remove_prefix(prefix.size());
    return true;
  };
  for (const std::string_view prefix : {"ST", "C", "N"}) attributes_ = skip(prefix) || attributes_;
  const bool has_four = skip("4"), has_more = skip("n");
  if (kind != "OFF")
    text_.fail(word, "unknown header " + quoted(word) +
                         "; begin the file with a line OFF, then the counts of vertices, faces and edges");
  if (has_four || has_more)
    text_.fail(word, "points of " + quoted(word) + " are not of three dimensions; project them to OFF first");
  std::string_view token = text_.next_token();
  if (token == "BINARY") text_.fail(token, "binary OFF is not supported; convert the file to text, or to binary PLY");
  if (!token.empty()) return token;
  if (!text_.next_line())
    text_.fail_at_end("the counts are missing; write the numbers of vertices, faces and edges behind OFF");
  return text_.next_token();
}

void Off_reader::read_counts(std::string_view token) {
  points_ = read_count(text_, token, "vertices", std::string_view("0 0 0\n").size());
  faces_ = read_count(text_, text_.next_token(), "faces", std::string_view("0\n").size());
  token = text_.next_token();
  if (!token.empty() && !parse_integer(token))
    text_.fail(token, quoted(token) + " is not a number of edges; write a count such as 12, or 0");
  expect_end_of_line(0);
}

void Off_reader::read_point(std::size_t i) {
  if (!text_.next_line()) fail_cut_off(i, points_, "vertices");
  for (int k = 0; k < 3; ++k) {
    const std::string_view token = text_.next_token();
    const bool is_decimal = options_.decimals_too && token.find('/') == std::string_view::npos;
    const Number number = read_coordinate(text_, token, is_decimal ? Number_syntax::decimal : syntax_, options_);
    const auto* value = std::get_if<Rational>(&number);
    if (value && syntax_ == Number_syntax::rational && !options_.any_denominator)
      if (const std::string why = denominator_.why_not(
              *value,
              "read the file with coordinates rounded to double (--coordinates double), or round them in the file");
          !why.empty())
        text_.fail(token, why);
    push(soup_.coordinates, number);
  }
  // A normal, a colour, a texture coordinate. Plain OFF has none, but colours are often met there.
  expect_end_of_line(attributes_ ? 9 : 4);
}

void Off_reader::read_face(std::size_t i) {
  if (!text_.next_line()) fail_cut_off(i, faces_, "faces");
  std::string_view token = text_.next_token();
  const std::size_t count = read_count(text_, token, "corners", std::string_view(" 0").size());
  corners_.clear();
  for (std::size_t k = 0; k < count; ++k) {
    token = text_.next_token();
    if (token.empty())
      text_.fail(token, "corner " + std::to_string(k + 1) + " of " + std::to_string(count) +
                            " is missing; write them all on one line");
    const std::optional<std::int64_t> index = parse_integer(token);
    if (!index) text_.fail(token, quoted(token) + " is not a vertex index; write an integer");
    if (*index >= static_cast<std::int64_t>(points_) || token.front() == '-')
      text_.fail(token, "vertex index " + quoted(token) + " is out of range; there are " + std::to_string(points_) +
                            " vertices, counted from 0");
    corners_.push_back(static_cast<Point_id>(*index));
  }
  expect_end_of_line(4);  // a colour
  soup_.add_face(corners_);
}

void Off_reader::expect_end_of_line(int numbers) {
  for (std::string_view token = text_.next_token(); !token.empty(); token = text_.next_token()) {
    if (numbers-- == 0)
      text_.fail(token, "unexpected " + quoted(token) + "; write each vertex and each face on a line of its own");
    skip_number(text_, token);
  }
}

void Off_reader::fail_cut_off(std::size_t found, std::size_t announced, const std::string& what) {
  text_.fail_at_end("the file ends after " + std::to_string(found) + " of " + std::to_string(announced) + " " + what +
                    "; correct the counts, or fetch the file again if it is cut off");
}

void write_off(const Polygon_soup& soup, std::ostream& out, bool rational) {
  check_no_holes(soup, rational ? "QOFF" : "OFF");
  out << "OFF\n" + std::to_string(soup.point_count()) + " " + std::to_string(soup.face_count()) + " 0\n";
  for (Point_id p = 0; p < soup.point_count(); ++p) {
    if (rational) {
      const auto [x, y, z] = soup.point(p);
      out << to_string(x) + " " + to_string(y) + " " + to_string(z) + "\n";
    } else {
      out << decimal_texts(soup, p, "OFF").substr(1) + "\n";
    }
  }
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    std::string line = std::to_string(soup.loop(f).size());
    for (const Point_id p : soup.loop(f)) (line += ' ') += std::to_string(p);
    out << line + "\n";
  }
}

}  // namespace

Polygon_soup read_off(const Input& input, const Read_options& options) {
  return Off_reader(input, Number_syntax::decimal, options).read();
}

Polygon_soup read_qoff(const Input& input, const Read_options& options) {
  return Off_reader(input, Number_syntax::rational, options).read();
}

void write_off(const Polygon_soup& soup, std::ostream& out) { write_off(soup, out, false); }

void write_qoff(const Polygon_soup& soup, std::ostream& out) { write_off(soup, out, true); }

}  // namespace sightline
