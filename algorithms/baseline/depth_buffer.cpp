#include <sightline/algorithms/baseline/depth_buffer.h>

#include <sightline/kernel/number.h>

#include <algorithm>
#include <bit>
#include <cmath>
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

class Rasterizer {
 public:
  Rasterizer(Depth_buffer& to, std::size_t side)
      : to_(to), side_(side), scale_(to.far / (to.far - to.near)), shift_(-to.near * scale_) {}

  void draw(std::uint32_t piece, std::vector<Corner> polygon);

 private:
  static constexpr float guard = 16;

  void draw(std::uint32_t piece, const Pixel_corner& a, Pixel_corner b, Pixel_corner c);
  /// Positive to the left of the edge from p to q.
  static std::int64_t edge(const Pixel_corner& p, const Pixel_corner& q, std::int64_t x, std::int64_t y);
  static std::int64_t inclusive(const Pixel_corner& p, const Pixel_corner& q);
  std::uint32_t stored(float z) const;

  Depth_buffer& to_;
  std::size_t side_;
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
    const float inverse = 1 / c.w, half = static_cast<float>(to_.size) / 2;
    const auto snapped = [&](float v) {
      return static_cast<std::int64_t>(std::lround((v * inverse * half + half) * 256));
    };
    corners.push_back({snapped(c.x), snapped(c.y), std::clamp(scale_ + shift_ * inverse, 0.0f, 1.0f)});
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
  const auto last = [&](std::int64_t v) { return std::min<std::int64_t>(to_.size - 1, (v - 128) >> 8); };
  const std::int64_t x0 = first(std::min({a.x, b.x, c.x})), x1 = last(std::max({a.x, b.x, c.x}));
  const std::int64_t y0 = first(std::min({a.y, b.y, c.y})), y1 = last(std::max({a.y, b.y, c.y}));
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
      const std::size_t at = to_.pixel(side_, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
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

Depth_buffer depth_buffer(const Scene& scene, const Exact_point& eye, const Depth_buffer_options& options) {
  if (options.size < 1 || options.size > 16384 || options.bits < 1 || options.bits > 32)
    throw std::invalid_argument("a depth buffer has 1 to 16384 pixels a side and 1 to 32 bits");
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
  const auto rounded = [](const Rational& x) { return static_cast<float>(nearest_double(x)); };
  double nearest = 0, farthest = 0;
  const std::array<Exact_point, 2> box = scene.box();
  for (std::size_t k = 0; k < 3; ++k) {
    const double low = nearest_double(Rational(box[0][k] - eye[k])),
                 high = nearest_double(Rational(box[1][k] - eye[k]));
    nearest = std::max({nearest, low, -high});
    farthest = std::max({farthest, -low, high});
  }
  if (options.far == 0) buffer.far = static_cast<float>(farthest * 1.0625);
  if (options.near == 0) buffer.near = std::max(static_cast<float>(nearest * 0.9375), buffer.far / 4096);
  const bool drawable =
      buffer.near > 0 && buffer.far > buffer.near && std::isfinite(buffer.far) && std::isfinite(1 / buffer.near);
  if (!drawable && (options.near != 0 || options.far != 0))
    throw std::invalid_argument("a near plane is in front of the eye, and a far one behind it");
  const std::array<float, 3> from{rounded(eye[0]), rounded(eye[1]), rounded(eye[2])};
  if (!drawable || !std::all_of(from.begin(), from.end(), [](float x) { return std::isfinite(x); })) {
    buffer.not_finite = scene.pieces().size();
    return buffer;
  }

  std::vector<std::array<float, 3>> points;
  for (std::uint32_t p = 0; p < scene.points().size(); ++p) {
    const Exact_point at = scene.position(p);
    points.push_back({rounded(at[0]) - from[0], rounded(at[1]) - from[1], rounded(at[2]) - from[2]});
  }
  const auto is_finite = [](float x) { return std::fabs(x) < 0x1p120f; };  // and sixteen times that
  std::vector<depth_buffer_detail::Corner> polygon;
  for (std::size_t side = 0; side < cube_sides.size(); ++side) {
    depth_buffer_detail::Rasterizer rasterizer(buffer, side);
    for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece) {
      polygon.clear();
      bool finite = true;
      for (const Piece_corner& corner : scene.corners(scene.pieces()[piece])) {
        const std::array<float, 3> p = cube_sides[side].turned(points[corner.point]);
        finite = finite && is_finite(p[0]) && is_finite(p[1]) && is_finite(p[2]);
        polygon.push_back({p[0], p[1], p[2]});
      }
      if (finite) rasterizer.draw(piece, polygon);
      else if (side == 0) ++buffer.not_finite;
    }
  }
  return buffer;
}

}  // namespace sightline
