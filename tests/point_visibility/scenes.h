#pragma once
// Small scenes from a seed, with an eye, where what is seen is decided by ties, touches and alignments.

#include "oracle.h"

#include <sightline/harness/generate/transform.h>
#include <sightline/harness/generate/view_drafts.h>

namespace view_scenes {

using sightline::Exact_point;
using sightline::Face_id;
using sightline::Integer;
using sightline::Point_id;
using sightline::Polygon_soup;
using sightline::Rational;
using sightline::generate::along;
using sightline::generate::at;
using sightline::generate::box;
using sightline::generate::lattice;
using sightline::generate::Points;
using sightline::generate::Random;
using sightline::generate::ratio;
using sightline::generate::rectangle;
using sightline::generate::reversed;
using sightline::generate::soup_of;
using sightline::generate::view_drafts::Made;

struct Case {
  std::string name;  ///< family, seed, number
  Polygon_soup soup;
  Exact_point eye;
};

enum class Family {
  uniform,     ///< on the lattice [-4, 4]^3
  coplanar,    ///< overlapping in one plane, either sense, and others
  cyclic,      ///< bars, each over the next
  crossing,    ///< through each other, also three and more in one line or point
  joined,      ///< planes subdivided with T-junctions, faces that share edges
  boxes,       ///< boxes on boxes, walls in pieces
  edge_on,     ///< planes through the eye
  touching,    ///< the eye on a face, on an edge, at a corner
  inside,      ///< the eye in a box, also at its walls
  aligned,     ///< copies scaled about the eye: edges coincide in view
  concurrent,  ///< many edges and corners in one line of sight
  one_ulp,     ///< one of the degenerate ones, some coordinates moved by 2^-40
  far,         ///< any one, moved by 1e8
  tiny,        ///< any one, scaled by 2^-30
  turned       ///< any one, by a rational rotation
};
inline constexpr std::array families{Family::uniform, Family::coplanar, Family::cyclic,     Family::crossing,
                                     Family::joined,  Family::boxes,    Family::edge_on,    Family::touching,
                                     Family::inside,  Family::aligned,  Family::concurrent, Family::one_ulp,
                                     Family::far,     Family::tiny,     Family::turned};
inline const char* name(Family family) {
  static constexpr const char* names[] = {"uniform",    "coplanar", "cyclic",   "crossing", "joined",
                                          "boxes",      "edge_on",  "touching", "inside",   "aligned",
                                          "concurrent", "one_ulp",  "far",      "tiny",     "turned"};
  return names[static_cast<std::size_t>(family)];
}

inline Made make_base(Family family, Random& random) {
  using sightline::generate::view_drafts::drafters;
  const std::size_t number = static_cast<std::size_t>(family);
  return drafters[number < drafters.size() ? number : random.below(drafters.size())].draft(random);
}

/// Scenes of a family, small ones, that differ in the eye. The same arguments give the same scenes.
inline std::vector<Case> make(Family family, std::uint64_t seed) {
  Random random(seed * families.size() + static_cast<std::uint64_t>(family));
  Made made = make_base(family, random);
  const auto apply = [&](auto map) {
    for (Points& face : made.faces)
      for (Exact_point& p : face) p = map(p);
    for (Exact_point& eye : made.eyes) eye = map(eye);
  };
  if (family == Family::far) apply([](const Exact_point& p) { return along(p, 100000000, at(1, -1, 1)); });
  if (family == Family::tiny) apply([](const Exact_point& p) { return along(at(0, 0, 0), Rational(1, 1ul << 30), p); });
  if (family == Family::turned) {
    const auto part = [&] { return static_cast<long>(random.between(-3, 3)); };
    const long a = static_cast<long>(random.between(1, 5)), b = part(), c = part(), d = part();
    const auto matrix = sightline::generate::rotation(a, b, c, d);
    apply([&](const Exact_point& p) {
      Exact_point q{0, 0, 0};
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) q[i] += matrix[i][j] * p[j];
      return q;
    });
  }
  if (family == Family::one_ulp)
    for (std::size_t count = 1 + random.below(3); count > 0; --count) {
      Points& face = made.faces[random.below(made.faces.size())];
      Exact_point& p =
          random.chance(1, 4) ? made.eyes[random.below(made.eyes.size())] : face[random.below(face.size())];
      Rational& x = p[random.below(3)];
      x += Rational(random.chance(1, 2) ? 1 : -1, 1ul << 40);
    }
  std::vector<Case> cases;
  const std::string label = std::string(name(family)) + ' ' + std::to_string(seed) + '.';
  for (const Exact_point& eye : made.eyes)
    cases.push_back({label + std::to_string(cases.size()), soup_of(made.faces), eye});
  return cases;
}

}  // namespace view_scenes
