#include <sightline/algorithms/baseline/depth_buffer.h>

#include <sightline/algorithms/baseline/rasterizer.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace sightline {

namespace {

float rounded(const Rational& x) { return static_cast<float>(nearest_double(x)); }

/// A depth as it is stored.
std::uint32_t stored(float z, int bits) {
  if (bits == 32) return std::bit_cast<std::uint32_t>(z);  // as unsigned numbers, floats from 0 on keep their order
  return static_cast<std::uint32_t>(std::lround(static_cast<double>(z) * ((std::uint64_t{1} << bits) - 1)));
}

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
    throw std::invalid_argument("a near plane at " + std::to_string(planes.near) + " and a far one at " +
                                std::to_string(planes.far) + ": both are in front of the eye, the far one farther");
  return planes;
}

/// What is drawn if its stored depth is less than what is there.
struct Nearer {
  std::uint32_t *pieces, *depths;
  int bits;

  void operator()(std::size_t at, std::uint32_t piece, float z) const {
    const std::uint32_t depth = stored(z, bits);
    if (pieces[at] != Depth_buffer::nothing && depth >= depths[at]) return;
    pieces[at] = piece;
    depths[at] = depth;
  }
};

/// The scene's points relative to the eye, in floats.
std::vector<std::array<float, 3>> arms_of(const Scene& scene, const std::array<float, 3>& from) {
  std::vector<std::array<float, 3>> arms;
  for (std::uint32_t p = 0; p < scene.points().size(); ++p) {
    const Exact_point at = scene.position(p);
    arms.push_back({rounded(at[0]) - from[0], rounded(at[1]) - from[1], rounded(at[2]) - from[2]});
  }
  return arms;
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
    depth_buffer_detail::Target target{options.size, options.size, planes.near, planes.far};
    const std::uint64_t not_finite = depth_buffer_detail::draw(
        scene, arms, [&](const std::array<float, 3>& v) { return cube_sides[side].turned(v); }, target,
        Nearer{&buffer.pieces[first], &buffer.depths[first], options.bits});
    if (side == 0) buffer.not_finite = not_finite;
    buffer.triangles += target.triangles;
    buffer.clipped += target.clipped;
  }
  return buffer;
}

namespace depth_buffer_detail {

Pinhole::Pinhole(const Scene& scene, const Pixel_view& pixels, const Depth_buffer_options& options)
    : scene_(scene), view_(pixels) {
  check(options);
  if (pixels.width < 1 || pixels.height < 1 || pixels.width > 16384 || pixels.height > 16384)
    throw std::invalid_argument("a depth buffer has 1 to 16384 pixels each way");
  if (scene.pieces().empty()) return;
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
  to_image_ = {row(across), row(upwards), row(forth)};
  arms_ = arms_of(scene, {rounded(pixels.eye[0]), rounded(pixels.eye[1]), rounded(pixels.eye[2])});
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (const std::array<float, 3>& arm : arms_) {
    const double depth = turned(arm)[2];
    nearest = std::min(nearest, depth);
    farthest = std::max(farthest, depth);
  }
  const Planes planes = planes_of(options, nearest, farthest);
  near_ = planes.near;
  far_ = planes.far;
  drawable_ = planes.drawable;
}

std::array<float, 3> Pinhole::turned(const std::array<float, 3>& v) const {
  return {dot(to_image_[0], v), dot(to_image_[1], v), dot(to_image_[2], v)};
}

}  // namespace depth_buffer_detail

Depth_image depth_image(const Scene& scene, const Pixel_view& pixels, const Depth_buffer_options& options) {
  const depth_buffer_detail::Pinhole pinhole(scene, pixels, options);
  std::vector<std::uint32_t> pieces(pinhole.pixels(), Piece_image::nothing), depths(pinhole.pixels(), ~0u);
  Depth_image image{{pixels.width, pixels.height, {}, {}, {}}, pinhole.near(), pinhole.far()};
  image.not_finite = pinhole.draw(image.image.counters.drawn, Nearer{pieces.data(), depths.data(), options.bits});
  image.image.pieces = pinhole.from_above(pieces);
  return image;
}

}  // namespace sightline
