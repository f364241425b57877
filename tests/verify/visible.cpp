// What the eye sees (P-63): right certificates accepted, and each clause broken alone rejected for its reason.
// Certificates are made here by cutting cones, piece by piece.

#include "../sample.h"
#include "scenes.h"

#include <sightline/algorithms/verify/certificate_json.h>
#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/algorithms/verify/pairs.h>
#include <sightline/algorithms/verify/polygons.h>

#include <nlohmann/json.hpp>

#include <numeric>
#include <sstream>

namespace {

using namespace verify_test;
using Directions = Visible_certificate::Directions;

Exact_point plus(const Exact_point& a, const Rational& s, const Exact_point& b) {
  return at(a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]);
}
Rational dot(const Exact_point& a, const Exact_point& b) { return Rational(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]); }
Exact_point cross(const Exact_point& a, const Exact_point& b) {
  return at(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}
Exact_point sum(const Points& points) {
  Exact_point total = at(0, 0, 0);
  for (const Exact_point& p : points) total = plus(total, 1, p);
  return total;
}

struct Sight {
  Polygon_soup soup;
  Visible_certificate certificate;

  Sight& from(const Exact_point& eye) {
    certificate.eye = eye;
    return *this;
  }
  Sight& within(const Directions& field) {
    certificate.field = field;
    return *this;
  }
  /// A convex face, which is its own piece.
  Sight& face(const Points& polygon) {
    std::vector<Point_id> ids;
    for (const Exact_point& p : polygon) ids.push_back(soup.add_point(p[0], p[1], p[2]));
    certificate.fragments.push_back({soup.add_face(ids), 0, polygon});
    return *this;
  }
  /// A part, with a ray through its middle.
  Sight& part(std::size_t fragment, const Points& vertices) {
    Exact_point ray = at(0, 0, 0);
    for (const Exact_point& p : vertices) ray = plus(plus(ray, 1, p), -1, certificate.eye);
    certificate.parts.push_back({fragment, vertices, ray});
    return *this;
  }
  Sight& empty(const Directions& cone) {
    certificate.empty.push_back(cone);
    return *this;
  }
  Verdict verdict() const { return verify_visible(soup, certificate); }
};

/// The same, its parts given by rays.
Sight by_rays(Sight sight) {
  Visible_certificate& c = sight.certificate;
  for (Visible_certificate::Part& part : c.parts) {
    for (const Exact_point& p : part.vertices) {
      part.rays.push_back(static_cast<std::uint32_t>(c.rays.size()));
      c.rays.push_back(plus(p, -1, c.eye));
    }
    part.vertices = {};
    part.ray = {};
  }
  return sight;
}

void expect_accepted(const Sight& sight) {
  const Verdict verdict = sight.verdict();
  EXPECT_TRUE(verdict.accepted) << verdict.why;
  EXPECT_TRUE(verdict.fragments.empty());
  EXPECT_EQ(by_rays(sight).verdict().why, verdict.why);
}
void expect_rejected(const Sight& sight, const std::string& words, const std::vector<std::size_t>& fragments = {}) {
  const Verdict verdict = sight.verdict();
  EXPECT_FALSE(verdict.accepted) << "instead of: " << words;
  EXPECT_NE(verdict.why.find(words), std::string::npos) << verdict.why << "\ninstead of: " << words;
  EXPECT_EQ(verdict.why.find('\n'), std::string::npos);
  EXPECT_EQ(verdict.fragments, fragments) << verdict.why;
}

Directions octant(int x, int y, int z) { return {at(x, 0, 0), at(0, y, 0), at(0, 0, z)}; }
/// Octants by number: bit k says which coordinate is negative.
Directions octant(int number) { return octant(number & 1 ? -1 : 1, number & 2 ? -1 : 1, number & 4 ? -1 : 1); }
Points scaled(Points points, const Rational& factor) {
  for (Exact_point& p : points) p = plus(at(0, 0, 0), factor, p);
  return points;
}
/// At height 1, where the eye in the origin sees plane geometry.
Points tile(const Rational& x0, const Rational& x1, const Rational& y0, const Rational& y1) {
  return rectangle(x0, x1, y0, y1, 1);
}

// ---- By hand

/// A triangle that fills the first octant, and nothing else.
Sight one_triangle() {
  Sight sight;
  sight.from(at(0, 0, 0)).face(octant(0)).part(0, octant(0));
  for (int k = 1; k < 8; ++k) sight.empty(octant(k));
  return sight;
}

TEST(Visible, one_triangle_and_the_other_octants) {
  expect_accepted(one_triangle());
  Sight moved = one_triangle();
  moved.certificate.eye = at(1, 0, 0);
  expect_rejected(moved, "part 0 (face 0) is seen edge-on", {0});
  Sight behind;  // seen from behind
  behind.from(at(0, 0, 0)).face(reversed(octant(0))).part(0, reversed(octant(0)));
  for (int k = 1; k < 8; ++k) behind.empty(reversed(octant(k)));
  expect_accepted(behind);
  Sight nothing;
  nothing.from(at(0, 0, 0));
  expect_rejected(nothing, "there is neither a part nor an empty cone");
  for (int k = 0; k < 8; ++k) nothing.empty(scaled(octant(k), ratio(k + 1, 3)));
  expect_accepted(nothing);
}

TEST(Visible, what_is_missing_or_doubled) {
  Sight sight = one_triangle();
  sight.certificate.parts.clear();
  expect_rejected(sight, "boundaries do not cancel");
  expect_rejected(sight.empty(octant(0)), "empty cone 7 has face 0 in it", {0});
  sight = one_triangle();
  expect_rejected(sight.part(0, octant(0)), "boundaries do not cancel");
  sight = one_triangle();
  expect_rejected(sight.empty(octant(5)), "boundaries do not cancel");
  sight = one_triangle();
  sight.certificate.empty.pop_back();
  expect_rejected(sight, "boundaries do not cancel");
  sight = one_triangle();  // everything twice: boundaries cancel
  sight.part(0, octant(0));
  for (int k = 1; k < 8; ++k) sight.empty(octant(k));
  expect_rejected(sight, "part 0 (face 0) and part 1 (face 0) overlap");
  sight = one_triangle();
  sight.certificate.fragments.clear();
  sight.certificate.parts.clear();
  expect_rejected(sight.empty(octant(0)), "face 0 has no fragment");
}

TEST(Visible, a_whole_circle_left_over_has_no_ends) {
  Sight sight;
  sight.from(at(0, 0, 0));
  for (int k = 0; k < 4; ++k) sight.empty(octant(k));
  expect_rejected(sight, "boundaries do not cancel");  // the upper half only
  for (int k = 0; k < 8; ++k) sight.empty(octant(k));
  expect_rejected(sight, "boundaries do not cancel");  // the upper half twice
  for (int k = 4; k < 8; ++k) sight.empty(octant(k));
  expect_rejected(sight, "empty cone 0 and empty cone 4 overlap");
}

TEST(Visible, a_triangle_hides_one_behind_it) {
  Sight sight = one_triangle();
  sight.face(scaled(octant(0), 2));
  expect_accepted(sight);
  Sight wrong = sight;
  wrong.certificate.parts.clear();
  expect_rejected(wrong.part(1, scaled(octant(0), 2)),
                  "part 0 (face 1) is not what its ray meets first: face 0 is nearer", {1, 0});
  wrong = sight;  // beside the front one, behind its plane
  wrong.certificate.parts[0].fragment = 1;
  expect_rejected(wrong, "part 0 (face 1) has a vertex off the plane of its face", {1});
}

/// A small square before a wall, in a frustum; the wall's part has two corners where the square's corners are, and
/// T-junctions.
const Points wall = scaled(tile(0, 3, 0, 3), 2), small = tile(1, 2, 1, 2);
Sight wall_and_square() {
  Sight sight;
  sight.from(at(0, 0, 0)).within(tile(0, 3, 0, 3)).face(wall).face(small).part(1, small);
  sight.part(0, scaled(tile(0, 1, 0, 3), 2)).part(0, scaled(tile(2, 3, 0, 3), 2));
  return sight.part(0, scaled(tile(1, 2, 0, 1), 2)).part(0, scaled(tile(1, 2, 2, 3), 2));
}

TEST(Visible, a_square_before_a_wall_with_T_junctions) {
  expect_accepted(wall_and_square());
  Sight sight = wall_and_square();
  sight.certificate.field = reversed(sight.certificate.field);
  expect_accepted(sight);
  sight = wall_and_square();  // the wall's ray misses the square, its part does not
  sight.certificate.parts = {{0, wall, at(1, 1, 2)}};
  expect_rejected(sight, "part 0 (face 0) is behind face 1 somewhere", {0, 1});
  sight.certificate.parts[0].ray = at(1, ratio(3, 2), 1);  // through an edge of the square, that is, of a closed face
  expect_rejected(sight, "part 0 (face 0) is not what its ray meets first: face 1 is nearer", {0, 1});
  sight = wall_and_square();  // a hair too much is behind
  sight.certificate.parts.clear();
  sight.part(0, scaled(tile(0, 1 + tiny(60), 0, 3), 2));
  expect_rejected(sight, "part 0 (face 0) is behind face 1 somewhere", {0, 1});
  sight = wall_and_square();
  sight.certificate.parts[0] = {0, scaled(small, 2), at(3, 3, 2)};
  expect_rejected(sight, "part 0 (face 0) is not what its ray meets first: face 1 is nearer", {0, 1});
  sight = wall_and_square();  // before the wall, but not there: outside its piece
  sight.certificate.parts[0].vertices = tile(1, 2 + tiny(60), 1, 2);
  expect_rejected(sight, "part 0 (face 1) is not inside its piece", {1});
  sight = wall_and_square();  // and if the ray is outside of all else too
  sight.within(tile(-1, 3, 0, 3)).part(0, scaled(tile(-1, 0, 0, 3), 2));
  expect_rejected(sight, "part 5 (face 0) is not inside its piece", {0});
}

TEST(Visible, gaps_and_overlaps_of_a_hair) {
  for (const Rational& hair : {tiny(60), Rational(-tiny(60)), Rational(-tiny(500))}) {
    Sight sight = wall_and_square();
    for (std::size_t corner : {1u, 2u}) sight.certificate.parts[1].vertices[corner][0] += hair;
    if (sgn(hair) < 0) expect_rejected(sight, "boundaries do not cancel");
    sight = wall_and_square();
    sight.certificate.parts[4].vertices[2][1] += hair;
    if (sgn(hair) < 0) expect_rejected(sight, "boundaries do not cancel");
    Sight plane;
    plane.from(at(0, 0, 0)).within(tile(0, 2, 0, 2)).empty(tile(0, 1, 0, 2));
    Sight right = plane;
    expect_accepted(right.empty(tile(1, 2, 0, 1)).empty(tile(1, 2, 1, 2)));
    Sight wrong = plane;
    expect_rejected(wrong.empty(tile(1 + hair, 2, 0, 1)).empty(tile(1, 2, 1, 2)), "boundaries do not cancel");
    wrong = plane;
    expect_rejected(wrong.empty(tile(1, 2, 0, 1 + hair)).empty(tile(1, 2, 1, 2)), "boundaries do not cancel");
    wrong = right;
    wrong.certificate.field[2][0] += hair;
    expect_rejected(wrong, "boundaries do not cancel");
  }
}

TEST(Visible, coplanar_overlap_has_one_winner) {
  const Points a = tile(0, 2, 0, 2), b = tile(1, 3, 1, 3);
  for (int turned = 0; turned < 4; ++turned) {  // bit 0: a is seen from the front; bit 1: b is
    const auto of_a = [&](const Points& p) { return turned & 1 ? reversed(p) : p; };
    const auto of_b = [&](const Points& p) { return turned & 2 ? reversed(p) : p; };
    Sight scene;
    scene.from(at(0, 0, 0))
        .within(tile(0, 3, 0, 3))
        .face(of_a(a))
        .face(of_b(b))
        .empty(tile(2, 3, 0, 1))
        .empty(tile(0, 1, 2, 3));
    Sight first = scene, second = scene;
    first.part(0, of_a(a)).part(1, of_b(tile(2, 3, 1, 3))).part(1, of_b(tile(1, 2, 2, 3)));
    second.part(1, of_b(b)).part(0, of_a(tile(0, 1, 0, 2))).part(0, of_a(tile(1, 2, 0, 1)));
    if (turned == 2) {
      expect_accepted(second);
      expect_rejected(first, "part 0 (face 0) is as far as face 1 somewhere, which is preferred", {0, 1});
    } else {
      expect_accepted(first);
      expect_rejected(second, "part 0 (face 1) is as far as face 0 somewhere, which is preferred", {1, 0});
    }
  }
  // Equally far, in one plane, and side by side: no overlap. Only an edge of the rectangle tells them apart.
  const Points triangle = {at(0, 0, 1), at(2, 2, 1), at(0, 4, 1)}, rectangle = tile(2, 4, 0, 4);
  for (const bool rectangle_first : {false, true}) {
    Sight beside;
    beside.from(at(0, 0, 0))
        .within(tile(0, 4, 0, 4))
        .empty({at(0, 0, 1), at(2, 0, 1), at(2, 2, 1)})
        .empty({at(0, 4, 1), at(2, 2, 1), at(2, 4, 1)});
    for (const Points& face : {rectangle_first ? rectangle : triangle, rectangle_first ? triangle : rectangle})
      beside.face(face).part(beside.soup.face_count() - 1, face);
    expect_accepted(beside);
  }
}

/// Crossing in x = 0: up is nearer on the left.
const Points up = {at(-1, -1, ratio(1, 2)), at(1, -1, ratio(3, 2)), at(1, 1, ratio(3, 2)), at(-1, 1, ratio(1, 2))};
const Points down = {at(-1, -1, ratio(3, 2)), at(1, -1, ratio(1, 2)), at(1, 1, ratio(1, 2)), at(-1, 1, ratio(3, 2))};

TEST(Visible, crossing_quads_are_cut_where_they_cross) {
  const auto sight_cut_at = [](const Rational& x) {
    Sight sight;
    sight.from(at(0, 0, 0)).within(tile(-2, 2, -2, 2)).face(up).face(down);
    sight.part(0, {up[0], at(x, -1, 1 + x / 2), at(x, 1, 1 + x / 2), up[3]})
        .part(1, {at(x, -1, 1 - x / 2), down[1], down[2], at(x, 1, 1 - x / 2)});
    return sight.empty({at(-2, 2, 1), at(0, 1, 1), at(2, 2, 1)}).empty({at(-2, -2, 1), at(0, -1, 1), at(2, -2, 1)});
  };
  expect_accepted(sight_cut_at(0));
  expect_rejected(sight_cut_at(tiny(60)), "part 0 (face 0) is behind face 1 somewhere", {0, 1});
  expect_rejected(sight_cut_at(-tiny(60)), "part 1 (face 1) is behind face 0 somewhere", {1, 0});
  expect_rejected(sight_cut_at(1), "part 1 (face 1) has a repeated vertex", {1});
}

/// The box [-1, 1]^3, fronts inwards.
std::vector<Points> box() {
  std::vector<Points> faces;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {-1, 1}) {
      Points face;
      for (const auto& [u, v] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)}) {
        Exact_point p = at(side, side, side);
        p[(axis + 1) % 3] = u;
        p[(axis + 2) % 3] = v;
        face.push_back(p);
      }
      faces.push_back(side < 0 ? face : reversed(face));
    }
  return faces;
}

