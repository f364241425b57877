// compare: exact kernels make no errors, and inexact ones do on the scenes that were made for it; pixels make fewer the
// smaller they are, rays the more they are. And budgets.

#include "program.h"

#include <set>

#include <map>

namespace program {

class Compare : public Program {
 protected:
  std::map<std::string, Json> rows(const std::string& scene, const std::string& eye,
                                   const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"compare", scene, "order", "--eye", eye, "--json", "-"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome r = run(words);
    EXPECT_EQ(r.code, done) << r;
    std::map<std::string, Json> by_kernel;
    const Json d = r.json();
    for (const Json& row : d["result"]["rows"]) {
      EXPECT_EQ(row["status"], "done") << row;
      by_kernel[row["kernel"]] = row["errors"];
    }
    return by_kernel;
  }
  static void expect_no_error(const Json& errors) {
    EXPECT_EQ(errors["pairs_wrong"], 0) << errors;
    EXPECT_EQ(errors["pairs_wrong_beyond_rounding"], 0) << errors;
    EXPECT_EQ(errors["tiles_exactly"], true) << errors;
    for (const char* key :
         {"area_lost", "area_overlapping", "area_outside", "fragments_degenerate", "fragments_not_finite"})
      EXPECT_EQ(errors[key], 0) << key << errors;
    EXPECT_EQ(errors.value("sides_wrong", 0), 0) << errors;
  }
};

TEST_F(Compare, doubles_and_epick_order_far_leaves_wrongly_and_exact_kernels_do_not) {
  for (const char* seed : {"1", "2", "3"}) {
    const auto errors = rows((corpus / "robust" / "far_leaves.off").string(),
                             "8000000000000058,5714285714285786,5333333333333380", {"--seed", seed});
    for (const char* kernel : {"exact", "epeck", "gmpq"}) expect_no_error(errors.at(kernel));
    for (const char* kernel : {"epick", "double"}) {
      EXPECT_GE(errors.at(kernel)["pairs_wrong_beyond_rounding"], 1) << kernel << errors.at(kernel);
      EXPECT_GE(errors.at(kernel)["sides_wrong"], 1) << kernel << errors.at(kernel);
    }
    EXPECT_GT(errors.at("float")["area_lost"], 0.5) << "2^53 is out of reach of a float";
  }
}

TEST_F(Compare, floats_order_leaves_wrongly_that_doubles_order_rightly) {
  const auto errors = rows((corpus / "robust" / "far_leaves_float.off").string(), "8000058,5714356,5333380");
  for (const char* kernel : {"exact", "epeck", "gmpq", "epick", "double"}) expect_no_error(errors.at(kernel));
  EXPECT_GE(errors.at("float")["pairs_wrong_beyond_rounding"], 1) << errors.at("float");
}

TEST_F(Compare, exact_kernels_are_right_where_coordinates_leave_the_range_of_doubles) {
  for (const char* name : {"huge.off", "subnormal.off", "thirds.qoff", "non_planar.off"}) {
    const auto errors = rows((corpus / "robust" / name).string(), "7/3,1,2", {"--kernels", "exact,epeck,gmpq"});
    for (const char* kernel : {"exact", "epeck", "gmpq"}) expect_no_error(errors.at(kernel));
  }
}

TEST_F(Compare, whatever_becomes_of_an_inexact_kernel_is_its_status_and_no_disagreement) {
  const Outcome r =
      run({"compare", (corpus / "robust" / "huge.off").string(), "order", "--eye", "7/3,1,2", "--json", "-"});
  EXPECT_EQ(r.code, done) << r;
  const Json d = r.json();
  EXPECT_EQ(d["result"]["rows"].size(), 6u);
  for (const Json& row : d["result"]["rows"]) EXPECT_TRUE(row["status"].is_string() && row["status"] != "") << row;
}

TEST_F(Compare, only_the_kernels_asked_for_are_compared) {
  const auto errors = rows((corpus / "general" / "cornell.obj").string(), "5,-20,5", {"--kernels", "exact,double"});
  EXPECT_EQ(errors.size(), 2u);
  expect_no_error(errors.at("exact"));
}

TEST_F(Compare, too_many_fragments_leave_the_pairs_open) {
  const auto errors =
      rows((corpus / "general" / "cornell.obj").string(), "5,-20,5", {"--kernels", "exact", "--max-fragments", "3"});
  EXPECT_TRUE(errors.at("exact")["pairs_wrong"].is_null()) << errors.at("exact");
}

TEST_F(Compare, refuses_options_that_its_question_would_pass_over) {
  const std::string cube = (corpus / "general" / "cube.off").string(), svg = path("none.svg").string();
  const std::vector<std::pair<std::vector<std::string>, std::string>> all{
      {{"order", "--svg", svg}, "weak, render"},
      {{"bsp", "--svg", svg}, "weak, render"},
      {{"see", "--svg", svg}, "weak, render"},
      {{"trace", "--svg", svg}, "weak, render"},
      {{"pvs", "--svg", svg}, "weak, render"},
      {{"order", "--rays", "3"}, "weak, pvs"},
      {{"bsp", "--eye", "1,2,3"}, "order, see, render"},
      {{"trace", "--kernels", "exact"}, "order, bsp, see, weak, render"},
      {{"see", "--two-sided"}, "weak"},
      {{"see", "--size", "16x16"}, "weak, render"},
      {{"weak", "--from-face", "0", "--size", "16x16"}, "--svg"},
      {{"weak", "--from-face", "0", "--alpha", "0.5"}, "render"},
      {{"see", "--sightlines", svg}, "pvs"},
      {{"order", "--ray-file", cube}, "trace"},
      {{"trace", "--ray-file", cube, "--random", "3"}, "--random"}};
  for (const auto& [words, named] : all) {
    std::vector<std::string> arguments{"compare", cube};
    arguments.insert(arguments.end(), words.begin(), words.end());
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, usage) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
    EXPECT_NE(r.err.find(named), std::string::npos) << r;
  }
  EXPECT_FALSE(fs::exists(svg));
}

