#include <sightline/harness/generate/twisted_holes.h>

#include <cstddef>
#include <utility>

namespace sightline::generate {

namespace {

/// A square that winds up by a third of its side or so, or is cut in at a corner.
Points twisted_contour(Random& random) {
  const Rational lift = integer(random, -2, 2);
  if (random.chance(1, 3)) return {at(-3, -3, 0), at(3, -3, lift), at(3, 3, 0), at(-2, 2, 1), at(-3, 3, 0)};
  return {at(-3, -3, 0), at(3, -3, lift), at(3, 3, 0), at(-3, 3, lift)};
}

/// A contour of no area in all, and a hole beside its plane by the gap.
Holed_face around_nothing(Random& random, const Rational& gap) {
  const Rational wide = integer(random, 1, 3);
  return {{at(-3, -3, 0), at(3, 3, 0), at(3, -3, 0), at(-3, 3, 0)}, {{at(2, 0, 0), at(wide, 1, 0), at(1, 0, gap)}}};
}

/// A hole that leans from the upright by the gap.
Holed_face upright(Random& random, const Rational& gap) {
  const Rational height = integer(random, 1, 3);
  return {twisted_contour(random), {{at(-1, 0, 0), at(1, 0, 0), at(1, gap, height), at(-1, gap, height)}}};
}

/// A hole with a corner over or under the contour's first edge, inside it by the gap.
Holed_face at_the_edge(Random& random, const Rational& gap) {
  const Rational height = integer(random, -2, 2), along = integer(random, -1, 2);
  return {twisted_contour(random), {{at(along, Rational(gap - 3), height), at(1, -1, 0), at(-1, -1, 1)}}};
}

/// Holes inside the contour from above, which may touch it at a corner, and one another.
Holed_face inside(Random& random, const Rational& gap) {
  Holed_face face{twisted_contour(random), {{at(1, 0, 0), at(2, 0, 1), at(1, 1, 0)}}};
  if (random.chance(1, 2)) {
    const Rational height = integer(random, -1, 1);
    face.holes.push_back(
        {at(Rational(1 - gap), 0, random.chance(1, 2) ? Rational(0) : height), at(0, 1, 0), at(-1, 0, 0)});
  }
  if (random.chance(1, 3)) face.holes[0][1] = face.outer[random.below(face.outer.size())];
  return face;
}

Holed_face anywhere(Random& random) {
  Holed_face face;
  for (std::size_t k = 3 + random.below(3); k > 0; --k) face.outer.push_back(lattice(random, 3));
  for (std::size_t count = 1 + random.below(2); count > 0; --count) {
    Points& hole = face.holes.emplace_back();
    for (std::size_t k = 3 + random.below(2); k > 0; --k) hole.push_back(lattice(random, 2));
  }
  return face;
}

}  // namespace

Holed_face twisted_holes(Random& random, const Rational& gap) {
  Holed_face face;
  switch (random.below(5)) {
    case 0: face = around_nothing(random, gap); break;
    case 1: face = upright(random, gap); break;
    case 2: face = at_the_edge(random, gap); break;
    case 3: face = inside(random, gap); break;
    default: face = anywhere(random);
  }
  // Turned onto any axis, and sheared.
  const std::size_t turn = random.below(3);
  const bool mirrored = random.chance(1, 2);
  const Rational shear = random.chance(1, 2) ? integer(random, -1, 1) : Rational(0);
  const auto place = [&](Points& loop) {
    for (Exact_point& p : loop) {
      p[2] += shear * p[0];
      if (mirrored) std::swap(p[0], p[1]);
      p = {p[turn], p[(turn + 1) % 3], p[(turn + 2) % 3]};
    }
  };
  place(face.outer);
  for (Points& hole : face.holes) {
    place(hole);
    hole = either_way(hole, random);
  }
  return face;
}

}  // namespace sightline::generate
