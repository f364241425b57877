#pragma once
// Files as others write them, each number in one of its many forms, whole or with one thing wrong: what is read is what
// was meant, an error is where the wrong thing is; and what is written, as readers of the plainest kind understand it.

#include "decimal.h"

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/io/read.h>
#include <sightline/io/write.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace fuzz {

using generate::Random;

// ---- Numbers

/// A rational of denominator 2^k as a decimal, by 2^-k = 5^k 10^-k.
inline std::string dyadic_text(const Rational& value) {
  const std::size_t places = bit_length(value.get_den()) - 1;
  Integer power;
  mpz_ui_pow_ui(power.get_mpz_t(), 5, places);
  std::string digits = Integer(abs(value.get_num()) * power).get_str();
  digits.insert(0, digits.size() <= places ? places + 1 - digits.size() : 0, '0');
  if (places > 0) digits.insert(digits.size() - places, ".");
  return (value < 0 ? "-" : "") + digits;
}

inline double any_double(Random& random) {
  for (;;) {
    std::uint64_t bits = random.below(~std::uint64_t{0});
    if (random.chance(3, 4)) bits = (bits & ~(0x7FFull << 52)) | (1023 - 40 + random.below(80)) << 52;
    if (random.chance(1, 4)) bits &= ~0xFFFFFFFFull;
    const double d = std::bit_cast<double>(bits);
    if (std::isfinite(d) && std::isfinite(std::nextafter(d, INFINITY)) && std::isfinite(std::nextafter(d, -INFINITY)))
      return d;
  }
}

inline std::string any_digits(Random& random, std::size_t count) {
  std::string digits;
  for (; count > 0; --count) digits += static_cast<char>('0' + (random.chance(1, 3) ? 0 : random.below(10)));
  return digits;
}

/// A decimal: short, long, halfway between two doubles or a little off, at the limits of 18 digits, 64 bits and the
/// range of exponents; with signs, zeros and exponents that say nothing.
inline std::string any_decimal(Random& random) {
  static const std::vector<std::string> limits{"999999999999999999",
                                               "1000000000000000000",
                                               "9223372036854775807",
                                               "9223372036854775808",
                                               "18446744073709551616",
                                               "4503599627370497.5",
                                               "9007199254740993",
                                               "1e1100",
                                               "-1e-1100",
                                               "12.50e-1098",
                                               "0e9999",
                                               "100e-1102"};
  std::string text;
  switch (random.below(6)) {
    case 0: {
      const double d = any_double(random);
      text = dyadic_text((exact(d) + exact(std::nextafter(d, INFINITY))) / 2);
      if (random.chance(1, 2) && text.find('.') != std::string::npos) text += "0001";
      break;
    }
    case 1: text = any_digits(random, 1 + random.below(45)); break;
    case 2: return limits[random.below(limits.size())];
    default: text = any_digits(random, 1 + random.below(3));
  }
  if (text.find('.') == std::string::npos && random.chance(1, 2))
    text.insert(text.size() - random.below(text.size() + 1 - text.starts_with('-')), ".");
  if (random.chance(1, 8)) text.insert(text.starts_with('-') ? 1 : 0, "000");
  if (random.chance(1, 8) && text.find('.') != std::string::npos) text += "00";
  if (!text.starts_with('-') && random.chance(1, 2)) text.insert(0, random.chance(1, 2) ? "-" : "+");
  if (text.size() < 200 && random.chance(1, 3)) {  // 1100 places are the most
    text += random.chance(1, 2) ? "e" : "E";
    text += random.chance(1, 3) ? "+" : random.chance(1, 2) ? "-" : "";
    text += std::to_string(random.below(random.chance(1, 8) ? 60 : 4));
  }
  return text;
}