TEST(Visible, a_box_around_the_eye) {
  for (const Exact_point& eye : {at(0, 0, 0), at(ratio(1, 2), ratio(-1, 3), 1 - tiny(70))}) {
    Sight sight;
    sight.from(eye);
    for (const Points& face : box()) sight.face(face);
    Sight open = sight;
    for (std::size_t f = 0; f < 6; ++f) sight.part(f, box()[f]);
    expect_accepted(sight);
    for (std::size_t f = 1; f < 6; ++f) open.part(f, box()[f]);
    expect_rejected(open, "boundaries do not cancel");
  }
}

TEST(Visible, the_eye_at_a_corner_on_an_edge_or_on_a_face_passes_over_what_is_edge_on) {
  const auto sight_from = [](const Exact_point& eye) {
    Sight sight;
    sight.from(eye);
    for (const Points& face : box()) sight.face(face);
    return sight;
  };
  Sight corner = sight_from(at(1, 1, 1));
  for (const std::size_t f : {0u, 2u, 4u}) corner.part(f, box()[f]);
  for (int k = 0; k < 7; ++k) corner.empty(octant(k));
  expect_accepted(corner);
  Sight wrong = corner;
  expect_rejected(wrong.part(1, box()[1]), "part 3 (face 1) is seen edge-on: the eye is in its plane", {1});
  Sight on_face = sight_from(at(0, 0, 1));
  for (const std::size_t f : {0u, 1u, 2u, 3u, 4u}) on_face.part(f, box()[f]);
  for (int k = 0; k < 4; ++k) on_face.empty(octant(k));
  expect_accepted(on_face);
}

