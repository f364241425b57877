// Plantinga's events against truths by construction, sightlines tested by brute force, the other engine, and hand-made
// places where edges meet. SIGHTLINE_LONG: so many times the scenes, for a long run.

#include "parallel_planes.h"
#include "../sample.h"

#include <sightline/harness/generate/soups.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/algorithms/weak_visibility/events/event_shaft.h>
#include <sightline/algorithms/weak_visibility/events/events.h>
#include <sightline/algorithms/weak_visibility/events/sign_cover.h>

#include <gtest/gtest.h>

namespace {

using namespace sightline;
using weak_scenes::Family;
using weak_scenes::Weak_scene;

const std::vector<Family>& event_families() {
  static const std::vector<Family> all = [] {
    std::vector<Family> list = weak_scenes::families();
    list.push_back({"parallel_planes", weak_oracle::parallel_planes_scene});
    return list;
  }();
  return all;
}

/// Edges up to which shafts are not divided: always divided, or never.
std::size_t undivided(std::uint64_t seed) { return seed % 2 == 0 ? 1000000 : 0; }

/// The answer for one face; every sightline is tested by brute force.
Weak_status by_events(const Weak_scene& scene, Face_id face, const Events_options& options, Event_counters& counters) {
  const Scene read(scene.soup);
  const Occluders occluders(read);
  const Weak_source source = weak_source(occluders, scene.source);
  const oracle::Flats flats = oracle::flats_of(read);
  Weak_status status = Weak_status::hidden;
  for (std::uint32_t piece = 0; piece < read.pieces().size(); ++piece) {
    if (read.pieces()[piece].face != face) continue;
    const Events_answer answer = weakly_visible_by_events(occluders, source, piece, options, counters);
    if (answer.status == Weak_status::hidden) continue;
    status = answer.status;
    if (status == Weak_status::undecided) continue;
    const weak_oracle::Sightline line{read.position(answer.sightline[0].exact),
                                      read.position(answer.sightline[1].exact)};
    if (!options.two_sided) {
      EXPECT_TRUE(weak_oracle::proves_visible(flats, scene.source, face, line)) << scene.name << ", face " << face;
    }
    return status;
  }
  return status;
}

class Event_families : public testing::TestWithParam<std::size_t> {};

TEST_P(Event_families, are_all_decided_as_they_were_built) {
  const Family& family = event_families()[GetParam()];
  Event_counters counters;
  Events_options options;
  options.rays = 0;
  for (std::uint64_t seed = 0; seed < weak_scenes::seeds(test_scenes::is_sanitized() ? 3 : 12); ++seed) {
    const Weak_scene scene = family.make(seed);
    options.undivided = undivided(seed / 3 + seed);
    for (const Face_id face : scene.targets) {
      const Weak_status status = by_events(scene, face, options, counters);
      EXPECT_NE(status, Weak_status::undecided) << scene.name << ", face " << face;
      if (scene.truth) {
        EXPECT_EQ(status == Weak_status::visible, *scene.truth) << scene.name << ", face " << face;
      } else if (status == Weak_status::hidden) {
        EXPECT_FALSE(weak_oracle::find_sightline(scene, face, 100, seed)) << scene.name << ", face " << face;
      }
    }
  }
  EXPECT_GT(counters.targets, 0u);
  EXPECT_EQ(counters.refuted, 0u);  // a free cell has a sightline
}
INSTANTIATE_TEST_SUITE_P(All, Event_families, testing::Range(std::size_t{0}, event_families().size()),
                         [](const auto& of) { return event_families()[of.param].name; });

/// All faces by both methods: the same wherever the search decides; its certificate is accepted, sightlines of events
/// are tested by brute force.
TEST_P(Event_families, and_the_search_among_lines_say_the_same) {
  const Family& family = event_families()[GetParam()];
  Event_counters counters;
  std::size_t scenes = 0, visible = 0, hidden = 0, left = 0;
  for (std::uint64_t seed = 0; seed < weak_scenes::seeds(test_scenes::is_sanitized() ? 1 : 3); ++seed, ++scenes) {
    const Weak_scene scene = family.make(seed);
    const Scene read(scene.soup);
    const Occluders occluders(read);
    const Weak_source source = weak_source(occluders, scene.source);
    const oracle::Flats flats = oracle::flats_of(read);
    Weak_options lines;
    Events_options events;
    lines.search.two_sided = events.two_sided = seed % 2 == 0;
    events.undivided = undivided(seed / 2);
    events.rays = 0;
    lines.search.cells = 2000;
    const Weakly_visible found = weakly_visible(occluders, {source}, lines);
    const Verdict verdict =
        verify_weak(scene.soup, weak_certificate(read, {scene.source}, lines.search.two_sided, found));
    EXPECT_TRUE(verdict.accepted) << scene.name << ": " << verdict.why;
    left += found.undecided.size();
    visible += found.visible.size();
    hidden += found.hidden.size();
    for (std::uint32_t piece = 0; piece < read.pieces().size(); ++piece) {
      const Face_id face = read.pieces()[piece].face;
      if (std::binary_search(found.undecided.begin(), found.undecided.end(), face)) continue;
      const Events_answer answer = weakly_visible_by_events(occluders, source, piece, events, counters);
      EXPECT_NE(answer.status, Weak_status::undecided) << scene.name << ", piece " << piece;
      const bool is_visible = std::binary_search(found.visible.begin(), found.visible.end(), face);
      if (is_visible && first_pieces(read.pieces()).size() == read.pieces().size()) {
        EXPECT_EQ(answer.status, Weak_status::visible) << scene.name << ", piece " << piece;
      }
      if (!is_visible) {
        EXPECT_EQ(answer.status, Weak_status::hidden) << scene.name << ", piece " << piece;
      }
      if (answer.status != Weak_status::visible || events.two_sided) continue;
      const weak_oracle::Sightline line{read.position(answer.sightline[0].exact),
                                        read.position(answer.sightline[1].exact)};
      EXPECT_TRUE(weak_oracle::proves_visible(flats, scene.source, face, line)) << scene.name << ", face " << face;
    }
  }
  EXPECT_GT(visible + hidden, 0u);
  RecordProperty("scenes", static_cast<int>(scenes));
  RecordProperty("visible", static_cast<int>(visible));
  RecordProperty("hidden", static_cast<int>(hidden));
  RecordProperty("undecided_by_lines", static_cast<int>(left));
}

TEST(Events, see_the_same_from_source_to_target_as_back) {
  Event_counters counters;
  Events_options options;
  options.rays = 0;
  std::size_t visible = 0, hidden = 0;
  for (const Family& family : event_families()) {
    if (family.name == "boxes" || family.name == "nudged") continue;  // several targets; targets that are not planar
    for (std::uint64_t seed = 0; seed < weak_scenes::seeds(test_scenes::is_sanitized() ? 1 : 3); ++seed) {
      Weak_scene scene = family.make(seed);
      if (scene.targets.size() != 1) continue;
      // Both as faces, then each in turn as the source.
      const auto points_of = [&](Face_id face) {
        weak_scenes::Points points;
        for (const Point_id p : scene.soup.loop(face, 0)) points.push_back(scene.soup.point(p));
        return points;
      };
      std::vector<Point_id> loop;
      for (const Exact_point& p : scene.source) loop.push_back(scene.soup.add_point(p[0], p[1], p[2]));
      scene.soup.add_face(loop);
      const Face_id source = static_cast<Face_id>(scene.soup.face_count() - 1);
      if (const Scene prepared(scene.soup); !prepared.set_aside().empty()) continue;
      Weak_scene back = scene;
      back.source = points_of(scene.targets[0]);
      const Weak_status forth = by_events(scene, scene.targets[0], options, counters);
      EXPECT_EQ(forth, by_events(back, source, options, counters)) << scene.name;
      ++(forth == Weak_status::visible ? visible : hidden);
    }
  }
  EXPECT_GT(visible, test_scenes::is_sanitized() ? 0u : 5u);
  EXPECT_GT(hidden, test_scenes::is_sanitized() ? 0u : 5u);
}

TEST(Events, of_a_target_that_stands_on_the_source_show_it) {
  // All lines that touch the target's two free edges pass its apex; its third edge is in the source's plane.
  const Weak_scene scene{
      "standing",
      weak_scenes::soup_of({{weak_scenes::at(-1, 2, 0), weak_scenes::at(1, 2, 0), weak_scenes::at(0, 2, 2)}}),
      {weak_scenes::at(-1, -1, 0), weak_scenes::at(1, -1, 0), weak_scenes::at(1, 1, 0), weak_scenes::at(-1, 1, 0)},
      {0},
      true};
  Event_counters counters;
  Events_options options;
  options.rays = 0;
  EXPECT_EQ(by_events(scene, 0, options, counters), Weak_status::visible);
  EXPECT_EQ(counters.away, 0u);
}

TEST(Events, keep_surfaces_from_source_to_target) {
  const Weak_scene scene = weak_scenes::families()[0].make(1);
  const Scene read(scene.soup);
  const Occluders occluders(read);
  Events_options options;
  options.rays = 0;
  options.surfaces = true;
  const Weakly_visible_by_events found =
      weakly_visible_by_events(occluders, {weak_source(occluders, scene.source)}, options);
  EXPECT_EQ(found.visible.size() + found.hidden.size() + found.undecided.size(), read.counters().faces);
  EXPECT_EQ(found.sightlines.size(), found.visible.size());
  ASSERT_FALSE(found.surfaces.empty());
  const weak_oracle::Half_space from = weak_oracle::plane_of(scene.source);
  for (const Event_surface& surface : found.surfaces) {
    const weak_oracle::Half_space to = weak_oracle::plane_of(oracle::flats_of(read)[surface.piece].corners);
    for (const auto& [p, q] : surface.rulings) {
      EXPECT_EQ(sgn(from.height(p)), 0);
      EXPECT_GE(oracle::holds(scene.source, from.normal, p), 0);
      EXPECT_EQ(sgn(to.height(q)), 0);
    }
  }
}

TEST(Events, find_cells_that_are_ulps_wide) {
  // Beside lines that nearly touch a regulus twice: planes of cells have thousands of bits there, and the first ways
  // into them were longer than any step was short.
  constexpr std::size_t tangent = 8;
  for (const std::uint64_t seed : {22u, 35u, 38u}) {
    generate::Random random(64 * seed + tangent);
    const weak_scenes::Draft draft =
        weak_scenes::drafters[tangent].draft(random, Rational(Integer(1), Integer(1) << 49));
    Weak_scene scene = weak_scenes::finished(draft, random);
    scene.name = "tangent " + std::to_string(seed);
    Event_counters counters;
    for (Face_id face = 0; face < scene.soup.face_count(); ++face)
      EXPECT_NE(by_events(scene, face, {}, counters), Weak_status::undecided) << scene.name << ", face " << face;
  }
}

TEST(Events, beyond_doubles_are_as_certain_as_lines) {
  // A square under a lid that leaves a rim of it free, seen from where products of coordinates are about 2^1024: at
  // some of these distances one of three terms overflows that nearly cancel.
  const Polygon_soup soup = generate::soup_of({generate::rectangle(-1000000, 1000000, -1000000, 1000000, 0),
                                               generate::rectangle(-999999, 999999, -999999, 999999, 1)});
  const Scene scene(soup);
  const Occluders occluders(scene);
  for (const long sixteenths : {16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 31})
    for (const unsigned long exponent : {518ul, 519ul, 520ul, 521ul}) {
      generate::Points far{generate::at(306, 215, 388), generate::at(310, 209, 388), generate::at(294, 185, 412),
                           generate::at(290, 191, 412)};
      for (Exact_point& p : far)
        for (Rational& x : p) x = x * sixteenths * Rational(Integer(1) << exponent);
      const std::vector<Weak_source> source{weak_source(occluders, far)};
      Events_options options;
      options.threads = 1;
      const std::vector<Face_id> by_events = weakly_visible_by_events(occluders, source, options).visible;
      EXPECT_EQ(by_events, weakly_visible(occluders, source, {}).visible) << sixteenths << ", " << exponent;
      EXPECT_EQ(by_events.size(), 2u);
    }
}

TEST(Events, find_a_line_through_slits_of_any_width) {
  // One wide, crossed, 10^3000 apart: the least step into a cell that shows it is below 2^-8192.
  Integer size;
  mpz_ui_pow_ui(size.get_mpz_t(), 10, 3000);
  const Rational n(size);
  const Weak_scene scene{
      "slits",
      generate::soup_of(
          {generate::reversed(generate::rectangle(-n, n, -n, n, 4 * n)),
           generate::rectangle(-2 * n, 0, -2 * n, 2 * n, n), generate::rectangle(1, 2 * n, -2 * n, 2 * n, n),
           generate::rectangle(-2 * n, 2 * n, -2 * n, 0, 3 * n), generate::rectangle(-2 * n, 2 * n, 1, 2 * n, 3 * n)}),
      generate::rectangle(-n, n, -n, n, 0),
      {0},
      true};
  Event_counters counters;
  EXPECT_EQ(by_events(scene, 0, {}, counters), Weak_status::visible);
}

TEST(Events, beyond_the_budget_are_undecided) {
  const Weak_scene scene = weak_scenes::families()[0].make(0);
  Event_counters counters;
  Events_options options;
  options.rays = 0;
  options.events = 3;
  EXPECT_EQ(by_events(scene, scene.targets[0], options, counters), Weak_status::undecided);
  EXPECT_LE(counters.horizon + counters.edge_vertex + counters.triple, 5u);
}

// ---- Shafts in parts

TEST(Event_shafts, of_random_triangles_are_decided_as_without_parts) {
  Event_counters whole, divided;
  std::size_t hidden = 0, visible = 0;
  for (const std::size_t n : {12u, 30u, 60u})
    for (std::uint64_t seed = test_scenes::is_sanitized() ? 3 : 0;
         seed < weak_scenes::seeds(test_scenes::is_sanitized() ? 4 : 6); ++seed) {
      const Polygon_soup soup = generate::triangles_between_squares(n, seed);
      const Scene scene(soup);
      const Occluders occluders(scene);
      const std::vector<Weak_source> source{weak_source(occluders, 0)};
      Events_options options;
      options.rays = 0;
      options.threads = 1;
      options.undivided = n < 60 ? 1000000 : 30;
      const Weakly_visible_by_events at_once = weakly_visible_by_events(occluders, source, options);
      options.undivided = 0;
      const Weakly_visible_by_events in_parts = weakly_visible_by_events(occluders, source, options);
      EXPECT_EQ(at_once.visible, in_parts.visible) << n << ", " << seed;
      EXPECT_EQ(at_once.hidden, in_parts.hidden) << n << ", " << seed;
      EXPECT_TRUE(in_parts.undecided.empty()) << n << ", " << seed;
      hidden += in_parts.hidden.size();
      visible += in_parts.visible.size();
      whole += at_once.counters;
      divided += in_parts.counters;
    }
  EXPECT_GT(hidden, 20u);
  EXPECT_GT(visible, 20u);
  EXPECT_GT(divided.shafts_covered, 0u);
  EXPECT_LT(divided.triple * 2, whole.triple);
  EXPECT_EQ(whole.refuted + divided.refuted, 0u);
}

/// A wall of n x n squares of two triangles each across [-4, 4]^2, at heights about 5 by lattice points, each triangle
/// shrunk about its centroid to so much of itself; face `hole` has none. Face 0 is seen from below through that.
Weak_scene wall(long n, bool uneven, const Rational& of_itself, long hole, const generate::Projective_map& map) {
  generate::Random random(static_cast<std::uint64_t>(n));
  std::vector<Exact_point> points;
  for (long i = 0; i <= n; ++i)
    for (long k = 0; k <= n; ++k)
      points.push_back(generate::at(generate::ratio(8 * i, n) - 4, generate::ratio(8 * k, n) - 4,
                                    uneven ? Rational(5 + generate::integer(random, -8, 8) / 7) : Rational(5)));
  generate::Faces faces{generate::reversed(generate::rectangle(-1, 1, -1, 1, 10))};
  for (long i = 0; i < n; ++i)
    for (long k = 0; k < n; ++k) {
      const auto corner = [&](long u, long v) { return points[static_cast<std::size_t>((i + u) * (n + 1) + k + v)]; };
      for (generate::Points triangle : {generate::Points{corner(0, 0), corner(1, 0), corner(1, 1)},
                                        generate::Points{corner(0, 0), corner(1, 1), corner(0, 1)}}) {
        const Exact_point middle = generate::centroid(triangle);
        for (Exact_point& p : triangle) p = generate::along(middle, of_itself, minus(p, middle));
        if (hole-- != 0) faces.push_back(generate::either_way(triangle, random));
      }
    }
  Weak_scene scene{"wall", generate::soup_of(faces), generate::rectangle(-1, 1, -1, 1, 0), {0}, {}};
  return generate::project(scene, map);
}

TEST(Event_shafts, behind_faces_that_share_edges_are_covered_by_several_together) {
  const Rational tiny(1, 1ul << 40);
  for (const generate::Projective_map& map : {generate::scaling(1, generate::at(0, 0, 0)),
                                              generate::scaling(generate::ratio(1, 3), generate::at(1000000, 7, -9)),
                                              generate::scaling(Rational(1, 1ul << 60), generate::at(0, 0, 0))})
    for (const bool uneven : {false, true}) {
      Events_options options;
      options.rays = 0;
      options.undivided = 0;
      Event_counters closed, open;
      constexpr long n = 4;
      EXPECT_EQ(by_events(wall(n, uneven, 1, -1, map), 0, options, closed), Weak_status::hidden) << uneven;
      EXPECT_GT(closed.shafts_together, 0u);
      EXPECT_EQ(by_events(wall(n, uneven, 1, 2 * (2 * n + 2), map), 0, options, open), Weak_status::visible) << uneven;
      EXPECT_EQ(by_events(wall(n, uneven, 1 - tiny, -1, map), 0, options, open), Weak_status::visible) << uneven;
      if (!uneven) {
        EXPECT_EQ(by_events(wall(n, uneven, 1 + tiny, -1, map), 0, options, open), Weak_status::hidden);
      }
      EXPECT_EQ(open.refuted, 0u);
    }
}

TEST(Event_lines, once_out_of_time_are_taken_as_they_are) {
  // To find out which of them nothing touches takes edges times corners: 18 s of a source of 1,000 sides.
  const Scene scene(generate::triangles_between_squares(60, 3));
  const Occluders occluders(scene);
  const Weak_source source = weak_source(occluders, 0), target = weak_source(occluders, 1);
  const int beside = side(target.plane, source.polygon);
  std::size_t asked = 0;
  const Event_lines all(occluders, source.polygon, source.plane, target.polygon, target.plane, beside, [&] {
    ++asked;
    return false;
  });
  const Event_lines at_once(occluders, source.polygon, source.plane, target.polygon, target.plane, beside,
                            [] { return true; });
  EXPECT_GT(all.untouched(), 0u);
  EXPECT_GE(asked, all.untouched());
  EXPECT_EQ(at_once.untouched(), 0u);
  EXPECT_EQ(at_once.lines().size(), all.lines().size());
}

TEST(Event_shafts, with_time_run_out_are_undecided) {
  const Weak_scene scene = wall(6, true, 1, -1, generate::scaling(1, generate::at(0, 0, 0)));
  Events_options options;
  options.rays = 0;
  std::size_t asked = 0;
  options.out_of_time = [&] { return ++asked > 3; };
  Event_counters counters;
  EXPECT_EQ(by_events(scene, 0, options, counters), Weak_status::undecided);
}

TEST(Sign_clauses, hold_if_some_one_does_in_all_cases) {
  generate::Random random(1);
  std::array<std::size_t, 2> said{};
  for (int k = 0; k < 3000; ++k) {
    // The leaves of a tree of decisions; one of them dropped, or some more thrown in, contradictory ones too.
    const std::size_t numbers = 1 + random.below(6);
    std::vector<Sign_clause> clauses{{0, 0}};
    for (std::size_t split = random.below(12); split > 0; --split) {
      const std::size_t chosen = random.below(clauses.size());
      const std::uint64_t bit = std::uint64_t{1} << random.below(numbers);
      Sign_clause other = clauses[chosen];
      clauses[chosen].positive |= bit;
      other.negative |= bit;
      clauses.push_back(other);
    }
    if (random.chance(1, 2)) clauses.erase(clauses.begin() + static_cast<std::ptrdiff_t>(random.below(clauses.size())));
    for (std::size_t more = random.below(4); more > 0; --more) {
      const std::uint64_t all = (std::uint64_t{1} << numbers) - 1;
      clauses.push_back({random.below(all + 1), random.below(all + 1)});
    }
    bool truth = true;
    for (std::uint64_t positive = 0; positive >> numbers == 0; ++positive)
      truth &= std::any_of(clauses.begin(), clauses.end(), [&](const Sign_clause& clause) {
        return (clause.positive & ~positive) == 0 && (clause.negative & positive) == 0;
      });
    std::vector<Sign_clause> few = clauses;
    EXPECT_EQ(some_clause_holds(clauses, 1000), truth) << k;
    if (some_clause_holds(few, 2)) {
      EXPECT_TRUE(truth) << k;
    }
    ++said[truth ? 1 : 0];
  }
  EXPECT_GT(said[0], 500u);
  EXPECT_GT(said[1], 500u);
}

// ---- Cells beside events

/// The combinations of sides of touched lines that random lines near the event line have; and what the visit says they
/// can have.
template <class Visit_cells>
void expect_all_cells(const Event_chart& chart, const std::vector<const Exact_pluecker*>& touched,
                      Visit_cells visit_cells) {
  std::set<std::vector<int>> said, seen;
  visit_cells(chart, touched, [&](const std::vector<int>& signs, const Event_move& move) {
    said.insert(signs);
    const Exact_pluecker line = moved(chart, move, Rational(1, 1ul << 40));
    for (std::size_t k = 0; k < touched.size(); ++k) EXPECT_EQ(sgn(side(line, *touched[k])), signs[k]);
    return false;
  });
  generate::Random random(1);
  for (int k = 0; k < 20000; ++k) {
    Event_move move;
    for (Rational& x : move.first)
      x = Rational(static_cast<long>(random.between(-1000000, 1000000))) / (1ul << random.below(20));
    const Exact_pluecker line = moved(chart, move, Rational(1, 1ul << 40));
    std::vector<int> signs;
    for (const Exact_pluecker* t : touched) signs.push_back(sgn(side(line, *t)));
    if (std::find(signs.begin(), signs.end(), 0) == signs.end()) seen.insert(signs);
  }
  for (const std::vector<int>& signs : seen) EXPECT_EQ(said.count(signs), 1u);
  EXPECT_GE(seen.size() * 3, said.size());
}

TEST(Event_cells, around_three_skew_lines_are_all_eight) {
  const auto x = [](long a, long b, long c) { return Homogeneous{a, b, c, 1}; };
  // Lines x = k, z = k y of a hyperbolic paraboloid; the other ruling: y = c, z = c x. Event line y = 0.
  const std::vector<Exact_pluecker> lines{join(x(0, 0, 0), x(0, 1, 0)), join(x(1, 0, 0), x(1, 1, 1)),
                                          join(x(2, 0, 0), x(2, 1, 2)), join(x(3, 0, 0), x(3, 1, 3))};
  const Event_chart chart{x(0, 0, 0), x(1, 0, 0), x(0, 1, 0), x(1, 1, 1)};
  const auto visit = [](const Event_chart& c, const std::vector<const Exact_pluecker*>& t, auto v) {
    return visit_cells_at_regulus(c, t, v);
  };
  std::size_t three = 0, four = 0;
  expect_all_cells(chart, {&lines[0], &lines[1], &lines[2]}, visit);
  visit_cells_at_regulus(chart, {&lines[0], &lines[1], &lines[2]}, [&](const auto&, const auto&) {
    ++three;
    return false;
  });
  visit_cells_at_regulus(chart, {&lines[0], &lines[1], &lines[2], &lines[3]}, [&](const auto&, const auto&) {
    ++four;
    return false;
  });
  EXPECT_EQ(three, 8u);
  EXPECT_EQ(four, 14u);  // four planes through a point in general position
  expect_all_cells(chart, {&lines[0], &lines[1], &lines[2], &lines[3]}, visit);
  // The same event line by coordinates of thousands of bits: ways into cells stay as short.
  Event_chart large = chart;
  for (Homogeneous* point : {&large.v, &large.w, &large.r, &large.n})
    for (Integer& coordinate : *point) coordinate <<= 3000;
  visit_cells_at_regulus(large, {&lines[0], &lines[1], &lines[2], &lines[3]}, [&](const auto&, const Event_move& move) {
    for (const Rational& by : move.first) {
      EXPECT_LE(abs(by), 1);
      EXPECT_LE(bit_length(by.get_den()), 64u);
    }
    return false;
  });
}

TEST(Event_cells, around_a_pencil_reach_between_its_own_lines) {
  const auto x = [](long a, long b, long c) { return Homogeneous{a, b, c, 1}; };
  const auto visit = [](const Event_chart& c, const std::vector<const Exact_pluecker*>& t, auto v) {
    return visit_cells_at_pencil(c, t, v);
  };
  // Through the origin, in the plane y = 0; the event line is the z axis.
  const Event_chart chart{x(0, 0, 0), x(0, 0, 1), {1, 0, 0, 0}, {0, 1, 0, 0}};
  const Exact_pluecker star = join(x(0, 0, 0), x(1, 2, 3)), star_2 = join(x(0, 0, 0), x(2, -1, 1)),
                       flat = join(x(0, 0, 3), x(1, 0, 5)), flat_2 = join(x(0, 0, -2), x(2, 0, -2)),
                       own = join(x(0, 0, 0), x(1, 0, 1)), own_2 = join(x(0, 0, 0), x(1, 0, 2)),
                       own_3 = join(x(0, 0, 0), x(-1, 0, 2));
  expect_all_cells(chart, {&star, &flat}, visit);
  expect_all_cells(chart, {&star, &star_2, &flat, &flat_2}, visit);
  expect_all_cells(chart, {&star, &flat, &own, &own_2}, visit);
  expect_all_cells(chart, {&star, &star_2, &flat, &flat_2, &own, &own_2, &own_3}, visit);
  // A line that pierces the plane between two lines of the pencil, near the event line: first order does not know it.
  std::set<std::vector<int>> cells;
  visit_cells_at_pencil(chart, {&own, &own_2}, [&](const std::vector<int>& signs, const Event_move&) {
    cells.insert(signs);
    return false;
  });
  EXPECT_EQ(cells.size(), 4u);
}

// ---- Roots

TEST(Quadratic_roots, compare_as_numbers_where_60_bits_do_not_tell) {
  // Roots 1/2 +- 2^-k sqrt(2), and neighbours: s^2 - s + 1/4 - 2^(1 - 2 k) = 0.
  const Parameter_range whole{Quadratic_root(0), Quadratic_root(1)};
  for (const unsigned long k : {5ul, 40ul, 100ul, 300ul}) {
    const Integer scale = Integer(1) << (2 * k);
    std::vector<Quadratic_root> roots, other;
    append_roots({{Integer(scale / 4 - 2), Integer(-scale), scale}}, whole, roots);
    append_roots({{Integer(1), Integer(-2), Integer(0)}}, whole, roots);
    append_roots({{Integer(3 * (scale / 4 - 2)), Integer(-3 * scale), Integer(3 * scale)}}, whole, other);
    ASSERT_EQ(roots.size(), 3u);
    ASSERT_EQ(other.size(), 2u);
    EXPECT_TRUE(roots[0] < roots[2] && roots[2] < roots[1]) << k;
    EXPECT_FALSE(roots[1] < roots[2] || roots[2] < roots[0] || roots[1] < roots[0]) << k;
    EXPECT_TRUE(roots[0] == other[0] && roots[1] == other[1] && !(roots[0] == other[1])) << k;
    const Rational low = inner_rational({roots[0], roots[2]}), high = inner_rational({roots[2], roots[1]}, 3);
    EXPECT_LT(low, Rational(1, 2));
    EXPECT_GT(high, Rational(1, 2));
    const Quadratic f{{Integer(scale / 4 - 2), Integer(-scale), scale}};
    EXPECT_EQ(f.sign(low), -1);
    EXPECT_EQ(f.sign(high), -1);
  }
}

TEST(Quadratic_roots, give_polynomials_their_signs) {
  const Quadratic_root root(Integer(0), 1, Integer(2), Integer(2));  // sqrt(1/2)
  EXPECT_EQ(root.sign_of({{Integer(-1), Integer(0), Integer(2)}}), 0);
  EXPECT_EQ(root.sign_of({{Integer(-1), Integer(0), Integer(3)}}), 1);
  EXPECT_EQ(root.sign_of({{Integer(-3), Integer(4), Integer(0)}}), -1);
}

TEST(Quadratic_roots, have_different_rationals_between_them) {
  const Parameter_range range{Quadratic_root(0), Quadratic_root(1)};
  std::set<Rational> found;
  for (unsigned long attempt = 0; attempt < 200; ++attempt) found.insert(inner_rational(range, attempt));
  EXPECT_EQ(found.size(), 200u);
  EXPECT_GT(*found.begin(), 0);
  EXPECT_LT(*found.rbegin(), 1);
}

}  // namespace
