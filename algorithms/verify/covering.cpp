// To be read after polygons.h, verdict.h, faces.h, surface.h and set_aside.h, from top to bottom: tilings, then the
// check itself, step by step.

#include <sightline/algorithms/verify/covering.h>

#include <sightline/algorithms/verify/contour.h>
#include <sightline/algorithms/verify/faces.h>
#include <sightline/algorithms/verify/numbered_points.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/set_aside.h>
#include <sightline/algorithms/verify/surface.h>
#include <sightline/algorithms/verify/verdict.h>
#include <sightline/kernel/number.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <map>
#include <span>
#include <set>
#include <string>
#include <vector>

namespace sightline::certificate_check {
namespace {

// ---- Tilings

using Corner_numbers = std::span<const Numbered_points::Number>;

/// A polygon that should be part of a tiling, with its name for messages and its place in the order, if it has one.
struct Tile {
  const Polygon* polygon;
  std::string name;
  std::vector<std::size_t> fragments;
  Corner_numbers corners;
};

/// The points that numbers of corners name.
struct Corner_points {
  const Numbered_points& numbered;
  std::vector<Homogeneous> in_integers;

  /// Pre: each was given a number.
  std::vector<Numbered_points::Number> numbers_of(const Polygon& polygon) const {
    std::vector<Numbered_points::Number> numbers;
    numbers.reserve(polygon.size());
    for (const Exact_point& p : polygon) numbers.push_back(numbered.find(p).value());
    return numbers;
  }
};

bool is_turned_polygon(Corner_numbers a, Corner_numbers b) {
  if (a.size() != b.size()) return false;
  const auto begin = static_cast<std::size_t>(std::find(b.begin(), b.end(), a.front()) - b.begin());
  for (std::size_t i = 0; i < a.size(); ++i)
    if (begin == b.size() || a[i] != b[(begin + i) % b.size()]) return false;
  return true;
}

/// Rejects unless the tiles are convex polygons in the plane that cover once what the loops bound, and nothing else,
/// and the loops cross nowhere else than in points of theirs. Pre: no loop is empty. Proof: P-21
void check_tiling(const std::string& what, const std::vector<Polygon>& loops, const Plane& plane,
                  const std::vector<Tile>& tiles, const Corner_points& points) {
  if (tiles.empty()) reject(what + " has no fragment and is not set aside");
  const Homogeneous front = plane_of(plane);
  for (const Tile& tile : tiles)
    if (const std::string fault = not_convex(each_of(points.in_integers, tile.corners), front); !fault.empty())
      reject(tile.name + " of " + what + " " + fault, tile.fragments);
  std::vector<std::vector<Numbered_points::Number>> corners;
  for (const Polygon& loop : loops) corners.push_back(points.numbers_of(loop));
  if (tiles.size() == 1 && loops.size() == 1 && is_turned_polygon(corners[0], tiles[0].corners)) return;

  Numbered_chain left;
  for (const Corner_numbers loop : corners) left.add(loop, 1);
  for (const Tile& tile : tiles) left.add(tile.corners, -1);
  if (const auto point = left.nonzero(points.numbered, points.in_integers))
    reject(what + " is not tiled by its parts: boundaries do not cancel near " + name(*point));
  const bool winds_once = loops.size() == 1 && not_convex(each_of(points.in_integers, corners[0]), front).empty();
  if (winds_once) return;
  // Boundaries cancel, so that a point is in as many tiles as the loops wind round it. Many tiles are not looked at in
  // pairs, unless to name two of them.
  const Contour contour = seen_from_front(loops, plane);
  if (tiles.size() > contour.edges.size()) {
    if (contour.crosses_itself()) reject(what + " crosses itself and is not set aside");
    if (contour.winding() == Contour::Winding::once) return;
  }
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
  if (contour.crosses_itself())  // what a spike crosses does not show in the chain
    reject(what + " crosses itself and is not set aside");
}

/// Rejects unless the pieces are the face: of one that is planar a tiling on its own vertices, else its surface.
/// Proof: P-22
void check_pieces(const std::string& what, const Face& face, const std::vector<Tile>& pieces,
                  const Corner_points& points) {
  if (!face.planar) {
    std::vector<Surface_piece> surface;
    for (const Tile& piece : pieces) surface.push_back({piece.polygon, piece.name});
    check_surface(what, face, surface);
    return;
  }
  std::set<Exact_point> own;
  for (const Polygon& loop : face.loops) own.insert(loop.begin(), loop.end());
  for (const Tile& piece : pieces)
    for (const Exact_point& p : *piece.polygon)
      if (!own.count(p)) reject(piece.name + " of " + what + " has a vertex that is not one of the face's");
  check_tiling(what, face.loops, face.plane, pieces, points);
}

}  // namespace

std::string Covered::text() const {
  return std::to_string(set_aside) + " faces set aside, " + std::to_string(not_planar) + " not planar";
}

Covered check_covering(const Polygon_soup& soup, const Covering& covering, const Workers& workers,
                       const Exact_point* eye, const std::vector<bool>& known, Numbered_polygons* numbered,
                       const Covering_places* places) {
  constexpr std::size_t faces_worth_a_thread = 100, points_worth_a_thread = 1000;
  const auto left_out = [&](const Plane& plane, const std::vector<Tile>& tiles) {
    return eye != nullptr && tiles.empty() && plane.side(*eye) <= 0;
  };
  const auto fragment_name = [&](std::size_t i) {
    return name("fragment", places == nullptr ? i : places->fragments[i]);
  };
  const auto piece_name = [&](std::size_t i) { return name("piece", places == nullptr ? i : places->pieces[i]); };
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
  std::vector<std::map<std::uint32_t, std::size_t>> pieces(soup.face_count());  // by number, their places
  for (std::size_t i = 0; i < covering.pieces.size(); ++i) {
    const auto& piece = covering.pieces[i];
    in_scene(piece_name(i), piece.face);
    if (!canonical(piece.vertices)) reject(piece_name(i) + " has a vertex that is not in canonical numbers");
    if (set_aside.count(piece.face)) reject(name("face", piece.face) + " is set aside but has pieces");
    if (!pieces[piece.face].emplace(piece.piece, i).second)
      reject(name("face", piece.face) + " has " + name("piece", piece.piece) + " twice");
  }
  Numbered_polygons own_numbered;
  Numbered_polygons& corners = numbered != nullptr ? *numbered : own_numbered;
  std::vector<char> in_canonical_numbers;  // points of fragments
  for (const Order_fragment& fragment : covering.fragments) {
    corners.add(fragment.vertices);
    while (in_canonical_numbers.size() < corners.points().size())
      in_canonical_numbers.push_back(
          canonical(corners.points()[static_cast<Numbered_points::Number>(in_canonical_numbers.size())]));
  }
  for (const Covering::Piece& piece : covering.pieces) corners.add(piece.vertices);
  std::vector<std::map<std::uint32_t, std::vector<Tile>>> tiles(
      soup.face_count());  // by face, then by piece where it has such
  for (std::size_t i = 0; i < covering.fragments.size(); ++i) {
    const Order_fragment& fragment = covering.fragments[i];
    in_scene(fragment_name(i), fragment.face);
    if (!std::all_of(corners[i].begin(), corners[i].end(),
                     [&](Numbered_points::Number p) { return in_canonical_numbers[p] != 0; }))
      reject(fragment_name(i) + " has a vertex that is not in canonical numbers", {i});
    if (set_aside.count(fragment.face)) reject(name("face", fragment.face) + " is set aside but drawn", {i});
    const auto& own = pieces[fragment.face];
    if (!own.empty() && !own.count(fragment.piece))
      reject(fragment_name(i) + " is of a piece that its face does not have", {i});
    tiles[fragment.face][own.empty() ? 0 : fragment.piece].push_back(
        {&fragment.vertices, fragment_name(i), {i}, corners[i]});
  }

  // 2. Nothing is lost and nothing is drawn twice.
  const auto is_known = [&](Face_id f) { return !known.empty() && known[f]; };
  std::vector<bool> is_added(soup.point_count());
  for (Face_id f = 0; f < soup.face_count(); ++f)
    for (std::size_t k = 0; k < soup.loop_count(f) && !is_known(f); ++k)
      for (const Point_id p : soup.loop(f, k)) {
        if (!is_added[p]) corners.add_point(soup.point(p));
        is_added[p] = true;
      }
  Corner_points points{corners.points(), std::vector<Homogeneous>(corners.points().size())};
  for_each_below(points.in_integers.size(), points_worth_a_thread, workers, [&](std::size_t i) {
    points.in_integers[i] = homogeneous(points.numbered[static_cast<Numbered_points::Number>(i)]);
  });
  Covered covered;
  for (const auto& entry : covering.set_aside) check_set_aside(soup, entry, set_aside);
  covered.set_aside = set_aside.size();
  std::atomic<std::size_t> not_planar = 0;
  for_each_below(soup.face_count(), faces_worth_a_thread, workers, [&](std::size_t place) {
    const auto f = static_cast<Face_id>(place);
    if (set_aside.count(f) || is_known(f)) return;
    const std::string what = name("face", f);
    const Face face(soup, f);
    not_planar += !face.planar;
    if (pieces[f].empty()) {
      if (!face.planar) reject(what + " is not planar and has no pieces");
      if (!face.has_front) reject(what + " has no front and is not set aside");
      if (!left_out(face.plane, tiles[f][0])) check_tiling(what, face.loops, face.plane, tiles[f][0], points);
      return;
    }
    if (face.planar && !face.has_front) reject(what + " has no front and is not set aside");
    std::vector<Tile> parts;
    for (const auto& [number, i] : pieces[f])
      parts.push_back(
          {&covering.pieces[i].vertices, name("piece", number), {}, corners[covering.fragments.size() + i]});
    check_pieces(what, face, parts, points);
    for (const auto& [number, i] : pieces[f]) {
      const Polygon& polygon = covering.pieces[i].vertices;
      const Plane plane{newell_normal(polygon), polygon.front()};
      if (!left_out(plane, tiles[f][number]))
        check_tiling(what + ", " + name("piece", number), {polygon}, plane, tiles[f][number], points);
    }
  });
  covered.not_planar = not_planar;
  return covered;
}

}  // namespace sightline::certificate_check
