#include <sightline/harness/generate/many_corners.h>

#include <sightline/harness/generate/gap_drafts.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace sightline::generate {

namespace {

using Outline = std::vector<std::array<long, 2>>;

/// Between the parabolas y = x^2 and y = 2 n^2 - x^2, or under a lid.
Outline between_parabolas(long n, bool has_lid) {
  Outline outline;
  for (long x = -n; x <= n; ++x) outline.push_back({x, x * x});
  if (has_lid) {
    outline.push_back({n, n * n + 3});
    outline.push_back({-n, n * n + 3});
  } else {
    for (long x = n - 1; x > -n; --x) outline.push_back({x, 2 * n * n - x * x});
  }
  return outline;
}

Outline comb(long teeth) {
  Outline outline{{0, 0}, {2 * teeth - 1, 0}};
  for (long k = teeth - 1; k >= 0; --k) {
    outline.push_back({2 * k + 1, 3});
    outline.push_back({2 * k, 3});
    if (k == 0) break;
    outline.push_back({2 * k, 1});
    outline.push_back({2 * k - 1, 1});
  }
  return outline;
}

Outline saw(long teeth) {
  Outline outline{{0, 0}, {2 * teeth, 0}, {2 * teeth, 1}};
  for (long k = teeth - 1; k >= 0; --k) {
    outline.push_back({2 * k + 1, 3});
    outline.push_back({2 * k, 1});
  }
  return outline;
}

Outline stairs(long steps) {
  Outline outline{{0, 0}, {steps, 0}};
  for (long k = 1; k <= steps; ++k) {
    outline.push_back({steps - k + 1, k});
    outline.push_back({steps - k, k});
  }
  return outline;
}

/// A rectangle with a corner in the middle of nearly each unit of its border.
Outline straight_corners(long length) {
  Outline outline;
  for (long x = 0; x < length; ++x) outline.push_back({x, 0});
  outline.push_back({length, 0});
  outline.push_back({length, 1});
  for (long x = length; x >= 0; --x) outline.push_back({x, 2});
  return outline;
}

const Outline& star(Random& random) {
  static const std::vector<Outline> stars{
      {{4, 0}, {1, 1}, {0, 4}, {-1, 1}, {-4, 0}, {-1, -1}, {0, -4}, {1, -1}},
      {{4, 0},
       {2, 1},
       {3, 3},
       {1, 2},
       {0, 4},
       {-1, 2},
       {-3, 3},
       {-2, 1},
       {-4, 0},
       {-2, -1},
       {-3, -3},
       {-1, -2},
       {0, -4},
       {1, -2},
       {3, -3},
       {2, -1}},
      {{0, 0}, {5, 0}, {5, 5}, {1, 5}, {1, 2}, {3, 2}, {3, 3}, {2, 3}, {2, 4}, {4, 4}, {4, 1}, {0, 1}}};  // a spiral
  return stars[random.below(stars.size())];
}

/// In any plane of the lattice, begun anywhere, either way round.
Points placed(const Outline& outline, const Rational& width, const Rational& height, Random& random) {
  const auto [u, v] = directions(random, 1);
  const Exact_point origin = lattice(random, 2);
  Points face;
  for (const auto& [x, y] : outline)
    face.push_back(along(along(origin, Rational(x * width), u), Rational(y * height), v));
  std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(random.below(face.size())), face.end());
  return either_way(face, random);
}

/// A vector of the face's plane, between two of its corners.
Exact_point step(const Points& face, Random& random) {
  return minus(face[random.below(face.size())], face[random.below(face.size())]);
}

Exact_point off_the_plane(const Points& face, Random& random) {
  while (true) {
    const Exact_point d = lattice(random, 2);
    for (std::size_t k = 2; k < face.size(); ++k)
      if (!is_zero(cross(minus(face[1], face[0]), minus(face[k], face[0]))))
        if (sgn(dot(cross(minus(face[1], face[0]), minus(face[k], face[0])), d)) != 0) return d;
  }
}

Holed_face moved(Holed_face face, const Rational& t, const Exact_point& d) {
  face.outer = view_drafts::moved(std::move(face.outer), t, d);
  for (Points& hole : face.holes) hole = view_drafts::moved(std::move(hole), t, d);
  return face;
}

}  // namespace

Points round_face(Random& random) {
  const bool has_lid = random.chance(1, 3);
  const long n = static_cast<long>(random.between(2, has_lid ? 5 : 4));
  return placed(between_parabolas(n, has_lid), ratio(1, 2), ratio(1, n < 3 ? 2 : n < 4 ? 4 : 8), random);
}

Points many_cornered(Random& random) {
  const Rational half = ratio(1, 2);
  switch (random.below(7)) {
    case 0: return placed(comb(static_cast<long>(random.between(2, 5))), half, half, random);
    case 1: return placed(saw(static_cast<long>(random.between(3, 4))), half, half, random);
    case 2: return placed(stairs(static_cast<long>(random.between(3, 6))), half, half, random);
    case 3: return placed(straight_corners(static_cast<long>(random.between(3, 8))), half, half, random);
    case 4: return placed(star(random), half, half, random);
    default: return round_face(random);
  }
}

