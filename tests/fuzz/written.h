#pragma once
// Files written for what is in them, and read: glTF (written_gltf.h), Quake's levels (written_bsp.h) and their brushes,
// triangles in text (text_forms.h), lists of numbers, materials; and endings of names.

#include "text_forms.h"
#include "written_bsp.h"
#include "written_gltf.h"

#include <sightline/harness/generate/polygons.h>
#include <sightline/io/format.h>
#include <sightline/io/materials.h>
#include <sightline/io/number_lines.h>
#include <sightline/io/quake_map.h>
#include <sightline/io/read.h>
#include <sightline/io/visibility_table.h>
#include <sightline/io/write.h>
#include <sightline/kernel/vectors.h>

#include <unistd.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

namespace fuzz {

/// With three places where they are enough, else p/q.
inline std::string decimal_of(const Rational& x) {
  const Rational thousandths = 1000 * x;
  if (thousandths.get_den() != 1) return to_string(x);
  std::string digits = to_string(Integer(abs(thousandths.get_num())));
  while (digits.size() < 4) digits.insert(0, "0");
  digits.insert(digits.size() - 3, ".");
  return (x < 0 ? "-" : "") + digits;
}

// ---- Brushes

/// A half space of points with value <= 0.
struct Half_space {
  Exact_point normal;
  Rational offset;
  Rational value(const Exact_point& p) const { return dot(normal, p) - offset; }
};

/// Where three planes meet.
inline std::optional<Exact_point> meet_of(const Half_space& a, const Half_space& b, const Half_space& c) {
  const Rational det = dot(a.normal, cross(b.normal, c.normal));
  if (det == 0) return std::nullopt;
  const Exact_point bc = cross(b.normal, c.normal), ca = cross(c.normal, a.normal), ab = cross(a.normal, b.normal);
  Exact_point p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = (a.offset * bc[k] + b.offset * ca[k] + c.offset * ab[k]) / det;
  return p;
}

/// The corners of each side's face, as a set; of planes that come twice the first has it. By all triples of planes.
inline std::vector<std::set<Exact_point>> faces_of_brush(const std::vector<Half_space>& sides) {
  std::set<Exact_point> corners;
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t j = i + 1; j < sides.size(); ++j)
      for (std::size_t k = j + 1; k < sides.size(); ++k)
        if (const auto p = meet_of(sides[i], sides[j], sides[k]);
            p && std::all_of(sides.begin(), sides.end(), [&](const Half_space& h) { return h.value(*p) <= 0; }))
          corners.insert(*p);
  std::vector<std::set<Exact_point>> faces;
  std::set<std::set<Exact_point>> there;
  for (const Half_space& h : sides) {
    std::set<Exact_point> on;
    for (const Exact_point& p : corners)
      if (h.value(p) == 0) on.insert(p);
    bool has_area = false;
    for (const Exact_point& p : on)
      for (const Exact_point& q : on)
        has_area = has_area || !is_zero(cross(minus(p, *on.begin()), minus(q, *on.begin())));
    if (has_area && there.insert(on).second) faces.push_back(on);
  }
  return faces;
}

/// A box, and planes that cut some of it off, in any order, some of them twice.
inline std::vector<Half_space> any_brush(generate::Random& random) {
  std::vector<Half_space> sides;
  const auto number = [&](std::int64_t least, std::int64_t most) {
    return generate::ratio(random.between(4 * least, 4 * most), 4);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational low = number(-8, 0), high = low + number(1, 8);
    for (const int sense : {-1, 1}) {
      Half_space h{{0, 0, 0}, sense * (sense < 0 ? low : high)};
      h.normal[k] = sense;
      sides.push_back(h);
    }
  }
  for (std::size_t k = random.below(4); k > 0; --k) {
    Half_space h{{0, 0, 0}, 0};
    for (Rational& x : h.normal) x = static_cast<long>(random.between(-2, 2));
    if (is_zero(h.normal)) h.normal[random.below(3)] = 1;
    h.offset = number(0, 12);
    sides.push_back(h);
  }
  if (random.chance(1, 4)) sides.push_back(sides[random.below(sides.size())]);
  random.shuffle(sides);
  return sides;
}

/// Three points of a plane, clockwise as seen from outside.
inline std::array<Exact_point, 3> points_of(const Half_space& h, generate::Random& random) {
  std::size_t k = 0;
  while (h.normal[k] == 0) ++k;
  for (;;) {
    std::array<Exact_point, 3> points;
    for (Exact_point& p : points) {
      for (Rational& x : p) x = static_cast<long>(4 * random.between(-9, 9));
      p[k] = 0;
      p[k] = (h.offset - dot(h.normal, p)) / h.normal[k];
    }
    const Rational turn = dot(h.normal, cross(minus(points[1], points[0]), minus(points[2], points[0])));
    if (turn == 0) continue;
    if (turn > 0) std::swap(points[1], points[2]);
    return points;
  }
}