class Compare_visible : public Program {
 protected:
  /// Rows by kernel, or by size and bits.
  std::map<std::string, Json> rows(const std::vector<std::string>& words) {
    std::vector<std::string> all{"compare"};
    all.insert(all.end(), words.begin(), words.end());
    all.insert(all.end(), {"--json", "-"});
    const Outcome r = run(all);
    EXPECT_EQ(r.code, done) << r;
    std::map<std::string, Json> found;
    const Json d = r.json();
    EXPECT_EQ(d["result"]["question"], "see");
    for (const Json& row : d["result"]["rows"]) {
      EXPECT_EQ(row["status"], "done") << row;
      EXPECT_TRUE(row["seconds"].is_number() && row["peak_bytes"].is_number()) << row;
      found[row["method"] == "depth buffer" ? row["size"].dump() + "x" + row["bits"].dump()
                                            : row["kernel"].get<std::string>()] = row["errors"];
    }
    return found;
  }
  static void expect_no_error(const Json& errors) {
    for (const char* key : {"wrongly_visible", "wrongly_hidden", "missing", "not_finite"})
      EXPECT_EQ(errors[key], 0) << key << errors;
    for (const char* key : {"wrong_area", "largest_missing", "gaps", "overlaps"})
      EXPECT_LT(errors[key], 1e-15) << key << errors;
  }
};