TEST(Visible, wide_cones_that_face_away_from_each_other) {
  // A flat prism: no edge plane of the bottom's cone, or of the open top's, tells one from the other.
  const Points top = {at(4, 0, 1), at(-2, 4, 1), at(-2, -4, 1)}, bottom = {at(4, 0, -1), at(-2, 4, -1), at(-2, -4, -1)};
  Sight sight;
  sight.from(at(0, 0, 0)).face(bottom).part(0, bottom);
  for (std::size_t i = 0; i < 3; ++i) {
    const Points wing = {top[i], top[(i + 1) % 3], bottom[(i + 1) % 3], bottom[i]};
    sight.face(wing).part(i + 1, wing);
  }
  expect_accepted(sight.empty(top));
  const order_check::Cone above(top, at(0, 0, 0)), below(bottom, at(0, 0, 0));
  EXPECT_FALSE(order_check::separates(above, below) || order_check::separates(below, above));
}

TEST(Visible, parts_that_are_no_convex_polygons) {
  const auto with = [](const Points& vertices) {
    Sight sight = one_triangle();
    sight.certificate.parts[0].vertices = vertices;
    return sight;
  };
  const Points t = octant(0);
  const Exact_point middle = at(ratio(1, 3), ratio(1, 3), ratio(1, 3)), half = at(ratio(1, 2), ratio(1, 2), 0);
  expect_accepted(with({t[0], half, t[1], t[2]}));  // a straight corner
  expect_rejected(with({t[0], t[1], middle, t[2]}), "part 0 (face 0) is not convex", {0});
  expect_rejected(with(reversed(t)), "is clockwise", {0});
  expect_rejected(with({t[0], t[1]}), "has fewer than three vertices", {0});
  expect_rejected(with({}), "has fewer than three vertices", {0});
  expect_rejected(with({t[0], half, t[1]}), "has zero area", {0});
  expect_rejected(with({t[0], t[1], t[1], t[2]}), "has a repeated vertex", {0});
  expect_rejected(with({t[0], t[1], at(0, 0, 1 + tiny(60))}), "has a vertex off the plane", {0});
  expect_rejected(with({t[0], t[1], at(0, 0, 0)}), "has a vertex off the plane", {0});  // the eye
  expect_rejected(with({t[0], t[1], t[2], t[0], t[1], t[2]}), "turns more than once", {0});
  expect_rejected(with({t[0], t[1], at(0, -tiny(60), 1 + tiny(60))}), "is not inside its piece", {0});
  Sight other = one_triangle();
  other.certificate.parts[0].fragment = 1;
  expect_rejected(other, "part 0 is of fragment 1, which there is not");
}

TEST(Visible, rays_that_are_not_inside) {
  const auto with = [](const Exact_point& ray) {
    Sight sight = one_triangle();
    sight.certificate.parts[0].ray = ray;
    return sight;
  };
  expect_accepted(with(at(1, 2, tiny(200))));
  expect_accepted(with(at(ratio(1, 7), 100, 3)));
  for (const Exact_point& wrong :
       {at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(-1, -1, -1), at(1, 1, -tiny(60)), at(-2, 1, 1)})
    expect_rejected(with(wrong), "part 0 (face 0) does not have its ray strictly inside its cone", {0});
}

