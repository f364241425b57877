#include <sightline/io/quake_map.h>

#include <sightline/io/decimal.h>
#include <sightline/io/grid_limit.h>
#include <sightline/io/text.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/quoted.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sightline {
namespace {

/// A side of a brush, a half space: normal x - offset <= 0 within the brush, in integers without a common factor.
struct Side {
  std::array<Integer, 3> normal;
  Integer offset;
  bool is_drawn;
  friend bool operator==(const Side& a, const Side& b) { return a.normal == b.normal && a.offset == b.offset; }
};

/// The half space behind three points that run clockwise as seen from outside; nothing where they are on a line.
std::optional<Side> side_through(const std::array<Exact_point, 3>& points) {
  const Exact_point normal = cross(minus(points[0], points[1]), minus(points[2], points[1]));
  if (is_zero(normal)) return std::nullopt;
  const std::array<Rational, 4> row{normal[0], normal[1], normal[2], dot(normal, points[1])};
  std::array<Integer, 4> whole = Over_common(row).whole;
  Integer common = 0;
  for (const Integer& value : whole) common = gcd(common, value);
  for (Integer& value : whole) value /= common;
  return Side{{whole[0], whole[1], whole[2]}, whole[3], true};
}

/// Of the longest number of its plane. Points with as many digits as doubles have, of 17 places too, take some 300.
std::size_t bits_of(const Side& side) {
  std::size_t bits = bit_length(side.offset);
  for (const Integer& value : side.normal) bits = std::max(bits, bit_length(value));
  return bits;
}
constexpr std::size_t most_plane_bits = 1024;

/// A corner of a side in the making, and the same in integers: to tell its side of a plane takes no fractions.
struct Brush_corner {
  Exact_point at;
  Over_common<3> scaled;

  explicit Brush_corner(Exact_point p) : at(std::move(p)), scaled(at) {}
};

Rational beyond(const Side& side, const Exact_point& p) {
  return side.normal[0] * p[0] + side.normal[1] * p[1] + side.normal[2] * p[2] - side.offset;
}
int sign_beyond(const Side& side, const Brush_corner& p) {
  return sgn(Integer(dot(side.normal, p.scaled.whole) - side.offset * p.scaled.denominator));
}

/// A square in a side's plane, counterclockwise as seen from outside, whose corners have two coordinates of size
/// `reach`.
std::vector<Brush_corner> square_in(const Side& side, const Integer& reach) {
  std::size_t k = 0;  // the coordinate that the plane gives
  for (std::size_t i = 1; i < 3; ++i)
    if (abs(side.normal[i]) > abs(side.normal[k])) k = i;
  const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
  std::vector<Brush_corner> square;
  for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
    Exact_point p;
    p[i] = x * reach;
    p[j] = y * reach;
    p[k] = (side.offset - side.normal[i] * p[i] - side.normal[j] * p[j]) / Rational(side.normal[k]);
    square.emplace_back(std::move(p));
  }
  if (sgn(side.normal[k]) < 0) std::reverse(square.begin(), square.end());
  return square;
}

/// The part of a convex polygon within a half space; nothing where it only touches it, unless all is in its plane.
std::vector<Brush_corner> within(const Side& side, std::vector<Brush_corner> polygon, const std::vector<int>& signs) {
  if (std::none_of(signs.begin(), signs.end(), [](int sign) { return sign > 0; })) return polygon;
  if (std::none_of(signs.begin(), signs.end(), [](int sign) { return sign < 0; })) return {};
  std::vector<Brush_corner> part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = i + 1 == polygon.size() ? 0 : i + 1;
    if (signs[i] <= 0) part.push_back(polygon[i]);
    if (signs[i] * signs[next] >= 0) continue;
    const Exact_point &p = polygon[i].at, &q = polygon[next].at;
    const Rational from = beyond(side, p), t = from / (from - beyond(side, q));
    Exact_point crossing;
    for (std::size_t k = 0; k < 3; ++k) crossing[k] = p[k] + t * (q[k] - p[k]);
    part.emplace_back(std::move(crossing));
  }
  return part;
}

class Map_reader {
 public:
  Map_reader(const Input& input, const Read_options& options)
      : text_(input, Text_reader::Comments::none), options_(options), bytes_(input.bytes.size()) {}

  Polygon_soup read() {
    for (std::string_view word = next_word(); !word.empty(); word = next_word()) {
      if (word != "{") text_.fail(word, "unexpected " + quoted(word) + "; an entity begins with {");
      read_entity();
      ++entity_;
    }
    return std::move(soup_);
  }
  std::vector<Map_brush> read_brushes() {
    read();
    return std::move(brushes_);
  }
  std::vector<Map_place> read_places() {
    are_places_wanted_ = true;
    read();
    return std::move(places_);
  }

