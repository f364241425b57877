// Hidden lines against brute force, and the classes of edges.

#include "support.h"

#include <sightline/algorithms/point_visibility/hidden_lines.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

namespace sightline::see_test {
namespace {

class Lines : public testing::TestWithParam<view_scenes::Family> {};

/// What is visible of an edge, neighbouring parts joined.
std::vector<oracle::Interval> visible(const std::vector<Line_part>& parts) {
  std::vector<oracle::Interval> found;
  for (const Line_part& part : parts) {
    if (part.hidden_by != Line_part::nothing) continue;
    if (!found.empty() && found.back().to == part.from) found.back().to = part.to;
    else found.push_back({part.from, part.to});
  }
  return found;
}

TEST_P(Lines, are_hidden_as_brute_force_hides_them) {
  std::size_t compared = 0, hidden = 0;
  for (std::uint64_t seed = 1; seed <= 6 && !HasFatalFailure(); ++seed)
    for (const view_scenes::Case& given : view_scenes::make(GetParam(), seed)) {
      SCOPED_TRACE(given.name);
      const Scene scene(given.soup);
      const Exact_view view(scene, given.eye);
      const auto surface = visible_surface(view, Piece_boxes(scene));
      const oracle::Flats flats = oracle::flats_of(scene);
      for (const Drawn_edge& drawn : hidden_lines(view, surface)) {
        const Exact_point a = scene.position(drawn.edge.p), b = scene.position(drawn.edge.q);
        SCOPED_TRACE("edge of face " + std::to_string(flats[drawn.edge.pieces[0]].face) + ", points " +
                     std::to_string(drawn.edge.p) + " and " + std::to_string(drawn.edge.q));
        ASSERT_EQ(visible(drawn.parts), oracle::visible_on_edge(flats, given.eye, a, b));
        ++compared;
        // One after the other, from end to end; what hides a part meets the sightlines to it.
        if (drawn.parts.empty()) continue;
        ASSERT_EQ(drawn.parts.front().from, 0);
        ASSERT_EQ(drawn.parts.back().to, 1);
        for (std::size_t k = 0; k < drawn.parts.size(); ++k) {
          const Line_part& part = drawn.parts[k];
          ASSERT_LT(part.from, part.to);
          ASSERT_EQ(part.from, k == 0 ? Rational(0) : drawn.parts[k - 1].to);
          if (part.hidden_by == Line_part::nothing) continue;
          ++hidden;
          for (const Rational& share : {Rational(1, 2), Rational(1, 1000), Rational(999, 1000)})
            ASSERT_TRUE(
                oracle::blocks(flats[part.hidden_by], given.eye,
                               oracle::along(a, part.from + share * (part.to - part.from), oracle::minus(b, a))));
        }
      }
    }
  EXPECT_GT(compared, 50u);
  EXPECT_GT(hidden, 10u);
}

/// The classes of the edges of some faces, by number: boundary, silhouette, smooth, crease.
std::array<int, 4> classes(const std::vector<view_scenes::Points>& faces, const Exact_point& eye) {
  const Scene scene(view_scenes::soup_of(faces));
  const Exact_view view(scene, eye);
  std::array<int, 4> found{};
  for (const Scene_edge& edge : scene_edges(scene)) ++found[static_cast<std::size_t>(classify(view, edge))];
  return found;
}

TEST(Edges, are_of_one_class_each) {
  using view_scenes::rectangle;
  const std::vector<view_scenes::Points> cube = view_scenes::box({0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(classes(cube, {3, -4, 5}), (std::array{0, 6, 0, 6}));
  EXPECT_EQ(classes(cube, {view_scenes::ratio(1, 2), view_scenes::ratio(1, 2), 5}), (std::array{0, 4, 0, 8}));
  EXPECT_EQ(classes(cube, {view_scenes::ratio(1, 2), view_scenes::ratio(1, 2), view_scenes::ratio(1, 2)}),
            (std::array{0, 0, 0, 12}));
  EXPECT_EQ(classes({rectangle(0, 1, 0, 1, 0), rectangle(1, 2, 0, 1, 0)}, {0, 0, 5}), (std::array{6, 0, 1, 0}));
  // An L is two pieces or more, and has six edges.
  EXPECT_EQ(classes({{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}}, {0, 0, 5}),
            (std::array{6, 0, 0, 0}));
  // Folded over: both are seen, from one side each.
  EXPECT_EQ(classes({rectangle(0, 1, 0, 1, 0), {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}}, {0, 5, 5})[1] +
                classes({rectangle(0, 1, 0, 1, 0), {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}}, {0, 5, 5})[1],
            1);
}

/// The edges of some faces, by where their ends are, and how many pieces each bounds.
std::map<std::pair<Exact_point, Exact_point>, std::size_t> edges_of(const std::vector<view_scenes::Points>& faces) {
  const Scene scene(view_scenes::soup_of(faces));
  std::map<std::pair<Exact_point, Exact_point>, std::size_t> found;
  for (const Scene_edge& edge : scene_edges(scene))
    found[std::minmax(scene.position(edge.p), scene.position(edge.q))] += edge.pieces.size();
  return found;
}

TEST(Edges, are_where_faces_end_whatever_their_pieces_are) {
  // A corner is in line with two others, so that a diagonal may end at it on one side alone.
  const view_scenes::Points dart{{0, 0, 0}, {4, 1, 0}, {2, 4, 0}, {2, 1, 0}, {0, 1, 0}};
  std::map<std::pair<Exact_point, Exact_point>, std::size_t> sides;
  for (std::size_t k = 0; k < dart.size(); ++k) {
    const Exact_point p = dart[k], q = dart[(k + 1) % dart.size()];
    sides[{std::min(p, q), std::max(p, q)}] = 1;
  }
  view_scenes::Points turned = dart;
  for (std::size_t k = 0; k < dart.size(); ++k) {
    EXPECT_EQ(edges_of({turned}), sides);
    EXPECT_EQ(edges_of({{turned.rbegin(), turned.rend()}}), sides);
    std::rotate(turned.begin(), turned.begin() + 1, turned.end());
  }
  // Another face on a side is at the same edge, one on a diagonal is not.
  const std::pair<Exact_point, Exact_point> side{{0, 1, 0}, {2, 1, 0}}, inside{{2, 1, 0}, {4, 1, 0}};
  auto both = edges_of({dart, {side.first, side.second, {1, 1, 3}}});
  EXPECT_EQ(both.size(), 7u);
  EXPECT_EQ(both.at(side), 2u);
  both = edges_of({dart, {inside.first, inside.second, {3, 1, 3}}});
  EXPECT_EQ(both.size(), 8u);
  EXPECT_EQ(both.at(inside), 1u);
  // A slit in line with the side of a hole that it ends at: eight sides of two squares are left.
  const view_scenes::Points frame{{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {0, 6, 0}, {0, 2, 0}, {2, 2, 0},
                                  {2, 4, 0}, {4, 4, 0}, {4, 2, 0}, {2, 2, 0}, {0, 2, 0}};
  for (const auto& [ends, pieces] : edges_of({frame})) {
    EXPECT_EQ(pieces, 1u);
    EXPECT_TRUE(ends.first[1] != 2 || ends.second[1] != 2 || ends.first[0] == 2) << "the slit is inside";
  }
}

INSTANTIATE_TEST_SUITE_P(All, Lines, testing::ValuesIn(view_scenes::families),
                         [](const auto& of) { return std::string(view_scenes::name(of.param)); });

}  // namespace
}  // namespace sightline::see_test
