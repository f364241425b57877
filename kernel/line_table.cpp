#include <sightline/kernel/line_table.h>

#include <array>
#include <numeric>
#include <stdexcept>

namespace sightline {

Line Line_table::through(std::uint32_t p, std::uint32_t q) {
  return points_->bits() <= 62 ? through_small(p, q) : through_any(p, q);
}

Line Line_table::through_small(std::uint32_t p, std::uint32_t q) {
  std::array<std::int64_t, 3> a, direction;
  std::int64_t common = 0;
  for (int k = 0; k < 3; ++k) {
    const std::size_t i = static_cast<std::size_t>(k);
    a[i] = points_->small(p, k);
    direction[i] = points_->small(q, k) - a[i];
    common = std::gcd(common, direction[i]);
  }
  if (common == 0) throw std::domain_error("a line needs two points");
  const std::int64_t lead = direction[0] != 0 ? direction[0] : direction[1] != 0 ? direction[1] : direction[2];
  if (lead < 0) common = -common;
  for (std::int64_t& x : direction) x /= common;
  scratch_.resize(rows_.stride());
  const auto store = [&](std::size_t k, __int128 x) {
    for (int limb = 0; limb < limbs_; ++limb, x >>= 64)
      scratch_[k * static_cast<std::size_t>(limbs_) + static_cast<std::size_t>(limb)] = static_cast<Limb>(x);
  };
  const auto product = [](std::int64_t x, std::int64_t y) { return static_cast<__int128>(x) * y; };
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
    store(k, direction[k]);
    store(3 + k, product(a[u], direction[v]) - product(a[v], direction[u]));
  }
  return {rows_.intern(scratch_.data()), lead < 0};
}

Line Line_table::through_any(std::uint32_t p, std::uint32_t q) {
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
