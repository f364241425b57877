#include <sightline/harness/generate/solids.h>

#include <sightline/algorithms/solids/measure.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/kernel/scene/exact_plane.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace sightline::generate {

namespace {

/// Fronts outwards; empty where there is no volume.
template <class Add>
Polygon_soup outwards(Points base, Add add) {
  for (int turn = 0; turn < 2; ++turn) {
    Polygon_soup solid;
    add(solid, base);
    const int sign = sgn(volume(solid));
    if (sign > 0) return solid;
    if (sign == 0) return {};
    std::reverse(base.begin(), base.end());
  }
  return {};
}

Polygon_soup any_solid(const Points& base, const Exact_point& apex, const Exact_point& along, Random& random) {
  const bool cone = random.chance(1, 2);
  return outwards(base, [&](Polygon_soup& solid, const Points& b) {
    cone ? add_cone(solid, b, apex) : add_prism(solid, b, along);
  });
}

/// The lowest and the highest coordinates. Pre: there is a point.
std::array<Exact_point, 2> box_of(const Polygon_soup& soup) {
  Points points;
  for (Point_id p = 0; p < soup.point_count(); ++p) points.push_back(soup.point(p));
  return exact_box(points);
}

/// The power of two not above the longest side of the box.
int side_bits(const Polygon_soup& soup) {
  const auto [low, high] = box_of(soup);
  const Exact_point sides = minus(high, low);
  const double longest = nearest_double(*std::max_element(sides.begin(), sides.end()));
  return longest > 0 ? std::ilogb(longest) : 0;
}

struct Corner_of_face {
  Exact_point at, normal;
};
/// Of a planar piece of any face; after some tries, without a normal.
Corner_of_face any_corner(const Polygon_soup& soup, Random& random) {
  constexpr int tries = 100;
  Corner_of_face corner{soup.point(0), {0, 0, 0}};
  for (int k = 0; k < tries && soup.face_count() > 0 && is_zero(corner.normal); ++k) {
    const Scene face(face_alone(soup, static_cast<Face_id>(random.below(soup.face_count()))));
    if (face.pieces().empty()) continue;
    const auto corners = face.corners(face.pieces()[0]);
    const auto at = [&](std::size_t i) { return face.position(corners[i].point); };
    corner = {at(0), cross(minus(at(1), at(0)), minus(at(2), at(0)))};
  }
  return corner;
}

Exact_point axes_exchanged(const Exact_point& p, std::size_t times) {
  return {p[times % 3], p[(times + 1) % 3], p[(times + 2) % 3]};
}

}  // namespace

Polygon_soup face_alone(const Polygon_soup& soup, Face_id face) {
  Polygon_soup alone;
  for (std::size_t k = 0; k < soup.loop_count(face); ++k) {
    Points corners;
    for (const Point_id p : soup.loop(face, k)) corners.push_back(soup.point(p));
    const std::vector<Point_id> ids = added(alone, corners);
    if (k == 0) alone.add_face(ids);
    else alone.add_hole(ids);
  }
  return alone;
}

Points base_of(const Polygon_soup& soup, Face_id face, bool planar) {
  if (soup.loop_count(face) != 1) return {};
  const Scene scene(face_alone(soup, face));
  if (scene.pieces().empty() || (planar && !scene.non_planar().empty())) return {};
  Points corners;
  for (const Point_id p : soup.loop(face))
    if (const Exact_point at = soup.point(p); corners.empty() || corners.back() != at) corners.push_back(at);
  while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
  return corners;
}

void add_cone(Polygon_soup& soup, const Points& base, const Exact_point& apex) {
  soup.add_face(added(soup, base));
  for (std::size_t k = 0; k < base.size(); ++k)
    soup.add_face(added(soup, {base[(k + 1) % base.size()], base[k], apex}));
}

