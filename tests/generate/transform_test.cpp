// Exact transforms: what they keep, what they change, and that they can be undone.

#include <sightline/harness/generate/scenes.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/soups.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace sightline;
namespace generate = sightline::generate;

namespace {

Rational fraction(long p, long q) {
  Rational r(p, q);
  r.canonicalize();
  return r;
}

bool same_points(const Polygon_soup& a, const Polygon_soup& b) {
  if (a.point_count() != b.point_count()) return false;
  for (Point_id p = 0; p < a.point_count(); ++p)
    if (a.point(p) != b.point(p)) return false;
  return true;
}

bool same_faces(const Polygon_soup& a, const Polygon_soup& b) {
  if (a.face_count() != b.face_count()) return false;
  for (Face_id f = 0; f < a.face_count(); ++f) {
    if (a.loop_count(f) != b.loop_count(f)) return false;
    for (std::size_t k = 0; k < a.loop_count(f); ++k)
      if (!std::equal(a.loop(f, k).begin(), a.loop(f, k).end(), b.loop(f, k).begin(), b.loop(f, k).end())) return false;
  }
  return true;
}

/// A frame with a hole, a concave face, a face of two points, an unused point.
Polygon_soup sample() {
  Polygon_soup soup = generate::city(5, 1, true);
  const Point_id a = soup.add_point(0.0, 0.0, 7.0);
  soup.add_point(8.0, 0.0, 7.0);
  soup.add_point(8.0, 8.0, 7.0);
  soup.add_point(0.0, 8.0, 7.0);
  soup.add_point(1.0, 1.0, 7.0);
  soup.add_point(1.0, 2.0, 7.0);
  soup.add_point(2.0, 1.0, 7.0);
  soup.add_point(fraction(1, 3), fraction(-2, 7), fraction(1, 1000000007));
  soup.add_face({a, a + 1, a + 2, a + 3});
  soup.add_hole({a + 4, a + 5, a + 6});
  soup.add_face({a, a + 2});
  return soup;
}

}  // namespace

TEST(Transform, what_is_appended_comes_behind_and_keeps_its_holes) {
  Polygon_soup square, holed;
  for (const auto& [x, y] : {std::pair(0, 0), {4, 0}, {4, 4}, {0, 4}}) square.add_point(x, y, 0);
  for (const auto& [x, y] : {std::pair(1, 1), {1, 2}, {2, 2}}) square.add_point(x, y, 0);
  holed = square;
  square.add_face(std::vector<Point_id>{0, 1, 2, 3});
  holed.add_face(std::vector<Point_id>{0, 1, 2, 3});
  holed.add_hole(std::vector<Point_id>{4, 5, 6});
  Polygon_soup both = square;
  generate::append(both, holed);
  ASSERT_EQ(both.face_count(), 2u);
  ASSERT_EQ(both.loop_count(1), 2u);
  EXPECT_EQ(both.point_count(), 14u);
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < holed.loop(0, k).size(); ++i) EXPECT_EQ(both.loop(1, k)[i], holed.loop(0, k)[i] + 7);
  EXPECT_EQ(both.point(11), holed.point(4));
}

TEST(Transform, translation_moves_every_point_and_can_be_undone) {
  const Polygon_soup soup = sample();
  const Exact_point offset{fraction(1, 3), fraction(-100000000, 1), exact(1e-50)};
  const Polygon_soup moved = generate::translated(soup, offset);
  EXPECT_TRUE(same_faces(soup, moved));
  for (Point_id p = 0; p < soup.point_count(); ++p)
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(moved.point(p)[i] - soup.point(p)[i], offset[i]);
  EXPECT_TRUE(same_points(soup, generate::translated(moved, {-offset[0], -offset[1], -offset[2]})));
}

TEST(Transform, scaling_can_be_undone_and_must_be_positive) {
  const Polygon_soup soup = sample();
  const Polygon_soup large = generate::scaled(soup, fraction(7, 3));
  EXPECT_TRUE(same_faces(soup, large));
  EXPECT_EQ(large.point(0)[0], soup.point(0)[0] * fraction(7, 3));
  EXPECT_TRUE(same_points(soup, generate::scaled(large, fraction(3, 7))));
  EXPECT_THROW(generate::scaled(soup, 0), std::invalid_argument);
  EXPECT_THROW(generate::scaled(soup, -1), std::invalid_argument);
}

