#include <sightline/harness/laws/line_scenes.h>

#include <sightline/harness/generate/polygons.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline::harness::line_scenes {

using namespace generate;

/// Small faces far from all others, so that these are in trees of many boxes.
static void add_bystanders(Faces& faces, Random& random) {
  for (std::uint64_t count = 5 + random.below(26); count > 0; --count) {
    Exact_point p = lattice(random, 60), q = p, r = p;
    p[random.below(3)] += 100;
    q[random.below(3)] += 1;
    r[random.below(3)] -= 2;
    faces.push_back({p, along(p, 1, minus(q, r)), along(p, 1, lattice(random, 2))});
  }
}

Posed_scene any_pages(Random& random) {
  Posed_scene posed;
  Faces faces;
  const auto number = [&](std::int64_t least, std::int64_t most) { return integer(random, least, most); };
  const auto [u, v] = directions(random, 2);
  Exact_point axis = lattice(random, 2);
  while (sgn(dot(axis, cross(u, v))) == 0) axis = lattice(random, 2);
  const Exact_point origin = lattice(random, 3);
  const auto on_line = [&](const Rational& height) { return along(origin, height, axis); };
  std::vector<Exact_point> ways;
  for (std::uint64_t pages = 3 + random.below(3); pages > 0; --pages) {
    Exact_point way = along({0, 0, 0}, number(1, 2), u);
    way = along(way, number(-2, 2), v);
    if (random.chance(1, 4)) way = v;
    ways.push_back(way);
    const bool crosses = random.chance(3, 4);
    const Rational left = crosses ? number(-2, -1) : number(-2, 0),
                   right = crosses ? number(1, 2) : left + number(1, 3), low = number(-2, 2), high = low + number(1, 4);
    Points page;
    for (const auto& [across, up] : {std::array{left, low}, {right, low}, {right, high}, {left, high}})
      page.push_back(along(on_line(up), across, way));
    if (random.chance(1, 4)) page.erase(page.begin() + static_cast<std::ptrdiff_t>(random.below(page.size())));
    faces.push_back(either_way(page, random));
  }
  posed.eye = random.chance(1, 4) ? lattice(random, 6) : along(on_line(number(-3, 4)), number(-5, -1), ways[0]);
  for (std::uint64_t strips = random.below(3); strips > 0; --strips) {
    const Exact_point to = on_line(number(-8, 16) / 4), at = along(posed.eye, number(1, 3) / 4, minus(to, posed.eye));
    const Exact_point wide = lattice(random, 2), high = along({0, 0, 0}, number(1, 8) / 16, axis);
    if (is_zero(cross(wide, high))) continue;
    Points strip;
    for (const auto& [across, up] : {std::array{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
      strip.push_back(along(along(at, across, wide), up, high));
    faces.push_back(either_way(strip, random));
  }
  if (random.chance(3, 4)) add_bystanders(faces, random);
  if (random.chance(1, 2)) {
    const Exact_point from = on_line(-20), to = on_line(20), aside = lattice(random, 2);
    for (const int side : {-1, 1}) {
      const Exact_point slope = along(minus(posed.eye, on_line(0)), ratio(side, 8), aside);
      faces.push_back({from, to, along(to, ratio(1, 2), slope), along(from, ratio(1, 2), slope)});
    }
  }
  shuffle(faces, random);
  posed.soup = soup_of(faces);
  return posed;
}

Posed_scene any_outlines(Random& random) {
  Posed_scene posed;
  Faces faces;
  const auto [u, v] = directions(random, 2);
  const Exact_point origin = lattice(random, 3);
  const std::int64_t reach = random.between(1, 3);
  for (std::uint64_t outlines = 1 + random.below(3); outlines > 0; --outlines)
    for (int tries = 0; tries < 8; ++tries) {
      Points outline;
      for (std::uint64_t corners = 4 + random.below(5); corners > 0; --corners)
        outline.push_back(lattice_in_plane(random, origin, u, v, -reach, reach));
      if (const Scene scene(soup_of({outline})); scene.pieces().size() < 2) continue;
      faces.push_back(outline);
      if (random.chance(1, 2)) faces.push_back({outline[0], outline[1], lattice(random, 4)});
      break;
    }
  posed.eye = lattice(random, 6);
  shuffle(faces, random);
  posed.soup = soup_of(faces);
  return posed;
}

}  // namespace sightline::harness::line_scenes
