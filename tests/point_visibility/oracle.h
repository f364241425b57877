#pragma once
// What an eye sees, by definition and by brute force: every piece against every other in plain rational arithmetic.
// Knows the scene's pieces and where their corners are, nothing else of the library, and nothing of what it tests.

#include "../products.h"

#include <sightline/harness/generate/random.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace oracle {

using sightline::Exact_point;
using sightline::Face_id;
using sightline::Rational;
using sightline::Scene;
using Points = std::vector<Exact_point>;

// ---- Vectors

inline Exact_point minus(const Exact_point& a, const Exact_point& b) {
  return {Rational(a[0] - b[0]), Rational(a[1] - b[1]), Rational(a[2] - b[2])};
}
/// p + t d
inline Exact_point along(const Exact_point& p, const Rational& t, const Exact_point& d) {
  return {Rational(p[0] + t * d[0]), Rational(p[1] + t * d[1]), Rational(p[2] + t * d[2])};
}
using test_scenes::cross;
using test_scenes::dot;
inline bool is_zero(const Exact_point& v) { return sgn(v[0]) == 0 && sgn(v[1]) == 0 && sgn(v[2]) == 0; }
inline Exact_point centroid(const Points& points) {
  Exact_point sum{0, 0, 0};
  for (const Exact_point& p : points) sum = along(sum, 1, p);
  for (Rational& x : sum) x /= static_cast<long>(points.size());
  return sum;
}

// ---- Convex polygons

/// A plane and its positive side.
struct Half_space {
  Exact_point normal;
  Rational offset;
  Rational height(const Exact_point& p) const { return Rational(dot(normal, p) - offset); }
};
inline Half_space opposite(const Half_space& h) {
  return {{Rational(-h.normal[0]), Rational(-h.normal[1]), Rational(-h.normal[2])}, Rational(-h.offset)};
}

/// The part of a strictly convex polygon on the positive side, its corners in the same sense. Degenerate: none where
/// that part has no area.
inline Points clipped(const Points& polygon, const Half_space& h) {
  std::vector<Rational> heights;
  for (const Exact_point& p : polygon) heights.push_back(h.height(p));
  Points part;
  if (std::none_of(heights.begin(), heights.end(), [](const Rational& x) { return sgn(x) > 0; })) return part;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const std::size_t next = (k + 1) % polygon.size();
    if (sgn(heights[k]) >= 0) part.push_back(polygon[k]);
    if (sgn(heights[k]) * sgn(heights[next]) < 0)
      part.push_back(along(polygon[k], heights[k] / (heights[k] - heights[next]), minus(polygon[next], polygon[k])));
  }
  return part;
}
/// Whether nothing of a convex polygon is strictly on the positive side.
inline bool is_beyond(const Points& polygon, const Half_space& h) {
  return std::none_of(polygon.begin(), polygon.end(), [&](const Exact_point& p) { return sgn(h.height(p)) > 0; });
}

/// What is left of convex polygons without the interior of an intersection of half-spaces: convex polygons with
/// disjoint interiors.
inline std::vector<Points> without(const std::vector<Points>& polygons, const std::vector<Half_space>& hole) {
  std::vector<Points> left;
  for (const Points& polygon : polygons) {
    if (std::any_of(hole.begin(), hole.end(), [&](const Half_space& side) { return is_beyond(polygon, side); })) {
      left.push_back(polygon);
      continue;
    }
    Points rest = polygon;
    std::vector<Points> around;
    for (std::size_t k = 0; k < hole.size() && !rest.empty(); ++k) {
      if (const Points outside = clipped(rest, opposite(hole[k])); !outside.empty()) around.push_back(outside);
      rest = clipped(rest, hole[k]);
    }
    if (rest.empty()) left.push_back(polygon);  // it has nothing in the hole
    else left.insert(left.end(), around.begin(), around.end());
  }
  return left;
}

