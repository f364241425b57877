// sightline fuzz: random scenes, all methods and all laws, until something disagrees.

#include "fuzz.h"

#include "case_watch.h"
#include "../support/journal.h"
#include "../support/query.h"
#include "../support/shard.h"

#include <sightline/harness/laws/fuzz.h>
#include <sightline/harness/laws/subjects.h>
#include <sightline/io/file.h>
#include <sightline/io/read.h>
#include <sightline/io/write.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/harness/judge/protocol.h>

#include <iostream>

namespace sightline::app {

namespace {

struct Fuzz_arguments {
  std::string command, family, only, check, scene, query, out = "sightline-fuzz", json, shard;
  Scene_format format;                 ///< of the scene
  bool resume = false, quiet = false;  ///< quiet: an output takes standard output
  double seconds = 60, case_seconds = 120;
  std::size_t scenes = 0, reduce_seconds = 120, most_faces = harness::Fuzz_options{}.most_faces;
  std::uint64_t seed = 1;
};

std::vector<harness::Subject> all_subjects() {
  std::vector<harness::Subject> all = harness::subjects();
  all.push_back(io_subject());
  return all;
}
std::vector<std::string> subject_names() {
  std::vector<std::string> names;
  for (const harness::Subject& subject : all_subjects()) names.push_back(subject.name);
  return names;
}

// ---- Reports

Json tallies_json(const std::map<std::string, harness::Tally>& tallies) {
  Json all = Json::object();
  for (const auto& [name, tally] : tallies)
    all[name] = {{"passed", tally.passed}, {"undecided", tally.undecided}, {"not_applicable", tally.not_applicable}};
  return all;
}
/// A number that counts something. Errors: std::exception where it is none: others would be made to fit.
std::size_t count_from_json(const nlohmann::json& value) {
  constexpr std::size_t most = std::size_t{1} << 53;
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > most) throw std::invalid_argument("no count");
  return value.get<std::size_t>();
}
std::map<std::string, harness::Tally> tallies_from_json(const nlohmann::json& all) {
  std::map<std::string, harness::Tally> tallies;
  for (const auto& [name, tally] : all.items())
    tallies[name] = {count_from_json(tally.at("passed")), count_from_json(tally.at("undecided")),
                     count_from_json(tally.at("not_applicable"))};
  return tallies;
}
/// What was found, as reduced_finding() writes it, or null. Errors: std::exception where it is neither.
Json finding_from_json(const nlohmann::json& value) {
  if (value.is_null()) return {};
  for (const char* text : {"case", "check", "what", "replay", "reduced"})
    if (!value.at(text).is_string()) throw std::invalid_argument("no text");
  for (const char* count : {"faces", "faces_reduced", "runs"}) count_from_json(value.at(count));
  if (!value.at("finished").is_boolean()) throw std::invalid_argument("not said");
  return value;
}
void print_tallies(const std::string& title, const std::map<std::string, harness::Tally>& tallies) {
  std::cout << fmt::format("{:<28} {:>10} {:>10} {:>14}\n", title, "passed", "undecided", "not applicable");
  for (const auto& [name, tally] : tallies)
    std::cout << fmt::format("  {:<26} {:>10} {:>10} {:>14}\n", name, tally.passed, tally.undecided,
                             tally.not_applicable);
}
void print_finding(const std::string& where, const std::string& check, const std::string& what) {
  std::cout << fmt::format("DISAGREEMENT in {}, check '{}':\n  {}\n", where, check, what);
}

/// The scene with its question, and the command that replays it.
std::string write_failing(const Fuzz_arguments& arguments, const generate::Posed_scene& scene, std::uint64_t seed,
                          const std::string& check) {
  std::filesystem::create_directories(arguments.out);
  const std::string stem = (std::filesystem::path(arguments.out) / arguments.command).string();
  for (Face_id f = 0; f < scene.soup.face_count(); ++f)
    if (scene.soup.loop_count(f) > 1) return "(not written: no file format holds the holes of its faces)";
  const std::string ending = ".qoff";
  write_scene(scene.soup, stem + ending, Format::qoff);
  write_file(stem + ".json", to_text(harness::query_json(scene, seed), 1) + "\n");
  return fmt::format("sightline fuzz {} --scene {} --query {} --check '{}'", arguments.command, stem + ending,
                     stem + ".json", check);
}

/// What a replay says of --check.
std::string only_check(const Fuzz_arguments& arguments) {
  return arguments.check.empty() ? "" : fmt::format(" --check '{}'", arguments.check);
}

std::string replay_of(const Fuzz_arguments& arguments, const harness::Fuzz_case& which) {
  return fmt::format("sightline fuzz {} --case {}{}", arguments.command, to_string(which), only_check(arguments));
}

/// One scene, be it of a case or of a file: all checks, or the named one.
Exit run_one(const harness::Subject& subject, const generate::Posed_scene& scene, std::uint64_t seed,
             const std::string& where, const std::string& check) {
  std::size_t cases = 0, undecided = 0;
  const auto tell = [&](const std::string& name, const harness::Outcome& outcome) {
    cases += outcome.state != harness::Outcome::State::not_applicable;
    undecided += outcome.state == harness::Outcome::State::undecided;
    static constexpr const char* words[] = {"passed", "failed", "undecided", "not applicable"};
    row(name, words[static_cast<std::size_t>(outcome.state)]);
  };
  if (const auto found = harness::first_disagreement(subject, scene, seed, check, tell)) {
    print_finding(where, found->check, found->what);
    return Exit::disagreement;
  }
  row("cases", fmt::format("{}, {} undecided", cases, undecided));
  return Exit::done;
}

/// What was done of a sequence of scenes, and what came of it.
struct Fuzzed {
  harness::Fuzz_summary summary;
  double seconds = 0;
  Json finding;  // of the summary's last scene; null: none
};

Json fuzzed_json(const harness::Fuzz_summary& summary) {
  return {{"scenes", summary.scenes},
          {"cases", summary.cases},
          {"undecided", summary.undecided},
          {"checks", tallies_json(summary.by_check)},
          {"families", tallies_json(summary.by_family)}};
}

/// What --resume keeps in a file beside --json: how far the sequence was followed, once a second and at the end.
class Kept_fuzzing {
 public:
  Kept_fuzzing(const Fuzz_arguments& arguments, const Shard& own)
      : file_(arguments.json + ".done"),
        head_(resumed_head("fuzz", {{"COMMAND", arguments.command},
                                    {"--seed", arguments.seed},
                                    {"--family", arguments.family},
                                    {"--check", arguments.check},
                                    {"--max-faces", arguments.most_faces},
                                    {"--shard", fmt::format("{}/{}", own.shard, own.shards)}})) {}

