// Sets of on-view faces against an elimination of variables, and trees of tests against all partial assignments; then
// both from eyes of every kind.

#include "../sample.h"

#include <gtest/gtest.h>

#include <sightline/algorithms/cutset/decision_tree.h>
#include <sightline/harness/generate/random.h>

#include <set>

namespace {

using namespace sightline;
using generate::Random;
using Plane4 = std::array<Rational, 4>;
using Plane_list = std::vector<Plane4>;
using Sets = std::set<std::uint32_t>;

Rational fraction(long p, unsigned long q) {
  Rational value(p, q);
  value.canonicalize();
  return value;
}

// ---- Bodies

/// The planes n . x = d, fronts away from the origin if d > 0.
Plane_list planes_of(const std::vector<std::array<long, 3>>& normals, const Rational& d = 1) {
  Plane_list planes;
  for (const auto& n : normals) planes.push_back({n[0], n[1], n[2], -d});
  return planes;
}
Plane_list box() { return planes_of({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}); }
Plane_list tetrahedron(const Rational& d = 1) {
  return planes_of({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, d);
}
Plane_list triangular_prism() { return planes_of({{2, 0, 0}, {-1, 2, 0}, {-1, -2, 0}, {0, 0, 1}, {0, 0, -1}}); }
Plane_list hexagonal_prism() {
  return planes_of({{2, 0, 0}, {1, 2, 0}, {-1, 2, 0}, {-2, 0, 0}, {-1, -2, 0}, {1, -2, 0}, {0, 0, 1}, {0, 0, -1}});
}
Plane_list octahedron() {
  return planes_of(
      {{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}, {-1, 1, 1}, {-1, 1, -1}, {-1, -1, 1}, {-1, -1, -1}});
}
Plane_list dodecahedron() {
  std::vector<std::array<long, 3>> normals;
  for (std::size_t k = 0; k < 3; ++k)
    for (const long s : {5, -5})
      for (const long t : {8, -8}) {
        normals.push_back({0, 0, 0});
        normals.back()[(k + 1) % 3] = s;
        normals.back()[(k + 2) % 3] = t;
      }
  return planes_of(normals);
}
/// Planes that touch the unit sphere in rational points.
Plane_list random_body(std::size_t n, Random& random) {
  Plane_list planes;
  while (planes.size() < n) {
    const Rational s = fraction(random.between(-60, 60), 20), t = fraction(random.between(-60, 60), 20),
                   d = 1 + s * s + t * t;
    const int side = random.chance(1, 2) ? 1 : -1;
    planes.push_back(
        {Rational(side * 2 * s / d), Rational(side * 2 * t / d), Rational(side * (1 - s * s - t * t) / d), -1});
  }
  return planes;
}
Plane_list random_planes(std::size_t n, long most, Random& random) {
  Plane_list planes;
  while (planes.size() < n) {
    Plane4 plane;
    for (Rational& c : plane) c = random.between(-most, most);
    if (plane[0] != 0 || plane[1] != 0 || plane[2] != 0) planes.push_back(plane);
  }
  return planes;
}
/// Planes that coincide in either sense, are parallel, and meet in lines and points.
Plane_list degenerate_planes(std::size_t n, Random& random) {
  Plane_list planes = random_planes(n, 1, random);
  const std::uint64_t kind = random.below(4);
  for (Plane4& plane : planes) {
    if (kind == 1) plane[3] = 0;
    if (kind == 2 && plane[0] == 0 && plane[1] == 0) plane[0] = 1;
    if (kind == 2) plane[2] = 0;
  }
  for (std::size_t k = 1; k < n; ++k)
    if (random.chance(1, 6)) {
      const Rational factor = fraction(random.chance(1, 2) ? 3 : -2, 5);
      for (std::size_t c = 0; c < 4; ++c) planes[k][c] = factor * planes[0][c];
      if (random.chance(1, 3)) planes[k][3] += 1;
    }
  return planes;
}

// ---- Eyes

Rational value_at(const Plane4& h, const Exact_point& p) { return h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3]; }
std::uint32_t signs_from(const Plane_list& planes, const Exact_point& p) {
  std::uint32_t on = 0;
  for (std::size_t k = 0; k < planes.size(); ++k) on += (value_at(planes[k], p) > 0 ? 1u : 0u) << k;
  return on;
}

Rational determinant(const Exact_point& a, const Exact_point& b, const Exact_point& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}
/// The point where three planes meet, by Cramer's rule.
std::optional<Exact_point> meet(const std::array<Plane4, 3>& h) {
  std::array<Exact_point, 4> columns;
  for (std::size_t k = 0; k < 4; ++k) columns[k] = {h[0][k], h[1][k], h[2][k]};
  const Rational d = determinant(columns[0], columns[1], columns[2]);
  if (d == 0) return std::nullopt;
  return Exact_point{Rational(-determinant(columns[3], columns[1], columns[2]) / d),
                     Rational(-determinant(columns[0], columns[3], columns[2]) / d),
                     Rational(-determinant(columns[0], columns[1], columns[3]) / d)};
}

/// An eye in none, one, two or three of the planes, a little off them, or far away.
Exact_point some_eye(const Plane_list& planes, Random& random) {
  for (;;) {
    std::array<Plane4, 3> through;
    const std::uint64_t in = planes.empty() ? 0 : random.below(4);
    for (std::size_t k = 0; k < 3; ++k) {
      for (Rational& c : through[k])
        c = fraction(random.between(-40, 40), static_cast<unsigned long>(random.between(1, 9)));
      if (k < in) through[k] = planes[random.below(planes.size())];
    }
    std::optional<Exact_point> p = meet(through);
    if (!p) continue;
    const std::uint64_t kind = random.below(4);
    for (Rational& x : *p) {
      if (kind == 1) x += exact_decimal(random.between(-9, 9), -30);
      if (kind == 2) x += exact_decimal(random.between(-9, 9), 30);
    }
    return *p;
  }
}

// ---- View cells

struct Condition {
  std::vector<Rational> form;  ///< coefficients, then the constant
  bool strict;                 ///< positive, or not negative
};

/// Whether all conditions can hold at once, by Fourier's and Motzkin's elimination of one variable after the other.
bool feasible(std::vector<Condition> conditions) {
  while (!conditions.empty() && conditions[0].form.size() > 1) {
    std::vector<Condition> rest;
    for (const Condition& low : conditions) {
      if (low.form[0] == 0) rest.push_back({{low.form.begin() + 1, low.form.end()}, low.strict});
      if (low.form[0] <= 0) continue;
      for (const Condition& high : conditions) {
        if (high.form[0] >= 0) continue;
        Condition both{{}, low.strict || high.strict};
        for (std::size_t k = 1; k < low.form.size(); ++k)
          both.form.push_back(low.form[k] / low.form[0] - high.form[k] / high.form[0]);
        rest.push_back(both);
      }
    }
    conditions = std::move(rest);
  }
  return std::all_of(conditions.begin(), conditions.end(),
                     [](const Condition& c) { return c.strict ? c.form[0] > 0 : c.form[0] >= 0; });
}
/// Whether an eye, or an open set of eyes, has these faces on-view and no others.
bool occurs(const Plane_list& planes, std::uint32_t on, bool open) {
  std::vector<Condition> conditions;
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const bool front = on >> k & 1;
    std::vector<Rational> form;
    for (const Rational& c : planes[k]) form.push_back(front ? c : -c);
    conditions.push_back({form, front || open});
  }
  return feasible(conditions);
}

