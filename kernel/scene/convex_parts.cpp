#include <sightline/kernel/scene/convex_parts.h>

#include <sightline/kernel/scene/planar_pieces.h>
#include <sightline/kernel/scene/planar_sites.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sightline {

namespace {

using planar::none;
using planar::Pieces;
using planar::Site;
using planar::Traits;
using Loop = std::vector<std::uint32_t>;

// ---- Loops

bool same(const Planar_point& a, const Planar_point& b) { return a.x == b.x && a.y == b.y; }

/// The sign of the turn a, b, c: +1 left, 0 straight or back, -1 right. Exact: yes
int turn(const Planar_point& a, const Planar_point& b, const Planar_point& c) {
  return sgn(Integer((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)));
}

/// The loop without points that repeat their predecessor (the first follows the last).
Loop without_repetitions(std::span<const Planar_point> points, const Loop& loop) {
  Loop kept;
  for (const std::uint32_t p : loop)
    if (kept.empty() || !same(points[kept.back()], points[p])) kept.push_back(p);
  while (kept.size() > 1 && same(points[kept.back()], points[kept.front()])) kept.pop_back();
  return kept;
}

/// Whether the loop turns left or goes straight ahead at every point, and round exactly once: the contour of a convex
/// polygon. Pre: no repetitions. Degenerate: false for fewer than three points and where it turns back. Exact: yes
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

/// Twice the signed area that a loop goes around.
Integer twice_area(std::span<const Planar_point> points, const Loop& loop) {
  Integer area = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Planar_point &a = points[loop[i]], &b = points[loop[i + 1 == loop.size() ? 0 : i + 1]];
    area += a.x * b.y - a.y * b.x;
  }
  return area;
}

/// Turns a piece so that it begins with its least index.
Loop from_least(Loop piece) {
  std::rotate(piece.begin(), std::min_element(piece.begin(), piece.end()), piece.end());
  return piece;
}

/// The loops without repetitions, holes clockwise. Errors: std::out_of_range where one uses a point that is not there.
std::vector<Loop> cleaned(std::span<const Planar_point> points, std::span<const Loop> loops) {
  std::vector<Loop> contour;
  for (std::size_t k = 0; k < loops.size(); ++k) {
    for (const std::uint32_t p : loops[k])
      if (p >= points.size())
        throw std::out_of_range("loop " + std::to_string(k) + " uses point " + std::to_string(p) + " of " +
                                std::to_string(points.size()));
    Loop& loop = contour.emplace_back(without_repetitions(points, loops[k]));
    if (k > 0 && sgn(twice_area(points, loop)) > 0) std::reverse(loop.begin(), loop.end());
  }
  return contour;
}

