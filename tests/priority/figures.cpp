// The figures of Fuchs, Kedem and Naylor 1979 as scenes. The text describes them and the drawings are not in it, so
// each test builds an object of its own that has the property that the text states, and says why it has. The figures
// are flat, "for simplicity in 2-space": a segment of theirs is a wall here, an upright rectangle over it, between
// heights 0 and 1. Walls meet a plane as segments meet its line, so all relations are those of the plane.

#include "support.h"

#include <sightline/algorithms/priority/implicit_graph.h>
#include <sightline/algorithms/priority/scope.h>

using namespace priority_test;

namespace {

struct Spot {
  Rational x, y;
};

/// The wall over a segment. Its front is to the right of who walks from p to q: outside, where an object is walked
/// round counterclockwise.
Points wall_over(const Spot& p, const Spot& q, const Rational& low = 0, const Rational& high = 1) {
  return {at(p.x, p.y, low), at(q.x, q.y, low), at(q.x, q.y, high), at(p.x, p.y, high)};
}

/// The walls round an object: wall k goes from corner k to the next.
std::vector<Points> walls_round(const std::vector<Spot>& outline) {
  std::vector<Points> walls;
  for (std::size_t k = 0; k < outline.size(); ++k)
    walls.push_back(wall_over(outline[k], outline[(k + 1) % outline.size()]));
  return walls;
}

using Arc_set = std::set<std::pair<std::uint32_t, std::uint32_t>>;
Arc_set arcs_in(const Matrix& arcs) {
  Arc_set set;
  for (std::uint32_t i = 0; i < arcs.size(); ++i)
    for (std::uint32_t j = 0; j < arcs.size(); ++j)
      if (arcs[i][j]) set.emplace(i, j);
  return set;
}
Arc_set arcs_in(const Related& scene) { return arcs_in(asked(scene.relation)); }

Priority_components searched(const Related& scene) {
  Implicit_priority_graph graph(scene.relation);
  return components(graph);
}

/// The smallest priority numbers that are possible, from 1: one more than the greatest of what may obscure the face.
/// None where there is a cycle.
std::optional<std::vector<int>> priority_numbers(const Matrix& arcs) {
  std::vector<int> numbers(arcs.size(), 1);
  for (std::size_t round = 0; round <= arcs.size(); ++round) {
    bool raised = false;
    for (std::size_t i = 0; i < arcs.size(); ++i)
      for (std::size_t j = 0; j < arcs.size(); ++j)
        if (arcs[i][j] && numbers[j] <= numbers[i]) {
          numbers[j] = numbers[i] + 1;
          raised = true;
        }
    if (!raised) return numbers;
  }
  return std::nullopt;
}

/// Where a ray goes through the inside of a face that its eye is in front of.
std::optional<Rational> goes_through(const Flat& face, const Exact_point& eye, const Exact_point& towards) {
  if (face.height(eye) <= 0) return std::nullopt;
  const std::optional<Rational> t = face.crossing(eye, towards);
  if (!t || *t <= 0 || face.holds(along(eye, *t, minus(towards, eye))) != 1) return std::nullopt;
  return t;
}

/// Walks along random rays and tells of each pair of faces, both facing the eye, the nearer first. The eyes are
/// anywhere, the targets on faces.
template <class Function>
void look_around(const Related& scene, long reach, int rays, Function tell) {
  Random random(1979);
  for (int ray = 0; ray < rays; ++ray) {
    const Exact_point eye = at(ratio(random.between(-8 * reach, 8 * reach), 8),
                               ratio(random.between(-8 * reach, 8 * reach), 8), ratio(random.between(-3, 11), 8));
    const Exact_point target = inside_of(scene.flats[random.below(scene.flats.size())].corners, random);
    std::vector<std::pair<Rational, std::uint32_t>> met;
    for (std::uint32_t i = 0; i < scene.flats.size(); ++i)
      if (const auto t = goes_through(scene.flats[i], eye, target)) met.emplace_back(*t, i);
    std::sort(met.begin(), met.end());
    for (std::size_t a = 0; a < met.size(); ++a)
      for (std::size_t b = a + 1; b < met.size(); ++b)
        if (met[a].first < met[b].first) tell(met[a].second, met[b].second);
  }
}

// ---- Figures 1, 3, 4: objects with a consistent enumeration

/// An L: of its six faces two, 2 and 3, make the notch. Nothing is in front of the four outer ones, so nothing obscures
/// them. 1 is in front of 3 across the notch, and so is the right part of 0 (the relation knows of no other faces, so
/// it looks through the solid); 4 and 5 are so to 2. The notch's own two are each in front of the other and not behind
/// it.
std::vector<Spot> l_shape() { return {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}; }

TEST(Figure_1, an_object_whose_faces_have_priority_numbers_from_anywhere) {
  const Related scene(soup_of(walls_round(l_shape())));
  EXPECT_EQ(arcs_in(scene), (Arc_set{{0, 3}, {1, 3}, {4, 2}, {5, 2}}));
  EXPECT_EQ(priority_numbers(asked(scene.relation)), (std::vector<int>{1, 1, 2, 2, 1, 1}));
  for (const Priority_components& found : {searched(scene), components(Explicit_priority_graph(scene.relation))}) {
    EXPECT_EQ(found.size(), 6u);
    EXPECT_EQ(found.cyclic(), 0u);
    for (const std::uint32_t outer : {0u, 1u}) EXPECT_LT(found.h(outer), found.h(3)) << outer;
    for (const std::uint32_t outer : {4u, 5u}) EXPECT_LT(found.h(outer), found.h(2)) << outer;
  }
}

TEST(Figure_1, from_a_specific_viewpoint_face_1_takes_priority_over_face_2_and_back_faces_over_nothing) {
  // Right of the object and a little below it: the face 1 of number 1 is before the face 3 of number 2; faces 2, 4, 5
  // are seen from behind.
  const Related scene(soup_of(walls_round(l_shape())));
  const Region_relation<Exact_traits> view(scene.relation, View_region::eye(at(5, -1, ratio(1, 2))));
  EXPECT_EQ(arcs_in(asked(view)), (Arc_set{{1, 3}}));
  for (const std::uint32_t back : {2u, 4u, 5u}) EXPECT_FALSE(view.on_view(back)) << back;
  for (const std::uint32_t front : {0u, 1u, 3u}) EXPECT_TRUE(view.on_view(front)) << front;
}

TEST(Figure_1, a_roof_obscures_the_walls_below_and_nothing_obscures_it) {
  // The closed prism: its roof and its floor look away from everything, and are in front of all walls.
  std::vector<Points> faces = walls_round(l_shape());
  faces.push_back({at(0, 0, 1), at(3, 0, 1), at(3, 1, 1), at(1, 1, 1), at(1, 3, 1), at(0, 3, 1)});
  const Related scene(soup_of(faces));
  ASSERT_GT(scene.flats.size(), 7u) << "the roof is concave, so it is several pieces";
  const Arc_set arcs = arcs_in(scene);
  EXPECT_TRUE(arcs.count({1, 3}) && arcs.count({4, 2}));
  for (const auto& [a, b] : arcs) EXPECT_LT(b, 6u) << a << " obscures a piece of the roof";
  for (const std::uint32_t notch : {2u, 3u}) {
    const bool under =
        std::any_of(arcs.begin(), arcs.end(), [&](const auto& arc) { return arc.first >= 6 && arc.second == notch; });
    EXPECT_TRUE(under) << "the roof's far part is before wall " << notch;
  }
  EXPECT_EQ(searched(scene).cyclic(), 0u);
}

/// Stairs: each tread or riser is obscured by the ones of its direction that are farther out, and through the solid by
/// 0 or 7, which nothing obscures.
std::vector<Spot> stairs() { return {{0, 0}, {3, 0}, {3, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 3}, {0, 3}}; }

TEST(Figure_3, along_a_viewing_ray_the_numbers_of_the_faces_ascend) {
  const Related scene(soup_of(walls_round(stairs())));
  const auto f = priority_numbers(asked(scene.relation));
  ASSERT_TRUE(f.has_value());
  const Priority_components found = searched(scene);
  std::set<std::pair<int, int>> met;
  look_around(scene, 8, 3000, [&](std::uint32_t nearer, std::uint32_t farther) {
    EXPECT_LT((*f)[nearer], (*f)[farther]) << nearer << " before " << farther;
    EXPECT_LT(found.h(nearer), found.h(farther)) << nearer << " before " << farther;
    met.emplace((*f)[nearer], (*f)[farther]);
  });
  EXPECT_EQ(met, (std::set<std::pair<int, int>>{{1, 2}, {1, 3}, {2, 3}}));
}

TEST(Figure_4, an_object_that_admits_a_consistent_enumeration) {
  const Related scene(soup_of(walls_round(stairs())));
  EXPECT_EQ(arcs_in(scene), (Arc_set{{1, 3}, {1, 5}, {3, 5}, {6, 4}, {6, 2}, {4, 2}, {0, 3}, {0, 5}, {7, 4}, {7, 2}}));
  EXPECT_EQ(priority_numbers(asked(scene.relation)), (std::vector<int>{1, 1, 3, 2, 2, 3, 1, 1}));
  EXPECT_EQ(searched(scene).size(), 8u);
}

// ---- Figures 2, 5, 6: objects without one

TEST(Figure_2, a_simple_object_without_viewpoint_independent_priority) {
  // A triangle with three blades, each a side that is longer than it should be: 0 to 8 on the x axis, 3 on x + y = 4, 6
  // on the y axis. The end of each outer side, 0, 3, 6, is in front of the next one's line, and all of the next one is
  // behind its own.
  const Related scene(
      soup_of(walls_round({{1, 0}, {8, 0}, {8, 1}, {3, 1}, {-4, 8}, {-4, 7}, {0, 3}, {0, -8}, {1, -8}})));
  const Matrix arcs = asked(scene.relation);
  for (const auto& [a, b] : {std::pair{0u, 3u}, std::pair{3u, 6u}, std::pair{6u, 0u}}) {
    EXPECT_TRUE(arcs[a][b]) << a << " < " << b;
    EXPECT_FALSE(arcs[b][a]) << b << " < " << a;
  }
  EXPECT_FALSE(priority_numbers(arcs).has_value());
  std::vector<int> number(9);
  std::iota(number.begin(), number.end(), 0);
  std::size_t consistent = 0;
  do {  // no enumeration of the nine
    bool respects = true;
    for (std::size_t i = 0; i < 9 && respects; ++i)
      for (std::size_t j = 0; j < 9; ++j) respects = respects && (!arcs[i][j] || number[i] < number[j]);
    consistent += respects;
  } while (std::next_permutation(number.begin(), number.end()));
  EXPECT_EQ(consistent, 0u);
  const Priority_components found = searched(scene);
  EXPECT_GE(found.cyclic(), 1u);
  EXPECT_TRUE(found.h(0) == found.h(3) && found.h(3) == found.h(6));
  // Each of the three really obscures the next, along some ray.
  std::set<std::pair<std::uint32_t, std::uint32_t>> met;
  look_around(scene, 20, 4000, [&](std::uint32_t nearer, std::uint32_t farther) {
    EXPECT_TRUE(arcs[nearer][farther]) << nearer << " before " << farther;
    met.emplace(nearer, farther);
  });
  for (const auto& arc : Arc_set{{0, 3}, {3, 6}, {6, 0}})
    EXPECT_TRUE(met.count(arc)) << arc.first << " before " << arc.second;
}

/// A core with four blades, wound one way: right, up, left and down from the core's corners. The blades' outer sides
/// are 2, 5, 8, 11, their inner sides 4, 7, 10, 1, their tips 3, 6, 9, 0.
std::vector<Spot> pinwheel() {
  return {{2, -2}, {3, -2}, {3, 2}, {8, 2}, {8, 3}, {4, 3}, {4, 8}, {3, 8}, {3, 4}, {-2, 4}, {-2, 3}, {2, 3}};
}

TEST(Figure_5, an_object_that_does_not_admit_a_consistent_enumeration) {
  const Related scene(soup_of(walls_round(pinwheel())));
  const Matrix arcs = asked(scene.relation);
  EXPECT_FALSE(priority_numbers(arcs).has_value());
  // The outer sides are a cycle one way, the inner sides the other way: each inner side is before the one that it looks
  // at over the core's corner.
  for (const std::vector<std::uint32_t>& cycle : {std::vector<std::uint32_t>{2, 5, 8, 11}, {4, 1, 10, 7}})
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_TRUE(arcs[cycle[k]][cycle[(k + 1) % 4]]) << cycle[k] << " < " << cycle[(k + 1) % 4];
      EXPECT_FALSE(arcs[cycle[(k + 1) % 4]][cycle[k]]) << cycle[(k + 1) % 4] << " < " << cycle[k];
    }
}

