#include <sightline/algorithms/solids/rounding.h>

#include <sightline/algorithms/solids/box_tree.h>
#include <sightline/algorithms/solids/contacts.h>
#include <sightline/algorithms/solids/operands.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

namespace sightline {

namespace {

/// The nearest float to a rational, ties to even: the nearest double says it unless that is halfway between two floats.
float nearest_float(const Rational& value) {
  const double near = nearest_double(value);
  float result = static_cast<float>(near);
  if (!std::isfinite(result)) return result;
  const Rational at = exact(static_cast<double>(result));
  const float beyond = std::nextafter(
      result, value < at ? -std::numeric_limits<float>::infinity() : std::numeric_limits<float>::infinity());
  if (!std::isfinite(beyond)) return result;
  const Rational to = abs(value - at), to_beyond = abs(value - exact(static_cast<double>(beyond)));
  return to_beyond < to ? beyond : result;
}

Exact_point doubled_normal(const Polygon_soup& soup, std::span<const Point_id> loop) {
  Exact_point sum;
  const Exact_point origin = soup.point(loop[0]);
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
    const Exact_point part = cross(minus(soup.point(loop[i]), origin), minus(soup.point(loop[i + 1]), origin));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
  }
  return sum;
}

bool is_planar(const Polygon_soup& soup, std::span<const Point_id> loop) {
  if (loop.size() == 3) return true;
  const Exact_point normal = doubled_normal(soup, loop), origin = soup.point(loop[0]);
  if (is_zero(normal)) return false;
  return std::all_of(loop.begin(), loop.end(),
                     [&](Point_id p) { return dot(normal, minus(soup.point(p), origin)) == 0; });
}

/// Pairs of faces of which one has a segment of the other inside it, and whether it goes through there, or only stands
/// upon it; a face that crosses itself is a pair.
using Pairs = std::map<std::pair<Face_id, Face_id>, bool>;

/// Whether a piece has corners on both sides of another one's plane.
bool is_on_both_sides(const Operands& operands, std::size_t piece, std::size_t of) {
  const std::span<const Piece_corner> corners = operands.corners(of);
  const Exact_point origin = operands.position(corners[0].point);
  Exact_point normal;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const Exact_point part = cross(minus(operands.position(corners[k].point), origin),
                                   minus(operands.position(corners[k + 1].point), origin));
    for (std::size_t axis = 0; axis < 3; ++axis) normal[axis] += part[axis];
  }
  bool front = false, behind = false;
  for (const Piece_corner& corner : operands.corners(piece)) {
    const int side = sgn(dot(normal, minus(operands.position(corner.point), origin)));
    front = front || side > 0;
    behind = behind || side < 0;
  }
  return front && behind;
}

Pairs crossings(const Polygon_soup& soup, const Rounding_progress& progress) {
  Operands operands(std::span(&soup, 1));
  Pairs pairs;
  for (const Cut& cut : contacts(operands, Box_tree(operands), progress).cuts) {
    const Face_id a = operands.pieces()[cut.piece].face, b = operands.pieces()[cut.other].face;
    if (a == b) continue;
    bool& goes_through = pairs[std::minmax(a, b)];
    goes_through = goes_through || is_on_both_sides(operands, cut.other, cut.piece);
  }
  for (const Set_aside& entry : operands.set_aside())
    if (entry.reason != Set_aside_reason::zero_area) pairs[{entry.face, entry.face}] = true;
  return pairs;
}

using Place = std::array<double, 3>;

/// The nearest numbers. Errors: std::domain_error where they are not finite.
Place nearest_place(const Exact_point& p, Rounding to) {
  Place near;
  for (std::size_t k = 0; k < 3; ++k) {
    near[k] = to == Rounding::to_double ? nearest_double(p[k]) : static_cast<double>(nearest_float(p[k]));
    if (!std::isfinite(near[k])) throw std::domain_error("a coordinate is beyond what the numbers hold");
  }
  return near;
}

