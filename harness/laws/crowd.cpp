#include <sightline/harness/laws/crowd.h>

#include <sightline/harness/generate/transform.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sightline::harness {

Polygon_soup crowd(const Polygon_soup& soup, std::size_t faces, const Rational& share) {
  Polygon_soup all;
  if (soup.face_count() == 0) return all;
  Exact_point low = soup.point(0), high = low;
  for (Point_id p = 0; p < soup.point_count(); ++p)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], soup.point(p)[k]);
      high[k] = std::max(high[k], soup.point(p)[k]);
    }
  Rational step = 0;
  for (std::size_t k = 0; k < 3; ++k) step = std::max(step, Rational(share * (high[k] - low[k])));
  const std::size_t copies = faces / soup.face_count() + 1;
  const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(copies))));
  for (std::size_t c = 0; c < copies; ++c) {
    const std::array<std::size_t, 3> place{c % side, c / side % side, c / side / side};
    Exact_point offset;
    for (std::size_t k = 0; k < 3; ++k) offset[k] = step * static_cast<long>(place[k]);
    generate::append(all, generate::translated(soup, offset));
  }
  return all;
}

}  // namespace sightline::harness
