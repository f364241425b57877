// The command line: help that teaches, and usage errors.

#include "program.h"
#include "terminal.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <regex>
#include <map>

namespace program {

class Command_line : public Program {
 protected:
  const std::string cube = (corpus / "general" / "cube.off").string();

  void expect_usage_error(const std::vector<std::string>& arguments, const std::string& mentions = "") {
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, usage) << r;
    EXPECT_EQ(r.out, "") << r;
    EXPECT_FALSE(r.err.empty()) << r;
    EXPECT_NE(r.err.find(mentions), std::string::npos) << "no '" << mentions << "' in: " << r;
  }
  void expect_bad_eye(const std::string& eye) {
    SCOPED_TRACE("--eye '" + eye + "'");
    const Outcome r = run({"order", cube, "--eye", eye});
    EXPECT_EQ(r.code, usage) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
    EXPECT_NE(r.err.find("--eye"), std::string::npos) << r;
    EXPECT_EQ(r.out, "") << r;
  }
};

static const std::map<std::string, std::vector<std::string>> options_of_commands{
    {"info", {"SCENE"}},
    {"bsp", {"SCENE", "--kernel", "--candidates"}},
    {"order",
     {"SCENE", "--eye", "--kernel", "--front-to-back", "--skip-hidden", "--certificate", "--svg", "--look", "--up",
      "--field"}},
    {"graph", {"SCENE", "--method", "--tree", "--codes", "--split", "--pixels"}},
    {"shadow", {"SCENE", "--light", "--sun", "--two-sided", "--svg", "--obj"}},
    {"trace", {"SCENE", "--rays", "--all", "--closed", "--method"}},
    {"cutset", {"SCENE", "--path", "--orbit", "--motion", "--decision-tree", "--check", "--svg"}},
    {"verify", {"SCENE", "CERTIFICATE"}},
    {"compare", {"SCENE", "--eye", "--kernels", "--max-fragments"}},
    {"generate", {"FAMILY", "--size", "--seed", "--ulps", "--offset", "--scale", "--out", "--query"}},
    {"fuzz",
     {"COMMAND", "--seconds", "--scenes", "--seed", "--family", "--max-faces", "--case", "--scene", "--query",
      "--check", "--out", "--json"}},
    {"reduce", {"SCENE", "PROGRAM", "--out", "--query", "--code", "--html", "--limit", "--seconds"}},
};

TEST_F(Command_line, help_names_every_command) {
  for (const char* option : {"--help", "-h"}) {
    const Outcome r = run({option});
    EXPECT_EQ(r.code, done) << r;
    EXPECT_EQ(r.err, "") << r;
    for (const auto& [command, options] : options_of_commands)
      EXPECT_NE(r.out.find("  " + command + " "), std::string::npos) << command << r;
  }
}

TEST_F(Command_line, help_of_each_command_names_each_of_its_options) {
  for (const auto& [command, options] : options_of_commands) {
    const Outcome r = run({command, "--help"});
    EXPECT_EQ(r.code, done) << r;
    EXPECT_EQ(r.err, "") << r;
    std::vector<std::string> all = options;
    if (command != "generate" && command != "fuzz" && command != "reduce")
      all.insert(all.end(), {"--json", "--coordinates", "--threads", "--seed", "--budget"});
    for (const std::string& option : all)
      EXPECT_NE(r.out.find(option), std::string::npos) << option << " is not in " << r;
  }
}

TEST_F(Command_line, help_of_generate_lists_the_kinds_with_the_meaning_of_their_size) {
  const Outcome r = run({"generate", "--help"});
  EXPECT_NE(r.out.find("rooms "), std::string::npos) << r;
  EXPECT_NE(r.out.find("(size:"), std::string::npos) << r;
}