/// Where a point of its plane is in a convex polygon: strictly inside (1), on the boundary (0), outside (-1). `normal`
/// is on the side from which the corners run counterclockwise.
inline int holds(const Points& polygon, const Exact_point& normal, const Exact_point& q) {
  int least = 1;
  for (std::size_t k = 0; k < polygon.size() && least >= 0; ++k) {
    const Exact_point &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    least = std::min(least, sgn(dot(cross(minus(b, a), minus(q, a)), normal)));
  }
  return least;
}
inline int holds(const std::vector<Points>& polygons, const Exact_point& normal, const Exact_point& q) {
  int most = -1;
  for (const Points& polygon : polygons) most = std::max(most, holds(polygon, normal, q));
  return most;
}

/// The axis in which a normal is longest, the first of these.
inline std::size_t dominant_axis(const Exact_point& normal) {
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (abs(normal[k]) > abs(normal[axis])) axis = k;
  return axis;
}
/// The area of a convex polygon's projection along that axis, not negative.
inline Rational projected_area(const Points& polygon, const Exact_point& normal) {
  const std::size_t axis = dominant_axis(normal), i = (axis + 1) % 3, j = (axis + 2) % 3;
  Rational twice = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Exact_point &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    twice += a[i] * b[j] - a[j] * b[i];
  }
  return Rational(abs(twice) / 2);
}
inline Rational projected_area(const std::vector<Points>& polygons, const Exact_point& normal) {
  Rational sum = 0;
  for (const Points& polygon : polygons) sum += projected_area(polygon, normal);
  return sum;
}

/// The half-spaces at right angles to its plane that bound a convex polygon.
inline std::vector<Half_space> walls(const Points& polygon, const Exact_point& normal) {
  std::vector<Half_space> sides;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Exact_point inward = cross(normal, minus(polygon[(k + 1) % polygon.size()], polygon[k]));
    sides.push_back({inward, dot(inward, polygon[k])});
  }
  return sides;
}
/// Whether two lists of convex polygons in one plane, all counterclockwise seen from the normal's side, cover the same
/// points up to area zero.
inline bool same_points(const std::vector<Points>& a, const std::vector<Points>& b, const Exact_point& normal) {
  const auto covered = [&](std::vector<Points> left, const std::vector<Points>& by) {
    for (const Points& polygon : by) left = without(left, walls(polygon, normal));
    return left.empty();
  };
  return covered(a, b) && covered(b, a);
}

// ---- Pieces

/// A piece of the scene by its corners only. Heights are positive in front.
struct Flat {
  Points corners;
  Half_space plane;
  Face_id face;
  std::uint32_t number;

  Rational height(const Exact_point& p) const { return plane.height(p); }
  int holds(const Exact_point& q) const { return oracle::holds(corners, plane.normal, q); }
  Rational area() const { return projected_area(corners, plane.normal); }
};
using Flats = std::vector<Flat>;

/// flats[i] is scene.pieces()[i].
inline Flats flats_of(const Scene& scene) {
  Flats flats;
  for (const sightline::Piece& piece : scene.pieces()) {
    const Points corners = scene.corner_points(piece);
    const Exact_point normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    flats.push_back({corners, {normal, dot(normal, corners[0])}, piece.face, piece.number});
  }
  return flats;
}

inline bool coplanar(const Flat& a, const Flat& b) {
  return std::all_of(b.corners.begin(), b.corners.end(), [&](const Exact_point& p) { return sgn(a.height(p)) == 0; });
}
/// Which of two coplanar pieces is the one seen where they overlap. Pre: the eye is not in their plane.
inline bool wins(const Flat& a, const Flat& b, const Exact_point& eye) {
  const bool a_front = sgn(a.height(eye)) > 0, b_front = sgn(b.height(eye)) > 0;
  if (a_front != b_front) return a_front;
  return std::pair(a.face, a.number) < std::pair(b.face, b.number);
}

// ---- 1. One direction

/// Where the ray from the eye meets a piece's plane, as eye + t direction with t > 0; none where it does not, or the
/// eye is in the plane.
inline std::optional<Rational> crossing(const Flat& flat, const Exact_point& eye, const Exact_point& direction) {
  const Rational height = flat.height(eye), descent = dot(flat.plane.normal, direction);
  if (sgn(height) * sgn(descent) >= 0) return std::nullopt;
  return Rational(-height / descent);
}

