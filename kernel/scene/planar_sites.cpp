#include <sightline/kernel/scene/planar_sites.h>

#include <CGAL/predicates/kernel_ftC2.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sightline::planar {

CGAL::Orientation Traits::Orientation_2::operator()(const Site& a, const Site& b, const Site& c) const {
  {
    const CGAL::Protect_FPU_rounding<true> upward;
    const auto filtered = CGAL::orientationC2(a.x, a.y, b.x, b.y, c.x, c.y);
    if (CGAL::is_certain(filtered)) return CGAL::get_certain(filtered);
  }
  return CGAL::orientationC2(a.exact->x, a.exact->y, b.exact->x, b.exact->y, c.exact->x, c.exact->y);
}

CGAL::Oriented_side Traits::Side_of_oriented_circle_2::operator()(const Site& a, const Site& b, const Site& c,
                                                                  const Site& d) const {
  {
    const CGAL::Protect_FPU_rounding<true> upward;
    const auto filtered = CGAL::side_of_oriented_circleC2(a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y);
    if (CGAL::is_certain(filtered)) return CGAL::get_certain(filtered);
  }
  return CGAL::side_of_oriented_circleC2(a.exact->x, a.exact->y, b.exact->x, b.exact->y, c.exact->x, c.exact->y,
                                         d.exact->x, d.exact->y);
}

CGAL::Interval_nt<false> interval(const Integer& n, long shift) {
  long exponent = 0;
  const double mantissa = mpz_get_d_2exp(&exponent, n.get_mpz_t());  // truncated; 1/2 <= |mantissa| < 1, or n = 0
  if (mantissa == 0) return 0.0;
  exponent -= shift;
  // Far below the others a number is only "tiny, of this sign": ldexp would lose bits under 2^-1022.
  constexpr double tiny = 0x1p-900;
  if (exponent <= -900)
    return mantissa > 0 ? CGAL::Interval_nt<false>(0.0, tiny) : CGAL::Interval_nt<false>(-tiny, 0.0);
  const double toward_zero = std::ldexp(mantissa, static_cast<int>(exponent));
  const long bits = static_cast<long>(bit_length(n));
  if (bits <= 53 || static_cast<long>(mpz_scan1(n.get_mpz_t(), 0)) >= bits - 53) return toward_zero;
  const double away = std::nextafter(toward_zero, mantissa > 0 ? HUGE_VAL : -HUGE_VAL);
  return mantissa > 0 ? CGAL::Interval_nt<false>(toward_zero, away) : CGAL::Interval_nt<false>(away, toward_zero);
}

std::vector<Site> sites_of(std::span<const Planar_point> points, const std::vector<std::uint32_t>& used) {
  const Planar_point& base = points[used[0]];
  std::size_t bits = 0;
  Integer x, y;
  for (const std::uint32_t p : used) {
    x = points[p].x - base.x;
    y = points[p].y - base.y;
    bits = std::max({bits, bit_length(x), bit_length(y)});
  }
  std::vector<Site> sites(used.size());
  for (std::size_t i = 0; i < used.size(); ++i) {
    x = points[used[i]].x - base.x;
    y = points[used[i]].y - base.y;
    sites[i] = {interval(x, static_cast<long>(bits)), interval(y, static_cast<long>(bits)), &points[used[i]]};
  }
  return sites;
}

}  // namespace sightline::planar
