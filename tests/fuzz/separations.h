#pragma once
// Planes that cut none of some polygons, against all planes across the same directions; and orders from an eye that
// trees of such planes give, against rays.

#include "soups.h"

#include <sightline/algorithms/priority/eye_order.h>
#include <sightline/algorithms/priority/separation.h>
#include <sightline/algorithms/priority/tree.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/traits/exact_traits.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <vector>

namespace fuzz {

using harness::Flat_face;

/// How many of the faces are on, behind and in front of a plane; nothing where it cuts one.
template <class Value>
std::optional<std::array<std::vector<std::uint32_t>, 3>> sides_of(const std::vector<Flat_face>& faces,
                                                                  const std::vector<std::uint32_t>& members,
                                                                  Value value) {
  std::array<std::vector<std::uint32_t>, 3> sides;
  for (const std::uint32_t member : members) {
    bool below = false, above = false;
    for (const Exact_point& p : faces[member].corners) {
      const int side = sgn(value(p));
      below = below || side < 0;
      above = above || side > 0;
    }
    if (below && above) return std::nullopt;
    sides[above ? 2 : below ? 1 : 0].push_back(member);
  }
  return sides;
}

/// The fewest that a plane across a direction leaves on its larger side, if it cuts none and leaves `least` on each:
/// that of a face, or one in a gap.
inline std::optional<std::size_t> best_across(const Exact_point& direction, const std::vector<Flat_face>& faces,
                                              const std::vector<std::uint32_t>& members, std::size_t least) {
  std::optional<std::size_t> best;
  std::set<Rational> heights;
  for (const std::uint32_t member : members)
    for (const Exact_point& p : faces[member].corners) heights.insert(dot(direction, p));
  const auto offer = [&](const Rational& height, bool is_gap) {
    const auto sides =
        sides_of(faces, members, [&](const Exact_point& p) { return Rational(dot(direction, p) - height); });
    if (!sides || std::min((*sides)[1].size(), (*sides)[2].size()) < least) return;
    if (!is_gap && (*sides)[0].empty()) return;  // no face's plane
    const std::size_t larger = std::max((*sides)[1].size(), (*sides)[2].size());
    if (!best || larger < *best) best = larger;
  };
  for (auto at = heights.begin(); at != heights.end(); ++at) {
    offer(*at, false);
    if (const auto next = std::next(at); next != heights.end()) offer(Rational((*at + *next) / 2), true);
  }
  return best;
}

inline void try_separation(const Scene& scene, const Exact_traits& traits, const std::vector<Flat_face>& faces,
                           Random& random) {
  Separation_finder<Exact_traits> finder(traits);
  Polygon_store<Exact_traits> store;
  std::vector<std::uint32_t> members;
  for (std::uint32_t i = 0; i < faces.size(); ++i) {
    finder.add(store.piece(traits, i));
    if (!random.chance(1, 6)) members.push_back(i);
  }
  random.shuffle(members);
  const std::size_t least = 1 + random.below(2), directions = random.chance(1, 2) ? 100 : random.below(3);
  Predicate_counts counts;
  const std::optional<Separation> found = finder.find(members, least, directions, counts);
  if (found) {
    // In the file's coordinates.
    std::array<Rational, 4> h;
    if (found->plane.is_free())
      for (std::size_t k = 0; k < 4; ++k) h[k] = exact(found->plane.free[k]);
    else h = scene.file_coefficients(found->plane.face);
    auto sides = sides_of(
        faces, members, [&](const Exact_point& p) { return Rational(h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3]); });
    require(sides.has_value(), "a separating plane cuts no member");
    require(*sides == found->sides, "members are on the sides that are said");
    require(std::min(found->sides[1].size(), found->sides[2].size()) >= least, "enough members are on each side");
  }
  std::vector<Exact_point> across{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  if (directions > faces.size())
    for (const std::uint32_t member : members) across.push_back(faces[member].normal);
  std::optional<std::size_t> best;
  for (const Exact_point& direction : across)
    if (const auto larger = best_across(direction, faces, members, least); larger && (!best || *larger < *best))
      best = larger;
  require(found.has_value() || !best, "where there is a separating plane one is found");
  if (best)
    require(std::max(found->sides[1].size(), found->sides[2].size()) <= *best,
            "of separating planes one is found that leaves the fewest on its larger side");
}

/// Of what a tree draws none obscures what is drawn later, and each face that the eye is in front of is drawn, once.
inline void try_eye_order(const Scene& scene, const Exact_traits& traits, const std::vector<Flat_face>& faces,
                          const Exact_point& eye, bool split) {
  const Priority_tree<Exact_traits> tree = build_priority_tree(traits, {false, split, {}});
  const Eye_order<Exact_traits> order = back_to_front(traits, tree, eye);
  std::vector<Flat_face> drawn;
  std::vector<Exact_point> areas(faces.size(), Exact_point{0, 0, 0});
  std::vector<std::size_t> parts(faces.size());
  for (const auto& polygon : order.polygons) {
    drawn.push_back(harness::flat_face_of(traits, polygon));
    areas[polygon.piece] = generate::along(areas[polygon.piece], 1, drawn.back().normal);
    ++parts[polygon.piece];
  }
  for (std::size_t i = 0; i < faces.size(); ++i)
    require(faces[i].height(eye) > 0 ? areas[i] == faces[i].normal : parts[i] == 0,
            "an eye is shown all of what it is in front of, and nothing else");
  require(scene.pieces().size() == faces.size(), "faces are pieces");
  for (std::size_t later = 0; later < drawn.size(); ++later)
    for (std::size_t earlier = 0; earlier < later; ++earlier)
      require(!harness::sees_over(eye, drawn[earlier], drawn[later]), "nothing that is drawn earlier is nearer");
}

inline void separations(std::string_view bytes) {
  Random random(Bytes(bytes).word());
  const bool about = random.chance(1, 4);
  const Polygon_soup soup = generate::soup_of(about ? about_the_eye(random) : groups(random));
  const Scene scene(soup);
  const Exact_traits traits(scene);
  const std::vector<Flat_face> faces = harness::flat_faces_of(scene);
  if (faces.empty()) return;
  try_separation(scene, traits, faces, random);
  const Exact_point eye = about ? Exact_point{0, 0, 0} : generate::half_lattice(random, 6);
  try_eye_order(scene, traits, faces, eye, random.chance(1, 4));
}

}  // namespace fuzz
