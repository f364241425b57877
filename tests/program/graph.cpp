// sightline graph: components, arcs, scopes, certificates, and what is said of wrong arguments.

#include "program.h"

#include <functional>
#include <map>
#include <set>

namespace program {

class Graph : public Program {
 protected:
  const std::string bars = (corpus / "general" / "three_bars.off").string(),
                    cube = (corpus / "general" / "cube.off").string(),
                    cornell = (corpus / "general" / "cornell.obj").string();

  Json graph(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "graph");
    arguments.insert(arguments.end(), {"--json", "-"});
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, done) << r;
    return r.json();
  }
  std::string made(const std::string& kind, const std::string& size) {
    const std::string file = path(kind + size + ".off").string();
    const Outcome r = run({"generate", kind, "--size", size, "--out", file});
    EXPECT_EQ(r.code, done) << r;
    return file;
  }
  static std::size_t largest(const Json& document) {
    std::size_t most = 0;
    for (const Json& component : document["result"]["components"]) most = std::max(most, component.size());
    return most;
  }
  static std::set<std::set<std::string>> partition(const Json& document) {
    std::set<std::set<std::string>> sets;
    for (const Json& component : document["result"]["components"]) {
      std::set<std::string> members;
      for (const Json& face : component) members.insert(face.dump());
      sets.insert(std::move(members));
    }
    return sets;
  }
};

TEST_F(Graph, of_three_bars_in_a_cycle_is_one_component) {
  const Json d = graph({bars, "--arcs"});
  EXPECT_EQ(d["command"], "graph");
  EXPECT_EQ(d["result"]["components"].size(), 1u) << d;
  EXPECT_EQ(d["result"]["arcs"], d["result"]["arc_list"].size());
}

TEST_F(Graph, of_a_cube_has_no_arc) {
  const Json d = graph({cube});
  EXPECT_EQ(d["result"]["arcs"], 0);
  EXPECT_EQ(d["result"]["components"].size(), 6u);
}

TEST_F(Graph, has_the_same_components_both_ways_and_arcs_never_go_back) {
  for (const std::string& scene :
       {bars, cornell, made("city", "12"), made("soup", "60"), made("menger_sponge_merged", "1")}) {
    const Json implicit = graph({scene, "--arcs"}), with_arcs = graph({scene, "--method", "explicit", "--arcs"});
    EXPECT_EQ(partition(implicit), partition(with_arcs)) << scene;
    for (const Json& d : {implicit, with_arcs}) {
      std::map<std::string, std::size_t> h;
      for (std::size_t c = 0; c < d["result"]["components"].size(); ++c)
        for (const Json& face : d["result"]["components"][c]) h[face.dump()] = c;
      EXPECT_GT(d["result"]["arc_list"].size(), 0u);
      for (const Json& arc : d["result"]["arc_list"])
        EXPECT_LE(h.at(arc[0].dump()), h.at(arc[1].dump())) << scene << ' ' << arc;
    }
  }
}

TEST_F(Graph, within_a_scope_has_fewer_arcs_and_an_eye_of_disjoint_faces_no_cycle) {
  const std::string scene = made("city", "12");
  const auto arcs = [&](std::vector<std::string> scope) {
    std::vector<std::string> arguments{scene, "--arcs"};
    arguments.insert(arguments.end(), scope.begin(), scope.end());
    std::set<std::string> all;
    const Json d = graph(arguments);
    for (const Json& arc : d["result"]["arc_list"]) all.insert(arc.dump());
    return all;
  };
  const auto part_of = [](const std::set<std::string>& a, const std::set<std::string>& b) {
    return std::includes(b.begin(), b.end(), a.begin(), a.end());
  };
  const auto whole = arcs({}), box = arcs({"--box", "-3,-3,2", "-2,-2,3"}), eye = arcs({"--eye", "-2.5,-2.5,2.5"}),
             ray = arcs({"--eye", "-2.5,-2.5,2.5", "--ray", "4.1,4.2,-2.3"});
  EXPECT_TRUE(part_of(box, whole) && part_of(eye, box) && part_of(ray, eye));
  EXPECT_LT(box.size(), whole.size());
  EXPECT_GT(eye.size(), 0u);
  EXPECT_EQ(arcs({"--region", "-3,-3,2 -2,-3,2 -3,-2,2 -2,-2,2 -3,-3,3 -2,-3,3 -3,-2,3 -2,-2,3"}), box);
  EXPECT_EQ(arcs({"--box", "-2.5,-2.5,2.5", "-2.5,-2.5,2.5"}), eye);
  EXPECT_EQ(largest(graph({scene, "--eye", "-2.5,-2.5,2.5"})), 1u);
  EXPECT_TRUE(arcs({"--box", "1,0,0", "0,1,1"}).empty()) << "an empty box";
}

