#pragma once
// What small functions promise, in the cases that scenes hardly ever bring about: roots at dyadic numbers, half-spaces,
// motions of directions, numbers below the least normal one, corners that are hardly straight, faces within a volume,
// edges of concave faces with a fin, faces given thrice, loops that come back, surfaces that wind round twice.

#include "merged.h"
#include "soups.h"
#include "support.h"

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/bsp/traverse.h>
#include <sightline/algorithms/cutset/motion.h>
#include <sightline/algorithms/levels/common_inside.h>
#include <sightline/algorithms/point_visibility/hidden_lines.h>
#include <sightline/algorithms/priority/rounded_plane.h>
#include <sightline/algorithms/rays/tracer.h>
#include <sightline/algorithms/solids/operands.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/verify/boxes.h>
#include <sightline/algorithms/weak_visibility/partition/real_root.h>
#include <sightline/algorithms/weak_visibility/volume.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/kernel/quoted.h>
#include <sightline/kernel/scene/closed.h>
#include <sightline/kernel/scene/exact_plane.h>
#include <sightline/kernel/scene/face_graph.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fuzz {

// ---- Numbers

/// A product of linear factors, some of them twice, and of one without real roots: its roots are known.
inline void try_roots(generate::Random& random) {
  static constexpr std::array<long, 7> denominators{1, 2, 4, 8, 64, 3, 7};
  Polynomial f{random.chance(1, 2) ? 1 : -3};
  const auto times = [&](const Polynomial& g) {
    Polynomial product(f.size() + g.size() - 1);
    for (std::size_t i = 0; i < f.size(); ++i)
      for (std::size_t j = 0; j < g.size(); ++j) product[i + j] += f[i] * g[j];
    f = std::move(product);
  };
  std::set<Rational> all;
  for (std::uint64_t k = random.below(5); k > 0; --k) {
    const long q = denominators[random.below(denominators.size())], p = random.between(-q, 3 * q);
    for (std::uint64_t n = random.chance(1, 4) ? 2 : 1; n > 0; --n) times({-p, q});
    all.insert(Rational(p) / q);
  }
  if (random.chance(1, 3)) times({random.between(1, 5), random.between(-1, 1), 1});
  const Rational low = generate::integer(random, -4, 3) / 4, high = low + generate::integer(random, 1, 8) / 4;
  std::vector<Real_root> found;
  append_real_roots(f, low, high, found);
  std::size_t expected = 0;
  for (const Rational& x : all) {
    if (x <= low || x >= high) continue;
    require(expected < found.size(), "no root is lost");
    Real_root known(x);
    require(compare(found[expected], known) == 0, "roots are those of the factors, in order");
    ++expected;
  }
  require(expected == found.size(), "nothing else is a root");
}

/// The nearest double is not farther than its neighbours, and even where one is as near.
inline void try_nearest_doubles(generate::Random& random) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const int power = static_cast<int>(random.chance(1, 2) ? random.between(-1140, -1010) : random.between(-80, 900));
  Integer n = random.between(1, std::int64_t{1} << random.between(1, 60));
  if (random.chance(1, 2))
    n = n * (Integer(1) << static_cast<unsigned long>(random.between(1, 60))) + random.between(-1, 1);
  Rational x = Rational(n) * generate::power_of_two(power);
  if (random.chance(1, 4)) x /= random.between(2, 9);
  if (random.chance(1, 2)) x = -x;
  if (random.chance(1, 3))  // hardly beside the middle of two numbers below the least normal one
    x = (random.between(0, std::int64_t{1} << random.between(0, 50)) + Rational(1, 2) +
         random.between(-1, 1) * generate::power_of_two(-static_cast<int>(random.between(1, 200)))) *
        generate::power_of_two(-1074);
  const double d = nearest_double(x);
  require(std::isfinite(d), "numbers below 2^1024 have a nearest double");
  const Rational off = abs(Rational(x - exact(d)));
  for (const double towards : {-infinity, infinity}) {
    const double other = std::nextafter(d, towards);
    const Rational farther = abs(Rational(x - exact(other)));
    require(off < farther || (off == farther && (std::bit_cast<std::uint64_t>(d) & 1) == 0),
            "no double is nearer than the nearest one, and of two the even one is taken");
  }
}

