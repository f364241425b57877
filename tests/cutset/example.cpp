// The examples of algorithms/cutset/README.md.

#include "support.h"

#include <sightline/algorithms/cutset/decision_tree.h>
#include <sightline/algorithms/cutset/tracker.h>

#include <iostream>

namespace {

void example(const sightline::Polygon_soup& soup, const std::vector<sightline::Viewpoint>& path, std::ostream& out) {
  const sightline::Scene scene(soup);
  const sightline::Exact_traits traits(scene);
  const sightline::Face_graph graph(scene);
  sightline::Cut_set_tracker tracker(traits, graph);
  for (const sightline::Viewpoint& viewpoint : path) {
    tracker.move_to(viewpoint);
    out << tracker.on_view_count() << " on-view, " << tracker.cut_edges().size() << " edges, " << tracker.last().tests
        << " tests; changed:";
    for (const std::uint32_t node : tracker.changed())
      out << " face " << scene.pieces()[graph.piece(node)].face << (tracker.on_view(node) ? " is on-view" : " is not");
    out << '\n';
  }
}

void decide(const sightline::Polygon_soup& soup, std::ostream& out) {
  const sightline::Scene scene(soup);
  std::vector<std::array<sightline::Rational, 4>> planes;
  for (const sightline::Piece& piece : scene.pieces()) planes.push_back(scene.file_coefficients(piece.support));
  const auto tree = sightline::least_tests(sightline::uniform_likelihood(sightline::view_cells(planes)),
                                           static_cast<unsigned>(planes.size()));
  out << "expected " << tree.expected << " tests; first face " << tree.steps[0].face << '\n';
}

TEST(Example, of_the_documentation_page_prints_what_it_says) {
  const sightline::Polygon_soup cube = cutset_test::box({-1, -1, -1}, {1, 1, 1}).soup();
  std::ostringstream out;
  example(cube, {{{3, 0, 0}}, {{3, 2, 0}}, {{1, 0, 0}, true}}, out);
  EXPECT_EQ(out.str(),
            "1 on-view, 4 edges, 6 tests; changed: face 1 is on-view\n"
            "2 on-view, 6 edges, 5 tests; changed: face 3 is on-view\n"
            "1 on-view, 4 edges, 6 tests; changed: face 3 is not\n");
  out.str("");
  decide(cube, out);
  EXPECT_EQ(out.str(), "expected 64/13 tests; first face 0\n");
}

}  // namespace
