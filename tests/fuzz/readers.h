#pragma once
// What every reader owes whatever bytes it is given: a scene or an error of one line; and a scene that the writers and
// it agree on.

#include "support.h"

#include <sightline/io/quake_bsp.h>
#include <sightline/io/read.h>
#include <sightline/io/visibility_table.h>
#include <sightline/io/write.h>
#include <sightline/io/exact_text.h>

#include <sstream>

namespace fuzz {

/// What the bytes hold; nothing where they are refused, as they must be: in one line that begins with the file's name,
/// at a place in the file.
inline std::optional<Polygon_soup> scene_in(std::string_view bytes, Format format, const Read_options& options = {}) {
  try {
    return read_scene(bytes, format, "scene", options);
  } catch (const Input_error& error) {
    const std::string_view line = error.what();
    require(line.starts_with("scene:") && line.size() > 10, "an error begins with the file's name");
    require(
        std::all_of(line.begin(), line.end(),
                    [](char c) { return static_cast<unsigned char>(c) >= 32 && static_cast<unsigned char>(c) < 127; }),
        "an error is one printable line");
    require(error.line <= bytes.size() + 1 && error.column <= bytes.size() + 1,
            "an error in text is at a place in the file");
    require(!error.byte || *error.byte <= bytes.size(), "an error in binary data is at a place in the file");
    const std::string_view behind_mark = bytes.substr(bytes.starts_with(byte_order_mark) ? byte_order_mark.size() : 0);
    require((behind_mark.find_first_not_of(" \t\v\f\r\n") == std::string_view::npos) ==
                line.ends_with("the file is empty; give a scene"),
            "an empty file is said to be empty");
    return std::nullopt;
  }
}

inline bool same_faces(const Polygon_soup& a, const Polygon_soup& b) {
  if (a.face_count() != b.face_count()) return false;
  for (Face_id f = 0; f < a.face_count(); ++f) {
    const std::span<const Point_id> of_a = a.loop(f), of_b = b.loop(f);
    if (!std::equal(of_a.begin(), of_a.end(), of_b.begin(), of_b.end())) return false;
  }
  return true;
}
inline bool same_points(const Polygon_soup& a, const Polygon_soup& b) {
  if (a.point_count() != b.point_count()) return false;
  for (Point_id p = 0; p < a.point_count(); ++p)
    if (a.point(p) != b.point(p)) return false;
  return true;
}

/// Whether a format can hold the scene; if so, reading what was written gives it back.
inline bool comes_back(const Polygon_soup& soup, Format format) {
  std::ostringstream text;
  try {
    write_scene(soup, text, format);
  } catch (const Not_representable&) {
    return false;
  }
  if (text.str().empty()) return false;  // OBJ and STL of nothing
  const std::optional<Polygon_soup> again = scene_in(text.str(), format);
  require(again.has_value(), "what is written is read");
  require(same_points(soup, *again) && same_faces(soup, *again), "what is written is the same scene when read");
  return true;
}

inline void check_reader(std::string_view bytes, Format format) {
  const std::optional<Polygon_soup> soup = scene_in(bytes, format);
  if (!soup) return;
  require(soup->coordinates.size() % 3 == 0, "a point has three coordinates");
  bool triangles = true;
  for (Face_id f = 0; f < soup->face_count(); ++f) {
    require(soup->loop_count(f) == 1, "a face that was read has one loop");
    triangles = triangles && soup->loop(f).size() == 3;
    for (const Point_id p : soup->loop(f)) require(p < soup->point_count(), "corners are points that there are");
  }
  if (const std::optional<Polygon_soup> rounded = scene_in(bytes, format, {true})) {
    require(format == Format::map || rounded->face_count() == soup->face_count(), "rounding leaves the faces");
    if (format != Format::stl && format != Format::map && format != Format::glb && format != Format::gltf)
      require(rounded->point_count() == soup->point_count() && same_faces(*soup, *rounded),
              "rounding leaves the points' numbers");
  }
  require(comes_back(*soup, Format::qoff), "QOFF holds any scene that was read");
  if (format == Format::map || format == Format::bsp || format == Format::glb || format == Format::gltf)
    return;  // read only
  if (format == Format::stl ? triangles && soup->face_count() > 0 : format != Format::qoff)
    require(comes_back(*soup, format), "a format holds what was read from it");
  if (format == Format::ply) comes_back(*soup, Format::ply_binary);  // where coordinates are doubles
}

inline void read_obj(std::string_view bytes) { check_reader(bytes, Format::obj); }
inline void read_off(std::string_view bytes) { check_reader(bytes, Format::off); }
inline void read_qoff(std::string_view bytes) { check_reader(bytes, Format::qoff); }
inline void read_ply(std::string_view bytes) { check_reader(bytes, Format::ply); }
inline void read_stl(std::string_view bytes) { check_reader(bytes, Format::stl); }
/// A level's brushes, each of which bounds a solid.
inline void read_map(std::string_view bytes) { check_reader(bytes, Format::map); }
inline void read_glb(std::string_view bytes) { check_reader(bytes, Format::glb); }
inline void read_gltf(std::string_view bytes) { check_reader(bytes, Format::gltf); }
/// A table of what cells see; what was read and is written is the same when it is read.
inline void read_table(std::string_view bytes) {
  std::optional<Visibility_table> table;
  try {
    table = sightline::read_table({"scene", bytes});
  } catch (const Input_error& error) {
    require(error.byte && *error.byte <= bytes.size(), "an error in a table is at a place in the file");
    return;
  }
  const std::string written = table_bytes(*table);
  const Visibility_table again = sightline::read_table({"scene", written});
  require(table_bytes(again) == written && again.cells == table->cells && again.faces == table->faces,
          "a table that is written is the same when read");
}
/// A level's faces; and its table, which is the same when written and read.
inline void read_bsp(std::string_view bytes) {
  check_reader(bytes, Format::bsp);
  if (!scene_in(bytes, Format::bsp)) return;
  const Quake_level level = read_quake_level({"scene", bytes});
  if (level.visible_leaves > 2000) return;
  std::vector<std::vector<bool>> rows;
  for (std::size_t l = 1; l <= level.visible_leaves; ++l) {
    rows.emplace_back(level.visible_leaves);
    for (const std::size_t seen : level.seen_from(l)) rows.back()[seen - 1] = true;
  }
  const std::string again = with_visibility(bytes, rows);
  const Quake_level same = read_quake_level({"scene", again});
  for (std::size_t l = 1; l <= level.visible_leaves; ++l)
    require(same.seen_from(l) == level.seen_from(l), "a table that is written is the same when read");
}

}  // namespace fuzz
