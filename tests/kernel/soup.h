#pragma once
// Small soups for the tests of scenes.

#include <gtest/gtest.h>

#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <map>
#include <random>

namespace kernel_test {

using namespace sightline;
using Random = std::mt19937_64;

/// A soup of the given integer points.
inline Polygon_soup soup_of(const std::vector<std::array<long, 3>>& points) {
  Polygon_soup soup;
  for (const auto& p : points) soup.add_point(Rational(p[0]), Rational(p[1]), Rational(p[2]));
  return soup;
}

/// Fronts outside.
inline void add_cube(Polygon_soup& soup, long x, long y, long z, long side, int without = -1) {
  const Point_id first = static_cast<Point_id>(soup.point_count());
  for (int i = 0; i < 8; ++i)
    soup.add_point(Rational(x + (i & 1 ? side : 0)), Rational(y + (i & 2 ? side : 0)),
                   Rational(z + (i & 4 ? side : 0)));
  static const Point_id faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (int f = 0; f < 6; ++f)
    if (f != without)
      soup.add_face({first + faces[f][0], first + faces[f][1], first + faces[f][2], first + faces[f][3]});
}

/// Random triangles and convex quads, some of them sharing points, with coordinates made by `number` from an integer in
/// [-2^bits, 2^bits].
template <class Number>
Polygon_soup random_soup(Random& random, int faces, int bits, Number number) {
  Polygon_soup soup;
  const auto coordinate = [&] { return static_cast<long>(random() >> (63 - bits)) - (1l << bits); };
  const auto add = [&](long x, long y, long z) { return soup.add_point(number(x), number(y), number(z)); };
  std::vector<Point_id> points;
  for (int i = 0; i < faces; ++i) points.push_back(add(coordinate(), coordinate(), coordinate()));
  for (int f = 0; f < faces; ++f) {
    if (f % 3 == 0) {  // a parallelogram
      long o[3], u[3], v[3];
      for (int k = 0; k < 3; ++k) {
        o[k] = coordinate() / 2;
        u[k] = coordinate() / 4;
        v[k] = coordinate() / 4;
      }
      const Point_id a = add(o[0], o[1], o[2]), b = add(o[0] + u[0], o[1] + u[1], o[2] + u[2]);
      const Point_id c = add(o[0] + u[0] + v[0], o[1] + u[1] + v[1], o[2] + u[2] + v[2]),
                     d = add(o[0] + v[0], o[1] + v[1], o[2] + v[2]);
      soup.add_face({a, b, c, d});
    } else {
      soup.add_face(
          {points[random() % points.size()], points[random() % points.size()], points[random() % points.size()]});
    }
  }
  return soup;
}

inline std::string why(const Scene& scene, Face_id face) {
  for (const Set_aside& entry : scene.set_aside())
    if (entry.face == face) return entry.why;
  return "";
}
inline std::size_t pieces_of(const Scene& scene, Face_id face) {
  return static_cast<std::size_t>(
      std::count_if(scene.pieces().begin(), scene.pieces().end(), [&](const Piece& p) { return p.face == face; }));
}

using Vector = std::array<Rational, 3>;
inline Vector minus(const Exact_point& a, const Exact_point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Rational dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
/// Of the triangles of corner 0 with edges from `first` to `last`, half by half, as denominators become long.
inline Vector area_between(const std::vector<Exact_point>& polygon, std::size_t first, std::size_t last) {
  if (last <= first) return {0, 0, 0};
  if (last == first + 1) return cross(minus(polygon[first], polygon[0]), minus(polygon[last], polygon[0]));
  const std::size_t middle = first + (last - first) / 2;
  Vector sum = area_between(polygon, first, middle);
  const Vector other = area_between(polygon, middle, last);
  for (std::size_t k = 0; k < 3; ++k) sum[k] += other[k];
  return sum;
}
/// Twice the area vector of a closed polygon.
inline Vector area_vector(const std::vector<Exact_point>& polygon) {
  return polygon.empty() ? Vector{0, 0, 0} : area_between(polygon, 1, polygon.size() - 1);
}
inline std::vector<Exact_point> loop_of(const Polygon_soup& soup, Face_id face, std::size_t loop = 0) {
  std::vector<Exact_point> polygon;
  for (const Point_id p : soup.loop(face, loop)) polygon.push_back(soup.point(p));
  return polygon;
}
inline Rational value(const std::array<Rational, 4>& h, const Exact_point& p) {
  return h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3];
}

/// An oriented boundary: on each line (direction and moment, scaled so that the direction's first non-zero is 1) the
/// net arrivals at each point. Zero nets are left out, so two chains are equal iff the boundaries are, T-junctions and
/// spikes aside.
class Chain {
 public:
  void add(const std::vector<Exact_point>& polygon, long times = 1) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Exact_point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      if (p == q) continue;
      Vector d = minus(q, p);
      const Rational lead = d[0] != 0 ? d[0] : d[1] != 0 ? d[1] : d[2];
      for (Rational& x : d) x /= lead;
      const Vector m = cross(p, d);
      const std::array<Rational, 6> line{d[0], d[1], d[2], m[0], m[1], m[2]};
      change(line, q, times);
      change(line, p, -times);
    }
  }
  bool empty() const { return net_.empty(); }
  friend bool operator==(const Chain&, const Chain&) = default;

 private:
  void change(const std::array<Rational, 6>& line, const Exact_point& p, long by) {
    long& n = net_[{line, p}];
    if ((n += by) == 0) net_.erase({line, p});
  }
  std::map<std::pair<std::array<Rational, 6>, Exact_point>, long> net_;
};

