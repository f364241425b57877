#include <sightline/algorithms/baseline/blended_depth.h>

#include <sightline/algorithms/baseline/rasterizer.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace sightline {

namespace {

void check_tints(const Scene& scene, const std::vector<Tint>& tints) {
  if (tints.size() < scene.pieces().size()) throw std::invalid_argument("there is a tint for each piece");
}

/// The least depth so far at each pixel, rounded to bits.
class Least_depth {
 public:
  Least_depth(std::size_t pixels, int bits) : least_(pixels, 2), steps_(std::ldexp(1.0, bits) - 1), bits_(bits) {}

  bool is_less(std::size_t at, float z) const { return stored(z) < least_[at]; }
  void set(std::size_t at, float z) { least_[at] = stored(z); }

 private:
  double stored(float z) const { return bits_ == 32 ? double{z} : std::round(double{z} * steps_) / steps_; }

  std::vector<double> least_;
  double steps_;
  int bits_;
};

}  // namespace

Blended_depth depth_blended(const Scene& scene, const Pixel_view& pixels, const std::vector<Tint>& tints,
                            const Depth_buffer_options& options) {
  check_tints(scene, tints);
  const depth_buffer_detail::Pinhole pinhole(scene, pixels, options);
  std::vector<Layer> layers(pinhole.pixels());
  Least_depth depths(pinhole.pixels(), options.bits);
  Blended_depth image{{}, pinhole.near(), pinhole.far()};
  image.not_finite = pinhole.draw(image.triangles, [&](std::size_t at, std::uint32_t piece, float z) {
    if (!depths.is_less(at, z)) return;
    depths.set(at, z);
    layers[at].put_before(tints[piece]);
  });
  image.layers = pinhole.from_above(layers);
  return image;
}

Blended_depth weighted_blended(const Scene& scene, const Pixel_view& pixels, const std::vector<Tint>& tints,
                               const Depth_buffer_options& options) {
  check_tints(scene, tints);
  const depth_buffer_detail::Pinhole pinhole(scene, pixels, options);
  std::vector<Layer> layers(pinhole.pixels());
  Least_depth depths(pinhole.pixels(), options.bits);
  Blended_depth image{{}, pinhole.near(), pinhole.far()};
  // 1. What hides all.
  image.not_finite = pinhole.draw(image.triangles, [&](std::size_t at, std::uint32_t piece, float z) {
    if (tints[piece].alpha < 1 || !depths.is_less(at, z)) return;
    depths.set(at, z);
    layers[at].put_before(tints[piece]);
  });
  // 2. What is before it: colours summed by weight, and what all let through together.
  struct Sum {
    Colour colour{};
    double weight = 0, through = 1;
  };
  std::vector<Sum> sums(pinhole.pixels());
  std::uint64_t again = 0;
  pinhole.draw(again, [&](std::size_t at, std::uint32_t piece, float z) {
    const Tint& tint = tints[piece];
    if (tint.alpha >= 1 || !depths.is_less(at, z)) return;
    const double weight = tint.alpha * std::max(1e-2, 3e3 * std::pow(1 - double{z}, 3));
    for (std::size_t k = 0; k < 3; ++k) sums[at].colour[k] += weight * tint.colour[k];
    sums[at].weight += weight;
    sums[at].through *= 1 - tint.alpha;
  });
  // 3. One over the other.
  for (std::size_t at = 0; at < sums.size(); ++at) {
    if (!(sums[at].weight > 0)) continue;
    Tint mean{sums[at].colour, 1 - sums[at].through};
    for (double& c : mean.colour) c /= sums[at].weight;
    layers[at].put_before(mean);
  }
  image.layers = pinhole.from_above(layers);
  return image;
}

}  // namespace sightline