/// The points that loops use, each once, in ascending order.
std::vector<std::uint32_t> used_by(std::span<const Loop> loops) {
  std::vector<std::uint32_t> used;
  for (const Loop& loop : loops) used.insert(used.end(), loop.begin(), loop.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

// ---- What takes no triangulation

/// A convex contour as one piece. `given`: as it was before repetitions were dropped from `loop`.
Convex_parts one_piece(std::span<const Planar_point> points, const Loop& given, const Loop& loop) {
  // As everywhere, the least of the indices with equal coordinates stands for all: here they can only be neighbours.
  Loop least = loop;
  for (std::size_t i = 0, j = 0; i < given.size(); ++i) {
    if (!same(points[given[i]], points[loop[j]])) j = j + 1 == loop.size() ? 0 : j + 1;
    least[j] = std::min(least[j], given[i]);
  }
  Loop piece;
  for (std::size_t i = 0, n = loop.size(); i < n; ++i)
    if (turn(points[loop[i == 0 ? n - 1 : i - 1]], points[loop[i]], points[loop[i + 1 == n ? 0 : i + 1]]) != 0)
      piece.push_back(least[i]);
  return {Contour::simple, {from_least(std::move(piece))}};
}

/// The parts of a polygon without holes, where it is convex or has at most three corners.
std::optional<Convex_parts> at_a_glance(std::span<const Planar_point> points, const Loop& given, const Loop& loop,
                                        bool merge) {
  if (loop.size() < 3) return Convex_parts{};
  if ((merge || loop.size() == 3) && is_convex_contour(points, loop)) return one_piece(points, given, loop);
  if (loop.size() > 3) return std::nullopt;
  const bool clockwise = turn(points[loop[0]], points[loop[1]], points[loop[2]]) != 0;
  return Convex_parts{clockwise ? Contour::self_intersecting : Contour::zero_area, {}};
}

// ---- The contour in a triangulation of its points

struct Vertex_number {
  std::uint32_t value = none;  // place in the list of sites
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

/// Inserts the sites along a space-filling curve: the order matters for speed only, so rounded coordinates will do.
/// Returns the vertex of each; sites in one place have one, which knows the first of them.
std::vector<Triangulation::Vertex_handle> insert_points(Triangulation& triangulation, const std::vector<Site>& sites) {
  using Rounded = CGAL::Simple_cartesian<double>;
  std::vector<Rounded::Point_2> rounded(sites.size());
  std::vector<std::size_t> order(sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    order[i] = i;
    rounded[i] = Rounded::Point_2(sites[i].x.inf(), sites[i].y.inf());
  }
  CGAL::spatial_sort(order.begin(), order.end(),
                     CGAL::Spatial_sort_traits_adapter_2<Rounded, CGAL::Pointer_property_map<Rounded::Point_2>::type>(
                         CGAL::make_property_map(rounded)));
  std::vector<Triangulation::Vertex_handle> vertex(sites.size());
  Triangulation::Face_handle near;
  for (const std::size_t i : order) {
    Triangulation::Locate_type type = Triangulation::OUTSIDE_AFFINE_HULL;
    int place = 0;
    const Triangulation::Face_handle at = triangulation.locate(sites[i], type, place, near);
    // CGAL inserts what is there, too, and then looks at all edges of it.
    vertex[i] = type == Triangulation::VERTEX && triangulation.dimension() > 0
                    ? at->vertex(place)
                    : triangulation.insert(sites[i], type, at, place);
    vertex[i]->info().value = std::min(vertex[i]->info().value, static_cast<std::uint32_t>(i));
    near = vertex[i]->face();
  }
  return vertex;
}

/// An edge of the contour, from the end that is on fewer edges: CGAL turns about that one to find it. `times`: how
/// often the contour runs along it that way, less the other way.
struct Edge {
  Triangulation::Vertex_handle from, to;
  int times;
};
using Edges = std::vector<Edge>;

/// The contour's edges, each once: those that close a loop come last.
Edges edges_of(const std::vector<Loop>& contour, const std::vector<std::uint32_t>& used,
               const std::vector<Triangulation::Vertex_handle>& vertex) {
  // 1. The vertices of each run along an edge.
  const auto vertex_of = [&](std::uint32_t p) {
    const auto place = std::lower_bound(used.begin(), used.end(), p);
    return vertex[static_cast<std::size_t>(place - used.begin())];
  };
  Edges runs;
  for (const Loop& loop : contour)
    for (std::size_t i = 0; i + 1 < loop.size(); ++i) runs.push_back({vertex_of(loop[i]), vertex_of(loop[i + 1]), 1});
  for (const Loop& loop : contour)
    if (loop.size() > 1) runs.push_back({vertex_of(loop.back()), vertex_of(loop.front()), 1});

  // 2. Each edge once, where it is first.
  std::vector<std::uint32_t> uses(vertex.size());
  for (const Edge& run : runs)
    for (const Triangulation::Vertex_handle v : {run.from, run.to}) ++uses[v->info().value];
  std::map<std::array<std::uint32_t, 2>, std::size_t> places;
  Edges edges;
  for (Edge run : runs) {
    std::uint32_t from = run.from->info().value, to = run.to->info().value;
    if (uses[to] < uses[from] || (uses[to] == uses[from] && places.contains({to, from}))) {
      std::swap(run.from, run.to);
      std::swap(from, to);
      run.times = -1;
    }
    const auto [at, is_new] = places.try_emplace({from, to}, edges.size());
    if (is_new) edges.push_back(run);
    else edges[at->second].times += run.times;
  }
  return edges;
}

/// Forces the edges into the triangulation. All points are there already, so only a crossing elsewhere can stop it:
/// then false.
bool force(Triangulation& triangulation, const Edges& edges) {
  try {
    for (const Edge& edge : edges) triangulation.insert_constraint(edge.from, edge.to);
  } catch (const Triangulation::Intersection_of_constraints_exception&) {
    return false;
  }
  return true;
}

/// Numbers the triangles, the infinite ones too.
std::vector<Triangulation::Face_handle> numbered_faces(Triangulation& triangulation) {
  std::vector<Triangulation::Face_handle> faces;
  for (auto f = triangulation.all_faces_begin(); f != triangulation.all_faces_end(); ++f) {
    f->info().value = static_cast<std::uint32_t>(faces.size());
    faces.push_back(f);
  }
  return faces;
}

/// How often the contour has each triangle on its left, along each side: +1 forth, -1 back.
std::vector<std::array<int, 3>> count_runs(const Triangulation& triangulation, const Edges& edges, std::size_t faces) {
  std::vector<std::array<int, 3>> runs(faces, {0, 0, 0});
  for (const Edge& edge : edges)
    for (Triangulation::Vertex_handle a = edge.from, b = edge.to; a != b;) {
      Triangulation::Vertex_handle stop;
      Triangulation::Face_handle f;
      int i = 0;
      if (!triangulation.includes_edge(a, b, stop, f, i))
        throw std::logic_error("convex_parts: a contour edge is not in its triangulation");
      const bool is_along = f->vertex(Triangulation::ccw(i)) == a;  // side i of f runs from ccw(i) to cw(i)
      const int sense = is_along ? edge.times : -edge.times;
      const Triangulation::Face_handle g = f->neighbor(i);
      runs[f->info().value][static_cast<std::size_t>(i)] += sense;
      runs[g->info().value][static_cast<std::size_t>(triangulation.mirror_index(f, i))] -= sense;
      a = stop;
    }
  return runs;
}

/// Spreads the winding numbers from the outside: one more on the left of each run than on its right. Returns which
/// triangles have 1, or nothing where one has neither 0 nor 1.
std::optional<std::vector<bool>> wound_once(const Triangulation& triangulation,
                                            const std::vector<Triangulation::Face_handle>& faces,
                                            const std::vector<std::array<int, 3>>& runs) {
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
      if (winding[g] != 0 && winding[g] != 1) return std::nullopt;
      to_visit.push_back(g);
    }
  }
  std::vector<bool> once(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) once[f] = winding[f] == 1;
  return once;
}

// ---- Pieces

/// The chosen triangles, a ring each. `across_contour`: whether triangles on both sides of an edge that the contour
/// walks there and back are neighbours.
Pieces rings_of(const Triangulation& triangulation, const std::vector<Triangulation::Face_handle>& faces,
                const std::vector<bool>& chosen, const std::vector<Site>& sites, bool across_contour) {
  std::vector<std::uint32_t> place(faces.size(), none);
  std::uint32_t count = 0;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (chosen[f]) place[f] = count++;
  const std::size_t sides = 3 * std::size_t{count};
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
      if (g != none && (across_contour || !faces[f]->is_constrained(i)))
        pieces.twin[h] = 3 * g + static_cast<std::uint32_t>(triangulation.mirror_index(faces[f], i));
    }
  }
  return pieces;
}

