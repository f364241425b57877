// To be read after polygons.h and verdict.h, from top to bottom: a face and its boundary; when a face may be left out;
// tilings; and last the check itself, step by step.

#include <sightline/algorithms/verify/covering.h>

#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/kernel/number.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

namespace sightline {
namespace certificate_check {
namespace {

// ---- Faces and their boundaries

/// A face of the soup as points: consecutive repetitions dropped, holes turned so that they run against the outer loop.
struct Face {
  std::vector<Polygon> loops;
  bool planar = true;
  bool has_front = false;  // the outer loop's Newell normal is not zero
  Plane plane;  // of a planar face; if it has no front, either side of its plane; if all points are collinear, zero

  Face(const Polygon_soup& soup, Face_id f);

  std::size_t corner_count() const {
    std::size_t count = 0;
    for (const Polygon& loop : loops) count += loop.size();
    return count;
  }

 private:
  Integer_vector some_normal() const;
};

Face::Face(const Polygon_soup& soup, Face_id f) {
  for (std::size_t k = 0; k < soup.loop_count(f); ++k) {
    Polygon loop;
    for (const Point_id p : soup.loop(f, k))
      if (Exact_point point = soup.point(p); loop.empty() || point != loop.back()) loop.push_back(std::move(point));
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    loops.push_back(std::move(loop));
  }
  if (loops[0].empty()) return;
  plane = {newell_normal(loops[0]), loops[0][0]};
  has_front = !is_zero(plane.normal);
  if (!has_front) plane.normal = some_normal();
  for (std::size_t k = 0; k < loops.size(); ++k) {
    if (k > 0 && has_front && sgn(dot(plane.normal, newell_normal(loops[k]))) > 0)
      std::reverse(loops[k].begin(), loops[k].end());
    for (const Exact_point& p : loops[k]) planar = planar && plane.side(p) == 0;
  }
}

Integer_vector Face::some_normal() const {  // of the first three points that are not collinear
  std::vector<Exact_point> arms;
  for (const Polygon& loop : loops)
    for (const Exact_point& p : loop) {
      if (p == loops[0][0]) continue;
      arms.push_back(minus(p, loops[0][0]));
      const Integer_vector normal = primitive(cross(arms.front(), arms.back()));
      if (!is_zero(normal)) return normal;
    }
  return {};
}

/// A sum of directed segments as a chain: two sums are the same chain iff on each line, at each point, the net number
/// of arrivals is the same. A line through a known point is its direction, so the key is (direction up to sign, point).
/// Proof: P-21b
class Boundary_chain {
 public:
  void add(const Polygon& loop, long multiplicity);
  void add(const Face& face, long multiplicity) {
    for (const Polygon& loop : face.loops) add(loop, multiplicity);
  }
  /// A point where the chain is not zero, if there is one.
  std::optional<Exact_point> nonzero() const;

