#include <sightline/algorithms/image/painted_cones.h>

#include <sightline/algorithms/image/number_cones.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/vectors.h>

#include <cmath>
#include <span>
#include <type_traits>
#include <utility>

namespace sightline::image_detail {

namespace {

/// A vector in doubles, as in Approximate_eye_plane; scaled, so that it is in their range.
Approximate_eye_plane approximated(const std::array<Integer, 3>& n) {
  const std::array<double, 3> v = in_proportion(n);
  const double size = (std::fabs(v[0]) + std::fabs(v[1]) + std::fabs(v[2])) * (1 + 0x1p-50);
  return {v, size, 0x1p-52 * size + 0x1p-1060};
}

/// The cones of polygons in exact numbers: their edges' normals, inwards.
struct Exact_cone {
  std::uint32_t piece;
  std::vector<std::array<Integer, 3>> corners, normals;  // none where it is edge-on
};

Exact_cone exact_cone(const Painted_polygon& polygon, const Exact_point& eye) {
  Exact_cone cone{polygon.piece, {}, {}};
  std::vector<Exact_point> arms;
  for (const Exact_point& p : polygon.corners) {
    arms.push_back(minus(p, eye));
    cone.corners.push_back(Over_common(arms.back()).whole);
  }
  // A convex polygon has no three corners on a line next to each other, but for those of cuts.
  int sense = 0;
  for (std::size_t k = 2; k < arms.size() && sense == 0; ++k) sense = sgn(dot(arms[0], cross(arms[k - 1], arms[k])));
  if (sense == 0) return {polygon.piece, {}, {}};
  for (std::size_t k = 0; k < arms.size(); ++k) {
    cone.normals.push_back(cross(cone.corners[k], cone.corners[k + 1 == arms.size() ? 0 : k + 1]));
    if (sense < 0)
      for (Integer& x : cone.normals.back()) x = -x;
  }
  return cone;
}

/// A ray to a relative 2^-40.
Approximate_vector close_to(const Exact_view& view, const Exact_view::Ray& ray) {
  if (ray.error < 0x1p-43 * ray.size) return view.approximate(ray);
  const std::array<double, 3> v = approximated(view.direction(ray)).normal;
  return {v[0], v[1], v[2]};
}
/// The plane through two rays, in front of it what is counterclockwise; the bound is that of Exact_view::meet(). P-60
Approximate_eye_plane approximately_through(const Exact_view::Ray& a, const Exact_view::Ray& b) {
  const std::array<double, 3> n = cross(std::array{a.x, a.y, a.z}, std::array{b.x, b.y, b.z});
  const double size = (std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2])) * (1 + 0x1p-50);
  return {n, size, a.size * b.error + b.size * a.error + 4 * a.error * b.error + 0x1p-50 * a.size * b.size + 0x1p-1000};
}

/// A ray of floats or doubles times the power of 2 that makes its largest entry less than 1, so that products of it
/// stay in their range.
template <class Number>
Vector_of<Number> scaled(const Approximate_vector& v) {
  int exponent = 0;
  std::frexp(std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}), &exponent);
  return {static_cast<Number>(std::ldexp(v.x, -exponent)), static_cast<Number>(std::ldexp(v.y, -exponent)),
          static_cast<Number>(std::ldexp(v.z, -exponent))};
}

/// Whether rounded rays, with entries below 1 and one of at least 1/2, agree in half of their digits or more.
template <class Number>
bool are_close(const Vector_of<Number>& a, const Vector_of<Number>& b) {
  const Vector_of<Number> n = cross(a, b);
  return std::max({std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])}) <
         (std::is_same_v<Number, float> ? Number(0x1p-14) : Number(0x1p-27));
}

/// The ray behind ray k of a part.
const Exact_view::Ray& next(std::span<const Exact_view::Ray> rays, std::size_t k) {
  return rays[k + 1 == rays.size() ? 0 : k + 1];
}

}  // namespace

Painted_cones::Painted_cones(const std::vector<Painted_polygon>& polygons, const Pixel_centres& centres,
                             Image_kernel kernel, const Image_options& options)
    : cones_(centres, no_normal) {
  switch (kernel) {
    case Image_kernel::float_numbers: add_in<float>(polygons, options); break;
    case Image_kernel::double_numbers: add_in<double>(polygons, options); break;
    case Image_kernel::exact: add_exactly(polygons, options); break;
  }
  left_out_ = polygons.size() - pieces_.size();
}

