#pragma once
// A wall that hides all but what is beyond one of its edges: what is behind it is weakly visible iff the line from some
// corner of the source to some corner of the target passes beside that edge. One of these lines passes the edge as
// closely as whole numbers can, or touches it.

#include "weak_claims.h"

#include <sightline/algorithms/verify/weak.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/events/events.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace fuzz {

inline Rational whole_near(const Rational& x) {
  Integer floor;
  const Rational above = x + Rational(1, 2);
  mpz_fdiv_q(floor.get_mpz_t(), above.get_num_mpz_t(), above.get_den_mpz_t());
  return floor;
}

/// On which side of the line from a to b the line from p to q passes, and how far: six times a volume.
inline Rational passed_by(const Exact_point& p, const Exact_point& q, const Exact_point& a, const Exact_point& b) {
  return dot(minus(q, p), cross(minus(b, a), minus(a, p)));
}

/// The whole point about `wanted` for which passed_by(p, it, a, b) is so many times the least that it can be; none
/// where all are in one plane. Pre: whole numbers.
inline std::optional<Exact_point> passing(const Exact_point& p, const Exact_point& a, const Exact_point& b, long times,
                                          const Exact_point& wanted) {
  const Exact_point e = minus(b, a), v = minus(a, p), n = cross(e, v);
  if (is_zero(n)) return std::nullopt;
  Integer g, all, s, t, r, last;
  mpz_gcdext(g.get_mpz_t(), s.get_mpz_t(), t.get_mpz_t(), n[0].get_num_mpz_t(), n[1].get_num_mpz_t());
  mpz_gcdext(all.get_mpz_t(), r.get_mpz_t(), last.get_mpz_t(), g.get_mpz_t(), n[2].get_num_mpz_t());
  const Exact_point one{Rational(r * s), Rational(r * t), Rational(last)};  // n one = all, which divides n
  const Exact_point start = generate::along(p, times, one), rest = minus(wanted, start);
  // What e and v add changes nothing: the nearest by these.
  const Rational ee = dot(e, e), ev = dot(e, v), vv = dot(v, v), er = dot(e, rest), vr = dot(v, rest),
                 area = ee * vv - ev * ev;
  const Exact_point moved = generate::along(start, whole_near((er * vv - vr * ev) / area), e);
  return generate::along(moved, whole_near((vr * ee - er * ev) / area), v);
}

/// The source below, the target above, the wall between; the edge is the wall's first, all of its faces have a part of
/// it, and lines on one side of it meet the wall.
struct One_edge {
  Points source, target, wall;
  std::vector<Points> faces;  ///< tiles that make up the wall
};

inline std::optional<One_edge> one_edge_scene(Random& random) {
  const long unit = 1L << (random.chance(1, 8) ? random.between(41, 50) : random.between(4, 36));
  const auto within = [&](long least, long most) {  // in sixteenths of the unit
    return Rational(static_cast<long>(random.between(least * (unit / 16), most * (unit / 16))));
  };
  const auto point = [&](std::array<long, 6> box) {
    const Rational x = within(box[0], box[1]), y = within(box[2], box[3]), z = within(box[4], box[5]);
    return Exact_point{x, y, z};
  };
  One_edge scene;
  const Exact_point p = point({-16, 16, -16, 16, -20, -16}), a = point({-2, 2, -18, -16, -2, 2}),
                    b = point({-2, 2, 16, 18, -1, 1});
  const std::optional<Exact_point> q = passing(p, a, b, static_cast<long>(random.between(-2, 2)),
                                               generate::along(point({-8, 8, -32, 32, 64, 80}), -4, {p[0], 0, 0}));
  if (!q) return std::nullopt;
  scene.source = {p};
  scene.target = {*q};
  const long least = random.chance(1, 4) ? -16 : 0;  // mostly, the others' lines meet the wall
  for (int k = 0; k < 2; ++k) {
    scene.source.push_back(generate::along(p, 1, point({least, 16, -16, 16, 0, random.chance(1, 2) ? 0 : 1})));
    scene.target.push_back(generate::along(*q, 1, point({least, 32, -32, 32, 0, random.chance(1, 2) ? 0 : 1})));
  }
  // A parallelogram of tiles: strips across the edge, cut along it at places of their own or at the same ones.
  const Exact_point e = minus(b, a), tile = point({18, 20, -1, 1, -1, 1});
  const auto at = [&](long along_edge, long across) {
    return generate::along(generate::along(a, along_edge, e), across, tile);
  };
  const auto between = [&](const std::array<long, 4>& r) {
    return Points{at(r[0], r[2]), at(r[1], r[2]), at(r[1], r[3]), at(r[0], r[3])};
  };
  const auto cuts = [&](std::vector<long> places) {
    while (places.size() > 2 && random.chance(1, 2))
      places.erase(places.begin() + 1 + static_cast<long>(random.below(places.size() - 2)));
    return places;
  };
  scene.wall = between({-3, 4, 0, 16});
  const std::vector<long> along_edge = cuts({-3, 0, 1, 4});
  std::vector<long> across = cuts({0, 1, 2, 16});
  const bool same = random.chance(1, 2);
  for (std::size_t k = 1; k < along_edge.size(); ++k) {
    if (!same) across = cuts({0, 1, 2, 16});
    for (std::size_t i = 1; i < across.size(); ++i)
      scene.faces.push_back(between({along_edge[k - 1], along_edge[k], across[i - 1], across[i]}));
  }
  return scene;
}

