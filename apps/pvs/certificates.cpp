#include "certificates.h"

#include "../methods/weak.h"
#include "../support/files.h"

#include <sightline/algorithms/levels/stated_cell.h>
#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/io/binary.h>
#include <sightline/io/file.h>
#include <sightline/io/input.h>

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace sightline::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* index_format = "sightline pvs certificates 3";
constexpr const char* part_format = "sightline pvs certificates 3, part";

std::string text_of_index(const std::string& question, Json cells, Json rest) {
  return to_text({{"format", index_format},
                  {"question", question},
                  {"cells", std::move(cells)},
                  {"rest", std::move(rest)}}) +
         "\n";
}

fs::path part_of_index(const fs::path& folder, const Shard& shard) {
  return folder / fmt::format("index-{}-of-{}.json", shard.shard, shard.shards);
}

/// What `--resume` keeps of cells whose certificates are whole: which question they answer, what their bytes add up to,
/// and what they do not prove.
class Kept_cells {
 public:
  Kept_cells(fs::path folder, std::string question, bool keeps)
      : folder_(std::move(folder)), question_(std::move(question)), keeps_(keeps) {}

  static std::string name_of(Cell_id cell) { return fmt::format("cell-{}.json", cell); }
  fs::path certificate(Cell_id cell) const { return folder_ / name_of(cell); }

  /// Nothing where there is no such cell, of this question, with the certificate that was written.
  std::optional<std::vector<Face_id>> unproved_of(Cell_id cell) const {
    if (!keeps_ || !fs::is_regular_file(mark(cell)) || !fs::is_regular_file(certificate(cell))) return std::nullopt;
    try {
      const nlohmann::json json = nlohmann::json::parse(read_own_bytes(mark(cell)));
      if (json.at("question") == question_ && json.at("sum") == sum_of_bytes(read_own_bytes(certificate(cell))))
        return json.at("unproved").get<std::vector<Face_id>>();
    } catch (const nlohmann::json::exception&) {
    } catch (const Input_error&) {
    }
    return std::nullopt;
  }
  void keep(Cell_id cell, std::string_view certificate, const std::vector<Face_id>& unproved) const {
    if (!keeps_) return;
    const Json json{{"question", question_}, {"sum", sum_of_bytes(certificate)}, {"unproved", unproved}};
    write_file(mark(cell).string(), to_text(json) + "\n");
  }
  void forget(const std::vector<Cell_id>& cells) const {
    std::error_code error;
    if (!keeps_) return;
    for (const Cell_id cell : cells) fs::remove(mark(cell), error);
  }

 private:
  fs::path mark(Cell_id cell) const { return folder_ / fmt::format("cell-{}.kept", cell); }

  fs::path folder_;
  std::string question_;
  bool keeps_;
};

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
                        const Time_limit& limit, const Shard& own, Ranks& ranks) {
  const fs::path folder = arguments.certificates;
  if (ranks.is_first()) make_folder(folder);
  const Occluders occluders(level.scene());
  Progress progress("proving");
  // 1. The cells that are asked about, and others, go round among shards.
  std::vector<Cell_id> asked, others;
  std::array<std::size_t, 2> places{};
  for (Cell_id cell = 0; cell < table.cells.size(); ++cell)
    if (places[table.cells[cell]]++ % own.shards == own.shard) (table.cells[cell] ? asked : others).push_back(cell);
  // 2. Their certificates, but for those that are there.
  const Kept_cells kept(folder, table.question, arguments.resume && ranks.is_first());
  std::map<Cell_id, std::vector<Face_id>> unproved;
  std::vector<Cell_id> missing;
  for (const Cell_id cell : asked)
    if (auto faces = kept.unproved_of(cell)) unproved[cell] = *std::move(faces);
    else missing.push_back(cell);
  bool all_decided = true;
  ranks.share(
      "certificates", missing, [&](Cell_id cell) { return certificate_of(arguments, level, occluders, limit, cell); },
      [&](Cell_id cell, const std::string& answer) {
        std::vector<Face_id>& faces = unproved[cell];
        progress(unproved.size(), asked.size());
        const auto number = [&](std::size_t i) { return load<std::uint32_t>(answer, 4 * i, std::endian::little); };
        all_decided = all_decided && number(0) == 0;
        faces.resize(number(1));
        for (std::size_t i = 0; i < faces.size(); ++i) faces[i] = number(i + 2);
        const std::string_view certificate = std::string_view(answer).substr(4 * (faces.size() + 2));
        write_file(kept.certificate(cell).string(), certificate);
        if (number(0) == 0) kept.keep(cell, certificate, faces);  // what time left open is asked again
      },
      [&](std::size_t done, std::size_t all) { progress(done, all); });
  if (!ranks.is_first()) return true;
  // 3. The index, or a part of it.
  Json index = Json::array(), rest = Json::array();
  for (const Cell_id cell : asked) {
    const Cell_statement statement = stated_cell(level, cell);
    state_walls(index.emplace_back(Json{{"cell", cell},
                                        {"within", statement.within},
                                        {"certificate", Kept_cells::name_of(cell)},
                                        {"unproved", unproved[cell]}}),
                statement);
  }
  for (const Cell_id cell : others) state_walls(rest.emplace_back(Json{{"cell", cell}}), stated_cell(level, cell));
  progress.clear();
  if (own.shards == 1) {
    write_file((folder / "index.json").string(), text_of_index(table.question, std::move(index), std::move(rest)));
  } else {
    write_file(part_of_index(folder, own).string(), to_text({{"format", part_format},
                                                             {"question", table.question},
                                                             {"all_decided", all_decided},
                                                             {"cells", std::move(index)},
                                                             {"rest", std::move(rest)}}) +
                                                        "\n");
  }
  if (all_decided) kept.forget(asked);
  return all_decided;
}

