#include <sightline/harness/generate/view_drafts.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace sightline::generate::view_drafts {

Exact_point some_eye(const Faces& faces, Random& random) {
  const Points &f = faces[random.below(faces.size())], &g = faces[random.below(faces.size())];
  const std::size_t k = random.below(f.size());
  const Exact_point &a = f[k], &b = f[(k + 1) % f.size()], &c = f[(k + 2) % f.size()], &d = g[random.below(g.size())];
  switch (random.below(8)) {
    case 0: return along(b, integer(random, 1, 3), minus(b, a));
    case 1: {
      const Exact_point p = lattice_in_plane(random, a, minus(b, a), minus(c, a), -2, 2);
      return along(p, ratio(random.between(-1, 1), 2), minus(c, b));
    }
    case 2: return along(d, integer(random, 1, 3), minus(d, a));
    case 3: return half_lattice(random, 6);
    default: return lattice(random, 7);
  }
}

Made with_some_eyes(Faces faces, Random& random, std::size_t count) {
  Made made{std::move(faces), {}};
  shuffle(made.faces, random);
  for (std::size_t k = 0; k < count; ++k) made.eyes.push_back(some_eye(made.faces, random));
  return made;
}

Made coplanar(Random& random) {
  Faces faces;
  const Exact_point origin = lattice(random, 2);
  const auto [u, v] = directions(random, 2);
  const std::size_t count = 2 + random.below(5);
  while (faces.size() < count) {
    if (!faces.empty() && random.chance(1, 5)) {  // the same polygon the other way around
      faces.push_back(reversed(faces[random.below(faces.size())]));
      continue;
    }
    const Exact_point corner = lattice_in_plane(random, origin, u, v, -2, 1);
    faces.push_back(either_way(in_plane(corner, u, v, outline(random)), random));
  }
  add_any(faces, random.below(5), random);
  return with_some_eyes(faces, random, 4);
}

Made cyclic(Random& random) {
  static const std::vector<std::vector<std::array<long, 2>>> rounds{
      {{0, 6}, {-6, -4}, {6, -4}}, {{4, 4}, {-4, 4}, {-4, -4}, {4, -4}}, {{0, 6}, {-6, 2}, {-4, -5}, {4, -5}, {6, 2}}};
  const std::vector<std::array<long, 2>>& round = rounds[random.below(rounds.size())];
  const Rational width = ratio(1, static_cast<long>(random.between(2, 6)));
  Faces faces;
  for (std::size_t k = 0; k < round.size(); ++k) {
    const std::array<long, 2>&p = round[k], &q = round[(k + 1) % round.size()];
    const Exact_point from = at(p[0], p[1], 0), step = at(q[0] - p[0], q[1] - p[1], 2);
    const Exact_point across = at((p[1] - q[1]) * width / 2, (q[0] - p[0]) * width / 2, 0);
    const Exact_point low = along(along(from, ratio(-1, 4), step), ratio(-1, 2), across),
                      high = along(along(from, ratio(5, 4), step), ratio(-1, 2), across);
    faces.push_back(either_way({low, high, along(high, 1, across), along(low, 1, across)}, random));
  }
  add_any(faces, random.below(4), random);
  const std::size_t turn = random.below(3);  // which axis is up
  for (Points& face : faces)
    for (Exact_point& p : face) std::rotate(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(turn), p.end());
  Made made = with_some_eyes(faces, random, 2);
  for (const long height : {12, -9}) {
    Exact_point eye{integer(random, -3, 3), integer(random, -3, 3), height};
    std::rotate(eye.begin(), eye.begin() + static_cast<std::ptrdiff_t>(turn), eye.end());
    made.eyes.push_back(eye);
  }
  return made;
}

