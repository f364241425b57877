// Pairs of solids: operands that meet as their names say, told by exact arithmetic on their points alone; and no more
// so once an ulp is between them.

#include "../sample.h"

#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/judge/solids.h>
#include <sightline/kernel/vectors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

namespace {

namespace generate = sightline::generate;
namespace judge = sightline::judge;
using namespace sightline;

using Corners = std::vector<Exact_point>;

Rational times(const Exact_point& a, const Exact_point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Exact_point between(const Exact_point& p, const Rational& t, const Exact_point& q) {
  return {p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])};
}

struct Face {
  Corners corners;
  Exact_point normal;
};
struct Body {
  Corners points;
  std::vector<Face> faces;
  std::vector<std::array<Exact_point, 2>> edges;
};

Body body_of(const Polygon_soup& soup) {
  Body body;
  for (Point_id p = 0; p < soup.point_count(); ++p) body.points.push_back(soup.point(p));
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    Face face;
    face.normal = {0, 0, 0};
    for (const Point_id p : soup.loop(f)) face.corners.push_back(soup.point(p));
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      const Exact_point &p = face.corners[k], &q = face.corners[(k + 1) % face.corners.size()];
      const Exact_point part = cross(p, q);
      for (std::size_t c = 0; c < 3; ++c) face.normal[c] += part[c];
      if (p < q) body.edges.push_back({p, q});
    }
    body.faces.push_back(std::move(face));
  }
  return body;
}

bool is_inside_edge(const Exact_point& p, const std::array<Exact_point, 2>& edge) {
  const Exact_point along = minus(edge[1], edge[0]), to = minus(p, edge[0]);
  return is_zero(cross(along, to)) && times(along, to) > 0 && times(along, to) < times(along, along);
}

/// In a face's plane, inside its outline: by how often the outline winds round the point, seen along an axis.
bool is_inside_face(const Exact_point& p, const Face& face) {
  if (times(face.normal, minus(p, face.corners[0])) != 0) return false;
  std::size_t dropped = 0;
  while (face.normal[dropped] == 0) ++dropped;
  const std::size_t x = (dropped + 1) % 3, y = (dropped + 2) % 3;
  bool inside = false;
  for (std::size_t k = 0; k < face.corners.size(); ++k) {
    const Exact_point &a = face.corners[k], &b = face.corners[(k + 1) % face.corners.size()];
    if (p == a || is_inside_edge(p, {a, b})) return false;
    if ((a[y] > p[y]) == (b[y] > p[y])) continue;
    const Rational crossing = a[x] + (p[y] - a[y]) / (b[y] - a[y]) * (b[x] - a[x]);
    if (crossing > p[x]) inside = !inside;
  }
  return inside;
}

/// Where lines of two edges cross, if they do and are not parallel.
std::vector<Exact_point> crossing_of(const std::array<Exact_point, 2>& e, const std::array<Exact_point, 2>& f) {
  const Exact_point u = minus(e[1], e[0]), v = minus(f[1], f[0]), to = minus(f[0], e[0]), normal = cross(u, v);
  if (is_zero(normal) || times(normal, to) != 0) return {};
  return {between(e[0], times(cross(to, v), normal) / times(normal, normal), e[1])};
}

/// Whether edges have a point inside both.
bool edges_meet(const std::array<Exact_point, 2>& e, const std::array<Exact_point, 2>& f) {
  for (const Exact_point& p : crossing_of(e, f)) return is_inside_edge(p, e) && is_inside_edge(p, f);
  const auto any_inside = [](const auto& one, const auto& other) {
    return is_inside_edge(one[0], other) || is_inside_edge(one[1], other) ||
           is_inside_edge(between(one[0], Rational(1, 2), one[1]), other);
  };
  return is_zero(cross(minus(e[1], e[0]), minus(f[1], f[0]))) && (any_inside(e, f) || any_inside(f, e));
}

/// Whether two faces in one plane have area in common: what they have is a polygon of corners of theirs and crossings
/// of their edges, and the middle of some three of these is inside both.
bool faces_overlap(const Face& f, const Face& g) {
  if (!is_zero(cross(f.normal, g.normal)) || times(f.normal, minus(g.corners[0], f.corners[0])) != 0) return false;
  Corners all = f.corners;
  all.insert(all.end(), g.corners.begin(), g.corners.end());
  for (std::size_t i = 0; i < f.corners.size(); ++i)
    for (std::size_t j = 0; j < g.corners.size(); ++j)
      for (const Exact_point& p : crossing_of({f.corners[i], f.corners[(i + 1) % f.corners.size()]},
                                              {g.corners[j], g.corners[(j + 1) % g.corners.size()]}))
        all.push_back(p);
  for (const Exact_point& p : all)
    for (const Exact_point& q : all)
      for (const Exact_point& r : all) {
        if (!(p < q && q < r)) continue;
        const Exact_point middle = between(between(p, Rational(1, 2), q), Rational(1, 3), r);
        if (is_inside_face(middle, f) && is_inside_face(middle, g)) return true;
      }
  return false;
}

