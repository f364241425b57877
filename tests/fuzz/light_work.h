#pragma once
// What is easily answered takes little: scenes of families are decided within their first cells, lines that doubles
// propose are hardly ever refuted, and where nothing or one plate is between two polygons neither cells nor events are
// looked at; hundreds of edges of one piece are decided in one path; rays open few boxes of what lies apart, and rooms
// apart take few planes. A shortcut that is idle changes no answer; a search that misses a proof leaves faces
// undecided.

#include "one_edge.h"

#include <sightline/algorithms/levels/volumes.h>
#include <sightline/algorithms/rays/ray.h>
#include <sightline/algorithms/rays/tracer.h>
#include <sightline/algorithms/weak_visibility/along/along.h>
#include <sightline/algorithms/weak_visibility/partition/light_partition.h>
#include <sightline/algorithms/weak_visibility/partition/partition.h>
#include <sightline/algorithms/weak_visibility/settle.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/shapes.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fuzz {

/// Families of scenes with a source that a search decides. Numbers of all sizes leave what doubles do not see,
/// apertures a line now and then that only events find.
inline const std::vector<const generate::Family*>& decided_families() {
  static const std::vector<const generate::Family*> families = [] {
    std::vector<const generate::Family*> found;
    for (const generate::Family& family : generate::families()) {
      if (family.pair || family.name == "exponents" || family.name == "apertures") continue;
      generate::Family_parameters parameters;
      parameters.size = family.small_size;
      if (!family.make(parameters).source.empty()) found.push_back(&family);
    }
    return found;
  }();
  return families;
}

/// A small scene of a family as it is meant, without moved points, whose faces a search decides. Bounds are several
/// times what 400 scenes of each family take at most, 331 cells and 7 lines refuted; and twice what 1500 take of exact
/// programs, 3.
inline void try_family_with_few_cells(Random& random) {
  constexpr std::size_t most_faces = 40, most_cells = 1000, most_thorough_cells = 100, most_refuted = 40,
                        most_exact = 6;
  const std::vector<const generate::Family*>& families = decided_families();
  // Where faces share edges, proofs take all means that there are.
  const generate::Family& family =
      random.chance(1, 4) ? generate::family("shared_edges") : *families[random.below(families.size())];
  generate::Family_parameters parameters;
  parameters.size = family.small_size;
  parameters.seed = random.below(1u << 30);
  const Posed_scene posed = family.make(parameters);
  if (posed.source.empty() || posed.soup.face_count() > most_faces) return;
  const Scene scene(posed.soup);
  const Occluders occluders(scene);
  const std::vector<Weak_source> sources{weak_source(occluders, posed.source)};
  Weak_options options;
  options.threads = 1;
  options.search.cells = most_cells;
  Weakly_visible found = weakly_visible(occluders, sources, options);
  const auto fail = [&](const std::string& what) {
    throw Finding("light work: " + family.name + ", seed " + std::to_string(parameters.seed) + ": " + what);
  };
  if (found.counters.refuted > most_refuted) fail("more lines are refuted than doubles should propose");
  if (family.name != "shared_edges" && family.name != "tangent" && found.counters.exact_programs > most_exact)
    fail("doubles prove less than they should");
  // Of tangent faces lines are left that touch what they pass: a thorough search has proofs for these.
  if (found.undecided.empty()) return;
  if (family.name != "tangent") fail("faces are undecided by a first search");
  options.search.cells = most_thorough_cells;
  search_thoroughly(occluders, sources, options, found);
  if (!found.undecided.empty()) fail("faces are undecided by a thorough search");
}