TEST_F(Compare_visible, exact_kernels_see_the_same_and_more_pixels_are_less_wrong) {
  const std::string scene = path("town.qoff").string();
  ASSERT_EQ(run({"generate", "city_rotated", "--size", "20", "--seed", "4", "--out", scene}).code, done);
  const auto errors = rows({scene, "see", "--sizes", "32,256", "--bits", "16,32"});
  EXPECT_EQ(errors.size(), 9u);
  for (const char* kernel : {"exact", "epeck", "gmpq"}) expect_no_error(errors.at(kernel));
  for (const char* bits : {"x16", "x32"}) {
    EXPECT_GT(errors.at(std::string("256") + bits)["wrong_area"], 1e-5) << errors.at(std::string("256") + bits);
    EXPECT_GT(errors.at(std::string("32") + bits)["wrong_area"],
              2 * errors.at(std::string("256") + bits)["wrong_area"].get<double>());
  }
  EXPECT_LT(errors.at("double")["wrong_area"], 1e-2);
}

TEST_F(Compare_visible, exact_kernels_are_right_where_coordinates_leave_the_range_of_doubles) {
  for (const char* name : {"huge.off", "subnormal.off", "thirds.qoff", "non_planar.off"}) {
    const auto errors = rows({(corpus / "robust" / name).string(), "see", "--eye", "7/3,1,2", "--kernels",
                              "exact,epeck,gmpq", "--sizes", "8", "--bits", "24"});
    for (const char* kernel : {"exact", "epeck", "gmpq"}) expect_no_error(errors.at(kernel));
  }
}

