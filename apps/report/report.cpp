// sightline report: speed against error, every question to every method and kernel, on families and real scenes.

#include "../support/files.h"
#include "../support/page.h"
#include "answers.h"
#include "examples.h"

#include <sightline/harness/report/page.h>
#include <sightline/harness/report/picture.h>
#include <sightline/io/file.h>

#include <filesystem>
#include <iostream>
#include <map>

namespace sightline::app {

namespace {

namespace fs = std::filesystem;

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
    make_folder(a.keep);
    for (const report::Example& e : report.examples) {
      const fs::path file = fs::path(a.keep) / e.file;
      write_file(file.string(), e.scene);
      if (!e.query.empty()) write_file(fs::path(file).replace_extension(".json").string(), e.query);
    }
  }
  // First what all else can be made of again (--merge).
  if (!a.json.empty()) write_file(a.json, to_text(report::to_json(report), 1) + "\n");
  if (!a.html.empty()) write_file(a.html, report::report_page(report, scenes_within()));
  if (!a.svg.empty()) write_file(a.svg, report::report_picture(report));
  if (!a.quiet) print(report);
}

/// Of a report that is whole.
Exit exit_of(const report::Report& report) {
  const bool broken =
      std::any_of(report.rows.begin(), report.rows.end(), [](const report::Row& row) { return row.broken > 0; });
  return broken ? Exit::disagreement : Exit::done;
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
  report::Report all;
  try {
    all = report::merged(parts);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(std::string("--merge: ") + error.what());
  }
  write(a, all);
  return exit_of(all);
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

/// --merge asks nothing.
void check_merge(const Report_arguments& given) {
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
}

/// Programs of users. Errors: Usage_error where nobody asks their question.
std::vector<Report_program> programs_of(const Report_arguments& a, const Report_limits& limits) {
  std::vector<Report_program> programs;
  for (const std::string& program : a.programs) {
    programs.push_back(report_program(program, limits));
    if (std::find(a.questions.begin(), a.questions.end(), programs.back().question) == a.questions.end())
      throw Usage_error("--program " + program + ": --questions leaves its question out");
  }
  return programs;
}

/// Asks every unit of the shard that is not done. Returns how many the budget leaves open.
std::size_t ask_units(const std::vector<Unit>& units, const Report_asking& asking, const Time_limit& time,
                      Kept_units* kept, std::map<std::size_t, Answered>& done) {
  std::size_t open = 0;
  Progress progress("asking");
  bool is_first = true;  // which is asked whatever the budget, so that to try again comes to an end
  for (const Unit& unit : units) {
    progress(unit.number, units.size());
    if (unit.number % asking.own.shards != asking.own.shard || done.count(unit.number) > 0) continue;
    if (time.is_over() && !is_first) {
      ++open;
      continue;
    }
    is_first = false;
    const Answered& answers = done[unit.number] = answered(unit, asking);
    if (kept != nullptr) kept->add(unit.number, answers);
  }
  return open;
}

/// All that was answered, in the order of units.
report::Report report_of(const Report_arguments& a, const Shard& own, std::size_t units,
                         const std::map<std::size_t, Answered>& done) {
  report::Report report;
  report.asked = asked_json(a);
  report.shard = own.shard;
  report.shards = own.shards;
  report.units = units;
  for (const std::string& name : a.questions) report.questions.push_back({name, report_question(name).error_means});
  for (const auto& [number, answers] : done) {
    report.rows.insert(report.rows.end(), answers.rows.begin(), answers.rows.end());
    for (const auto& [why, count] : answers.not_asked.items())
      report.not_asked[why] = report.not_asked.value(why, std::size_t{0}) + count.get<std::size_t>();
  }
  return report;
}

/// The smallest scenes that show errors, made smaller.
std::vector<report::Example> examples_of(const std::vector<report::Row>& rows, const std::vector<Unit>& units,
                                         const Example_options& options) {
  std::vector<report::Example> examples;
  Progress progress("reducing");
  const std::vector<const report::Row*> wrong = report::smallest_wrong(rows);
  for (std::size_t k = 0; k < wrong.size(); ++k) {
    progress(k, wrong.size());
    const report::Row& row = *wrong[k];
    if (const auto example = example_of(row, units[row.unit].group.make(row.smallest->seed), options))
      examples.push_back(*example);
  }
  return examples;
}

Exit run(const Report_arguments& given) {
  if (given.json.empty() && given.html.empty() && given.svg.empty())
    throw Usage_error("say where the report goes: --html FILE, --json FILE or --svg FILE");
  if (!given.parts.empty()) {
    check_merge(given);
    return merge(given);
  }
  if (given.resume && (given.json.empty() || given.json == "-"))
    throw Usage_error("--resume keeps what is done beside an output: name it with --json FILE");
  if (!given.ask.empty() && (given.scenes.empty() || given.questions.size() != 1))
    throw Usage_error("--ask wants a scene, and its one question in --questions");
  for (const char* question : {"cutset", "pvs"})
    if (!given.ask.empty() && given.questions[0] == question)
      throw Usage_error(fmt::format("--ask: no query says what {} is asked; leave it out", question));
  const Report_arguments a = completed(given);
  Report_asking asking{a, shard_of(a.shard), report_effort(a.quick), {a.limit, a.memory << 20}, {}};
  asking.effort.own_query = !a.ask.empty();
  asking.programs = programs_of(a, asking.limits);

  // 1. Every unit of this shard that is not done.
  const Stopwatch watch;
  const Time_limit time(a.budget);
  const std::vector<Unit> units = units_of(a);
  for (const std::string& output : {a.json, a.html, a.svg}) check_replaceable(output);  // before the work
  const Json contents = contents_json(a, units);
  std::optional<Kept_units> kept;
  std::map<std::size_t, Answered> done;
  if (a.resume) done = kept.emplace(asking).begin(units, contents);
  const std::size_t were_there = done.size();
  const std::size_t open = ask_units(units, asking, time, kept ? &*kept : nullptr, done);
  report::Report report = report_of(a, asking.own, units.size(), done);
  report.contents = contents;
  report.open = open;
  if (open > 0) {
    std::cerr << fmt::format(
        "sightline: undecided: --budget ran out, {} of {} units are open; {}\n", open, done.size() + open,
        a.resume ? "the same command goes on from there" : "with --resume the same command would go on from there");
    write(a, report);
    return Exit::undecided;
  }

  // 2. The smallest scenes that show errors.
  const std::uint64_t tests = a.reduce > 0 ? a.reduce : usual(a.quick).reduce;
  report.examples = examples_of(report.rows, units, {asking.effort, asking.limits, tests, 60, asking.programs});
  report.seconds = watch.seconds();
  write(a, report);
  if (kept) kept->remove();
  if (kept && !a.quiet)
    row("resumed",
        fmt::format("{} of {} units were there{}", were_there, done.size(),
                    kept->changed() == 0
                        ? ""
                        : fmt::format("; {} more were of files that have changed since, and were asked again",
                                      kept->changed())));
  if (!a.quiet) row("seconds", fmt::format("{:.1f}", report.seconds));
  return exit_of(report);
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
  add_json_option(command, a->json, "all rows");
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
  command.add_option(
      "--shard", a->shard,
      "I/N: every N-th row from the I-th, for another machine or process; by default what SLURM_ARRAY_TASK_ID and "
      "_COUNT say");
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
