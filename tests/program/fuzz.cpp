// fuzz and reduce: what they find, say and write; and queries, which generate writes for them.

#include "program.h"

namespace program {

class Fuzz : public Program {};

TEST_F(Fuzz, each_command_runs_scenes_and_counts_cases) {
  const std::string scenes = sanitized ? "2" : "5";
  for (const char* command :
       {"order", "graph", "cutset", "see", "weak", "render", "trace", "shadow", "boolean", "pvs", "io"}) {
    const Outcome r =
        run({"fuzz", command, "--scenes", scenes, "--seed", "3", "--json", "-", "--out", path("found").string()});
    ASSERT_EQ(r.code, done) << r;
    const Json d = r.json();
    EXPECT_EQ(d["command"], "fuzz");
    EXPECT_EQ(d["counters"]["scenes"], sanitized ? 2 : 5) << command;
    EXPECT_GE(d["counters"]["cases"], sanitized ? 4 : 10) << command;
    EXPECT_TRUE(d["result"]["finding"].is_null()) << r;
    EXPECT_FALSE(fs::exists(path("found"))) << "nothing found, nothing written";
  }
}

TEST_F(Fuzz, one_seed_is_one_sequence_and_seconds_end_it) {
  const auto counters = [&](const char* seed) {
    return run({"fuzz", "io", "--scenes", "40", "--seed", seed, "--json", "-"}).json()["counters"].dump();
  };
  EXPECT_EQ(counters("1"), counters("1"));
  EXPECT_NE(counters("1"), counters("2"));
  const Outcome r = run({"fuzz", "io", "--seconds", "1"});
  EXPECT_EQ(r.code, done) << r;
  for (const char* word : {"qoff", "regulus", "cases", "a second"})
    EXPECT_NE(r.out.find(word), std::string::npos) << word << r;
}

TEST_F(Fuzz, one_check_alone_is_asked_what_it_is_among_all) {
  const auto checks = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"fuzz", "see", "--scenes", sanitized ? "2" : "6", "--seed", "4", "--json", "-"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome r = run(words);
    EXPECT_EQ(r.code, done) << r;
    return r.json()["counters"]["checks"];
  };
  const Json all = checks({}), one = checks({"--check", "lines"});
  EXPECT_EQ(one.size(), 2u);
  EXPECT_GT(all.size(), 10u);
  for (const char* name : {"certificate", "lines"}) EXPECT_EQ(one[name], all[name]) << name;
}

