#pragma once
// Planes through a viewpoint in doubles, before what is exact; and the points of polygons, for that.

#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/traits/partition_traits.h>
#include <sightline/kernel/vectors.h>

#include <array>
#include <vector>

namespace sightline::priority_detail {

/// The corners of a polygon.
template <class Traits>
std::vector<Exact_point> positions(const Traits& traits, const Convex_polygon<Traits>& polygon) {
  std::vector<Exact_point> points;
  for (const Corner<Traits>& corner : polygon) points.push_back(traits.position(*corner.vertex));
  return points;
}

/// The plane through a viewpoint and two points, given by the vectors to them, in doubles that are each within a
/// relative 2^-53.
struct Rounded_plane {
  Triple normal, size;
  double lost;  ///< of what underflow may take, at a direction of size 1

  /// In front is where a, b and the direction are positively oriented.
  Rounded_plane(const Triple& a, const Triple& b);
  /// The side of a direction of that kind: 1, -1, or 0 where doubles do not tell. Products of two are off by 3 x 2^-53
  /// of their size, their difference by 4, a product with the direction by 6, the sum of three by 8: 2^-49 covers that;
  /// the last term is for underflow, which costs the more the larger the other two are. What is beyond doubles is not
  /// told. Proof: P-33
  int side(const Triple& d) const;
};

}  // namespace sightline::priority_detail