/// Whether cells ascend, samples see what they should, and are off all planes just where the cell is open.
testing::AssertionResult sound(const std::vector<View_cell>& cells, const Plane_list& planes) {
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (k > 0 && cells[k - 1].on_view >= cells[k].on_view)
      return testing::AssertionFailure() << "cell " << k << " does not ascend";
    if (signs_from(planes, cells[k].sample) != cells[k].on_view)
      return testing::AssertionFailure() << "cell " << k << ": its sample sees something else";
    if (on_view_from(planes, cells[k].sample) != cells[k].on_view)
      return testing::AssertionFailure() << "cell " << k << ": on_view_from sees something else";
    const bool off_planes =
        std::none_of(planes.begin(), planes.end(), [&](const Plane4& h) { return value_at(h, cells[k].sample) == 0; });
    if (cells[k].open != off_planes)
      return testing::AssertionFailure() << "cell " << k << ": open " << cells[k].open << ", its sample off all planes "
                                         << off_planes;
  }
  return testing::AssertionSuccess();
}
Sets sets_of(const std::vector<View_cell>& cells, bool open_only = false) {
  Sets sets;
  for (const View_cell& cell : cells)
    if (cell.open || !open_only) sets.insert(cell.on_view);
  return sets;
}
/// As above, and whether these are all sets that occur.
testing::AssertionResult right_cells(const Plane_list& planes) {
  const std::vector<View_cell> cells = view_cells(planes);
  if (const testing::AssertionResult result = sound(cells, planes); !result) return result;
  const Sets all = sets_of(cells), open = sets_of(cells, true);
  for (std::uint32_t on = 0; on >> planes.size() == 0; ++on) {
    if (all.contains(on) != occurs(planes, on, false))
      return testing::AssertionFailure() << "set " << on << (all.contains(on) ? " cannot occur" : " is missing");
    if (open.contains(on) != occurs(planes, on, true))
      return testing::AssertionFailure() << "set " << on << (open.contains(on) ? " is not open" : " is open");
  }
  return testing::AssertionSuccess();
}