TEST_F(Fuzz, goes_on_where_it_was_and_does_nothing_again) {
  const std::string json = path("io.json").string(), kept = json + ".done";
  const auto fuzz = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"fuzz", "io", "--seed", "3", "--shard", "1/2"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  };
  const Json whole = fuzz({"--scenes", "60", "--json", "-"}).json();
  EXPECT_EQ(whole["counters"]["scenes"], 30);
  // 1. A part, the rest, and once more.
  ASSERT_EQ(fuzz({"--scenes", "25", "--json", json, "--resume"}).code, done);
  const Outcome rest = fuzz({"--scenes", "60", "--json", json, "--resume"});
  ASSERT_EQ(rest.code, done) << rest;
  EXPECT_NE(rest.out.find("12 scenes"), std::string::npos) << rest;
  const Json resumed = Json::parse(read_file(json));
  EXPECT_EQ(resumed["counters"], whole["counters"]);
  EXPECT_EQ(resumed["result"], whole["result"]);
  const Outcome nothing = fuzz({"--scenes", "60", "--json", json, "--resume"});
  EXPECT_NE(nothing.out.find("30 scenes"), std::string::npos) << nothing;
  EXPECT_EQ(Json::parse(read_file(json))["counters"], whole["counters"]);

  // 2. Seconds are those of all runs.
  Json state = Json::parse(read_file(kept));
  const auto with = [&](const char* key, const Json& value) {
    Json other = state;
    other[key] = value;
    file("io.json.done", other.dump());
  };
  with("seconds", 1000);
  const Outcome over = fuzz({"--seconds", "900", "--json", json, "--resume"});
  EXPECT_EQ(over.code, done) << over;
  EXPECT_EQ(Json::parse(read_file(json))["counters"], whole["counters"]);

  // 3. What was found is found.
  with("finding", {{"case", "bars:1"},
                   {"check", "qoff"},
                   {"what", "another scene"},
                   {"replay", "sightline fuzz io --case bars:1"},
                   {"reduced", "sightline fuzz"},
                   {"faces", 3},
                   {"faces_reduced", 1},
                   {"runs", 9},
                   {"finished", true}});
  const Outcome found = fuzz({"--scenes", "60", "--json", json, "--resume"});
  EXPECT_EQ(found.code, disagreement) << found;
  EXPECT_NE(found.out.find("another scene"), std::string::npos) << found;

  // 4. What is of another question, or damaged, is refused.
  const auto refused = [&](const std::vector<std::string>& more, const std::string& names) {
    std::vector<std::string> words{"--scenes", "60", "--json", json, "--resume"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome r = run([&] {
      std::vector<std::string> all{"fuzz", "io"};
      all.insert(all.end(), words.begin(), words.end());
      return all;
    }());
    EXPECT_EQ(r.code, bad_input) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
    EXPECT_NE(r.err.find(names), std::string::npos) << r;
  };
  const std::vector<std::string> same{"--seed", "3", "--shard", "1/2"};
  refused({"--seed", "4", "--shard", "1/2"}, "--seed: 3, not 4");
  refused({"--seed", "3", "--shard", "0/2"}, "--shard: 1/2, not 0/2");
  refused({"--seed", "3", "--shard", "1/2", "--max-faces", "9"}, "--max-faces: 40, not 9");
  refused({"--seed", "3", "--shard", "1/2", "--family", "bars"}, "--family: nothing, not bars");
  refused({"--seed", "3", "--shard", "1/2", "--check", "qoff"}, "--check: nothing, not qoff");
  with("sightline", "0.0.9");
  refused(same, "version 0.0.9");
  with("random", "1 2 3");
  refused(same, "damaged");
  const std::string random = state["random"].get<std::string>();
  for (const auto& [key, value] : std::vector<std::pair<const char*, Json>>{
           {"random", random.substr(0, random.find_last_of(' ') + 1) + "313"},  // a place behind all
           {"drawn", -1},
           {"drawn", 1e30},
           {"drawn", 2.5},
           {"seconds", -1},
           {"finding", {{"case", 7}}}}) {
    with(key, value);
    refused(same, "damaged");
  }
  Json counters = state["counters"];
  counters["scenes"] = std::uint64_t{1} << 63;
  with("counters", counters);
  refused(same, "damaged");
  file("io.json.done", "{");
  refused(same, "io.json.done");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--scenes", "3", "--resume"}, {"--case", "bars:1", "--resume", "--json", json}})
    EXPECT_EQ(fuzz(words).code, usage);
}

TEST_F(Fuzz, killed_at_any_moment_goes_on_to_the_same_counts) {
  const std::string json = path("see.json").string();
  const std::vector<std::string> fuzz{"fuzz", "see", "--scenes", sanitized ? "4" : "12", "--seed", "5", "--json"};
  const auto to = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> words = fuzz;
    words.push_back(name);
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const Json whole = run(to("-", {})).json();
  int killed = 0;
  for (double seconds = 0.1; killed < 40; seconds *= 1.5) {
    const Outcome r = run(to(json, {"--resume"}), {.seconds = sanitized ? seconds / 10 : seconds});
    if (r.code == done) break;
    ASSERT_EQ(r.code, -1) << r;
    ++killed;
  }
  EXPECT_GE(killed, 1);
  EXPECT_EQ(Json::parse(read_file(json))["counters"], whole["counters"]);
}