/// p or p/q.
inline std::string any_fraction(Random& random) {
  const auto integer = [&](const char* least) {
    const std::string sign = random.chance(1, 4) ? "-" : random.chance(1, 4) ? "+" : "";
    return sign + least + any_digits(random, random.chance(1, 8) ? 20 : random.below(3));
  };
  const std::string p = integer(random.chance(1, 2) ? "0" : "6");
  return random.chance(1, 3) ? p : p + "/" + integer(random.chance(1, 2) ? "3" : "4");
}

// ---- Files

/// Faces of points, as they are meant.
struct Meant {
  std::vector<std::array<std::string, 3>> written;
  std::vector<Exact_point> points;
  std::vector<std::vector<Point_id>> faces;
};

/// Text, token by token, with blanks, comments and line ends of all kinds. One token may be exchanged for a wrong one,
/// whose place is kept: line and column.
class Page {
 public:
  enum class Kind { plain, binary, hash, backslash, words };  ///< words: a line end is a blank
  Page(Random& random, Kind kind)
      : random_(&random), kind_(kind), end_of_line_(random.below(kind == Kind::binary ? 3 : 4)) {
    if (random.chance(1, 8)) {
      text = byte_order_mark;
      begin_ = text.size();
    }
    if (random.chance(1, 2)) left_ = random.below(40);
  }
  std::string text;
  std::optional<std::array<std::size_t, 2>> wrong;

  void add(const std::string& token) {
    if (text.size() > begin_) {
      static constexpr std::array blanks{" ", "\t", "  ", " \v\f "};
      if (kind_ == Kind::backslash && random_->chance(1, 12)) {
        text += " \\ ";
        line_end();
      }
      if (kind_ == Kind::words && random_->chance(1, 4)) line_end();
      else text += blanks[random_->below(4)];
    }
    if (token.empty()) return;
    text += token;
    end_ = {line_, text.size() - begin_ + 1};
  }
  /// The token, or one of these that are wrong; "": none. Pre: `last` where none is wrong here.
  void add(const std::string& token, const std::vector<std::string>& others, bool last = false) {
    if (wrong || left_-- != 0) return add(token);
    const std::string other = last && random_->chance(1, 4) ? "" : others[random_->below(others.size())];
    if (other.empty()) wrong = end_;
    else add_wrong(other);
  }
  /// A token more than there may be.
  void add_no_more() {
    if (!wrong && left_-- == 0) add_wrong("7");
  }
  void add_wrong(const std::string& token) {
    add(token);
    wrong = {end_[0], end_[1] - token.size()};
  }
  /// With an empty line behind it now and then, but for the last of a header.
  void end_line(bool last = false) {
    if ((kind_ == Kind::hash || kind_ == Kind::backslash) && random_->chance(1, 8)) text += " # 1 2 3";
    else if (random_->chance(1, 8)) text += " \t";
    line_end();
    if (last || !random_->chance(1, 8)) return;
    text += " ";
    line_end();
  }

 private:
  void line_end() {
    static constexpr std::array ends{"\n", "\r\n", "\r"};
    text += ends[end_of_line_ < 3 ? end_of_line_ : random_->below(3)];
    begin_ = text.size();
    ++line_;
  }
  Random* random_;
  Kind kind_;
  std::uint64_t end_of_line_;  // 3: any
  std::size_t left_ = ~std::size_t{0}, line_ = 1, begin_ = 0;
  std::array<std::size_t, 2> end_{1, 1};  // behind the last token
};

inline const std::vector<std::string> no_decimals{"nan", "-inf", "0x10", "1,5", "1.2.3", "--1", "1e",     "e5",
                                                  ".",   "+",    "1/2",  "1e+", "1_0",   "1-1", "1e1101", "1e-1101"},
    no_fractions{"1.5", "1/0", "-3/-0", "1e3", "/2", "1/", "1/2/3", "1//2", "+", "x", "1/2.0"},
    no_counts{"1.0", "-1", "x1", "1e0", "4000000000", "1/1"}, no_integers{"1.0", "1e0", "0x1", "x", "1.", "+"};