TEST(Transform, rotations_are_orthogonal_with_determinant_one) {
  for (const auto& q :
       {std::array<long, 4>{1, 0, 0, 0}, {1, 0, 0, 1}, {2, 0, 0, 1}, {1, 2, 3, 4}, {-5, 1, 0, 7}, {0, 0, 3, 0}}) {
    const generate::Rational_matrix m = generate::rotation(q[0], q[1], q[2], q[3]);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        Rational dot = 0;
        for (std::size_t k = 0; k < 3; ++k) dot += m[i][k] * m[j][k];
        EXPECT_EQ(dot, i == j ? 1 : 0);
      }
    for (std::size_t j = 0; j < 3; ++j) {  // the third row is the cross product of the others: determinant 1
      const std::size_t k = (j + 1) % 3, l = (j + 2) % 3;
      EXPECT_EQ(m[2][j], m[0][k] * m[1][l] - m[0][l] * m[1][k]);
    }
    for (std::size_t i = 0; i < 3; ++i) {  // the axis stays
      Rational image = 0;
      for (std::size_t j = 0; j < 3; ++j) image += m[i][j] * q[j + 1];
      EXPECT_EQ(image, q[i + 1]);
    }
  }
  EXPECT_THROW(generate::rotation(0, 0, 0, 0), std::invalid_argument);
}

TEST(Transform, rotation_turns_counterclockwise_about_its_axis) {
  const generate::Rational_matrix quarter = generate::rotation(1, 0, 0, 1);  // 90 degrees about z
  EXPECT_EQ(quarter[0][1], -1);
  EXPECT_EQ(quarter[1][0], 1);
  EXPECT_EQ(generate::rotation(2, 0, 0, 1)[0][0], fraction(3, 5));
  EXPECT_EQ(generate::rotation(2, 0, 0, 1)[1][0], fraction(4, 5));
  const Polygon_soup soup = sample(), turned = generate::rotated(soup, generate::rotation(1, 2, -3, 4));
  EXPECT_TRUE(same_faces(soup, turned));
  EXPECT_FALSE(same_points(soup, turned));
  EXPECT_TRUE(same_points(soup, generate::rotated(turned, generate::rotation(1, -2, 3, -4))));
}

TEST(Transform, permuted_faces_are_where_the_order_says) {
  const Polygon_soup soup = sample(), mixed = generate::faces_permuted(soup, 5);
  const std::vector<Face_id> order = generate::random_order(soup.face_count(), 5);
  EXPECT_FALSE(same_faces(soup, mixed));
  EXPECT_TRUE(same_points(soup, mixed));
  EXPECT_TRUE(same_faces(mixed, generate::with_faces(soup, order)));
  std::vector<Face_id> back(order.size());
  for (Face_id k = 0; k < order.size(); ++k) back[order[k]] = k;
  EXPECT_TRUE(same_faces(soup, generate::with_faces(mixed, back)));
  EXPECT_NE(order, generate::random_order(soup.face_count(), 6));
  EXPECT_THROW(generate::with_faces(soup, {static_cast<Face_id>(soup.face_count())}), std::out_of_range);
}

TEST(Transform, reversed_faces_run_backwards_with_their_holes) {
  const Polygon_soup soup = sample(), reversed = generate::faces_reversed(soup);
  EXPECT_TRUE(same_points(soup, reversed));
  for (Face_id f = 0; f < soup.face_count(); ++f)
    for (std::size_t k = 0; k < soup.loop_count(f); ++k)
      EXPECT_TRUE(std::equal(soup.loop(f, k).rbegin(), soup.loop(f, k).rend(), reversed.loop(f, k).begin(),
                             reversed.loop(f, k).end()));
  EXPECT_TRUE(same_faces(soup, generate::faces_reversed(reversed)));
}

TEST(Transform, one_ulp_is_at_most_one_ulp_and_often_less) {
  const Polygon_soup soup = generate::soup(100, 0.3, 1), moved = generate::one_ulp_perturbed(soup, 2);
  EXPECT_TRUE(same_faces(soup, moved));
  int down = 0, same = 0, up = 0;
  for (std::size_t i = 0; i < soup.coordinates.size(); ++i) {
    const double a = soup.coordinates[i].get_d(), b = moved.coordinates[i].get_d();
    EXPECT_EQ(exact(b), moved.coordinates[i]);
    if (b == a) ++same;
    else if (b == std::nextafter(a, 2.0)) ++up;
    else if (b == std::nextafter(a, -2.0)) ++down;
  }
  EXPECT_EQ(down + same + up, 900);
  EXPECT_GT(std::min({down, same, up}), 200);
  EXPECT_TRUE(same_points(moved, generate::one_ulp_perturbed(soup, 2)));
  EXPECT_FALSE(same_points(moved, generate::one_ulp_perturbed(soup, 3)));
  generate::one_ulp_perturbed(sample(), 1);  // coordinates that are no doubles are rounded first
}
