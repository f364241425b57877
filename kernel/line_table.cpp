#include <sightline/kernel/line_table.h>

#include <array>
#include <stdexcept>

namespace sightline {

Line Line_table::through(std::uint32_t p, std::uint32_t q) {
  std::array<Integer, 3> a, b, direction;
  for (int k = 0; k < 3; ++k) {
    const std::size_t i = static_cast<std::size_t>(k);
    a[i] = points_->integer(p, k);
    b[i] = points_->integer(q, k);
    direction[i] = b[i] - a[i];
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

}  // namespace sightline