TEST(Figure_6, the_partial_priority_graph_of_figure_5_is_acyclic_and_has_a_consistent_enumeration) {
  // Nothing is in front of a tip, and each tip is before an outer and an inner side; an outer side is before an inner
  // one (8 before 4) and never behind one. So the four tips come first, then the outer cycle, then the inner one.
  const Related scene(soup_of(walls_round(pinwheel())));
  const Explicit_priority_graph written(scene.relation);
  for (const Priority_components& found : {searched(scene), components(written)}) {
    ASSERT_EQ(found.size(), 6u);
    EXPECT_EQ(found.cyclic(), 2u);
    EXPECT_EQ(found.largest(), 4u);
    for (const std::uint32_t tip : {3u, 6u, 9u, 0u}) EXPECT_LT(found.h(tip), 4u) << tip;
    for (const std::uint32_t outer : {2u, 5u, 8u, 11u}) EXPECT_EQ(found.h(outer), 4u) << outer;
    for (const std::uint32_t inner : {4u, 7u, 10u, 1u}) EXPECT_EQ(found.h(inner), 5u) << inner;
    // 6a: the graph between components.
    Arc_set arcs;
    const Arc_graph partial = condensation(written.boost_graph(), found);
    for (const auto& arc : boost::make_iterator_range(boost::edges(partial)))
      arcs.emplace(boost::source(arc, partial), boost::target(arc, partial));
    EXPECT_EQ(arcs, (Arc_set{{0, 4}, {0, 5}, {1, 4}, {1, 5}, {2, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}}));
    // 6b: where h differs along a ray, the lower is nearer.
    std::size_t met = 0, undecided = 0;
    look_around(scene, 12, 3000, [&](std::uint32_t nearer, std::uint32_t farther) {
      EXPECT_LE(found.h(nearer), found.h(farther)) << nearer << " before " << farther;
      ++met;
      undecided += found.h(nearer) == found.h(farther);
    });
    EXPECT_GT(met, 500u);
    EXPECT_GT(undecided, 50u);
  }
}