/// Two triangles that face each other, with nothing between them, or a plate that hides all of one.
inline void try_at_once(Random& random) {
  const auto triangle = [&](long z) {
    Points corners;
    for (int k = 0; k < 3; ++k) {
      const Rational x = static_cast<long>(random.between(-9, 9)), y = static_cast<long>(random.between(-9, 9));
      corners.push_back({x, y, z + generate::ratio(random.between(-2, 2), 4)});
    }
    return corners;
  };
  Points source = triangle(0), target = triangle(8);
  if (is_zero(Flat_face(source).normal) || is_zero(Flat_face(target).normal)) return;
  source = facing(source, target[0]);
  target = facing(target, source[0]);
  const Flat_face from(source), to(target);
  const auto in_front = [](const Flat_face& of, const Points& points) {
    return std::all_of(points.begin(), points.end(), [&](const Exact_point& p) { return of.height(p) > 0; });
  };
  if (!in_front(from, target) || !in_front(to, source)) return;
  std::vector<Points> faces{target};
  const bool hidden = random.chance(1, 2);
  if (hidden) faces.push_back(generate::either_way(generate::rectangle(-20, 20, -20, 20, 4), random));
  const Scene scene(generate::soup_of(faces));
  const Occluders occluders(scene);
  const std::vector<Weak_source> sources{weak_source(occluders, source)};
  Weak_options options;
  options.threads = 1;
  const Weakly_visible found = weakly_visible(occluders, sources, options);
  Events_options by_events;
  by_events.threads = 1;
  const Weakly_visible_by_events events = weakly_visible_by_events(occluders, sources, by_events);
  require(said_of_target(found) == !hidden, "what a plate hides, and nothing else, is hidden");
  require(said_of_target(events) == !hidden, "events say so of a plate, too");
  require(found.counters.cells == 0, "no cells are searched of what one plate hides, or nothing");
  require(events.counters.horizon + events.counters.edge_vertex + events.counters.triple == 0,
          "no events are looked at of what one plate hides, or nothing");
}

/// Many small triangles behind a plate that hides all of them: no cell is searched, and few pieces are sought.
inline void try_many_behind_a_plate(Random& random) {
  Points source;
  for (int k = 0; k < 3; ++k)
    source.push_back({static_cast<long>(random.between(-9, 9)), static_cast<long>(random.between(-9, 9)), 0});
  if (is_zero(Flat_face(source).normal)) return;
  source = facing(source, {0, 0, 1});
  std::vector<Points> faces{generate::either_way(generate::rectangle(-40, 40, -40, 40, 4), random)};
  for (int k = 0; k < 60; ++k) {
    const std::array<long, 3> at{static_cast<long>(random.between(-16, 16)), static_cast<long>(random.between(-16, 16)),
                                 static_cast<long>(random.between(6, 14))};
    Points corners;
    for (int c = 0; c < 3; ++c) {
      corners.emplace_back();
      for (std::size_t i = 0; i < 3; ++i)
        corners.back()[i] = Rational(at[i]) + generate::ratio(random.between(-8, 8), 8);
    }
    if (!is_zero(Flat_face(corners).normal)) faces.push_back(corners);
  }
  const Scene scene(generate::soup_of(faces));
  const Occluders occluders(scene);
  Weak_options options;
  options.threads = 1;
  options.search.two_sided = true;
  const Weakly_visible found = weakly_visible(occluders, {weak_source(occluders, source)}, options);
  require(found.visible == std::vector<Face_id>{0} && found.undecided.empty(), "a plate hides all that is behind it");
  require(found.counters.by_one + found.counters.away + 1 >= found.counters.targets && found.counters.cells == 0,
          "what a plate hides is hidden by one piece");
  require(found.counters.occluders <= 8, "pieces are sought near no shaft that a plate blocks");
}

/// Three points at one height.
inline Points level_triangle(long z, Random& random) {
  Points corners;
  for (int c = 0; c < 3; ++c) {
    corners.push_back(generate::lattice(random, 9));
    corners.back()[2] = z;
  }
  return corners;
}

