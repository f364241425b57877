#include <sightline/harness/compare/order_errors.h>

#include <sightline/algorithms/verify/pairs.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/harness/compare/flat_polygon.h>
#include <sightline/kernel/plane.h>

#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace sightline {

Order_errors order_errors(const Scene& scene, const Exact_point& eye, std::span<const Order_fragment> fragments,
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
      for (const Flat_polygon& beyond : part.without(whole)) {
        errors.outside += beyond.area();
        sum -= beyond.area();
      }
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
  if (all > 0) {
    errors.lost /= all;
    errors.overlapping /= all;
    errors.outside /= all;
  }

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
