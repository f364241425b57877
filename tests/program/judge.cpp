// sightline judge: every mark by a tiny program, contracts, limits, what is written, usage errors.

#include "program.h"

#include <array>

namespace program {

class Judge : public Program {
 protected:
  /// Two squares of a tower seen from above: the upper one is visible.
  std::string tower() const {
    return file("tower.off",
                "OFF\n8 2 0\n-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n-1 -1 1\n1 -1 1\n1 1 1\n-1 1 1\n4 0 1 2 3\n4 4 5 6 7\n");
  }

  /// A shell program: $1 is the scene, $2 the query, $3 the answer.
  static std::string shell(const std::string& script) { return "sh -c '" + script + "' sh {scene} {query} {answer}"; }

  Json judge(const std::string& program, std::vector<std::string> options, int code) {
    std::vector<std::string> arguments{"judge", "--program", program, "--json", "-"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, code) << r;
    return r.json();
  }
  /// The one mark of a program that is asked one case.
  std::string mark(const std::string& script, const std::string& contract, int code,
                   std::vector<std::string> options = {}) {
    options.insert(options.end(), {"--query", "order", "--contract", contract, "--families", "stacked", "--ulps", "0",
                                   "--cases", "1", "--two-sided"});
    const Json j = judge(shell(script), options, code);
    std::string found;
    for (const auto& [name, count] : j["result"]["total"]["cases"].items())
      if (count != 0) found += (found.empty() ? "" : " ") + name;
    EXPECT_EQ(j["result"]["holds"], code == done);
    EXPECT_EQ(j["result"]["failures"].size(), code == done ? 0u : 1u);
    return found;
  }

