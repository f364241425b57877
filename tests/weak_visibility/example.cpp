// The examples of algorithms/weak_visibility/README.md, run.

#include <sightline/algorithms/weak_visibility/along/along.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/events/active_subranges.h>
#include <sightline/algorithms/weak_visibility/partition/partition.h>
#include <sightline/algorithms/weak_visibility/weak.h>

#include <iostream>

void light(const sightline::Polygon_soup& soup, const std::vector<sightline::Exact_point>& lamp, std::ostream& out) {
  const sightline::Scene scene(soup);
  const sightline::Occluders occluders(scene);  // serves any number of sources
  const auto found = sightline::weakly_visible(occluders, {weak_source(occluders, lamp)});
  for (const sightline::Face_id face : found.visible) out << "face " << face << " is lit\n";
  for (const sightline::Face_id face : found.hidden) out << "face " << face << " is dark\n";
  const auto certificate = sightline::weak_certificate(scene, {lamp}, false, found);
  out << (sightline::verify_weak(soup, certificate).accepted ? "proved\n" : "not proved\n");
}

/// What bars of a grating leave of an edge, the k-th from the square root of (2 k + 1) / n to that of (2 k + 2) / n.
void look_through(unsigned long n, std::ostream& out) {
  using namespace sightline;
  const auto root = [n](unsigned long k) { return Quadratic_root(Integer(0), 1, Integer(k * n), Integer(n)); };
  Active_subranges<Quadratic_root> active(Parameter_range{Quadratic_root(0), Quadratic_root(1)});
  for (unsigned long k = 0; 2 * k + 2 <= n; ++k) active.subtract(root(2 * k + 1), root(2 * k + 2));
  out << active.ranges().size() << " gaps, the last from " << active.last().low.near() << '\n';
}

/// What comes into sight on the way.
void walk(const sightline::Polygon_soup& soup, const sightline::Exact_point& from, const sightline::Exact_point& to,
          std::ostream& out) {
  const sightline::Scene scene(soup);
  const sightline::Occluders occluders(scene);
  for (const sightline::Along_event& event : visible_along(occluders, from, to).events)
    for (const auto& change : event.changes)
      if (change.after && !change.before) out << "face " << change.face << " at t = " << event.t.near() << '\n';
}

/// What of a face is lit, in penumbra and in umbra, and a point of each part.
void divide(const sightline::Scene& scene, std::uint32_t piece, const std::vector<sightline::Exact_point>& lamp,
            std::ostream& out) {
  const sightline::Light_partitioner partitioner(scene);  // serves any number of pieces and sources
  sightline::Partition_counters counters;
  const auto found = partitioner.partition(piece, {lamp}, {}, counters);
  for (const auto& cell : found.cells)
    out << name_of(cell.light) << " around " << cell.at[0] << ", " << cell.at[1] << '\n';
  const auto lit = found.shares()[0];  // between two doubles
  out << "lit: " << lit.low << " to " << lit.high << " of it\n";
}

#include <gtest/gtest.h>

#include <sstream>

TEST(Example, of_the_page_lights_a_floor_past_a_table) {
  sightline::Polygon_soup soup;
  const auto face = [&](double x0, double x1, double y0, double y1, double z) {  // looks up
    std::vector<sightline::Point_id> square;
    for (const auto& [x, y] : {std::pair(x0, y0), std::pair(x1, y0), std::pair(x1, y1), std::pair(x0, y1)})
      square.push_back(soup.add_point(x, y, z));
    soup.add_face(square);
  };
  face(-4, 4, -4, 4, 0);              // the floor
  face(-1, 1, -1, 1, 2);              // a table
  face(-0.25, 0.25, -0.25, 0.25, 1);  // a shelf below it, that the lamp does not reach
  std::ostringstream out;
  light(soup, {{-1, -1, 4}, {-1, 1, 4}, {1, 1, 4}, {1, -1, 4}}, out);  // looks down
  EXPECT_EQ(out.str(), "face 0 is lit\nface 1 is lit\nface 2 is dark\nproved\n");
}
TEST(Weak_visibility_example, bars_leave_gaps) {
  std::ostringstream out;
  look_through(100, out);
  EXPECT_EQ(out.str(), "50 gaps, the last from 0.989949\n");
}
TEST(Weak_visibility_example, divides_a_wall_that_a_lamp_is_level_with) {
  sightline::Polygon_soup soup;  // a wall in x = 0; the lamp is at half its height and looks up
  const auto a = soup.add_point(0, 0, 0), b = soup.add_point(0, 4, 0), c = soup.add_point(0, 4, 4),
             d = soup.add_point(0, 0, 4);
  soup.add_face({a, b, c, d});
  std::ostringstream out;
  divide(sightline::Scene(soup), 0, {{1, 1, 2}, {2, 1, 2}, {2, 2, 2}, {1, 2, 2}}, out);
  EXPECT_NE(out.str().find("lit: 0.5 to 0.5 of it\n"), std::string::npos) << out.str();
  EXPECT_NE(out.str().find("umbra around "), std::string::npos) << out.str();
}
TEST(Weak_visibility_example, a_walk_past_a_floor) {
  sightline::Polygon_soup soup;
  const auto a = soup.add_point(0, 0, 0), b = soup.add_point(1, 0, 0), c = soup.add_point(0, 1, 0);
  soup.add_face({a, b, c});
  std::ostringstream out;
  walk(soup, {5, 5, -1}, {5, 5, 3}, out);
  EXPECT_EQ(out.str(), "face 0 at t = 0.25\n");
}