 private:
  std::map<std::pair<Integer_vector, Exact_point>, long> arrivals_;
};

void Boundary_chain::add(const Polygon& loop, long multiplicity) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Exact_point &from = loop[i], &to = loop[(i + 1) % loop.size()];
    Integer_vector direction = primitive(minus(to, from));
    if (direction < Integer_vector{}) direction = negated(direction);
    arrivals_[{direction, to}] += multiplicity;
    arrivals_[{direction, from}] -= multiplicity;
  }
}

std::optional<Exact_point> Boundary_chain::nonzero() const {
  for (const auto& [place, count] : arrivals_)
    if (count != 0) return place.second;
  return std::nullopt;
}

// ---- Faces that are not drawn

/// Whether two edges of a planar face cross in a point inside both, or its winding number is neither 0 nor 1 somewhere.
/// Where no edges cross so, a sweep between neighbouring abscissae of vertices meets every cell.
/// Pre: planar, not all points collinear. Cost: quadratic in the corners. Proof: P-21d
bool self_intersecting(const Face& face) {
  // Edges seen from the front, as if a coordinate plane were the face's.
  using Point = std::array<Rational, 2>;
  std::size_t drop = 0;
  while (sgn(face.plane.normal[drop]) == 0) ++drop;
  std::size_t x = (drop + 1) % 3, y = (drop + 2) % 3;
  if (sgn(face.plane.normal[drop]) < 0) std::swap(x, y);
  std::vector<std::pair<Point, Point>> edges;
  std::set<Rational> abscissae;
  for (const Polygon& loop : face.loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Exact_point &from = loop[i], &to = loop[(i + 1) % loop.size()];
      edges.push_back({{from[x], from[y]}, {to[x], to[y]}});
      abscissae.insert(from[x]);
    }

  const auto side = [](const std::pair<Point, Point>& e, const Point& p) {
    return sgn(
        Rational((e.second[0] - e.first[0]) * (p[1] - e.first[1]) - (e.second[1] - e.first[1]) * (p[0] - e.first[0])));
  };
  for (auto e = edges.begin(); e != edges.end(); ++e)
    for (auto f = edges.begin(); f != e; ++f)
      if (side(*e, f->first) * side(*e, f->second) < 0 && side(*f, e->first) * side(*f, e->second) < 0) return true;

  // Between neighbouring abscissae the edges do not cross: add up the winding number from below on a line in the
  // middle.
  for (auto left = abscissae.begin(), right = std::next(left); right != abscissae.end(); ++left, ++right) {
    const Rational middle = (*left + *right) / 2;
    std::map<Rational, int> steps;
    for (const auto& [from, to] : edges)
      if (std::min(from[0], to[0]) < middle && middle < std::max(from[0], to[0])) {
        const Rational height = from[1] + (to[1] - from[1]) * (middle - from[0]) / (to[0] - from[0]);
        steps[height] += from[0] < to[0] ? 1 : -1;
      }
    int winding = 0;
    for (const auto& [height, step] : steps) {
      winding += step;
      if (winding != 0 && winding != 1) return true;
    }
  }
  return false;
}

/// Whether two closed sequences of points are the same up to the place where they begin.
bool same_cycle(const Polygon& a, const Polygon& b) {
  if (a.size() != b.size()) return false;
  Polygon twice = a;
  twice.insert(twice.end(), a.begin(), a.end());
  return std::search(twice.begin(), twice.end(), b.begin(), b.end()) != twice.end();
}

// ---- Tilings

/// A polygon that should be part of a tiling, with its name for messages and its place in the order, if it has one.
struct Tile {
  const Polygon* polygon;
  std::string name;
  std::vector<std::size_t> fragments;
};

/// Rejects unless the tiles are convex polygons in the plane that cover once what `target` bounds, and nothing else.
/// `winds_once`: the target is known to be the boundary of a set, taken once. Proof: P-21
void check_tiling(const std::string& what, Boundary_chain target, const Plane& plane, bool winds_once,
                  const std::vector<Tile>& tiles) {
  if (tiles.empty()) reject(what + " has no fragment and is not set aside");
  for (const Tile& tile : tiles) {
    if (const std::string fault = not_convex(*tile.polygon, plane); !fault.empty())
      reject(tile.name + " of " + what + " " + fault, tile.fragments);
    target.add(*tile.polygon, -1);
  }
  if (const auto point = target.nonzero())
    reject(what + " is not tiled by its parts: boundaries do not cancel near " + name(*point));
  if (winds_once) return;
  Exact_point eye = plane.origin;
  for (std::size_t k = 0; k < 3; ++k) eye[k] += plane.normal[k];
  std::vector<Cone> cones;
  for (const Tile& tile : tiles) cones.emplace_back(*tile.polygon, eye);
  for (std::size_t j = 0; j < tiles.size(); ++j)
    for (std::size_t i = 0; i < j; ++i)
      if (!separates(cones[i], cones[j]) && !separates(cones[j], cones[i])) {  // in one plane that is an overlap
        std::vector<std::size_t> both = tiles[i].fragments;
        both.insert(both.end(), tiles[j].fragments.begin(), tiles[j].fragments.end());
        reject(tiles[i].name + " and " + tiles[j].name + " of " + what + " overlap", both);
      }
}

/// Rejects unless the pieces make a surface on the face's own vertices that its loops bound. Proof: P-22
void check_pieces(const std::string& what, const Face& face, const std::vector<Tile>& pieces) {
  std::set<Exact_point> own;
  for (const Polygon& loop : face.loops) own.insert(loop.begin(), loop.end());
  Boundary_chain difference;
  difference.add(face, 1);
  std::size_t triangles = 0;
  for (const Tile& piece : pieces) {
    for (const Exact_point& p : *piece.polygon)
      if (!own.count(p)) reject(piece.name + " of " + what + " has a vertex that is not one of the face's");
    if (face.planar) continue;
    if (piece.polygon->empty()) reject(piece.name + " of " + what + " is empty");
    const Plane plane{newell_normal(*piece.polygon), piece.polygon->front()};
    if (is_zero(plane.normal)) reject(piece.name + " of " + what + " has zero area");
    if (const std::string fault = not_convex(*piece.polygon, plane); !fault.empty())
      reject(piece.name + " of " + what + " " + fault);
    difference.add(*piece.polygon, -1);
    triangles += piece.polygon->size() - 2;
  }
  if (face.planar) {
    check_tiling(what, difference, face.plane, false, pieces);
    return;
  }
  if (const auto point = difference.nonzero())
    reject(what + " is not bounded as its pieces are: boundaries do not cancel near " + name(*point));
  // As many triangles as a polygon with holes has; fewer only where zero-area ones were left out, which holes forbid.
  const std::size_t holes = face.loops.size() - 1, most = face.corner_count() + 2 * holes - 2;
  if (triangles > most || (holes > 0 && triangles < most))
    reject(what + " has the wrong number of pieces for its corners");
}

/// Rejects unless the reason holds.
void check_set_aside(const Polygon_soup& soup, const Covering::Set_aside& entry, const std::set<Face_id>& set_aside) {
  const std::string what = name("face", entry.face);
  const std::string_view why = entry.why;
  const Face face(soup, entry.face);
  Boundary_chain boundary, outer;
  boundary.add(face, 1);
  outer.add(face.loops[0], 1);
  const bool no_area = !boundary.nonzero() || !outer.nonzero();
  if (why.starts_with("zero area")) {
    if (!no_area) reject(what + " is set aside for zero area but has area");
  } else if (why.starts_with("self-intersecting")) {
    if (!face.planar) reject(what + " is set aside as self-intersecting but is not planar");
    if (is_zero(face.plane.normal) || !self_intersecting(face))
      reject(what + " is set aside as self-intersecting but is not");
  } else if (constexpr std::string_view words = "duplicate of "; why.starts_with(words)) {
    std::uint64_t original = 0;
    std::size_t digits = 0;
    for (const char c : why.substr(words.size())) {
      if (c < '0' || c > '9') break;
      original = std::min(10 * original + static_cast<std::uint64_t>(c - '0'), std::uint64_t{1} << 32);
      ++digits;
    }
    if (digits == 0 || original >= entry.face)
      reject(what + " is set aside as a duplicate, but not of an earlier face");
    const Face_id f = static_cast<Face_id>(original);
    if (set_aside.count(f))
      reject(what + " is set aside as a duplicate of face " + std::to_string(f) + ", which is set aside itself");
    const Face other(soup, f);
    if (!std::equal(face.loops.begin(), face.loops.end(), other.loops.begin(), other.loops.end(), same_cycle))
      reject(what + " is set aside as a duplicate of face " + std::to_string(f) + " but differs from it");
  } else {
    reject(what + " is set aside for no reason that can be checked");
  }
}

}  // namespace