template <class List, class Other, class Meet>
bool any_pair(const List& list, const Other& others, Meet meet) {
  for (const auto& one : list)
    for (const auto& other : others)
      if (meet(one, other)) return true;
  return false;
}

/// How many pairs of faces have area in common, and are of equal (1) or opposite (-1) sense.
std::size_t faces_together(const Body& a, const Body& b, int sense) {
  std::size_t count = 0;
  for (const Face& f : a.faces)
    for (const Face& g : b.faces) count += sgn(times(f.normal, g.normal)) == sense && faces_overlap(f, g);
  return count;
}
bool planes_meet(const Body& a, const Body& b, int sense) { return faces_together(a, b, sense) > 0; }
bool vertex_on_face(const Body& a, const Body& b) {
  return any_pair(a.points, b.faces, is_inside_face) || any_pair(b.points, a.faces, is_inside_face);
}
bool vertex_on_edge(const Body& a, const Body& b) {
  return any_pair(a.points, b.edges, is_inside_edge) || any_pair(b.points, a.edges, is_inside_edge);
}
bool vertex_on_vertex(const Body& a, const Body& b) { return any_pair(a.points, b.points, std::equal_to<>()); }
bool edge_on_edge(const Body& a, const Body& b) { return any_pair(a.edges, b.edges, edges_meet); }

/// Whether a plane through some point has each body on a side of its own, perhaps on the plane: of all such planes,
/// those are enough that two lines from the point to corners span.
bool are_apart_at(const Exact_point& p, const Body& a, const Body& b) {
  Corners all = a.points;
  all.insert(all.end(), b.points.begin(), b.points.end());
  return any_pair(all, all, [&](const Exact_point& q, const Exact_point& r) {
    const Exact_point normal = cross(minus(q, p), minus(r, p));
    const auto is_beyond = [&](const Corners& points, int side) {
      return std::all_of(points.begin(), points.end(),
                         [&](const Exact_point& x) { return sgn(times(normal, minus(x, p))) != -side; });
    };
    return !is_zero(normal) && is_beyond(a.points, -1) && is_beyond(b.points, 1);
  });
}
/// Whether they meet, and nowhere that has volume.
bool touch(const Body& a, const Body& b) {
  const auto touch_at = [&](const Exact_point& p) { return are_apart_at(p, a, b); };
  for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (const Exact_point& p : one->points) {
      const auto holds = [&](const auto& of, auto is_inside) {
        return std::any_of(of.begin(), of.end(), [&](const auto& item) { return is_inside(p, item); });
      };
      if (holds(other->points, std::equal_to<>()) || holds(other->edges, is_inside_edge) ||
          holds(other->faces, is_inside_face))
        return touch_at(p);
    }
  }
  for (const auto& e : a.edges)
    for (const auto& f : b.edges)
      if (edges_meet(e, f))
        for (const Exact_point& p : crossing_of(e, f)) return touch_at(p);
  return false;
}

/// Whether no corner of one is beyond a plane of the other's faces, and some is on one. Pre: the other is convex.
bool is_within(const Body& a, const Body& b) {
  int highest = -1;
  for (const Face& face : b.faces)
    for (const Exact_point& p : a.points)
      highest = std::max(highest, sgn(times(face.normal, minus(p, face.corners[0]))));
  return highest == 0;
}

/// Faces as they are anywhere, each loop from its least corner on.
std::multiset<Corners> faces_of(const Body& body) {
  std::multiset<Corners> faces;
  for (const Face& face : body.faces) {
    Corners corners = face.corners;
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    faces.insert(std::move(corners));
  }
  return faces;
}

/// By family, what its name says.
const std::map<std::string, std::function<bool(const Body&, const Body&)>>& contacts() {
  static const std::map<std::string, std::function<bool(const Body&, const Body&)>> all{
      {"solids_equal_planes", [](const Body& a, const Body& b) { return planes_meet(a, b, 1); }},
      {"solids_opposite_planes", [](const Body& a, const Body& b) { return planes_meet(a, b, -1) && touch(a, b); }},
      {"solids_edge_on_edge", edge_on_edge},
      {"solids_vertex_on_face", vertex_on_face},
      {"solids_vertex_on_edge", vertex_on_edge},
      {"solids_vertex_on_vertex", vertex_on_vertex},
      {"solids_touching", touch},
      {"solids_within", is_within},
      {"solids_twice", [](const Body& a, const Body& b) { return faces_of(a) == faces_of(b); }}};
  return all;
}

generate::Solid_pair pair_of(const std::string& family, std::uint64_t seed, std::int64_t ulps, std::size_t size = 0) {
  generate::Family_parameters parameters;
  parameters.seed = seed;
  parameters.ulps = ulps;
  parameters.size = size;
  const generate::Posed_scene scene = generate::family(family).make(parameters);
  return generate::solids_of(scene.soup, scene.first);
}
Rational volume_of(const generate::Solid_pair& pair, Set_operation operation) {
  Set_options options;
  options.operation = operation;
  return sightline::volume(set_operation(Operands(pair), options).soup);
}