/// A point of a grid near p, of which the step is 2^level times that of the numbers at p's greatest coordinate: the
/// nearest one, or, with a seed, one of those around p.
Place snapped_place(const Exact_point& p, Rounding to, int level, std::uint64_t seed) {
  double greatest = 0;
  for (const double x : nearest_place(p, to)) greatest = std::max(greatest, std::fabs(x));
  const int digits =
      to == Rounding::to_double ? std::numeric_limits<double>::digits : std::numeric_limits<float>::digits;
  const int least = to == Rounding::to_double ? -1074 : -149;
  const int exponent = std::max(greatest == 0 ? least : std::ilogb(greatest) - digits + 1 + level, least);
  const Rational step = exact(std::ldexp(1.0, exponent));
  Place place;
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational steps = p[k] / step;
    const Rational whole = (seed >> k & 1) == 0 ? steps + Rational(1, 2) : steps;
    Integer below;
    mpz_fdiv_q(below.get_mpz_t(), whole.get_num_mpz_t(), whole.get_den_mpz_t());
    if ((seed >> (k + 3) & 1) != 0 && (seed >> k & 1) != 0 && below != steps) ++below;
    place[k] = nearest_double(step * below);
  }
  return place;
}

/// The surface with its points at other places, and what is broken there. Loops lose corners that repeat the one
/// before, and faces of fewer than three corners vanish, if `merge`.
Rounded_surface surface_at(const Polygon_soup& soup, const std::vector<Place>& places, bool triangulate, bool merge,
                           const Rounding_progress& progress) {
  Rounded_surface result;
  result.soup.file = soup.file;
  // 1. Points.
  std::vector<Point_id> point_of(soup.point_count());
  std::map<Place, Point_id> known;
  Rational farthest;
  for (Point_id p = 0; p < soup.point_count(); ++p) {
    const Exact_point at = soup.point(p);
    bool moved = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational step = abs(at[k] - exact(places[p][k]));
      if (sgn(step) != 0) moved = true;
      if (farthest < step) farthest = step;
    }
    result.moved += moved;
    const auto [place, fresh] = known.try_emplace(places[p], static_cast<Point_id>(result.soup.point_count()));
    point_of[p] = merge ? place->second : p;
    if (!merge || fresh) result.soup.add_point(places[p][0], places[p][1], places[p][2]);
  }
  result.farthest = std::nextafter(nearest_double(farthest), std::numeric_limits<double>::infinity());
  if (sgn(farthest) == 0) result.farthest = 0;
  // 2. Faces.
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    if (progress) progress(f, soup.face_count());
    const auto placed = [&](std::span<const Point_id> loop) {
      std::vector<Point_id> corners;
      for (const Point_id p : loop)
        if (corners.empty() || !merge || corners.back() != point_of[p]) corners.push_back(point_of[p]);
      while (merge && corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
      return corners;
    };
    const std::vector<Point_id> loop = placed(soup.loop(f));
    if (merge && loop.size() < 3) continue;
    const bool planar = is_planar(result.soup, loop);
    if (!planar) result.not_planar.push_back(f);
    const Exact_point before = doubled_normal(soup, soup.loop(f));
    const auto add = [&](const std::vector<Point_id>& corners) {
      if (merge && corners.size() < 3) return;
      const Face_id face = result.soup.add_face(corners);
      result.face_of.push_back(f);
      const Exact_point normal = doubled_normal(result.soup, corners);
      if (is_zero(normal)) result.collapsed.push_back(face);
      else if (dot(normal, before) < 0) result.turned.push_back(face);
    };
    if (planar && (!triangulate || loop.size() == 3)) add(loop);
    else
      for (const std::vector<Point_id>& triangle : triangles_of(soup, f)) add(placed(triangle));
  }
  return result;
}

/// What crosses that did not: by faces before, of which triangles of one may not cross, either.
void add_crossing(Rounded_surface& surface, const Pairs& before, const Rounding_progress& progress) {
  if (surface.moved == 0) return;
  for (const auto& [pair, goes_through] : crossings(surface.soup, progress)) {
    const auto known = before.find(std::minmax(surface.face_of[pair.first], surface.face_of[pair.second]));
    if (known == before.end() || (goes_through && !known->second)) surface.crossing.push_back(pair);
  }
}

