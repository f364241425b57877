#pragma once
// Scenes that no family makes: faces of all kinds of outlines, bent, repeated and set aside; solids; faces apart, or
// about an eye between them; and faces so small that products of their coordinates are beyond doubles.

#include "support.h"

#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace fuzz {

using generate::Posed_scene;
using generate::Random;
using sightline::cross;  // beside those of other targets
using sightline::dot;
using Outline = std::vector<std::array<long, 2>>;
using Outlines = std::vector<Outline>;  // the first, and its holes

/// Whether the first three corners are not in line.
inline bool spans_a_plane(const generate::Points& face) {
  return cross(minus(face[1], face[0]), minus(face[2], face[0])) != Exact_point{0, 0, 0};
}

/// Convex, straight, concave, keyholes, pinched, with holes that touch; and what is set aside.
inline Outlines outlines_without_thorns(Random& random) {
  static const std::vector<Outlines> some{
      {{{0, 0}, {3, 0}, {0, 3}}},
      {{{0, 0}, {3, 0}, {3, 3}, {0, 3}}},
      {{{0, 0}, {1, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 2}}},
      {{{0, 0}, {3, 0}, {3, 1}, {3, 2}, {3, 3}, {1, 3}, {0, 3}}},
      {{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}}},
      {{{0, 0}, {4, 1}, {8, 0}, {5, 3}, {4, 8}, {3, 3}}},
      {{{1, 0}, {2, 0}, {3, 1}, {3, 2}, {2, 3}, {1, 3}, {0, 2}, {0, 1}}},
      {{{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0}, {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}}},
      {{{0, 0}, {6, 0}, {6, 3}, {4, 3}, {4, 1}, {2, 1}, {2, 5}, {4, 5}, {4, 3}, {6, 3}, {6, 6}, {0, 6}}},
      {{{0, 0}, {4, 0}, {6, 0}, {4, 0}, {4, 4}, {0, 4}}},
      {{{0, 0}, {2, 2}, {4, 0}, {4, 4}, {2, 2}, {0, 4}}},
      {{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}, {1, 1}, {2, 2}, {3, 3}, {5, 5}, {2, 2}}},
      {{{0, 0}, {6, 0}, {6, 6}, {0, 6}}, {{1, 1}, {1, 3}, {3, 3}, {3, 1}}},
      {{{0, 0}, {6, 0}, {6, 6}, {0, 6}}, {{1, 1}, {3, 1}, {3, 3}}, {{3, 3}, {5, 5}, {5, 3}}},
      {{{0, 0}, {6, 0}, {6, 6}, {0, 6}}, {{0, 3}, {3, 1}, {3, 5}}},
      {{{0, 0}, {4, 4}, {4, 0}, {0, 4}}},
      {{{0, 0}, {1, 1}, {2, 2}}},
      {{{0, 0}, {3, 0}, {0, 3}, {0, 0}, {3, 0}, {0, 3}}}};
  if (random.chance(2, 3)) return some[random.below(some.size())];
  Outlines any(1);
  for (std::uint64_t k = 3 + random.below(5); k > 0; --k) {
    const long x = static_cast<long>(random.between(0, 4)), y = static_cast<long>(random.between(0, 4));
    any[0].push_back({x, y});
  }
  if (random.chance(1, 2)) {  // around their middle, so that they are hardly ever crossed
    const auto half = [](const std::array<long, 2>& p) { return p[1] > 2 || (p[1] == 2 && p[0] > 2); };
    std::stable_sort(any[0].begin(), any[0].end(), [&](const auto& p, const auto& q) {
      if (half(p) != half(q)) return half(p) < half(q);
      return (p[0] - 2) * (q[1] - 2) - (p[1] - 2) * (q[0] - 2) > 0;
    });
  }
  return any;
}

/// Such outlines; some with a spike that goes anywhere and comes back.
inline Outlines any_outlines(Random& random) {
  Outlines any = outlines_without_thorns(random);
  if (random.chance(1, 6)) {
    Outline& loop = any[random.below(any.size())];
    const auto at = loop.begin() + static_cast<std::ptrdiff_t>(random.below(loop.size()));
    const std::array<long, 2> from = *at;
    const std::array<long, 2> to{static_cast<long>(random.between(-1, 9)), static_cast<long>(random.between(-1, 9))};
    if (to != from) loop.insert(at, {from, to});
  }
  return any;
}

/// A face of such outlines anywhere; with `bent`, some points of it elsewhere.
inline void add_outlines(Polygon_soup& soup, const Outlines& outlines, bool bent, Random& random) {
  const Exact_point origin = generate::lattice(random, 4);
  const std::array<Exact_point, 2> along = generate::directions(random, 2);
  std::map<std::array<long, 2>, Point_id> ids;
  for (std::size_t k = 0; k < outlines.size(); ++k) {
    std::vector<Point_id> loop;
    for (const auto& [x, y] : outlines[k]) {
      const auto [place, is_new] = ids.try_emplace({x, y});
      if (is_new) {
        Exact_point p = generate::along(generate::along(origin, x, along[0]), y, along[1]);
        if (bent && random.chance(1, 4)) p = generate::along(p, 1, generate::lattice(random, 1));
        place->second = soup.add_point(p[0], p[1], p[2]);
      }
      loop.push_back(place->second);
    }
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(random.below(loop.size())), loop.end());
    if (random.chance(1, 8)) std::reverse(loop.begin(), loop.end());
    if (k == 0) soup.add_face(loop);
    else soup.add_hole(loop);
  }
}

