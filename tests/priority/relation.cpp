// The relation against the Lemma in rational arithmetic, and the Lemma against eyes and rays.

#include "../sample.h"
#include "support.h"

#include <sightline/kernel/traits/point_traits.h>

#include <CGAL/Cartesian.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

using namespace priority_test;

namespace {

using test_scenes::least;
using test_scenes::sample;

/// may_obscure and arcs of every ordered pair, and under the default traits find_corner's witnesses.
template <class Traits>
testing::AssertionResult agrees(const Traits& traits, const Sides& sides, const Matrix& expected) {
  const Priority_relation<Traits> relation(traits);
  Relation_counters counters;
  if (const auto same = same_arcs(asked(relation), expected); !same) return same;
  for (std::uint32_t i = 0; i < relation.size(); ++i)
    for (std::uint32_t j = 0; j < relation.size(); ++j) {
      const Arcs both = relation.arcs(i, j, counters);
      if (both.forth != bool(expected[i][j]) || both.back != bool(expected[j][i]))
        return testing::AssertionFailure() << "arcs(" << i << ", " << j << ")";
      if constexpr (!std::is_same_v<Traits, Exact_traits>) continue;
      for (const Sign side : {CGAL::NEGATIVE, CGAL::POSITIVE}) {
        const std::uint32_t k = relation.find_corner(i, side, j, counters.predicates);
        const std::vector<int>& corners = sides[i][j];
        const bool some = std::count(corners.begin(), corners.end(), static_cast<int>(side)) > 0;
        if (some ? k >= corners.size() || corners[k] != static_cast<int>(side) : k != corners.size())
          return testing::AssertionFailure() << "corner " << k << " of " << i << " on side " << side << " of " << j;
      }
    }
  if (const std::uint64_t n = relation.size(); counters.pairs != n * n)
    return testing::AssertionFailure() << counters.pairs << " pairs counted, of " << n << " faces";
  return testing::AssertionSuccess();
}

// ---- What kinds of pairs there are

/// What two closed polygons that are not in parallel planes have in common.
struct Common {
  bool touch = false;  ///< a point
  bool cross = false;  ///< inner points of both
};
Common common(const Flat& a, const Flat& b) {
  const Exact_point line = cross(a.normal, b.normal);
  struct Part {  // what a polygon has in the other's plane, along the common line
    std::optional<Rational> low{}, high{};
    bool front = false, behind = false;
  };
  const auto part = [&](const Flat& of, const Flat& plane) {
    Part result;
    const auto add = [&](const Exact_point& p) {
      const Rational t = dot(line, p);
      if (!result.low || t < *result.low) result.low = t;
      if (!result.high || *result.high < t) result.high = t;
    };
    for (std::size_t k = 0; k < of.corners.size(); ++k) {
      const Exact_point &p = of.corners[k], &q = of.corners[(k + 1) % of.corners.size()];
      const Rational here = plane.height(p), next = plane.height(q);
      if (here == 0) add(p);
      if (sgn(here) * sgn(next) < 0) add(along(p, here / (here - next), minus(q, p)));
      result.front |= here > 0;
      result.behind |= here < 0;
    }
    return result;
  };
  const Part p = part(a, b), q = part(b, a);
  if (!p.low || !q.low) return {};
  const Rational low = std::max(*p.low, *q.low), high = std::min(*p.high, *q.high);
  return {low <= high, low < high && p.front && p.behind && q.front && q.behind};
}

/// How often each kind of pair was met.
using Kinds = std::map<std::string, std::size_t>;

void count_kinds(const Flats& flats, const Matrix& arcs, Kinds& kinds) {
  for (std::size_t i = 0; i < flats.size(); ++i)
    for (std::size_t j = i + 1; j < flats.size(); ++j) {
      const Flat &a = flats[i], &b = flats[j];
      ++kinds[arcs[i][j] && arcs[j][i] ? "arcs: both" : arcs[i][j] || arcs[j][i] ? "arcs: one" : "arcs: none"];
      std::size_t shared = 0, edges = 0;
      for (std::size_t k = 0; k < a.corners.size(); ++k)
        for (std::size_t l = 0; l < b.corners.size(); ++l) {
          shared += a.corners[k] == b.corners[l];
          const Exact_point &next = a.corners[(k + 1) % a.corners.size()],
                            &after = b.corners[(l + 1) % b.corners.size()];
          edges += (a.corners[k] == b.corners[l] && next == after) || (a.corners[k] == after && next == b.corners[l]);
        }
      const bool alike = dot(a.normal, b.normal) > 0;
      if (cross(a.normal, b.normal) == Exact_point{0, 0, 0}) {
        if (a.height(b.corners[0]) == 0) ++kinds[alike ? "coplanar: same sense" : "coplanar: opposite sense"];
        else if (alike) ++kinds["parallel: same sense"];
        else ++kinds[a.height(b.corners[0]) > 0 ? "parallel: face to face" : "parallel: back to back"];
        continue;
      }
      const Common both = common(a, b);
      if (both.cross) ++kinds["interpenetrating"];
      else if (edges > 0) ++kinds["shared edge"];
      else if (shared > 0) ++kinds["shared corner"];
      else if (both.touch) ++kinds["touching elsewhere"];
      else ++kinds["apart"];
      const auto in_plane = [](const Flat& of, const Flat& plane) {
        return std::any_of(of.corners.begin(), of.corners.end(),
                           [&](const Exact_point& p) { return plane.height(p) == 0; });
      };
      if (!both.touch && (in_plane(a, b) || in_plane(b, a))) ++kinds["apart, a corner in the other's plane"];
    }
}

TEST(Relation, is_the_lemma_on_degenerate_scenes_each_under_two_of_three_exact_kernels) {
  Kinds kinds, moved_arcs;
  for (std::uint64_t k = 0; k < sample(10000u); ++k) {
    const Related scene(degenerate_soup(k));
    const Sides sides = sides_of(scene.flats);
    const Matrix expected = arcs_of(sides);
    ASSERT_TRUE(agrees(scene.traits, sides, expected)) << "scene " << k;
    if (k / 32 % 2 == 0) {
      ASSERT_TRUE(agrees(Point_traits<CGAL::Epeck>(scene.scene), sides, expected)) << "scene " << k << ", Epeck";
    } else {
      ASSERT_TRUE(agrees(Point_traits<CGAL::Cartesian<CGAL::Gmpq>>(scene.scene), sides, expected))
          << "scene " << k << ", Gmpq";
    }
    if (k / 4 % 4 == 0) count_kinds(scene.flats, expected, kinds);
    if (k / 4 % 2 == 1)
      moved_arcs[k / 4 % 8 == 1   ? "far"
                 : k / 4 % 8 == 3 ? "tiny"
                 : k / 4 % 8 == 5 ? "one ulp off"
                                  : "turned"] += count_arcs(expected);
  }
  // Each kind of pair occurs, and often: what the scenes do not make they cannot test.
  for (const char* kind :
       {"arcs: none", "arcs: one", "arcs: both", "coplanar: same sense", "coplanar: opposite sense",
        "parallel: same sense", "parallel: face to face", "parallel: back to back", "interpenetrating", "shared edge",
        "shared corner", "touching elsewhere", "apart", "apart, a corner in the other's plane"})
    EXPECT_GT(kinds[kind], least(300u)) << kind;
  for (const char* move : {"far", "tiny", "one ulp off", "turned"}) EXPECT_GT(moved_arcs[move], least(5000u)) << move;
}

// ---- The definition: eyes and rays

/// Whether from this eye, strictly in front of both, the ray towards `through` goes through the inside of a and
/// strictly later of b.
bool sees_through(const Flat& a, const Flat& b, const Exact_point& eye, const Exact_point& through) {
  if (a.height(eye) <= 0 || b.height(eye) <= 0) return false;
  const std::optional<Rational> first = a.crossing(eye, through), then = b.crossing(eye, through);
  if (!first || !then || !(0 < *first && *first < *then)) return false;
  const Exact_point d = minus(through, eye);
  return a.holds(along(eye, *first, d)) == 1 && b.holds(along(eye, *then, d)) == 1;
}

/// The corner that is farthest on a side of a plane, moved towards the inside of its polygon as long as it stays on
/// that side; as it is if it is not there at all.
Exact_point inner_witness(const Flat& of, const Flat& plane, int side) {
  Exact_point farthest = of.corners[0];
  for (const Exact_point& p : of.corners)
    if (Rational(side * (plane.height(p) - plane.height(farthest))) > 0) farthest = p;
  const Exact_point centre = centroid(of.corners);
  if (sgn(plane.height(farthest)) != side) return farthest;
  for (Rational t = ratio(1, 2);; t /= 2) {
    const Exact_point p = along(farthest, t, minus(centre, farthest));
    if (sgn(plane.height(p)) == side) return p;
  }
}

TEST(Relation, every_arc_has_an_eye_whose_ray_goes_through_the_insides_of_both_faces_in_that_order) {
  std::size_t arcs = 0;
  for (std::uint64_t k = 0; k < sample(1000u); ++k) {
    const Related scene(degenerate_soup(k + 20000));
    const Matrix found = asked(scene.relation);
    for (std::size_t i = 0; i < found.size(); ++i)
      for (std::size_t j = 0; j < found.size(); ++j) {
        if (!found[i][j]) continue;
        ++arcs;
        const Exact_point a = inner_witness(scene.flats[i], scene.flats[j], 1),
                          b = inner_witness(scene.flats[j], scene.flats[i], -1);
        for (const Rational& t : {ratio(1, 1000), ratio(1, 1), ratio(1000, 1)})
          ASSERT_TRUE(sees_through(scene.flats[i], scene.flats[j], along(a, t, minus(a, b)), b))
              << "scene " << k << ": " << i << " < " << j << ", t = " << to_string(t);
      }
  }
  EXPECT_GT(arcs, least(5000u));
}

/// Whether from an eye strictly in front of both the ray towards a point of b meets a, closed, strictly before b.
bool meets_before(const Flat& a, const Flat& b, const Exact_point& eye, const Exact_point& of_b) {
  if (a.height(eye) <= 0 || b.height(eye) <= 0) return false;
  const std::optional<Rational> t = a.crossing(eye, of_b);
  return t && 0 < *t && *t < 1 && a.holds(along(eye, *t, minus(of_b, eye))) >= 0;
}

TEST(Relation, where_there_is_no_arc_no_eye_and_no_ray_shows_one_face_before_the_other) {
  std::size_t none = 0, in_front = 0, met = 0;
  for (std::uint64_t k = 0; k < sample(1000u); ++k) {
    Random random(k);
    const Related scene(degenerate_soup(k + 20000));
    const Matrix found = asked(scene.relation);
    for (std::size_t i = 0; i < found.size(); ++i)
      for (std::size_t j = 0; j < found.size(); ++j) {
        if (i == j) continue;
        const Flat &a = scene.flats[i], &b = scene.flats[j];
        for (int sample = 0; sample < 3; ++sample) {
          // The eyes that look through a given point of a at a given point of b; closed faces, so corners and edges
          // too.
          const Exact_point p = point_of(a.corners, random), q = point_of(b.corners, random);
          const Exact_point eye = along(p, ratio(random.between(1, 40), 10), minus(p, q));
          const bool shows = p != q && meets_before(a, b, eye, q);
          ASSERT_TRUE(found[i][j] || !shows) << "scene " << k << ": " << i << " before " << j;
          met += shows;
          // And eyes that have nothing to do with a.
          const Exact_point anywhere =
              along(p, ratio(random.between(1, 30), 10),
                    sample == 0 ? b.normal : along(a.normal, ratio(random.between(-1, 3), 2), b.normal));
          ASSERT_TRUE(found[i][j] || !meets_before(a, b, anywhere, q)) << "scene " << k << ": " << i << " before " << j;
          in_front += a.height(anywhere) > 0 && b.height(anywhere) > 0;
        }
        none += !found[i][j];
      }
  }
  EXPECT_GT(none, least(5000u));
  EXPECT_GT(in_front, least(5000u)) << "eyes in front of both";
  EXPECT_GT(met, least(5000u)) << "the samples do find arcs where there are any";
}

// ---- Laws

TEST(Relation, turning_all_faces_round_reverses_all_arcs) {
  std::size_t arcs = 0, one_way = 0;
  for (std::uint64_t k = 0; k < sample(2000u); ++k) {
    Random random(k);
    const Polygon_soup soup = moved(touching_soup(random),
                                    k % 2 == 0   ? Move::none
                                    : k % 4 == 1 ? Move::far
                                                 : Move::turned,
                                    k);
    const Related scene(soup), turned(generate::faces_reversed(soup));
    const Matrix there = asked(scene.relation), back = asked(turned.relation);
    ASSERT_EQ(there.size(), back.size()) << "scene " << k;
    for (std::uint32_t i = 0; i < there.size(); ++i) {
      ASSERT_EQ(scene.traits.face(i), turned.traits.face(i)) << "scene " << k;
      for (std::uint32_t j = 0; j < there.size(); ++j) {
        ASSERT_EQ(there[i][j], back[j][i]) << "scene " << k << ": " << i << ", " << j;
        arcs += there[i][j] != 0;
        one_way += there[i][j] && !there[j][i];
      }
    }
  }
  EXPECT_GT(arcs, least(10000u));
  EXPECT_GT(one_way, least(5000u)) << "a symmetric relation would keep the law too";
}

TEST(Relation, has_no_arc_from_a_face_to_itself_or_between_coplanar_ones) {
  std::size_t coplanar = 0;
  for (std::uint64_t k = 0; k < 1000; ++k) {
    Random random(k);
    const Related scene(moved(touching_soup(random), static_cast<Move>(k % 3), k));
    const Matrix found = asked(scene.relation);
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_FALSE(found[i][i]) << "scene " << k << ": " << i;
      for (std::size_t j = 0; j < found.size(); ++j) {
        const Points& corners = scene.flats[j].corners;
        if (i == j || std::any_of(corners.begin(), corners.end(),
                                  [&](const Exact_point& p) { return scene.flats[i].height(p) != 0; }))
          continue;
        ++coplanar;
        ASSERT_FALSE(found[i][j]) << "scene " << k << ": " << i << " < " << j;
      }
    }
  }
  EXPECT_GT(coplanar, 1000u);
}