/// In doubles a side is told only where it is so, however small the vectors are.
inline void try_rounded_planes(generate::Random& random) {
  const auto vector = [&] {
    const int power = static_cast<int>(random.between(-560, random.chance(1, 4) ? 300 : -480));
    Triple v;
    for (double& x : v)
      x = std::ldexp(static_cast<double>(random.between(-(1 << 20), 1 << 20)), power - (random.chance(1, 4) ? 40 : 0));
    return v;
  };
  Triple a = vector(), b = vector(), d = vector();
  if (random.chance(2, 3)) {  // hardly beside the plane, and of any length
    const double of_a = static_cast<double>(random.between(-4, 4)) / 4,
                 of_b = static_cast<double>(random.between(-4, 4)) / 4;
    const int power = static_cast<int>(random.between(0, 900));
    for (std::size_t k = 0; k < 3; ++k) d[k] = std::ldexp(of_a * a[k] + of_b * b[k], power);
  }
  const int told = priority_detail::Rounded_plane(a, b).side(d);
  require(told == 0 || told == sgn(dot(cross(exact(a), exact(b)), exact(d))), "a side that doubles tell is right");
}

// ---- Points

/// A linear program in three unknowns: where there is an inside, the mean of all vertices is in it.
inline void try_common_inside(generate::Random& random) {
  const Exact_point low = generate::lattice(random, 2);
  Exact_point high = low;
  for (Rational& x : high) x += generate::integer(random, 1, 3);
  std::vector<Exact_plane> planes;
  for (std::uint64_t k = random.below(5); k > 0; --k) {
    const Exact_point n = generate::lattice(random, 2);
    if (n == Exact_point{0, 0, 0}) continue;
    planes.push_back({n[0], n[1], n[2], generate::integer(random, -6, 6) / (random.chance(1, 3) ? 2 : 1)});
  }
  std::vector<Exact_plane> all = planes;
  for (std::size_t k = 0; k < 3; ++k) {
    Exact_plane from{0, 0, 0, low[k]}, to{0, 0, 0, -high[k]};
    from[k] = -1;
    to[k] = 1;
    all.push_back(from);
    all.push_back(to);
  }
  Exact_point sum{0, 0, 0};
  long vertices = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j)
      for (std::size_t k = j + 1; k < all.size(); ++k) {
        const auto normal = [](const Exact_plane& h) { return Exact_point{h[0], h[1], h[2]}; };
        const Exact_point jk = cross(normal(all[j]), normal(all[k])), ki = cross(normal(all[k]), normal(all[i])),
                          ij = cross(normal(all[i]), normal(all[j]));
        const Rational volume = dot(normal(all[i]), jk);
        if (volume == 0) continue;
        Exact_point p;
        for (std::size_t c = 0; c < 3; ++c)
          p[c] = -(all[i][3] * jk[c] + all[j][3] * ki[c] + all[k][3] * ij[c]) / volume;
        if (std::any_of(all.begin(), all.end(), [&](const Exact_plane& h) { return exact_height(h, p) > 0; })) continue;
        ++vertices;
        for (std::size_t c = 0; c < 3; ++c) sum[c] += p[c];
      }
  bool has_inside = vertices > 0;
  if (has_inside)
    for (Rational& x : sum) x /= vertices;
  for (const Exact_plane& h : planes) has_inside = has_inside && exact_height(h, sum) < 0;
  require(have_common_inside(planes, {low, high}) == has_inside,
          "half-spaces have an inside in common iff the mean of their vertices is in it");
}

/// A motion keeps lengths and differences; directions are turned only.
inline void try_motions(generate::Random& random) {
  Rigid_motion motion{{}, generate::lattice(random, 5)};
  for (Rational& x : motion.quaternion) x = generate::integer(random, -3, 3);
  if (motion.quaternion == std::array<Rational, 4>{0, 0, 0, 0}) return;
  const Exact_point p = generate::lattice(random, 9), d = generate::lattice(random, 9);
  Exact_point q = p;
  for (std::size_t k = 0; k < 3; ++k) q[k] += d[k];
  const Viewpoint from_p = motion.seen_from({p, false}), from_q = motion.seen_from({q, false}),
                  from_d = motion.seen_from({d, true}), middle = motion.seen_from({motion.translation, false});
  require(from_d.at_infinity && !from_p.at_infinity, "a direction stays one");
  require(minus(from_q.at, from_p.at) == from_d.at, "a direction is turned as the way between two points is");
  require(dot(from_d.at, from_d.at) == dot(d, d), "turning keeps lengths");
  require(middle.at == Exact_point{0, 0, 0}, "where the origin was moved to, it is seen from");
}

