#pragma once
// Families of scenes with a question: degenerate exactly, by so many ulps to either side, or far from it; anywhere, of
// any scale. `sightline generate FAMILY`.

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/scenes.h>
#include <sightline/harness/generate/view_drafts.h>
#include <sightline/harness/generate/weak_scenes.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace sightline::generate {

namespace touching_solids {
struct Drafter;
}

/// How far from its degeneracy a scene is.
enum class Distance { exact, beside, far };
inline constexpr std::array<Distance, 3> distances{Distance::exact, Distance::beside, Distance::far};
inline const char* name_of(Distance distance) {
  return distance == Distance::exact ? "exact" : distance == Distance::beside ? "beside" : "far";
}

/// So many ulps count as far: a gap of 1/256 of the scene's size.
inline constexpr std::int64_t far_ulps = std::int64_t{1} << 44;

struct Family_parameters {
  std::uint64_t seed = 1;
  std::size_t size = 0;  ///< what it means is the family's; 0: the family's own
  /// 0: exactly degenerate; else the gap (or, negative, the overlap) in units of 2^-52 of the scene's size.
  std::int64_t ulps = 0;
  Exact_point offset{0, 0, 0};  ///< added to all points, after scaling
  Rational scale = 1;           ///< > 0; of all points, about the origin
};

/// A scene, what is asked of it, and what is known about the answers.
struct Posed_scene {
  std::string name;  ///< family and seed
  Polygon_soup soup;
  Exact_point eye{0, 0, 0};
  Points source;          ///< strictly convex, counterclockwise seen from the side it looks to; empty: none
  std::size_t first = 0;  ///< of a pair of solids, so many faces are the first one's, all others the second's
  std::vector<Face_id> visible, hidden;  ///< from the source, by construction; of other faces nothing is known
  Distance distance = Distance::exact;
};

struct Family {
  std::string name, what;
  std::string size_means;  ///< what `size` counts
  std::size_t small_size;  ///< what `size` is where many small scenes are wanted
  bool holes;              ///< whether faces have holes, which no file format can hold
  bool pair;               ///< whether it is two solids, operands of set operations
  /// The same parameters give the same scene on every machine.
  std::function<Posed_scene(const Family_parameters&)> make;
};

// ---- What all of them do

/// p -> scale p + offset, of all points. Exact: yes
Posed_scene placed(Posed_scene scene, const Family_parameters& parameters);

/// 2^power. Exact: yes
Rational power_of_two(int power);
/// A whole number about as long as doubles hold, or a little longer: 2^52 to 2^57, give or take 9, of either sign.
Rational long_integer(Random& random);

/// So many ulps of a scene whose coordinates are at most 2^bits. Exact: yes
inline Rational ulps_of_size(std::int64_t ulps, int bits) {
  return Rational(static_cast<long>(ulps) * power_of_two(bits - 52));
}
/// The least b >= 0 such that no coordinate is above 2^b.
int size_bits(const Polygon_soup& soup);

// ---- One family of each origin

/// Coordinates of the small families are at most 8, before they are turned.
inline constexpr int small_bits = 3;

/// Faces with some eyes. More faces than there are: any ones on the lattice.
Posed_scene with_an_eye(view_drafts::Made made, const Family_parameters& parameters, Random& random);

/// A degenerate scene of faces with some eyes; beside the degeneracy, one to three of them, faces or the eye, are moved
/// along an axis.
Posed_scene nudged(view_drafts::Made made, const Family_parameters& parameters, Random& random);

/// Faces with holes that are twisted: simple along all axes, some, or none, and at times beside a hole in their plane.
/// The eye is anywhere. More faces than there are: any ones on the lattice.
Posed_scene with_twisted_holes(const Family_parameters& parameters, Random& random);

/// Faces of many corners, concave ones among them, and in half of them a source of many corners.
Posed_scene with_many_corners(const Family_parameters& parameters, Random& random);

/// Planar faces with holes, that touch their contour and one another or, beside that, do so by a gap no more.
Posed_scene with_flat_holes(const Family_parameters& parameters, Random& random);

/// A question of weak visibility; the eye is on the source or before it. More faces than there are: any ones on the
/// lattice, aside.
Posed_scene with_a_source(const weak_drafts::Drafter& drafter, const Family_parameters& parameters, Random& random);

/// Two solids that meet as the drafter says, with some eye. More faces than there are: of tetrahedra aside, the second
/// solid's.
Posed_scene of_two_solids(const touching_solids::Drafter& drafter, const Family_parameters& parameters, Random& random);

/// A scene of a kind, with an eye anywhere about it: at a corner, beyond one, in the middle, outside. Beside what it
/// is, each coordinate is moved by K ulps, or not, or by -K.
Posed_scene of_a_kind(const Kind& kind, const Family_parameters& parameters, Random& random);

// ---- The list

/// All families: questions of weak visibility, scenes with an eye, tangles, faces with holes, pairs of solids, and the
/// kinds of scenes.h. Each name is there once.
const std::vector<Family>& families();

/// The family of that name, or std::invalid_argument that says which there are.
const Family& family(std::string_view name);

}  // namespace sightline::generate
