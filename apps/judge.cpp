// sightline judge: somebody else's program, asked many cases and graded against the exact truth.

#include "common.h"
#include "judge_cases.h"
#include "judge_page.h"
#include "limited_process.h"

#include <sightline/io/read.h>
#include <sightline/io/write.h>

#include <csignal>
#include <iostream>
#include <sstream>

namespace sightline::app {

namespace {

namespace fs = std::filesystem;
using namespace judge;

struct Judge_arguments {
  std::string program, query, contract, scenes, format = "off", json, html, keep;
  std::vector<std::string> families, ulps{"0", "1", "-1", "far"};
  std::size_t cases = 5, size = 0;
  std::uint64_t seed = 1;
  double time = 10, budget = 20;
  std::uint64_t memory = 1024;
  int threads = 0;
  bool two_sided = false, cycles = false;

  Case_options case_options() const { return {static_cast<Question>(place_of(query, question_names)), two_sided, format != "qoff"}; }
  Contract promised() const { return static_cast<Contract>(place_of(contract, contract_names)); }
  template <std::size_t n>
  static std::size_t place_of(const std::string& name, const std::array<std::string_view, n>& names) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  }
};

/// A folder that is gone at the end.
class Temporary_folder {
 public:
  Temporary_folder() {
    std::string pattern = (fs::temp_directory_path() / "sightline-judge-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error(pattern + ": no folder can be made there; check TMPDIR");
    path_ = pattern;
  }
  Temporary_folder(const Temporary_folder&) = delete;
  ~Temporary_folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

/// A row of the table: what all cases of a family have in common at one distance, and how to make them.
struct Group {
  std::string family, distance;
  std::string again;  ///< the options that ask one of these cases again, but for its seed
  std::function<Judge_case(std::uint64_t seed)> make;
};

struct Judged {
  std::uint64_t seed = 0;
  std::string not_asked;  ///< why; the rest is then empty
  std::size_t faces = 0;
  Mark mark = Mark::right;
  bool breaks = false;
  std::string why;
  Grade grade;
  double seconds = 0;
  std::uint64_t bytes = 0;
};

// ---- Which cases ------------------------------------------------------------------------------------------------------------

std::int64_t ulps_of(const std::string& text) {
  if (text == "far") return generate::far_ulps;
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) throw Usage_error("--ulps wants whole numbers or `far`, with commas; '" + text + "' is none");
  return value;
}

/// Text as one word of a shell's command line.
std::string shell_word(const std::string& text) {
  if (!text.empty() && text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./,:=@%{}") == std::string::npos && text.find("{}") == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
  return word + "'";
}

std::vector<Group> groups_of(const Judge_arguments& arguments) {
  const Case_options options = arguments.case_options();
  std::vector<Group> groups;
  if (!arguments.scenes.empty()) {
    std::vector<fs::path> files;
    if (fs::is_directory(arguments.scenes)) {
      for (const auto& entry : fs::recursive_directory_iterator(arguments.scenes))
        if (entry.is_regular_file() && format_of_ending(entry.path())) files.push_back(entry.path());
      std::sort(files.begin(), files.end());
      if (files.empty()) throw Usage_error("--scenes " + arguments.scenes + ": the folder holds no scene; give one with " + std::string(supported_formats));
    } else {
      files.push_back(arguments.scenes);
    }
    for (const fs::path& file : files)
      groups.push_back({file.filename().string(), "-", "--scenes " + shell_word(file.string()), [file, options](std::uint64_t seed) { return case_of(read_scene(file), seed, options); }});
    return groups;
  }
  std::vector<std::string> names = arguments.families;
  if (names.empty())
    for (const generate::Family& family : generate::families()) names.push_back(family.name);
  for (const std::string& name : names)
    for (const std::string& distance : arguments.ulps) {
      generate::Family_parameters parameters;
      parameters.ulps = ulps_of(distance);
      const generate::Family* family = nullptr;
      try {
        family = &generate::family(name);
      } catch (const std::invalid_argument& error) {
        throw Usage_error(std::string("--families: ") + error.what());
      }
      parameters.size = arguments.size > 0 ? arguments.size : family->small_size;
      groups.push_back({name, distance == "far" ? "far" : parameters.ulps == 0 ? "exact" : fmt::format("{:+} ulps", parameters.ulps),
                        fmt::format("--families {} --ulps {}{}", shell_word(name), distance, arguments.size > 0 ? fmt::format(" --size {}", arguments.size) : ""), [family, parameters, options](std::uint64_t seed) mutable {
                          parameters.seed = seed;
                          return case_of(*family, parameters, options);
                        }});
    }
  return groups;
}

// ---- One case -----------------------------------------------------------------------------------------------------------------

std::string in_words(const Grade& grade) {
  std::vector<std::string> all;
  for (const auto& [earlier, later] : grade.wrong_pairs) all.push_back(fmt::format("face {} is drawn before face {} but is nearer somewhere", earlier, later));
  if (grade.wrong_pairs.empty()) {
    for (const Face_id face : grade.wrong_visible) all.push_back(fmt::format("face {} is shown but hidden", face));
    for (const Face_id face : grade.wrong_hidden) all.push_back(fmt::format("face {} is missing but visible", face));
  }
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(all.size(), 4); ++i) text += (i == 0 ? "" : ", ") + all[i];
  return text + (all.size() > 4 ? fmt::format(", and {} more", all.size() - 4) : "");
}

/// Asks the program one query, in a folder of its own.
class Court {
 public:
  explicit Court(const Judge_arguments& arguments) : arguments_(arguments) {
    try {
      words_ = split_words(arguments.program);
    } catch (const std::invalid_argument& error) {
      throw Usage_error(std::string("--program: ") + error.what());
    }
    for (const char* place : {"{scene}", "{query}", "{answer}"})
      if (arguments.program.find(place) == std::string::npos) throw Usage_error(std::string("--program has no ") + place + ": give the command with {scene} {query} {answer} where the names of these files belong");
  }

