// sightline merge: the parts of a table together.

#include "../support/files.h"
#include "cell_index.h"
#include "pvs.h"
#include "tables.h"

#include <sightline/io/file.h>

#include <algorithm>

namespace sightline::app {

namespace {

struct Merge_arguments {
  std::vector<std::string> parts;
  std::string out, certificates;
};

Exit run_merge(const Merge_arguments& arguments) {
  if (ending_of(arguments.out) == ".bsp")
    throw Usage_error(
        "--out: a level is no table; write one, and `pvs LEVEL.bsp --leaves --table TABLE --out FILE.bsp` puts that of "
        "--cells-too into a copy of the level");
  std::vector<Visibility_table> parts;
  for (const std::string& file : arguments.parts) {
    if (std::count(arguments.parts.begin(), arguments.parts.end(), file) > 1)
      throw Usage_error("PARTS: " + file + " is named twice; name each part once");
    const std::string bytes = read_input(file);
    parts.push_back(read_table({file, bytes}));
  }
  try {
    const Visibility_table table = merged(parts, arguments.parts);
    const bool all_proved = arguments.certificates.empty() || join_index(arguments.certificates, table.question);
    write_table(arguments.out, table);
    const std::size_t undecided = count_of(table, &Visibility_table::Row::undecided),
                      cells_undecided = count_of(table, &Visibility_table::Row::cells_undecided) / 2;
    if (arguments.out != "-") {
      row("merged",
          fmt::format("{} parts: {} cells, {} faces, {} pairs visible, {} undecided", parts.size(), table.rows.size(),
                      table.faces.size(), count_of(table, &Visibility_table::Row::visible), undecided));
      if (table.has_cells())
        row("", fmt::format("of two cells: {} see each other, {} undecided",
                            count_of(table, &Visibility_table::Row::cells) / 2, cells_undecided));
    }
    return undecided + cells_undecided > 0 || !all_proved ? Exit::undecided : Exit::done;
  } catch (const Merge_error& error) {
    throw std::runtime_error(std::string("merge: ") + error.what());
  }
}

}  // namespace

void add_merge(Command program) {
  const Command command = program.add_command("merge", "Makes one table of the parts that `pvs --shard` wrote");
  auto a = std::make_shared<Merge_arguments>();
  command.add_option("PARTS", a->parts, "tables of one scene, with the same options").required().reads_file();
  command.add_option("--out", a->out, "write the table: .json, .csv, or else binary").required().writes_file();
  command
      .add_option("--certificates", a->certificates,
                  "the folder to which `pvs --shard --certificates` wrote: of its parts of an index make one")
      .check(not_empty());
  command.footer(
      "Refuses parts of other scenes or options, a face twice, and a face in none; then it says which shards "
      "to run again. Exit code 4: pairs are undecided, as `pvs` says.");
  command.set_action([a] { return run_merge(*a); });
}

}  // namespace sightline::app