TEST_F(Command_line, version_is_a_line) {
  const Outcome r = run({"--version"});
  EXPECT_EQ(r.code, done) << r;
  EXPECT_EQ(r.out.rfind("sightline ", 0), 0u) << r;
  EXPECT_EQ(r.out.find('\n'), r.out.size() - 1) << r;
  for (const char* library : {"CGAL 5.", "GMP 6.", "MPFR ", "oneTBB 20", "Boost 1."})
    EXPECT_NE(r.out.find(library), std::string::npos) << library << r;
}

TEST_F(Command_line, quiet_leaves_files_exit_codes_and_errors) {
  const std::string scene = (corpus / "general" / "two_rooms.off").string(), made = path("made.json").string();
  for (const std::vector<std::string>& words : {std::vector<std::string>{"info", scene},
                                                {"order", scene, "--certificate", made},
                                                {"verify", scene, made},
                                                {"see", scene, "--eye", "1,1,2"},
                                                {"compare", scene, "--kernels", "exact,double"},
                                                {"cells", scene},
                                                {"fuzz", "see", "--scenes", "2"}}) {
    const Outcome loud = run(words);
    std::vector<std::string> quietly = words;
    quietly.push_back("--quiet");
    const Outcome r = run(quietly);
    EXPECT_EQ(r.code, loud.code) << r;
    EXPECT_EQ(r.code, done) << r;
    EXPECT_EQ(r.out + r.err, "") << words[0];
    EXPECT_NE(loud.out, "") << words[0];
  }
  EXPECT_TRUE(fs::exists(made));
  EXPECT_EQ(run({"info", scene, "--json", "-", "--quiet"}).json()["command"], "info") << "an output is no row";
  const Outcome wrong = run({"verify", (corpus / "general" / "cube.off").string(), made, "--quiet"});
  EXPECT_EQ(wrong.code, disagreement);
  EXPECT_EQ(wrong.out, "");
  const Outcome missing = run({"info", path("none.off").string(), "--quiet"});
  EXPECT_EQ(missing.code, bad_input);
  EXPECT_TRUE(missing.one_line_of_error()) << missing;
  EXPECT_EQ(run({"schema", "info", "--quiet"}).code, usage) << "its answer is what it prints";
}

TEST_F(Command_line, no_command_or_an_unknown_one_is_a_usage_error) {
  expect_usage_error({});
  expect_usage_error({"watch", cube}, "watch");
  expect_usage_error({cube});
}

TEST_F(Command_line, unknown_options_are_usage_errors) {
  for (const auto& [command, options] : options_of_commands) expect_usage_error({command, "--no-such-option"});
  expect_usage_error({"info", cube, "--eye", "0,0,0"}, "eye");
}

TEST_F(Command_line, missing_and_surplus_arguments_are_usage_errors) {
  for (const auto& [command, options] : options_of_commands) expect_usage_error({command});
  expect_usage_error({"info", cube, cube});
  expect_usage_error({"verify", cube}, "CERTIFICATE");
  expect_usage_error({"generate", "rooms"}, "--out");
  expect_usage_error({"info", cube, "--json"}, "--json");
}

TEST_F(Command_line, values_out_of_range_are_usage_errors) {
  for (const char* threads : {"-1", "1025", "two", "1.5", ""})
    expect_usage_error({"info", cube, "--threads", threads}, "--threads");
  for (const char* seed : {"-1", "x", "18446744073709551616", "1e3"})
    expect_usage_error({"bsp", cube, "--seed", seed}, "--seed");
  for (const char* seed : {"010", "00", "08", "0x10"})  // octal, or hexadecimal, to some
    expect_usage_error({"bsp", cube, "--seed", seed}, "--seed");
  expect_usage_error({"bsp", cube, "--threads", "02"}, "--threads");
  for (const char* budget : {"-1", "soon"}) expect_usage_error({"bsp", cube, "--budget", budget}, "--budget");
  for (const char* field : {"0", "180", "wide", "nan"})
    expect_usage_error({"order", cube, "--eye", "3,4,5", "--field", field}, "--field");
  for (const char* candidates : {"0", "1001", "-1"})
    expect_usage_error({"bsp", cube, "--candidates", candidates}, "--candidates");
  expect_usage_error({"bsp", cube, "--kernel", "exakt"}, "exakt");
  expect_usage_error({"info", cube, "--coordinates", "float"}, "float");
  expect_usage_error({"compare", cube, "bsp", "--kernels", "exact,magic"}, "magic");
  expect_usage_error({"compare", cube, "cutset"}, "cutset");
}

