// sightline report: speed against error, every question to every method and kernel, on families and real scenes.

#include "examples.h"

#include "../judge/cases.h"
#include "../support/journal.h"
#include "../support/shard.h"

#include <sightline/harness/generate/families.h>
#include <sightline/harness/report/page.h>
#include <sightline/harness/report/picture.h>
#include <sightline/harness/report/report.h>
#include <sightline/io/file.h>
#include <sightline/io/read.h>

#include <filesystem>
#include <iostream>
#include <map>
#include <set>

namespace sightline::app {

namespace {

namespace fs = std::filesystem;

struct Report_arguments {
  std::vector<std::string> scenes;
  std::vector<std::string> questions, families, distances, programs, parts;
  std::vector<std::size_t> sizes;
  std::string ask, json, html, svg, keep, shard;
  bool quick = false, resume = false, quiet = false;  // quiet: an output takes standard output
  std::uint64_t cases = 0, seed = 1, memory = 1024, reduce = 0;
  double limit = 0, budget = 0;
  std::optional<Command> command;
};

// ---- What is asked

/// The distance of scenes of files.
constexpr const char* as_given = "as given";

/// What is chosen where an option is not given.
struct Usual {
  std::vector<std::string> families, distances;
  std::vector<std::size_t> sizes;
  std::uint64_t cases, reduce;
  double limit;
};
Usual usual(bool quick) {
  if (quick)
    return {{"hinged", "boxes", "cyclic", "edge_on", "leaves", "touching_faces", "triangles_between_squares",
             "city_rotated", "convex_sphere"},
            {"0", "1", "-1", "1000", "-1000", "far"},
            {0, 20},
            1,
            60,
            2};
  std::vector<std::string> all;
  for (const generate::Family& family : generate::families())
    if (!family.holes) all.push_back(family.name);
  return {all, {"0", "1", "-1", "1000", "-1000", "far"}, {0, 50, 200}, 3, 1000, 10};
}

/// A row's place: a question, and where its cases come from.
struct Unit {
  std::size_t number;
  const Report_question* question;
  std::size_t size;
  Case_group group;
  bool is_of_a_folder = false;  ///< a scene that nobody named: what cannot be read is passed over
};

std::size_t faces_of(const generate::Family& family, std::size_t size) {
  try {
    return family.make({1, size, 0, {0, 0, 0}, 1}).soup.face_count();
  } catch (const std::invalid_argument&) {
    return 0;
  }
}
/// The family's own size with which it has so many faces, or somewhat more; nothing where it has no such scene.
std::optional<std::size_t> size_with(const generate::Family& family, std::size_t faces) {
  if (faces == 0) return family.small_size;
  constexpr std::size_t most = 1 << 20;
  std::size_t low = 0, high = 1;  // with low it has fewer
  while (faces_of(family, high) < faces) {
    low = high;
    high *= 2;
    if (high > most) return std::nullopt;
  }
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (faces_of(family, middle) < faces ? low : high) = middle;
  }
  if (faces_of(family, high) > 3 * faces) return std::nullopt;
  return high;
}

std::vector<Unit> units_of(const Report_arguments& a) {
  std::vector<Unit> units;
  std::map<std::pair<std::string, std::size_t>, std::optional<std::size_t>> sizes;
  for (const std::string& name : a.questions) {
    const Report_question& question = report_question(name);
    const Case_options options{case_question(name), false, true};
    const auto add = [&](std::size_t size, Case_group group, bool is_of_a_folder = false) {
      units.push_back({units.size(), &question, size, std::move(group), is_of_a_folder});
    };
    for (const std::string& family : a.families)
      for (const std::string& distance : a.distances)
        for (const std::size_t faces : a.sizes) {
          const auto [found, is_new] = sizes.try_emplace({family, faces});
          if (is_new) {
            try {
              found->second = size_with(generate::family(family), faces);
            } catch (const std::invalid_argument& error) {
              throw Usage_error(std::string("--families: ") + error.what());
            }
          }
          if (!found->second || (a.quick && faces > question.quick_size)) continue;
          Case_choice choice;
          choice.families = {family};
          choice.ulps = {distance};
          choice.size = *found->second;
          add(faces, groups_of(choice, options).at(0));
        }
    for (const std::string& scene : a.scenes) {
      Case_choice choice;
      choice.scenes = scene;
      choice.ask = a.ask;
      for (Case_group& group : groups_of(choice, options)) {
        group.distance = as_given;
        add(0, std::move(group), fs::is_directory(scene));
      }
    }
  }
  return units;
}

Json asked_json(const Report_arguments& a) {
  return {{"questions", a.questions}, {"families", a.families}, {"distances", a.distances}, {"sizes", a.sizes},
          {"scenes", a.scenes},       {"ask", a.ask},           {"programs", a.programs},   {"cases", a.cases},
          {"seed", a.seed},           {"limit", a.limit},       {"memory", a.memory},       {"quick", a.quick}};
}

/// A name of what each file holds that is asked about, which is read once, whatever is asked of it; of one that cannot
/// be read, what is said of it where it is asked about.
Json contents_json(const Report_arguments& a, const std::vector<Unit>& units) {
  Json contents = Json::object();
  if (!a.ask.empty()) contents[a.ask] = content_hash(a.ask);
  for (const Unit& unit : units) {
    const std::string& file = unit.group.file;
    if (file.empty() || contents.contains(file)) continue;
    try {
      contents[file] = identity(unit.group);
    } catch (const Input_error& error) {
      contents[file] = error.what();
    }
  }
  return contents;
}

// ---- Asking

/// Rows of a unit, and what was not asked.
struct Answered {
  std::vector<report::Row> rows;
  Json not_asked = Json::object();
};

/// The rows of one unit while its cases are asked.
class Table {
 public:
  explicit Table(const Unit& unit, std::uint64_t seed) : unit_(unit), seed_(seed) {}

