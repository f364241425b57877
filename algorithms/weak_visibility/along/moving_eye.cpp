#include <sightline/algorithms/weak_visibility/along/moving_eye.h>

#include <sightline/kernel/located_point.h>
#include <sightline/kernel/vectors.h>

#include <cstddef>
#include <stdexcept>

namespace sightline {

Moving_eye::Moving_eye(const Scene& scene, const Near_frame& frame, const Exact_point& from, const Exact_point& to) {
  if (from == to) throw std::invalid_argument("a path has no length; give two different points");
  const Located_point a = scene.locate(from), b = scene.locate(to);
  ends_ = {Homogeneous{a.x, a.y, a.z, a.w}, Homogeneous{b.x, b.y, b.z, b.w}};
  for (std::size_t i = 0; i < 2; ++i) near_[i] = sightline::near(near_point(frame, ends_[i]));
  for (Integer& x : ends_[0]) x *= b.w;
  for (Integer& x : ends_[1]) x *= a.w;
}

Homogeneous Moving_eye::at(const Rational& t) const {
  const Integer &n = t.get_num(), rest = t.get_den() - n;
  Homogeneous p;
  for (std::size_t k = 0; k < 4; ++k) p[k] = rest * ends_[0][k] + n * ends_[1][k];
  return p;
}

Near<4> Moving_eye::near(const Quadratic_root& t) const {
  const double s = t.near();
  Near<4> p{};
  for (std::size_t k = 0; k < 4; ++k) p.at[k] = (1 - s) * near_[0].at[k] + s * near_[1].at[k];
  p.size = near_[0].size + near_[1].size;
  p.error = near_[0].error + near_[1].error + 0x1p-49 * p.size + 0x1p-960;  // s is within 2^-52. P-87
  return p;
}

Quadratic Moving_eye::side(const Homogeneous& plane) const {
  const Integer first = dot(plane, ends_[0]);
  return {{first, Integer(dot(plane, ends_[1]) - first), Integer(0)}};
}

Eye_line eye_line(const Moving_eye& eye, const Near_frame& frame, const Exact_pluecker& line) {
  Eye_line made{line, near(frame, line), {}, {}};
  const Homogeneous from = join(eye.ends()[0], line), to = join(eye.ends()[1], line);
  for (std::size_t k = 0; k < 3; ++k) {
    made.first[k] = from[k];
    made.change[k] = to[k] - from[k];
  }
  return made;
}

Quadratic determinant(const Eye_line& i, const Eye_line& j, const Eye_line& k) {
  const std::array<Integer, 3> constant = cross(i.first, j.first), square = cross(i.change, j.change);
  std::array<Integer, 3> linear = cross(i.first, j.change);
  const std::array<Integer, 3> other = cross(i.change, j.first);
  for (std::size_t x = 0; x < 3; ++x) linear[x] += other[x];
  return {{dot(constant, k.first), Integer(dot(linear, k.first) + dot(constant, k.change)),
           Integer(dot(square, k.first) + dot(linear, k.change))}};
}

Quadratic side(const Moving_eye& eye, const Eye_line& line, const Homogeneous& point) {
  const Integer first = dot(join(eye.ends()[0], line.line), point);
  return {{first, Integer(dot(join(eye.ends()[1], line.line), point) - first), Integer(0)}};
}

}  // namespace sightline
