// sightline cutset: paths, orbits, motions, decision trees, and what is said of wrong arguments.

#include "program.h"

namespace program {

class Cutset : public Program {
 protected:
  const std::string cube = (corpus / "general" / "cube.off").string();  // [0, 1]^3

  Json cutset(std::vector<std::string> arguments, int code = done) {
    arguments.insert(arguments.begin(), "cutset");
    arguments.insert(arguments.end(), {"--json", "-"});
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, code) << r;
    return r.json();
  }
  void refused(const std::vector<std::string>& arguments, int code, const std::string& mentions) {
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, code) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
    EXPECT_NE(r.err.find(mentions), std::string::npos) << "no '" << mentions << "' in: " << r;
    EXPECT_EQ(r.out, "") << r;
  }
};

TEST_F(Cutset, lists_the_on_view_faces_of_each_viewpoint_of_a_path) {
  const std::string eyes =
      file("eyes.csv", "x,y,z\n5,1/2,1/2\n-5, 0.5, 0.5   # the other side\r\n0.5,0.5,0.5\n1,0,0,0\n");
  const Json d = cutset({cube, "--path", eyes, "--faces", "--check"});
  const Json& frames = d["result"]["frames"];
  ASSERT_EQ(frames.size(), 4u) << d;
  EXPECT_EQ(frames[0]["on_view"].size(), 1u) << d;
  EXPECT_EQ(frames[1]["on_view"].size(), 1u);
  EXPECT_NE(frames[0]["on_view"], frames[1]["on_view"]);
  EXPECT_EQ(frames[2]["on_view"].size(), 0u);
  EXPECT_EQ(frames[3]["on_view"], frames[0]["on_view"]);
  EXPECT_EQ(frames[3]["direction"], Json({"1", "0", "0"}));
  EXPECT_EQ(frames[0]["eye"], Json({"5", "1/2", "1/2"}));
  EXPECT_EQ(frames[0]["cut_edges"], 4);
  EXPECT_EQ(frames[1]["births"], 1);
  EXPECT_EQ(d["result"]["wrong_frames"], 0);
  EXPECT_EQ(d["counters"]["convex"], 1);
  EXPECT_EQ(cutset({cube, "--path", eyes})["result"]["frames"][0]["on_view"], 1);
}

TEST_F(Cutset, the_published_update_loses_the_far_side_of_a_cube_and_the_check_says_so) {
  const std::string eyes = file("eyes.csv", "5,0.5,0.5\n-5,0.5,0.5\n");
  const Json d = cutset({cube, "--path", eyes, "--method", "1977", "--check"}, disagreement);
  EXPECT_EQ(d["result"]["wrong_frames"], 1);
  EXPECT_EQ(d["result"]["frames"][1]["cut_edges"], 0);
  const Json literal = cutset(
      {cube, "--path", file("step.csv", "5,0.5,0.5\n5,2,0.5\n"), "--method", "1977-literal", "--check"}, disagreement);
  EXPECT_EQ(literal["result"]["frames"][1]["cut_edges"], 4);
}

TEST_F(Cutset, goes_round_a_scene_and_holds_every_frame_to_brute_force) {
  for (const char* scene : {"general/cornell.obj", "general/u_and_quad.off", "robust/non_planar.off", "robust/huge.off",
                            "robust/subnormal.off", "robust/far_leaves.off"}) {
    const Json d = cutset({(corpus / scene).string(), "--orbit", "60", "--check"});
    EXPECT_EQ(d["result"]["frames"].size(), 60u) << scene;
    EXPECT_EQ(d["result"]["wrong_frames"], 0) << scene;
  }
  EXPECT_EQ(cutset({cube, "--orbit", "1"})["result"]["frames"].size(), 1u);
  EXPECT_EQ(cutset({cube, "--orbit", "30", "--radius", "0", "--height", "0", "--check"})["counters"]["births"], 0)
      << "inside";
}

TEST_F(Cutset, moves_the_object_instead_of_the_eye) {
  // Half a turn about z through the origin takes the cube to [-1, 0] x [-1, 0] x [0, 1].
  const std::string motions =
      file("motions.csv", "# w,x,y,z and a translation\n1,0,0,0,0,0,0\n0,0,0,2,0,0,0\n0,0,0,2,1,1,0\n");
  const Json d = cutset({cube, "--motion", motions, "--eye", "5,0.5,0.5", "--faces", "--check"});
  const Json still = cutset({cube, "--path", file("eyes.csv", "5,0.5,0.5\n-5,-0.5,0.5\n-4,0.5,0.5\n"), "--faces"});
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_EQ(d["result"]["frames"][k]["on_view"], still["result"]["frames"][k]["on_view"]) << k;
  EXPECT_EQ(d["result"]["frames"][1]["eye"], Json({"-5", "-1/2", "1/2"}));
}

