// Bad input: one line that says where, exit code 3; never a crash, a hang, or memory out of proportion.

#include "program.h"

#include <cmath>

namespace program {

class Bad_input : public Program {
 protected:
  /// info, bsp and order refuse a scene in one line, which says where. They read it alike: under sanitizers each of
  /// them is asked in turn.
  void expect_refused(const std::string& scene, const std::string& where, Limits limits = {10, 1024}) {
    const std::vector<std::vector<std::string>> commands{
        {"info", scene}, {"bsp", scene}, {"order", scene, "--eye", "3,4,5"}, {"info", scene, "--json", "-"}};
    ++refused_;
    for (std::size_t k = 0; k < commands.size(); ++k) {
      if (sanitized && k != refused_ % commands.size()) continue;
      std::vector<std::string> arguments = commands[k];
      arguments.insert(arguments.end(), {"--threads", "1"});
      const Outcome r = run(arguments, limits);
      EXPECT_EQ(r.code, bad_input) << r;
      EXPECT_EQ(r.out, "") << r;
      EXPECT_TRUE(r.one_line_of_error()) << r;
      EXPECT_EQ(r.err.rfind("sightline: " + scene + where, 0), 0u) << "expected '" << where << "' in " << r;
    }
  }
  /// info, bsp and order take a scene, and verify accepts what order wrote. Returns what info says.
  Json expect_taken(const std::string& scene, Limits limits = {60, 2048}) {
    const Outcome b = run({"bsp", scene, "--threads", "1"}, limits);
    EXPECT_EQ(b.code, done) << b;
    const Outcome o =
        run({"order", scene, "--eye", "30,41,52", "--threads", "1", "--certificate", path("certificate.json").string()},
            limits);
    EXPECT_EQ(o.code, done) << o;
    const Outcome v = run({"verify", scene, path("certificate.json").string()}, limits);
    EXPECT_EQ(v.code, done) << v;
    const Outcome i = run({"info", scene, "--json", "-"}, limits);
    EXPECT_EQ(i.code, done) << i;
    return i.json();
  }

 private:
  std::size_t refused_ = 0;  ///< scenes
};

TEST_F(Bad_input, every_failure_of_the_corpus_is_refused_with_its_place) {
  std::ifstream expected(corpus / "failure" / "expected.txt");
  std::size_t tried = 0;
  for (std::string line; std::getline(expected, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::size_t colon = line.find(':');
    ASSERT_NE(colon, std::string::npos) << line;
    expect_refused((corpus / "failure" / line.substr(0, colon)).string(), line.substr(colon));
    ++tried;
  }
  EXPECT_EQ(tried, scenes_in(corpus / "failure").size()) << "each failure has a line in expected.txt";
}

TEST_F(Bad_input, a_missing_file_and_a_folder_and_a_device_are_refused) {
  expect_refused(path("none.off").string(), ": no such file");
  expect_refused(path("").string(), ": is a directory");
  expect_refused("/dev/zero", ": is not a file that has an end");
  expect_refused(file("scene.xyz", "1 2 3\n"), ": neither its ending nor its content is of a known format");
}

TEST_F(Bad_input, an_unreadable_file_is_refused) {
  if (geteuid() == 0) GTEST_SKIP() << "root reads everything";
  const std::string scene = file("locked.off", "OFF\n0 0 0\n");
  fs::permissions(scene, fs::perms::none);
  expect_refused(scene, ": cannot be opened");
}

TEST_F(Bad_input, a_name_with_line_ends_gives_one_line) {
  const Outcome r = run({"info", path("a\nb.off").string()});
  EXPECT_EQ(r.code, bad_input) << r;
  EXPECT_TRUE(r.one_line_of_error()) << r;
}

TEST_F(Bad_input, a_cube_cut_off_anywhere_is_refused_or_read_never_a_crash) {
  const std::string whole = read_file(corpus / "general" / "cube.off");
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    const Outcome r = run({"info", file("cut.off", whole.substr(0, length)), "--threads", "1"}, {10, 1024});
    EXPECT_TRUE(r.code == done || r.code == bad_input) << r;  // a number of the last face may be a shorter one
    EXPECT_EQ(r.code == bad_input, r.one_line_of_error()) << r;
  }
}

TEST_F(Bad_input, announced_multitudes_take_no_memory) {
  for (const char* name :
       {"billion_faces.off", "billion_points.off", "billion_corners.off", "billion_faces.ply", "billion_facets.stl"}) {
    const Outcome r = run({"info", (corpus / "failure" / name).string(), "--threads", "1"}, {5, 128});
    EXPECT_EQ(r.code, bad_input) << r;
  }
}

TEST_F(Bad_input, a_query_of_another_scene_or_of_many_brackets_is_refused) {
  const std::string cube = (corpus / "general" / "cube.off").string();
  const std::size_t brackets = sanitized ? 30'000 : 200'000;
  const std::string deep = std::string(brackets, '[') + std::string(brackets, ']'),
                    begin = R"({"format": "sightline query 1", "eye": )", eye = R"(["0", "0", "9"], )";
  const std::vector<std::pair<std::string, std::string>> queries{
      {(corpus / "queries" / "face_out_of_range.json").string(),
       "\"visible\" names a face that is not one of the scene's 6"},
      {file("eye.json", begin + deep + '}'), "is nested too deeply"},
      {file("eyes.json", begin + "[0, 0, " + deep + "]}"), "is nested too deeply"},
      {file("source.json", begin + eye + "\"source\": " + deep + '}'), "is nested too deeply"},
      {file("hidden.json", begin + eye + "\"hidden\": " + deep + '}'), "is nested too deeply"},
      {file("bytes.json", begin + "\x7f\n\xff"), "from here on it is no JSON"}};
  for (const auto& [query, why] : queries)
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"fuzz", "see", "--scene", cube, "--query", query},
          {"reduce", cube, "--out", path("small.off").string(), "--query", query, "--", "false", "{}"}}) {
      const Outcome r = run(words, {20, 1024});
      EXPECT_EQ(r.code, bad_input) << r;
      EXPECT_TRUE(r.one_line_of_error()) << r;
      EXPECT_NE(r.err.find(query + ":"), std::string::npos) << r;
      EXPECT_NE(r.err.find(why), std::string::npos) << r;
    }
}

