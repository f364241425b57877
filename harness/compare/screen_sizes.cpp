#include <sightline/harness/compare/screen_sizes.h>

#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sightline {

void Screen_sizes::add(double pixels) {
  ++counts[static_cast<std::size_t>(std::upper_bound(bounds.begin(), bounds.end(), pixels) - bounds.begin())];
  largest = std::max(largest, pixels);
}

std::size_t Screen_sizes::measured() const { return std::accumulate(counts.begin(), counts.end(), std::size_t{0}); }

/// The largest angle between corners of a part, as the eye sees them.
static double length_of(const Part& part, const Exact_point& eye) {
  std::vector<Exact_point> rays;
  for (const Exact_point& p : part.corners) rays.push_back(scaled_to_one(minus(p, eye)));
  double length = 0;
  for (const Exact_point& a : rays)
    for (const Exact_point& b : rays) {
      const Exact_point across = cross(a, b);
      length = std::max(length, std::atan2(square_root(dot(across, across)), nearest_double(dot(a, b))));
    }
  return length;
}

std::map<Face_id, Seen_face> seen_faces(const Model& model, const Exact_point& eye, const Asking& asking) {
  // 1. All parts of each face.
  const Seen seen = see(model, eye, asking);
  struct Largest_part {
    const Part* part;
    double angle;
  };
  std::map<Face_id, Seen_face> faces;
  std::map<Face_id, Largest_part> largest;
  for (const Seen::Visible_part& part : seen.parts) {
    if (!part.from_front) continue;
    const double angle = part.solid_angle(eye);
    faces[part.face].pixels += angle / pixel_angle;
    const auto [place, is_new] = largest.try_emplace(part.face, Largest_part{&part, angle});
    if (!is_new && angle > place->second.angle) place->second = {&part, angle};
  }

  // 2. The largest.
  for (const auto& [face, of_face] : largest) {
    Seen_face& found = faces[face];
    const std::vector<Exact_point>& corners = of_face.part->corners;
    found.width = of_face.angle > 0 ? of_face.angle / length_of(*of_face.part, eye) : 0;  // 0: less than doubles hold
    found.middle = {0, 0, 0};
    for (const Exact_point& corner : corners)
      for (std::size_t k = 0; k < 3; ++k) found.middle[k] += corner[k] / static_cast<long>(corners.size());
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
