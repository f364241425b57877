// sightline judge: somebody else's program, asked many cases and graded against the exact truth.

#include "../support/shard.h"
#include "kept.h"
#include "page.h"
#include "picture.h"
#include "table.h"

#include <sightline/harness/laws/reduce.h>

namespace sightline::app {

namespace {

using namespace judge;

struct Judge_arguments {
  std::string program, query, contract, format = "off", json, html, keep, shard;
  Case_choice choice{{}, {"0", "1", "-1", "far"}, 0, {}, {}};
  std::size_t cases = 5;
  std::uint64_t seed = 1;
  double time = 10, budget = 20, reduce = 0;
  std::uint64_t memory = 1024;
  int threads = 0;
  bool two_sided = false, cycles = false, excuse_touching = false, resume = false,
       quiet = false;  // quiet: an output takes standard output

  Case_options case_options() const {
    return {static_cast<Question>(place_of(query, question_names)), two_sided, format != "qoff"};
  }
  Court_options court_options() const {
    return {program,
            format,
            static_cast<Contract>(place_of(contract, contract_names)),
            {time, memory << 20},
            {threads, budget, cycles, excuse_touching}};
  }
  template <std::size_t n>
  static std::size_t place_of(const std::string& name, const std::array<std::string_view, n>& names) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  }
};

/// The command that asks one case again, which `which` names.
std::string command_again(const Judge_arguments& arguments, const std::string& which) {
  return fmt::format("sightline judge --program {} --query {} --contract {} {}{}{}{}{}", shell_word(arguments.program),
                     arguments.query, arguments.contract, which,
                     arguments.format == "off" ? "" : " --format " + arguments.format,
                     arguments.two_sided ? " --two-sided" : "", arguments.cycles ? " --cycles" : "",
                     arguments.excuse_touching ? " --excuse-touching" : "");
}

/// Whether a face has a corner twice.
bool repeats_a_corner(const Polygon_soup& soup) {
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    const auto loop = soup.loop(f);
    std::set<Exact_point> corners;
    for (const Point_id p : loop) corners.insert(soup.point(p));
    if (corners.size() < loop.size()) return true;
  }
  return false;
}

/// Whether a case is broken as another one is: the same mark, and faces wrong in no way that is new.
bool broken_alike(const Judged& judged, const Judged& broken) {
  return judged.breaks && judged.mark == broken.mark &&
         (judged.grade.wrong_visible.empty() || !broken.grade.wrong_visible.empty()) &&
         (judged.grade.wrong_hidden.empty() || !broken.grade.wrong_hidden.empty());
}

/// Why a case is wrong, for people: the line that refutes, the share that is wrong, and a picture. Pre: its mark is
/// `wrong`.
Json explained(const Judge_arguments& arguments, const Judge_case& asked, const Judged& broken) {
  const Explanation why = explain(asked.soup, asked.query, broken.answer, broken.grade,
                                  arguments.court_options().contract, arguments.budget);
  Json json{{"share", why.share}, {"share_words", why.share_words}, {"line", Json()}};
  if (why.refutation) {
    const Refutation& line = *why.refutation;
    json["line"] = {{"face", line.face},
                    {"from", point_json(line.from)},
                    {"to", point_json(line.to)},
                    {"by", line.by ? Json(*line.by) : Json()},
                    {"words", line.words}};
  }
  json["picture"] = picture_of(asked.soup, asked.query, broken.grade, why);
  return json;
}

/// Writes the picture of an explained case beside its scene, where files are kept.
void keep_picture(const Judge_arguments& arguments, Json& explained_case, const std::string& stem) {
  if (arguments.keep.empty()) return;
  const std::string file = (std::filesystem::path(arguments.keep) / (stem + ".svg")).string();
  write_file(file, explained_case["explained"]["picture"].get<std::string>());
  explained_case["files"].push_back(file);
}