TEST_F(Bad_input, a_common_denominator_that_explodes_is_refused) {
  // Each point has another denominator of 61 bits with few common factors: those of 143 points have a multiple of 8192
  // bits.
  std::string text = "OFF\n600 1 0\n";
  unsigned long long n = (1ull << 61) - 1;
  for (int i = 0; i < 600; ++i, n -= 2) text += "1/" + std::to_string(n) + " " + std::to_string(i) + " 0\n";
  text += "3 0 1 2\n";
  const std::string scene = file("bomb.qoff", text);
  expect_refused(scene, ":146:1: common denominator", {20, 1024});
  const Outcome r = run({"info", scene, "--coordinates", "double", "--threads", "1"}, {20, 1024});
  EXPECT_EQ(r.code, done) << "rounded, as the message proposes: " << r;
}

TEST_F(Bad_input, decimals_of_all_exponents_are_not_a_bomb) {
  std::string text = "OFF\n400 398 0\n";
  for (int i = 0; i < 400; ++i)
    text += "1e" + std::to_string(5 * i - 1000) + " " + std::to_string(i) + " " + std::to_string(i * i) + "\n";
  for (int i = 0; i < 398; ++i)
    text += "3 " + std::to_string(i) + " " + std::to_string(i + 1) + " " + std::to_string(i + 2) + "\n";
  const std::string scene = file("exponents.off", text);
  const Outcome r = run({"info", scene, "--threads", "1"}, {20, 1024});
  EXPECT_EQ(r.code, done) << r;
}

