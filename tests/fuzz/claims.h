#pragma once
// What certificates claim, tried at a few points by plain rationals: a claim that a checker accepted and that a sample
// contradicts is a finding. Samples prove nothing right; they share no code with the checkers.

#include "support.h"

#include <sightline/algorithms/verify/graph.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/algorithms/verify/visible.h>
#include <sightline/algorithms/verify/weak.h>

#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace fuzz {

using Points = std::vector<Exact_point>;

inline Exact_point minus(const Exact_point& a, const Exact_point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Exact_point plus(const Exact_point& a, const Exact_point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Exact_point times(const Rational& r, const Exact_point& a) { return {r * a[0], r * a[1], r * a[2]}; }
inline Rational dot(const Exact_point& a, const Exact_point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Exact_point cross(const Exact_point& a, const Exact_point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Points strictly inside the convex hull, or the cone, of others: positive mixtures. Pre: there are some.
inline Points mixtures(const Points& of, bool sum_one = true) {
  Points result;
  for (std::size_t k = 0; k < 4; ++k) {
    Exact_point sum{0, 0, 0};
    Rational all = 0;
    for (std::size_t i = 0; i < of.size(); ++i) {
      const Rational weight = 1 + static_cast<long>((7 * i * i + 5 * k * i + 3 * k) % 11 * k);
      sum = plus(sum, times(weight, of[i])), all += weight;
    }
    result.push_back(sum_one ? times(1 / all, sum) : sum);
  }
  return result;
}

/// A convex polygon. Pre: of area.
struct Flat {
  Points corners;
  Exact_point normal;  // by Newell, towards its front

  explicit Flat(Points of) : corners(std::move(of)), normal{0, 0, 0} {
    for (std::size_t i = 0; i < corners.size(); ++i)
      normal = plus(normal, cross(minus(corners[i], corners[0]), minus(corners[(i + 1) % corners.size()], corners[0])));
  }
  int side(const Exact_point& p) const { return sgn(dot(normal, minus(p, corners[0]))); }
  bool is_in_plane_of(const Flat& other) const {
    return std::all_of(corners.begin(), corners.end(), [&](const Exact_point& p) { return other.side(p) == 0; });
  }
  /// Of a point in the plane: 1 inside, 0 on the boundary, -1 outside.
  int location(const Exact_point& p) const {
    int least = 1;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Exact_point& from = corners[i];
      least = std::min(least, sgn(dot(normal, cross(minus(corners[(i + 1) % corners.size()], from), minus(p, from)))));
    }
    return least;
  }
  /// Where the line p + t (q - p) meets the polygon: t, and the location there. Nothing where it is parallel to the
  /// plane or passes the polygon by.
  std::optional<std::pair<Rational, int>> hit(const Exact_point& p, const Exact_point& q) const {
    const Rational at_p = dot(normal, minus(p, corners[0])), at_q = dot(normal, minus(q, corners[0]));
    if (at_p == at_q) return std::nullopt;
    const Rational t = at_p / (at_p - at_q);
    const int where = location(plus(p, times(t, minus(q, p))));
    if (where < 0) return std::nullopt;
    return std::pair(t, where);
  }
};

/// What is known of the one scene that certificates are tried on.
struct Known_scene {
  Polygon_soup soup;
  std::vector<std::vector<Flat>> parts;  // of each face, convex; none where it is not planar
  std::vector<bool> set_aside;
  std::vector<bool> duplicate;  // may as well be drawn
};

inline std::vector<Flat> flats(const Covering& covering) {
  std::vector<Flat> all;
  for (const Order_fragment& fragment : covering.fragments) all.emplace_back(fragment.vertices);
  return all;
}

/// Each fragment is in its face, and each point of a face is in one fragment; faces that the eye is not in front of may
/// have none.
inline void try_covering(const Known_scene& scene, const Covering& covering, const std::vector<Flat>& fragments,
                         const Exact_point* eye = nullptr) {
  std::vector<bool> set_aside(scene.parts.size());
  for (const Covering::Set_aside& entry : covering.set_aside) set_aside[entry.face] = true;
  for (std::size_t f = 0; f < set_aside.size(); ++f)
    require(set_aside[f] == scene.set_aside[f] || (!set_aside[f] && scene.duplicate[f]), "what is set aside has to be");
  const auto is_in = [](const Flat& part, const Exact_point& p) { return part.side(p) == 0 && part.location(p) >= 0; };
  const auto lies_with = [](const Flat& part, const Flat& fragment) {  // in its plane, with its front
    return dot(part.normal, fragment.normal) > 0 && fragment.is_in_plane_of(part);
  };
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const std::vector<Flat>& parts = scene.parts[covering.fragments[i].face];
    if (parts.empty()) continue;
    for (const Exact_point& p : mixtures(fragments[i].corners))
      require(std::any_of(parts.begin(), parts.end(),
                          [&](const Flat& part) { return lies_with(part, fragments[i]) && is_in(part, p); }),
              "a fragment is in its face, with its front");
  }
  for (std::size_t f = 0; f < scene.parts.size(); ++f) {
    if (set_aside[f]) continue;
    const bool planar = std::all_of(scene.parts[f].begin(), scene.parts[f].end(),
                                    [&](const Flat& part) { return lies_with(scene.parts[f][0], part); });
    for (const Flat& part : scene.parts[f]) {
      const bool is_meant = eye == nullptr || part.side(*eye) > 0;
      for (const Exact_point& p : mixtures(part.corners)) {
        std::size_t inside = 0, touching = 0;
        for (std::size_t i = 0; i < fragments.size(); ++i) {
          if (covering.fragments[i].face != f || !lies_with(part, fragments[i])) continue;
          inside += fragments[i].location(p) > 0;
          touching += fragments[i].location(p) == 0;
        }
        // The triangles of one that is not planar may lie on one another.
        const bool once = planar ? inside == 1 || (inside == 0 && touching >= 2) : inside + touching > 0;
        require(once || !is_meant, "a point of a face is in one fragment");
      }
    }
  }
}

inline void try_claims(const Known_scene& scene, const Order_certificate& claim) {
  const std::vector<Flat> fragments = flats(claim);
  try_covering(scene, claim, fragments, claim.on_view ? &claim.eye : nullptr);
  for (std::size_t later = 0; later < fragments.size(); ++later) {
    if (fragments[later].side(claim.eye) == 0) continue;
    for (const Exact_point& p : mixtures(fragments[later].corners))
      for (std::size_t earlier = 0; earlier < later; ++earlier)
        if (const auto hit = fragments[earlier].hit(claim.eye, p))
          require(hit->first <= 0 || hit->first >= 1 || hit->second == 0, "nothing that is drawn earlier is nearer");
  }
}

inline void try_claims(const Known_scene& scene, const Graph_certificate& claim) {
  const std::vector<Flat> fragments = flats(claim);
  try_covering(scene, claim, fragments);
  for (std::size_t f = 0; f < scene.parts.size(); ++f)
    require(scene.parts[f].size() != 1 ||
                std::count_if(claim.fragments.begin(), claim.fragments.end(),
                              [&](const Order_fragment& fragment) { return fragment.face == f; }) <= 1,
            "a convex face is one fragment");
  const std::size_t n = fragments.size();
  const auto has_corner = [&](std::size_t of, int side, std::size_t plane) {
    return std::any_of(fragments[of].corners.begin(), fragments[of].corners.end(),
                       [&](const Exact_point& p) { return fragments[plane].side(p) == side; });
  };
  std::vector<std::vector<char>> reaches(n, std::vector<char>(n));
  std::vector<std::size_t> component;
  for (std::size_t c = 0; c < claim.sizes.size(); ++c) component.insert(component.end(), claim.sizes[c], c);
  require(component.size() == n, "components are the fragments");
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      reaches[i][j] = i == j || (has_corner(i, 1, j) && has_corner(j, -1, i));
      require(!reaches[i][j] || component[i] <= component[j], "nothing obscures what has higher priority");
    }
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) reaches[i][j] = reaches[i][j] || (reaches[i][k] && reaches[k][j]);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      require(component[i] != component[j] || reaches[i][j], "a component is strongly connected");
}

