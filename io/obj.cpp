#include <sightline/io/obj.h>

#include <sightline/io/decimal.h>
#include <sightline/io/exact_text.h>
#include <sightline/io/format.h>
#include <sightline/io/input.h>
#include <sightline/io/text.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/quoted.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sightline {
namespace {

/// Reads OBJ line by line. Statements are `v` and `f` (or `fo`, its old name); what only dresses them is passed over;
/// anything else is an error, so that no surface is lost unseen.
class Obj_reader {
 public:
  Obj_reader(const Input& input, const Read_options& options)
      : text_(input, Text_reader::Comments::hash, Text_reader::Continuation::backslash), options_(options) {}

  Polygon_soup read();

 private:
  /// v x y z, then nothing, w, r g b, or w r g b. The weight w bends only curves and surfaces, so it may only be 1.
  void read_vertex();

  /// f, then any number of v, v/vt, v//vn, v/vt/vn.
  void read_face();

  Point_id read_corner(std::string_view token);

  /// Whether text is what may follow "v/": [vt] or [vt]/[vn]. The numbers themselves are of no interest.
  static bool is_attributes(std::string_view text);

  void check_ignored(std::string_view statement);

  [[noreturn]] void fail_out_of_range(std::string_view token);

  struct Forward {
    std::int64_t index;
    std::string_view token;
  };

  Text_reader text_;
  const Read_options& options_;
  Polygon_soup soup_;
  std::vector<Point_id> corners_;
  std::vector<Forward> forward_;
};

Polygon_soup Obj_reader::read() {
  while (text_.next_line()) {
    const std::string_view statement = text_.next_token();
    if (statement == "v") read_vertex();
    else if (statement == "f" || statement == "fo") read_face();
    else check_ignored(statement);
  }
  for (const Forward& forward : forward_)
    if (forward.index > static_cast<std::int64_t>(soup_.point_count())) fail_out_of_range(forward.token);
  return std::move(soup_);
}

void Obj_reader::read_vertex() {
  for (int i = 0; i < 3; ++i)
    push(soup_.coordinates, read_coordinate(text_, text_.next_token(), Number_syntax::decimal, options_));
  std::array<std::string_view, 4> more;
  std::size_t count = 0;
  for (std::string_view token = text_.next_token(); !token.empty(); token = text_.next_token()) {
    if (count == more.size())
      text_.fail(token, "more than 7 numbers after v; write x y z, perhaps with w, perhaps with a colour r g b");
    skip_number(text_, token);
    more[count++] = token;
  }
  if (count == 2) text_.fail(more[1], "5 numbers after v; write x y z, perhaps with w, perhaps with a colour r g b");
  if ((count == 1 || count == 4) && parse_decimal(text_, more[0]) != Number(Decimal{1, 0}))
    text_.fail(more[0], "a vertex with a weight w other than 1 is not supported; remove the weights");
}

void Obj_reader::read_face() {
  corners_.clear();
  for (std::string_view token = text_.next_token(); !token.empty(); token = text_.next_token())
    corners_.push_back(read_corner(token));
  soup_.add_face(corners_);
}

Point_id Obj_reader::read_corner(std::string_view token) {
  const std::size_t slash = token.find('/');
  const std::optional<std::int64_t> index = parse_integer(token.substr(0, slash));
  if (!index || (slash != std::string_view::npos && !is_attributes(token.substr(slash + 1))))
    text_.fail(token, quoted(token) + " is not a corner of a face; write v, v/vt, v//vn or v/vt/vn with integers");
  const auto count = static_cast<std::int64_t>(soup_.point_count());
  if (*index == 0 || *index < -count) fail_out_of_range(token);
  if (*index < 0) return static_cast<Point_id>(count + *index);
  // The vertex may come later in the file. Of such corners only those need be looked at in the end that go beyond all
  // before them: the first one out of range is among them.
  if (*index > count && (forward_.empty() || *index > forward_.back().index)) forward_.push_back({*index, token});
  return static_cast<Point_id>(*index - 1);
}

bool Obj_reader::is_attributes(std::string_view text) {
  const std::size_t slash = text.find('/');
  const auto is_index = [](std::string_view s) { return s.empty() || parse_integer(s).has_value(); };
  return is_index(text.substr(0, slash)) && (slash == std::string_view::npos || is_index(text.substr(slash + 1)));
}

void Obj_reader::check_ignored(std::string_view statement) {
  for (const std::string_view known : {"vt", "vn", "vp", "g", "o", "s", "mg", "usemtl", "mtllib", "usemap", "maplib",
                                       "l", "p", "bevel", "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj"})
    if (statement == known) return;
  for (const std::string_view free_form : {"cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim",
                                           "hole", "scrv", "sp", "end", "con", "ctech", "stech"})
    if (statement == free_form)
      text_.fail(statement, "free-form curves and surfaces (" + quoted(statement) +
                                ") are not supported; convert them to polygons");
  text_.fail(statement, "unknown statement " + quoted(statement) + "; if this is an OBJ file, remove the line");
}

void Obj_reader::fail_out_of_range(std::string_view token) {
  text_.fail(token, "vertex index " + quoted(token) + " is out of range; there are " +
                        std::to_string(soup_.point_count()) + " vertices" + (token.front() == '-' ? " so far" : "") +
                        ", counted from 1, or from -1 backwards");
}

}  // namespace

Polygon_soup read_obj(const Input& input, const Read_options& options) { return Obj_reader(input, options).read(); }

void write_obj(const Polygon_soup& soup, std::ostream& out) {
  check_no_holes(soup, "OBJ");
  out << "# " + std::to_string(soup.point_count()) + " vertices, " + std::to_string(soup.face_count()) + " faces\n";
  for (Point_id p = 0; p < soup.point_count(); ++p) out << "v" + decimal_texts(soup, p, "OBJ") + "\n";
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    std::string line = "f";
    for (const Point_id p : soup.loop(f)) (line += ' ') += std::to_string(std::size_t{p} + 1);
    out << line + "\n";
  }
}

}  // namespace sightline
