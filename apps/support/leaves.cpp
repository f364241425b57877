#include "leaves.h"

#include "journal.h"

#include <sightline/algorithms/levels/coarse.h>
#include <sightline/algorithms/levels/grid.h>
#include <sightline/algorithms/levels/volumes.h>
#include <sightline/io/file.h>
#include <sightline/io/input.h>
#include <sightline/kernel/number.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace sightline::app {

std::vector<Option> Division_arguments::add_to(Command command) {
  const Option by_candidates =
      command.add_option("--candidates", candidates, "face planes tried for each node of the tree of cells")
          .check(range(1, 1000))
          .show_default();
  const Option by_leaves =
      command.add_flag("--leaves", leaves, "of a compiled level (.bsp): cells within its own leaves, by number");
  const Option by_boxes =
      command
          .add_option(
              "--grid", grid,
              "NX,NY,NZ: cells within even boxes, so many along each axis of the box about the scene; box (x, y, z) "
              "is number x + NX (y + NY z), and those at the rim go on without end")
          .check(not_empty());
  const Option by_volumes =
      command
          .add_option(
              "--volumes", volumes,
              "cells within volumes, rooms say: a file of closed polyhedra that do not overlap, each a connected "
              "component, with points of its own; by first faces they are volume 0, 1, ...")
          .reads_file()
          .check(not_empty());
  const Option by_regions =
      command
          .add_option(
              "--coarse", coarse,
              "put cells that are not solid together while they are convex together and no face is inside, until "
              "so many regions are left, or no two can be put together")
          .check(range(1, 1000000000));
  return {by_candidates, by_leaves, by_boxes, by_volumes, by_regions};
}

std::array<std::uint32_t, 3> Division_arguments::counts() const {
  constexpr std::uint64_t most = 1000000;
  std::array<std::uint32_t, 3> counts{};
  const char* at = grid.data();
  const char* const end = at + grid.size();
  std::uint64_t all = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [next, error] = std::from_chars(at, end, counts[k]);
    const bool ends_well = k < 2 ? next != end && *next == ',' : next == end;
    if (error != std::errc() || counts[k] == 0 || !ends_well)
      throw Usage_error("--grid " + grid + ": three positive numbers are needed, like 8,8,2");
    at = k < 2 ? next + 1 : next;
    all *= counts[k];
    if (all > most) throw Usage_error(fmt::format("--grid {}: more than {} boxes; ask for fewer", grid, most));
  }
  return counts;
}

Division Division_arguments::division(const Common& common, const Polygon_soup& soup) const {
  if (static_cast<int>(leaves) + !grid.empty() + !volumes.empty() + (coarse > 0) > 1)
    throw Usage_error("--leaves, --grid, --volumes and --coarse each say what is asked about: leave out all but one");
  Division division;
  division.candidates = candidates;
  division.seed = common.seed;
  if (leaves) {
    const std::string bytes = compiled_level(common, "--leaves");
    division.kind = Division::Kind::leaves;
    division.tree = space_tree(read_quake_level({common.scene, bytes}), common.scene);
  }
  if (!grid.empty()) {
    division.kind = Division::Kind::boxes;
    division.counts = counts();
    try {
      division.tree = even_boxes(soup, division.counts);
    } catch (const std::invalid_argument& error) {
      throw Usage_error("--grid " + grid + ": " + error.what() + "; ask for 1 there");
    }
  }
  if (!volumes.empty()) {
    Common of_file = common;
    of_file.scene = volumes;
    of_file.flip = false;  // that turns SCENE alone
    const Polygon_soup read = of_file.read();
    division.kind = Division::Kind::volumes;
    try {
      Progress progress("dividing");
      Volume_division found = volume_division(read, common.within_budget(progress));
      division.tree = std::move(found.tree);
      division.volumes = found.volumes;
      if (division.volumes == 0) throw std::invalid_argument("has no face, and so no volume");
    } catch (const std::invalid_argument& error) {
      throw Input_error::of_file(volumes, error.what());
    }
  }
  if (coarse > 0) {
    division.kind = Division::Kind::regions;
    division.regions = coarse;
  }
  return division;
}

/// All that a tree is.
static std::string text_of(const Space_tree& tree) {
  std::string text = std::to_string(tree.root);
  const auto add = [&](const Rational& x) { text += ' ' + to_string(x); };
  for (const Space_tree::Node& node : tree.nodes) {
    std::for_each(node.plane.begin(), node.plane.end(), add);
    text += fmt::format(" {}\n", fmt::join(node.children, " "));
  }
  for (const Exact_point& p : tree.corners) std::for_each(p.begin(), p.end(), add);
  return text;
}

std::string Division::question() const {
  switch (kind) {
    case Kind::leaves: return ", leaves";
    case Kind::boxes: return fmt::format(", grid {}", fmt::join(counts, ","));
    case Kind::volumes: return ", volumes " + hash_of_bytes(fmt::format("{} {}", volumes, text_of(tree)));
    case Kind::none:
    case Kind::regions: break;
  }
  return "";
}

std::vector<std::uint32_t> Division::groups(const Level_cells& level, const Report& progress) const {
  if (kind == Kind::regions) return known_regions.empty() ? convex_regions(level, regions, progress) : known_regions;
  std::vector<std::uint32_t> groups;
  for (const Level_cell& cell : level.cells())
    groups.push_back(kind == Kind::boxes || (kind == Kind::volumes && cell.leaf < volumes) ? cell.leaf : no_cell);
  return groups;
}

Level_cells cells_of(const Common& common, const Polygon_soup& soup, const Division& division) {
  Progress progress("dividing");
  Cell_options options;
  options.candidates = division.candidates;
  options.seed = division.seed;
  options.threads = common.threads;
  options.tree = division.tree;
  options.progress = common.within_budget(progress);
  return Level_cells(soup, options);
}

std::string level_bytes(const Common& common) {
  return common.scene == "-" ? *common.format.level : read_bytes(common.scene);
}

std::string compiled_level(const Common& common, const std::string& wanted) {
  if (std::string bytes = level_bytes(common); looks_like_quake_level(bytes)) return bytes;
  throw Usage_error(wanted + " is of a level that is compiled, version 29; SCENE is none");
}

std::optional<std::vector<Map_place>> places_of(const Common& common) {
  std::optional<Format> format = format_of_ending(common.scene);
  if (common.scene == "-" && !common.format.level->empty())
    format = looks_like_quake_level(*common.format.level) ? Format::bsp : Format::map;
  if (format != Format::map && format != Format::bsp) return std::nullopt;
  const std::string bytes = level_bytes(common);
  return format == Format::map ? read_map_places({common.scene, bytes}) : read_level_places({common.scene, bytes});
}

std::vector<std::vector<bool>> rows_of_level(const Level_cells& level, const Cell_pvs& pvs, const Quake_level& file) {
  std::vector<std::vector<bool>> rows = visible_leaves(level, pvs, std::max<std::size_t>(1, file.leaves.size()));
  rows.erase(rows.begin());  // leaf 0, which is solid, has none
  rows.resize(file.visible_leaves);
  for (std::vector<bool>& row : rows) {
    row.erase(row.begin());
    row.resize(file.visible_leaves);
  }
  return rows;
}

}  // namespace sightline::app
