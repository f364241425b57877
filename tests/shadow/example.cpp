// The example of algorithms/shadow/README.md.

#include <gtest/gtest.h>

#include <sightline/algorithms/shadow/shadow.h>

#include <iostream>
#include <sstream>

namespace {

void example(const sightline::Polygon_soup& soup, std::ostream& out) {
  const sightline::Scene scene(soup);
  const sightline::Piece_boxes boxes(scene);
  const sightline::Exact_view lamp(scene, {1, 1, 4}), sun(scene, sightline::Sun{{0, 0, 1}});
  for (const sightline::Exact_view* light : {&lamp, &sun}) {
    for (const sightline::Shadow_part& part : sightline::shadows(*light, boxes).parts) {
      if (part.is_lit()) continue;
      out << "face " << scene.pieces()[part.piece].face << ", by face " << scene.pieces()[part.by].face << ':';
      for (const sightline::Exact_point& p : part.vertices) out << " (" << p[0] << ", " << p[1] << ", " << p[2] << ')';
      out << '\n';
    }
  }
}

TEST(Shadow_example, of_the_documentation_page_prints_what_it_says) {
  sightline::Polygon_soup soup;
  const auto square = [&](double x, double z, double size) {
    const auto a = soup.add_point(x, x, z), b = soup.add_point(x + size, x, z),
               c = soup.add_point(x + size, x + size, z), d = soup.add_point(x, x + size, z);
    soup.add_face({a, b, c, d});
  };
  square(0, 0, 4);
  square(1, 2, 1);
  std::ostringstream out;
  example(soup, out);
  EXPECT_EQ(out.str(),
            "face 0, by face 1: (1, 3, 0) (1, 1, 0) (3, 1, 0) (3, 3, 0)\n"
            "face 0, by face 1: (1, 1, 0) (2, 1, 0) (2, 2, 0) (1, 2, 0)\n");
}

}  // namespace