TEST_F(Graph, certificates_are_accepted_and_changed_ones_are_not) {
  for (const std::string& scene : {bars, cornell, made("city", "12"), (corpus / "robust" / "duplicates.off").string(),
                                   (corpus / "robust" / "non_planar.off").string()}) {
    const std::string to = path("graph.json").string();
    const Outcome r = run({"graph", scene, "--certificate", to});
    ASSERT_EQ(r.code, done) << r;
    const Outcome verified = run({"verify", scene, to});
    EXPECT_EQ(verified.code, done) << verified;
    const Json certificate = Json::parse(read_file(to));
    const auto code_after = [&](const std::function<void(Json&)>& change) {
      Json changed = certificate;
      change(changed);
      return run({"verify", scene, file("changed.json", changed.dump())}).code;
    };
    EXPECT_EQ(code_after([](Json& c) {
                c["arcs"].clear();
                c["fragments"].erase(0);
              }),
              disagreement);
    EXPECT_EQ(code_after([](Json& c) { c["sizes"].push_back(1); }), disagreement);
    EXPECT_EQ(code_after([](Json& c) { c["points"][0][0] = "12345678901/7"; }), disagreement);
    EXPECT_EQ(code_after([](Json& c) { c.erase("sizes"); }), bad_input);
    EXPECT_EQ(code_after([](Json& c) { c["arcs"].push_back({0, 1, 2}); }), bad_input);
    EXPECT_EQ(code_after([](Json& c) { c["arcs"].push_back({0, 4000000000u, 0, 0}); }), bad_input);
    if (!certificate["arcs"].empty()) {
      EXPECT_EQ(code_after([](Json& c) { c["arcs"].clear(); }), disagreement);
    }
  }
}

TEST_F(Graph, draws_itself_for_graphviz) {
  const std::string to = path("graph.dot").string();
  const Outcome r = run({"graph", bars, "--dot", to});
  ASSERT_EQ(r.code, done) << r;
  const std::string dot = read_file(to);
  EXPECT_EQ(dot.rfind("digraph priority {", 0), 0u);
  EXPECT_NE(dot.find("subgraph cluster_0"), std::string::npos);
  EXPECT_NE(dot.find("color=red"), std::string::npos);
}

TEST_F(Graph, wrong_arguments_are_usage_errors) {
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--box", "0,0,0"},
                                                {"--box", "0,0,0", "1,1"},
                                                {"--ray", "1,0,0"},
                                                {"--eye", "0,0,9", "--ray", "0,0,0"},
                                                {"--eye", "0,0,9", "--box", "0,0,0", "1,1,1"},
                                                {"--method", "guess"},
                                                {"--eye", "0,0,9", "--certificate", "x.json"},
                                                {"--method", "explicit", "--certificate", "x.json"},
                                                {"--region", ""},
                                                {"--region", " "}}) {
    std::vector<std::string> arguments{"graph", cube};
    arguments.insert(arguments.end(), wrong.begin(), wrong.end());
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, usage) << r;
    EXPECT_NE(r.err, "") << r;
  }
}

TEST_F(Graph, of_nothing_is_nothing) {
  const Json d = graph({file("empty.off", "OFF\n0 0 0\n")});
  EXPECT_EQ(d["result"]["components"].size(), 0u);
}