// ---- Figures 7, 8: splitting

/// A relation to which polygons are added: the scene's walls come first, then what they were split into.
struct Splitting {
  Related scene;
  Polygon_store<Exact_traits> store;

  explicit Splitting(const std::vector<Points>& faces) : scene(soup_of(faces)) {}

  /// Splits a face along another's plane; returns the numbers of its parts behind and in front.
  std::array<std::uint32_t, 2> split_along(std::uint32_t face, std::uint32_t plane) {
    Split_scratch<Exact_traits> scratch;
    Predicate_counts counts;
    const auto& cutter = scene.relation.cutter(plane);
    const Convex_polygon<Exact_traits> polygon = scene.relation[face];
    if (classify(scene.traits, polygon, cutter, scratch, counts) != Position::across)
      throw std::logic_error("the plane does not split the face");
    const auto [behind, front] = split(scene.traits, polygon, cutter, scratch, store);
    scene.relation.add(behind);
    scene.relation.add(front);
    return {scene.relation.size() - 2, scene.relation.size() - 1};
  }
  bool before(std::uint32_t a, std::uint32_t b) const {
    Relation_counters counters;
    return scene.relation.may_obscure(a, b, counters);
  }
};

TEST(Figure_7, of_b_split_along_the_plane_of_a_only_the_part_behind_a_can_be_obscured) {
  // A looks up at y = 1, B left at x = 2; A is in front of all of B's plane's left, B on both sides of A's plane.
  const Spot a1{1, 1}, a0{0, 1}, b1{2, 2}, b0{2, 0};
  Splitting figure({wall_over(a1, a0), wall_over(b1, b0)});
  EXPECT_EQ(arcs_in(figure.scene), (Arc_set{{0, 1}}));
  const auto [b_behind, b_front] = figure.split_along(1, 0);
  EXPECT_TRUE(figure.before(0, b_behind));
  EXPECT_FALSE(figure.before(0, b_front));
  for (const std::uint32_t part : {b_behind, b_front}) EXPECT_FALSE(figure.before(part, 0));
  EXPECT_FALSE(figure.before(b_behind, b_front) || figure.before(b_front, b_behind));
  // The same, split by hand.
  EXPECT_EQ(arcs_in(Related(soup_of({wall_over(a1, a0), wall_over({2, 1}, b0), wall_over(b1, {2, 1})}))),
            (Arc_set{{0, 1}}));
}

