#include <sightline/algorithms/cutset/motion.h>

#include <cstddef>
#include <stdexcept>

namespace sightline {

Viewpoint Rigid_motion::seen_from(const Viewpoint& view) const {
  const auto& [w, x, y, z] = quaternion;
  const Rational size = w * w + x * x + y * y + z * z;
  if (size == 0) throw std::invalid_argument("a rotation wants a quaternion that is not zero");
  Exact_point p = view.at;
  if (!view.at_infinity)
    for (std::size_t k = 0; k < 3; ++k) p[k] -= translation[k];
  const Rational rows[3][3] = {{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
                               {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
                               {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
  Viewpoint turned{p, view.at_infinity};
  for (std::size_t k = 0; k < 3; ++k) turned.at[k] = (rows[0][k] * p[0] + rows[1][k] * p[1] + rows[2][k] * p[2]) / size;
  return turned;
}

}  // namespace sightline
