// The example of algorithms/rays/README.md.

#include <gtest/gtest.h>

#include <sightline/algorithms/rays/tracer.h>

#include <iostream>
#include <sstream>

namespace {

void example(const sightline::Polygon_soup& soup, std::ostream& out) {
  const sightline::Scene scene(soup);
  const sightline::Ray_tracer tracer(scene);
  sightline::Ray_counters counters;

  // Straight down through the corner that two squares share, and along the plane of both.
  for (const sightline::Exact_ray& ray : {sightline::Exact_ray{{1, 1, 5}, {0, 0, -2}}, {{-1, 1, 0}, {1, 0, 0}}})
    for (const sightline::Face_hit& hit : tracer.first(ray, sightline::Ray_start::open, counters))
      out << "face " << hit.face << " from " << sightline::to_string(hit.t) << " to " << sightline::to_string(hit.until)
          << '\n';
}

TEST(Rays_example, of_the_documentation_page_prints_what_it_says) {
  sightline::Polygon_soup soup;
  const auto square = [&](double x, double y) {
    const auto a = soup.add_point(x, y, 0.0), b = soup.add_point(x + 1, y, 0.0), c = soup.add_point(x + 1, y + 1, 0.0),
               d = soup.add_point(x, y + 1, 0.0);
    soup.add_face({a, b, c, d});
  };
  square(0, 0);
  square(1, 1);
  std::ostringstream out;
  example(soup, out);
  EXPECT_EQ(out.str(), "face 0 from 5/2 to 5/2\nface 1 from 5/2 to 5/2\nface 0 from 1 to 2\n");
}

}  // namespace