/// Two lines of a file that are made one, but for comments, are the same or an error: nothing is lost in silence.
inline void join_lines(const Polygon_soup& soup, std::string text, Format format, generate::Random& random) {
  const std::size_t end = text.find('\n', random.below(text.size()));
  if (end == std::string::npos) return;
  const std::size_t begin = end == 0 ? 0 : text.rfind('\n', end - 1) + 1;
  const std::string_view line(text.data() + begin, end - begin);
  if (line.find("//") != std::string_view::npos || line.starts_with("comment") || line.starts_with('#')) return;
  text[end] = ' ';
  std::optional<Polygon_soup> joined;
  try {
    joined = read_scene(text, format, "joined");
  } catch (const Input_error&) {
    return;
  }
  require(fingerprint(*joined) == fingerprint(soup), "what is on a line of another is read or refused");
}

/// The same of faces in each format of text.
inline void try_joined_lines(generate::Random& random) {
  generate::Faces faces(1 + random.below(4));
  for (generate::Points& face : faces) {
    face.resize(3 + random.below(2));
    for (Exact_point& p : face)
      for (Rational& x : p) x = static_cast<long>(random.between(-9, 9));
  }
  const Polygon_soup soup = generate::soup_of(faces);
  static constexpr std::array formats{Format::obj, Format::off, Format::qoff, Format::ply, Format::stl};
  const Format format = formats[random.below(formats.size())];
  std::ostringstream out;
  try {
    write_scene(soup, out, format);
  } catch (const Not_representable&) {  // of triangles alone
    return;
  }
  if (format != Format::qoff)  // which has no word of its own
    require(format_of_content({"written", out.str()}) == format, "what is written is known by its content");
  join_lines(read_scene(out.str(), format, "written"), out.str(), format, random);
}

/// A level of few brushes has the faces of those that are of the world and drawn, counterclockwise from outside.
inline void try_brushes(generate::Random& random) {
  static constexpr std::array names{"worldspawn",       "func_group", "func_detail",
                                    "func_detail_wall", "func_door",  "light"};
  static constexpr std::array textures{"stone", "clip", "HINT", "hintskip", "Skip", "trigger", "origin", "skipper"};
  std::string text;
  std::vector<std::pair<Half_space, std::set<Exact_point>>> expected;
  for (std::size_t entities = 1 + random.below(3); entities > 0; --entities) {
    const std::size_t name = random.below(names.size());
    text += std::string("{\n\"classname\" \"") + names[name] + "\"\n";
    for (std::size_t brushes = random.below(3); brushes > 0; --brushes) {
      const std::vector<Half_space> sides = any_brush(random);
      const std::vector<std::set<Exact_point>> faces = faces_of_brush(sides);
      if (faces.size() < 4) continue;  // without volume
      text += random.chance(1, 2) ? "{ // a brush\n" : "{\n";
      bool is_drawn = false;
      const bool is_hidden = random.chance(1, 4);
      for (const Half_space& h : sides) {
        for (const Exact_point& p : points_of(h, random)) {
          text += "( ";
          for (const Rational& x : p) text += decimal_of(x) + " ";
          text += ") ";
        }
        const std::size_t texture = is_hidden ? 1 + random.below(6) : random.below(textures.size());
        is_drawn = is_drawn || texture == 0 || texture == 7;
        text += std::string(textures[texture]) + " 0 0 0 1 1\n";
      }
      text += "}\n";
      if (name > 3 || !is_drawn) continue;
      std::set<std::set<Exact_point>> wanted(faces.begin(), faces.end());
      for (const Half_space& h : sides)
        for (const std::set<Exact_point>& face : faces)
          if (std::all_of(face.begin(), face.end(), [&](const Exact_point& p) { return h.value(p) == 0; }) &&
              wanted.erase(face) > 0)
            expected.emplace_back(h, face);
    }
    text += "}\n";
  }
  const Polygon_soup soup = sightline::read_map({"written", text});
  require(format_of_content({"written", text}) == Format::map, "a level is known by its content");
  require(soup.face_count() == expected.size(), "a level has a face for each side of a brush");
  join_lines(soup, text, Format::map, random);
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    std::vector<Exact_point> loop;
    for (const Point_id p : soup.loop(f)) loop.push_back(soup.point(p));
    require(std::set<Exact_point>(loop.begin(), loop.end()) == expected[f].second &&
                loop.size() == expected[f].second.size(),
            "a face has its corners where planes meet");
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Exact_point &a = loop[k], &b = loop[(k + 1) % loop.size()], &c = loop[(k + 2) % loop.size()];
      require(dot(expected[f].first.normal, cross(minus(b, a), minus(c, b))) > 0,
              "a face runs counterclockwise as seen from outside");
    }
  }
}