TEST(Figure_7, of_a_split_along_the_plane_of_b_only_the_part_in_front_of_b_can_obscure) {
  // A looks up at y = 1 and is on both sides of B's plane, x = 2; B looks left and is below A.
  const Spot a1{4, 1}, a0{0, 1}, b1{2, ratio(1, 2)}, b0{2, 0};
  Splitting figure({wall_over(a1, a0), wall_over(b1, b0)});
  EXPECT_EQ(arcs_in(figure.scene), (Arc_set{{0, 1}}));
  const auto [a_behind, a_front] = figure.split_along(0, 1);
  EXPECT_TRUE(figure.before(a_front, 1));
  EXPECT_FALSE(figure.before(a_behind, 1));
  for (const std::uint32_t part : {a_behind, a_front}) EXPECT_FALSE(figure.before(1, part));
  EXPECT_EQ(arcs_in(Related(soup_of({wall_over({2, 1}, a0), wall_over(a1, {2, 1}), wall_over(b1, b0)}))),
            (Arc_set{{0, 2}}));
}

TEST(Figure_8, splitting_breaks_up_a_strongly_connected_component) {
  // B looks up from y = 0, all along. A stands over it at x = 1 and looks right: it obscures B's left, from the right.
  // C hangs under B at x = 2 and looks right too: B's right end, in front of C, obscures it, and C, in front of A,
  // obscures that. So A < B < C < A, but the two ends of B are the two parts along A's plane.
  const Points a = wall_over({1, 1}, {1, 2}), b = wall_over({4, 0}, {-4, 0}), c = wall_over({2, -2}, {2, -1});
  const Related whole(soup_of({a, b, c}));
  EXPECT_EQ(arcs_in(whole), (Arc_set{{0, 1}, {1, 2}, {2, 0}}));
  EXPECT_EQ(searched(whole).size(), 1u);

  const Related parts(
      soup_of({a, wall_over({1, 0}, {-4, 0}), wall_over({4, 0}, {1, 0}), c}));  // B1 behind A is 1, B2 in front 2
  EXPECT_EQ(arcs_in(parts), (Arc_set{{2, 3}, {3, 0}, {0, 1}}));
  for (const Priority_components& found : {searched(parts), components(Explicit_priority_graph(parts.relation))}) {
    ASSERT_EQ(found.size(), 4u);
    EXPECT_EQ((std::vector<std::uint32_t>{found.h(2), found.h(3), found.h(0), found.h(1)}),
              (std::vector<std::uint32_t>{0, 1, 2, 3}))
        << "B2, C, A, B1";
  }

  Splitting split({a, b, c});
  const auto [b1, b2] = split.split_along(1, 0);
  EXPECT_TRUE(split.before(b2, 2) && split.before(2, 0) && split.before(0, b1));
  EXPECT_FALSE(split.before(b1, 2) || split.before(2, b1) || split.before(2, b2) || split.before(0, b2) ||
               split.before(b1, 0) || split.before(b2, 0));
}

