#pragma once
// What families of questions of weak visibility are made of: a shaft with a source at its bottom and a target at its
// top, and polygons that come as near to closing it as a gap says. A gap of 0 lets faces just touch, a positive one
// leaves so much between them, a negative one makes them overlap.

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <optional>
#include <vector>

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
Draft shaft(const Rational& height);

/// A convex face drawn in towards its centroid (gap > 0) or blown up (gap < 0), in its plane.
Points shrunk(const Points& face, const Rational& gap);
void shrink_one(Faces& faces, std::size_t first, const Rational& gap, Random& random);

/// The parallelogram with the edge `on` - u .. `on` + u that extends from it by w, front up if w is left of u seen from
/// above.
Points plate(const Exact_point& on, const Exact_point& u, const Exact_point& w);

inline Exact_point scaled(const Rational& factor, const Exact_point& v) { return along(at(0, 0, 0), factor, v); }
Exact_point level_direction(Random& random);
/// A fraction strictly between 0 and 1.
Rational share(Random& random);
/// Numbers in increasing order from `low` to `high`, these included, `inner` of them between.
std::vector<Rational> subdivided(const Rational& low, const Rational& high, std::size_t inner, Random& random);

}  // namespace sightline::generate::weak_drafts
