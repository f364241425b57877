#include "cell_index.h"

#include "../support/files.h"

#include <sightline/algorithms/verify/written_out.h>
#include <sightline/io/file.h>
#include <sightline/io/input.h>

#include <limits>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>
#include <utility>

namespace sightline::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* index_format = "sightline pvs certificates 3";
constexpr const char* part_format = "sightline pvs certificates 3, part";

fs::path index_of(const fs::path& folder) { return folder / "index.json"; }
fs::path part_of_index(const fs::path& folder, const Shard& shard) {
  return folder / fmt::format("index-{}-of-{}.json", shard.shard, shard.shards);
}

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

}  // namespace

Json asked_entry(std::uint64_t cell, const Cell_statement& statement, const std::string& certificate,
                 const Certificate_facts& facts) {
  Json entry{{"cell", cell}, {"within", statement.within}, {"certificate", certificate}, {"unproved", facts.unproved}};
  if (facts.sum) entry["sum"] = *facts.sum;
  state_walls(entry, statement);
  return entry;
}

Json other_entry(std::uint64_t cell, const Cell_statement& statement) {
  Json entry{{"cell", cell}};
  state_walls(entry, statement);
  return entry;
}

void write_index(const fs::path& folder, const std::string& question, const Shard& own, bool all_decided, Json cells,
                 Json rest) {
  const bool is_whole = own.shards == 1;
  Json index{{"format", is_whole ? index_format : part_format}, {"question", question}};
  if (!is_whole) index["all_decided"] = all_decided;
  index["cells"] = std::move(cells);
  index["rest"] = std::move(rest);
  write_file((is_whole ? index_of(folder) : part_of_index(folder, own)).string(), to_text(index) + "\n");
}

std::map<std::uint64_t, Certificate_facts> facts_in_index(const fs::path& folder, const std::string& question,
                                                          const Shard& own) {
  fs::path file = own.shards == 1 ? index_of(folder) : part_of_index(folder, own);
  if (!fs::is_regular_file(file)) file = index_of(folder);  // of parts that were put together
  std::map<std::uint64_t, Certificate_facts> found;
  if (!fs::is_regular_file(file)) return found;
  try {
    const nlohmann::json json = nlohmann::json::parse(read_own_bytes(file));
    if (json.at("question") != question) return found;
    for (const nlohmann::json& entry : json.at("cells"))
      if (entry.contains("sum"))
        found[entry.at("cell").get<std::uint64_t>()] = {entry.at("unproved").get<std::vector<Face_id>>(),
                                                        entry.at("sum").get<std::uint64_t>()};
  } catch (const nlohmann::json::exception&) {  // it is none, and is made again
    found.clear();
  } catch (const Input_error&) {
    found.clear();
  }
  return found;
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
  for (const char* key : {"cell", "within", "certificate", "unproved", "sum", "corners", "walls"})
    if (entry.contains(key)) ordered[key] = entry[key];
  return ordered;
}

}  // namespace

bool join_index(const fs::path& folder, const std::string& question) {
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
          if (list == &cells && !fs::exists(folder / entry.at("certificate").get<std::string>()))
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
  write_index(folder, question, {}, all_decided, listed(cells), listed(rest));
  for (const fs::path& part : parts) fs::remove(part);
  return all_decided;
}

namespace {

std::uint64_t whole_number_in(const nlohmann::json& value, std::uint64_t most, const char* what) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most)
    throw std::invalid_argument(fmt::format("{} is no whole number up to {}", what, most));
  return value.get<std::uint64_t>();
}

const nlohmann::json& list_in(const nlohmann::json& json, const char* key) {
  const nlohmann::json& list = json.at(key);
  if (!list.is_array()) throw std::invalid_argument(fmt::format("\"{}\" is no list", key));
  return list;
}