TEST(Figure_8, splitting_breaks_up_a_pair_that_obscure_each_other) {
  // Two walls whose planes cross in both, one above the other: each before the other, and in the order B2, A, B1 once B
  // is split.
  const Points a = wall_over({1, 0}, {-1, 0}, 0, 1),
               b = wall_over({0, -1}, {0, 1}, 2, 3);  // A looks up the y axis, B right
  EXPECT_EQ(arcs_in(Related(soup_of({a, b}))), (Arc_set{{0, 1}, {1, 0}}));
  const Related parts(soup_of({a, wall_over({0, -1}, {0, 0}, 2, 3), wall_over({0, 0}, {0, 1}, 2, 3)}));
  EXPECT_EQ(arcs_in(parts), (Arc_set{{0, 1}, {2, 0}}));
  const Priority_components found = searched(parts);
  EXPECT_EQ((std::vector<std::uint32_t>{found.h(2), found.h(0), found.h(1)}), (std::vector<std::uint32_t>{0, 1, 2}));
}

// ---- Figure 9: a ring

/// A, B, C, D: the sides of a square, looking out, each longer than it should be at one end. That end is in front of
/// the next side, which is behind the whole of it; opposite sides are back to back.
std::vector<Points> ring() {
  const Rational quarter = ratio(1, 4), rest = ratio(3, 4);
  return {wall_over({quarter, 0}, {2, 0}), wall_over({1, quarter}, {1, 2}), wall_over({rest, 1}, {-1, 1}),
          wall_over({0, rest}, {0, -1})};
}

