#pragma once
// What families of questions of weak visibility are made of: a shaft with a source at its bottom and a target at its
// top, and polygons that come as near to closing it as a gap says. A gap of 0 lets faces just touch, a positive one
// leaves so much between them, a negative one makes them overlap.

#include <sightline/algorithms/generate/projective.h>

#include <set>

namespace sightline::generate::weak_drafts {

/// A scene in the making; its target is faces[0], unless there are others.
struct Draft {
  Faces faces;
  Points source;
  std::optional<bool> truth;
  std::vector<std::size_t> targets{0};
  bool bodies = false;  ///< whether the faces' fronts are to stay, and the source is one of them
};

/// The shaft [-1, 1]^2 x [0, height]: source at its bottom, target at its top, each looking at the other. Every line
/// between them stays in it.
inline Draft shaft(const Rational& height) {
  return {{reversed(rectangle(-1, 1, -1, 1, height))}, rectangle(-1, 1, -1, 1, 0), std::nullopt};
}

/// A convex face drawn in towards its centroid (gap > 0) or blown up (gap < 0), in its plane.
inline Points shrunk(const Points& face, const Rational& gap) {
  const Exact_point middle = centroid(face);
  Points points;
  for (const Exact_point& p : face) points.push_back(along(p, gap, minus(middle, p)));
  return points;
}
inline void shrink_one(Faces& faces, std::size_t first, const Rational& gap, Random& random) {
  Points& face = faces[first + random.below(faces.size() - first)];
  face = shrunk(face, gap);
}

/// The parallelogram with the edge `on` - u .. `on` + u that extends from it by w, front up if w is left of u seen from
/// above.
inline Points plate(const Exact_point& on, const Exact_point& u, const Exact_point& w) {
  const Exact_point a = along(on, -1, u), b = along(on, 1, u);
  return {a, b, along(b, 1, w), along(a, 1, w)};
}

inline Exact_point scaled(const Rational& factor, const Exact_point& v) { return along(at(0, 0, 0), factor, v); }
inline Exact_point level_direction(Random& random) {
  Exact_point u = at(0, 0, 0);
  while (is_zero(u)) u = {integer(random, -2, 2), integer(random, -2, 2), 0};
  return u;
}
/// A fraction strictly between 0 and 1.
inline Rational share(Random& random) {
  const std::int64_t whole = random.between(2, 5), part = random.between(1, whole - 1);
  return ratio(part, whole);
}
/// Numbers in increasing order from `low` to `high`, these included, `inner` of them between.
inline std::vector<Rational> subdivided(const Rational& low, const Rational& high, std::size_t inner, Random& random) {
  std::set<Rational> cuts{low, high};
  while (cuts.size() < inner + 2) cuts.insert(Rational(low + (high - low) * ratio(random.between(1, 11), 12)));
  return {cuts.begin(), cuts.end()};
}

}  // namespace sightline::generate::weak_drafts
