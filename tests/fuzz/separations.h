#pragma once
// Planes that cut none of some polygons, against all planes across the same directions; orders from an eye that trees
// of such planes give, against rays; and planes between two polygons.

#include "soups.h"

#include <sightline/algorithms/priority/components.h>
#include <sightline/algorithms/priority/eye_order.h>
#include <sightline/algorithms/priority/implicit_graph.h>
#include <sightline/algorithms/priority/pair_code.h>
#include <sightline/algorithms/priority/relation.h>
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

/// Where a tree has one plane, which cuts the only component of several faces, it is one of their planes with the least
/// cost: four for each that it cuts, and what is on one of its sides more than on the other.
inline void try_cut(const Exact_traits& traits, const std::vector<Flat_face>& faces) {
  const Priority_tree<Exact_traits> tree = build_priority_tree(traits, {false, true, {}});
  if (tree.counters.planes != 1 || tree.counters.cutting_planes != 1) return;
  const Priority_relation<Exact_traits> relation(traits);
  const Priority_components components =
      Implicit_priority_graph<Priority_relation<Exact_traits>>(relation).find_components();
  std::vector<std::vector<std::uint32_t>> members(faces.size());
  for (std::uint32_t i = 0; i < faces.size(); ++i) members[components.h(i)].push_back(i);
  const auto larger = [](const auto& a, const auto& b) { return a.size() < b.size(); };
  const std::vector<std::uint32_t>& cut = *std::max_element(members.begin(), members.end(), larger);
  std::size_t least = ~std::size_t{0};
  bool is_taken = false;
  for (const std::uint32_t f : cut) {
    std::array<std::size_t, 4> at{};  // on, behind, in front, across
    for (const std::uint32_t g : cut) {
      const auto has = [&](int side) {
        return std::any_of(faces[g].corners.begin(), faces[g].corners.end(),
                           [&](const Exact_point& p) { return sgn(faces[f].height(p)) == side; });
      };
      ++at[(has(-1) ? 1u : 0u) + (has(1) ? 2u : 0u)];
    }
    const std::size_t cost = 4 * at[3] + std::max(at[1], at[2]) - std::min(at[1], at[2]);
    if (cost < least) {
      least = cost;
      is_taken = false;
    }
    is_taken = is_taken || (cost == least && at[3] == tree.counters.splits);
  }
  require(is_taken, "of the planes that cut faces the one of the least cost is taken");
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

/// A plane between two convex polygons has the one before it and the other behind it, neither all in it; where none is
/// told, none through three of their corners has. Half of them touch each other's planes, as nobody asks who asks about
/// faces that may hide each other: all of the one is then on one side of the other's plane, with a corner in it.
inline void try_plane_between(Random& random) {
  const auto drawn = [&] {
    const Exact_point at = generate::lattice(random, 3), u = generate::lattice(random, 2),
                      v = generate::lattice(random, 2);
    generate::Points points{at, generate::along(at, 1, u)};
    if (random.chance(1, 2)) points.push_back(generate::along(points[1], 1, v));
    points.push_back(generate::along(at, 1, v));
    return points;
  };
  const generate::Points p = drawn();
  generate::Points q = drawn();
  if (!spans_a_plane(p) || !spans_a_plane(q)) return;
  if (random.chance(1, 2)) {
    const auto share = [&] { return Rational(generate::integer(random, -2, 4) / 2); };
    const Exact_point along_edge = generate::along(p[0], share(), minus(p[1], p[0])),
                      touched = generate::along(along_edge, share(), minus(p.back(), p[0])),
                      way = minus(touched, q[random.below(q.size())]);
    for (Exact_point& corner : q) corner = generate::along(corner, 1, way);
  }
  const auto is_between = [&](const Exact_point& normal, const Exact_point& point) {
    bool is_before = false, is_behind = false;
    for (const generate::Points* its : std::array<const generate::Points*, 2>{&p, &q})
      for (const Exact_point& corner : *its) {
        const int side = sgn(dot(normal, minus(corner, point)));
        if (side == 0) continue;
        if ((side > 0) != (its == &p)) return false;
        (its == &p ? is_before : is_behind) = true;
      }
    return is_before && is_behind;
  };
  if (const auto plane = priority_detail::plane_between(p, q)) {
    require(is_between(plane->normal, plane->point),
            "a plane between two polygons has the one before it and the other behind it");
    return;
  }
  generate::Points all = p;
  all.insert(all.end(), q.begin(), q.end());
  for (std::size_t i = 2; i < all.size(); ++i)
    for (std::size_t j = 1; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const Exact_point u = minus(all[j], all[i]), v = minus(all[k], all[i]);
        require(!is_between(cross(u, v), all[i]) && !is_between(cross(v, u), all[i]),
                "where no plane is between two polygons there is none");
      }
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
  if (random.chance(1, 4)) try_cut(traits, faces);
  for (int pairs = 0; pairs < 4; ++pairs) try_plane_between(random);
}

}  // namespace fuzz