namespace {

/// The parts of an index that are in a folder: all of one division, or an error that says what is missing.
std::vector<fs::path> parts_in(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw Input_error::of_file(folder.string(),
                               "is no folder; name the one that `pvs --shard --certificates` wrote to");
  std::map<std::uint32_t, std::set<std::uint32_t>> found;  // by how many shards there are
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    static const std::regex pattern("index-([0-9]{1,7})-of-([0-9]{1,7})[.]json");
    const std::string name = entry.path().filename().string();
    std::smatch numbers;
    if (std::regex_match(name, numbers, pattern))
      found[static_cast<std::uint32_t>(std::stoul(numbers[2]))].insert(
          static_cast<std::uint32_t>(std::stoul(numbers[1])));
  }
  if (found.empty())
    throw Input_error::of_file(folder.string(),
                               "has no part of an index; `pvs --shard I/N --certificates FOLDER` writes one");
  if (found.size() > 1)
    throw Input_error::of_file(folder.string(), fmt::format("has parts of {} shards and of {}; remove those of one",
                                                            found.begin()->first, found.rbegin()->first));
  const auto& [shards, there] = *found.begin();
  std::vector<fs::path> parts;
  for (std::uint32_t shard = 0; shard < shards; ++shard) {
    parts.push_back(part_of_index(folder, {shard, shards}));
    if (!there.contains(shard))
      throw Input_error::of_file(parts.back().string(),
                                 fmt::format("is missing; run again --shard {}/{}", shard, shards));
  }
  return parts;
}

/// An entry with its parts in the order of those that are written.
Json in_order(const nlohmann::json& entry) {
  Json ordered;
  for (const char* key : {"cell", "within", "certificate", "unproved", "corners", "walls"})
    if (entry.contains(key)) ordered[key] = entry[key];
  return ordered;
}

}  // namespace

bool join_certificates(const std::string& folder, const std::string& question) {
  std::map<std::uint64_t, Json> cells, rest;
  bool all_decided = true;
  const std::vector<fs::path> parts = parts_in(folder);
  for (const fs::path& part : parts) {
    const std::string file = part.string();
    const nlohmann::json json = parse_json(read_bytes(file), file);
    const auto refuse = [&](const std::string& what) { throw Input_error::of_file(file, what); };
    try {
      if (json.at("format") != part_format) refuse(fmt::format("its \"format\" is not \"{}\"", part_format));
      if (json.at("question") != question)
        refuse(fmt::format("is of another question than the tables: \"{}\", not \"{}\"",
                           json["question"].get<std::string>(), question));
      all_decided = all_decided && json.at("all_decided").get<bool>();
      for (auto* list : {&cells, &rest})
        for (const nlohmann::json& entry : json.at(list == &cells ? "cells" : "rest")) {
          const auto cell = entry.at("cell").get<std::uint64_t>();
          if (cells.contains(cell) || rest.contains(cell))
            refuse(fmt::format("has cell {}, as another part has", cell));
          if (list == &cells && !fs::exists(fs::path(folder) / entry.at("certificate").get<std::string>()))
            refuse(fmt::format("names \"{}\", which is not in the folder", entry["certificate"].get<std::string>()));
          list->emplace(cell, in_order(entry));
        }
    } catch (const nlohmann::json::exception&) {
      refuse("has not the parts of an index; run that shard again");
    }
  }
  const auto listed = [](std::map<std::uint64_t, Json>& entries) {
    Json list = Json::array();
    for (auto& [cell, entry] : entries) list.push_back(std::move(entry));
    return list;
  };
  write_file((fs::path(folder) / "index.json").string(), text_of_index(question, listed(cells), listed(rest)));
  for (const fs::path& part : parts) fs::remove(part);
  return all_decided;
}

}  // namespace sightline::app
