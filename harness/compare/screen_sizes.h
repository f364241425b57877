#pragma once
// How large faces look: solid angles in pixels, and how many of some faces are of which size.

#include <sightline/sightline.h>

#include <array>
#include <cstddef>
#include <map>

namespace sightline {

/// The solid angle of a pixel at the middle of a picture of 1024 x 1024 pixels that is 90 degrees wide: it is a square
/// of 1/512 at distance 1. So sizes do not depend on where one looks, add up, and are what one sees who looks there;
/// towards a picture's rim the same takes up to 5.2 times as many. The sphere has 3,294,199.
inline constexpr double pixel_angle = 1.0 / (512 * 512);

/// How many things are smaller than 1 pixel, 10, 100, 1000, and not; a size that is a bound is not below it.
struct Screen_sizes {
  static constexpr std::array<double, 4> bounds{1, 10, 100, 1000};
  std::array<std::size_t, 5> counts{};
  double largest = 0;

  void add(double pixels);
  std::size_t measured() const;
};

/// What an eye sees of a face, and of it the largest part: the mean of its corners, and how wide it looks, in radians:
/// its solid angle divided by its length, the largest angle between two of its corners.
struct Seen_face {
  double pixels = 0, width = 0;
  Exact_point middle;
};
/// Of each face that the eye sees from its front. Which faces and parts these are is exact, their sizes are right to
/// about 2^-48 of themselves. Cost: of see(). Errors: as see().
std::map<Face_id, Seen_face> seen_faces(const Model& model, const Exact_point& eye, const Asking& asking = {});

/// A face's size in pixels as if nothing were before it; 0 where the eye is not in front of it. Cost: O(parts).
double size_alone(const Model& model, const Exact_point& eye, Face_id face);

}  // namespace sightline
