#include <sightline/harness/laws/solid_rounding.h>

#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/operands.h>
#include <sightline/algorithms/solids/rounding.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/solids.h>
#include <sightline/harness/generate/tangles.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/solid_oracle.h>
#include <sightline/kernel/scene/exact_plane.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

namespace sightline::harness {

using generate::Random;

namespace {

/// Whether a cube around p, 2 reach wide, is seen to meet no face: by its box, or its plane.
bool is_off(const Polygon_soup& surface, const Exact_point& p, const Rational& reach) {
  for (Face_id f = 0; f < surface.face_count(); ++f) {
    bool apart = false;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto loop = surface.loop(f);
      const auto is_above = [&](Point_id q) { return surface.point(q)[k] > p[k] + reach; };
      const auto is_below = [&](Point_id q) { return surface.point(q)[k] < p[k] - reach; };
      apart =
          apart || std::all_of(loop.begin(), loop.end(), is_above) || std::all_of(loop.begin(), loop.end(), is_below);
    }
    if (apart) continue;
    const Exact_point normal = doubled_area_vector(surface, f);
    const Rational height = abs(dot(normal, minus(p, surface.point(surface.loop(f)[0]))));
    if (height <= reach * (abs(normal[0]) + abs(normal[1]) + abs(normal[2]))) return false;
  }
  return true;
}

/// Farther from a surface than rounding moved anything, what was inside is, and nothing else.
std::string flaw_of_places(const Polygon_soup& before, const Rounded_surface& after, Random& random) {
  const std::vector<Exact_point> corners = corners_of(before);
  if (corners.empty()) return after.soup.face_count() == 0 ? "" : "faces come of nothing";
  const Rational reach = exact(after.farthest);
  const Solid_oracle then(before), now(after.soup);
  constexpr int points = 8;
  for (int i = 0; i < points; ++i) {
    Exact_point p = any_point_of(corners, random);
    const bool is_near = random.chance(1, 2);
    if (is_near) p = corners[random.below(corners.size())];
    for (Rational& x : p) {
      const auto steps = static_cast<long>(random.between(-8, 8));
      if (is_near) x += reach * steps / 3;
    }
    if (!is_off(before, p, reach) || then.is_on_a_face(p)) continue;
    if (now.is_on_a_face(p)) return "the surface is at " + text_of(p) + ", farther than anything moved";
    if (now.winding(p, random) != then.winding(p, random))
      return text_of(p) + " is inside before or after only, farther than anything moved";
  }
  return {};
}

/// Whether the numbers hold a coordinate.
bool is_held(const Rational& x, Rounding to) {
  const double near = x.get_d();
  return exact(near) == x && (to == Rounding::to_double || static_cast<double>(static_cast<float>(near)) == near);
}

/// The nearest number of a kind, of two the even one: of three in a row about it.
template <class Number, class Bits>
double nearest_of(const Rational& x) {
  constexpr Number infinity = std::numeric_limits<Number>::infinity();
  const auto about = static_cast<Number>(x.get_d());
  Number best = about;
  for (const Number other : {std::nextafter(about, -infinity), std::nextafter(about, infinity)}) {
    if (!std::isfinite(other)) continue;
    const int nearer = cmp(abs(x - exact(static_cast<double>(other))), abs(x - exact(static_cast<double>(best))));
    if (nearer < 0 || (nearer == 0 && std::bit_cast<Bits>(other) % 2 == 0)) best = other;
  }
  return static_cast<double>(best);
}

/// That corners of a rounded surface are at the nearest numbers of those before, all of them.
std::string flaw_of_nearest(const Polygon_soup& before, const Polygon_soup& after, Rounding to) {
  const auto corners_of = [](const Polygon_soup& soup, const auto& place) {
    std::set<Exact_point> places;
    for (Face_id f = 0; f < soup.face_count(); ++f)
      for (const Point_id p : soup.loop(f)) places.insert(place(soup.point(p)));
    return places;
  };
  const auto nearest = [&](Exact_point p) {
    for (Rational& x : p)
      x = exact(to == Rounding::to_double ? nearest_of<double, std::uint64_t>(x) : nearest_of<float, std::uint32_t>(x));
    return p;
  };
  const bool are_nearest = corners_of(before, nearest) == corners_of(after, [](const Exact_point& p) { return p; });
  return are_nearest ? "" : "corners are not at the nearest numbers";
}

/// The step that the numbers have at one, towards 0.
double step_at(double x, Rounding to) {
  if (to == Rounding::to_double) return x - std::nextafter(x, 0.0);
  const auto single = static_cast<float>(x);
  return static_cast<double>(single - std::nextafter(single, 0.0F));
}

/// That no two points or faces of a snapped surface are the same, that the numbers hold its corners, all of one grid if
/// it is a coarser one, and which of those before are none of them, and which of them are new, is told. `nearest`: the
/// surface once rounded, point by point.
std::string flaw_of_points(const Polygon_soup& nearest, const Rounded_surface& after, Rounding to) {
  std::set<Exact_point> then, now;
  double farthest = 0;
  for (Point_id p = 0; p < nearest.point_count(); ++p) {
    const Exact_point at = nearest.point(p);
    then.insert(at);
    for (const Rational& x : at) farthest = std::max(farthest, std::fabs(x.get_d()));
  }
  const double step = std::ldexp(step_at(farthest, to), after.coarser);
  for (Point_id p = 0; p < after.soup.point_count(); ++p) {
    const Exact_point at = after.soup.point(p);
    now.insert(at);
    for (const Rational& x : at) {
      if (!is_held(x, to)) return "the numbers do not hold a coordinate";
      if (after.coarser > 0 && Rational(x / exact(step)).get_den() != 1) return "a coordinate is not of the grid";
    }
  }
  if (now.size() != after.soup.point_count()) return "two points are at one place";
  std::size_t vanished = 0, added = 0;
  for (Point_id p = 0; p < nearest.point_count(); ++p) vanished += now.count(nearest.point(p)) == 0;
  for (Point_id p = 0; p < after.soup.point_count(); ++p) added += then.count(after.soup.point(p)) == 0;
  if (vanished != after.vanished.size() || added != after.added.size()) return "points vanish or come and are not told";
  for (const Point_id p : after.vanished)
    if (now.count(nearest.point(p)) > 0) return "a point is said to vanish that is there";
  for (const Point_id p : after.added)
    if (then.count(after.soup.point(p)) > 0) return "a point is said to be new that was there";
  std::set<Point_id> corners;
  std::set<std::set<Point_id>> faces;
  for (Face_id f = 0; f < after.soup.face_count(); ++f) {
    const std::span<const Point_id> loop = after.soup.loop(f);
    corners.insert(loop.begin(), loop.end());
    if (!faces.insert(std::set<Point_id>(loop.begin(), loop.end())).second) return "two faces have the same corners";
  }
  if (corners.size() != after.soup.point_count()) return "a point is no face's corner";
  return {};
}

// ---- What crosses

/// Nothing where it is not asked.
std::optional<Face_meeting> meeting_of_both(const Flat_face& a, const Flat_face& b) {
  const auto is_on = [&](const Exact_point& p) { return a.height(p) == 0; };
  if (std::all_of(b.corners.begin(), b.corners.end(), is_on)) return std::nullopt;
  return std::max(meeting_of(a, b), meeting_of(b, a));
}

/// Whether all corners are inside of each edge or on its line, and no edge goes back.
bool is_convex_face(const Flat_face& face) {
  const std::size_t size = face.corners.size();
  for (std::size_t k = 0; k < size; ++k) {
    const Exact_point &p = face.corners[k], &q = face.corners[(k + 1) % size], &r = face.corners[(k + 2) % size];
    const Exact_point edge = minus(q, p), next = minus(r, q), inwards = cross(face.normal, edge);
    if (is_zero(edge) || (dot(edge, next) < 0 && is_zero(cross(edge, next)))) return false;
    for (const Exact_point& corner : face.corners)
      if (dot(inwards, minus(corner, p)) < 0) return false;
  }
  return !is_zero(face.normal);
}

/// Faces that are convex, with area.
std::vector<std::optional<Flat_face>> convex_faces(const Polygon_soup& soup) {
  std::vector<std::optional<Flat_face>> faces;
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    generate::Points corners;
    for (const Point_id p : soup.loop(f)) corners.push_back(soup.point(p));
    Flat_face face(std::move(corners));
    faces.emplace_back();
    if (is_convex_face(face)) faces.back() = std::move(face);
  }
  return faces;
}