inline std::vector<std::string> no_corners_of(const Meant& meant, std::size_t first) {
  std::vector<std::string> others = no_integers;
  others.push_back(std::to_string(meant.points.size() + first));
  others.push_back("99999999999999999999");
  if (first == 0) others.insert(others.end(), {"-1", "1/"});
  else others.insert(others.end(), {"0", "-" + std::to_string(meant.points.size() + 1), "1/x", "1/2/3/4", "/1"});
  return others;
}
inline void add_numbers(Page& page, std::size_t count, Random& random) {
  static constexpr std::array numbers{"0", "1.5", "-2e3", "nan", "-inf", "255"};
  for (; count > 0; --count) page.add(numbers[random.below(numbers.size())]);
}

inline Page off_page(const Meant& meant, bool rational, Random& random) {
  Page page(random, Page::Kind::hash);
  const std::string count = std::to_string(meant.points.size());
  std::size_t most = 4;
  if (random.chance(3, 4)) {
    const std::string kind = random.chance(2, 3) ? "" : random.chance(1, 2) ? "STCN" : random.chance(1, 2) ? "N" : "C";
    if (!kind.empty()) most = 9;
    page.add(kind + "OFF", {"OF", "off", "4OFF", "nOFF", "OFFX"});
    if (random.chance(1, 2)) page.end_line();
  }
  page.add(count, no_counts);
  const bool edges = random.chance(2, 3);
  page.add(std::to_string(meant.faces.size()), no_counts, !edges);
  if (edges) page.add("0", no_integers);
  page.end_line();
  for (const auto& point : meant.written) {
    const std::size_t more = random.chance(1, 4) ? random.below(most + 1) : 0;
    for (std::size_t k = 0; k < 3; ++k) page.add(point[k], rational ? no_fractions : no_decimals, k == 2 && more == 0);
    add_numbers(page, more, random);
    if (more == most) page.add_no_more();
    page.end_line();
  }
  for (const auto& face : meant.faces) {
    page.add(std::to_string(face.size()), no_counts);
    const std::size_t more = random.chance(1, 4) ? random.below(5) : 0;
    for (std::size_t k = 0; k < face.size(); ++k)
      page.add(std::to_string(face[k]), no_corners_of(meant, 0),
               k + 1 == face.size() && more == 0 && &face != &meant.faces.back());
    add_numbers(page, more, random);
    if (more == 4) page.add_no_more();
    page.end_line();
  }
  return page;
}

inline Page obj_page(const Meant& meant, Random& random) {
  Page page(random, Page::Kind::backslash);
  const bool faces_first = random.chance(1, 3);
  const auto add_points = [&] {
    for (const auto& point : meant.written) {
      page.add("v", {"V", "vv", "curv"});
      const std::uint64_t more = random.below(8);
      for (std::size_t k = 0; k < 3; ++k) page.add(point[k], no_decimals, k == 2 && more > 2);
      if (more < 2) page.add(random.chance(1, 2) ? "1" : "10.0e-1", {"2", "0", "-1", "1.0000000000000000001", "nan"});
      if (more == 1 || more == 2) add_numbers(page, 3, random);
      if (more == 1) page.add_no_more();
      page.end_line();
      if (random.chance(1, 8)) {
        page.add(random.chance(1, 2) ? "vn" : "usemtl");
        add_numbers(page, random.below(4), random);
        page.end_line();
      }
    }
  };
  if (!faces_first) add_points();
  const std::string attribute = std::array{"", "/7", "//7", "/7/-7", "/7/"}[random.below(5)];
  for (const auto& face : meant.faces) {
    page.add(random.chance(1, 8) ? "fo" : "f");
    for (const Point_id p : face) {
      const bool backwards = !faces_first && random.chance(1, 3);
      page.add((backwards ? "-" + std::to_string(meant.points.size() - p)
                          : (random.chance(1, 8) ? "+" : "") + std::to_string(p + 1)) +
                   attribute,
               no_corners_of(meant, 1));
    }
    page.end_line();
  }
  if (faces_first) add_points();
  return page;
}

