#pragma once
// Polygons in groups, and tables in parts, as files: each number is read again where the format has it.

#include "support.h"

#include <sightline/harness/generate/random.h>
#include <sightline/io/grouped_polygons.h>
#include <sightline/io/read.h>
#include <sightline/io/visibility_table.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fuzz {

using generate::Random;

/// What a random drawing was made of.
struct Sketch {
  Grouped_polygons all;
  std::vector<std::vector<std::array<double, 3>>> polygons;
  std::vector<std::uint32_t> groups;
  std::vector<Face_id> faces;
  std::vector<std::array<std::uint8_t, 3>> colours;
  std::vector<std::vector<std::uint32_t>> columns;
};

inline Sketch any_sketch(Random& random) {
  Sketch sketch;
  const std::size_t groups = 1 + random.below(3), count = random.below(6);
  for (std::size_t g = 0; g < groups; ++g) {
    std::array<std::uint8_t, 3>& colour = sketch.colours.emplace_back();
    for (std::uint8_t& part : colour) part = static_cast<std::uint8_t>(random.below(256));
    sketch.all.add_group("group" + std::to_string(g), colour);
  }
  const double offset = random.chance(1, 3) ? 0x1p30 : 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t corners = random.chance(1, 30) ? 256 + random.below(3) : 3 + random.below(4);
    std::vector<Exact_point> exact;
    std::vector<std::array<double, 3>>& polygon = sketch.polygons.emplace_back();
    for (std::size_t k = 0; k < corners; ++k) {
      std::array<double, 3>& p = polygon.emplace_back();
      for (double& x : p) x = offset + static_cast<double>(random.between(-8, 8)) / 4;
      if (corners > 6) p[0] = offset + static_cast<double>(k);
      exact.push_back({Rational(p[0]), Rational(p[1]), Rational(p[2])});
    }
    sketch.groups.push_back(static_cast<std::uint32_t>(random.below(groups)));
    sketch.faces.push_back(random.chance(1, 4) ? Grouped_polygons::no_face : static_cast<Face_id>(random.below(50)));
    sketch.all.add_polygon(sketch.groups.back(), sketch.faces.back(), exact);
  }
  for (std::size_t c = random.below(3); c > 0; --c) {
    std::vector<std::uint32_t>& column = sketch.columns.emplace_back();
    for (std::size_t i = 0; i < count; ++i) column.push_back(static_cast<std::uint32_t>(random.below(1000)));
    sketch.all.add_column("column" + std::string(c, 'x'), column);
  }
  return sketch;
}

/// The least significant byte first, as this machine has it.
template <class Number>
Number number_in(std::string_view bytes, std::size_t at) {
  require(at + sizeof(Number) <= bytes.size(), "a file has all its numbers");
  Number value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

inline std::int64_t name_of_face(Face_id face) { return face == Grouped_polygons::no_face ? -1 : std::int64_t{face}; }

/// Points and faces, by the reader of the format.
inline void require_polygons(const Sketch& sketch, const Polygon_soup& soup) {
  require(soup.face_count() == sketch.polygons.size(), "a drawing has its polygons");
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    require(soup.loop(f).size() == sketch.polygons[f].size(), "a polygon has its corners");
    for (std::size_t k = 0; k < sketch.polygons[f].size(); ++k)
      for (int axis = 0; axis < 3; ++axis)
        require(soup.point(soup.loop(f)[k])[axis] == Rational(sketch.polygons[f][k][static_cast<std::size_t>(axis)]),
                "a corner is where it was");
  }
}

inline void in_obj(const Sketch& sketch) {
  const std::string text = drawing_bytes(sketch.all, Drawing_format::obj);
  if (text.empty()) return require(sketch.polygons.empty(), "obj: a drawing has its polygons");
  require_polygons(sketch, read_scene(text, Format::obj, "drawing", {}));
  std::istringstream lines(text);
  std::string group, material;
  std::size_t i = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("g ")) group = line.substr(2);
    if (line.starts_with("usemtl ")) material = line.substr(7);
    if (!line.starts_with("f ")) continue;
    require(group == "group" + std::to_string(sketch.groups.at(i)) && group == material, "a face is in its group");
    ++i;
  }
}

