#include <sightline/algorithms/point_visibility/certificate.h>

#include <sightline/algorithms/covering_of_scene.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/kernel/number.h>

#include <array>
#include <cstddef>

namespace sightline {

Visible_certificate visible_certificate(const Exact_view& view, const Visible_surface<Exact_view>& surface,
                                        const Exact_point& eye, const std::vector<Exact_point>& field) {
  Visible_certificate certificate;
  certificate.eye = eye;
  certificate.field = field;
  add_all(certificate, view.scene());
  for (const auto& part : surface.parts) {
    if (part.piece == surface.nothing) {
      auto& directions = certificate.empty.emplace_back();
      for (const auto& ray : surface.of(part)) {
        const std::array<Integer, 3> d = view.direction(ray);
        directions.push_back({Rational(d[0]), Rational(d[1]), Rational(d[2])});
      }
      continue;
    }
    const std::vector<Exact_point> corners = vertices(view, surface, part);
    Exact_point ray{0, 0, 0};  // to the mean of the corners
    for (const Exact_point& p : corners)
      for (std::size_t k = 0; k < 3; ++k) ray[k] += (p[k] - eye[k]) / static_cast<long>(corners.size());
    certificate.parts.push_back({part.piece, corners, ray});
  }
  return certificate;
}

}  // namespace sightline