Made crossing(Random& random) {
  Faces faces;
  const auto around = [](const Exact_point& p, const Exact_point& u, const Exact_point& v) {
    return in_plane(along(along(p, ratio(-1, 2), u), ratio(-1, 2), v), u, v, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  };
  const Exact_point middle = lattice(random, 2), line = directions(random, 2)[0];
  const std::size_t count = 2 + random.below(5), kind = random.below(3);
  while (faces.size() < count) {
    Exact_point u = line, v = lattice(random, 3);
    if (kind == 1) u = lattice(random, 3);  // in one point only
    if (is_zero(cross(u, v))) continue;
    if (kind == 2 && !faces.empty()) {  // through another one's inner point
      const Points& other = faces[random.below(faces.size())];
      faces.push_back(either_way(around(along(other[0], ratio(1, 3), minus(other[2], other[0])), u, v), random));
    } else {
      faces.push_back(either_way(around(middle, u, v), random));
    }
  }
  add_any(faces, random.below(5), random);
  return with_some_eyes(faces, random, 4);
}

Made joined(Random& random) {
  Faces faces;
  const Exact_point origin = lattice(random, 1);
  const auto [u, v] = directions(random, 2);
  // A square in pieces that meet in T-junctions, some missing or turned, and others hinged on its edges.
  const long cut = static_cast<long>(random.between(1, 3));
  const std::vector<std::vector<std::array<long, 2>>> tiles{{{-2, -2}, {0, -2}, {0, 2}, {-2, 2}},
                                                            {{0, -2}, {2, -2}, {2, cut - 2}, {0, cut - 2}},
                                                            {{0, cut - 2}, {1, cut - 2}, {1, 2}, {0, 2}},
                                                            {{1, cut - 2}, {2, cut - 2}, {2, 2}, {1, 2}}};
  for (const auto& tile : tiles)
    if (random.chance(4, 5))
      faces.push_back(random.chance(1, 5) ? reversed(in_plane(origin, u, v, tile)) : in_plane(origin, u, v, tile));
  if (faces.empty()) faces.push_back(in_plane(origin, u, v, tiles[0]));
  for (std::size_t count = random.below(4); count > 0; --count) {
    const Points& other = faces[random.below(faces.size())];
    const std::size_t k = random.below(other.size());
    const Exact_point a = other[k], b = other[(k + 1) % other.size()], apex = lattice(random, 4);
    if (is_zero(cross(minus(a, apex), minus(b, apex)))) continue;
    switch (random.below(3)) {
      case 0: faces.push_back(either_way({b, a, apex}, random)); break;
      case 1: faces.push_back(either_way({centroid({a, b}), a, apex}, random)); break;  // on half the edge
      default: faces.push_back(either_way({b, a, along(a, 1, apex), along(b, 1, apex)}, random));
    }
    if (is_zero(cross(minus(faces.back()[1], faces.back()[0]), minus(faces.back()[2], faces.back()[0]))))
      faces.pop_back();
  }
  add_any(faces, random.below(4), random);
  return with_some_eyes(faces, random, 4);
}

Made boxes(Random& random) {
  const auto size = [&] { return Exact_point{integer(random, 1, 3), integer(random, 1, 3), integer(random, 1, 3)}; };
  const Exact_point low = lattice(random, 2), high = along(low, 1, size());
  Faces faces = box(low, high);
  Exact_point next_low = at(low[0], low[1], high[2]),
              next_high = at(high[0], high[1], Rational(high[2] + 1));  // a storey of the same plan
  switch (random.below(4)) {
    case 0: break;
    case 1: {
      next_low[0] += integer(random, -1, 1);
      next_low[1] += integer(random, -1, 1);
    }
      next_high = along(next_low, 1, size());
      break;
    case 2: {
      next_low = at(high[0], low[1], low[2]);
      next_high = along(next_low, 1, size());
    } break;  // beside it, on one plane
    default: {
      next_low = lattice(random, 2);
      next_high = along(next_low, 1, size());
    }  // anywhere, perhaps into it
  }
  add(faces, box(next_low, next_high));
  if (random.chance(1, 3)) {  // a wall in two pieces, its neighbours whole
    const std::size_t k = random.below(6);
    const Points wall = faces[k];
    const Rational share = ratio(random.between(1, 4), 5);
    const Exact_point p = along(wall[0], share, minus(wall[1], wall[0])),
                      q = along(wall[3], share, minus(wall[2], wall[3]));
    faces[k] = {wall[0], p, q, wall[3]};
    faces.push_back({p, wall[1], wall[2], q});
  }
  if (random.chance(1, 4))
    for (Points& face : faces) face = reversed(face);
  if (random.chance(1, 3)) faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(random.below(faces.size())));
  Made made = with_some_eyes(faces, random, 3);
  made.eyes.push_back(along(centroid({low, high}), ratio(1, 4), lattice(random, 1)));
  return made;
}