/// Of several solids, with words in upper and lower case.
inline Page stl_page(const Meant& meant, Random& random) {
  Page page(random, Page::Kind::words);
  const auto add = [&](std::string word, const std::vector<std::string>& others) {
    if (random.chance(1, 8)) word[0] = static_cast<char>(word[0] - 32);
    if (others.empty()) page.add(word);
    else page.add(word, others);
  };
  add("solid", {});
  page.end_line();
  for (const auto& face : meant.faces) {
    add("facet", {"facets", "solid", "vertex"});
    add("normal", {"facet"});
    add_numbers(page, 2, random);
    page.add("nan", {"x", "1,5"});
    add("outer", {"inner"});
    add("loop", {"outer"});
    for (const Point_id p : face) {
      add("vertex", {"vertx", "endfacet", "1"});
      for (const std::string& x : meant.written[p]) page.add(x, no_decimals);
    }
    add("endloop", {"endsolid", "facet", "0"});
    add("endfacet", {"end", "facet"});
    if (!random.chance(1, 8)) continue;
    add("endsolid a name", {});
    page.end_line();
    add("solid a facet", {});
    page.end_line();
  }
  add("endsolid", {"endsolids", "outer"});
  page.end_line();
  return page;
}

/// The header of a PLY file: x, y and z in any order among others, of these types; corners and, behind them, a flag.
struct Ply_layout {
  std::vector<std::string> columns;  ///< of a vertex
  bool flag = false;
};
inline Ply_layout add_ply_header(Page& page, const Meant& meant, const std::string& encoding,
                                 const std::array<std::string, 3>& types, const std::string& index, Random& random) {
  Ply_layout layout{{"x", "y", "z", "u"}, random.chance(1, 2)};
  random.shuffle(layout.columns);
  const auto line = [&](std::initializer_list<std::string> words) {
    for (const std::string& word : words) page.add(word);
    page.end_line();
  };
  line({"ply"});
  line({"format", encoding, "1.0"});
  if (random.chance(1, 2)) line({"comment", "end_header"});
  page.add("element");
  page.add("vertex");
  page.add(std::to_string(meant.points.size()), no_counts, true);
  page.end_line();
  for (const std::string& name : layout.columns)
    line({"property", name == "u" ? "int16" : types[static_cast<std::size_t>(name[0] - 'x')], name});
  page.add("element");
  page.add("face");
  page.add(std::to_string(meant.faces.size()), no_counts, true);
  page.end_line();
  // Corners are a list of integers; where they are not, the name is the place.
  const std::string name = random.chance(1, 2) ? "vertex_indices" : "vertex_index";
  page.add("property");
  const bool whole = !random.chance(1, 12) || page.wrong;
  const std::uint64_t kind = random.below(3);
  if (whole || kind > 0) {
    page.add("list");
    page.add("uchar");
  }
  page.add(whole || kind == 0 ? index : kind == 1 ? "float" : "float64");
  if (whole) page.add(name);
  else page.add_wrong(name);
  page.end_line();
  if (layout.flag) line({"property", "uint8", "flag"});
  page.add("end_header");
  page.end_line(true);
  return layout;
}

inline Page ply_page(const Meant& meant, Random& random) {
  Page page(random, Page::Kind::plain);
  const Ply_layout layout = add_ply_header(page, meant, "ascii", {"float", "double", "float64"}, "int", random);
  for (const auto& point : meant.written) {
    for (const std::string& name : layout.columns)
      if (name == "u") page.add("-3e5", {"x", "1,5"}, name == layout.columns.back());
      else page.add(point[static_cast<std::size_t>(name[0] - 'x')], no_decimals, name == layout.columns.back());
    page.add_no_more();
    page.end_line();
  }
  for (const auto& face : meant.faces) {
    page.add(std::to_string(face.size()), no_counts);
    for (std::size_t k = 0; k < face.size(); ++k)
      page.add(std::to_string(face[k]), no_corners_of(meant, 0),
               k + 1 == face.size() && !layout.flag && &face != &meant.faces.back());
    if (layout.flag) page.add("255", {"x"}, true);
    page.add_no_more();
    page.end_line();
  }
  return page;
}

