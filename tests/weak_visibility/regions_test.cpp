// Around the search: quick answers that leave out nothing, what it leaves open and events decide, surfaces of events,
// and solids that look. SIGHTLINE_LONG: so many times the scenes, for a long run.

#include "../sample.h"
#include "rays.h"
#include "scenes.h"

#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/conservative.h>
#include <sightline/algorithms/weak_visibility/settle.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/algorithms/weak_visibility/volume.h>
#include <sightline/algorithms/weak_visibility/events/events.h>

#include <gtest/gtest.h>

#include <stdexcept>

namespace weak_regions {
namespace {

using namespace sightline;
using generate::Random;
using weak_scenes::at;
using weak_scenes::Faces;
using weak_scenes::Points;
using weak_scenes::rectangle;
using weak_scenes::reversed;
using weak_scenes::Weak_scene;

bool contains(const std::vector<Face_id>& faces, Face_id face) {
  return std::binary_search(faces.begin(), faces.end(), face);
}

// ---- Conservative

TEST(Conservative, leaves_out_nothing_that_is_visible_and_proves_what_it_hides) {
  std::size_t hidden = 0, too_many = 0;
  for (const weak_scenes::Family& family : weak_scenes::families())
    for (std::uint64_t seed = 0; seed < weak_scenes::seeds(6); ++seed) {
      const Weak_scene scene = family.make(seed);
      const Scene read(scene.soup);
      const Occluders occluders(read);
      const std::vector<Weak_source> sources{weak_source(occluders, scene.source)};
      Conservative_options options;
      options.two_sided = seed % 2 == 1;
      const Weakly_visible quick = possibly_visible(occluders, sources, options);
      EXPECT_EQ(quick.visible.size() + quick.hidden.size(), read.counters().faces) << scene.name;
      for (const Face_id target : scene.targets)
        EXPECT_TRUE(scene.truth != true || contains(quick.visible, target)) << scene.name;
      Weak_options lines;
      lines.search.two_sided = options.two_sided;
      lines.search.cells = 500;
      const Weakly_visible exact = weakly_visible(occluders, sources, lines);
      for (const Face_id face : exact.visible)
        EXPECT_TRUE(contains(quick.visible, face)) << scene.name << ", face " << face;
      const Verdict verdict = verify_weak(scene.soup, weak_certificate(read, {scene.source}, options.two_sided, quick));
      EXPECT_TRUE(verdict.accepted) << scene.name << ": " << verdict.why;
      hidden += quick.hidden.size();
      for (const Face_id face : exact.hidden) too_many += contains(quick.visible, face);
    }
  EXPECT_GT(hidden, 100u);
  EXPECT_GT(too_many, 20u);
}

TEST(Conservative, hides_what_one_piece_hides_and_not_what_two_do) {
  const Points source = rectangle(-1, 1, -1, 1, 0), target = reversed(rectangle(-1, 1, -1, 1, 2));
  const auto visible = [&](Faces faces) {
    faces.insert(faces.begin(), target);
    const Scene scene(generate::soup_of(faces));
    const Occluders occluders(scene);
    return contains(possibly_visible(occluders, {weak_source(occluders, source)}).visible, 0);
  };
  EXPECT_TRUE(visible({}));
  EXPECT_FALSE(visible({rectangle(-1, 1, -1, 1, 1)}));  // just all of the shaft
  EXPECT_FALSE(visible({reversed(rectangle(-1, 1, -1, 1, 1))}));
  for (const unsigned bits : {40u, 62u})  // doubles tell, or not
    EXPECT_TRUE(visible({rectangle(-1, Rational(1 - Rational(1, 1ul << bits)), -1, 1, 1)})) << bits;
  EXPECT_TRUE(visible({rectangle(-1, 0, -1, 1, 1), rectangle(0, 1, -1, 1, 1)}));
  // Upright, through the source's middle and across the target: it blocks some lines both ways, and no line along it.
  EXPECT_TRUE(visible({{at(0, -3, -1), at(0, 3, -1), at(0, 3, 3), at(0, -3, 3)}}));
}

TEST(Conservative, cuts_off_what_source_and_target_do_not_have_in_front_of_each_other) {
  // The target stands upright through the source's plane: only its upper half counts, and that is behind a screen that
  // the lower half would look past.
  const Points source = rectangle(-1, 1, -1, 1, 0), target{at(3, -1, -9), at(3, -1, 1), at(3, 1, 1), at(3, 1, -9)},
               screen{at(2, -3, 0), at(2, 3, 0), at(2, 3, 3), at(2, -3, 3)};
  for (const bool turned : {false, true}) {
    const Polygon_soup soup = generate::soup_of({turned ? reversed(target) : target, screen});
    const Scene scene(soup);
    const Occluders occluders(scene);
    Conservative_options options;
    options.two_sided = turned;
    const Weakly_visible quick = possibly_visible(occluders, {weak_source(occluders, source)}, options);
    EXPECT_TRUE(contains(quick.hidden, 0)) << turned;
    EXPECT_TRUE(verify_weak(soup, weak_certificate(scene, {source}, turned, quick)).accepted);
  }
  // A face in the source's plane has nothing in front of it.
  const Scene floor(generate::soup_of({rectangle(2, 3, -1, 1, 0)}));
  const Occluders in_plane(floor);
  EXPECT_TRUE(contains(possibly_visible(in_plane, {weak_source(in_plane, source)}).hidden, 0));
  // The source crosses the target's plane: one of its parts looks at the back. The cover leaves room below the roof;
  // the screen is in the way of both parts.
  const Points across{at(0, 1, -1), at(0, 1, 5), at(0, -1, 5), at(0, -1, -1)},
      roof = reversed(rectangle(1, 3, -1, 1, 4));
  const Points cover = rectangle(Rational(1, 2), 4, -4, 4, 3),
               upright{at(Rational(1, 2), -4, -2), at(Rational(1, 2), -4, 9), at(Rational(1, 2), 4, 9),
                       at(Rational(1, 2), 4, -2)};
  for (const bool two_sided : {false, true})
    for (const Points& before : {cover, upright}) {
      const Polygon_soup soup = generate::soup_of({roof, before});
      const Scene scene(soup);
      const Occluders occluders(scene);
      Conservative_options options;
      options.two_sided = two_sided;
      const Weakly_visible quick = possibly_visible(occluders, {weak_source(occluders, across)}, options);
      EXPECT_EQ(contains(quick.visible, 0), before == cover) << two_sided;
      EXPECT_TRUE(verify_weak(soup, weak_certificate(scene, {across}, two_sided, quick)).accepted);
    }
  // A screen up to the roof's plane is in the way of the part below it, not of the other one.
  const Scene low(generate::soup_of(
      {roof,
       {at(Rational(1, 2), -4, -2), at(Rational(1, 2), -4, 4), at(Rational(1, 2), 4, 4), at(Rational(1, 2), 4, -2)}}));
  const Occluders below(low);
  for (const bool two_sided : {false, true}) {
    Conservative_options options;
    options.two_sided = two_sided;
    EXPECT_EQ(contains(possibly_visible(below, {weak_source(below, across)}, options).visible, 0), two_sided);
  }
}

// ---- What the search leaves open

const weak_scenes::Family& family_called(const std::string& name) {
  for (const weak_scenes::Family& family : weak_scenes::families())
    if (family.name == name) return family;
  throw std::invalid_argument("no family " + name);
}

TEST(Settled_by_events, are_faces_that_lines_leave_open_and_certificates_claim_only_what_is_proved) {
  std::size_t settled = 0, visible = 0;
  for (const char* name : {"tangent", "nudged", "five_edges"})
    for (std::uint64_t seed = 0; seed < weak_scenes::seeds(12); ++seed) {
      const Weak_scene scene = family_called(name).make(seed);
      const Scene read(scene.soup);
      const Occluders occluders(read);
      const std::vector<Weak_source> sources{weak_source(occluders, scene.source)};
      Weak_options lines;
      lines.search.cells = seed % 2 == 0 ? 100 : 1;
      lines.search.rays = 0;  // so few cells that there is something to do, also where faces are visible
      Weakly_visible found = weakly_visible(occluders, sources, lines);
      const Weakly_visible before = found;
      settle_by_events(occluders, sources, 0, {}, found);  // no edges allowed: as it was
      EXPECT_EQ(found.undecided, before.undecided) << scene.name;
      EXPECT_EQ(found.open.size(), before.open.size()) << scene.name;
      const Event_counters counters = settle_by_events(occluders, sources, 1000, {}, found);
      EXPECT_TRUE(found.undecided.empty() && found.open.empty()) << scene.name;
      EXPECT_EQ(found.visible.size() + found.hidden.size(), read.counters().faces) << scene.name;
      EXPECT_GE(counters.targets, before.undecided.size());
      EXPECT_TRUE(std::is_sorted(found.pairs.begin(), found.pairs.end(), [](const auto& a, const auto& b) {
        return a.piece < b.piece;
      })) << scene.name;
      for (const Face_id target : scene.targets)
        EXPECT_EQ(contains(found.visible, target), scene.truth.value_or(contains(found.visible, target))) << scene.name;
      for (const Face_id face : before.undecided) {
        EXPECT_LE(contains(found.unproved, face), contains(found.hidden, face)) << scene.name;
        ++(contains(found.visible, face) ? visible : settled);
      }
      const Weak_certificate certificate = weak_certificate(read, {scene.source}, false, found);
      EXPECT_EQ(certificate.undecided, found.unproved);
      const Verdict verdict = verify_weak(scene.soup, certificate);
      EXPECT_TRUE(verdict.accepted) << scene.name << ": " << verdict.why;
    }
  EXPECT_GT(settled, 2u);
  EXPECT_GT(visible, 2u);
}

TEST(Settled_by_events, come_soon_where_edges_are_ulps_beside_a_degeneracy) {
  // Exactly concurrent, or on one regulus, they have short proofs; so close to that no proof is found, and each cell
  // that stays open would be one of thousands.
  std::size_t settled = 0;
  for (const std::size_t which : {5u, 6u, 7u, 10u})
    for (std::uint64_t seed = 0; seed < weak_scenes::seeds(12); ++seed) {
      Random random(seed);
      const weak_scenes::Draft draft =
          weak_scenes::drafters[which].draft(random, Rational(Integer(3), Integer(1) << 49));
      const Weak_scene scene = weak_scenes::finished(draft, random);
      const std::string name = std::string(weak_scenes::drafters[which].name) + ' ' + std::to_string(seed);
      const Scene read(scene.soup);
      const Occluders occluders(read);
      const std::vector<Weak_source> sources{weak_source(occluders, scene.source)};
      Weakly_visible found = weakly_visible(occluders, sources);
      EXPECT_LT(found.counters.cells, 1000 * read.counters().faces) << name;
      settled += found.undecided.size();
      settle_by_events(occluders, sources, 300, {}, found);
      EXPECT_TRUE(found.undecided.empty()) << name;
      for (const Face_id target : scene.targets)
        EXPECT_EQ(contains(found.visible, target), scene.truth.value_or(contains(found.visible, target))) << name;
    }
  EXPECT_GE(settled, 2u);
}

TEST(Settled_by_events, are_pairs_with_as_many_edges_as_allowed_and_one_that_is_visible_is_all_that_a_face_needs) {
  // Two plates hide the target from what is below them; a source beside them sees it.
  const Points target = reversed(rectangle(-2, 2, -2, 2, 4));
  const Scene read(generate::soup_of({target, rectangle(-4, 0, -2, 2, 2), rectangle(0, 4, -2, 2, 2)}));
  const Occluders occluders(read);
  const std::vector<Weak_source> sources{weak_source(occluders, rectangle(-1, 1, -1, 1, 0)),
                                         weak_source(occluders, rectangle(20, 21, -1, 1, 3))};
  Weak_options lines;
  lines.search.cells = 0;
  lines.search.rays = 0;  // all is left open
  const Weakly_visible open = weakly_visible(occluders, sources, lines);
  const std::size_t below = edges_between(occluders, sources[0], 0), beside = edges_between(occluders, sources[1], 0);
  ASSERT_GT(below, beside);
  const auto settled = [&](std::size_t edges) {
    Weakly_visible found = open;
    settle_by_events(occluders, sources, edges, {}, found);
    return found;
  };
  const Weakly_visible none = settled(beside - 1), one = settled(beside);
  EXPECT_TRUE(contains(none.undecided, 0));
  EXPECT_EQ(std::count_if(none.open.begin(), none.open.end(), [](const auto& pair) { return pair.piece == 0; }), 2);
  EXPECT_TRUE(contains(one.visible, 0));
  std::vector<std::uint32_t> by;
  for (const Weakly_visible::Pair& pair : one.pairs)
    if (pair.piece == 0) by.push_back(pair.source);
  EXPECT_EQ(by, (std::vector<std::uint32_t>{1}));
}

/// The sign of det[p, q, a, b] in homogeneous coordinates.
int side_of_line(const Exact_point& p, const Exact_point& q, const Exact_point& a, const Exact_point& b) {
  std::vector<std::vector<Rational>> rows;
  for (const Exact_point* x : {&p, &q, &a, &b}) rows.push_back({(*x)[0], (*x)[1], (*x)[2], Rational(1)});
  return sgn(generate::determinant(rows));
}

TEST(Open_cells, hold_each_sightline_that_the_search_stopped_short_of) {
  std::size_t held = 0, with_cuts = 0;
  for (const weak_scenes::Family& family : weak_scenes::families())
    for (std::uint64_t seed = 0; seed < (test_scenes::is_sanitized() ? 3 : weak_scenes::seeds(12)); ++seed) {
      const Weak_scene scene = family.make(seed);
      const Scene read(scene.soup);
      const Occluders occluders(read);
      const oracle::Flats flats = oracle::flats_of(read);
      const Weak_source source = weak_source(occluders, scene.source);
      const weak_oracle::Half_space from = weak_oracle::plane_of(scene.source);
      Weak_options lines;
      lines.search.cells = 2000;
      const Weakly_visible whole = weakly_visible(occluders, {source}, lines);
      lines.search.cells = 1 + seed % 12;
      lines.search.rays = 0;
      const Weakly_visible stopped = weakly_visible(occluders, {source}, lines);
      for (const Weakly_visible::Pair& open : stopped.open)
        for (const Weakly_visible::Pair& seen : whole.pairs) {
          if (seen.piece != open.piece || seen.answer.status != Weak_status::visible) continue;
          const Exact_point p = read.position(seen.answer.sightline[0].exact),
                            q = read.position(seen.answer.sightline[1].exact);
          std::size_t cells = 0;
          const std::vector<Open_cell> all = open_cells(occluders, source, open, 1000);
          for (const Open_cell& cell : all) {
            bool inside = oracle::holds(cell.source, from.normal, p) >= 0 &&
                          oracle::holds(cell.target, flats[open.piece].plane.normal, q) >= 0;
            for (const Open_cell::Side& side : cell.sides) {
              const Points& corners = flats[side.edge.piece].corners;
              inside = inside &&
                       side_of_line(p, q, corners[side.edge.corner], corners[(side.edge.corner + 1) % corners.size()]) *
                               side.sign >=
                           0;
            }
            cells += inside;
          }
          EXPECT_EQ(cells, 1u) << scene.name << ", piece " << open.piece;
          with_cuts += std::any_of(open.answer.proof.begin(), open.answer.proof.end(), [](const Weak_step& step) {
            return step.kind == Weak_step::Kind::cut_source || step.kind == Weak_step::Kind::cut_target;
          });
          EXPECT_EQ(open_cells(occluders, source, open, 1).size(), 1u);
          ++held;
        }
    }
  EXPECT_GT(held, 8u);
  EXPECT_GT(with_cuts, 2u);
}

// ---- Surfaces of events

TEST(Event_surfaces, are_kept_for_faces_that_are_visible_too_and_touch_edges) {
  // A plate over a part of the shaft.
  const Weak_scene scene{
      "half",
      generate::soup_of({reversed(rectangle(-1, 1, -1, 1, 2)), rectangle(Rational(1, 2), 3, -3, 3, 1)}),
      rectangle(-1, 1, -1, 1, 0),
      {0},
      true};
  const Scene read(scene.soup);
  const Occluders occluders(read);
  Events_options options;
  options.surfaces = true;
  const Weakly_visible_by_events found =
      weakly_visible_by_events(occluders, {weak_source(occluders, scene.source)}, options);
  EXPECT_EQ(found.visible, (std::vector<Face_id>{0}));  // the plate is seen from behind
  std::vector<std::array<Exact_point, 2>> edges;
  const auto add_edges = [&](const Points& polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i) edges.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
  };
  for (const oracle::Flat& flat : oracle::flats_of(read)) add_edges(flat.corners);
  add_edges(scene.source);
  std::size_t by_plate = 0;  // that touch the plate's edge across the shaft
  for (const Event_surface& surface : found.surfaces) {
    EXPECT_EQ(surface.piece, 0u);
    EXPECT_GE(surface.rulings.size(), 2u);
    bool plate = true;
    for (const auto& [p, q] : surface.rulings) {
      std::size_t touched = 0;
      for (const auto& [a, b] : edges) touched += side_of_line(p, q, a, b) == 0;
      EXPECT_GE(touched, 3u);
      plate = plate && side_of_line(p, q, at(Rational(1, 2), -3, 1), at(Rational(1, 2), 3, 1)) == 0;
      EXPECT_LE(p[0] + q[0], 1) << "through the plate's inside";
      for (const Exact_point* end : {&p, &q}) EXPECT_TRUE(abs((*end)[0]) <= 1 && abs((*end)[1]) <= 1);
    }
    by_plate += plate;
  }
  EXPECT_GT(by_plate, 1u);
}

TEST(Event_surfaces, are_kept_however_narrow_they_are) {
  // Of the lines through a corner and a long edge, those from a small source.
  const Rational half_width(Integer(1), Integer(1) << 70);
  const Points edge_above{at(-1, 0, 1), at(1, 0, 1), at(0, 2, 1)};
  const Exact_point corner = at(0, 0, Rational(3, 2));
  const Scene scene(generate::soup_of({reversed(rectangle(-4, 4, -4, 4, 2)),
                                       edge_above,
                                       {corner, at(1, 1, Rational(3, 2)), at(-1, 1, Rational(3, 2))}}));
  const Occluders occluders(scene);
  Events_options options;
  options.surfaces = true;
  const Weakly_visible_by_events found = weakly_visible_by_events(
      occluders, {weak_source(occluders, rectangle(-half_width, half_width, -half_width, half_width, 0))}, options);
  const auto is_through_both = [&](const Event_surface& surface) {
    return surface.piece == 0 && std::all_of(surface.rulings.begin(), surface.rulings.end(), [&](const auto& ruling) {
             const auto& [p, q] = ruling;
             return abs(p[0]) <= half_width && is_zero(cross(minus(q, p), minus(corner, p))) &&
                    side_of_line(p, q, edge_above[0], edge_above[1]) == 0;
           });
  };
  EXPECT_TRUE(std::any_of(found.surfaces.begin(), found.surfaces.end(), is_through_both));
}

// ---- Solids that look

Faces box(const Rational& x0, const Rational& x1, const Rational& y0, const Rational& y1, const Rational& z0,
          const Rational& z1) {
  return generate::box(at(x0, y0, z0), at(x1, y1, z1));
}
Faces turned(Faces faces) {
  for (Points& face : faces) face = reversed(face);
  return faces;
}
Faces joined(Faces faces, const Faces& more) {
  faces.insert(faces.end(), more.begin(), more.end());
  return faces;
}

struct Seen {
  Weakly_visible answer;
  std::vector<Face_id> within;
};
Seen seen_from(const Faces& solid, const Faces& faces, bool two_sided = false) {
  const Weak_volume volume(generate::soup_of(solid));
  const Polygon_soup soup = generate::soup_of(faces);
  const Scene scene(soup);
  const Occluders occluders(scene);
  std::vector<Weak_source> sources;
  for (const Points& part : volume.surface()) sources.push_back(weak_source(occluders, part));
  Weak_options options;
  options.search.two_sided = two_sided;
  Seen seen{weakly_visible(occluders, sources, options), {}};
  seen.within = add_seen_from_within(scene, volume, two_sided, seen.answer);
  EXPECT_EQ(seen.answer.visible.size() + seen.answer.hidden.size() + seen.answer.undecided.size(),
            scene.counters().faces);
  const Verdict verdict = verify_weak(soup, weak_certificate(scene, volume.surface(), two_sided, seen.answer));
  EXPECT_TRUE(verdict.accepted) << verdict.why;
  EXPECT_EQ(seen.answer.unproved, seen.within);
  return seen;
}
using Ids = std::vector<Face_id>;

TEST(Volume, in_a_room_sees_its_walls_whichever_way_its_own_fronts_look) {
  const Faces room = turned(box(0, 4, 0, 4, 0, 4)), solid = box(1, 2, 1, 2, 1, 2);
  for (const Faces& faces : {solid, turned(solid)}) {
    const Seen seen = seen_from(faces, room);
    EXPECT_EQ(seen.answer.visible.size(), 6u);
    EXPECT_TRUE(seen.within.empty());
    const Weak_volume volume(generate::soup_of(faces));
    EXPECT_EQ(volume.surface().size(), 6u);
    for (const Points& part : volume.surface())
      EXPECT_LT(weak_oracle::plane_of(part).height(at(Rational(3, 2), Rational(3, 2), Rational(3, 2))), 0)
          << "looks inwards";
    EXPECT_TRUE(
        volume.sees_from_within(rectangle(Rational(5, 4), 3, Rational(5, 4), Rational(7, 4), Rational(3, 2)), false))
        << "a part of it is in the solid";
  }
  EXPECT_TRUE(seen_from(solid, box(0, 4, 0, 4, 0, 4)).answer.visible.empty());  // their fronts look away
  EXPECT_EQ(seen_from(solid, box(0, 4, 0, 4, 0, 4), true).answer.visible.size(), 6u);
}

TEST(Volume, sees_from_within_what_passes_through_it_and_what_lies_in_its_surface_and_looks_in) {
  const Faces solid = box(0, 2, 0, 2, 0, 2);
  const Points inside = rectangle(Rational(1, 2), 1, Rational(1, 2), 1, 1), through = rectangle(1, 9, 1, 9, 1),
               bottom = rectangle(0, 1, 0, 1, 0), beside = rectangle(2, 3, 0, 1, 0),
               touching = rectangle(0, 2, 0, 2, 2);
  const Seen seen = seen_from(solid, {inside, through, bottom, beside, touching, reversed(rectangle(5, 6, 5, 6, 2)),
                                      rectangle(0, 1, 0, 1, -1)});
  // `through` and `beside` are seen from the side as well. `touching` looks up from the top, which looks up too.
  // `bottom` does not hide what is below it.
  EXPECT_EQ(seen.within, (Ids{0, 2}));
  EXPECT_EQ(seen.answer.visible, (Ids{0, 1, 2, 3, 5, 6}));
  const Seen both = seen_from(solid, {inside, through, bottom, beside, touching, reversed(bottom)}, true);
  EXPECT_EQ(both.answer.visible, (Ids{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(both.within, (Ids{0, 2, 4, 5}));
}

TEST(Volume, of_nested_boxes_that_share_a_face_closes_and_counts_it_twice) {
  // A box of height 3 and one of height 1 on the same floor, once each: the inside winds once above 1 and twice below.
  const Faces solid = joined(box(0, 2, 0, 2, 0, 3), box(0, 2, 0, 2, 0, 1));
  const Scene scene(generate::soup_of(solid));
  EXPECT_EQ(scene.set_aside().size(), 1u);
  const Weak_volume volume(generate::soup_of(solid));
  const auto level = [](const Rational& z) { return rectangle(Rational(1, 2), 1, Rational(1, 2), 1, z); };
  for (const Rational& z : {Rational(1, 2), Rational(2)})
    EXPECT_TRUE(volume.sees_from_within(level(z), false) && volume.sees_from_within(level(z), true)) << z;
  EXPECT_TRUE(volume.sees_from_within(level(0), false));
  EXPECT_FALSE(volume.sees_from_within(level(0), true)) << "below the floor";
  EXPECT_FALSE(volume.sees_from_within(level(4), true));
  for (const Points& part : volume.surface())
    EXPECT_FALSE(std::all_of(part.begin(), part.end(), [](const Exact_point& p) { return p[2] == 1; }))
        << "the lower lid has the inside on both sides";
  const Seen seen = seen_from(solid, {rectangle(-1, 3, -1, 3, -1), rectangle(-1, 3, -1, 3, 4), level(2)});
  EXPECT_EQ(seen.answer.visible, (Ids{0, 2}));
  EXPECT_EQ(seen.within, (Ids{2}));

  Faces open = joined(box(0, 2, 0, 2, 0, 3), {box(0, 2, 0, 2, 0, 3)[0]});
  EXPECT_THROW(Weak_volume(generate::soup_of(open)), std::invalid_argument) << "one face twice, and no other";
}

TEST(Volume, of_many_faces_takes_a_ray_for_each_where_none_meets_the_inside_of_another) {
  // Two pyramids over a concave polygon about their tops; planes of faces pass through others all over.
  constexpr long n = 24;
  Points zigzag;
  for (long k = 0; k <= n; ++k) zigzag.push_back(at(k, k * k + (k % 2 == 1 ? Rational(3, 2) : Rational(0)), 0));
  Faces faces;
  for (std::size_t i = 0; i < zigzag.size(); ++i) {
    const Exact_point &a = zigzag[i], &b = zigzag[(i + 1) % zigzag.size()];
    faces.push_back({a, b, at(n / 2, 3 * n * n / 8, n)});
    faces.push_back({b, a, at(n / 2, 3 * n * n / 8, -n)});
  }
  std::size_t told = 0;
  const Weak_volume volume(generate::soup_of(faces), [&](std::size_t done, std::size_t all) {
    EXPECT_LT(done, all);
    ++told;
  });
  EXPECT_EQ(volume.surface().size(), faces.size());
  EXPECT_LE(told, 2 * faces.size()) << "faces are cut";
  const auto end = [](std::size_t, std::size_t) { throw std::domain_error("over"); };
  EXPECT_THROW(Weak_volume(generate::soup_of(faces), end), std::domain_error);
}

TEST(Sources, are_named_by_their_strict_corners_in_certificates) {
  const Polygon_soup soup = generate::soup_of({rectangle(-2, 2, -2, 2, 0), reversed(rectangle(-1, 1, -1, 1, 1))});
  const Scene scene(soup);
  const Occluders occluders(scene);
  // Looks down; the first corner is there three times, and one edge has a point inside.
  const Points lamp{at(-1, -1, 4), at(-1, -1, 4), at(-1, 1, 4), at(0, 1, 4), at(1, 1, 4), at(1, -1, 4), at(-1, -1, 4)};
  EXPECT_EQ(strict_corners(lamp), (Points{at(-1, -1, 4), at(-1, 1, 4), at(1, 1, 4), at(1, -1, 4)}));
  for (const bool two_sided : {false, true}) {
    Weak_options options;
    options.search.two_sided = two_sided;
    const Weakly_visible found = weakly_visible(occluders, {weak_source(occluders, lamp)}, options);
    const Weak_certificate certificate = weak_certificate(scene, {lamp}, two_sided, found);
    EXPECT_EQ(certificate.sources[0].size(), 4u);
    const Verdict verdict = verify_weak(soup, certificate);
    EXPECT_TRUE(verdict.accepted) << verdict.why;
  }
}

TEST(Volume, that_is_concave_or_hollow_has_its_inside_where_its_faces_wind_around_it) {
  // An L: [0, 3] x [0, 3] less [1, 3] x [1, 3], of height 1, from two boxes that share a face, and with a cavity.
  const Faces ell = joined(box(0, 3, 0, 1, 0, 1), box(0, 1, 1, 3, 0, 1));
  const Points in_notch = rectangle(2, Rational(5, 2), 2, Rational(5, 2), Rational(1, 2)),
               in_foot = rectangle(2, Rational(5, 2), Rational(1, 4), Rational(1, 2), Rational(1, 2)),
               in_seam = rectangle(Rational(1, 4), Rational(1, 2), Rational(1, 2), Rational(3, 2), Rational(1, 2));
  EXPECT_EQ(seen_from(ell, {in_notch, in_foot, in_seam}).answer.visible, (Ids{0, 1, 2}));
  const Weak_volume volume(generate::soup_of(ell));
  EXPECT_FALSE(volume.sees_from_within(in_notch, false) || volume.sees_from_within(in_notch, true));
  EXPECT_TRUE(volume.sees_from_within(in_foot, false) && volume.sees_from_within(in_foot, true) &&
              volume.sees_from_within(in_seam, false));
  // The shared face has the inside on both sides, but for what of it is no part of the other box: two of its three
  // units.
  Rational shared = 0;
  for (const Points& part : volume.surface())
    if (std::all_of(part.begin(), part.end(), [](const Exact_point& p) { return p[1] == 1; }))
      shared += oracle::projected_area(part, at(0, 1, 0));
  EXPECT_EQ(shared, 2);

  const Faces hollow = joined(box(0, 9, 0, 9, 0, 9), turned(box(3, 6, 3, 6, 3, 6)));
  const Faces faces{rectangle(4, 5, 4, 5, 4), rectangle(1, 2, 1, 2, 1), rectangle(4, 5, 4, 5, 6),
                    reversed(rectangle(4, 5, 4, 5, 6))};
  const Seen around = seen_from(hollow, faces);
  EXPECT_EQ(around.within, (Ids{2}));                   // in the cavity's ceiling, looks up, into the solid
  EXPECT_EQ(around.answer.visible, (Ids{0, 1, 2, 3}));  // the cavity's walls look into it, and on through the solid
}

TEST(Volume, sees_exactly_what_random_points_of_its_inside_see_or_sightlines_from_its_surface_go_on_into_it) {
  std::size_t by_points = 0, by_sightlines = 0, within = 0;
  for (std::uint64_t seed = 0; seed < weak_scenes::seeds(12); ++seed) {
    Random random(seed);
    Faces faces;
    generate::add_any(faces, 12, random);
    for (int k = 0; k < 2; ++k) faces.push_back(generate::any_face(random, 1));  // in it
    const Rational low = Rational(-2) + weak_scenes::ratio(static_cast<long>(random.below(7)), 13),
                   high = low + Rational(23, 7);  // off the lattice that faces are on
    const Faces solid = box(low, high, low, high, low, high);
    const Polygon_soup soup = generate::soup_of(faces);
    const Scene scene(soup);
    const oracle::Flats flats = oracle::flats_of(scene);
    const Seen seen = seen_from(solid, faces);
    within += seen.within.size();
    // Sightlines from random points of its inside.
    for (int k = 0; k < 300; ++k) {
      Exact_point p;
      for (Rational& x : p) x = low + (high - low) * weak_scenes::ratio(static_cast<long>(1 + random.below(998)), 999);
      const oracle::Flat& flat = flats[random.below(flats.size())];
      const Exact_point q = weak_oracle::random_inner_point(flat.corners, random);
      if (sgn(flat.height(p)) <= 0 || !oracle::is_sightline(flats, p, q)) continue;
      EXPECT_TRUE(contains(seen.answer.visible, flat.face)) << "seed " << seed << ", face " << flat.face;
      ++by_points;
    }
    // Sightlines from its surface go on into it.
    for (const Weakly_visible::Pair& pair : seen.answer.pairs) {
      if (pair.answer.status != Weak_status::visible) continue;
      const Exact_point p = scene.position(pair.answer.sightline[0].exact),
                        q = scene.position(pair.answer.sightline[1].exact);
      Rational step(-1);
      Exact_point inner;
      const auto is_inside = [&] {
        return std::all_of(inner.begin(), inner.end(), [&](const Rational& x) { return x > low && x < high; });
      };
      for (int k = 0; k < 60; ++k, step /= 2)
        if (inner = weak_oracle::along(p, step, weak_oracle::minus(q, p));
            is_inside() && oracle::is_sightline(flats, inner, q))
          break;
      EXPECT_TRUE(is_inside() && oracle::is_sightline(flats, inner, q)) << "seed " << seed << ", piece " << pair.piece;
      ++by_sightlines;
    }
  }
  EXPECT_GT(by_points, 100u);
  EXPECT_GT(by_sightlines, 30u);
  EXPECT_GT(within, 3u);
}

TEST(Volume, settles_what_it_sees_from_within_and_leaves_no_pairs_of_it_open) {
  const Weak_volume volume(generate::soup_of(box(0, 3, 0, 3, 0, 3)));
  const Scene scene(generate::soup_of({{at(1, 1, 1), at(2, 1, 1), at(2, 1, 9), at(1, 1, 9)},
                                       reversed(rectangle(1, 2, 1, 2, 9))}));  // the first one stands in it
  const Occluders occluders(scene);
  std::vector<Weak_source> sources;
  for (const Points& part : volume.surface()) sources.push_back(weak_source(occluders, part));
  Weak_options options;
  options.search.cells = 0;
  options.search.rays = 0;
  options.search.two_sided = true;  // all is left open
  Weakly_visible found = weakly_visible(occluders, sources, options);
  ASSERT_EQ(found.undecided, (Ids{0, 1}));
  EXPECT_EQ(add_seen_from_within(scene, volume, true, found), (Ids{0}));
  EXPECT_EQ(found.undecided, (Ids{1}));
  for (const Weakly_visible::Pair& pair : found.open) EXPECT_EQ(pair.piece, 1u);
}

TEST(Volume, that_bounds_nothing_is_refused_with_advice) {
  const auto refused = [](const Faces& faces) -> std::string {
    try {
      const Weak_volume volume(generate::soup_of(faces));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  Faces open = box(0, 1, 0, 1, 0, 1);
  open.pop_back();
  EXPECT_NE(refused(open).find("do not close up"), std::string::npos);
  Faces one_turned = box(0, 1, 0, 1, 0, 1);
  one_turned[2] = reversed(one_turned[2]);
  EXPECT_NE(refused(one_turned).find("do not close up"), std::string::npos);
  EXPECT_NE(refused({}).find("no faces"), std::string::npos);
  EXPECT_NE(refused({rectangle(0, 1, 0, 1, 0), reversed(rectangle(0, 1, 0, 1, 0))}).find("enclose nothing"),
            std::string::npos);
}

}  // namespace
}  // namespace weak_regions
