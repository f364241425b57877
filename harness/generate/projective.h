#pragma once
// A question of weak visibility, and its images under projective maps, which have the same answer.

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sightline::generate {

/// A question of weak visibility.
struct Weak_scene {
  std::string name;   ///< family, seed
  Polygon_soup soup;  ///< every face has one loop
  Points source;      ///< strictly convex, counterclockwise seen from the side it looks to
  std::vector<Face_id> targets;
  std::optional<bool> truth;  ///< of every target
};

// ---- Projective maps

/// Of homogeneous coordinates (x, y, z, 1).
using Projective_map = std::array<std::array<Rational, 4>, 4>;

Rational determinant(const std::vector<std::vector<Rational>>& m);

Rational image_coordinate(const Projective_map& map, std::size_t row, const Exact_point& p);
/// Pre: the point's weight is positive, or std::invalid_argument.
Exact_point image(const Projective_map& map, const Exact_point& p);

/// The image of a scene under a projective map of positive weight on all its points, hence on all segments between
/// them: segments go to segments, faces to faces, and the sign of orient(a, b, c, d) is multiplied by the
/// determinant's. Where that is negative all loops are turned, so fronts stay fronts and the truth stays. Pre: as said,
/// and a determinant other than 0, or std::invalid_argument; planar faces, as how others are cut depends on where they
/// are.
Weak_scene project(const Weak_scene& scene, const Projective_map& map);

Projective_map affine_map(const Rational_matrix& matrix, const Exact_point& offset);
Projective_map scaling(const Rational& factor, const Exact_point& offset);
Projective_map random_rotation(Random& random);
/// x, y, z in another order, some with the other sign. Half of these are mirror images.
Projective_map random_axes(Random& random);
Projective_map random_shear(Random& random);
/// One that makes parallel planes and edges skew. Its weight is at least 1 on the scene's points.
Projective_map random_projection(const Weak_scene& scene, Random& random);

}  // namespace sightline::generate
