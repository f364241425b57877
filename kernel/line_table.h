#pragma once
// The lines of a scene: canonical integer Plücker coordinates, each line once, numbered.

#include <sightline/kernel/plane_table.h>

namespace sightline {

/// An oriented line by name. Two handles with one id are the same line in space, whatever segments of it they came
/// from.
struct Line {
  std::uint32_t id;
  bool flipped;  ///< runs against the canonical direction
  friend bool operator==(const Line&, const Line&) = default;
};

/// Interned lines through two grid points: direction q - p and moment p x q, divided by the greatest common divisor of
/// the direction (which divides the moment p x (q - p) too), the first non-zero of the direction positive. Edges on one
/// line share an id also where their end points differ. Exact: yes. Proof: P-01
class Line_table {
 public:
  explicit Line_table(const Grid_points& points)
      : points_(&points), limbs_((2 * points.bits() + 3) / 64 + 1), rows_(static_cast<std::size_t>(6 * limbs_)) {}

  /// The line from point p to point q. Pre: p != q, or std::domain_error.
  Line through(std::uint32_t p, std::uint32_t q) {
    std::array<Integer, 3> a, b, direction;
    for (int k = 0; k < 3; ++k) {
      const std::size_t i = static_cast<std::size_t>(k);
      a[i] = points_->integer(p, k), b[i] = points_->integer(q, k), direction[i] = b[i] - a[i];
    }
    const Integer common = gcd(gcd(direction[0], direction[1]), direction[2]);
    if (sgn(common) == 0) throw std::domain_error("a line needs two points");
    const int lead = sgn(direction[0]) != 0   ? sgn(direction[0])
                     : sgn(direction[1]) != 0 ? sgn(direction[1])
                                              : sgn(direction[2]);
    const Integer divisor = lead < 0 ? Integer(-common) : common;
    for (Integer& x : direction) x /= divisor;
    const std::array<Integer, 3> moment{a[1] * direction[2] - a[2] * direction[1],
                                        a[2] * direction[0] - a[0] * direction[2],
                                        a[0] * direction[1] - a[1] * direction[0]};
    scratch_.resize(rows_.stride());
    for (std::size_t k = 0; k < 3; ++k) {
      to_limbs(direction[k], &scratch_[k * static_cast<std::size_t>(limbs_)], limbs_);
      to_limbs(moment[k], &scratch_[(3 + k) * static_cast<std::size_t>(limbs_)], limbs_);
    }
    return {rows_.intern(scratch_.data()), lead < 0};
  }

  std::size_t size() const { return rows_.size(); }
  /// Plücker coordinate k of the canonical line: 0..2 direction, 3..5 moment.
  Integer integer(std::uint32_t id, int k) const { return from_limbs(rows_[id] + k * limbs_, limbs_); }

 private:
  const Grid_points* points_;
  int limbs_;
  Row_table rows_;
  std::vector<Limb> scratch_;
};

}  // namespace sightline
