// sightline see: what it prints, its certificates, its lines, eyes that are nowhere good, wrong arguments.

#include "program.h"

#include <sightline/kernel/number.h>

#include <algorithm>
#include <set>

namespace program {

class See : public Program {
 protected:
  const std::string cube = (corpus / "general" / "cube.off").string();  // [0, 1]^3
  const std::string crossing = (corpus / "general" / "crossing_quads.obj").string();

  Json see(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "see");
    arguments.insert(arguments.end(), {"--json", "-"});
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, done) << r;
    return r.json();
  }
  Json certificate(const std::string& scene, std::vector<std::string> arguments) {
    const std::string to = path("seen.json").string();
    arguments.insert(arguments.begin(), {"see", scene});
    arguments.insert(arguments.end(), {"--certificate", to});
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, done) << r;
    return Json::parse(read_file(to));
  }
  void expect(int code, const std::string& scene, const Json& made) {
    const Outcome r = run({"verify", scene, file("made.json", made.dump()), "--json", "-"});
    EXPECT_EQ(r.code, code) << r;
    EXPECT_EQ(r.json()["result"]["accepted"], code == done) << r;
  }
};

TEST_F(See, shows_a_cube_from_each_kind_of_eye) {
  EXPECT_EQ(see({cube, "--eye", "1/2,1/2,5"})["result"]["visible"].size(), 1u);
  EXPECT_EQ(see({cube, "--eye", "3,0.5,5"})["result"]["visible"].size(), 2u);
  const Json corner = see({cube, "--eye", "3,-4,5"});
  EXPECT_EQ(corner["result"]["visible"].size(), 3u);
  EXPECT_EQ(corner["result"]["eye"], Json({"3", "-4", "5"}));
  for (const Json& piece : corner["result"]["pieces"]) {
    EXPECT_EQ(piece["side"], "front");
    EXPECT_GE(piece["vertices"].size(), 3u);
  }
  // Inside all faces are seen from behind.
  EXPECT_EQ(see({cube, "--eye", "1/3,1/3,1/3"})["result"]["visible"].size(), 0u);
  const Json inside = see({cube, "--eye", "1/3,1/3,1/3", "--two-sided"});
  EXPECT_EQ(inside["result"]["visible"].size(), 6u);
  EXPECT_EQ(inside["result"]["pieces"][0]["side"], "back");
  // On a face it is edge-on; at a corner three are.
  EXPECT_EQ(see({cube, "--eye", "1/3,1/3,1", "--two-sided"})["result"]["visible"].size(), 5u);
  const Json vertex = see({cube, "--eye", "0,0,0", "--two-sided"});
  EXPECT_EQ(vertex["result"]["visible"].size(), 3u);
  EXPECT_EQ(vertex["counters"]["edge_on"], 3);
  // In a face's plane, beside it.
  EXPECT_EQ(see({cube, "--eye", "5,1/2,1"})["result"]["visible"].size(), 1u);
  // As far as doubles do not go.
  EXPECT_EQ(see({cube, "--eye", "1e400,1e400,1e400"})["result"]["visible"].size(), 3u);
}

TEST_F(See, gives_certificates_that_are_accepted_for_every_scene_and_rejected_once_changed) {
  for (const char* folder : {"general", "robust"})
    for (const fs::path& scene : scenes_in(corpus / folder)) {
      if (sanitized && fs::file_size(scene) > 2000) continue;
      const Json made = certificate(scene.string(), {"--eye", "7/2,-5,3"});
      expect(done, scene.string(), made);
      if (made["parts"].empty()) continue;
      Json changed = made;
      changed["parts"].erase(changed["parts"].size() / 2);
      expect(disagreement, scene.string(), changed);
    }
  expect(done, crossing,
         certificate(crossing, {"--frustum", "--look", "1,2,-1", "--field", "100", "--eye", "-3,-4,3"}));
  expect(done, cube, certificate(cube, {"--eye", "1/3,1/3,1/3"}));
  expect(done, cube, certificate(cube, {"--eye", "0,0,1/2"}));
}

