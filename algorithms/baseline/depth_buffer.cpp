#include <sightline/algorithms/baseline/depth_buffer.h>

#include <sightline/kernel/number.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace sightline {

namespace depth_buffer_detail {

/// A corner in the coordinates of an image: right, up, forward.
struct Corner {
  float x, y, w;
};
/// A corner in the image: in 256ths of a pixel, and its depth in [0, 1].
struct Pixel_corner {
  std::int64_t x, y;
  float z;
};

/// The part of a convex polygon where a linear form is not negative.
template <class Form>
std::vector<Corner> clipped(const std::vector<Corner>& polygon, Form form) {
  std::vector<Corner> part;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Corner &p = polygon[k], &q = polygon[k + 1 == polygon.size() ? 0 : k + 1];
    const float a = form(p), b = form(q);
    if (a >= 0) part.push_back(p);
    if ((a >= 0) == (b >= 0)) continue;
    const float t = a / (a - b);
    part.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), p.w + t * (q.w - p.w)});
  }
  return part;
}

/// An image that pieces are drawn into, row by row from below.
struct Target {
  std::uint32_t width, height;
  int bits;
  float near, far;
  std::uint32_t *pieces, *depths;
  std::uint64_t triangles = 0, clipped = 0;
};

class Rasterizer {
 public:
  explicit Rasterizer(Target& to) : to_(to), scale_(to.far / (to.far - to.near)), shift_(-to.near * scale_) {}

  void draw(std::uint32_t piece, std::vector<Corner> polygon);

 private:
  static constexpr float guard = 16;

  void draw(std::uint32_t piece, const Pixel_corner& a, Pixel_corner b, Pixel_corner c);
  /// Positive to the left of the edge from p to q.
  static std::int64_t edge(const Pixel_corner& p, const Pixel_corner& q, std::int64_t x, std::int64_t y);
  static std::int64_t inclusive(const Pixel_corner& p, const Pixel_corner& q);
  std::uint32_t stored(float z) const;

  Target& to_;
  float scale_, shift_;  // depth of w: scale + shift / w
};

void Rasterizer::draw(std::uint32_t piece, std::vector<Corner> polygon) {
  const auto all = [&](auto outside) { return std::all_of(polygon.begin(), polygon.end(), outside); };
  if (all([](const Corner& c) { return c.w <= 0; }) || all([](const Corner& c) { return c.x > c.w; }) ||
      all([](const Corner& c) { return -c.x > c.w; }) || all([](const Corner& c) { return c.y > c.w; }) ||
      all([](const Corner& c) { return -c.y > c.w; }))
    return;
  if (std::any_of(polygon.begin(), polygon.end(), [&](const Corner& c) { return c.w < to_.near; })) {
    ++to_.clipped;
    polygon = clipped(polygon, [&](const Corner& c) { return c.w - to_.near; });
  }
  // A guard band of 16 images' widths keeps coordinates in the image small; what is between it and the image is not
  // drawn anyway.
  const auto beyond = [](const Corner& c) { return std::fabs(c.x) > guard * c.w || std::fabs(c.y) > guard * c.w; };
  if (std::any_of(polygon.begin(), polygon.end(), beyond)) {
    polygon = clipped(polygon, [](const Corner& c) { return guard * c.w - c.x; });
    polygon = clipped(polygon, [](const Corner& c) { return guard * c.w + c.x; });
    polygon = clipped(polygon, [](const Corner& c) { return guard * c.w - c.y; });
    polygon = clipped(polygon, [](const Corner& c) { return guard * c.w + c.y; });
  }
  if (polygon.size() < 3) return;
  std::vector<Pixel_corner> corners;
  for (const Corner& c : polygon) {
    const float inverse = 1 / c.w;
    const auto snapped = [&](float v, std::uint32_t size) {
      const float half = static_cast<float>(size) / 2;
      return static_cast<std::int64_t>(std::lround((v * inverse * half + half) * 256));
    };
    corners.push_back(
        {snapped(c.x, to_.width), snapped(c.y, to_.height), std::clamp(scale_ + shift_ * inverse, 0.0f, 1.0f)});
  }
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) draw(piece, corners[0], corners[k], corners[k + 1]);
}