/// Two triangles in parallel planes, with nothing between them: the one is lit by all of the other, without a curve;
/// and an eye that moves in the plane between asks what a point of what it sees tells, and needs one run.
inline void try_nothing_between(Random& random) {
  Points source = level_triangle(0, random), target = level_triangle(8, random);
  const Exact_point from = level_triangle(4, random)[0], to = level_triangle(4, random)[0];
  if (is_zero(Flat_face(source).normal) || is_zero(Flat_face(target).normal) || from == to) return;
  source = facing(source, target[0]);
  target = facing(target, source[0]);
  const Scene scene(generate::soup_of({target}));
  Partition_counters partition;
  const Light_partition lit = Light_partitioner(scene).partition(0, {source}, {}, partition);
  require(lit.cells.size() == 1 && lit.cells[0].light == Light::lit, "what has nothing before it is lit");
  require(partition.alike == partition.boxes && partition.arrangements == 0, "what is lit as a whole is so at once");
  const Occluders occluders(scene);
  Along_options options;
  options.threads = 1;
  const Visible_along seen = visible_along(occluders, from, to, options);
  require(seen.visible.size() == 1 && seen.events.empty(), "an eye sees what has nothing before it all along");
  require(seen.counters.witnesses > 0, "a point of what is seen says for how long");
}

/// Two triangles behind a wall of sixteen plates that overlap. One plate alone hides most parts of the lines between
/// them, so that but for one pair in six (of 4600) events are looked at in what is left of them only, or not at all.
inline void try_parts_of_a_wall(Random& random) {
  constexpr int pairs = 12;
  constexpr long plates = 4;
  int in_parts = 0;
  for (int k = 0; k < pairs; ++k) {
    Points source = level_triangle(0, random), target = level_triangle(16, random);
    if (is_zero(Flat_face(source).normal) || is_zero(Flat_face(target).normal)) return;
    source = facing(source, target[0]);
    std::vector<Points> faces{facing(target, source[0])};
    for (long place = 0; place < plates * plates; ++place) {
      const long x = 5 * (place % plates) - 10, y = 5 * (place / plates) - 10;
      const Rational height = 8 + generate::integer(random, 0, 15) / 16;
      faces.push_back(generate::either_way(generate::rectangle(x - 2, x + 7, y - 2, y + 7, height), random));
    }
    const Scene scene(generate::soup_of(faces));
    const Occluders occluders(scene);
    std::uint32_t piece = 0;
    while (scene.pieces()[piece].face != 0) ++piece;
    Events_options options;
    options.threads = 1;
    Event_counters counters;
    const Weak_status status =
        weakly_visible_by_events(occluders, weak_source(occluders, source), piece, options, counters).status;
    require(status == Weak_status::hidden, "a wall of plates that overlap hides what is behind it");
    const std::size_t events = counters.horizon + counters.edge_vertex + counters.triple;
    in_parts += counters.shafts > 0 && (counters.shafts_left > 0 || events == 0);
  }
  require(in_parts > 0, "events are looked at in what plates leave of the lines between two polygons");
}

/// A disk of hundreds of edges, behind which four plates leave a hole that is smaller: a search goes along all of the
/// disk's edges in one path, longer than what it notes of paths, and what it says is proved.
inline void try_many_edges(Random& random) {
  constexpr std::int64_t radius = 1000000;
  const std::uint64_t edges = 250 + random.below(60);
  const Rational source_half = generate::integer(random, 7, 10) * radius / 10,
                 hole = generate::integer(random, 3, 6) * radius / 10;
  Points disk;
  for (std::uint64_t k = 0; k < edges; ++k) {
    const generate::Lattice_point p = generate::circle_point(k, edges, radius);
    disk.push_back({Rational(static_cast<long>(p[0])), Rational(static_cast<long>(p[1])), 4 * radius / 10});
  }
  const Rational height = radius / 2, far = 4 * radius;
  const auto square = [](const Rational& half, const Rational& z) {
    return generate::rectangle(-half, half, -half, half, z);
  };
  std::vector<Points> faces{
      generate::reversed(square(source_half, radius)),       disk,
      generate::rectangle(-far, -hole, -far, far, height),   generate::rectangle(hole, far, -far, far, height),
      generate::rectangle(-hole, hole, -far, -hole, height), generate::rectangle(-hole, hole, hole, far, height)};
  for (std::size_t k = 1; k < faces.size(); ++k) faces[k] = generate::either_way(faces[k], random);
  const Points source = square(source_half, 0);
  const Polygon_soup soup = generate::soup_of(faces);
  const Scene scene(soup);
  const Occluders occluders(scene);
  Weak_options options;
  options.threads = 1;
  const Weakly_visible found = weakly_visible(occluders, {weak_source(occluders, source)}, options);
  require(found.undecided.empty(), "many edges of one piece are decided by a first search");
  const Verdict verdict = verify_weak(soup, weak_certificate(scene, {source}, false, found));
  if (!verdict.accepted) throw Finding("many edges: the certificate is rejected: " + verdict.why);
}