Faces many_corners(Random& random) {
  Faces faces;
  for (std::size_t count = 1 + random.below(2); count > 0; --count) faces.push_back(many_cornered(random));
  for (std::size_t count = random.below(4); count > 0; --count) {
    const Points& face = faces[random.below(faces.size())];
    const std::size_t k = random.below(face.size()), next = (k + 1) % face.size();
    Points other;
    switch (random.below(4)) {
      case 0: other = view_drafts::moved(face, ratio(1, 2), step(face, random)); break;           // in its plane
      case 1: other = view_drafts::moved(face, ratio(1, 2), off_the_plane(face, random)); break;  // before or behind it
      case 2: {                                                                                   // a wall upon an edge
        const Exact_point d = off_the_plane(face, random);
        other = {face[k], face[next], along(face[next], 1, d), along(face[k], 1, d)};
        break;
      }
      default: other = any_face(random);
    }
    faces.push_back(either_way(other, random));
  }
  return faces;
}

Holed_face flat_holes(Random& random, const Rational& gap) {
  static const std::vector<Outline> outers{
      {{0, 0}, {6, 0}, {6, 6}, {0, 6}},
      {{0, 0}, {3, -1}, {6, 0}, {7, 3}, {6, 6}, {3, 7}, {0, 6}, {-1, 3}},
      {{0, 0}, {6, 0}, {8, 3}, {6, 6}, {0, 6}, {2, 3}},
      {{0, 0}, {2, 0}, {3, 2}, {4, 0}, {6, 0}, {6, 6}, {4, 6}, {3, 4}, {2, 6}, {0, 6}}};
  static const std::vector<Outline> holes{
      {{0, 0}, {2, 0}, {0, 2}}, {{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {{1, 0}, {2, 1}, {1, 2}, {0, 1}},
      {{0, 0}, {2, 1}, {1, 2}}, {{0, 0}, {2, 0}, {2, 2}, {1, 1}}, {{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 1}, {0, 2}}};
  const auto [u, v] = directions(random, 1);
  const Exact_point origin = along(along(lattice(random, 2), ratio(-3, 2), u), ratio(-3, 2), v);
  const Rational half = ratio(1, 2);
  const auto at_place = [&, &u = u, &v = v](const Rational& x, const Rational& y) {
    return along(along(origin, Rational(x * half), u), Rational(y * half), v);
  };
  Holed_face face;
  for (const auto& [x, y] : outers[random.below(outers.size())]) face.outer.push_back(at_place(x, y));
  // In squares of their own as a rule, some of them beside the contour, so that they touch; or anywhere.
  std::array<std::array<long, 2>, 9> squares{};
  for (std::size_t k = 0; k < squares.size(); ++k)
    squares[k] = {2 * static_cast<long>(k % 3), 2 * static_cast<long>(k / 3)};
  for (std::size_t k = squares.size(); k > 1; --k) std::swap(squares[k - 1], squares[random.below(k)]);
  const std::size_t count = 1 + random.below(3);
  for (std::size_t k = 0; k < count; ++k) {
    std::array<long, 2> corner = squares[k];
    if (random.chance(1, 4))
      corner = {static_cast<long>(random.between(0, 5)), static_cast<long>(random.between(0, 5))};
    else if (count == 1 && random.chance(1, 2)) corner = {2, 2};
    const Rational size = random.chance(1, 3) ? ratio(1, 2) : Rational(1);
    const Rational aside = random.chance(1, 2) ? gap : Rational(0);
    Points& hole = face.holes.emplace_back();
    for (const auto& [x, y] : holes[random.below(holes.size())])
      hole.push_back(at_place(corner[0] + size * x + aside, corner[1] + size * y));
    hole = either_way(hole, random);
  }
  if (random.chance(1, 2)) {
    face.outer = reversed(face.outer);
    for (Points& hole : face.holes) hole = reversed(hole);
  }
  return face;
}

std::vector<Holed_face> windows(Random& random, const Rational& gap) {
  std::vector<Holed_face> faces;
  for (std::size_t count = 1 + random.below(2); count > 0; --count) faces.push_back(flat_holes(random, gap));
  for (std::size_t count = random.below(4); count > 0; --count) {
    const Holed_face& face = faces[random.below(faces.size())];
    if (face.holes.empty()) continue;
    const Points& hole = face.holes[random.below(face.holes.size())];
    const Exact_point d = off_the_plane(face.outer, random);
    Holed_face other;
    switch (random.below(6)) {
      case 0: other.outer = reversed(hole); break;  // its pane
      case 1:                                       // a bar through it
        other.outer = {along(centroid(hole), -1, d), along(hole[0], 1, d), along(hole[1], 1, d)};
        break;
      case 2:  // a wall upon its edge
        other.outer = {hole[0], hole[1], along(hole[1], 1, d), along(hole[0], 1, d)};
        break;
      case 3: other = moved(face, ratio(1, 2), d); break;         // the whole face once more, before or behind it
      case 4: other = moved(face, 1, step(hole, random)); break;  // and in its plane
      default: other.outer = any_face(random);
    }
    faces.push_back(std::move(other));
  }
  return faces;
}

}  // namespace sightline::generate
