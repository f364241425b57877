#include <sightline/algorithms/baseline/ray_sampling.h>

#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/kernel/uniform.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace sightline {

std::vector<Face_id> visible_by_sampling(const Occluders& occluders, const std::vector<Weak_source>& sources,
                                         const Ray_sampling_options& options) {
  std::mt19937_64 dice(options.seed);
  const Uniform unit(0, 1);
  const auto length = [](const Triple& a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); };
  const auto scaled = [](const Triple& a, double by) { return Triple{a[0] * by, a[1] * by, a[2] * by}; };
  std::vector<bool> seen(occluders.scene().counters().faces_read);
  std::size_t done = 0;
  for (const Weak_source& source : sources) {
    // 1. A frame on the source, and its triangles by area.
    const Triple& origin = source.polygon[0].near;
    const Triple across = minus(source.polygon[1].near, origin), u = scaled(across, 1 / length(across));
    std::vector<double> areas;
    double total = 0;
    Triple normal{};
    for (std::size_t i = 1; i + 1 < source.polygon.size(); ++i) {
      const Triple part = cross(minus(source.polygon[i].near, origin), minus(source.polygon[i + 1].near, origin));
      for (std::size_t k = 0; k < 3; ++k) normal[k] += part[k];
      areas.push_back(total += length(part));
    }
    const Triple n = scaled(normal, 1 / length(normal)), v = cross(n, u);
    for (std::size_t ray = 0; ray < options.rays; ++ray) {
      if (options.progress && done++ % 4096 == 0) options.progress(done, sources.size() * options.rays);
      // 2. A point, and a direction.
      const double share = unit(dice) * total;
      const std::size_t i =
          std::min(areas.size() - 1,
                   static_cast<std::size_t>(std::upper_bound(areas.begin(), areas.end(), share) - areas.begin())) +
          1;
      double s = unit(dice), t = unit(dice);
      if (s + t > 1) {
        s = 1 - s;
        t = 1 - t;
      }
      const Triple a = minus(source.polygon[i].near, origin), b = minus(source.polygon[i + 1].near, origin);
      const double square = unit(dice), angle = 6.283185307179586 * unit(dice), flat = std::sqrt(square),
                   up = std::sqrt(1 - square);
      Triple p, direction;
      for (std::size_t k = 0; k < 3; ++k) {
        p[k] = origin[k] + s * a[k] + t * b[k];
        direction[k] = flat * std::cos(angle) * u[k] + flat * std::sin(angle) * v[k] + up * n[k];
      }
      // 3. What it hits.
      const auto hit = occluders.first_hit(p, direction);
      if (hit && (hit->front || options.two_sided)) seen[occluders.scene().pieces()[hit->piece].face] = true;
    }
  }
  std::vector<Face_id> visible;
  for (Face_id f = 0; f < seen.size(); ++f)
    if (seen[f]) visible.push_back(f);
  return visible;
}

}  // namespace sightline
