// sightline pvs: for each cell of a level the faces, and the cells, that are visible from it, as a table, with
// certificates, in parts.

#include "pvs.h"

#include "../support/drawing.h"
#include "../support/files.h"
#include "../support/page.h"
#include "certificates.h"
#include "drawings.h"
#include "into_level.h"
#include "table_maker.h"
#include "tables.h"

#include <sightline/algorithms/levels/pvs.h>
#include <sightline/io/file.h>
#include <sightline/io/input.h>

#include <algorithm>

namespace sightline::app {

namespace {

/// Of what does not go together.
void check_usage(const Pvs_arguments& arguments, const Shard& own) {
  const bool has_drawing = !arguments.svg.empty() || !arguments.obj.empty() || !arguments.mesh.empty();
  if (arguments.resume && (arguments.out.empty() || arguments.out == "-"))
    throw Usage_error("--resume keeps what is done beside an output: name it with --out FILE");
  if (own.shards > 1 && !arguments.shown.empty())
    throw Usage_error("a shard has some faces only: leave out --show, or --shard");
  if (const std::string ending = ending_of(arguments.out); own.shards > 1 && (ending == ".json" || ending == ".csv"))
    throw Usage_error("a shard has some faces only, which --out FILE" + ending +
                      " would not say: name one that is binary, for `merge`");
  if (arguments.shown.empty() && has_drawing)
    throw Usage_error("a picture is of what a cell sees: say which with --show CELL");
  arguments.view.check_usage(!arguments.svg.empty());
  if (arguments.svg.empty() && !arguments.eye.empty())
    throw Usage_error("--eye is the eye of the picture: add --svg FILE, or leave it out");
}

/// A level that is not shut would be asked about what is outside, too. Errors: Input_error where what stands in it has
/// a way out.
void check_leaks(const Common& common, const Level_cells& level) {
  const std::vector<char> has_way_out = regions_with_a_way_out(level);
  const auto leads_out = [&](Cell_id c) {
    const Level_cell& cell = level.cells()[c];
    return !cell.is_solid && has_way_out[cell.region] != 0;
  };
  for (const Map_place& place : places_of(common).value_or(std::vector<Map_place>{})) {
    const std::vector<Cell_id> cells = level.about(place.origin);
    if (std::any_of(cells.begin(), cells.end(), leads_out))
      throw Input_error::of_file(input_path(common.scene).string(),
                                 fmt::format("is not shut: there is a way out from {} at {}; `sightline cells SCENE "
                                             "--seal entities` shows ways; --outside asks about all cells",
                                             place.name, Page::text(place.origin)));
  }
}

/// The cells that --show names: by number, or by a point in or on the border of one. Errors: Usage_error where there is
/// none, or it is not asked about.
std::vector<Cell_id> shown_cells(const Pvs_arguments& arguments, const Level_cells& level) {
  const std::vector<char> asked = asked_cells(level, arguments.outside);
  std::vector<Cell_id> cells;
  for (const std::string& text : arguments.shown) {
    std::vector<Cell_id> named;
    if (text.find(',') != std::string::npos) {
      named = level.about(parse_point(text, "--show"));
    } else {
      if (text.empty() || text.size() > 9 || text.find_first_not_of("0123456789") != std::string::npos)
        throw Usage_error("--show " + text + ": give a cell's number, or a point X,Y,Z of one; may be repeated");
      named.push_back(static_cast<Cell_id>(std::stoul(text)));
    }
    const auto found =
        std::find_if(named.begin(), named.end(), [&](Cell_id cell) { return cell < asked.size() && asked[cell] != 0; });
    if (found == named.end())
      throw Usage_error(
          fmt::format("--show {}: no such cell, or one that is not asked about; `pvs --out FILE.csv` "
                      "lists those that are",
                      text));
    cells.push_back(*found);
  }
  return cells;
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

/// How the pairs of the table were decided; of one that was there before, what it says.
void print(const Table_maker* of_now, const Table_facts& facts, bool cells_too) {
  if (of_now == nullptr) {
    row("pairs", fmt::format("{} of a cell and a face visible, {} undecided", facts.visible, facts.undecided));
    if (cells_too)
      row("", fmt::format("{} of two cells: {} see each other, {} undecided", facts.cells_pairs, facts.cells_visible,
                          facts.cells_undecided));
    return;
  }
  const Table_maker& maker = *of_now;
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
}

void print_groups(const Table_facts& facts) {
  if (!facts.names) return;
  std::size_t pairs = 0;
  for (const Group_row& group : facts.groups) pairs += group.visible.size();
  row(facts.names->words,
      fmt::format("{} have cells that are asked about; {} pairs of one of them and a face are visible; "
                  "--json - lists them",
                  facts.groups.size(), pairs));
}

Exit run_pvs(const Pvs_arguments& given, Ranks& ranks) {
  Pvs_arguments arguments = given;
  const Common& common = arguments.common;
  const bool into_level = ending_of(arguments.out) == ".bsp";
  if (!ranks.is_alone() && into_level)
    throw Usage_error("--out FILE.bsp is asked of one process: call it without mpirun, with the --table that one made");
  if (into_level) return run_into_level(arguments);
  if (!ranks.is_alone() && (common.scene == "-" || arguments.cells == "-" || arguments.table == "-"))
    throw Usage_error("of several processes one alone has a standard input: name a file that all can read");
  const Shard own = arguments.table.empty() ? shard_of(arguments.shard) : Shard{};
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
  if (ranks.is_first()) {  // while there is no table yet to lose
    if (division.kind == Division::Kind::regions) division.known_regions = division.groups(level, in_time);
    if (!arguments.outside) check_leaks(common, level);
    arguments.show = shown_cells(arguments, level);
  }
  const double cells_seconds = watch.seconds();

  // 2. What they see.
  std::optional<Table_maker> maker;
  Visibility_table table;
  if (arguments.table.empty()) {
    maker.emplace(arguments, division, soup, level, limit);
    const bool in_blocks = arguments.resume || !ranks.is_alone();
    table = in_blocks ? maker->make_in_blocks(own, ranks) : maker->make(own);
    maker->clear();
  } else if (ranks.is_first()) {
    table = saved_table(arguments, soup, division);
    arguments.cells_too = table.has_cells();
  }
  if (!ranks.is_first()) {
    if (!arguments.certificates.empty()) write_certificates(arguments, level, table, limit, own, ranks);
    return Exit::done;
  }
  const double seconds = watch.seconds() - cells_seconds;
  const Table_facts facts = facts_of(table, division, level);

  // 3. What is written.
  if (!arguments.out.empty())
    write_table(arguments.out, table,
                facts.names ? Json{{facts.names->all, groups_json(facts.groups, division, *facts.names)}} : Json{});
  if (!arguments.svg.empty()) draw(arguments, soup, level, table);
  if (!arguments.obj.empty() || !arguments.mesh.empty())
    write_drawings(arguments.obj, arguments.mesh, drawing_of_table(level, table, arguments.show));
  if (!arguments.html.empty()) write_page(arguments, level, table);
  const bool all_proved =
      arguments.certificates.empty() || write_certificates(arguments, level, table, limit, own, ranks);
  if (maker && arguments.resume && facts.is_decided() && all_proved) maker->remove_kept();
  const Exit exit = !facts.is_decided() || !all_proved ? Exit::undecided : Exit::done;
  const std::uint32_t blocks_kept = maker ? maker->blocks_kept() : table_blocks;
  const double pairs_seconds = maker ? maker->cell_seconds() : 0;
  Json counters = counters_json(maker ? maker->counters() : Pvs_counters{});
  counters["cells"] = counters_json(level.counters());
  if (arguments.cells_too)
    counters["pairs_of_cells"] = counters_json(maker ? maker->cell_counters() : Cell_pvs_counters{});
  if (write_json(common, "pvs", level.scene(), result_json(arguments, level, division, table, facts, blocks_kept),
                 std::move(counters), {{"cells", cells_seconds}, {"pvs", seconds}, {"pairs_of_cells", pairs_seconds}}))
    return exit;

  // 4. For people.
  scene_rows(level.scene());
  row("cells", fmt::format("{} of {} are asked about", table.rows.size(), level.counters().cells));
  print(maker ? &*maker : nullptr, facts, arguments.cells_too);
  print_groups(facts);
  if (arguments.resume)
    row("resumed",
        fmt::format(
            "{} of {} blocks were there{}", blocks_kept, table_blocks,
            facts.is_decided() ? "" : "; those that are decided are kept, and the same command goes on from there"));
  for (const Cell_id cell : arguments.show) {
    row(fmt::format("cell {}", cell), fmt::format("sees {}", fmt::join(table.row_of(cell)->visible, " ")));
    if (arguments.cells_too) row("", fmt::format("and cells {}", fmt::join(table.row_of(cell)->cells, " ")));
  }
  row("seconds",
      fmt::format("{:.3f} for cells, {:.3f} for what they see{}", cells_seconds, seconds,
                  arguments.cells_too ? fmt::format(", {:.3f} of it for pairs of cells", pairs_seconds) : ""));
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
  const Option table =
      command
          .add_option("--table", a->table,
                      "the whole table that `pvs` or `merge` wrote of SCENE with the same options: show, draw, prove "
                      "and write that, and ask nothing again")
          .reads_file();
  command.add_option("--show", a->shown, "print what this cell sees, or that of a point X,Y,Z; may be repeated");
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
  const Option shard = command.add_option(
      "--shard", a->shard,
      "I/N: the faces, pairs whose lower cell, and cells with certificates, are each I-th of N; by default what "
      "SLURM_ARRAY_TASK_ID and _COUNT say");
  const Option resume =
      command.add_flag("--resume", a->resume,
                       "keep blocks of faces beside --out, and cells with certificates in their folder, and do not ask "
                       "again what they hold");
  for (const Option& of_asking : {shard, resume}) table.excludes(of_asking);
  command.footer(
      "Example: sightline pvs level.map --out level.pvs\n"
      "         for i in 0 1 2 3; do sightline pvs level.map --shard $i/4 --out part$i.pvs --resume & done; wait\n"
      "         sightline merge part?.pvs --out level.pvs\n"
      "         mpirun -n 3 sightline pvs level.map --threads 1 --resume --out level.pvs\n"
      "         sightline pvs level.map --table level.pvs --show 64,64,24 --svg seen.svg\n"
      "         sightline pvs level.bsp --out better.bsp\n"
      "Cells are those of `sightline cells` with the same --candidates, --seed, --leaves, --grid and --volumes; with "
      "--cells FILE, whatever --seed is. Exit "
      "code 4: pairs are undecided; in a .bsp their leaves see each other.");
  command.set_action([a] { return Ranks::together([&](Ranks& ranks) { return run_pvs(*a, ranks); }); });
}

}  // namespace sightline::app