/// Each ring, a convex polygon, as triangles from its least corner.
std::vector<Loop> fanned(std::vector<Loop> rings) {
  std::vector<Loop> triangles;
  for (Loop& ring : rings) {
    ring = from_least(std::move(ring));
    for (std::size_t i = 2; i < ring.size(); ++i) triangles.push_back({ring[0], ring[i - 1], ring[i]});
  }
  return triangles;
}

/// The rings in lexicographic order, by indices of points.
std::vector<Loop> named(std::vector<Loop> rings, const std::vector<std::uint32_t>& used) {
  for (Loop& ring : rings) {
    for (std::uint32_t& corner : ring) corner = used[corner];
    ring = from_least(std::move(ring));
  }
  std::sort(rings.begin(), rings.end());
  return rings;
}

/// convex_parts() and triangles().
Convex_parts cut(std::span<const Planar_point> points, std::span<const Loop> loops, bool merge) {
  const std::vector<Loop> contour = cleaned(points, loops);
  if (loops.size() == 1)
    if (std::optional<Convex_parts> parts = at_a_glance(points, loops[0], contour[0], merge)) return *std::move(parts);
  const std::vector<std::uint32_t> used = used_by(loops);
  if (used.size() < 3) return {};

  const std::vector<Site> sites = planar::sites_of(points, used);
  Triangulation triangulation;
  const std::vector<Triangulation::Vertex_handle> vertex = insert_points(triangulation, sites);
  if (triangulation.dimension() < 2) return {};  // all points on a line

  const Convex_parts crossed{Contour::self_intersecting, {}};
  const Edges edges = edges_of(contour, used, vertex);
  if (!force(triangulation, edges)) return crossed;
  const std::vector<Triangulation::Face_handle> faces = numbered_faces(triangulation);
  const std::optional<std::vector<bool>> inside =
      wound_once(triangulation, faces, count_runs(triangulation, edges, faces.size()));
  if (!inside) return crossed;
  if (std::find(inside->begin(), inside->end(), true) == inside->end()) return {};

  Pieces pieces = rings_of(triangulation, faces, *inside, sites, merge);
  if (merge) {
    pieces.merge();
    return {Contour::simple, named(pieces.loops(false), used)};
  }
  pieces.merge_circles();
  return {Contour::simple, named(fanned(pieces.loops(true)), used)};
}

}  // namespace

Convex_parts convex_parts(std::span<const Planar_point> points, std::span<const std::vector<std::uint32_t>> loops) {
  return cut(points, loops, true);
}

Convex_parts triangles(std::span<const Planar_point> points, std::span<const std::vector<std::uint32_t>> loops) {
  return cut(points, loops, false);
}

}  // namespace sightline