  Judged judge(const Judge_case& asked, std::uint64_t seed) const {
    Judged judged;
    judged.seed = seed, judged.faces = asked.soup.face_count(), judged.not_asked = asked.not_asked;
    if (!judged.not_asked.empty()) return judged;
    const Truth truth = truth_of(asked.soup, asked.query, {arguments_.threads, arguments_.budget, arguments_.cycles});
    judged.not_asked = truth.not_asked;
    if (!judged.not_asked.empty()) return judged;
    for (const auto& [known, found] : {std::pair(&asked.visible, &truth.hidden), std::pair(&asked.hidden, &truth.visible)})
      for (const Face_id face : *known)
        if (std::binary_search(found->begin(), found->end(), face)) throw std::logic_error(fmt::format("the library says of face {} what its construction excludes (seed {}); please report it", face, seed));
    try {
      write_scene(asked.soup, scene());
    } catch (const Not_representable& error) {
      judged.not_asked = "the format cannot hold the scene";
      return judged;
    }
    write_file(query(), to_json(asked.query).dump() + "\n");
    fs::remove_all(answer());
    run(asked, truth, judged);
    return judged;
  }

  fs::path scene() const { return folder_ / ("scene." + arguments_.format); }
  fs::path query() const { return folder_ / "query.json"; }
  fs::path answer() const { return folder_ / "answer"; }

 private:
  void run(const Judge_case& asked, const Truth& truth, Judged& judged) const {
    std::vector<std::string> words = words_;
    for (std::string& word : words)
      for (const auto& [place, file] : {std::pair("{scene}", scene()), std::pair("{query}", query()), std::pair("{answer}", answer())})
        for (std::size_t at = word.find(place); at != std::string::npos; at = word.find(place, at + file.string().size())) word.replace(at, std::string_view(place).size(), file.string());
    Process_end end;
    try {
      end = run_limited(words, {arguments_.time, arguments_.memory << 20}, (folder_ / "said").string());
    } catch (const std::runtime_error& error) {
      throw Usage_error(std::string("--program: ") + error.what() + "; check the name and PATH");
    }
    judged.seconds = end.seconds, judged.bytes = end.bytes;
    const std::string said = end.said.empty() ? "" : "; it said: " + end.said.substr(end.said.find_last_of('\n') + 1);
    const auto crashed = [&](const std::string& how) { judged.mark = Mark::crashed, judged.why = how + said; };
    switch (end.kind) {
      case Process_end::timed_out: judged.mark = Mark::timed_out, judged.why = fmt::format("no end within {} s", arguments_.time); break;
      case Process_end::out_of_memory: judged.mark = Mark::out_of_memory, judged.why = fmt::format("more than {} MB", arguments_.memory); break;
      case Process_end::signalled: crashed(fmt::format("signal {} ({})", end.number, strsignal(end.number))); break;
      case Process_end::exited:
        if (end.number != 0) crashed(fmt::format("exit code {}", end.number));
        else grade_answer(asked, truth, judged);
    }
    judged.breaks = judge::breaks(arguments_.promised(), judged.mark, judged.grade);
  }

