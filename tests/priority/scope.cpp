// Scopes against eyes: a region's arcs by separating planes, witnesses by sampling, and answers by hand.

#include "../sample.h"
#include "support.h"

#include <sightline/algorithms/priority/implicit_graph.h>
#include <sightline/algorithms/priority/scope.h>

#include <stdexcept>

using namespace priority_test;

namespace {

using test_scenes::least;
using test_scenes::sample;

using Region = Region_relation<Exact_traits>;
using Ray = Ray_relation<Exact_traits>;
static_assert(Priority_graph<Implicit_priority_graph<Region>> && Priority_graph<Implicit_priority_graph<Ray>>);

Matrix from(const Related& scene, const View_region& region) { return asked(Region(scene.relation, region)); }

/// may_obscure and arcs say the same.
template <class Relation>
testing::AssertionResult consistent(const Relation& relation) {
  Relation_counters counters;
  for (std::uint32_t i = 0; i < relation.size(); ++i)
    for (std::uint32_t j = 0; j < relation.size(); ++j) {
      const Arcs both = relation.arcs(i, j, counters);
      if (both.forth != relation.may_obscure(i, j, counters) || both.back != relation.may_obscure(j, i, counters))
        return testing::AssertionFailure() << "arcs(" << i << ", " << j << ")";
    }
  return testing::AssertionSuccess();
}

// ---- An oracle: no plane separates
// ---------------------------------------------------------------------------------------------- Let A be the part of a
// in front of b's plane, B the part of b behind a's. The eyes that may see a before b are A + t (A - B), t > 0: the
// inside of Q = conv A + cone {a - b}. A convex region R has none of them iff some plane separates R from Q: iff some n
// != 0 has n . (a - p) >= 0 for all corners a of A and points p of R, and n . (a - b) >= 0 for all corners a and b.
// Such an n is looked for by brute force: if there is one, there is one orthogonal to two of the vectors (or to all).

/// The closed part of a convex polygon in front of a plane.
Points part_in_front(const Points& polygon, const Flat& plane, int side) {
  Points part;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Exact_point &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const Rational here = side * plane.height(p), next = side * plane.height(q);
    if (here >= 0) part.push_back(p);
    if (sgn(here) * sgn(next) < 0) part.push_back(along(p, here / (here - next), minus(q, p)));
  }
  return part;
}

using Direction_vector = std::array<Integer, 3>;

/// Whether some n != 0 has n . v >= 0 for all vectors. Pre: not all vectors are parallel, and Number holds 12 times the
/// cube of a coordinate.
template <class Number>
bool in_a_closed_half_space(const std::vector<std::array<Number, 3>>& vectors) {
  for (std::size_t i = 0; i < vectors.size(); ++i)
    for (std::size_t j = i + 1; j < vectors.size(); ++j) {
      const std::array<Number, 3>&u = vectors[i], &v = vectors[j];
      const std::array<Number, 3> n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
      if (n[0] == 0 && n[1] == 0 && n[2] == 0) continue;
      bool front = false, behind = false;
      for (std::size_t k = 0; k < vectors.size() && !(front && behind); ++k) {
        const Number side = n[0] * vectors[k][0] + n[1] * vectors[k][1] + n[2] * vectors[k][2];
        front |= side > 0;
        behind |= side < 0;
      }
      if (!(front && behind)) return true;
    }
  return false;
}
bool in_a_closed_half_space(const std::set<Direction_vector>& vectors) {
  std::vector<std::array<__int128, 3>> small;
  for (const Direction_vector& v : vectors) {
    if (bit_length(v[0]) > 40 || bit_length(v[1]) > 40 || bit_length(v[2]) > 40)
      return in_a_closed_half_space(std::vector<Direction_vector>(vectors.begin(), vectors.end()));
    small.push_back({v[0].get_si(), v[1].get_si(), v[2].get_si()});
  }
  return in_a_closed_half_space(small);
}

bool arc_from(const Flat& a, const Flat& b, const Points& region) {
  if (region.empty() || !arcs_of(Flats{a, b})[0][1]) return false;
  std::set<Direction_vector> vectors;
  const auto add = [&](Exact_point v) {  // the shortest integer vector in its direction
    const Integer common = lcm(lcm(v[0].get_den(), v[1].get_den()), v[2].get_den());
    Direction_vector w;
    for (std::size_t k = 0; k < 3; ++k) w[k] = Rational(v[k] * common).get_num();
    const Integer divisor = gcd(gcd(w[0], w[1]), w[2]);
    if (sgn(divisor) == 0) return;
    for (Integer& x : w) x /= divisor;
    vectors.insert(w);
  };
  for (const Exact_point& p : part_in_front(a.corners, b, 1)) {
    for (const Exact_point& q : part_in_front(b.corners, a, -1)) add(minus(p, q));
    for (const Exact_point& q : region) add(minus(p, q));
  }
  return !in_a_closed_half_space(vectors);
}

