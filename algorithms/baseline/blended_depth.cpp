#include <sightline/algorithms/baseline/blended_depth.h>

#include <sightline/algorithms/baseline/rasterizer.h>
#include <sightline/algorithms/image/blend.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sightline {

namespace {

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

/// An image in the making.
struct Drawing {
  const depth_buffer_detail::Pinhole pinhole;
  const std::vector<Tint>& tints;
  std::vector<Layer> layers;
  Least_depth depths;

  /// Errors: as depth_blended().
  Drawing(const Scene& scene, const Pixel_view& pixels, const std::vector<Tint>& its,
          const Depth_buffer_options& options)
      : pinhole(scene, pixels, options), tints(its), layers(pinhole.pixels()), depths(pinhole.pixels(), options.bits) {
    image_detail::check_tints(tints, scene.pieces().size());
  }

  /// Those of an opacity or more, in the scene's order, each over what is there where it is nearer than all so far.
  Blended_depth draw(double least_alpha) {
    Blended_depth image{{}, pinhole.near(), pinhole.far()};
    image.not_finite = pinhole.draw(image.triangles, [&](std::size_t at, std::uint32_t piece, float z) {
      if (tints[piece].alpha < least_alpha || !depths.is_less(at, z)) return;
      depths.set(at, z);
      layers[at].put_before(tints[piece]);
    });
    return image;
  }
};

}  // namespace

Blended_depth depth_blended(const Scene& scene, const Pixel_view& pixels, const std::vector<Tint>& tints,
                            const Depth_buffer_options& options) {
  Drawing drawing(scene, pixels, tints, options);
  Blended_depth image = drawing.draw(0);
  image.layers = drawing.pinhole.from_above(drawing.layers);
  return image;
}

Blended_depth weighted_blended(const Scene& scene, const Pixel_view& pixels, const std::vector<Tint>& tints,
                               const Depth_buffer_options& options) {
  // 1. What hides all.
  Drawing drawing(scene, pixels, tints, options);
  Blended_depth image = drawing.draw(1);
  // 2. What is before it: colours summed by weight, and what all let through together.
  struct Sum {
    Colour colour{};
    double weight = 0, through = 1;
  };
  std::vector<Sum> sums(drawing.layers.size());
  std::uint64_t again = 0;
  drawing.pinhole.draw(again, [&](std::size_t at, std::uint32_t piece, float z) {
    const Tint& tint = tints[piece];
    if (tint.alpha >= 1 || !drawing.depths.is_less(at, z)) return;
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
    drawing.layers[at].put_before(mean);
  }
  image.layers = drawing.pinhole.from_above(drawing.layers);
  return image;
}

}  // namespace sightline
