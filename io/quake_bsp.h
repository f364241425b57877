#pragma once
// Quake's .bsp, version 29: a compiled level, whose faces, tree, leaves and table of what leaves may see are read.

#include <sightline/io/format.h>
#include <sightline/io/input.h>
#include <sightline/io/quake_map.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sightline {

/// A compiled level, as its file says it; only numbers that name something else are checked. Planes are
/// normal x = distance, the front where it is larger. Children below 0 are leaves: -1 - child.
struct Quake_level {
  struct Plane {
    std::array<float, 3> normal;
    float distance;
  };
  struct Node {
    std::uint32_t plane;
    std::array<std::int32_t, 2> children;  ///< in front, behind
  };
  struct Leaf {
    std::int32_t contents;    ///< -1 empty, -2 solid, -3 water, -4 slime, -5 lava, -6 sky
    std::int32_t visible_at;  ///< where its row begins in `visibility`; -1: none, everything may be seen
    std::vector<Face_id> faces;
  };

  Polygon_soup soup;  ///< the faces of the world, counterclockwise as seen from their front
  std::vector<Plane> planes;
  std::vector<Node> nodes;
  std::vector<Leaf> leaves;        ///< leaf 0 is all that is solid
  std::int32_t root = 0;           ///< of the world: a node, or a leaf below 0
  std::size_t visible_leaves = 0;  ///< leaves 1 to this have rows in the table
  std::string visibility;          ///< rows: a bit a leaf from leaf 1 on, in bytes; 0 and n stand for n bytes of 0

  /// The leaves that a leaf's row says may be seen from it, ascending; all where it has no row. Pre: checked by
  /// reading.
  std::vector<std::size_t> seen_from(std::size_t leaf) const;
  /// Whether eyes may be in a leaf: it has a row, and is neither solid nor sky.
  bool is_open(std::size_t leaf) const {
    constexpr std::int32_t solid = -2, sky = -6;
    return leaf != 0 && leaf <= visible_leaves && leaves[leaf].contents != solid && leaves[leaf].contents != sky;
  }
};

/// Whether the bytes begin as a level of version 29 does.
bool looks_like_quake_level(std::string_view bytes);

/// Reads a level of version 29 (also those without textures and light). Errors: Input_error where it is of another
/// version, cut off, or names what there is not. Cost: one pass. Exact: yes, the floats as they are.
Quake_level read_quake_level(const Input& input);

/// Where something stands in a level, as its entities say: those with an `origin` and no model of the file's, in its
/// order. Errors: Input_error, as read_map_places; places are in the lump of entities.
std::vector<Map_place> read_level_places(const Input& input);

/// The faces of the world alone. A face's id is its place in the world's model, which is its place in the file. Faces
/// of doors and the like are passed over.
Polygon_soup read_quake_bsp(const Input& input);

/// The bytes of a level with another table of what leaves may see, and nothing else changed: rows[l] is of leaf l + 1,
/// true where leaf m + 1 may be seen. Rows that are equal share their bytes. Pre: the bytes are a level that was read;
/// visible_leaves rows of as many entries.
std::string with_visibility(std::string_view bytes, const std::vector<std::vector<bool>>& rows);

}  // namespace sightline
