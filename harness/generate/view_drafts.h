#pragma once
// Families of small scenes with an eye, where what is seen is decided by ties, touches and alignments.

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstddef>

namespace sightline::generate::view_drafts {

/// A point that some face makes special, or none does: beyond an edge on its line, in a plane, on the line from one
/// corner through another, anywhere.
Exact_point some_eye(const Faces& faces, Random& random);

/// A scene in the making, and places to look from.
struct Made {
  Faces faces;
  Points eyes;
};
Made with_some_eyes(Faces faces, Random& random, std::size_t count = 3);

// ---- Families

inline Made uniform(Random& random) {
  Faces faces;
  add_any(faces, 2 + random.below(11), random);
  return with_some_eyes(faces, random);
}

Made coplanar(Random& random);

/// Bars from a low end at one corner of a polygon to a high end beyond the next one: each lies over the next.
Made cyclic(Random& random);

Made crossing(Random& random);

Made joined(Random& random);

Made boxes(Random& random);

Made edge_on(Random& random);

Made touching(Random& random);

Made inside(Random& random);

Rational factor(Random& random);
inline Exact_point scaled_about(const Exact_point& eye, const Rational& scale, const Exact_point& p) {
  return along(eye, scale, minus(p, eye));
}

Made aligned(Random& random);

/// Corners, and inner points of edges and of faces, on one ray from the eye.
Made concurrent(Random& random);

struct Drafter {
  const char* name;
  const char* what;
  Made (*draft)(Random& random);
};
extern const std::array<Drafter, 11> drafters;

}  // namespace sightline::generate::view_drafts
