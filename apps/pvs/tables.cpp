#include "tables.h"

#include "../support/files.h"
#include "../support/versions.h"

#include <sightline/io/input.h>

#include <algorithm>
#include <map>

namespace sightline::app {

std::vector<Group_row> rows_of_groups(const std::vector<std::uint32_t>& groups, const Visibility_table& table) {
  std::map<std::uint32_t, Group_row> rows;
  for (Cell_id cell = 0; cell < groups.size(); ++cell) {
    const Visibility_table::Row* const seen = table.row_of(cell);
    if (seen == nullptr || groups[cell] == no_cell) continue;
    Group_row& row = rows.try_emplace(groups[cell], Group_row{groups[cell], {}, {}, {}}).first->second;
    row.cells.push_back(cell);
    row.visible.insert(row.visible.end(), seen->visible.begin(), seen->visible.end());
    row.undecided.insert(row.undecided.end(), seen->undecided.begin(), seen->undecided.end());
  }
  std::vector<Group_row> list;
  for (auto& [number, of_group] : rows) {
    Group_row& row = of_group;
    for (std::vector<Face_id>* faces : {&row.visible, &row.undecided}) {
      std::sort(faces->begin(), faces->end());
      faces->erase(std::unique(faces->begin(), faces->end()), faces->end());
    }
    std::erase_if(row.undecided,
                  [&](Face_id f) { return std::binary_search(row.visible.begin(), row.visible.end(), f); });
    list.push_back(std::move(row));
  }
  return list;
}

std::optional<Group_names> names_of(Division::Kind kind) {
  switch (kind) {
    case Division::Kind::boxes: return Group_names{"box", "boxes", "boxes"};
    case Division::Kind::volumes: return Group_names{"volume", "volumes", "volumes"};
    case Division::Kind::regions: return Group_names{"convex_region", "convex_regions", "convex regions"};
    case Division::Kind::none:
    case Division::Kind::leaves: break;
  }
  return std::nullopt;
}

Json groups_json(const std::vector<Group_row>& rows, const Division& division, const Group_names& names) {
  Json list = Json::array();
  for (const Group_row& row : rows) {
    Json& json = list.emplace_back();
    if (division.kind != Division::Kind::boxes) json[names.one] = row.number;
    else {
      const auto [x, y, z] = division.counts;
      json[names.one] = {row.number % x, row.number / x % y, row.number / x / y};
    }
    json.update({{"cells", row.cells}, {"visible", row.visible}, {"undecided", row.undecided}});
  }
  return list;
}

std::string question_of(const Polygon_soup& soup, const Division& division, bool outside, bool cells_too) {
  return fmt::format("sightline {}, scene {:016x}, candidates {}, seed {}{}{}{}", program_version(), fingerprint(soup),
                     division.candidates, division.seed, outside ? ", outside" : "", division.question(),
                     cells_too ? ", cells too" : "");
}

Visibility_table saved_table(const Pvs_arguments& arguments, const Polygon_soup& soup, const Division& division) {
  const std::string bytes = read_input(arguments.table);
  Visibility_table table = read_table({arguments.table, bytes});
  const std::string question = question_of(soup, division, arguments.outside, table.has_cells());
  if (table.question != question)
    throw Input_error::of_file(arguments.table,
                               fmt::format("is a table of \"{}\", not \"{}\"; give the options that it was made with",
                                           table.question, question));
  for (const std::vector<bool>* asked : {&table.faces, &table.lower_cells})
    if (std::find(asked->begin(), asked->end(), false) != asked->end())
      throw Input_error::of_file(arguments.table, "is a part of a table; `sightline merge` makes a whole one of all");
  return table;
}

static Json table_json(const Visibility_table& table) {
  Json cells = Json::array();
  std::size_t r = 0;
  for (std::size_t c = 0; c < table.cells.size(); ++c) {
    if (!table.cells[c]) continue;
    const Visibility_table::Row& row = table.rows[r++];
    cells.push_back({{"cell", c}, {"visible", row.visible}, {"undecided", row.undecided}});
    if (table.has_cells()) cells.back().update({{"cells", row.cells}, {"cells_undecided", row.cells_undecided}});
  }
  return {{"format", table.has_cells() ? "sightline pvs 2" : "sightline pvs 1"},
          {"question", table.question},
          {"cells", std::move(cells)}};
}

static std::string table_csv(const Visibility_table& table) {
  std::string text = table.has_cells() ? "cell,kind,number,state\n" : "cell,face,state\n";
  std::size_t r = 0;
  for (std::size_t c = 0; c < table.cells.size(); ++c) {
    if (!table.cells[c]) continue;
    const Visibility_table::Row& row = table.rows[r++];
    const auto add = [&](const char* kind, const std::vector<std::uint32_t>& numbers, const char* state) {
      for (const std::uint32_t number : numbers) text += fmt::format("{},{}{},{}\n", c, kind, number, state);
    };
    add(table.has_cells() ? "face," : "", row.visible, "visible");
    add(table.has_cells() ? "face," : "", row.undecided, "undecided");
    add("cell,", row.cells, "visible");
    add("cell,", row.cells_undecided, "undecided");
  }
  return text;
}

void write_table(const std::string& out, const Visibility_table& table, const Json& groups) {
  const std::string ending = ending_of(out);
  Json json;
  if (ending == ".json") {
    json = table_json(table);
    if (!groups.is_null()) json.update(groups);
  }
  write_file(out, ending == ".json" ? to_text(json) + "\n" : ending == ".csv" ? table_csv(table) : table_bytes(table));
}

std::size_t count_of(const Visibility_table& table, std::vector<std::uint32_t> Visibility_table::Row::*numbers) {
  std::size_t sum = 0;
  for (const Visibility_table::Row& row : table.rows) sum += (row.*numbers).size();
  return sum;
}

}  // namespace sightline::app
