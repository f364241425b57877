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
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>

namespace sightline {

namespace {

/// The nearest float to a rational, ties to even: the nearest double says it unless that is halfway between two floats,
/// or between the greatest one and what floats hold no more.
float nearest_float(const Rational& value) {
  constexpr float greatest = std::numeric_limits<float>::max();
  const float result = static_cast<float>(nearest_double(value));
  if (!std::isfinite(result)) {
    static const Rational first_beyond = exact(0x1p128 - 0x1p103);
    return abs(value) < first_beyond ? std::copysign(greatest, result) : result;
  }
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

/// The step that the numbers have at a point's greatest coordinate.
int exponent_of_step(const Place& nearest, Rounding to) {
  double greatest = 0;
  for (const double x : nearest) greatest = std::max(greatest, std::fabs(x));
  const int digits =
      to == Rounding::to_double ? std::numeric_limits<double>::digits : std::numeric_limits<float>::digits;
  const int least = to == Rounding::to_double ? -1074 : -149;
  return std::max(greatest == 0 ? least : std::ilogb(greatest) - digits + 1, least);
}

/// A point near p of the grid of step 2^exponent: the nearest one, or, with a seed, one of those around p, which the
/// numbers hold. Degenerate: a point of the grid stays.
Place place_on_grid(const Exact_point& p, int exponent, Rounding to, std::uint64_t seed) {
  Rational step = 1;
  if (exponent < 0) mpq_div_2exp(step.get_mpq_t(), step.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  if (exponent > 0) mpq_mul_2exp(step.get_mpq_t(), step.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
  const Rational greatest = exact(to == Rounding::to_double ? std::numeric_limits<double>::max()
                                                            : static_cast<double>(std::numeric_limits<float>::max()));
  Place place;
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational steps = p[k] / step;
    const bool is_nearest = (seed >> k & 1) == 0, is_above = (seed >> (k + 3) & 1) != 0;
    const Rational whole = is_nearest ? steps + Rational(1, 2) : steps;
    Integer below;
    mpz_fdiv_q(below.get_mpz_t(), whole.get_num_mpz_t(), whole.get_den_mpz_t());
    if (!is_nearest && is_above && below != steps) ++below;
    const Rational at = step * below;
    place[k] = nearest_double(abs(at) > greatest ? Rational(step * (below - sgn(below))) : at);
  }
  return place;
}

bool is_at(const Exact_point& p, const Place& place) {
  return p[0] == exact(place[0]) && p[1] == exact(place[1]) && p[2] == exact(place[2]);
}

/// A double not below, which is near.
double double_above(const Rational& value) {
  return sgn(value) == 0 ? 0 : std::nextafter(nearest_double(value), std::numeric_limits<double>::infinity());
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
  for (Point_id p = 0; p < soup.point_count(); ++p) {
    result.moved += !is_at(soup.point(p), places[p]);
    const auto [place, fresh] = known.try_emplace(places[p], static_cast<Point_id>(result.soup.point_count()));
    point_of[p] = merge ? place->second : p;
    if (!merge || fresh) result.soup.add_point(places[p][0], places[p][1], places[p][2]);
  }
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
    const auto add = [&](const std::vector<Point_id>& corners) {
      if (merge && corners.size() < 3) return;
      const Face_id face = result.soup.add_face(corners);
      result.face_of.push_back(f);
      if (is_zero(doubled_normal(result.soup, corners))) result.collapsed.push_back(face);
    };
    if (planar && (!triangulate || loop.size() == 3)) add(loop);
    else
      for (const std::vector<Point_id>& triangle : triangles_of(soup, f)) add(placed(triangle));
  }
  return result;
}

/// No coordinate is moved by more.
Rational farthest_step(const Polygon_soup& soup, const std::vector<Place>& places) {
  Rational farthest;
  for (Point_id p = 0; p < soup.point_count(); ++p) {
    const Exact_point at = soup.point(p);
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational step = abs(at[k] - exact(places[p][k]));
      if (farthest < step) farthest = step;
    }
  }
  return farthest;
}

/// Faces whose normals point to the other side of the plane of the face before.
void add_turned(Rounded_surface& surface, const Polygon_soup& before) {
  for (Face_id f = 0; f < surface.soup.face_count(); ++f) {
    const Exact_point normal = doubled_normal(surface.soup, surface.soup.loop(f));
    if (dot(normal, doubled_normal(before, before.loop(surface.face_of[f]))) < 0) surface.turned.push_back(f);
  }
}

/// Some faces, on points of their own.
Polygon_soup faces_alone(const Polygon_soup& soup, const std::set<Face_id>& faces) {
  Polygon_soup alone;
  std::map<Point_id, Point_id> known;
  for (const Face_id f : faces) {
    std::vector<Point_id> corners;
    for (const Point_id p : soup.loop(f)) {
      const auto [entry, fresh] = known.try_emplace(p, static_cast<Point_id>(alone.point_count()));
      if (fresh) {
        const Exact_point at = soup.point(p);
        alone.add_point(at[0], at[1], at[2]);
      }
      corners.push_back(entry->second);
    }
    alone.add_face(corners);
  }
  return alone;
}

/// What crosses that did not: by faces before, of which triangles of one may not cross, either.
void add_crossing(Rounded_surface& surface, const Polygon_soup& soup, const Rounding_progress& progress) {
  if (surface.moved == 0) return;
  // 1. What crosses now. Faces before are asked of only then, and only those: their points may take many digits.
  const Pairs now = crossings(surface.soup, progress);
  std::set<Face_id> faces;
  for (const auto& [pair, goes_through] : now)
    for (const Face_id face : {pair.first, pair.second}) faces.insert(surface.face_of[face]);
  // 2. What of it did before.
  const Pairs before = faces.empty() ? Pairs{} : crossings(faces_alone(soup, faces), progress);
  const auto place_of = [&](Face_id face) {
    return static_cast<Face_id>(std::distance(faces.begin(), faces.find(surface.face_of[face])));
  };
  for (const auto& [pair, goes_through] : now) {
    const auto known = before.find(std::minmax(place_of(pair.first), place_of(pair.second)));
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
      const bool is_border = std::min(front, behind) == 0 && std::max(front, behind) == 1;
      if (!is_border || fragment.parts.size() > 1)
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

/// What a surface winds round positively, exactly; of each face of that which one of the surface's it is a part of.
/// Pre: no face crosses itself.
Hole_free resolved(const Polygon_soup& surface, const Rounding_progress& progress) {
  Set_options options;
  options.progress = progress;
  const Set_result result = set_operation(Operands(std::span(&surface, 1)), options);
  Hole_free flat = without_holes(result.soup);
  for (Face_id& face : flat.face_of) face = result.faces[face].face;
  return flat;
}

bool crosses_itself(const Polygon_soup& surface) { return !flaws(Operands(std::span(&surface, 1))).empty(); }

std::set<Place> places_of(const Polygon_soup& rounded) {
  std::set<Place> places;
  for (Point_id p = 0; p < rounded.point_count(); ++p) {
    const Exact_point at = rounded.point(p);
    places.insert({nearest_double(at[0]), nearest_double(at[1]), nearest_double(at[2])});
  }
  return places;
}

std::vector<bool> corners_of(const Polygon_soup& surface) {
  std::vector<bool> is_corner(surface.point_count());
  for (Face_id f = 0; f < surface.face_count(); ++f)
    for (const Point_id p : surface.loop(f)) is_corner[p] = true;
  return is_corner;
}

/// The same surface without points that are no corners, of faces that vanished. Pre: faces have no holes.
Polygon_soup with_corners_alone(const Polygon_soup& surface) {
  const std::vector<bool> is_corner = corners_of(surface);
  Polygon_soup result;
  result.file = surface.file;
  std::vector<Point_id> number(surface.point_count());
  for (Point_id p = 0; p < surface.point_count(); ++p) {
    if (!is_corner[p]) continue;
    number[p] = static_cast<Point_id>(result.point_count());
    const Exact_point at = surface.point(p);
    result.add_point(at[0], at[1], at[2]);
  }
  for (Face_id f = 0; f < surface.face_count(); ++f) {
    std::vector<Point_id> corners;
    for (const Point_id p : surface.loop(f)) corners.push_back(number[p]);
    result.add_face(corners);
  }
  return result;
}

/// Which corners before are none of the surface's, and which of its own are new.
void add_changed_points(Rounded_surface& surface, const Polygon_soup& before, const std::vector<Place>& nearest) {
  const std::set<Place> now = places_of(surface.soup), then(nearest.begin(), nearest.end());
  const std::vector<bool> was_corner = corners_of(before);
  for (Point_id p = 0; p < before.point_count(); ++p)
    if (was_corner[p] && now.count(nearest[p]) == 0) surface.vanished.push_back(p);
  for (Point_id p = 0; p < surface.soup.point_count(); ++p) {
    const Exact_point at = surface.soup.point(p);
    if (then.count({nearest_double(at[0]), nearest_double(at[1]), nearest_double(at[2])}) == 0)
      surface.added.push_back(p);
  }
}

/// The surface snapped to one grid in that many rounds at most, which are added to `rounds`; nothing where they were
/// not enough, or each breaks more than the one before. `coarser`: 0 for the numbers' own grid, of which the step is
/// that at each point's greatest coordinate; else one grid for all points, 2^coarser of the greatest such step.
std::optional<Rounded_surface> snapped_to_grid(const Polygon_soup& soup, Rounding to, int coarser, bool triangulate,
                                               const Rounding_progress& progress, std::size_t most_rounds,
                                               std::size_t& rounds) {
  constexpr std::size_t aside_every = 3, most_crossing_more = 4, most_crossing = 1000;
  std::vector<Place> nearest;
  int coarsest = std::numeric_limits<int>::min();
  for (Point_id p = 0; p < soup.point_count(); ++p) {
    nearest.push_back(nearest_place(soup.point(p), to));
    coarsest = std::max(coarsest, exponent_of_step(nearest[p], to));
  }
  // The exact surface of each round, and of its faces which one of the first's each is a part of.
  Hole_free now{soup, std::vector<Face_id>(soup.face_count())};
  std::iota(now.face_of.begin(), now.face_of.end(), Face_id{0});
  std::set<Face_id> not_planar;
  Rational farthest;
  std::size_t crossing_first = 0;
  for (std::size_t round = 1; round <= most_rounds; ++round) {
    ++rounds;
    // 1. Points get places. The numbers' own grid leaves the first ones at the nearest numbers; all others go to one of
    // the grid, now and then beside the nearest, lest the same comes again and again.
    std::vector<Place> places;
    const bool aside = round > aside_every && round % aside_every == 0;
    for (Point_id p = 0; p < now.soup.point_count(); ++p) {
      const Exact_point at = now.soup.point(p);
      places.push_back(nearest_place(at, to));
      const int exponent = coarser == 0 ? exponent_of_step(places[p], to) : coarsest + coarser;
      if (coarser > 0 || (round > 1 && !is_at(at, places[p])))
        places[p] = place_on_grid(at, exponent, to, aside ? mixed(std::uint64_t{p} << 32 | round) : 0);
    }
    farthest += farthest_step(now.soup, places);
    // 2. What that breaks.
    Rounded_surface surface = surface_at(now.soup, places, triangulate, true, progress);
    for (const Face_id face : surface.not_planar) not_planar.insert(now.face_of[face]);
    add_crossing(surface, now.soup, progress);
    add_misplaced(surface, progress);
    const std::size_t crossing = surface.crossing.size();
    const bool is_sound = surface.is_sound();
    if (!is_sound && crosses_itself(surface.soup)) surface = surface_at(now.soup, places, true, true, progress);
    for (Face_id& face : surface.face_of) face = now.face_of[face];
    if (is_sound) {
      surface.soup = with_corners_alone(surface.soup);
      surface.farthest = double_above(farthest);
      surface.not_planar.assign(not_planar.begin(), not_planar.end());
      add_turned(surface, soup);
      add_changed_points(surface, soup, nearest);
      return surface;
    }
    // 3. Where rounds break more and more, the next would take out of proportion.
    if (round == 1) crossing_first = crossing;
    if (crossing > most_crossing + most_crossing_more * crossing_first) return std::nullopt;
    // 4. What it winds round, exactly: it crosses nowhere, but has new points.
    now = resolved(surface.soup, progress);
    for (Face_id& face : now.face_of) face = surface.face_of[face];
  }
  return std::nullopt;
}

}  // namespace

Rounded_surface rounded(const Polygon_soup& soup, Rounding to, bool triangulate, const Rounding_progress& progress) {
  std::vector<Place> places;
  for (Point_id p = 0; p < soup.point_count(); ++p) {
    if (progress) progress(p, soup.point_count());
    places.push_back(nearest_place(soup.point(p), to));
  }
  Rounded_surface result = surface_at(soup, places, triangulate, false, progress);
  result.farthest = double_above(farthest_step(soup, places));
  add_turned(result, soup);
  add_crossing(result, soup, progress);
  add_misplaced(result, progress);
  return result;
}

Rounded_surface snapped(const Polygon_soup& soup, Rounding to, bool triangulate, const Rounding_progress& progress,
                        std::size_t most_rounds) {
  Rounded_surface first = rounded(soup, to, triangulate, progress);
  if (first.is_sound()) return first;
  // It ends: once the step is more than twice the greatest coordinate, all points are one, and no face is left.
  constexpr int coarser_each = 4;
  std::size_t rounds = 0;
  for (int coarser = 0;; coarser += coarser_each) {
    std::optional<Rounded_surface> surface =
        snapped_to_grid(soup, to, coarser, triangulate, progress, most_rounds, rounds);
    if (!surface) continue;
    surface->moved = first.moved;
    surface->rounds = rounds;
    surface->coarser = coarser;
    return *std::move(surface);
  }
}

}  // namespace sightline
