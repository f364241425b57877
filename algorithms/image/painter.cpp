#include <sightline/algorithms/image/painter.h>

#include <sightline/algorithms/image/bands.h>
#include <sightline/algorithms/image/number_cones.h>
#include <sightline/algorithms/image/pixel_cones.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>

namespace sightline {

namespace image_detail {

namespace {

/// A vector in doubles, as in Approximate_eye_plane; scaled, so that it is in their range.
Approximate_eye_plane approximated(const std::array<Integer, 3>& n) {
  const long bits = static_cast<long>(std::max({bit_length(n[0]), bit_length(n[1]), bit_length(n[2])}));
  const auto scaled = [&](const Integer& x) {
    long exponent = 0;
    const double mantissa = mpz_get_d_2exp(&exponent, x.get_mpz_t());
    return std::ldexp(mantissa, static_cast<int>(std::max(exponent - bits, -5000L)));
  };
  const std::array<double, 3> v{scaled(n[0]), scaled(n[1]), scaled(n[2])};
  const double size = (std::fabs(v[0]) + std::fabs(v[1]) + std::fabs(v[2])) * (1 + 0x1p-50);
  return {v, size, 0x1p-52 * size + 0x1p-1060};
}
/// The integers of the same direction.
std::array<Integer, 3> integers(const Exact_point& v) {
  const Integer divisor = lcm(lcm(v[0].get_den(), v[1].get_den()), v[2].get_den());
  return {Rational(v[0] * divisor).get_num(), Rational(v[1] * divisor).get_num(), Rational(v[2] * divisor).get_num()};
}

/// What shows if cones are painted in their order.
Piece_image painted(const Pixel_cones& cones, const std::vector<std::uint32_t>& pieces, const Image_options& options) {
  const Pixel_view& pixels = cones.centres().view();
  Piece_image image{pixels.width, pixels.height, {}, {}, {}};
  image.pieces.assign(std::size_t{pixels.width} * pixels.height, Piece_image::nothing);
  image.counters = draw_bands(bands_of(cones), options, [&](const Band& band, Image_counters& counters) {
    for (const std::uint32_t cone : band.cones)
      for (std::int64_t y = std::max<std::int64_t>(band.top, cones[cone].top);
           y < std::min<std::int64_t>(band.bottom, cones[cone].bottom); ++y)
        cones.row(cone, y, counters, [&](std::int64_t x, bool) {
          image.pieces[image.pixel(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))] = pieces[cone];
        });
  });
  image.counters.drawn = cones.size();
  return image;
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
    cone.corners.push_back(integers(arms.back()));
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

Piece_image paint_exactly(const std::vector<Painted_polygon>& polygons, const Pixel_centres& centres,
                          const Image_options& options) {
  std::vector<Exact_cone> exact(polygons.size());
  parallel_for(polygons.size(), [&](std::size_t i) { exact[i] = exact_cone(polygons[i], centres.view().eye); });
  std::erase_if(exact, [](const Exact_cone& cone) { return cone.normals.empty(); });
  std::vector<std::uint32_t> pieces;
  for (const Exact_cone& cone : exact) pieces.push_back(cone.piece);
  const auto normal = [&](std::uint32_t cone, std::uint32_t edge) { return exact[cone].normals[edge]; };
  const Pixel_cones cones = all_cones(exact.size(), Pixel_cones(centres, normal), [&](Pixel_cones& to, std::size_t i) {
    std::vector<Approximate_vector> corners;
    for (const auto& corner : exact[i].corners) {
      const std::array<double, 3> v = approximated(corner).normal;
      corners.push_back({v[0], v[1], v[2]});
    }
    to.add(corners);
    for (const auto& n : exact[i].normals) to.add_edge(Pixel_form(centres, approximated(n)));
  });
  Piece_image image = painted(cones, pieces, options);
  image.counters.edge_on = polygons.size() - exact.size();
  return image;
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

Piece_image paint_parts(const Exact_view& view, const Visible_surface<Exact_view>& surface,
                        const Pixel_centres& centres, const Image_options& options) {
  std::vector<std::span<const Exact_view::Ray>> parts;
  std::vector<std::uint32_t> pieces;
  for (const auto& part : surface.parts) {
    if (part.piece == surface.nothing) continue;
    parts.push_back(surface.of(part));
    pieces.push_back(part.piece);
  }
  const auto next = [](std::span<const Exact_view::Ray> rays, std::size_t k) -> const Exact_view::Ray& {
    return rays[k + 1 == rays.size() ? 0 : k + 1];
  };
  const auto normal = [&](std::uint32_t cone, std::uint32_t edge) {
    return cross(view.direction(parts[cone][edge]), view.direction(next(parts[cone], edge)));
  };
  const Pixel_cones cones = all_cones(parts.size(), Pixel_cones(centres, normal), [&](Pixel_cones& to, std::size_t i) {
    std::vector<Approximate_vector> corners;
    for (const Exact_view::Ray& ray : parts[i]) corners.push_back(close_to(view, ray));
    to.add(corners);
    for (std::size_t k = 0; k < parts[i].size(); ++k)
      to.add_edge(Pixel_form(centres, approximately_through(parts[i][k], next(parts[i], k))));
  });
  return painted(cones, pieces, options);
}

template <class Number>
Piece_image paint_in(const std::vector<Painted_polygon>& polygons, const Pixel_centres& centres,
                     const Image_options& options) {
  const Number_image<Number> numbers(centres.view());
  Pixel_cones cones(centres, no_normal);
  std::vector<std::uint32_t> pieces;
  for (const Painted_polygon& polygon : polygons) {
    std::vector<Vector_of<Number>> arms;
    for (const Exact_point& p : polygon.corners) arms.push_back(numbers.arm(p));
    if (const auto plane = numbers.plane(arms); plane && numbers.add(cones, arms, *plane))
      pieces.push_back(polygon.piece);
  }
  Piece_image image = painted(cones, pieces, options);
  image.counters.edge_on = polygons.size() - pieces.size();
  return image;
}

/// Pieces farthest first.
template <class Number>
std::vector<std::uint32_t> sorted(const Scene& scene, const Pixel_view& pixels, Painter_key key) {
  const Vector_of<Number> eye = rounded<Number>(pixels.eye), look = converted<Number>(pixels.look);
  std::vector<Number> depths;
  for (std::uint32_t p = 0; p < scene.points().size(); ++p)
    depths.push_back(dot(minus(rounded<Number>(scene.position(p)), eye), look));
  std::vector<Number> keys;
  for (const Piece& piece : scene.pieces()) {
    const std::span<const Piece_corner> corners = scene.corners(piece);
    Number least = depths[corners[0].point], most = least, sum = 0;
    for (const Piece_corner& corner : corners) {
      const Number& depth = depths[corner.point];
      if (depth < least) least = depth;
      if (depth > most) most = depth;
      sum += depth;
    }
    sum /= Number(static_cast<unsigned>(corners.size()));
    keys.push_back(key == Painter_key::nearest ? least : key == Painter_key::farthest ? most : sum);
  }
  std::vector<std::uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] > keys[b]; });
  return order;
}

std::vector<std::uint32_t> sorted(const Scene& scene, const Pixel_view& pixels, Painter_key key, Image_kernel kernel) {
  switch (kernel) {
    case Image_kernel::float_numbers: return sorted<float>(scene, pixels, key);
    case Image_kernel::double_numbers: return sorted<double>(scene, pixels, key);
    case Image_kernel::exact: break;
  }
  return sorted<Rational>(scene, pixels, key);
}

}  // namespace

}  // namespace image_detail