// ---- Binary files

inline void add_bytes(std::string& bytes, std::uint64_t value, std::size_t count, bool big) {
  for (std::size_t k = 0; k < count; ++k) bytes += static_cast<char>(value >> 8 * (big ? count - 1 - k : k) & 255);
}

struct Ply_number {
  const char* name;
  const char* other_name;
  std::size_t size;
  bool floating, is_signed;
};
inline constexpr std::array<Ply_number, 8> ply_numbers{{{"char", "int8", 1, false, true},
                                                        {"uchar", "uint8", 1, false, false},
                                                        {"short", "int16", 2, false, true},
                                                        {"ushort", "uint16", 2, false, false},
                                                        {"int", "int32", 4, false, true},
                                                        {"uint", "uint32", 4, false, false},
                                                        {"float", "float32", 4, true, true},
                                                        {"double", "float64", 8, true, true}}};

/// The bits of a finite number of the type, and what it is.
inline std::pair<std::uint64_t, Rational> any_binary(const Ply_number& type, Random& random) {
  if (type.floating && type.size == 8) {
    const double d = random.chance(1, 8) ? -0.0 : any_double(random);
    return {std::bit_cast<std::uint64_t>(d), exact(d)};
  }
  if (type.floating) {
    const float f = static_cast<float>(generate::ratio(static_cast<long>(random.between(-4, 4)), 2).get_d()) *
                    (random.chance(1, 2) ? 0x1.000002p-100f : 1);
    return {std::bit_cast<std::uint32_t>(f), exact(f)};
  }
  const std::size_t bits = 8 * type.size;
  const std::uint64_t values = std::uint64_t{1} << bits;
  const std::uint64_t value = random.chance(1, 2) ? random.below(values) : values / 2 - random.below(2);
  const bool negative = type.is_signed && value >= values / 2;
  return {value, Rational(static_cast<long>(value) - (negative ? static_cast<long>(values) : 0))};
}

/// Reads a file, which gives what is meant, or an error at the byte.
inline void check_binary(const std::string& bytes, Format format, const Meant& meant, std::optional<std::size_t> wrong);

inline void try_binary_ply(Meant meant, Random& random) {
  const bool big = random.chance(1, 2);
  std::array<Ply_number, 3> types;
  std::array<std::string, 3> names;
  for (std::size_t k = 0; k < 3; ++k) {
    types[k] = ply_numbers[random.below(8)];
    names[k] = random.chance(1, 2) ? types[k].name : types[k].other_name;
  }
  const Ply_number index = ply_numbers[random.below(6)];
  Page page(random, Page::Kind::binary);
  const Ply_layout layout = add_ply_header(page, meant, big ? "binary_big_endian" : "binary_little_endian", names,
                                           random.chance(1, 2) ? index.name : index.other_name, random);
  if (page.wrong) return;
  std::optional<std::size_t> wrong;
  std::uint64_t left = random.below(40);
  const auto is_wrong = [&] { return !wrong && left-- == 0; };
  std::string& bytes = page.text;
  for (Exact_point& point : meant.points)
    for (const std::string& name : layout.columns) {
      if (name == "u") {
        add_bytes(bytes, random.below(65536), 2, big);
        continue;
      }
      const std::size_t k = static_cast<std::size_t>(name[0] - 'x');
      auto [bits, value] = any_binary(types[k], random);
      if (types[k].floating && is_wrong()) {
        bits = types[k].size == 8 ? 0x7FF0ull << 48 : 0x7F80ull << 16;  // infinite; or no number
        bits |= random.chance(1, 2) ? 1 : 0;
        wrong = bytes.size();
      }
      point[k] = value;
      add_bytes(bytes, bits, types[k].size, big);
    }
  for (const auto& face : meant.faces) {
    add_bytes(bytes, face.size(), 1, big);
    for (const Point_id p : face) {
      const bool beyond = is_wrong();
      if (beyond) wrong = bytes.size();
      add_bytes(bytes,
                !beyond                                  ? p
                : index.is_signed && random.chance(1, 2) ? ~std::uint64_t{0}
                                                         : meant.points.size(),
                index.size, big);
    }
    if (layout.flag) add_bytes(bytes, random.below(256), 1, big);
  }
  if (is_wrong()) {
    wrong = bytes.size();
    bytes += "x";
  }
  check_binary(bytes, Format::ply, meant, wrong);
}

