#include <sightline/harness/compare/screen_sizes.h>

#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <numeric>

namespace sightline {

void Screen_sizes::add(double pixels) {
  ++counts[static_cast<std::size_t>(std::upper_bound(bounds.begin(), bounds.end(), pixels) - bounds.begin())];
  largest = std::max(largest, pixels);
}

std::size_t Screen_sizes::measured() const { return std::accumulate(counts.begin(), counts.end(), std::size_t{0}); }

std::map<Face_id, Seen_face> seen_faces(const Model& model, const Exact_point& eye, const Asking& asking) {
  std::map<Face_id, Seen_face> faces;
  std::map<Face_id, double> largest;
  for (const Seen::Visible_part& part : see(model, eye, asking).parts) {
    if (!part.from_front) continue;
    const double pixels = part.solid_angle(eye) / pixel_angle;
    Seen_face& seen = faces[part.face];
    seen.pixels += pixels;
    if (const auto [place, is_new] = largest.try_emplace(part.face, pixels); !is_new && pixels <= place->second)
      continue;
    largest[part.face] = pixels;
    seen.middle = {0, 0, 0};
    for (const Exact_point& corner : part.corners)
      for (std::size_t k = 0; k < 3; ++k) seen.middle[k] += corner[k] / static_cast<long>(part.corners.size());
  }
  return faces;
}

double size_alone(const Model& model, const Exact_point& eye, Face_id face) {
  const Exact_view view(model.scene(), eye);
  double angle = 0;
  for (std::uint32_t i = 0; i < model.parts().size(); ++i)
    if (const Part& part = model.parts()[i]; part.face == face && view.eye_side(i) == CGAL::POSITIVE)
      angle += part.solid_angle(eye);
  return angle / pixel_angle;
}

}  // namespace sightline