TEST(View_cells, are_the_sets_that_elimination_finds_on_degenerate_sets_of_planes) {
  std::size_t flat = 0, bodies = 0, without_none = 0;
  for (std::uint64_t k = 0; k < test_scenes::sample(300u); ++k) {
    Random random(k);
    const Plane_list planes = k % 5 == 0 ? random_planes(random.below(7), 9, random)
                                         : degenerate_planes(random.below(k % 20 == 1 ? 8 : 7), random);
    ASSERT_TRUE(right_cells(planes)) << "planes " << k;
    const Sets all = sets_of(view_cells(planes)), open = sets_of(view_cells(planes), true);
    flat += all != open;
    bodies += open.contains(0);
    without_none += !all.contains(0);
  }
  EXPECT_GT(flat, test_scenes::least(40u));
  EXPECT_GT(bodies, test_scenes::least(60u));
  EXPECT_GT(without_none, test_scenes::least(10u));
}

TEST(View_cells, of_a_box_are_27_and_26_of_them_outside) {
  const std::vector<View_cell> cells = view_cells(box());
  ASSERT_TRUE(right_cells(box()));
  Sets expected;
  for (const std::uint32_t x : {0, 1, 2})
    for (const std::uint32_t y : {0, 4, 8})
      for (const std::uint32_t z : {0, 16, 32}) expected.insert(x | y | z);
  EXPECT_EQ(sets_of(cells), expected);
  EXPECT_EQ(sets_of(cells, true), expected);
  for (std::uint32_t face = 0; face < 6; ++face)
    EXPECT_EQ(
        std::count_if(cells.begin(), cells.end(), [face](const View_cell& cell) { return cell.on_view >> face & 1; }),
        9)
        << "9 on-view and 17 off-view of the 26";
}

TEST(View_cells, of_a_convex_body_are_all_taken_on_open_sets_of_eyes) {
  const std::vector<std::pair<Plane_list, std::size_t>> bodies{
      {tetrahedron(), 15}, {triangular_prism(), 21}, {hexagonal_prism(), 57}, {octahedron(), 59}};
  for (const auto& [planes, count] : bodies) {
    EXPECT_TRUE(right_cells(planes)) << planes.size() << " faces";
    EXPECT_EQ(view_cells(planes).size(), count) << planes.size() << " faces";
    EXPECT_EQ(sets_of(view_cells(planes), true).size(), count) << planes.size() << " faces";
  }
}

TEST(View_cells, of_planes_in_general_position_are_as_many_as_the_formula_says) {
  for (std::size_t n = 0; n <= 12; ++n) {
    Random random(n + 1);
    const std::vector<View_cell> cells = view_cells(random_planes(n, 1 << 20, random));
    EXPECT_EQ(cells.size(), 1 + n + n * (n - 1) / 2 + n * (n - 1) * (n - 2) / 6) << n;
    EXPECT_TRUE(std::all_of(cells.begin(), cells.end(), [](const View_cell& cell) { return cell.open; })) << n;
  }
}

TEST(View_cells, of_no_planes_is_one_and_of_one_plane_two) {
  EXPECT_EQ(view_cells({}).size(), 1u);
  EXPECT_TRUE(view_cells({})[0].open);
  EXPECT_EQ(view_cells({})[0].on_view, 0u);
  EXPECT_EQ(sets_of(view_cells(planes_of({{0, 0, 7}})), true), (Sets{0, 1}));
}

TEST(View_cells, tell_coincident_planes_by_their_senses) {
  const Plane_list back_to_back{{2, 4, -6, 10}, {-1, -2, 3, -5}}, twice{{2, 4, -6, 10}, {1, 2, -3, 5}};
  EXPECT_EQ(sets_of(view_cells(back_to_back)), (Sets{0, 1, 2})) << "the first, the second, and neither from the plane";
  EXPECT_EQ(sets_of(view_cells(back_to_back), true), (Sets{1, 2}));
  EXPECT_EQ(sets_of(view_cells(twice)), (Sets{0, 3}));
  EXPECT_EQ(sets_of(view_cells(twice), true), (Sets{0, 3}));
}

TEST(View_cells, of_parallel_planes_are_slabs) {
  const Plane_list one_way = planes_of({{0, 0, 1}, {0, 0, 2}, {0, 0, 4}}, 4);  // z > 4, z > 2, z > 1
  EXPECT_EQ(sets_of(view_cells(one_way), true), (Sets{0, 4, 6, 7}));
  EXPECT_EQ(sets_of(view_cells(one_way)), (Sets{0, 4, 6, 7}));
  EXPECT_EQ(sets_of(view_cells(planes_of({{1, 0, 0}, {-1, 0, 0}}))), (Sets{0, 1, 2})) << "a slab between";
  EXPECT_EQ(sets_of(view_cells(planes_of({{1, 0, 0}, {-1, 0, 0}}, -1))), (Sets{1, 2, 3}))
      << "fronts towards one another: everyone sees one";
}

