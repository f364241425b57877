#pragma once
// A pinhole image: where it is seen from, and the directions of its pixels.

#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstdint>

namespace sightline {

/// A pinhole image. Pixel (x, y), 0-based from the top left, looks in the direction look + (2 (x + 1/2) / width - 1)
/// right + (1 - 2 (y + 1/2) / height) up; so a point of the image's plane is look + across right + upwards up, and what
/// it shows is -1 to 1 both ways.
struct Pixel_view {
  Exact_point eye;
  std::array<double, 3> look{}, right{}, up{};
  std::uint32_t width = 0, height = 0;

  /// The direction of a pixel's centre, rounded to doubles.
  std::array<double, 3> ray(std::uint32_t x, std::uint32_t y) const;
  /// The same exactly. Pre: the directions are finite.
  Exact_point centre(std::uint32_t x, std::uint32_t y) const;
  /// The direction of a point of the image's plane. Pre: finite. Exact: yes.
  Exact_point direction(const Rational& across, const Rational& upwards) const;
};

}  // namespace sightline
