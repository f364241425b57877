#include "into_level.h"

#include "../support/files.h"
#include "tables.h"

#include <sightline/io/input.h>

#include <algorithm>

namespace sightline::app {

double percent(std::size_t part, std::size_t whole) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(1, whole));
}

void row_of_cells(const Cell_pvs_counters& c, std::size_t pairs, std::size_t visible, std::size_t undecided) {
  row("", fmt::format("{} of two cells: {} see each other ({:.3g}%), {} undecided", pairs, visible,
                      percent(visible, pairs), undecided));
  row("",
      fmt::format("{} neighbours, {} along random lines, {} along a sightline made longer; {} searches, {} of which "
                  "found hidden, {} left to events; {} pairs were not reached",
                  c.adjacent, c.by_lines, c.extended, c.searched, c.hidden, c.by_events, c.unreached));
}

namespace {

/// Which cells see each other, asked now.
Cell_pvs pairs_of_cells(const Pvs_arguments& arguments, const Level_cells& level) {
  const Time_limit limit(arguments.common.budget);
  Progress progress("looking");
  Pvs_options options;
  options.outside = arguments.outside;
  options.threads = arguments.common.threads;
  options.search.seed = arguments.common.seed;
  options.progress = [&](std::size_t done, std::size_t all) { progress(done, all); };
  options.search.out_of_time = limit.end();
  return mutually_visible_cells(level, options);
}

/// The same as a table has it. Errors: Input_error where it is none of pairs of cells.
Cell_pvs pairs_of_table(const Visibility_table& table, const std::string& name) {
  if (!table.has_cells())
    throw Input_error::of_file(name, "is no table of pairs of cells; make it with --leaves --cells-too");
  Cell_pvs pvs;
  pvs.is_asked.assign(table.cells.begin(), table.cells.end());
  pvs.visible.resize(table.cells.size());
  pvs.undecided.resize(table.cells.size());
  pvs.counters.cells = table.rows.size();
  std::size_t r = 0;
  for (std::size_t cell = 0; cell < table.cells.size(); ++cell) {
    if (!table.cells[cell]) continue;
    const Visibility_table::Row& row = table.rows[r++];
    pvs.visible[cell] = row.cells;
    pvs.undecided[cell] = row.cells_undecided;
  }
  pvs.counters.visible = count_of(table, &Visibility_table::Row::cells) / 2;
  pvs.counters.undecided = count_of(table, &Visibility_table::Row::cells_undecided) / 2;
  return pvs;
}

}  // namespace

Exit run_into_level(const Pvs_arguments& arguments) {
  const Common& common = arguments.common;
  if (!arguments.shard.empty() || arguments.resume || !arguments.shown.empty() || !arguments.certificates.empty())
    throw Usage_error(
        "--out FILE.bsp is about leaves alone: leave out --shard, --resume, --show and "
        "--certificates; parts that `pvs --leaves --cells-too --shard I/N` made and `merge` put "
        "together it takes by --table");
  if (!arguments.svg.empty() || !arguments.html.empty() || !arguments.obj.empty() || !arguments.mesh.empty())
    throw Usage_error("--out FILE.bsp draws nothing: leave out --svg, --html, --obj and --mesh, or name another --out");
  if (const Division_arguments& d = arguments.division;
      !d.grid.empty() || !d.volumes.empty() || d.coarse > 0 || !arguments.cells.empty())
    throw Usage_error("--out FILE.bsp is about the level's leaves: leave out --cells, --grid, --volumes and --coarse");
  const Polygon_soup soup = common.read();
  const std::string bytes = compiled_level(common, "--out FILE.bsp");
  const Quake_level file = read_quake_level({common.scene, bytes});
  const Stopwatch watch;
  Division_arguments by_leaves;
  by_leaves.candidates = arguments.division.candidates;
  by_leaves.leaves = true;
  const Division division = by_leaves.division(common, soup);
  const Level_cells level = cells_of(common, soup, division);
  const double cells_seconds = watch.seconds();
  const Cell_pvs pvs = arguments.table.empty()
                           ? pairs_of_cells(arguments, level)
                           : pairs_of_table(saved_table(arguments, soup, division), arguments.table);
  const double seconds = watch.seconds() - cells_seconds;
  const std::vector<std::vector<bool>> rows = rows_of_level(level, pvs, file);
  write_file(arguments.out, with_visibility(bytes, rows));

  std::size_t visible = 0;
  for (const std::vector<bool>& row : rows)
    visible += static_cast<std::size_t>(std::count(row.begin(), row.end(), true));
  const Cell_pvs_counters& c = pvs.counters;
  const Exit exit = c.undecided > 0 ? Exit::undecided : Exit::done;
  Json counters = counters_json(c);
  counters["cells"] = counters_json(level.counters());
  if (write_json(common, "pvs", level.scene(),
                 {{"cells", c.cells},
                  {"faces", 0},
                  {"visible", 0},
                  {"undecided", 0},
                  {"blocks_kept", 0},
                  {"pairs_of_cells", {{"visible", c.visible}, {"undecided", c.undecided}}},
                  {"leaves", {{"leaves", rows.size()}, {"visible", visible}}}},
                 std::move(counters), {{"cells", cells_seconds}, {"pvs", seconds}}))
    return exit;
  scene_rows(level.scene());
  row("cells", fmt::format("{} of {} are asked about", c.cells, level.counters().cells));
  if (arguments.table.empty()) row_of_cells(c, c.pairs, c.visible, c.undecided);
  else
    row("", fmt::format("as {} has it, {} pairs of two cells see each other, {} are undecided", arguments.table,
                        c.visible, c.undecided));
  row("leaves", fmt::format("{} have rows: of {} pairs, each with itself too, {} are visible", rows.size(),
                            rows.size() * rows.size(), visible));
  row("seconds", fmt::format("{:.3f} for cells, {:.3f} for what they see", cells_seconds, seconds));
  return exit;
}

}  // namespace sightline::app
