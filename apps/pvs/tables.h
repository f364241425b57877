#pragma once
// Tables of what cells see as files, and what groups of cells see together.

#include "pvs.h"

#include <sightline/io/visibility_table.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sightline::app {

/// What the cells of a box, a volume or a convex region see, together.
struct Group_row {
  std::uint32_t number;
  std::vector<Cell_id> cells;
  std::vector<Face_id> visible, undecided;  // ascending; what one cell sees is undecided of no group
};

/// Of groups that have cells which are asked about, by number.
std::vector<Group_row> rows_of_groups(const std::vector<std::uint32_t>& groups, const Visibility_table& table);

/// What JSON and people call the groups of a division; nothing where there are none.
struct Group_names {
  const char *one, *all, *words;
};
std::optional<Group_names> names_of(Division::Kind kind);

Json groups_json(const std::vector<Group_row>& rows, const Division& division, const Group_names& names);

/// As the ending of its name says: .json, .csv, or else binary.
void write_table(const std::string& out, const Visibility_table& table);

/// Of all rows together.
std::size_t count_of(const Visibility_table& table, std::vector<std::uint32_t> Visibility_table::Row::*numbers);

}  // namespace sightline::app