Matrix arcs_from(const Flats& flats, const Points& region) {
  Matrix arcs(flats.size(), std::vector<char>(flats.size(), 0));
  for (std::size_t i = 0; i < flats.size(); ++i)
    for (std::size_t j = 0; j < flats.size(); ++j) arcs[i][j] = i != j && arc_from(flats[i], flats[j], region);
  return arcs;
}

/// Where the ray from an eye strictly in front goes through the inside of a face.
std::optional<Rational> meets_front(const Flat& face, const Exact_point& eye, const Exact_point& direction) {
  if (face.height(eye) <= 0) return std::nullopt;
  const std::optional<Rational> t = face.crossing(eye, along(eye, 1, direction));
  if (!t || *t <= 0 || face.holds(along(eye, *t, direction)) != 1) return std::nullopt;
  return t;
}

/// A region near a scene where degeneracy is likely: a point, a segment, a triangle, a box, a box without width, or a
/// polyhedron, with corners on the lattice, on faces and in their planes, or where two planes of faces cross.
View_region random_region(const Related& scene, Random& random) {
  const auto corner = [&]() -> Exact_point {
    const Flat& face = scene.flats[random.below(scene.flats.size())];
    const Flat& other = scene.flats[random.below(scene.flats.size())];
    switch (random.below(5)) {
      case 0: return lattice_point(random, 4);
      case 1: return point_of(face.corners, random);
      case 2: return along(face.corners[0], random.between(-3, 3), minus(face.corners[1], face.corners[0]));
      case 3: return along(point_of(face.corners, random), random.between(0, 3), face.normal);
      default: {  // where a line between corners of two faces goes on: the boundary of what looks through them
        const Exact_point &p = face.corners[random.below(face.corners.size())],
                          &q = other.corners[random.below(other.corners.size())];
        return along(p, random.between(0, 2), minus(p, q));
      }
    }
  };
  View_region region;
  switch (random.below(6)) {
    case 0: return View_region::eye(corner());
    case 1:
    case 2: {
      const Exact_point p = corner(), q = corner();
      Exact_point low, high;
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(p[k], q[k]);
        high[k] = std::max(p[k], q[k]);
      }
      return View_region::box(low, high);
    }
    default:
      for (std::size_t count = 2 + random.below(4); count > 0; --count) region.points.push_back(corner());
  }
  return region;
}

/// Scenes of at least one face; few of them moved, for the oracle's sake.
Related random_scene(std::uint64_t k) {
  Random random(k + 300000);
  const Polygon_soup soup = random.chance(1, 4) ? random_soup(random, 5) : touching_soup(random);
  return Related(moved(soup, random.chance(1, 6) ? static_cast<Move>(random.below(5)) : Move::none, k));
}

TEST(Scope, of_a_region_has_the_arcs_whose_eyes_no_plane_separates_from_it) {
  std::size_t present = 0, absent = 0;
  for (std::uint64_t k = 0; k < sample(160u); ++k) {
    Random random(k);
    const Related scene = random_scene(k);
    if (scene.flats.empty()) continue;
    const std::size_t whole = count_arcs(arcs_of(scene.flats));
    for (int repeat = 0; repeat < 2; ++repeat) {
      const View_region region = random_region(scene, random);
      const Region relation(scene.relation, region);
      const Matrix found = asked(relation);
      ASSERT_TRUE(same_arcs(found, arcs_from(scene.flats, region.points)))
          << "scene " << k << ", region " << repeat << " of " << region.points.size() << " points";
      if (repeat == 0) {
        ASSERT_TRUE(consistent(relation)) << "scene " << k;
      }
      for (std::uint32_t i = 0; i < found.size(); ++i) {
        const bool seen = std::any_of(region.points.begin(), region.points.end(),
                                      [&](const Exact_point& p) { return scene.flats[i].height(p) > 0; });
        ASSERT_EQ(relation.on_view(i), seen) << "scene " << k << ", face " << i;
      }
      present += count_arcs(found);
      absent += whole - count_arcs(found);
    }
  }
  EXPECT_GT(present, least(1000u));
  EXPECT_GT(absent, least(1000u)) << "arcs of the whole relation that the region has not";
}

