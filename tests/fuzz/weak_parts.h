#pragma once
// What is open of a pair of source and target, cut by hand: events of the parts say what events of the whole do. And
// what rays along axes hit first among rectangles.

#include "any_case.h"
#include "support.h"

#include <sightline/algorithms/weak_visibility/events/event_search.h>
#include <sightline/algorithms/weak_visibility/events/events.h>
#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/settle.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/algorithms/weak_visibility/weak_source.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/fuzz.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace fuzz {

/// A plane across an axis, through the middle of a polygon or, if need be, beyond it.
inline std::array<Integer, 4> cut_across(const Near_polygon& polygon, generate::Random& random) {
  std::size_t axis = random.below(3);
  Rational low, high;
  for (;; axis = (axis + 1) % 3) {  // not the polygon's own plane
    for (const Near_point& p : polygon) {
      const Rational x = Rational(p.exact[axis]) / Rational(p.exact[3]);
      if (&p == polygon.data() || x < low) low = x;
      if (&p == polygon.data() || x > high) high = x;
    }
    if (low < high) break;
  }
  const Rational at = random.chance(1, 6) ? Rational(high + 1) : Rational((low + high) / 2);
  std::array<Integer, 4> plane{0, 0, 0, Integer(-at.get_num())};
  plane[axis] = at.get_den();
  if (random.chance(1, 2))
    for (Integer& x : plane) x = -x;
  return plane;
}

inline void try_parts_of_a_pair(generate::Random& random) {
  constexpr std::size_t most_pieces = 9;
  const harness::Posed_scene posed = harness::make(any_case(random));
  if (posed.source.empty()) return;
  const Scene scene(posed.soup);
  if (scene.pieces().empty() || scene.pieces().size() > most_pieces) return;
  const Occluders occluders(scene);
  const Weak_source source = weak_source(occluders, posed.source);
  const auto piece = static_cast<std::uint32_t>(random.below(scene.pieces().size()));
  using Step = Weak_step::Kind;
  Weakly_visible::Pair pair{piece, 0, {}};
  pair.answer.lines.push_back({static_cast<std::uint32_t>(random.below(scene.pieces().size())), 0});
  std::vector<Weak_step>& proof = pair.answer.proof;
  std::size_t cells = 1;  // that are still to be told of
  while (cells > 0) {
    const std::uint64_t kind = proof.size() > 5 ? 3 : random.below(5);
    const Near_polygon target = occluders.polygon(piece);
    Weak_step step{};
    step.kind = kind == 0 ? Step::line : kind == 1 ? Step::cut_source : kind == 2 ? Step::cut_target : Step::open;
    if (kind == 1) step.plane = cut_across(source.polygon, random);
    if (kind == 2) step.plane = cut_across(target, random);
    proof.push_back(std::move(step));
    if (kind < 3) ++cells;
    else --cells;
  }
  const std::vector<Open_cell> all = open_cells(occluders, source, pair, 1000),
                               one = open_cells(occluders, source, pair, 1);
  require(all.size() == static_cast<std::size_t>(std::count_if(
                            proof.begin(), proof.end(), [](const Weak_step& step) { return step.kind == Step::open; })),
          "each step that is open has its cell");
  require(one.size() == 1 && one[0].source == all[0].source && one[0].target == all[0].target,
          "the first cell is the first of all");

  Events_options options;
  options.threads = 1;
  options.rays = random.chance(1, 2) ? 0 : 4;
  Event_counters counters;
  const Weak_status whole = weakly_visible_by_events(occluders, source, piece, options, counters).status;
  require(whole != Weak_status::undecided, "events that have time decide a pair");
  const std::size_t near = edges_between(occluders, source, piece);
  const std::size_t most_edges = near - std::min<std::size_t>(near, random.below(6));
  const std::uint64_t bound = random.below(4);
  std::size_t asks = 0;
  const std::size_t most_asks = random.below(random.chance(1, 2) ? 4 : 200);
  if (bound == 0) {
    options.events = random.below(random.chance(1, 2) ? 400 : 20);
    options.rays = 0;
  }
  if (bound == 1) options.out_of_time = [&] { return ++asks > most_asks; };
  const Events_answer parts = open_pair_by_events(occluders, source, pair, most_edges, options, counters);
  require(parts.status == Weak_status::undecided || parts.status == whole,
          "events of what is open say what events of all do");
  require(parts.status != Weak_status::undecided || bound < 2 || near > most_edges,
          "few edges leave nothing undecided");
  if (parts.status == Weak_status::visible) {
    const Near_plane h = occluders.plane(piece);
    require(!occluders.blocker(parts.sightline[0], parts.sightline[1], source.plane, h), "a sightline is free");
  }
}

