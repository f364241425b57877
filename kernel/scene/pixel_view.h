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

  /// Whether doubles tell where directions are in the image: its own are between 2^-100 and 2^100 long, so that no
  /// product of a few of their coordinates is too large or too small; not nearly in a plane; and do not have so many
  /// pixels in so small a field that a place may be off by as much as one. Proof: P-40
  bool has_places_in_doubles() const;
  /// The direction of a pixel's centre, rounded to doubles.
  std::array<double, 3> ray(std::uint32_t x, std::uint32_t y) const;
  /// The same exactly. Pre: the directions are finite.
  Exact_point centre(std::uint32_t x, std::uint32_t y) const;
  /// The direction of a point of the image's plane. Pre: finite. Exact: yes.
  Exact_point direction(const Rational& across, const Rational& upwards) const;
};

/// Where directions are in an image: of each what direction() is given. Pre: finite directions that span the space.
class Image_places {
 public:
  explicit Image_places(const Pixel_view& pixels);

  /// Across and upwards, each the nearest double. Pre: the direction is not along the image's plane.
  std::array<double, 2> operator()(const std::array<Integer, 3>& direction) const;

 private:
  Exact_point to_right_, to_up_, to_look_;
};

}  // namespace sightline