TEST(Relation,
     squares_above_each_other_obscure_downwards_if_fronts_are_up_and_not_at_all_if_they_look_apart_or_at_each_other) {
  const Points low = rectangle(0, 1, 0, 1, 0), high = rectangle(0, 1, 0, 1, 1);
  const auto arcs = [](const Points& a, const Points& b) { return asked(Related(soup_of({a, b})).relation); };
  EXPECT_EQ(arcs(low, high), (Matrix{{0, 0}, {1, 0}}));
  EXPECT_EQ(arcs(reversed(low), reversed(high)), (Matrix{{0, 1}, {0, 0}}));
  EXPECT_EQ(arcs(low, reversed(high)), (Matrix{{0, 0}, {0, 0}})) << "face to face";
  EXPECT_EQ(arcs(reversed(low), high), (Matrix{{0, 0}, {0, 0}})) << "back to back";
  EXPECT_EQ(arcs(low, rectangle(100, 101, 50, 51, 1)), (Matrix{{0, 0}, {1, 0}})) << "from far enough to the side";
  EXPECT_EQ(arcs(low, rectangle(ratio(1, 2), 3, 0, 5, 0)), (Matrix{{0, 0}, {0, 0}})) << "in one plane";
}

TEST(Relation, faces_that_cross_obscure_each_other_and_ones_that_meet_at_an_edge_do_as_their_fronts_say) {
  const auto arcs = [](const Points& a, const Points& b) { return asked(Related(soup_of({a, b})).relation); };
  const Points floor = rectangle(-1, 1, -1, 1, 0);
  const auto wall = [](long low, long high) {
    return Points{at(0, -1, low), at(0, 1, low), at(0, 1, high), at(0, -1, high)};
  };  // front to +x
  EXPECT_EQ(arcs(floor, wall(-1, 1)), (Matrix{{0, 1}, {1, 0}})) << "crossing";
  EXPECT_EQ(arcs(floor, wall(0, 1)), (Matrix{{0, 0}, {1, 0}}))
      << "standing on it: from the right, the wall before the floor on its left";
  EXPECT_EQ(arcs(floor, wall(-1, 0)), (Matrix{{0, 1}, {0, 0}}))
      << "hanging from it: from the right, the floor before the wall";
  const Points right = rectangle(0, 1, -1, 1, 0), left = rectangle(-1, 0, -1, 1, 0);  // the floor's halves
  EXPECT_EQ(arcs(right, wall(0, 1)), (Matrix{{0, 0}, {0, 0}})) << "a concave edge";
  EXPECT_EQ(arcs(right, wall(-1, 0)), (Matrix{{0, 1}, {0, 0}}));
  EXPECT_EQ(arcs(left, wall(0, 1)), (Matrix{{0, 0}, {1, 0}}));
  EXPECT_EQ(arcs(left, wall(-1, 0)), (Matrix{{0, 0}, {0, 0}})) << "a convex edge";
}

