#pragma once
// What certificates claim, tried at a few points by integers: a claim that a checker accepted and that a sample
// contradicts is a finding. Samples prove nothing right; they share no code with the checkers.

#include "support.h"

#include <sightline/algorithms/verify/along.h>
#include <sightline/algorithms/verify/graph.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/algorithms/verify/visible.h>
#include <sightline/algorithms/verify/weak.h>

#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace fuzz {

using Points = std::vector<Exact_point>;

/// A point (x, y, z, w) of positive w, a direction of w = 0, or a plane, where that is said. Integers, so that nothing
/// is ever reduced.
using Place = std::array<Integer, 4>;
using Places = std::vector<Place>;

inline Place place(const Exact_point& p) {
  Integer w = 1;
  for (const Rational& x : p) w = lcm(w, x.get_den());
  return {Integer(p[0] * w), Integer(p[1] * w), Integer(p[2] * w), w};
}
inline Places places(const Points& points) {
  Places all;
  for (const Exact_point& p : points) all.push_back(place(p));
  return all;
}
inline Place direction_to(const Place& q, const Place& from) {
  Place d;
  for (std::size_t k = 0; k < 3; ++k) d[k] = q[k] * from[3] - from[k] * q[3];
  return d;
}
inline Place direction(const Exact_point& d) {
  Place result = place(d);
  result[3] = 0;
  return result;
}
inline Place cross(const Place& a, const Place& b) {  // of directions
  return {Integer(a[1] * b[2] - a[2] * b[1]), Integer(a[2] * b[0] - a[0] * b[2]), Integer(a[0] * b[1] - a[1] * b[0]),
          0};
}
/// Of directions, or of a plane and a place: on which side of it that is.
inline int sign_of_dot(const Place& a, const Place& b) {
  Integer sum = a[0] * b[0];
  for (std::size_t k = 1; k < 4; ++k) mpz_addmul(sum.get_mpz_t(), a[k].get_mpz_t(), b[k].get_mpz_t());
  return sgn(sum);
}

