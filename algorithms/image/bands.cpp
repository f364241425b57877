#include <sightline/algorithms/image/bands.h>

namespace sightline::image_detail {

std::vector<Band> bands_of(const Pixel_cones& cones) {
  constexpr std::int64_t rows = 16;
  const std::int64_t height = cones.centres().view().height;
  std::vector<Band> bands;
  for (std::int64_t top = 0; top < height; top += rows) bands.push_back({top, std::min(top + rows, height), {}});
  for (std::uint32_t i = 0; i < cones.size(); ++i) {
    const Pixel_cones::Cone& cone = cones[i];
    if (cone.left >= cone.right) continue;
    for (std::int64_t top = cone.top / rows * rows; top < cone.bottom; top += rows)
      bands[static_cast<std::size_t>(top / rows)].cones.push_back(i);
  }
  return bands;
}

}  // namespace sightline::image_detail