TEST(Relation, one_corner_a_hair_out_of_the_other_plane_decides) {
  const double far = 100000000, up = std::nextafter(far, 2 * far), down = std::nextafter(far, 0);
  const std::array<std::array<double, 3>, 3> heights{{{down, far, up}, {-0x1p-1074, 0, 0x1p-1074}, {-1e-50, 0, 1e-50}}};
  for (const auto& [below, plane, above] : heights)
    for (const double z : {below, plane, above}) {
      const Rational h = exact(plane);
      const auto arcs = [&](const Points& face) {
        return asked(Related(soup_of({rectangle(0, 1, 0, 1, h), face})).relation);
      };
      const char higher = z > plane, lower = z < plane;
      EXPECT_EQ(arcs({at(2, 0, h), at(3, 0, h), at(3, 1, exact(z)), at(2, 1, exact(z))}),
                (Matrix{{0, lower}, {higher, 0}}))
          << "hinged to the plane, " << z;
      EXPECT_EQ(arcs(rectangle(2, 3, 0, 1, exact(z))), (Matrix{{0, lower}, {higher, 0}})) << "parallel, " << z;
      // Turned over, a strip that rises to the right looks down and right: it is behind the square's plane or not, and
      // the square on its back or not.
      EXPECT_EQ(arcs(reversed(rectangle(2, 3, 0, 1, exact(z)))), (Matrix{{0, 0}, {0, 0}}))
          << "parallel, turned over, " << z;
    }
}

// ---- Polygons that are no pieces of the scene

TEST(Relation, holds_for_the_fragments_of_a_tree_whose_corners_are_meets_of_planes) {
  std::size_t fragments = 0, cut = 0, arcs = 0;
  for (std::uint64_t k = 0; k < sample(400u); ++k) {
    const Built built(degenerate_soup(k + 40000));
    Priority_relation<Exact_traits> relation(built.traits);
    Flats flats;
    for (const Piece& piece : built.scene.pieces()) flats.emplace_back(built.scene.corner_points(piece));
    for (const Drawn& fragment : built.tree.fragments) {
      relation.add(fragment.polygon);
      flats.emplace_back(built.corners(fragment.polygon));
      ++fragments;
      cut += fragment.number > 0;
    }
    const Matrix expected = arcs_of(flats);
    ASSERT_TRUE(same_arcs(asked(relation), expected)) << "scene " << k;
    arcs += count_arcs(expected);
  }
  EXPECT_GT(fragments, least(2000u));
  EXPECT_GT(cut, least(500u));
  EXPECT_GT(arcs, least(10000u));
}

}  // namespace
