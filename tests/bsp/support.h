#pragma once
// Scenes by hand and at random, trees of them, and orders as certificates.

#include "../products.h"

#include <gtest/gtest.h>

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/bsp/traverse.h>
#include <sightline/harness/generate/scenes.h>
#include <sightline/harness/generate/tangles.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/harness/generate/soups.h>

namespace bsp_test {

using namespace sightline;
using Points = std::vector<Exact_point>;
using Tree = Bsp_tree<Exact_traits>;
using Drawn = Fragment<Exact_traits>;

inline Rational ratio(long p, long q) {
  Rational value(p, static_cast<unsigned long>(q));
  value.canonicalize();
  return value;
}
inline Exact_point at(const Rational& x, const Rational& y, const Rational& z) { return {x, y, z}; }
inline Face_id add_face(Polygon_soup& soup, const Points& loop) {
  std::vector<Point_id> ids;
  for (const Exact_point& p : loop) ids.push_back(soup.add_point(p[0], p[1], p[2]));
  return soup.add_face(ids);
}
inline Polygon_soup soup_of(const std::vector<Points>& faces) {
  Polygon_soup soup;
  for (const Points& face : faces) add_face(soup, face);
  return soup;
}
inline Points reversed(Points points) {
  std::reverse(points.begin(), points.end());
  return points;
}
/// The rectangle [x0, x1] x [y0, y1] at height z, front up.
inline Points rectangle(const Rational& x0, const Rational& x1, const Rational& y0, const Rational& y1,
                        const Rational& z) {
  return {at(x0, y0, z), at(x1, y0, z), at(x1, y1, z), at(x0, y1, z)};
}

// ---- Vectors, written down once more

inline Exact_point minus(const Exact_point& a, const Exact_point& b) {
  return {Rational(a[0] - b[0]), Rational(a[1] - b[1]), Rational(a[2] - b[2])};
}
inline Exact_point along(const Exact_point& p, const Rational& t, const Exact_point& d) {
  return {Rational(p[0] + t * d[0]), Rational(p[1] + t * d[1]), Rational(p[2] + t * d[2])};
}
using test_scenes::cross;
using test_scenes::dot;
inline Exact_point centroid(const Points& points) {
  Exact_point sum{0, 0, 0};
  for (const Exact_point& p : points) sum = along(sum, 1, p);
  for (Rational& x : sum) x /= static_cast<long>(points.size());
  return sum;
}
/// Normal and value of the plane through the first three corners, by the polygon's own points.
inline Exact_point normal_of(const Points& convex) {
  return cross(minus(convex[1], convex[0]), minus(convex[2], convex[0]));
}

// ---- A scene and its tree

inline Bsp_options serial() {
  Bsp_options options;
  options.threads = 1;
  return options;
}

struct Built {
  Polygon_soup soup;
  Scene scene;
  Exact_traits traits;
  Tree tree;

  explicit Built(Polygon_soup given, const Bsp_options& options = serial())
      : soup(std::move(given)), scene(soup), traits(scene), tree(build_bsp(traits, options)) {}
  Built(const Built&) = delete;

