#pragma once
// Points and rays against trees of few faces, empty ones too, and every face by itself; solids that are known.

#include "cutset.h"

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/bsp/query.h>
#include <sightline/kernel/scene/closed.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace fuzz {

/// A planar face of one loop, by its corners alone; it may be concave.
struct Plain_face {
  generate::Points corners;
  Exact_point normal{0, 0, 0};
  std::size_t x = 0, y = 1;  ///< two coordinates that tell its points apart

  explicit Plain_face(generate::Points points) : corners(std::move(points)) {
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      normal = generate::along(normal, 1, cross(minus(corners[k], corners[0]), minus(corners[k + 1], corners[0])));
    std::size_t across = 2;
    while (normal[across] == 0) --across;
    x = (across + 1) % 3;
    y = (across + 2) % 3;
  }
  const Exact_point& corner(std::size_t k) const { return corners[k % corners.size()]; }
  Rational height(const Exact_point& p) const { return dot(normal, minus(p, corners[0])); }

  /// 1 inside, 0 on its boundary, -1 outside: how often a ray along x crosses it. Pre: p is in its plane.
  int within(const Exact_point& p) const {
    bool inside = false;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Exact_point &a = corner(k), &b = corner(k + 1);
      if (is_zero(cross(minus(b, a), minus(p, a))) && dot(minus(a, p), minus(b, p)) <= 0) return 0;
      if ((a[y] > p[y]) == (b[y] > p[y])) continue;
      inside ^= a[x] + (p[y] - a[y]) * (b[x] - a[x]) / (b[y] - a[y]) > p[x];
    }
    return inside ? 1 : -1;
  }
  bool holds(const Exact_point& p) const { return height(p) == 0 && within(p) >= 0; }

  /// The least t >= 0 at which it holds the ray's point. Within its plane a ray enters it where it begins, across an
  /// edge or at a corner.
  std::optional<Rational> first_on(const Exact_ray& ray) const {
    const Rational slope = dot(normal, ray.direction), at = height(ray.origin);
    std::vector<Rational> times;
    if (slope != 0) {
      times.push_back(-at / slope);
    } else if (at == 0) {
      times.push_back(0);
      for (std::size_t k = 0; k < corners.size(); ++k) {
        const Exact_point from = minus(corner(k), ray.origin), across = cross(normal, minus(corner(k + 1), corner(k)));
        if (const Rational rise = dot(across, ray.direction); rise != 0) times.push_back(dot(across, from) / rise);
        else times.push_back(dot(from, ray.direction) / dot(ray.direction, ray.direction));
      }
    }
    std::optional<Rational> first;
    for (const Rational& t : times)
      if (t >= 0 && (!first || t < *first) && holds(generate::along(ray.origin, t, ray.direction))) first = t;
    return first;
  }
};

/// A convex body, its faces' fronts outside or inside.
struct Convex_body {
  std::vector<Plain_face> faces;
  int sense;
  bool holds(const Exact_point& p) const {
    return std::all_of(faces.begin(), faces.end(), [&](const Plain_face& f) { return sense * sgn(f.height(p)) < 0; });
  }
};

/// What is asked about: faces, and the bodies that they bound if they are bodies.
struct Asked_faces {
  generate::Faces faces;
  std::vector<Convex_body> bodies;
  bool are_bodies = false, are_whole = true;
};

inline Asked_faces any_asked_faces(Random& random) {
  Asked_faces asked;
  switch (random.below(6)) {
    case 0: break;
    case 1: generate::add_any(asked.faces, 1 + random.below(6), random); break;
    case 2: {  // in two planes that meet
      const Exact_point origin = generate::lattice(random, 2);
      const auto [u, v] = generate::directions(random, 2);
      const Exact_point w = generate::directions(random, 2)[0];
      for (std::uint64_t k = 1 + random.below(5); k > 0; --k) {
        const bool other = random.chance(1, 3) && !is_zero(cross(u, w));
        const Exact_point from = generate::lattice_in_plane(random, origin, u, other ? w : v, -2, 2);
        asked.faces.push_back(
            generate::either_way(generate::in_plane(from, u, other ? w : v, generate::outline(random)), random));
      }
      break;
    }
    default:
      asked.are_bodies = true;
      for (std::uint64_t k = 1 + random.below(3); k > 0; --k) {
        generate::Faces body = any_hull(random);
        const Exact_point place = generate::lattice(random, 2);
        const bool inwards = random.chance(1, 4);
        Convex_body& known = asked.bodies.emplace_back();
        known.sense = inwards ? -1 : 1;
        for (generate::Points& face : body) {
          for (Exact_point& p : face) p = generate::along(place, 1, p);
          if (inwards) std::reverse(face.begin(), face.end());
          known.faces.emplace_back(face);
        }
        if (body.empty()) asked.bodies.pop_back();
        generate::add(asked.faces, body);
        if (!body.empty() && random.chance(1, 4)) {
          asked.bodies.push_back(asked.bodies.back());
          generate::add(asked.faces, body);
        }
      }
      if (!asked.faces.empty() && random.chance(1, 6)) {
        asked.faces.pop_back();
        asked.are_whole = false;
      }
  }
  return asked;
}

