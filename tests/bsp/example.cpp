// The example of algorithms/bsp/README.md.

#include <gtest/gtest.h>

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/bsp/query.h>
#include <sightline/algorithms/bsp/traverse.h>

#include <iostream>
#include <sstream>

namespace {

void example(const sightline::Polygon_soup& soup, std::ostream& out) {
  const sightline::Scene scene(soup);
  const sightline::Exact_traits traits(scene);
  const sightline::Exact_tree tree = sightline::build_bsp(traits);
  out << tree.counters.fragments << " fragments, " << tree.counters.splits << " splits\n";

  // Farthest first, as a painter draws.
  const sightline::Exact_point eye{sightline::Rational(1, 2), sightline::Rational(1, 3), 5};
  sightline::traverse(
      traits, tree, traits.eye(eye), sightline::Direction::back_to_front, [&](const auto& fragment, sightline::Sign) {
        out << "face " << traits.face(fragment.polygon.piece) << " with " << fragment.polygon.size << " corners\n";
      });

  // What is straight below the eye?
  if (const auto hit = sightline::first_hit(traits, tree, {eye, {0, 0, -1}}))
    out << "face " << hit->face << " after " << sightline::to_string(hit->t) << '\n';
}

TEST(Example, of_the_documentation_page_prints_what_it_says) {
  sightline::Polygon_soup soup;
  const auto square = [&](double z) {
    const auto a = soup.add_point(0.0, 0.0, z), b = soup.add_point(1.0, 0.0, z), c = soup.add_point(1.0, 1.0, z),
               d = soup.add_point(0.0, 1.0, z);
    soup.add_face({a, b, c, d});
  };
  square(1);
  square(0);
  std::ostringstream out;
  example(soup, out);
  EXPECT_EQ(out.str(),
            "2 fragments, 0 splits\n"
            "face 1 with 4 corners\n"
            "face 0 with 4 corners\n"
            "face 0 after 4\n");
}

}  // namespace