/// A convex cone.
struct Tile {
  Points rays, inward;  // normals of its sides

  explicit Tile(Points of) : rays(std::move(of)) {
    const Exact_point middle = mixtures(rays, false)[0];
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Exact_point side = cross(rays[i], rays[(i + 1) % rays.size()]);
      inward.push_back(times(sgn(dot(side, middle)), side));
    }
  }
  /// Of a direction: 1 strictly inside, 0 on the boundary, -1 outside.
  int location(const Exact_point& direction) const {
    int least = 1;
    for (const Exact_point& side : inward) {
      least = std::min(least, sgn(dot(side, direction)));
      if (least < 0) break;
    }
    return least;
  }
};

/// The extreme rays of a part, which it has, or its vertices.
inline Points rays_of(const Visible_certificate& claim, const Visible_certificate::Part& part) {
  Points rays;
  for (const std::uint32_t ray : part.rays) rays.push_back(claim.rays[ray]);
  if (part.rays.empty())
    for (const Exact_point& p : part.vertices) rays.push_back(minus(p, claim.eye));
  return rays;
}

inline void try_claims(const Known_scene& scene, const Visible_certificate& claim) {
  const std::vector<Flat> fragments = flats(claim);
  try_covering(scene, claim, fragments);
  std::vector<Tile> tiles;
  for (const Points& cone : claim.empty) tiles.emplace_back(cone);
  std::optional<Tile> field;
  if (!claim.field.empty()) field.emplace(claim.field);
  for (const Visible_certificate::Part& part : claim.parts) {
    const Points rays = rays_of(claim, part);
    tiles.emplace_back(rays);
    Points vertices = part.vertices;
    if (!part.rays.empty())
      for (const Exact_point& ray : rays) {
        const auto hit = fragments[part.fragment].hit(claim.eye, plus(claim.eye, ray));
        require(hit && hit->first > 0, "a ray of a part meets its fragment");
        vertices.push_back(plus(claim.eye, times(hit->first, ray)));
      }
    for (const Exact_point& p : mixtures(vertices)) {
      require(fragments[part.fragment].side(p) == 0 && fragments[part.fragment].location(p) >= 0,
              "a part is in its fragment");
      for (const Flat& other : fragments)
        if (const auto hit = other.hit(claim.eye, p))
          require(hit->first <= 0 || hit->first >= 1 || hit->second == 0, "nothing is before a visible part");
    }
  }
  for (const Points& cone : claim.empty)
    for (const Exact_point& d : mixtures(cone, false))
      for (const Flat& other : fragments)
        if (const auto hit = other.hit(claim.eye, plus(claim.eye, d)))
          require(hit->first <= 0 || hit->second == 0, "nothing is in an empty cone");
  for (const Tile& tile : tiles)
    for (const Exact_point& d : mixtures(tile.rays, false)) {
      require(!field || field->location(d) >= 0, "what is seen is in the field");
      require(std::count_if(tiles.begin(), tiles.end(), [&](const Tile& other) { return other.location(d) > 0; }) == 1,
              "a direction is in one cone");
    }
  for (const Flat& fragment : fragments)
    for (const Exact_point& p : mixtures(fragment.corners)) {
      const Exact_point d = minus(p, claim.eye);
      if (fragment.side(claim.eye) == 0 || (field && field->location(d) <= 0)) continue;
      require(std::any_of(tiles.begin(), tiles.end(), [&](const Tile& tile) { return tile.location(d) >= 0; }),
              "a direction of the field is in a cone");
    }
}

