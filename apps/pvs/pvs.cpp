// sightline pvs: for each cell of a level the faces, and the cells, that are visible from it, as a table, with
// certificates, in parts.

#include "pvs.h"

#include "../support/drawing.h"
#include "certificates.h"
#include "drawings.h"
#include "table_maker.h"
#include "tables.h"

#include <sightline/io/file.h>

#include <algorithm>

namespace sightline::app {

namespace {

/// How much of a whole.
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

/// A copy of a compiled level with what its leaves see in the place of its own table: cells from cells alone.
Exit run_into_level(const Pvs_arguments& arguments) {
  const Common& common = arguments.common;
  if (!arguments.shard.empty() || arguments.resume || !arguments.show.empty() || !arguments.certificates.empty())
    throw Usage_error("--out FILE.bsp is about leaves alone: leave out --shard, --resume, --show and --certificates");
  if (!arguments.svg.empty() || !arguments.html.empty() || !arguments.obj.empty() || !arguments.mesh.empty())
    throw Usage_error("--out FILE.bsp draws nothing: leave out --svg, --html, --obj and --mesh, or name another --out");
  if (const Division_arguments& d = arguments.division;
      !d.grid.empty() || !d.volumes.empty() || d.coarse > 0 || !arguments.cells.empty())
    throw Usage_error("--out FILE.bsp is about the level's leaves: leave out --cells, --grid, --volumes and --coarse");
  const std::string bytes = compiled_level(common, "--out FILE.bsp");
  const Quake_level file = read_quake_level({common.scene, bytes});
  const Polygon_soup soup = common.read();
  const Stopwatch watch;
  const Time_limit limit(common.budget);
  Division division;
  division.candidates = arguments.division.candidates;
  division.seed = common.seed;
  division.tree = space_tree(file, common.scene);
  const Level_cells level = cells_of(common, soup, division);
  const double cells_seconds = watch.seconds();
  Progress progress("looking");
  Pvs_options options;
  options.outside = arguments.outside;
  options.threads = common.threads;
  options.search.seed = common.seed;
  options.progress = [&](std::size_t done, std::size_t all) { progress(done, all); };
  options.search.out_of_time = limit.end();
  const Cell_pvs pvs = mutually_visible_cells(level, options);
  progress.clear();
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
  row_of_cells(c, c.pairs, c.visible, c.undecided);
  row("leaves", fmt::format("{} have rows: of {} pairs, each with itself too, {} are visible", rows.size(),
                            rows.size() * rows.size(), visible));
  row("seconds", fmt::format("{:.3f} for cells, {:.3f} for what they see", cells_seconds, seconds));
  return exit;
}

/// Of what does not go together.
void check_usage(const Pvs_arguments& arguments, const Shard& own) {
  const bool has_drawing = !arguments.svg.empty() || !arguments.obj.empty() || !arguments.mesh.empty();
  if (arguments.resume && (arguments.out.empty() || arguments.out == "-"))
    throw Usage_error("--resume keeps what is done beside an output: name it with --out FILE");
  if (own.shards > 1 && !arguments.show.empty())
    throw Usage_error("a shard has some faces only: leave out --show, or --shard");
  if (arguments.show.empty() && has_drawing)
    throw Usage_error("a picture is of what a cell sees: say which with --show CELL");
  arguments.view.check_usage(!arguments.svg.empty());
  if (arguments.svg.empty() && !arguments.eye.empty())
    throw Usage_error("--eye is the eye of the picture: add --svg FILE, or leave it out");
}

/// What --show names is a cell that is asked about.
void check_shown(const Pvs_arguments& arguments, const Level_cells& level) {
  const std::vector<char> asked = asked_cells(level, arguments.outside);
  for (const Cell_id cell : arguments.show)
    if (cell >= asked.size() || asked[cell] == 0)
      throw Usage_error(
          fmt::format("--show {}: no such cell, or one that is not asked about; `sightline cells` lists them", cell));
}

/// What is told of a table.
struct Table_facts {
  std::size_t visible, undecided;                           // pairs of a cell and a face
  std::size_t cells_pairs, cells_visible, cells_undecided;  // of two cells
  std::optional<Group_names> names;                         // of what cells are within, where there is such a thing
  std::vector<Group_row> groups;