void Rasterizer::draw(std::uint32_t piece, const Pixel_corner& a, Pixel_corner b, Pixel_corner c) {
  std::int64_t area = edge(a, b, c.x, c.y);
  if (area == 0) return;
  if (area < 0) {
    std::swap(b, c);
    area = -area;
  }
  // Pixels whose centres, at 128 of 256, are in the triangle's box.
  const auto first = [](std::int64_t v) { return std::max<std::int64_t>(0, (v + 127) >> 8); };
  const auto last = [](std::int64_t v, std::uint32_t size) {
    return std::min<std::int64_t>(std::int64_t{size} - 1, (v - 128) >> 8);
  };
  const std::int64_t x0 = first(std::min({a.x, b.x, c.x})), x1 = last(std::max({a.x, b.x, c.x}), to_.width);
  const std::int64_t y0 = first(std::min({a.y, b.y, c.y})), y1 = last(std::max({a.y, b.y, c.y}), to_.height);
  if (x0 > x1 || y0 > y1) return;
  ++to_.triangles;
  // A centre on an edge is inside where the edge is a left or a top one, so that triangles that share it share no
  // pixel.
  const std::int64_t at_a = inclusive(b, c), at_b = inclusive(c, a), at_c = inclusive(a, b);
  const float inverse = 1 / static_cast<float>(area);
  for (std::int64_t y = y0; y <= y1; ++y) {
    const std::int64_t px = x0 * 256 + 128, py = y * 256 + 128;
    std::int64_t e_a = edge(b, c, px, py), e_b = edge(c, a, px, py), e_c = edge(a, b, px, py);
    for (std::int64_t x = x0; x <= x1;
         ++x, e_a -= 256 * (c.y - b.y), e_b -= 256 * (a.y - c.y), e_c -= 256 * (b.y - a.y)) {
      if (e_a < at_a || e_b < at_b || e_c < at_c) continue;
      const float z =
          a.z + static_cast<float>(e_b) * inverse * (b.z - a.z) + static_cast<float>(e_c) * inverse * (c.z - a.z);
      const std::uint32_t depth = stored(std::clamp(z, 0.0f, 1.0f));
      const std::size_t at = static_cast<std::size_t>(y) * to_.width + static_cast<std::size_t>(x);
      if (to_.pieces[at] != Depth_buffer::nothing && depth >= to_.depths[at]) continue;
      to_.pieces[at] = piece;
      to_.depths[at] = depth;
    }
  }
}

std::int64_t Rasterizer::edge(const Pixel_corner& p, const Pixel_corner& q, std::int64_t x, std::int64_t y) {
  return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
}

std::int64_t Rasterizer::inclusive(const Pixel_corner& p, const Pixel_corner& q) {
  return q.y < p.y || (q.y == p.y && q.x < p.x) ? 0 : 1;
}

std::uint32_t Rasterizer::stored(float z) const {
  if (to_.bits == 32) return std::bit_cast<std::uint32_t>(z);  // as unsigned numbers, floats from 0 on keep their order
  return static_cast<std::uint32_t>(std::lround(static_cast<double>(z) * ((std::uint64_t{1} << to_.bits) - 1)));
}

}  // namespace depth_buffer_detail

namespace {

float rounded(const Rational& x) { return static_cast<float>(nearest_double(x)); }

void check(const Depth_buffer_options& options) {
  if (options.bits < 1 || options.bits > 32) throw std::invalid_argument("a depth buffer has 1 to 32 bits");
}

struct Planes {
  float near = 0, far = 0;
  bool drawable = false;
};

/// Where the clipping planes are, by the least and largest distance at which a point may be in an image.
Planes planes_of(const Depth_buffer_options& options, double nearest, double farthest) {
  Planes planes{options.near, options.far, false};
  if (options.far == 0) planes.far = static_cast<float>(farthest * 1.0625);
  if (options.near == 0) planes.near = std::max(static_cast<float>(nearest * 0.9375), planes.far / 4096);
  planes.drawable =
      planes.near > 0 && planes.far > planes.near && std::isfinite(planes.far) && std::isfinite(1 / planes.near);
  if (!planes.drawable && (options.near != 0 || options.far != 0))
    throw std::invalid_argument("a near plane is in front of the eye, and a far one behind it");
  return planes;
}

/// The scene's points relative to the eye, in floats.
std::vector<std::array<float, 3>> arms_of(const Scene& scene, const std::array<float, 3>& from) {
  std::vector<std::array<float, 3>> arms;
  for (std::uint32_t p = 0; p < scene.points().size(); ++p) {
    const Exact_point at = scene.position(p);
    arms.push_back({rounded(at[0]) - from[0], rounded(at[1]) - from[1], rounded(at[2]) - from[2]});
  }
  return arms;
}

/// Draws all pieces, in coordinates of the image. Returns how many floats do not hold.
template <class To_image>
std::uint64_t draw(const Scene& scene, const std::vector<std::array<float, 3>>& arms, To_image to_image,
                   depth_buffer_detail::Target& target) {
  const auto is_finite = [](float x) { return std::fabs(x) < 0x1p120f; };  // and sixteen times that
  depth_buffer_detail::Rasterizer rasterizer(target);
  std::vector<depth_buffer_detail::Corner> polygon;
  std::uint64_t not_finite = 0;
  for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece) {
    polygon.clear();
    bool finite = true;
    for (const Piece_corner& corner : scene.corners(scene.pieces()[piece])) {
      const std::array<float, 3> p = to_image(arms[corner.point]);
      finite = finite && is_finite(p[0]) && is_finite(p[1]) && is_finite(p[2]);
      polygon.push_back({p[0], p[1], p[2]});
    }
    if (finite) rasterizer.draw(piece, polygon);
    else ++not_finite;
  }
  return not_finite;
}

}  // namespace

