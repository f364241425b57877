// sightline boolean: results, certificates, what is refused.

#include "program.h"

#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace program {

class Boolean : public Program {
 protected:
  /// A box as OFF; `faces` of its six.
  std::string box(const std::string& name, const std::vector<int>& low, const std::vector<int>& high, int faces = 6) {
    std::string text = "OFF\n8 " + std::to_string(faces) + " 0\n";
    for (int k = 0; k < 8; ++k)
      text += std::to_string((k & 4) != 0 ? high[0] : low[0]) + " " + std::to_string((k & 2) != 0 ? high[1] : low[1]) +
              " " + std::to_string((k & 1) != 0 ? high[2] : low[2]) + "\n";
    const char* const all[] = {"0 1 3 2", "4 6 7 5", "0 4 5 1", "2 3 7 6", "0 2 6 4", "1 5 7 3"};
    for (int f = 0; f < faces; ++f) text += std::string("4 ") + all[f] + "\n";
    const fs::path file = path(name);
    std::ofstream(file) << text;
    return file.string();
  }
};

TEST_F(Boolean, writes_results_that_its_checker_accepts) {
  const std::string a = box("a.off", {0, 0, 0}, {3, 3, 3}), b = box("b.off", {1, 1, -1}, {2, 2, 4}),
                    c = box("c.off", {-1, 1, 1}, {4, 2, 2});
  const std::string out = path("left.qoff").string(), why = path("why.json").string();
  const Outcome r = run({"boolean", "difference", a, b, c, "--out", out, "--certificate", why, "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  const Json result = r.json()["result"];
  EXPECT_EQ(result["operation"], "difference");
  EXPECT_EQ(result["volume"], "22");
  EXPECT_EQ(result["maximal_faces"], 20);
  EXPECT_EQ(result["provenance"].size(), result["faces"]);
  EXPECT_TRUE(result["not_manifold"].empty());
  EXPECT_EQ(run({"info", out, "--json", "-"}).json()["result"]["closed"], true);
  EXPECT_EQ(run({"verify", a, why, "--solid", b, c, "--result", out}).code, done);
  EXPECT_EQ(run({"verify", a, why, "--solid", c, b}).code, disagreement);
  EXPECT_EQ(run({"verify", a, why, "--solid", b, c, "--result", a}).code, disagreement);
  EXPECT_EQ(run({"verify", a, a, "--solid", b, c}).code, bad_input);
  EXPECT_EQ(run({"verify", a, why}).code, disagreement);  // of three solids
  ASSERT_EQ(run({"boolean", "union", a, "--certificate", why}).code, done);
  EXPECT_EQ(run({"verify", a, why}).code, done);
  // Wherever in the file the format is told.
  std::ifstream written(why);
  nlohmann::ordered_json told = nlohmann::ordered_json::parse(written);
  const std::string format = told["format"];
  told.erase("format");
  told["format"] = format;
  std::ofstream(why) << told;
  const Outcome last = run({"verify", a, why});
  EXPECT_EQ(last.code, done) << last;
  EXPECT_NE(last.out.find("union of 1 solids (inside: positive)"), std::string::npos) << last;
}

TEST_F(Boolean, writes_exact_results_that_its_checker_reads_however_many_denominators_they_have) {
  const std::string a = path("a.qoff").string(), b = path("b.qoff").string(), out = path("both.qoff").string(),
                    why = path("why.json").string();
  const std::vector<std::string> sphere{"generate", "convex_sphere", "--size", "100", "--ulps", "5", "--out"};
  const auto with = [](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  ASSERT_EQ(run(with(sphere, {a})).code, done);
  ASSERT_EQ(run(with(sphere, {b, "--seed", "2", "--offset", "1/3,2/7,3/11"})).code, done);
  const Outcome made = run({"boolean", "intersection", a, b, "--out", out, "--certificate", why});
  ASSERT_EQ(made.code, done) << made;
  EXPECT_NE(made.out.find("more than 8192 bits"), std::string::npos) << made;
  const Outcome scene = run({"info", out});
  EXPECT_EQ(scene.code, bad_input) << scene;
  EXPECT_NE(scene.err.find("more than 8192 bits"), std::string::npos) << scene;
  const Outcome r = run({"verify", a, why, "--solid", b, "--result", out});
  EXPECT_EQ(r.code, done) << r;
  const Outcome small = run({"boolean", "union", a, "--out", out});
  EXPECT_EQ(small.out.find("8192"), std::string::npos) << small;
}

TEST_F(Boolean, takes_each_pair_of_solids_that_generate_makes) {
  const Outcome help = run({"generate", "--help"});
  std::size_t pairs = 0;
  for (std::size_t at = 0; (at = help.out.find("\n  solids_", at)) != std::string::npos; ++pairs) {
    at += 3;
    const std::string family = help.out.substr(at, help.out.find(' ', at) - at), a = path("a.off").string(),
                      b = path("b.off").string(), why = path("why.json").string();
    ASSERT_EQ(run({"generate", family, "--seed", "7", "--out", a, "--second", b}).code, done) << family;
    for (const char* operation : {"union", "intersection", "difference", "symmetric-difference"}) {
      const Outcome made = run({"boolean", operation, a, b, "--certificate", why});
      EXPECT_EQ(made.code, done) << made;
      EXPECT_EQ(run({"verify", a, why, "--solid", b}).code, done) << family;
      if (sanitized) break;
    }
    if (family == "solids_touching" || family == "solids_opposite_planes")
      EXPECT_EQ(run({"boolean", "intersection", a, b, "--json", "-"}).json()["result"]["volume"], "0");
    // As one scene, which says where the second begins.
    const std::string both = path("both.off").string(), query = path("both.json").string();
    ASSERT_EQ(run({"generate", family, "--seed", "7", "--out", both, "--query", query}).code, done);
    const auto faces = [&](const std::string& file) -> std::size_t {
      return run({"info", file, "--json", "-"}).json()["scene"]["faces_read"];
    };
    EXPECT_EQ(Json::parse(read_file(query))["first"], faces(a));
    EXPECT_EQ(faces(both), faces(a) + faces(b));
  }
  EXPECT_GE(pairs, 9u);
  const Outcome one = run({"generate", "boxes", "--out", path("c.off").string(), "--second", path("d.off").string()});
  EXPECT_EQ(one.code, usage);
  EXPECT_TRUE(one.one_line_of_error()) << one;
  EXPECT_FALSE(fs::exists(path("c.off")));
}

TEST_F(Boolean, refuses_what_bounds_no_solid_and_names_its_edges) {
  const std::string a = box("a.off", {0, 0, 0}, {3, 3, 3}), open = box("open.off", {1, 1, 1}, {2, 2, 2}, 5);
  const Outcome r = run({"boolean", "union", a, open});
  EXPECT_EQ(r.code, bad_input) << r;
  EXPECT_TRUE(r.one_line_of_error()) << r;
  EXPECT_NE(r.err.find("open.off"), std::string::npos) << r;
  EXPECT_NE(r.err.find("4 edges without an opposite"), std::string::npos) << r;
  // All of them are in the JSON, of all solids.
  const std::string more = box("more.off", {7, 7, 7}, {8, 8, 8}, 3);
  const Outcome listed = run({"boolean", "union", open, a, more, "--repair", "none", "--json", "-"});
  EXPECT_EQ(listed.code, bad_input) << listed;
  const Json refused = listed.json()["result"]["refused"];
  ASSERT_EQ(refused.size(), 2u);
  EXPECT_EQ(refused[0]["operand"], 0);
  EXPECT_EQ(refused[0]["open_edges"].size(), 4u);
  EXPECT_EQ(refused[1]["operand"], 2);
  EXPECT_EQ(refused[1]["file"], more);
  EXPECT_EQ(refused[1]["open_edges"].size(), 8u);
  EXPECT_EQ(run({"boolean", "difference", a}).code, usage);
  EXPECT_EQ(run({"boolean", "unite", a, a}).code, usage);
  EXPECT_EQ(run({"boolean", "union", a, a, "--inside", "out"}).code, usage);
  EXPECT_EQ(run({"boolean", "union", a, path("none.off").string()}).code, bad_input);
}

TEST_F(Boolean, says_what_it_sets_aside_cuts_and_finds_inside_out) {
  const std::string a = box("a.off", {0, 0, 0}, {3, 3, 3});
  const std::string flipped = file("inwards.off",
                                   "OFF\n4 5 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                                   "3 0 1 2\n3 0 3 1\n3 1 3 2\n3 0 2 3\n3 0 1 1\n");
  const std::string bent = file("bent.off",
                                "OFF\n5 5 0\n0 0 0\n2 0 0\n2 2 1\n0 2 0\n0 0 -9\n"
                                "4 0 1 2 3\n3 1 0 4\n3 2 1 4\n3 3 2 4\n3 0 3 4\n");
  const Outcome r = run({"boolean", "union", a, flipped, bent});
  ASSERT_EQ(r.code, done) << r;
  EXPECT_NE(r.out.find("face 4 of " + flipped), std::string::npos) << r;
  EXPECT_NE(r.out.find("face 0 of " + bent), std::string::npos) << r;
  EXPECT_NE(r.out.find("inside out             1: " + flipped), std::string::npos) << r;
  EXPECT_EQ(run({"boolean", "union", a, flipped, "--inside", "nonzero"}).out.find("inside out"), std::string::npos);
  // So small that what a double holds of its volume is rounding alone.
  const std::array<long, 3> low{1750806, 1604697, 1507457}, high{2291552, 2145443, 2048202};
  std::ostringstream corners;
  corners.precision(17);
  for (std::size_t n = 0; n < 8; ++n)
    for (std::size_t k = 0; k < 3; ++k)
      corners << std::ldexp(static_cast<double>((n >> k & 1) == 0 ? low[k] : high[k]), -378) << (k == 2 ? '\n' : ' ');
  const std::string tiny = file("tiny.off", "OFF\n8 6 0\n" + corners.str() +
                                                "4 1 3 2 0\n4 6 7 5 4\n4 4 5 1 0\n4 3 7 6 2\n4 2 6 4 0\n4 5 7 3 1\n");
  const Outcome of_tiny = run({"boolean", "union", a, tiny});
  EXPECT_NE(of_tiny.out.find("inside out             1: " + tiny), std::string::npos) << of_tiny;
  const Json scene = run({"boolean", "union", a, flipped, bent, "--json", "-"}).json()["scene"];
  EXPECT_EQ(scene["set_aside"][0]["operand"], 1);
  EXPECT_EQ(scene["non_planar"], Json::parse("[[2, 0]]"));
}

TEST_F(Boolean, says_volumes_that_doubles_do_not_hold) {
  const std::string head = "OFF\n4 4 0\n0 0 0\n", tail = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  const std::string large = file("large.off", head + "1e300 0 0\n0 1e300 0\n0 0 6e300\n" + tail),
                    small = file("small.off", head + "1e-300 0 0\n0 1e-300 0\n0 0 6e-300\n" + tail);
  EXPECT_NE(run({"boolean", "union", large}).out.find("volume                 1e+900"), std::string::npos);
  EXPECT_NE(run({"boolean", "union", small}).out.find("volume                 1e-900"), std::string::npos);
  const Outcome r = run({"boolean", "union", large, "--round", "float", "--out", path("large.obj").string()});
  EXPECT_EQ(r.code, bad_input) << r;
  EXPECT_NE(r.err.find("large.obj: a coordinate is beyond what floats hold"), std::string::npos) << r;
}

TEST_F(Boolean, snapping_mends_what_is_hardly_wider_than_the_numbers_step_and_says_what_moved) {
  const std::string a = box("a.off", {8000000, 8000000, 8000000}, {8000002, 8000002, 8000002});
  std::string askew = "OFF\n8 6 0\n";  // turned about z, at less than the step of floats from there
  for (int k = 0; k < 8; ++k) {
    const int x = (k & 4) / 2, y = k & 2, z = 2 * (k & 1);
    const auto at = [](int numerator, int denominator) {
      return std::to_string(8000000 * std::int64_t{denominator} + numerator) + '/' + std::to_string(denominator);
    };
    askew += at(9 * x - 12 * y + 20, 15) + ' ' + at(28 * x + 21 * y + 5, 35) + ' ' + at(3 * z + 1, 5) + '\n';
  }
  const std::string b = file("b.qoff", askew + "4 0 1 3 2\n4 4 6 7 5\n4 0 4 5 1\n4 2 3 7 6\n4 0 2 6 4\n4 1 5 7 3\n");
  const std::string out = path("u.off").string();
  const auto run_with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"boolean", "symmetric-difference", a, b, "--out", out};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  };
  // 1. Rounding breaks it, and says so.
  const Json broken = run_with({"--round", "float", "--json", "-"}).json()["result"]["rounding"];
  EXPECT_EQ(broken["sound"], false) << broken;
  EXPECT_EQ(broken["vanished"].size() + broken["added"].size(), 0u);
  // 2. Snapping mends it: what it wrote is a solid, as it stands.
  const Outcome r = run_with({"--round", "float", "--snap", "--json", "-"});
  EXPECT_EQ(r.code, done) << r;
  const Json rounding = r.json()["result"]["rounding"];
  EXPECT_EQ(rounding["sound"], true) << r;
  EXPECT_GT(rounding["rounds"], 0);
  EXPECT_LT(rounding["farthest"], 8);
  const Json again = run({"boolean", "union", out, "--json", "-"}).json()["result"];
  const Json nonzero = run({"boolean", "union", out, "--inside", "nonzero", "--json", "-"}).json()["result"];
  EXPECT_EQ(again["volume"], nonzero["volume"]);
  // Where it may not try so often, it takes a coarser grid, and says so.
  ASSERT_GT(rounding["rounds"], 1);
  const std::string fewer = std::to_string(rounding["rounds"].get<std::size_t>() - 1);
  const Outcome coarse = run_with({"--round", "float", "--snap", "--snap-rounds", fewer, "--json", "-"});
  EXPECT_EQ(coarse.code, done) << coarse;
  const Json left = coarse.json()["result"]["rounding"];
  EXPECT_EQ(left["sound"], true) << coarse;
  EXPECT_GT(left["coarser"], rounding["coarser"]) << coarse;
  EXPECT_GT(left["rounds"], rounding["rounds"].get<std::size_t>() - 1) << coarse;
  const std::string of_coarse = run_with({"--round", "float", "--snap", "--snap-rounds", fewer}).out;
  EXPECT_NE(of_coarse.find("to a grid of 2^4 of the numbers' steps, by which"), std::string::npos) << of_coarse;
  const std::string said = run_with({"--round", "float", "--snap"}).out;
  EXPECT_NE(said.find("rounds, by which"), std::string::npos) << said;
  // 3. A slab that is too thin for floats vanishes, all of it, and its exact corners are listed.
  const std::string slab = file("slab.qoff",
                                "OFF\n8 6 0\n0 0 1\n0 0 1073741825/1073741824\n0 1 1\n0 1 1073741825/1073741824\n"
                                "1 0 1\n1 0 1073741825/1073741824\n1 1 1\n1 1 1073741825/1073741824\n"
                                "4 0 1 3 2\n4 4 6 7 5\n4 0 4 5 1\n4 2 3 7 6\n4 0 2 6 4\n4 1 5 7 3\n");
  const Outcome gone = run({"boolean", "union", slab, "--out", out, "--round", "float", "--snap", "--json", "-"});
  EXPECT_EQ(gone.code, done) << gone;
  EXPECT_EQ(gone.json()["result"]["faces"], 0);
  const Json lost = gone.json()["result"]["rounding"]["vanished"];
  EXPECT_EQ(lost.size(), 8u);
  EXPECT_EQ(std::count(lost.begin(), lost.end(), Json::parse(R"(["1", "1", "1073741825/1073741824"])")), 1) << lost;
  // 4. Doubles hold the two.
  EXPECT_EQ(run_with({"--snap", "--json", "-"}).json()["result"]["rounding"]["rounds"], 0);
}

TEST_F(Boolean, refuses_options_that_would_do_nothing_and_files_that_nothing_can_be_written_to) {
  const std::string a = box("a.off", {0, 0, 0}, {3, 3, 3}), b = box("b.off", {1, 1, 1}, {4, 4, 4});
  const auto code = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"boolean", "union", a, b};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome r = run(words);
    EXPECT_TRUE(r.code == done || r.one_line_of_error()) << r;
    return r.code;
  };
  const std::string exact = path("u.qoff").string();
  EXPECT_EQ(code({"--out", exact}), done);
  EXPECT_EQ(code({"--out", exact, "--round", "float"}), usage);
  EXPECT_EQ(code({"--round", "float"}), usage);
  EXPECT_EQ(code({"--snap"}), usage);
  EXPECT_EQ(code({"--out", path("u.off").string(), "--snap-rounds", "3"}), usage);
  for (const std::string ending : {"map", "bsp", "glb", "none"}) {
    const std::string out = path("u." + ending).string();
    EXPECT_EQ(code({"--out", out}), usage) << ending;
    EXPECT_EQ(run({"shadow", a, "--light", "9,9,9", "--volume", out}).code, usage) << ending;
  }
  EXPECT_EQ(code({"--repair", "fill"}), usage);
}