/// Points on edges, and corners repeated, change no source.
inline void try_straight_corners(generate::Random& random) {
  const Rational size = generate::power_of_two(static_cast<int>(random.between(-80, 80))),
                 coarse = random.chance(1, 2) ? generate::power_of_two(35) : 0;  // then of more bits than a double
  const auto point = [&] {
    Exact_point p = generate::lattice(random, 1 << 30);
    for (Rational& x : p) x = size * (x + coarse * generate::integer(random, -(1 << 30), 1 << 30));
    return p;
  };
  const generate::Points corners{point(), point(), point()};
  if (!spans_a_plane(corners)) return;
  generate::Points given;
  for (std::size_t k = 0; k < 3; ++k) {
    const Exact_point way = minus(corners[(k + 1) % 3], corners[k]);
    for (std::uint64_t n = random.chance(1, 4) ? 2 : 1; n > 0; --n) given.push_back(corners[k]);
    std::set<Rational> shares;
    for (std::uint64_t n = random.below(3); n > 0; --n) shares.insert(generate::integer(random, 1, 6) / 7);
    for (const Rational& share : shares) given.push_back(generate::along(corners[k], share, way));
  }
  std::rotate(given.begin(), given.begin() + static_cast<std::ptrdiff_t>(random.below(given.size())), given.end());
  generate::Points found = strict_corners(given);
  const auto first = std::find(found.begin(), found.end(), corners[0]);
  require(first != found.end(), "a corner stays");
  std::rotate(found.begin(), first, found.end());
  require(found == corners, "what stays are the corners");
}

/// What a volume sees from within is visible, and nothing else than before.
inline void try_seen_from_within(generate::Random& random) {
  Polygon_soup box;
  for (int k = 0; k < 8; ++k) box.add_point(Rational(k >> 2), Rational(k >> 1 & 1), Rational(k & 1));
  for (const std::vector<Point_id>& face : std::vector<std::vector<Point_id>>{
           {0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}})
    box.add_face(face);
  generate::Faces faces;
  std::vector<bool> is_within;
  for (std::uint64_t k = 1 + random.below(4); k > 0; --k) {
    const bool within = random.chance(1, 2);
    generate::Points face;
    for (int c = 0; c < 3; ++c) {
      Exact_point p;
      for (Rational& x : p) x = generate::integer(random, 1, 15) / 16 + (within ? 0 : 2);
      face.push_back(p);
    }
    if (!spans_a_plane(face)) continue;
    faces.push_back(face);
    is_within.push_back(within);
  }
  const Scene scene(generate::soup_of(faces));
  Weakly_visible found;
  for (const Piece& piece : scene.pieces())
    (random.chance(1, 2) ? found.hidden : random.chance(1, 2) ? found.undecided : found.visible).push_back(piece.face);
  const Weakly_visible before = found;
  const std::vector<Face_id> within = add_seen_from_within(scene, Weak_volume(box), random.chance(1, 2), found);
  const auto has = [](const std::vector<Face_id>& all, Face_id face) {
    return std::binary_search(all.begin(), all.end(), face);
  };
  for (const Piece& piece : scene.pieces()) {
    const Face_id f = piece.face;
    const bool seen = is_within[f] || has(before.visible, f);
    require(has(found.visible, f) == seen && has(found.hidden, f) == (!seen && has(before.hidden, f)) &&
                has(found.undecided, f) == (!seen && has(before.undecided, f)),
            "what is within is visible, and all else is as it was");
    const bool is_new = is_within[f] && !has(before.visible, f);
    require(has(found.unproved, f) == is_new && has(within, f) == is_new, "what was not found before has no proof");
  }
}

// ---- Scenes