/// A case made smaller as long as the program breaks the contract in the same way: how far, and the files that are
/// kept. Faces stay planar, their corners apart, and coordinates doubles where these are wanted.
Json made_smaller(const Judge_arguments& arguments, const Court& court, const Judge_case& asked, const Judged& broken) {
  bool one_ray = false;  // as an eye and a direction
  const auto case_of_smaller = [&](const generate::Posed_scene& smaller) {
    Query query{asked.query.question, smaller.eye,           smaller.source,   asked.query.two_sided,
                asked.query.rays,     asked.query.operation, asked.query.first};
    if (one_ray) query = {query.question, {}, {}, false, {{smaller.eye, smaller.source.at(0)}}};
    return case_of(smaller.soup, query, arguments.case_options());
  };
  const bool repeats = repeats_a_corner(asked.soup);
  const auto fails = [&](const generate::Posed_scene& smaller) {
    const Judge_case other = case_of_smaller(smaller);
    return other.as_given && (repeats || !repeats_a_corner(other.soup)) &&
           broken_alike(court.judge(other, broken.seed), broken);
  };
  Countdown time("reducing", arguments.reduce);
  harness::Reduce_options options;
  options.most_tests = 1000000;
  options.out_of_time = [&] { return time.over(); };
  generate::Posed_scene scene;
  scene.soup = asked.soup;
  scene.eye = asked.query.eye;
  scene.source = asked.query.source;
  // Of rays the first is kept that breaks the contract when asked alone.
  for (const Wrong_ray& wrong : broken.grade.wrong_rays) {
    generate::Posed_scene alone{scene};
    alone.eye = asked.query.rays[wrong.ray].origin;
    alone.source = {asked.query.rays[wrong.ray].direction};
    one_ray = true;
    one_ray = fails(alone);
    if (!one_ray) continue;
    scene = alone;
    break;
  }
  const harness::Reduced reduced = harness::reduce(scene, fails, options);
  const Judge_case left = case_of_smaller(reduced.scene);
  const Judged last = court.judge(left, broken.seed);
  const std::vector<std::string> files = court.keep_files(arguments.keep, "reduced");
  Json json{
      {"faces", last.faces},
      {"runs", reduced.tests},
      {"finished", reduced.finished},
      {"mark", mark_names[static_cast<std::size_t>(last.mark)]},
      {"why", last.why},
      {"files", files},
      {"again", command_again(arguments, "--scenes " + shell_word(files.at(0)) + " --ask " + shell_word(files.at(1)))}};
  if (last.mark == Mark::wrong) {
    json["explained"] = explained(arguments, left, last);
    keep_picture(arguments, json, "reduced");
  }
  return json;
}

/// What a wrong case looks like once it is moved, and under other readings of the question.
std::vector<std::string> guesses(const Judge_arguments& arguments, const Court& court, const Case_group& group,
                                 const Judge_case& asked, const Judged& broken) {
  std::vector<std::string> guesses;
  for (const Reading reading : lists_faces(broken.answer) ? readings_of(asked.query.question) : std::vector<Reading>())
    if (is_right(reading, asked.soup, asked.query, broken.answer, arguments.court_options().truth))
      guesses.push_back("the answer is right read otherwise, " + words_of(reading, asked.query.two_sided));
  std::vector<Neighbour> neighbours{{group.ulps, true}};
  std::vector<std::int64_t> places{0};
  for (const int bits : {0, 12, 22, 32, 44})  // one ulp, 2^-40, 2^-30, 2^-20 and 2^-8 of the size
    for (const std::int64_t sign : {1, -1}) places.push_back(sign * (std::int64_t{1} << bits));
  for (const std::int64_t place : places) {
    if (place == group.ulps) continue;
    const Judged moved = court.judge(group.moved(broken.seed, place), broken.seed);
    if (moved.not_asked.empty() && (moved.mark == Mark::right || moved.mark == Mark::wrong))
      neighbours.push_back({place, moved.mark == Mark::wrong});
  }
  if (neighbours.size() > 1) guesses.push_back(words_of(neighbours, group.exactly));
  return guesses;
}

/// What all wrong cases have in common.
class Common_guess {
 public:
  Common_guess(Question question, bool two_sided) : readings_(readings_of(question)), two_sided_(two_sided) {}

