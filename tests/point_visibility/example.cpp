// The example of algorithms/point_visibility/README.md, run.

#include <sightline/algorithms/point_visibility/hidden_lines.h>
#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/visible.h>

#include <iostream>

void look(const sightline::Polygon_soup& soup, const sightline::Exact_point& eye, std::ostream& out) {
  const sightline::Scene scene(soup);
  const sightline::Piece_boxes boxes(scene);  // serves any number of eyes
  const sightline::Exact_view view(scene, eye);
  const auto surface = sightline::visible_surface(view, boxes);
  for (const auto& part : surface.parts) {
    if (part.piece == surface.nothing) continue;  // a cone of directions in which nothing is seen
    out << "face " << scene.pieces()[part.piece].face << ':';
    for (const sightline::Exact_point& p : vertices(view, surface, part))
      out << " (" << p[0] << ' ' << p[1] << ' ' << p[2] << ')';
    out << '\n';
  }
  for (const sightline::Drawn_edge& drawn : hidden_lines(view, surface))
    for (const sightline::Line_part& part : drawn.parts)
      if (part.hidden_by != part.nothing)
        out << "from " << part.from << " to " << part.to << " behind face " << scene.pieces()[part.hidden_by].face
            << '\n';
}

#include <gtest/gtest.h>

#include <sstream>

TEST(Example, of_the_page_shows_two_squares) {
  sightline::Polygon_soup soup;
  for (const double z : {0.0, 1.0}) {  // the nearer one hides the middle of the farther one
    const double r = z == 0 ? 4 : 1;
    std::vector<sightline::Point_id> square;
    for (const auto& [x, y] : {std::pair(-r, -r), std::pair(r, -r), std::pair(r, r), std::pair(-r, r)})
      square.push_back(soup.add_point(x, y, z));
    soup.add_face(square);
  }
  std::ostringstream out;
  look(soup, {0, 0, 2}, out);
  EXPECT_NE(out.str().find("face 1: "), std::string::npos) << out.str();
  EXPECT_NE(out.str().find("face 0: "), std::string::npos);
  EXPECT_NE(out.str().find("(2 2 0)"), std::string::npos);      // a corner of the shadow
  EXPECT_EQ(out.str().find("behind face"), std::string::npos);  // no edge is hidden
  std::ostringstream other;
  look(soup, {0, 0, -1}, other);
  EXPECT_NE(other.str().find("from 0 to 1 behind face 0"), std::string::npos) << other.str();
}
