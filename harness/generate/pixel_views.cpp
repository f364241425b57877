#include <sightline/harness/generate/pixel_views.h>

#include <sightline/kernel/number.h>
#include <sightline/kernel/vectors.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace sightline::generate {

namespace {

std::array<double, 3> rounded(const Exact_point& v) {
  return {nearest_double(v[0]), nearest_double(v[1]), nearest_double(v[2])};
}

}  // namespace

void flatten(Pixel_view& view, Random& random) {
  std::array<double, 3>* directions[] = {&view.look, &view.right, &view.up};
  std::swap(directions[2], directions[random.below(3)]);
  auto& [first, second, moved] = directions;
  const double some = static_cast<double>(random.between(-4, 4)) / 3,
               more = static_cast<double>(random.between(1, 4)) / 4;
  for (std::size_t k = 0; k < 3; ++k) (*moved)[k] = some * (*first)[k] + more * (*second)[k];
  double& entry = (*moved)[random.below(3)];
  entry += std::ldexp(entry == 0 ? 1 : entry, -static_cast<int>(random.between(5, 52)));
}

void stretch(Pixel_view& view, Random& random) {
  const std::int64_t most = random.chance(1, 2) ? 300 : 8;
  for (std::array<double, 3>* direction : {&view.look, &view.right, &view.up}) {
    const auto power = static_cast<int>(random.between(-most, most));
    for (double& x : *direction) x = std::ldexp(x, power);
  }
}

Pixel_view any_pixel_view(const Polygon_soup& soup, const Exact_point& eye, Random& random) {
  const auto point = [&] { return soup.point(static_cast<Point_id>(random.below(soup.point_count()))); };
  const auto small = [&] { return static_cast<double>(random.between(-4, 4)); };
  for (;;) {
    Pixel_view view{eye, {}, {}, {}, 0, 0};
    view.width = 5 + static_cast<std::uint32_t>(random.below(12));
    view.height = 5 + static_cast<std::uint32_t>(random.below(12));
    const std::uint64_t kind = random.below(3);
    if (kind == 0) {
      const std::size_t axis = random.below(3);
      view.look[axis] = random.chance(1, 2) ? 1 : -1;
      view.right[(axis + 1) % 3] = random.chance(1, 2) ? 2 : -1;
      view.up[(axis + 2) % 3] = random.chance(1, 2) ? 0.5 : -2;
      view.width = 8;
      view.height = 16;
    } else if (kind == 1) {
      const Exact_point p = point(), q = point();
      view.look = rounded(minus(p, eye));
      view.right = rounded(minus(q, p));
      view.up = {small(), small(), small()};
      view.width |= 1;
      view.height |= 1;
    } else {
      for (std::size_t k = 0; k < 3; ++k) {
        view.look[k] = small() + 0.125;
        view.right[k] = small() / 3;
        view.up[k] = small();
      }
    }
    if (random.chance(1, 5)) flatten(view, random);
    if (random.chance(1, 8)) stretch(view, random);
    const auto is_finite = [](const std::array<double, 3>& v) { return std::isfinite(v[0] + v[1] + v[2]); };
    if (!is_finite(view.look) || !is_finite(view.right) || !is_finite(view.up))
      continue;  // the scene is beyond doubles
    if (sgn(dot(exact(view.look), cross(exact(view.right), exact(view.up)))) != 0) return view;
  }
}

}  // namespace sightline::generate
