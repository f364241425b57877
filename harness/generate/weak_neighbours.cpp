#include <sightline/harness/generate/weak_neighbours.h>

#include <sightline/harness/generate/polygons.h>

#include <cstdint>

namespace sightline::generate::weak_drafts {

Draft hinged(Random& random, const Rational& gap) {
  Draft draft;
  const Rational near = Rational(1 - gap);
  if (random.chance(1, 2)) {
    draft.source = {at(0, -1, 0), at(2, -1, 0), at(2, 1, 0), at(0, 1, 0)};
    draft.faces = {{at(0, -1, 0), at(0, 1, 0), at(0, 1, 2), at(0, -1, 2)}};
    const Rational end = integer(random, 1, 2), side = integer(random, 1, 2);
    switch (random.below(3)) {
      case 0:
        draft.faces.push_back({at(gap, -1, gap), at(end, Rational(-side), end), at(end, side, end), at(gap, 1, gap)});
        break;
      case 1:
        draft.faces.push_back({at(0, -1, 0), at(near, Rational(-side), near), at(near, side, near), at(0, 1, 0)});
        break;
      default: draft.faces.push_back({at(0, -1, 0), at(end, -1, end), at(end, near, end), at(0, near, 0)});
    }
  } else {
    draft.source = {at(0, 0, 0), at(2, -1, 0), at(2, 1, 0)};
    draft.faces = {{at(0, 0, 0), at(0, 1, 2), at(0, -1, 2)}};
    switch (random.below(3)) {
      case 0: draft.faces.push_back({at(gap, 0, gap), at(1, -1, 1), at(1, 1, 1)}); break;
      case 1: draft.faces.push_back({at(0, 0, 0), at(near, Rational(-near), near), at(near, near, near)}); break;
      default: draft.faces.push_back({at(0, 0, 0), at(1, -1, 1), at(1, near, 1)});
    }
  }
  draft.truth = sgn(gap) > 0;
  return draft;
}

Draft facing(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  const Rational low = integer(random, -2, 1), high = Rational(low + integer(random, 1, 2)),
                 back = integer(random, -3, -1);
  draft.truth = sgn(gap) > 0;
  switch (random.below(6)) {
    case 0:
      draft.faces = {{at(-1, low, back), at(-1, high, back), at(-1, high, gap), at(-1, low, gap)}};
      break;  // a wall behind the source's plane but for its top
    case 1: {
      draft.faces = {{at(-1, low, 1), at(-1, high, back), at(-1, high, gap)}};
      draft.truth = true;
    } break;  // across it
    case 2:   // a wall, and the source behind it but for its rim
      draft.source = rectangle(back, gap, -1, 1, 0);
      draft.faces = {{at(0, low, 0), at(0, high, 0), at(0, high, 2), at(0, low, 2)}};
      break;
    case 3: draft.faces = {reversed(rectangle(low, high, low, high, gap))}; break;  // parallel, or in one plane
    case 4: {
      draft.faces = {rectangle(low, high, low, high, Rational(4 + gap))};
      draft.truth = false;
    } break;  // turned away
    default:  // a triangle that is hardly steeper than the source's plane: in front of it is p where gap (2 (x - low) -
              // (high - low) y) > 0
      draft.faces = {{at(low, -1, Rational(-gap)), at(high, 1, Rational(-gap)), at(low, 1, gap)}};
      draft.truth = sgn(gap) > 0 || (sgn(gap) < 0 && 2 * (-1 - low) < high - low);
  }
  return draft;
}

Draft lids(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  const Rational wide = Rational(1 + ratio(random.between(1, 2), 2));
  draft.faces.push_back(rectangle(Rational(-wide), wide, -1, wide, Rational(4 + gap)));
  draft.faces.push_back(rectangle(-1, wide, Rational(-wide), 1, random.chance(1, 2) ? Rational(-gap) : Rational(0)));
  draft.truth = sgn(gap) >= 0;
  return draft;
}

Draft valley(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  const Rational middle = ratio(random.between(-3, 3), 4);
  const std::uint64_t where = random.below(3);  // the gap: on the source, at the far end, at the side
  const long chosen = random.chance(1, 2) ? 1 : -1;
  for (const long side : {-1, 1}) {
    const Rational steepness = ratio(random.between(1, 7), 4), deep = ratio(random.between(0, 2), 4),
                   mine = side == chosen ? gap : Rational(0);
    const Rational from = where == 0 ? Rational(middle + side * mine) : Rational(middle - side * deep);
    const Rational to = Rational(side * (where == 1 ? Rational(1 - mine) : Rational(1))), low = -1,
                   high = where == 2 ? Rational(1 - mine) : Rational(1);
    const auto height = [&](const Rational& x) { return Rational(side * steepness * (x - middle)); };
    draft.faces.push_back(
        {at(from, low, height(from)), at(to, low, height(to)), at(to, high, height(to)), at(from, high, height(from))});
  }
  draft.truth = sgn(gap) > 0;
  return draft;
}

Exact_point box_size(Random& random) { return {integer(random, 1, 3), integer(random, 1, 3), integer(random, 1, 3)}; }

void all_are_targets(Draft& draft) {
  draft.targets.clear();
  for (std::size_t k = 0; k < draft.faces.size(); ++k) draft.targets.push_back(k);
}

Draft boxes(Random& random, const Rational& gap) {
  Draft draft;
  draft.bodies = true;
  const Exact_point low = lattice(random, 1), high = along(low, 1, box_size(random));
  switch (random.below(4)) {
    case 0: {  // one on the other: the upper one's bottom from the lower one's top
      const Exact_point base{Rational(low[0] + ratio(random.between(-1, 1), 2)),
                             Rational(low[1] + ratio(random.between(-1, 1), 2)), Rational(high[2] + gap)};
      draft.faces = box(low, high);
      draft.source = draft.faces[5];
      add(draft.faces, box(base, along(base, 1, box_size(random))));
      draft.targets = {10};
      draft.truth = sgn(gap) > 0;
      break;
    }
    case 1:  // a square in a box, one of whose walls is a little too small
      draft.source = rectangle(-3, 3, -3, 3, -1);
      draft.faces = {reversed(rectangle(-1, 1, -1, 1, 2))};
      add(draft.faces, box(at(-1, -1, 1), at(1, 1, 3)));
      shrink_one(draft.faces, 1, gap, random);
      if (sgn(gap) <= 0) draft.truth = false;
      break;
    case 2: {  // a room with a box in it, perhaps at a wall
      draft.faces = box(at(-3, -3, -3), at(3, 3, 3));
      for (Points& face : draft.faces) face = reversed(face);
      draft.source = draft.faces[random.below(6)];
      add(draft.faces, box(low, along(low, 2, at(1, 1, 1))));
      all_are_targets(draft);
      break;
    }
    default: {
      const Exact_point other = lattice(random, 4), third = lattice(random, 4);
      draft.faces = box(low, high);
      draft.source = draft.faces[random.below(6)];
      add(draft.faces, box(other, along(other, 1, box_size(random))));
      add(draft.faces, box(third, along(third, 1, box_size(random))));
      all_are_targets(draft);
      draft.targets.erase(draft.targets.begin(), draft.targets.begin() + 6);
    }
  }
  return draft;
}

void move_a_face(Draft& draft, std::size_t first, const Rational& gap, Random& random) {
  Points& face = draft.faces[first + random.below(draft.faces.size() - first)];
  const std::size_t axis = random.below(3);
  for (Exact_point& p : face) p[axis] += gap;
}

Draft lattice_faces(Random& random, const Rational& gap) {
  Draft draft;
  add_any(draft.faces, 2 + random.below(7), random);
  const Exact_point corner = lattice(random, 3);
  const auto [u, v] = directions(random, 3);
  draft.source = in_plane(corner, u, v, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  if (random.chance(1, 2)) draft.source.pop_back();
  move_a_face(draft, 0, gap, random);
  all_are_targets(draft);
  return draft;
}

Draft triangles(Random& random, const Rational& gap) {
  Draft draft = shaft(4);
  const Rational narrow = ratio(1, random.between(1, 6));
  for (Points* square : {&draft.source, &draft.faces[0]})
    for (Exact_point& p : *square) {
      p[0] *= narrow;
      p[1] *= narrow;
    }
  const std::size_t count = 3 + random.below(10);
  while (draft.faces.size() < count) {
    const Exact_point centre{ratio(random.between(-3, 3), 4), ratio(random.between(-3, 3), 4),
                             ratio(random.between(4, 12), 4)};
    Points corners(3, centre);
    for (Exact_point& p : corners)
      p = along(p, ratio(1, 4),
                Exact_point{integer(random, -12, 12), integer(random, -12, 12), integer(random, -3, 3)});
    if (!is_zero(cross(minus(corners[1], corners[0]), minus(corners[2], corners[0])))) draft.faces.push_back(corners);
  }
  move_a_face(draft, 1, gap, random);
  return draft;
}

}  // namespace sightline::generate::weak_drafts