TEST_F(Fuzz, a_case_and_a_scene_with_its_query_run_alone) {
  const Outcome r = run({"fuzz", "weak", "--case", "hinged:7:0:1:0,0,0:-30"});
  EXPECT_EQ(r.code, done) << r;
  EXPECT_NE(r.out.find("construction"), std::string::npos) << r;
  const std::string scene = path("a.qoff").string(), query = path("a.json").string();
  ASSERT_EQ(run({"generate", "hinged", "--seed", "7", "--ulps", "1", "--scale", "2^-30", "--offset", "1/3,0,1e6",
                 "--out", scene, "--query", query})
                .code,
            done);
  const Outcome again = run({"fuzz", "weak", "--scene", scene, "--query", query, "--check", "events"});
  EXPECT_EQ(again.code, done) << again;
  EXPECT_NE(again.out.find("events"), std::string::npos) << again;
  EXPECT_EQ(again.out.find("construction"), std::string::npos) << again;

  // A query that claims what is not so: exactly degenerate, nothing is seen.
  Json claims = Json::parse(read_file(query));
  EXPECT_EQ(claims["distance"], "beside");
  ASSERT_EQ(claims["visible"].size(), 1u);
  std::swap(claims["visible"], claims["hidden"]);
  std::ofstream(query) << claims.dump();
  const Outcome wrong = run({"fuzz", "weak", "--scene", scene, "--query", query});
  EXPECT_EQ(wrong.code, disagreement) << wrong;
  EXPECT_NE(wrong.out.find("DISAGREEMENT"), std::string::npos) << wrong;
}

TEST_F(Fuzz, a_case_that_does_not_end_in_time_ends_the_run_and_is_named) {
  // The system looks at its processor timers a few hundred times a second: a case that is to be ended surely needs far
  // more than that, one of a run that is to end somewhere does not.
  const std::string before = "sightline fuzz: no end within ",
                    after = " s of processor time in the case that this replays: sightline fuzz ",
                    name = sanitized ? "triangles:7:15:0:0,0,0:0" : "triangles:7:60:0:0,0,0:0";
  const Outcome alone = run({"fuzz", "see", "--case", name, "--case-seconds", "0.05"});
  EXPECT_EQ(alone.code, disagreement) << alone;
  EXPECT_EQ(alone.err, before + "0.05" + after + "see --case " + name + "\n");
  EXPECT_EQ(run({"fuzz", "see", "--case", name}).code, done) << "with time enough it ends";

  const Outcome r = run({"fuzz", "weak", "--family", "triangles", "--case-seconds", "0.001"});
  EXPECT_EQ(r.code, disagreement) << r;
  EXPECT_TRUE(r.one_line_of_error()) << r;
  const std::string replay = before + "0.001" + after + "weak --case ";
  ASSERT_TRUE(r.err.starts_with(replay)) << r;
  EXPECT_EQ(run({"fuzz", "weak", "--case", r.err.substr(replay.size(), r.err.size() - replay.size() - 1)}).code, done)
      << r;
  // Each case has its own time.
  EXPECT_EQ(run({"fuzz", "io", "--seconds", "0.5", "--case-seconds", "0.3"}).code, done);
}

/// Slivers far away, of which each round of snapping broke more than the one before, 68,182 pairs in the ninth: it went
/// on for minutes.
TEST_F(Fuzz, snapping_ends_where_each_round_breaks_more) {
  const Outcome r = run({"fuzz", "boolean", "--case", "slivers:3516677467:20:0:0,0,0:30", "--check", "rounding"});
  EXPECT_EQ(r.code, done) << r.err;
}

