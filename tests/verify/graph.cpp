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
  for (long k = 0; k < n; ++k) {
    given.add(rectangle(0, 1, 0, 1, n - k));
    given.certificate.sizes.push_back(1);
  }
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
  expect_accepted(stack(1), "1 strongly connected components of 1 pieces");
  expect_accepted(stack(5), "5 strongly connected components of 5 pieces");
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = i + 1; j < 5; ++j) {
      Graph_scene given = stack(5);
      std::swap(given.certificate.fragments[i], given.certificate.fragments[j]);
      EXPECT_FALSE(given.verdict().accepted);
      EXPECT_NE(given.verdict().why.find("which has higher priority"), std::string::npos) << given.verdict().why;
    }
}

TEST(Graph_certificate, of_an_empty_scene_is_accepted) {
  expect_accepted(Graph_scene(), "0 strongly connected components of 0 pieces");
}

TEST(Graph_certificate, takes_any_order_of_faces_without_arcs) {
  // A cube's faces look outwards: none may obscure another.
  Graph_scene given;
  const auto corner = [](unsigned k) { return at(k & 1, k >> 1 & 1, k >> 2 & 1); };
  for (const std::array<unsigned, 4>& f :
       {std::array<unsigned, 4>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    given.add({corner(f[0]), corner(f[1]), corner(f[2]), corner(f[3])});
    given.certificate.sizes.push_back(1);
  }
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
  expect_accepted(whole, "1 strongly connected components of 3 pieces");
  Graph_scene apart = whole;
  apart.certificate.sizes = {1, 1, 1};
  apart.certificate.arcs.clear();
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

TEST(Graph_certificate, must_not_dissolve_a_component_by_cutting) {
  // Two plates that cross: each is across the other's plane, so they are one component; cut there they are four.
  const auto plate = [](bool turned, const Rational& from, const Rational& to) {
    Points p = {at(0, from, 0), at(0, to, 0), at(0, to, 2), at(0, from, 2)};
    if (turned)
      for (Exact_point& q : p) q = {Rational(-q[1]), q[0], q[2]};
    return p;
  };
  Scene scene;
  for (const bool turned : {false, true}) scene.face(plate(turned, -1, 1));
  std::vector<Order_fragment> halves;
  for (const bool turned : {false, true})
    for (const int from : {-1, 0}) halves.push_back({turned ? 1u : 0u, 0, plate(turned, from, from + 1)});
  // In some order the checker would take them as four components, were it not for the cut.
  std::vector<std::size_t> order{0, 1, 2, 3};
  std::size_t cut = 0;
  do {
    Graph_scene given;
    given.scene = scene;
    for (const std::size_t k : order) given.certificate.fragments.push_back(halves[k]);
    given.certificate.sizes = {1, 1, 1, 1};
    EXPECT_FALSE(given.verdict().accepted);
    cut += given.verdict().why.find("is cut at") != std::string::npos;
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(cut, 24u);
  // At corners it is no better, with pieces or without.
  for (const bool with_pieces : {false, true}) {
    Graph_scene given;
    const Points square = rectangle(0, 1, 0, 1, 0);
    given.scene.face(square);
    for (std::uint32_t k = 0; k < 2; ++k) {
      const Points half = {square[0], square[k + 1], square[k + 2]};
      given.certificate.fragments.push_back({0, k, half});
      if (with_pieces) given.certificate.pieces.push_back({0, k, half});
      given.certificate.sizes.push_back(1);
    }
    expect_rejected(given, "face 0 is convex, but in 2 fragments");
  }
  // A spike makes no face concave. One that is may be cut, at its own points, and the line says so.
  Points spiked = rectangle(0, 4, 0, 4, 0);
  spiked.insert(spiked.begin() + 1, {at(2, 0, 0), at(1, 0, 0)});
  Graph_scene given;
  given.scene.face(spiked);
  for (const Points& half :
       {Points{at(0, 0, 0), at(4, 0, 0), at(4, 4, 0)}, Points{at(0, 0, 0), at(4, 4, 0), at(0, 4, 0)}}) {
    given.certificate.fragments.push_back({0, 0, half});
    given.certificate.sizes.push_back(1);
  }
  expect_rejected(given, "face 0 is convex, but in 2 fragments");
  // Nor at the tip of a spike that points inwards.
  Points inwards = rectangle(0, 4, 0, 4, 0);
  inwards.insert(inwards.begin() + 1, {at(2, 2, 0), at(0, 0, 0)});
  Graph_scene tipped;
  tipped.scene.face(inwards);
  for (const Points& part :
       {Points{at(0, 0, 0), at(4, 0, 0), at(2, 2, 0)}, Points{at(4, 0, 0), at(4, 4, 0), at(2, 2, 0)},
        Points{at(0, 0, 0), at(2, 2, 0), at(4, 4, 0), at(0, 4, 0)}}) {
    tipped.certificate.fragments.push_back({0, 0, part});
    tipped.certificate.sizes.push_back(1);
  }
  expect_rejected(tipped, "face 0 is convex, but in 3 fragments");
  const Points ell = {at(0, 0, 0), at(4, 0, 0), at(4, 2, 0), at(2, 2, 0), at(2, 4, 0), at(0, 4, 0)};
  Graph_scene concave, elsewhere;
  concave.scene.face(ell);
  elsewhere.scene.face(ell);
  for (const Points& part : {Points{ell[0], ell[1], ell[2], ell[3]}, Points{ell[0], ell[3], ell[4], ell[5]}}) {
    concave.certificate.fragments.push_back({0, 0, part});
    concave.certificate.sizes.push_back(1);
  }
  expect_accepted(concave, "2 pieces in order of priority, 1 faces that are not convex in pieces as the certificate");
  for (const Points& part : {rectangle(0, 4, 0, 2, 0), rectangle(0, 2, 2, 4, 0)}) {
    elsewhere.certificate.fragments.push_back({0, 0, part});
    elsewhere.certificate.sizes.push_back(1);
  }
  expect_rejected(elsewhere, "face 0 is cut at (0, 2, 0), which is none of its points");
  // A triangle of a face that is not planar is one fragment.
  const Points saddle = {at(0, 0, 0), at(4, 0, 1), at(4, 4, 0), at(0, 4, 1)};
  const Points first = {saddle[0], saddle[1], saddle[2]}, second = {saddle[0], saddle[2], saddle[3]};
  for (const bool whole : {true, false}) {
    Graph_scene skew;
    skew.scene.face(saddle);
    skew.certificate.pieces = {{0, 0, first}, {0, 1, second}};
    std::vector<Points> fragments = {first};
    const Exact_point middle = at(2, 2, 0);
    if (!whole) fragments = {{first[0], first[1], middle}, {first[1], first[2], middle}};
    for (const Points& fragment : fragments) skew.certificate.fragments.push_back({0, 0, fragment});
    skew.certificate.fragments.push_back({0, 1, second});
    skew.certificate.sizes.assign(skew.certificate.fragments.size(), 1);
    if (whole) expect_accepted(skew, "0 faces set aside, 1 not planar");
    else expect_rejected(skew, "is cut");
  }
}

TEST(Graph_certificate, takes_straight_corners_of_parts) {
  // A face that is not convex, and one that is not planar, each in two parts with a corner more.
  const Points bent{at(0, 0, 0), at(4, 0, 0), at(4, 4, 0), at(3, 1, 0)};
  Graph_scene concave;
  concave.scene.face(bent);
  concave.certificate.fragments = {{0, 0, {bent[0], at(2, 0, 0), bent[1], bent[3]}},
                                   {0, 0, {bent[1], bent[2], bent[3]}}};
  concave.certificate.sizes = {1, 1};
  expect_accepted(concave, "of 2 pieces");
  concave.certificate.fragments[0].vertices[1] = at(2, ratio(1, 1000), 0);  // not straight
  EXPECT_FALSE(concave.verdict().accepted);
}

TEST(Graph_certificate, with_a_witness_that_is_none_is_rejected) {
  const Graph_scene whole = ring();
  std::size_t wrong = 0;
  for (std::size_t k = 0; k < whole.certificate.arcs.size(); ++k)
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b) {
        Graph_scene given = whole;
        auto& arc = given.certificate.arcs[k];
        arc.corner_from = a;
        arc.corner_to = b;
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
  missing.certificate.fragments.pop_back();
  missing.certificate.sizes.pop_back();
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
