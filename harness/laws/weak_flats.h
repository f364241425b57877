#pragma once
// Convex polygons in rationals, by definition: what the oracles of the subject `weak` stand on. Shares nothing with the
// search.

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/scene.h>

#include <cstddef>
#include <vector>

namespace sightline::harness::weak_flats {

/// A plane, by its normal and where it is along that.
struct Level {
  Exact_point normal;
  Rational offset;

  Rational height(const Exact_point& p) const;
  int side(const Exact_point& p) const { return sgn(height(p)); }
  Level turned() const;
};

/// The plane of a polygon, seen counterclockwise from its positive side. Pre: the first corner that is not straight is
/// convex, as all are of a convex polygon; its area is not zero.
Level level_of(const generate::Points& polygon);

/// 1 or -1: all corners are on that closed side, and not all in the plane; 0: all are in it; 2: they are on both sides.
int position(const Level& level, const generate::Points& polygon);

/// The part of a convex polygon on the closed positive side; empty where it has no inside.
generate::Points clipped(const generate::Points& polygon, const Level& level);

/// A convex polygon in parts that no plane of some passes.
std::vector<generate::Points> cells(const generate::Points& polygon, const std::vector<Level>& planes);

/// The corners of a scene's pieces, by their places.
std::vector<generate::Points> polygons(const Scene& scene);

/// A point strictly inside a convex hull: a mixture of corners with weights from 1 to 8.
Exact_point inner_point(const generate::Points& corners, generate::Random& random);

/// Of a point in the plane of a convex polygon: 1 inside, 0 on the boundary, -1 outside.
int location(const generate::Points& polygon, const Level& level, const Exact_point& p);

/// Whether the closed segment from p to q may meet a convex polygon: always where it does, and where it only lies in
/// its plane.
bool may_meet(const generate::Points& polygon, const Exact_point& p, const Exact_point& q);

}  // namespace sightline::harness::weak_flats