/// A level whose brushes overlap, stand in each other and upon each other.
TEST_F(Boolean, the_union_of_a_levels_brushes_sees_what_its_faces_see) {
  const std::string rooms = read_file(corpus / "general" / "two_rooms.map");
  const auto brush = [](std::array<int, 3> low, std::array<int, 3> high) {
    const auto at = [](std::array<int, 3> p, int k, int by) {
      p[static_cast<std::size_t>(k)] += by;
      return "( " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " + std::to_string(p[2]) + " ) ";
    };
    std::string text = "{\n";
    for (const auto& [k, i, j] : {std::array{0, 2, 1}, {1, 0, 2}, {2, 1, 0}}) {
      text += at(low, i, 1) + at(low, 0, 0) + at(low, j, 1) + "wall 0 0 0 1 1\n";
      text += at(high, j, 1) + at(high, 0, 0) + at(high, i, 1) + "wall 0 0 0 1 1\n";
    }
    return text + "}\n";
  };
  const std::string added = "{\n\"classname\" \"func_group\"\n" + brush({20, 20, -8}, {40, 40, 30}) +
                            brush({30, 10, 0}, {50, 30, 20}) + brush({25, 25, 5}, {30, 30, 15}) +
                            brush({20, 20, 30}, {30, 30, 40}) + "}\n";
  const std::string level = file("level.map", rooms + added), united = path("level.qoff").string(),
                    why = path("why.json").string();
  const Outcome r = run({"boolean", "union", level, "--out", united, "--certificate", why, "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  const Json result = r.json()["result"];
  EXPECT_EQ(run({"verify", level, why, "--result", united}).code, done);

  // 1. Provenance: faces of brushes, none of those that stand in another one.
  const std::vector<std::array<std::size_t, 2>> provenance = result["provenance"], brushes = result["brushes"];
  ASSERT_EQ(brushes.size(), provenance.size());
  const std::size_t faces = r.json()["scene"]["operands"][0]["faces_read"];
  std::set<std::size_t> of_group;
  for (std::size_t f = 0; f < provenance.size(); ++f)
    if (provenance[f][1] >= faces - 24) {  // the last four brushes
      EXPECT_EQ(brushes[f][1], (provenance[f][1] - (faces - 24)) / 6);
      of_group.insert(brushes[f][1]);
      EXPECT_EQ(brushes[f][0], 4u);
    } else {
      EXPECT_LT(brushes[f][0], 4u);
    }
  EXPECT_EQ(of_group, (std::set<std::size_t>{0, 1, 3}));

  // 2. What boxes of the level see: the same faces.
  const auto seen = [&](const std::string& scene, const auto& name_of) {
    const Outcome pvs = run({"pvs", scene, "--grid", "3,2,2", "--json", "-"});
    EXPECT_EQ(pvs.code, done) << pvs;
    std::map<std::string, std::set<std::size_t>> faces_of;
    const Json boxes = pvs.json()["result"]["boxes"];
    for (const Json& box : boxes)
      for (const std::size_t face : box["visible"].get<std::vector<std::size_t>>())
        faces_of[box["box"].dump()].insert(name_of(face));
    return faces_of;
  };
  const auto of_soup = seen(level, [](std::size_t face) { return face; });
  EXPECT_EQ(seen(united, [&](std::size_t face) { return provenance[face][1]; }), of_soup);
  EXPECT_EQ(of_soup.size(), 12u);
}

TEST_F(Boolean, a_brush_that_bounds_nothing_is_named) {
  std::string rooms = read_file(corpus / "general" / "two_rooms.map");
  const std::size_t second = rooms.find("}\n{") + 4, line = rooms.find('\n', second) + 1;
  const Outcome r = run({"boolean", "union", file("open.map", rooms.erase(second, line - second))});
  EXPECT_EQ(r.code, bad_input) << r;
  EXPECT_TRUE(r.one_line_of_error()) << r;
  EXPECT_NE(r.err.find("open.map:13:1: brush 1 of entity 0 has no end"), std::string::npos) << r;
}

}  // namespace program