using Box = std::array<Triple, 2>;

/// Of a face of which the coordinates are doubles.
Box box_of(const Flat_face& face) {
  Box box;
  const std::array<Exact_point, 2> exact = exact_box(face.corners);
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t k = 0; k < 3; ++k) box[side][k] = nearest_double(exact[side][k]);
  return box;
}
bool are_boxes_apart(const Box& a, const Box& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a[1][k] < b[0][k] || b[1][k] < a[0][k]) return true;
  return false;
}

struct Crossing_flaw {
  std::string what;
  bool nothing_meets = true;  // of what is asked, and all is
};

/// A face with all corners on one line has nothing inside that could cross itself.
std::string flaw_of_selves(const Rounded_surface& near) {
  for (const auto& [a, b] : near.crossing) {
    if (a != b) continue;
    const auto loop = near.soup.loop(a);
    const auto way = [&](Point_id p) { return minus(near.soup.point(p), near.soup.point(loop[0])); };
    const auto is_along_all = [&](Point_id p) {
      return std::all_of(loop.begin(), loop.end(), [&](Point_id q) { return is_zero(cross(way(p), way(q))); });
    };
    if (std::all_of(loop.begin(), loop.end(), is_along_all))
      return "face " + std::to_string(a) + " is a line, and said to cross itself";
  }
  return {};
}

