// sightline graph: components, arcs, scopes, certificates, and what is said of wrong arguments.

#include "program.h"

#include <functional>
#include <map>
#include <set>

namespace program {

class Graph : public Program {
 protected:
  const std::string bars = (corpus / "general" / "three_bars.off").string(), cube = (corpus / "general" / "cube.off").string(), cornell = (corpus / "general" / "cornell.obj").string();

  Json graph(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "graph");
    arguments.insert(arguments.end(), {"--json", "-"});
    const Outcome r = run(arguments);
    EXPECT_EQ(r.code, done) << r;
    return r.json();
  }
  std::string made(const std::string& kind, const std::string& size) {
    const std::string file = path(kind + size + ".off").string();
    const Outcome r = run({"make", kind, "--size", size, "--out", file});
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
  for (const std::string& scene : {bars, cornell, made("city", "12"), made("soup", "60"), made("menger_sponge_merged", "1")}) {
    const Json implicit = graph({scene, "--arcs"}), with_arcs = graph({scene, "--method", "explicit", "--arcs"});
    EXPECT_EQ(partition(implicit), partition(with_arcs)) << scene;
    for (const Json& d : {implicit, with_arcs}) {
      std::map<std::string, std::size_t> h;
      for (std::size_t c = 0; c < d["result"]["components"].size(); ++c)
        for (const Json& face : d["result"]["components"][c]) h[face.dump()] = c;
      EXPECT_GT(d["result"]["arc_list"].size(), 0u);
      for (const Json& arc : d["result"]["arc_list"]) EXPECT_LE(h.at(arc[0].dump()), h.at(arc[1].dump())) << scene << ' ' << arc;
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
  const auto part_of = [](const std::set<std::string>& a, const std::set<std::string>& b) { return std::includes(b.begin(), b.end(), a.begin(), a.end()); };
  const auto whole = arcs({}), box = arcs({"--box", "-3,-3,2", "-2,-2,3"}), eye = arcs({"--eye", "-2.5,-2.5,2.5"}), ray = arcs({"--eye", "-2.5,-2.5,2.5", "--ray", "4.1,4.2,-2.3"});
  EXPECT_TRUE(part_of(box, whole) && part_of(eye, box) && part_of(ray, eye));
  EXPECT_LT(box.size(), whole.size());
  EXPECT_GT(eye.size(), 0u);
  EXPECT_EQ(arcs({"--region", "-3,-3,2 -2,-3,2 -3,-2,2 -2,-2,2 -3,-3,3 -2,-3,3 -3,-2,3 -2,-2,3"}), box);
  EXPECT_EQ(arcs({"--box", "-2.5,-2.5,2.5", "-2.5,-2.5,2.5"}), eye);
  EXPECT_EQ(largest(graph({scene, "--eye", "-2.5,-2.5,2.5"})), 1u);
  EXPECT_TRUE(arcs({"--box", "1,0,0", "0,1,1"}).empty()) << "an empty box";
}

TEST_F(Graph, certificates_are_accepted_and_changed_ones_are_not) {
  for (const std::string& scene : {bars, cornell, made("city", "12"), (corpus / "robust" / "duplicates.off").string(), (corpus / "robust" / "non_planar.off").string()}) {
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
    EXPECT_EQ(code_after([](Json& c) { c["arcs"].clear(), c["fragments"].erase(0); }), disagreement);
    EXPECT_EQ(code_after([](Json& c) { c["sizes"].push_back(1); }), disagreement);
    EXPECT_EQ(code_after([](Json& c) { c["fragments"][0]["vertices"][0][0] = "12345678901/7"; }), disagreement);
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
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"--box", "0,0,0"}, {"--box", "0,0,0", "1,1"}, {"--ray", "1,0,0"}, {"--eye", "0,0,9", "--ray", "0,0,0"}, {"--eye", "0,0,9", "--box", "0,0,0", "1,1,1"},
        {"--method", "guess"}, {"--eye", "0,0,9", "--certificate", "x.json"}, {"--method", "explicit", "--certificate", "x.json"}, {"--region", ""}}) {
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
  const Outcome r = run({"order", scene, "--method", "graph", "--eye", "20.3,-7.1,4", "--certificate", to, "--svg", svg, "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  const Json d = r.json();
  EXPECT_EQ(d["result"]["fragments"].size(), 201u);
  EXPECT_EQ(d["counters"]["graph"]["cycles"], 0);
  EXPECT_EQ(run({"verify", scene, to}).code, done);
  EXPECT_NE(read_file(svg).find("<polygon"), std::string::npos);
  // From inside the town the picture is of what is in front of the near plane only.
  const Outcome inside = run({"order", scene, "--method", "graph", "--eye", "3.3,3.1,1/3", "--certificate", to, "--svg", svg});
  ASSERT_EQ(inside.code, done) << inside;
  EXPECT_EQ(run({"verify", scene, to}).code, done);
  EXPECT_EQ(run({"order", scene, "--method", "graph", "--kernel", "double"}).code, usage);
  EXPECT_EQ(run({"order", bars, "--method", "graph", "--eye", "0,0,50", "--certificate", to}).code, done);
  EXPECT_EQ(run({"verify", bars, to}).code, done);
}

}  // namespace program