 private:
  /// The next token that is not in a comment; an empty one at the end of the text.
  std::string_view next_word() {
    for (;;) {
      const std::string_view word = text_.next_token_of_any_line();
      if (!word.starts_with("//")) return word;
      text_.finish_line();
    }
  }
  std::string_view next_word(const char* expected) {
    const std::string_view word = next_word();
    if (word.empty())
      text_.fail_at_end(std::string("the file ends where ") + expected +
                        " should follow; fetch it again if it is cut off");
    return word;
  }

  /// Keys and values of an entity, and its brushes, of which it is known only at its end whether they are of the world.
  void read_entity() {
    bool is_world = false;
    std::vector<Brush> brushes;
    std::string name;
    std::optional<Exact_point> origin;
    bool has_model = false;  // of a compiled level, in the place of brushes
    for (;;) {
      const std::string_view word = next_word("} or a brush");
      if (word == "}") break;
      if (word.starts_with('"')) {
        const std::string_view key = quoted_from(word), value = quoted_from(text_.next_token());
        if (key == "classname") {
          is_world = is_part_of_world(value);
          name = value;
        } else if (key == "origin" && are_places_wanted_) {
          origin = origin_of(value);
        } else if (key == "model") {
          has_model = value.starts_with('*');
        }
        finish_line();
      } else if (word == "{") {
        brushes.push_back(read_brush(word, brushes.size()));
      } else {
        text_.fail(word, "unexpected " + quoted(word) + "; write \"KEY\" \"VALUE\", { or } here");
      }
    }
    if (origin && brushes.empty() && !has_model) places_.push_back({std::move(name), *std::move(origin)});
    if (!is_world || are_places_wanted_) return;
    for (const Brush& brush : brushes) add_faces(brush);
  }
  static bool is_part_of_world(std::string_view value) {
    for (const std::string_view name : {"worldspawn", "func_group", "func_detail", "func_detail_wall"})
      if (value == name) return true;
    return false;
  }

  /// What is between the quotes of a key or a value that begins with a token, all on one line.
  std::string_view quoted_from(std::string_view token) {
    const auto refuse = [&, first = token] {
      text_.fail(first, "no \"KEY\" \"VALUE\" here; write both on one line, with a blank between");
    };
    if (!token.starts_with('"')) refuse();
    token.remove_prefix(1);
    const char* const begin = token.data();
    while (!token.ends_with('"'))
      if ((token = text_.next_token()).empty()) refuse();
    const char* const end = token.data() + token.size() - 1;
    if (std::find(begin, end, '"') != end) refuse();
    return {begin, end};
  }
  /// Leaves a line behind, of which nothing is left that says more of the level.
  void finish_line() {
    for (std::string_view word = text_.next_token(); !word.empty() && !word.starts_with("//");
         word = text_.next_token())
      if (std::string_view("(){}\"").find(word[0]) != std::string_view::npos)
        text_.fail(word, "unexpected " + quoted(word) + "; begin a line of its own with it");
    text_.finish_line();
  }
  /// The value of `origin`: X Y Z.
  Exact_point origin_of(std::string_view value) {
    Exact_point origin;
    const auto skip_blanks = [&] { value.remove_prefix(std::min(value.find_first_not_of(" \t"), value.size())); };
    for (Rational& coordinate : origin) {
      skip_blanks();
      const std::string_view number = value.substr(0, value.find_first_of(" \t"));
      if (number.empty()) text_.fail(value, "an origin is \"X Y Z\", three decimals");
      coordinate = value_of(read_coordinate(text_, number, Number_syntax::decimal, options_));
      value.remove_prefix(number.size());
    }
    skip_blanks();
    if (!value.empty()) text_.fail(value, "an origin is \"X Y Z\", three decimals");
    return origin;
  }

