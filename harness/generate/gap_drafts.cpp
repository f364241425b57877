#include <sightline/harness/generate/gap_drafts.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace sightline::generate::view_drafts {

std::array<Exact_point, 3> axes(Random& random) {
  while (true) {
    const auto [u, v] = directions(random, 2);
    const Exact_point w = lattice(random, 2), n = cross(u, v);
    if (sgn(Rational(n[0] * w[0] + n[1] * w[1] + n[2] * w[2])) != 0) return {u, v, w};
  }
}

Made duplicates(Random& random, const Rational& gap) {
  Faces faces;
  add_any(faces, 1 + random.below(4), random);
  const std::size_t count = faces.size() + 1 + random.below(4);
  while (faces.size() < count) {
    Points copy = faces[random.below(faces.size())];
    std::rotate(copy.begin(), copy.begin() + static_cast<std::ptrdiff_t>(random.below(copy.size())), copy.end());
    if (random.chance(1, 4)) copy.push_back(centroid({copy.front(), copy.back()}));
    copy = either_way(copy, random);
    faces.push_back(moved(copy, gap, unit_vector(random)));
  }
  return with_some_eyes(faces, random);
}

Made slender(Random& random, const Rational& gap) {
  Faces faces;
  for (std::size_t count = 1 + random.below(5); count > 0; --count) {
    const Exact_point p = lattice(random, 3);
    const auto [u, v, w] = axes(random);
    const Exact_point end = along(p, 2, u), middle = along(p, ratio(static_cast<long>(random.between(1, 7)), 4), u);
    Points face;
    switch (random.below(5)) {
      case 0: face = {p, end, along(middle, gap, v)}; break;                 // a cap
      case 1: face = {p, end, along(end, gap, v)}; break;                    // a needle
      case 2: face = {p, end, along(end, gap, v), along(p, gap, v)}; break;  // a sliver
      case 3: face = {p, middle, end, along(middle, gap, v)}; break;         // there and back
      default: face = {p, along(p, gap, u), along(p, gap, v)};               // next to a point
    }
    faces.push_back(either_way(face, random));
  }
  add_any(faces, 1 + random.below(5), random);
  return with_some_eyes(faces, random);
}

Made near_parallel(Random& random, const Rational& gap) {
  Faces faces;
  const Exact_point origin = lattice(random, 2);
  const auto [u, v, w] = axes(random);
  for (std::size_t count = 2 + random.below(5); count > 0; --count) {
    const Exact_point corner = lattice_in_plane(random, origin, u, v, -2, 1);
    const Exact_point first = along(u, Rational(gap * integer(random, -1, 2)), w),
                      second = along(v, Rational(gap * integer(random, -1, 2)), w);
    faces.push_back(either_way(in_plane(corner, first, second, outline(random)), random));
  }
  add_any(faces, random.below(4), random);
  return with_some_eyes(faces, random);
}

Made leaves(Random& random, const Rational& gap) {
  Faces faces;
  const Exact_point origin = lattice(random, 2);
  const auto [u, v, w] = axes(random);
  const std::size_t count = 2 + random.below(6);
  long level = 0;
  while (faces.size() < count) {
    const Exact_point corner = lattice_in_plane(random, along(origin, Rational(level * gap), w), u, v, -1, 0);
    faces.push_back(either_way(in_plane(corner, u, v, outline(random)), random));
    level += static_cast<long>(random.between(1, 2));
  }
  add_any(faces, random.below(3), random);
  Made made = with_some_eyes(faces, random, 2);
  made.eyes.push_back(along(origin, integer(random, 2, 5), w));
  made.eyes.push_back(along(origin, integer(random, -5, -2), w));
  return made;
}

Made equal_depth(Random& random, const Rational& gap) {
  Faces faces;
  const std::size_t axis = random.below(3);
  Exact_point toward{0, 0, 0}, u{0, 0, 0}, v{0, 0, 0};
  toward[axis] = u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
  const Exact_point eye = lattice(random, 2), middle = along(eye, integer(random, 1, 3), toward);
  for (std::size_t count = 2 + random.below(5); count > 0; --count) {
    const Exact_point corner = lattice_in_plane(random, middle, u, v, -2, 1);
    const Rational nearer = Rational(gap * integer(random, -1, 1));
    const bool crosses = random.chance(1, 4);
    const Exact_point up = crosses ? along(v, integer(random, -1, 1), toward) : v;
    faces.push_back(either_way(moved(in_plane(corner, u, up, outline(random)), nearer, toward), random));
  }
  add_any(faces, random.below(3), random);
  shuffle(faces, random);
  return {faces, {eye, along(middle, integer(random, 1, 3), toward), some_eye(faces, random)}};
}

Made collinear_edges(Random& random, const Rational& gap) {
  Faces faces;
  const Exact_point origin = lattice(random, 2);
  const auto [u, v, w] = axes(random);
  for (std::size_t count = 2 + random.below(6); count > 0; --count) {
    const std::int64_t from = random.between(-3, 2), to = random.between(from + 1, 3);
    const Rational sideways = integer(random, -2, 2);
    const Exact_point across = along(along({0, 0, 0}, sideways, v), integer(random, 1, 2), w),
                      off = random.chance(1, 2) ? v : w;
    const Rational apart = Rational(gap * integer(random, -1, 1));
    const Exact_point a = along(along(origin, apart, off), Rational(static_cast<long>(from)), u),
                      b = along(along(origin, apart, off), Rational(static_cast<long>(to)), u);
    const bool triangle = random.chance(1, 2);
    faces.push_back(either_way(
        triangle ? Points{a, b, along(a, 1, across)} : Points{a, b, along(b, 1, across), along(a, 1, across)}, random));
  }
  add_any(faces, random.below(3), random);
  Made made = with_some_eyes(faces, random, 2);
  made.eyes.push_back(along(origin, integer(random, -4, 4), u));
  return made;
}

const std::array<Gap_drafter, 6> gap_drafters{
    {Gap_drafter{"duplicates", "copies of faces, turned, begun elsewhere, with straight corners; K ulps apart",
                 duplicates},
     Gap_drafter{"slender", "needles, slivers and caps, K ulps wide: without area for 0", slender},
     Gap_drafter{"near_parallel", "faces whose planes lean from one plane by K ulps", near_parallel},
     Gap_drafter{"leaves", "stacked thin leaves, K ulps between them", leaves},
     Gap_drafter{"equal_depth", "tiles at one depth before the eye, each moved K ulps nearer or farther or not",
                 equal_depth},
     Gap_drafter{"collinear_edges", "pages with an edge each on one line, moved off it by K ulps", collinear_edges}}};

}  // namespace sightline::generate::view_drafts
