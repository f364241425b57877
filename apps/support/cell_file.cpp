#include "cell_file.h"

#include "journal.h"

#include <sightline/harness/judge/protocol.h>
#include <sightline/io/input.h>
#include <sightline/io/visibility_table.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/quoted.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <exception>
#include <utility>

namespace sightline::app {

namespace {

constexpr const char* cells_format = "sightline cells 1";
constexpr std::array<const char*, 5> division_names{"faces", "leaves", "grid", "volumes", "coarse"};  // by kind

/// Points once, by number; with the convex region of each cell where there are regions.
Json cells_json(const Level_cells& level, const std::vector<std::uint32_t>& regions) {
  Json points = Json::array(), cells = Json::array(), walls = Json::array();
  for (const Exact_point& p : level.points()) points.push_back(point_json(p));
  for (const Level_cell& cell : level.cells())
    cells.push_back({{"solid", cell.is_solid},
                     {"outside", cell.is_outside},
                     {"winding", cell.winding},
                     {"region", cell.region},
                     {"leaf", cell.leaf},
                     {"faces", Json(cell.faces)},
                     {"walls", Json(cell.walls)}});
  for (std::size_t c = 0; c < regions.size(); ++c)
    cells[c]["convex_region"] = regions[c] == no_cell ? Json() : Json(regions[c]);
  for (const Cell_wall& wall : level.walls()) {
    Json open = Json::array();
    for (const std::vector<std::uint32_t>& part : wall.open) open.push_back(Json(part));
    Json faces = Json::array({Json(wall.faces_front), Json(wall.faces_behind)});
    walls.push_back({{"cells", Json::array({Json(wall.front), wall.behind == no_cell ? Json() : Json(wall.behind)})},
                     {"corners", Json(wall.corners)},
                     {"open", std::move(open)},
                     {"faces", std::move(faces)}});
  }
  return {{"points", std::move(points)}, {"cells", std::move(cells)}, {"walls", std::move(walls)}};
}

Json tree_json(const Space_tree& tree) {
  Json nodes = Json::array(), corners = Json::array();
  for (const Space_tree::Node& node : tree.nodes) {
    Json plane = Json::array();
    for (const Rational& x : node.plane) plane.push_back(to_string(x));
    nodes.push_back({std::move(plane), node.children[0], node.children[1]});
  }
  for (const Exact_point& p : tree.corners) corners.push_back(point_json(p));
  return {{"root", tree.root}, {"nodes", std::move(nodes)}, {"corners", std::move(corners)}};
}

/// What damage to how cells were made changes.
std::string sum_of(nlohmann::json made) {
  made.erase("sum");
  return hash_of_bytes(made.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string scene_name(const Polygon_soup& soup) { return fmt::format("{:016x}", fingerprint(soup)); }

}  // namespace

std::string cells_text(const Level_cells& level, const Polygon_soup& soup, const Division& division,
                       const std::vector<std::uint32_t>& regions) {
  Json made{{"scene", scene_name(soup)},         {"by", division_names.at(static_cast<std::size_t>(division.kind))},
            {"candidates", division.candidates}, {"seed", division.seed},
            {"question", division.question()},   {"grid", division.counts},
            {"volumes", division.volumes},       {"coarse", division.regions},
            {"tree", tree_json(division.tree)}};
  made["sum"] = sum_of(made);
  Json json{{"format", cells_format}, {"scene", level.scene().file()}, {"made", std::move(made)}};
  json.update(cells_json(level, regions));
  return to_text(json) + "\n";
}

void Cell_file::fail(const std::string& what) const {
  throw Input_error::of_file(file_, what + "; write it with `sightline cells SCENE --out FILE`");
}

/// Nodes are below one node, or none, and each is there.
void Cell_file::read_tree(const nlohmann::json& tree) {
  Space_tree& to = division_.tree;
  for (const nlohmann::json& node : tree.at("nodes")) {
    Space_tree::Node& read = to.nodes.emplace_back();
    for (std::size_t k = 0; k < 4; ++k) read.plane.at(k) = judge::number_from_json(node.at(0).at(k), "plane");
    for (std::size_t k = 0; k < 2; ++k) node.at(k + 1).get_to(read.children.at(k));
    if (sgn(read.plane[0]) == 0 && sgn(read.plane[1]) == 0 && sgn(read.plane[2]) == 0) fail("a node has no plane");
  }
  for (const nlohmann::json& p : tree.at("corners")) to.corners.push_back(judge::point_from_json(p, "corner"));
  tree.at("root").get_to(to.root);
  std::vector<char> is_known(to.nodes.size(), 0);
  std::vector<std::int32_t> open{to.root};
  while (!open.empty()) {
    const std::int32_t number = open.back();
    open.pop_back();
    if (number < 0) continue;
    const auto n = static_cast<std::size_t>(number);
    if (n >= to.nodes.size() || std::exchange(is_known[n], 1) != 0) fail("its nodes are no tree");
    open.insert(open.end(), to.nodes[n].children.begin(), to.nodes[n].children.end());
  }
}

/// Makes the division again by the options that the file names; a tree of volumes is taken as it is.
void Cell_file::read_made(const nlohmann::json& made, const Common& common, const Polygon_soup& soup) {
  const auto by = std::find(division_names.begin(), division_names.end(), made.at("by").get<std::string>());
  if (by == division_names.end()) fail("does not say how its cells were made");
  const auto kind = static_cast<Division::Kind>(by - division_names.begin());
  Common as_made = common;
  Division_arguments arguments;
  made.at("seed").get_to(as_made.seed);
  made.at("candidates").get_to(arguments.candidates);
  if (arguments.candidates == 0 || arguments.candidates > 1000) fail("no such number of candidates");
  arguments.leaves = kind == Division::Kind::leaves;
  if (kind == Division::Kind::boxes)
    arguments.grid = fmt::format("{}", fmt::join(made.at("grid").get<std::array<std::uint32_t, 3>>(), ","));
  if (kind == Division::Kind::regions) made.at("coarse").get_to(arguments.coarse);
  division_ = arguments.division(as_made, soup);
  if (kind != Division::Kind::volumes) return;
  division_.kind = kind;
  made.at("volumes").get_to(division_.volumes);
  read_tree(made.at("tree"));
}

Cell_file::Cell_file(const std::string& file, const Common& common, const Polygon_soup& soup) : file_(file) {
  json_ = parse_json(read_input(file), file);
  if (!json_.is_object() || json_.value("format", nlohmann::json()) != cells_format) fail("is no file of cells");
  if (!json_.contains("made")) fail("does not say how its cells were made, as older files of cells do not");
  try {
    const nlohmann::json& made = json_.at("made");
    if (made.at("scene") != scene_name(soup))
      throw Input_error::of_file(
          file, fmt::format("its cells are of another scene, {}; give that, or write the cells of {} with `sightline "
                            "cells SCENE --out FILE`, with the same --coordinates and --flip",
                            printable(json_.at("scene").get<std::string>(), 400, false), soup.file));
    if (made.at("sum") != sum_of(made)) fail("is damaged");
    read_made(made, common, soup);
  } catch (const Input_error&) {
    throw;
  } catch (const Usage_error& error) {  // what is not asked of this scene
    fail(error.what());
  } catch (const std::exception&) {
    fail("is damaged");
  }
}

std::vector<std::uint32_t> Cell_file::checked_regions(const Level_cells& level) const {
  std::vector<std::uint32_t> regions;
  if (division_.kind == Division::Kind::regions) regions = division_.groups(level);
  const nlohmann::json cells = cells_json(level, regions);
  for (const char* list : {"points", "cells", "walls"}) {
    const nlohmann::json said = json_.value(list, nlohmann::json());
    if (said == cells[list]) continue;
    std::size_t k = 0;
    while (said.is_array() && k < std::min(said.size(), cells[list].size()) && said[k] == cells[list][k]) ++k;
    fail(fmt::format("is damaged: of its {} number {} is not what the scene has", list, k));
  }
  return regions;
}

}  // namespace sightline::app