/// A pair is told iff it meets now and did not, or passes now and did not.
Crossing_flaw flaw_of_crossing(const Polygon_soup& exact, const Rounded_surface& near) {
  constexpr std::size_t most_faces = 24;  // all pairs of them
  Crossing_flaw flaw;
  if (near.soup.face_count() > most_faces) return {{}, false};
  const std::vector<std::optional<Flat_face>> now = convex_faces(near.soup), before = convex_faces(exact);
  std::vector<Box> boxes;
  for (const auto& face : now) {
    boxes.emplace_back();
    if (face) boxes.back() = box_of(*face);
    else flaw.nothing_meets = false;
  }
  const std::set<std::pair<Face_id, Face_id>> told(near.crossing.begin(), near.crossing.end());
  for (Face_id a = 0; a < now.size(); ++a)
    for (Face_id b = a + 1; b < now.size(); ++b) {
      if (!now[a] || !now[b]) continue;
      const std::string pair = "faces " + std::to_string(a) + " and " + std::to_string(b);
      const bool is_told = told.count({a, b}) > 0;
      std::optional<Face_meeting> meets = Face_meeting::none, met = Face_meeting::none;
      if (!are_boxes_apart(boxes[a], boxes[b])) meets = meeting_of_both(*now[a], *now[b]);
      if (meets != Face_meeting::none) flaw.nothing_meets = false;
      if (!meets) continue;
      if (*meets == Face_meeting::none) {
        if (is_told) return {pair + " are said to cross, and do not", false};
        continue;
      }
      const Face_id of_a = near.face_of[a], of_b = near.face_of[b];
      if (of_a != of_b) {
        if (!before[of_a] || !before[of_b]) continue;
        met = meeting_of_both(*before[of_a], *before[of_b]);
        if (!met) continue;
      }
      const bool is_new =
          *met == Face_meeting::none || (*meets == Face_meeting::passes && *met == Face_meeting::stands);
      if (near.moved > 0 && is_new != is_told)
        return {pair + (is_told ? " are said to cross, and did before" : " cross, which is not said"), false};
    }
  return flaw;
}

// ---- What is inside

/// How often the surface winds round what is just before and just behind a point inside a convex face, which may be any
/// one: what touches the face, at its middle perhaps, may not be right behind it.
std::array<int, 2> windings_beside(const Solid_oracle& surface, const Flat_face& face, Random& random) {
  static const Rational little = generate::power_of_two(-2000);  // nearer than any other face may be
  Exact_point p;
  long all = 0;
  for (const Exact_point& corner : face.corners) {
    const auto weight = static_cast<long>(random.between(1, 1 << 20));
    for (std::size_t k = 0; k < 3; ++k) p[k] += corner[k] * weight;
    all += weight;
  }
  for (Rational& x : p) x /= all;
  const int front = surface.winding(generate::along(p, little, face.normal), random);
  return {front, surface.winding(generate::along(p, Rational(-little), face.normal), random)};
}

/// Of a sound surface any face has the inside behind it; where nothing meets, all others are told.
std::string flaw_of_sides(const Rounded_surface& near, bool nothing_meets, Random& random) {
  constexpr std::size_t most_faces = 12, asked = 1;
  const std::size_t count = near.soup.face_count();
  const bool is_of_all = nothing_meets && near.moved > 0 && count <= most_faces;
  if (count == 0 || (!near.is_sound() && !is_of_all)) return {};
  const Solid_oracle surface(near.soup);
  const std::vector<std::optional<Flat_face>> faces = convex_faces(near.soup);
  const std::set<Face_id> told(near.misplaced.begin(), near.misplaced.end());
  for (std::size_t k = 0; k < (is_of_all ? count : asked); ++k) {
    const auto f = static_cast<Face_id>(is_of_all ? k : random.below(count));
    if (!faces[f]) continue;
    if ((windings_beside(surface, *faces[f], random) == std::array{0, 1}) == (told.count(f) > 0))
      return "face " + std::to_string(f) + " has not the inside behind it and nothing before it, or it is said so";
  }
  return {};
}

