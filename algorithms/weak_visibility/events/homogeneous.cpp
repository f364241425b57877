#include <sightline/algorithms/weak_visibility/events/homogeneous.h>

namespace sightline {

Exact_pluecker join(const Homogeneous& a, const Homogeneous& b) {
  return {a[3] * b[0] - b[3] * a[0], a[3] * b[1] - b[3] * a[1], a[3] * b[2] - b[3] * a[2],
          a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Homogeneous join(const Homogeneous& x, const Exact_pluecker& e) {
  return {e[1] * x[2] - e[2] * x[1] + x[3] * e[3], e[2] * x[0] - e[0] * x[2] + x[3] * e[4],
          e[0] * x[1] - e[1] * x[0] + x[3] * e[5], -(x[0] * e[3] + x[1] * e[4] + x[2] * e[5])};
}

Homogeneous meet(const Homogeneous& h, const Exact_pluecker& e) {
  return {h[1] * e[5] - h[2] * e[4] - h[3] * e[0], h[2] * e[3] - h[0] * e[5] - h[3] * e[1],
          h[0] * e[4] - h[1] * e[3] - h[3] * e[2], h[0] * e[0] + h[1] * e[1] + h[2] * e[2]};
}

Exact_pluecker meet(const Homogeneous& g, const Homogeneous& h) {
  return {g[1] * h[2] - g[2] * h[1], g[2] * h[0] - g[0] * h[2], g[0] * h[1] - g[1] * h[0],
          g[3] * h[0] - h[3] * g[0], g[3] * h[1] - h[3] * g[1], g[3] * h[2] - h[3] * g[2]};
}

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

Near<4> near(const Near_plane& h) {
  double size = 0;
  for (const double x : h.near) size = std::max(size, std::fabs(x));
  return {h.near, size, 0x1p-51 * size + 0x1p-1000};
}

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
  double size = 0;
  for (const double x : at) size = std::max(size, std::fabs(x));
  return {at, size, 0x1p-51 * size + 0x1p-1000};
}

}  // namespace sightline
