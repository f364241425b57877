// The examples of algorithms/priority/README.md.

#include "support.h"

#include <sightline/algorithms/priority/eye_order.h>
#include <sightline/algorithms/priority/implicit_graph.h>

#include <iostream>

namespace {

void example(const sightline::Polygon_soup& soup, std::ostream& out) {
  const sightline::Scene scene(soup);
  const sightline::Exact_traits traits(scene);
  const sightline::Priority_relation faces(traits);
  sightline::Relation_counters counters;
  if (faces.may_obscure(0, 1, counters)) out << "some eye sees face 0 in front of face 1\n";

  sightline::Implicit_priority_graph graph(faces);
  const sightline::Priority_components found = components(graph);
  for (std::size_t c = 0; c < found.size(); ++c) {
    out << "priority " << c << ':';
    for (const std::uint32_t i : found[c]) out << " face " << traits.face(i);
    out << '\n';
  }
}

void draw(const sightline::Polygon_soup& soup, const sightline::Exact_point& eye, std::ostream& out) {
  const sightline::Scene scene(soup);
  const sightline::Exact_traits traits(scene);
  const auto tree = sightline::build_priority_tree(traits);  // once, for all eyes
  out << tree.counters.planes << " planes, " << tree.counters.left << " faces left in cycles\n";
  for (const auto& polygon : sightline::back_to_front(traits, tree, eye).polygons)
    out << "face " << traits.face(polygon.piece) << '\n';
}

TEST(Example, of_the_documentation_page_prints_what_it_says) {
  using namespace priority_test;
  std::ostringstream out;
  example(soup_of({rectangle(0, 1, 0, 1, 2), rectangle(0, 1, 0, 1, 1)}), out);
  EXPECT_EQ(out.str(), "some eye sees face 0 in front of face 1\npriority 0: face 0\npriority 1: face 1\n");
  out.str("");
  draw(soup_of({rectangle(0, 1, 0, 1, 2), rectangle(0, 1, 0, 1, 1)}), at(0, 0, 9), out);
  EXPECT_EQ(out.str(), "0 planes, 0 faces left in cycles\nface 1\nface 0\n");
}

}  // namespace