  void grade_answer(const Judge_case& asked, const Truth& truth, Judged& judged) const {
    try {
      if (!fs::exists(answer())) throw std::invalid_argument("it wrote no answer");
      judged.grade = grade(truth, read_answer(detail::read_bytes(answer()), asked.query.question, asked.soup.face_count()));
    } catch (const std::runtime_error& error) {  // no file that can be read
      judged.mark = Mark::invalid, judged.why = error.what();
      return;
    } catch (const std::invalid_argument& error) {
      judged.mark = Mark::invalid, judged.why = std::string("the answer: ") + error.what();
      return;
    }
    judged.mark = mark_of(judged.grade);
    judged.why = in_words(judged.grade);
  }

  const Judge_arguments& arguments_;
  std::vector<std::string> words_;
  Temporary_folder folder_;
};

// ---- All of them ----------------------------------------------------------------------------------------------------------------

/// The sums of some cases.
Json sums_of(const std::vector<const Judged*>& cases) {
  Json row;
  std::array<std::size_t, mark_names.size()> marks{};
  std::size_t not_asked = 0, judged = 0, wrong_visible = 0, wrong_hidden = 0, abstained = 0, breaches = 0;
  std::vector<double> seconds;
  std::uint64_t bytes = 0;
  for (const Judged* c : cases) {
    if (!c->not_asked.empty()) {
      ++not_asked;
      continue;
    }
    ++marks[static_cast<std::size_t>(c->mark)], breaches += c->breaks;
    judged += c->grade.judged, wrong_visible += c->grade.wrong_visible.size(), wrong_hidden += c->grade.wrong_hidden.size(), abstained += c->grade.abstained.size();
    seconds.push_back(c->seconds), bytes = std::max(bytes, c->bytes);
  }
  row["asked"] = cases.size() - not_asked, row["not_asked"] = not_asked;
  for (std::size_t k = 0; k < mark_names.size(); ++k) row["cases"][std::string(mark_names[k])] = marks[k];
  row["breaches"] = breaches;
  row["faces"] = {{"judged", judged}, {"wrong_visible", wrong_visible}, {"wrong_hidden", wrong_hidden}, {"abstained", abstained}};
  std::sort(seconds.begin(), seconds.end());
  const auto percentile = [&](double share) { return seconds.empty() ? Json() : Json(seconds[std::min(seconds.size() - 1, static_cast<std::size_t>(share * static_cast<double>(seconds.size())))]); };
  row["seconds"] = {{"p50", percentile(0.5)}, {"p95", percentile(0.95)}, {"max", percentile(1)}};
  row["bytes"] = bytes;
  return row;
}

std::string command_again(const Judge_arguments& arguments, const Group& group, std::uint64_t seed) {
  return fmt::format("sightline judge --program {} --query {} --contract {} {} --cases 1 --seed {}{}{}{}", shell_word(arguments.program), arguments.query, arguments.contract, group.again, seed,
                     arguments.format == "off" ? "" : " --format " + arguments.format, arguments.two_sided ? " --two-sided" : "", arguments.cycles ? " --cycles" : "");
}

/// Keeps the files of a case, so that the program can be asked again by hand.
std::vector<std::string> keep_files(const Court& court, const std::string& folder) {
  std::vector<std::string> kept;
  fs::create_directories(folder);
  for (const fs::path& file : {court.scene(), court.query(), court.answer()}) {
    const fs::path to = fs::path(folder) / ("smallest." + (file.extension() == "" ? "answer" : file.extension().string().substr(1)));
    std::error_code ignored;
    fs::remove(to, ignored);
    if (fs::exists(file) && fs::copy_file(file, to, ignored)) kept.push_back(to.string());
  }
  return kept;
}

void print_table(const Json& document) {
  const std::string line = "{:<26} {:<8} {:>5} {:>5} {:>5} {:>9} {:>7} {:>7} {:>9} {:>6} {:>13} {:>12} {:>8} {:>8} {:>8} {:>7}\n";
  std::cout << fmt::format(fmt::runtime(line), "family", "distance", "asked", "right", "wrong", "abstained", "invalid", "crashed", "timed out", "memory", "wrong visible", "wrong hidden", "p50 s", "p95 s", "max s", "max MB");
  const auto print = [&](const Json& r) {
    const Json &cases = r["cases"], &faces = r["faces"];
    const auto count = [](const Json& value) { return value == 0 ? std::string("-") : value.dump(); };
    const auto seconds = [&](const char* key) { return r["seconds"][key].is_null() ? std::string("-") : fmt::format("{:.3f}", r["seconds"][key].get<double>()); };
    std::cout << fmt::format(fmt::runtime(line), r["family"].get<std::string>(), r["distance"].get<std::string>(), count(r["asked"]), count(cases["right"]), count(cases["wrong"]), count(cases["abstained"]), count(cases["invalid"]),
                             count(cases["crashed"]), count(cases["timed out"]), count(cases["out of memory"]), count(faces["wrong_visible"]), count(faces["wrong_hidden"]), seconds("p50"), seconds("p95"), seconds("max"),
                             fmt::format("{:.0f}", r["bytes"].get<double>() / 1e6));
  };
  for (const Json& r : document["result"]["rows"]) print(r);
  print(document["result"]["total"]);
}

void print_verdict(const Json& document) {
  const Json &result = document["result"], &total = result["total"];
  for (const auto& [reason, count] : result["not_asked"].items()) std::cout << fmt::format("not asked: {} cases, as {}\n", count.get<std::size_t>(), reason);
  if (!result["smallest"].is_null()) {
    const Json& s = result["smallest"];
    std::cout << fmt::format("the smallest that breaks it: {} {}, seed {}, {} faces: {}: {}\n", s["family"].get<std::string>(), s["distance"].get<std::string>(), s["seed"].get<std::uint64_t>(), s["faces"].get<std::size_t>(),
                             s["mark"].get<std::string>(), s["why"].get<std::string>());
    for (const Json& file : s["files"]) std::cout << fmt::format("  kept: {}\n", file.get<std::string>());
    std::cout << fmt::format("  again: {}\n", s["again"].get<std::string>());
  }
  const std::string contract = document["contract"].get<std::string>();
  if (total["asked"] == 0) std::cout << "nothing was asked\n";
  else if (total["breaches"] == 0) std::cout << fmt::format("the contract `{}` holds in all {} cases\n", contract, total["asked"].get<std::size_t>());
  else std::cout << fmt::format("the contract `{}` is BROKEN in {} of {} cases\n", contract, total["breaches"].get<std::size_t>(), total["asked"].get<std::size_t>());
}

Exit run(const Judge_arguments& arguments) {
  if (!arguments.scenes.empty() && !arguments.families.empty()) throw Usage_error("--scenes and --families exclude each other: ask twice");
  if (!arguments.scenes.empty() && !fs::exists(arguments.scenes)) throw Usage_error("--scenes " + arguments.scenes + ": there is no such folder or file");
  const std::vector<Group> groups = groups_of(arguments);
  const Court court(arguments);
  const Stopwatch watch;
  Progress progress("judging");
  Json document{{"command", "judge"}, {"program", arguments.program}, {"query", arguments.query}, {"two_sided", arguments.two_sided}, {"contract", arguments.contract},
                {"limits", {{"seconds", arguments.time}, {"bytes", arguments.memory << 20}}}, {"result", Json::object()}};
  Json& result = document["result"];
  Json rows = Json::array(), failures = Json::array(), smallest, reasons = Json::object();
  std::vector<std::vector<Judged>> judged(groups.size());
  std::size_t done = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Group& group = groups[g];
    for (std::uint64_t k = 0; k < arguments.cases; ++k) {
      const Judged& c = judged[g].emplace_back(court.judge(group.make(arguments.seed + k), arguments.seed + k));
      progress(++done, groups.size() * arguments.cases);
      if (!c.not_asked.empty()) reasons[c.not_asked] = reasons.value(c.not_asked, std::size_t{0}) + 1;
      if (!c.breaks) continue;
      failures.push_back({{"family", group.family}, {"distance", group.distance}, {"seed", c.seed}, {"faces", c.faces}, {"mark", mark_names[static_cast<std::size_t>(c.mark)]}, {"why", c.why},
                          {"wrong_visible", c.grade.wrong_visible}, {"wrong_hidden", c.grade.wrong_hidden}, {"again", command_again(arguments, group, c.seed)}});
      if (!smallest.is_null() && smallest["faces"] <= c.faces) continue;
      smallest = failures.back();
      smallest["files"] = arguments.keep.empty() ? std::vector<std::string>() : keep_files(court, arguments.keep);
    }
    const auto pointers = [](const std::vector<Judged>& cases) {
      std::vector<const Judged*> all;
      for (const Judged& c : cases) all.push_back(&c);
      return all;
    };
    Json row{{"family", group.family}, {"distance", group.distance}};
    row.update(sums_of(pointers(judged[g])));
    rows.push_back(std::move(row));
  }
  std::vector<const Judged*> all;
  for (const std::vector<Judged>& cases : judged)
    for (const Judged& c : cases) all.push_back(&c);
  Json total{{"family", "all"}, {"distance", ""}};
  total.update(sums_of(all));
  result["holds"] = total["breaches"] == 0;
  result["rows"] = std::move(rows), result["total"] = total, result["not_asked"] = std::move(reasons), result["smallest"] = std::move(smallest), result["failures"] = std::move(failures);
  document["seconds"] = {{"all", watch.seconds()}};