/// Rectangles across the axes, on a lattice; rays along them between its lines.
inline void try_axis_rays(generate::Random& random) {
  struct Rectangle {
    std::size_t axis;
    std::array<long, 3> low, high;
  };
  std::vector<Rectangle> all;
  Polygon_soup soup;
  for (std::size_t k = random.below(7); k > 0; --k) {
    Rectangle r{random.below(3), {}, {}};
    for (std::size_t i = 0; i < 3; ++i) {
      r.low[i] = random.between(-4, 4);
      r.high[i] = r.low[i] + (i == r.axis ? 0 : random.between(1, 4));
    }
    const std::size_t a = (r.axis + 1) % 3, b = (r.axis + 2) % 3;
    const bool again = std::any_of(all.begin(), all.end(), [&](const Rectangle& other) {  // one hit is one rectangle
      return other.axis == r.axis && other.low[r.axis] == r.low[r.axis];
    });
    if (again) continue;
    const auto corner = [&](bool far_a, bool far_b) {
      std::array<long, 3> p = r.low;
      if (far_a) p[a] = r.high[a];
      if (far_b) p[b] = r.high[b];
      return soup.add_point(Rational(p[0]), Rational(p[1]), Rational(p[2]));
    };
    const Point_id p = corner(false, false), q = corner(true, false), s = corner(true, true), t = corner(false, true);
    soup.add_face({p, q, s, t});
    all.push_back(r);
  }
  const Scene scene(soup);
  const Occluders occluders(scene);
  if (all.empty()) {
    require(!occluders.first_hit({0, 0, 0}, {1, 0, 0}), "where there is nothing, nothing is hit");
    return;
  }
  // From the file's coordinates to those of doubles, by corners; in halves that are no coordinates of rectangles.
  const auto mapped = [&](std::size_t axis, double x) -> std::optional<double> {
    const std::span<const Piece_corner> corners = scene.corners(scene.pieces()[0]);
    for (std::uint32_t i = 0; i < scene.pieces().size(); ++i)
      for (const Piece_corner& other : scene.corners(scene.pieces()[i])) {
        const double from = scene.position(corners[0].point)[axis].get_d(),
                     to = scene.position(other.point)[axis].get_d();
        const double near_from = occluders.near_point_of(corners[0].point)[axis],
                     near_to = occluders.near_point_of(other.point)[axis];
        if (from != to) return near_from + (near_to - near_from) * (x - from) / (to - from);
      }
    return std::nullopt;
  };
  for (std::size_t turn = 0; turn < 6; ++turn) {
    const std::size_t axis = random.below(3);
    const double sense = random.chance(1, 2) ? 1 : -1;
    std::array<double, 3> from;
    Triple near_from{}, direction{};
    bool is_mapped = true;
    for (std::size_t k = 0; k < 3; ++k) {
      from[k] = static_cast<double>(random.between(-6, 9)) + 0.5;
      const std::optional<double> x = mapped(k, from[k]);
      is_mapped = is_mapped && x;
      near_from[k] = x.value_or(0);
    }
    if (!is_mapped) continue;
    direction[axis] = sense;
    const Rectangle* first = nullptr;
    double least = 0;
    for (const Rectangle& r : all) {
      if (r.axis != axis) continue;
      bool holds = true;
      for (std::size_t k = 0; k < 3; ++k)
        holds = holds &&
                (k == axis || (static_cast<double>(r.low[k]) < from[k] && from[k] < static_cast<double>(r.high[k])));
      const double t = sense * (static_cast<double>(r.low[axis]) - from[axis]);
      if (holds && t > 0 && (first == nullptr || t < least)) {
        first = &r;
        least = t;
      }
    }
    const std::optional<Occluders::Hit> hit = occluders.first_hit(near_from, direction);
    require(hit.has_value() == (first != nullptr), "a ray hits something iff it is before it");
    if (!hit) continue;
    const Face_id face = scene.pieces()[hit->piece].face;
    require(&all[face] == first, "a ray hits the nearest rectangle first");
    require(hit->front == (sense < 0), "it hits that from the side that it comes from");
  }
}