TEST_F(Fuzz, what_it_found_is_mended) {
  const std::string query = file(
      "query.json",
      R"({"format": "sightline query 1", "eye": ["0", "0", "0"], "source": [["0", "0", "-2"], ["0", "0", "0"], ["1", "0", "0"]]})");
  const Outcome r =
      run({"fuzz", "weak", "--scene", (corpus / "robust" / "far_corner.qoff").string(), "--query", query});
  EXPECT_EQ(r.code, done) << r;
  // A family that claimed to see past an overlap, however wide.
  const Outcome wide = run({"fuzz", "weak", "--case", "tangent:684701:0:-17592186044416", "--check", "construction"});
  EXPECT_EQ(wide.code, done) << wide;
  // A law that took the middle of a part of a surface, which is on an edge of another body that only touches it there.
  const Outcome touched = run({"fuzz", "weak", "--case", "apertures:1673085673:0:1:0,0,0:0", "--check", "volume"});
  EXPECT_EQ(touched.code, done) << touched;
  // A law that took the middle of a face that a corner of a hollow touches there.
  const Outcome hollow =
      run({"fuzz", "boolean", "--case", "solids_within:541514373:0:17179869184:0,0,0:0", "--check", "rounding"});
  EXPECT_EQ(hollow.code, done) << hollow;
}

TEST_F(Fuzz, what_makes_no_sense_is_told) {
  const std::string scene = path("a.off").string();
  ASSERT_EQ(run({"generate", "bars", "--size", "3", "--out", scene}).code, done);
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"fuzz", "everything"},
                                             {"fuzz", "see", "--case", "castle:1"},
                                             {"fuzz", "see", "--case", "bars:1:0:x"},
                                             {"fuzz", "weak", "--case", "bars:1"},
                                             {"fuzz", "see", "--family", "castle"},
                                             {"fuzz", "weak", "--family", "bars"},
                                             {"fuzz", "see", "--scenes", "1", "--check", "nothing"},
                                             {"fuzz", "weak", "--scene", scene},
                                             {"fuzz", "see", "--seconds", "0"},
                                             {"fuzz", "see", "--case-seconds", "0"},
                                             {"generate", "regulus", "--ulps", "some", "--out", scene},
                                             {"generate", "regulus", "--scale", "0", "--out", scene},
                                             {"generate", "regulus", "--scale", "2^2000", "--out", scene},
                                             {"generate", "regulus", "--offset", "1,2", "--out", scene}}) {
    const Outcome r = run(words);
    EXPECT_EQ(r.code, usage) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
  }
  const std::string query = path("q.json").string();
  std::ofstream(query)
      << R"({"format": "sightline query 1", "eye": [1, 2, 3], "source": [[0, 0, 9], [1, 0, 9], ["1/3", 0, 9]]})";
  const Outcome flat = run({"fuzz", "weak", "--scene", scene, "--query", query});
  EXPECT_EQ(flat.code, usage) << flat;
  EXPECT_NE(flat.err.find("a source has no area"), std::string::npos) << flat;
  EXPECT_EQ(run({"fuzz", "see", "--scene", scene, "--query", query}).code, done) << "a source is not asked about";
  for (const char* text :
       {"", "{}", "[1]", "{\"format\": \"sightline query 1\"}", "{\"format\": \"sightline query 1\", \"eye\": [1, 2]}",
        "{\"format\": \"sightline query 1\", \"eye\": [\"1\", \"2\", \"3/0\"]}"}) {
    std::ofstream(query) << text;
    const Outcome r = run({"fuzz", "see", "--scene", scene, "--query", query});
    EXPECT_EQ(r.code, bad_input) << text << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
    EXPECT_NE(r.err.find("q.json"), std::string::npos) << r;
  }
}