/// The piece that is seen in a direction, as an index into scene.pieces(). `generic` becomes false where the answer is
/// a matter of convention or about to change: the ray meets the boundary of a piece, is in the plane of a piece that is
/// edge-on, or meets two pieces in different planes at once, nearest. Pre: direction != 0.
inline std::optional<std::uint32_t> first_hit(const Flats& flats, const Exact_point& eye, const Exact_point& direction,
                                              bool* generic = nullptr) {
  std::optional<std::uint32_t> first;
  Rational nearest;
  bool is_generic = true, tie = false;
  for (std::uint32_t i = 0; i < flats.size(); ++i) {
    if (sgn(flats[i].height(eye)) == 0) {
      if (sgn(dot(flats[i].plane.normal, direction)) == 0) is_generic = false;
      continue;
    }
    const std::optional<Rational> t = crossing(flats[i], eye, direction);
    if (!t) continue;
    const int inside = flats[i].holds(along(eye, *t, direction));
    if (inside == 0) is_generic = false;
    if (inside < 0) continue;
    if (!first || *t < nearest) {
      first = i;
      nearest = *t;
      tie = false;
    } else if (*t == nearest) {
      if (!coplanar(flats[*first], flats[i])) tie = true;
      else if (wins(flats[i], flats[*first], eye)) first = i;
    }
  }
  if (generic) *generic = is_generic && !tie;
  return first;
}
inline std::optional<std::uint32_t> first_hit(const Scene& scene, const Exact_point& eye, const Exact_point& direction,
                                              bool* generic = nullptr) {
  return first_hit(flats_of(scene), eye, direction, generic);
}

// ---- 2. All of what is seen

/// The part of a piece that is seen: convex polygons in its plane with disjoint interiors, counterclockwise seen from
/// the piece's front. Their closure counts.
struct Region {
  std::uint32_t piece;  ///< index into scene.pieces()
  Face_id face;
  bool front;  ///< whether the eye is in front of the piece
  std::vector<Points> parts;
  Rational area;  ///< of the projection along the dominant axis of the piece's normal, in the file's coordinates
};

/// The half-spaces that bound the cone of a convex polygon with the eye as apex. Pre: the eye is not in the polygon's
/// plane.
inline std::vector<Half_space> cone(const Exact_point& eye, const Points& polygon) {
  const Exact_point inside = centroid(polygon);
  std::vector<Half_space> sides;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Exact_point normal = cross(minus(polygon[k], eye), minus(polygon[(k + 1) % polygon.size()], eye));
    const Half_space side{normal, dot(normal, eye)};
    sides.push_back(sgn(side.height(inside)) > 0 ? side : opposite(side));
  }
  return sides;
}

/// What the other pieces leave to be seen of flats[i]. Two coplanar pieces: the one that wins hides the other, or,
/// without `ties`, none does.
inline std::vector<Points> seen_of(const Flats& flats, std::size_t i, const Exact_point& eye, bool ties) {
  const Flat& flat = flats[i];
  const int side = sgn(flat.height(eye));
  if (side == 0) return {};
  std::vector<Points> seen{flat.corners};
  for (std::size_t j = 0; j < flats.size() && !seen.empty(); ++j) {
    const Flat& other = flats[j];
    if (j == i || sgn(other.height(eye)) == 0) continue;
    if (coplanar(flat, other)) {
      if (ties && wins(other, flat, eye))
        seen = without(seen, cone(eye, other.corners));  // the cone meets the plane in the polygon itself
    } else if (const Points nearer = clipped(other.corners, side > 0 ? flat.plane : opposite(flat.plane));
               !nearer.empty()) {
      seen = without(seen, cone(eye, nearer));
    }
  }
  return seen;
}

/// What is seen of every piece, in the scene's order. Degenerate: nothing of pieces that are edge-on.
inline std::vector<Region> visible_parts(const Flats& flats, const Exact_point& eye) {
  std::vector<Region> regions;
  for (std::uint32_t i = 0; i < flats.size(); ++i) {
    Region region{i, flats[i].face, sgn(flats[i].height(eye)) > 0, seen_of(flats, i, eye, true), 0};
    region.area = projected_area(region.parts, flats[i].plane.normal);
    regions.push_back(region);
  }
  return regions;
}
inline std::vector<Region> visible_parts(const Scene& scene, const Exact_point& eye) {
  return visible_parts(flats_of(scene), eye);
}