/// The face once more: begun elsewhere, the other way round, or less a corner.
inline void add_again(Polygon_soup& soup, Face_id face, Random& random) {
  const std::uint64_t change = random.below(4);
  for (std::size_t k = 0, loops = soup.loop_count(face); k < loops; ++k) {
    std::vector<Point_id> loop(soup.loop(face, k).begin(), soup.loop(face, k).end());
    if (change > 0)
      std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(random.below(loop.size())), loop.end());
    if (change == 2) std::reverse(loop.begin(), loop.end());
    if (change == 3 && loop.size() > 3) loop.pop_back();
    if (k == 0) soup.add_face(loop);
    else soup.add_hole(loop);
  }
}

inline Polygon_soup soup_of_outlines(std::size_t faces, Random& random) {
  Polygon_soup soup;
  while (soup.face_count() < faces) {
    const bool bent = random.chance(1, 2);
    if (soup.face_count() > 0 && random.chance(1, 4))
      add_again(soup, static_cast<Face_id>(random.below(soup.face_count())), random);
    else add_outlines(soup, any_outlines(random), bent, random);
  }
  return soup;
}

/// Boxes, some of them twice or less a face, and tetrahedra.
inline generate::Faces solids(Random& random) {
  generate::Faces faces;
  for (std::uint64_t k = 1 + random.below(2); k > 0; --k) {
    generate::Faces solid;
    if (random.chance(1, 2)) {
      const Exact_point low = generate::lattice(random, 2);
      Exact_point high = low;
      for (Rational& x : high) x += generate::integer(random, 1, 3);
      solid = generate::box(low, high);
    } else {
      const Exact_point p = generate::lattice(random, 2), q = generate::lattice(random, 2),
                        r = generate::lattice(random, 2), s = generate::lattice(random, 2);
      solid = {{p, q, r}, {p, r, s}, {p, s, q}, {q, s, r}};
    }
    if (random.chance(1, 4)) solid.pop_back();
    if (random.chance(1, 4)) generate::add(faces, solid);
    generate::add(faces, solid);
  }
  if (random.chance(1, 2)) generate::shuffle(faces, random);
  return faces;
}

/// Long faces on two sides of the eye, which is the origin: narrow across each other, so that what keeps their cones
/// apart, if anything does, is a plane through a corner of each.
inline generate::Faces about_the_eye(Random& random) {
  generate::Faces faces;
  const std::size_t axis = random.below(3);
  for (std::uint64_t k = 2 + random.below(3); k > 0; --k) {
    const bool beyond = random.chance(1, 2);
    const std::int64_t narrow = random.between(0, 2), wide = random.between(1, 6);
    generate::Points face;
    for (std::uint64_t corners = 3 + random.below(2); corners > 0; --corners) {
      Exact_point p;
      p[axis] = generate::integer(random, 1, 3);
      p[(axis + 1) % 3] = generate::integer(random, -narrow, narrow);
      p[(axis + 2) % 3] = generate::integer(random, -wide, wide);
      if (beyond) p = {Rational(-p[0]), Rational(-p[1]), Rational(-p[2])};
      if (beyond && face.size() == 0) std::swap(p[(axis + 1) % 3], p[(axis + 2) % 3]);
      face.push_back(p);
    }
    if (face.size() == 4) face[3] = generate::along(face[0], 1, minus(face[2], face[1]));  // a parallelogram
    // Seen from the front.
    if (dot(cross(minus(face[1], face[0]), minus(face[2], face[0])), face[0]) > 0)
      std::reverse(face.begin(), face.end());
    faces.push_back(std::move(face));
  }
  return faces;
}

/// Groups of faces, each in a box of its own; boxes touch.
inline generate::Faces groups(Random& random) {
  generate::Faces faces;
  for (std::uint64_t k = 2 + random.below(3); k > 0; --k) {
    Exact_point middle = generate::lattice(random, 1);
    for (Rational& x : middle) x *= 4;
    for (std::uint64_t n = 1 + random.below(4); n > 0; --n) {
      generate::Points face = generate::any_face(random, 2);
      for (Exact_point& p : face) p = generate::along(middle, 1, p);
      faces.push_back(std::move(face));
    }
  }
  return faces;
}

/// Some of the faces far smaller than others, about the origin or a corner.
inline generate::Faces of_many_scales(generate::Faces faces, Random& random) {
  static constexpr std::array powers{-60, -300, -460, -505, -510, -515, -530, -1040, 200};
  const Rational scale = generate::power_of_two(powers[random.below(powers.size())]);
  const bool at_origin = random.chance(1, 2);
  for (generate::Points& face : faces) {
    if (random.chance(1, 2)) continue;
    const Exact_point centre = at_origin ? Exact_point{0, 0, 0} : face[0];
    for (Exact_point& p : face) p = generate::along(centre, scale, minus(p, centre));
  }
  return faces;
}

inline Posed_scene any_soup(Random& random) {
  Posed_scene scene;
  scene.name = "soup";
  scene.eye = generate::half_lattice(random, 5);
  switch (random.below(6)) {
    case 0: scene.soup = soup_of_outlines(1 + random.below(5), random); break;
    case 1: scene.soup = generate::soup_of(solids(random)); break;
    case 2:
      scene.soup = generate::soup_of(about_the_eye(random));
      scene.eye = {0, 0, 0};
      break;
    case 3: scene.soup = generate::soup_of(groups(random)); break;
    default: {
      generate::Faces faces;
      generate::add_any(faces, 2 + random.below(6), random);
      const bool scales = random.chance(1, 2);
      scene.soup = generate::soup_of(scales ? of_many_scales(faces, random) : faces);
    }
  }
  return scene;
}

}  // namespace fuzz