/// What else is broken, once nothing crosses: the winding numbers on both sides of all fragments tell.
void add_misplaced(Rounded_surface& surface, const Rounding_progress& progress) {
  if (surface.moved == 0 || !surface.is_sound()) return;
  const Operands operands(std::span(&surface.soup, 1));
  std::set<Face_id> faces;
  if (!flaws(operands).empty())
    for (Face_id f = 0; f < surface.soup.face_count(); ++f) faces.insert(f);
  else {
    Set_options options;
    options.keep_fragments = true;
    options.progress = progress;
    for (const Result_fragment& fragment : set_operation(operands, options).fragments) {
      const int front = fragment.front.empty() ? 0 : fragment.front[0].number;
      int behind = front;
      for (const Result_fragment::Part& part : fragment.parts) behind += part.turned ? -1 : 1;
      if ((front != 0 && front != 1) || (behind != 0 && behind != 1))
        for (const Result_fragment::Part& part : fragment.parts) faces.insert(part.face);
    }
  }
  surface.misplaced.assign(faces.begin(), faces.end());
}

/// A number that looks random, of another one.
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9;
  x = (x ^ x >> 27) * 0x94d049bb133111eb;
  return x ^ x >> 31;
}

}  // namespace

Rounded_surface rounded(const Polygon_soup& soup, Rounding to, bool triangulate, const Rounding_progress& progress) {
  std::vector<Place> places;
  for (Point_id p = 0; p < soup.point_count(); ++p) {
    if (progress) progress(p, soup.point_count());
    places.push_back(nearest_place(soup.point(p), to));
  }
  Rounded_surface result = surface_at(soup, places, triangulate, false, progress);
  if (result.moved > 0) add_crossing(result, crossings(soup, progress), progress);
  add_misplaced(result, progress);
  return result;
}

Rounded_surface snapped(const Polygon_soup& soup, Rounding to, bool triangulate, const Rounding_progress& progress) {
  constexpr std::size_t most_rounds = 40;
  constexpr std::uint32_t turns_on_a_grid = 6;
  Rounded_surface first = rounded(soup, to, triangulate, progress);
  if (first.is_sound()) return first;
  const Pairs before = crossings(soup, progress);
  std::vector<Place> nearest;
  for (Point_id p = 0; p < soup.point_count(); ++p) nearest.push_back(nearest_place(soup.point(p), to));
  std::vector<Place> least_places = nearest;
  std::vector<std::uint32_t> turns(soup.point_count());
  Rounded_surface least = first;  // of all so far what is broken least
  for (std::size_t round = 1; round <= most_rounds; ++round) {
    // 1. The corners of all faces at fault are put elsewhere.
    std::set<Point_id> at_fault;
    const auto add = [&](Face_id face) {
      for (const Point_id p : soup.loop(least.face_of[face])) at_fault.insert(p);
    };
    for (const Face_id face : least.collapsed) add(face);
    for (const Face_id face : least.turned) add(face);
    for (const Face_id face : least.misplaced) add(face);
    for (const auto& [one, other] : least.crossing) {
      add(one);
      add(other);
    }
    std::vector<Place> places = least_places;
    for (const Point_id p : at_fault) {
      const std::uint32_t turn = turns[p]++;
      const std::uint64_t seed = turn % turns_on_a_grid == 0 ? 0 : mixed(std::uint64_t{p} << 32 | turn);
      places[p] = snapped_place(soup.point(p), to, static_cast<int>(turn / turns_on_a_grid), seed);
    }
    // 2. What that breaks, and mends.
    Rounded_surface surface = surface_at(soup, places, triangulate, true, progress);
    add_crossing(surface, before, progress);
    add_misplaced(surface, progress);
    if (surface.is_sound()) {
      surface.rounds = round;
      for (Point_id p = 0; p < soup.point_count(); ++p) surface.snapped += places[p] != nearest[p];
      return surface;
    }
    if (surface.faults() > least.faults() && round % 4 != 0) continue;
    least = std::move(surface);
    least_places = std::move(places);
  }
  first.rounds = most_rounds;
  return first;
}

}  // namespace sightline
