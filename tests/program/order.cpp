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

TEST_F(Order, skipping_what_is_hidden_wants_what_hides_first) {
  const std::string cube = (corpus / "general" / "cube.off").string();
  const std::vector<std::vector<std::string>> wrong{{},
                                                    {"--front-to-back", "--method", "graph"},
                                                    {"--front-to-back", "--kernel", "double"},
                                                    {"--front-to-back", "--svg", path("a.svg").string()},
                                                    {"--front-to-back", "--certificate", path("a.json").string()}};
  for (std::vector<std::string> arguments : wrong) {
    arguments.insert(arguments.begin(), {"order", cube, "--eye", "3,4,5", "--skip-hidden"});
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, usage) << r;
    EXPECT_NE(r.err.find("--skip-hidden"), std::string::npos) << r;
  }
}

}  // namespace program