  if (!arguments.html.empty()) write_file(arguments.html, judge_page(document));
  const std::string text = document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  if (arguments.json == "-") {
    std::cout << text << std::flush;
  } else {
    if (!arguments.json.empty()) write_file(arguments.json, text);
    print_table(document);
    print_verdict(document);
  }
  return total["breaches"] == 0 ? Exit::done : Exit::disagreement;
}

}  // namespace

}  // namespace sightline::app

void add_judge(CLI::App& app) {
  using namespace sightline::app;
  CLI::App* command = app.add_subcommand("judge", "Asks somebody else's program many cases, and grades its answers against the exact truth");
  auto a = std::make_shared<Judge_arguments>();
  command->add_option("--program", a->program, "its command, with {scene} {query} {answer} where the names of these files belong; quotes hold a word together")->required();
  command->add_option("--query", a->query, "what it is asked: order, see (from a point), weak (from a polygon)")->required()->check(CLI::IsMember(std::vector<std::string>(sightline::judge::question_names.begin(), sightline::judge::question_names.end())));
  command->add_option("--contract", a->contract, "what it promises: exact (no wrong face), conservative (never hides a visible one), aggressive (never shows a hidden one)")
      ->required()->check(CLI::IsMember(std::vector<std::string>(sightline::judge::contract_names.begin(), sightline::judge::contract_names.end())));
  command->add_option("--families", a->families, "which families of scenes, with commas (`sightline generate --help` lists them); by default all")->delimiter(',');
  command->add_option("--ulps", a->ulps, "how far from their degeneracy, with commas: 0 (exactly there), a number of ulps to either side, or far")->delimiter(',')->capture_default_str();
  command->add_option("--size", a->size, "how large the families' scenes are; 0: small")->check(whole_number)->capture_default_str();
  command->add_option("--scenes", a->scenes, "instead of families: a scene, or a folder of them")->check(not_empty);
  command->add_option("--cases", a->cases, "of each family at each distance, or of each scene")->check(whole_number)->capture_default_str();
  command->add_option("--seed", a->seed, "of the first case; the next has the next number")->check(whole_number)->capture_default_str();
  command->add_option("--time", a->time, "seconds for a case")->check(CLI::PositiveNumber & finite_number)->capture_default_str();
  command->add_option("--memory", a->memory, "MB for a case")->check(whole_number)->check(CLI::Range(1, 1 << 20))->capture_default_str();
  command->add_option("--format", a->format, "of the scene's file: off, obj, ply, stl with coordinates rounded to doubles, or qoff, exact")->check(CLI::IsMember({"off", "obj", "ply", "stl", "qoff"}))->capture_default_str();
  command->add_flag("--two-sided", a->two_sided, "faces seen from behind count too");
  command->add_flag("--cycles", a->cycles, "order: ask also where faces overlap in a cycle, so that some must be drawn in parts");
  command->add_option("--budget", a->budget, "seconds for the truth of a weak query; what is undecided then is not judged")->check(CLI::PositiveNumber & finite_number)->capture_default_str();
  command->add_option("--threads", a->threads, "for the truth; 0: one for each processor")->check(CLI::Range(0, 1024))->capture_default_str();
  command->add_option("--json", a->json, "write everything as JSON to this file, - for standard output");
  command->add_option("--html", a->html, "write a page to look at");
  command->add_option("--keep", a->keep, "a folder for the smallest case that breaks the contract: scene, query and answer");
  command->footer("The program reads the scene and the query, {\"query\": \"see\", \"eye\": [0.5, 2, 1], \"two_sided\": false} or {\"query\": \"weak\", \"source\": [[0, 0, 1], ...], ...}, and writes the answer:\n"
                  "the visible faces, one number a line, faces counted from 0; for order all faces, farthest first. `abstained 7` leaves face 7 open.\n"
                  "Example: sightline judge --program \"python3 mine.py {scene} {query} {answer}\" --query see --contract exact --html report.html\n"
                  "A wrong face, an answer outside of the protocol and a crash break the contract; to abstain, and to run out of time or memory, does not. Exit code 1: broken.\n"
                  "All of it: algorithms/judge/README.md.");
  set_action(*command, [a] { return run(*a); });
}
