// JSON Schemas, held to what commands write: every document is valid, and no key of it goes without a word.

#include "flaw.h"
#include "program.h"

#include <sightline/kernel/number.h>

#include <functional>
#include <sstream>

namespace program {

class Schema : public Program {};

TEST_F(Schema, of_each_command_is_what_it_writes) {
  const std::string rooms = (corpus / "general" / "two_rooms.off").string();
  const std::string cube = (corpus / "general" / "cube.off").string();
  const std::string bars = (corpus / "general" / "bars_over_floor.off").string();
  const std::string flat = file("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 2\nf 3 1 2\n");
  const std::string none = file("none.off", "OFF\n0 0 0\n");
  const std::string rays = file("rays.csv", "0,0,5,0,0,-1\n9,9,9,0,0,1\n-5,1,1,1,0,0\n");
  const std::string certificate = path("order.json").string();
  ASSERT_EQ(run({"order", cube, "--eye", "3,4,5", "--certificate", certificate}).code, done);
  const std::vector<std::vector<std::string>> documents{
      {"info", rooms},
      {"info", flat, "--flip"},
      {"info", none},
      {"bsp", rooms},
      {"order", rooms, "--eye", "1,1,2"},
      {"order", cube, "--eye", "1/3,4,5", "--front-to-back", "--skip-hidden"},
      {"graph", rooms},
      {"graph", cube, "--arcs", "--split"},
      {"cutset", cube, "--orbit", "4"},
      {"cutset", cube, "--orbit", "4", "--faces", "--check"},
      {"see", rooms, "--eye", "1,1,2", "--lines"},
      {"see", cube, "--eye", "3,4,5", "--two-sided"},
      {"see", none, "--eye", "3,4,5"},
      {"trace", cube, "--rays", rays},
      {"trace", cube, "--rays", rays, "--all", "--closed"},
      {"cutset", cube, "--decision-tree"},
      {"cutset", cube, "--decision-tree", "--inside"},
      {"weak", rooms, "--from-face", "0"},
      {"weak", rooms, "--from-face", "0", "--partition", "3"},
      {"weak", bars, "--from-face", "0", "--partition", "2,3", "--all-borders", "--beside-rays", "64"},
      {"weak", rooms, "--along", "1,1,1 7,3,2", "--two-sided"},
      {"shadow", rooms, "--light", "1,1,2", "--sun", "1,2,3", "--two-sided"},
      {"shadow", cube, "--light", "3,4,5", "--volume", path("dark.obj").string()},
      {"render", rooms, "--eye", "1,1,2", "--size", "16x16", "--png", path("seen.png").string()},
      {"render", rooms, "--eye", "1,1,2", "--size", "16x16", "--method", "centres"},
      {"boolean", "union", cube, cube},
      {"boolean", "difference", cube, (corpus / "general" / "cube.off").string(), "--round", "float", "--out",
       path("less.obj").string()},
      {"fuzz", "order", "--scenes", "3"},
      {"cells", cube},
      {"cells", rooms, "--seal", "1,1,1"},
      {"pvs", rooms},
      {"pvs", (corpus / "general" / "two_rooms.map").string(), "--show", "54"},
      {"pvs", (corpus / "general" / "two_rooms.map").string(), "--coarse", "1"},
      {"pvs", rooms, "--volumes", (corpus / "general" / "cube.off").string()},
      {"cells", rooms, "--coarse", "1"},
      {"report", "--questions", "see", "--families", "edge_on", "--distances", "1", "--sizes", "0", "--reduce", "1"},
      {"verify", cube, certificate}};
  std::map<std::string, Json> schemas;  // by command
  for (std::vector<std::string> arguments : documents) {
    Json& schema = schemas[arguments[0]];
    if (schema.is_null()) {
      const Outcome printed = run({"schema", arguments[0]});
      ASSERT_EQ(printed.code, done) << printed;
      schema = printed.json();
    }
    arguments.insert(arguments.end(), {"--json", "-"});
    const Outcome written = run(arguments);
    EXPECT_EQ(written.code, done) << written;
    EXPECT_EQ(flaw(written.json(), schema, schema, arguments[0]), "") << written.command;
  }
}

TEST_F(Schema, of_compare_and_judge_is_what_they_write) {
  const std::string rooms = (corpus / "general" / "two_rooms.off").string();
  const std::string cube = (corpus / "general" / "cube.off").string();
  const auto valid = [&](std::vector<std::string> arguments, int code) {
    const Json schema = run({"schema", arguments[0]}).json();
    arguments.insert(arguments.end(), {"--json", "-"});
    const Outcome written = run(arguments);
    EXPECT_EQ(written.code, code) << written;
    const Json document = written.json();
    EXPECT_EQ(flaw(document, schema, schema, arguments[0]), "") << written.command;
    return std::pair(document, schema);
  };
  valid({"compare", cube, "order", "--eye", "3,4,5"}, done);
  valid({"compare", rooms, "order", "--eye", "1,1,2", "--max-fragments", "3", "--kernels", "exact,double"}, done);
  valid({"compare", cube, "bsp", "--kernels", "exact,float"}, done);
  valid({"compare", rooms, "see", "--eye", "1,1,2", "--sizes", "8", "--kernels", "exact,double"}, done);
  valid({"compare", cube, "weak", "--from-face", "0", "--rays", "100", "--kernels", "exact"}, done);
  valid({"compare", cube, "render", "--eye", "3,4,5", "--size", "16x16"}, done);
  valid({"compare", cube, "trace", "--random", "5"}, done);
  valid({"compare", (corpus / "general" / "two_rooms.map").string(), "pvs", "--rays", "10"}, done);
  valid({"compare", (corpus / "robust" / "tiny_level.bsp").string(), "pvs", "--rays", "10"}, done);
  valid({"compare", rooms, "render", "--eye", "1,1,2", "--size", "16x16", "--alpha", "0.5"}, done);
  const std::string program = "sh -c 'echo 0 > $3' sh {scene} {query} {answer}", kept = path("kept").string();
  std::filesystem::create_directory(kept);
  const std::vector<std::string> judged{"judge",      "--program", program,      "--query", "see",
                                        "--contract", "exact",     "--families", "hinged",  "--ulps",
                                        "0,1",        "--cases",   "2"};
  auto reduced = judged, held = judged;
  reduced.insert(reduced.end(), {"--keep", kept, "--reduce", "0.5", "--html", path("judged.html").string()});
  held[2] = "sh -c 'echo abstained all > $3' sh {scene} {query} {answer}";
  valid(held, done);
  held[4] = "trace";
  valid(held, done);
  held[4] = "boolean";
  held[2] = "sh -c 'echo OFF 0 0 0 > $3' sh {scene} {query} {answer}";
  valid(held, disagreement);
  const auto [right, schema] = valid(reduced, disagreement);
  ASSERT_TRUE(right["result"]["smallest"].contains("reduced")) << right["result"]["smallest"];
  EXPECT_TRUE(right["result"]["failures"][0].contains("explained"));
  const auto wrong = [](Json document, const Json& by, const std::function<void(Json&)>& change) {
    change(document["result"]);
    return !flaw(document, by, by, "it").empty();
  };
  EXPECT_TRUE(wrong(right, schema, [](Json& r) { r["total"]["cases"].erase("wrong"); }));
  EXPECT_TRUE(wrong(right, schema, [](Json& r) { r["failures"][0]["mark"] = "odd"; }));
  EXPECT_TRUE(wrong(right, schema, [](Json& r) { r["smallest"]["reduced"].erase("runs"); }));
  EXPECT_TRUE(wrong(right, schema, [](Json& r) { r["smallest"]["explained"]["line"]["from"][0] = 1; }));
  const auto [seen, by] = valid({"compare", cube, "see", "--eye", "3,4,5", "--sizes", "8"}, done);
  for (const std::string key : {"seconds", "errors"})  // it is done
    EXPECT_TRUE(wrong(seen, by, [&](Json& r) { r["rows"][0].erase(key); }));
  for (const std::string status : {"timed out", "done"})
    EXPECT_EQ(wrong(seen, by,
                    [&](Json& r) {
                      r["rows"][0] = {{"kernel", "exact"}, {"method", "partition"}, {"status", status}};
                    }),
              status == "done");
  EXPECT_TRUE(wrong(seen, by, [](Json& r) { r["question"] = "render"; }));
  EXPECT_TRUE(wrong(seen, by, [](Json& r) { r["rows"][0]["errors"]["wrong_area"] = "0"; }));
}

/// A cube of 2^600: areas are beyond doubles, distances beyond floats.
TEST_F(Schema, says_where_numbers_that_doubles_do_not_hold_are_null) {
  std::string text = "OFF\n8 6 0\n";
  const std::string large = sightline::to_string(sightline::Rational(1) << 600);
  for (int k = 0; k < 8; ++k)
    for (const int bit : {1, 2, 4}) text += ((k & bit) != 0 ? large : "0") + (bit < 4 ? " " : "\n");
  text += "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
  const std::string cube = file("cube.off", text);
  const auto written = [&](std::vector<std::string> words) {
    const Json schema = run({"schema", words[0]}).json();
    words.insert(words.end(), {"--json", "-"});
    const Outcome r = run(words);
    EXPECT_EQ(r.code, done) << r;
    EXPECT_EQ(flaw(r.json(), schema, schema, words[0]), "") << r;
    return r.json()["result"];
  };
  EXPECT_TRUE(written({"boolean", "union", cube})["area"][1].is_null());
  const Json rows = written({"compare", cube, "see", "--kernels", "exact", "--sizes", "8", "--bits", "32"})["rows"];
  EXPECT_TRUE(rows.back()["near"].is_null() && rows.back()["far"].is_null()) << rows;
}

TEST_F(Schema, is_there_for_each_command_that_writes_json) {
  std::istringstream lines(run({"--help"}).out);
  std::size_t some = 0;
  bool listed = false;
  for (std::string line, command; std::getline(lines, line); listed |= line == "Subcommands:") {
    if (!listed || line.rfind("  ", 0) != 0) continue;
    std::istringstream(line) >> command;
    const bool writes = run({command, "--help"}).out.find("--json OUTPUT") != std::string::npos;
    EXPECT_EQ(run({"schema", command}).code, writes ? done : usage) << command;
    some += writes;
  }
  EXPECT_GE(some, 18u);
}

TEST_F(Schema, refuses_what_is_not_so) {
  const Json schema = run({"schema", "see"}).json();
  const Outcome written = run({"see", (corpus / "general" / "cube.off").string(), "--eye", "3,4,5", "--json", "-"});
  const Json right = written.json();
  ASSERT_EQ(flaw(right, schema, schema, "see"), "");
  const auto wrong = [&](const std::function<void(Json&)>& change) {
    Json document = right;
    change(document);
    return !flaw(document, schema, schema, "see").empty();
  };
  EXPECT_TRUE(wrong([](Json& d) { d["command"] = "order"; }));
  EXPECT_TRUE(wrong([](Json& d) { d["result"]["eye"][0] = 3; }));
  EXPECT_TRUE(wrong([](Json& d) { d["result"]["eye"][0] = "3.5"; }));
  EXPECT_TRUE(wrong([](Json& d) { d["result"]["eye"].push_back("1"); }));
  EXPECT_TRUE(wrong([](Json& d) { d["result"]["visible"][0] = -1; }));
  EXPECT_TRUE(wrong([](Json& d) { d["result"]["pieces"][0]["side"] = "left"; }));
  EXPECT_TRUE(wrong([](Json& d) { d["result"].erase("pieces"); }));
  EXPECT_TRUE(wrong([](Json& d) { d["scene"]["faces"] = 1.5; }));
  EXPECT_EQ(run({"schema", "merge"}).code, usage);
}

}  // namespace program
