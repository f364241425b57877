#pragma once
// What a piece looks like in an image.

#include <array>
#include <cstddef>

namespace sightline {

/// Red, green and blue.
using Colour = std::array<double, 3>;

/// A colour, and how much it hides of what is behind it: 0 nothing, 1 all.
struct Tint {
  Colour colour{};
  double alpha = 1;
};

/// A colour times its opacity, and that opacity.
struct Layer {
  Colour colour{};
  double alpha = 0;

  /// With something behind it.
  void put_behind(const Tint& tint) {
    const double share = (1 - alpha) * tint.alpha;
    for (std::size_t k = 0; k < 3; ++k) colour[k] += share * tint.colour[k];
    alpha += share;
  }
  /// With something before it.
  void put_before(const Tint& tint) {
    for (std::size_t k = 0; k < 3; ++k) colour[k] = tint.alpha * tint.colour[k] + (1 - tint.alpha) * colour[k];
    alpha = tint.alpha + (1 - tint.alpha) * alpha;
  }
};

}  // namespace sightline
