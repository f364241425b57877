#include <sightline/harness/generate/tangles.h>

#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace sightline::generate {

Points folded_loop(Random& random) {
  Points loop;
  for (std::size_t k = 5 + random.below(2); k > 0; --k) loop.push_back(lattice(random, 2));
  const std::size_t axis = random.below(3);
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) loop[k][axis] = loop[0][axis];
  return loop;
}

Faces tangle(Random& random, std::size_t most_faces) {
  static const std::vector<std::vector<std::array<int, 2>>> outlines{
      {{0, 0}, {1, 0}, {0, 1}},
      {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
      {{0, 0}, {2, 0}, {2, 1}, {0, 1}},
      {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
      {{-1, -1}, {2, -1}, {2, 2}, {1, 2}, {1, 0}, {0, 0}, {0, 2}, {-1, 2}},
      {{0, 0}, {2, -1}, {1, 0}, {2, 1}},
      {{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}},
      {{0, 0}, {1, 1}, {1, 0}, {0, 1}},                                       // crosses itself
      {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}, {1, 0}, {1, 1}, {0, 1}},       // twice round
      {{-1, -1}, {2, -1}, {2, 2}, {0, 2}, {0, 0}, {1, 0}, {1, 1}, {-1, 1}}};  // twice round its middle
  Faces faces;
  const std::size_t count = 1 + random.below(most_faces);
  while (faces.size() < count) {
    Points loop;
    switch (random.below(8)) {
      case 0:  // any loop, mostly not planar
        if (random.chance(1, 2)) loop = folded_loop(random);
        else
          for (std::size_t k = 3 + random.below(3); k > 0; --k) loop.push_back(lattice(random, 2));
        break;
      case 1:  // a triangle, at times without area
        for (std::size_t k = 0; k < 3; ++k) loop.push_back(lattice(random, 2));
        break;
      case 2:  // an earlier one again, perhaps turned, perhaps begun elsewhere
        if (faces.empty()) continue;
        loop = faces[random.below(faces.size())];
        if (random.chance(1, 2)) loop = reversed(loop);
        std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(random.below(loop.size())), loop.end());
        break;
      case 3: {  // axis-parallel
        const std::size_t axis = random.below(3);
        const Exact_point origin = lattice(random, 2);
        Exact_point u{0, 0, 0}, v{0, 0, 0};
        u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1;
        for (const auto& [a, b] : outlines[random.below(outlines.size())])
          loop.push_back(along(along(origin, a, u), b, v));
        break;
      }
      default: {  // an outline in any plane of the lattice
        const Exact_point origin = lattice(random, 2), u = lattice(random, 1), v = lattice(random, 1);
        for (const auto& [a, b] : outlines[random.below(outlines.size())])
          loop.push_back(along(along(origin, a, u), b, v));
      }
    }
    faces.push_back(loop);
  }
  return faces;
}

Faces touching_faces(Random& random) {
  Faces faces;
  const auto parallelogram = [](const Exact_point& p, const Exact_point& u, const Exact_point& v) {
    return Points{p, along(p, 1, u), along(along(p, 1, u), 1, v), along(p, 1, v)};
  };
  const std::size_t count = 2 + random.below(7);
  while (faces.size() < count) {
    const Exact_point p = lattice(random, 2), u = lattice(random, 1), v = lattice(random, 1);
    Points face;
    const std::uint64_t kind = faces.empty() ? random.below(2) : random.below(9);
    if (kind == 0) {
      face = {p, lattice(random, 2), lattice(random, 2)};
    } else if (kind == 1) {
      face = parallelogram(p, u, v);
    } else {
      const Points& other = faces[random.below(faces.size())];
      const std::size_t n = other.size(), k = random.below(n);
      const Exact_point &a = other[k], &b = other[(k + 1) % n], &c = other[(k + 2) % n];
      const Exact_point inner = centroid({a, b, c}), middle = centroid({a, b});
      switch (kind) {
        case 2: {  // in its plane
          const Rational second = integer(random, -2, 2), first = integer(random, -2, 2);
          const Exact_point offset = along(along(Exact_point{0, 0, 0}, first, minus(b, a)), second, minus(c, a));
          for (const Exact_point& q : other) face.push_back(along(q, 1, offset));
          break;
        }
        case 3:  // parallel
          for (const Exact_point& q : other) face.push_back(along(q, 1, p));
          break;
        case 4: face = {b, a, p}; break;  // on its edge
        case 5: face = parallelogram(a, u, v); break;
        case 6: face = {middle, p, along(p, 1, u)}; break;
        case 7: face = {inner, p, along(p, 1, u)}; break;
        default: face = parallelogram(along(along(inner, ratio(-1, 2), u), ratio(-1, 2), v), u, v);  // through it
      }
    }
    if (is_zero(cross(minus(face[1], face[0]), minus(face[2], face[0])))) continue;
    if (random.chance(1, 2)) face = reversed(face);
    faces.push_back(face);
  }
  return faces;
}

}  // namespace sightline::generate