inline void in_ply(const Sketch& sketch) {
  const std::string bytes = drawing_bytes(sketch.all, Drawing_format::ply);
  require_polygons(sketch, read_scene(bytes, Format::ply, "drawing", {}));
  const bool is_long = bytes.find("property list uint int") != std::string::npos;
  std::size_t at = bytes.find("end_header\n") + 11 + 24 * sketch.all.points().size();
  for (std::size_t i = 0; i < sketch.polygons.size(); ++i) {
    at += (is_long ? 4 : 1) + 4 * sketch.polygons[i].size();
    require(number_in<std::int32_t>(bytes, at) == name_of_face(sketch.faces[i]), "ply: a polygon is of its face");
    require(number_in<std::uint32_t>(bytes, at + 4) == sketch.groups[i], "ply: a polygon is in its group");
    at += 8;
    for (const auto& column : sketch.columns) {
      require(number_in<std::uint32_t>(bytes, at) == column[i], "ply: a column has its value");
      at += 4;
    }
    for (const std::uint8_t part : sketch.colours[sketch.groups[i]])
      require(number_in<std::uint8_t>(bytes, at++) == part, "ply: a polygon has its group's colour");
  }
  require(at == bytes.size(), "ply: nothing is behind the polygons");
}

/// The numbers of an array of a VTK file: four digits are three bytes, and before all stands how many these are.
template <class Number>
std::vector<Number> array_in(const std::string& text, const std::string& name) {
  const std::size_t named = text.find(" Name=\"" + name + '"');
  require(named != std::string::npos, "an array has its name");
  const std::size_t begin = text.find('>', named) + 1, end = text.find("</DataArray>", begin);
  std::string bytes;
  std::uint32_t bits = 0;
  std::size_t digits = 0, missing = 0;
  for (std::size_t k = begin; k < end; ++k) {
    const char c = text[k];
    missing += c == '=';
    const int value = c >= 'A' && c <= 'Z'   ? c - 'A'
                      : c >= 'a' && c <= 'z' ? c - 'a' + 26
                      : c >= '0' && c <= '9' ? c - '0' + 52
                      : c == '+'             ? 62
                      : c == '/'             ? 63
                      : c == '='             ? 0
                                             : -1;
    require(value >= 0, "an array is of digits");
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    if (++digits % 4 == 0)
      for (int shift = 16; shift >= 0; shift -= 8) bytes += static_cast<char>(bits >> shift & 255);
  }
  require(digits % 4 == 0 && missing < 3, "digits come in fours");
  bytes.resize(bytes.size() - missing);
  require(number_in<std::uint64_t>(bytes, 0) == bytes.size() - 8 && (bytes.size() - 8) % sizeof(Number) == 0,
          "an array says how long it is");
  std::vector<Number> numbers;
  for (std::size_t at = 8; at < bytes.size(); at += sizeof(Number)) numbers.push_back(number_in<Number>(bytes, at));
  return numbers;
}