TEST_F(Fuzz, reduce_makes_a_scene_small_for_any_program) {
  const std::string scene = path("a.off").string(), small = path("small.off").string();
  ASSERT_EQ(run({"generate", "stacked", "--size", "9", "--out", scene}).code, done);
  // Fails with exit code 7 while there are three faces or more.
  const Outcome r = run({"reduce", scene, "--out", small, "--code", "7", "--", "sh", "-c",
                         "test $(grep -c '^[34] [0-9]* [0-9]* [0-9]*' {}) -lt 3 || exit 7"});
  ASSERT_EQ(r.code, done) << r;
  std::istringstream words(read_file(small));
  std::string header;
  std::size_t points = 0, faces = 0;
  words >> header >> points >> faces;
  EXPECT_EQ(faces, 3u) << read_file(small);
  EXPECT_LE(points, 3u) << read_file(small);
  const Outcome other = run({"reduce", scene, "--out", small, "--code", "8", "--", "sh", "-c", "exit 7  # {}"});
  EXPECT_EQ(other.code, disagreement) << other;
  EXPECT_NE(other.err.find("exit code is 7"), std::string::npos) << other;
  // A crash counts, and its signal is its code.
  EXPECT_EQ(run({"reduce", scene, "--out", small, "--", "sh", "-c", "test -s {} && kill -ABRT $$"}).code, done);
  EXPECT_EQ(
      run({"reduce", scene, "--out", small, "--code", "134", "--", "sh", "-c", "test -s {} && kill -ABRT $$"}).code,
      done);
  // No end in time does not, unless it is asked for.
  EXPECT_EQ(run({"reduce", scene, "--out", small, "--limit", "0.1", "--", "sh", "-c", "test -s {} && sleep 5"}).code,
            disagreement);
}

TEST_F(Fuzz, reduce_keeps_the_query_with_the_scene) {
  const std::string scene = path("a.qoff").string(), query = path("a.json").string(),
                    small = path("small.qoff").string();
  ASSERT_EQ(run({"generate", "slats", "--seed", "4", "--out", scene, "--query", query}).code, done);
  const Outcome r = run(
      {"reduce", scene, "--query", query, "--out", small, "--", "sh", "-c", "test -s {} && test -s {query} && exit 1"});
  ASSERT_EQ(r.code, done) << r;
  const Json left = Json::parse(read_file(path("small.json")));
  EXPECT_EQ(left["source"].size(), 3u) << left;
  EXPECT_EQ(left["eye"], (Json{"0", "0", "0"})) << left;
}

TEST_F(Fuzz, reduce_refuses_a_scene_that_the_program_cannot_be_given) {
  const std::string thirds = (corpus / "robust" / "thirds.qoff").string(),
                    cube = (corpus / "general" / "cube.off").string();
  for (const auto& [scene, out] : {std::pair(thirds, "small.off"), {cube, "small.stl"}})
    for (const char* code : {"0", "1"}) {
      const Outcome r = run({"reduce", scene, "--out", path(out).string(), "--code", code, "--", "sh", "-c",
                             "echo {} > " + path("ran").string() + "; exit " + code});
      EXPECT_EQ(r.code, bad_input) << r;
      EXPECT_TRUE(r.one_line_of_error()) << r;
      EXPECT_EQ(r.err.find("fail"), std::string::npos) << r;
    }
  EXPECT_FALSE(fs::exists(path("ran")));
}

TEST_F(Fuzz, reduce_says_what_is_missing) {
  const std::string scene = path("a.off").string();
  ASSERT_EQ(run({"generate", "bars", "--size", "3", "--out", scene}).code, done);
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"reduce", scene, "--out", "b.off", "--", "false"},
                                             {"reduce", scene, "--out", "b.xyz", "--", "false", "{}"},
                                             {"reduce", scene, "--out", "b.off", "--", "false", "{}", "{query}"},
                                             {"reduce", scene, "--", "false", "{}"}}) {
    const Outcome r = run(words);
    EXPECT_EQ(r.code, usage) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
  }
  const Outcome r = run({"reduce", scene, "--out", path("b.off").string(), "--", "no-such-program", "{}"});
  EXPECT_EQ(r.code, usage) << r;
  EXPECT_NE(r.err.find("'no-such-program' cannot be started"), std::string::npos) << r;
}

}  // namespace program