Made edge_on(Random& random) {
  const Exact_point eye = lattice(random, 4);
  Faces faces;
  for (std::size_t count = 1 + random.below(4); count > 0; --count) {
    const auto [u, v] = directions(random, 2);
    const Exact_point corner = lattice_in_plane(random, eye, u, v, -3, 2);
    faces.push_back(either_way(in_plane(corner, u, v, outline(random)), random));
  }
  if (random.chance(1, 2)) {  // an edge on a line through the eye, of a face that need not be edge-on otherwise
    const auto [u, v] = directions(random, 2);
    faces.push_back(either_way({along(eye, 1, u), along(eye, 3, u), along(along(eye, 2, u), 1, v)}, random));
    faces.push_back(
        either_way({along(eye, 2, u), along(eye, 3, u), along(along(eye, 2, u), 1, lattice(random, 3))}, random));
    if (is_zero(cross(u, minus(faces.back()[2], eye)))) faces.pop_back();
  }
  add_any(faces, 1 + random.below(5), random);
  shuffle(faces, random);
  return {faces, {eye, some_eye(faces, random)}};
}

Made touching(Random& random) {
  Faces faces;
  add_any(faces, 1 + random.below(8), random);
  const Points face = faces[random.below(faces.size())];
  const std::size_t k = random.below(face.size());
  const Exact_point &a = face[k], &b = face[(k + 1) % face.size()], &c = face[(k + 2) % face.size()];
  const Exact_point eyes[] = {a, centroid({a, b}), along(a, ratio(1, 3), minus(b, a)), centroid({a, b, c})};
  const Exact_point eye = eyes[random.below(4)];
  for (std::size_t count = random.below(4); count > 0; --count) {  // further ones with the eye on them
    const auto [u, v] = directions(random, 3);
    switch (random.below(3)) {
      case 0: faces.push_back(either_way({eye, along(eye, 1, u), along(eye, 1, v)}, random)); break;
      case 1: faces.push_back(either_way({along(eye, -1, u), along(eye, 1, u), along(eye, 1, v)}, random)); break;
      default:
        faces.push_back(
            either_way({along(eye, -1, u), along(along(eye, 1, u), -1, v), along(along(eye, 1, u), 1, v)}, random));
    }
  }
  shuffle(faces, random);
  return {faces, {eye, centroid({a, b, c}), a}};
}

Made inside(Random& random) {
  Faces faces = box(at(-5, -5, -5), at(5, 5, 5));
  if (random.chance(1, 2))
    for (Points& face : faces) face = reversed(face);
  if (random.chance(1, 3)) faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(random.below(6)));
  if (random.chance(1, 3)) {  // a box in the box, perhaps at its wall
    const Exact_point low = lattice(random, 3);
    add(faces, box(low, along(low, 2, at(1, 1, 1))));
  } else {
    add_any(faces, random.below(6), random);
  }
  Made made = with_some_eyes(faces, random, 1);
  made.eyes.push_back(lattice(random, 4));
  made.eyes.push_back(half_lattice(random, 4));
  Exact_point at_wall = lattice(random, 4);
  at_wall[random.below(3)] = random.chance(1, 2) ? 5 : -5;
  made.eyes.push_back(at_wall);
  return made;
}