inline void in_vtk(const Sketch& sketch, bool unstructured) {
  const std::string text = drawing_bytes(sketch.all, unstructured ? Drawing_format::vtu : Drawing_format::vtp);
  const std::size_t count = sketch.polygons.size();
  require(text.find((unstructured ? "NumberOfCells=\"" : "NumberOfPolys=\"") + std::to_string(count) + '"') !=
              std::string::npos,
          "vtk: polygons are counted");
  const auto points = array_in<double>(text, "Points");
  require(text.find("NumberOfPoints=\"" + std::to_string(points.size() / 3) + '"') != std::string::npos,
          "vtk: points are counted");
  const auto corners = array_in<std::int64_t>(text, "connectivity"), ends = array_in<std::int64_t>(text, "offsets"),
             faces = array_in<std::int64_t>(text, "face");
  const auto groups = array_in<std::uint32_t>(text, "group");
  const auto colours = array_in<std::uint8_t>(text, "colour");
  require(ends.size() == count && faces.size() == count && groups.size() == count && colours.size() == 3 * count,
          "vtk: each polygon has its numbers");
  if (unstructured)
    require(array_in<std::uint8_t>(text, "types") == std::vector<std::uint8_t>(count, 7), "vtk: cells are polygons");
  std::size_t corner = 0;
  for (std::size_t i = 0; i < count; ++i) {
    require(static_cast<std::size_t>(ends[i]) == corner + sketch.polygons[i].size(), "vtk: a polygon ends");
    for (const auto& p : sketch.polygons[i]) {
      const auto at = static_cast<std::size_t>(corners.at(corner++));
      for (std::size_t axis = 0; axis < 3; ++axis)
        require(points.at(3 * at + axis) == p[axis], "vtk: a corner is where it was");
    }
    require(faces[i] == name_of_face(sketch.faces[i]) && groups[i] == sketch.groups[i], "vtk: a polygon has its names");
    for (std::size_t k = 0; k < 3; ++k)
      require(colours[3 * i + k] == sketch.colours[groups[i]][k], "vtk: a polygon has its group's colour");
  }
  for (std::size_t c = 0; c < sketch.columns.size(); ++c)
    require(array_in<std::uint32_t>(text, sketch.all.columns()[c].name) == sketch.columns[c],
            "vtk: a column has its values");
}