Depth_buffer depth_buffer(const Scene& scene, const Exact_point& eye, const Depth_buffer_options& options) {
  check(options);
  if (options.size < 1 || options.size > 16384)
    throw std::invalid_argument("a depth buffer has 1 to 16384 pixels a side");
  Depth_buffer buffer;
  buffer.size = options.size;
  buffer.bits = options.bits;
  buffer.near = options.near;
  buffer.far = options.far;
  const std::size_t pixels = 6 * std::size_t{options.size} * options.size;
  buffer.pieces.assign(pixels, Depth_buffer::nothing);
  buffer.depths.assign(pixels, ~std::uint32_t{0});
  if (scene.pieces().empty()) return buffer;

  // Along an image's forward axis, nothing that it shows is nearer or farther than the box in the largest of three
  // coordinates.
  double nearest = 0, farthest = 0;
  const std::array<Exact_point, 2> box = scene.box();
  for (std::size_t k = 0; k < 3; ++k) {
    const double low = nearest_double(Rational(box[0][k] - eye[k])),
                 high = nearest_double(Rational(box[1][k] - eye[k]));
    nearest = std::max({nearest, low, -high});
    farthest = std::max({farthest, -low, high});
  }
  const Planes planes = planes_of(options, nearest, farthest);
  buffer.near = planes.near;
  buffer.far = planes.far;
  const std::array<float, 3> from{rounded(eye[0]), rounded(eye[1]), rounded(eye[2])};
  if (!planes.drawable || !std::all_of(from.begin(), from.end(), [](float x) { return std::isfinite(x); })) {
    buffer.not_finite = scene.pieces().size();
    return buffer;
  }
  const std::vector<std::array<float, 3>> arms = arms_of(scene, from);
  for (std::size_t side = 0; side < cube_sides.size(); ++side) {
    const std::size_t first = buffer.pixel(side, 0, 0);
    depth_buffer_detail::Target target{options.size, options.size,          options.bits,         planes.near,
                                       planes.far,   &buffer.pieces[first], &buffer.depths[first]};
    const std::uint64_t not_finite = draw(
        scene, arms, [&](const std::array<float, 3>& v) { return cube_sides[side].turned(v); }, target);
    if (side == 0) buffer.not_finite = not_finite;
    buffer.triangles += target.triangles;
    buffer.clipped += target.clipped;
  }
  return buffer;
}

Depth_image depth_image(const Scene& scene, const Pixel_view& pixels, const Depth_buffer_options& options) {
  check(options);
  if (pixels.width < 1 || pixels.height < 1 || pixels.width > 16384 || pixels.height > 16384)
    throw std::invalid_argument("a depth buffer has 1 to 16384 pixels each way");
  Depth_image image;
  image.image.width = pixels.width;
  image.image.height = pixels.height;
  const std::size_t count = std::size_t{pixels.width} * pixels.height;
  image.image.pieces.assign(count, Piece_image::nothing);
  if (scene.pieces().empty()) return image;

  // A point is z (look + across right + upwards up) from the eye.
  const std::array<double, 3> forth = cross(pixels.right, pixels.up), across = cross(pixels.up, pixels.look),
                              upwards = cross(pixels.look, pixels.right);
  const double volume = dot(pixels.look, forth);
  if (!(std::fabs(volume) > 0) || !std::isfinite(volume))
    throw std::invalid_argument("the directions of an image span the space");
  const auto row = [&](const std::array<double, 3>& v) {
    return std::array<float, 3>{static_cast<float>(v[0] / volume), static_cast<float>(v[1] / volume),
                                static_cast<float>(v[2] / volume)};
  };
  const std::array<std::array<float, 3>, 3> to_image{row(across), row(upwards), row(forth)};
  const auto turned = [&](const std::array<float, 3>& v) {
    return std::array<float, 3>{dot(to_image[0], v), dot(to_image[1], v), dot(to_image[2], v)};
  };
  const std::array<float, 3> from{rounded(pixels.eye[0]), rounded(pixels.eye[1]), rounded(pixels.eye[2])};
  const std::vector<std::array<float, 3>> arms = arms_of(scene, from);
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (const std::array<float, 3>& arm : arms) {
    const double depth = turned(arm)[2];
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  const Planes planes = planes_of(options, nearest, farthest);
  image.near = planes.near;
  image.far = planes.far;
  if (!planes.drawable) {
    image.not_finite = scene.pieces().size();
    return image;
  }
  std::vector<std::uint32_t> pieces(count, Piece_image::nothing), depths(count, ~std::uint32_t{0});
  depth_buffer_detail::Target target{pixels.width, pixels.height, options.bits, planes.near,
                                     planes.far,   pieces.data(), depths.data()};
  image.not_finite = draw(scene, arms, turned, target);
  image.image.counters.drawn = target.triangles;
  for (std::uint32_t y = 0; y < pixels.height; ++y)  // whose rows run from above
    std::copy_n(&pieces[std::size_t{y} * pixels.width], pixels.width,
                &image.image.pieces[image.image.pixel(0, pixels.height - 1 - y)]);
  return image;
}

}  // namespace sightline