void add_prism(Polygon_soup& soup, const Points& base, const Exact_point& along) {
  const auto moved = [&](const Exact_point& p) {
    return Exact_point{p[0] + along[0], p[1] + along[1], p[2] + along[2]};
  };
  soup.add_face(added(soup, base));
  Points top;
  for (const Exact_point& p : base) top.push_back(moved(p));
  std::reverse(top.begin(), top.end());
  soup.add_face(added(soup, top));
  for (std::size_t k = 0; k < base.size(); ++k) {
    const Exact_point &p = base[k], &q = base[(k + 1) % base.size()];
    soup.add_face(added(soup, {q, p, moved(p), moved(q)}));
  }
}

Exact_point any_step(const Posed_scene& scene, Random& random) {
  Exact_point step = lattice(random, 2);
  if (random.chance(1, 3)) return {0, 0, 0};
  const Rational unit = random.chance(1, 3) ? ulps_of_size(1, size_bits(scene.soup)) : Rational(1);
  for (Rational& x : step) x *= unit;
  return step;
}

Polygon_soup joined(std::span<const Polygon_soup, 2> solids) {
  Polygon_soup soup;
  for (const Polygon_soup& solid : solids) {
    std::map<Exact_point, Point_id> there;
    for (Face_id f = 0; f < solid.face_count(); ++f)
      for (std::size_t k = 0; k < solid.loop_count(f); ++k) {
        std::vector<Point_id> loop;
        for (const Point_id p : solid.loop(f, k)) {
          const Exact_point at = solid.point(p);
          const auto found = there.find(at);
          loop.push_back(found != there.end() ? found->second
                                              : there.emplace(at, soup.add_point(at[0], at[1], at[2])).first->second);
        }
        if (k == 0) soup.add_face(loop);
        else soup.add_hole(loop);
      }
  }
  return soup;
}

Solid_pair solids_of(const Polygon_soup& soup, std::size_t first) {
  Solid_pair solids;
  for (Polygon_soup& solid : solids) solid.coordinates = soup.coordinates;
  for (Face_id f = 0; f < soup.face_count(); ++f)
    for (std::size_t k = 0; k < soup.loop_count(f); ++k) {
      Polygon_soup& solid = solids[f < first ? 0 : 1];
      if (k == 0) solid.add_face(soup.loop(f));
      else solid.add_hole(soup.loop(f, k));
    }
  const Polygon_soup nothing;  // points in use only, as joined() leaves them
  return {joined(std::array{solids[0], nothing}), joined(std::array{solids[1], nothing})};
}

Solid_pair pair_of_solids(const Posed_scene& scene, Random& random) {
  if (scene.first > 0) return solids_of(scene.soup, scene.first);
  std::vector<Points> bases;
  for (Face_id f = 0; f < scene.soup.face_count(); ++f)
    if (Points base = base_of(scene.soup, f, true); !base.empty()) bases.push_back(std::move(base));
  if (bases.empty()) return {};
  constexpr int tries = 20;  // an apex may be in the base's plane
  for (int k = 0; k < tries; ++k) {
    const Exact_point apex = random.chance(1, 2) ? scene.eye : lattice(random, 8), along = lattice(random, 3),
                      other_apex = lattice(random, 8), other_along = lattice(random, 3);
    const Points &base = bases[random.below(bases.size())], &other = bases[random.below(bases.size())];
    Solid_pair pair{any_solid(base, apex, along, random), {}};
    switch (random.below(4)) {
      case 0: pair[1] = any_solid(other, apex, along, random); break;
      case 1: pair[1] = any_solid(other, other_apex, other_along, random); break;
      case 2: pair[1] = any_solid(base, other_apex, other_along, random); break;
      default: pair[1] = translated(pair[0], any_step(scene, random));
    }
    if (pair[0].face_count() > 0 && pair[1].face_count() > 0) return pair;
  }
  return {};
}

Solid_pair pair_of_copies(const Polygon_soup& soup, Random& random) {
  if (soup.face_count() == 0) return {};
  const auto [low, high] = box_of(soup);
  Exact_point step{0, 0, 0};
  const bool near = random.chance(1, 4);
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational unit = near ? ulps_of_size(1, size_bits(soup)) : Rational((high[k] - low[k]) / 4);
    step[k] = unit * integer(random, -4, 4);
    if (random.chance(1, 3)) step[k] = 0;
  }
  return {soup, translated(soup, step)};
}