/// Fans of triangles, group by group; corners as floats about the middle of all.
inline void in_glb(const Sketch& sketch) {
  const std::string bytes = drawing_bytes(sketch.all, Drawing_format::glb);
  require(number_in<std::uint32_t>(bytes, 8) == bytes.size() && bytes.size() % 4 == 0, "glb: it says how long it is");
  const std::size_t length = number_in<std::uint32_t>(bytes, 12);
  const nlohmann::json tree = nlohmann::json::parse(bytes.substr(20, length));
  std::vector<std::size_t> order;
  for (std::size_t g = 0; g < sketch.colours.size(); ++g)
    for (std::size_t i = 0; i < sketch.polygons.size(); ++i)
      if (sketch.groups[i] == g) order.push_back(i);
  if (order.empty()) return require(!tree.contains("meshes"), "glb: what is empty has no mesh");
  require(!tree.at("nodes").at(0).contains("scale"), "glb: what floats hold is not scaled");
  const Polygon_soup soup = read_scene(bytes, Format::glb, "drawing", {});
  Face_id f = 0;
  for (const std::size_t i : order)
    for (std::size_t k = 2; k < sketch.polygons[i].size(); ++k, ++f) {
      require(f < soup.face_count() && soup.loop(f).size() == 3, "glb: polygons are fans of triangles");
      const std::array<std::size_t, 3> corners{0, k - 1, k};
      for (std::size_t c = 0; c < 3; ++c)
        for (int axis = 0; axis < 3; ++axis)
          require(std::fabs(soup.point(soup.loop(f)[c])[axis].get_d() -
                            sketch.polygons[i][corners[c]][static_cast<std::size_t>(axis)]) < 1e-4,
                  "glb: a corner is where it was");
    }
  require(f == soup.face_count(), "glb: there are no more triangles");
  // What is said of corners: of each polygon's, its face and its columns; of all, between which bounds they are.
  const auto floats = [&](const nlohmann::json& place) {
    const auto& accessor = tree.at("accessors").at(place.get<std::size_t>());
    const auto& view = tree.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
    const std::size_t first = 28 + length + view.at("byteOffset").get<std::size_t>();
    std::vector<float> values;
    for (std::size_t k = 0; k < view.at("byteLength").get<std::size_t>() / 4; ++k)
      values.push_back(number_in<float>(bytes, first + 4 * k));
    return values;
  };
  std::size_t next = 0, mesh = 0;
  while (next < order.size()) {
    const std::uint32_t group = sketch.groups[order[next]];
    const auto& primitive = tree.at("meshes").at(0).at("primitives").at(mesh);
    const auto& material = tree.at("materials").at(primitive.at("material").get<std::size_t>());
    require(material.at("name") == "group" + std::to_string(group), "glb: a group has its material");
    for (std::size_t k = 0; k < 3; ++k) {
      const double light = material.at("pbrMetallicRoughness").at("baseColorFactor").at(k).get<double>();
      const double shown = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
      require(std::lround(255 * shown) == sketch.colours[group][k], "glb: a colour is what a screen is told");
    }
    const auto& named = primitive.at("attributes");
    const std::vector<float> faces = floats(named.at("_FACE")), places = floats(named.at("POSITION"));
    std::size_t corner = 0;
    for (; next < order.size() && sketch.groups[order[next]] == group; ++next)
      for (std::size_t k = 0; k < sketch.polygons[order[next]].size(); ++k, ++corner) {
        require(corner < faces.size() && faces[corner] == static_cast<float>(name_of_face(sketch.faces[order[next]])),
                "glb: a corner is of its face");
        for (std::size_t c = 0; c < sketch.columns.size(); ++c) {
          std::string name = "_" + sketch.all.columns()[c].name;
          for (char& letter : name) letter = static_cast<char>(std::toupper(letter));
          require(floats(named.at(name)).at(corner) == static_cast<float>(sketch.columns[c][order[next]]),
                  "glb: a column has its value");
        }
      }
    require(corner == faces.size() && places.size() == 3 * corner, "glb: there are no more corners");
    const auto& bounds = tree.at("accessors").at(named.at("POSITION").get<std::size_t>());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float least = places[axis], most = places[axis];
      for (std::size_t k = axis; k < places.size(); k += 3) {
        least = std::min(least, places[k]);
        most = std::max(most, places[k]);
      }
      require(bounds.at("min").at(axis).get<float>() == least && bounds.at("max").at(axis).get<float>() == most,
              "glb: corners are between their bounds");
    }
    ++mesh;
  }
  require(tree.at("meshes").at(0).at("primitives").size() == mesh, "glb: there are no more groups");
}

