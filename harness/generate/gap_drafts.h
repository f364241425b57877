#pragma once
// Families of small scenes with an eye that are degenerate where a gap is zero: faces without area, planes and edges
// that coincide, equal depth. A positive gap and a negative one are the two sides of it.

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/view_drafts.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>

namespace sightline::generate::view_drafts {

/// Vectors u, v, w of a small lattice, linearly independent.
std::array<Exact_point, 3> axes(Random& random);
inline Points moved(Points face, const Rational& t, const Exact_point& d) {
  for (Exact_point& p : face) p = along(p, t, d);
  return face;
}
inline Exact_point unit_vector(Random& random) {
  Exact_point e{0, 0, 0};
  e[random.below(3)] = 1;
  return e;
}

/// Copies of faces, begun elsewhere, turned, with a straight corner more; each moved by the gap.
Made duplicates(Random& random, const Rational& gap);

/// Needles, slivers and caps that are as wide as the gap, so without area where it is zero; also faces that go there
/// and back.
Made slender(Random& random, const Rational& gap);

/// Faces in one plane, or in planes that lean from it by the gap.
Made near_parallel(Random& random, const Rational& gap);

/// A stack of thin leaves, one gap between each and the next; some are left out.
Made leaves(Random& random, const Rational& gap);

/// Tiles at one depth before the eye, side by side and over each other, each moved by the gap, nearer or farther or
/// not; also crossing one another there.
Made equal_depth(Random& random, const Rational& gap);

/// Pages with an edge each on one line, of any length there, each moved off it by the gap.
Made collinear_edges(Random& random, const Rational& gap);

struct Gap_drafter {
  const char* name;
  const char* what;
  Made (*draft)(Random& random, const Rational& gap);
};
extern const std::array<Gap_drafter, 6> gap_drafters;

}  // namespace sightline::generate::view_drafts