TEST_F(Graph, orders_whole_faces_that_verify_accepts) {
  const std::string scene = made("city", "40"), to = path("order.json").string(), svg = path("order.svg").string();
  const std::vector<std::string> order{"order",         scene, "--method", "graph", "--eye",  "20.3,-7.1,4",
                                       "--certificate", to,    "--svg",    svg,     "--json", "-"};
  std::vector<std::string> both = order;
  both.push_back("--two-sided");
  const Outcome r = run(both);
  ASSERT_EQ(r.code, done) << r;
  const Json d = r.json();
  EXPECT_EQ(d["result"]["fragments"].size(), 201u);
  EXPECT_EQ(d["counters"]["graph"]["left"], 0);
  EXPECT_EQ(run({"verify", scene, to}).code, done);
  // The on-view faces only: the certificate says so, or it would be rejected.
  const Json on_view = run(order).json();
  const std::size_t off_view = on_view["counters"]["graph"]["off_view"];
  EXPECT_GT(off_view, 50u);
  EXPECT_EQ(on_view["result"]["fragments"].size() + off_view, 201u);
  EXPECT_EQ(run({"verify", scene, to}).code, done);
  Json certificate = Json::parse(read_file(to));
  EXPECT_EQ(certificate["on_view"], true);
  certificate.erase("on_view");
  EXPECT_EQ(run({"verify", scene, file("all.json", certificate.dump())}).code, disagreement);
  EXPECT_EQ(run({"order", scene, "--two-sided"}).code, usage);
  EXPECT_NE(read_file(svg).find("<polygon"), std::string::npos);
  // From inside the town the picture is of what is in front of the near plane only.
  const Outcome inside =
      run({"order", scene, "--method", "graph", "--eye", "3.3,3.1,1/3", "--certificate", to, "--svg", svg});
  ASSERT_EQ(inside.code, done) << inside;
  EXPECT_EQ(run({"verify", scene, to}).code, done);
  EXPECT_EQ(run({"order", scene, "--method", "graph", "--kernel", "double"}).code, usage);
  EXPECT_EQ(run({"order", bars, "--method", "graph", "--eye", "0,0,50", "--certificate", to}).code, done);
  EXPECT_EQ(run({"verify", bars, to}).code, done);
}

TEST_F(Graph, tree_settles_a_city_without_a_cut_and_tells_what_settles_each_face) {
  const Json d = graph({made("city", "40"), "--tree", "--split"});
  const Json& tree = d["result"]["tree"];
  EXPECT_EQ(tree["polygons"], 201);
  EXPECT_EQ(tree["by_number"].get<int>() + tree["by_plane"].get<int>(), 201);
  EXPECT_EQ(tree["left"], 0);
  EXPECT_EQ(d["result"]["splits"], 0);
  EXPECT_EQ(d["result"]["pieces"], 201);
  EXPECT_GT(d["counters"]["bsp_fragments"].get<int>(), 201);
  const Json both = graph({made("city", "40"), "--two-sided"});
  EXPECT_EQ(both["result"]["tree"]["polygons"], 402);
}

TEST_F(Graph, codes_of_three_bars_decide_each_pair_and_splitting_cuts_them) {
  const Json d = graph({bars, "--codes"});
  EXPECT_EQ(d["result"]["tree"]["left"], 3);
  ASSERT_EQ(d["result"]["codes"].size(), 3u) << d["result"];
  for (const Json& code : d["result"]["codes"])
    EXPECT_TRUE(code[2] == "plane" ? code.size() == 4 : code[2] == "first" || code[2] == "second") << code;
  const Json split = graph({bars, "--split"});
  EXPECT_EQ(split["result"]["tree"]["left"], 0);
  EXPECT_GT(split["result"]["splits"].get<int>(), 0);
  EXPECT_EQ(split["result"]["pieces"].get<int>(), 3 + split["result"]["splits"].get<int>());
}