Polygon_soup union_of(const std::vector<Polygon_soup>& solids, Inside_rule rule) {
  Set_options options;
  options.inside = rule;
  return set_operation(Operands(solids), options).soup;
}

}  // namespace

std::string flaw_of_rounded(const Polygon_soup& exact, Rounding to, Random& random) {
  const std::size_t few_rounds = 1 + random.below(3);
  std::vector<Rounded_surface> all;
  try {
    all = {rounded(exact, to), snapped(exact, to), snapped(exact, to, false, {}, few_rounds)};
  } catch (const std::domain_error&) {  // beyond what the numbers hold
    return {};
  }
  if (const std::string flaw = flaw_of_nearest(exact, all[0].soup, to); !flaw.empty()) return "rounded: " + flaw;
  for (const Rounded_surface& near : all) {
    const std::string name = near.coarser > 0  ? "snapped to a coarser grid: "
                             : near.rounds > 0 ? "snapped: "
                                               : "rounded: ";
    if (near.rounds > 0 && !near.is_sound()) return name + "something is broken";
    if (near.rounds > 0 && all[0].is_sound()) return name + "and was sound once rounded";
    const std::vector<Polygon_soup> one{near.soup};
    const std::vector<Operand_flaw> open = flaws(Operands(one));
    const bool crosses_itself =  // a face; its edges are open then
        std::any_of(open.begin(), open.end(), [](const Operand_flaw& flaw) { return !flaw.why.empty(); });
    if (!open.empty() && (!crosses_itself || near.is_sound())) return name + "the surface is not closed any more";
    for (Face_id f = 0; f < near.soup.face_count(); ++f) {
      const Exact_point before = doubled_area_vector(exact, near.face_of[f]);
      const bool is_turned = dot(doubled_area_vector(near.soup, f), before) < 0;
      if (is_turned != (std::count(near.turned.begin(), near.turned.end(), f) > 0))
        return name + "a face is turned over and not said to be, or the other way round";
    }
    bool nothing_meets = false;
    if (near.rounds == 0) {
      if (const std::string flaw = flaw_of_selves(near); !flaw.empty()) return name + flaw;
      const Crossing_flaw crossing = flaw_of_crossing(exact, near);
      if (!crossing.what.empty()) return name + crossing.what;
      nothing_meets = crossing.nothing_meets && near.collapsed.empty();
    }
    if (const std::string flaw = flaw_of_sides(near, nothing_meets, random); !flaw.empty()) return name + flaw;
    if (!near.is_sound()) continue;
    if (near.rounds > 0)
      if (const std::string flaw = flaw_of_points(all[0].soup, near, to); !flaw.empty()) return name + flaw;
    if (const std::string flaw = flaw_of_places(exact, near, random); !flaw.empty()) return name + flaw;
    const Rational signed_volume = volume(near.soup);
    for (const Inside_rule rule : {Inside_rule::positive, Inside_rule::nonzero})
      if (volume(union_of(one, rule)) != signed_volume)
        return name + "said to be sound, but not wound once round what is " + sightline::name(rule);
  }
  return {};
}

std::string flaw_of_rounding(const std::vector<Polygon_soup>& solids, Random& random) {
  Set_options options;
  options.operation = set_operations[random.below(4)];
  const Set_result result = set_operation(Operands(solids), options);
  const Rounding to = random.chance(1, 3) ? Rounding::to_double : Rounding::to_float;
  const int more_bits = to == Rounding::to_double ? 29 : 0;
  const Rational far = generate::power_of_two(static_cast<int>(random.between(10, 24)) + more_bits);
  const Polygon_soup exact = without_holes(generate::translated(result.soup, {far, far / 3, 0})).soup;
  if (const std::string flaw = flaw_of_rounded(exact, to, random); !flaw.empty()) return flaw;
  if (const std::string flaw = flaw_of_rounded(generate::thin_tetrahedron(random), to, random); !flaw.empty())
    return "a thin tetrahedron, " + flaw;
  if (random.chance(1, 2)) {
    const std::string flaw = flaw_of_rounded(generate::tetrahedron_below_a_top(random), to, random);
    return flaw.empty() ? flaw : "a tetrahedron below a top, " + flaw;
  }
  const std::string flaw = flaw_of_rounded(generate::tetrahedron_upon_a_box(random), to, random);
  return flaw.empty() ? flaw : "a tetrahedron upon a box, " + flaw;
}

}  // namespace sightline::harness
