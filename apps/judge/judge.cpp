// sightline judge: somebody else's program, asked many cases and graded against the exact truth.

#include "judge.h"

#include "../support/files.h"
#include "../support/shard.h"
#include "broken.h"
#include "kept.h"
#include "page.h"
#include "table.h"

#include <sightline/io/file.h>

namespace sightline::app {

namespace {

using namespace judge;

/// What --keep writes is neither read nor written by another option.
void check_kept(const Judge_arguments& arguments) {
  const Case_choice& choice = arguments.choice;
  if (arguments.keep.empty()) return;
  std::error_code not_there;
  if (std::filesystem::equivalent(choice.scenes, arguments.keep, not_there))
    throw Usage_error("--keep " + arguments.keep + ": that is the folder that --scenes reads; name another one");
  std::vector<Named_file> inputs{{"--scenes", choice.scenes}, {"--ask", choice.ask}},
      outputs{{"--json", arguments.json}, {"--html", arguments.html}};
  const auto is_left_out = [](const Named_file& file) { return file.name.empty(); };
  std::erase_if(inputs, is_left_out);
  std::erase_if(outputs, is_left_out);
  for (const std::string stem : {"smallest.", "reduced."})
    for (const std::string& ending : Court::kept_endings(arguments.format))
      outputs.push_back({"--keep", (std::filesystem::path(arguments.keep) / (stem + ending)).string()});
  check_files(inputs, outputs);
}

/// What all cases are asked alike, by options' names. Programs are known by their files, too.
Json asked_json(const Judge_arguments& a, const Court& court, const Shard& own) {
  const Case_choice& choice = a.choice;
  return {{"--program", a.program},
          {"--program's files", hashes_of_words(court.words())},
          {"--query", a.query},
          {"--contract", a.contract},
          {"--families", choice.families},
          {"--ulps", choice.ulps},
          {"--size", choice.size},
          {"--scenes", choice.scenes},
          {"--ask", choice.ask.empty() ? "" : choice.ask + ' ' + content_hash(choice.ask)},
          {"--cases", a.cases},
          {"--seed", a.seed},
          {"--shard", fmt::format("{}/{}", own.shard, own.shards)},
          {"--time", a.time},
          {"--memory", a.memory},
          {"--budget", a.budget},
          {"--format", a.format},
          {"--two-sided", a.two_sided},
          {"--cycles", a.cycles},
          {"--excuse-touching", a.excuse_touching}};
}

/// The sums of all cases at one distance, in the order in which these were asked.
Json by_distance(const std::vector<Case_group>& groups, const std::vector<std::vector<Judged>>& judged) {
  std::vector<std::string> distances;
  for (const Case_group& group : groups)
    if (std::find(distances.begin(), distances.end(), group.distance) == distances.end())
      distances.push_back(group.distance);
  Json rows = Json::array();
  for (const std::string& distance : distances) {
    std::vector<const Judged*> cases;
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (const Judged& c : judged[g])
        if (groups[g].distance == distance) cases.push_back(&c);
    Json row{{"distance", distance}};
    row.update(sums_of(cases));
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Of what does not go together.
void check_usage(const Judge_arguments& arguments) {
  if (!arguments.choice.scenes.empty() && !arguments.choice.families.empty())
    throw Usage_error("--scenes and --families exclude each other: ask twice");
  if (!arguments.choice.ask.empty() && arguments.choice.scenes.empty())
    throw Usage_error("--ask wants --scenes: which scene is asked about");
  if (arguments.reduce > 0 && arguments.keep.empty())
    throw Usage_error("--reduce wants --keep: the folder for the scene");
  const bool of_rays = arguments.query == "trace", of_solids = arguments.query == "boolean";
  if (of_rays && arguments.two_sided)
    throw Usage_error("--two-sided is not of --query trace: rays meet faces from both sides; leave it out");
  if (of_solids && arguments.two_sided)
    throw Usage_error("--two-sided is not of --query boolean: fronts look outwards; leave it out");
  if (!of_rays && arguments.excuse_touching) throw Usage_error("--excuse-touching is of --query trace only");
  if (arguments.resume && (arguments.json.empty() || arguments.json == "-"))
    throw Usage_error("--resume keeps what is done beside an output: name it with --json FILE");
  check_kept(arguments);
}

/// A case as it was judged before, or now.
struct Heard_case {
  std::optional<Judge_case> made;  // the case, where it is looked at
  Kept_case kept;
};

Heard_case heard(const Judge_arguments& arguments, const Court& court, const Case_group& group, std::uint64_t seed,
                 const Kept_case* before) {
  Heard_case heard;
  if (before == nullptr || before->judged.breaks || before->said) heard.made = group.make(seed);
  if (before == nullptr) {
    Judged& now = heard.kept.judged = court.judge(*heard.made, seed);
    if (arguments.resume && now.not_asked.empty() && (now.breaks || now.mark == Mark::wrong || now.answer.surface))
      heard.kept.said = court.said();
    return heard;
  }
  heard.kept = *before;
  Judged& again = heard.kept.judged;
  if (before->said && again.mark != Mark::invalid && again.mark != Mark::crashed)
    again.answer = court.read(*heard.made, *before->said);
  return heard;
}

/// All cases before a court, one after another, and what they say of the program together.
class Session {
 public:
  Session(const Judge_arguments& arguments, const Court& court, const std::vector<Case_group>& groups)
      : arguments_(arguments),
        court_(court),
        groups_(groups),
        judged_(groups.size()),
        common_(arguments.case_options().question, arguments.two_sided) {}

  /// Those of a shard. `kept`: what was judged before, and where it is written what is judged now; null: nowhere.
  void hear(const Shard& own, Kept_cases* kept) {
    const auto [shard, shards] = own;
    const std::uint64_t cases = arguments_.choice.ask.empty() ? arguments_.cases : 1;
    Progress progress("judging");
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const std::string of = kept != nullptr ? identity(groups_[g]) : "";
      for (std::uint64_t k = 0; k < cases; ++k) {
        const std::size_t number = g * cases + k;
        if (number % shards != shard) continue;
        hear_case(g, arguments_.seed + k, number, of, kept);
        progress(++done_, groups_.size() * cases / shards + 1);
      }
    }
  }

  /// Says why cases broke the contract: of the smallest one also what may be the reason, and how small it can be made.
  void explain() {
    explain_some();
    if (smallest_of_ == nullptr) return;
    if (smallest_["mark"] == "wrong") {
      const Judge_case asked = smallest_of_->make(smallest_case_.seed);
      smallest_["explained"] = explained(arguments_, asked, smallest_case_);
      smallest_["guess"] = guesses(arguments_, court_, *smallest_of_, asked, smallest_case_);
      keep_picture(arguments_, smallest_, "smallest");
    }
    if (arguments_.reduce > 0)
      smallest_["reduced"] = made_smaller(arguments_, court_, smallest_of_->make(smallest_case_.seed), smallest_case_);
  }

  Json result() const {
    Json rows = Json::array();
    std::vector<const Judged*> all;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      std::vector<const Judged*> cases;
      for (const Judged& c : judged_[g]) cases.push_back(&c);
      rows.push_back(sums_row(groups_[g].family, groups_[g].distance, cases));
      all.insert(all.end(), cases.begin(), cases.end());
    }
    const Json total = sums_row("all", "", all);
    return {{"holds", total["breaches"] == 0},
            {"rows", std::move(rows)},
            {"by_distance", by_distance(groups_, judged_)},
            {"total", total},
            {"guess", common_.words()},
            {"not_asked", reasons_},
            {"smallest", smallest_},
            {"failures", failures_}};
  }

  std::size_t done() const { return done_; }
  std::size_t done_before() const { return done_before_; }  ///< of them, what was there

 private:
  void hear_case(std::size_t g, std::uint64_t seed, std::size_t number, const std::string& of, Kept_cases* kept) {
    const Kept_case* const before = kept != nullptr ? kept->find(number, of) : nullptr;
    Heard_case heard_case = heard(arguments_, court_, groups_[g], seed, before);
    const Judged& c = judged_[g].emplace_back(heard_case.kept.judged);
    done_before_ += before != nullptr;
    if (!c.not_asked.empty()) reasons_[c.not_asked] = reasons_.value(c.not_asked, std::size_t{0}) + 1;
    common_.add(c.kinds);
    if (c.mark == Mark::wrong)
      heard_case.kept.readings = common_.add(*heard_case.made, c, arguments_.court_options().truth,
                                             before != nullptr ? &before->readings : nullptr);
    if (before == nullptr && kept != nullptr) kept->add(number, of, heard_case.kept);
    if (c.breaks) add_failure(groups_[g], c, heard_case, before != nullptr);
  }

  void add_failure(const Case_group& group, const Judged& c, const Heard_case& heard_case, bool was_heard_before) {
    failures_.push_back(
        {{"family", group.family},
         {"distance", group.distance},
         {"seed", c.seed},
         {"faces", c.faces},
         {"mark", mark_names[static_cast<std::size_t>(c.mark)]},
         {"why", c.why},
         {"wrong_visible", c.grade.wrong_visible},
         {"wrong_hidden", c.grade.wrong_hidden},
         {"again", command_again(arguments_, fmt::format("{} --cases 1 --seed {}", group.again, c.seed))}});
    if (!smallest_.is_null() && smallest_["faces"] <= c.faces) return;
    smallest_ = failures_.back();
    smallest_["files"] = std::vector<std::string>();
    if (!arguments_.keep.empty())
      smallest_["files"] = court_.keep_files(arguments_.keep, "smallest", *heard_case.made,
                                             was_heard_before ? heard_case.kept.said : court_.said());
    smallest_of_ = &group;
    smallest_case_ = c;
  }

  /// The smallest of the wrong cases that broke the contract, for the page: as many as one looks at.
  void explain_some() {
    constexpr std::size_t most = 12;
    if (arguments_.html.empty()) return;
    struct Wrong {
      const Case_group* group;
      const Judged* judged;
      std::size_t failure;
    };
    std::vector<Wrong> wrong;
    std::size_t failure = 0;
    for (std::size_t g = 0; g < groups_.size(); ++g)
      for (const Judged& c : judged_[g]) {
        if (c.breaks && c.mark == Mark::wrong) wrong.push_back({&groups_[g], &c, failure});
        failure += c.breaks;
      }
    std::stable_sort(wrong.begin(), wrong.end(),
                     [](const Wrong& a, const Wrong& b) { return a.judged->faces < b.judged->faces; });
    for (std::size_t i = 0; i < std::min(wrong.size(), most); ++i)
      failures_[wrong[i].failure]["explained"] =
          explained(arguments_, wrong[i].group->make(wrong[i].judged->seed), *wrong[i].judged);
  }

  static Json sums_row(const std::string& family, const std::string& distance,
                       const std::vector<const Judged*>& cases) {
    Json row{{"family", family}, {"distance", distance}};
    row.update(sums_of(cases));
    return row;
  }

  const Judge_arguments& arguments_;
  const Court& court_;
  const std::vector<Case_group>& groups_;
  std::vector<std::vector<Judged>> judged_;  // by group
  Common_guess common_;
  std::size_t done_ = 0, done_before_ = 0;
  Json failures_ = Json::array(), reasons_ = Json::object(), smallest_;
  const Case_group* smallest_of_ = nullptr;  // of the smallest failure: its group, and the case
  Judged smallest_case_;
};

Exit run(Judge_arguments arguments) {
  check_usage(arguments);
  const std::vector<Case_group> groups = groups_of(arguments.choice, arguments.case_options());
  if (!arguments.choice.ask.empty()) arguments.two_sided = groups.at(0).make(arguments.seed).query.two_sided;
  for (const std::string& output : {arguments.json, arguments.html}) check_replaceable(output);  // before the work
  if (!arguments.keep.empty()) make_folder(arguments.keep);
  const Court court(arguments.court_options());
  const Shard own = shard_of(arguments.shard);
  std::optional<Kept_cases> kept;
  if (arguments.resume)
    kept.emplace(arguments.json + ".done", resumed_head("judge", asked_json(arguments, court, own)));
  const Stopwatch watch;
  Session session(arguments, court, groups);
  session.hear(own, kept ? &*kept : nullptr);
  session.explain();
  const Json document{{"command", "judge"},
                      {"program", arguments.program},
                      {"query", arguments.query},
                      {"two_sided", arguments.two_sided},
                      {"contract", arguments.contract},
                      {"shard", {own.shard, own.shards}},
                      {"limits", {{"seconds", arguments.time}, {"bytes", arguments.memory << 20}}},
                      {"result", session.result()},
                      {"seconds", {{"all", watch.seconds()}}}};

  if (!arguments.html.empty()) write_file(arguments.html, judge_page(document));
  const std::string text = document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  if (!arguments.json.empty()) write_file(arguments.json, text);
  if (!arguments.quiet) {
    print_table(document);
    print_verdict(document);
    if (arguments.resume)
      row("resumed", fmt::format("{} of {} cases were there", session.done_before(), session.done()));
  }
  return document["result"]["holds"] == true ? Exit::done : Exit::disagreement;
}

}  // namespace

std::string command_again(const Judge_arguments& arguments, const std::string& which) {
  return fmt::format("sightline judge --program {} --query {} --contract {} {}{}{}{}{}", shell_word(arguments.program),
                     arguments.query, arguments.contract, which,
                     arguments.format == "off" ? "" : " --format " + arguments.format,
                     arguments.two_sided ? " --two-sided" : "", arguments.cycles ? " --cycles" : "",
                     arguments.excuse_touching ? " --excuse-touching" : "");
}

void add_judge(Command program) {
  const Command command = program.add_command(
      "judge", "Asks somebody else's program many cases, and grades its answers against the exact truth");
  auto a = std::make_shared<Judge_arguments>();
  command
      .add_option("--program", a->program,
                  "its command, with {scene} {query} {answer} where the names of these files belong; quotes hold a "
                  "word together")
      .required();
  command
      .add_option("--query", a->query,
                  "what it is asked: order, see (from a point), weak (from a polygon), trace (what rays meet first), "
                  "boolean (set operations on solids)")
      .required()
      .check(one_of(
          std::vector<std::string>(sightline::judge::question_names.begin(), sightline::judge::question_names.end())));
  command
      .add_option("--contract", a->contract,
                  "what it promises: exact (no wrong face), conservative (never hides a visible one), aggressive "
                  "(never shows a hidden one)")
      .required()
      .check(one_of(
          std::vector<std::string>(sightline::judge::contract_names.begin(), sightline::judge::contract_names.end())));
  command
      .add_option("--families", a->choice.families,
                  "which families of scenes, with commas (`sightline generate --help` lists them); by default all")
      .delimiter(',');
  command
      .add_option(
          "--ulps", a->choice.ulps,
          "how far from their degeneracy, with commas: 0 (exactly there), a number of ulps to either side, or far")
      .delimiter(',')
      .show_default();
  command.add_option("--size", a->choice.size, "how large the families' scenes are; 0: small")
      .check(whole_number())
      .show_default();
  command.add_option("--scenes", a->choice.scenes, "instead of families: a scene, or a folder of them").reads_file();
  command
      .add_option(
          "--ask", a->choice.ask,
          "with --scenes: a file with the query to ask, as --keep writes it, instead of queries of the judge's own")
      .reads_file();
  command.add_option("--cases", a->cases, "of each family at each distance, or of each scene")
      .check(whole_number())
      .show_default();
  command.add_option("--seed", a->seed, "of the first case; the next has the next number")
      .check(whole_number())
      .show_default();
  command.add_option("--shard", a->shard,
                     "I/N: of all cases those whose number is I modulo N; by default what SLURM_ARRAY_TASK_ID and "
                     "SLURM_ARRAY_TASK_COUNT say");
  command.add_flag("--resume", a->resume,
                   "keep each case that is judged beside --json, and ask for none again that is there");
  command.add_option("--time", a->time, "seconds for a case").check(positive() & finite_number()).show_default();
  command.add_option("--memory", a->memory, "MB for a case")
      .check(whole_number())
      .check(range(1, 1 << 20))
      .show_default();
  command
      .add_option("--format", a->format,
                  "of the scene's file: off, obj, ply, stl with coordinates rounded to doubles, or qoff, exact")
      .check(one_of({"off", "obj", "ply", "stl", "qoff"}))
      .show_default();
  command.add_flag("--two-sided", a->two_sided, "faces seen from behind count too");
  command.add_flag("--cycles", a->cycles,
                   "order: ask also where faces overlap in a cycle, so that some must be drawn in parts");
  command.add_flag("--excuse-touching", a->excuse_touching,
                   "trace: a face that a ray meets on its border or along itself may be named or passed over");
  command
      .add_option("--budget", a->budget, "seconds for the truth of a weak query; what is undecided then is not judged")
      .check(positive() & finite_number())
      .show_default();
  command.add_option("--threads", a->threads, "for the truth; 0: one for each processor")
      .check(range(0, 1024))
      .show_default();
  add_json_option(command, a->json);
  command.add_option("--html", a->html, "write a page to look at").writes_file(".html");
  command
      .add_option("--keep", a->keep, "a folder for the smallest case that breaks the contract: scene, query and answer")
      .check(not_empty());
  command
      .add_option("--reduce", a->reduce,
                  "with --keep: make that case smaller still, for so many seconds, as long as the program breaks the "
                  "contract in the same way; 0: not at all")
      .check(not_negative() & finite_number())
      .show_default();
  command.footer(
      "The program reads the scene and the query, {\"query\": \"see\", \"eye\": [0.5, 2, 1], \"two_sided\": false} or "
      "{\"query\": \"weak\", \"source\": [[0, 0, 1], ...], ...}, and writes the answer:\n"
      "the visible faces, one number a line, faces counted from 0; for order all faces, farthest first. `abstained 7` "
      "leaves face 7 open.\n"
      "For trace, {\"query\": \"trace\", \"rays\": [{\"origin\": [0, 0, 1], \"direction\": [0, 0, -1]}, ...]}, a line "
      "for each ray: the face that it meets first, `none` or `abstained`.\n"
      "For boolean, {\"query\": \"boolean\", \"operation\": \"union\", \"first\": 6}, the first 6 faces bounding one "
      "solid "
      "and all others the other: the result's surface as OFF, fronts outwards, or `abstained`.\n"
      "Example: sightline judge --program \"python3 mine.py {scene} {query} {answer}\" --query see --contract exact "
      "--html report.html\n"
      "A wrong face, an answer outside of the protocol and a crash break the contract; to abstain, and to run out of "
      "time or memory, does not. Exit code 1: broken.\n"
      "All of it: harness/judge/README.md.");
  command.set_action([a, command] {
    a->quiet = command.writes_standard_output();
    return run(*a);
  });
}

}  // namespace sightline::app
