#include <sightline/algorithms/priority/rational_geometry.h>

#include <cmath>
#include <cstddef>

namespace sightline {
namespace priority_detail {

Exact_point minus(const Exact_point& a, const Exact_point& b) {
  return {Rational(a[0] - b[0]), Rational(a[1] - b[1]), Rational(a[2] - b[2])};
}

Rational dot(const Exact_point& a, const Exact_point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Exact_point cross(const Exact_point& a, const Exact_point& b) {
  return {Rational(a[1] * b[2] - a[2] * b[1]), Rational(a[2] * b[0] - a[0] * b[2]),
          Rational(a[0] * b[1] - a[1] * b[0])};
}

Rounded_plane::Rounded_plane(const Triple& a, const Triple& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t p = (k + 1) % 3, q = (k + 2) % 3;
    normal[k] = a[p] * b[q] - a[q] * b[p];
    size[k] = std::fabs(a[p] * b[q]) + std::fabs(a[q] * b[p]);
  }
}

int Rounded_plane::side(const Triple& d) const {
  const double value = normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2];
  const double bound =
      0x1p-49 * (size[0] * std::fabs(d[0]) + size[1] * std::fabs(d[1]) + size[2] * std::fabs(d[2])) + 0x1p-900;
  return value > bound ? 1 : value < -bound ? -1 : 0;
}

}  // namespace priority_detail
}  // namespace sightline
