// sightline trace, shadow, and compare of rays: what they print and write, and wrong arguments.

#include "program.h"

#include <sightline/kernel/number.h>

#include <algorithm>
#include <chrono>

namespace program {

class Rays_and_lights : public Program {
 protected:
  const std::string cube = (corpus / "general" / "cube.off").string();  // [0, 1]^3

  Json result(const std::vector<std::string>& arguments) {
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {"--json", "-"});
    const Outcome r = run(all);
    EXPECT_EQ(r.code, done) << r;
    return r.json()["result"];
  }
};

TEST_F(Rays_and_lights, trace_writes_exact_hits) {
  const std::string rays = file("rays.csv",
                                "X,Y,Z,DX,DY,DZ  # down, through a corner, past it, along a face, away\n"
                                "1/3,0.25,5,0,0,-2\n\n2,2,2,-1,-1,-1\n2,2,2.5,-1,-1,0\n-1,1/2,1,1,0,0\n9,9,9,1,1,1\n");
  for (const std::string method : {"boxes", "tree"}) {
    const Json first = result({"trace", cube, "--rays", rays, "--method", method});
    const Json& hits = first["hits"];
    ASSERT_EQ(hits.size(), 5u);
    EXPECT_EQ(hits[0]["t"], "2");
    EXPECT_EQ(hits[0]["point"], Json({"1/3", "1/4", "1"}));
    EXPECT_EQ(hits[0]["side"], "front");
    EXPECT_EQ(hits[0]["faces"].size(), 1u);
    EXPECT_EQ(hits[1]["faces"].size(), 3u);
    EXPECT_EQ(hits[1]["face"], hits[1]["faces"][0]);
    EXPECT_TRUE(hits[2].is_null());
    EXPECT_EQ(hits[3]["t"], "1");
    EXPECT_EQ(hits[3]["faces"].size(), 2u);
    EXPECT_TRUE(hits[4].is_null());
    EXPECT_EQ(first["hit"], 3);
    const Json all = result({"trace", cube, "--rays", rays, "--method", method, "--all"})["hits"];
    EXPECT_EQ(all[0].size(), 2u);
    EXPECT_EQ(all[0][1]["side"], "back");
    EXPECT_EQ(all[3].size(), 3u);  // the sides at both ends, and the top along
    EXPECT_EQ(std::count_if(all[3].begin(), all[3].end(),
                            [](const Json& hit) { return hit["side"] == "along" && hit["until"] == "2"; }),
              1);
  }
  const std::string on = file("on.csv", "0.5,0.5,1,0,0,-1\n");
  EXPECT_EQ(result({"trace", cube, "--rays", on})["hits"][0]["t"], "1");
  EXPECT_EQ(result({"trace", cube, "--rays", on, "--closed"})["hits"][0]["t"], "0");
}

TEST_F(Rays_and_lights, trace_says_what_is_wrong_and_where) {
  const auto says = [&](const std::string& text, const std::string& words) {
    const Outcome r = run({"trace", cube, "--rays", file("wrong.csv", text)});
    EXPECT_EQ(r.code, bad_input) << r;
    EXPECT_NE(r.err.find(words), std::string::npos) << r;
  };
  says("1,2,3,0,0,1\n1,2,3,0,0,0\n", "wrong.csv:2:1: ");
  says("1,2,3,0,0,1\n\n1,2,3,4,5\n", "wrong.csv:3:1: ");
  says("1,2,3,0,nothing,1\n", "wrong.csv:1:");
  says("", "wrong.csv: ");
  says("1,2,3,0,0,1\n1,2,3,0,0,nan\n", "wrong.csv:2:11: ");
  says("1,2,3,0,0,1e5000\n", "exponents within +-1100); \"1e5000\" is none");
  EXPECT_EQ(run({"trace", cube}).code, usage);
  EXPECT_EQ(run({"trace", cube, "--rays", file("r.csv", "0,0,9,0,0,-1\n"), "--method", "embree", "--all"}).code, usage);
}

TEST_F(Rays_and_lights, compare_trace_holds_exact_methods_to_the_truth) {
  const Outcome r = run({"compare", cube, "trace", "--random", "40", "--json", "-"});
  EXPECT_EQ(r.code, done) << r;
  const Json rows = r.json()["result"]["rows"];
  ASSERT_GE(rows.size(), 2u);
  for (const Json& row : rows)
    if (row["kernel"] == "exact") {
      EXPECT_EQ(row["status"], "done");
      EXPECT_EQ(row["errors"], (Json{{"rays", 240}, {"missed", 0}, {"invented", 0}, {"wrong_face", 0}}));
    }
}

/// A ground on which thousands of parts are seen and thousands lie in shadow: each against each would take a minute.
TEST_F(Rays_and_lights, shadow_draws_a_town_by_where_shadows_are) {
  const std::string town = path("town.off").string(), svg = path("town.svg").string();
  const int houses = sanitized ? 200 : 1000;  // of five faces
  ASSERT_EQ(run({"generate", "city", "--size", std::to_string(houses), "--out", town}).code, done);
  const auto begin = std::chrono::steady_clock::now();
  const Outcome r = run({"shadow", town, "--sun=-1,-2,3", "--svg", svg});
  EXPECT_EQ(r.code, done) << r;
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
  EXPECT_NE(r.out.find("smaller than a pixel are drawn whole"), std::string::npos) << r;
  const std::string text = read_file(svg);
  EXPECT_NE(text.find("in the shadow of"), std::string::npos);
  // All of the ground that is lit is one shape, however many parts it has.
  const std::string ground = "<title>face " + std::to_string(5 * houses) + ", lit</title>";
  const std::size_t lit = text.find(ground);
  EXPECT_NE(lit, std::string::npos);
  EXPECT_EQ(text.find(ground, lit + 1), std::string::npos);
}

