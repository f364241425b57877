#include <sightline/algorithms/priority/rounded_plane.h>

#include <cmath>
#include <cstddef>

namespace sightline::priority_detail {

namespace {

double reach(const std::array<double, 3>& v) { return 1 + std::fabs(v[0]) + std::fabs(v[1]) + std::fabs(v[2]); }

}  // namespace

Rounded_plane::Rounded_plane(const Triple& a, const Triple& b) : lost(0x1p-900 * reach(a) * reach(b)) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t p = (k + 1) % 3, q = (k + 2) % 3;
    normal[k] = a[p] * b[q] - a[q] * b[p];
    size[k] = std::fabs(a[p] * b[q]) + std::fabs(a[q] * b[p]);
  }
}

int Rounded_plane::side(const Triple& d) const {
  const double value = normal[0] * d[0] + normal[1] * d[1] + normal[2] * d[2];
  const double bound =
      0x1p-49 * (size[0] * std::fabs(d[0]) + size[1] * std::fabs(d[1]) + size[2] * std::fabs(d[2])) + lost * reach(d);
  return value > bound ? 1 : value < -bound ? -1 : 0;
}

}  // namespace sightline::priority_detail
