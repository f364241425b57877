#include <sightline/algorithms/levels/stated_cell.h>

#include <sightline/algorithms/levels/ways.h>

namespace sightline {

Cell_statement stated_cell(const Level_cells& level, Cell_id cell) {
  Cell_statement statement{{}, level.cells()[cell].faces};
  for (const std::uint32_t w : level.cells()[cell].walls)
    statement.walls.push_back(levels_detail::looking_from(level, level.walls()[w], level.walls()[w].corners, cell));
  return statement;
}

}  // namespace sightline