TEST(View_cells, list_what_only_eyes_in_planes_see) {
  // The planes of a tetrahedron that has shrunk to a point: there nothing is on-view, round it always something.
  const std::vector<View_cell> point = view_cells(tetrahedron(0));
  ASSERT_TRUE(right_cells(tetrahedron(0)));
  ASSERT_EQ(point.size(), 15u);
  EXPECT_EQ(point[0].on_view, 0u);
  EXPECT_FALSE(point[0].open);
  EXPECT_EQ(point[0].sample, (Exact_point{0, 0, 0}));
  EXPECT_EQ(sets_of(point, true).size(), 14u);
  // A prism without ends that has shrunk to a line: nothing is on-view from it.
  const Plane_list through_line{{2, 0, 0, -6}, {-1, 2, 0, 1}, {-1, -2, 0, 5}};
  const std::vector<View_cell> line = view_cells(through_line);
  ASSERT_TRUE(right_cells(through_line));
  EXPECT_EQ(sets_of(line), (Sets{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(sets_of(line, true), (Sets{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(line[0].sample[0], 3);
  EXPECT_EQ(line[0].sample[1], 1);
}

TEST(View_cells, hold_what_any_eye_sees_also_in_planes_on_edges_at_vertices_and_far_away) {
  std::size_t in_planes = 0, off_planes = 0;
  for (std::uint64_t k = 0; k < 40; ++k) {
    Random random(k + 300);
    const Plane_list planes = k == 0       ? dodecahedron()
                              : k % 4 == 1 ? random_body(6 + k / 4, random)
                                           : degenerate_planes(3 + k / 5, random);
    const std::vector<View_cell> cells = view_cells(planes);
    ASSERT_TRUE(sound(cells, planes)) << "planes " << k;
    const Sets all = sets_of(cells), open = sets_of(cells, true);
    for (int eye = 0; eye < test_scenes::sample(200); ++eye) {
      const Exact_point p = some_eye(planes, random);
      const bool off = std::none_of(planes.begin(), planes.end(), [&](const Plane4& h) { return value_at(h, p) == 0; });
      ASSERT_TRUE((off ? open : all).contains(signs_from(planes, p))) << "planes " << k << ", eye " << eye;
      ++(off ? off_planes : in_planes);
    }
  }
  EXPECT_GT(in_planes, test_scenes::least(2000u));
  EXPECT_GT(off_planes, test_scenes::least(2000u));
}

TEST(View_cells, follow_the_order_of_planes_and_not_their_scale_or_place) {
  for (std::uint64_t k = 0; k < 60; ++k) {
    Random random(k + 900);
    const Plane_list planes = degenerate_planes(2 + random.below(6), random);
    const Sets all = sets_of(view_cells(planes)), open = sets_of(view_cells(planes), true);
    Plane_list moved = planes, in_disorder, turned = planes;
    for (Plane4& h : moved) {  // x' = 10^-50 x + 10^8 (1, -2, 3), and each plane by a factor of its own
      const Rational factor = fraction(random.between(1, 99), 7);
      const Rational offset = h[3] * exact_decimal(1, -50) - 100000000 * (h[0] - 2 * h[1] + 3 * h[2]);
      h = {Rational(factor * h[0]), Rational(factor * h[1]), Rational(factor * h[2]), Rational(factor * offset)};
    }
    EXPECT_EQ(sets_of(view_cells(moved)), all) << "planes " << k;
    EXPECT_EQ(sets_of(view_cells(moved), true), open) << "planes " << k;

    std::vector<std::size_t> order(planes.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    random.shuffle(order);
    for (const std::size_t i : order) in_disorder.push_back(planes[i]);
    Sets renamed;
    for (const std::uint32_t on : sets_of(view_cells(in_disorder))) {
      std::uint32_t name = 0;
      for (std::size_t i = 0; i < order.size(); ++i) name |= (on >> i & 1) << order[i];
      renamed.insert(name);
    }
    EXPECT_EQ(renamed, all) << "planes " << k;

    for (Plane4& h : turned)
      for (Rational& c : h) c = -c;
    Sets complements;
    for (const std::uint32_t on : sets_of(view_cells(turned), true))
      complements.insert(((1u << planes.size()) - 1) & ~on);
    EXPECT_EQ(complements, open) << "planes " << k;
  }
}

TEST(View_cells, refuse_planes_without_a_normal_and_too_many) {
  EXPECT_THROW(view_cells(Plane_list{{1, 0, 0, 0}, {0, 0, 0, 1}}), std::invalid_argument);
  Random random(1);
  EXPECT_THROW(view_cells(random_planes(most_view_faces + 1, 99, random)), std::invalid_argument);
  EXPECT_EQ(view_cells(Plane_list(most_view_faces, Plane4{1, 2, 3, 4})).size(), 2u);
}

// ---- Decision trees

using Views = std::vector<Weighted_view>;

/// The least sum of weight times tests, for all partial assignments of answers, also those that test what is known; and
/// the sets of more than two views that they leave.
struct Assignments {
  const Views& views;
  unsigned faces;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Rational> known;
  std::set<std::vector<std::uint32_t>> sets;

  Rational least(std::uint32_t on = 0, std::uint32_t off = 0) {
    const auto [at, is_new] = known.try_emplace({on, off});
    if (!is_new) return at->second;
    std::vector<std::uint32_t> left;
    Rational weight = 0, best = -1;
    for (const Weighted_view& view : views)
      if ((view.on_view & on) == on && (view.on_view & off) == 0) {
        left.push_back(view.on_view);
        weight += view.weight;
      }
    if (left.size() < 2) best = 0;
    if (left.size() > 2) sets.insert(left);
    for (unsigned face = 0; left.size() > 1 && face < faces; ++face) {
      if ((on | off) >> face & 1) continue;
      const Rational cost = weight + least(on | 1u << face, off) + least(on, off | 1u << face);
      if (best < 0 || cost < best) best = cost;
    }
    return known[{on, off}] = best;
  }
};

/// The least of any binary tree with these weights at its ends: over all ways to split them in two.
Rational least_of_any_tree(const std::vector<Rational>& weights) {
  const std::size_t all = std::size_t{1} << weights.size();
  std::vector<Rational> cost(all);
  for (std::size_t set = 1; set < all; ++set) {
    if (std::has_single_bit(set)) continue;
    Rational best = -1;
    for (std::size_t part = (set - 1) & set; part != 0; part = (part - 1) & set)
      if (const Rational sum = cost[part] + cost[set - part]; best < 0 || sum < best) best = sum;
    cost[set] = best;
    for (std::size_t k = 0; k < weights.size(); ++k)
      if (set >> k & 1) cost[set] += weights[k];
  }
  return cost[all - 1];
}

Rational weight_of(const Views& views) {
  Rational sum = 0;
  for (const Weighted_view& view : views) sum += view.weight;
  return sum;
}

/// Whether each view ends one path, no path asks what is known, and the expectation is what running the tree takes.
/// Pre: no view is given twice.
testing::AssertionResult sound(const Decision_tree& tree, const Views& views, unsigned faces) {
  if (tree.views.size() != views.size()) return testing::AssertionFailure() << tree.views.size() << " views";
  if (tree.steps.size() + 1 != views.size()) return testing::AssertionFailure() << tree.steps.size() << " steps";
  Rational sum = 0;
  for (const Weighted_view& view : views) {
    std::uint32_t asked = 0;
    unsigned tests = 0;
    const auto answer = [&](std::uint32_t face) {
      if (face >= faces || asked >> face & 1)
        throw std::logic_error("face " + std::to_string(face) + " is asked twice or is none");
      asked |= 1u << face;
      return (view.on_view >> face & 1) != 0;
    };
    if (tree.run(answer, &tests) != view.on_view)
      return testing::AssertionFailure() << "view " << view.on_view << " is taken for another";
    if (tests != static_cast<unsigned>(std::popcount(asked)))
      return testing::AssertionFailure() << "view " << view.on_view << ": " << tests << " tests";
    sum += view.weight * tests;
  }
  // As each of n ends is reached and there are n - 1 steps, no step has only one side.
  if (tree.expected != sum / weight_of(views))
    return testing::AssertionFailure() << tree.expected << " expected tests, not " << Rational(sum / weight_of(views));
  if (tree.bound > tree.expected || tree.expected > faces)
    return testing::AssertionFailure() << tree.expected << " expected tests, bound " << tree.bound;
  for (std::size_t k = 0; k < tree.steps.size(); ++k)
    for (const std::uint32_t child : {tree.steps[k].on, tree.steps[k].off})
      if (!(child & Decision_tree::leaf) && child <= k)
        return testing::AssertionFailure() << "step " << k << " goes back";
  return testing::AssertionSuccess();
}
/// As above, and whether the expectation is the least, and the first test the lowest that it can begin with.
testing::AssertionResult optimal(const Decision_tree& tree, const Views& views, unsigned faces) {
  if (const testing::AssertionResult result = sound(tree, views, faces); !result) return result;
  Assignments oracle{views, faces, {}, {}};
  const Rational least = oracle.least(), weight = weight_of(views);
  if (tree.expected != least / weight)
    return testing::AssertionFailure() << tree.expected << " expected tests, least " << Rational(least / weight);
  if (views.size() > 2 && tree.states + 1 != oracle.sets.size())
    return testing::AssertionFailure() << tree.states << " states of " << oracle.sets.size() - 1;
  for (std::uint32_t face = 0; views.size() > 1 && face < tree.steps[0].face; ++face)
    if (least == weight + oracle.least(1u << face, 0) + oracle.least(0, 1u << face))
      return testing::AssertionFailure() << "face " << face << " would do as well";
  return testing::AssertionSuccess();
}

TEST(Decision_tree, of_a_box_takes_64_13ths_and_the_62_13ths_of_the_paper_are_what_no_tree_can_be_below) {
  const Views views = uniform_likelihood(view_cells(box()));
  ASSERT_EQ(views.size(), 26u);
  const Decision_tree tree = least_tests(views, 6);
  EXPECT_EQ(tree.expected, fraction(64, 13)) << "128 tests for 26 views: 4.923";
  EXPECT_EQ(tree.bound, fraction(62, 13)) << "124 tests for 26 views: 4.769";
  EXPECT_TRUE(optimal(tree, views, 6));

  const Views with_inside = uniform_likelihood(view_cells(box()), true);
  ASSERT_EQ(with_inside.size(), 27u);
  const Decision_tree also_inside = least_tests(with_inside, 6);
  EXPECT_EQ(also_inside.expected, fraction(129, 26));
  EXPECT_TRUE(optimal(also_inside, with_inside, 6));
}

TEST(Decision_tree, asks_all_the_time_and_ends_by_what_that_throws) {
  std::size_t asked = 0, throws_at = 0;
  const auto ask = [&] {
    if (++asked == throws_at) throw std::runtime_error("enough");
  };
  const std::vector<View_cell> cells = view_cells(box(), ask);
  EXPECT_EQ(cells.size(), view_cells(box()).size());
  EXPECT_GE(asked, 6u);  // for each plane
  const Views views = uniform_likelihood(cells);
  asked = 0;
  const Decision_tree tree = least_tests(views, 6, Decision_tree::most_states, ask);
  EXPECT_GE(asked, tree.states);
  asked = 0;
  throws_at = 3;
  EXPECT_THROW(least_tests(views, 6, Decision_tree::most_states, ask), std::runtime_error);
  asked = 0;
  EXPECT_THROW(view_cells(box(), ask), std::runtime_error);
}

TEST(Decision_tree, of_other_bodies_is_what_all_partial_assignments_say) {
  struct Known {
    Plane_list planes;
    Rational expected, bound;
  };
  const std::vector<Known> bodies{{tetrahedron(), fraction(27, 7), fraction(27, 7)},
                                  {triangular_prism(), fraction(89, 20), fraction(22, 5)},
                                  {hexagonal_prism(), fraction(341, 56), fraction(41, 7)},
                                  {octahedron(), fraction(351, 58), fraction(171, 29)}};
  for (const Known& body : bodies) {
    const unsigned faces = static_cast<unsigned>(body.planes.size());
    for (const bool inside : {false, true}) {
      const Views views = uniform_likelihood(view_cells(body.planes), inside);
      const Decision_tree tree = least_tests(views, faces);
      EXPECT_TRUE(optimal(tree, views, faces)) << faces << " faces";
      if (inside) continue;
      EXPECT_EQ(tree.expected, body.expected) << faces << " faces";
      EXPECT_EQ(tree.bound, body.bound) << faces << " faces";
    }
  }
}

TEST(Decision_tree, of_bodies_in_general_position_too) {
  for (const std::size_t faces : {7, 8, 9}) {
    Random random(faces);
    Views views = uniform_likelihood(view_cells(random_body(faces, random)), true);
    EXPECT_EQ(views.size(), 1 + faces + faces * (faces - 1) / 2 + faces * (faces - 1) * (faces - 2) / 6);
    for (Weighted_view& view : views) view.weight = random.between(0, 20);
    EXPECT_TRUE(optimal(least_tests(views, static_cast<unsigned>(faces)), views, static_cast<unsigned>(faces)))
        << faces << " faces";
  }
}

TEST(Decision_tree, is_optimal_for_random_likelihoods) {
  std::size_t above_bound = 0, at_bound = 0, costless = 0;
  for (std::uint64_t k = 0; k < test_scenes::sample(2000u); ++k) {
    Random random(k);
    const unsigned faces = static_cast<unsigned>(1 + random.below(5));
    const std::uint64_t density = 1 + random.below(8), most = random.chance(1, 3) ? 1 : random.chance(1, 2) ? 3 : 1000;
    Views views;
    for (std::uint32_t on = 0; on >> faces == 0; ++on)
      if (random.chance(density, 8))
        views.push_back({on, fraction(random.between(0, static_cast<long>(most)),
                                      static_cast<unsigned long>(random.between(1, 3)))});
    if (views.empty()) views.push_back({0, 1});
    if (weight_of(views) == 0) views.back().weight = 1;
    random.shuffle(views);
    const Decision_tree tree = least_tests(views, faces);
    ASSERT_TRUE(optimal(tree, views, faces)) << "likelihood " << k;
    ++(tree.bound < tree.expected ? above_bound : at_bound);
    costless += std::any_of(views.begin(), views.end(), [](const Weighted_view& view) { return view.weight == 0; });
  }
  EXPECT_GT(above_bound, test_scenes::least(500u));
  EXPECT_GT(at_bound, test_scenes::least(200u));
  EXPECT_GT(costless, test_scenes::least(500u));
}

TEST(Decision_tree, is_optimal_for_the_cells_of_degenerate_planes_and_their_flat_views) {
  std::size_t flat = 0;
  for (std::uint64_t k = 0; k < 150; ++k) {
    Random random(k + 50);
    const unsigned faces = static_cast<unsigned>(2 + random.below(5));
    const std::vector<View_cell> cells = view_cells(degenerate_planes(faces, random));
    const Views views = uniform_likelihood(cells, true);
    ASSERT_EQ(views.size(), cells.size());
    for (std::size_t i = 0; i < views.size(); ++i)
      EXPECT_EQ(views[i].weight, cells[i].open && cells[i].on_view != 0 ? 1 : 0);
    EXPECT_EQ(uniform_likelihood(cells).size(), views.size() - (views[0].on_view == 0));
    flat +=
        std::any_of(cells.begin(), cells.end(), [](const View_cell& cell) { return !cell.open && cell.on_view != 0; });
    ASSERT_TRUE(optimal(least_tests(views, faces), views, faces)) << "planes " << k;
  }
  EXPECT_GT(flat, 30u);
}

TEST(Decision_tree, has_the_bound_of_the_best_binary_tree) {
  for (std::uint64_t k = 0; k < 300; ++k) {
    Random random(k + 7000);
    Views views;
    std::vector<Rational> weights;
    const std::uint64_t most = random.chance(1, 2) ? 3 : 100, count = 1 + random.below(9);
    for (std::uint32_t on = 0; on < count; ++on) {
      weights.push_back(random.between(on == 0, static_cast<long>(most)));
      views.push_back({on, weights.back()});
    }
    ASSERT_EQ(least_tests(views, 4).bound, least_of_any_tree(weights) / weight_of(views)) << "likelihood " << k;
  }
}

TEST(Decision_tree, run_from_any_eye_finds_all_faces_that_are_on_view) {
  std::size_t eyes = 0, in_planes = 0, none = 0;
  for (std::uint64_t k = 0; k < 24; ++k) {
    Random random(k + 40);
    const Plane_list planes = k == 0       ? dodecahedron()
                              : k == 1     ? box()
                              : k % 3 == 0 ? degenerate_planes(4 + k / 4, random)
                                           : random_body(4 + k / 3, random);
    const unsigned faces = static_cast<unsigned>(planes.size());
    const std::vector<View_cell> cells = view_cells(planes);
    const Views outside = uniform_likelihood(cells), everywhere = uniform_likelihood(cells, true);
    const Decision_tree tree = least_tests(outside, faces), inside_too = least_tests(everywhere, faces);
    ASSERT_TRUE(sound(tree, outside, faces)) << "planes " << k;
    ASSERT_TRUE(sound(inside_too, everywhere, faces)) << "planes " << k;
    for (int eye = 0; eye < 250; ++eye) {
      const Exact_point p = some_eye(planes, random);
      const auto is_on_view = [&](std::uint32_t face) { return value_at(planes[face], p) > 0; };
      const std::uint32_t expected = signs_from(planes, p);
      unsigned tests = 0;
      ASSERT_EQ(inside_too.run(is_on_view, &tests), expected) << "planes " << k << ", eye " << eye;
      ASSERT_LE(tests, faces);
      if (expected != 0) {
        ASSERT_EQ(tree.run(is_on_view), expected) << "planes " << k << ", eye " << eye;
      }
      ++eyes;
      none += expected == 0;
      in_planes += std::any_of(planes.begin(), planes.end(), [&](const Plane4& h) { return value_at(h, p) == 0; });
    }
  }
  EXPECT_EQ(eyes, 6000u);
  EXPECT_GT(in_planes, 1500u);
  EXPECT_GT(none, 50u);
}

TEST(Decision_tree, tests_likely_faces_first) {
  // Nearly always the corner of faces 1, 3 and 5 is seen, as the paper has it: then three tests of six will do.
  const auto likely_corner = [](const Rational& others) {
    Views views = uniform_likelihood(view_cells(box()));
    for (Weighted_view& view : views)
      if (view.on_view != 0b101010) view.weight = others;
    return views;
  };
  const Decision_tree tree = least_tests(likely_corner(0), 6);
  EXPECT_EQ(tree.expected, 3);
  std::vector<std::uint32_t> asked;
  tree.run([&](std::uint32_t face) {
    asked.push_back(face);
    return face % 2 == 1;
  });
  EXPECT_EQ(asked, (std::vector<std::uint32_t>{1, 3, 5}));

  const Views views = likely_corner(fraction(1, 1000));
  const Decision_tree nearly = least_tests(views, 6);
  EXPECT_TRUE(optimal(nearly, views, 6));
  EXPECT_GT(nearly.expected, 3);
  EXPECT_LT(nearly.expected, fraction(31, 10));
  EXPECT_EQ(nearly.steps[0].face, 1u);
}

TEST(Decision_tree, minds_the_smallest_difference_and_takes_the_lowest_of_equal_faces) {
  const Rational more = 1 + Rational(1, Integer(1) << 200);
  const auto first = [](const Rational& of_0, const Rational& of_1) {
    return least_tests(Views{{0, 1}, {1, of_0}, {2, of_1}}, 2).steps[0].face;
  };
  EXPECT_EQ(first(1, 1), 0u);
  EXPECT_EQ(first(more, 1), 0u);
  EXPECT_EQ(first(1, more), 1u);
}

TEST(Decision_tree, does_not_depend_on_the_width_of_weights_or_the_order_of_views) {
  for (std::uint64_t k = 0; k < 40; ++k) {
    Random random(k);
    Views views = uniform_likelihood(view_cells(random_body(6, random)));
    for (Weighted_view& view : views) view.weight = random.between(0, 50);
    const Decision_tree tree = least_tests(views, 6);
    const Integer total = weight_of(views).get_num();
    // Totals of one bit, of 57 or 58 bits on either side of 64-bit arithmetic, of 300 bits, and weights that are no
    // integers.
    const Integer narrow = ((Integer(1) << 57) - 1) / total, wide = (Integer(1) << 57) / total + 1,
                  wider = (Integer(1) << 300) / total;
    for (const Rational& factor : {Rational(narrow), Rational(wide), Rational(wider), Rational(1, wider)}) {
      Views scaled = views;
      for (Weighted_view& view : scaled) {
        view.weight *= factor;
        view.weight.canonicalize();
      }
      random.shuffle(scaled);
      const Decision_tree same = least_tests(scaled, 6);
      EXPECT_EQ(same.expected, tree.expected) << "body " << k;
      EXPECT_EQ(same.bound, tree.bound) << "body " << k;
      EXPECT_EQ(same.states, tree.states) << "body " << k;
      EXPECT_EQ(same.views, tree.views) << "body " << k;
      ASSERT_EQ(same.steps.size(), tree.steps.size());
      for (std::size_t i = 0; i < tree.steps.size(); ++i) {
        EXPECT_EQ(same.steps[i].face, tree.steps[i].face) << "body " << k;
        EXPECT_EQ(same.steps[i].on, tree.steps[i].on) << "body " << k;
        EXPECT_EQ(same.steps[i].off, tree.steps[i].off) << "body " << k;
      }
    }
  }
}

TEST(Decision_tree, of_one_view_takes_no_test_and_a_view_given_twice_counts_once) {
  const Decision_tree one = least_tests(Views{{5, 2}}, 3);
  EXPECT_TRUE(one.steps.empty());
  EXPECT_EQ(one.expected, 0);
  EXPECT_EQ(one.bound, 0);
  EXPECT_EQ(one.run([](std::uint32_t) -> bool { throw std::logic_error("a test"); }), 5u);
  const Decision_tree twice = least_tests(Views{{0, 1}, {1, 1}, {2, 1}, {2, 1}}, 2),
                      once = least_tests(Views{{0, 1}, {1, 1}, {2, 2}}, 2);
  EXPECT_EQ(twice.views.size(), 3u);
  EXPECT_EQ(twice.steps[0].face, 1u);
  EXPECT_EQ(twice.expected, fraction(3, 2));
  EXPECT_EQ(once.expected, fraction(3, 2));
}

TEST(Decision_tree, takes_32_faces) {
  Views views{{0, Integer(1) << 64}};  // each has one more face than the one before it, and a quarter of its weight
  for (unsigned k = 1; k <= 32; ++k) views.push_back({~std::uint32_t{0} << (32 - k), Integer(1) << (64 - 2 * k)});
  const Decision_tree tree = least_tests(views, 32);
  EXPECT_TRUE(sound(tree, views, 32));
  EXPECT_EQ(tree.expected, tree.bound);
  EXPECT_EQ(tree.steps[0].face, 31u) << "from the likely to the unlikely, one by one";
  EXPECT_EQ(tree.steps[31].face, 0u);
}

TEST(Decision_tree, says_what_is_wrong) {
  EXPECT_THROW(least_tests(Views{}, 3), std::invalid_argument);
  EXPECT_THROW(least_tests(Views{{1, 0}, {2, 0}}, 3), std::invalid_argument);
  EXPECT_THROW(least_tests(Views{{1, 2}, {2, -1}}, 3), std::invalid_argument);
  EXPECT_THROW(least_tests(Views{{8, 1}, {2, 1}}, 3), std::invalid_argument);
  EXPECT_NO_THROW(least_tests(Views{{8, 1}, {2, 1}}, 4));
  EXPECT_THROW(least_tests(Views{{8, 1}, {2, 1}}, 33), std::invalid_argument);
}

TEST(Decision_tree, ends_a_search_that_is_too_long) {
  const Views views = uniform_likelihood(view_cells(box()));
  const std::size_t states = least_tests(views, 6).states;
  EXPECT_EQ(least_tests(views, 6, states).expected, fraction(64, 13));
  EXPECT_THROW(least_tests(views, 6, states - 1), std::length_error);
}

}  // namespace
