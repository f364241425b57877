#pragma once
// What cells see, as pictures, groups of polygons and pages.

#include "pvs.h"

#include <sightline/io/grouped_polygons.h>

#include <vector>

namespace sightline::app {

/// The scene's pieces in groups "visible", "hidden" and "undecided", and cells in groups of their own.
Grouped_polygons drawing_of_table(const Level_cells& level, const Visibility_table& table,
                                  const std::vector<Cell_id>& cells);

/// The faces that look into cells that are asked about, from their fronts, so that one looks into rooms, and the cells.
void draw(const Pvs_arguments& arguments, const Polygon_soup& soup, const Level_cells& level,
          const Visibility_table& table);

/// The cells that are asked about, those of --show first, and what each sees.
void write_page(const Pvs_arguments& arguments, const Level_cells& level, const Visibility_table& table);

}  // namespace sightline::app
