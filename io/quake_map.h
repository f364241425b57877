#pragma once
// Quake's .map: a level as brushes, each a convex solid between planes that three points give.

#include <sightline/io/format.h>
#include <sightline/io/input.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <string>
#include <vector>

namespace sightline {

/// Sides that a brush may have; each is cut by all others.
inline constexpr std::size_t most_brush_sides = 512;

/// Reads the brushes of the world: of the entity `worldspawn`, and of `func_group`, `func_detail` and
/// `func_detail_wall`, which compilers of levels take for parts of it. A face is a side of a brush, seen from outside
/// of it; its corners are exact, where three planes meet, equal ones one point, numbered in the order of first
/// appearance. Faces are in the order of the file. Passed over: what other entities are made of (doors, triggers, what
/// can be walked through), brushes all sides of which have a texture that is not drawn (clip, hint, skip, trigger,
/// origin), textures and where they lie, sides of which nothing is left. Brushes may overlap and touch: it is a soup,
/// not their union. Errors: Input_error, also for a side whose points are on a line, and for a brush that has no volume
/// or no end, by its numbers (Map_brush). Cost: for a brush of n sides O(n^2) cuts of a polygon. Exact: yes.
Polygon_soup read_map(const Input& input, const Read_options& options = {});

/// A brush of which read_map has faces. Entities of a file, and brushes of an entity, count from 0, as in other tools.
struct Map_brush {
  std::size_t entity, brush;
  Face_id first_face;  ///< of read_map; others follow
  std::size_t faces;
};

/// The brushes of the faces that `read_map` gives, in their order. Errors: Input_error, as there.
std::vector<Map_brush> read_map_brushes(const Input& input, const Read_options& options = {});

/// Where something stands in a level: a player, a lamp, a monster.
struct Map_place {
  std::string name;  ///< its `classname`; empty where it has none
  Exact_point origin;
};

/// The entities of a .map that have an `origin` and no brushes, nor a `model` of a compiled level's in their place
/// (`*1`), in the order of the file; of a key that comes twice the
/// last value counts. Errors: Input_error, as `read_map`, and for an origin that is not three decimals. Exact: yes.
std::vector<Map_place> read_map_places(const Input& input, const Read_options& options = {});

}  // namespace sightline
