#include <sightline/harness/laws/line_flats.h>

#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cstddef>

namespace sightline::harness::line_flats {

using generate::Points;

bool Flat_piece::is_in_plane_of(const Flat_piece& other) const {
  return std::all_of(corners.begin(), corners.end(), [&](const Exact_point& p) { return other.plane.height(p) == 0; });
}

Exact_point between(const Exact_point& p, const Rational& t, const Exact_point& q) {
  return generate::along(p, t, minus(q, p));
}

Flat_pieces flat_pieces(const Scene& scene) {
  Flat_pieces flats;
  for (const Piece& piece : scene.pieces()) {
    Flat_piece flat{scene.corner_points(piece), {}, {}, piece.face};
    const Points& c = flat.corners;
    flat.plane.normal = cross(minus(c[1], c[0]), minus(c[2], c[0]));
    flat.plane.offset = dot(flat.plane.normal, c[0]);
    for (std::size_t k = 0; k < c.size(); ++k) {
      const Exact_point inward = cross(flat.plane.normal, minus(c[(k + 1) % c.size()], c[k]));
      flat.walls.push_back({inward, dot(inward, c[k])});
    }
    flats.push_back(std::move(flat));
  }
  return flats;
}

std::optional<Interval> clipped(const std::vector<Level>& walls, const Exact_point& p, const Exact_point& q,
                                Interval range, bool touches) {
  auto& [least, most] = range;
  for (const Level& wall : walls) {
    const Rational at = wall.height(p), rise = Rational(wall.height(q) - at);
    if (rise == 0 && at < 0) return std::nullopt;
    if (rise > 0) least = std::max(least, Rational(-at / rise));
    if (rise < 0) most = std::min(most, Rational(-at / rise));
  }
  if (least < most || (touches && least == most)) return range;
  return std::nullopt;
}

bool is_within_walls(const Flat_piece& flat, const Exact_point& x) {
  return std::all_of(flat.walls.begin(), flat.walls.end(), [&](const Level& wall) { return wall.height(x) >= 0; });
}

bool blocks(const Flat_piece& flat, const Exact_point& p, const Exact_point& q) {
  const Rational from = flat.plane.height(p), to = flat.plane.height(q);
  if (from == 0 && to == 0) {
    const std::optional<Interval> common = clipped(flat.walls, p, q, {0, 1}, true);
    return common && common->first < 1 && common->second > 0;
  }
  if (from * to >= 0) return false;
  const Exact_point at = between(p, Rational(from / (from - to)), q);
  return is_within_walls(flat, at);
}

bool is_sightline(const Flat_pieces& flats, const Exact_point& p, const Exact_point& q) {
  return std::none_of(flats.begin(), flats.end(), [&](const Flat_piece& flat) { return blocks(flat, p, q); });
}

std::set<Face_id> crossing_at(const Flat_pieces& flats, const Exact_point& x, const Exact_point& direction) {
  std::vector<std::size_t> around;
  for (std::size_t i = 0; i < flats.size(); ++i)
    if (flats[i].plane.height(x) == 0 && dot(flats[i].plane.normal, direction) == 0) around.push_back(i);
  std::set<Face_id> faces;
  std::size_t planes = 0;
  for (const std::size_t i : around) {
    const auto together = [&](std::size_t k) { return flats[k].is_in_plane_of(flats[i]); };
    if (*std::find_if(around.begin(), around.end(), together) != i) continue;
    std::array<std::set<Face_id>, 2> beside;
    for (std::size_t side = 0; side < 2; ++side) {
      Exact_point to = cross(direction, flats[i].plane.normal);
      if (side == 1) to = minus({0, 0, 0}, to);
      for (const std::size_t k : around) {
        const auto keeps = [&](const Level& wall) {
          const Rational at = wall.height(x);
          return at > 0 || (at == 0 && dot(wall.normal, to) >= 0);
        };
        if (together(k) && std::all_of(flats[k].walls.begin(), flats[k].walls.end(), keeps))
          beside[side].insert(flats[k].face);
      }
    }
    if (beside[0].empty() || beside[1].empty()) continue;
    ++planes;
    for (const auto& some : beside) faces.insert(some.begin(), some.end());
  }
  return planes < 2 ? std::set<Face_id>() : faces;
}

std::optional<std::array<Exact_point, 2>> common_segment(const Flat_piece& f, const Flat_piece& g) {
  std::vector<Exact_point> on;  // where f's edges meet g's plane
  const auto at = [](const Flat_piece& of, std::size_t k) { return of.corners[k % of.corners.size()]; };
  for (std::size_t k = 0; k < f.corners.size(); ++k) {
    const Exact_point p = at(f, k), q = at(f, k + 1);
    const Rational from = g.plane.height(p), to = g.plane.height(q);
    if (from == 0) on.push_back(p);
    if (from * to < 0) on.push_back(between(p, Rational(from / (from - to)), q));
  }
  if (on.size() != 2) return std::nullopt;
  const std::optional<Interval> common = clipped(g.walls, on[0], on[1], {0, 1});
  if (!common) return std::nullopt;
  return std::array{between(on[0], common->first, on[1]), between(on[0], common->second, on[1])};
}

}  // namespace sightline::harness::line_flats