/// A concave quadrilateral, and fins on the diagonal that its pieces share: edges against all pairs of neighbours.
inline void try_fins(generate::Random& random) {
  const Exact_point base = generate::lattice(random, 4), u = generate::lattice(random, 3),
                    v = generate::lattice(random, 3);
  if (cross(u, v) == Exact_point{0, 0, 0}) return;
  const auto at = [&](long x, long y) {
    Exact_point p = base;
    for (std::size_t k = 0; k < 3; ++k) p[k] += x * u[k] + y * v[k];
    return p;
  };
  generate::Faces faces{{at(-2, 0), at(0, random.between(1, 2)), at(2, 0), at(0, 4)}};
  for (std::uint64_t k = random.below(3); k > 0; --k)
    faces.push_back(
        {faces[0][1], random.chance(1, 4) ? generate::lattice(random, 6) : faces[0][3], generate::lattice(random, 6)});
  const Scene scene(generate::soup_of(faces));
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> all;
  for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece) {
    const auto corners = scene.corners(scene.pieces()[piece]);
    for (std::size_t k = 0; k < corners.size(); ++k)
      all[std::minmax(corners[k].point, corners[(k + 1) % corners.size()].point)].push_back(piece);
  }
  for (auto& edge : all) {  // the diagonal is no edge of the quadrilateral's pieces
    const std::vector<std::uint32_t> pieces = edge.second;
    const auto face = [&](std::uint32_t piece) { return scene.pieces()[piece].face; };
    std::erase_if(edge.second, [&](std::uint32_t piece) {
      return std::count_if(pieces.begin(), pieces.end(), [&](auto other) { return face(other) == face(piece); }) > 1;
    });
  }
  std::erase_if(all, [](const auto& edge) { return edge.second.empty(); });
  std::vector<Scene_edge> found = scene_edges(scene);
  require(found.size() == all.size(), "all edges are edges but those between two pieces of one face alone");
  for (Scene_edge& edge : found) {
    const auto known = all.find({edge.p, edge.q});
    std::sort(edge.pieces.begin(), edge.pieces.end());
    require(known != all.end() && known->second == edge.pieces, "an edge has the pieces that it bounds");
  }
}

/// Faces given several times, begun anywhere, some with loops that come back to a corner: each is kept once, and counts
/// as often as it was given.
inline void try_repeated_faces(generate::Random& random) {
  generate::Faces faces;
  const std::size_t kinds = 1 + random.below(3);
  std::map<Exact_point, int> times_of;  // by the first corner, which is the face's own
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    const Exact_point base{Rational(20 * static_cast<long>(kind)), 0, 0};
    const auto at = [&](long x, long y) { return Exact_point{base[0] + x, Rational(y), Rational(0)}; };
    generate::Points loop{at(0, 0), at(1, -1), at(1, 1)};
    if (random.chance(1, 2)) loop = {at(0, 0), at(1, -1), at(1, 1), at(0, 0), at(-1, 1), at(-1, -1)};
    const int times = static_cast<int>(random.between(1, 4));
    for (int n = 0; n < times; ++n) {
      generate::Points given = loop;
      std::rotate(given.begin(), given.begin() + static_cast<std::ptrdiff_t>(random.below(given.size())), given.end());
      faces.insert(faces.begin() + static_cast<std::ptrdiff_t>(random.below(faces.size() + 1)), given);
    }
    times_of[at(1, -1)] = times;
  }
  const Scene scene(generate::soup_of(faces));
  const std::vector<int> times = times_given(scene);
  std::set<Face_id> kept;
  for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece) {
    const generate::Points& loop = faces[scene.pieces()[piece].face];
    kept.insert(scene.pieces()[piece].face);
    for (const auto& [corner, count] : times_of)
      if (std::find(loop.begin(), loop.end(), corner) != loop.end())
        require(times[piece] == count, "a face counts as often as it is given");
  }
  require(kept.size() == kinds, "of equal faces one is kept, wherever they begin");
}