/// Segments between points of pieces: what blocks one is among the pieces that are near it, which come by rank, each
/// once.
inline void try_segments(generate::Random& random) {
  constexpr std::size_t most_pieces = 60;
  const harness::Posed_scene posed = harness::make(any_case(random));
  const Scene scene(posed.soup);
  if (scene.pieces().empty() || scene.pieces().size() > most_pieces) return;
  const Occluders occluders(scene);
  const auto any_piece = [&] { return static_cast<std::uint32_t>(random.below(scene.pieces().size())); };
  const auto point_of = [&](std::uint32_t piece) {
    Homogeneous sum{0, 0, 0, 0};
    for (const Near_point& corner : occluders.polygon(piece)) {
      const unsigned long weight = 1 + random.below(1u << 20);
      for (std::size_t k = 0; k < 4; ++k) sum[k] += weight * corner.exact[k];
    }
    return near_point(occluders.frame(), sum);
  };
  for (int turn = 0; turn < 8; ++turn) {
    const std::uint32_t a = any_piece(), b = any_piece();
    const Near_point p = point_of(a), q = point_of(b);
    const std::vector<std::uint32_t> near = occluders.near_segment(p.near, q.near, 1e-12);
    for (std::size_t k = 0; k + 1 < near.size(); ++k)
      require(occluders.rank(near[k]) < occluders.rank(near[k + 1]), "pieces near a segment come by rank");
    const std::optional<std::uint32_t> blocker = occluders.blocker(p, q, occluders.plane(a), occluders.plane(b));
    require(!blocker || std::find(near.begin(), near.end(), *blocker) != near.end(),
            "what blocks a segment is near it");
  }
}

/// Segments through points of an edge, or as little beside it as 2^-60 of its length, of a triangle with a corner in
/// the middle of the scene, where the doubles of that corner are 0: they are blocked iff they meet a triangle.
inline void try_middle_corner(generate::Random& random) {
  const auto any = [&] {
    Exact_point p;
    for (Rational& x : p) x = exact(static_cast<double>(random.between(-(1l << 52), 1l << 52)) * 0x1p-50);
    return p;
  };
  const Exact_point zero{0, 0, 0}, b = any(), c = any(), n = cross(b, c);
  if (is_zero(n)) return;
  const auto times = [&](long factor, const Exact_point& p) { return generate::along(zero, factor, p); };
  // The others make the box about all even.
  const std::vector<generate::Points> corners{{zero, b, c},
                                              {times(-1, b), times(-1, c), times(-1, generate::along(b, 1, c))},
                                              {generate::along(b, 1, c), b, c}};
  const Polygon_soup soup = generate::soup_of(corners);
  const Scene scene(soup);
  if (scene.pieces().size() != corners.size()) return;
  const Occluders occluders(scene);
  const std::vector<harness::Flat_face> faces = harness::flat_faces_of(scene);
  for (int turn = 0; turn < 8; ++turn) {
    const Rational share = generate::integer(random, 1, 1000) / 1001;
    Exact_point m = generate::along(zero, share, random.chance(1, 2) ? b : c);
    const Exact_point inwards = minus(generate::along(b, 1, c), m), d = any();
    m = generate::along(m, random.between(-1, 1) * generate::power_of_two(-60), inwards);
    const Exact_point p = generate::along(m, 1, d), q = generate::along(m, -1, d);
    const auto is_met = [&](const harness::Flat_face& face) {
      const Rational at_p = face.height(p), at_q = face.height(q);
      return sgn(at_p) * sgn(at_q) < 0 &&
             face.side_within(generate::along(p, Rational(at_p / (at_p - at_q)), minus(q, p))) >= 0;
    };
    if (std::any_of(faces.begin(), faces.end(), [&](const auto& f) { return f.height(p) == 0 || f.height(q) == 0; }))
      continue;
    const bool is_blocked =
        occluders.blocker(occluders.located(p), occluders.located(q), occluders.plane(0), occluders.plane(0))
            .has_value();
    require(is_blocked == std::any_of(faces.begin(), faces.end(), is_met), "a segment is blocked iff it meets a face");
  }
}

inline void weak_parts(std::string_view bytes) {
  Bytes from(bytes);
  const std::size_t kind = from.below(7);
  generate::Random random(from.word());
  if (kind == 0) try_axis_rays(random);
  else if (kind == 1) try_segments(random);
  else if (kind == 2) try_middle_corner(random);
  else try_parts_of_a_pair(random);
}

}  // namespace fuzz