Painted_cones::Painted_cones(const Exact_view& view, const Visible_surface<Exact_view>& surface,
                             const Pixel_centres& centres, const Image_options& options)
    : cones_(centres, no_normal) {
  std::vector<std::span<const Exact_view::Ray>> parts;
  for (const auto& part : surface.parts) {
    if (part.piece == surface.nothing) continue;
    parts.push_back(surface.of(part));
    pieces_.push_back(part.piece);
  }
  const auto normal = [&view, parts](std::uint32_t cone, std::uint32_t edge) {
    return cross(view.direction(parts[cone][edge]), view.direction(next(parts[cone], edge)));
  };
  cones_ = all_cones(parts.size(), Pixel_cones(centres, normal), options, [&](Pixel_cones& to, std::size_t i) {
    std::vector<Approximate_vector> corners;
    for (const Exact_view::Ray& ray : parts[i]) corners.push_back(close_to(view, ray));
    if (!to.add(corners)) return;
    for (std::size_t k = 0; k < parts[i].size(); ++k)
      to.add_edge(Pixel_form(centres, approximately_through(parts[i][k], next(parts[i], k))));
  });
}

template <class Number>
Painted_cones::Painted_cones(const Number_view<Number>& view, const Visible_surface<Number_view<Number>>& surface,
                             const Pixel_centres& centres, const Image_options& options)
    : cones_(centres, no_normal) {
  const Pixel_view& pixels = centres.view();
  const Number_image<Number> numbers(pixels);
  std::array<double, 3> ahead = cross(pixels.right, pixels.up);
  if (dot(ahead, pixels.look) < 0) ahead = {-ahead[0], -ahead[1], -ahead[2]};
  for (const auto& part : surface.parts) {
    if (options.progress) options.progress(0, surface.parts.size());
    if (part.piece == surface.nothing) continue;
    // Rays that are none bound nothing, and so near the one before the normal is noise: one of the two stands for both.
    // Of fewer than three there is no inside.
    std::vector<Vector_of<Number>> rays;
    for (const auto& ray : surface.of(part))
      if (const Vector_of<Number> v = scaled<Number>(view.approximate(ray));
          !is_zero(v) && (rays.empty() || !are_close(rays.back(), v)))
        rays.push_back(v);
    while (rays.size() > 1 && are_close(rays.back(), rays.front())) rays.pop_back();
    // All of a surface in the field of an image is before the eye; rounded rays of slivers may point anywhere.
    const bool is_before = std::all_of(rays.begin(), rays.end(), [&](const Vector_of<Number>& v) {
      return dot(std::array{double(v[0]), double(v[1]), double(v[2])}, ahead) > 0;
    });
    // Each two consecutive rays turn around the inside.
    if (rays.size() < 3 || !is_before || !numbers.add(cones_, rays, Number_plane<Number>{{}, 1})) ++left_out_;
    else pieces_.push_back(part.piece);
  }
}
template Painted_cones::Painted_cones(const Number_view<float>&, const Visible_surface<Number_view<float>>&,
                                      const Pixel_centres&, const Image_options&);
template Painted_cones::Painted_cones(const Number_view<double>&, const Visible_surface<Number_view<double>>&,
                                      const Pixel_centres&, const Image_options&);

void Painted_cones::add_exactly(const std::vector<Painted_polygon>& polygons, const Image_options& options) {
  const Pixel_centres& centres = cones_.centres();
  std::vector<Exact_cone> exact(polygons.size());
  parallel_for(polygons.size(), [&](std::size_t i) {
    if (options.progress) options.progress(0, polygons.size());
    exact[i] = exact_cone(polygons[i], centres.view().eye);
  });
  std::erase_if(exact, [](const Exact_cone& cone) { return cone.normals.empty(); });
  for (Exact_cone& cone : exact) {
    pieces_.push_back(cone.piece);
    normals_.push_back(std::move(cone.normals));
  }
  const auto normal = [this](std::uint32_t cone, std::uint32_t edge) { return normals_[cone][edge]; };
  cones_ = all_cones(exact.size(), Pixel_cones(centres, normal), options, [&](Pixel_cones& to, std::size_t i) {
    std::vector<Approximate_vector> corners;
    for (const auto& corner : exact[i].corners) {
      const std::array<double, 3> v = approximated(corner).normal;
      corners.push_back({v[0], v[1], v[2]});
    }
    if (!to.add(corners)) return;
    for (const auto& n : normals_[i]) to.add_edge(Pixel_form(centres, approximated(n)));
  });
}

template <class Number>
void Painted_cones::add_in(const std::vector<Painted_polygon>& polygons, const Image_options& options) {
  const Number_image<Number> numbers(cones_.centres().view());
  for (const Painted_polygon& polygon : polygons) {
    if (options.progress) options.progress(0, polygons.size());
    std::vector<Vector_of<Number>> arms;
    for (const Exact_point& p : polygon.corners) arms.push_back(numbers.arm(p));
    if (const auto plane = numbers.plane(arms); plane && numbers.add(cones_, arms, *plane))
      pieces_.push_back(polygon.piece);
  }
}

}  // namespace sightline::image_detail