/// Of an index of so many bytes, in which so much is written out.
Cell_entry cell_entry(const nlohmann::json& json, const fs::path& folder, bool has_certificate, std::size_t bytes,
                      Written_out& written_out) {
  Cell_entry entry;
  entry.cell = whole_number_in(json.at("cell"), std::numeric_limits<std::uint64_t>::max(), "\"cell\"");
  if (has_certificate) {
    const fs::path name = json.at("certificate").get<std::string>();
    if (name.empty() || name != name.filename() || name == "." || name == "..")
      throw std::invalid_argument("its certificate is no file of this folder");
    entry.file = (folder / name).string();
    for (const nlohmann::json& face : list_in(json, "within"))
      entry.statement.within.push_back(
          static_cast<Face_id>(whole_number_in(face, std::numeric_limits<Face_id>::max(), "a face of \"within\"")));
  }
  std::vector<Exact_point> corners;
  for (const nlohmann::json& corner : list_in(json, "corners")) {
    if (!corner.is_array() || corner.size() != 3) throw std::invalid_argument("a corner has not three coordinates");
    Exact_point& p = corners.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) p[k] = rational_from_string(corner[k].get<std::string>());
  }
  for (const nlohmann::json& wall : list_in(json, "walls")) {
    if (!wall.is_array()) throw std::invalid_argument("a wall is no list of corners");
    std::vector<Exact_point>& polygon = entry.statement.walls.emplace_back();
    for (const nlohmann::json& place : wall) {
      if (!place.is_number_unsigned() || place.get<std::uint64_t>() >= corners.size())
        throw std::invalid_argument("a wall names a corner that there is not");
      if (!written_out.add(corners[place.get<std::size_t>()], bytes))
        throw std::invalid_argument(std::string("corners are ") + Written_out::what_is_too_much);
      polygon.push_back(corners[place.get<std::size_t>()]);
    }
  }
  return entry;
}

}  // namespace

Cell_index read_index(const fs::path& folder) {
  const std::string file = index_of(folder).string();
  if (!fs::exists(file)) {
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().filename().string().starts_with("index-"))
        throw Input_error::of_file(folder.string(),
                                   "has its index in parts, as shards write it; `sightline merge PARTS --out FILE "
                                   "--certificates FOLDER` makes one of them");
    throw Input_error::of_file(
        folder.string(), "is a directory; name a file in it, or a folder that `sightline pvs --certificates` wrote");
  }
  const std::string bytes = read_bytes(file);
  const nlohmann::json json = parse_json(bytes, file);
  Written_out written_out;
  const auto refuse = [&](const std::string& what) {
    throw Input_error::of_file(file, what + "; write the folder again with `sightline pvs --certificates FOLDER`");
  };
  if (!json.is_object() || !json.contains("format") || json["format"] != index_format)
    refuse(fmt::format("its \"format\" is not \"{}\"", index_format));
  Cell_index index;
  if (const auto question = json.find("question"); question != json.end() && question->is_string())
    index.question = question->get<std::string>();
  const auto read = [&](const char* key, std::vector<Cell_entry>& cells) {
    if (!json.contains(key) || !json[key].is_array()) refuse(fmt::format("has no list \"{}\"", key));
    for (std::size_t i = 0; i < json[key].size(); ++i) try {
        cells.push_back(cell_entry(json[key][i], folder, &cells == &index.cells, bytes.size(), written_out));
      } catch (const nlohmann::json::exception&) {
        refuse(fmt::format("entry {} of \"{}\" has not the parts of a cell", i, key));
      } catch (const std::invalid_argument& error) {
        refuse(fmt::format("entry {} of \"{}\": {}", i, key, error.what()));
      }
  };
  read("cells", index.cells);
  read("rest", index.rest);
  std::set<std::uint64_t> numbers;
  std::set<std::string> files;
  for (const std::vector<Cell_entry>* cells : {&index.cells, &index.rest})
    for (const Cell_entry& entry : *cells) {
      if (!numbers.insert(entry.cell).second) refuse(fmt::format("has cell {} twice", entry.cell));
      if (!entry.file.empty() && !files.insert(entry.file).second)
        refuse(fmt::format("names the certificate of cell {} twice", entry.cell));
    }
  if (index.cells.empty()) refuse("names no cells");
  return index;
}

}  // namespace sightline::app
