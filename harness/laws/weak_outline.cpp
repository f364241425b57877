#include <sightline/harness/laws/weak_outline.h>

#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cstddef>
#include <set>

namespace sightline::harness::weak_flats {

namespace {

using generate::Points;
/// Where c[0] + c[1] a + c[2] b > 0.
using Half_plane = std::array<Rational, 3>;
using Region = std::vector<Half_plane>;  // all of them
using Place = std::array<Rational, 2>;

Rational value(const Half_plane& h, const Place& at) { return h[0] + h[1] * at[0] + h[2] * at[1]; }

/// What of a polygon's plane is in front of another one.
Half_plane half_plane(const Points& source, const Level& level) {
  return {level.height(source[0]), dot(level.normal, minus(source[1], source[0])),
          dot(level.normal, minus(source[2], source[0]))};
}

Level through(const Exact_point& a, const Exact_point& b, const Exact_point& c) {
  const Exact_point normal = cross(minus(b, a), minus(c, a));
  return {normal, dot(normal, a)};
}

/// The plane through the eye and each edge of a polygon, positive where its inside is.
Region shadow(const Points& polygon, const Points& source, const Exact_point& eye) {
  Region region;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    Level level = through(eye, polygon[i], polygon[(i + 1) % polygon.size()]);
    if (position(level, polygon) < 0) level = level.turned();
    region.push_back(half_plane(source, level));
  }
  return region;
}

Flat_line canonical(const Half_plane& h) {
  const Rational& lead = sgn(h[1]) != 0 ? h[1] : h[2];
  return {Rational(h[0] / lead), Rational(h[1] / lead), Rational(h[2] / lead)};
}

/// Whether points next to a place, in a direction, are in a region. Pre: lines through the place are not along it.
bool holds(const Region& region, const Place& at, const Place& towards) {
  return std::all_of(region.begin(), region.end(), [&](const Half_plane& h) {
    const int here = sgn(value(h, at));
    return here != 0 ? here > 0 : h[1] * towards[0] + h[2] * towards[1] > 0;
  });
}

}  // namespace

std::vector<Flat_line> seen_outline(const std::vector<Points>& polygons, const Points& source, const Level& front,
                                    const Exact_point& eye) {
  const Level of_source = level_of(source);
  // 1. What there is to see, and shadows.
  Region whole;
  for (std::size_t i = 0; i < source.size(); ++i) {
    const Exact_point &a = source[i], &b = source[(i + 1) % source.size()];
    const Exact_point inwards = cross(of_source.normal, minus(b, a));
    whole.push_back(half_plane(source, {inwards, dot(inwards, a)}));
  }
  whole.push_back(half_plane(source, front));
  std::vector<Region> shadows;
  for (const Points& polygon : polygons) {
    if (level_of(polygon).side(eye) == 0) continue;
    const Points part = clipped(clipped(polygon, of_source), front);
    if (!part.empty()) shadows.push_back(shadow(part, source, eye));
  }
  // 2. All lines.
  std::set<Flat_line> lines;
  const auto add = [&](const Region& region) {
    for (const Half_plane& h : region)
      if (sgn(h[1]) != 0 || sgn(h[2]) != 0) lines.insert(canonical(h));
  };
  add(whole);
  for (const Region& region : shadows) add(region);
  // 3. Of each, its stretches between the others.
  const auto is_seen = [&](const Place& at, const Place& towards) {
    return holds(whole, at, towards) && std::none_of(shadows.begin(), shadows.end(),
                                                     [&](const Region& region) { return holds(region, at, towards); });
  };
  std::vector<Flat_line> outline;
  for (const Flat_line& line : lines) {
    const Rational square = line[1] * line[1] + line[2] * line[2], from = -line[0] / square;
    const Place origin{from * line[1], from * line[2]}, along{Rational(-line[2]), line[1]}, left{line[1], line[2]},
        right{Rational(-line[1]), Rational(-line[2])};
    std::vector<Rational> crossings;
    for (const Flat_line& other : lines) {
      const Rational slope = other[1] * along[0] + other[2] * along[1];
      if (sgn(slope) != 0) crossings.push_back(-value(other, origin) / slope);
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); ++k) {
      if (crossings[k] == crossings[k + 1]) continue;
      const Rational t = (crossings[k] + crossings[k + 1]) / 2;
      const Place middle{origin[0] + t * along[0], origin[1] + t * along[1]};
      if (is_seen(middle, left) == is_seen(middle, right)) continue;
      outline.push_back(line);
      break;
    }
  }
  return outline;
}

Flat_line image_of(const Points& source, const Exact_point& eye, const std::array<Exact_point, 2>& line) {
  return canonical(half_plane(source, through(eye, line[0], line[1])));
}

}  // namespace sightline::harness::weak_flats