/// Two pyramids over a star that winds round several times: it closes up, looks outwards at each edge, and is convex
/// only where it winds once.
inline void try_stars(generate::Random& random) {
  static constexpr std::array<std::array<long, 2>, 9> circle{{{1000, 0},
                                                              {766, 643},
                                                              {174, 985},
                                                              {-500, 866},
                                                              {-940, 342},
                                                              {-940, -342},
                                                              {-500, -866},
                                                              {174, -985},
                                                              {766, -643}}};
  static constexpr std::array<std::array<std::size_t, 2>, 5> stars{{{9, 1}, {9, 2}, {9, 4}, {5, 1}, {5, 2}}};
  static constexpr std::array<std::array<long, 2>, 5> pentagon{
      {{1000, 0}, {309, 951}, {-809, 588}, {-809, -588}, {309, -951}}};
  const auto [n, step] = stars[random.below(stars.size())];
  const long height = random.between(1, 2000);
  const Exact_point top{0, 0, height}, bottom{0, 0, -height};
  generate::Faces faces;
  for (std::size_t k = 0; k < n; ++k) {
    const auto at = [&, count = n](std::size_t i) {
      const auto& p = count == 9 ? circle[i % 9] : pentagon[i % 5];
      return Exact_point{Rational(p[0]), Rational(p[1]), 0};
    };
    faces.push_back({at(k), at(k + step), top});
    faces.push_back({at(k + step), at(k), bottom});
  }
  const Scene scene(generate::soup_of(faces));
  const Face_graph graph(scene);
  require(graph.size() == faces.size(), "each triangle is a node");
  for (std::uint32_t node = 0; node < graph.size(); ++node)
    require(graph.is_convex(node) == (step == 1), "what winds round twice is not convex");
}

/// In doubles a ray meets what it meets exactly, from origins near the middle of what is symmetric, in fine steps.
inline void try_fine_origins(generate::Random& random) {
  const long size = random.between(1, 1 << 12);
  Polygon_soup soup;
  const auto point = [&](long x, long y, long z) { return soup.add_point(Rational(x), Rational(y), Rational(z)); };
  const Point_id a = point(-size / 3, -size, 0), b = point(size, -size, 0), c = point(size / 3, size, 0),
                 d = point(-size, size, 0);
  soup.add_face({a, b, c});
  soup.add_face({a, c, d});
  if (random.chance(1, 2))
    soup.add_face({point(-size, -size, -size), point(size, size - 1, size), point(size, 1 - size, size)});
  const Scene scene(soup);
  const Ray_tracer tracer(scene);
  const double up = random.chance(1, 2) ? 1 : -1;
  for (int turn = 0; turn < 16; ++turn) {
    const double step =
        std::ldexp(static_cast<double>(random.between(1, 40)), -static_cast<int>(random.between(20, 70)));
    const Double_ray ray{{step, (size > 2 ? 3.0 : 1.0) * step, -up * step}, {0, 0, up}};
    Ray_counters counters;
    const std::vector<Face_hit> exactly = tracer.first(ray.exact(), Ray_start::open, counters);
    const Ray_tracer::Nearest near = tracer.nearest(ray, Ray_start::open, counters);
    require(exactly.empty() ? near.face == Ray_tracer::Nearest::nothing
                            : near.face == exactly[0].face && near.tied == (exactly.size() > 1),
            "in doubles a ray meets what it meets exactly");
  }
}

/// Stars of five corners, mirrored, so that rays from inside meet edges: what is called convex has no corner before any
/// of its faces.
inline void try_mirrored_stars(generate::Random& random) {
  const Rational a = generate::integer(random, 8, 12), b = generate::integer(random, 4, 8),
                 c = generate::integer(random, 6, 10), d = generate::integer(random, 16, 20) / 2,
                 e = generate::integer(random, 2, 4);
  const generate::Points rim{
      {0, a, 0}, {Rational(-b), Rational(-c), 0}, {d, e, 0}, {Rational(-d), e, 0}, {b, Rational(-c), 0}};
  const Exact_point top{0, 0, generate::integer(random, 1, 80)}, bottom{0, 0, generate::integer(random, -80, -1)};
  generate::Faces faces;
  for (std::size_t k = 0; k < 5; ++k) {
    faces.push_back({rim[k], rim[(k + 1) % 5], top});
    faces.push_back({rim[(k + 1) % 5], rim[k], bottom});
  }
  random.shuffle(faces);
  const Scene scene(generate::soup_of(faces));
  const Face_graph graph(scene);
  for (std::uint32_t node = 0; node < graph.size(); ++node)
    if (graph.is_convex(node))
      for (const generate::Points& face : faces) {
        const Exact_plane plane = exact_plane(face);
        for (const Exact_point& p : {top, bottom, rim[0], rim[1], rim[2], rim[3], rim[4]})
          require(exact_height(plane, p) <= 0, "a convex body has no corner before any of its faces");
      }
}