Piece_image paint(const std::vector<Painted_polygon>& polygons, const Pixel_view& pixels, Image_kernel kernel,
                  const Image_options& options) {
  using namespace image_detail;
  const Pixel_centres centres(pixels);
  Piece_image image;
  run_with_threads(options.threads, [&] {
    image = kernel == Image_kernel::float_numbers    ? paint_in<float>(polygons, centres, options)
            : kernel == Image_kernel::double_numbers ? paint_in<double>(polygons, centres, options)
                                                     : paint_exactly(polygons, centres, options);
  });
  return image;
}

Piece_image paint(const Exact_view& view, const Visible_surface<Exact_view>& surface, const Pixel_view& pixels,
                  const Image_options& options) {
  const image_detail::Pixel_centres centres(pixels);
  Piece_image image;
  run_with_threads(options.threads, [&] { image = image_detail::paint_parts(view, surface, centres, options); });
  return image;
}

Piece_image heedless_painter(const Scene& scene, const Pixel_view& pixels, Painter_key key, Image_kernel kernel,
                             const Image_options& options) {
  std::vector<Painted_polygon> polygons;
  for (const std::uint32_t i : image_detail::sorted(scene, pixels, key, kernel)) {
    Painted_polygon& polygon = polygons.emplace_back(Painted_polygon{i, {}});
    for (const Piece_corner& corner : scene.corners(scene.pieces()[i]))
      polygon.corners.push_back(scene.position(corner.point));
  }
  return paint(polygons, pixels, kernel, options);
}

}  // namespace sightline