Solid_pair pair_on_a_plane(const Polygon_soup& a, const Polygon_soup& b, Random& random) {
  // 1. A corner on a corner, with the axis along which both faces may be told from it.
  const Corner_of_face to = any_corner(a, random), from = any_corner(b, random);
  std::size_t turns = 0, axis = 3;
  while (axis == 3 && turns < 3) {
    const Exact_point normal = axes_exchanged(from.normal, turns);
    for (std::size_t k = 0; k < 3 && axis == 3; ++k)
      if (to.normal[k] != 0 && normal[k] != 0) axis = k;
    if (axis == 3) ++turns;
  }
  const Exact_point normal = axes_exchanged(from.normal, turns);
  const Rational scale = power_of_two(side_bits(a) - side_bits(b));
  // 2. Along the axis, what is on the one plane goes to the other.
  return {a, mapped(b, [&](Point_id, const Exact_point& p) {
            const Exact_point away = axes_exchanged(minus(p, from.at), turns);
            Exact_point q = along(to.at, scale, away);
            if (axis < 3)
              q[axis] += scale * (dot(normal, away) / normal[axis] - dot(to.normal, away) / to.normal[axis]);
            return q;
          })};
}

Polygon_soup thin_tetrahedron(Random& random) {
  const int power = static_cast<int>(random.between(0, 24));
  const Rational far = power_of_two(power), eighth = power_of_two(power - 26);
  const std::size_t turns = random.below(3);
  constexpr std::array<std::array<long, 2>, 4> around{{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}};
  for (;;) {
    Points corners;
    for (const auto& [x, y] : around) {
      const Rational to_x = integer(random, -2, 2), to_y = integer(random, -2, 2), up = integer(random, 0, 15);
      corners.push_back(axes_exchanged({x + to_x, y + to_y, far + up * eighth}, turns));
    }
    Polygon_soup solid = soup_of({{corners[0], corners[1], corners[2]},
                                  {corners[0], corners[2], corners[3]},
                                  {corners[0], corners[3], corners[1]},
                                  {corners[1], corners[3], corners[2]}});
    const int sign = sgn(volume(solid));
    if (sign != 0) return sign > 0 ? solid : faces_reversed(solid);
  }
}

/// So that its corners are rounded to floats by much.
static Polygon_soup turned_far_away(const Faces& faces, Random& random) {
  const Exact_point turn = lattice(random, 3);
  const Rational far = power_of_two(static_cast<int>(random.between(16, 20)));
  return translated(rotated(soup_of(faces), rotation(4, turn[0].get_num().get_si(), turn[1].get_num().get_si(),
                                                     turn[2].get_num().get_si())),
                    {far, ratio(1, 3), far / 3});
}

Polygon_soup tetrahedron_upon_a_box(Random& random) {
  Faces faces = box(at(-2, -2, 0), at(2, 2, 1));
  const Rational from = integer(random, -1, 1), to = integer(random, -1, 1), height = integer(random, 2, 3);
  const Exact_point p = at(-3, from, 1), q = at(3, to, 1), r = at(-1, 2, height), s = at(1, -2, height);
  add(faces, {{p, r, q}, {p, q, s}, {p, s, r}, {q, r, s}});
  return turned_far_away(faces, random);
}

Polygon_soup tetrahedron_below_a_top(Random& random) {
  Faces faces = box(at(-4, -4, -4), at(4, 4, 1));
  const Rational from = integer(random, -1, 1), to = integer(random, -1, 1), depth = integer(random, 0, 1);
  const Exact_point p = at(-3, from, 1), q = at(3, to, 1), r = at(-1, 2, -depth), s = at(1, -2, -depth);
  add(faces, {{p, r, q}, {p, q, s}, {p, s, r}, {q, r, s}});  // mirrored, so its fronts look into the hollow
  return turned_far_away(faces, random);
}

}  // namespace sightline::generate