  Points corners(const Convex_polygon<Exact_traits>& polygon) const {
    Points points;
    for (const auto& corner : polygon) points.push_back(traits.position(*corner.vertex));
    return points;
  }
  /// Fragments as a traversal visits them.
  std::vector<const Drawn*> order(const Exact_point& eye, Direction direction = Direction::back_to_front) const {
    std::vector<const Drawn*> visited;
    traverse(traits, tree, traits.eye(eye), direction,
             [&](const Drawn& fragment, Sign) { visited.push_back(&fragment); });
    return visited;
  }
  std::vector<Face_id> faces(const std::vector<const Drawn*>& fragments) const {
    std::vector<Face_id> faces;
    for (const Drawn* fragment : fragments) faces.push_back(traits.face(fragment->polygon.piece));
    return faces;
  }
  std::vector<Face_id> face_order(const Exact_point& eye, Direction direction = Direction::back_to_front) const {
    return faces(order(eye, direction));
  }
};

/// What `verify` reads, for an order of fragments.
inline Order_certificate certificate_of(const Built& built, const Exact_point& eye,
                                        const std::vector<const Drawn*>& order) {
  Order_certificate certificate;
  certificate.eye = eye;
  const auto piece_of = [&](const Drawn* fragment) { return built.scene.pieces()[fragment->polygon.piece]; };
  for (const Drawn* fragment : order)
    certificate.fragments.push_back(
        {piece_of(fragment).face, piece_of(fragment).number, built.corners(fragment->polygon)});
  std::set<Face_id> cut(built.scene.non_planar().begin(), built.scene.non_planar().end());
  for (const Piece& piece : built.scene.pieces())
    if (piece.number > 0) cut.insert(piece.face);
  for (const Piece& piece : built.scene.pieces())
    if (cut.count(piece.face))
      certificate.pieces.push_back({piece.face, piece.number, built.scene.corner_points(piece)});
  for (const Set_aside& entry : built.scene.set_aside()) certificate.set_aside.push_back({entry.face, entry.why});
  return certificate;
}

inline testing::AssertionResult verified(const Built& built, const Exact_point& eye) {
  const Verdict verdict = verify_order(built.soup, certificate_of(built, eye, built.order(eye)));
  if (verdict.accepted) return testing::AssertionSuccess();
  return testing::AssertionFailure() << verdict.why << "; eye " << to_string(eye[0]) << ' ' << to_string(eye[1]) << ' '
                                     << to_string(eye[2]);
}

// ---- Random scenes

using generate::Random;

/// A point of the lattice {-reach .. reach}^3.
inline Exact_point lattice_point(Random& random, std::int64_t reach = 2) {
  Exact_point p;
  for (Rational& x : p) x = Rational(Integer(static_cast<long>(random.between(-reach, reach))));
  return p;
}

/// generate::tangle as a soup.
inline Polygon_soup random_soup(Random& random, std::size_t most_faces = 7) {
  return soup_of(generate::tangle(random, most_faces));
}

/// The same scene where floating point is worse: far from the origin, tiny, one ulp off, turned.
inline Polygon_soup moved_somewhere(const Polygon_soup& soup, Random& random) {
  switch (random.below(6)) {
    case 0: return generate::translated(soup, at(100000000, -100000000, 100000000));
    case 1: return generate::scaled(soup, Rational(Integer(1), exact_decimal(1, 50).get_num()));
    case 2:
      return generate::one_ulp_perturbed(generate::translated(soup, at(ratio(1, 3), ratio(1, 7), ratio(-2, 3))),
                                         random.below(1000));
    case 3:
      return generate::rotated(soup, generate::rotation(random.between(1, 5), random.between(-3, 3),
                                                        random.between(-3, 3), random.between(-3, 3)));
    default: return soup;
  }
}

/// A point where degeneracy is likely: a vertex, in a face's plane, on the line or point common to planes of faces, or
/// anywhere.
inline Exact_point random_eye(const Built& built, Random& random) {
  const std::vector<Piece>& pieces = built.scene.pieces();
  const auto anywhere = [&] {
    const auto [low, high] =
        built.soup.point_count() > 0 ? built.scene.box() : std::array<Exact_point, 2>{at(0, 0, 0), at(1, 1, 1)};
    Exact_point p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = low[k] + (high[k] - low[k]) * ratio(random.between(-4, 12), 8) +
             (low[k] == high[k] ? random.between(-1, 1) : 0);
    return p;
  };
  if (pieces.empty()) return anywhere();
  const auto piece = [&] { return built.scene.corner_points(pieces[random.below(pieces.size())]); };
  switch (random.below(7)) {
    case 0: {
      const Points corners = piece();
      return corners[random.below(corners.size())];
    }
    case 1: {  // in a plane
      const Points c = piece();
      return along(along(c[0], ratio(random.between(-6, 6), 3), minus(c[1], c[0])), ratio(random.between(-6, 6), 3),
                   minus(c[2], c[0]));
    }
    case 2: return centroid(piece());
    case 3: {  // where the line of an edge meets a plane
      const Points a = piece(), b = piece();
      const Exact_point n = normal_of(a), d = minus(b[1], b[0]);
      if (dot(n, d) == 0) return b[0];
      return along(b[0], dot(n, minus(a[0], b[0])) / dot(n, d), d);
    }
    case 4: {  // on the line that two planes have in common
      const Points a = piece(), b = piece();
      const Exact_point n = normal_of(a), m = normal_of(b), line = cross(n, m), down = cross(line, n);
      if (dot(down, m) == 0) return a[0];
      return along(along(a[0], dot(m, minus(b[0], a[0])) / dot(m, down), down), random.between(-2, 2), line);
    }
    case 5: {  // far away
      Exact_point p = anywhere();
      const Exact_point d = lattice_point(random);
      for (std::size_t k = 0; k < 3; ++k) p[k] += d[k] * 1000003;
      return p;
    }
    default: return anywhere();
  }
}

}  // namespace bsp_test
