#pragma once
// Rays, and what they meet of faces: the words that all ways to trace share.

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstdint>
#include <vector>

namespace sightline {

/// The points origin + t direction for t >= 0, in the file's coordinates. Pre: direction != 0.
struct Exact_ray {
  Exact_point origin, direction;
};

/// The same in doubles, which are the numbers that they are. Pre: finite, direction != 0.
struct Double_ray {
  std::array<double, 3> origin, direction;

  Exact_ray exact() const;
};

/// Each number rounded to the nearest double: infinite beyond them, and what is short may have no direction left.
Double_ray in_doubles(const Exact_ray& ray);
/// Whether that is a ray, as Double_ray has to be.
bool is_ray(const Double_ray& ray);

/// Whether what holds the origin is met there. Rays that leave a surface want `open`, the default everywhere.
enum class Ray_start {
  open,   ///< a part of a face that holds the origin is passed over, all along the ray's way in it
  closed  ///< it is met at t = 0
};

/// From which side a ray comes to a face: strictly in front of its plane, strictly behind it, or in it.
enum class Met_side { front, back, along };

/// A part of a ray that a face holds: from t to until, equal but where the ray runs along the face. Faces are closed.
struct Face_hit {
  Face_id face;
  Met_side side;
  Rational t, until;
  friend bool operator==(const Face_hit&, const Face_hit&) = default;
};

/// The hits of faces that parts of them are met in: of each face the connected parts, by t, then by face. Where pieces
/// of one face are met at one t from different sides it is from the front before from behind before along. Exact: yes.
/// Proof: P-95
std::vector<Face_hit> hits_of(std::vector<Face_hit> parts, Ray_start start);

/// Of sorted hits those of the least t.
std::vector<Face_hit> only_first(std::vector<Face_hit> hits);

/// Where a hit begins.
Exact_point point_at(const Exact_ray& ray, const Rational& t);

/// Errors: std::domain_error where the direction is zero.
void check_direction(const Exact_ray& ray);

}  // namespace sightline