TEST(Visible, a_ray_may_graze_what_is_not_nearer_inside) {
  // The wall's ray through the edge that a step in front of it has in common with it; and one that meets a nearer
  // corner.
  Sight sight;
  const Points step = {at(2, 0, 2), at(3, 0, ratio(3, 2)), at(3, 3, ratio(3, 2)), at(2, 3, 2)};
  sight.from(at(0, 0, 0))
      .within(tile(0, 2, 0, 1))
      .face(scaled(tile(0, 2, 0, 1), 2))
      .face(step)
      .part(0, scaled(tile(0, 1, 0, 1), 2))
      .part(1, {step[0], at(3, 0, ratio(3, 2)), at(3, ratio(3, 2), ratio(3, 2)), at(2, 2, 2)});
  expect_accepted(sight);
  sight.certificate.parts[0] = {0, scaled(tile(0, 2, 0, 1), 2), at(1, ratio(1, 2), 1)};
  expect_rejected(sight, "part 0 (face 0) is behind face 1 somewhere", {0, 1});  // its ray meets both, equally far
}

TEST(Visible, cones_that_are_none) {
  const std::vector<std::pair<Directions, std::string>> cases = {
      {{at(1, 0, 0), at(0, 1, 0)}, "has fewer than three directions"},
      {{at(1, 0, 0)}, "has fewer than three directions"},
      {{at(1, 0, 0), at(0, 0, 0), at(0, 1, 0), at(0, 0, 1)}, "has a direction that is zero"},
      {{at(1, 0, 0), at(0, 1, 0), at(-1, 0, 0)}, "is not a convex cone, or not a pointed one"},  // half a plane
      {{at(1, 0, 0), at(0, 1, 1), at(-1, 0, 0)},
       "is not a convex cone, or not a pointed one"},  // an arc of half a circle
      {{at(1, 0, 0), at(0, 1, 0), at(-1, 0, 0), at(0, -1, 0)},
       "is not a convex cone, or not a pointed one"},                                           // a whole one
      {{at(1, 0, 0), at(0, 1, 0), at(1, 1, 0)}, "is not a convex cone, or not a pointed one"},  // flat
      {{at(1, 0, 0), at(1, 0, 0), at(1, 0, 0)}, "is not a convex cone, or not a pointed one"},
      {{at(6, 10, 12), at(-10, 6, 11), at(-11, -4, 11), at(3, 12, -9), at(-12, 1, -7)},
       "is not a convex cone, or not a pointed one"},  // convex, but for two that are mirrored in the eye
      {{at(1, 0, 0), at(0, 1, 0), at(0, 1, 0), at(0, 0, 1)}, "has a repeated vertex"},
      {{at(1, 0, 0), at(0, 1, 0), at(0, 2, 0), at(0, 0, 1)}, "has a repeated vertex"},
      {{at(0, 0, 1), at(4, 0, 1), at(1, 1, 1), at(0, 4, 1)}, "is not convex"},
      {{at(0, 3, 1), at(-2, -3, 1), at(3, 1, 1), at(-3, 1, 1), at(2, -3, 1)}, "turns more than once"},  // a star
  };
  for (const auto& [directions, words] : cases) {
    Sight sight = one_triangle();
    sight.certificate.empty[6] = directions;
    expect_rejected(sight, words);
    EXPECT_EQ(sight.verdict().why.find("empty cone 6 "), 0u);
    sight = one_triangle();
    sight.certificate.field = directions;
    expect_rejected(sight, words);
  }
}

TEST(Visible, a_field_is_filled_and_nothing_else) {
  Sight sight = one_triangle();
  sight.within(octant(0));
  expect_rejected(sight, "boundaries do not cancel");
  sight.certificate.empty.clear();
  expect_accepted(sight);
  Sight all_and_field = one_triangle();  // the field twice, all else once: boundaries cancel
  expect_rejected(all_and_field.within(octant(0)).part(0, octant(0)), "part 0 (face 0) and part 1 (face 0) overlap");
  Sight outside_first = one_triangle();
  expect_rejected(outside_first.within(octant(3)).empty(octant(3)), "part 0 (face 0) is not inside the field");
  Sight opposite = one_triangle();
  opposite.certificate.parts.clear();
  opposite.certificate.empty = {octant(1)};
  expect_rejected(opposite.within(octant(0)), "boundaries do not cancel");
  Sight none;
  expect_rejected(none.from(at(0, 0, 0)).within(octant(0)), "boundaries do not cancel");
  Sight half;  // the inside of part 0 is on a side of another cone of the pair that lies over it
  half.from(at(0, 0, 0)).within(tile(-1, 1, -1, 1)).empty(tile(-1, 1, -1, 1));
  expect_accepted(half);
  half.empty(octant(1, 1, 1))
      .empty(octant(1, 1, -1))
      .empty(octant(1, -1, 1))
      .empty(octant(1, -1, -1))
      .empty(octant(-1, 1, 1))
      .empty(octant(-1, 1, -1))
      .empty(octant(-1, -1, 1));
  expect_rejected(half.empty(octant(-1, -1, -1)), "empty cone 0 and empty cone 1 overlap");
}

TEST(Visible, numbers_that_are_not_canonical) {
  Rational doubled, infinite;
  mpz_set_si(mpq_numref(doubled.get_mpq_t()), 2);
  mpz_set_si(mpq_denref(doubled.get_mpq_t()), 2);
  mpz_set_si(mpq_numref(infinite.get_mpq_t()), 1);
  mpz_set_si(mpq_denref(infinite.get_mpq_t()), 0);
  for (const Rational& bad : {doubled, infinite}) {
    Sight sight = one_triangle();
    sight.certificate.eye[2] = bad;
    expect_rejected(sight, "the eye is not a point");
    sight = one_triangle();
    sight.certificate.parts[0].vertices[1][1] = bad;
    expect_rejected(sight, "part 0 (face 0) has a vertex or a ray", {0});
    sight = one_triangle();
    sight.certificate.parts[0].ray[0] = bad;
    expect_rejected(sight, "part 0 (face 0) has a vertex or a ray", {0});
    sight = one_triangle();
    sight.certificate.empty[3][0][0] = bad;
    expect_rejected(sight, "empty cone 3 has a direction that is not");
    sight = one_triangle();
    sight.certificate.field = {at(1, 0, 0), at(0, 1, 0), at(0, 0, bad)};
    expect_rejected(sight, "the field has a direction that is not");
  }
}

TEST(Visible, reports_progress_up_to_the_end) {
  std::vector<std::size_t> seen;
  Verify_options options;
  options.progress = [&](std::size_t done, std::size_t total) {
    seen.push_back(done);
    EXPECT_EQ(total, 8u);
  };
  const Sight sight = one_triangle();
  EXPECT_TRUE(verify_visible(sight.soup, sight.certificate, options).accepted);
  ASSERT_GE(seen.size(), 8u);
  EXPECT_EQ(seen.front(), 0u);
  EXPECT_EQ(seen.back(), 8u);
  EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
}

// ---- Made by cutting cones

