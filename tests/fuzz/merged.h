#pragma once
// Pieces of one plane put together: they are as large as before, convex, and no two of them could be put together
// again.

#include "support.h"

#include <sightline/algorithms/weak_visibility/partition/merged_occluders.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <vector>

namespace fuzz {

/// Twice the area of all faces, each by its normal or against it, whichever goes with `ahead`.
inline Rational twice_area_ahead(const Polygon_soup& soup, const Exact_point& ahead) {
  Rational sum = 0;
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    std::vector<Exact_point> corners;
    for (const Point_id p : soup.loop(f)) corners.push_back(soup.point(p));
    sum += abs(Rational(dot(ahead, harness::Flat_face(corners).normal)));
  }
  return sum;
}

/// A wall of cells, whole, cut across or halved, some left out; in a plane of any direction, fronts to both sides.
struct Drawn_wall {
  Polygon_soup soup;
  Exact_point normal;

  explicit Drawn_wall(generate::Random& random) {
    std::array<std::array<long, 3>, 3> frame;
    for (auto& v : frame)
      for (long& x : v) x = static_cast<long>(random.between(-3, 3));
    const auto vector = [](const std::array<long, 3>& v) {
      return Exact_point{Rational(v[0]), Rational(v[1]), Rational(v[2])};
    };
    normal = cross(vector(frame[1]), vector(frame[2]));
    std::map<std::array<long, 2>, Point_id> known;
    const auto at = [&](long x, long y) {
      const auto [place, is_new] = known.try_emplace({x, y}, 0);
      if (is_new) {
        Exact_point p;
        for (std::size_t k = 0; k < 3; ++k) p[k] = frame[0][k] + x * frame[1][k] + y * frame[2][k];
        place->second = soup.add_point(p[0], p[1], p[2]);
      }
      return place->second;
    };
    const auto add = [&](std::vector<Point_id> corners) {
      if (random.chance(1, 4)) std::reverse(corners.begin(), corners.end());
      soup.add_face(corners);
    };
    const long columns = static_cast<long>(random.between(1, 4)), rows = static_cast<long>(random.between(1, 4));
    for (long x = 0; x < 2 * columns; x += 2)
      for (long y = 0; y < 2 * rows; y += 2) {
        const Point_id a = at(x, y), b = at(x + 2, y), c = at(x + 2, y + 2), d = at(x, y + 2);
        switch (random.below(8)) {
          case 0: break;
          case 1: add({a, b, c, d}); break;
          case 2: add({a, b, c}); break;
          case 3: {
            const Point_id left = at(x, y + 1), right = at(x + 2, y + 1);
            add({a, b, right, left});
            add({left, right, c, d});
            break;
          }
          case 4:
          case 5:
            add({a, b, c});
            add({a, c, d});
            break;
          default: add({a, b, d}); add({b, c, d});
        }
      }
  }
};

inline void try_merged_pieces(generate::Random& random) {
  const Drawn_wall wall(random);
  if (wall.soup.face_count() == 0 || is_zero(wall.normal)) return;
  const Polygon_soup merged = merged_pieces(Scene(wall.soup));
  require(twice_area_ahead(merged, wall.normal) == twice_area_ahead(wall.soup, wall.normal),
          "merged pieces are as large as before");
  const Scene again(merged);
  require(again.pieces().size() == merged.face_count(), "merged pieces are convex");
  require(merged_pieces(again).face_count() == merged.face_count(), "no two merged pieces are convex together");
}

}  // namespace fuzz