  /// Returns what readings are left. `kept`: those that were left before.
  const std::vector<Reading>& add(const Judge_case& asked, const Judged& wrong, const Truth_options& options,
                                  const std::vector<Reading>* kept) {
    ++wrong_;
    supported_ = supported_ || lists_faces(wrong.answer);
    std::erase_if(readings_, [&](Reading reading) {
      return kept != nullptr ? std::find(kept->begin(), kept->end(), reading) == kept->end()
                             : !is_right(reading, asked.soup, asked.query, wrong.answer, options);
    });
    return readings_;
  }
  void add(const Kinds& kinds) {
    kinds_.concave_right += kinds.concave_right;
    kinds_.concave_wrong += kinds.concave_wrong;
    kinds_.convex_right += kinds.convex_right;
    kinds_.convex_wrong += kinds.convex_wrong;
  }
  std::vector<std::string> words() const {
    std::vector<std::string> all;
    for (const Reading reading : supported_ ? readings_ : std::vector<Reading>())
      all.push_back(fmt::format("in {} the answer is right read otherwise, {}",
                                wrong_ == 1 ? "the one wrong case" : fmt::format("all {} wrong cases", wrong_),
                                words_of(reading, two_sided_)));
    if (const std::string kinds = words_of(kinds_); !kinds.empty()) all.push_back(kinds);
    return all;
  }

 private:
  std::vector<Reading> readings_;  // under which all wrong answers are right
  bool two_sided_;
  std::size_t wrong_ = 0;
  bool supported_ = false;
  Kinds kinds_;
};

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
    for (const std::string& ending : {arguments.format, std::string("json"), std::string("answer"), std::string("svg")})
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

/// Explains the smallest of the wrong cases that broke the contract, for the page: as many as one looks at.
void explain_some(const Judge_arguments& arguments, const std::vector<Case_group>& groups,
                  const std::vector<std::vector<Judged>>& judged, Json& failures) {
  constexpr std::size_t most = 12;
  if (arguments.html.empty()) return;
  struct Wrong {
    const Case_group* group;
    const Judged* judged;
    std::size_t failure;
  };
  std::vector<Wrong> wrong;
  std::size_t failure = 0;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const Judged& c : judged[g]) {
      if (c.breaks && c.mark == Mark::wrong) wrong.push_back({&groups[g], &c, failure});
      failure += c.breaks;
    }
  std::stable_sort(wrong.begin(), wrong.end(),
                   [](const Wrong& a, const Wrong& b) { return a.judged->faces < b.judged->faces; });
  for (std::size_t i = 0; i < std::min(wrong.size(), most); ++i)
    failures[wrong[i].failure]["explained"] =
        explained(arguments, wrong[i].group->make(wrong[i].judged->seed), *wrong[i].judged);
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

