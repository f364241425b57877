#include <sightline/harness/generate/touching_solids.h>

#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/transform.h>

#include <utility>
#include <vector>

namespace sightline::generate::touching_solids {

namespace {

// ---- Bodies below the plane z = 0, which they meet in a polygon, an edge or a corner

enum class Tip : std::size_t { corner, edge, face };
constexpr std::array<Tip, 3> tips{Tip::corner, Tip::edge, Tip::face};

/// A rectangle, a triangle or an L at a height, front up, with [-1, 1] x [-1, 1] in it; coordinates at most 4.
Points polygon_around(Random& random, const Rational& z) {
  const Rational a = integer(random, 1, 2), b = integer(random, 2, 4), c = integer(random, 1, 2),
                 d = integer(random, 2, 4);
  switch (random.below(3)) {
    case 0: return rectangle(-a, b, -c, d, z);
    case 1: return {at(-a, -c, z), at(a + 2, -c, z), at(-a, c + 2, z)};
    default: return {at(-a, -c, z), at(b, -c, z), at(b, 1, z), at(1, 1, z), at(1, d, z), at(-a, d, z)};
  }
}

/// A body that meets the plane in the origin alone, in an edge around it along x, or in a polygon around it.
Polygon_soup body_below(Tip tip, Random& random) {
  Polygon_soup body;
  const Rational depth = integer(random, 1, 3);
  switch (tip) {
    case Tip::corner: add_cone(body, reversed(polygon_around(random, -depth)), {0, 0, 0}); break;
    case Tip::edge: {
      const Rational from = integer(random, -2, -1), to = integer(random, 1, 2), left = integer(random, 1, 3),
                     right = integer(random, 1, 3), other_depth = integer(random, 1, 3);
      add_prism(body, {at(from, 0, 0), at(from, right, -depth), at(from, -left, -other_depth)}, at(to - from, 0, 0));
      break;
    }
    case Tip::face: {
      const Points top = polygon_around(random, 0);
      const Rational x = integer(random, -1, 1), y = integer(random, -1, 1);
      if (random.chance(1, 2)) add_cone(body, top, at(x, y, -depth));
      else add_prism(body, top, at(x, y, -depth));
    }
  }
  return body;
}

/// The body turned about x to the plane's other side.
Polygon_soup above(const Polygon_soup& body) {
  return mapped(body, [](Point_id, const Exact_point& p) { return at(p[0], -p[1], -p[2]); });
}
/// The body turned about z by a quarter.
Polygon_soup across(const Polygon_soup& body) {
  return mapped(body, [](Point_id, const Exact_point& p) { return at(-p[1], p[0], p[2]); });
}

// ---- Pairs

/// The second one moved by the gap; both anywhere, the plane z = 0 in any direction.
Solid_pair posed(Solid_pair pair, const Rational& gap, Random& random) {
  const Rational to_y = integer(random, -1, 1), x_to_z = integer(random, -1, 1), y_to_z = integer(random, -1, 1);
  const Exact_point origin = lattice(random, 1);
  const std::size_t turns = random.below(3);
  const bool flips_first = random.chance(1, 2), flips_second = random.chance(1, 2);
  pair[1] = translated(pair[1], at(0, 0, gap));
  for (Polygon_soup& solid : pair)
    solid = mapped(solid, [&](Point_id, const Exact_point& p) {
      Exact_point q = at(p[0], p[1] + to_y * p[0], p[2] + x_to_z * p[0] + y_to_z * p[1]);
      if (flips_first) q = at(-q[0], -q[1], q[2]);
      if (flips_second) q = at(q[0], -q[1], -q[2]);
      q = along(origin, 1, q);
      return at(q[turns % 3], q[(turns + 1) % 3], q[(turns + 2) % 3]);
    });
  return pair;
}

enum class Sides { one, two, any };

/// Two bodies, tip on tip; one of them turned by a quarter, at times.
Solid_pair tip_on_tip(Tip first, Tip second, Sides sides, const Rational& gap, Random& random) {
  Solid_pair pair{body_below(first, random), {}};
  pair[1] = body_below(second, random);
  if (random.chance(1, 2)) pair[1] = across(pair[1]);
  const bool two_sides = sides == Sides::two || (sides == Sides::any && random.chance(1, 2));
  if (two_sides) pair[1] = above(pair[1]);
  return posed(std::move(pair), gap, random);
}
Solid_pair either_order(Solid_pair pair, Random& random) {
  if (random.chance(1, 2)) std::swap(pair[0], pair[1]);
  return pair;
}

Solid_pair touching(Random& random, const Rational& gap) {
  const Tip first = tips[random.below(tips.size())], second = tips[random.below(tips.size())];
  return tip_on_tip(first, second, Sides::two, gap, random);
}

Solid_pair one_within_the_other(Random& random, const Rational& gap) {
  Polygon_soup within = body_below(tips[random.below(tips.size())], random);
  Polygon_soup around;
  add_prism(around, rectangle(-5, 5, -5, 5, 0), at(0, 0, -4));
  return posed({std::move(within), std::move(around)}, gap, random);
}

Solid_pair the_same_twice(Random& random, const Rational& gap) {
  const Polygon_soup body = body_below(tips[random.below(tips.size())], random);
  const std::vector<Face_id> order = random_order(body.face_count(), random.below(1000));
  return posed({body, with_faces(body, order)}, gap, random);
}

}  // namespace

const std::array<Drafter, 9> drafters{{
    {"solids_equal_planes", "a face of each in one plane, both bodies on one side of it",
     [](Random& random, const Rational& gap) { return tip_on_tip(Tip::face, Tip::face, Sides::one, gap, random); }},
    {"solids_opposite_planes", "a face of each in one plane, the bodies on its two sides; no intersection",
     [](Random& random, const Rational& gap) { return tip_on_tip(Tip::face, Tip::face, Sides::two, gap, random); }},
    {"solids_edge_on_edge", "an edge of one along or across an edge of the other, outside or inside it",
     [](Random& random, const Rational& gap) { return tip_on_tip(Tip::edge, Tip::edge, Sides::any, gap, random); }},
    {"solids_vertex_on_face", "a vertex of one on a face of the other, from outside or inside",
     [](Random& random, const Rational& gap) {
       return either_order(tip_on_tip(Tip::face, Tip::corner, Sides::any, gap, random), random);
     }},
    {"solids_vertex_on_edge", "a vertex of one on an edge of the other, from outside or inside",
     [](Random& random, const Rational& gap) {
       return either_order(tip_on_tip(Tip::edge, Tip::corner, Sides::any, gap, random), random);
     }},
    {"solids_vertex_on_vertex", "a vertex of each in one place, from outside or inside",
     [](Random& random, const Rational& gap) { return tip_on_tip(Tip::corner, Tip::corner, Sides::any, gap, random); }},
    {"solids_touching", "in a vertex, an edge or a face only: what they share has no volume, so no intersection",
     touching},
    {"solids_within", "the first inside the second, on its wall: no difference", one_within_the_other},
    {"solids_twice", "a solid and itself, its faces in another order: no difference", the_same_twice},
}};

void enlarge(Solid_pair& pair, std::size_t faces) {
  constexpr std::size_t side = 64;  // of a block of them
  for (std::size_t k = 0; pair[0].face_count() + pair[1].face_count() < faces; ++k) {
    const auto place = [](std::size_t count) -> Rational { return 32 + 2 * static_cast<long>(count); };
    const Exact_point p = at(place(k % side), place(k / side % side), place(k / (side * side)));
    add_cone(pair[1], {p, along(p, 1, {0, 1, 0}), along(p, 1, {1, 0, 0})}, along(p, 1, {0, 0, 1}));
  }
}

}  // namespace sightline::generate::touching_solids