/// The two sides of a strictly convex cone; a side without an inside is empty.
std::array<Directions, 2> halves(const Directions& cone, const Exact_point& plane) {
  std::array<Directions, 2> result;
  for (std::size_t i = 0; i < cone.size(); ++i) {
    const Exact_point &from = cone[i], &to = cone[(i + 1) % cone.size()];
    const Rational u = dot(plane, from), v = dot(plane, to);
    if (sgn(u) <= 0) result[0].push_back(from);
    if (sgn(u) >= 0) result[1].push_back(from);
    if (sgn(u) * sgn(v) >= 0) continue;
    const auto whole = order_check::primitive(plus(plus(at(0, 0, 0), abs(v), from), abs(u), to));
    for (Directions& half : result) half.push_back({whole[0], whole[1], whole[2]});
  }
  for (Directions& half : result)
    if (half.size() < 3) half.clear();
  return result;
}

/// A fragment in coordinates around the eye.
struct Seen {
  Points corners;
  Exact_point nearness = at(0, 0, 0);  // nearness.x = 1 in its plane
  bool edge_on = true, front = false;
  Seen(const Order_fragment& fragment, const Exact_point& eye) {
    for (const Exact_point& p : fragment.vertices) corners.push_back(plus(p, -1, eye));
    Exact_point normal = at(0, 0, 0);
    for (std::size_t i = 0; i < corners.size(); ++i)
      normal = plus(normal, 1, cross(corners[i], corners[(i + 1) % corners.size()]));
    const Rational height = dot(normal, corners[0]);
    edge_on = sgn(height) == 0;
    front = sgn(height) < 0;
    if (!edge_on) nearness = plus(nearness, 1 / height, normal);
  }
  Exact_point edge_plane(std::size_t i) const {
    const Exact_point plane = cross(corners[i], corners[(i + 1) % corners.size()]);
    return plus(at(0, 0, 0), sgn(dot(plane, sum(corners))), plane);
  }
};

/// What is seen: all directions, or the field, cut by each fragment's edge planes and where it crosses what is nearest
/// so far.
void fill(Sight& sight) {
  struct Cell {
    Directions cone;
    std::size_t nearest;
  };
  auto& c = sight.certificate;
  const std::size_t nothing = c.fragments.size();
  std::vector<Cell> cells;
  if (!c.field.empty()) cells.push_back({c.field, nothing});
  for (int k = 0; k < 8 && c.field.empty(); ++k) cells.push_back({octant(k), nothing});
  std::vector<Seen> seen;
  for (const Order_fragment& fragment : c.fragments) seen.emplace_back(fragment, c.eye);
  for (std::size_t f = 0; f < nothing; ++f) {
    if (seen[f].edge_on) continue;
    std::vector<Cell> next;
    for (const Cell& cell : cells) {
      Directions rest = cell.cone;
      for (std::size_t i = 0; i < seen[f].corners.size() && !rest.empty(); ++i) {
        auto [out, in] = halves(rest, seen[f].edge_plane(i));
        if (!out.empty()) next.push_back({out, cell.nearest});
        rest = in;
      }
      if (rest.empty()) continue;
      if (cell.nearest == nothing) {
        next.push_back({rest, f});
        continue;
      }
      const Seen &old = seen[cell.nearest], &now = seen[f];
      const Exact_point nearer = plus(now.nearness, -1, old.nearness);
      if (sgn(dot(nearer, nearer)) == 0) {  // fragments are in the order of faces and pieces
        next.push_back({rest, now.front && !old.front ? f : cell.nearest});
        continue;
      }
      const auto [farther_half, nearer_half] = halves(rest, nearer);
      if (!farther_half.empty()) next.push_back({farther_half, cell.nearest});
      if (!nearer_half.empty()) next.push_back({nearer_half, f});
    }
    cells = std::move(next);
  }
  for (const Cell& cell : cells) {
    if (cell.nearest == nothing) {
      sight.empty(cell.cone);
      continue;
    }
    const Seen& piece = seen[cell.nearest];
    Points vertices;
    for (const Exact_point& d : cell.cone) vertices.push_back(plus(c.eye, 1 / dot(piece.nearness, d), d));
    const bool left =
        sgn(dot(cross(cell.cone[0], cell.cone[1]), cell.cone[2])) > 0;  // seen counterclockwise from outside
    c.parts.push_back({cell.nearest, left != piece.front ? vertices : reversed(vertices), sum(cell.cone)});
  }
}