/// A line by the 2 x 2 minors of two places on it.
using Line = std::array<Integer, 6>;
inline Line line(const Place& p, const Place& q) {
  const std::size_t columns[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  Line minors;
  for (std::size_t k = 0; k < 6; ++k) {
    const auto [i, j] = columns[k];
    minors[k] = p[i] * q[j];
    mpz_submul(minors[k].get_mpz_t(), p[j].get_mpz_t(), q[i].get_mpz_t());
  }
  return minors;
}
/// Whether one line runs counterclockwise around the other: 1, 0 where they meet, -1.
inline int turns(const Line& l, const Line& m) {
  Integer sum = l[1] * m[4] + l[4] * m[1];
  for (const std::size_t k : {0, 2, 3, 5}) mpz_submul(sum.get_mpz_t(), l[k].get_mpz_t(), m[5 - k].get_mpz_t());
  return sgn(sum);
}

/// Places strictly inside the convex hull, or the cone, of others: positive mixtures. Pre: there are some.
inline Places mixtures(const Places& of) {
  Places result;
  for (std::size_t k = 0; k < 4; ++k) {
    Place sum{0, 0, 0, 0};
    for (std::size_t i = 0; i < of.size(); ++i)
      for (std::size_t j = 0; j < 4; ++j)
        mpz_addmul_ui(sum[j].get_mpz_t(), of[i][j].get_mpz_t(), 1 + (7 * i * i + 5 * k * i + 3 * k) % 11 * k);
    result.push_back(std::move(sum));
  }
  return result;
}

/// A convex polygon. Pre: of area.
struct Flat {
  Places corners;
  Place normal{0, 0, 0, 0}, plane;  // towards its front
  std::vector<Line> edges;

  explicit Flat(const Points& of) : corners(places(of)) {
    const Place first = direction_to(corners[1], corners[0]);
    for (std::size_t i = 2; i < corners.size() && normal == Place{0, 0, 0, 0}; ++i)
      normal = cross(first, direction_to(corners[i], corners[0]));
    for (std::size_t k = 0; k < 3; ++k) {
      plane[k] = normal[k] * corners[0][3];
      plane[3] -= normal[k] * corners[0][k];
    }
    for (std::size_t i = 0; i < corners.size(); ++i)
      edges.push_back(line(corners[i], corners[(i + 1) % corners.size()]));
  }
  int side(const Place& p) const { return sign_of_dot(plane, p); }
  bool is_in_plane_of(const Flat& other) const {
    return std::all_of(corners.begin(), corners.end(), [&](const Place& p) { return other.side(p) == 0; });
  }
  /// Where a line towards the front passes: 1 inside, 0 through the boundary, -1 outside.
  int passed(const Line& towards_front, int way = 1) const {
    int least = 1;
    for (const Line& edge : edges) {
      least = std::min(least, way * turns(towards_front, edge));
      if (least < 0) break;
    }
    return least;
  }
  /// Of a point in the plane.
  int location(const Place& p) const { return passed(line(p, normal)); }
  bool is_convex() const {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Place& p) { return side(p) == 0 && location(p) == 0; });
  }
  /// Whether it meets a closed segment in its plane.
  bool meets_in_plane(const Place& p, const Place& q) const {
    const Line along = line(p, q);
    int least = 1, most = -1;
    for (const Place& corner : corners) {
      const int side = turns(along, line(corner, normal));
      least = std::min(least, side);
      most = std::max(most, side);
    }
    if (least > 0 || most < 0) return false;
    const Line at_p = line(p, normal), at_q = line(q, normal);
    return std::none_of(edges.begin(), edges.end(),
                        [&](const Line& edge) { return turns(at_p, edge) < 0 && turns(at_q, edge) < 0; });
  }
  /// Where a ray meets the plane, strictly before it.
  std::optional<Place> met(const Place& from, const Place& ray) const {
    if (side(from) * sign_of_dot(plane, ray) >= 0) return std::nullopt;
    Integer height = 0, fall = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      height += plane[k] * from[k];
      fall += plane[k] * ray[k];
    }
    Place p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = abs(fall) * from[k] + abs(height) * ray[k];
    return p;
  }
  /// Where the segment from p to q meets the polygon: between its ends or at one of them. Or the line elsewhere.
  enum class At { before, p, between, q, behind };
  struct Hit {
    At at;
    int location;
  };
  /// Nothing where the line is parallel to the plane or passes the polygon by. q may be a direction: then nothing is
  /// behind it.
  std::optional<Hit> hit(const Place& p, const Place& q) const {
    const int from = side(p), to = side(q);
    // Towards which side it goes; where both ends are on one side, towards the nearer one is away.
    const int way = from != to ? (to > from ? 1 : -1) : sign_of_dot(normal, direction_to(q, p));
    if (way == 0) return std::nullopt;
    const int where = passed(line(p, q), way);
    if (where < 0) return std::nullopt;
    const At at = from == 0     ? At::p
                  : to == 0     ? At::q
                  : from != to  ? At::between
                  : from == way ? At::before
                                : At::behind;
    return Hit{at, where};
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
                         const std::optional<Place>& eye = std::nullopt) {
  std::vector<bool> set_aside(scene.parts.size());
  for (const Covering::Set_aside& entry : covering.set_aside) set_aside[entry.face] = true;
  std::vector<bool> drawn(scene.parts.size());
  for (const Order_fragment& fragment : covering.fragments) drawn[fragment.face] = true;
  for (std::size_t f = 0; f < set_aside.size(); ++f) {
    const bool needs_no_reason = scene.duplicate[f] || (eye && !drawn[f]);
    require(set_aside[f] == scene.set_aside[f] || (!set_aside[f] && needs_no_reason), "what is set aside has to be");
  }
  const auto is_in = [](const Flat& part, const Place& p) { return part.side(p) == 0 && part.location(p) >= 0; };
  const auto lies_with = [](const Flat& part, const Flat& fragment) {  // in its plane, with its front
    return sign_of_dot(part.normal, fragment.normal) > 0 && fragment.is_in_plane_of(part);
  };
  for (std::size_t i = 0; i < fragments.size(); ++i) {
    require(fragments[i].normal != Place{0, 0, 0, 0}, "a fragment has an area");
    require(fragments[i].is_convex(), "a fragment is convex");
    const std::vector<Flat>& parts = scene.parts[covering.fragments[i].face];
    if (parts.empty()) continue;
    for (const Place& p : mixtures(fragments[i].corners))
      require(std::any_of(parts.begin(), parts.end(),
                          [&](const Flat& part) { return lies_with(part, fragments[i]) && is_in(part, p); }),
              "a fragment is in its face, with its front");
  }
  for (std::size_t f = 0; f < scene.parts.size(); ++f) {
    if (set_aside[f]) continue;
    const bool planar = std::all_of(scene.parts[f].begin(), scene.parts[f].end(),
                                    [&](const Flat& part) { return lies_with(scene.parts[f][0], part); });
    for (const Flat& part : scene.parts[f]) {
      const bool is_meant = !eye || part.side(*eye) > 0;
      for (const Place& p : mixtures(part.corners)) {
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
  const Place eye = place(claim.eye);
  try_covering(scene, claim, fragments, claim.on_view ? std::optional(eye) : std::nullopt);
  for (std::size_t later = 0; later < fragments.size(); ++later) {
    if (fragments[later].side(eye) == 0) continue;
    for (const Place& p : mixtures(fragments[later].corners))
      for (std::size_t earlier = 0; earlier < later; ++earlier)
        if (const auto hit = fragments[earlier].hit(eye, p))
          require(hit->at != Flat::At::between || hit->location == 0, "nothing that is drawn earlier is nearer");
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
  for (const Order_fragment& fragment : claim.fragments) {
    if (scene.parts[fragment.face].size() < 2) continue;
    std::set<Exact_point> own;
    for (std::size_t k = 0; k < scene.soup.loop_count(fragment.face); ++k)
      for (const Point_id p : scene.soup.loop(fragment.face, k)) own.insert(scene.soup.point(p));
    for (const Exact_point& p : fragment.vertices) require(own.count(p) > 0, "a face is cut at its own points");
  }
  const std::size_t n = fragments.size();
  const auto has_corner = [&](std::size_t of, int side, std::size_t plane) {
    return std::any_of(fragments[of].corners.begin(), fragments[of].corners.end(),
                       [&](const Place& p) { return fragments[plane].side(p) == side; });
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
  for (const auto& [from, to, corner_from, corner_to] : claim.arcs)
    require(component[from] == component[to] && fragments[to].side(fragments[from].corners[corner_from]) > 0 &&
                fragments[from].side(fragments[to].corners[corner_to]) < 0,
            "an arc is one, and in its component");
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) reaches[i][j] = reaches[i][j] || (reaches[i][k] && reaches[k][j]);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      require(component[i] != component[j] || reaches[i][j], "a component is strongly connected");
}

/// A convex cone.
struct Tile {
  Places rays, inward;  // normals of its sides

  explicit Tile(Places of) : rays(std::move(of)) {
    const Place middle = mixtures(rays)[0];
    for (std::size_t i = 0; i < rays.size(); ++i) {
      Place side = cross(rays[i], rays[(i + 1) % rays.size()]);
      const int sense = sign_of_dot(side, middle);
      for (Integer& x : side) x *= sense;
      inward.push_back(std::move(side));
    }
  }
  /// Of a direction: 1 strictly inside, 0 on the boundary, -1 outside.
  int location(const Place& direction) const {
    int least = 1;
    for (const Place& side : inward) {
      least = std::min(least, sign_of_dot(side, direction));
      if (least < 0) break;
    }
    return least;
  }
};

inline Places directions(const Points& cone) {
  Places all;
  for (const Exact_point& d : cone) all.push_back(direction(d));
  return all;
}

/// The extreme rays of a part, which it has, or those to its vertices.
inline Points rays_of(const Visible_certificate& claim, const Visible_certificate::Part& part) {
  Points rays;
  for (const std::uint32_t ray : part.rays) rays.push_back(claim.rays[ray]);
  if (part.rays.empty())
    for (const Exact_point& p : part.vertices)
      rays.push_back({p[0] - claim.eye[0], p[1] - claim.eye[1], p[2] - claim.eye[2]});
  return rays;
}

inline void try_claims(const Known_scene& scene, const Visible_certificate& claim) {
  const std::vector<Flat> fragments = flats(claim);
  const Place eye = place(claim.eye);
  try_covering(scene, claim, fragments);
  std::vector<Tile> tiles;
  for (const Points& cone : claim.empty) tiles.emplace_back(directions(cone));
  std::optional<Tile> field;
  if (!claim.field.empty()) field.emplace(directions(claim.field));
  const auto preference = [&](std::size_t i) {  // of what is as far: seen from the front, then as in the file
    return std::tuple(fragments[i].side(eye) <= 0, claim.fragments[i].face, claim.fragments[i].piece);
  };
  for (const Visible_certificate::Part& part : claim.parts) {
    const Places rays = directions(rays_of(claim, part));
    tiles.emplace_back(rays);
    Places corners = places(part.vertices);
    if (!part.rays.empty())
      for (const Place& ray : rays) {
        const std::optional<Place> corner = fragments[part.fragment].met(eye, ray);
        require(corner.has_value(), "a ray of a part meets its fragment's plane");
        corners.push_back(*corner);
      }
    for (const Place& p : mixtures(corners)) {
      require(fragments[part.fragment].side(p) == 0 && fragments[part.fragment].location(p) >= 0,
              "a part is in its fragment");
      for (std::size_t i = 0; i < fragments.size(); ++i)
        if (const auto hit = fragments[i].hit(eye, p); hit && hit->location > 0) {
          require(hit->at != Flat::At::between, "nothing is before a visible part");
          require(hit->at != Flat::At::q || preference(part.fragment) <= preference(i),
                  "of what is as far, a visible part is of what is preferred");
        }
    }
  }
  for (const Points& cone : claim.empty)
    for (const Place& d : mixtures(directions(cone)))
      for (const Flat& other : fragments)
        if (const auto hit = other.hit(eye, d))
          require(hit->at != Flat::At::between || hit->location == 0, "nothing is in an empty cone");
  for (const Tile& tile : tiles)
    for (const Place& d : mixtures(tile.rays)) {
      require(!field || field->location(d) >= 0, "what is seen is in the field");
      require(std::count_if(tiles.begin(), tiles.end(), [&](const Tile& other) { return other.location(d) > 0; }) == 1,
              "a direction is in one cone");
    }
  const auto is_in_a_cone = [&](const Place& d) {
    return std::any_of(tiles.begin(), tiles.end(), [&](const Tile& tile) { return tile.location(d) >= 0; });
  };
  if (field)
    for (const Place& d : mixtures(field->rays)) require(is_in_a_cone(d), "a direction of the field is in a cone");
  else
    for (const Tile& tile : tiles)
      for (const Place& d : mixtures(tile.rays))
        require(is_in_a_cone({Integer(-d[0]), Integer(-d[1]), Integer(-d[2]), 0}),
                "a direction is in a cone, and so is the opposite one");
  for (const Flat& fragment : fragments)
    for (const Place& p : mixtures(fragment.corners)) {
      const Place d = direction_to(p, eye);
      if (fragment.side(eye) == 0 || (field && field->location(d) <= 0)) continue;
      require(is_in_a_cone(d), "a direction of the field is in a cone");
    }
}

/// Fractions at which a path may be asked: moments that are fractions, and some between each two.
inline std::vector<std::pair<Rational, Along_certificate::Range>> times_of(const Along_certificate& claim) {
  std::vector<std::pair<Rational, Along_certificate::Range>> times;
  for (std::size_t k = 0; k < claim.moments.size(); ++k) {
    if (claim.moments[k].low == claim.moments[k].high) times.push_back({claim.moments[k].low, {k, k}});
    if (k + 1 < claim.moments.size())
      times.push_back({Rational((claim.moments[k].high + claim.moments[k + 1].low) / 2), {k, k + 1}});
  }
  return times;
}
inline Exact_point eye_at(const Along_certificate& claim, const Rational& t) {
  Exact_point eye;
  for (std::size_t k = 0; k < 3; ++k) eye[k] = claim.from[k] + t * (claim.to[k] - claim.from[k]);
  return eye;
}
/// The faces that a path is said to see then.
inline std::set<Face_id> said_to_be_seen(const Along_certificate& claim, const Along_certificate::Range& then) {
  std::set<Face_id> faces;
  for (const Along_certificate::Face& face : claim.faces)
    for (const auto& [low, high] : face.seen)
      if (then.low == then.high ? (low == high && low == then.low) || (low < then.low && then.low < high)
                                : low <= then.low && then.high <= high)
        faces.insert(face.face);
  return faces;
}

inline void try_claims(const Known_scene& scene, const Along_certificate& claim) {
  const std::vector<Flat> fragments = flats(claim);
  try_covering(scene, claim, fragments);
  const auto have_a_place_in_common = [](const Along_certificate::Range& a, const Along_certificate::Range& b) {
    const auto first = [](const auto& range) { return 2 * range.low + (range.low < range.high ? 1 : 0); };
    const auto last = [](const auto& range) { return 2 * range.high - (range.low < range.high ? 1 : 0); };
    return first(a) <= last(b) && first(b) <= last(a);
  };
  for (const Along_certificate::Face& face : claim.faces)
    for (auto range = face.seen.begin(); range != face.seen.end(); ++range)
      require(std::none_of(face.seen.begin(), range,
                           [&](const auto& other) { return have_a_place_in_common(*range, other); }),
              "a face is said to be seen once at a time");
  std::size_t tried = 0;
  for (const auto& [t, then] : times_of(claim)) {
    if (++tried > 16) break;
    const Place eye = place(eye_at(claim, t));
    const std::set<Face_id> seen = said_to_be_seen(claim, then);
    for (std::size_t i = 0; i < fragments.size(); ++i) {
      const Flat& target = fragments[i];
      if (seen.contains(claim.fragments[i].face) || (claim.two_sided ? target.side(eye) == 0 : target.side(eye) <= 0))
        continue;
      for (const Place& q : mixtures(target.corners)) {
        const bool is_free = std::none_of(fragments.begin(), fragments.end(), [&](const Flat& other) {
          if (other.side(eye) == 0 && other.side(q) == 0) return true;  // it may touch the segment: nothing is known
          const auto hit = other.hit(eye, q);
          return hit && (hit->at == Flat::At::between || (hit->at == Flat::At::q && !other.is_in_plane_of(target)));
        });
        require(!is_free, "what is said not to be seen on the way is not seen");
      }
    }
  }
}

inline void try_claims(const Known_scene& scene, const Weak_certificate& claim) {
  const std::vector<Flat> fragments = flats(claim);
  try_covering(scene, claim, fragments);
  std::vector<Flat> sources;
  for (const Points& source : claim.sources) sources.emplace_back(source);
  const auto looks = [&](const Place& p, const Flat& source, const Place& q, const Flat& fragment) {
    return source.side(q) > 0 && (fragment.side(p) > 0 || (claim.two_sided && fragment.side(p) < 0));
  };
  const auto blocked = [&](const Place& p, const Place& q) {
    return std::any_of(fragments.begin(), fragments.end(), [&](const Flat& other) {
      const auto hit = other.hit(p, q);
      return hit && hit->at == Flat::At::between;
    });
  };
  // Nor does anything touch its ends but in the planes of source and target: else a keel, or a plane that holds the
  // segment, may make it free alone among all near by.
  const auto holds_an_end = [&](const Flat& other, const Place& p, const Flat& source, const Place& q,
                                const Flat& target) {
    const auto hit = other.hit(p, q);
    return hit && ((hit->at == Flat::At::p && !other.is_in_plane_of(source)) ||
                   (hit->at == Flat::At::q && !other.is_in_plane_of(target)));
  };
  const auto strictly_free = [&](const Place& p, const Flat& source, const Place& q, const Flat& target) {
    return !blocked(p, q) && std::none_of(fragments.begin(), fragments.end(), [&](const Flat& other) {
      return (other.side(p) == 0 && other.side(q) == 0) || holds_an_end(other, p, source, q, target);
    });
  };
  const auto touched = [&](const Place& p, const Flat& source, const Place& q, const Flat& target) {
    return std::any_of(fragments.begin(), fragments.end(), [&](const Flat& other) {
      if (other.side(p) == 0 && other.side(q) == 0) return other.meets_in_plane(p, q);
      return holds_an_end(other, p, source, q, target);
    });
  };
  std::vector<bool> visible(scene.parts.size()), undecided(scene.parts.size());
  for (const Weak_certificate::Sightline& entry : claim.visible) {
    const Flat &source = sources[entry.source], &fragment = fragments[entry.fragment];
    const Place from = place(entry.from), to = place(entry.to);
    require(source.side(from) == 0 && source.location(from) > 0, "a sightline begins inside its source");
    require(fragment.side(to) == 0 && fragment.location(to) > 0, "a sightline ends inside its fragment");
    require(looks(from, source, to, fragment), "both ends of a sightline look to each other");
    require(!blocked(from, to), "nothing is on a sightline");
    require(!touched(from, source, to, fragment), "nothing touches a sightline's ends but in their planes");
    visible[claim.fragments[entry.fragment].face] = true;
  }
  std::set<std::pair<std::size_t, std::size_t>> hidden;
  for (const Weak_certificate::Hidden& entry : claim.hidden) {
    entry.for_each_fragment([&](std::size_t k) {
      hidden.insert({k, entry.source});
      const Flat &source = sources[entry.source], &fragment = fragments[k];
      for (const Place& p : mixtures(source.corners))
        for (const Place& q : mixtures(fragment.corners))
          require(!looks(p, source, q, fragment) || !strictly_free(p, source, q, fragment),
                  "what is hidden is not seen");
    });
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