TEST_F(Graph, pixels_count_the_faces_left_to_choose_from) {
  // Two squares that face up, one above a half of the other, seen from above.
  const std::string scene = file(
      "two.off", "OFF\n8 2 0\n-4 -4 0\n4 -4 0\n4 4 0\n-4 4 0\n-4 -4 1\n0 -4 1\n0 4 1\n-4 4 1\n4 0 1 2 3\n4 4 5 6 7\n");
  const std::string eyes =
      file("eyes.txt", "# two eyes\n0.01,0,5,0,0,-1\n\n0,0,-5, 0,0,1  # below: nothing is on-view\n");
  const std::string folder = path("").string();
  const Json d = graph({scene, "--pixels", "16x12", "--eyes", eyes, "--pictures", folder});
  const Json& images = d["result"]["images"];
  ASSERT_EQ(images.size(), 2u);
  EXPECT_EQ(images[0]["covered"], 16 * 12);
  EXPECT_EQ(images[0]["several"], 8 * 12);
  EXPECT_EQ(images[0]["faces"], 24 * 12);
  EXPECT_EQ(images[0]["by_h"]["single"], 16 * 12);
  EXPECT_EQ(images[0]["by_h"]["by_size"], Json::parse("[[1,1,96],[2,1,96]]"));
  EXPECT_EQ(images[0]["by_tree"], images[0]["by_h"]);
  EXPECT_TRUE(images[0]["changed"].is_null());
  EXPECT_EQ(images[1]["covered"], 0);
  EXPECT_EQ(images[1]["changed"], 1.0);
  const std::string picture = read_file(path("image_0001.svg").string());
  EXPECT_NE(picture.find("one face left at 100.0%"), std::string::npos) << picture.substr(0, 500);
  // In a ring h leaves all that a ray pierces.
  const Json ring = graph({bars, "--pixels", "40x30", "--eyes", file("above.txt", "0,0,50,0,0,-1\n")});
  const Json& image = ring["result"]["images"][0];
  EXPECT_GT(image["several"].get<int>(), 0);
  EXPECT_EQ(image["by_h"]["left"], image["faces"]);
}

TEST_F(Graph, images_take_no_more_memory_the_more_they_are) {
  const int images = sanitized ? 3 : 16;
  std::string eyes;
  for (int k = 0; k < images; ++k) eyes += "0,0,50,0,0,1\n";  // all look away: nothing is drawn
  const Outcome r =
      run({"graph", bars, "--pixels", "1500x1500", "--eyes", file("away.txt", eyes), "--json", "-"}, {60, 300});
  ASSERT_EQ(r.code, done) << r;
  const Json d = r.json();
  ASSERT_EQ(d["result"]["images"].size(), static_cast<std::size_t>(images));
  EXPECT_EQ(d["result"]["images"][images - 1]["changed"], 0.0);
}

TEST_F(Graph, wrong_eyes_and_sizes_are_named_with_their_place) {
  const auto fails = [&](const std::string& size, const std::string& eyes, int code, const std::string& why) {
    const Outcome r = run({"graph", bars, "--pixels", size, "--eyes", eyes});
    EXPECT_EQ(r.code, code) << r;
    EXPECT_NE(r.err.find(why), std::string::npos) << r;
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r;
  };
  const std::string good = file("good.txt", "0,0,9\n");
  for (const char* size : {"0x4", "4", "x", "4x", "4x-4", "5000x2", "4x4x4", "99999999999x2"})
    fails(size, good, usage, "--pixels wants WIDTHxHEIGHT");
  fails("4x4", path("none.txt").string(), bad_input, "no such file");
  fails("4x4", file("empty.txt", "# nothing\n"), bad_input, "has no line; write an eye");
  fails("4x4", file("wrong.txt", "0,0,9\n0,0\n"), bad_input, "wrong.txt:2:1: ");
  fails("4x4", file("much.txt", "0,0,9,0,0,1,7\n"), bad_input, "much.txt:1:1: ");
  fails("4x4", file("apart.txt", "0,0,9 0,0,1\n"), bad_input, "apart.txt:1:7: ");
  for (const char* look : {"0,0,0", "0,1e-400,0", "0,0,1e400"})
    fails("4x4", file("zero.txt", std::string("0,0,9,") + look + "\n"), bad_input, "zero.txt:1:1: ");
  EXPECT_EQ(run({"graph", bars, "--pixels", "4x4"}).code, usage);
  EXPECT_EQ(run({"graph", bars, "--tree", "--eye", "1,2,3"}).code, usage);
  EXPECT_EQ(run({"graph", bars, "--pixels", "4x4", "--eyes", good, "--box", "0,0,0", "1,1,1"}).code, usage);
}

}  // namespace program