TEST(Figure_9, a_ring_of_four_has_no_relation_across) {
  const Related scene(soup_of(ring()));
  EXPECT_EQ(arcs_in(scene), (Arc_set{{0, 1}, {1, 2}, {2, 3}, {3, 0}}));
  const Priority_components found = searched(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].size(), 4u);
}

TEST(Figure_9, at_any_pixel_at_most_one_of_each_opposite_pair_is_potentially_visible) {
  const Related scene(soup_of(ring()));
  Arc_set met;
  look_around(scene, 6, 4000, [&](std::uint32_t nearer, std::uint32_t farther) { met.emplace(nearer, farther); });
  EXPECT_EQ(met, (Arc_set{{0, 1}, {1, 2}, {2, 3}, {3, 0}})) << "the four conflicting cases of figure 9b and no other";
  // No eye is in front of two opposite ones, so from any eye the ring is open.
  Random random(9);
  for (int sample = 0; sample < 200; ++sample) {
    const Exact_point eye = at(ratio(random.between(-40, 40), 8), ratio(random.between(-40, 40), 8), ratio(1, 2));
    const Region_relation<Exact_traits> view(scene.relation, View_region::eye(eye));
    EXPECT_FALSE(view.on_view(0) && view.on_view(2));
    EXPECT_FALSE(view.on_view(1) && view.on_view(3));
    Implicit_priority_graph graph(view);
    EXPECT_EQ(components(graph).size(), 4u);
  }
}

TEST(Figure_9, the_whole_ring_is_seen_from_a_region_round_it_and_each_arc_from_one_corner_of_that) {
  const Related scene(soup_of(ring()));
  const Arc_set all{{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  const auto from_box = [&](long x0, long y0, long x1, long y1) {
    return arcs_in(
        asked(Region_relation<Exact_traits>(scene.relation, View_region::box(at(x0, y0, 0), at(x1, y1, 1)))));
  };
  EXPECT_EQ(from_box(-9, -9, 9, 9), all);
  EXPECT_EQ(from_box(1, -9, 9, 0), (Arc_set{{0, 1}})) << "below and right: A before B";
  EXPECT_EQ(from_box(1, 1, 9, 9), (Arc_set{{1, 2}}));
  EXPECT_EQ(from_box(-9, 1, 0, 9), (Arc_set{{2, 3}}));
  EXPECT_EQ(from_box(-9, -9, 0, 0), (Arc_set{{3, 0}}));
  EXPECT_EQ(from_box(1, -9, 9, 9), (Arc_set{{0, 1}, {1, 2}}));
  EXPECT_EQ(from_box(0, 0, 1, 1), Arc_set{}) << "within the ring, behind all";
}

}  // namespace