/// The areas of what is seen of each face and side, where there is any: {face, whether its front}.
inline std::map<std::pair<Face_id, bool>, Rational> visible_areas(const std::vector<Region>& regions) {
  std::map<std::pair<Face_id, bool>, Rational> areas;
  for (const Region& region : regions)
    if (!region.parts.empty()) areas[{region.face, region.front}] += region.area;
  return areas;
}
inline Rational visible_area(const std::vector<Region>& regions, Face_id face, bool front) {
  Rational sum = 0;
  for (const Region& region : regions)
    if (region.face == face && region.front == front) sum += region.area;
  return sum;
}
inline Rational visible_area(const Scene& scene, const Exact_point& eye, Face_id face, bool front) {
  return visible_area(visible_parts(scene, eye), face, front);
}

// ---- 3. The law

/// The faces that are visible by the law (P-00): the eye strictly in front, and sightlines to an open part of the face.
/// Coplanar faces do not hide each other.
inline std::set<Face_id> visible_faces(const Flats& flats, const Exact_point& eye) {
  std::set<Face_id> faces;
  for (std::size_t i = 0; i < flats.size(); ++i)
    if (sgn(flats[i].height(eye)) > 0 && !seen_of(flats, i, eye, false).empty()) faces.insert(flats[i].face);
  return faces;
}
inline std::set<Face_id> visible_faces(const Scene& scene, const Exact_point& eye) {
  return visible_faces(flats_of(scene), eye);
}

// ---- 4. Hidden lines

/// from < to
struct Interval {
  Rational from, to;
};
inline bool operator==(const Interval& a, const Interval& b) { return a.from == b.from && a.to == b.to; }

/// Whether the open segment (p, q) meets a closed piece, by itself. Pre: p != q.
inline bool blocks(const Flat& flat, const Exact_point& p, const Exact_point& q) {
  const Rational from = flat.height(p), to = flat.height(q);
  if (sgn(from) * sgn(to) < 0) return flat.holds(along(p, from / (from - to), minus(q, p))) >= 0;
  if (sgn(from) != 0 || sgn(to) != 0) return false;  // it meets the plane in an end, or nowhere
  Rational low = 0, high = 1;                        // in the plane: the t of p + t (q - p) that no edge excludes
  for (const Half_space& wall : walls(flat.corners, flat.plane.normal)) {
    const Rational start = wall.height(p), rise = Rational(wall.height(q) - start);
    if (sgn(rise) == 0) {
      if (sgn(start) < 0) return false;
    } else if (const Rational t = Rational(-start / rise); sgn(rise) > 0) {
      low = std::max(low, t);
    } else {
      high = std::min(high, t);
    }
  }
  return low <= high && low < 1 && high > 0;
}
inline bool is_sightline(const Flats& flats, const Exact_point& p, const Exact_point& q) {
  return std::none_of(flats.begin(), flats.end(), [&](const Flat& flat) { return blocks(flat, p, q); });
}