Rational factor(Random& random) {
  static const std::array<Rational, 8> factors{ratio(1, 2), ratio(2, 3),  ratio(3, 2), ratio(2, 1),
                                               ratio(3, 1), ratio(-1, 1), ratio(4, 3), ratio(1, 1)};
  return factors[random.below(factors.size())];
}

Made aligned(Random& random) {
  const Exact_point eye = lattice(random, 5);
  Faces faces;
  for (std::size_t count = 1 + random.below(2); count > 0; --count) faces.push_back(any_face(random));
  for (std::size_t count = 1 + random.below(6); count > 0; --count) {
    Points face = faces[random.below(faces.size())];
    const Exact_point edge = minus(face[1], face[0]);
    const Rational scale = factor(random);
    Rational shift;
    switch (random.below(5)) {
      case 0:  // a triangle of the same outline in another plane
        face.resize(3);
        for (Exact_point& p : face) p = scaled_about(eye, abs(factor(random)), p);
        break;
      case 1:  // an edge stays in one plane with the eye
        shift = ratio(random.between(-2, 2), 2);
        for (Exact_point& p : face) p = along(scaled_about(eye, scale, p), shift, edge);
        break;
      case 2:
        face = {scaled_about(eye, scale, face[0]), scaled_about(eye, Rational(2 * scale), face[1]), lattice(random, 4)};
        break;  // one edge in common, to the eye
      default:
        for (Exact_point& p : face) p = scaled_about(eye, scale, p);
    }
    if (is_zero(cross(minus(face[1], face[0]), minus(face[2], face[0])))) continue;
    faces.push_back(either_way(face, random));
  }
  add_any(faces, random.below(4), random);
  shuffle(faces, random);
  return {faces, {eye}};
}

Made concurrent(Random& random) {
  const Exact_point eye = lattice(random, 5), ray = directions(random, 2)[0];
  Faces faces;
  for (std::size_t count = 3 + random.below(6); count > 0; --count) {
    const Exact_point p = along(eye, ratio(random.between(1, 12), 3), ray);
    const auto [u, v] = directions(random, 3);
    switch (random.below(5)) {
      case 0: faces.push_back({p, along(p, 1, u), along(p, 1, v)}); break;
      case 1: faces.push_back({along(p, -1, u), along(p, 1, u), along(p, 1, v)}); break;
      case 2: faces.push_back(in_plane(p, u, v, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})); break;
      case 3: faces.push_back(in_plane(p, u, v, {{0, 0}, {1, 0}, {1, 1}, {0, 1}})); break;
      default:
        faces.push_back(
            in_plane(p, u, v, {{0, 0}, {1, 0}, {1, 1}, {-1, 1}, {-1, -1}, {0, -1}}));  // a re-entrant corner
    }
    faces.back() = either_way(faces.back(), random);
  }
  shuffle(faces, random);
  return {faces, {eye}};
}

const std::array<Drafter, 11> drafters{
    {Drafter{"uniform", "any faces on a small lattice: many accidental coincidences", uniform},
     Drafter{"coplanar", "faces that overlap in one plane, turned either way, some of them twice", coplanar},
     Drafter{"cyclic", "three to five bars, each over the next", cyclic},
     Drafter{"crossing_faces", "faces through each other, many in one line or one point", crossing},
     Drafter{"joined", "a square in pieces that meet in T-junctions, and faces hinged on its edges", joined},
     Drafter{"box_pairs", "two boxes: stacked, side by side, one in the other, walls in pieces or missing", boxes},
     Drafter{"edge_on", "faces in planes through the eye, edges on lines through it", edge_on},
     Drafter{"touching", "the eye at a corner, on an edge, or on a face", touching},
     Drafter{"inside", "the eye in a closed or open box, also at its walls", inside},
     Drafter{"aligned", "faces scaled about the eye: edges and outlines that coincide in the view, equal depth",
             aligned},
     Drafter{"concurrent", "corners, edges and faces on one line of sight", concurrent}}};

}  // namespace sightline::generate::view_drafts
