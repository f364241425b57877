#include <sightline/algorithms/weak_visibility/events/homogeneous.h>

namespace sightline {

Exact_pluecker join(const Homogeneous& a, const Homogeneous& b) { return homogeneous_detail::joined(a, b); }

Homogeneous join(const Homogeneous& x, const Exact_pluecker& e) { return homogeneous_detail::plane_of(x, e); }

Homogeneous meet(const Homogeneous& h, const Exact_pluecker& e) {
  return {h[1] * e[5] - h[2] * e[4] - h[3] * e[0], h[2] * e[3] - h[0] * e[5] - h[3] * e[1],
          h[0] * e[4] - h[1] * e[3] - h[3] * e[2], h[0] * e[0] + h[1] * e[1] + h[2] * e[2]};
}

Exact_pluecker meet(const Homogeneous& g, const Homogeneous& h) { return homogeneous_detail::met(g, h); }

Integer dot(const Homogeneous& a, const Homogeneous& b) {
  Integer sum = a[0] * b[0];
  for (std::size_t k = 1; k < 4; ++k) mpz_addmul(sum.get_mpz_t(), a[k].get_mpz_t(), b[k].get_mpz_t());
  return sum;
}

Integer side(const Exact_pluecker& a, const Exact_pluecker& b) {
  Integer sum = a[0] * b[3];
  for (std::size_t k = 1; k < 6; ++k) mpz_addmul(sum.get_mpz_t(), a[k].get_mpz_t(), b[(k + 3) % 6].get_mpz_t());
  return -sum;
}

Near<4> near(const Near_point& p) {
  const double size = std::max({1.0, std::fabs(p.near[0]), std::fabs(p.near[1]), std::fabs(p.near[2])});
  return {{p.near[0], p.near[1], p.near[2], 1}, size, 0x1p-51 * size};
}

namespace {

/// Of entries each within 2^-52 of themselves and 2^-1074.
template <std::size_t n>
Near<n> rounded(const std::array<double, n>& at) {
  Near<n> result = homogeneous_detail::bounded(at, 0.0);
  result.error = 0x1p-51 * result.size + 0x1p-1000;
  return result;
}

}  // namespace

Near<4> near(const Near_plane& h) { return rounded(h.near); }

Near<4> near(const Near_frame& frame, const Homogeneous& x) {
  Near_point p;
  for (std::size_t k = 0; k < 3; ++k) p.near[k] = frame.near(x[k], x[3]);
  return near(p);
}

Near<6> near(const Near_frame& frame, const Exact_pluecker& e) {
  const Integer most = std::max({Integer(abs(e[0])), Integer(abs(e[1])), Integer(abs(e[2]))});
  std::array<double, 6> at;
  for (std::size_t k = 0; k < 3; ++k) at[k] = near_quotient(e[k], most, 0);
  for (std::size_t k = 3; k < 6; ++k) at[k] = frame.near(e[k], most);
  return rounded(at);
}

}  // namespace sightline
