#pragma once
// The lines of a scene: canonical integer Plücker coordinates, each line once, numbered.

#include <sightline/kernel/fixed_integer.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/row_table.h>

#include <cstddef>
#include <cstdint>
#include <vector>

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
  explicit Line_table(Grid_points&&) = delete;
  explicit Line_table(const Grid_points& points)
      : points_(&points), limbs_((2 * points.bits() + 3) / 64 + 1), rows_(static_cast<std::size_t>(6 * limbs_)) {}

  /// The line from point p to point q. Pre: p != q, or std::domain_error.
  Line through(std::uint32_t p, std::uint32_t q);

  std::size_t size() const { return rows_.size(); }
  /// Plücker coordinate k of the canonical line: 0..2 direction, 3..5 moment.
  Integer integer(std::uint32_t id, int k) const { return from_limbs(rows_[id] + k * limbs_, limbs_); }

 private:
  Line through_small(std::uint32_t p, std::uint32_t q);  // grids of 62 bits at most
  Line through_any(std::uint32_t p, std::uint32_t q);

  const Grid_points* points_;
  int limbs_;
  Row_table rows_;
  std::vector<Limb> scratch_;
};

}  // namespace sightline
