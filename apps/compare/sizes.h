#pragma once
// What methods have wrong by size on screen: a sample of pairs, and a table.

#include "../support/common.h"

#include <sightline/harness/compare/screen_sizes.h>

#include <array>
#include <cstdint>
#include <vector>

namespace sightline::app {

/// Who looks, and at what.
using Pairs = std::vector<std::array<std::uint32_t, 2>>;

/// Of what a method has wrong, as row["sample"]: of pairs hidden wrongly, and of those too many, at most 200 each, in a
/// random order: so is the beginning, where there is no time for all.
Json sample_json(Pairs hidden, Pairs visible, std::uint64_t seed);

Json sizes_json(const Screen_sizes& sizes);

/// Of rows with "sizes" a line for each of the two kinds that has some. `name`: of a row.
void print_sizes(const Json& rows);

/// "rays, 100 a cell".
std::string cells_name(const Json& row);

}  // namespace sightline::app
