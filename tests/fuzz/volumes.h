#pragma once
// Given volumes, rooms say: they are taken iff they close up, go nowhere through themselves and overlap nowhere; and
// points of leaves of the division are in the volumes that it says.

#include "refusals.h"
#include "support.h"

#include <sightline/algorithms/levels/volumes.h>
#include <sightline/algorithms/weak_visibility/volume.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

namespace fuzz {

namespace rooms {

using generate::Faces;
using generate::Points;
using generate::Random;
using sightline::cross;
using sightline::dot;

/// n (x - p) <= 0
struct Half_space {
  Exact_point normal, point;

  int side(const Exact_point& x) const { return sgn(dot(normal, minus(x, point))); }
};

/// A box, a tetrahedron or a slanted prism, fronts outside; on a lattice, so that volumes touch in all ways.
inline Faces convex_room(Random& random) {
  const Exact_point low = generate::lattice(random, 3);
  const auto size = [&] { return generate::integer(random, 1, 3); };
  Faces faces;
  switch (random.below(3)) {
    case 0: {
      Exact_point high = low;
      for (Rational& x : high) x += size();
      return generate::box(low, high);
    }
    case 1: {
      std::array<Exact_point, 4> p;
      do
        for (Exact_point& x : p) x = generate::lattice(random, 4);
      while (sgn(dot(cross(minus(p[1], p[0]), minus(p[2], p[0])), minus(p[3], p[0]))) == 0);
      if (sgn(dot(cross(minus(p[1], p[0]), minus(p[2], p[0])), minus(p[3], p[0]))) > 0) std::swap(p[0], p[1]);
      return {{p[0], p[1], p[2]}, {p[0], p[3], p[1]}, {p[1], p[3], p[2]}, {p[2], p[3], p[0]}};
    }
    default: {
      const Rational dx = generate::integer(random, -2, 2), dy = generate::integer(random, -2, 2), dz = size();
      const Rational a = size(), b = size();
      const auto corner = [&](const Rational& x, const Rational& y, bool above) {
        return above ? Exact_point{Rational(low[0] + x + dx), Rational(low[1] + y + dy), Rational(low[2] + dz)}
                     : Exact_point{Rational(low[0] + x), Rational(low[1] + y), low[2]};
      };
      const std::array<Exact_point, 3> l{corner(0, 0, false), corner(a, 0, false), corner(0, b, false)},
          h{corner(0, 0, true), corner(a, 0, true), corner(0, b, true)};
      return {{l[0], l[2], l[1]},
              {h[0], h[1], h[2]},
              {l[0], l[1], h[1], h[0]},
              {l[1], l[2], h[2], h[1]},
              {l[2], l[0], h[0], h[2]}};
    }
  }
}

/// A closed polyhedron, fronts outside, and convex parts of it by half-spaces.
struct Room {
  Faces faces;
  std::vector<std::vector<Half_space>> parts;
};

inline std::vector<Half_space> half_spaces_of(const Faces& faces) {
  std::vector<Half_space> all;
  for (const Points& face : faces) all.push_back({cross(minus(face[1], face[0]), minus(face[2], face[0])), face[0]});
  return all;
}

inline Room whole(Faces faces) {
  std::vector<Half_space> sides = half_spaces_of(faces);
  return {std::move(faces), {std::move(sides)}};
}

/// A box without an edge: an L.
inline Room bent_room(Random& random) {
  const Exact_point o = generate::lattice(random, 3);
  const auto p = [&](long x, long y, long z) {
    return Exact_point{Rational(o[0] + x), Rational(o[1] + y), Rational(o[2] + z)};
  };
  Faces faces{{p(0, 0, 0), p(0, 2, 0), p(1, 2, 0), p(1, 1, 0), p(2, 1, 0), p(2, 0, 0)},
              {p(0, 0, 1), p(2, 0, 1), p(2, 1, 1), p(1, 1, 1), p(1, 2, 1), p(0, 2, 1)}};
  const Points around = faces[1];
  for (std::size_t k = 0; k < around.size(); ++k) {
    Exact_point a = around[k], b = around[(k + 1) % around.size()];
    Points side{b, a};
    a[2] -= 1;
    b[2] -= 1;
    side.push_back(a);
    side.push_back(b);
    faces.push_back(side);
  }
  return {
      faces,
      {half_spaces_of(generate::box(p(0, 0, 0), p(1, 2, 1))), half_spaces_of(generate::box(p(1, 0, 0), p(2, 1, 1)))}};
}

/// Two boxes with a box in common and a corner: one component, since they share that point, which goes through itself.
inline Faces crossing_rooms(Random& random) {
  const Exact_point o = generate::lattice(random, 3);
  const auto p = [&](long x, long y, long z) {
    return Exact_point{Rational(o[0] + x), Rational(o[1] + y), Rational(o[2] + z)};
  };
  Faces faces = generate::box(p(0, 0, 0), p(2, 2, 1));
  const Faces other = generate::box(p(0, 0, 0), p(1, 3, 2));
  faces.insert(faces.end(), other.begin(), other.end());
  return faces;
}

/// Whether half-spaces have a point inside all: the corners of what they have in common are in no plane. By each three
/// planes.
inline bool have_inside(const std::vector<Half_space>& all) {
  Points corners;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        const Exact_point &a = all[i].normal, &b = all[j].normal, &c = all[k].normal;
        const Rational determinant = dot(a, cross(b, c));
        if (determinant == 0) continue;
        const Rational da = dot(a, all[i].point), db = dot(b, all[j].point), dc = dot(c, all[k].point);
        const Exact_point bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
        Exact_point p;
        for (std::size_t x = 0; x < 3; ++x) p[x] = (da * bc[x] + db * ca[x] + dc * ab[x]) / determinant;
        if (std::all_of(all.begin(), all.end(), [&](const Half_space& h) { return h.side(p) <= 0; }))
          corners.push_back(p);
      }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  for (std::size_t i = 1; i < corners.size(); ++i)
    for (std::size_t j = 1; j < i; ++j)
      for (std::size_t k = 1; k < j; ++k)
        if (sgn(dot(cross(minus(corners[i], corners[0]), minus(corners[j], corners[0])),
                    minus(corners[k], corners[0]))) != 0)
          return true;
  return false;
}

/// Of a box, at times with a cavity, what is right in front of a small square, and right behind it, is inside iff it is
/// between the box's walls; also where rays from the square's middle come through an edge or a corner of the box, where
/// they run along a wall, in the square's plane or in that of a wall that begins behind them. Rays that go (1000003,
/// 7919 k, 104729 + k^2) are the first to be tried.
inline void sees_a_box(Random& random) {
  const long k = random.chance(2, 3) ? 1 : 2;
  Exact_point ray{1000003, 7919 * k, 104729 + k * k};
  if (random.chance(1, 2)) ray = generate::along({0, 0, 0}, -1, ray);
  const auto share = [&](long least, long most) { return Rational(generate::integer(random, least, most) / 8); };
  Exact_point low = generate::lattice(random, 3), high = low;
  for (Rational& x : high) x += generate::integer(random, 1, 4);
  // 1. A point from which a ray comes to a corner, to an edge or to the inside of a wall, or that is in a wall's plane.
  Exact_point target;
  for (std::size_t i = 0; i < 3; ++i) {
    const Rational size = high[i] - low[i];
    target[i] = low[i] + size * (random.chance(1, 2) ? share(0, 8) : generate::integer(random, 0, 1));
  }
  const Rational length = generate::integer(random, 0, 9) / (1000003 * 4);
  const Exact_point middle = generate::along(target, Rational(-length), ray);
  // 2. A small square around it, in any plane, or in one that the ray is in.
  Exact_point normal = generate::directions(random, 2)[0];
  if (random.chance(1, 3))
    normal = random.chance(1, 2) ? cross(ray, normal) : Exact_point{ray[1], Rational(-ray[0]), 0};
  if (is_zero(normal)) return;
  const Exact_point u = is_zero(cross(normal, Exact_point{1, 0, 0})) ? cross(normal, Exact_point{0, 1, 0})
                                                                     : cross(normal, Exact_point{1, 0, 0}),
                    v = cross(normal, u);
  Rational longest = 1;
  for (const Exact_point& d : {u, v})
    for (const Rational& x : d) longest = std::max(longest, Rational(abs(x)));
  const Rational size = Rational(1) / (longest * (std::int64_t{1} << 40));
  const auto corner = [&](long a, long b) {
    return generate::along(generate::along(middle, Rational(a * size), u), Rational(b * size), v);
  };
  const Points square{corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
  // 3. Whether some of what is right in front, or behind, is inside: what the walls leave of the square.
  const Exact_point look = cross(minus(square[1], square[0]), minus(square[2], square[0]));
  const auto is_inside_beside = [&](int side) {
    Points left = square;
    for (std::size_t i = 0; i < 3; ++i)
      for (const int inwards : {1, -1}) {
        const auto height = [&](const Exact_point& p) {
          return Rational(inwards > 0 ? p[i] - low[i] : high[i] - p[i]);
        };
        if (std::all_of(left.begin(), left.end(), [&](const Exact_point& p) { return height(p) == 0; })) {
          if (side * inwards * sgn(look[i]) <= 0) return false;
          continue;
        }
        if (std::all_of(left.begin(), left.end(), [&](const Exact_point& p) { return height(p) <= 0; })) return false;
        Points part;
        for (std::size_t n = 0; n < left.size(); ++n) {
          const Exact_point &p = left[n], &q = left[(n + 1) % left.size()];
          const Rational at = height(p), after = height(q);
          if (at >= 0) part.push_back(p);
          if (sgn(at) * sgn(after) < 0) part.push_back(generate::along(p, Rational(at / (at - after)), minus(q, p)));
        }
        left = std::move(part);
      }
    return true;
  };
  Faces walls = generate::box(low, high);
  bool front = is_inside_beside(1), behind = is_inside_beside(-1);
  // 4. At times in a cavity: rays that come through the box's edges are not inside.
  Rational room = 1;
  for (std::size_t i = 0; i < 3; ++i)
    room = std::min({room, Rational(middle[i] - low[i]), Rational(high[i] - middle[i])});
  if (room * 64 > 1 && random.chance(1, 2)) {
    Exact_point from = middle, to = middle;
    for (std::size_t i = 0; i < 3; ++i) {
      from[i] -= room / 2;
      to[i] += room / 2;
    }
    for (const Points& wall : generate::box(from, to)) walls.push_back(generate::reversed(wall));
    front = behind = false;
  }
  random.shuffle(walls);
  if (random.chance(1, 2))
    for (Points& wall : walls) wall = generate::reversed(wall);
  const Weak_volume volume(generate::soup_of(walls));
  require(volume.sees_from_within(square, false) == front,
          "what is right in front of a square is inside a box iff it is between its walls");
  require(volume.sees_from_within(square, true) == behind,
          "what is right behind a square is inside a box iff it is between its walls");
}

}  // namespace rooms

inline void volumes(std::string_view bytes) {
  using namespace rooms;
  Random random(Bytes(bytes).word());

  // 1. Volumes, and whether they may be taken.
  if (random.chance(1, 3)) rooms::sees_a_box(random);
  std::vector<Faces> drawn;
  std::vector<std::vector<std::vector<rooms::Half_space>>> insides;  // of each the parts
  bool right = true;
  for (std::uint64_t count = 1 + random.below(4); count > 0; --count) {
    Room room = random.chance(1, 4) ? bent_room(random) : whole(convex_room(random));
    for (const auto& others : insides)
      for (const std::vector<rooms::Half_space>& other : others)
        for (const std::vector<rooms::Half_space>& part : room.parts) {
          std::vector<rooms::Half_space> both = other;
          both.insert(both.end(), part.begin(), part.end());
          right = right && !have_inside(both);
        }
    drawn.push_back(std::move(room.faces));
    insides.push_back(std::move(room.parts));
  }
  if (random.chance(1, 20)) {
    drawn.push_back(crossing_rooms(random));
    insides.emplace_back();
    right = false;
  }
  if (random.chance(1, 10)) {  // a face less, or turned round
    Faces& some = drawn[random.below(drawn.size())];
    Points& face = some[random.below(some.size())];
    if (random.chance(1, 2)) face = generate::reversed(face);
    else some.erase(some.begin() + (&face - some.data()));
    right = false;
  }

  // 2. Each with points of its own, looking inwards at times; faces in any order.
  Polygon_soup soup;
  std::vector<std::pair<std::size_t, Points>> faces;
  for (std::size_t v = 0; v < drawn.size(); ++v) {
    const bool inwards = random.chance(1, 3);
    for (const Points& face : drawn[v]) faces.emplace_back(v, inwards ? generate::reversed(face) : face);
  }
  random.shuffle(faces);
  std::vector<std::map<Exact_point, Point_id>> ids(drawn.size());
  std::vector<std::size_t> order;  // of volumes by their first faces
  for (const auto& [v, face] : faces) {
    if (std::find(order.begin(), order.end(), v) == order.end()) order.push_back(v);
    std::vector<Point_id> loop;
    for (const Exact_point& p : face) {
      const auto [at, is_new] = ids[v].try_emplace(p, static_cast<Point_id>(soup.point_count()));
      if (is_new)
        for (const Rational& x : p) soup.coordinates.push(x);
      loop.push_back(at->second);
    }
    soup.add_face(loop);
  }

  // 3. What is said of them.
  Volume_division division;
  std::size_t told = 0;
  const auto progress = [&](std::size_t done, std::size_t all) {
    ++told;
    require(done <= all, "nobody is told of more than all");
  };
  const bool refused = is_refused<std::invalid_argument>([&] { division = volume_division(soup, progress); });
  require(refused || drawn.empty() || told > 0, "who asks is told how far it is");
  require(refused != right, "volumes are refused iff one is open or goes through itself, or two overlap");
  if (refused) return;
  require(division.volumes == drawn.size(), "each volume is one");
  for (int k = 0; k < 20; ++k) {
    Exact_point p = generate::lattice(random, 40);
    for (Rational& x : p) x /= 7;
    std::int32_t at = division.tree.root;
    for (int side = 1; at >= 0 && side != 0;) {
      const auto& node = division.tree.nodes[static_cast<std::size_t>(at)];
      side = sgn(Rational(node.plane[0] * p[0] + node.plane[1] * p[1] + node.plane[2] * p[2] + node.plane[3]));
      if (side != 0) at = node.children[side > 0 ? 0 : 1];
    }
    if (at >= 0) continue;            // in the plane of a node
    std::size_t leaf = drawn.size();  // no border of a volume goes through a leaf, but one between parts may
    for (std::size_t n = 0; n < order.size(); ++n)
      for (const std::vector<rooms::Half_space>& part : insides[order[n]])
        if (std::all_of(part.begin(), part.end(), [&](const rooms::Half_space& h) { return h.side(p) <= 0; })) leaf = n;
    require(static_cast<std::size_t>(-1 - at) == leaf, "a point's leaf is the volume that it is in");
  }
}

}  // namespace fuzz
