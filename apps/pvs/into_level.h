#pragma once
// A copy of a compiled level with what its leaves see in the place of its own table.

#include "pvs.h"

#include <sightline/algorithms/levels/cell_pvs.h>

#include <cstddef>

namespace sightline::app {

/// Cells from cells alone, or as --table has them. Errors: Usage_error for what does not go together with that.
Exit run_into_level(const Pvs_arguments& arguments);

/// For people: how pairs of cells were decided, and how many see each other.
void row_of_cells(const Cell_pvs_counters& c, std::size_t pairs, std::size_t visible, std::size_t undecided);

/// How much of a whole.
double percent(std::size_t part, std::size_t whole);

}  // namespace sightline::app
