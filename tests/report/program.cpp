// sightline report: a program that is wrong is found wrong, with the smallest scene; shards, resuming, bad input.

#include "../program/program.h"

#include <map>
#include <set>

namespace program {

namespace {

class Report_command : public Program {
 protected:
  std::vector<std::string> words(const std::vector<std::string>& more) const {
    std::vector<std::string> all{"report",      "--questions", "see",     "--families", "hinged,edge_on",
                                 "--distances", "0,1",         "--sizes", "0"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  /// A report as it is in a file, without what differs between runs.
  static nlohmann::json lasting(const std::string& text) {
    nlohmann::json report = nlohmann::json::parse(text, nullptr, false);
    report.erase("seconds");
    for (const char* list : {"rows", "summaries"})
      for (nlohmann::json& row : report["result"][list])
        for (const char* key : {"seconds", "worst_seconds", "peak_bytes"}) row.erase(key);
    return report;
  }
  /// Runs the command that shows an error again, where its scene is.
  Outcome again(const std::string& command, const std::string& more) const {
    const std::string script = file("again.sh", "cd " + path("kept").string() + " && " + executable +
                                                    command.substr(command.find(' ')) + more + "\n");
    Outcome outcome;
    outcome.code = WEXITSTATUS(std::system(("sh " + script + " > " + path("said").string()).c_str()));
    outcome.out = read_file(path("said"));
    return outcome;
  }
};

TEST_F(Report_command, finds_a_program_wrong_and_shows_the_smallest_scene) {
  const std::string blind = file("blind.sh", "echo '# nothing' > /dev/null; : > \"$3\"\n");  // it sees nothing
  const std::string json = path("report.json").string();
  const Outcome r = run(words({"--program", "see=sh " + blind + " {scene} {query} {answer}", "--keep",
                               path("kept").string(), "--reduce", sanitized ? "60" : "150", "--json", json, "--html",
                               path("report.html").string(), "--svg", path("report.svg").string()}));
  ASSERT_EQ(r.code, done) << r;
  const Json report = Json::parse(read_file(json));

  // 1. Exact kernels are right, the program is wrong wherever there is something to see, and doubles err here.
  std::map<std::string, Json> sums;
  for (const Json& s : report["result"]["summaries"]) sums[s["kernel"]] = s;
  for (const char* kernel : {"exact", "epeck", "gmpq"}) {
    EXPECT_EQ(sums.at(kernel)["wrong"], 0) << kernel;
    EXPECT_EQ(sums.at(kernel)["error"], 0) << kernel;
    EXPECT_EQ(sums.at(kernel)["cases"], 12) << kernel;
  }
  EXPECT_GE(sums.at("program")["wrong"], 6) << sums.at("program");
  EXPECT_EQ(sums.at("program")["crashed"], 0);
  EXPECT_GT(sums.at("program")["error"], 0);

  // 2. The smallest scene has one face, and the command shows the error.
  std::map<std::string, Json> examples;
  for (const Json& e : report["result"]["examples"])
    examples[e["method"].get<std::string>() + e["kernel"].get<std::string>()] = e;
  const Json& smallest = examples.at("sh " + blind + "program");
  EXPECT_EQ(smallest["faces"], 1) << smallest;
  EXPECT_EQ(read_file(path("kept") / smallest["file"].get<std::string>()), smallest["scene"]);
  const Outcome judged = again(smallest["again"], "");
  EXPECT_EQ(judged.code, disagreement) << smallest["again"] << judged.out;
  EXPECT_NE(judged.out.find("missing but visible"), std::string::npos) << judged.out;

  // 3. The same of a depth buffer, which this program's own `compare` asks.
  const Json& pixels = examples.at("depth buffer 64, 24 bitfloat");
  EXPECT_LE(pixels["faces"], 2);
  const Json compared = again(pixels["again"], " --json -").json();
  ASSERT_FALSE(compared.is_discarded()) << pixels["again"];
  EXPECT_GT(compared["result"]["rows"][1]["errors"]["wrong_area"], 0x1p-20) << compared["result"]["rows"];

  // 4. The page and the picture.
  const std::string page = read_file(path("report.html"));
  EXPECT_NE(page.find(smallest["file"].get<std::string>()), std::string::npos);
  EXPECT_LT(page.size(), 3'000'000u);
  EXPECT_NE(read_file(path("report.svg")).find("see: seconds against error"), std::string::npos);
}

TEST_F(Report_command, of_shards_and_resumed_is_the_same) {
  const auto ask = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> all{"--cases", "1", "--reduce", "20", "--quick", "--json", path(name).string()};
    all.insert(all.end(), more.begin(), more.end());
    return run(words(all));
  };
  ASSERT_EQ(ask("whole.json", {}).code, done);
  const nlohmann::json whole = lasting(read_file(path("whole.json")));
  EXPECT_EQ(whole["units"], 4);
  EXPECT_FALSE(whole["result"]["examples"].empty());

  // 1. Shards.
  for (const char* shard : {"0", "1", "2"})
    ASSERT_EQ(ask(std::string("part") + shard + ".json", {"--shard", std::string(shard) + "/3"}).code, done);
  const auto part = [&](int k) { return path("part" + std::to_string(k) + ".json").string(); };
  const Outcome merged = run({"report", "--merge", part(2), part(0), part(1), "--json", path("merged.json").string()});
  ASSERT_EQ(merged.code, done) << merged;
  EXPECT_EQ(lasting(read_file(path("merged.json"))), whole);
  const Outcome missing = run({"report", "--merge", part(2), part(0), "--json", "-"});
  EXPECT_EQ(missing.code, bad_input) << missing;
  EXPECT_NE(missing.err.find("shard 1 of 3 is missing"), std::string::npos) << missing;

  // 2. A unit a run, since the budget is over at once; then what is left.
  const std::vector<std::string> a_unit{"--resume", "--budget", "1e-9"};
  for (int k = 1; k <= 2; ++k) {
    const Outcome stopped = ask("resumed.json", a_unit);
    EXPECT_EQ(stopped.code, undecided) << stopped;
    EXPECT_TRUE(stopped.one_line_of_error()) << stopped;
    EXPECT_EQ(lasting(read_file(path("resumed.json")))["open"], 4 - k);
    EXPECT_TRUE(fs::exists(path("resumed.json.units")));
  }
  const Outcome unfinished = run({"report", "--merge", path("resumed.json").string(), "--json", "-"});
  EXPECT_EQ(unfinished.code, bad_input) << unfinished;
  std::ofstream(path("resumed.json.units"), std::ios::app) << "{\"unit\":3,\"ro";  // as an end in the middle leaves it
  const Outcome rest = ask("resumed.json", {"--resume"});
  ASSERT_EQ(rest.code, done) << rest;
  EXPECT_NE(rest.out.find("2 of 4 units were there"), std::string::npos) << rest;
  EXPECT_EQ(lasting(read_file(path("resumed.json"))), whole);
  EXPECT_FALSE(fs::exists(path("resumed.json.units")));
}

TEST_F(Report_command, resumed_asks_again_about_a_scene_that_changed_and_refuses_other_options) {
  if (sanitized) GTEST_SKIP() << "it asks ten times; the next tests, which resume and take shards, are sanitized";
  const std::string one = path("one.off").string(), two = path("two.off").string();
  const auto becomes = [&](const std::string& scene, const char* name) {
    fs::copy_file(corpus / "general" / name, scene, fs::copy_options::overwrite_existing);
  };
  const std::string program = file("mine.sh", ": > \"$3\"\n");
  const auto ask = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> all{"report",    one,
                                 two,         "--questions",
                                 "see",       "--cases",
                                 "1",         "--reduce",
                                 "1",         "--quick",
                                 "--program", "see=sh " + program + " {scene} {query} {answer}",
                                 "--json",    path(name).string()};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  };
  // 1. Both scenes are asked about, and then one of them is another.
  becomes(one, "cube.off");
  becomes(two, "cube.off");
  const auto begun = [&] {
    for (int k = 0; k < 2; ++k) {
      const Outcome r = ask("r.json", {"--resume", "--budget", "1e-9"});
      EXPECT_EQ(r.code, k == 0 ? undecided : done) << r;
      if (k == 0) fs::copy_file(path("r.json.units"), path("units"), fs::copy_options::overwrite_existing);
    }
    fs::copy_file(path("units"), path("r.json.units"));  // of one.off
  };
  begun();
  const Outcome same = ask("r.json", {"--resume"});
  ASSERT_EQ(same.code, done) << same;
  EXPECT_NE(same.out.find("1 of 2 units were there\n"), std::string::npos) << same;
  begun();
  becomes(one, "two_rooms.off");
  const Outcome other = ask("r.json", {"--resume"});
  ASSERT_EQ(other.code, done) << other;
  EXPECT_NE(other.out.find("0 of 2 units were there; 1 more were of files that have changed since"), std::string::npos)
      << other;
  ASSERT_EQ(ask("whole.json", {}).code, done);
  EXPECT_EQ(lasting(read_file(path("r.json"))), lasting(read_file(path("whole.json"))));
  ASSERT_EQ(ask("part0.json", {"--shard", "0/2"}).code, done);
  becomes(two, "two_rooms.off");
  ASSERT_EQ(ask("part1.json", {"--shard", "1/2"}).code, done);
  const Outcome changed =
      run({"report", "--merge", path("part0.json").string(), path("part1.json").string(), "--json", "-"});
  EXPECT_EQ(changed.code, bad_input) << changed;
  EXPECT_TRUE(changed.one_line_of_error()) << changed;
  EXPECT_NE(changed.err.find(two + " was another file for shard 1 than for shard 0"), std::string::npos) << changed;
  becomes(two, "cube.off");