TEST_F(See, cuts_edges_into_visible_and_hidden_parts) {
  const Json d = see({cube, "--eye", "3,-4,5", "--lines"});
  std::size_t visible = 0, hidden = 0, outline = 0;
  for (const Json& line : d["result"]["lines"]) {
    ASSERT_GE(line["parts"].size(), 1u) << line;
    EXPECT_EQ(line["faces"].size(), 2u);
    outline += line["class"] == "silhouette";
    EXPECT_EQ(line["parts"].front()["vertices"][0], line["vertices"][0]);
    EXPECT_EQ(line["parts"].back()["vertices"][1], line["vertices"][1]);
    for (const Json& part : line["parts"]) EXPECT_EQ(part.contains("hidden_by"), part["visible"] == false);
    ++(line["parts"][0]["visible"] == true ? visible
                                           : hidden);  // the three at the far corner, each behind one face or two
  }
  EXPECT_EQ(visible, 9u);
  EXPECT_EQ(hidden, 3u);
  EXPECT_EQ(outline, 6u);
  std::size_t intersections = 0;
  const Json crossed = see({crossing, "--eye", "-3,-4,3", "--lines"});
  for (const Json& line : crossed["result"]["lines"]) intersections += line["class"] == "intersection";
  EXPECT_GE(intersections, 1u);
}

TEST_F(See, lists_lines_where_faces_cross_alike_in_any_order_of_the_faces) {
  // Two ramps through each other and a level roof through both, its middle between them and the eye.
  const std::string points =
      "-3 -3 -3\n3 -3 3\n3 3 3\n-3 3 -3\n-3 -3 3\n3 -3 -3\n3 3 -3\n-3 3 3\n"
      "-2 -4 1\n2 -4 1\n2 4 1\n-2 4 1\n";
  std::vector<std::string> faces{"4 0 1 2 3\n", "4 4 5 6 7\n", "4 8 9 10 11\n"};
  std::sort(faces.begin(), faces.end());
  std::set<Json> found;
  do {
    const Json d = see(
        {file("ramps.off", "OFF\n12 3 0\n" + points + faces[0] + faces[1] + faces[2]), "--eye", "1/7,0,12", "--lines"});
    Json lines = Json::array();
    for (const Json& line : d["result"]["lines"])
      if (line["class"] == "intersection") lines.push_back(line["parts"]);
    EXPECT_EQ(lines.size(), 2u);
    found.insert(lines);
  } while (std::next_permutation(faces.begin(), faces.end()));
  EXPECT_EQ(found.size(), 1u);
}

TEST_F(See, shows_lines_in_a_field_as_without_it) {
  const std::vector<std::string> whole{crossing, "--eye", "-3,-4,3", "--lines"};
  std::vector<std::string> in_field = whole;
  in_field.insert(in_field.end(), {"--look", "3,4,-3", "--field", "120", "--frustum"});
  EXPECT_EQ(see(whole)["result"]["lines"], see(in_field)["result"]["lines"]);
}

TEST_F(See, sees_no_floor_of_which_a_keel_leaves_a_line) {
  // Two wings stand on the floor in the line y = 0, and have all the rest of it behind them.
  const std::string keel = file("keel.off",
                                "OFF\n10 3 0\n-3 -2 0\n3 -2 0\n3 2 0\n-3 2 0\n-4 0 0\n4 0 0\n4 5 2\n-4 5 2\n"
                                "-4 -5 2\n4 -5 2\n4 0 1 2 3\n4 4 5 6 7\n4 5 4 8 9\n"),
                    certificate = path("keel.json").string();
  EXPECT_EQ(see({keel, "--eye", "0,0,7", "--certificate", certificate})["result"]["visible"], Json({1, 2}));
  EXPECT_EQ(run({"verify", keel, certificate}).code, done);
  EXPECT_EQ(see({keel, "--eye", "0,10,7"})["result"]["visible"], Json({1, 2}));
}

