#include "certificates.h"

#include "../methods/weak.h"
#include "../support/files.h"

#include <sightline/algorithms/levels/stated_cell.h>
#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/io/binary.h>

#include <filesystem>
#include <map>
#include <sstream>

namespace sightline::app {

namespace fs = std::filesystem;

namespace {

/// A cell as what bounds it, for the index: its corners, and its walls as places of these, as seen from outside.
void state_walls(Json& entry, const Cell_statement& statement) {
  std::map<Exact_point, std::size_t> places;
  Json corners = Json::array(), walls = Json::array();
  for (const std::vector<Exact_point>& polygon : statement.walls) {
    Json& wall = walls.emplace_back(Json::array());
    for (const Exact_point& p : polygon) {
      const auto [at, is_new] = places.try_emplace(p, places.size());
      if (is_new) corners.push_back(point_json(p));
      wall.push_back(at->second);
    }
  }
  entry["corners"] = std::move(corners);
  entry["walls"] = std::move(walls);
}

/// What the portals of a cell see outwards: how many faces are undecided, as they are once the budget is over; those
/// that nothing is proved of; then the certificate.
std::string certificate_of(const Pvs_arguments& arguments, const Level_cells& level, const Occluders& occluders,
                           const Time_limit& limit, Cell_id cell) {
  Sources sources;
  for (const std::vector<Exact_point>& portal : portals_of(level, cell)) {
    sources.polygons.push_back(weak_source(occluders, portal));
    sources.points.push_back(portal);
  }
  Weakly_visible found;
  if (!sources.polygons.empty()) {
    Weak_task task;
    task.threads = arguments.common.threads;
    task.seed = arguments.common.seed;
    task.out_of_time = limit.end();
    found = run_weak_method("lines", occluders, sources, task).found;
  }
  std::string bytes;
  store(bytes, static_cast<std::uint32_t>(found.undecided.size()));
  store(bytes, static_cast<std::uint32_t>(found.unproved.size()));
  for (const Face_id face : found.unproved) store(bytes, face);
  std::ostringstream certificate;
  write_certificate(certificate, weak_certificate(level.scene(), sources.points, false, found));
  return bytes + std::move(certificate).str();
}

}  // namespace

bool write_certificates(const Pvs_arguments& arguments, const Level_cells& level, const Visibility_table& table,
                        const Time_limit& limit, Ranks& ranks) {
  const fs::path folder = arguments.certificates;
  if (ranks.is_first()) make_folder(folder);
  const Occluders occluders(level.scene());
  Progress progress("proving");
  std::vector<Cell_id> asked;
  for (Cell_id cell = 0; cell < table.cells.size(); ++cell)
    if (table.cells[cell]) asked.push_back(cell);
  std::map<Cell_id, std::vector<Face_id>> unproved;
  bool all_decided = true;
  const auto name_of = [](Cell_id cell) { return fmt::format("cell-{}.json", cell); };
  ranks.share(
      "certificates", asked, [&](Cell_id cell) { return certificate_of(arguments, level, occluders, limit, cell); },
      [&](Cell_id cell, const std::string& answer) {
        std::vector<Face_id>& faces = unproved[cell];
        progress(unproved.size(), asked.size());
        const auto number = [&](std::size_t i) { return load<std::uint32_t>(answer, 4 * i, std::endian::little); };
        all_decided = all_decided && number(0) == 0;
        faces.resize(number(1));
        for (std::size_t i = 0; i < faces.size(); ++i) faces[i] = number(i + 2);
        write_file((folder / name_of(cell)).string(), std::string_view(answer).substr(4 * (faces.size() + 2)));
      },
      [&](std::size_t done, std::size_t all) { progress(done, all); });
  if (!ranks.is_first()) return true;
  Json index = Json::array(), rest = Json::array();
  for (Cell_id cell = 0; cell < table.cells.size(); ++cell) {
    const Cell_statement statement = stated_cell(level, cell);
    Json entry{{"cell", cell}};
    if (table.cells[cell])
      entry.update({{"within", statement.within}, {"certificate", name_of(cell)}, {"unproved", unproved[cell]}});
    state_walls((table.cells[cell] ? index : rest).emplace_back(std::move(entry)), statement);
  }
  progress.clear();
  write_file((folder / "index.json").string(), to_text({{"format", "sightline pvs certificates 3"},
                                                        {"question", table.question},
                                                        {"cells", std::move(index)},
                                                        {"rest", std::move(rest)}}) +
                                                   "\n");
  return all_decided;
}

}  // namespace sightline::app