// ---- Numbers, materials, endings

inline void try_numbers(generate::Random& random) {
  std::vector<Rational> expected;
  std::string text;
  for (std::size_t k = 1 + random.below(5); k > 0; --k) {
    const Rational x = generate::ratio(random.between(-999, 999), random.chance(1, 2) ? 8 : 1 + random.between(0, 20));
    text += (text.empty() ? "" : ",") + (random.chance(1, 2) ? to_string(x) : decimal_of(x));
    expected.push_back(x);
  }
  require(numbers_in(text, "wanted") == expected, "a list has the numbers that were written");
}

/// A folder of this process that goes with it.
struct Own_folder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("sightline_written_" + std::to_string(getpid()));
  Own_folder() { std::filesystem::create_directories(path); }
  ~Own_folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};

inline void try_materials(generate::Random& random) {
  static const Own_folder folder;
  // 1. A library: colours and opacities, in any order, or none; what comes twice counts as said last.
  std::vector<Material> all;
  std::string library = "# materials\n";
  for (std::size_t k = 1 + random.below(3); k > 0; --k) {
    Material material{"paint" + std::to_string(k), {0.8, 0.8, 0.8}, 1};
    library += "newmtl " + material.name + "\nNs 10\n";
    for (std::size_t line = random.below(4); line > 0; --line) {
      const double x = static_cast<double>(random.below(9)) / 8, y = static_cast<double>(random.below(9)) / 8;
      if (random.chance(1, 2)) {
        material.colour = {x, y, 0.5};
        library += "Kd " + std::to_string(x) + " " + std::to_string(y) + " 0.5\n";
      } else {
        const bool is_transparency = random.chance(1, 2);
        material.opacity = is_transparency ? 1 - x : x;
        library += (is_transparency ? "Tr " : "d ") + std::to_string(x) + "\n";
      }
    }
    all.push_back(material);
  }
  // 2. Faces that use them.
  std::vector<std::optional<Material>> expected;
  std::string obj = "mtllib all.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
  std::optional<Material> current;
  for (std::size_t k = random.below(6); k > 0; --k) {
    if (random.chance(1, 2)) {
      current = all[random.below(all.size())];
      obj += "usemtl " + current->name + "\n";
    }
    obj += "f 1 2 3\n";
    expected.push_back(current);
  }
  const bool is_unknown = random.chance(1, 8);
  if (is_unknown) obj += "usemtl none\n";
  std::ofstream(folder.path / "all.mtl") << library;
  std::ofstream(folder.path / "scene.obj") << obj;
  std::vector<std::optional<Material>> found;
  const bool refused = is_refused<Input_error>([&] { found = read_materials(folder.path / "scene.obj"); });
  require(refused == is_unknown, "a material is refused iff no library has it");
  if (refused) return;
  require(found.size() == expected.size(), "each face has its material, or none");
  for (std::size_t k = 0; k < found.size(); ++k)
    require(found[k].has_value() == expected[k].has_value() &&
                (!found[k] || (found[k]->name == expected[k]->name && found[k]->colour == expected[k]->colour &&
                               found[k]->opacity == expected[k]->opacity)),
            "a face has the material that was written");
}

inline void try_endings(generate::Random& random) {
  static const std::vector<std::pair<std::string, Format>> all{
      {".obj", Format::obj}, {".off", Format::off}, {".qoff", Format::qoff},
      {".ply", Format::ply}, {".stl", Format::stl}, {".map", Format::map},
      {".bsp", Format::bsp}, {".glb", Format::glb}, {".gltf", Format::gltf}};
  for (const auto& [ending, format] : all) {
    std::string name = "a.b" + ending;
    for (char& c : name)
      if (random.chance(1, 2)) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    require(format_of_ending(name) == format, "an ending names its format");
    require(!format_of_ending(name + "x") && !format_of_ending("a" + ending.substr(1)), "no other ending does");
  }
}

inline void written(std::string_view bytes) {
  Bytes from(bytes);
  const std::size_t kind = from.below(22);
  generate::Random random(from.word());
  if (kind > 19) try_joined_lines(random);
  else if (kind > 15) try_forms(random);
  else if (kind < 5) try_gltf(random);
  else if (kind == 5) try_place_of_nonsense(random);
  else if (kind < 9) try_level(random);
  else if (kind < 13) try_brushes(random);
  else if (kind == 13) try_numbers(random);
  else if (kind == 14) try_materials(random);
  else try_endings(random);
}

}  // namespace fuzz