TEST(Scope, of_a_region_has_every_arc_of_which_a_random_eye_and_ray_are_found) {
  std::size_t witnesses = 0, proven = 0, arcs = 0;
  for (std::uint64_t k = 0; k < sample(200u); ++k) {
    Random random(k);
    const Related scene = random_scene(k + 1000);
    if (scene.flats.size() < 2) continue;
    const View_region region = random_region(scene, random);
    const Matrix found = from(scene, region);
    Matrix met(found.size(), std::vector<char>(found.size(), 0));
    for (int sample = 0; sample < 200; ++sample) {
      const Exact_point eye = point_of(region.points, random);
      const Exact_point target = inside_of(scene.flats[random.below(found.size())].corners, random),
                        direction = minus(target, eye);
      std::vector<std::optional<Rational>> at_parameter;
      for (const Flat& face : scene.flats)
        at_parameter.push_back(direction == Exact_point{0, 0, 0} ? std::nullopt : meets_front(face, eye, direction));
      for (std::size_t i = 0; i < found.size(); ++i)
        for (std::size_t j = 0; j < found.size(); ++j)
          if (at_parameter[i] && at_parameter[j] && *at_parameter[i] < *at_parameter[j]) {
            ASSERT_TRUE(found[i][j]) << "scene " << k << ": " << i << " before " << j;
            met[i][j] = 1;
            ++witnesses;
          }
    }
    proven += count_arcs(met);
    arcs += count_arcs(found);
  }
  EXPECT_GT(witnesses, least(1000u));
  EXPECT_GT((test_scenes::is_sanitized() ? 3 : 2) * proven, arcs) << "most arcs are met";
}

// ---- Laws

TEST(Scope, smaller_regions_have_fewer_arcs_down_to_eyes_and_rays) {
  std::array<std::size_t, 5> arcs{};
  for (std::uint64_t k = 0; k < sample(200u); ++k) {
    Random random(k);
    const Related scene = random_scene(k + 2000);
    if (scene.flats.empty()) continue;
    View_region larger = random_region(scene, random), smaller;
    while (larger.points.size() < 3) larger = random_region(scene, random);
    for (int points = 0; points < 3; ++points) smaller.points.push_back(point_of(larger.points, random));
    const Exact_point eye = point_of(smaller.points, random);
    const std::array<Matrix, 4> scopes{asked(scene.relation), from(scene, larger), from(scene, smaller),
                                       from(scene, View_region::eye(eye))};
    for (std::size_t s = 0; s < 4; ++s) {
      arcs[s] += count_arcs(scopes[s]);
      if (s > 0) {
        ASSERT_TRUE(part_of(scopes[s], scopes[s - 1])) << "scene " << k << ", scope " << s;
      }
    }
    Matrix rays(scene.flats.size(), std::vector<char>(scene.flats.size(), 0));
    for (const Flat& face : scene.flats) {
      const Exact_point direction = minus(inside_of(face.corners, random), eye);
      if (direction == Exact_point{0, 0, 0}) continue;
      const Matrix ray = asked(Ray(scene.relation, eye, direction));
      ASSERT_TRUE(part_of(ray, scopes[3])) << "scene " << k << ", a ray";
      for (std::size_t i = 0; i < rays.size(); ++i)
        for (std::size_t j = 0; j < rays.size(); ++j) rays[i][j] = static_cast<char>(rays[i][j] | ray[i][j]);
    }
    arcs[4] += count_arcs(rays);
  }
  for (std::size_t s = 1; s < 5; ++s) {
    EXPECT_LT(arcs[s], arcs[s - 1]);
    EXPECT_GT(arcs[s], least(30u)) << s;
  }
}

TEST(Scope, of_a_box_three_times_as_far_as_the_scene_is_the_whole_relation) {
  // If a point p of one face may hide a point q of another, then it does from p + (p - q), which is at most three times
  // as far from the centre.
  std::size_t arcs = 0;
  for (std::uint64_t k = 0; k < sample(150u); ++k) {
    Random random(k + 7000);
    const Related scene(touching_soup(random));
    Rational reach = 1;
    for (const Flat& face : scene.flats)
      for (const Exact_point& p : face.corners)
        for (const Rational& x : p) reach = std::max(reach, Rational(abs(x)));
    reach *= 3;
    const Matrix whole = asked(scene.relation),
                 box = from(scene, View_region::box(at(-reach, -reach, -reach), at(reach, reach, reach)));
    ASSERT_TRUE(same_arcs(box, whole)) << "scene " << k;
    arcs += count_arcs(whole);
  }
  EXPECT_GT(arcs, least(1000u));
}