TEST_F(Command_line, a_number_out_of_range_is_told_in_few_words) {
  for (const char* budget : {"-1", "soon", "1e400"})
    expect_usage_error({"bsp", cube, "--budget", budget}, '"' + std::string(budget) + "\" is not a number >= 0");
  expect_usage_error({"fuzz", "order", "--seconds", "0"}, "\"0\" is not a number > 0");
  EXPECT_LT(run({"bsp", cube, "--budget", "-1"}).err.size(), 100u);
}

TEST_F(Command_line, a_budget_that_is_no_number_is_a_usage_error) {
  expect_usage_error({"bsp", cube, "--budget", "nan"}, "--budget");
}

TEST_F(Command_line, order_wants_an_eye_of_three_exact_numbers) {
  for (const char* eye :
       {"",          "1,2",      "1,2,3,4",         "1,2,",    ",1,2",     ",,",        "a,b,c",     "1;2;3",
        "1 2 3",     "1, 2, 3",  "nan,0,0",         "inf,0,0", "0,-inf,0", "1/0,0,0",   "1/,0,0",    "/2,0,0",
        "1/2/3,0,0", "0x10,0,0", "1e999999999,0,0", "1e,0,0",  "--1,0,0",  "1.2.3,0,0", "1.5/2,0,0", "1#,0,0",
        "1,2,3\n"})
    expect_bad_eye(eye);
}

TEST_F(Command_line, order_takes_decimals_fractions_signs_and_exponents_as_eye) {
  for (const auto& [eye, read] : std::map<std::string, std::vector<std::string>>{
           {"-1,-2,-3", {"-1", "-2", "-3"}},
           {"1/3,-2/4,+5", {"1/3", "-1/2", "5"}},
           {"0.1,1e2,-.5", {"1/10", "100", "-1/2"}},
           {"1e-30,0,1.", {"1/1000000000000000000000000000000", "0", "1"}}}) {
    for (const std::vector<std::string>& spelling : {std::vector<std::string>{"--eye", eye}, {"--eye=" + eye}}) {
      std::vector<std::string> words{"order", cube, "--json", "-"};
      words.insert(words.end(), spelling.begin(), spelling.end());
      const Outcome r = run(words);
      ASSERT_EQ(r.code, done) << r;
      EXPECT_EQ(r.json()["result"]["eye"], Json(read)) << r;
    }
  }
}

TEST_F(Command_line, directions_of_a_picture_are_three_exact_numbers) {
  const std::string svg = path("a.svg").string();
  expect_usage_error({"order", cube, "--eye", "3,4,5", "--svg", svg, "--look", "1,2"}, "--look");
  expect_usage_error({"order", cube, "--eye", "3,4,5", "--svg", svg, "--up", "up"}, "--up");
  for (const char* option : {"--look", "--up"})
    for (const char* zero : {"0,0,0", "-0,0/7,0e5", "1e-400,0,0"})
      expect_usage_error({"see", cube, "--svg", svg, option, zero},
                         std::string(option) + " wants a direction that is not 0,0,0");
  EXPECT_FALSE(fs::exists(svg));
}

