#pragma once
// Triangles in pixels as graphics hardware draws them, and what a pinhole image of a scene needs for that, in floats.

#include <sightline/algorithms/baseline/depth_buffer.h>
#include <sightline/kernel/scene/pixel_view.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sightline {

namespace depth_buffer_detail {

/// A corner in the coordinates of an image: right, up, forward.
struct Corner {
  float x, y, w;
};
/// A corner in the image: in 256ths of a pixel, and its depth, from 0 at the near plane to 1 at the far one and more
/// beyond.
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
  float near, far;
  std::uint64_t triangles = 0, clipped = 0;
};

/// put(pixel, piece, depth from 0 to 1) for each pixel that a piece covers.
template <class Put>
class Rasterizer {
 public:
  Rasterizer(Target& to, Put put)
      : to_(to), put_(put), scale_(to.far / (to.far - to.near)), shift_(-to.near * scale_) {}

  void draw(std::uint32_t piece, std::vector<Corner> polygon);

 private:
  static constexpr float guard = 16;

  void draw(std::uint32_t piece, const Pixel_corner& a, Pixel_corner b, Pixel_corner c);
  /// Positive to the left of the edge from p to q.
  static std::int64_t edge(const Pixel_corner& p, const Pixel_corner& q, std::int64_t x, std::int64_t y);
  static std::int64_t inclusive(const Pixel_corner& p, const Pixel_corner& q);

  Target& to_;
  Put put_;
  float scale_, shift_;  // depth of w: scale + shift / w
};

template <class Put>
void Rasterizer<Put>::draw(std::uint32_t piece, std::vector<Corner> polygon) {
  const auto all = [&](auto outside) { return std::all_of(polygon.begin(), polygon.end(), outside); };
  if (all([](const Corner& c) { return c.w <= 0; }) || all([](const Corner& c) { return c.x > c.w; }) ||
      all([](const Corner& c) { return -c.x > c.w; }) || all([](const Corner& c) { return c.y > c.w; }) ||
      all([](const Corner& c) { return -c.y > c.w; }))
    return;
  if (std::any_of(polygon.begin(), polygon.end(), [&](const Corner& c) { return c.w < to_.near; })) {
    ++to_.clipped;
    polygon = clipped(polygon, [&](const Corner& c) { return c.w - to_.near; });
    for (Corner& c : polygon) c.w = std::max(c.w, to_.near);  // floats may make it 0
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
      return static_cast<std::int64_t>(
          std::lround((std::clamp(v * inverse, -2 * guard, 2 * guard) * half + half) * 256));
    };
    corners.push_back({snapped(c.x, to_.width), snapped(c.y, to_.height), scale_ + shift_ * inverse});
  }
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) draw(piece, corners[0], corners[k], corners[k + 1]);
}

template <class Put>
void Rasterizer<Put>::draw(std::uint32_t piece, const Pixel_corner& a, Pixel_corner b, Pixel_corner c) {
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
      put_(static_cast<std::size_t>(y) * to_.width + static_cast<std::size_t>(x), piece, std::clamp(z, 0.0f, 1.0f));
    }
  }
}

template <class Put>
std::int64_t Rasterizer<Put>::edge(const Pixel_corner& p, const Pixel_corner& q, std::int64_t x, std::int64_t y) {
  return (q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x);
}

template <class Put>
std::int64_t Rasterizer<Put>::inclusive(const Pixel_corner& p, const Pixel_corner& q) {
  return q.y < p.y || (q.y == p.y && q.x < p.x) ? 0 : 1;
}

/// Draws all pieces, in coordinates of the image. Returns how many floats do not hold.
template <class To_image, class Put>
std::uint64_t draw(const Scene& scene, const std::vector<std::array<float, 3>>& arms, To_image to_image, Target& target,
                   Put put) {
  const auto is_finite = [](float x) { return std::fabs(x) < 0x1p120f; };  // and sixteen times that
  Rasterizer<Put> rasterizer(target, put);
  std::vector<Corner> polygon;
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

/// A scene before a pinhole camera, in floats.
class Pinhole {
 public:
  /// Errors: std::invalid_argument for no pixels, more than 16384 each way, directions that do not span the space, or
  /// planes that are not one behind the other.
  Pinhole(const Scene& scene, const Pixel_view& pixels, const Depth_buffer_options& options);

  float near() const { return near_; }
  float far() const { return far_; }
  std::size_t pixels() const { return std::size_t{view_.width} * view_.height; }
  /// put(pixel, piece, depth) for all that pieces cover, in their order. Pixels are counted from below. Returns how
  /// many pieces floats do not hold.
  template <class Put>
  std::uint64_t draw(std::uint64_t& triangles, Put put) const {
    if (!drawable_) return scene_.pieces().size();
    Target target{view_.width, view_.height, near_, far_};
    const std::uint64_t not_finite = depth_buffer_detail::draw(
        scene_, arms_, [&](const std::array<float, 3>& v) { return turned(v); }, target, put);
    triangles += target.triangles;
    return not_finite;
  }
  /// Of an image whose rows run from below the one whose rows run from above.
  template <class T>
  std::vector<T> from_above(const std::vector<T>& from_below) const {
    std::vector<T> image(from_below.size());
    for (std::uint32_t y = 0; y < view_.height; ++y)
      std::copy_n(from_below.begin() + static_cast<std::ptrdiff_t>(std::size_t{y} * view_.width), view_.width,
                  image.begin() + static_cast<std::ptrdiff_t>(std::size_t{view_.height - 1 - y} * view_.width));
    return image;
  }

 private:
  std::array<float, 3> turned(const std::array<float, 3>& v) const;

  const Scene& scene_;
  const Pixel_view& view_;
  std::vector<std::array<float, 3>> arms_;  // of points
  std::array<std::array<float, 3>, 3> to_image_{};
  float near_ = 0, far_ = 0;
  bool drawable_ = false;
};

}  // namespace depth_buffer_detail

}  // namespace sightline
