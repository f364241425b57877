// Certificates of priority graphs: by hand, right and wrong in every way.

#include "scenes.h"

#include <sightline/algorithms/verify/graph.h>

#include <random>

namespace verify_test {

/// A scene whose fragments are its faces, in order of priority.
struct Graph_scene {
  Scene scene;
  Graph_certificate certificate;

  void add(const Points& polygon) {
    const Face_id f = scene.face(polygon);
    certificate.fragments.push_back({f, 0, polygon});
  }
  Verdict verdict() const { return verify_graph(scene.soup, certificate); }
};

void expect_accepted(const Graph_scene& given, const std::string& words) {
  const Verdict verdict = given.verdict();
  EXPECT_TRUE(verdict.accepted) << verdict.why;
  EXPECT_NE(verdict.why.find(words), std::string::npos) << verdict.why;
}
void expect_rejected(const Graph_scene& given, const std::string& words,
                     const std::vector<std::size_t>& fragments = {}) {
  const Verdict verdict = given.verdict();
  EXPECT_FALSE(verdict.accepted) << verdict.why;
  EXPECT_NE(verdict.why.find(words), std::string::npos) << verdict.why;
  EXPECT_EQ(verdict.why.find('\n'), std::string::npos);
  EXPECT_EQ(verdict.fragments, fragments) << verdict.why;
}

/// Unit squares above each other, the highest first: n components in one order only.
Graph_scene stack(long n) {
  Graph_scene given;
  for (long k = 0; k < n; ++k) given.add(rectangle(0, 1, 0, 1, n - k)), given.certificate.sizes.push_back(1);
  return given;
}

/// Three triangles around the z axis, fronts up, each with its first corner over the next one's plane and its third
/// below the previous one's.
Graph_scene ring() {
  Graph_scene given;
  const Points corners{at(4, 0, 0), at(-2, 3, 0), at(-2, -3, 0)};
  for (std::size_t k = 0; k < 3; ++k) {
    const Exact_point &from = corners[k], &to = corners[(k + 1) % 3];
    const Exact_point inner{Rational((from[0] + to[0]) / 4), Rational((from[1] + to[1]) / 4), 0};
    given.add({at(from[0], from[1], 1), at(to[0], to[1], -1), inner});
  }
  given.certificate.sizes = {3};
  // All corners of all faces, judged here: find the witnesses by trying.
  const auto& f = given.certificate.fragments;
  const auto height = [&](std::size_t i, const Exact_point& p) {
    const Points& v = f[i].vertices;
    Exact_point n;
    const auto edge = [&](std::size_t a, std::size_t k) -> Rational { return v[a][k] - v[0][k]; };
    for (std::size_t k = 0; k < 3; ++k)
      n[k] = edge(1, (k + 1) % 3) * edge(2, (k + 2) % 3) - edge(1, (k + 2) % 3) * edge(2, (k + 1) % 3);
    return sgn(Rational(n[0] * (p[0] - v[0][0]) + n[1] * (p[1] - v[0][1]) + n[2] * (p[2] - v[0][2])));
  };
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b)
          if (i != j && height(j, f[i].vertices[a]) > 0 && height(i, f[j].vertices[b]) < 0)
            given.certificate.arcs.push_back({i, j, a, b});
  return given;
}

TEST(Graph_certificate, of_a_stack_is_accepted_from_the_top_down_only) {
  expect_accepted(stack(1), "1 strongly connected components of 1 faces");
  expect_accepted(stack(5), "5 strongly connected components of 5 faces");
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = i + 1; j < 5; ++j) {
      Graph_scene given = stack(5);
      std::swap(given.certificate.fragments[i], given.certificate.fragments[j]);
      EXPECT_FALSE(given.verdict().accepted);
      EXPECT_NE(given.verdict().why.find("which has higher priority"), std::string::npos) << given.verdict().why;
    }
}

TEST(Graph_certificate, of_an_empty_scene_is_accepted) {
  expect_accepted(Graph_scene(), "0 strongly connected components of 0 faces");
}

