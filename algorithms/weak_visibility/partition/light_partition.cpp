#include <sightline/algorithms/weak_visibility/partition/light_partition.h>

#include <sightline/algorithms/weak_visibility/events/quadratic_roots.h>
#include <sightline/kernel/vectors.h>

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <optional>

namespace sightline {

const char* name_of(Light light) {
  constexpr const char* names[] = {"lit", "penumbra", "umbra", "undecided"};
  return names[static_cast<std::size_t>(light)];
}

namespace {

using Share = CGAL::Interval_nt<>;

/// Each between 0 and 1, and no more and no less than the others leave of 1, which all of them are together.
std::array<Bounded, lights> shares_of(const std::array<Share, lights>& sums) {
  std::array<Bounded, lights> found;
  for (std::size_t k = 0; k < lights; ++k) {
    Share left = 1;
    for (std::size_t other = 0; other < lights; ++other)
      if (other != k) left -= Share(std::clamp(sums[other].inf(), 0.0, 1.0), std::clamp(sums[other].sup(), 0.0, 1.0));
    found[k] = {std::max({sums[k].inf(), left.inf(), 0.0}), std::min({sums[k].sup(), left.sup(), 1.0})};
  }
  return found;
}

/// Twice its area, along its normal.
Exact_point area_vector(const Scene& scene, const Piece& piece) {
  Exact_point sum{0, 0, 0};
  const std::span<const Piece_corner> corners = scene.corners(piece);
  const Exact_point first = scene.position(corners[0].point);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Exact_point part =
        cross(minus(scene.position(corners[i].point), first), minus(scene.position(corners[i + 1].point), first));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
  }
  return sum;
}

}  // namespace

Exact_point Light_partition::point(const Rational& x, const Rational& y) const {
  Exact_point p = chart[0];
  for (std::size_t k = 0; k < 3; ++k) p[k] += x * chart[1][k] + y * chart[2][k];
  return p;
}

std::array<Bounded, lights> Light_partition::shares() const {
  std::array<Share, lights> sums{0, 0, 0, 0};
  for (const Cell& cell : cells) sums[static_cast<std::size_t>(cell.light)] += Share(cell.area.low, cell.area.high);
  return shares_of(sums);
}

std::array<Bounded, lights> shares_of_face(const Scene& scene, std::span<const Light_partition> pieces) {
  if (pieces.size() == 1) return pieces[0].shares();
  std::vector<Exact_point> areas;
  Rational largest = 0;
  for (const Light_partition& partition : pieces) {
    areas.push_back(area_vector(scene, scene.pieces()[partition.piece]));
    for (const Rational& x : areas.back()) largest = std::max(largest, Rational(abs(x)));
  }
  Share whole = 0;
  std::array<Share, lights> sums{0, 0, 0, 0};
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    Share square = 0;
    for (const Rational& x : areas[n]) {
      const Bounded near = bounds_of(Rational(x / largest));
      square += CGAL::square(Share(near.low, near.high));
    }
    const Share area = CGAL::sqrt(square);
    whole += area;
    const std::array<Bounded, lights> own = pieces[n].shares();
    for (std::size_t k = 0; k < lights; ++k) sums[k] += area * Share(own[k].low, own[k].high);
  }
  for (Share& sum : sums) sum /= whole;
  return shares_of(sums);
}

std::size_t Light_partition::cell_at(const Rational& x, const Rational& y) const {
  if (x <= 0 || x >= 1 || y <= 0 || y >= 1) return none;
  // The nearest borders below and above.
  const Quadratic_root here(y.get_num(), 0, Integer(0), y.get_den());
  std::optional<Quadratic_root> low, high;
  std::size_t under = none, over = none;
  for (const Border& border : borders) {
    const Bounded &from = border.x[0], &to = border.x[1];
    if (x < exact(from.low) || x > exact(to.high)) continue;
    if (x <= exact(from.high) || x >= exact(to.low)) return none;
    const std::optional<Quadratic_root> at = curves[border.curve].height(x, border.upper);
    const int order = at ? compare(*at, here) : 0;
    if (order == 0) return none;
    if (order < 0 && (!low || *low < *at)) {
      low = at;
      under = border.above;
    }
    if (order > 0 && (!high || *at < *high)) {
      high = at;
      over = border.below;
    }
  }
  if (low) return under;
  if (high) return over;
  // One cell from the lower to the upper side.
  for (const Strip& strip : strips)
    if (exact(strip.lower.front()[0]) < x && x < exact(strip.lower.back()[0])) return strip.cell;
  return none;
}

}  // namespace sightline
