#include "leaves.h"

#include <sightline/algorithms/levels/grid.h>
#include <sightline/io/file.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace sightline::app {

void Division_arguments::add_to(Command command) {
  command.add_flag("--leaves", leaves, "of a compiled level (.bsp): cells within its own leaves, by number");
  command
      .add_option(
          "--grid", grid,
          "NX,NY,NZ: cells within even boxes, so many along each axis of the box about the scene; box (x, y, z) "
          "is number x + NX (y + NY z), and those at the rim go on without end")
      .check(not_empty());
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

Space_tree Division_arguments::tree(const Common& common, const Polygon_soup& soup) const {
  if (leaves && !grid.empty()) throw Usage_error("--grid and --leaves both divide space: leave out one of them");
  if (leaves) {
    const std::string bytes = compiled_level(common, "--leaves");
    return space_tree(read_quake_level({common.scene, bytes}), common.scene);
  }
  if (grid.empty()) return {};
  try {
    return even_boxes(soup, counts());
  } catch (const std::invalid_argument& error) {
    throw Usage_error("--grid " + grid + ": " + error.what() + "; ask for 1 there");
  }
}

std::string compiled_level(const Common& common, const std::string& wanted) {
  if (common.scene != "-")
    if (std::string bytes = read_bytes(common.scene); looks_like_quake_level(bytes)) return bytes;
  throw Usage_error(wanted + " is of a level that is compiled, version 29; SCENE is none");
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