Points random_polygon(Dice& dice, long size) {
  while (true) {
    const auto vector = [&] { return at(roll(dice, -size, size), roll(dice, -size, size), roll(dice, -size, size)); };
    const Exact_point o = vector(), u = vector(), v = vector(), normal = cross(u, v);
    if (sgn(dot(normal, normal)) == 0) continue;
    const auto corner = [&](const Rational& s, const Rational& t) { return plus(plus(o, s, u), t, v); };
    const long kind = roll(dice, 0, 3);
    if (kind == 0) return {corner(0, 0), corner(1, 0), corner(0, 1)};
    if (kind == 1) return {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
    if (kind == 2) return {corner(0, 0), corner(1, 0), corner(1, ratio(1, 2)), corner(ratio(1, 2), 1), corner(0, 1)};
    return {corner(0, 0), corner(ratio(1, 3), 0), corner(1, 0), corner(0, 1),
            corner(0, ratio(1, 2))};  // with straight corners
  }
}

/// Faces that may cross, overlap in one plane, touch, or hold the eye; sometimes inside a body, sometimes in a field.
Sight random_sight(Dice& dice) {
  Sight sight;
  const long size = roll(dice, 1, 4);
  sight.from(at(ratio(roll(dice, -2, 2), roll(dice, 1, 3)), ratio(roll(dice, -2, 2), roll(dice, 1, 3)),
                ratio(roll(dice, -2, 2), 3)));
  for (long count = roll(dice, 0, 3); count > 0; --count) {
    const Points polygon = random_polygon(dice, size);
    sight.face(polygon);
    if (roll(dice, 0, 3) > 0) continue;  // another in its plane, either way around
    Points other;
    const Exact_point shift = plus(polygon[1], -1, polygon[0]);
    for (const Exact_point& p : polygon) other.push_back(plus(p, ratio(1, 3), shift));
    sight.face(roll(dice, 0, 1) ? other : reversed(other));
  }
  if (roll(dice, 0, 2) == 0)
    for (int k = 0; k < 8; ++k)
      if (roll(dice, 0, 3) > 0) sight.face(scaled(octant(k), 12));
  if (roll(dice, 0, 2) == 0) {
    const Seen window({0, 0, random_polygon(dice, 3)}, sight.certificate.eye);
    const order_check::Cone cone(window.corners, at(0, 0, 0));
    Directions field;
    for (const auto& ray : cone.rays) field.push_back({ray[0], ray[1], ray[2]});
    if (!window.edge_on) sight.within(field);
  }
  fill(sight);
  return sight;
}

/// Pre: no straight corners.
bool strictly_inside(const Directions& cone, const Exact_point& d) {
  const auto side = [&](std::size_t i, const Exact_point& p) {
    return sgn(dot(cross(cone[i], cone[(i + 1) % cone.size()]), p));
  };
  for (std::size_t i = 0; i < cone.size(); ++i)
    if (side(i, d) != side(0, cone[2])) return false;
  return true;
}
Directions cone_of(const Visible_certificate::Part& part, const Exact_point& eye) {
  Directions cone;
  for (const Exact_point& p : part.vertices) cone.push_back(plus(p, -1, eye));
  return cone;
}

/// Whether in a direction at random, one tile says what is met first.
bool right_in(const Sight& sight, const Exact_point& d) {
  const auto& c = sight.certificate;
  const std::size_t nothing = c.fragments.size();
  if (!c.field.empty() && !strictly_inside(c.field, d)) return true;
  std::size_t first = nothing;
  Rational nearest = 0;
  bool front = false;
  for (std::size_t f = 0; f < nothing; ++f) {
    const Seen piece(c.fragments[f], c.eye);
    if (piece.edge_on) continue;
    bool inside = true;
    for (std::size_t i = 0; i < piece.corners.size(); ++i) inside = inside && sgn(dot(piece.edge_plane(i), d)) > 0;
    const Rational nearness = dot(piece.nearness, d);
    if (inside && (nearness > nearest || (nearness == nearest && piece.front && !front))) {
      first = f;
      nearest = nearness;
      front = piece.front;
    }
  }
  std::size_t tiles = 0;
  for (const auto& part : c.parts)
    if (strictly_inside(cone_of(part, c.eye), d)) {
      if (part.fragment != first) return false;
      ++tiles;
    }
  for (const Directions& cone : c.empty)
    if (strictly_inside(cone, d)) {
      if (first != nothing) return false;
      ++tiles;
    }
  return tiles == 1;
}
Exact_point random_direction(Dice& dice) {
  return at(roll(dice, -999999937, 999999937), roll(dice, -999999937, 999999937), roll(dice, -999999937, 999999937));
}

constexpr unsigned sight_count = 100;
const Sight& sight_of(unsigned seed) {
  static const std::vector<Sight> sights = [] {
    std::vector<Sight> all;
    for (unsigned k = 0; k < sight_count; ++k) {
      Dice dice(k);
      all.push_back(random_sight(dice));
    }
    return all;
  }();
  return sights[seed % sight_count];
}

TEST(Visible_by_cutting, is_accepted_and_right_in_directions_at_random) {
  std::size_t parts = 0, empty = 0, fields = 0;
  for (unsigned seed = 0; seed < test_scenes::sample(sight_count); ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    const Sight& sight = sight_of(seed);
    expect_accepted(sight);
    for (int k = 0; k < test_scenes::sample(10); ++k) EXPECT_TRUE(right_in(sight, random_direction(dice)));
    parts += sight.certificate.parts.size();
    empty += sight.certificate.empty.size();
    fields += !sight.certificate.field.empty();
  }
  EXPECT_GT(parts, test_scenes::least(500u));
  EXPECT_GT(empty, test_scenes::least(500u));
  EXPECT_GT(fields, test_scenes::least(20u));
}

// ---- Damage

TEST(Visible_by_cutting, other_ways_to_say_the_same_are_accepted) {
  for (unsigned seed = 0; seed < sight_count; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    Sight sight = sight_of(seed);
    auto& c = sight.certificate;
    std::shuffle(c.parts.begin(), c.parts.end(), dice);
    std::shuffle(c.empty.begin(), c.empty.end(), dice);
    for (Directions& cone : c.empty) {
      if (roll(dice, 0, 1)) cone = reversed(cone);
      std::rotate(cone.begin(), cone.begin() + 1, cone.end());
      for (Exact_point& d : cone) d = plus(at(0, 0, 0), ratio(roll(dice, 1, 9), roll(dice, 1, 9)), d);
      if (roll(dice, 0, 1))
        cone.push_back(plus(cone.back(), ratio(roll(dice, 1, 9), 4), cone.front()));  // a straight corner
    }
    for (auto& part : c.parts) {
      part.ray = at(0, 0, 0);
      for (const Exact_point& d : cone_of(part, c.eye)) part.ray = plus(part.ray, ratio(roll(dice, 1, 100), 7), d);
      std::rotate(part.vertices.begin(), part.vertices.begin() + 1, part.vertices.end());
      if (roll(dice, 0, 1))
        part.vertices.push_back(plus(part.vertices.back(), ratio(roll(dice, 1, 8), 9),
                                     plus(part.vertices.front(), -1, part.vertices.back())));
    }
    if (!c.parts.empty()) {  // a part in two, by a plane through a direction inside it
      const auto part = c.parts.back();
      const Directions cone = cone_of(part, c.eye);
      const Seen piece(c.fragments[part.fragment], c.eye);
      c.parts.pop_back();
      for (const Directions& half : halves(cone, cross(part.ray, random_direction(dice)))) {
        Points vertices;
        for (const Exact_point& d : half) vertices.push_back(plus(c.eye, 1 / dot(piece.nearness, d), d));
        c.parts.push_back({part.fragment, vertices, sum(half)});
      }
    }
    expect_accepted(sight);
  }
}

TEST(Visible_by_cutting, damage_is_rejected) {
  std::array<std::size_t, 14> done{};
  const std::array<std::string, 14> reasons = {"do not cancel",
                                               "do not cancel",
                                               "do not cancel",
                                               "do not cancel",
                                               "",
                                               "in it",
                                               "ray strictly inside",
                                               "ray strictly inside",
                                               "",
                                               "off the plane",
                                               "do not cancel",
                                               "do not cancel",
                                               "",
                                               "clockwise"};
  const unsigned rounds = test_scenes::is_sanitized() ? 300 : 2000;
  for (unsigned seed = 0; seed < rounds; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    Sight sight = sight_of(seed);
    auto& c = sight.certificate;
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(dice() % n); };
    const auto at_place = [&](auto& list, std::size_t k) { return list.begin() + static_cast<std::ptrdiff_t>(k); };
    const Rational hair = roll(dice, 0, 1) ? tiny(60) : ratio(roll(dice, 1, 9), 10);
    const std::size_t kind = below(14);
    const bool of_empty = kind == 1 || kind == 3 || kind == 10;
    if ((of_empty ? c.empty.empty() : c.parts.empty()) || (kind == 11 && c.field.empty())) continue;
    const std::size_t place = below(of_empty ? c.empty.size() : c.parts.size());
    if (kind == 0) c.parts.erase(at_place(c.parts, place));
    if (kind == 1) c.empty.erase(at_place(c.empty, place));
    if (kind == 2) c.parts.push_back(c.parts[place]);
    if (kind == 3) c.empty.push_back(c.empty[place]);
    if (kind ==
        4) {  // a corner moves outwards, inside the plane: out of its piece, behind another, or over another part
      auto& vertices = c.parts[place].vertices;
      const Exact_point middle = plus(at(0, 0, 0), ratio(1, static_cast<long>(vertices.size())), sum(vertices));
      Exact_point& corner = vertices[below(vertices.size())];
      corner = plus(corner, hair, plus(corner, -1, middle));
    }
    if (kind == 5) {
      c.empty.push_back(cone_of(c.parts[place], c.eye));
      c.parts.erase(at_place(c.parts, place));
    }
    if (kind == 6) {  // onto the boundary, or out of it by a hair
      const Directions cone = cone_of(c.parts[place], c.eye);
      const std::size_t k = below(cone.size());
      c.parts[place].ray = plus(plus(cone[k], ratio(roll(dice, 0, 9), 3), cone[(k + 1) % cone.size()]),
                                roll(dice, 0, 1) ? Rational(0) : Rational(-hair), sum(cone));
    }
    if (kind == 7) {
      const std::size_t other = below(c.parts.size());
      if (other == place) continue;
      c.parts[place].ray = c.parts[other].ray;
    }
    if (kind == 8) {  // another piece: off its plane, outside, behind, or not preferred
      if (c.fragments.size() < 2) continue;
      std::size_t& own = c.parts[place].fragment;
      own = (own + 1 + below(c.fragments.size() - 1)) % c.fragments.size();
    }
    if (kind == 9)
      c.parts[place].vertices[0] = plus(c.parts[place].vertices[0], hair, plus(c.eye, -1, c.parts[place].vertices[0]));
    if (kind == 10) {
      Directions& cone = c.empty[place];
      cone[0] = plus(cone[0], hair, cone[1]);
    }
    if (kind == 11) c.field[0] = plus(c.field[0], hair, c.field[1]);
    if (kind == 12) c.eye = plus(c.eye, hair, at(roll(dice, -3, 3), roll(dice, -3, 3), 5));
    if (kind == 13) c.parts[place].vertices = reversed(c.parts[place].vertices);
    const Verdict verdict = sight.verdict();
    EXPECT_EQ(verdict.why.find('\n'), std::string::npos);
    if (kind == 12 && verdict.accepted) {  // harmless where all that is seen is whole faces
      for (int k = 0; k < 20; ++k) EXPECT_TRUE(right_in(sight, random_direction(dice)));
      continue;
    }
    EXPECT_FALSE(verdict.accepted) << "kind " << kind;
    EXPECT_NE(verdict.why.find(reasons[kind]), std::string::npos) << "kind " << kind << ": " << verdict.why;
    ++done[kind];
  }
  for (std::size_t kind = 0; kind < 14; ++kind) EXPECT_GT(done[kind], rounds / 200) << kind;
  EXPECT_GT(std::accumulate(done.begin(), done.end(), std::size_t{0}), rounds / 2);
}