/// Both orders of a tree have the same polygons, seen from the same sides, wherever the eye is: also in a plane.
inline void try_both_orders(generate::Random& random) {
  generate::Faces faces;
  for (std::uint64_t k = 1 + random.below(4); k > 0; --k) {
    const generate::Points face{generate::lattice(random, 3), generate::lattice(random, 3),
                                generate::lattice(random, 3)};
    if (spans_a_plane(face)) faces.push_back(face);
  }
  if (faces.empty()) return;
  const generate::Points& face = faces[random.below(faces.size())];
  Exact_point eye = generate::lattice(random, 5);
  if (random.chance(2, 3)) {  // in its plane
    const Rational u = generate::integer(random, -8, 8) / 4, v = generate::integer(random, -8, 8) / 4;
    for (std::size_t k = 0; k < 3; ++k)
      eye[k] = face[0][k] + u * (face[1][k] - face[0][k]) + v * (face[2][k] - face[0][k]);
  }
  const Scene scene(generate::soup_of(faces));
  const Exact_traits traits(scene);
  Bsp_options options;
  options.threads = 1;
  const auto tree = build_bsp(traits, options);
  std::array<std::vector<std::pair<const void*, Sign>>, 2> orders;
  for (const bool back_first : {false, true})
    traverse(traits, tree, traits.eye(eye), back_first ? Direction::back_to_front : Direction::front_to_back,
             [&](const auto& polygon, Sign side) { orders[back_first].emplace_back(&polygon, side); });
  for (auto& order : orders) std::sort(order.begin(), order.end());
  require(orders[0] == orders[1], "both orders have the same polygons, seen from the same sides");
}

/// A plane by Newell's sum, of any loop in it: concave, with corners in line, crossing itself.
inline void try_exact_planes(generate::Random& random) {
  const Exact_point base = generate::lattice(random, 9), u = generate::lattice(random, 5),
                    v = generate::lattice(random, 5);
  generate::Points loop;
  for (std::uint64_t n = 3 + random.below(6); n > 0; --n) {
    const Rational x = generate::integer(random, -6, 6) / 2, y = generate::integer(random, -6, 6) / 2;
    Exact_point p = base;
    for (std::size_t k = 0; k < 3; ++k) p[k] += x * u[k] + y * v[k];
    loop.push_back(p);
  }
  Exact_plane expected{0, 0, 0, 0};
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Exact_point part = cross(loop[k], loop[(k + 1) % loop.size()]);
    for (std::size_t i = 0; i < 3; ++i) expected[i] += part[i];
  }
  for (std::size_t i = 0; i < 3; ++i) expected[3] -= expected[i] * base[i];
  require(exact_plane(loop) == expected, "a polygon's plane is that of its signed area");
}

/// A segment is near each box that it meets, to the end of doubles.
inline void try_boxes_on_a_segment(generate::Random& random) {
  using certificate_check::Outward_box;
  std::array<int, 3> powers{};  // of each axis
  for (int& power : powers)
    power = static_cast<int>(random.chance(1, 2) ? random.between(995, 1022) : random.between(-60, 900));
  const auto number = [&](std::size_t axis) {
    return Rational(generate::integer(random, -9, 9) * generate::power_of_two(powers[axis]));
  };
  const Exact_point from{number(0), number(1), number(2)}, to{number(0), number(1), number(2)};
  std::vector<Outward_box> boxes;
  std::vector<bool> is_met;
  for (std::uint64_t n = 1 + random.below(30); n > 0; --n) {
    const bool on_it = random.chance(1, 3);
    const Rational share = generate::integer(random, 0, 16) / 16, size = random.between(1, 9);
    Exact_point p{number(0), number(1), number(2)};
    if (on_it)
      for (std::size_t k = 0; k < 3; ++k) p[k] = from[k] + share * (to[k] - from[k]);
    boxes.emplace_back(certificate_check::Polygon{p, {p[0] + size, p[1], p[2]}, {p[0], p[1] + size, p[2]}});
    is_met.push_back(on_it);
  }
  const std::vector<std::size_t> near = certificate_check::Boxes(boxes).near_segment(from, to);
  for (std::size_t k = 0; k < boxes.size(); ++k)
    require(!is_met[k] || std::find(near.begin(), near.end(), k) != near.end(),
            "a segment is near a box that it meets");
}

// ---- Solids

