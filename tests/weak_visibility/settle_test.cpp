// Open cells by events, where too many edges are near the whole of source and target.

#include "scenes.h"
#include "../sample.h"

#include <sightline/algorithms/verify/weak.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/events/events.h>
#include <sightline/algorithms/weak_visibility/settle.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/harness/generate/soups.h>
#include <sightline/kernel/time_limit.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

namespace weak_settle {
namespace {

using namespace sightline;

constexpr std::size_t tangent = 8;

std::uint64_t some(std::uint64_t scenes) { return test_scenes::is_sanitized() ? scenes / 4 : scenes; }

TEST(Settled_by_events, also_between_the_open_parts_alone) {
  std::size_t by_parts = 0;
  for (std::uint64_t seed = 0; seed < some(20); ++seed) {
    generate::Random random(seed);
    weak_scenes::Weak_scene scene =
        weak_scenes::finished(weak_scenes::drafters[tangent].draft(random, Rational(0)), random);
    // Specks all over the shaft: most of them are not near what stays open.
    weak_scenes::Points goal;
    for (const Point_id id : scene.soup.loop(scene.targets[0])) goal.push_back(scene.soup.point(id));
    for (const Exact_point& p : scene.source)
      for (const Exact_point& q : goal) {
        std::vector<Point_id> speck;
        for (const std::size_t axis : {0u, 1u, 2u}) {
          Exact_point x;
          for (std::size_t k = 0; k < 3; ++k) x[k] = Rational((p[k] + q[k]) / 2);
          x[axis] += Rational(1, 1000);
          speck.push_back(scene.soup.add_point(x[0], x[1], x[2]));
        }
        scene.soup.add_face(speck);
      }
    const Scene read(scene.soup);
    const Occluders occluders(read);
    const std::vector<Weak_source> sources{weak_source(occluders, scene.source)};
    const Weakly_visible before = weakly_visible(occluders, sources);
    for (const Weakly_visible::Pair& pair : before.open) {
      Event_counters counters;
      const std::size_t edges = edges_between(occluders, sources[0], pair.piece);
      const Weak_status whole = open_pair_by_events(occluders, sources[0], pair, edges, {}, counters).status;
      const Weak_status parts = open_pair_by_events(occluders, sources[0], pair, edges - 1, {}, counters).status;
      EXPECT_NE(whole, Weak_status::undecided) << seed;
      if (parts == Weak_status::undecided) continue;
      EXPECT_EQ(parts, whole) << seed << ", piece " << pair.piece;
      ++by_parts;
    }
  }
  EXPECT_GT(by_parts, test_scenes::is_sanitized() ? 0u : 2u);
}

/// `SIGHTLINE_LONG=36 test_weak_visibility --gtest_filter='Left_open.*'` counts over 3,024 scenes.
TEST(Left_open, is_decided_and_proved_by_a_thorough_search_as_events_decide_it) {
  std::size_t scenes = 0, hidden = 0, visible = 0, left = 0;
  for (const weak_scenes::Family& family : weak_scenes::families())
    for (std::uint64_t seed = 0; seed < weak_scenes::seeds(some(4)) + (family.name == "tangent" ? 20 : 0); ++seed) {
      const weak_scenes::Weak_scene scene = family.make(seed);
      ++scenes;
      const Scene read(scene.soup);
      const Occluders occluders(read);
      const std::vector<Weak_source> sources{weak_source(occluders, scene.source)};
      Weakly_visible found = weakly_visible(occluders, sources);
      if (found.undecided.empty()) continue;
      Weakly_visible by_events = found;
      search_thoroughly(occluders, sources, {}, found);
      settle_by_events(occluders, sources, usual_event_edges, {}, by_events);
      for (const Face_id face : found.undecided) std::cout << scene.name << ": face " << face << " is left open\n";
      left += found.undecided.size();
      hidden += by_events.unproved.size();
      visible += by_events.visible.size();
      EXPECT_TRUE(
          std::includes(by_events.visible.begin(), by_events.visible.end(), found.visible.begin(), found.visible.end()))
          << scene.name;
      EXPECT_TRUE(
          std::includes(by_events.hidden.begin(), by_events.hidden.end(), found.hidden.begin(), found.hidden.end()))
          << scene.name;
      const Weak_certificate certificate = weak_certificate(read, {scene.source}, false, found);
      EXPECT_EQ(certificate.undecided, found.undecided) << scene.name;
      const Verdict verdict = verify_weak(scene.soup, certificate);
      EXPECT_TRUE(verdict.accepted) << scene.name << ": " << verdict.why;
    }
  std::cout << scenes << " scenes, of what was left open " << hidden << " faces hidden, " << left << " still open\n";
  EXPECT_GE(hidden, 2u);
  EXPECT_GE(visible, 1u);
  EXPECT_EQ(left, 0u);
}

/// A cell that is 2^-40 thin, beside three lines that nearly meet in a point: doubles find no line in it.
TEST(Left_open, cells_thinner_than_doubles_tell_apart_hold_lines_that_are_found) {
  for (const auto& [name, seed] : {std::pair{"shared_edges", 41u}, {"boxes", 98u}, {"concurrent_edges", 13u}})
    for (const weak_scenes::Family& family : weak_scenes::families()) {
      if (family.name != name) continue;
      const weak_scenes::Weak_scene scene = family.make(seed);
      const Scene read(scene.soup);
      const Occluders occluders(read);
      const std::vector<Weak_source> sources{weak_source(occluders, scene.source)};
      Weakly_visible found = weakly_visible(occluders, sources);
      EXPECT_FALSE(found.undecided.empty()) << scene.name << ": nothing to do";
      search_thoroughly(occluders, sources, {}, found);
      EXPECT_TRUE(found.undecided.empty() && found.open.empty()) << scene.name;
    }
}

/// What is undecided with so few cells and edges, over and over, and after all of it.
TEST(Decided_to_the_end, leaves_nothing_undecided_and_says_what_a_long_search_says) {
  std::size_t undecided = 0;
  for (std::uint64_t seed = 0; seed < some(24); ++seed) {
    generate::Random random(seed);
    const weak_scenes::Weak_scene scene =
        weak_scenes::finished(weak_scenes::drafters[seed % 12].draft(random, Rational(0)), random);
    const Scene read(scene.soup);
    const Occluders occluders(read);
    const std::vector<Weak_source> sources{weak_source(occluders, scene.source)};
    Weakly_visible whole = weakly_visible(occluders, sources);
    settle_by_events(occluders, sources, usual_event_edges, {}, whole);
    Weak_options few;
    few.search.cells = 1;
    few.search.rays = 0;
    Weakly_visible found = weakly_visible(occluders, sources, few);
    undecided += found.undecided.size();
    decide_the_rest(occluders, sources, few, 4, {}, found);
    EXPECT_TRUE(found.undecided.empty() && found.open.empty()) << seed;
    if (whole.undecided.empty()) {
      EXPECT_EQ(found.visible, whole.visible) << seed;
      EXPECT_EQ(found.hidden, whole.hidden) << seed;
    }
    const Verdict verdict = verify_weak(scene.soup, weak_certificate(read, {scene.source}, false, found));
    EXPECT_TRUE(verdict.accepted) << seed << ": " << verdict.why;
  }
  EXPECT_GT(undecided, test_scenes::least(24u));
}

/// In processor time, on one thread: other programs run beside this one.
TEST(Budget, bounds_the_time_of_lines_events_and_of_going_on) {
  const Polygon_soup soup = generate::triangles_between_squares(250, 3);
  const Scene scene(soup);
  const Occluders occluders(scene);
  const std::vector<Weak_source> sources{weak_source(occluders, 0), weak_source(occluders, 1)};
  for (const double budget : {0.0, 0.02, 0.2})
    for (const bool by_lines : {true, false}) {
      const double begin = processor_seconds();
      const std::function<bool()> out_of_time = [&] { return processor_seconds() - begin > budget; };
      Weak_options lines;
      lines.threads = 1;
      lines.search.out_of_time = out_of_time;
      lines.search.rays = 1;
      lines.search.cells = 3;  // so that events get most
      Events_options events;
      events.threads = 1;
      events.rays = 1;
      events.out_of_time = out_of_time;
      std::size_t undecided;
      if (by_lines) {
        Weakly_visible found = weakly_visible(occluders, sources, lines);
        settle_by_events(occluders, sources, 1000000, events, found);
        decide_the_rest(occluders, sources, lines, 1000000, events, found);
        undecided = found.undecided.size();
        EXPECT_EQ(undecided + found.visible.size() + found.hidden.size(), scene.counters().faces);
      } else undecided = weakly_visible_by_events(occluders, sources, events).undecided.size();
      EXPECT_LE(processor_seconds() - begin, (1.1 * budget + 0.05) * (test_scenes::is_sanitized() ? 10 : 1))
          << budget << by_lines;
      EXPECT_GT(undecided, 0u) << budget << by_lines;
    }
}

TEST(Settled_by_events, ends_with_what_progress_throws) {
  struct Enough {};
  std::size_t open = 0;
  for (std::uint64_t seed = 0; seed < 10 && open < some(10); ++seed) {
    generate::Random random(seed);
    const weak_scenes::Weak_scene scene =
        weak_scenes::finished(weak_scenes::drafters[tangent].draft(random, Rational(0)), random);
    const Scene read(scene.soup);
    const Occluders occluders(read);
    const std::vector<Weak_source> sources{weak_source(occluders, scene.source)};
    Weakly_visible found = weakly_visible(occluders, sources);
    if (found.open.empty()) continue;
    ++open;
    Events_options options;
    options.threads = 1;
    std::size_t calls = 0;
    options.progress = [&](std::size_t done, std::size_t all) {
      EXPECT_LT(done, all);
      ++calls;
    };
    Weakly_visible settled = found;
    settle_by_events(occluders, sources, usual_event_edges, options, settled);
    EXPECT_GE(calls, found.undecided.size());
    options.progress = [](std::size_t, std::size_t) { throw Enough(); };
    EXPECT_THROW(settle_by_events(occluders, sources, usual_event_edges, options, found), Enough);
  }
  EXPECT_GT(open, 0u);
}

}  // namespace
}  // namespace weak_settle