TEST(Graph_certificate, takes_any_order_of_faces_without_arcs) {
  // A cube's faces look outwards: none may obscure another.
  Graph_scene given;
  const auto corner = [](unsigned k) { return at(k & 1, k >> 1 & 1, k >> 2 & 1); };
  for (const std::array<unsigned, 4>& f :
       {std::array<unsigned, 4>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
    given.add({corner(f[0]), corner(f[1]), corner(f[2]), corner(f[3])}), given.certificate.sizes.push_back(1);
  std::mt19937 random(7);
  for (int trial = 0; trial < 20; ++trial) {
    std::shuffle(given.certificate.fragments.begin(), given.certificate.fragments.end(), random);
    expect_accepted(given, "6 strongly connected");
  }
  given.certificate.sizes = {2, 1, 1, 1, 1};
  expect_rejected(given, "is not reached from fragment 0", {0, 1});
}

TEST(Graph_certificate, of_a_ring_needs_arcs_both_ways_and_one_component) {
  const Graph_scene whole = ring();
  ASSERT_GE(whole.certificate.arcs.size(), 3u);
  expect_accepted(whole, "1 strongly connected components of 3 faces");
  Graph_scene apart = whole;
  apart.certificate.sizes = {1, 1, 1}, apart.certificate.arcs.clear();
  EXPECT_NE(apart.verdict().why.find("which has higher priority"), std::string::npos) << apart.verdict().why;
  Graph_scene none = whole;
  none.certificate.arcs.clear();
  expect_rejected(none, "fragment 1 is not reached from fragment 0", {0, 1});
  // Without the arcs into one face, or out of it, it is not held any more.
  for (std::size_t face = 1; face < 3; ++face) {
    Graph_scene in = whole, out = whole;
    std::erase_if(in.certificate.arcs, [&](const auto& arc) { return arc.to == face; });
    std::erase_if(out.certificate.arcs, [&](const auto& arc) { return arc.from == face; });
    EXPECT_NE(in.verdict().why.find("is not reached from fragment 0"), std::string::npos) << in.verdict().why;
    EXPECT_NE(out.verdict().why.find("does not reach fragment 0"), std::string::npos) << out.verdict().why;
  }
}

TEST(Graph_certificate, with_a_witness_that_is_none_is_rejected) {
  const Graph_scene whole = ring();
  std::size_t wrong = 0;
  for (std::size_t k = 0; k < whole.certificate.arcs.size(); ++k)
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) {
        Graph_scene given = whole;
        auto& arc = given.certificate.arcs[k];
        arc.corner_from = a, arc.corner_to = b;
        const bool is_arc =
            std::any_of(whole.certificate.arcs.begin(), whole.certificate.arcs.end(), [&](const auto& other) {
              return other.from == arc.from && other.to == arc.to && other.corner_from == a && other.corner_to == b;
            });
        EXPECT_EQ(given.verdict().accepted, is_arc) << given.verdict().why;
        wrong += !is_arc;
      }
  EXPECT_GT(wrong, 10u);
  Graph_scene self = stack(2);
  self.certificate.sizes = {2};
  self.certificate.arcs = {{0, 1, 0, 0}, {1, 0, 0, 0}};
  expect_rejected(self, "arc 1: the corner of fragment 1 is not in front of fragment 0", {1, 0});
}

TEST(Graph_certificate, with_sizes_or_names_that_do_not_fit_is_rejected) {
  for (const std::vector<std::size_t>& sizes :
       {std::vector<std::size_t>{1, 1}, {1, 1, 2}, {4}, {1, 1, 1, 1}, {}, {~std::size_t{0}, 1}}) {
    Graph_scene given = stack(3);
    given.certificate.sizes = sizes;
    EXPECT_FALSE(given.verdict().accepted);
  }
  Graph_scene empty = stack(3);
  empty.certificate.sizes = {1, 0, 1, 1};
  expect_rejected(empty, "component 1 is empty");
  Graph_scene leaves = stack(3);
  leaves.certificate.arcs = {{0, 1, 0, 0}};
  expect_rejected(leaves, "arc 0 leaves its component", {0, 1});
  for (const Graph_certificate::Arc& arc :
       {Graph_certificate::Arc{3, 0, 0, 0}, {0, 3, 0, 0}, {0, 0, 4, 0}, {0, 0, 0, 4}}) {
    Graph_scene given = stack(3);
    given.certificate.arcs = {arc};
    expect_rejected(given, "names something that is not there");
  }
}

TEST(Graph_certificate, that_is_not_the_scene_is_rejected) {
  Graph_scene missing = stack(3);
  missing.certificate.fragments.pop_back(), missing.certificate.sizes.pop_back();
  EXPECT_NE(missing.verdict().why.find("has no fragment"), std::string::npos) << missing.verdict().why;
  Graph_scene moved = stack(3);
  moved.certificate.fragments[1].vertices[0][0] += tiny(60);
  EXPECT_FALSE(moved.verdict().accepted);
  Graph_scene turned = stack(3);
  turned.certificate.fragments[1].vertices = reversed(turned.certificate.fragments[1].vertices);
  EXPECT_NE(turned.verdict().why.find("clockwise"), std::string::npos) << turned.verdict().why;
}

TEST(Graph_certificate, of_faces_that_touch_in_a_plane_has_no_arc_from_a_corner_on_it) {
  // The second face stands on the first one: it has corners in front of the first one's plane, but none of the first's
  // is behind it.
  Graph_scene given;
  given.add(rectangle(0, 1, 0, 1, 0));
  given.add({at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)});
  given.certificate.sizes = {1, 1};
  // Its front looks to -y, the square is behind it: it may obscure the square, and stands first.
  EXPECT_FALSE(given.verdict().accepted);
  std::swap(given.certificate.fragments[0], given.certificate.fragments[1]);
  expect_accepted(given, "2 strongly connected");
}

}  // namespace verify_test