inline void try_binary_stl(Meant meant, Random& random) {
  std::string bytes(80, random.chance(1, 2) ? ' ' : '\0');
  std::vector<std::uint64_t> bits;
  for (Exact_point& point : meant.points)
    for (Rational& x : point) {
      const auto [of_x, value] = any_binary(ply_numbers[6], random);
      bits.push_back(of_x);
      x = value;
    }
  for (auto& face : meant.faces) {
    face.resize(3);
    for (Point_id& p : face) p %= static_cast<Point_id>(meant.points.size());
  }
  add_bytes(bytes, meant.faces.size(), 4, false);
  std::optional<std::size_t> wrong;
  for (const auto& face : meant.faces) {
    bytes += std::string(12, '\xFF');
    for (const Point_id p : face)
      for (std::size_t k = 0; k < 3; ++k) {
        const bool infinite = !wrong && random.chance(1, 60);
        if (infinite) wrong = bytes.size();
        add_bytes(bytes, infinite ? 0x7F800000u : bits[3 * p + k], 4, false);
      }
    add_bytes(bytes, random.below(65536), 2, false);
  }
  check_binary(bytes, Format::stl, meant, wrong);
}

// ---- What is read

inline void require_meant(const Polygon_soup& soup, const Meant& meant, bool by_faces) {
  require(soup.face_count() == meant.faces.size(), "as many faces as are meant");
  if (!by_faces) require(soup.point_count() == meant.points.size(), "as many points as are meant");
  for (Point_id p = 0; !by_faces && p < soup.point_count(); ++p)
    require(soup.point(p) == meant.points[p], "a point is the one that is meant");
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    require(soup.loop(f).size() == meant.faces[f].size(), "a face has as many corners as are meant");
    for (std::size_t k = 0; k < meant.faces[f].size(); ++k) {
      require(by_faces || soup.loop(f)[k] == meant.faces[f][k], "a corner is the point that is meant");
      require(soup.point(soup.loop(f)[k]) == meant.points[meant.faces[f][k]], "a corner is where it is meant");
      for (std::size_t j = 0; by_faces && j < k; ++j)
        require((soup.loop(f)[k] == soup.loop(f)[j]) ==
                    (meant.points[meant.faces[f][k]] == meant.points[meant.faces[f][j]]),
                "equal points are one");
    }
  }
}

inline void check_binary(const std::string& bytes, Format format, const Meant& meant,
                         std::optional<std::size_t> wrong) {
  try {
    const Polygon_soup soup = read_scene(bytes, format, "scene");
    require(!wrong, "what is wrong is refused");
    require_meant(soup, meant, format == Format::stl);
  } catch (const Input_error& error) {
    if (!wrong) throw Finding(std::string("what is right is read: ") + error.what());
    if (error.byte != wrong)
      throw Finding("an error is at the byte where it is, " + std::to_string(*wrong) + ": " + error.what());
  }
}