TEST(Touching_solids, are_all_families_that_are_pairs) {
  std::set<std::string> pairs, known;
  for (const generate::Family& family : generate::families())
    if (family.pair) pairs.insert(family.name);
  for (const auto& [name, contact] : contacts()) known.insert(name);
  EXPECT_EQ(pairs, known);
}

TEST(Touching_solids, are_operands_and_meet_as_their_names_say_and_not_an_ulp_apart) {
  for (const auto& [name, meet] : contacts())
    for (std::uint64_t seed = 0; seed < (test_scenes::is_sanitized() ? 8u : 40u); ++seed) {
      const generate::Solid_pair pair = pair_of(name, seed, 0);
      EXPECT_EQ(judge::flaw_of_solids(generate::joined(pair), pair[0].face_count()), "") << name << seed;
      EXPECT_GT(sightline::volume(pair[0]), 0) << name << seed;
      EXPECT_GT(sightline::volume(pair[1]), 0) << name << seed;
      EXPECT_TRUE(meet(body_of(pair[0]), body_of(pair[1]))) << name << seed;
      // Beside it: where both are on two sides, apart, or into each other; else a plane or a corner has moved.
      const bool is_of_sides = name == "solids_touching" || name == "solids_opposite_planes";
      const generate::Solid_pair apart = pair_of(name, seed, 1), overlapping = pair_of(name, seed, -1);
      if (is_of_sides) {
        EXPECT_EQ(volume_of(pair, Set_operation::intersect), 0) << name << seed;
        EXPECT_EQ(volume_of(apart, Set_operation::intersect), 0) << name << seed;
        EXPECT_GT(volume_of(overlapping, Set_operation::intersect), 0) << name << seed;
      }
      if (name == "solids_within" || name == "solids_twice")
        EXPECT_EQ(volume_of(pair, Set_operation::subtract), 0) << name << seed;
      if (name == "solids_within") {
        EXPECT_EQ(volume_of(apart, Set_operation::subtract), 0) << name << seed;
        EXPECT_GT(volume_of(overlapping, Set_operation::subtract), 0) << name << seed;
      }
      if (name == "solids_equal_planes")  // but faces across that plane may stay in theirs
        EXPECT_LT(faces_together(body_of(apart[0]), body_of(apart[1]), 1),
                  faces_together(body_of(pair[0]), body_of(pair[1]), 1))
            << name << seed;
      if (is_of_sides || name == "solids_twice")
        EXPECT_FALSE(meet(body_of(apart[0]), body_of(apart[1]))) << name << seed;
      for (const generate::Solid_pair& beside : {apart, overlapping})
        for (const Polygon_soup& solid : beside)
          for (std::size_t k = 0; k < solid.coordinates.size(); ++k)
            EXPECT_EQ(exact(nearest_double(solid.coordinates[k])), solid.coordinates[k]) << name << seed;
    }
}

TEST(Touching_solids, come_on_both_sides_and_in_all_ways) {
  std::map<std::string, std::set<bool>> disjoint_insides;
  std::set<std::string> tips;  // how those of solids_touching meet
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    for (const char* name :
         {"solids_edge_on_edge", "solids_vertex_on_face", "solids_vertex_on_edge", "solids_vertex_on_vertex"})
      disjoint_insides[name].insert(volume_of(pair_of(name, seed, 0), Set_operation::intersect) == 0);
    const generate::Solid_pair pair = pair_of("solids_touching", seed, 0);
    const Body a = body_of(pair[0]), b = body_of(pair[1]);
    tips.insert(planes_meet(a, b, -1)    ? "faces"
                : edge_on_edge(a, b)     ? "edges"
                : vertex_on_face(a, b)   ? "vertex on face"
                : vertex_on_edge(a, b)   ? "vertex on edge"
                : vertex_on_vertex(a, b) ? "vertices"
                                         : "else");
  }
  for (const auto& [name, both] : disjoint_insides) EXPECT_EQ(both.size(), 2u) << name;
  EXPECT_EQ(tips, (std::set<std::string>{"faces", "edges", "vertex on face", "vertex on edge", "vertices"}));
}

TEST(Touching_solids, are_as_large_as_one_wants_and_meet_in_nothing_else) {
  for (const auto& [name, meet] : contacts()) {
    const generate::Solid_pair pair = pair_of(name, 3, 0), large = pair_of(name, 3, 0, 1000);
    EXPECT_GE(large[0].face_count() + large[1].face_count(), 1000u) << name;
    EXPECT_EQ(large[0].face_count(), pair[0].face_count()) << name;
    EXPECT_EQ(judge::flaw_of_solids(generate::joined(large), large[0].face_count()), "") << name;
    EXPECT_EQ(volume_of(large, Set_operation::intersect), volume_of(pair, Set_operation::intersect)) << name;
  }
}

}  // namespace