  // 2. Another option, another program, and a file that is somebody else's: nothing is lost.
  ASSERT_EQ(ask("r.json", {"--resume", "--budget", "1e-9"}).code, undecided);
  const std::string units = read_file(path("r.json.units"));
  const auto refused = [&](const std::vector<std::string>& more, const std::string& names) {
    const Outcome r = ask("r.json", more);
    EXPECT_EQ(r.code, bad_input) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
    EXPECT_NE(r.err.find(names), std::string::npos) << r;
  };
  refused({"--resume", "--seed", "2"}, "--seed: 1, not 2");
  refused({"--resume", "--shard", "0/2"}, "--shard: 0/1, not 0/2");
  file("mine.sh", "true; : > \"$3\"\n");
  refused({"--resume"}, "--program's files");
  EXPECT_EQ(read_file(path("r.json.units")), units);
  std::string newer = units;
  newer.replace(newer.find("\"sightline\":\"") + 13, 1, "9");
  file("r.json.units", newer);
  refused({"--resume"}, "version 9");
  file("r.json.units", "my units");
  refused({"--resume"}, "is no file of --resume");
  EXPECT_EQ(read_file(path("r.json.units")), "my units");
}

TEST_F(Report_command, says_what_to_do_about_bad_input) {
  const std::string cube = (corpus / "general" / "cube.off").string();
  const std::string torn = file("torn.json", "{\"command\": \"rep"),
                    other = file("other.json", "{\"command\": \"see\"}"),
                    both_sides = file("both.json", R"({"query": "see", "eye": [3, 4, 5], "two_sided": true})");
  const std::string json = path("x.json").string();
  const std::string program = "sh " + file("p.sh", "exit 0\n") + " {scene} {query} {answer}";
  const std::vector<std::pair<std::vector<std::string>, int>> all{
      {{"report"}, usage},
      {{"report", "--html", path("x.txt").string()}, usage},
      {{"report", "--resume", "--html", path("x.html").string()}, usage},
      {{"report", "--json", json, "--shard", "3/2"}, usage},
      {{"report", "--json", json, "--shard", "x"}, usage},
      {{"report", "--json", json, "--families", "none"}, usage},
      {{"report", "--json", json, "--distances", "near"}, usage},
      {{"report", "--json", json, "--questions", "what"}, usage},
      {{"report", "--json", json, "--program", program}, usage},
      {{"report", "--json", json, "--program", "pvs=" + program}, usage},
      {{"report", "--json", json, "--ask", other}, usage},
      {{"report", cube, "--json", json, "--ask", both_sides, "--questions", "see,order"}, usage},
      {{"report", cube, "--json", json, "--ask", both_sides, "--questions", "see"}, usage},
      {{"report", cube, "--json", json, "--ask", both_sides, "--questions", "pvs"}, usage},
      {{"report", cube, "--json", json, "--ask", other, "--questions", "see"}, bad_input},
      {{"report", "--json", json, "--program", "see=sh x"}, usage},
      {{"report", "--json", json, "--questions", "order", "--program", "see=" + program}, usage},
      {words({"--json", json, "--program", "see=/none/there {scene} {query} {answer}"}), usage},
      {{"report", "--json", json, path("none.off").string()}, bad_input},
      {{"report", "--json", json, "--merge", torn}, bad_input},
      {{"report", "--json", json, "--merge", other}, bad_input},
      {{"report", "--json", json, "--merge", path("none.json").string()}, bad_input},
      {{"report", "--json", json, "--merge", other, "--shard", "0/2"}, usage},
      {{"report", "--json", torn, "--merge", torn}, usage}};
  for (const auto& [arguments, code] : all) {
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, code) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
  }
}

TEST_F(Report_command, asks_programs_what_rays_meet) {
  const std::string blind = file("no_hits.sh", "for ray in $(grep -o origin \"$2\"); do echo none; done > \"$3\"\n");
  const Outcome r =
      run({"report",     "--questions", "trace",       "--quick",
           "--families", "boxes",       "--distances", "0",
           "--sizes",    "0",           "--cases",     "2",
           "--reduce",   "30",          "--keep",      path("kept").string(),
           "--json",     "-",           "--program",   "trace=sh " + blind + " {scene} {query} {answer}"});
  ASSERT_EQ(r.code, done) << r;
  const Json result = r.json()["result"];
  bool is_there = false;
  for (const Json& s : result["summaries"]) {
    if (s["kernel"] != "program") continue;
    is_there = true;
    EXPECT_EQ(s["wrong"], 2) << s;
    EXPECT_GT(s["error"], 0.2);
    EXPECT_LT(s["error"], 1);
  }
  EXPECT_TRUE(is_there) << result["summaries"];
  bool is_shown = false;
  for (const Json& example : result["examples"]) {
    if (example["kernel"] != "program") continue;
    is_shown = true;
    EXPECT_NE(example["why"].get<std::string>().find("first meets face"), std::string::npos) << example["why"];
    EXPECT_EQ(again(example["again"], "").code, disagreement) << example["again"];
  }
  EXPECT_TRUE(is_shown) << result["examples"];
}

TEST_F(Report_command, asks_programs_for_set_operations) {
  // It gives both solids as they are, which wind twice round what they share, and have all that is inside either.
  const std::string both = file("both.sh", "cp \"$1\" \"$2\"\n");
  const Outcome r = run({"report", "--questions", "boolean", "--quick", "--families", "boxes,leaves", "--distances",
                         "0,far", "--cases", sanitized ? "2" : "4", "--reduce", "10", "--keep", path("kept").string(),
                         "--json", "-", "--program", "boolean=sh " + both + " {scene} {answer} {query}"});
  ASSERT_EQ(r.code, done) << r;
  const Json result = r.json()["result"];
  std::map<std::string, Json> sums;
  for (const Json& s : result["summaries"]) sums[s["kernel"]] = s;
  EXPECT_GE(sums.at("exact")["cases"], sanitized ? 4 : 8) << sums.at("exact");
  EXPECT_EQ(sums.at("exact")["wrong"], 0);
  EXPECT_EQ(sums.at("exact")["error"], 0);
  EXPECT_EQ(sums.at("float")["cases"], sums.at("exact")["cases"]);
  EXPECT_GT(sums.at("float")["error"], sums.at("double")["error"]);
  EXPECT_GE(sums.at("float")["wrong"], 1) << "what is an ulp thin is nothing in floats";
  EXPECT_GE(sums.at("program")["wrong"], 2) << sums.at("program");
  EXPECT_GT(sums.at("program")["error"], 0.1);
  std::set<std::string> shown;
  for (const Json& example : result["examples"]) {
    shown.insert(example["kernel"]);
    EXPECT_NE(example["why"].get<std::string>().find("the answer winds round it"), std::string::npos) << example["why"];
    const Outcome asked = again(example["again"], "");
    if (example["kernel"] == "program") {
      EXPECT_EQ(asked.code, disagreement) << example["again"];
      continue;
    }
    ASSERT_EQ(asked.code, done) << example["again"];
    const Json told = asked.json();
    for (const Json& s : told["result"]["summaries"])
      if (s["kernel"] == "exact" || s["kernel"] == example["kernel"]) {
        EXPECT_EQ(s["wrong"], s["kernel"] == "exact" ? 0 : 1) << s;
      }
  }
  EXPECT_EQ(shown.count("program") + shown.count("float"), 2u) << result["examples"];
}

/// Of one ray, along a square that it meets at its edge: who is asked it is wrong about all rays or about none.
TEST_F(Report_command, asks_methods_the_rays_of_a_file) {
  const std::string square = file("square.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"),
                    ray = file("ray.json",
                               R"({"query": "trace", "rays": [{"origin": [-1, 0.5, 0], "direction": [1, 0, 0]}]})");
  const Outcome r = run({"report", square, "--ask", ray, "--questions", "trace", "--quick", "--keep",
                         path("kept").string(), "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  const Json result = r.json()["result"];
  std::size_t exact = 0;
  for (const Json& row : result["rows"]) {
    exact += row["kernel"] == "exact";
    EXPECT_EQ(row["error"], row["kernel"] == "exact" ? 0 : 1) << row;
  }
  EXPECT_EQ(exact, 2u);
  for (const Json& example : result["examples"]) {
    const Outcome asked = again(example["again"], "");
    ASSERT_EQ(asked.code, done) << example["again"];
    const Json told = asked.json();
    for (const Json& row : told["result"]["rows"])
      if (row["method"] == example["method"]) {
        EXPECT_EQ(row["error"], 1) << example["again"];
      }
  }
}

/// A speck that is seen from behind, if both sides count; no random ray meets it.
TEST_F(Report_command, asks_methods_about_both_sides_where_a_file_does) {
  const std::string speck = file("speck.off", "OFF\n3 1 0\n0 0 0\n0 1e-6 0\n1e-6 0 0\n3 0 1 2\n");
  for (const bool both : {true, false}) {
    const std::string lamp =
        file("lamp.json", R"({"query": "weak", "source": [[-1,-1,2],[-1,1,2],[1,1,2],[1,-1,2]], "two_sided": )" +
                              std::string(both ? "true}" : "false}"));
    const Outcome r = run({"report", speck, "--ask", lamp, "--questions", "weak", "--quick", "--reduce", "1", "--json",
                           "-", "--keep", path("kept").string()});
    ASSERT_EQ(r.code, done) << r;
    const Json result = r.json()["result"];
    EXPECT_EQ(result["rows"].size(), 6u) << result;
    for (const Json& row : result["rows"])
      EXPECT_EQ(row["wrong"], both && row["method"].get<std::string>().starts_with("sample") ? 1 : 0) << both << row;
    if (!both) continue;
    ASSERT_FALSE(result["examples"].empty());
    const Outcome asked = again(result["examples"][0]["again"], " --json -");
    ASSERT_EQ(asked.code, done) << result["examples"][0]["again"];
    const Json told = asked.json();
    for (const Json& row : told["result"]["rows"])
      if (row["method"] == "sample") {
        EXPECT_EQ(row["errors"]["wrongly_hidden"], 1) << row;
      }
  }
}

TEST_F(Report_command, says_of_orders_too_large_to_be_compared_that_they_are_not_asked) {
  if (sanitized) GTEST_SKIP() << "three thousand faces in six kernels; other orders are sanitized";
  constexpr int faces = 3001;
  std::string scene = "OFF " + std::to_string(3 * faces) + ' ' + std::to_string(faces) + " 0\n";
  for (int k = 0; k < 3 * faces; ++k)
    scene += std::to_string(k / 3 * 3 + (k % 3 == 1)) + (k % 3 == 2 ? " 1 0\n" : " 0 0\n");
  for (int k = 0; k < 3 * faces; k += 3)
    scene += "3 " + std::to_string(k) + ' ' + std::to_string(k + 1) + ' ' + std::to_string(k + 2) + '\n';
  const Outcome r = run({"report", file("many.off", scene), "--questions", "order", "--quick", "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  const Json result = r.json()["result"];
  EXPECT_TRUE(result["rows"].empty()) << result["rows"];
  EXPECT_EQ(result["not_asked"].size(), 6u) << result["not_asked"];
  EXPECT_EQ(result["not_asked"]["many.off: an order of more than 3000 fragments by exact is compared in no pair"], 1)
      << result["not_asked"];
}

/// Beyond those of --memory; this test's own limit is all that is left.
TEST_F(Report_command, lets_programs_name_more_addresses_than_they_use) {
  const std::string wants = file("wants.sh",
                                 "most=$(ulimit -v); [ $most = unlimited ] || [ $most -ge 4194304 ] || exit 9\n"
                                 ": > \"$3\"\n");
  const Outcome r =
      run({"report", (corpus / "general" / "cube.off").string(), "--questions", "see", "--quick", "--memory", "64",
           "--json", "-", "--program", "see=sh " + wants + " {scene} {query} {answer}"});
  ASSERT_EQ(r.code, done) << r;
  const Json said = r.json();
  bool is_there = false;
  for (const Json& s : said["result"]["summaries"]) {
    if (s["kernel"] != "program") continue;
    is_there = true;
    EXPECT_EQ(s["crashed"], 0) << s;
  }
  EXPECT_TRUE(is_there) << said;
}

TEST_F(Report_command, of_an_answer_of_any_area_is_written_and_merged) {
  std::string cubes = "OFF 16 12 0\n";
  for (const char* x : {"0", "5"})
    for (const char* corner : {"0 0 0", "2 0 0", "2 2 0", "0 2 0", "0 0 2", "2 0 2", "2 2 2", "0 2 2"})
      cubes += std::to_string(std::atoi(x) + std::atoi(corner)) + (corner + 1) + '\n';
  const int sides[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  for (const int first : {0, 8})
    for (const auto& side : sides) {
      cubes += "4";
      for (const int corner : side) cubes += ' ' + std::to_string(first + corner);
      cubes += '\n';
    }
  const std::string huge = file("huge.off", "OFF 3 2 0\n0 0 9\n1e300 0 9\n0 1e300 9\n3 0 1 2\n3 0 2 1\n"),
                    ask = file("ask.json", R"({"query": "boolean", "operation": "difference", "first": 6})"),
                    json = path("r.json").string();
  const Outcome r =
      run({"report", file("cubes.off", cubes), "--ask", ask, "--questions", "boolean", "--quick", "--cases", "3",
           "--reduce", "1", "--json", json, "--html", path("r.html").string(), "--svg", path("r.svg").string(),
           "--program", "boolean=sh " + file("copy.sh", "cp $1 $2\n") + ' ' + huge + " {answer} {scene} {query}"});
  ASSERT_EQ(r.code, done) << r;
  const Json report = Json::parse(read_file(json));
  bool is_there = false;
  for (const Json& s : report["result"]["summaries"]) {
    if (s["kernel"] != "program") continue;
    is_there = true;
    EXPECT_EQ(s["wrong"], 3) << s;
    EXPECT_GT(s["error"].get<double>(), 1e200) << s;
  }
  EXPECT_TRUE(is_there) << report["result"]["summaries"];
  const Outcome merged = run({"report", "--merge", json, "--html", path("merged.html").string()});
  EXPECT_EQ(merged.code, done) << merged;
}

TEST_F(Report_command, merged_says_as_one_run_does_that_an_exact_method_erred) {
  const std::string json = path("r.json").string();
  ASSERT_EQ(
      run({"report", (corpus / "general" / "cube.off").string(), "--questions", "trace", "--quick", "--json", json})
          .code,
      done);
  EXPECT_EQ(run({"report", "--merge", json, "--json", "-"}).code, done);
  Json report = Json::parse(read_file(json));
  report["result"]["rows"][0]["wrong"] = report["result"]["rows"][0]["broken"] = 1;
  const std::string changed = file("changed.json", report.dump());
  EXPECT_EQ(run({"report", "--merge", changed, "--json", "-"}).code, disagreement);
}

/// Whether a process is there and not merely waited for.
bool is_alive(pid_t process) {
  const std::string stat = read_file("/proc/" + std::to_string(process) + "/stat");
  const std::size_t name_end = stat.rfind(')');
  return name_end != std::string::npos && stat[name_end + 2] != 'Z';
}

TEST_F(Report_command, that_is_ended_leaves_no_process_behind) {
  const std::string tells =
      file("tells.sh", "echo $PPID > " + path("told.part").string() + "; mv " + path("told.part").string() + ' ' +
                           path("told").string() + "; exec sleep 100\n");
  std::vector<std::string> words{executable,
                                 "report",
                                 (corpus / "general" / "cube.off").string(),
                                 "--questions",
                                 "see",
                                 "--quick",
                                 "--limit",
                                 "100",
                                 "--json",
                                 path("r.json").string(),
                                 "--quiet",
                                 "--program",
                                 "see=sh " + tells + " {scene} {query} {answer}"};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t report = 0;
  ASSERT_EQ(posix_spawn(&report, executable.c_str(), nullptr, nullptr, argv.data(), environ), 0);
  const auto waits_for = [](auto holds) {
    const int most = sanitized ? 6000 : 1500;
    for (int k = 0; k < most && !holds(); ++k) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return holds();
  };
  const bool asked = waits_for([&] { return fs::exists(path("told")); });
  kill(report, SIGTERM);
  waitpid(report, nullptr, 0);
  ASSERT_TRUE(asked);
  const pid_t child = std::stoi(read_file(path("told")));
  EXPECT_TRUE(waits_for([&] { return !is_alive(child); }));
}

/// Each example marks the faces that are wrong, or says why it marks none.
TEST_F(Report_command, marks_the_faces_that_are_wrong_of_each_question) {
  const Outcome r =
      run({"report", "--questions", "order,see,render,trace,cutset,pvs", "--quick", "--families",
           sanitized ? "leaves,boxes" : "leaves,boxes,exponents", "--distances", "0", "--sizes", "0", "--cases",
           sanitized ? "1" : "2", "--reduce", "10", "--keep", path("kept").string(), "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  const std::map<std::string, std::set<std::string>> names{
      {"order", {"nearer, or missing", "drawn over it"}},
      {"see", {"missing but visible", "shown but hidden"}},
      {"render", {"not shown where it is seen", "shown where it is not"}},
      {"trace", {"met, but not named", "named, but not met first"}},
      {"cutset", {"on-view, but not said to be", "off-view, but said to be on-view"}},
      {"pvs", {"seen by the cell, not said", "said, not seen by the cell"}}};
  std::map<std::string, std::size_t> marked, all;
  const Json report = r.json();
  for (const Json& example : report["result"]["examples"]) {
    const std::string question = example["question"];
    ++all[question];
    std::size_t groups = 0;
    for (const Json& group : example["view"]["groups"]) groups += names.at(question).count(group["name"]);
    marked[question] += groups > 0;
    const std::string why = example["why"];
    EXPECT_EQ(why.starts_with("no face is marked: "), groups == 0) << example;
    if (question == "cutset" || question == "pvs") {
      EXPECT_TRUE(example["view"].contains("eye")) << "the viewpoint, or a point of the cell";
    }
    if (question == "trace") {
      EXPECT_TRUE(why.starts_with("the ray from (")) << why;
    }
    if (groups > 0) {
      EXPECT_NE(example["picture"].get<std::string>().find("right"), std::string::npos) << "a key of the colours";
    }
  }
  for (const char* question : {"render", "cutset", "pvs"}) EXPECT_GT(all[question], 0u) << question;
  for (const char* question : {"render", "trace", "cutset", "pvs"})
    EXPECT_EQ(marked[question], all[question]) << question;
}

/// What `compare` says of one scene, of a folder, in shards: together they are what one run is.
TEST_F(Report_command, of_a_folder_passes_over_what_cannot_be_read_and_shards_add_up) {
  const fs::path folder = path("folder");
  fs::create_directories(folder / "more");
  for (const char* name : {"cube.off", "two_rooms.off"})
    fs::copy_file(corpus / "general" / name, folder / "more" / name);
  std::ofstream(folder / "torn.off") << "OFF 8";
  const auto ask = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> all{"report",           folder.string(), "--questions", "see,boolean,order",
                                 "--quick",          "--reduce",      "1",           "--json",
                                 path(name).string()};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  };
  ASSERT_EQ(ask("whole.json", {}).code, done);
  const nlohmann::json whole = lasting(read_file(path("whole.json")));
  EXPECT_EQ(whole["units"], 9);
  std::map<std::string, int> rows;
  for (const auto& row : whole["result"]["rows"])
    ++rows[row["question"].get<std::string>() + " of " + row["family"].get<std::string>()];
  EXPECT_EQ(rows["boolean of cube.off"], 3) << whole["result"];
  EXPECT_GT(rows["see of cube.off"], 3);
  EXPECT_GT(rows["see of two_rooms.off"], 3);
  EXPECT_EQ(rows["boolean of two_rooms.off"], 0);
  std::string not_asked = whole["result"]["not_asked"].dump();
  EXPECT_NE(not_asked.find("torn.off:1"), std::string::npos) << not_asked;
  EXPECT_NE(not_asked.find("two_rooms.off: a solid"), std::string::npos) << not_asked;
  std::vector<std::string> merge{"report", "--json", path("merged.json").string(), "--merge"};
  if (sanitized) return;  // each shard asks again; of_shards_and_resumed_is_the_same has shards, too
  const int shards = 8;
  for (int k = 0; k < shards; ++k) {
    const std::string part = "part" + std::to_string(k) + ".json";
    ASSERT_EQ(ask(part, {"--shard", std::to_string(k) + '/' + std::to_string(shards)}).code, done);
    merge.push_back(path(part).string());
  }
  const Outcome merged = run(merge);
  ASSERT_EQ(merged.code, done) << merged;
  EXPECT_EQ(lasting(read_file(path("merged.json"))), whole);
  // A scene that is named has to be one.
  const Outcome named = run({"report", (folder / "torn.off").string(), "--quick", "--questions", "see", "--json", "-"});
  EXPECT_EQ(named.code, bad_input) << named;
  EXPECT_TRUE(named.one_line_of_error()) << named;
}

TEST_F(Report_command, asks_about_scenes_and_counts_what_it_cannot_ask) {
  const Outcome r = run({"report", "--questions", "see,trace", "--quick", "--reduce", "1", "--json", "-",
                         (corpus / "general" / "cube.off").string(), (corpus / "general" / "two_rooms.off").string()});
  ASSERT_EQ(r.code, done) << r;
  const Json report = r.json();
  EXPECT_EQ(report["units"], 4);
  std::map<std::string, int> families;
  for (const Json& row : report["result"]["rows"]) {
    ++families[row["family"]];
    EXPECT_EQ(row["distance"], "as given");
  }
  EXPECT_EQ(families.size(), 2u);
  EXPECT_GT(families["cube.off"], 6);
  const Outcome huge = run({"report", "--questions", "see", "--quick", "--reduce", "1", "--json", "-",
                            (corpus / "robust" / "huge.off").string()});
  ASSERT_EQ(huge.code, done) << huge;
  EXPECT_EQ(huge.json()["result"]["rows"].size() + huge.json()["result"]["not_asked"].size() > 0, true) << huge.out;
}

}  // namespace

}  // namespace program