  void add(const Json& name, const Verdict& v, std::uint64_t seed, std::size_t faces) {
    if (v.kind == Verdict::not_asked) return;
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
    row.wrong += v.kind == Verdict::wrong;
    row.abstained += v.kind == Verdict::abstained;
    row.crashed += v.kind == Verdict::crashed;
    row.stopped += v.kind == Verdict::stopped;
    row.broken += v.broken;
    if (v.kind == Verdict::crashed || v.kind == Verdict::stopped) return;
    found->seconds.push_back(v.seconds);
    row.worst_seconds = std::max(row.worst_seconds, v.seconds);
    row.peak_bytes = std::max(row.peak_bytes, v.peak_bytes);
    row.error += v.error;
    row.worst_error = std::max(row.worst_error, v.error);
    if (v.kind == Verdict::wrong && (!row.smallest || faces < row.smallest->faces))
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

Answered answered(const Unit& unit, const Report_arguments& a, const Report_effort& effort, const Report_limits& limits,
                  const std::vector<Report_program>& programs) {
  Answered answers;
  Table table(unit, a.seed);
  const std::string scene = unit.group.distance == as_given ? unit.group.family + ": " : "";
  const auto leave_out = [&](const std::string& reason) {
    const std::string why = scene + reason;
    answers.not_asked[why] = answers.not_asked.value(why, std::size_t{0}) + 1;
  };
  for (std::uint64_t seed = a.seed; seed < a.seed + a.cases; ++seed) {
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
      Compare_arguments arguments = unit.question->arguments(*asked, effort);
      arguments.common.seed = seed;
      arguments.common.threads = 1;
      arguments.common.budget = limits.seconds;
      const std::unique_ptr<Trial> trial = unit.question->trial(arguments, asked->soup);
      for (const Contestant& contestant : trial->contestants)
        table.add(contestant.name, verdict_of(*unit.question, *trial, contestant, faces, limits), seed, faces);
      for (const Report_program& program : programs) {
        if (program.question != unit.question->name) continue;
        const Contestant contestant = contestant_of(program, asked, seed);
        table.add(contestant.name, verdict_of(*unit.question, *trial, contestant, faces, limits), seed, faces);
      }
    } catch (const Out_of_budget&) {
      leave_out("the truth takes longer than --limit");
    } catch (const Usage_error& error) {
      if (std::string_view(error.what()).starts_with("--program")) throw;
      leave_out(error.what());
    } catch (const std::invalid_argument& error) {
      leave_out(error.what());
    }
  }
  answers.rows = table.rows();
  return answers;
}

// ---- What is done already

/// What is done, in a file beside --json, a unit a line, until the report is written whole.
class Kept_units {
 public:
  Kept_units(const Report_arguments& a, const Json& asked, const Shard& own,
             const std::vector<Report_program>& programs)
      : journal_(a.json + ".units", resumed_head("report", asked_by_option(a, asked, own, programs))) {}