  /// Goes on from what is there. Errors: std::runtime_error where it is of another question, or damaged.
  void load(Fuzzed& fuzzed, std::optional<harness::Fuzz_place>& place) const {
    if (!std::filesystem::exists(file_)) return;
    const nlohmann::json found = parse_json(read_own_bytes(file_), file_);
    check_resumed(file_, found, head_);
    try {
      const nlohmann::json& counters = found.at("counters");
      fuzzed.summary = {count_from_json(counters.at("scenes")), count_from_json(counters.at("cases")),
                        count_from_json(counters.at("undecided")), tallies_from_json(counters.at("checks")),
                        tallies_from_json(counters.at("families"))};
      fuzzed.seconds = found.at("seconds").get<double>();
      if (!(fuzzed.seconds >= 0 && fuzzed.seconds < 1e15)) throw std::invalid_argument("no time");
      fuzzed.finding = finding_from_json(found.at("finding"));
      place.emplace(harness::Fuzz_place{harness::Random(0), count_from_json(found.at("drawn"))});
      place->random.set_state(found.at("random").get<std::string>());
    } catch (const std::exception&) {
      throw std::runtime_error(file_ + ": is damaged; delete the file to begin anew");
    }
  }
  void save(const Fuzzed& fuzzed, const harness::Fuzz_place& place) const {
    Json json = head_;
    json.update({{"seconds", fuzzed.seconds},
                 {"drawn", place.drawn},
                 {"counters", fuzzed_json(fuzzed.summary)},
                 {"finding", fuzzed.finding},
                 {"random", place.random.state()}});
    write_file(file_, json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n");
  }

 private:
  std::string file_;
  Json head_;
};

/// What was found, made small and written.
Json reduced_finding(const Fuzz_arguments& arguments, const harness::Subject& subject,
                     const harness::Finding& finding) {
  const std::string replay = replay_of(arguments, finding.which);
  harness::Reduce_options limits;
  const Stopwatch since;
  limits.out_of_time = [&] {
    begin_case(replay, arguments.case_seconds, "making the case small that this replays");
    return since.seconds() > static_cast<double>(arguments.reduce_seconds);
  };
  const harness::Reduced reduced =
      harness::reduce(subject, finding.scene, finding.which.parameters.seed, finding.disagreement, limits);
  end_case();
  return {
      {"case", to_string(finding.which)},
      {"check", finding.disagreement.check},
      {"what", finding.disagreement.what},
      {"replay", replay},
      {"reduced", write_failing(arguments, reduced.scene, finding.which.parameters.seed, finding.disagreement.check)},
      {"faces", finding.scene.soup.face_count()},
      {"faces_reduced", reduced.scene.soup.face_count()},
      {"runs", reduced.tests},
      {"finished", reduced.finished}};
}

Exit run_many(const Fuzz_arguments& arguments, const harness::Subject& subject) {
  const Shard own = shard_of(arguments.shard);
  if (arguments.resume && (arguments.json.empty() || arguments.json == "-"))
    throw Usage_error("--resume keeps what is done beside an output: name it with --json FILE");
  const Kept_fuzzing kept(arguments, own);
  Fuzzed fuzzed;
  harness::Fuzz_options options;
  if (arguments.resume) kept.load(fuzzed, options.from);
  const double seconds_before = fuzzed.seconds;
  const std::size_t scenes_before = fuzzed.summary.scenes;
  Countdown time("fuzzing", arguments.seconds - seconds_before);
  options.seed = arguments.seed;
  options.scenes = arguments.scenes;
  options.shard = own.shard;
  options.shards = own.shards;
  options.family = arguments.family;
  options.check = arguments.check;
  options.most_faces = arguments.most_faces;
  options.out_of_time = [&] { return time.over() && arguments.scenes == 0; };
  options.begin = [&](const harness::Fuzz_case& which) {
    begin_case(replay_of(arguments, which), arguments.case_seconds);
  };
  std::optional<harness::Fuzz_place> place = options.from;
  Stopwatch since_kept;
  if (arguments.resume)
    options.at = [&](const harness::Fuzz_place& at) {
      place = at;
      if (since_kept.seconds() < 1) return;
      fuzzed.seconds = seconds_before + time.seconds();
      kept.save(fuzzed, at);
      since_kept = {};
    };
  if (fuzzed.finding.is_null()) {
    std::optional<harness::Finding> finding;
    try {
      finding = harness::fuzz(subject, options, fuzzed.summary);
    } catch (const std::invalid_argument& error) {
      throw Usage_error(error.what());
    }
    fuzzed.seconds = seconds_before + time.seconds();
    end_case();
    if (finding) fuzzed.finding = reduced_finding(arguments, subject, *finding);
    if (arguments.resume) kept.save(fuzzed, place.value());
  }

  const harness::Fuzz_summary& summary = fuzzed.summary;
  const Json& found = fuzzed.finding;
  if (!arguments.json.empty()) {
    const Json document{
        {"command", "fuzz"},
        {"result",
         {{"subject", subject.name}, {"seed", arguments.seed}, {"shard", {own.shard, own.shards}}, {"finding", found}}},
        {"counters", fuzzed_json(summary)},
        {"seconds", {{"fuzz", fuzzed.seconds}}}};
    write_file(arguments.json, to_text(document, 1) + "\n");
  }
  if (!arguments.quiet) {
    print_tallies("check", summary.by_check);
    print_tallies("family", summary.by_family);
    row("scenes", fmt::format("{} from seed {}", summary.scenes, arguments.seed));
    row("cases", fmt::format("{}, {} undecided; {:.0f} a second", summary.cases, summary.undecided,
                             static_cast<double>(summary.cases) / std::max(fuzzed.seconds, 1e-3)));
    if (options.from) row("resumed", fmt::format("{} scenes of {:.0f} s were there", scenes_before, seconds_before));
    if (!found.is_null()) {
      const auto text = [&](const char* key) { return found.at(key).get<std::string>(); };
      print_finding("case " + text("case"), text("check"), text("what"));
      row("as found", text("replay"));
      row("reduced", fmt::format("from {} faces to {} in {} runs{}", found.at("faces").get<std::size_t>(),
                                 found.at("faces_reduced").get<std::size_t>(), found.at("runs").get<std::size_t>(),
                                 found.at("finished").get<bool>() ? "" : ", not to the end"));
      row("smallest", text("reduced"));
    }
  }
  return found.is_null() ? Exit::done : Exit::disagreement;
}

/// Errors: Usage_error where the source is no convex polygon.
void check_source(const generate::Posed_scene& posed, const std::string& wanted) {
  if (posed.source.empty()) throw Usage_error(wanted);
  try {
    const Scene scene(posed.soup);
    weak_source(Occluders(scene), posed.source);
  } catch (const std::invalid_argument& error) {
    throw Usage_error(wanted + ": " + error.what());
  }
}

Exit run_fuzz(const Fuzz_arguments& arguments) {
  harness::Subject subject;
  for (harness::Subject& one : all_subjects())
    if (one.name == arguments.command) subject = std::move(one);
  if (!arguments.check.empty() && arguments.check != "certificate" &&
      std::none_of(subject.checks.begin(), subject.checks.end(),
                   [&](const harness::Check& check) { return check.name == arguments.check; })) {
    std::string names = "certificate";
    for (const harness::Check& check : subject.checks) names += ", " + check.name;
    throw Usage_error(fmt::format("--check '{}': {} has {}", arguments.check, subject.name, names));
  }
  if (!arguments.json.empty()) {
    const std::string stem = (std::filesystem::path(arguments.out) / arguments.command).string();
    check_files({}, {{"--json", arguments.json}, {"--out", stem + ".qoff"}, {"--out", stem + ".json"}});
    if (arguments.resume) check_files({}, {{"--resume", arguments.json + ".done"}, {"--out", stem + ".json"}});
  }
  if (arguments.resume && (!arguments.scene.empty() || !arguments.only.empty()))
    throw Usage_error("--resume is of a sequence of scenes: leave it out, or --case and --scene");
  if (arguments.scene.empty() && !arguments.format.name.empty())
    throw Usage_error("--format is of a --scene from standard input: leave it out");
  watch_for_crashes();
  if (!arguments.scene.empty()) {
    Polygon_soup soup = arguments.format.read(arguments.scene);
    harness::Posed_query query;
    if (!arguments.query.empty()) query = read_query(arguments.query, soup.face_count());
    generate::Posed_scene& scene = query.scene;
    scene.soup = std::move(soup);
    if (subject.wants_source) check_source(scene, "'" + subject.name + "' wants a --query with a source polygon");
    begin_case(fmt::format("sightline fuzz {} --scene {}{}{}", arguments.command, arguments.scene,
                           arguments.query.empty() ? "" : " --query " + arguments.query, only_check(arguments)),
               arguments.case_seconds);
    return run_one(subject, scene, query.seed, arguments.scene, arguments.check);
  }
  if (!arguments.only.empty()) {
    harness::Fuzz_case which;
    generate::Posed_scene scene;
    try {
      which = harness::parse_case(arguments.only);
      scene = harness::make(which);
    } catch (const std::invalid_argument& error) {
      throw Usage_error(std::string("--case: ") + error.what());
    }
    if (subject.wants_source && scene.source.empty())
      throw Usage_error(
          fmt::format("--case: '{}' wants a source polygon, and '{}' has none", subject.name, which.family));
    begin_case(replay_of(arguments, which), arguments.case_seconds);
    return run_one(subject, scene, which.parameters.seed, "case " + to_string(which), arguments.check);
  }
  return run_many(arguments, subject);
}

std::string list_of_checks() {
  std::string text;
  for (const harness::Subject& subject : all_subjects()) {
    text += fmt::format("\n  {:<8} {}", subject.name, subject.what);
    for (const harness::Check& check : subject.checks) text += fmt::format("\n    {:<16} {}", check.name, check.what);
  }
  return text;
}

}  // namespace

void add_fuzz(Command program) {
  const Command command = program.add_command("fuzz",
                                              "Random degenerate scenes, all methods and all laws, until something "
                                              "disagrees; then the smallest scene that shows it");
  auto a = std::make_shared<Fuzz_arguments>();
  command.add_option("COMMAND", a->command, "what to run, see below").required().check(one_of(subject_names()));
  command.add_option("--seconds", a->seconds, "how long to draw scenes")
      .check(positive() & finite_number())
      .show_default();
  command
      .add_option("--case-seconds", a->case_seconds,
                  "of processor time; a case that takes longer ends the run: a finding, named on standard error")
      .check(positive() & finite_number())
      .show_default();
  command
      .add_option("--scenes", a->scenes, "draw so many scenes instead, in all shards together, however long that takes")
      .check(whole_number());
  command.add_option("--reduce-seconds", a->reduce_seconds, "how long to make small what was found; 0: as it was found")
      .check(whole_number())
      .show_default();
  command.add_option("--seed", a->seed, "one seed is one sequence of cases").check(whole_number()).show_default();
  command.add_option("--shard", a->shard,
                     "I/N: of the scenes of that sequence those whose number is I modulo N; by default what "
                     "SLURM_ARRAY_TASK_ID and SLURM_ARRAY_TASK_COUNT say");
  command.add_flag("--resume", a->resume,
                   "keep beside --json how far it is, and go on from there: with other --seconds or --scenes too");
  command.add_option("--family", a->family, "only scenes of this family (`sightline generate --help` lists them)");
  command.add_option("--max-faces", a->most_faces, "pass over scenes of more faces")
      .check(whole_number())
      .show_default();
  command.add_option("--case", a->only, "run one case alone, FAMILY:SEED:SIZE:ULPS:X,Y,Z:POWER");
  command.add_option("--scene", a->scene, "run a scene of a file alone").reads_file();
  a->format.add_to(command);
  command.add_option("--query", a->query, "with --scene: the eye and the source, as `generate --query` writes them")
      .reads_file();
  command.add_option("--check", a->check, "only this check, beside 'certificate'");
  command.add_option("--out", a->out, "the folder for the smallest failing scene").check(not_empty()).show_default();
  add_json_option(command, a->json, "the summary");
  command.footer(
      "Commands and their checks; each answer is also checked by itself ('certificate'):" + list_of_checks() +
      "\nExit codes: 0 nothing found, 1 something disagrees or a case does not end, 2 usage, 3 bad input."
      "\nExample: sightline fuzz see --seconds 600 --seed 7 --out found");
  command.set_action([a, command] {
    a->quiet = command.writes_standard_output();
    return run_fuzz(*a);
  });
}

}  // namespace sightline::app
