// sightline weak: answers, certificates, pictures, sources that are none.

#include "program.h"

#include <algorithm>

namespace program {

class Weak : public Program {
 protected:
  const std::string cube = (corpus / "general" / "cube.off").string();  // [0, 1]^3
  const std::string cornell = (corpus / "general" / "cornell.obj").string();

  Json weak(std::vector<std::string> arguments, int code = done) {
    arguments.insert(arguments.begin(), "weak");
    arguments.insert(arguments.end(), {"--json", "-"});
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, code) << r;
    return r.json();
  }
};

TEST_F(Weak, sees_the_sides_of_a_cube_that_face_the_source_and_proves_the_others_hidden) {
  const std::string to = path("weak.json").string();
  const Json above = weak({cube, "--from", "0,0,3 0,1,3 1,1,3 1,0,3", "--certificate", to});
  EXPECT_EQ(above["result"]["visible"].size(), 1u);
  EXPECT_EQ(above["result"]["hidden"].size(), 5u);
  EXPECT_EQ(above["result"]["undecided"].size(), 0u);
  EXPECT_EQ(above["result"]["certificate"], to);
  const Outcome checked = run({"verify", cube, to, "--json", "-"});
  EXPECT_EQ(checked.code, done) << checked;
  EXPECT_EQ(checked.json()["result"]["accepted"], true);
  // Larger than the cube: it sees four sides as well. Turned over: nothing.
  EXPECT_EQ(weak({cube, "--from", "-1,-1,3 -1,2,3 2,2,3 2,-1,3"})["result"]["visible"].size(), 5u);
  EXPECT_EQ(weak({cube, "--from", "0,0,3 1,0,3 1,1,3 0,1,3"})["result"]["visible"].size(), 0u);
  // Two polygons see what either sees.
  EXPECT_EQ(weak({cube, "--from", "0,0,3 0,1,3 1,1,3 1,0,3", "--from", "0,0,-3 1,0,-3 1,1,-3 0,1,-3"})["result"]["visible"].size(), 2u);
  // From a face: none of a convex body's own faces is in front of it; inside, from behind, all others are.
  EXPECT_EQ(weak({cube, "--from-face", "0"})["result"]["visible"].size(), 0u);
}

TEST_F(Weak, lights_two_rooms_through_the_door_between_them) {
  const std::string rooms = (corpus / "general" / "two_rooms.off").string(), to = path("rooms.json").string();
  const Json lit = weak({rooms, "--from", "1,1,29/10 1,2,29/10 2,2,29/10 2,1,29/10", "--certificate", to});
  EXPECT_EQ(lit["result"]["visible"].size(), 89u);
  EXPECT_EQ(lit["result"]["hidden"].size(), 53u);
  EXPECT_EQ(run({"verify", rooms, to}).code, done);
}

TEST_F(Weak, by_rays_sees_no_more_than_there_is_and_proves_nothing) {
  const std::string rooms = (corpus / "general" / "two_rooms.off").string(), lamp = "1,1,29/10 1,2,29/10 2,2,29/10 2,1,29/10";
  const Json all = weak({rooms, "--from", lamp})["result"]["visible"], few = weak({rooms, "--from", lamp, "--method", "sample", "--rays", "300"})["result"]["visible"];
  EXPECT_LT(few.size(), all.size());
  EXPECT_GT(few.size(), 20u);
  for (const Json& face : few) EXPECT_NE(std::find(all.begin(), all.end(), face), all.end()) << face;
  const Outcome r = run({"weak", rooms, "--from", lamp, "--method", "sample", "--certificate", path("no.json").string()});
  EXPECT_EQ(r.code, usage) << r;
}

TEST_F(Weak, by_events_says_the_same) {
  for (const char* const from : {"0,0,3 0,1,3 1,1,3 1,0,3", "-1,-1,3 -1,2,3 2,2,3 2,-1,3", "0,0,3 1,0,3 1,1,3 0,1,3"}) {
    const Json lines = weak({cube, "--from", from})["result"], events = weak({cube, "--from", from, "--method", "events"})["result"];
    EXPECT_EQ(lines["visible"], events["visible"]) << from;
    EXPECT_EQ(lines["hidden"], events["hidden"]) << from;
  }
}

TEST_F(Weak, rejects_a_certificate_whose_answer_was_changed) {
  const std::string to = path("weak.json").string();
  weak({cornell, "--from-face", "5", "--certificate", to});
  Json certificate = Json::parse(read_file(to));
  ASSERT_GT(certificate["visible"].size(), 0u);
  ASSERT_GT(certificate["hidden"].size(), 0u);
  EXPECT_EQ(run({"verify", cornell, to}).code, done);
  Json other = certificate;
  other["visible"].erase(0);
  EXPECT_EQ(run({"verify", cornell, file("less.json", other.dump())}).code, disagreement);
  other = certificate;
  other["hidden"][0]["proof"] = Json::array({Json::array({"away"})});
  other["hidden"][0]["fragment"] = other["visible"][0]["fragment"];
  EXPECT_EQ(run({"verify", cornell, file("other.json", other.dump())}).code, disagreement);
}

TEST_F(Weak, draws_and_marks_what_it_found) {
  const std::string svg = path("weak.svg").string(), obj = path("weak.obj").string();
  weak({cornell, "--from-face", "5", "--eye", "5,-15,5", "--svg", svg, "--obj", obj});
  EXPECT_NE(read_file(svg).find("<polygon"), std::string::npos);
  const std::string marked = read_file(obj);
  EXPECT_NE(marked.find("\ng visible\n"), std::string::npos);
  EXPECT_NE(marked.find("\nf 1 2 3"), std::string::npos);
}

TEST_F(Weak, refuses_sources_that_are_none) {
  const auto refused = [&](std::vector<std::string> arguments, const std::string& why) {
    arguments.insert(arguments.begin(), {"weak", cube});
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, usage) << r;
    EXPECT_NE(r.err.find(why), std::string::npos) << r;
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r;
  };
  refused({}, "--from-face ID");
  refused({"--from-face", "77"}, "no such face");
  refused({"--from", "0,0,3 1,0,3"}, "fewer than three");
  refused({"--from", "0,0,3 1,0,3 2,0,3"}, "no area");
  refused({"--from", "0,0,3 1,0,3 1,1,4 0,1,3"}, "not planar");
  refused({"--from", "0,0,3 4,0,3 1,1,3 0,4,3"}, "not convex");
  refused({"--from", "0,0,3 1,0 1,1,3"}, "--from");
}

TEST_F(Weak, says_undecided_with_exit_code_4_where_it_may_not_search) {
  const std::string scene = file("two.off", "OFF\n12 3 0\n-2 -2 4\n-2 2 4\n2 2 4\n2 -2 4\n-4 -2 2\n0 -2 2\n0 2 2\n-4 2 2\n0 -2 2\n4 -2 2\n4 2 2\n0 2 2\n4 0 1 2 3\n4 4 5 6 7\n4 8 9 10 11\n");
  const std::vector<std::string> source{"--from", "-1,-1,0 1,-1,0 1,1,0 -1,1,0"};
  std::vector<std::string> arguments{scene};
  arguments.insert(arguments.end(), source.begin(), source.end());
  EXPECT_EQ(weak(arguments)["result"]["hidden"], Json({0, 1, 2}));  // the two are seen from behind
  arguments.insert(arguments.end(), {"--cells", "1"});
  EXPECT_EQ(weak(arguments, undecided)["result"]["undecided"], Json({0}));
}

}  // namespace program