TEST(Visible_by_cutting, pieces_of_one_face_in_one_plane_go_by_their_number) {
  // A walk, simple along no axis: of the cone from its least point the first and the last triangle lie in one plane and
  // overlap; between them it leaves the plane.
  const Points corner = {at(-1, -1, 1), at(4, 0, 1), at(0, 4, 1), at(9, 9, 5), at(5, 1, 1), at(1, 5, 1)};
  const std::vector<std::array<std::size_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  for (const bool swapped : {false, true}) {
    Sight sight;
    sight.from(at(0, 0, 0));
    std::vector<Point_id> ids;
    for (const Exact_point& p : corner) ids.push_back(sight.soup.add_point(p[0], p[1], p[2]));
    sight.soup.add_face(ids);
    for (std::uint32_t k = 0; k < 4; ++k) {
      const Points piece = {corner[triangles[k][0]], corner[triangles[k][1]], corner[triangles[k][2]]};
      sight.certificate.fragments.push_back({0, k, piece});
      sight.certificate.pieces.push_back({0, k, piece});
    }
    fill(sight);
    if (swapped)
      for (auto* list : {&sight.certificate.fragments[0].piece, &sight.certificate.fragments[3].piece,
                         &sight.certificate.pieces[0].piece, &sight.certificate.pieces[3].piece})
        *list = 3 - *list;
    if (!swapped) expect_accepted(sight);
    else
      EXPECT_NE(sight.verdict().why.find("is as far as face 0 somewhere, which is preferred"), std::string::npos)
          << sight.verdict().why;
  }
}

// ---- Parts by rays

TEST(Visible, parts_by_rays_that_are_none) {
  const Sight good = by_rays(one_triangle());
  expect_accepted(good);
  const auto with = [&](const std::vector<std::uint32_t>& rays, const Exact_point& more) {
    Sight sight = good;
    sight.certificate.parts[0].rays = rays;
    sight.certificate.rays.push_back(more);
    return sight;
  };
  expect_accepted(with({2, 1, 0}, {}));
  expect_accepted(with({2, 1, 3}, at(7, 0, 0)));
  expect_rejected(with({0, 1, 4}, {}), "part 0 (face 0) names ray 4, which there is not", {0});
  expect_rejected(with({0, 1}, {}), "part 0 (face 0) has fewer than three directions");
  expect_rejected(with({0, 1, 3}, at(0, 0, 0)), "part 0 (face 0) has a direction that is zero");
  expect_rejected(with({0, 1, 1, 2}, {}), "part 0 (face 0) has a repeated vertex");
  expect_rejected(with({0, 1, 3}, at(0, 0, -1)), "part 0 (face 0) is not inside its piece", {0});
  expect_rejected(with({0, 1, 3}, at(-1, -1, 1)), "part 0 (face 0) is not inside its piece", {0});
  expect_rejected(with({0, 1, 3}, at(1, 1, 1)), "boundaries do not cancel");
  Sight unreduced = with({0, 1, 3}, {});
  mpq_set_si(unreduced.certificate.rays[3][2].get_mpq_t(), 2, 2);
  expect_rejected(unreduced, "part 0 (face 0) has a direction that is not in canonical numbers");
}

// ---- JSON