inline void check_text(const Page& page, Format format, const Meant& meant) {
  try {
    const Polygon_soup soup = read_scene(page.text, format, "scene");
    require(!page.wrong, "what is wrong is refused");
    require_meant(soup, meant, format == Format::stl);
  } catch (const Input_error& error) {
    if (!page.wrong) throw Finding(std::string("what is right is read: ") + error.what());
    if (*page.wrong != std::array{error.line, error.column})
      throw Finding(std::string("an error is where it is, at ") + std::to_string((*page.wrong)[0]) + ':' +
                    std::to_string((*page.wrong)[1]) + ": " + error.what());
  }
  if (page.wrong) return;
  bool beyond = false;  // doubles
  for (const Exact_point& p : meant.points)
    for (const Rational& x : p) beyond = beyond || is_nearest(HUGE_VAL, abs(x));
  if (beyond && format == Format::stl) return;  // perhaps of no face
  try {
    const Polygon_soup soup = read_scene(page.text, format, "scene", {true});
    require(!beyond, "what is beyond doubles is refused where they are wanted");
    for (Face_id f = 0; f < soup.face_count(); ++f)
      for (std::size_t k = 0; k < soup.loop(f).size(); ++k)
        for (std::size_t a = 0; a < 3; ++a) {
          const Rational x = soup.point(soup.loop(f)[k])[a];
          require(exact(x.get_d()) == x && is_nearest(x.get_d(), meant.points[meant.faces[f][k]][a]),
                  "what is rounded is the nearest double");
        }
  } catch (const Input_error&) {
    require(beyond, "what is right is rounded");
  }
}

// ---- What is written, as readers of the plainest kind have it

inline bool has_decimal(const Rational& x) {
  Integer rest = x.get_den();
  std::size_t twos = 0, fives = 0;
  for (; rest % 2 == 0; rest /= 2) ++twos;
  for (; rest % 5 == 0; rest /= 5) ++fives;
  return rest == 1 && std::max(twos, fives) <= 1100;
}

inline bool can_hold(Format format, const Meant& meant) {
  const auto all_are = [&](auto is) {
    return std::all_of(meant.points.begin(), meant.points.end(),
                       [&](const Exact_point& p) { return std::all_of(p.begin(), p.end(), is); });
  };
  if (format == Format::qoff) return true;
  if (format == Format::ply_binary)
    return all_are([](const Rational& x) { return abs(x) < exact(0x1p1023) && exact(x.get_d()) == x; });
  const bool triangles =
      std::all_of(meant.faces.begin(), meant.faces.end(), [](const auto& face) { return face.size() == 3; });
  if (format != Format::stl) return all_are(has_decimal);
  if (!triangles) return false;
  for (const auto& face : meant.faces)
    for (const Point_id p : face)
      if (!std::all_of(meant.points[p].begin(), meant.points[p].end(), has_decimal)) return false;
  return true;
}

/// Numbers in their order: coordinates of points, then each face's corners; of STL the corners' coordinates.
inline std::vector<Rational> numbers_meant(Format format, const Meant& meant) {
  std::vector<Rational> numbers;
  const auto add = [&](const Exact_point& p) { numbers.insert(numbers.end(), p.begin(), p.end()); };
  if (format != Format::stl)
    for (const Exact_point& p : meant.points) add(p);
  for (const auto& face : meant.faces) {
    if (format != Format::stl && format != Format::obj) numbers.push_back(Rational(static_cast<long>(face.size())));
    for (const Point_id p : face)
      if (format == Format::stl) add(meant.points[p]);
      else numbers.push_back(Rational(static_cast<long>(p) + (format == Format::obj)));
  }
  return numbers;
}

