#include <sightline/kernel/scene/convex_parts.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/mpz_class.h>
#include <CGAL/predicates/kernel_ftC2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sightline {

namespace planar {

// A point as the triangulation sees it: bounds of its coordinates after a common translation and scaling, and the exact
// ones.
struct Site {
  CGAL::Interval_nt<false> x = 0.0, y = 0.0;
  const Planar_point* exact = nullptr;
};

// A model of CGAL's ConstrainedDelaunayTriangulationTraits_2 without constructions: interval first, then GMP. Exact:
// filtered.
struct Traits {
  using Point_2 = Site;
  struct Segment_2 {};
  struct Triangle_2 {};
  struct Construct_segment_2 {};
  struct Construct_triangle_2 {};
  struct Construct_point_2 {
    const Site& operator()(const Site& a) const { return a; }
  };
  struct Compare_x_2 {
    CGAL::Comparison_result operator()(const Site& a, const Site& b) const {
      return CGAL::sign(cmp(a.exact->x, b.exact->x));
    }
  };
  struct Compare_y_2 {
    CGAL::Comparison_result operator()(const Site& a, const Site& b) const {
      return CGAL::sign(cmp(a.exact->y, b.exact->y));
    }
  };
  struct Orientation_2 {
    CGAL::Orientation operator()(const Site& a, const Site& b, const Site& c) const;
  };
  struct Side_of_oriented_circle_2 {
    CGAL::Oriented_side operator()(const Site& a, const Site& b, const Site& c, const Site& d) const;
  };
  Construct_point_2 construct_point_2_object() const { return {}; }
  Compare_x_2 compare_x_2_object() const { return {}; }
  Compare_y_2 compare_y_2_object() const { return {}; }
  Orientation_2 orientation_2_object() const { return {}; }
  Side_of_oriented_circle_2 side_of_oriented_circle_2_object() const { return {}; }
};

inline constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
struct Vertex_number {
  std::uint32_t value = none;  // place in the list of used points
};
struct Face_number {
  std::uint32_t value = none;
};
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Traits,
    CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<Vertex_number, Traits>,
                                         CGAL::Triangulation_face_base_with_info_2<
                                             Face_number, Traits, CGAL::Constrained_triangulation_face_base_2<Traits>>>,
    CGAL::No_constraint_intersection_requiring_constructions_tag>;

inline bool same(const Planar_point& a, const Planar_point& b) { return a.x == b.x && a.y == b.y; }

/// The sign of the turn a, b, c: +1 left, 0 straight or back, -1 right. Exact: yes
inline int turn(const Planar_point& a, const Planar_point& b, const Planar_point& c) {
  return sgn(Integer((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)));
}

/// An interval that holds n / 2^shift. Post: a point where n has at most 53 significant bits and nothing underflows.
CGAL::Interval_nt<false> interval(const Integer& n, long shift);

using Loop = std::vector<std::uint32_t>;

/// The loop without points that repeat their predecessor (the first follows the last).
Loop without_repetitions(std::span<const Planar_point> points, const Loop& loop);

/// Whether the loop turns left or goes straight ahead at every point, and round exactly once: the contour of a convex
/// polygon. Pre: no repetitions. Degenerate: false for fewer than three points and where it turns back. Exact: yes
bool is_convex_contour(std::span<const Planar_point> points, const Loop& loop);

/// Twice the signed area, positive for counterclockwise. Exact: yes
Integer twice_area(std::span<const Planar_point> points, const Loop& loop);

/// Turns a piece so that it begins with its least index.
inline Loop from_least(Loop piece) {
  std::rotate(piece.begin(), std::min_element(piece.begin(), piece.end()), piece.end());
  return piece;
}

/// Convex pieces as rings of half-edges, at first one ring for each triangle.
struct Pieces {
  std::vector<std::uint32_t> origin, next, previous, twin;  // twin is none on the polygon's boundary
  std::vector<bool> alive;
  const std::vector<Site>& sites;

  std::uint32_t destination(std::uint32_t h) const { return origin[next[h]]; }
  CGAL::Orientation turn_at(std::uint32_t before, std::uint32_t after) const {
    return Traits::Orientation_2{}(sites[origin[before]], sites[origin[after]], sites[destination(after)]);
  }

  /// Removes diagonals until no removal leaves a convex piece (Hertel and Mehlhorn).
  /// Two convex pieces that touch along a chain of collinear edges are merged across all of it or not at all.
  /// Post: at most four times as many pieces as an optimal partition of a simple polygon has. Exact: yes
  void merge();

  /// The rings as loops of places in `sites`; straight corners only where asked for.
  std::vector<Loop> loops(bool with_straight_corners) const;