/// Where the planes of three faces meet, if they meet in a point.
inline std::optional<Exact_point> meet_of(const Plain_face& f, const Plain_face& g, const Plain_face& h) {
  const Exact_point gh = cross(g.normal, h.normal), hf = cross(h.normal, f.normal), fg = cross(f.normal, g.normal);
  const Rational volume = dot(f.normal, gh);
  if (volume == 0) return std::nullopt;
  const Exact_point origin{0, 0, 0};
  Exact_point p = generate::along(origin, dot(f.normal, f.corners[0]) / volume, gh);
  p = generate::along(p, dot(g.normal, g.corners[0]) / volume, hf);
  return generate::along(p, dot(h.normal, h.corners[0]) / volume, fg);
}

inline Exact_point asked_point(const std::vector<Plain_face>& faces, Random& random) {
  if (faces.empty() || random.chance(1, 12)) return generate::half_lattice(random, 4);
  const auto any = [&]() -> const Plain_face& { return faces[random.below(faces.size())]; };
  const Plain_face& f = any();
  const std::size_t k = random.below(f.corners.size());
  const Exact_point p = f.corner(k), u = minus(f.corner(k + 1), p), v = minus(f.corner(k + 2), p);
  const auto share = [&] { return generate::ratio(static_cast<long>(random.between(-1, 4)), 3); };
  switch (random.below(8)) {
    case 0: return p;
    case 1: return generate::along(p, share(), u);
    case 2: return generate::along(generate::along(p, share(), u), share(), v);
    case 3: return meet_of(f, any(), any()).value_or(p);
    case 4: return generate::along(p, generate::power_of_two(-60), generate::lattice(random, 1));
    case 5: return generate::along(p, generate::power_of_two(40), generate::lattice(random, 1));
    case 6: return generate::centroid({p, f.corner(k + 1), f.corner(k + 2)});
    default: return generate::centroid({p, any().corners[0], any().corners[1]});
  }
}

inline Exact_point asked_direction(const std::vector<Plain_face>& faces, const Exact_point& from, Random& random) {
  Exact_point direction{0, 0, 0};
  if (faces.empty() || random.chance(1, 8)) {
    direction = generate::lattice(random, 1);
  } else {
    const Plain_face &f = faces[random.below(faces.size())], &g = faces[random.below(faces.size())];
    const std::size_t k = random.below(f.corners.size());
    switch (random.below(4)) {
      case 0: direction = minus(f.corner(k), f.corner(k + 1)); break;
      case 1: direction = cross(f.normal, g.normal); break;
      default: direction = minus(asked_point(faces, random), from);
    }
    if (random.chance(1, 4)) direction = minus(Exact_point{0, 0, 0}, direction);
  }
  if (is_zero(direction)) direction[random.below(3)] = 1;
  return direction;
}

