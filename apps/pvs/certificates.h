#pragma once
// A certificate for each cell that `sightline pvs` asks about, and the index of their folder.

#include "../support/ranks.h"
#include "pvs.h"

namespace sightline::app {

/// A certificate for each cell that is asked about, made by whoever is free; and an index that states all cells, as the
/// table of the first process has them. Returns there whether they leave nothing undecided.
bool write_certificates(const Pvs_arguments& arguments, const Level_cells& level, const Visibility_table& table,
                        const Time_limit& limit, Ranks& ranks);

}  // namespace sightline::app