  /// Whether a process whose number is in a file goes on, for five seconds.
  static bool goes_on(const std::string& file) {
    const std::string process = "/proc/" + std::to_string(std::stoi(read_file(file))) + "/stat";
    const auto runs = [&] {  // a process that ended stays in the table as Z until somebody asks for it
      const std::string stat = read_file(process);
      const std::size_t name_end = stat.rfind(')');
      return name_end != std::string::npos && stat.substr(name_end + 2, 1) != "Z";
    };
    for (int wait = 0; wait < 100 && runs(); ++wait) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return runs();
  }
};

TEST_F(Judge, marks_what_became_of_a_program) {
  EXPECT_EQ(mark("exit 3", "exact", disagreement), "crashed");
  EXPECT_EQ(mark("kill -SEGV $$", "aggressive", disagreement), "crashed");
  EXPECT_EQ(mark("true", "exact", disagreement), "invalid");
  EXPECT_EQ(mark("mkdir $3; true", "exact", disagreement), "invalid");
  EXPECT_EQ(mark("mkfifo $3", "exact", disagreement), "invalid");  // nobody writes into it
  EXPECT_EQ(mark("echo 1000000 > $3", "conservative", disagreement), "invalid");
  EXPECT_EQ(mark("echo abstained all > $3", "exact", done), "abstained");
  EXPECT_EQ(mark("echo 0 > $3", "exact", disagreement), "wrong");  // the others are missing
  EXPECT_EQ(mark("echo 0 > $3", "conservative", disagreement), "wrong");
  EXPECT_EQ(mark("echo 0 > $3", "aggressive", done), "wrong");
  EXPECT_EQ(mark("sleep 100", "exact", done, {"--time", "0.3"}), "timed out");
  EXPECT_EQ(mark("sleep 100 & wait", "exact", done, {"--time", "0.3"}), "timed out");
  if (!sanitized) {
    EXPECT_EQ(mark("x=0123456789012345; while true; do x=$x$x; done", "exact", done, {"--memory", "40"}),
              "out of memory");
  }
}

TEST_F(Judge, keeps_what_was_asked_whatever_a_program_does_to_its_files) {
  const std::vector<std::string> options{"--query", "see", "--contract", "exact", "--scenes", tower(), "--cases", "1"};
  const auto kept = [&](const std::string& script, const std::string& folder) {
    std::vector<std::string> words = options;
    words.insert(words.end(), {"--keep", path(folder).string()});
    judge(shell(script), words, disagreement);
    return read_file(path(folder + "/smallest.off")) + read_file(path(folder + "/smallest.json")) +
           read_file(path(folder + "/smallest.answer"));
  };
  const std::string asked = kept("echo > $3", "asked");
  EXPECT_EQ(kept("echo OFF > $1; rm $2; echo > $3", "changed"), asked);
  EXPECT_EQ(asked.substr(0, 3), "OFF");
}

TEST_F(Judge, grades_within_the_limits_of_the_program) {
  // Thousands of tetrahedra: each edge is held to each corner.
  std::string points, faces;
  constexpr int count = 3000;
  for (int k = 0; k < count; ++k) {
    const std::string x = std::to_string(3 * k), more = std::to_string(3 * k + 1);
    points += x + " 0 0\n" + more + " 0 0\n" + x + " 1 0\n" + x + " 0 1\n";
    for (const auto& [a, b, c] : {std::array{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
      faces +=
          "3 " + std::to_string(4 * k + a) + ' ' + std::to_string(4 * k + b) + ' ' + std::to_string(4 * k + c) + '\n';
  }
  const std::string large =
      file("large", "OFF\n" + std::to_string(4 * count) + ' ' + std::to_string(4 * count) + " 0\n" + points + faces);
  const auto marked = [&](const std::string& query, const std::string& family, const std::string& answer,
                          const std::vector<std::string>& limit) {
    std::vector<std::string> options{"--query", query, "--contract", "exact", "--families", family, "--ulps", "0"};
    options.insert(options.end(), {"--cases", "1"});
    options.insert(options.end(), limit.begin(), limit.end());
    return judge(shell("cp " + answer + " $3"), options, done)["result"]["total"]["cases"];
  };
  EXPECT_EQ(marked("boolean", "boxes", large, {"--time", "0.3"})["timed out"], 1);
  if (sanitized) return;
  std::string much = "{\"order\": [{}";
  for (int k = 0; k < 250'000; ++k) much += ",{}";
  EXPECT_EQ(marked("order", "stacked", file("much", much + "]}"), {"--memory", "10"})["out of memory"], 1);
}

TEST_F(Judge, ends_what_a_program_leaves_running) {
  const std::string left = path("left").string();
  EXPECT_EQ(mark("sleep 300 & echo $! > " + left + "; echo abstained all > $3", "exact", done), "abstained");
  EXPECT_FALSE(goes_on(left));
}

TEST_F(Judge, that_a_signal_ends_leaves_no_program_and_no_folder) {
  const std::string left = path("left").string(), where = path("where").string();
  const std::string script =
      "sleep 300 & echo $! > " + left + "; dirname $1 > " + where + "; kill -TERM $PPID; sleep 300";
  const Outcome r = run({"judge", "--program", shell(script), "--query", "see", "--contract", "exact", "--scenes",
                         tower(), "--cases", "1"});
  EXPECT_EQ(r.ended, "signal " + std::to_string(SIGTERM)) << r;
  EXPECT_FALSE(goes_on(left));
  std::string folder = read_file(where);
  folder.pop_back();
  EXPECT_NE(folder, "");
  EXPECT_FALSE(fs::exists(folder)) << folder;
}

TEST_F(Judge, counts_the_memory_of_all_processes_and_what_they_share_once) {
  if (sanitized) GTEST_SKIP() << "a process of the sanitizers' takes more";
  // 40 MB in four processes that have it in common; and as much again in a child of a thread.
  const auto marked = [&](const std::string& script) {
    const std::string program = file("memory.py", script);
    return judge("python3 " + program + " {scene} {query} {answer}",
                 {"--query", "see", "--contract", "exact", "--scenes", tower(), "--cases", "1", "--memory", "100"},
                 done)["result"]["total"]["cases"];
  };
  const std::string answer = "open(sys.argv[3], 'w').write('abstained all')\n";
  EXPECT_EQ(marked("import os, sys, time\nheld = b'x' * (40 << 20)\n"
                   "for k in range(4):\n  if os.fork() == 0:\n    time.sleep(0.3)\n    os._exit(0)\n"
                   "for k in range(4): os.wait()\n" +
                   answer)["abstained"],
            1);
  EXPECT_EQ(marked("import subprocess, sys, threading\n"
                   "def child(): subprocess.run([sys.executable, '-c', "
                   "'import time; held = b\"x\" * (150 << 20); time.sleep(3)'])\n"
                   "t = threading.Thread(target=child)\nt.start()\nt.join()\n" +
                   answer)["out of memory"],
            1);
}

TEST_F(Judge, asks_a_share_of_the_cases_where_others_ask_the_rest) {
  const std::string nothing = shell("echo abstained all > $3");
  const auto asked = [&](const std::vector<std::string>& more) {
    std::vector<std::string> options{"--query",        "see",    "--contract", "exact",   "--families",
                                     "stacked,hinged", "--ulps", "0,1",        "--cases", "2"};
    options.insert(options.end(), more.begin(), more.end());
    return judge(nothing, options, done)["result"]["total"]["asked"].get<int>();
  };
  EXPECT_EQ(asked({}), 8);
  EXPECT_EQ(asked({"--shard", "0/3"}), 3);
  EXPECT_EQ(asked({"--shard", "1/3"}), 3);
  EXPECT_EQ(asked({"--shard", "2/3"}), 2);
  EXPECT_EQ(run({"judge", "--program", nothing, "--query", "see", "--shard", "3/3"}).code, usage);
}

TEST_F(Judge, killed_in_the_middle_goes_on_where_it_was) {
  // Answers that are wrong in every way: what is wrong with each kind is kept.
  for (const auto& [query, answer] : {std::pair<std::string, std::string>{"see", "echo 0 > $3"},
                                      {"order", "echo 0 > $3"},
                                      {"weak", "printf \"{\\377\" > $3"},
                                      {"trace", "for ray in $(grep -o origin $2); do echo none; done > $3"},
                                      {"boolean", "cp $1 $3"}}) {
    SCOPED_TRACE(query);
    const std::string log = path("log").string();
    const std::string script =
        file("mine.sh", "echo x >> " + log + "\nif [ -e " + path("kill").string() + " ] && [ $(grep -c x " + log +
                            ") = 4 ]; then kill -9 $PPID; sleep 1; fi\n" + answer + "\n");
    const auto asked = [&, query = query](const std::string& name, const std::vector<std::string>& more) {
      std::vector<std::string> words{"judge",
                                     "--program",
                                     "sh " + script + " {scene} {query} {answer}",
                                     "--query",
                                     query,
                                     "--contract",
                                     "exact",
                                     "--families",
                                     "stacked,hinged",
                                     "--ulps",
                                     "0,far",
                                     "--cases",
                                     "2",
                                     "--keep",
                                     path(name).string(),
                                     "--json",
                                     path(name + ".json").string()};
      words.insert(words.end(), more.begin(), more.end());
      fs::remove(log);
      return run(words);
    };
    const auto lasting = [&](const std::string& name) {
      Json json = Json::parse(read_file(path(name + ".json")));
      json.erase("seconds");
      Json& result = json["result"];
      for (const char* rows : {"rows", "by_distance"})
        for (Json& row : result[rows]) {
          row.erase("seconds");
          row.erase("bytes");
        }
      result["total"].erase("seconds");
      result["total"].erase("bytes");
      for (Json& kept : result["smallest"]["files"])
        kept = fs::path(kept.get<std::string>()).filename().string() + read_file(kept.get<std::string>());
      return json.dump(1, ' ', false, Json::error_handler_t::replace);
    };
    const auto calls = [&] {
      const std::string text = read_file(log);
      return std::count(text.begin(), text.end(), 'x');
    };
    ASSERT_EQ(asked("whole", {}).code, disagreement);
    const auto all = calls(),
               one_by_one =
                   Json::parse(read_file(path("whole.json")))["result"]["total"]["asked"].get<std::ptrdiff_t>();
    ASSERT_GE(one_by_one, 5);  // and what is asked about the smallest
    // 1. Three cases are judged when it is killed, and not asked again.
    file("kill", "");
    const Outcome killed = asked("again", {"--resume"});
    ASSERT_EQ(killed.code, -1) << killed;
    EXPECT_EQ(calls(), 4);
    fs::remove(path("kill"));
    std::ofstream(path("again.json.done"), std::ios::app) << "{\"case\":3,\"o";  // as an end in the middle leaves it
    const Outcome rest = asked("again", {"--resume"});
    EXPECT_EQ(rest.code, disagreement) << rest;
    EXPECT_EQ(calls(), all - 3);
    EXPECT_EQ(lasting("again"), lasting("whole"));
    // 2. What is done is not done again, but for what is looked for beside the smallest.
    fs::remove_all(path("again"));
    const Outcome done_before = asked("again", {"--resume"});
    EXPECT_EQ(done_before.code, disagreement) << done_before;
    EXPECT_NE(done_before.out.find("8 of 8 cases were there"), std::string::npos) << done_before;
    EXPECT_EQ(calls(), all - one_by_one);
    EXPECT_EQ(lasting("again"), lasting("whole"));
    // 3. Other cases, or another program.
    const Outcome seed = asked("again", {"--resume", "--seed", "2"});
    EXPECT_EQ(seed.code, bad_input) << seed;
    EXPECT_TRUE(seed.one_line_of_error()) << seed;
    EXPECT_NE(seed.err.find("--seed: 1, not 2"), std::string::npos) << seed;
    std::ofstream(script, std::ios::app) << "true\n";
    const Outcome program = asked("again", {"--resume"});
    EXPECT_EQ(program.code, bad_input) << program;
    EXPECT_NE(program.err.find("--program's files"), std::string::npos) << program;
    for (const std::string name : {"whole", "again"}) fs::remove_all(path(name));
    fs::remove(path("again.json.done"));
  }
}

TEST_F(Judge, resumed_asks_again_about_a_scene_that_changed) {
  const std::string scene = tower(), json = path("j.json").string();
  const std::vector<std::string> words{
      "judge",   "--program", shell("echo 0 > $3"), "--query", "see", "--contract", "exact", "--scenes", scene,
      "--cases", "3",         "--resume",           "--json",  json};
  ASSERT_EQ(run(words).code, disagreement);
  EXPECT_NE(run(words).out.find("3 of 3 cases were there"), std::string::npos);
  std::ofstream(scene, std::ios::app) << "# another\n";
  EXPECT_NE(run(words).out.find("0 of 3 cases were there"), std::string::npos);
  EXPECT_NE(run(words).out.find("3 of 3 cases were there"), std::string::npos);
  EXPECT_EQ(run({"judge", "--program", shell("true"), "--query", "see", "--contract", "exact", "--resume"}).code,
            usage);
}

TEST_F(Judge, resumed_asks_again_about_a_scene_whose_buffer_changed) {
  const auto buffer = [&](float last) {
    const std::array<float, 9> corners{0, 0, 0, 1, 0, 0, 0, last, 0};
    file("t.bin", {reinterpret_cast<const char*>(corners.data()), sizeof corners});
  };
  const std::string scene = file("t.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
      "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
      "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"uri": "t.bin", "byteLength": 36}]})");
  const std::vector<std::string> words{"judge",
                                       "--program",
                                       shell("echo abstained all > $3"),
                                       "--query",
                                       "see",
                                       "--contract",
                                       "exact",
                                       "--scenes",
                                       scene,
                                       "--cases",
                                       "3",
                                       "--resume",
                                       "--json",
                                       path("j.json").string()};
  buffer(1);
  ASSERT_EQ(run(words).code, done);
  EXPECT_NE(run(words).out.find("3 of 3 cases were there"), std::string::npos);
  buffer(2);
  EXPECT_NE(run(words).out.find("0 of 3 cases were there"), std::string::npos);
}

TEST_F(Judge, goes_on_where_a_program_leaves_what_is_in_the_way) {
  const std::vector<std::string> options{"--query", "see", "--contract", "exact", "--scenes", tower(), "--cases", "3"};
  const auto invalid = [&](const std::string& script) {
    return judge(shell(script), options, disagreement)["result"]["total"]["cases"]["invalid"];
  };
  EXPECT_EQ(invalid("rm $1 $2; mkdir $1 $2; touch $1/x"), 3);
  // So deep that there are not enough descriptors to remove it.
  const std::string log = path("log").string();
  launcher_ = {"/bin/sh", "-c", "ulimit -n 64; export TMPDIR=\"$0\"; exec \"$@\"", path("").string()};
  EXPECT_EQ(invalid("mkdir -p $3/$(seq -s / 100); basename $3 >> " + log), 3);
  EXPECT_EQ(read_file(log), "answer\n1-answer\n2-answer\n");
}

TEST_F(Judge, that_cannot_make_the_folder_to_keep_says_so_before_it_asks) {
  const std::string log = path("log").string(), keep = tower() + "/kept";
  const Outcome r = run({"judge", "--program", shell("echo x >> " + log), "--query", "see", "--contract", "exact",
                         "--scenes", tower(), "--cases", "1", "--keep", keep});
  EXPECT_EQ(r.code, bad_input) << r;
  EXPECT_TRUE(r.one_line_of_error()) << r;
  EXPECT_NE(r.err.find(keep + ": cannot be made ("), std::string::npos) << r;
  EXPECT_FALSE(fs::exists(log));
}

TEST_F(Judge, grades_orders_of_a_stack) {
  // `stacked`: unit squares one above the other; some order of their numbers is right from every eye.
  const std::vector<std::string> options{"--query", "order",  "--contract", "exact",  "--families",
                                         "stacked", "--size", "5",          "--ulps", "0",
                                         "--cases", "4",      "--two-sided"};
  const Json up = judge(shell("printf \"0\\n1\\n2\\n3\\n4\\n\" > $3"), options, disagreement),
             down = judge(shell("printf \"4\\n3\\n2\\n1\\n0\\n\" > $3"), options, disagreement);
  std::size_t right = 0;
  for (const Json* j : {&up, &down}) right += (*j)["result"]["total"]["cases"]["right"].get<std::size_t>();
  EXPECT_EQ(up["result"]["total"]["asked"], 4);
  EXPECT_GE(right, 4u);
  const Json& smallest = (up["result"]["smallest"].is_null() ? down : up)["result"]["smallest"];
  EXPECT_NE(smallest["why"].get<std::string>().find("is drawn before face"), std::string::npos) << smallest;
}

TEST_F(Judge, asks_about_scenes_and_keeps_what_went_wrong) {
  const std::vector<std::string> options{"--query",
                                         "see",
                                         "--contract",
                                         "exact",
                                         "--scenes",
                                         tower(),
                                         "--cases",
                                         "6",
                                         "--two-sided",
                                         "--keep",
                                         path("kept").string(),
                                         "--html",
                                         path("page.html").string()};
  const Json j = judge(shell("echo 0 > $3"), options, disagreement);
  EXPECT_EQ(j["result"]["total"]["asked"], 6);
  EXPECT_GT(j["result"]["total"]["faces"]["wrong_visible"].get<int>() +
                j["result"]["total"]["faces"]["wrong_hidden"].get<int>(),
            0);
  // What is kept is what was asked: the scene as it was, a query, the answer.
  EXPECT_EQ(read_file(path("kept") / "smallest.answer"), "0\n");
  EXPECT_EQ(Json::parse(read_file(path("kept") / "smallest.json"))["query"], "see");
  EXPECT_EQ(read_file(path("kept") / "smallest.off"), read_file(tower()));
  EXPECT_TRUE(fs::exists(path("kept") / "smallest.svg"));
  const std::string page = read_file(path("page.html"));
  EXPECT_NE(page.find("is broken in"), std::string::npos);
  EXPECT_NE(page.find("tower.off"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos);
  // The command that is printed asks that case again: one case, which fails in the same way.
  const Json &s = j["result"]["smallest"], again = judge(shell("echo 0 > $3"),
                                                         {"--query", "see", "--contract", "exact", "--scenes", tower(),
                                                          "--cases", "1", "--two-sided", "--seed", s["seed"].dump()},
                                                         disagreement);
  EXPECT_EQ(again["result"]["smallest"]["why"], s["why"]);
  EXPECT_NE(s["again"].get<std::string>().find("--cases 1 --seed " + s["seed"].dump() + " --two-sided"),
            std::string::npos)
      << s;
}

TEST_F(Judge, keeps_no_picture_of_another_case_and_says_what_the_query_of_a_file_says) {
  const std::string query = file("query.json", R"({"query": "see", "eye": [0, 0, 5], "two_sided": true})");
  const auto asked = [&](const std::string& script) {
    return judge(
        shell(script),
        {"--query", "see", "--contract", "exact", "--scenes", tower(), "--ask", query, "--keep", path("kept").string()},
        disagreement);
  };
  const Json wrong = asked("echo 0 > $3");
  EXPECT_EQ(wrong["two_sided"], true);
  EXPECT_TRUE(fs::exists(path("kept") / "smallest.svg"));
  std::ofstream(path("kept") / "reduced.off") << "old";
  asked("exit 1");  // of which there is neither a picture nor an answer
  EXPECT_FALSE(fs::exists(path("kept") / "smallest.svg"));
  EXPECT_FALSE(fs::exists(path("kept") / "smallest.answer"));
  EXPECT_FALSE(fs::exists(path("kept") / "reduced.off"));
}

TEST_F(Judge, asks_what_rays_meet_first) {
  const std::string query = file("rays.json", R"({"query": "trace", "rays": [
    {"origin": [0, 0, 5], "direction": [0, 0, -1]}, {"origin": [1, 0, 5], "direction": [0, 0, -1]},
    {"origin": [0, 0, 1], "direction": [0, 0, 1]}]})");
  const auto judged = [&](const std::string& said, const std::string& contract, int code,
                          std::vector<std::string> more = {}) {
    std::vector<std::string> options{"--query", "trace", "--contract", contract, "--scenes", tower(), "--ask", query};
    options.insert(options.end(), more.begin(), more.end());
    return judge(shell("printf \"" + said + "\" > $3"), options, code)["result"];
  };
  EXPECT_EQ(judged("1\\n1\\nnone\\n", "exact", done)["total"]["faces"]["judged"], 3);
  EXPECT_EQ(judged("abstained all", "exact", done)["total"]["cases"]["abstained"], 1);
  EXPECT_EQ(judged("1\\n1\\n", "conservative", disagreement)["total"]["cases"]["invalid"], 1);
  // A face is missed: through its border, too, unless that is excused.
  EXPECT_EQ(judged("1\\nnone\\nnone\\n", "conservative", disagreement)["smallest"]["why"],
            "ray 1 first meets face 1, not nothing");
  judged("1\\nnone\\nnone\\n", "aggressive", done);
  judged("1\\nnone\\nnone\\n", "exact", done, {"--excuse-touching"});
  // The farther face.
  const Json farther = judged("0\\n0\\nnone\\n", "aggressive", disagreement);
  EXPECT_EQ(farther["total"]["faces"]["wrong_visible"], 2);
  EXPECT_EQ(farther["total"]["faces"]["wrong_hidden"], 2);
  EXPECT_EQ(farther["smallest"]["why"], "ray 0 first meets face 1, not face 0, ray 1 first meets face 1, not face 0");
  EXPECT_EQ(
      farther["guess"].dump(),
      R"(["in the one wrong case the answer is right read otherwise, as if the last face were asked for, not the first"])");
  const Json reduced = judge(shell("for ray in $(grep -o origin $2); do echo 0; done > $3"),
                             {"--query", "trace", "--contract", "exact", "--scenes", tower(), "--ask", query, "--keep",
                              path("kept").string(), "--reduce", "60"},
                             disagreement)["result"]["smallest"]["reduced"];
  EXPECT_EQ(reduced["finished"], true);
  EXPECT_EQ(Json::parse(read_file(path("kept") / "reduced.json"))["rays"].size(), 1u);
  // Rays of the judge's own, about a family.
  const Json own =
      judge(shell("for ray in $(grep -o origin $2); do echo none; done > $3"),
            {"--query", "trace", "--contract", "aggressive", "--families", "hinged", "--cases", "2"}, done);
  EXPECT_GT(own["result"]["total"]["faces"]["judged"], 100);
  EXPECT_EQ(own["result"]["total"]["cases"]["wrong"], own["result"]["total"]["asked"]);
  EXPECT_EQ(run({"judge", "--program", shell("true"), "--query", "trace", "--contract", "exact", "--two-sided"}).code,
            usage);
  EXPECT_EQ(
      run({"judge", "--program", shell("true"), "--query", "see", "--contract", "exact", "--excuse-touching"}).code,
      usage);
}

TEST_F(Judge, asks_for_set_operations) {
  // Two tetrahedra that share the corner at the origin's one: the second twice as large.
  const std::string faces = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n", other = "3 4 6 5\n3 4 5 7\n3 5 6 7\n3 6 4 7\n";
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n", larger = "0 0 0\n2 0 0\n0 2 0\n0 0 2\n";
  const std::string scene = file("two.off", "OFF\n8 8 0\n" + points + larger + faces + other),
                    query = file("two.json", R"({"query": "boolean", "operation": "intersection", "first": 4})"),
                    small = file("small.off", "OFF\n4 4 0\n" + points + faces),
                    large = file("large.off", "OFF\n4 4 0\n" + larger + faces),
                    open = file("open.off", "OFF\n4 3 0\n" + points + "3 0 2 1\n3 0 1 3\n3 1 2 3\n");
  const auto judged = [&](const std::string& said, const std::string& contract, int code) {
    return judge(shell("cp " + said + " $3"),
                 {"--query", "boolean", "--contract", contract, "--scenes", scene, "--ask", query}, code)["result"];
  };
  const Json right = judged(small, "exact", done)["total"];
  EXPECT_EQ(right["cases"]["right"], 1);
  EXPECT_GT(right["faces"]["judged"], 30);
  EXPECT_EQ(right["errors"].dump(), R"({"area":0.0,"volume":0.0})");
  const Json more = judged(large, "aggressive", disagreement);
  EXPECT_EQ(more["total"]["errors"]["volume"], 7);
  EXPECT_GT(more["total"]["faces"]["wrong_visible"], 0);
  EXPECT_EQ(more["total"]["faces"]["wrong_hidden"], 0);
  EXPECT_NE(more["smallest"]["why"].get<std::string>().find(" is outside, and wound round 1 times"), std::string::npos)
      << more["smallest"];
  judged(large, "conservative", done);
  const Json invalid = judged(open, "conservative", disagreement);
  EXPECT_EQ(invalid["total"]["cases"]["invalid"], 1);
  EXPECT_NE(invalid["smallest"]["why"].get<std::string>().find("not closed: 3 edges"), std::string::npos)
      << invalid["smallest"];
  const Json leaves_open =
      judge(shell("echo abstained > $3"),
            {"--query", "boolean", "--contract", "exact", "--families", "boxes,leaves", "--cases", "2"},
            done)["result"]["total"];
  EXPECT_GT(leaves_open["cases"]["abstained"], 8);
  EXPECT_EQ(leaves_open["cases"]["abstained"], leaves_open["asked"]);
  // A scene that is a solid is asked about with a copy of itself; an open one is not.
  const Json copies =
      judge(shell("cp $1 $3"), {"--query", "boolean", "--contract", "conservative", "--scenes", small, "--cases", "8"},
            done)["result"];
  EXPECT_EQ(copies["total"]["asked"], 8);  // both as they are lack nothing
  EXPECT_GT(copies["total"]["faces"]["wrong_visible"], 0);
  EXPECT_EQ(copies["total"]["faces"]["wrong_hidden"], 0);
  EXPECT_EQ(judge(shell("cp $1 $3"), {"--query", "boolean", "--contract", "exact", "--scenes", open},
                  done)["result"]["not_asked"]
                .dump(),
            R"({"a solid is not closed":5})");
  // On the page, with a picture; and made smaller.
  const Outcome page = run({"judge", "--program", shell("cp " + large + " $3"), "--query", "boolean", "--contract",
                            "exact", "--scenes", scene, "--ask", query, "--html", path("solids.html").string(),
                            "--keep", path("kept").string(), "--reduce", "5"});
  EXPECT_EQ(page.code, disagreement) << page;
  EXPECT_NE(page.out.find("the answer winds round it 1 times"), std::string::npos) << page;
  EXPECT_NE(read_file(path("solids.html")).find("holds what is beside"), std::string::npos);
  EXPECT_EQ(Json::parse(read_file(path("kept") / "reduced.json"))["first"], 4);
  EXPECT_EQ(run({"judge", "--program", shell("true"), "--query", "boolean", "--contract", "exact", "--two-sided"}).code,
            usage);
}

TEST_F(Judge, makes_the_smallest_smaller_and_asks_it_again) {
  // Face 0 is shown always: what is left is one triangle that looks away.
  const std::string program = shell("echo 0 > $3");
  const Json j = judge(program,
                       {"--query", "see", "--contract", "aggressive", "--families", "stacked", "--size", "6", "--ulps",
                        "0", "--cases", "4", "--keep", path("kept").string(), "--reduce", "60"},
                       disagreement);
  const Json& r = j["result"]["smallest"]["reduced"];
  EXPECT_EQ(r["faces"], 1) << r;
  EXPECT_EQ(r["finished"], true) << r;
  EXPECT_EQ(r["why"], "face 0 is shown but hidden");
  std::istringstream off(read_file(path("kept") / "reduced.off"));
  std::string header;
  std::size_t points = 0, faces = 0;
  off >> header >> points >> faces;
  EXPECT_EQ(points, 3u);
  EXPECT_EQ(faces, 1u);
  const std::string with =
      " --scenes " + path("kept/reduced.off").string() + " --ask " + path("kept/reduced.json").string();
  EXPECT_NE(r["again"].get<std::string>().find(with), std::string::npos) << r;
  const std::vector<std::string> options{"--query",    "see",
                                         "--contract", "aggressive",
                                         "--scenes",   path("kept/reduced.off").string(),
                                         "--ask",      path("kept/reduced.json").string()};
  const Json again = judge(program, options, disagreement);
  EXPECT_EQ(again["result"]["total"]["asked"], 1);
  EXPECT_EQ(again["result"]["smallest"]["why"], r["why"]);
  EXPECT_EQ(judge(shell("true > $3"), options, done)["result"]["holds"], true);
  EXPECT_EQ(Json::parse(read_file(path("kept") / "reduced.json"))["query"], "see");
}

TEST_F(Judge, makes_scenes_smaller_that_break_the_contract_in_the_same_way) {
  // It crashes where there is a quad, and is wrong of triangles too: what is left is a quad, its corners apart.
  const Json j = judge(shell("grep -q \"^4 \" $1 && exit 3; echo 0 > $3"),
                       {"--query", "weak", "--contract", "exact", "--families", "stacked", "--size", "3", "--ulps", "0",
                        "--cases", "1", "--keep", path("kept").string(), "--reduce", "60"},
                       disagreement);
  const Json& r = j["result"]["smallest"]["reduced"];
  EXPECT_EQ(r["mark"], "crashed") << r;
  EXPECT_EQ(r["faces"], 1) << r;
  const std::string left = read_file(path("kept") / "reduced.off");
  EXPECT_EQ(left.substr(left.rfind('\n', left.size() - 2) + 1), "4 0 1 2 3\n") << left;
}

TEST_F(Judge, makes_scenes_smaller_that_have_the_same_kind_of_wrong_face) {
  // Face 1, which is hidden, is shown as long as there are three faces; nothing is shown of fewer, where the first is
  // missing then.
  const std::string three =
      "OFF\n12 3 0\n-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n-1 -1 1\n1 -1 1\n1 1 1\n-1 1 1\n-1 -1 2\n1 -1 2\n1 1 2\n-1 1 2\n4 "
      "8 9 10 11\n4 4 5 6 7\n4 0 1 2 3\n";
  const std::string query = file("query.json", R"({"query": "see", "eye": [0, 0, 9], "two_sided": false})");
  const Json j =
      judge(shell("test $(grep -c \"^[34] [0-9]* [0-9]* [0-9]*\" $1) -lt 3 || printf \"0\\n1\\n\" > $3; touch $3"),
            {"--query", "see", "--contract", "exact", "--scenes", file("three.off", three), "--ask", query, "--keep",
             path("kept").string(), "--reduce", "60"},
            disagreement);
  EXPECT_EQ(j["result"]["smallest"]["why"], "face 1 is shown but hidden");
  const Json& r = j["result"]["smallest"]["reduced"];
  EXPECT_EQ(r["faces"], 3) << r;
  EXPECT_EQ(r["why"].get<std::string>().find("missing"), std::string::npos) << r;
}

TEST_F(Judge, gives_the_scene_in_the_format_that_is_asked_for) {
  for (const std::string format : {"off", "obj", "ply", "qoff"}) {
    const Json j = judge(
        shell("test -s $1 && case $1 in *." + format + ") echo abstained all > $3;; esac"),
        {"--query", "weak", "--contract", "exact", "--scenes", tower(), "--cases", "1", "--format", format}, done);
    EXPECT_EQ(j["result"]["total"]["cases"]["abstained"], 1) << format;
  }
  const Json j =
      judge(shell("true"),
            {"--query", "see", "--contract", "exact", "--scenes", tower(), "--cases", "1", "--format", "stl"}, done);
  EXPECT_EQ(j["result"]["total"]["not_asked"], 1);
}

TEST_F(Judge, prints_a_table_and_a_verdict) {
  const Outcome holds = run({"judge", "--program", shell("echo abstained all > $3"), "--query", "see", "--contract",
                             "exact", "--scenes", tower(), "--cases", "2"});
  EXPECT_EQ(holds.code, done) << holds;
  EXPECT_NE(holds.out.find("the contract `exact` is not broken in 2 cases: 0 answered, 2 abstained\n"),
            std::string::npos)
      << holds;
  const Outcome broken = run({"judge", "--program", shell("exit 1"), "--query", "see", "--contract", "exact",
                              "--scenes", tower(), "--cases", "2"});
  EXPECT_EQ(broken.code, disagreement) << broken;
  EXPECT_NE(broken.out.find("the contract `exact` is BROKEN in 2 of 2 cases"), std::string::npos) << broken;
  EXPECT_NE(broken.out.find("  again: sightline judge --program "), std::string::npos) << broken;
}

TEST_F(Judge, explains_a_wrong_answer_in_words_and_pictures) {
  const std::string query = file("query.json", R"({"query": "see", "eye": [0, 0, 5], "two_sided": false})");
  const std::vector<std::string> options{"--query",    "see",
                                         "--contract", "exact",
                                         "--scenes",   tower(),
                                         "--ask",      query,
                                         "--keep",     path("kept").string(),
                                         "--html",     path("page.html").string()};
  const Json j = judge(shell("printf \"0\\n1\\n\" > $3"), options, disagreement);
  const Json& why = j["result"]["smallest"]["explained"];
  EXPECT_EQ(why["line"]["words"], "on the way from (0, 0, 5) to (0, 0, 0) on face 0, face 1 is met at (0, 0, 1)");
  EXPECT_EQ(why["line"]["by"], 1);
  EXPECT_EQ(j["result"]["guess"][0],
            "in the one wrong case the answer is right read otherwise, as if no face hid another: all are shown that "
            "the eye is in front of");
  const std::string svg = read_file(path("kept") / "smallest.svg"), page = read_file(path("page.html"));
  for (const char* words :
       {">eye<", ">face 0<", ">face 1<", ">shown but hidden<", ">in the way<", "stroke-dasharray"}) {
    EXPECT_NE(svg.find(words), std::string::npos) << words;
    EXPECT_NE(page.find(words), std::string::npos) << words;
  }
  EXPECT_NE(page.find("A guess: "), std::string::npos);

  // The same in three dimensions: faces in groups by what is wrong with them.
  const Json &view = why["view"], groups{{{"name", "shown but hidden"}, {"role", "open"}},
                                         {{"name", "in the way"}, {"role", "other"}},
                                         {{"name", "right"}, {"role", "face"}}};
  EXPECT_EQ(view["groups"], groups);
  EXPECT_EQ(view["polygons"]["count"], view["polygons"]["of"]);
  EXPECT_EQ(view["eye"]["exact"], "0, 0, 5");
  EXPECT_EQ(view["refutation"]["words"], why["line"]["words"]);
  EXPECT_EQ(page.find("data-view=\"0\""), page.rfind("data-view=\"0\""));
  EXPECT_NE(page.find("data-view=\"0\""), std::string::npos);
}

TEST_F(Judge, guesses_a_turned_side_and_faces_that_are_dropped) {
  const std::string above = file("above.json", R"({"query": "see", "eye": [0, 0, 5], "two_sided": false})"),
                    below = file("below.json", R"({"query": "see", "eye": [0, 0, -5], "two_sided": false})");
  const auto guess = [&](const std::string& scene, const std::string& query, const std::string& answer) {
    return judge(shell("printf \"" + answer + "\" > $3"),
                 {"--query", "see", "--contract", "exact", "--scenes", scene, "--ask", query},
                 disagreement)["result"]["guess"]
        .dump();
  };
  // A square over another one, and one beside them that looks down.
  const std::string turned = file("turned.off",
                                  "OFF\n12 3 0\n-1 -1 1\n1 -1 1\n1 1 1\n-1 1 1\n-1 -1 0\n1 -1 0\n1 1 0\n-1 1 "
                                  "0\n4 0 0\n4 1 0\n5 1 0\n5 0 0\n4 0 1 2 3\n4 4 5 6 7\n4 8 9 10 11\n");
  EXPECT_EQ(guess(turned, above, "2\\n"),
            R"(["in the one wrong case the answer is right read otherwise, as if the front of a face were where it is )"
            R"(clockwise"])");
  EXPECT_EQ(guess(tower(), above, ""), "[]") << "nothing that is listed is no sign of anything";
  EXPECT_NE(guess(tower(), below, "0\\n").find("as if faces seen from behind counted too"), std::string::npos);
  // An L and a square beside it.
  const std::string concave = file("concave.off",
                                   "OFF\n10 2 0\n0 0 0\n2 0 0\n2 1 0\n1 1 0\n1 2 0\n0 2 0\n3 0 0\n4 0 0\n4 1 "
                                   "0\n3 1 0\n6 0 1 2 3 4 5\n4 6 7 8 9\n");
  EXPECT_EQ(guess(concave, above, "1\\n"), R"(["1 of 1 concave faces are wrong, and none of 1 convex ones"])");
}

TEST_F(Judge, guesses_a_tolerance_from_the_scene_moved) {
  // The program itself, in floats: gaps of 2^-30 are none to it, those of 2^-8 are.
  const std::string floats = shell(
      "eye=$(sed \"s/.*eye...//; s/].*//\" $2); " + executable +
      " see $1 --eye=$eye --kernel float --json - | tr -d \" \\n\" | sed \"s/.*visible..\\[//; s/\\].*//\" | tr , "
      "\"\\n\" > $3");
  const Json j =
      judge(floats, {"--query", "see", "--contract", "exact", "--families", "hinged", "--ulps", "1", "--cases", "1"},
            disagreement);
  const std::string guess = j["result"]["smallest"]["guess"].dump();
  EXPECT_NE(guess.find("a tolerance of a size between, or rounding"), std::string::npos) << guess;
}

TEST_F(Judge, prints_what_the_page_shows) {
  if (sanitized) GTEST_SKIP() << "it is about the page's text; other tests of the judge are sanitized";
  if (std::system("python3 -c pass > /dev/null 2>&1") != 0) GTEST_SKIP() << "there is no python3";
  const std::string page = read_file(fs::path(SIGHTLINE_SOURCE_DIR) / "harness/judge/README.md"), fence = "```python\n";
  const std::size_t code = page.find(fence) + fence.size();
  const std::string mine = file("mine.py", page.substr(code, page.find("```", code) - code));
  const Outcome r = run({"judge", "--program", "python3 " + mine + " {scene} {query} {answer}", "--query", "see",
                         "--contract", "exact", "--families", "hinged,leaves,boxes", "--cases", "3"});
  ASSERT_EQ(r.code, disagreement) << r;
  std::string out = r.out.substr(r.out.find("the smallest"));
  for (std::size_t at; (at = out.find(mine)) != std::string::npos;) out.replace(at, mine.size(), "mine.py");
  std::string shown;
  for (std::size_t at = 0; at < out.size();) {
    const std::size_t end = out.find('\n', at);
    shown += "    " + out.substr(at, end + 1 - at);
    at = end + 1;
  }
  for (const char* where : {"README.md", "harness/judge/README.md"})
    EXPECT_NE(read_file(fs::path(SIGHTLINE_SOURCE_DIR) / where).find(shown), std::string::npos) << where << '\n' << out;
}

TEST_F(Judge, says_what_is_wrong_with_a_command_line) {
  const auto complains = [&](std::vector<std::string> options, const std::string& about, int code = usage) {
    options.insert(options.begin(), "judge");
    const Outcome r = run(options);
    EXPECT_EQ(r.code, code) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
    EXPECT_NE(r.err.find(about), std::string::npos) << r;
  };
  const std::string good = shell("true");
  complains({"--query", "see", "--contract", "exact"}, "--program");
  complains({"--program", good, "--query", "look", "--contract", "exact"}, "--query");
  complains({"--program", good, "--query", "see", "--contract", "kind"}, "--contract");
  complains({"--program", "mine {scene} {answer}", "--query", "see", "--contract", "exact"}, "{query}");
  complains({"--program", "mine '{scene} {query} {answer}", "--query", "see", "--contract", "exact"}, "quote");
  complains({"--program", "/nowhere/mine {scene} {query} {answer}", "--query", "see", "--contract", "exact", "--scenes",
             tower()},
            "cannot be started");
  complains({"--program", good, "--query", "see", "--contract", "exact", "--families", "none_such"}, "--families");
  complains({"--program", good, "--query", "see", "--contract", "exact", "--ulps", "1.5"}, "--ulps");
  complains({"--program", good, "--query", "see", "--contract", "exact", "--scenes", path("nowhere").string()},
            "nowhere: there is no such folder or file", bad_input);
  fs::create_directory(path("empty"));
  complains({"--program", good, "--query", "see", "--contract", "exact", "--scenes", path("empty").string()},
            "the folder holds no scene", bad_input);
  complains({"--program", good, "--query", "see", "--contract", "exact", "--scenes", tower(), "--families", "stacked"},
            "exclude each other");
  complains({"--program", good, "--query", "see", "--contract", "exact", "--families", "stacked", "--reduce", "5"},
            "--keep");
  complains({"--program", good, "--query", "see", "--contract", "exact", "--families", "stacked", "--ask", tower()},
            "--scenes");
  complains({"--program", good, "--query", "see", "--contract", "exact", "--scenes", tower(), "--ask", tower()},
            "tower.off:1:1: from here on it is no JSON", bad_input);
  complains({"--program", good, "--query", "see", "--contract", "exact", "--scenes", tower(), "--ask",
             path("nowhere").string()},
            "no such file", bad_input);
  for (const auto& [text, why] : {std::pair<std::string, std::string>{R"({"query": "see"})", "no \"eye\""},
                                  {R"({"query": "see", "eye": [18446744073709551617, 0, 1], "two_sided": false})",
                                   "the integer 18446744073709551617 is beyond 64 bits"}})
    complains({"--program", good, "--query", "see", "--contract", "exact", "--scenes", tower(), "--ask",
               file("query.json", text)},
              why, bad_input);
  const std::string other = file("query.json", R"({"query": "order", "eye": [0, 0, 1], "two_sided": false})");
  complains({"--program", good, "--query", "see", "--contract", "exact", "--scenes", tower(), "--ask", other},
            "another question");
}

}  // namespace program