  struct Brush {
    std::string_view at;  // its brace, for messages
    std::size_t number;   // in its entity
    std::vector<Side> sides;
  };
  Brush read_brush(std::string_view brace, std::size_t number) {
    Brush brush{brace, number, {}};
    for (;;) {
      const std::string_view word = next_word("( or }");
      if (word == "}") return brush;
      if (word != "(")
        text_.fail(word,
                   "unexpected " + quoted(word) +
                       "; a side of a brush is ( x y z ) ( x y z ) ( x y z ) TEXTURE ..., and brushes and patches "
                       "of later games are not read: export Quake's format");
      if (brush.sides.size() == most_brush_sides)
        text_.fail(word, "a brush of more than " + std::to_string(most_brush_sides) + " sides; cut it in parts");
      brush.sides.push_back(read_side(word));
    }
  }
  Side read_side(std::string_view begin) {
    std::array<Exact_point, 3> points;
    for (std::size_t i = 0; i < 3; ++i) {
      if (i > 0) expect("(");
      for (Rational& coordinate : points[i])
        coordinate = value_of(read_coordinate(text_, text_.next_token(), Number_syntax::decimal, options_));
      expect(")");
    }
    std::optional<Side> side = side_through(points);
    if (!side) text_.fail(begin, "the three points of this side lie on a line; give three that span its plane");
    if (bits_of(*side) > most_plane_bits)
      text_.fail(begin, "this side's plane takes numbers of " + std::to_string(bits_of(*side)) + " bits, more than " +
                            std::to_string(most_plane_bits) + "; give its points with fewer digits");
    side->is_drawn = is_drawn(text_.next_token());
    finish_line();
    return *std::move(side);
  }
  void expect(const char* word) {
    const std::string_view token = text_.next_token();
    if (token != word)
      text_.fail(token, std::string("no ") + word + " here; a point is ( x y z ), with blanks between");
  }
  static bool is_drawn(std::string_view texture) {
    std::string name(texture);
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const std::string_view hidden : {"clip", "hint", "hintskip", "skip", "trigger", "origin"})
      if (name == hidden) return false;
    return true;
  }

  /// The faces of a brush: of each side what all others leave of it.
  void add_faces(const Brush& brush) {
    if (std::none_of(brush.sides.begin(), brush.sides.end(), [](const Side& side) { return side.is_drawn; })) return;
    // Three planes of coefficients below 2^b meet in a point p/q with p below 6 2^3b, and q an integer.
    std::size_t bits = 1;
    for (const Side& side : brush.sides) bits = std::max(bits, bits_of(side));
    Integer reach;
    mpz_setbit(reach.get_mpz_t(), 3 * bits + 4);
    std::vector<std::vector<Exact_point>> faces;
    for (std::size_t i = 0; i < brush.sides.size(); ++i) {
      std::vector<Exact_point> face = face_of(brush.sides, i, reach);
      const auto is_far = [&](const Exact_point& p) {
        return std::any_of(p.begin(), p.end(), [&](const Rational& x) { return 2 * abs(x) >= reach; });
      };
      if (std::any_of(face.begin(), face.end(), is_far))
        text_.fail(brush.at, named(brush) + " has no end; add the sides that bound it");
      if (!face.empty()) faces.push_back(std::move(face));
    }
    if (faces.size() < 4)
      text_.fail(brush.at,
                 named(brush) + " has no volume; give its sides' points clockwise as seen from outside, or remove it");
    brushes_.push_back({entity_, brush.number, static_cast<Face_id>(soup_.face_count()), faces.size()});
    for (const std::vector<Exact_point>& face : faces) add_face(face, brush);
  }
  std::string named(const Brush& brush) const {
    return "brush " + std::to_string(brush.number) + " of entity " + std::to_string(entity_);
  }
  static std::vector<Exact_point> face_of(const std::vector<Side>& sides, std::size_t i, const Integer& reach) {
    std::vector<Brush_corner> face = square_in(sides[i], reach);
    std::vector<int> signs;
    for (std::size_t j = 0; j < sides.size() && !face.empty(); ++j) {
      if (j == i) continue;
      signs.clear();
      for (const Brush_corner& corner : face) signs.push_back(sign_beyond(sides[j], corner));
      const bool is_in_plane = std::all_of(signs.begin(), signs.end(), [](int sign) { return sign == 0; });
      if (!is_in_plane) face = within(sides[j], std::move(face), signs);
      else if (!(sides[j] == sides[i]) || j < i) return {};  // no room between two sides, or given before
    }
    std::vector<Exact_point> corners;
    for (Brush_corner& corner : face) corners.push_back(std::move(corner.at));
    return corners;
  }

  void add_face(const std::vector<Exact_point>& face, const Brush& brush) {
    std::vector<Point_id> corners;
    for (const Exact_point& p : face) {
      const auto [place, fresh] = ids_.try_emplace(p, static_cast<Point_id>(ids_.size()));
      corners.push_back(place->second);
      if (!fresh) continue;
      soup_.add_point(p[0], p[1], p[2]);
      for (const Rational& x : p)
        if (!grid_.include(x.get_den(), ids_.size(), bytes_))
          text_.fail(brush.at, named(brush) + " and those before it have " + Grid_limit::words +
                                   "; snap their sides to whole numbers, or cut round brushes in parts");
    }
    soup_.add_face(corners);
  }

  Text_reader text_;
  const Read_options& options_;
  bool are_places_wanted_ = false;  // and no faces
  std::vector<Map_place> places_;
  std::size_t entity_ = 0;  // which one is read
  std::vector<Map_brush> brushes_;
  Polygon_soup soup_;
  std::map<Exact_point, Point_id> ids_;
  std::size_t bytes_;
  Grid_limit grid_;
};

}  // namespace

Polygon_soup read_map(const Input& input, const Read_options& options) { return Map_reader(input, options).read(); }

std::vector<Map_brush> read_map_brushes(const Input& input, const Read_options& options) {
  return Map_reader(input, options).read_brushes();
}

std::vector<Map_place> read_map_places(const Input& input, const Read_options& options) {
  return Map_reader(input, options).read_places();
}

}  // namespace sightline