  void link(std::uint32_t a, std::uint32_t b) {
    next[a] = b;
    previous[b] = a;
  }
};

/// convex_parts() and triangles().
Convex_parts cut(std::span<const Planar_point> points, std::span<const Loop> loops, bool merge);

CGAL::Orientation Traits::Orientation_2::operator()(const Site& a, const Site& b, const Site& c) const {
  {
    const CGAL::Protect_FPU_rounding<true> upward;
    const auto filtered = CGAL::orientationC2(a.x, a.y, b.x, b.y, c.x, c.y);
    if (CGAL::is_certain(filtered)) return CGAL::get_certain(filtered);
  }
  return CGAL::orientationC2(a.exact->x, a.exact->y, b.exact->x, b.exact->y, c.exact->x, c.exact->y);
}

CGAL::Oriented_side Traits::Side_of_oriented_circle_2::operator()(const Site& a, const Site& b, const Site& c,
                                                                  const Site& d) const {
  {
    const CGAL::Protect_FPU_rounding<true> upward;
    const auto filtered = CGAL::side_of_oriented_circleC2(a.x, a.y, b.x, b.y, c.x, c.y, d.x, d.y);
    if (CGAL::is_certain(filtered)) return CGAL::get_certain(filtered);
  }
  return CGAL::side_of_oriented_circleC2(a.exact->x, a.exact->y, b.exact->x, b.exact->y, c.exact->x, c.exact->y,
                                         d.exact->x, d.exact->y);
}

CGAL::Interval_nt<false> interval(const Integer& n, long shift) {
  long exponent = 0;
  const double mantissa = mpz_get_d_2exp(&exponent, n.get_mpz_t());  // truncated; 1/2 <= |mantissa| < 1, or n = 0
  if (mantissa == 0) return 0.0;
  exponent -= shift;
  // Far below the others a number is only "tiny, of this sign": ldexp would lose bits under 2^-1022.
  constexpr double tiny = 0x1p-900;
  if (exponent <= -900)
    return mantissa > 0 ? CGAL::Interval_nt<false>(0.0, tiny) : CGAL::Interval_nt<false>(-tiny, 0.0);
  const double toward_zero = std::ldexp(mantissa, static_cast<int>(exponent));
  const long bits = static_cast<long>(bit_length(n));
  if (bits <= 53 || static_cast<long>(mpz_scan1(n.get_mpz_t(), 0)) >= bits - 53) return toward_zero;
  const double away = std::nextafter(toward_zero, mantissa > 0 ? HUGE_VAL : -HUGE_VAL);
  return mantissa > 0 ? CGAL::Interval_nt<false>(toward_zero, away) : CGAL::Interval_nt<false>(away, toward_zero);
}

Loop without_repetitions(std::span<const Planar_point> points, const Loop& loop) {
  Loop kept;
  for (const std::uint32_t p : loop)
    if (kept.empty() || !same(points[kept.back()], points[p])) kept.push_back(p);
  while (kept.size() > 1 && same(points[kept.back()], points[kept.front()])) kept.pop_back();
  return kept;
}

bool is_convex_contour(std::span<const Planar_point> points, const Loop& loop) {
  const std::size_t n = loop.size();
  if (n < 3) return false;
  const auto at = [&](std::size_t i) -> const Planar_point& { return points[loop[i % n]]; };
  // A direction is "up" in the half-open half plane of angles [0, pi). Turning left by less than pi at each point, the
  // direction enters it once in each full turn.
  const auto up = [&](std::size_t i) {
    const int y = cmp(at(i + 1).y, at(i).y);
    return y > 0 || (y == 0 && at(i + 1).x > at(i).x);
  };
  int full_turns = 0;
  bool previous_up = up(n - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const int side = turn(at(i + n - 1), at(i), at(i + 1));
    const bool now_up = up(i);
    if (side < 0 || (side == 0 && now_up != previous_up)) return false;
    full_turns += now_up && !previous_up;
    previous_up = now_up;
  }
  return full_turns == 1;
}

Integer twice_area(std::span<const Planar_point> points, const Loop& loop) {
  Integer area = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Planar_point &a = points[loop[i]], &b = points[loop[i + 1 == loop.size() ? 0 : i + 1]];
    area += a.x * b.y - a.y * b.x;
  }
  return area;
}

void Pieces::merge() {
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t first = 0; first < origin.size(); ++first) {
      if (!alive[first] || twin[first] == none) continue;
      if (twin[previous[first]] == next[twin[first]]) continue;  // the chain begins earlier
      std::uint32_t last = first;
      while (twin[next[last]] != none && twin[next[last]] == previous[twin[last]]) last = next[last];
      const std::uint32_t before = previous[first], after = next[last];
      const std::uint32_t other_before = previous[twin[last]], other_after = next[twin[first]];
      // Neither angle can reach a full turn, or the chain would be longer: a left turn or straight means at most pi.
      if (turn_at(before, other_after) == CGAL::RIGHT_TURN || turn_at(other_before, after) == CGAL::RIGHT_TURN)
        continue;
      for (std::uint32_t h = first;; h = next[h]) {
        alive[h] = alive[twin[h]] = false;
        if (h == last) break;
      }
      link(before, other_after);
      link(other_before, after);
      changed = true;
    }
  }
}