inline std::vector<Rational> numbers_written(Format format, const std::string& text) {
  std::vector<Rational> numbers;
  std::istringstream lines(text);
  std::size_t number = 0, points = 0, faces = 0;
  bool in_header = format == Format::ply || format == Format::ply_binary;
  for (std::string line; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    std::string word;
    if (in_header) {
      if (line.starts_with("element vertex ")) points = std::stoul(line.substr(15));
      if (line.starts_with("element face ")) faces = std::stoul(line.substr(13));
      in_header = line != "end_header";
      if (in_header || format == Format::ply) continue;
      for (std::size_t k = 0; k < 3 * points; ++k) {
        double d = 0;
        lines.read(reinterpret_cast<char*>(&d), sizeof d);
        numbers.push_back(exact(d));
      }
      for (; faces > 0; --faces) {
        const int count = lines.get();
        numbers.push_back(Rational(count));
        for (int k = 0; k < count; ++k) {
          std::uint32_t p = 0;
          lines.read(reinterpret_cast<char*>(&p), sizeof p);
          numbers.push_back(Rational(static_cast<unsigned long>(p)));
        }
      }
      require(lines.good() && lines.peek() == EOF, "binary data are as long as they must be");
      return numbers;
    }
    if ((format == Format::off || format == Format::qoff) && number < 2) continue;
    if (format == Format::obj || format == Format::stl) {
      words >> word;
      if (word != "v" && word != "f" && word != "vertex") continue;
    }
    while (words >> word) {
      const std::optional<Plain_decimal> decimal = plain_decimal(word);
      const std::optional<Rational> ratio = plain_rational(word);
      require(format == Format::qoff ? ratio.has_value() : decimal.has_value(), "what is written are numbers");
      numbers.push_back(format == Format::qoff ? *ratio : value_of(*decimal));
    }
  }
  return numbers;
}

inline void try_writing(const Meant& meant) {
  Polygon_soup soup;
  for (const Exact_point& p : meant.points) soup.add_point(p[0], p[1], p[2]);
  for (const auto& face : meant.faces) soup.add_face(face);
  for (const Format format : {Format::obj, Format::off, Format::qoff, Format::ply, Format::ply_binary, Format::stl}) {
    std::ostringstream out;
    try {
      write_scene(soup, out, format);
    } catch (const Not_representable&) {
      require(!can_hold(format, meant), "what a format can hold is written");
      continue;
    }
    require(can_hold(format, meant), "what a format cannot hold is not written");
    require(numbers_written(format, out.str()) == numbers_meant(format, meant), "what is written is what is meant");
    if (meant.faces.empty() && format == Format::stl) continue;
    require_meant(read_scene(out.str(), format, "scene"), meant, format == Format::stl);
  }
}

inline void text_numbers(std::string_view bytes) {
  Random random(Bytes(bytes).word());
  const bool fractions = random.chance(1, 4), triangles = random.chance(1, 2);
  Meant meant;
  for (std::uint64_t k = 1 + random.below(4); k > 0; --k) {
    auto& written = meant.written.emplace_back();
    auto& point = meant.points.emplace_back();
    if (meant.points.size() > 1 && random.chance(1, 6)) {
      written = meant.written[0];
      point = meant.points[0];
      continue;
    }
    for (std::size_t a = 0; a < 3; ++a) {
      written[a] = fractions ? any_fraction(random) : any_decimal(random);
      point[a] = fractions ? *plain_rational(written[a]) : value_of(*plain_decimal(written[a]));
    }
  }
  for (std::uint64_t k = random.below(4); k > 0; --k) {
    auto& face = meant.faces.emplace_back();
    for (std::uint64_t corners = triangles ? 3 : random.below(6); corners > 0; --corners)
      face.push_back(static_cast<Point_id>(random.below(meant.points.size())));
  }
  if (random.chance(1, 2)) try_writing(meant);
  if (fractions) return check_text(off_page(meant, true, random), Format::qoff, meant);
  switch (random.below(6)) {
    case 0: check_text(off_page(meant, false, random), Format::off, meant); break;
    case 1: check_text(obj_page(meant, random), Format::obj, meant); break;
    case 2: check_text(ply_page(meant, random), Format::ply, meant); break;
    case 3: check_text(stl_page(meant, random), Format::stl, meant); break;
    case 4: try_binary_ply(meant, random); break;
    default: try_binary_stl(meant, random);
  }
}

}  // namespace fuzz
