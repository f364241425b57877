#include <sightline/algorithms/solids/rounding.h>

#include <sightline/algorithms/solids/box_tree.h>
#include <sightline/algorithms/solids/contacts.h>
#include <sightline/algorithms/solids/operands.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

/// Pairs of faces, by `name`, of which one has a segment of the other inside it.
template <class Name>
std::set<std::pair<Face_id, Face_id>> crossings(const Polygon_soup& soup, Name name) {
  const Operands operands(std::span(&soup, 1));
  std::set<std::pair<Face_id, Face_id>> pairs;
  for (const Cut& cut : contacts(operands, Box_tree(operands)).cuts) {
    const Face_id a = operands.pieces()[cut.piece].face, b = operands.pieces()[cut.other].face;
    if (a != b) pairs.insert(std::minmax(name(a), name(b)));
  }
  return pairs;
}

}  // namespace

Rounded_surface rounded(const Polygon_soup& soup, Rounding to, bool triangulate) {
  Rounded_surface result;
  result.soup.file = soup.file;
  // 1. Points.
  Rational farthest;
  for (Point_id p = 0; p < soup.point_count(); ++p) {
    const Exact_point at = soup.point(p);
    std::array<double, 3> near;
    bool moved = false;
    for (std::size_t k = 0; k < 3; ++k) {
      near[k] = to == Rounding::to_double ? nearest_double(at[k]) : static_cast<double>(nearest_float(at[k]));
      if (!std::isfinite(near[k])) throw std::domain_error("a coordinate is beyond what the numbers hold");
      const Rational step = abs(at[k] - exact(near[k]));
      if (sgn(step) != 0) moved = true;
      if (farthest < step) farthest = step;
    }
    result.soup.add_point(near[0], near[1], near[2]);
    result.moved += moved;
  }
  result.farthest = std::nextafter(nearest_double(farthest), std::numeric_limits<double>::infinity());
  if (sgn(farthest) == 0) result.farthest = 0;
  // 2. Faces.
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    const std::span<const Point_id> loop = soup.loop(f);
    const bool planar = is_planar(result.soup, loop);
    if (!planar) result.not_planar.push_back(f);
    const Exact_point before = doubled_normal(soup, loop);
    const auto add = [&](std::span<const Point_id> corners) {
      const Face_id face = result.soup.add_face(corners);
      result.face_of.push_back(f);
      const Exact_point normal = doubled_normal(result.soup, corners);
      if (is_zero(normal)) result.collapsed.push_back(face);
      else if (dot(normal, before) < 0) result.turned.push_back(face);
    };
    if (planar && (!triangulate || loop.size() == 3)) add(loop);
    else
      for (const std::vector<Point_id>& triangle : triangles_of(soup, f)) add(triangle);
  }
  // 3. What crosses that did not: by faces before, of which triangles of one may not cross, either.
  if (result.moved == 0) return result;
  const auto known = crossings(soup, [](Face_id f) { return f; });
  for (const auto& pair : crossings(result.soup, [](Face_id f) { return f; }))
    if (!known.count(std::minmax(result.face_of[pair.first], result.face_of[pair.second])))
      result.crossing.push_back(pair);
  return result;
}

}  // namespace sightline