/// What every scene promises of its pieces: points of the face, convex, counterclockwise about the support, edge planes
/// through their edges with the piece in front; numbers 0, 1, ... within each face; every kept face has a piece and no
/// face set aside has one.
inline void expect_sound_pieces(const Polygon_soup& soup, const Scene& scene) {
  std::vector<std::uint32_t> next(soup.face_count(), 0);
  for (const Piece& piece : scene.pieces()) {
    ASSERT_LT(piece.face, soup.face_count());
    ASSERT_EQ(piece.number, next[piece.face]++);
    const std::vector<Exact_point> polygon = scene.corner_points(piece);
    const std::size_t n = polygon.size();
    ASSERT_GE(n, 3u);
    std::vector<Exact_point> own;
    for (std::size_t k = 0; k < soup.loop_count(piece.face); ++k)
      for (const Exact_point& p : loop_of(soup, piece.face, k)) own.push_back(p);
    const std::array<Rational, 4> support = scene.file_coefficients(piece.support);
    const Vector normal{support[0], support[1], support[2]};
    ASSERT_GT(dot(normal, area_vector(polygon)), 0);
    for (std::size_t i = 0; i < n; ++i) {
      ASSERT_NE(std::find(own.begin(), own.end(), polygon[i]), own.end()) << "a corner that is no point of the face";
      ASSERT_EQ(value(support, polygon[i]), 0);
      ASSERT_GT(dot(normal,
                    cross(minus(polygon[(i + 1) % n], polygon[i]), minus(polygon[(i + 2) % n], polygon[(i + 1) % n]))),
                0)
          << "not strictly convex";
      const Plane edge = scene.corners(piece)[i].edge;
      ASSERT_NE(edge.id(), piece.support.id());
      const std::array<Rational, 4> bound = scene.file_coefficients(edge);
      for (std::size_t j = 0; j < n; ++j) {
        if (j == i || j == (i + 1) % n) {
          ASSERT_EQ(value(bound, polygon[j]), 0);
        } else {
          ASSERT_GT(value(bound, polygon[j]), 0);
        }
      }
    }
  }
  for (Face_id f = 0; f < soup.face_count(); ++f)
    ASSERT_EQ(next[f] == 0, !why(scene, f).empty())
        << "face " << f << " has " << next[f] << " pieces and is set aside for '" << why(scene, f) << "'";
  // The pieces of a face have its boundary, holes against the outer contour as some axis has them.
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    if (next[f] == 0) continue;
    Chain got;
    for (const Piece& piece : scene.pieces())
      if (piece.face == f) got.add(scene.corner_points(piece));
    const std::vector<Exact_point> outer = loop_of(soup, f);
    bool bounded = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int sense = sgn(area_vector(outer)[axis]);
      if (sense == 0 && soup.loop_count(f) > 1) continue;
      Chain expected;
      expected.add(outer);
      for (std::size_t k = 1; k < soup.loop_count(f); ++k) {
        const std::vector<Exact_point> hole = loop_of(soup, f, k);
        expected.add(hole, sgn(area_vector(hole)[axis]) == sense ? -1 : 1);
      }
      bounded = bounded || expected == got;
    }
    ASSERT_TRUE(bounded) << "the pieces of face " << f << " have another boundary than the face";
  }
  ASSERT_EQ(scene.counters().pieces, scene.pieces().size());
  ASSERT_EQ(scene.counters().faces + scene.set_aside().size(), soup.face_count());
  const Scene_counters& c = scene.counters();
  ASSERT_EQ(c.zero_area + c.duplicates + c.self_intersecting + c.no_simple_projection, scene.set_aside().size());
  for (const Set_aside& entry : scene.set_aside()) ASSERT_EQ(set_aside_reason(entry.why), entry.reason);
  ASSERT_EQ(c.non_planar, scene.non_planar().size());
  ASSERT_EQ(c.concave, scene.concave().size());
  ASSERT_EQ(c.faces_read, soup.face_count());
  ASSERT_EQ(c.points_read, soup.point_count());
}

}  // namespace kernel_test