TEST_F(Compare_visible, near_and_far_planes_are_those_given) {
  const std::string cube = (corpus / "general" / "cube.off").string();
  const Outcome r = run({"compare", cube, "see", "--kernels", "exact", "--sizes", "8", "--bits", "24", "--near", "0.5",
                         "--far", "1000", "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  const Json row = r.json()["result"]["rows"][1];
  EXPECT_EQ(row["near"], 0.5);
  EXPECT_EQ(row["far"], 1000);
}

TEST_F(Compare_visible, what_no_method_can_do_is_a_usage_error) {
  const std::string cube = (corpus / "general" / "cube.off").string();
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--kernels", "epick"},
                                               {"--sizes", "0"},
                                               {"--sizes", "100000"},
                                               {"--bits", "33"},
                                               {"--near", "-1"},
                                               {"--near", "2", "--far", "1"},
                                               {"--near", "1", "--far", "1.00000000001"}}) {
    std::vector<std::string> words{"compare", cube, "see"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome r = run(words);
    EXPECT_EQ(r.code, usage) << r;
  }
}

class Compare_weak : public Program {
 protected:
  const std::string rooms = (corpus / "general" / "two_rooms.off").string(),
                    lamp = "1,1,29/10 1,2,29/10 2,2,29/10 2,1,29/10";
};

TEST_F(Compare_weak, lines_make_no_error_and_rays_miss_fewer_faces_the_more_they_are) {
  const std::string svg = path("weak.svg").string();
  const Outcome r = run({"compare", rooms, "weak", "--from", lamp, "--rays", "100,10000", "--event-edges", "20",
                         "--svg", svg, "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  const Json result = r.json()["result"];
  EXPECT_EQ(result["question"], "weak");
  EXPECT_EQ(result["visible"], 89);
  EXPECT_EQ(result["hidden"], 53);
  EXPECT_EQ(result["undecided"], 0);
  std::map<std::string, Json> rows;
  for (const Json& row : result["rows"]) {
    const std::string name = row["method"] == "sample" ? row["rays"].dump() : row["method"].get<std::string>();
    if (name == "events") {
      EXPECT_EQ(row["status"].get<std::string>().rfind("left out: ", 0), 0u) << row;
      continue;
    }
    EXPECT_EQ(row["status"], "done") << row;
    EXPECT_TRUE(row["seconds"].is_number() && row["peak_bytes"].is_number()) << row;
    rows[name] = row["errors"];
  }
  ASSERT_EQ(rows.size(), 5u);
  for (const char* key : {"wrongly_visible", "wrongly_hidden", "undecided", "unjudged"})
    EXPECT_EQ(rows.at("lines")[key], 0) << key;
  EXPECT_EQ(rows.at("conservative")["wrongly_hidden"], 0);
  EXPECT_GT(rows.at("conservative")["wrongly_visible"], 0);
  EXPECT_GT(rows.at("100")["wrongly_hidden"], rows.at("10000")["wrongly_hidden"]);
  EXPECT_EQ(rows.at("100")["wrongly_visible"], 0);
  const std::string plot = read_file(svg);
  EXPECT_NE(plot.find(">conservative</text>"), std::string::npos);
  EXPECT_NE(plot.find(">0</text>"), std::string::npos);  // lines, which have none
}

TEST_F(Compare_weak, asks_events_of_small_scenes_and_only_the_kernels_given) {
  const std::string cube = (corpus / "general" / "cube.off").string();
  const Outcome r =
      run({"compare", cube, "weak", "--from", "-1,-1,3 -1,2,3 2,2,3 2,-1,3", "--kernels", "exact", "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  const Json rows = r.json()["result"]["rows"];
  ASSERT_EQ(rows.size(), 3u);
  for (const Json& row : rows) {
    EXPECT_EQ(row["kernel"], "exact");
    EXPECT_EQ(row["status"], "done") << row;
    EXPECT_EQ(row["visible"], 5) << row;
  }
  EXPECT_EQ(run({"compare", cube, "weak", "--from-face", "0", "--kernels", "epick"}).code, usage);
  EXPECT_EQ(run({"compare", cube, "weak"}).code, usage);
  EXPECT_EQ(run({"compare", cube, "weak", "--from-face", "0", "--rays", "-5"}).code, usage);
}

class Budget : public Program {};

TEST_F(Budget, that_runs_out_is_exit_4_and_one_line) {
  const std::string soup = path("soup.off").string();
  ASSERT_EQ(run({"generate", "soup_constant_density", "--size", "3000", "--out", soup}).code, done);
  for (const std::vector<std::string>& words : {std::vector<std::string>{"bsp", soup},
                                                {"order", soup, "--eye", "0.3,-2,0.1"},
                                                {"bsp", soup, "--json", "-"},
                                                {"bsp", soup, "--threads", "2"},
                                                {"bsp", soup, "--kernel", "double"}}) {
    std::vector<std::string> with_budget = words;
    with_budget.insert(with_budget.end(), {"--budget", "0.001"});
    const Outcome r = run(with_budget);
    EXPECT_EQ(r.code, undecided) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
    EXPECT_EQ(r.out, "") << r;
  }
}

// What comes before an answer, such as a scene's shades or a tree of boxes, asks for the time too.
TEST_F(Budget, that_is_over_at_once_costs_hardly_more_than_reading_the_scene) {
  if (sanitized) GTEST_SKIP() << "it is about seconds";
  const std::string city = path("city.off").string(), picture = path("x.png").string();
  ASSERT_EQ(run({"generate", "city", "--size", "3000", "--out", city}).code, done);
  const Outcome read = run({"info", city});
  ASSERT_EQ(read.code, done);
  std::vector<std::vector<std::string>> all{{"order"},
                                            {"graph"},
                                            {"see"},
                                            {"bsp"},
                                            {"cells"},
                                            {"shadow", "--sun", "1,2,-3"},
                                            {"weak", "--along", "0,0,200 100,50,90"}};
  for (const char* method : {"exact", "centres", "painter-min", "painter-max", "painter-mean", "newell", "bsp", "graph",
                             "scan-line", "warnock", "weiler-atherton", "bsp2d"})
    all.push_back({"render", "--method", method, "--png", picture});
  for (std::vector<std::string> words : all) {
    words.insert(words.begin() + 1, city);
    words.insert(words.end(), {"--budget", "1e-6", "--threads", "1"});
    const Outcome r = run(words);
    EXPECT_EQ(r.code, undecided) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
    EXPECT_LT(r.processor_seconds, 1.5 * read.processor_seconds + 0.1) << r;
  }
  EXPECT_FALSE(fs::exists(picture));
}

TEST_F(Budget, that_runs_out_in_boolean_ends_each_of_its_stages_and_nothing_is_written) {
  const std::string one = path("one.off").string(), other = path("other.off").string(), out = path("u.ply").string(),
                    certificate = path("c.json").string(), page = path("u.html").string();
  const std::string size = sanitized ? "800" : "4000";
  for (const auto& [file, seed] : {std::pair(one, "1"), {other, "2"}})
    ASSERT_EQ(run({"generate", "convex_sphere", "--size", size, "--seed", seed, "--out", file}).code, done);
  const std::vector<std::string> words{
      "boolean", "union",     one, other,     "--out", out,      "--html",        page,       "--json",
      "-",       "--threads", "1", "--round", "float", "--snap", "--certificate", certificate};
  const Outcome whole = run(words);
  ASSERT_EQ(whole.code, done) << whole;
  for (const std::string& file : {out, certificate, page}) ASSERT_TRUE(fs::remove(file));
  // 1. At once, and then later and later, until it suffices.
  std::set<std::string> stages;
  double at_once = 0;  // what comes before it is first asked about
  for (double budget = 1e-6;; budget = std::max(1.5 * budget, 0.03 * whole.processor_seconds)) {
    std::vector<std::string> late = words;
    late.insert(late.end(), {"--budget", std::to_string(budget)});
    const Outcome r = run(late);
    if (r.code == done && !stages.empty()) break;
    ASSERT_EQ(r.code, undecided) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
    EXPECT_EQ(r.out, "") << r;
    EXPECT_NE(r.err.find("; nothing is written"), std::string::npos) << r;
    for (const std::string& file : {out, certificate, page}) EXPECT_FALSE(fs::exists(file)) << r;
    if (stages.empty()) at_once = r.processor_seconds;
    if (!sanitized) {
      EXPECT_LT(r.processor_seconds, 1.5 * at_once + budget + 0.1) << r;
    }
    stages.insert(r.err.substr(r.err.find("ran out ") + 8, 60));
  }
  if (!sanitized) {
    EXPECT_LT(at_once, 0.5 * whole.processor_seconds);
  }
  EXPECT_GE(stages.size(), 3u);
  // 2. What suffices changes nothing.
  std::vector<std::string> in_time = words;
  in_time.insert(in_time.end(), {"--budget", "1e6"});
  EXPECT_EQ(run(in_time).code, done);
  EXPECT_TRUE(fs::exists(out));
}

TEST_F(Budget, that_runs_out_in_pvs_leaves_the_rest_undecided_at_once) {
  const std::string house = path("house.off").string();
  ASSERT_EQ(run({"generate", "rooms", "--size", "2", "--out", house}).code, done);
  for (const char* more : {"--outside", "--cells-too"}) {  // what it takes without a budget: some three seconds
    double budget = sanitized ? 0.6 : 0.2;
    Outcome r;
    for (; r.out.empty() && budget < 30; budget *= 1.5) {  // on a busy machine there may be no time for the cells
      r = run({"pvs", house, more, "--budget", std::to_string(budget), "--json", "-"}, {.seconds = 30});
      ASSERT_EQ(r.code, undecided) << r;
    }
    const Json written = r.json();
    EXPECT_GT(written["result"]["undecided"], 0);
    EXPECT_LT(written["seconds"]["pvs"], budget + (sanitized ? 15 : 1)) << more;
  }
}

TEST_F(Budget, that_runs_out_while_regions_are_made_is_exit_4_before_there_is_a_table) {
  const std::string soup = path("soup.off").string();  // its cells take a tenth of a second, its regions 100 times that
  ASSERT_EQ(run({"generate", "soup", "--size", "300", "--out", soup}).code, done);
  const Outcome r = run({"pvs", soup, "--coarse", "1", "--out", path("table.pvs").string(), "--budget", "0.5"});
  EXPECT_EQ(r.code, undecided) << r;
  EXPECT_TRUE(r.one_line_of_error()) << r;
  EXPECT_FALSE(fs::exists(path("table.pvs")));
}

TEST_F(Budget, of_compare_is_for_the_truth_and_what_that_leaves_open_is_not_judged) {
  const std::string house = path("house.off").string(), ball = path("ball.off").string();
  ASSERT_EQ(run({"generate", "rooms", "--size", "2", "--out", house}).code, done);
  ASSERT_EQ(run({"generate", "convex_sphere", "--size", "4000", "--out", ball}).code, done);
  Outcome r;
  for (double budget = 0.1; r.out.empty() && budget < 30; budget *= 1.5) {  // there may be no time for the cells
    r = run({"compare", house, "pvs", "--rays", "10", "--budget", std::to_string(budget), "--json", "-"});
    ASSERT_EQ(r.code, undecided) << r;
  }
  const Json result = r.json()["result"];
  EXPECT_GT(result["undecided"], 0);
  ASSERT_EQ(result["rows"][1]["method"], "rays");
  if (result["rows"][1]["status"] == "done") {
    EXPECT_EQ(result["rows"][1]["errors"]["wrongly_visible"], 0);
  }
  // A volume that takes minutes to be made a source.
  const Outcome weak =
      run({"compare", house, "weak", "--from-volume", ball, "--rays", "10", "--budget", "0.1"}, {.seconds = 20});
  EXPECT_EQ(weak.code, undecided) << weak;
  EXPECT_TRUE(weak.one_line_of_error()) << weak;
}

TEST_F(Budget, that_runs_out_while_sizes_are_measured_leaves_the_rest_unmeasured) {
  if (sanitized) GTEST_SKIP() << "it is about seconds; other tests measure sizes under sanitizers";
  const std::string house = path("house.off").string();
  ASSERT_EQ(run({"generate", "rooms", "--size", "2", "--out", house}).code, done);
  Json row;
  std::size_t wrong = 0;
  for (double budget = 0.1; wrong <= 200 && budget < 30; budget *= 1.5) {  // there may be no time for the truth
    const Outcome r = run({"compare", house, "pvs", "--rays", "10", "--budget", std::to_string(budget), "--json", "-"},
                          {.seconds = 60});
    if (r.out.empty()) continue;
    row = r.json()["result"]["rows"][1];
    ASSERT_EQ(row["method"], "rays");
    if (row["status"] == "done") wrong = row["errors"]["wrongly_hidden"].get<std::size_t>();
  }
  ASSERT_GT(wrong, 200u);
  EXPECT_LT(row["sizes"]["wrongly_hidden"]["measured"].get<std::size_t>(), wrong / 2)
      << "looking from so many points takes longer";
  EXPECT_FALSE(row.contains("sample"));
}

TEST_F(Budget, that_runs_out_before_there_are_cells_is_exit_4) {
  const std::string city = path("city.off").string();  // its cells take a second and more
  ASSERT_EQ(run({"generate", "city", "--size", "2000", "--out", city}).code, done);
  const Outcome r = run({"pvs", city, "--out", path("table.pvs").string(), "--budget", "0.01"});
  EXPECT_EQ(r.code, undecided) << r;
  EXPECT_TRUE(r.one_line_of_error()) << r;
  EXPECT_FALSE(fs::exists(path("table.pvs")));
}

TEST_F(Budget, that_runs_out_in_verify_is_exit_4) {
  const std::string scene = path("soup.off").string(), certificate = path("c.json").string();
  ASSERT_EQ(run({"generate", "soup", "--size", "300", "--out", scene}).code, done);
  for (const std::vector<std::string>& words : {std::vector<std::string>{"order", "--eye", "3,2,1"},
                                                {"see", "--eye", "3,2,1"},
                                                {"graph"},
                                                {"weak", "--from-face", "0"}}) {
    std::vector<std::string> made = words;
    made.insert(made.begin() + 1, scene);
    made.insert(made.end(), {"--certificate", certificate});
    ASSERT_EQ(run(made).code, done) << words[0];
    const Outcome r = run({"verify", scene, certificate, "--budget", "1e-9"});
    EXPECT_EQ(r.code, undecided) << words[0] << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
  }
}

TEST_F(Budget, that_runs_out_in_verify_of_solids_and_in_info_is_exit_4) {
  const std::string cube = (corpus / "general" / "cube.off").string(), certificate = path("c.json").string();
  ASSERT_EQ(run({"boolean", "union", cube, cube, "--out", path("u.off").string(), "--certificate", certificate}).code,
            done);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"verify", cube, certificate, "--solid", cube}, {"info", cube}}) {
    std::vector<std::string> late = words;
    late.insert(late.end(), {"--budget", "1e-9"});
    const Outcome r = run(late);
    EXPECT_EQ(r.code, undecided) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
    EXPECT_EQ(run(words).code, done);
  }
}

TEST_F(Budget, of_compare_is_for_each_kernel_and_an_exact_one_that_is_late_is_exit_4) {
  const std::string scene = path("soup.off").string();
  ASSERT_EQ(run({"generate", "soup", "--size", "3000", "--out", scene}).code, done);
  const Outcome r = run({"compare", scene, "bsp", "--budget", "0.001", "--json", "-"});
  EXPECT_EQ(r.code, undecided) << r;
  const Json d = r.json();
  for (const Json& row : d["result"]["rows"]) EXPECT_EQ(row["status"], "timed out") << row;
}

TEST_F(Budget, that_suffices_changes_nothing) {
  const std::string cube = (corpus / "general" / "cube.off").string();
  for (const char* seconds : {"30", "1e12", "0"}) {
    EXPECT_EQ(run({"bsp", cube, "--budget", seconds}).code, done) << seconds;
    EXPECT_EQ(run({"compare", cube, "bsp", "--kernels", "exact,double", "--budget", seconds}).code, done) << seconds;
  }
}

/// The methods that show a wrong pixel; `exact` among them where a mean of it is off.
static std::set<std::string> wrong_methods(const Json& table) {
  std::set<std::string> wrong;
  for (const Json& row : table["result"]["rows"]) {
    if (row.contains("samples")) continue;  // never right: see means_of_pixels_...
    if (row["errors"][row["method"] == "exact" ? "off" : "wrong"] > 0) wrong.insert(row["method"].get<std::string>());
  }
  return wrong;
}

TEST_F(Compare, finds_wrong_in_each_sketch_whom_it_was_made_for_and_nobody_else) {
  using Names = std::set<std::string>;
  struct Sketch {
    std::string scene;
    std::vector<std::string> view;
    Names wrong, perhaps;
  };
  const std::vector<std::string> ahead{"--eye", "0,0,0", "--look", "0,0,-1", "--up", "0,1,0", "--field", "100"};
  const std::vector<Sketch> sketches{
      {"painter_min.off", ahead, {"painter-min"}, {}},
      {"painter_max.off", ahead, {"painter-max"}, {}},
      {"painter_mean.off", ahead, {"painter-mean"}, {}},
      {"depth_resolution.off", ahead, {"depth"}, {}},
      {"three_bars.off", {"--eye", "4,3,20"}, {"painter-min", "painter-max", "painter-mean"}, {"depth", "rays"}},
      {"u_and_quad.off", {"--eye", "3,3,20"}, {"painter-min", "painter-max"}, {"depth"}},
      {"crossing_quads.obj", {"--eye", "2,-3,2"}, {"painter-min", "painter-max", "painter-mean"}, {"depth", "rays"}}};
  for (const Sketch& sketch : sketches) {
    std::vector<std::string> words{"compare", (corpus / "general" / sketch.scene).string(), "render", "--size",
                                   "200x150"};
    words.insert(words.end(), sketch.view.begin(), sketch.view.end());
    words.insert(words.end(), {"--json", "-"});
    const Outcome r = run(words);
    ASSERT_EQ(r.code, done) << r;
    Names wrong = wrong_methods(r.json());
    for (const std::string& name : sketch.perhaps) wrong.erase(name);
    EXPECT_EQ(wrong, sketch.wrong) << sketch.scene;
  }
}

/// The row of a method with so many samples, or without any.
static Json row_of(const Json& table, const std::string& method, int samples = 0) {
  for (const Json& row : table["result"]["rows"])
    if (row["method"] == method && row.value("samples", 0) == samples) return row;
  return nullptr;
}

TEST_F(Compare, holds_means_of_pixels_to_areas_and_samples_to_means) {
  const std::vector<std::string> words{
      "compare", (corpus / "general" / "crossing_quads.obj").string(), "render", "--eye", "2,-3,2", "--size", "60x40"};
  const auto asked = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = words;
    all.insert(all.end(), more.begin(), more.end());
    all.insert(all.end(), {"--json", "-"});
    const Outcome r = run(all);
    EXPECT_EQ(r.code, done) << r;
    return r.json();
  };
  const Json table = asked({"--samples", "2,8"}), exact = row_of(table, "exact")["errors"];
  EXPECT_EQ(exact["compared"], 256);
  EXPECT_EQ(exact["off"], 0);
  EXPECT_EQ(exact["missing"], 0);
  EXPECT_LT(exact["largest"].get<double>(), 1e-6);
  if (const Json few = row_of(table, "rays", 2), many = row_of(table, "rays", 8); !few.is_null()) {
    EXPECT_EQ(few["errors"]["compared"], 60 * 40);
    EXPECT_GT(few["errors"]["off"], 0);
    EXPECT_GT(few["errors"]["mean"].get<double>(), 2 * many["errors"]["mean"].get<double>());
    EXPECT_EQ(few["errors"]["missing"], 0);
  }
  // Glass: no samples, and the same oracle.
  const Json glass = asked({"--alpha", "0.5"});
  EXPECT_EQ(row_of(glass, "exact")["errors"]["off"], 0);
  EXPECT_FALSE(row_of(glass, "exact")["errors"].contains("missing"));
  EXPECT_TRUE(row_of(glass, "rays", 4).is_null());
  const Outcome printed = run(words);
  EXPECT_NE(printed.out.find("means over pixels"), std::string::npos) << printed;
}

TEST_F(Compare, counts_faces_that_no_sample_meets) {
  // A sliver 0.15 of a pixel wide, beside the middle of one: centres miss it, and so do 2 x 2 samples.
  std::ofstream(path("sliver.off")) << "OFF\n8 2 0\n-5 -5 -2\n5 -5 -2\n5 5 -2\n-5 5 -2\n"
                                       "0.03 -1 -1\n0.045 -1 -1\n0.045 1 -1\n0.03 1 -1\n4 0 1 2 3\n4 4 5 6 7\n";
  const Outcome r = run({"compare", path("sliver.off").string(), "render", "--eye", "0,0,0", "--look", "0,0,-1", "--up",
                         "0,1,0", "--field", "90", "--size", "20x20", "--samples", "2,16", "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  const Json table = r.json();
  EXPECT_EQ(row_of(table, "exact")["errors"]["missing"], 0);
  if (const Json few = row_of(table, "rays", 2), many = row_of(table, "rays", 16); !few.is_null()) {
    EXPECT_EQ(few["errors"]["missing"], 1);
    EXPECT_NEAR(few["errors"]["largest_missing"].get<double>(), 20 * 0.15, 1e-3);
    EXPECT_EQ(many["errors"]["missing"], 0);
  }
}

TEST_F(Compare, plots_pictures) {
  const fs::path svg = path("render.svg");
  const Outcome r = run({"compare", (corpus / "general" / "painter_min.off").string(), "render", "--size", "40x30",
                         "--svg", svg.string()});
  EXPECT_EQ(r.code, done) << r;
  const std::string text = read_file(svg);
  for (const char* method : {"painter-min", "warnock", "depth"})
    EXPECT_NE(text.find(method), std::string::npos) << method;
}

}  // namespace program
