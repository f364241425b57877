// sightline order: both directions, and what is not visited.

#include "program.h"

#include <algorithm>
#include <set>

namespace program {

class Order : public Program {
 protected:
  Json ask(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--json", "-"});
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, done) << r;
    return r.json();
  }
  /// The faces that a picture is painted by, in this order.
  static std::vector<int> painted_faces(const std::string& svg) {
    std::vector<int> faces;
    const std::string mark = "<polygon id=\"face-", text = read_file(svg);
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + 1))
      faces.push_back(std::stoi(text.substr(at + mark.size())));
    return faces;
  }
};

TEST_F(Order, front_to_back_is_back_to_front_the_other_way_round) {
  const std::string scene = (corpus / "general" / "two_rooms.off").string();
  for (const char* method : {"bsp", "graph"}) {
    const Json back = ask({"order", scene, "--eye", "1,1,2", "--method", method}),
               front = ask({"order", scene, "--eye", "1,1,2", "--method", method, "--front-to-back"});
    std::vector<Json> turned(back["result"]["fragments"].begin(), back["result"]["fragments"].end());
    std::reverse(turned.begin(), turned.end());
    EXPECT_EQ(Json(turned), front["result"]["fragments"]);
    EXPECT_GT(turned.size(), 10u);
  }
}

TEST_F(Order, what_is_not_hidden_is_what_see_sees) {
  for (const char* name : {"two_rooms.off", "crossing_quads.obj", "cube.off"})
    for (const char* eye : {"1,1,2", "1/2,1/2,1/3", "-3,-4,5"}) {
      const std::string scene = (corpus / "general" / name).string();
      const Json seen = ask({"see", scene, "--eye", eye}),
                 kept = ask({"order", scene, "--eye", eye, "--front-to-back", "--skip-hidden"}),
                 all = ask({"order", scene, "--eye", eye, "--front-to-back"});
      EXPECT_EQ(seen["result"]["visible"], kept["result"]["visible"]) << name << ' ' << eye;
      // The fragments that are seen are among all; their faces are those that are seen.
      const Json& among = all["result"]["fragments"];
      std::set<int> faces;
      for (const Json& fragment : kept["result"]["fragments"]) {
        EXPECT_NE(std::find(among.begin(), among.end(), fragment), among.end()) << name << ' ' << eye;
        faces.insert(fragment["face"].get<int>());
      }
      std::set<int> expected;
      for (const char* side : {"visible", "from_behind"})
        for (const Json& face : kept["result"][side]) expected.insert(face.get<int>());
      EXPECT_EQ(faces, expected);
      const Json& counters = kept["counters"]["skip_hidden"];
      EXPECT_EQ(counters["nodes"].get<std::size_t>() + counters["nodes_skipped"].get<std::size_t>(),
                kept["counters"]["nodes"].get<std::size_t>());
      EXPECT_EQ(counters["fragments"].get<std::size_t>() + counters["fragments_skipped"].get<std::size_t>(),
                among.size());
    }
}

TEST_F(Order, pictures_and_certificates_of_what_is_not_hidden_have_no_more) {
  // From outside of two rooms their insides are hidden; the third eye has faces behind it, and faces across its plane.
  for (const char* eye : {"-3,-4,6", "1,1,2", "1/2,-1/3,1"}) {
    const std::string scene = (corpus / "general" / "two_rooms.off").string(), svg = path("seen.svg").string(),
                      ply = path("seen.ply").string(), proof = path("seen.json").string();
    const Json kept = ask({"order", scene, "--eye", eye, "--front-to-back", "--skip-hidden", "--svg", svg, "--mesh",
                           ply, "--certificate", proof}),
               whole = ask({"order", scene, "--eye", eye});
    const std::size_t fragments = kept["result"]["fragments"].size();
    EXPECT_LT(fragments, whole["result"]["fragments"].size()) << eye;
    EXPECT_NE(read_file(ply).find("element face " + std::to_string(fragments) + "\n"), std::string::npos) << eye;
    // The picture is painted by them, farthest first; by all of them where none reaches behind the eye.
    std::vector<int> nearest_last;
    for (const Json& fragment : kept["result"]["fragments"]) nearest_last.push_back(fragment["face"]);
    std::reverse(nearest_last.begin(), nearest_last.end());
    const std::vector<int> painted = painted_faces(svg);
    EXPECT_GT(painted.size(), 0u) << eye;
    std::size_t at = 0;
    for (const int face : nearest_last) at += at < painted.size() && painted[at] == face;
    EXPECT_EQ(at, painted.size()) << eye;
    EXPECT_EQ(painted == nearest_last, eye == std::string("-3,-4,6")) << eye;
    const Outcome verified = run({"verify", scene, proof});
    EXPECT_EQ(verified.code, done) << verified;
  }
}

TEST_F(Order, skipping_what_is_hidden_wants_what_hides_first) {
  const std::string cube = (corpus / "general" / "cube.off").string();
  const std::vector<std::vector<std::string>> wrong{
      {}, {"--front-to-back", "--method", "graph"}, {"--front-to-back", "--kernel", "double"}};
  for (std::vector<std::string> arguments : wrong) {
    arguments.insert(arguments.begin(), {"order", cube, "--eye", "3,4,5", "--skip-hidden"});
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, usage) << r;
    EXPECT_NE(r.err.find("--skip-hidden"), std::string::npos) << r;
  }
}

}  // namespace program