TEST_F(Bad_input, a_number_of_a_million_digits_is_a_number) {
  const std::string scene =
      file("long.off", "OFF\n3 1 0\n0." + std::string(1'000'000, '3') + " 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const Outcome r = run({"info", scene, "--threads", "1"}, {20, 1024});
  EXPECT_TRUE(r.code == done || (r.code == bad_input && r.one_line_of_error())) << r;
}

TEST_F(Bad_input, faces_of_fewer_than_three_corners_are_set_aside) {
  const std::string scene = file("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 3\nf\nf 1 2 3\n");
  const Json info = expect_taken(scene);
  EXPECT_EQ(info["scene"]["faces_read"], 4);
  EXPECT_EQ(info["scene"]["faces"], 1);
  EXPECT_EQ(info["scene"]["set_aside"],
            Json::parse(R"([{"face":0,"why":"zero area"},{"face":1,"why":"zero area"},{"face":2,"why":"zero area"}])"))
      << info["scene"];
}

TEST_F(Bad_input, a_scene_without_faces_or_points_is_an_empty_scene) {
  for (const char* text : {"OFF\n0 0 0\n", "OFF\n2 0 0\n0 0 0\n1 1 1\n", "OFF\n1 1 0\n1 2 3\n0\n"}) {
    const std::string scene = file("empty.off", text);
    const Json info = expect_taken(scene);
    EXPECT_EQ(info["scene"]["faces"], 0) << info;
    for (const char* kernel : {"exact", "epeck", "gmpq", "epick", "double", "float"}) {
      const Outcome r = run({"order", scene, "--eye", "1,1,1", "--kernel", kernel, "--svg", path("a.svg").string()});
      EXPECT_EQ(r.code, done) << r;
    }
  }
}

TEST_F(Bad_input, polygons_of_thousands_of_corners_are_cut_and_ordered) {
  const int n = sanitized ? 2'000 : 5'000;
  // Convex: on a parabola, so exactly convex.
  std::string convex = "OFF\n" + std::to_string(n) + " 1 0\n", comb = convex, face = std::to_string(n);
  for (long i = 0; i < n; ++i) {
    const long x = i - n / 2;
    convex += std::to_string(x) + " " + std::to_string(x * x) + " 7\n";
    comb += i == 0   ? "-1 -5 7\n"
            : i == 1 ? std::to_string(n) + " -5 7\n"
                     : std::to_string(n - i) + (i % 2 == 0 ? " 0 7\n" : " 100 7\n");
    face += " " + std::to_string(i);
  }
  const Json one = expect_taken(file("convex.off", convex + face + "\n"), {30, 1024});
  EXPECT_EQ(one["result"]["pieces"], 1) << one["scene"];
  // Concave: a comb; its teeth make it as concave as can be.
  const Json many = expect_taken(file("comb.off", comb + face + "\n"), {120, 1024});
  EXPECT_EQ(many["result"]["concave"], Json::array({0})) << many["scene"];
  EXPECT_GE(many["result"]["pieces"], n / 2 - 2) << many["scene"];
}

TEST_F(Bad_input, a_million_repetitions_of_one_corner_are_one_point) {
  const int repetitions = sanitized ? 100'000 : 1'000'000;
  std::string face = std::to_string(repetitions + 3) + " 0 1 2";
  for (int i = 0; i < repetitions; ++i) face += " 2";
  const Json info = expect_taken(file("stutter.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n" + face + "\n"), {30, 1024});
  EXPECT_EQ(info["result"]["pieces"], 1);
}

TEST_F(Bad_input, ends_of_lines_and_comments_change_nothing) {
  const auto fragments = [&](const std::string& scene) {
    const Outcome r = run({"order", scene, "--eye", "3,-4,5/2", "--json", "-"});
    EXPECT_EQ(r.code, done) << r;
    return r.json()["result"];
  };
  const Json plain = fragments(
      file("plain.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nv 0 0 1\nv 1 0 1\nv 1 1 1\nf -3 -2 -1\n"));
  EXPECT_EQ(fragments((corpus / "robust" / "mixed_line_ends.obj").string()), plain);
}

TEST_F(Bad_input, targets_that_cannot_be_written_are_told_and_exit_3) {
  const std::string cube = (corpus / "general" / "cube.off").string();
  const std::string nowhere = path("no/such/folder/x").string(), folder = path("").string();
  for (const std::string& target : {nowhere, folder, std::string("/dev/full")})
    for (const char* option : {"--json", "--svg", "--certificate"}) {
      const Outcome r = run({"order", cube, "--eye", "3,4,5", option, target});
      EXPECT_EQ(r.code, bad_input) << r;
      EXPECT_TRUE(r.one_line_of_error()) << r;
      EXPECT_NE(r.err.find(target), std::string::npos) << r;
    }
  for (const char* command : {"info", "bsp"}) {
    const Outcome r = run({command, cube, "--json", nowhere});
    EXPECT_EQ(r.code, bad_input) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
  }
  const Outcome r = run({"generate", "stacked", "--out", path("no/such/folder/x.off").string()});
  EXPECT_EQ(r.code, bad_input) << r;
  EXPECT_TRUE(r.one_line_of_error()) << r;
}

TEST_F(Bad_input, a_full_standard_output_is_no_success) {
  const std::string cube = (corpus / "general" / "cube.off").string();
  for (const std::vector<std::string>& words : {std::vector<std::string>{"info", cube},
                                                {"info", cube, "--json", "-"},
                                                {"order", cube, "--eye", "3,4,5", "--json", "-"},
                                                {"bsp", cube},
                                                {"completion", "bash"},  // more than is kept before it is written
                                                {"schema", "see"}}) {
    const Outcome r = run_to("/dev/full", words);
    EXPECT_EQ(r.code, bad_input) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
    EXPECT_NE(r.err.find("No space left on device"), std::string::npos) << r;
  }
}

TEST_F(Bad_input, certificates_that_are_none_are_refused) {
  const std::string cube = (corpus / "general" / "cube.off").string();
  for (
      const std::string& certificate :
      {path("none.json").string(), path("").string(), file("empty.json", ""),
       file("garbage.json", std::string("\0\1\2{\xff", 5)), file("other.json", "{\"format\": \"sightline see 1\"}"),
       file("list.json", "[]"), file("half.json", "{\"format\": \"sightline order 1\", \"eye\": [\"1\", \"2\""),
       file("deep.json", std::string(1'000'000, '[')),
       file("numbers.json", R"({"format": "sightline order 1", "eye": [1, 2, 3], "fragments": []})"),
       file(
           "face.json",
           R"({"format": "sightline order 1", "eye": ["1", "2", "3"], "fragments": [{"face": -1, "piece": 0, "vertices": []}]})"),
       file("zero.json", R"({"format": "sightline order 1", "eye": ["1/0", "2", "3"], "fragments": []})")}) {
    const Outcome r = run({"verify", cube, certificate}, {20, 1024});
    EXPECT_EQ(r.code, bad_input) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
    EXPECT_NE(r.err.find(certificate), std::string::npos) << r;
    EXPECT_EQ(r.out, "") << r;
  }
}

TEST_F(Bad_input, certificates_are_refused_with_the_place_and_what_to_do) {
  const std::string cube = (corpus / "general" / "cube.off").string(),
                    scene = (corpus / "general" / "cornell.obj").string();
  const auto expect = [&](const std::string& certificate, const std::string& says) {
    const Outcome r = run({"verify", cube, certificate});
    EXPECT_EQ(r.code, bad_input) << r;
    EXPECT_EQ(r.err, "sightline: " + certificate + says + "\n") << r;
  };
  const std::string again = "; write the file again, or fetch it again";
  expect(path("").string(),
         ": is a directory; name a file in it, or a folder that `sightline pvs --certificates` wrote");
  expect(file("comma.json", "{\n \"format\": \"sightline order 1\",,\n}"), ":2:32: from here on it is no JSON" + again);
  expect(file("short.json", "{\n \"format\": [1, 2"), ":2:17: the JSON ends too early" + again);
  expect(file("huge.json", "{\"format\": 1e999}"), ":1:17: number overflow parsing '1e999'" + again);
  expect(
      file("table.json",
           "{\"format\": \"sightline order 2\", \"eye\": [\"1\",\"2\",\"3\"], \"points\": [],\n \"fragments\": "
           "[{\"face\": 0, "
           "\"piece\": 0, \"vertices\": [7]}]}"),
      ":2:16: fragments[0].vertices[0]: expected a number below 0, the size of \"points\"; make the certificate again");
  expect(scene, ": is a scene by its name, not a certificate; `verify` wants SCENE, then CERTIFICATE");
  for (const Outcome& r :
       {run({"verify", cube, file("list.json", "[]")}), run({"verify", cube, file("none.json", "")})})
    EXPECT_EQ(r.err.find("json.exception"), std::string::npos) << r;
}

TEST_F(Bad_input, memory_that_runs_out_is_told) {
  if (sanitized) GTEST_SKIP() << "sanitizers take address space of their own";
  const std::string soup = path("soup.off").string();
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"generate", "soup", "--size", "100000000", "--out", soup},  // a vector
        {"generate", "city_rotated", "--size", "4000000", "--out", soup}}) {                 // GMP's numbers
    const Outcome r = run(words, {60, 512});
    EXPECT_EQ(r.code, undecided) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
    EXPECT_NE(r.err.find("out of memory; take a smaller scene"), std::string::npos) << r;
    EXPECT_FALSE(fs::exists(soup));
  }
}

}  // namespace program