void check_covering(const Polygon_soup& soup, const Covering& covering, const Exact_point* eye) {
  const auto left_out = [&](const Plane& plane, const std::vector<Tile>& tiles) {
    return eye != nullptr && tiles.empty() && plane.side(*eye) <= 0;
  };
  // 1. Everything refers to something, once, and is a number.
  const auto in_scene = [&](const std::string& what, Face_id face) {
    if (face >= soup.face_count())
      reject(what + " names face " + std::to_string(face) + ", which the scene does not have");
  };
  for (Face_id f = 0; f < soup.face_count(); ++f)
    for (std::size_t k = 0; k < soup.loop_count(f); ++k)
      for (const Point_id p : soup.loop(f, k))
        if (p >= soup.point_count()) reject("the scene's " + name("face", f) + " names a point that it does not have");
  std::set<Face_id> set_aside;
  for (const auto& entry : covering.set_aside) {
    in_scene("set_aside", entry.face);
    if (!set_aside.insert(entry.face).second) reject(name("face", entry.face) + " is set aside twice");
  }
  std::vector<std::map<std::uint32_t, const Polygon*>> pieces(soup.face_count());
  for (std::size_t i = 0; i < covering.pieces.size(); ++i) {
    const auto& piece = covering.pieces[i];
    in_scene(name("piece", i), piece.face);
    if (!canonical(piece.vertices)) reject(name("piece", i) + " has a vertex that is not in canonical numbers");
    if (set_aside.count(piece.face)) reject(name("face", piece.face) + " is set aside but has pieces");
    if (!pieces[piece.face].emplace(piece.piece, &piece.vertices).second)
      reject(name("face", piece.face) + " has " + name("piece", piece.piece) + " twice");
  }
  std::vector<std::map<std::uint32_t, std::vector<Tile>>> tiles(
      soup.face_count());  // by face, then by piece where it has such
  for (std::size_t i = 0; i < covering.fragments.size(); ++i) {
    const Order_fragment& fragment = covering.fragments[i];
    in_scene(name("fragment", i), fragment.face);
    if (!canonical(fragment.vertices))
      reject(name("fragment", i) + " has a vertex that is not in canonical numbers", {i});
    if (set_aside.count(fragment.face)) reject(name("face", fragment.face) + " is set aside but drawn", {i});
    const auto& own = pieces[fragment.face];
    if (!own.empty() && !own.count(fragment.piece))
      reject(name("fragment", i) + " is of a piece that its face does not have", {i});
    tiles[fragment.face][own.empty() ? 0 : fragment.piece].push_back({&fragment.vertices, name("fragment", i), {i}});
  }

  // 2. Nothing is lost and nothing is drawn twice.
  for (const auto& entry : covering.set_aside) check_set_aside(soup, entry, set_aside);
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    if (set_aside.count(f)) continue;
    const std::string what = name("face", f);
    const Face face(soup, f);
    if (pieces[f].empty()) {
      if (!face.planar) reject(what + " is not planar and has no pieces");
      if (!face.has_front) reject(what + " has no front and is not set aside");
      Boundary_chain contour;
      contour.add(face, 1);
      const bool winds_once = face.loops.size() == 1 && not_convex(face.loops[0], face.plane).empty();
      if (!left_out(face.plane, tiles[f][0])) check_tiling(what, contour, face.plane, winds_once, tiles[f][0]);
      continue;
    }
    if (face.planar && !face.has_front) reject(what + " has no front and is not set aside");
    std::vector<Tile> parts;
    for (const auto& [number, polygon] : pieces[f]) parts.push_back({polygon, name("piece", number), {}});
    check_pieces(what, face, parts);
    for (const auto& [number, polygon] : pieces[f]) {
      Boundary_chain contour;
      contour.add(*polygon, 1);
      const Plane plane{newell_normal(*polygon), polygon->front()};
      if (!left_out(plane, tiles[f][number]))
        check_tiling(what + ", " + name("piece", number), contour, plane, true, tiles[f][number]);
    }
  }
}

}  // namespace certificate_check
}  // namespace sightline
