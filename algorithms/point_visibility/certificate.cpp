#include <sightline/algorithms/point_visibility/certificate.h>

#include <sightline/algorithms/covering_of_scene.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/kernel/number.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

namespace sightline {
namespace {

/// The rays of a surface by number: of those that have one name, one.
class Numbered_rays {
 public:
  explicit Numbered_rays(const std::vector<Exact_view::Ray>& rays) : number_(rays.size()) {
    std::vector<std::uint32_t> order(rays.size());
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
      return std::pair(name(rays[i]), i) < std::pair(name(rays[j]), j);
    });
    // Numbers go by the first place, so that those of a part are near each other.
    for (std::size_t k = 0; k < order.size(); ++k)
      number_[order[k]] = k > 0 && name(rays[order[k]]) == name(rays[order[k - 1]]) ? number_[order[k - 1]] : order[k];
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
      if (number_[i] == i) {
        number_[i] = static_cast<std::uint32_t>(first_.size());
        first_.push_back(i);
      } else {
        number_[i] = number_[number_[i]];
      }
    }
  }
  /// Of each number: the place of a ray.
  const std::vector<std::uint32_t>& first() const { return first_; }
  std::span<const std::uint32_t> of(const Visible_surface<Exact_view>::Part& part) const {
    return {number_.data() + part.first, part.size};
  }

 private:
  using Name = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, bool>;
  /// Rays of one name are one. The product of two normals is the other way round where they are exchanged.
  static Name name(const Exact_view::Ray& ray) {
    if (ray.point != Exact_view::no_point) return {ray.point, 0, 0, 0, 0, ray.flipped};
    const std::pair p(ray.p.a, ray.p.b), q(ray.q.a, ray.q.b);
    return p < q ? Name{ray.point, p.first, p.second, q.first, q.second, ray.flipped}
                 : Name{ray.point, q.first, q.second, p.first, p.second, !ray.flipped};
  }

  std::vector<std::uint32_t> number_, first_;
};

/// Coprime integers.
Exact_point direction(const Exact_view& view, const Exact_view::Ray& ray) {
  const std::array<Integer, 3> d = view.direction(ray);
  const Integer divisor = gcd(gcd(d[0], d[1]), d[2]);
  return {Rational(Integer(d[0] / divisor)), Rational(Integer(d[1] / divisor)), Rational(Integer(d[2] / divisor))};
}

}  // namespace

Visible_certificate visible_certificate(const Exact_view& view, const Visible_surface<Exact_view>& surface,
                                        const Exact_point& eye, const std::vector<Exact_point>& field) {
  Visible_certificate certificate;
  certificate.eye = eye;
  certificate.field = field;
  add_all(certificate, view.scene());
  const Numbered_rays numbered(surface.rays);
  for (const std::uint32_t i : numbered.first()) certificate.rays.push_back(direction(view, surface.rays[i]));
  for (const auto& part : surface.parts) {
    const std::span<const std::uint32_t> rays = numbered.of(part);
    if (part.piece == surface.nothing) {
      auto& directions = certificate.empty.emplace_back();
      for (const std::uint32_t ray : rays) directions.push_back(certificate.rays[ray]);
    } else {
      certificate.parts.push_back({part.piece, {}, {}, {rays.begin(), rays.end()}});
    }
  }
  return certificate;
}

void write_visible_certificate(std::ostream& out, const Exact_view& view, const Visible_surface<Exact_view>& surface,
                               const Exact_point& eye, const std::vector<Exact_point>& field,
                               const std::function<void(std::size_t done, std::size_t all)>& progress) {
  std::size_t done = 0;
  const auto step = [&, all = surface.rays.size() + 2 * surface.parts.size()] {
    if (progress && done++ % 256 == 0) progress(done, all);
  };
  step();
  Covering scene;
  add_all(scene, view.scene());
  Visible_certificate_writer writer(out, scene, eye, field);
  scene = {};
  const Numbered_rays numbered(surface.rays);
  for (const std::uint32_t i : numbered.first()) {
    step();
    writer.ray(direction(view, surface.rays[i]));
  }
  for (const bool seen : {true, false})
    for (const auto& part : surface.parts) {
      step();
      if (seen != (part.piece != surface.nothing)) continue;
      if (seen) writer.part(part.piece, numbered.of(part));
      else writer.empty(numbered.of(part));
    }
  writer.finish();
}

}  // namespace sightline
