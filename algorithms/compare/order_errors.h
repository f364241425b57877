#pragma once
// How wrong an order of fragments is that an inexact method made, measured exactly.

#include <sightline/algorithms/compare/flat_polygon.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/kernel/scene/scene.h>

namespace sightline {

/// Errors of a back-to-front order against the exact scene. Areas are shares of the area of all faces, each face
/// measured in its projection along the dominant axis of its normal.
struct Order_errors {
  std::uint64_t fragments = 0, degenerate = 0;  ///< given; those that have no area on their face
  std::uint64_t pairs = 0;                      ///< compared; 0 where there were too many
  std::uint64_t wrong = 0;  ///< the earlier one is nearer somewhere, be it by one rounding error at its rim
  std::uint64_t wrong_beyond_rounding = 0;  ///< nearer by more than 2^-20 of the distance somewhere
  Rational lost = 0, overlapping = 0, outside = 0;
};

/// Judges fragments whose vertices may lie off their faces by rounding: each is moved onto the exact plane of its piece
/// along the dominant axis, and stands for its convex hull there. Pairs are compared as `verify` does it, if there are
/// at most max_fragments of them. Cost: quadratic in the fragments, and in the fragments of each piece. Exact: yes.
inline Order_errors order_errors(const Scene& scene, const Exact_point& eye, std::span<const Order_fragment> fragments,
                                 std::size_t max_fragments) {
  Order_errors errors;
  errors.fragments = fragments.size();

  // The plane of each piece in the file's coordinates, and what was drawn of it.
  std::map<std::pair<Face_id, std::uint32_t>, std::size_t> piece_of;
  for (std::size_t i = 0; i < scene.pieces().size(); ++i)
    piece_of[{scene.pieces()[i].face, scene.pieces()[i].number}] = i;
  std::vector<std::vector<std::size_t>> drawn_of(scene.pieces().size());
  for (std::size_t i = 0; i < fragments.size(); ++i)
    drawn_of[piece_of.at({fragments[i].face, fragments[i].piece})].push_back(i);

  std::vector<std::optional<order_check::Cone>> cones(fragments.size());
  Rational all = 0;
  for (std::size_t p = 0; p < scene.pieces().size(); ++p) {
    const Piece& piece = scene.pieces()[p];
    const std::array<Rational, 4> plane = scene.file_coefficients(piece.support);
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (abs(plane[axis]) < abs(plane[k])) axis = k;
    const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
    const auto flat = [&](const Exact_point& q) { return Flat_polygon::Point{q[x], q[y]}; };
    std::vector<Flat_polygon::Point> corners;
    for (const Piece_corner& corner : scene.corners(piece)) corners.push_back(flat(scene.position(corner.point)));
    const Flat_polygon whole = Flat_polygon::hull(std::move(corners));
    all += whole.area();

    std::vector<Flat_polygon> missing{whole};
    Rational sum = 0;
    for (const std::size_t i : drawn_of[p]) {
      corners.clear();
      order_check::Polygon moved;
      for (const Exact_point& q : fragments[i].vertices) {
        corners.push_back(flat(q));
        Exact_point on = q;
        on[axis] = -(plane[x] * q[x] + plane[y] * q[y] + plane[3]) / plane[axis];
        moved.push_back(std::move(on));
      }
      const Flat_polygon part = Flat_polygon::hull(std::move(corners));
      if (part.empty()) {
        ++errors.degenerate;
        continue;
      }
      sum += part.area();
      for (const Flat_polygon& beyond : part.without(whole)) errors.outside += beyond.area(), sum -= beyond.area();
      std::vector<Flat_polygon> rest;
      for (const Flat_polygon& hole : missing)
        for (Flat_polygon& left : hole.without(part)) rest.push_back(std::move(left));
      missing = std::move(rest);
      const order_check::Plane supporting{{Integer(plane[0]), Integer(plane[1]), Integer(plane[2])}, moved[0]};
      if (order_check::not_convex(moved, supporting).empty()) cones[i].emplace(moved, eye);
      else ++errors.degenerate;
    }
    Rational lost = 0;
    for (const Flat_polygon& hole : missing) lost += hole.area();
    errors.lost += lost;
    errors.overlapping += sum - (whole.area() - lost);
  }
  if (all > 0) errors.lost /= all, errors.overlapping /= all, errors.outside /= all;

  if (fragments.size() > max_fragments) return errors;
  order_check::Pair_check check;
  for (std::size_t later = 0; later < fragments.size(); ++later)
    for (std::size_t earlier = 0; earlier < later; ++earlier) {
      ++errors.pairs;
      const auto &a = cones[earlier], &b = cones[later];
      if (!a || !b || a->edge_on || b->edge_on || !check.nearer_somewhere(*a, *b)) continue;
      ++errors.wrong;
      // Moved away by 2^-20 of its distance, is it nearer still?
      order_check::Cone farther = *a;
      for (Integer& coefficient : farther.nearness) coefficient <<= 20;
      farther.distance *= (1 << 20) + 1;
      errors.wrong_beyond_rounding += check.nearer_somewhere(farther, *b);
    }
  return errors;
}

}  // namespace sightline