TEST(Scope, repeated_points_and_points_inside_change_no_region) {
  std::size_t arcs = 0;
  for (std::uint64_t k = 0; k < sample(100u); ++k) {
    Random random(k);
    const Related scene = random_scene(k + 3000);
    if (scene.flats.empty()) continue;
    const View_region region = random_region(scene, random);
    View_region more = region;
    more.points.push_back(point_of(region.points, random));
    more.points.push_back(region.points[random.below(region.points.size())]);
    std::reverse(more.points.begin(), more.points.end());
    const Matrix arcs_of_it = from(scene, region);
    ASSERT_TRUE(same_arcs(from(scene, more), arcs_of_it)) << "scene " << k;
    arcs += count_arcs(arcs_of_it);
  }
  EXPECT_GT(arcs, least(100u));
}

TEST(Scope, graphs_of_regions_and_rays_have_the_components_of_the_closure) {
  std::size_t cyclic = 0, arcs = 0;
  for (std::uint64_t k = 0; k < sample(150u); ++k) {
    Random random(k);
    const Related scene = random_scene(k + 4000);
    if (scene.flats.empty()) continue;
    const auto check = [&](const auto& relation) {
      const Matrix expected = asked(relation);
      const Explicit_priority_graph written(relation);
      Implicit_priority_graph<std::remove_cvref_t<decltype(relation)>> searched(relation);
      Component_trees trees;
      ASSERT_EQ(written.arc_count(), count_arcs(expected)) << "scene " << k;
      ASSERT_TRUE(right_components(components(written), expected)) << "scene " << k;
      const Priority_components found = searched.find_components(&trees);
      ASSERT_TRUE(right_components(found, expected)) << "scene " << k;
      for (std::uint32_t face = 0; face < expected.size(); ++face) {
        ASSERT_TRUE(trees.from[face] == face || expected[trees.from[face]][face]) << "scene " << k;
        ASSERT_TRUE(trees.to[face] == face || expected[face][trees.to[face]]) << "scene " << k;
      }
      cyclic += found.cyclic();
      arcs += written.arc_count();
    };
    check(Region(scene.relation, random_region(scene, random)));
    const Exact_point eye = lattice_point(random, 5), direction = minus(inside_of(scene.flats[0].corners, random), eye);
    if (direction != Exact_point{0, 0, 0}) check(Ray(scene.relation, eye, direction));
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(arcs, least(500u));
  EXPECT_GT(cyclic, least(10u));
}

// ---- Rays

TEST(Scope, of_a_ray_has_the_faces_that_it_goes_through_in_their_order) {
  std::size_t pierced = 0, missed = 0, arcs = 0;
  for (std::uint64_t k = 0; k < sample(1000u); ++k) {
    Random random(k);
    const Related scene(degenerate_soup(k + 300000));
    if (scene.flats.empty()) continue;
    for (int sample = 0; sample < 6; ++sample) {
      // From anywhere, a face's plane too, towards an inside, an edge or a corner of a face, or away from it.
      const Points &here = scene.flats[random.below(scene.flats.size())].corners,
                   &there = scene.flats[random.below(scene.flats.size())].corners;
      const Exact_point target = random.chance(1, 2) ? inside_of(there, random) : point_of(there, random);
      const Exact_point eye =
          along(point_of(here, random), ratio(random.between(-1, 6), 2), minus(point_of(here, random), target));
      Exact_point direction = minus(target, eye);
      if (direction == Exact_point{0, 0, 0}) continue;
      if (random.chance(1, 8)) direction = minus(eye, target);
      const Ray relation(scene.relation, eye, direction);
      std::vector<std::optional<Rational>> expected;
      for (const Flat& face : scene.flats) expected.push_back(meets_front(face, eye, direction));
      const Matrix found = asked(relation);
      ASSERT_TRUE(consistent(relation)) << "scene " << k;
      for (std::uint32_t i = 0; i < expected.size(); ++i) {
        ASSERT_EQ(relation.parameter(i).has_value(), expected[i].has_value()) << "scene " << k << ", face " << i;
        if (expected[i]) {
          ASSERT_EQ(*relation.parameter(i), *expected[i]) << "scene " << k << ", face " << i;
        }
        ++(expected[i] ? pierced : missed);
        for (std::uint32_t j = 0; j < expected.size(); ++j) {
          const bool arc = expected[i] && expected[j] && *expected[i] < *expected[j];
          ASSERT_EQ(found[i][j] != 0, arc) << "scene " << k << ": " << i << ", " << j;
          arcs += arc;
        }
      }
    }
  }
  EXPECT_GT(pierced, least(2000u));
  EXPECT_GT(missed, least(2000u));
  EXPECT_GT(arcs, least(500u));
}

/// Unit squares at heights 1 and 0, fronts up: the upper one, 0, may obscure the lower one, 1.
Polygon_soup two_squares() { return soup_of({rectangle(0, 1, 0, 1, 1), rectangle(0, 1, 0, 1, 0)}); }
const Matrix no_arcs{{0, 0}, {0, 0}}, upper_first{{0, 1}, {0, 0}};

TEST(Scope, of_a_ray_needs_a_direction) {
  const Related scene(two_squares());
  EXPECT_THROW(Ray(scene.relation, at(0, 0, 2), at(0, 0, 0)), std::domain_error);
}

TEST(Scope, of_a_ray_through_an_edge_along_a_face_or_from_behind_has_no_arc) {
  const Related scene(two_squares());
  const Rational half = ratio(1, 2);
  const auto along_ray = [&](const Exact_point& eye, const Exact_point& direction) {
    return asked(Ray(scene.relation, eye, direction));
  };
  EXPECT_EQ(along_ray(at(half, half, 3), at(0, 0, -1)), upper_first);
  EXPECT_EQ(along_ray(at(half, half, 3), at(0, 0, -1000)), upper_first);
  EXPECT_EQ(along_ray(at(0, half, 3), at(0, 0, -1)), no_arcs) << "through edges";
  EXPECT_EQ(along_ray(at(1, 1, 3), at(0, 0, -1)), no_arcs) << "through corners";
  EXPECT_EQ(along_ray(at(0, half, 2), at(half, 0, -1)), no_arcs)
      << "through the middle of the upper one and an edge of the lower one";
  EXPECT_EQ(along_ray(at(0, half, 2), at(ratio(499, 1000), 0, -1)), upper_first);
  EXPECT_EQ(along_ray(at(half, half, 1), at(0, 0, -1)), no_arcs) << "from the plane of the upper one";
  EXPECT_EQ(along_ray(at(half, half, ratio(1, 2)), at(0, 0, -1)), no_arcs) << "from between them";
  EXPECT_EQ(along_ray(at(half, half, -1), at(0, 0, 1)), no_arcs) << "from behind";
  EXPECT_EQ(along_ray(at(half, half, 3), at(0, 0, 1)), no_arcs) << "away from them";
  EXPECT_EQ(along_ray(at(-1, half, 2), at(1, 0, 0)), no_arcs) << "parallel to them";
  EXPECT_EQ(along_ray(at(-1, half, 1), at(1, 0, 0)), no_arcs) << "in a face";
}

// ---- Regions by hand
// The eyes that may see the upper square before the lower one: at height 1 + t, t > 0, those with -t < x < 1 + t and -t
// < y < 1 + t.

TEST(Scope, of_one_viewpoint_has_the_arc_inside_the_set_of_eyes_and_not_on_its_boundary) {
  const Related scene(two_squares());
  const Rational half = ratio(1, 2), hair = exact(0x1p-60), million = 1000000;
  const auto eye = [&](const Rational& x, const Rational& y, const Rational& z) {
    return from(scene, View_region::eye(at(x, y, z)));
  };
  EXPECT_EQ(eye(half, half, 2), upper_first);
  EXPECT_EQ(eye(2, half, 2), no_arcs) << "on its boundary";
  EXPECT_EQ(eye(2 - hair, half, 2), upper_first);
  EXPECT_EQ(eye(2 + hair, half, 2), no_arcs);
  EXPECT_EQ(eye(-1, -1, 2), no_arcs) << "on its edge";
  EXPECT_EQ(eye(hair - 1, hair - 1, 2), upper_first);
  EXPECT_EQ(eye(half, half, 1), no_arcs) << "in the upper one's plane, on it";
  EXPECT_EQ(eye(5, half, 1), no_arcs) << "in the upper one's plane, beside it";
  EXPECT_EQ(eye(half, half, 1 + hair), upper_first);
  EXPECT_EQ(eye(1, 1, 1), no_arcs) << "at a corner";
  EXPECT_EQ(eye(half, half, half), no_arcs) << "between them";
  EXPECT_EQ(eye(half, half, 0), no_arcs) << "in the lower one's plane";
  EXPECT_EQ(eye(half, half, -2), no_arcs) << "behind both";
  EXPECT_EQ(eye(million, half, 2), no_arcs);
  EXPECT_EQ(eye(million, half, million), no_arcs) << "on its boundary, far away";
  EXPECT_EQ(eye(million, half, million + hair), upper_first);
}

TEST(Scope, of_a_viewpoint_close_to_two_large_faces_needs_planes_through_a_corner_of_each) {
  // From the origin both cones are almost half-spaces, one below and one above: often no plane through an edge of
  // either keeps them apart, but one through a corner of each does.
  Random random(11);
  std::size_t arcs = 0, whole = 0;
  for (int trial = 0; trial < sample(3000); ++trial) {
    const auto face = [&](const std::array<std::array<long, 2>, 3>& corners, int sign) {
      Points points;
      for (const auto& [x, y] : corners) {
        const long far = static_cast<long>(random.between(5, 200));
        points.push_back(at(far * x, far * y, sign * static_cast<long>(random.between(-3, 12))));
      }
      const Flat flat(points);
      return sgn(flat.height(at(0, 0, 0))) < 0 ? reversed(points) : points;
    };
    const Points below = face({{{4, 0}, {-2, 3}, {-2, -3}}}, -1), above = face({{{2, 3}, {-4, 0}, {2, -3}}}, 1);
    if (sgn(Flat(below).height(at(0, 0, 0))) == 0 || sgn(Flat(above).height(at(0, 0, 0))) == 0) continue;
    const Related scene(soup_of({below, above}));
    if (scene.flats.size() < 2) continue;
    const Matrix found = from(scene, View_region::eye(at(0, 0, 0)));
    ASSERT_TRUE(same_arcs(found, arcs_from(scene.flats, {at(0, 0, 0)}))) << trial;
    arcs += count_arcs(found);
    whole += count_arcs(arcs_of(scene.flats));
  }
  EXPECT_GT(arcs, least(100u));
  EXPECT_GT(whole, arcs + least(600u));
}

TEST(Scope, of_a_viewpoint_over_faces_of_thousands_of_corners_has_their_arc_in_time) {
  // Minutes where each plane through a corner of each looked at all corners of both.
  constexpr int n = 2000;
  std::vector<Points> faces(2);
  for (int z = 0; z < 2; ++z)
    for (int x = 0; x < n; ++x) faces[static_cast<std::size_t>(z)].push_back({x, x * x, z});
  const Related scene(generate::soup_of(faces));
  const Region region(scene.relation, View_region::eye({n / 2, n * n / 2, n}));
  Relation_counters counters;
  const Arcs arcs = region.arcs(0, 1, counters);
  EXPECT_FALSE(arcs.forth);
  EXPECT_TRUE(arcs.back);
}

TEST(Scope, of_a_viewpoint_before_a_face_of_thousands_of_corners_that_many_cross_has_both_arcs_in_time) {
  // Minutes where each pair took linear programs of a column for each corner.
  constexpr int n = 2000;
  const int walls = test_scenes::is_sanitized() ? 50 : 500;
  std::vector<Points> faces(1);
  for (int x = 0; x < n; ++x) faces[0].push_back({x, x * x, 0});
  for (int k = 1; k <= walls; ++k) {
    const int x = 2 * k, y = x * n / 2;
    faces.push_back({{x, y, -1}, {x, y + 1, -1}, {x, y + 1, 1}, {x, y, 1}});
  }
  const Related scene(generate::soup_of(faces));
  const Region region(scene.relation, View_region::eye({n, 0, n}));
  Relation_counters counters;
  for (std::uint32_t wall = 1; wall < faces.size(); ++wall) {
    const Arcs arcs = region.arcs(0, wall, counters);
    EXPECT_TRUE(arcs.forth && arcs.back) << wall;
  }
}

TEST(Scope, of_a_region_that_touches_the_set_of_eyes_only_in_its_boundary_has_no_arc) {
  const Related scene(two_squares());
  const Rational half = ratio(1, 2), hair = exact(0x1p-60);
  const auto box = [&](const Exact_point& low, const Exact_point& high) {
    return from(scene, View_region::box(low, high));
  };
  const auto hull = [&](const Points& points) { return from(scene, View_region{points}); };
  // Boxes.
  EXPECT_EQ(box(at(-9, -9, -9), at(9, 9, 1)), no_arcs) << "its top in the upper one's plane";
  EXPECT_EQ(box(at(-9, -9, -9), at(9, 9, 1 + hair)), upper_first);
  EXPECT_EQ(box(at(2, 0, 1), at(3, 1, 2)), no_arcs) << "an edge on the boundary";
  EXPECT_EQ(box(at(2 - hair, 0, 1), at(3, 1, 2)), upper_first);
  EXPECT_EQ(box(at(2, 0, 1), at(3, 1, 2 + hair)), upper_first);
  EXPECT_EQ(box(at(2, 2, 1), at(3, 3, 2)), no_arcs) << "a corner on an edge of the boundary";
  EXPECT_EQ(box(at(2, 2, 1), at(3, 3, 2 + hair)), upper_first);
  // A rectangle within a facet of the boundary, where x = z, and one that is turned through it.
  EXPECT_EQ(hull({at(1, 0, 1), at(3, 0, 3), at(3, 1, 3), at(1, 1, 1)}), no_arcs);
  EXPECT_EQ(hull({at(1 - hair, 0, 1), at(3 - hair, 0, 3), at(3 - hair, 1, 3), at(1 - hair, 1, 1)}), upper_first);
  EXPECT_EQ(hull({at(1, 0, 1), at(3, 0, 3), at(3 - hair, 1, 3), at(1, 1, 1)}), upper_first)
      << "one of its corners inside";
  // Segments: along a facet, through the set with both ends outside, and past it.
  EXPECT_EQ(hull({at(2, -5, 2), at(2, 5, 2)}), no_arcs);
  EXPECT_EQ(hull({at(2 - hair, -5, 2), at(2 - hair, 5, 2)}), upper_first);
  EXPECT_EQ(hull({at(-5, half, 2), at(5, half, 2)}), upper_first);
  EXPECT_EQ(hull({at(-5, -1, 2), at(5, -1, 2)}), no_arcs);
  EXPECT_EQ(hull({at(3, half, 1), at(3, half, 3)}), no_arcs);
  EXPECT_EQ(hull({at(3, half, 1), at(3, half, 3 + hair)}), upper_first);
  // A tetrahedron around a part of the set that holds none of its corners.
  EXPECT_EQ(hull({at(-50, -50, 2), at(50, -50, 2), at(0, 90, 2), at(0, 0, 3)}), upper_first);
  EXPECT_EQ(hull({at(-50, -50, -2), at(50, -50, -2), at(0, 90, -2), at(0, 0, 1)}), no_arcs)
      << "its top at a corner of the upper one";
}

TEST(Scope, of_a_degenerate_box_is_that_of_a_rectangle_a_segment_a_point_or_nothing) {
  const Related scene(two_squares());
  const auto size = [](long x, long y, long z) { return View_region::box(at(0, 0, 2), at(x, y, 2 + z)).points.size(); };
  EXPECT_EQ(size(1, 1, 1), 8u);
  EXPECT_EQ(size(1, 0, 1), 4u);
  EXPECT_EQ(size(0, 0, 1), 2u);
  EXPECT_EQ(size(0, 0, 0), 1u);
  EXPECT_EQ(size(-1, 1, 1), 0u);
  EXPECT_EQ(size(1, 1, -1), 0u);
  EXPECT_EQ(from(scene, View_region::box(at(0, 0, 2), at(1, 0, 3))), upper_first);
  EXPECT_EQ(from(scene, View_region::box(at(-3, -3, 2), at(-3, 3, 2))), no_arcs);
  EXPECT_EQ(from(scene, View_region::box(at(-3, -3, 2), at(-3, 3, 5))), upper_first);
  EXPECT_EQ(from(scene, View_region::box(at(0, 0, 2), at(0, 0, 2))), upper_first);
  EXPECT_EQ(from(scene, View_region::box(at(0, 0, 2), at(1, 1, 1))), no_arcs) << "low above high";
  const Region empty(scene.relation, View_region{});
  EXPECT_EQ(asked(empty), no_arcs);
  EXPECT_FALSE(empty.on_view(0) || empty.on_view(1));
}

TEST(Scope, of_a_region_between_two_faces_sees_one_of_them_and_of_one_that_both_cut_has_the_whole_relation) {
  const Related scene(two_squares());
  const Region between(scene.relation, View_region::box(at(0, 0, 0), at(1, 1, 1)));
  EXPECT_EQ(asked(between), no_arcs);
  EXPECT_FALSE(between.on_view(0)) << "all of the region is behind it or in its plane";
  EXPECT_TRUE(between.on_view(1));
  const Region cut(scene.relation, View_region::box(at(0, 0, -1), at(1, 1, 2)));
  EXPECT_EQ(asked(cut), upper_first);
  EXPECT_TRUE(cut.on_view(0) && cut.on_view(1));
  EXPECT_EQ(from(scene, View_region::box(at(-100, -100, -100), at(100, 100, -1))), no_arcs) << "beyond both";
  EXPECT_EQ(from(scene, View_region::box(at(10, 10, -100), at(100, 100, 3))), no_arcs) << "beside, not high enough";
  EXPECT_EQ(from(scene, View_region::box(at(10, 10, -100), at(100, 100, 11))), upper_first);
}

TEST(Scope, of_a_viewpoint_before_crossing_faces_has_both_arcs) {
  // A floor and a wall through its middle: what is above the floor and right of the wall sees either before the other.
  const Related scene(soup_of({rectangle(-1, 1, -1, 1, 0), {at(0, -1, -1), at(0, 1, -1), at(0, 1, 1), at(0, -1, 1)}}));
  const Matrix both{{0, 1}, {1, 0}};
  const auto eye = [&](long x, long z) { return from(scene, View_region::eye(at(x, 0, z))); };
  EXPECT_EQ(eye(5, 1), both);
  EXPECT_EQ(eye(1, 5), both);
  EXPECT_EQ(eye(-1, 1), no_arcs) << "behind the wall";
  EXPECT_EQ(eye(1, -1), no_arcs) << "below the floor";
  EXPECT_EQ(eye(0, 1), no_arcs) << "in the wall's plane";
  EXPECT_EQ(eye(0, 0), no_arcs) << "where they cross";
  EXPECT_EQ(from(scene, View_region::box(at(-5, -5, -5), at(0, 5, 5))), no_arcs) << "touches the quadrant";
  EXPECT_EQ(from(scene, View_region{{at(-1, 0, 5), at(5, 0, -1)}}), both)
      << "both ends see one face only, the middle sees both";
  EXPECT_EQ(from(scene, View_region{{at(-1, 0, 1), at(1, 0, -1)}}), no_arcs)
      << "passes through the corner of the quadrant";
  // A wall that stands on the floor is before the floor's left half, and never behind it.
  const Related standing(soup_of({rectangle(-1, 1, -1, 1, 0), {at(0, -1, 0), at(0, 1, 0), at(0, 1, 1), at(0, -1, 1)}}));
  const Matrix wall_first{{0, 0}, {1, 0}};
  EXPECT_EQ(from(standing, View_region::box(at(-9, -9, -9), at(9, 9, 9))), wall_first);
  EXPECT_EQ(from(standing, View_region::eye(at(1, 0, 2))), wall_first);
  EXPECT_EQ(from(standing, View_region::eye(at(1, 0, 1000))), wall_first);
  EXPECT_EQ(from(standing, View_region::eye(at(1, 0, 1))), wall_first);
}

TEST(Scope, of_a_region_in_front_of_one_face_of_three_has_its_arcs_only) {
  // A stack of three squares: from between the first and the second only what is below counts.
  const Related scene(soup_of({rectangle(0, 1, 0, 1, 2), rectangle(0, 1, 0, 1, 1), rectangle(0, 1, 0, 1, 0)}));
  EXPECT_EQ(asked(scene.relation), (Matrix{{0, 1, 1}, {0, 0, 1}, {0, 0, 0}}));
  EXPECT_EQ(from(scene, View_region::box(at(0, 0, 1), at(1, 1, 2))), (Matrix{{0, 0, 0}, {0, 0, 1}, {0, 0, 0}}));
  EXPECT_EQ(from(scene, View_region::box(at(0, 0, 0), at(1, 1, 1))), (Matrix{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}));
  EXPECT_EQ(from(scene, View_region::box(at(0, 0, 1), at(1, 1, 3))), (Matrix{{0, 1, 1}, {0, 0, 1}, {0, 0, 0}}));
  // At height 3 the eye must be within -1 < x < 2 to see the first before the second, and within -1/2 < x < 3/2 before
  // the third.
  EXPECT_EQ(from(scene, View_region::eye(at(ratio(7, 4), ratio(1, 2), 3))), (Matrix{{0, 1, 0}, {0, 0, 1}, {0, 0, 0}}));
}

}  // namespace