TEST_F(See, draws_what_it_sees) {
  const std::string svg = path("a.svg").string();
  ASSERT_EQ(run({"see", cube, "--eye", "3,-4,5", "--lines", "--svg", svg}).code, done);
  const std::string text = read_file(svg);
  EXPECT_NE(text.find("<polygon"), std::string::npos);
  EXPECT_NE(text.find("stroke-dasharray"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

TEST_F(See, is_the_same_with_any_number_of_threads_and_in_every_exact_kernel) {
  const std::string city = path("city.qoff").string();
  ASSERT_EQ(run({"generate", "city_rotated", "--size", "40", "--seed", "3", "--out", city}).code, done);
  const Json one = see({city, "--eye", "0,0,1", "--threads", "1", "--lines"}),
             many = see({city, "--eye", "0,0,1", "--threads", "5", "--lines"});
  EXPECT_EQ(one["result"], many["result"]);
  EXPECT_EQ(one["counters"], many["counters"]);
  for (const char* kernel : {"epeck", "gmpq"})
    EXPECT_EQ(see({city, "--eye", "0,0,1", "--kernel", kernel})["result"]["visible"], one["result"]["visible"])
        << kernel;
  for (const char* kernel : {"double", "float"})
    EXPECT_GT(see({city, "--eye", "0,0,1", "--kernel", kernel})["result"]["visible"].size(), 0u) << kernel;
}

TEST_F(See, counts_the_same_with_any_number_of_threads_where_faces_lie_in_one_plane) {
  for (const char* family : {"coplanar_overlap", "duplicates"}) {
    const std::string scene = path(std::string(family) + ".qoff").string();
    ASSERT_EQ(run({"generate", family, "--size", "60", "--seed", "2", "--out", scene}).code, done);
    const Json one = see({scene, "--eye", "1,2,30", "--threads", "1"});
    for (const char* threads : {"2", "5"}) {
      const Json many = see({scene, "--eye", "1,2,30", "--threads", threads});
      EXPECT_EQ(many["result"], one["result"]) << family;
      EXPECT_EQ(many["counters"], one["counters"]) << family;
    }
  }
}

TEST_F(See, shows_the_same_by_each_exact_method_in_parts_of_its_own) {
  const std::string rooms = (corpus / "general" / "two_rooms.off").string();
  const auto is_the_same = [](Json a, Json b) {
    for (Json* lines : {&a, &b}) {
      for (Json& line : (*lines)["lines"])
        for (Json& part : line["parts"]) part.erase("hidden_by");  // one of those that hide it
      lines->erase("pieces");
    }
    return a == b;
  };
  for (const std::string& scene : {crossing, rooms})
    for (const std::vector<std::string>& field : {std::vector<std::string>{}, {"--frustum", "--field", "40"}}) {
      std::vector<std::string> words{scene, "--eye", "5,-7/2,3", "--lines", "--two-sided"};
      words.insert(words.end(), field.begin(), field.end());
      const Json by_regions = see(words);
      EXPECT_GT(by_regions["result"]["pieces"].size(), 0u);
      for (const char* method : {"weiler-atherton", "bsp2d"}) {
        std::vector<std::string> own = words;
        own.insert(own.end(), {"--method", method});
        const Json found = see(own);
        EXPECT_EQ(found["counters"]["method"], method);
        EXPECT_TRUE(is_the_same(found["result"], by_regions["result"])) << method << ' ' << scene;
        expect(done, scene, certificate(scene, {own.begin() + 1, own.end()}));
      }
    }
  EXPECT_EQ(run({"see", cube, "--method", "bsp2d", "--kernel", "double"}).code, usage);
  EXPECT_EQ(run({"see", cube, "--method", "painter"}).code, usage);
}

TEST_F(See, refuses_what_is_no_eye_and_what_is_not_exact) {
  for (const char* eye : {"1,2", "1,2,3,4", "a,b,c", "1,,3", "nan,0,0", "1/0,0,0", ""}) {
    const Outcome r = run({"see", cube, "--eye", eye});
    EXPECT_EQ(r.code, usage) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
  }
  for (const char* option : {"--lines", "--frustum"})
    EXPECT_EQ(run({"see", cube, "--kernel", "double", option}).code, usage) << option;
  EXPECT_EQ(run({"see", cube, "--kernel", "epick"}).code, usage);
  EXPECT_EQ(run({"see", path("none.off").string()}).code, bad_input);
  EXPECT_EQ(run({"see", cube, "--budget", "1e-9"}).code, undecided);
  const Json empty = see({file("empty.off", "OFF\n0 0 0\n"), "--eye", "0,0,0", "--lines"});
  EXPECT_EQ(empty["result"]["pieces"].size(), 0u);
}

TEST_F(See, sees_real_scenes_as_verify_accepts_them) {
  if (std::string_view(SIGHTLINE_SCENES_DIR).empty()) GTEST_SKIP() << "no folder of real scenes";
  const fs::path scenes = SIGHTLINE_SCENES_DIR;
  for (const char* name : {"a_interior/cornell_box.obj", "c_convex/cg_geosphere.off", "d_hard/cg_cross.off",
                           "d_hard/gc_three_cubes.stl", "d_hard/mf_Havocglass8_left.obj"}) {
    if (!fs::exists(scenes / name)) continue;
    for (const char* eye : {"", "0,0,0", "1/7,1/9,1/11"}) {
      const Json made = certificate((scenes / name).string(),
                                    *eye == 0 ? std::vector<std::string>{} : std::vector<std::string>{"--eye", eye});
      expect(done, (scenes / name).string(), made);
    }
  }
}

}  // namespace program
