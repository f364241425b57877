#pragma once
// Weak visibility by brute force: exact tests of random sightlines. One that passes is a proof; that none does says
// nothing.

#include "scenes.h"

namespace weak_oracle {

using oracle::along;
using oracle::cross;
using oracle::dot;
using oracle::Flat;
using oracle::Flats;
using oracle::Half_space;
using oracle::minus;
using oracle::Points;
using sightline::Exact_point;
using sightline::Face_id;
using sightline::Rational;
using sightline::generate::Random;
using weak_scenes::Weak_scene;

/// The plane of a strictly convex polygon. In front of it is the side from which the corners run counterclockwise.
inline Half_space plane_of(const Points& polygon) {
  const Exact_point normal = cross(minus(polygon[1], polygon[0]), minus(polygon[2], polygon[0]));
  return {normal, dot(normal, polygon[0])};
}
inline bool lies_in(const Points& polygon, const Half_space& plane) {
  return std::all_of(polygon.begin(), polygon.end(), [&](const Exact_point& p) { return sgn(plane.height(p)) == 0; });
}

/// Open: p in the relative interior of the source, q of the target.
struct Sightline {
  Exact_point p, q;
};

/// Whether a pair shows that a face is weakly visible, all pairs near it being sightlines too: p strictly in front of
/// one of its pieces, q, strictly in front of the source, within that piece, no piece on the open segment, and through
/// p or q no piece in a plane other than the source's or the target's. Degenerate: grazing is blocked. Exact: yes
inline bool proves_visible(const Flats& flats, const Points& source, Face_id target, const Sightline& line) {
  const Half_space from = plane_of(source);
  const Exact_point &p = line.p, &q = line.q;
  if (sgn(from.height(p)) != 0 || oracle::holds(source, from.normal, p) <= 0 || sgn(from.height(q)) <= 0) return false;
  const auto ends_on = [&](const Flat& piece) {
    return piece.face == target && sgn(piece.height(q)) == 0 && piece.holds(q) > 0 && sgn(piece.height(p)) > 0;
  };
  const auto end = std::find_if(flats.begin(), flats.end(), ends_on);
  if (end == flats.end()) return false;
  return std::none_of(flats.begin(), flats.end(), [&](const Flat& piece) {
    if (lies_in(piece.corners, from) || lies_in(piece.corners, end->plane)) return false;
    const bool through_p = sgn(piece.height(p)) == 0 && piece.holds(p) >= 0,
               through_q = sgn(piece.height(q)) == 0 && piece.holds(q) >= 0;
    return through_p || through_q || oracle::blocks(piece, p, q);
  });
}

/// A point in the relative interior, with weights of the corners that are often of very different sizes.
inline Exact_point random_inner_point(const Points& polygon, Random& random) {
  Exact_point sum = weak_scenes::at(0, 0, 0);
  Rational whole = 0;
  const std::uint64_t unequal = random.chance(1, 2) ? 1 : 24;
  for (const Exact_point& corner : polygon) {
    const Rational weight(static_cast<unsigned long>(1 + random.below(1000)) << random.below(unequal));
    sum = along(sum, weight, corner);
    whole += weight;
  }
  return weak_scenes::scaled(Rational(1 / whole), sum);
}

/// A sightline that proves the target visible, if one of so many random pairs does. Cost: O(tries x pieces). Exact: yes
inline std::optional<Sightline> find_sightline(const Flats& flats, const Points& source, Face_id target,
                                               std::size_t tries, Random& random) {
  std::vector<const Flat*> pieces;
  for (const Flat& flat : flats)
    if (flat.face == target) pieces.push_back(&flat);
  for (; tries > 0 && !pieces.empty(); --tries) {
    const Exact_point p = random_inner_point(source, random);
    const Sightline line{p, random_inner_point(pieces[random.below(pieces.size())]->corners, random)};
    if (proves_visible(flats, source, target, line)) return line;
  }
  return std::nullopt;
}
inline std::optional<Sightline> find_sightline(const Weak_scene& scene, Face_id target, std::size_t tries,
                                               std::uint64_t seed) {
  Random random(seed);
  return find_sightline(oracle::flats_of(sightline::Scene(scene.soup)), scene.source, target, tries, random);
}

}  // namespace weak_oracle