Visible_certificate read_visible(const std::string& text) {
  std::istringstream in(text);
  return std::get<Visible_certificate>(read_certificate(in));
}
nlohmann::ordered_json json_of(const Visible_certificate& certificate) {
  return nlohmann::ordered_json::parse(certificate_text(certificate));
}
std::string fault_of_visible(const std::string& text) {
  try {
    read_visible(text);
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "nothing";
}

TEST(Visible_json, what_is_written_is_read_back) {
  std::size_t with_field = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Dice dice(seed);
    const Sight sight = random_sight(dice);
    const auto& c = sight.certificate;
    const Visible_certificate rays = by_rays(sight).certificate;
    EXPECT_EQ(certificate_text(read_visible(certificate_text(rays))), certificate_text(rays));
    EXPECT_EQ(read_visible(nlohmann::json::parse(certificate_text(rays)).dump()).rays, rays.rays) << "sorted by name";
    const Visible_certificate again = read_visible(certificate_text(c));
    EXPECT_EQ(again.eye, c.eye);
    EXPECT_EQ(again.field, c.field);
    EXPECT_EQ(again.empty, c.empty);
    ASSERT_EQ(again.parts.size(), c.parts.size());
    for (std::size_t k = 0; k < c.parts.size(); ++k) {
      EXPECT_EQ(again.parts[k].fragment, c.parts[k].fragment);
      EXPECT_EQ(again.parts[k].vertices, c.parts[k].vertices);
      EXPECT_EQ(again.parts[k].ray, c.parts[k].ray);
    }
    EXPECT_EQ(certificate_text(again), certificate_text(c));
    EXPECT_TRUE(verify_visible(sight.soup, again).accepted);
    EXPECT_EQ(json_of(c).contains("field"), !c.field.empty());
    with_field += !c.field.empty();
  }
  EXPECT_GT(with_field, 0u);
}

TEST(Visible_json, has_the_documented_keys) {
  Sight sight = one_triangle();
  sight.within(octant(0));
  const nlohmann::ordered_json json = json_of(sight.certificate);
  EXPECT_EQ(json["format"], "sightline see 2");
  EXPECT_EQ(json["eye"], (nlohmann::ordered_json{"0", "0", "0"}));
  EXPECT_EQ(json["field"][1], (nlohmann::ordered_json{"0", "1", "0"}));
  EXPECT_EQ(json["fragments"][0]["piece"], 0);
  EXPECT_EQ(json["parts"][0]["fragment"], 0);
  EXPECT_EQ(json["parts"][0]["vertices"][2], (nlohmann::ordered_json{"0", "0", "1"}));
  EXPECT_EQ(json["parts"][0]["ray"], (nlohmann::ordered_json{"1", "1", "1"}));
  EXPECT_EQ(json["empty"][0][0], (nlohmann::ordered_json{"-1", "0", "0"}));
  EXPECT_TRUE(json_of(Visible_certificate{})["empty"].is_array());
  EXPECT_TRUE(json_of(Visible_certificate{})["parts"].is_array());
}

TEST(Visible_json, faults_are_named_with_their_place) {
  const std::string head =
      R"({"format":"sightline see 1","eye":["0","0","0"],"fragments":[{"face":0,"piece":0,"vertices":[]}],)";
  EXPECT_EQ(fault_of_visible(head + R"("parts":[],"empty":[]})"), "nothing");
  EXPECT_EQ(fault_of_visible(head + R"("field":[],"parts":[],"empty":[[]],"more":1})"), "nothing");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {R"({"format":"sightline see 1"})", "no \"eye\""},
      {R"({"format":"sightline see 1","eye":["0","0"]})", "eye: expected three numbers"},
      {R"({"format":"sightline see 1","eye":["0","0","0"],"parts":[],"empty":[]})", "no \"fragments\""},
      {head + R"("empty":[]})", "no \"parts\""},
      {head + R"("parts":[]})", "no \"empty\""},
      {head + R"("parts":{},"empty":[]})", "parts: expected an array"},
      {head + R"("parts":[1],"empty":[]})", "parts[0]: expected an object"},
      {head + R"("parts":[{"vertices":[],"ray":["0","0","1"]}],"empty":[]})", "parts[0]: no \"fragment\""},
      {head + R"("parts":[{"fragment":1,"vertices":[],"ray":["0","0","1"]}],"empty":[]})",
       "parts[0].fragment: expected a number below 1"},
      {head + R"("parts":[{"fragment":-1,"vertices":[],"ray":["0","0","1"]}],"empty":[]})",
       "parts[0].fragment: expected an integer"},
      {head + R"("parts":[{"fragment":0,"ray":["0","0","1"]}],"empty":[]})", "parts[0]: no \"vertices\""},
      {head + R"("parts":[{"fragment":0,"vertices":[]}],"empty":[]})", "parts[0]: no \"ray\""},
      {head + R"("parts":[{"fragment":0,"vertices":[["0"]],"ray":["0","0","1"]}],"empty":[]})",
       "parts[0].vertices[0]: expected three numbers"},
      {head + R"("parts":[{"fragment":0,"vertices":[],"ray":["0","0",1]}],"empty":[]})",
       "parts[0].ray: expected exact numbers as strings"},
      {head + R"("parts":[{"fragment":0,"vertices":[],"ray":["0","0","1/0"]}],"empty":[]})",
       "parts[0].ray: zero denominator"},
      {head + R"("parts":[],"empty":7})", "empty: expected an array"},
      {head + R"("parts":[],"empty":[7]})", "empty[0]: expected an array"},
      {head + R"("parts":[],"empty":[[["0","0","1"],["0","0"]]]})", "empty[0][1]: expected three numbers"},
      {head + R"("field":7,"parts":[],"empty":[]})", "field: expected an array"},
      {head + R"("field":[["1","0","x"]],"parts":[],"empty":[]})", "field[0]: not a number"},
  };
  for (const auto& [text, words] : cases)
    EXPECT_NE(fault_of_visible(text).find(words), std::string::npos) << text << " -> " << fault_of_visible(text);
  const std::string rays =
      head + R"("rays":[["1","0","0"],["0","1","0"],["0","0","1"]],"parts":[{"fragment":0,"rays":)";
  EXPECT_EQ(fault_of_visible(rays + R"([0,1,2]}],"empty":[[2,1,["-1","0","0"]]]})"), "nothing");
  const std::vector<std::pair<std::string, std::string>> more = {
      {R"([0,1]}],"empty":[]})", "parts[0].rays: expected three or more numbers"},
      {R"(7}],"empty":[]})", "parts[0].rays: expected an array"},
      {R"([0,1,3]}],"empty":[]})", "parts[0].rays[2]: expected a number below 3, the size of \"rays\""},
      {R"([0,1,-3]}],"empty":[]})", "parts[0].rays[2]: expected an integer"},
      {R"([0,1,["0","0","1"]]}],"empty":[]})", "parts[0].rays[2]: expected an integer"},
      {R"([0,1,2],"ray":["1","1","1"]}],"empty":[]})",
       "parts[0]: expected either \"rays\", or \"vertices\" and \"ray\""},
      {R"([0,1,2]}],"empty":[[0,1,5]]})", "empty[0][2]: expected a number below 3, the size of \"rays\""},
  };
  for (const auto& [text, words] : more)
    EXPECT_NE(fault_of_visible(rays + text).find(words), std::string::npos) << fault_of_visible(rays + text);
  EXPECT_EQ(fault_of_visible(head + R"("parts":[{"fragment":0,"rays":[0,1,2]}],"empty":[]})"),
            "certificate: parts[0].rays[0]: is a number, but there is no table \"rays\"");
}

}  // namespace