inline void try_claims(const Known_scene& scene, const Weak_certificate& claim) {
  const std::vector<Flat> fragments = flats(claim);
  try_covering(scene, claim, fragments);
  std::vector<Flat> sources;
  for (const Points& source : claim.sources) sources.emplace_back(source);
  const auto looks = [&](const Exact_point& p, const Flat& source, const Exact_point& q, const Flat& fragment) {
    return source.side(q) > 0 && (fragment.side(p) > 0 || (claim.two_sided && fragment.side(p) < 0));
  };
  const auto blocked = [&](const Exact_point& p, const Exact_point& q) {
    return std::any_of(fragments.begin(), fragments.end(), [&](const Flat& other) {
      const auto hit = other.hit(p, q);
      return hit && hit->first > 0 && hit->first < 1;
    });
  };
  // Nor does anything touch its ends but in the planes of source and target: else a keel, or a plane that holds the
  // segment, may make it free alone among all near by.
  const auto strictly_free = [&](const Exact_point& p, const Flat& source, const Exact_point& q, const Flat& target) {
    return std::none_of(fragments.begin(), fragments.end(), [&](const Flat& other) {
      if (other.side(p) == 0 && other.side(q) == 0) return true;
      const auto hit = other.hit(p, q);
      if (!hit || hit->first < 0 || hit->first > 1) return false;
      return !(hit->first == 0 && other.is_in_plane_of(source)) && !(hit->first == 1 && other.is_in_plane_of(target));
    });
  };
  std::vector<bool> visible(scene.parts.size()), undecided(scene.parts.size());
  for (const Weak_certificate::Sightline& entry : claim.visible) {
    const Flat &source = sources[entry.source], &fragment = fragments[entry.fragment];
    require(source.side(entry.from) == 0 && source.location(entry.from) > 0, "a sightline begins inside its source");
    require(fragment.side(entry.to) == 0 && fragment.location(entry.to) > 0, "a sightline ends inside its fragment");
    require(looks(entry.from, source, entry.to, fragment), "both ends of a sightline look to each other");
    require(!blocked(entry.from, entry.to), "nothing is on a sightline");
    visible[claim.fragments[entry.fragment].face] = true;
  }
  std::set<std::pair<std::size_t, std::size_t>> hidden;
  for (const Weak_certificate::Hidden& entry : claim.hidden) {
    hidden.insert({entry.fragment, entry.source});
    const Flat &source = sources[entry.source], &fragment = fragments[entry.fragment];
    for (const Exact_point& p : mixtures(source.corners))
      for (const Exact_point& q : mixtures(fragment.corners))
        require(!looks(p, source, q, fragment) || !strictly_free(p, source, q, fragment), "what is hidden is not seen");
  }
  for (const Face_id face : claim.undecided) undecided[face] = true;
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    const Face_id face = claim.fragments[i].face;
    for (std::size_t s = 0; s < sources.size(); ++s)
      require(visible[face] || undecided[face] || hidden.count({i, s}) > 0,
              "a face that is not visible is hidden from each source, with all its fragments");
  }
}

}  // namespace fuzz