TEST_F(Rays_and_lights, shadow_names_lit_and_dark_parts) {
  const std::string scene = file("floor.obj",
                                 "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 2\nv 2 1 2\nv 2 2 2\nv 1 2 2\n"
                                 "f 1 2 3 4\nf 5 6 7 8\n");
  const Json sun = result({"shadow", scene, "--sun", "0,0,1"});
  ASSERT_EQ(sun["dark"].size(), 1u);
  EXPECT_EQ(sun["dark"][0]["face"], 0);
  EXPECT_EQ(sun["dark"][0]["by"], 1);
  EXPECT_EQ(sun["dark"][0]["vertices"], (Json{{"1", "1", "0"}, {"2", "1", "0"}, {"2", "2", "0"}, {"1", "2", "0"}}));
  EXPECT_EQ(sun["lit_faces"], Json({0, 1}));
  EXPECT_EQ(sun["dark_faces"], Json::array());
  // Two lights: one below, which lights no front.
  const Json two = result({"shadow", scene, "--light", "1,1,-5", "--light=1,1,4"});
  EXPECT_EQ(two["lights"].size(), 2u);
  EXPECT_EQ(two["lights"][0]["away"], Json({0, 1}));
  EXPECT_EQ(two["dark"][0]["light"], 1);
  EXPECT_EQ(two["lit_faces"], Json({0, 1}));
  EXPECT_EQ(result({"shadow", scene, "--light", "1,1,-5"})["dark_faces"], Json({0, 1}));
  // The space behind them, as a solid that is written and read again: 16 below the floor, 2 above it.
  const std::string dark = path("dark.qoff").string();
  const Json volume = result({"shadow", scene, "--sun", "0,0,1", "--volume", dark})["volume"];
  EXPECT_EQ(volume["volume"], "18");
  EXPECT_EQ(volume["casting"], 2);
  EXPECT_EQ(result({"boolean", "union", dark, dark})["volume"], "18");
  EXPECT_EQ(run({"shadow", scene, "--sun", "0,0,1", "--light", "1,1,4", "--volume", dark}).code, usage);
  EXPECT_EQ(run({"shadow", scene, "--sun", "0,0,1", "--volume", path("dark").string()}).code, usage);
  // In other formats.
  const std::string svg = path("s.svg").string(), obj = path("s.obj").string();
  EXPECT_EQ(run({"shadow", scene, "--sun", "1,0,2", "--svg", svg, "--obj", obj, "--eye", "-3,-2,5"}).code, done);
  EXPECT_NE(read_file(svg).find("face 0, in the shadow of face 1"), std::string::npos);
  EXPECT_NE(read_file(svg).find("face 1, lit"), std::string::npos);
  EXPECT_NE(read_file(obj).find("g shadowed"), std::string::npos);
  EXPECT_NE(read_file(obj).find("g lit"), std::string::npos);
  // Usage.
  EXPECT_EQ(run({"shadow", scene}).code, usage);
  EXPECT_EQ(run({"shadow", scene, "--sun", "0,0,0"}).code, usage);
  EXPECT_EQ(run({"shadow", scene, "--light", "1,2"}).code, usage);
  EXPECT_EQ(run({"shadow", scene, "--light", "1,2,3", "--eye", "1,2,3"}).code, usage);
}

TEST_F(Rays_and_lights, shadow_says_that_few_commands_read_an_exact_volume_of_many_denominators) {
  const std::string soup = path("soup.off").string(), dark = path("dark.qoff").string();
  ASSERT_EQ(run({"generate", "soup", "--size", "60", "--out", soup}).code, done);
  const Outcome made = run({"shadow", soup, "--light", "3,4,9", "--volume", dark});
  EXPECT_EQ(made.code, done) << made;
  EXPECT_NE(made.out.find("more than 8192 bits"), std::string::npos) << made;
  EXPECT_NE(made.out.find("--coordinates double"), std::string::npos) << made;
  EXPECT_EQ(run({"boolean", "union", dark}).code, bad_input);
  EXPECT_EQ(run({"boolean", "union", dark, "--coordinates", "double"}).code, done);
  // Rounded, or of few denominators: all commands read it.
  const Outcome rounded = run({"shadow", soup, "--light", "3,4,9", "--volume", path("dark.off").string()});
  EXPECT_EQ(rounded.out.find("8192"), std::string::npos) << rounded;
  ASSERT_EQ(run({"generate", "soup", "--size", "2", "--out", soup}).code, done);
  const Outcome small = run({"shadow", soup, "--light", "3,4,9", "--volume", dark});
  EXPECT_EQ(small.out.find("8192"), std::string::npos) << small;
}

}  // namespace program