inline void bsp_queries(std::string_view bytes) {
  Random random(Bytes(bytes).word());
  const Asked_faces asked = any_asked_faces(random);
  Polygon_soup soup = generate::soup_of(asked.faces);
  if (random.chance(1, 4)) soup.add_point(Rational(1), Rational(2), Rational(1, 3));
  Scene scene(soup);

  // 1. A tree, some of its planes without faces.
  Bsp_options options;
  options.threads = 1;
  options.seed = random.below(1000);
  options.split_weight = static_cast<unsigned>(random.below(4));
  options.candidates = 1 + static_cast<unsigned>(random.below(5));
  for (std::uint64_t k = random.chance(1, 3) ? 1 + random.below(2) : 0; k > 0 && !asked.faces.empty(); --k) {
    std::array<Integer, 4> plane;
    for (Integer& x : plane) x = static_cast<long>(random.between(-1, 1));
    if (plane[0] != 0 || plane[1] != 0 || plane[2] != 0) options.first.push_back(scene.add_plane(plane));
  }
  const Exact_traits traits(scene);
  const Exact_tree tree = build_bsp(traits, options);

  // 2. Every face by itself, and every fragment.
  std::set<Face_id> gone;
  for (const Set_aside& entry : scene.set_aside()) gone.insert(entry.face);
  std::vector<Plain_face> faces;
  std::vector<Face_id> ids;
  for (Face_id f = 0; f < asked.faces.size(); ++f) {
    if (gone.count(f) > 0) continue;
    faces.emplace_back(asked.faces[f]);
    ids.push_back(f);
  }
  std::vector<Plain_face> fragments;
  for (const Fragment<Exact_traits>& fragment : tree.fragments) {
    generate::Points corners;
    for (const auto& corner : fragment.polygon) corners.push_back(traits.position(*corner.vertex));
    fragments.emplace_back(std::move(corners));
  }
  const bool closed = closure(scene).closed;
  if (asked.are_bodies) require(closed == asked.are_whole, "bodies are closed, and not less a face");

  Predicate_counts counts;
  for (int question = 0; question < 6; ++question) {
    // 3. A point.
    const Exact_point point = asked_point(faces, random);
    Bsp_leaf leaf;
    for (std::int32_t next = tree.nodes.empty() ? -1 : 0; next >= 0;) {
      const auto& node = tree.nodes[static_cast<std::size_t>(next)];
      const std::array<Rational, 4> h = scene.file_coefficients(node.plane);
      const Rational value = h[0] * point[0] + h[1] * point[1] + h[2] * point[2] + h[3];
      leaf = {next, value >= 0, leaf.on_boundary || value == 0};
      next = leaf.in_front ? node.front : node.behind;
    }
    require(find_leaf(traits, tree, point, counts) == leaf, "a point's cell is where its sides lead");
    std::vector<Face_id> held;
    for (std::size_t i = 0; i < faces.size(); ++i)
      if (faces[i].holds(point)) held.push_back(ids[i]);
    require(faces_at(traits, tree, point, counts) == held, "the faces at a point are those that hold it");
    int times_inside = 0;
    for (const Convex_body& body : asked.bodies) times_inside += body.holds(point) ? body.sense : 0;
    const Point_location found = locate_point(traits, tree, point, closed, counts);
    require(found.leaf == leaf && found.faces == held, "a location has the point's cell and faces");
    if (!held.empty()) require(found.location == Location::on, "a point of a face is on the solid");
    else if (!closed) require(found.location == Location::undefined, "what is not closed has no inside");
    else if (asked.are_bodies || faces.empty())
      require(found.location == (times_inside != 0 ? Location::inside : Location::outside),
              "a point is inside iff it is inside more bodies of one sense");

    // 4. A ray from there.
    const Exact_ray ray{point, asked_direction(faces, point, random)};
    std::optional<std::pair<Rational, Face_id>> first;
    for (std::size_t i = 0; i < faces.size(); ++i)
      if (const auto t = faces[i].first_on(ray); t && (!first || std::pair(*t, ids[i]) < *first)) first = {*t, ids[i]};
    const std::optional<Ray_hit> hit = first_hit(traits, tree, ray);
    require(hit.has_value() == first.has_value(), "a ray hits a face iff one is on it");
    if (hit) {
      require(hit->t == first->first && hit->face == first->second, "a ray hits the first face, of several the lowest");
      const Exact_point at = generate::along(point, hit->t, ray.direction);
      std::optional<std::uint32_t> least;
      for (std::size_t i = 0; i < fragments.size(); ++i)
        if (traits.face(tree.fragments[i].polygon.piece) == hit->face && fragments[i].holds(at))
          least = std::min(least.value_or(~0u), tree.fragments[i].number);
      require(least == hit->number, "of the face's fragments it hits the lowest");
      const auto later = first_hit(traits, tree, {point, generate::along({0, 0, 0}, Rational(1, 3), ray.direction)});
      require(later && later->t == 3 * hit->t && later->face == hit->face && later->number == hit->number,
              "a direction may be of any length");
    }
    if (!held.empty()) continue;

    // 5. What it leaves and enters, each face counted as often as one likes.
    std::vector<int> weight(asked.faces.size()), times;
    for (int& w : weight) w = static_cast<int>(random.between(-2, 3));
    for (const Piece& piece : scene.pieces()) times.push_back(weight[piece.face]);
    int winding = 0;
    for (std::size_t i = 0; i < faces.size(); ++i)
      if (faces[i].first_on(ray)) winding += sgn(dot(faces[i].normal, ray.direction)) * weight[ids[i]];
    const bool meets_edge = std::any_of(fragments.begin(), fragments.end(), [&](const Plain_face& f) {
      const auto t = f.first_on(ray);
      return t && f.within(generate::along(point, *t, ray.direction)) == 0;
    });
    const std::optional<int> told = bsp_detail::winding_along(traits, tree, ray, times);
    require(told.has_value() == !meets_edge, "a ray tells nothing iff it meets an edge");
    require(!told || *told == winding, "a ray counts what it leaves, less what it enters");
  }
  bool thrown = false;
  try {
    first_hit(traits, tree, {asked_point(faces, random), {0, 0, 0}});
  } catch (const std::domain_error&) {
    thrown = true;
  }
  require(thrown, "zero is no direction");
}

}  // namespace fuzz
