#include <sightline/harness/laws/solid_oracle.h>

#include <sightline/harness/generate/solids.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace sightline::harness {

Solid_oracle::Solid_oracle(const Polygon_soup& soup) {
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    const Scene alone(generate::face_alone(soup, f));
    for (Flat_face& face : flat_faces_of(alone)) faces_.push_back(std::move(face));
    has_bent_faces_ |= !alone.non_planar().empty();
    if (std::any_of(alone.set_aside().begin(), alone.set_aside().end(),
                    [](const Set_aside& aside) { return aside.reason != Set_aside_reason::zero_area; }))
      unusable_.push_back(f);
  }
}

Polygon_soup Solid_oracle::parts() const {
  Polygon_soup soup;
  std::vector<Point_id> loop;
  for (const Flat_face& face : faces_) {
    loop.clear();
    for (const Exact_point& p : face.corners) loop.push_back(soup.add_point(p[0], p[1], p[2]));
    soup.add_face(loop);
  }
  return soup;
}

bool Solid_oracle::is_on_a_face(const Exact_point& p) const {
  return std::any_of(faces_.begin(), faces_.end(), [&](const Flat_face& face) { return face.holds(p); });
}

int Solid_oracle::winding(const Exact_point& p, generate::Random& random) const {
  for (;;) {
    const Exact_point direction = generate::lattice(random, 1000);
    if (is_zero(direction)) continue;
    int winding = 0;
    bool general = true;
    for (const Flat_face& face : faces_) {
      const std::optional<Rational> t = met_at(face, p, direction);
      if (!t) continue;
      const Rational slope = dot(face.normal, direction);
      general = slope != 0 && face.side_within(generate::along(p, *t, direction)) > 0;
      if (!general) break;
      winding += sgn(slope);
    }
    if (general) return winding;
  }
}

Exact_point any_point_of(const std::vector<Exact_point>& corners, generate::Random& random) {
  const auto any = [&] { return corners[random.below(corners.size())]; };
  const Exact_point p = any(), q = any(), r = any();
  const Rational s = Rational(static_cast<long>(random.between(0, 8))) / 8;
  const long parts = random.chance(1, 2) ? 1024 : 6;
  const Rational t = Rational(static_cast<long>(random.between(-1, 4))) / parts;
  Exact_point point;
  for (std::size_t k = 0; k < 3; ++k) point[k] = p[k] + s * (q[k] - p[k]) + t * (r[k] - p[k]);
  return point;
}

std::vector<Exact_point> corners_of(const Polygon_soup& soup) {
  std::vector<Exact_point> corners;
  for (Point_id p = 0; p < soup.point_count(); ++p) corners.push_back(soup.point(p));
  return corners;
}

std::string text_of(const Exact_point& p) {
  return "(" + sightline::to_string(p[0]) + ", " + sightline::to_string(p[1]) + ", " + sightline::to_string(p[2]) + ")";
}

}  // namespace sightline::harness