TEST_F(Command_line, an_eye_that_is_not_given_is_outside_the_scene) {
  const Outcome r = run({"order", cube, "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  const Json eye = r.json()["result"]["eye"];
  ASSERT_EQ(eye.size(), 3u);
  EXPECT_EQ(eye[1].get<std::string>()[0], '-') << "before the scene: " << eye;
  EXPECT_EQ(run({"compare", cube, "order", "--kernels", "exact,double"}).code, done);
  EXPECT_EQ(run({"order", (corpus / "robust" / "huge.off").string()}).code, done);
}

TEST_F(Command_line, compare_wants_an_eye_of_three_numbers_if_any) {
  expect_usage_error({"compare", cube, "order", "--eye", "1,2"}, "--eye");
  expect_usage_error({"compare", cube, "order", "--eye", ""}, "--eye");
  EXPECT_EQ(run({"compare", cube, "bsp", "--kernels", "exact"}).code, done);
}

TEST_F(Command_line, generate_wants_a_family_that_there_is) {
  expect_usage_error({"generate", "castle", "--out", path("a.off").string()}, "castle");
  EXPECT_FALSE(fs::exists(path("a.off")));
}

TEST_F(Command_line, what_would_be_ignored_is_refused) {
  for (const std::vector<std::string>& command : {std::vector<std::string>{"order", cube, "--eye", "5,5,5"},
                                                  {"see", cube, "--eye", "5,5,5"},
                                                  {"weak", cube, "--from-face", "0"},
                                                  {"shadow", cube, "--light", "5,5,5"},
                                                  {"pvs", cube}})
    for (const std::vector<std::string>& option : {std::vector<std::string>{"--field", "30"},
                                                   {"--look", "1,0,0"},
                                                   {"--up", "1,0,0"},
                                                   {"--shade", "none"},
                                                   {"--size", "64x64"},
                                                   {"--background", "#000000"}}) {
      std::vector<std::string> words = command;
      words.insert(words.end(), option.begin(), option.end());
      expect_usage_error(words, "add --svg FILE");
    }
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"weak", cube, "--from-face", "0", "--eye", "1,1,1"}, {"pvs", cube, "--eye", "1,1,1"}})
    expect_usage_error(words, "--eye");
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--rays", "10"},
                                                {"--method", "events", "--cells", "10"},
                                                {"--method", "sample", "--event-edges", "10"}}) {
    std::vector<std::string> all{"weak", cube, "--from-face", "0"};
    all.insert(all.end(), words.begin(), words.end());
    expect_usage_error(all, "is for --method");
  }
  const std::string part = path("part.pvs").string(), report = path("report.json").string();
  ASSERT_EQ(run({"pvs", cube, "--out", part}).code, done);
  expect_usage_error({"merge", part, "--out", path("level.bsp").string()}, ".bsp");
  ASSERT_EQ(run({"report", cube, "--questions", "order", "--cases", "1", "--json", report}).code, done);
  for (const std::vector<std::string>& option :
       {std::vector<std::string>{"--questions", "see"}, {"--cases", "2"}, {"--quick"}, {"--limit", "3"}}) {
    std::vector<std::string> words{"report", "--merge", report, "--html", path("report.html").string()};
    words.insert(words.end(), option.begin(), option.end());
    expect_usage_error(words, option[0]);
  }
}

TEST_F(Command_line, a_bar_says_how_long_it_may_take) {
  const std::string told =  // of short cases
      on_a_terminal({executable, "fuzz", "see", "--check", "certificate", "--seconds", "4"});
  EXPECT_NE(told.find("fuzzing [####"), std::string::npos) << told;
  std::smatch first;
  ASSERT_TRUE(std::regex_search(told, first, std::regex("([0-9]+)%, about [1-3] s left"))) << told;
  EXPECT_GE(std::stoi(first[1]), 35) << "before two seconds: " << told;
  EXPECT_EQ(on_a_terminal({executable, "fuzz", "see", "--seconds", "1", "--quiet"}), "");
}

TEST_F(Command_line, a_line_says_how_long_a_scene_is_waited_for) {
  const std::string slow = "(sleep 1.5; cat " + cube + ") | " + executable + " info -";
  const std::string told = on_a_terminal({"sh", "-c", slow});
  EXPECT_NE(told.find("\rreading the scene, 1 s\033[K"), std::string::npos) << told;
  EXPECT_TRUE(told.ends_with("\r\033[K")) << told;
  EXPECT_EQ(on_a_terminal({"sh", "-c", slow + " --quiet"}), "");
}

}  // namespace program
