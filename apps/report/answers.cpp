#include "answers.h"

#include <sightline/io/input.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <utility>

namespace sightline::app {

namespace {

/// The rows of one unit while its cases are asked.
class Table {
 public:
  explicit Table(const Unit& unit, std::uint64_t seed) : unit_(unit), seed_(seed) {}

  void add(const Json& name, const Report_verdict& v, std::uint64_t seed, std::size_t faces) {
    if (v.kind == Report_verdict::not_asked) return;
    const report::Contender who{unit_.question->name, method_of(name), name["kernel"].get<std::string>()};
    auto found = std::find_if(lines_.begin(), lines_.end(), [&](const Line& line) { return line.row.who == who; });
    if (found == lines_.end()) {
      found = lines_.insert(lines_.end(), Line());
      report::Row& row = found->row;
      row.unit = unit_.number;
      row.who = who;
      row.family = unit_.group.family;
      row.distance = unit_.group.distance;
      row.size = unit_.size;
      row.seed = seed_;
    }
    report::Row& row = found->row;
    ++row.cases;
    row.faces += static_cast<double>(faces);
    row.wrong += v.kind == Report_verdict::wrong;
    row.abstained += v.kind == Report_verdict::abstained;
    row.crashed += v.kind == Report_verdict::crashed;
    row.stopped += v.kind == Report_verdict::stopped;
    row.broken += v.broken;
    if (v.kind == Report_verdict::crashed || v.kind == Report_verdict::stopped) return;
    found->seconds.push_back(v.seconds);
    row.worst_seconds = std::max(row.worst_seconds, v.seconds);
    row.peak_bytes = std::max(row.peak_bytes, v.peak_bytes);
    row.error += v.error;
    row.worst_error = std::max(row.worst_error, v.error);
    if (v.kind == Report_verdict::wrong && (!row.smallest || faces < row.smallest->faces))
      row.smallest = report::Wrong_case{faces, seed, v.error};
  }

  std::vector<report::Row> rows() {
    std::vector<report::Row> rows;
    for (Line& line : lines_) {
      report::Row& row = rows.emplace_back(line.row);
      row.faces /= static_cast<double>(row.cases);
      if (line.seconds.empty()) continue;
      row.error /= static_cast<double>(line.seconds.size());
      std::sort(line.seconds.begin(), line.seconds.end());
      row.seconds = line.seconds[line.seconds.size() / 2];
    }
    return rows;
  }

 private:
  struct Line {
    report::Row row;
    std::vector<double> seconds;
  };
  const Unit& unit_;
  std::uint64_t seed_;
  std::vector<Line> lines_;
};

Json asked_by_option(const Report_asking& asking) {
  const Report_arguments& a = asking.arguments;
  Json named = Json::object();
  const Json asked = asked_json(a);
  for (const auto& [option, value] : asked.items()) named[option == "scenes" ? "SCENES" : "--" + option] = value;
  if (!a.ask.empty()) named["--ask"] = a.ask + ' ' + content_hash(a.ask);
  Json files = Json::object();
  for (const Report_program& program : asking.programs) files.update(hashes_of_words(split_words(program.command)));
  named["--program's files"] = std::move(files);
  named["--shard"] = fmt::format("{}/{}", asking.own.shard, asking.own.shards);
  return named;
}

}  // namespace

Answered answered(const Unit& unit, const Report_asking& asking) {
  const std::uint64_t first = asking.arguments.seed;
  Answered answers;
  Table table(unit, first);
  const std::string scene = unit.group.distance == as_given ? unit.group.family + ": " : "";
  const auto leave_out = [&](const std::string& reason) {
    const std::string why = scene + reason;
    answers.not_asked[why] = answers.not_asked.value(why, std::size_t{0}) + 1;
  };
  for (std::uint64_t seed = first; seed < first + asking.arguments.cases; ++seed) {
    std::shared_ptr<const Judge_case> asked;
    try {
      asked = std::make_shared<const Judge_case>(unit.group.make(seed));
    } catch (const Input_error& error) {
      if (!unit.is_of_a_folder) throw;
      leave_out(error.what());
      continue;
    }
    if (!asked->not_asked.empty()) {
      leave_out(asked->not_asked);
      continue;
    }
    const std::size_t faces = asked->soup.face_count();
    try {
      Compare_arguments arguments = unit.question->arguments(*asked, asking.effort);
      arguments.common.seed = seed;
      arguments.common.threads = 1;
      arguments.common.budget = asking.limits.seconds;
      const std::unique_ptr<Trial> trial = unit.question->trial(arguments, asked->soup);
      const auto ask = [&](const Contestant& contestant) {
        const Report_verdict verdict = verdict_of(*unit.question, *trial, contestant, faces, asking.limits);
        if (verdict.kind == Report_verdict::not_asked && !verdict.why_not_asked.empty())
          leave_out(verdict.why_not_asked);
        table.add(contestant.name, verdict, seed, faces);
      };
      for (const Contestant& contestant : trial->contestants) ask(contestant);
      for (const Report_program& program : asking.programs)
        if (program.question == unit.question->name) ask(contestant_of(program, asked, seed));
    } catch (const Out_of_budget&) {
      leave_out("the truth takes longer than --limit");
    } catch (const Usage_error& error) {
      const std::string_view what = error.what();
      if (what.starts_with("--program") || what.starts_with("--ask")) throw;  // of the command line, not of the scene
      leave_out(error.what());
    } catch (const std::invalid_argument& error) {
      leave_out(error.what());
    } catch (const std::domain_error& error) {
      leave_out(fmt::format("{}: beyond the range of doubles", error.what()));
    }
  }
  answers.rows = table.rows();
  return answers;
}

Kept_units::Kept_units(const Report_asking& asking)
    : journal_(asking.arguments.json + ".units", resumed_head("report", asked_by_option(asking))) {}

std::map<std::size_t, Answered> Kept_units::begin(const std::vector<Unit>& units, const Json& contents) {
  for (const Unit& unit : units)
    identities_.push_back(
        unit.question->name + ' ' +
        (unit.group.file.empty() ? identity(unit.group) : contents.at(unit.group.file).get<std::string>()));
  std::map<std::size_t, Answered> all;
  for (const nlohmann::json& line : journal_.lines()) try {
      const auto number = line.at("unit").get<std::size_t>();
      if (number >= units.size()) continue;
      if (line.at("of") != identities_[number]) {
        changed_.insert(number);
        continue;
      }
      Answered answers;
      for (const nlohmann::json& row : line.at("rows")) answers.rows.push_back(report::row_from_json(row));
      answers.not_asked = line.at("not_asked");
      all[number] = std::move(answers);
    } catch (const std::exception&) {
      continue;  // no line of ours: its unit is asked again
    }
  for (const auto& [number, answers] : all) changed_.erase(number);
  journal_.begin();
  return all;
}

void Kept_units::add(std::size_t unit, const Answered& answers) {
  Json rows = Json::array();
  for (const report::Row& row : answers.rows) rows.push_back(report::to_json(row));
  journal_.add(
      {{"unit", unit}, {"of", identities_[unit]}, {"rows", std::move(rows)}, {"not_asked", answers.not_asked}});
}

}  // namespace sightline::app
