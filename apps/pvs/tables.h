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

/// What a table is of, in one line: which program made it, of which scene, with which options.
std::string question_of(const Polygon_soup& soup, const Division& division, bool outside, bool cells_too);

/// The table of all faces that --table names. Errors: Input_error where there is none, it is a part, or one of another
/// question.
Visibility_table saved_table(const Pvs_arguments& arguments, const Polygon_soup& soup, const Division& division);

/// As the ending of its name says: .json, with what groups see where cells are in such, .csv, or else binary.
void write_table(const std::string& out, const Visibility_table& table, const Json& groups = {});

/// Of all rows together.
std::size_t count_of(const Visibility_table& table, std::vector<std::uint32_t> Visibility_table::Row::*numbers);

}  // namespace sightline::app
