// generate: every kind makes a scene that the other commands read.

#include "program.h"

#include <cctype>
#include <set>

namespace program {

class Generate : public Program {
 protected:
  /// The kinds that the help lists.
  std::vector<std::string> kinds() {
    const Outcome r = run({"generate", "--help"});
    std::vector<std::string> names;
    std::istringstream lines(r.out.substr(std::min(r.out.size(), r.out.find("Kinds of any size"))));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line) && line.starts_with("  ")) names.push_back(line.substr(2, line.find(' ', 2) - 2));
    EXPECT_GE(names.size(), 10u) << r;
    return names;
  }
  Json info(const std::string& scene) {
    const Outcome r = run({"info", scene, "--json", "-"});
    EXPECT_EQ(r.code, done) << r;
    return r.json();
  }
};

TEST_F(Generate, every_kind_in_its_own_size_is_a_scene_of_faces_that_none_is_set_aside_of) {
  std::size_t number = 0;
  for (const std::string& kind : kinds()) {
    if (sanitized && number++ % 3 != 0) continue;
    const std::string scene = path(kind + ".qoff").string();
    const Outcome r = run({"generate", kind, "--out", scene});
    ASSERT_EQ(r.code, done) << r;
    EXPECT_EQ(r.err, "") << r;
    const Json d = info(scene);
    EXPECT_GE(d["scene"]["faces"], 1) << kind;
    EXPECT_EQ(d["scene"]["set_aside"].size(), 0u) << kind << d["scene"]["set_aside"].dump().substr(0, 300);
    EXPECT_EQ(d["result"]["non_planar"].size(), 0u) << kind;
  }
}

TEST_F(Generate, every_kind_can_be_ordered_and_the_order_verified) {
  std::size_t number = 0;
  for (const std::string& kind : kinds()) {
    if (sanitized && number++ % 3 != 1) continue;
    const std::string scene = path(kind + ".qoff").string(), certificate = path("c.json").string();
    const std::string size = kind == "bars"                                  ? "5"
                             : kind.starts_with("menger_sponge")             ? "1"
                             : kind == "convex_sphere" || kind == "terrain"  ? "100"
                             : kind.starts_with("soup") || kind == "slivers" ? "40"
                                                                             : "2";
    ASSERT_EQ(run({"generate", kind, "--size", size, "--out", scene}).code, done) << kind << size;
    for (const char* eye : {"7/3,-11,5.3", "0,0,0", "1/2,1/2,1/2"}) {
      if (sanitized && *eye != '1') continue;
      const Outcome o = run({"order", scene, "--eye", eye, "--certificate", certificate});
      ASSERT_EQ(o.code, done) << o;
      const Outcome v = run({"verify", scene, certificate});
      EXPECT_EQ(v.code, done) << v << kind << eye;
    }
  }
}

TEST_F(Generate, a_seed_repeats_and_another_gives_another_scene) {
  for (const char* kind : {"soup", "city", "rooms", "terrain", "convex_sphere"}) {
    std::set<std::string> texts;
    for (const char* seed : {"1", "2", "1"}) {
      const std::string scene = path("a.qoff").string();
      ASSERT_EQ(run({"generate", kind, "--seed", seed, "--out", scene}).code, done);
      texts.insert(read_file(scene));
    }
    EXPECT_EQ(texts.size(), 2u) << kind;
  }
}

TEST_F(Generate, each_format_holds_the_same_scene) {
  Json first;
  for (const char* ending : {".off", ".obj", ".ply", ".qoff", ".OFF"}) {
    const std::string scene = path(std::string("rooms") + ending).string();
    const Outcome r = run({"generate", "rooms", "--size", "2", "--out", scene});
    ASSERT_EQ(r.code, done) << r;
    Json result = info(scene)["result"];
    if (first.is_null()) first = result;
    EXPECT_EQ(result.dump(), first.dump()) << ending;
  }
}

TEST_F(Generate, stl_holds_triangles_and_refuses_others) {
  const Outcome soup = run({"generate", "soup", "--out", path("soup.stl").string()});
  EXPECT_EQ(soup.code, done) << soup;
  EXPECT_EQ(info(path("soup.stl").string())["scene"]["faces"], 1000);
  const Outcome stacked = run({"generate", "stacked", "--out", path("stacked.stl").string()});
  EXPECT_EQ(stacked.code, bad_input) << stacked;
  EXPECT_TRUE(stacked.one_line_of_error()) << stacked;
  EXPECT_FALSE(fs::exists(path("stacked.stl"))) << "no half a file";
}

TEST_F(Generate, sizes_that_make_no_sense_are_usage_errors_at_once) {
  const std::vector<std::string> all = kinds();
  for (const std::string& kind : all)
    for (const char* size : {"1000000000000", "9999999999999999999", "18446744073709551615", "-1", "many"}) {
      if (std::isdigit(static_cast<unsigned char>(*size)) == 0 && kind != all[0]) continue;  // are numbers of no kind
      const Outcome r = run({"generate", kind, "--size", size, "--out", path("a.off").string()}, {10, 1024});
      EXPECT_EQ(r.code, usage) << r;
      EXPECT_TRUE(r.one_line_of_error()) << r;
      EXPECT_FALSE(fs::exists(path("a.off")));
    }
}

TEST_F(Generate, an_unknown_ending_is_told) {
  const std::string known = path("a.off").string();
  ASSERT_EQ(run({"generate", "stacked", "--out", known}).code, done);
  for (const std::string& unknown : {path("a.xyz").string(), path("a.map").string(), std::string("-")})
    for (const std::vector<std::string>& words : {std::vector<std::string>{"generate", "stacked", "--out", unknown},
                                                  {"generate", "solids_touching", "--out", known, "--second", unknown},
                                                  {"reduce", known, "--out", unknown, "--", "false", "{}"}}) {
      const Outcome r = run(words);
      EXPECT_EQ(r.code, usage) << r;
      EXPECT_TRUE(r.one_line_of_error()) << r;
      EXPECT_NE(r.err.find(".qoff"), std::string::npos) << r;
    }
}

}  // namespace program