/// The s in [0, 1] for which the open segment from the eye to a + s (b - a) meets the closed piece, up to finitely
/// many: an interval, or none. Points of the plane of eye, a and b are eye + x (a - eye) + y (b - eye). Then t = x + y
/// is how far along the segment a point is, and s = y / t. What the piece has in common with the triangle x, y >= 0, t
/// <= 1 is convex, and s of one of its points is a mean of s of its corners, without the eye. It blocks unless all of
/// it is the eye, or on the edge.
inline std::optional<Interval> blocked_by(const Flat& flat, const Exact_point& eye, const Exact_point& a,
                                          const Exact_point& b) {
  const Exact_point u = minus(a, eye), v = minus(b, eye), normal = cross(u, v);
  const Half_space plane{normal, dot(normal, eye)};
  const Rational size = dot(normal, normal);
  // The piece's part in the plane: the polygon itself, a segment, a point or nothing.
  Points common;
  for (std::size_t k = 0; k < flat.corners.size(); ++k) {
    const Exact_point &p = flat.corners[k], &q = flat.corners[(k + 1) % flat.corners.size()];
    const Rational here = plane.height(p), next = plane.height(q);
    if (sgn(here) == 0) common.push_back(p);
    if (sgn(here) * sgn(next) < 0) common.push_back(along(p, here / (here - next), minus(q, p)));
  }
  // In x and y, and what of it is in the triangle: closed, so that points and segments stay.
  using Pair = std::array<Rational, 2>;
  std::vector<Pair> corners;
  for (const Exact_point& p : common) {
    const Exact_point w = minus(p, eye);
    corners.push_back({Rational(dot(cross(w, v), normal) / size), Rational(dot(cross(u, w), normal) / size)});
  }
  const auto cut = [&](auto value) {
    std::vector<Pair> part;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Pair &p = corners[k], &q = corners[(k + 1) % corners.size()];
      const Rational here = value(p), next = value(q);
      if (sgn(here) >= 0) part.push_back(p);
      if (sgn(here) * sgn(next) < 0) {
        const Rational share = Rational(here / (here - next));
        part.push_back({Rational(p[0] + share * (q[0] - p[0])), Rational(p[1] + share * (q[1] - p[1]))});
      }
    }
    corners = part;
  };
  cut([](const Pair& p) { return p[0]; });
  cut([](const Pair& p) { return p[1]; });
  cut([](const Pair& p) { return Rational(1 - p[0] - p[1]); });

  std::optional<Interval> blocked;
  bool short_of_edge = false;
  for (const Pair& p : corners) {
    const Rational t = Rational(p[0] + p[1]);
    if (t < 1) short_of_edge = true;
    if (sgn(t) == 0) continue;
    const Rational s = Rational(p[1] / t);
    if (!blocked) blocked = Interval{s, s};
    blocked->from = std::min(blocked->from, s);
    blocked->to = std::max(blocked->to, s);
  }
  if (!short_of_edge || !blocked || blocked->from == blocked->to) return std::nullopt;
  return blocked;
}

/// The intervals of s in [0, 1] where the open segment from the eye to a + s (b - a) meets no closed piece of the
/// scene, whichever side and edge-on or not, up to finitely many points; ascending, disjoint, each as long as can be.
/// Degenerate: none where eye, a and b are on one line.
inline std::vector<Interval> visible_on_edge(const Flats& flats, const Exact_point& eye, const Exact_point& a,
                                             const Exact_point& b) {
  if (is_zero(cross(minus(a, eye), minus(b, eye)))) return {};
  std::vector<Interval> blocked;
  for (const Flat& flat : flats)
    if (const std::optional<Interval> interval = blocked_by(flat, eye, a, b)) blocked.push_back(*interval);
  std::sort(blocked.begin(), blocked.end(), [](const Interval& i, const Interval& j) { return i.from < j.from; });
  std::vector<Interval> free;
  Rational reached = 0;
  for (const Interval& interval : blocked) {
    if (reached < interval.from) free.push_back({reached, interval.from});
    reached = std::max(reached, interval.to);
  }
  if (reached < 1) free.push_back({reached, 1});
  return free;
}
inline std::vector<Interval> visible_on_edge(const Scene& scene, const Exact_point& eye, const Exact_point& a,
                                             const Exact_point& b) {
  return visible_on_edge(flats_of(scene), eye, a, b);
}

// ---- 5. Directions at random

using sightline::generate::Random;

inline Exact_point random_direction(Random& random, std::int64_t reach = 1000) {
  Exact_point v{0, 0, 0};
  while (is_zero(v))
    for (Rational& x : v) x = static_cast<long>(random.between(-reach, reach));
  return v;
}
/// Towards a point strictly inside a piece, any but the eye. Pre: there is a piece.
inline Exact_point random_direction_at(const Flats& flats, const Exact_point& eye, Random& random) {
  while (true) {
    const Points& corners = flats[random.below(flats.size())].corners;
    Exact_point sum{0, 0, 0};
    Rational total = 0;
    for (const Exact_point& p : corners) {
      const Rational weight = static_cast<long>(random.between(1, 1000));
      sum = along(sum, weight, p);
      total += weight;
    }
    const Exact_point v = minus(along(Exact_point{0, 0, 0}, Rational(1 / total), sum), eye);
    if (!is_zero(v)) return v;
  }
}

}  // namespace oracle
