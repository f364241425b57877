#pragma once
// Faces that are not drawn: whether the reason that is given for it holds. Rationals and integers only; shares nothing
// with what sets faces aside but the list of reasons. Laws: proofs/order_certificate.md (P-21d, P-22).

#include <sightline/algorithms/verify/covering.h>
#include <sightline/algorithms/verify/faces.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <set>

namespace sightline::certificate_check {

/// Whether two edges of a planar face cross in a point inside both that is none of its loops', or its winding number is
/// neither 0 nor 1 somewhere. Pre: planar, not all points collinear. Proof: P-21d
bool self_intersecting(const Face& face);

/// Whether two closed sequences of points are the same up to the place where they begin.
bool same_cycle(const Polygon& a, const Polygon& b);

/// Rejects unless the reason holds.
void check_set_aside(const Polygon_soup& soup, const Covering::Set_aside& entry, const std::set<Face_id>& set_aside);

}  // namespace sightline::certificate_check