std::vector<Loop> Pieces::loops(bool with_straight_corners) const {
  std::vector<Loop> result;
  std::vector<bool> seen(origin.size(), false);
  for (std::uint32_t start = 0; start < origin.size(); ++start) {
    if (!alive[start] || seen[start]) continue;
    Loop& piece = result.emplace_back();
    for (std::uint32_t h = start; !seen[h]; h = next[h]) {
      seen[h] = true;
      if (with_straight_corners || turn_at(previous[h], h) != CGAL::COLLINEAR) piece.push_back(origin[h]);
    }
  }
  return result;
}

Convex_parts cut(std::span<const Planar_point> points, std::span<const Loop> loops, bool merge) {
  Convex_parts result;

  // Clean the loops, turn the holes clockwise.
  std::vector<Loop> contour;
  std::vector<std::uint32_t> used;
  for (std::size_t k = 0; k < loops.size(); ++k) {
    for (const std::uint32_t p : loops[k])
      if (p >= points.size())
        throw std::out_of_range("loop " + std::to_string(k) + " uses point " + std::to_string(p) + " of " +
                                std::to_string(points.size()));
    Loop loop = without_repetitions(points, loops[k]);
    if (k == 0 && loops.size() == 1) {
      // Quick exits.
      if (loop.size() < 3) return result;
      if ((merge || loop.size() == 3) && is_convex_contour(points, loop)) {
        // As everywhere, the least of the indices with equal coordinates stands for all: here they can only be
        // neighbours.
        Loop least = loop;
        for (std::size_t i = 0, j = 0; i < loops[0].size(); ++i) {
          if (!same(points[loops[0][i]], points[loop[j]])) j = j + 1 == loop.size() ? 0 : j + 1;
          least[j] = std::min(least[j], loops[0][i]);
        }
        Loop piece;
        for (std::size_t i = 0, n = loop.size(); i < n; ++i)
          if (turn(points[loop[i == 0 ? n - 1 : i - 1]], points[loop[i]], points[loop[i + 1 == n ? 0 : i + 1]]) != 0)
            piece.push_back(least[i]);
        result.contour = Contour::simple;
        result.pieces.push_back(from_least(std::move(piece)));
        return result;
      }
      if (loop.size() == 3) {
        if (turn(points[loop[0]], points[loop[1]], points[loop[2]]) != 0)
          result.contour = Contour::self_intersecting;  // clockwise
        return result;
      }
    }
    if (k > 0 && sgn(twice_area(points, loop)) > 0) std::reverse(loop.begin(), loop.end());
    used.insert(used.end(), loops[k].begin(), loops[k].end());
    contour.push_back(std::move(loop));
  }
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  if (used.size() < 3) return result;

  // Bound the coordinates: relative to the first point, scaled so that all lie in [-1, 1].
  std::vector<Site> sites(used.size());
  {
    const Planar_point& base = points[used[0]];
    std::size_t bits = 0;
    Integer x, y;
    for (const std::uint32_t p : used) {
      x = points[p].x - base.x;
      y = points[p].y - base.y;
      bits = std::max({bits, bit_length(x), bit_length(y)});
    }
    for (std::size_t i = 0; i < used.size(); ++i) {
      x = points[used[i]].x - base.x;
      y = points[used[i]].y - base.y;
      sites[i] = {interval(x, static_cast<long>(bits)), interval(y, static_cast<long>(bits)), &points[used[i]]};
    }
  }

  // Insert the points along a space-filling curve (the order matters for speed only, so rounded coordinates will do).
  Triangulation triangulation;
  std::vector<Triangulation::Vertex_handle> vertex(used.size());
  {
    using Rounded = CGAL::Simple_cartesian<double>;
    std::vector<Rounded::Point_2> rounded(used.size());
    std::vector<std::size_t> order(used.size());
    for (std::size_t i = 0; i < used.size(); ++i) {
      order[i] = i;
      rounded[i] = Rounded::Point_2(sites[i].x.inf(), sites[i].y.inf());
    }
    CGAL::spatial_sort(order.begin(), order.end(),
                       CGAL::Spatial_sort_traits_adapter_2<Rounded, CGAL::Pointer_property_map<Rounded::Point_2>::type>(
                           CGAL::make_property_map(rounded)));
    Triangulation::Face_handle near;
    for (const std::size_t i : order) {
      vertex[i] = triangulation.insert(sites[i], near);
      vertex[i]->info().value = std::min(vertex[i]->info().value, static_cast<std::uint32_t>(i));
      near = vertex[i]->face();
    }
  }
  if (triangulation.dimension() < 2) return result;  // all points on a line
  const auto vertex_of = [&](std::uint32_t p) {
    return vertex[static_cast<std::size_t>(std::lower_bound(used.begin(), used.end(), p) - used.begin())];
  };
  const auto for_each_edge = [&](auto&& visit) {
    for (const Loop& loop : contour)
      for (std::size_t i = 0; i + 1 < loop.size(); ++i) visit(vertex_of(loop[i]), vertex_of(loop[i + 1]));
    for (const Loop& loop : contour)
      if (loop.size() > 1) visit(vertex_of(loop.back()), vertex_of(loop.front()));
  };

  // Force the contour's edges. All points are there already, so only a crossing elsewhere can stop it.
  try {
    for_each_edge([&](auto a, auto b) { triangulation.insert_constraint(a, b); });
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    result.contour = Contour::self_intersecting;
    return result;
  }

  // Count how often the contour has each triangle on its left, along each side: +1 forth, -1 back.
  std::vector<Triangulation::Face_handle> faces;
  for (auto f = triangulation.all_faces_begin(); f != triangulation.all_faces_end(); ++f) {
    f->info().value = static_cast<std::uint32_t>(faces.size());
    faces.push_back(f);
  }
  std::vector<std::array<int, 3>> runs(faces.size(), {0, 0, 0});
  for_each_edge([&](auto a, auto b) {
    while (a != b) {
      Triangulation::Vertex_handle stop;
      Triangulation::Face_handle f;
      int i = 0;
      if (!triangulation.includes_edge(a, b, stop, f, i))
        throw std::logic_error("convex_parts: a contour edge is not in its triangulation");
      const int sense = f->vertex(Triangulation::ccw(i)) == a ? 1 : -1;  // side i of f runs from ccw(i) to cw(i)
      const Triangulation::Face_handle g = f->neighbor(i);
      runs[f->info().value][static_cast<std::size_t>(i)] += sense;
      runs[g->info().value][static_cast<std::size_t>(triangulation.mirror_index(f, i))] -= sense;
      a = stop;
    }
  });

  // Spread the winding numbers from the outside: one more on the left of each run than on its right.
  constexpr int unknown = std::numeric_limits<int>::min();
  std::vector<int> winding(faces.size(), unknown);
  std::vector<std::uint32_t> to_visit{triangulation.infinite_face()->info().value};
  winding[to_visit[0]] = 0;
  while (!to_visit.empty()) {
    const std::uint32_t f = to_visit.back();
    to_visit.pop_back();
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t g = faces[f]->neighbor(i)->info().value;
      if (winding[g] != unknown) continue;
      winding[g] = winding[f] - runs[f][static_cast<std::size_t>(i)];
      if (winding[g] != 0 && winding[g] != 1) {
        result.contour = Contour::self_intersecting;
        return result;
      }
      to_visit.push_back(g);
    }
  }

  // Take the triangles inside, merge them, name their corners.
  std::vector<std::uint32_t> place(faces.size(), none);
  std::uint32_t inside = 0;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (winding[f] == 1) place[f] = inside++;
  if (inside == 0) return result;
  const std::size_t sides = 3 * std::size_t{inside};
  Pieces pieces{std::vector<std::uint32_t>(sides), std::vector<std::uint32_t>(sides),
                std::vector<std::uint32_t>(sides), std::vector<std::uint32_t>(sides, none),
                std::vector<bool>(sides, true),    sites};
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (place[f] == none) continue;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t h = 3 * place[f] + static_cast<std::uint32_t>(i);
      pieces.origin[h] = faces[f]->vertex(Triangulation::ccw(i))->info().value;
      pieces.link(h, 3 * place[f] + static_cast<std::uint32_t>(Triangulation::ccw(i)));
      const std::uint32_t g = place[faces[f]->neighbor(i)->info().value];
      if (g != none) pieces.twin[h] = 3 * g + static_cast<std::uint32_t>(triangulation.mirror_index(faces[f], i));
    }
  }
  if (merge) pieces.merge();
  result.contour = Contour::simple;
  result.pieces = pieces.loops(!merge);
  for (Loop& piece : result.pieces) {
    for (std::uint32_t& corner : piece) corner = used[corner];
    piece = from_least(std::move(piece));
  }
  std::sort(result.pieces.begin(), result.pieces.end());
  return result;
}

}  // namespace planar

Convex_parts convex_parts(std::span<const Planar_point> points, std::span<const std::vector<std::uint32_t>> loops) {
  return planar::cut(points, loops, true);
}

Convex_parts triangles(std::span<const Planar_point> points, std::span<const std::vector<std::uint32_t>> loops) {
  return planar::cut(points, loops, false);
}

}  // namespace sightline