  /// What was answered of these units before, where their scenes' files are what they were, as contents_json() has
  /// them; and goes on behind it.
  std::map<std::size_t, Answered> begin(const std::vector<Unit>& units, const Json& contents) {
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
  void add(std::size_t unit, const Answered& answers) {
    Json rows = Json::array();
    for (const report::Row& row : answers.rows) rows.push_back(report::to_json(row));
    journal_.add(
        {{"unit", unit}, {"of", identities_[unit]}, {"rows", std::move(rows)}, {"not_asked", answers.not_asked}});
  }
  void remove() { journal_.remove(); }
  std::size_t changed() const { return changed_.size(); }  ///< units that were answered of another scene

 private:
  static Json asked_by_option(const Report_arguments& a, const Json& asked, const Shard& own,
                              const std::vector<Report_program>& programs) {
    Json named = Json::object();
    for (const auto& [option, value] : asked.items()) named[option == "scenes" ? "SCENES" : "--" + option] = value;
    if (!a.ask.empty()) named["--ask"] = a.ask + ' ' + content_hash(a.ask);
    Json files = Json::object();
    for (const Report_program& program : programs) files.update(hashes_of_words(split_words(program.command)));
    named["--program's files"] = std::move(files);
    named["--shard"] = fmt::format("{}/{}", own.shard, own.shards);
    return named;
  }

  Journal journal_;
  std::vector<std::string> identities_;
  std::set<std::size_t> changed_;
};

// ---- Output

std::string share_text(std::size_t part, std::size_t all) {
  return part == 0 ? "-" : fmt::format("{:.1f}%", 100.0 * static_cast<double>(part) / static_cast<double>(all));
}

void print(const report::Report& report) {
  const std::string line = "{:<9} {:<24} {:<8} {:>10} {:>10} {:>8} {:>9} {:>9} {:>7} {:>9} {:>7} {:>7}\n";
  std::cout << fmt::format(fmt::runtime(line), "question", "method", "kernel", "median s", "worst s", "peak MB",
                           "error", "worst", "wrong", "abstained", "crashed", "stopped");
  for (const report::Summary& s : report::summaries(report.rows))
    std::cout << fmt::format(
        fmt::runtime(line), s.who.question, s.who.method, s.who.kernel,
        s.seconds ? fmt::format("{:.6f}", *s.seconds) : "-", fmt::format("{:.6f}", s.worst_seconds),
        fmt::format("{:.1f}", static_cast<double>(s.peak_bytes) / 1e6), fmt::format("{:.2g}", s.error),
        fmt::format("{:.2g}", s.worst_error), share_text(s.wrong, s.cases), share_text(s.abstained, s.cases),
        share_text(s.crashed, s.cases), share_text(s.stopped, s.cases));
  for (const report::Example& e : report.examples)
    row("smallest",
        fmt::format("{} {} {}: {} faces: {}", e.who.question, e.who.method, e.who.kernel, e.faces, e.again));
  for (const auto& [why, count] : report.not_asked.items())
    row("not asked", fmt::format("{} cases: {}", count.get<std::size_t>(), why));
}

void write(const Report_arguments& a, const report::Report& report) {
  if (!a.keep.empty()) {
    std::error_code error;
    fs::create_directories(a.keep, error);
    if (error) throw std::runtime_error(a.keep + ": cannot be made (" + error.message() + "); name another folder");
    for (const report::Example& e : report.examples) {
      const fs::path file = fs::path(a.keep) / e.file;
      write_file(file.string(), e.scene);
      if (!e.query.empty()) write_file(fs::path(file).replace_extension(".json").string(), e.query);
    }
  }
  if (!a.html.empty()) write_file(a.html, report::report_page(report));
  if (!a.svg.empty()) write_file(a.svg, report::report_picture(report));
  if (!a.json.empty()) write_file(a.json, to_text(report::to_json(report), 1) + "\n");
  if (!a.quiet) print(report);
}

Exit merge(const Report_arguments& a) {
  std::vector<report::Report> parts;
  for (const std::string& file : a.parts) {
    try {
      parts.push_back(report::report_from_json(parse_json(read_input(file), file)));
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(file + ": " + error.what() + "; give what `sightline report --json` wrote");
    }
  }
  try {
    write(a, report::merged(parts));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(std::string("--merge: ") + error.what());
  }
  return Exit::done;
}

/// Fills in what was not given.
Report_arguments completed(Report_arguments a) {
  const Usual given = usual(a.quick);
  if (a.questions.empty())
    for (const Report_question& question : report_questions()) a.questions.push_back(question.name);
  if (a.families.empty() && a.scenes.empty()) a.families = given.families;
  if (a.distances.empty()) a.distances = given.distances;
  if (a.sizes.empty()) a.sizes = given.sizes;
  if (a.cases == 0) a.cases = given.cases;
  if (a.limit == 0) a.limit = given.limit;
  return a;
}

Exit run(const Report_arguments& given) {
  if (given.json.empty() && given.html.empty() && given.svg.empty())
    throw Usage_error("say where the report goes: --html FILE, --json FILE or --svg FILE");
  if (!given.parts.empty()) {
    if (!given.scenes.empty() || given.resume || !given.shard.empty())
      throw Usage_error("--merge asks nothing: leave out scenes, --shard and --resume");
    for (const auto& [option, is_given] : {std::pair("--questions", !given.questions.empty()),
                                           {"--families", !given.families.empty()},
                                           {"--distances", !given.distances.empty()},
                                           {"--sizes", !given.sizes.empty()},
                                           {"--program", !given.programs.empty()},
                                           {"--ask", !given.ask.empty()},
                                           {"--cases", given.cases != 0},
                                           {"--limit", given.limit != 0},
                                           {"--budget", given.budget != 0},
                                           {"--reduce", given.reduce != 0},
                                           {"--quick", given.quick}})
      if (is_given) throw Usage_error(std::string("--merge asks nothing: leave out ") + option);
    return merge(given);
  }
  if (given.resume && (given.json.empty() || given.json == "-"))
    throw Usage_error("--resume keeps what is done beside an output: name it with --json FILE");
  if (!given.ask.empty() && (given.scenes.empty() || given.questions.size() != 1))
    throw Usage_error("--ask wants a scene, and its one question in --questions");
  const Report_arguments a = completed(given);
  const Report_limits limits{a.limit, a.memory << 20};
  const Report_effort effort = report_effort(a.quick);
  const Shard own = shard_of(a.shard);
  const auto [shard, shards] = own;
  std::vector<Report_program> programs;
  for (const std::string& program : a.programs) {
    programs.push_back(report_program(program, limits));
    if (std::find(a.questions.begin(), a.questions.end(), programs.back().question) == a.questions.end())
      throw Usage_error("--program " + program + ": --questions leaves its question out");
  }

  // 1. Every unit of this shard that is not done.
  const Stopwatch watch;
  const std::vector<Unit> units = units_of(a);
  std::optional<Kept_units> kept_units;
  std::map<std::size_t, Answered> done;
  const Json contents = contents_json(a, units);
  if (a.resume) done = kept_units.emplace(a, asked_json(a), own, programs).begin(units, contents);
  const std::size_t kept = done.size();
  report::Report report;
  {
    Progress progress("asking");
    bool is_first = true;  // which is asked whatever the budget, so that to try again comes to an end
    for (const Unit& unit : units) {
      progress(unit.number, units.size());
      if (unit.number % shards != shard || done.count(unit.number) > 0) continue;
      if (a.budget > 0 && watch.seconds() > a.budget && !is_first) {
        ++report.open;
        continue;
      }
      is_first = false;
      const Answered& answers = done[unit.number] = answered(unit, a, effort, limits, programs);
      if (kept_units) kept_units->add(unit.number, answers);
    }
  }
  report.asked = asked_json(a);
  report.contents = contents;
  report.shard = shard;
  report.shards = shards;
  report.units = units.size();
  for (const std::string& name : a.questions) report.questions.push_back({name, report_question(name).error_means});
  bool broken = false;
  for (const auto& [number, answers] : done) {
    for (const report::Row& row : answers.rows) {
      report.rows.push_back(row);
      broken = broken || row.broken > 0;
    }
    for (const auto& [why, count] : answers.not_asked.items())
      report.not_asked[why] = report.not_asked.value(why, std::size_t{0}) + count.get<std::size_t>();
  }
  if (report.open > 0) {
    std::cerr << fmt::format(
        "sightline: undecided: --budget ran out, {} of {} units are open; {}\n", report.open, done.size() + report.open,
        a.resume ? "the same command goes on from there" : "with --resume the same command would go on from there");
    write(a, report);
    return Exit::undecided;
  }

  // 2. The smallest scenes that show errors.
  const Example_options options{effort, limits, a.reduce > 0 ? a.reduce : usual(a.quick).reduce, 60, programs};
  {
    Progress progress("reducing");
    const std::vector<const report::Row*> wrong = report::smallest_wrong(report.rows);
    for (std::size_t k = 0; k < wrong.size(); ++k) {
      progress(k, wrong.size());
      if (const auto example =
              example_of(*wrong[k], units[wrong[k]->unit].group.make(wrong[k]->smallest->seed), options))
        report.examples.push_back(*example);
    }
  }
  report.seconds = watch.seconds();
  write(a, report);
  if (kept_units) kept_units->remove();
  if (kept_units && !a.quiet)
    row("resumed",
        fmt::format("{} of {} units were there{}", kept, done.size(),
                    kept_units->changed() == 0
                        ? ""
                        : fmt::format("; {} more were of files that have changed since, and were asked again",
                                      kept_units->changed())));
  if (!a.quiet) row("seconds", fmt::format("{:.1f}", report.seconds));
  return broken ? Exit::disagreement : Exit::done;
}

}  // namespace

void add_report(Command program) {
  const Command command = program.add_command(
      "report", "Speed against error on one page: every question to every method and kernel, each in a process apart");
  auto a = std::make_shared<Report_arguments>();
  a->command = command;
  std::vector<std::string> questions;
  for (const Report_question& question : report_questions()) questions.push_back(question.name);
  command
      .add_option(
          "SCENES", a->scenes,
          "scenes, or folders of them, instead of families; with --families beside them. What of a folder cannot be "
          "read is told, and passed over")
      .reads_file();
  command
      .add_option("--ask", a->ask,
                  "of scenes: a file with the query to ask, as --keep writes it, and one question in --questions")
      .reads_file();
  command.add_option("--html", a->html, "write the page to look at").writes_file(".html");
  command.add_option("--json", a->json, "write all rows as JSON to this file, - for standard output").writes_file();
  command.add_option("--svg", a->svg, "write a picture: seconds against errors").writes_file(".svg");
  command.add_option("--questions", a->questions, "which, with commas; by default all")
      .delimiter(',')
      .check(one_of(questions));
  command
      .add_option(
          "--families", a->families,
          "families of scenes, with commas (`sightline generate --help` lists them); by default all that a file "
          "holds, with --quick nine")
      .delimiter(',');
  command
      .add_option("--distances", a->distances,
                  "how far from their degeneracy, in ulps of their size, with commas: 0 (exactly there), a number to "
                  "either side, or far; by default 0,1,-1,1000,-1000,far")
      .delimiter(',');
  command
      .add_option("--sizes", a->sizes,
                  "faces of a scene, about, with commas; 0: as small as the family has them; by default 0,50,200, "
                  "with --quick 0,20")
      .delimiter(',')
      .check(whole_number() & range(0, 1'000'000));
  command.add_option("--program", a->programs,
                     "somebody's program beside the methods: QUESTION=COMMAND, the question order, see, weak, trace or "
                     "boolean, and the command as `sightline judge` takes it; may be repeated");
  command.add_option("--cases", a->cases, "scenes of each family, distance and size; 0: 3, with --quick 1")
      .check(whole_number())
      .show_default();
  command.add_option("--seed", a->seed, "of the first case; the next has the next number")
      .check(whole_number())
      .show_default();
  command.add_option("--limit", a->limit, "seconds for a method on a case; 0: 10, with --quick 2")
      .check(not_negative() & finite_number())
      .show_default();
  command.add_option("--memory", a->memory, "MB for a method on a case")
      .check(whole_number())
      .check(range(1, 1 << 20))
      .show_default();
  command.add_flag("--quick", a->quick, "fewer and smaller scenes: about a minute and a half");
  command
      .add_option("--reduce", a->reduce,
                  "scenes tried to make the smallest one that shows an error smaller; 0: 1000, with --quick 60")
      .check(whole_number())
      .show_default();
  command.add_option("--keep", a->keep, "a folder for these scenes, where their commands are run").check(not_empty());
  command
      .add_option("--budget", a->budget,
                  "seconds for all; 0: no limit. What is not reached is in no row, and the exit code is 4")
      .check(not_negative() & finite_number())
      .show_default();
  command.add_option("--shard", a->shard, "I/N: every N-th row from the I-th, for another machine or process");
  command.add_flag("--resume", a->resume, "keep rows beside --json while they are made, and do not ask again for them");
  command.add_option("--merge", a->parts, "ask nothing: make one report of what all shards wrote with --json")
      .reads_file();
  command.footer(
      "Examples: sightline report --quick --html report.html\n"
      "          sightline report --questions see,render --program \"see=python3 mine.py {scene} {query} {answer}\" "
      "--html report.html\n"
      "          for i in 0 1; do sightline report --shard $i/2 --json part$i.json --resume & done; wait\n"
      "          sightline report --merge part0.json part1.json --html report.html\n"
      "Seconds are of one thread. Exit code 1: a method that claims to be exact erred.");
  command.set_action([a, command] {
    a->quiet = command.writes_standard_output();
    return run(*a);
  });
}

}  // namespace sightline::app