  bool is_decided() const { return undecided + cells_undecided == 0; }
};

Table_facts facts_of(const Visibility_table& table, const Division& division, const Level_cells& level) {
  std::size_t cells_pairs = 0, place = 0;  // of each lower cell those above it
  for (std::size_t cell = 0; cell < table.lower_cells.size(); ++cell) {
    if (!table.cells[cell]) continue;
    ++place;
    if (table.lower_cells[cell]) cells_pairs += table.rows.size() - place;
  }
  Table_facts facts{count_of(table, &Visibility_table::Row::visible),
                    count_of(table, &Visibility_table::Row::undecided),
                    cells_pairs,
                    count_of(table, &Visibility_table::Row::cells) / 2,
                    count_of(table, &Visibility_table::Row::cells_undecided) / 2,
                    names_of(division.kind),
                    {}};
  if (facts.names) facts.groups = rows_of_groups(division.groups(level), table);
  return facts;
}

/// The rows of the cells that --show names.
Json shown_json(const Pvs_arguments& arguments, const Level_cells& level, const Visibility_table& table) {
  Json shown = Json::array();
  for (const Cell_id cell : arguments.show) {
    const Visibility_table::Row& seen = *table.row_of(cell);
    shown.push_back({{"cell", cell},
                     {"point", point_json(level.inside(cell))},
                     {"visible", seen.visible},
                     {"undecided", seen.undecided}});
    if (arguments.cells_too) shown.back().update({{"cells", seen.cells}, {"cells_undecided", seen.cells_undecided}});
  }
  return shown;
}

Json result_json(const Pvs_arguments& arguments, const Level_cells& level, const Division& division,
                 const Visibility_table& table, const Table_facts& facts, std::uint32_t blocks_kept) {
  Json result{{"cells", table.rows.size()},
              {"faces", std::count(table.faces.begin(), table.faces.end(), true)},
              {"visible", facts.visible},
              {"undecided", facts.undecided},
              {"blocks_kept", blocks_kept}};
  if (arguments.cells_too)
    result["pairs_of_cells"] = {{"visible", facts.cells_visible}, {"undecided", facts.cells_undecided}};
  if (!arguments.show.empty()) result["shown"] = shown_json(arguments, level, table);
  if (facts.names) result[facts.names->all] = groups_json(facts.groups, division, *facts.names);
  return result;
}

/// How the pairs of the table were decided.
void print(const Table_maker& maker, const Table_facts& facts, bool cells_too) {
  const Pvs_counters& c = maker.counters();
  row("pairs", maker.blocks_kept() > 0
                   ? fmt::format("{} of a cell and a face visible, {} undecided; {} asked about now, the others kept",
                                 facts.visible, facts.undecided, c.pairs)
                   : fmt::format("{} of a cell and a face: {} visible ({:.3g}%), {} undecided", c.pairs, facts.visible,
                                 percent(facts.visible, c.pairs), facts.undecided));
  row("seen", fmt::format("{} within their cell, {} by a neighbour's sightline; {} searches, {} of which found hidden, "
                          "{} left to events; {} pairs were not reached",
                          c.within, c.extended, c.searched, c.hidden, c.by_events, c.unreached));
  if (cells_too) row_of_cells(maker.cell_counters(), facts.cells_pairs, facts.cells_visible, facts.cells_undecided);
  if (!facts.names) return;
  std::size_t pairs = 0;
  for (const Group_row& group : facts.groups) pairs += group.visible.size();
  row(facts.names->words,
      fmt::format("{} have cells that are asked about; {} pairs of one of them and a face are visible; "
                  "--json - lists them",
                  facts.groups.size(), pairs));
}

Exit run_pvs(const Pvs_arguments& arguments, Ranks& ranks) {
  const Common& common = arguments.common;
  if (!ranks.is_alone() && arguments.out.ends_with(".bsp"))
    throw Usage_error("--out FILE.bsp is asked of one process: call it without mpirun");
  if (arguments.out.ends_with(".bsp")) return run_into_level(arguments);
  if (!ranks.is_alone() && (common.scene == "-" || arguments.cells == "-"))
    throw Usage_error("of several processes one alone has a standard input: name a file that all can read");
  const Shard own = shard_of(arguments.shard);
  check_usage(arguments, own);

  // 1. The cells.
  const Polygon_soup soup = common.read();
  std::optional<Cell_file> file;
  if (!arguments.cells.empty()) file.emplace(arguments.cells, common, soup);
  Division division = file ? file->division() : arguments.division.division(common, soup);
  const Stopwatch watch;
  const Time_limit limit(common.budget);
  const Report in_time = common.within_budget();
  const Level_cells level = cells_of(common, soup, division);
  if (file) division.known_regions = file->checked_regions(level);
  file.reset();
  if (division.kind == Division::Kind::regions && ranks.is_first())  // while there is no table yet to lose
    division.known_regions = division.groups(level, in_time);
  const double cells_seconds = watch.seconds();
  check_shown(arguments, level);

  // 2. What they see.
  Table_maker maker(arguments, division, soup, level, limit);
  const bool in_blocks = arguments.resume || !ranks.is_alone();
  const Visibility_table table = in_blocks ? maker.make_in_blocks(own, ranks) : maker.make(own);
  maker.clear();
  if (!ranks.is_first()) {
    if (!arguments.certificates.empty()) write_certificates(arguments, level, table, limit, own, ranks);
    return Exit::done;
  }
  const double seconds = watch.seconds() - cells_seconds;
  const Table_facts facts = facts_of(table, division, level);

  // 3. What is written.
  if (!arguments.out.empty()) write_table(arguments.out, table);
  if (!arguments.svg.empty()) draw(arguments, soup, level, table);
  if (!arguments.obj.empty() || !arguments.mesh.empty())
    write_drawings(arguments.obj, arguments.mesh, drawing_of_table(level, table, arguments.show));
  if (!arguments.html.empty()) write_page(arguments, level, table);
  const bool all_proved =
      arguments.certificates.empty() || write_certificates(arguments, level, table, limit, own, ranks);
  if (arguments.resume && facts.is_decided() && all_proved) maker.remove_kept();
  const Exit exit = !facts.is_decided() || !all_proved ? Exit::undecided : Exit::done;
  Json counters = counters_json(maker.counters());
  counters["cells"] = counters_json(level.counters());
  if (arguments.cells_too) counters["pairs_of_cells"] = counters_json(maker.cell_counters());
  if (write_json(common, "pvs", level.scene(),
                 result_json(arguments, level, division, table, facts, maker.blocks_kept()), std::move(counters),
                 {{"cells", cells_seconds}, {"pvs", seconds}, {"pairs_of_cells", maker.cell_seconds()}}))
    return exit;

  // 4. For people.
  scene_rows(level.scene());
  row("cells", fmt::format("{} of {} are asked about", table.rows.size(), level.counters().cells));
  print(maker, facts, arguments.cells_too);
  if (arguments.resume)
    row("resumed",
        fmt::format(
            "{} of {} blocks were there{}", maker.blocks_kept(), table_blocks,
            facts.is_decided() ? "" : "; those that are decided are kept, and the same command goes on from there"));
  for (const Cell_id cell : arguments.show) {
    row(fmt::format("cell {}", cell), fmt::format("sees {}", fmt::join(table.row_of(cell)->visible, " ")));
    if (arguments.cells_too) row("", fmt::format("and cells {}", fmt::join(table.row_of(cell)->cells, " ")));
  }
  row("seconds",
      fmt::format("{:.3f} for cells, {:.3f} for what they see{}", cells_seconds, seconds,
                  arguments.cells_too ? fmt::format(", {:.3f} of it for pairs of cells", maker.cell_seconds()) : ""));
  return exit;
}

}  // namespace

void add_pvs(Command program) {
  const Command command =
      program.add_command("pvs", "What each cell of a level can see, exactly: a table, in parts, with certificates");
  auto a = std::make_shared<Pvs_arguments>();
  a->common.add_to(command);
  command
      .add_option(
          "--out", a->out,
          "write the table: .json, .csv, or else binary; .bsp: a copy of SCENE, a compiled level, with what its "
          "leaves see in the place of its own table")
      .writes_file();
  command.add_flag("--outside", a->outside, "ask about cells too from which there is a way out of the level");
  command.add_flag("--cells-too", a->cells_too,
                   "find the pairs of cells of which some point of the one sees some point of the other, too");
  const std::vector<Option> ways = a->division.add_to(command);
  const Option cells = command
                           .add_option("--cells", a->cells,
                                       "the cells that `cells SCENE --out FILE` wrote, and that of them which they are "
                                       "within: boxes, volumes or convex regions")
                           .reads_file();
  for (const Option& way : ways) cells.excludes(way);
  command.add_option("--show", a->show, "print what this cell sees; may be repeated");
  add_mesh_option(command, a->mesh, "faces visible, hidden, undecided from --show, and the cells,");
  command.add_option("--obj", a->obj, "the same as OBJ").writes_file(".obj");
  command
      .add_option("--svg", a->svg, "draw the rooms and what --show sees of them, without what has its back to the eye")
      .writes_file(".svg");
  command.add_option("--html", a->html, "write a page to look at: click a cell, and what it sees").writes_file(".html");
  command.add_option("--eye", a->eye, "with --svg: X,Y,Z; by default a place outside the scene").check(not_empty());
  a->view.add_to(command);
  command
      .add_option(
          "--certificates", a->certificates,
          "write a certificate for each cell, and an index that states the cells, to this folder; of a shard those "
          "of its cells, and a part of the index, for `merge --certificates`")
      .check(not_empty());
  command.add_option(
      "--shard", a->shard,
      "I/N: the faces, pairs whose lower cell, and cells with certificates, are each I-th of N; by default what "
      "SLURM_ARRAY_TASK_ID and _COUNT say");
  command.add_flag("--resume", a->resume,
                   "keep blocks of faces beside --out, and cells with certificates in their folder, and do not ask "
                   "again what they hold");
  command.footer(
      "Example: sightline pvs level.map --out level.pvs\n"
      "         for i in 0 1 2 3; do sightline pvs level.map --shard $i/4 --out part$i.pvs --resume & done; wait\n"
      "         sightline merge part?.pvs --out level.pvs\n"
      "         mpirun -n 3 sightline pvs level.map --threads 1 --resume --out level.pvs\n"
      "         sightline pvs level.bsp --out better.bsp\n"
      "Cells are those of `sightline cells` with the same --candidates, --seed, --leaves, --grid and --volumes; with "
      "--cells FILE, whatever --seed is. Exit "
      "code 4: pairs are undecided; in a .bsp their leaves see each other.");
  command.set_action([a] { return Ranks::together([&](Ranks& ranks) { return run_pvs(*a, ranks); }); });
}

}  // namespace sightline::app