/// A table taken apart, by faces and by cells: put together it is the same, in whatever order; with a part twice, or a
/// part less, it is refused.
inline void table_in_parts(Random& random) {
  const std::size_t cells = 1 + random.below(9), faces = 1 + random.below(20), shards = 1 + random.below(4);
  Visibility_table whole;
  whole.question = "a question";
  const bool has_cells = random.chance(1, 2);
  for (std::size_t c = 0; c < cells; ++c) {
    whole.cells.push_back(random.chance(2, 3));
    if (has_cells) whole.lower_cells.push_back(true);
  }
  whole.faces.assign(faces, true);
  std::vector<std::vector<int>> seen(cells, std::vector<int>(cells));
  for (std::size_t a = 0; a < cells; ++a)
    for (std::size_t b = 0; b < a; ++b)
      seen[a][b] = seen[b][a] = whole.cells[a] && whole.cells[b] ? static_cast<int>(random.below(3)) : 0;
  const auto add = [](std::vector<std::uint32_t>& visible, std::vector<std::uint32_t>& undecided, std::size_t number,
                      int what) {
    if (what > 0) (what == 1 ? visible : undecided).push_back(static_cast<std::uint32_t>(number));
  };
  std::vector<Visibility_table> parts(shards, whole);
  for (std::size_t s = 0; s < shards; ++s) {
    for (std::size_t f = 0; f < faces; ++f) parts[s].faces[f] = f % shards == s;
    for (std::size_t c = 0; c < cells && has_cells; ++c) parts[s].lower_cells[c] = c % shards == s;
  }
  for (std::size_t c = 0; c < cells; ++c) {
    if (!whole.cells[c]) continue;
    auto& row = whole.rows.emplace_back();
    for (Visibility_table& part : parts) part.rows.emplace_back();
    for (std::size_t f = 0; f < faces; ++f) {
      const int what = static_cast<int>(random.below(3));
      add(row.visible, row.undecided, f, what);
      add(parts[f % shards].rows.back().visible, parts[f % shards].rows.back().undecided, f, what);
    }
    for (std::size_t other = 0; other < cells && has_cells; ++other) {
      add(row.cells, row.cells_undecided, other, seen[c][other]);
      auto& mine = parts[std::min(c, other) % shards].rows.back();
      add(mine.cells, mine.cells_undecided, other, seen[c][other]);
    }
  }
  const std::string bytes = table_bytes(whole);
  std::vector<std::string> names;
  for (Visibility_table& part : parts) {
    part = sightline::read_table({"part", table_bytes(part)});
    names.push_back("part " + std::to_string(names.size()));
  }
  std::vector<Visibility_table> shuffled = parts;
  random.shuffle(shuffled);
  require(table_bytes(merged(shuffled, names)) == bytes, "parts are the table again");
  const auto is_refused = [](auto run) {
    try {
      run();
    } catch (const Merge_error& error) {
      return std::string_view(error.what()).find('\n') == std::string_view::npos;
    }
    return false;
  };
  const std::size_t chosen = random.below(shards);
  const bool is_empty = chosen >= faces && (!has_cells || chosen >= cells);
  std::vector<Visibility_table> less = parts;
  less.erase(less.begin() + static_cast<std::ptrdiff_t>(chosen));
  std::vector<std::string> fewer(names.begin(), names.end() - 1);
  if (chosen < faces) require(is_refused([&] { merged(less, fewer); }), "a table with a part less is refused");
  std::vector<Visibility_table> twice = parts;
  twice.push_back(parts[chosen]);
  names.push_back("another");
  if (!is_empty && chosen < faces) require(is_refused([&] { joined(twice, names); }), "a part twice is refused");
  twice.back().question = "another question";
  require(is_refused([&] { joined(twice, names); }), "an answer to another question is refused");
}

/// The first bytes are a seed.
/// A format is known by a name's ending, in upper or lower case; letters beside these are none.
inline void by_ending(Random& random) {
  static const std::vector<std::pair<std::string, Drawing_format>> known{{"obj", Drawing_format::obj},
                                                                         {"ply", Drawing_format::ply},
                                                                         {"glb", Drawing_format::glb},
                                                                         {"vtp", Drawing_format::vtp},
                                                                         {"vtu", Drawing_format::vtu}};
  auto [ending, format] = known[random.below(known.size())];
  for (char& c : ending)
    if (random.chance(1, 2)) c = static_cast<char>(c - 'a' + 'A');
  const bool is_wrong = random.chance(1, 3);
  if (is_wrong) {
    char& c = ending[random.below(ending.size())];
    c = random.chance(1, 2) ? static_cast<char>(c ^ 64) : '_';
  }
  const std::optional<Drawing_format> found = drawing_format_of_ending("a.b/c." + ending);
  require(found.has_value() != is_wrong && (is_wrong || *found == format), "formats are known by their endings");
}

inline void drawings(std::string_view bytes) {
  std::uint64_t seed = bytes.size();
  for (const char c : bytes.substr(0, 16)) seed = 31 * seed + static_cast<unsigned char>(c);
  Random random(seed);
  const Sketch sketch = any_sketch(random);
  in_obj(sketch);
  in_ply(sketch);
  in_vtk(sketch, false);
  in_vtk(sketch, true);
  in_glb(sketch);
  table_in_parts(random);
  by_ending(random);
}

}  // namespace fuzz