TEST_F(Cutset, draws_its_frames) {
  const std::string svg = path("frames.svg").string();
  const Outcome r = run({"cutset", cube, "--orbit", "30", "--svg", svg});
  EXPECT_EQ(r.code, done) << r;
  const std::string text = read_file(svg);
  EXPECT_NE(text.find("<polygon"), std::string::npos);
  EXPECT_NE(text.find("<line"), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n') > 30, true);
  std::size_t titles = 0;
  for (std::size_t at = text.find("<text"); at != std::string::npos; at = text.find("<text", at + 1)) ++titles;
  EXPECT_EQ(titles, 2 * 10u + 1) << "two lines for every third of 30 frames, and what the colours mean";
}

/// The colours of faces in a picture's frames.
std::set<std::string> fills_of(const std::string& svg) {
  std::set<std::string> fills;
  const std::string key = "fill=\"#";
  for (std::size_t at = svg.find("<polygon"); at != std::string::npos; at = svg.find("<polygon", at + 1))
    fills.insert(svg.substr(svg.find(key, at) + key.size(), 6));
  return fills;
}

TEST_F(Cutset, shades_its_frames_unless_told_not_to) {
  const std::string lit = path("lit.svg").string(), flat = path("flat.svg").string();
  EXPECT_EQ(run({"cutset", cube, "--orbit", "30", "--svg", lit}).code, done);
  EXPECT_EQ(run({"cutset", cube, "--orbit", "30", "--svg", flat, "--shade", "none"}).code, done);
  EXPECT_EQ(fills_of(read_file(flat)), (std::set<std::string>{"a9d6a0", "e3e8ee"}));
  EXPECT_GT(fills_of(read_file(lit)).size(), 4u);  // two colours by the sides of a cube
  refused({"cutset", cube, "--orbit", "3", "--shade", "phong"}, usage, "--shade");
}

TEST_F(Cutset, finds_the_order_of_tests_with_the_fewest_expected) {
  const Json d = cutset({cube, "--decision-tree"});
  const Json& tree = d["result"]["decision_tree"];
  EXPECT_EQ(tree["expected"], "64/13");
  EXPECT_EQ(tree["bound"], "62/13") << "the paper's 4.769";
  EXPECT_EQ(tree["views"].size(), 26u);
  EXPECT_EQ(tree["steps"].size(), 25u);
  EXPECT_EQ(cutset({cube, "--decision-tree", "--inside"})["result"]["decision_tree"]["views"].size(), 27u);
  const Json likely =
      cutset({cube, "--decision-tree", "--likelihood", file("likely.csv", "weight,faces\n97,1,2\n1,1\n1/2,2,5\n")});
  EXPECT_EQ(likely["result"]["decision_tree"]["views"].size(), 3u);
  EXPECT_EQ(likely["result"]["decision_tree"]["expected"],
            "392/197");  // face 2 first: one test for {1}, two for the others
}

TEST_F(Cutset, a_likelihood_may_name_any_face_of_those_that_hang_together_in_one_plane) {
  const std::string halves =
      file("halves.off",
           "OFF\n8 12 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n3 0 3 2\n3 0 2 1\n3 4 5 6\n3 4 6 7\n"
           "3 0 1 5\n3 0 5 4\n3 3 7 6\n3 3 6 2\n3 0 4 7\n3 0 7 3\n3 1 2 6\n3 1 6 5\n");
  const auto views = [&](const std::string& lines) {
    return cutset(
        {halves, "--decision-tree", "--likelihood", file("likely.csv", lines)})["result"]["decision_tree"]["views"];
  };
  const Json by_first = views("1,0\n1,2,8\n");
  EXPECT_EQ(by_first.size(), 2u);
  EXPECT_EQ(views("1,1\n1,9,3\n"), by_first);
  EXPECT_EQ(views("1,0,1\n1,2,3,8,9\n"), by_first);
  refused({"cutset", halves, "--decision-tree", "--likelihood", file("more.csv", "1,12\n")}, bad_input, "more.csv:1:1");
}

TEST_F(Cutset, a_decision_tree_keeps_to_its_budget) {
  const std::string many = path("many.qoff").string();
  ASSERT_EQ(run({"generate", "triangles", "--size", "20", "--seed", "3", "--out", many}).code, done);
  refused({"cutset", many, "--decision-tree", "--budget", "1e-6"}, undecided, "budget");
}

TEST_F(Cutset, what_is_of_a_path_or_of_a_picture_is_refused_without_one) {
  const std::string svg = path("none.svg").string();
  for (const std::vector<std::string>& given : std::vector<std::vector<std::string>>{
           {"--svg", svg}, {"--html", svg + ".html"}, {"--faces"}, {"--check"}, {"--method", "1977"}}) {
    std::vector<std::string> words{"cutset", cube, "--decision-tree"};
    words.insert(words.end(), given.begin(), given.end());
    refused(words, usage, given[0] + " is of a path");
  }
  for (const std::vector<std::string>& given :
       std::vector<std::vector<std::string>>{{"--size", "300x300"}, {"--background", "red"}, {"--shade", "none"}})
    refused({"cutset", cube, "--orbit", "3", given[0], given[1]}, usage, given[0] + " is of a picture");
  const std::string eyes = file("eyes.csv", "5,0.5,0.5\n");
  for (const char* option : {"--radius", "--height"})
    refused({"cutset", cube, "--path", eyes, option, "4"}, usage, std::string(option) + " is of an orbit");
}

TEST_F(Cutset, wrong_arguments_are_usage_errors) {
  refused({"cutset", cube}, usage, "--orbit");
  refused({"cutset", cube, "--orbit", "3", "--decision-tree"}, usage, "--decision-tree");
  refused({"cutset", cube, "--orbit", "3", "--path", "p.csv"}, usage, "one of");
  refused({"cutset", cube, "--orbit", "3", "--eye", "0,0,0"}, usage, "--motion");
  refused({"cutset", cube, "--orbit", "3", "--inside"}, usage, "--decision-tree");
  refused({"cutset", cube, "--orbit", "0"}, usage, "--orbit");
  refused({"cutset", cube, "--orbit", "-1"}, usage, "--orbit");
  refused({"cutset", cube, "--orbit", "3", "--method", "1978"}, usage, "--method");
}

TEST_F(Cutset, bad_files_name_line_and_column) {
  refused({"cutset", cube, "--path", path("none.csv").string()}, bad_input, "no such file");
  refused({"cutset", cube, "--path", file("empty.csv", "# nothing\n")}, bad_input, "X,Y,Z");
  refused({"cutset", cube, "--path", file("two.csv", "0,0,1\n  1,2\n")}, bad_input, "two.csv:2:3");
  refused({"cutset", cube, "--path", file("nan.csv", "0,0,nan\n")}, bad_input, "nan.csv:1:5");
  refused({"cutset", cube, "--path", file("zero.csv", "0,0,0,0\n")}, bad_input, "not zero");
  refused({"cutset", cube, "--path", file("w.csv", "0,0,1,2\n")}, bad_input, "w.csv:1:1");
  refused({"cutset", cube, "--motion", file("q.csv", "0,0,0,0,1,1,1\n")}, bad_input, "quaternion");
  refused({"cutset", cube, "--decision-tree", "--likelihood", file("l.csv", "1,9\n")}, bad_input, "l.csv:1:1");
  refused({"cutset", cube, "--decision-tree", "--likelihood", file("m.csv", "1,2\n1,0,1\n")}, bad_input,
          "m.csv:2:1");  // opposite faces
  refused({"cutset", file("none.off", "OFF\n0 0 0\n"), "--decision-tree"}, bad_input, "none.off: no face is left");
  run({"generate", "city", "--size", "8", "--out", path("city.qoff").string()});
  refused({"cutset", path("city.qoff").string(), "--decision-tree"}, bad_input, "city.qoff: views of 41 faces; take");
}

TEST_F(Cutset, a_long_orbit_takes_no_memory_for_its_frames) {
  const std::size_t frames = sanitized ? 4000 : 150'000;
  const Outcome r = run({"cutset", cube, "--orbit", std::to_string(frames)}, {120, 512});
  EXPECT_EQ(r.code, done) << r;
  EXPECT_NE(r.out.find("for " + std::to_string(frames) + " frames"), std::string::npos) << r;
  EXPECT_NE(r.out.find("... " + std::to_string(frames - 20) + " more"), std::string::npos) << r;
}

TEST_F(Cutset, too_many_planes_for_a_decision_tree_are_said) {
  const std::string sphere = path("sphere.off").string();
  run({"generate", "convex_sphere", "--size", "48", "--out", sphere});
  const Outcome r = run({"cutset", sphere, "--decision-tree"});
  EXPECT_EQ(r.code, bad_input) << r;
  EXPECT_NE(r.err.find("24"), std::string::npos) << r;
}

}  // namespace program