/// Rays through 200 small triangles that lie apart. Bounds are one and a half times what 400 such scenes take at most
/// of boxes, 8.1 a ray, and several times of pieces, 0.2, and exact ones, none.
inline void try_rays_with_few_boxes(Random& random) {
  constexpr std::size_t faces = 200, rays = 64, most_boxes = 12, most_pieces = 1, most_exact = 3;
  constexpr std::int64_t far = 1 << 20, near = far / 32;
  Polygon_soup soup;
  for (std::size_t k = 0; k < faces; ++k) {
    std::array<std::int64_t, 3> at;
    for (std::int64_t& x : at) x = random.between(-far, far);
    std::vector<Point_id> corners;
    for (int c = 0; c < 3; ++c) {
      Exact_point p;
      for (std::size_t i = 0; i < 3; ++i) p[i] = static_cast<long>(at[i] + random.between(-near, near));
      corners.push_back(soup.add_point(p[0], p[1], p[2]));
    }
    soup.add_face(corners);
  }
  const Scene scene(soup);
  const Ray_tracer tracer(scene);
  Ray_counters counters;
  for (std::size_t k = 0; k < rays; ++k) {
    Double_ray ray;
    for (std::size_t i = 0; i < 3; ++i) {
      ray.origin[i] = static_cast<double>(random.between(-far, far));
      ray.direction[i] = static_cast<double>(random.between(-far, far)) - ray.origin[i];
    }
    if (is_ray(ray)) tracer.nearest(ray, Ray_start::closed, counters);
  }
  require(counters.boxes <= most_boxes * rays, "a ray opens few boxes of what lies apart");
  require(counters.pieces <= most_pieces * rays, "a ray looks at few pieces of what lies apart");
  require(counters.exact_pieces <= most_exact, "doubles decide what rays in general position meet");
}

/// Boxes apart, on a lattice. Of a tree that divides space for them, each takes its six sides and little more: the
/// bound is a fifth more than what 300 such scenes take at most, 6.4 nodes a box.
inline void try_rooms_with_few_nodes(Random& random) {
  Polygon_soup soup;
  std::size_t rooms = 0;
  for (long place = 0; place < 32; ++place) {
    if (random.chance(1, 4)) continue;
    const std::array<long, 3> at{place % 4, place / 4 % 4, place / 16};
    std::array<std::array<long, 3>, 2> ends;
    for (std::size_t k = 0; k < 3; ++k) {
      ends[0][k] = 4 * at[k] + static_cast<long>(random.below(2));
      ends[1][k] = ends[0][k] + static_cast<long>(random.between(1, 3));
    }
    ++rooms;
    std::vector<Point_id> corner;
    for (std::size_t c = 0; c < 8; ++c)
      corner.push_back(
          soup.add_point(Rational(ends[c & 1][0]), Rational(ends[c >> 1 & 1][1]), Rational(ends[c >> 2][2])));
    for (const auto& [a, b, c, d] :
         {std::array<std::size_t, 4>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
      soup.add_face({corner[a], corner[b], corner[c], corner[d]});
  }
  require(volume_division(soup).tree.nodes.size() * 10 <= rooms * 75, "rooms apart take few planes");
}

inline void light_work(std::string_view bytes) {
  Bytes from(bytes);
  const std::size_t kind = from.below(12);
  Random random(from.word());
  if (kind == 11) try_nothing_between(random);
  else if (kind == 10) try_parts_of_a_wall(random);
  else if (kind == 9) try_many_edges(random);
  else if (kind == 8) try_many_behind_a_plate(random);
  else if (kind == 0) try_at_once(random);
  else if (kind == 1) try_rays_with_few_boxes(random);
  else if (kind == 2) try_rooms_with_few_nodes(random);
  else try_family_with_few_cells(random);
}

}  // namespace fuzz
