#pragma once
// A certificate for each cell that `sightline pvs` asks about, and the index of their folder.

#include "../support/ranks.h"
#include "../support/shard.h"
#include "pvs.h"

#include <string>

namespace sightline::app {

/// A certificate for each cell that is asked about, made by whoever is free; and an index that states all cells, as the
/// table of the first process has them. Returns there whether they leave nothing undecided. Of a shard the cells that
/// are its own, of those asked about and of the others each I-th of N, and a part of the index.
bool write_certificates(const Pvs_arguments& arguments, const Level_cells& level, const Visibility_table& table,
                        const Time_limit& limit, const Shard& own, Ranks& ranks);

}  // namespace sightline::app