/// Whether it is seen, by corners alone; none where more than the edge matters.
inline std::optional<bool> is_seen_beside(const One_edge& scene) {
  const Flat_face source(scene.source), target(scene.target), wall(scene.wall);
  if (is_zero(source.normal) || is_zero(target.normal) || is_zero(wall.normal)) return std::nullopt;
  const auto all_in_front = [](const Flat_face& of, const Points& points, int side) {
    return std::all_of(points.begin(), points.end(),
                       [&](const Exact_point& p) { return side * sgn(of.height(p)) > 0; });
  };
  if (!all_in_front(source, scene.target, 1) || !all_in_front(target, scene.source, 1)) return std::nullopt;
  const int below = sgn(wall.height(scene.source[0]));
  if (!all_in_front(wall, scene.source, below) || !all_in_front(wall, scene.target, -below)) return std::nullopt;
  const Exact_point middle = generate::centroid(scene.wall);
  bool seen = false;
  for (const Exact_point& p : scene.source)
    for (const Exact_point& q : scene.target)
      for (std::size_t k = 0; k < scene.wall.size(); ++k) {
        const Exact_point &a = scene.wall[k], &b = scene.wall[(k + 1) % scene.wall.size()];
        const int side = sgn(passed_by(p, q, a, b)) * sgn(passed_by(p, middle, a, b));
        if (k > 0 && side <= 0) return std::nullopt;
        seen |= side < 0;
      }
  return seen;
}

/// Whether the first face is said to be visible; none: undecided.
inline std::optional<bool> said_of_target(const Weak_faces& found) {
  const auto has_target = [](const std::vector<Face_id>& list) {
    return std::find(list.begin(), list.end(), 0) != list.end();
  };
  if (has_target(found.visible)) return true;
  if (has_target(found.hidden)) return false;
  return std::nullopt;
}

inline void try_one_edge(Random& random) {
  constexpr std::size_t most_cells = 100, most_refuted = 20;  // thousands of walls take 15 and none
  std::optional<One_edge> scene = one_edge_scene(random);
  if (!scene) return;
  // Any axis upwards, and any scale; numbers that are no longer whole are so in the scene's own units.
  const std::size_t turn = random.below(3);
  const Rational scale = generate::power_of_two(random.chance(1, 2) ? 0 : static_cast<int>(random.between(-70, 3)));
  const auto turned = [&](Points& points) {
    for (Exact_point& p : points) p = {p[turn] * scale, p[(turn + 1) % 3] * scale, p[(turn + 2) % 3] * scale};
  };
  turned(scene->source);
  turned(scene->target);
  turned(scene->wall);
  for (Points& face : scene->faces) turned(face);
  scene->source = facing(scene->source, scene->target[0]);
  scene->target = facing(scene->target, scene->source[0]);
  const std::optional<bool> seen = is_seen_beside(*scene);
  if (!seen) return;
  std::vector<Points> faces{scene->target};
  for (const Points& face : scene->faces) faces.push_back(generate::either_way(face, random));
  const Polygon_soup soup = generate::soup_of(faces);
  const Scene made(soup);
  const Occluders occluders(made);
  const std::vector<Weak_source> sources{weak_source(occluders, scene->source)};
  Weak_options options;
  options.threads = 1;
  options.search.cells = 3000;
  const Weakly_visible found = weakly_visible(occluders, sources, options);
  require(said_of_target(found) != !*seen, "a target is seen by lines iff some line passes beside the wall's edge");
  require(found.undecided.empty() && found.counters.cells <= most_cells, "one edge takes few cells");
  require(found.counters.refuted <= most_refuted, "what a wall blocks in doubles is not asked of exact numbers");
  const Verdict verdict = verify_weak(soup, weak_certificate(made, {scene->source}, false, found));
  if (!verdict.accepted) throw Finding("one edge: the certificate is rejected: " + verdict.why);
  Events_options by_events;
  by_events.threads = 1;
  by_events.rays = 0;
  by_events.events = 100000;
  require(said_of_target(weakly_visible_by_events(occluders, sources, by_events)) != !*seen,
          "a target is seen by events iff some line passes beside the wall's edge");
}

inline void one_edge(std::string_view bytes) {
  Bytes from(bytes);
  Random random(from.word());
  try_one_edge(random);
}

}  // namespace fuzz
