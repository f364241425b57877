#pragma once
// What divides space before faces do, a compiled level's own tree and leaves, even boxes or volumes, and what puts
// cells together again.

#include "common.h"

#include <sightline/algorithms/levels/cell_pvs.h>
#include <sightline/algorithms/levels/cells.h>
#include <sightline/io/quake_bsp.h>
#include <sightline/io/quake_map.h>
#include <sightline/own_leaves.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sightline::app {

/// What divides space, and is asked about beside cells.
struct Division {
  enum class Kind { none, leaves, boxes, volumes, regions } kind = Kind::none;
  Space_tree tree;
  std::array<std::uint32_t, 3> counts{};  ///< of boxes
  std::uint32_t volumes = 0;
  std::size_t regions = 0;  ///< at most
  unsigned candidates = 5;  ///< of the tree of faces, with its seed
  std::uint64_t seed = 1;
  std::vector<std::uint32_t> known_regions;  ///< by cell, where they are known already

  /// What a table has to name: it is another one without. Of the tree where that was given.
  std::string question() const;

  /// By cell the box, volume or region that it is in; no_cell: none. What `progress` throws ends it.
  std::vector<std::uint32_t> groups(const Level_cells& level, const Report& progress = {}) const;
};

/// How cells are made: option --candidates, and --leaves, --grid, --volumes and --coarse, of which there may be one.
struct Division_arguments {
  unsigned candidates = 5;
  bool leaves = false;
  std::string grid;     // "NX,NY,NZ", or empty
  std::string volumes;  // a file, or empty
  std::size_t coarse = 0;

  /// Returns the options.
  std::vector<Option> add_to(Command command);
  /// What they ask for. Errors: Usage_error, and Input_error for files.
  Division division(const Common& common, const Polygon_soup& soup) const;

 private:
  std::array<std::uint32_t, 3> counts() const;
};

/// The cells of a level, with a bar. Errors: Out_of_budget: there is no answer without them.
Level_cells cells_of(const Common& common, const Polygon_soup& soup, const Division& division);

/// The bytes of SCENE; of standard input, where that is a level. Pre: SCENE has been read.
std::string level_bytes(const Common& common);

/// The same where it is a compiled level. Errors: Usage_error that begins with `wanted` where it is none.
std::string compiled_level(const Common& common, const std::string& wanted);

/// What stands in SCENE, where it is a level by its name, .map or .bsp, or by what standard input is; nothing where it
/// is none. Pre: as above.
std::optional<std::vector<Map_place>> places_of(const Common& common);

/// What leaves see, as a level has it: rows[l] is of leaf l + 1. Pre: cells are within the leaves of the level's tree.
std::vector<std::vector<bool>> rows_of_level(const Level_cells& level, const Cell_pvs& pvs, const Quake_level& file);

}  // namespace sightline::app