Exit run(const Judge_arguments& arguments) {
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
  const std::vector<Case_group> groups = groups_of(arguments.choice, arguments.case_options());
  const Court court(arguments.court_options());
  const std::uint64_t cases = arguments.choice.ask.empty() ? arguments.cases : 1;
  const Shard own = shard_of(arguments.shard);
  const auto [shard, shards] = own;
  std::optional<Kept_cases> kept_cases;
  if (arguments.resume)
    kept_cases.emplace(arguments.json + ".done", resumed_head("judge", asked_json(arguments, court, own)));
  const Stopwatch watch;
  Progress progress("judging");
  Json document{{"command", "judge"},
                {"program", arguments.program},
                {"query", arguments.query},
                {"two_sided", arguments.two_sided},
                {"contract", arguments.contract},
                {"shard", {shard, shards}},
                {"limits", {{"seconds", arguments.time}, {"bytes", arguments.memory << 20}}},
                {"result", Json::object()}};
  Json& result = document["result"];
  Json rows = Json::array(), failures = Json::array(), smallest, reasons = Json::object();
  const Case_group* smallest_of = nullptr;
  Judged smallest_case;
  Common_guess common(arguments.case_options().question, arguments.two_sided);
  std::vector<std::vector<Judged>> judged(groups.size());
  std::size_t done = 0, done_before = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Case_group& group = groups[g];
    const std::string of = arguments.resume ? identity(group) : "";
    for (std::uint64_t k = 0; k < cases; ++k) {
      const std::size_t number = g * cases + k;
      if (number % shards != shard) continue;
      // 1. The case, as it was judged before, or now.
      const std::uint64_t seed = arguments.seed + k;
      const Kept_case* const before = kept_cases ? kept_cases->find(number, of) : nullptr;
      std::optional<Judge_case> made;
      if (before == nullptr || before->judged.breaks || before->said) made = group.make(seed);
      Kept_case now;
      if (before == nullptr) now.judged = court.judge(*made, seed);
      else now = *before;
      if (before == nullptr && arguments.resume && now.judged.not_asked.empty() &&
          (now.judged.breaks || now.judged.mark == Mark::wrong || now.judged.answer.surface))
        now.said = court.said();
      if (before != nullptr && now.said && now.judged.mark != Mark::invalid && now.judged.mark != Mark::crashed)
        now.judged.answer = court.read(*made, *now.said);
      const Judged& c = judged[g].emplace_back(now.judged);
      progress(++done, groups.size() * cases / shards + 1);
      done_before += before != nullptr;

      // 2. What it says of the program.
      if (!c.not_asked.empty()) reasons[c.not_asked] = reasons.value(c.not_asked, std::size_t{0}) + 1;
      common.add(c.kinds);
      if (c.mark == Mark::wrong)
        now.readings = common.add(*made, c, arguments.court_options().truth, before ? &before->readings : nullptr);
      if (before == nullptr && kept_cases) kept_cases->add(number, of, now);
      if (!c.breaks) continue;
      failures.push_back(
          {{"family", group.family},
           {"distance", group.distance},
           {"seed", c.seed},
           {"faces", c.faces},
           {"mark", mark_names[static_cast<std::size_t>(c.mark)]},
           {"why", c.why},
           {"wrong_visible", c.grade.wrong_visible},
           {"wrong_hidden", c.grade.wrong_hidden},
           {"again", command_again(arguments, fmt::format("{} --cases 1 --seed {}", group.again, c.seed))}});
      if (!smallest.is_null() && smallest["faces"] <= c.faces) continue;
      smallest = failures.back();
      if (before != nullptr && !arguments.keep.empty()) court.put_back(*made, now.said);
      smallest["files"] =
          arguments.keep.empty() ? std::vector<std::string>() : court.keep_files(arguments.keep, "smallest");
      smallest_of = &group;
      smallest_case = c;
    }
    const auto pointers = [](const std::vector<Judged>& of_group) {
      std::vector<const Judged*> each;
      for (const Judged& c : of_group) each.push_back(&c);
      return each;
    };
    Json row{{"family", group.family}, {"distance", group.distance}};
    row.update(sums_of(pointers(judged[g])));
    rows.push_back(std::move(row));
  }
  explain_some(arguments, groups, judged, failures);
  if (smallest_of != nullptr && smallest["mark"] == "wrong") {
    const Judge_case asked = smallest_of->make(smallest_case.seed);
    smallest["explained"] = explained(arguments, asked, smallest_case);
    smallest["guess"] = guesses(arguments, court, *smallest_of, asked, smallest_case);
    keep_picture(arguments, smallest, "smallest");
  }
  if (smallest_of != nullptr && arguments.reduce > 0)
    smallest["reduced"] = made_smaller(arguments, court, smallest_of->make(smallest_case.seed), smallest_case);
  std::vector<const Judged*> all;
  for (const std::vector<Judged>& of_group : judged)
    for (const Judged& c : of_group) all.push_back(&c);
  Json total{{"family", "all"}, {"distance", ""}};
  total.update(sums_of(all));
  result["holds"] = total["breaches"] == 0;
  result["rows"] = std::move(rows);
  result["by_distance"] = by_distance(groups, judged);
  result["total"] = total;
  result["guess"] = common.words();
  result["not_asked"] = std::move(reasons);
  result["smallest"] = std::move(smallest);
  result["failures"] = std::move(failures);
  document["seconds"] = {{"all", watch.seconds()}};

  progress.clear();
  if (!arguments.html.empty()) write_file(arguments.html, judge_page(document));
  const std::string text = document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  if (!arguments.json.empty()) write_file(arguments.json, text);
  if (!arguments.quiet) {
    print_table(document);
    print_verdict(document);
    if (arguments.resume) row("resumed", fmt::format("{} of {} cases were there", done_before, done));
  }
  return total["breaches"] == 0 ? Exit::done : Exit::disagreement;
}

}  // namespace

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
  command.add_option("--json", a->json, "write everything as JSON to this file, - for standard output").writes_file();
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