/// A prism over a triangle or a rectangle of the plane of two axes.
inline generate::Faces any_prism(std::size_t axis, generate::Random& random) {
  const Rational low = generate::integer(random, -4, 3), high = low + generate::integer(random, 1, 5),
                 x = generate::integer(random, -4, 4), y = generate::integer(random, -4, 4),
                 wide = generate::integer(random, 1, 6), deep = generate::integer(random, 1, 6);
  const auto at = [&](const Rational& u, const Rational& v, const Rational& w) {
    Exact_point p;
    p[(axis + 1) % 3] = u;
    p[(axis + 2) % 3] = v;
    p[axis] = w;
    return p;
  };
  std::vector<std::array<Rational, 2>> base{{x, y}, {x + wide, y}, {x, y + deep}};
  if (random.chance(1, 2)) base.insert(base.begin() + 2, {x + wide, y + deep});
  generate::Faces faces(2);
  const std::size_t n = base.size();
  for (std::size_t k = 0; k < n; ++k) {
    faces[0].push_back(at(base[n - 1 - k][0], base[n - 1 - k][1], low));
    faces[1].push_back(at(base[k][0], base[k][1], high));
    const auto &from = base[k], &to = base[(k + 1) % n];
    faces.push_back(
        {at(from[0], from[1], low), at(to[0], to[1], low), at(to[0], to[1], high), at(from[0], from[1], high)});
  }
  return faces;
}

/// Solids with axes in units of the prime by which planes and lines are told apart, or of one over it: a result has the
/// same faces, edges and points in whatever order the faces are given.
inline void try_units_of_a_prime(generate::Random& random) {
  constexpr long prime = 2147483647;
  std::array<generate::Faces, 2> solids{any_prism(random.below(3), random), any_prism(random.below(3), random)};
  for (generate::Faces& faces : solids) {
    Exact_point units;
    for (Rational& unit : units)
      unit = random.chance(1, 2) ? Rational(1) : random.chance(3, 4) ? Rational(prime) : Rational(1, prime);
    for (generate::Points& face : faces)
      for (Exact_point& p : face)
        for (std::size_t k = 0; k < 3; ++k) p[k] *= units[k];
  }
  Set_options options;
  options.operation = set_operations[random.below(set_operations.size())];
  std::array<std::array<std::size_t, 3>, 2> counted;
  for (auto& counts : counted) {
    std::vector<Polygon_soup> soups;
    for (generate::Faces faces : solids) {
      random.shuffle(faces);
      for (generate::Points& face : faces)
        std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(random.below(face.size())), face.end());
      soups.push_back(generate::soup_of(faces));
    }
    const Set_result result = set_operation(Operands(soups), options);
    counts = {result.faces.size(), result.crowded.size(), result.soup.point_count()};
  }
  require(counted[0] == counted[1], "a result has the same faces, edges and points in whatever order faces are given");
}

/// A token in a message: its first forty bytes, what is no printable ASCII in hexadecimal, and whether that is all.
inline void try_quoted(generate::Random& random) {
  std::string token(random.chance(1, 2) ? 38 + random.below(5) : random.below(60), ' ');
  for (char& c : token) c = static_cast<char>(random.chance(2, 3) ? random.between(33, 126) : random.between(0, 255));
  std::string expected;
  for (const char c : token.substr(0, 40)) {
    std::array<char, 5> code{};
    std::snprintf(code.data(), code.size(), "\\x%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
    expected += c >= ' ' && c < 127 ? std::string(1, c) : std::string(code.data());
  }
  if (token.size() > 40) expected += "...";
  require(sightline::quoted(token) == '"' + expected + '"',
          "a token is quoted on one line, and says whether that is all of it");
}

inline void small_promises(std::string_view bytes) {
  static constexpr std::array<void (*)(generate::Random&), 18> laws{
      try_mirrored_stars,   try_both_orders,  try_exact_planes,     try_boxes_on_a_segment,
      try_units_of_a_prime, try_roots,        try_nearest_doubles,  try_rounded_planes,
      try_common_inside,    try_motions,      try_straight_corners, try_fins,
      try_repeated_faces,   try_stars,        try_fine_origins,     try_seen_from_within,
      try_quoted,           try_merged_pieces};
  ask_one_of(laws, bytes);
}

}  // namespace fuzz
