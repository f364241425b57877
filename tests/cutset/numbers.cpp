// Where the arithmetic of the tracker is hard: steps below the last bit, long ways, heights within their error, bodies
// that doubles take for others.

#include "support.h"
#include "../sample.h"

namespace cutset_test {
namespace {

using Random = std::mt19937_64;

/// What a place should hold, by the definition.
struct Watched_node {
  std::uint32_t place;
  std::array<double, 4> row;
  double until;
  bool on, at_cut;
};

TEST(Watch_list, tests_what_ran_out_and_nothing_else) {
  Random random(3);
  using Tester = On_view<Exact_traits>;
  Watch_list list;
  std::map<std::uint32_t, Watched_node> kept;
  double path = 0;
  std::uint32_t node = 0;
  std::size_t most = 0;
  std::uint64_t opened = 0, confirmed = 0, holding = 0, away = 0, unclear = 0;
  const auto small = [&] { return static_cast<double>(between(random, -6, 6)); };
  const auto set = [&](std::uint32_t i, Watched_node& w) {
    w.until =
        path + static_cast<double>(between(random, 0, 8)) * std::ldexp(1.0, static_cast<int>(between(random, -4, 2)));
    w.on = random() % 2 == 0;
    w.at_cut = random() % 3 > 0;
    list.set(w.place, i, Tester::Row{w.row[0], w.row[1], w.row[2], w.row[3]}, w.on, w.until, w.at_cut);
  };
  for (int move = 0; move < 3000; ++move) {
    // More at first than later: places are given up, and taken again.
    for (std::int64_t n = between(random, 0, move < 1500 ? 12 : 4); n > 0; --n, ++node) {
      Watched_node& w = kept[node];
      w.place = list.take();
      w.row = {small(), small(), small(), small()};
      set(node, w);
    }
    for (std::int64_t n = between(random, 0, 2); n > 0 && !kept.empty(); --n) {
      const auto w = std::next(kept.begin(), static_cast<std::ptrdiff_t>(random() % kept.size()));
      ASSERT_EQ(list.remove(w->second.place), w->second.until);
      kept.erase(w);
    }
    if (move % 100 == 50) {
      list.forget_all();
      for (auto& [i, w] : kept) w.until = -1;
    }
    path += static_cast<double>(between(random, 0, 4)) / 4;
    Tester::Eye eye{};
    eye.x = small();
    eye.y = small();
    eye.z = small();
    eye.w = move % 5 > 0;
    eye.bound = static_cast<double>(between(random, 0, 3));
    std::vector<std::uint32_t> open, expected;
    const Watch_list::Confirmed result = list.test(eye, path, open);
    std::uint64_t tests = 0, tests_away = 0;
    for (auto& [i, w] : kept) {
      if (w.until >= path) {
        ++holding;
        continue;
      }
      const double height = w.row[0] * eye.x + w.row[1] * eye.y + w.row[2] * eye.z + w.row[3] * eye.w;
      if (w.on ? height > eye.bound : height < -eye.bound) {
        ++tests;
        tests_away += !w.at_cut;
        w.until = std::max(path, (path + (std::fabs(height) - eye.bound)) * (1 - 0x1p-52));
      } else {
        expected.push_back(i);
        unclear += std::fabs(height) <= eye.bound;
      }
    }
    ASSERT_EQ(sorted(open), expected) << move;
    ASSERT_EQ(result.nodes, tests);
    ASSERT_EQ(result.away, tests_away);
    most = std::max(most, kept.size());
    opened += open.size();
    confirmed += tests;
    away += tests_away;
    for (const std::uint32_t i : open) {
      Watched_node& w = kept.at(i);
      if (random() % 8 == 0) {
        list.remove(w.place);
        kept.erase(i);
      } else if (random() % 2 == 0) set(i, w);
      else {
        w.until = path;
        list.set_until(w.place, path);
      }
    }
    if (!kept.empty()) {
      kept.begin()->second.at_cut ^= true;
      list.set_at_cut(kept.begin()->second.place, kept.begin()->second.at_cut);
    }
  }
  EXPECT_GT(most, 600u) << "more than a group of blocks";
  EXPECT_LT(kept.size(), most / 2);
  for (const std::uint64_t count : {opened, confirmed, holding, away, unclear}) EXPECT_GT(count, 1000u);
}

TEST(Watch_list, leaves_open_what_overflows) {
  Watch_list list;
  const On_view<Exact_traits>::Row row{1, -1, 0, 0};
  list.set(list.take(), 7, row, true, 0, true);
  On_view<Exact_traits>::Eye eye{};
  std::vector<std::uint32_t> open;
  eye.x = eye.y = eye.bound = std::numeric_limits<double>::infinity();
  eye.w = 1;  // a height that is no number
  list.test(eye, 1, open);
  EXPECT_EQ(open, std::vector<std::uint32_t>{7});
}

TEST(Tracker, notices_moves_below_the_last_bit_of_doubles) {
  const Stage stage(box({-1, -2, -3}, {1, 2, 3}).soup());
  Cut_set_tracker tracker(stage.traits, stage.graph);
  const Rational tiny = exact_decimal(1, -40);
  for (const Rational& x :
       {Rational(1), Rational(1 + tiny), Rational(1), Rational(1 - tiny), Rational(1 + tiny), Rational(1 - tiny)})
    for (const bool at_infinity : {false, true}) {
      const Viewpoint view{{at_infinity ? Rational(x - 1) : x, 1, 0}, at_infinity};
      tracker.move_to({{x, 0, 0}, false});
      tracker.move_to(view);
      ASSERT_TRUE(agrees(tracker, stage.graph, on_view(stage.graph, view)));
    }
  for (const Rational& x :
       {Rational(1), Rational(1 + tiny), Rational(1), Rational(1 - tiny), Rational(1 + tiny), Rational(1 - tiny)}) {
    const Viewpoint view{{x, 0, 0}, false};
    tracker.move_to(view);
    ASSERT_TRUE(agrees(tracker, stage.graph, on_view(stage.graph, view)));
  }
}

TEST(Tracker, notices_steps_whose_squares_underflow) {
  Polygon_soup soup = box({-3, -3, -3}, {3, 3, 3}).soup();  // keeps the origin in the middle
  soup.add_point(Rational(0), Rational(-1), Rational(-1));
  soup.add_point(Rational(0), Rational(1), Rational(-1));
  soup.add_point(Rational(0), Rational(0), Rational(1));
  soup.add_face(std::vector<Point_id>{8, 9, 10});  // x = 0
  const Stage stage(soup);
  Cut_set_tracker tracker(stage.traits, stage.graph);
  for (const double x : {0.0, 0x1p-600, -0x1p-600, 0x1p-600, 0.0, -0x1p-600}) {
    const Viewpoint view{{exact(x), 0, 0}, false};
    tracker.move_to(view);
    ASSERT_TRUE(agrees(tracker, stage.graph, on_view(stage.graph, view))) << x;
  }
}

TEST(Tracker, holds_for_short_steps_after_a_long_way) {
  Random random(4);
  const Body body = box({-1, -2, -3}, {1, 2, 3});
  const Stage stage(body.soup());
  Cut_set_tracker tracker(stage.traits, stage.graph);
  for (const std::int64_t far :
       {std::int64_t{1} << 40, std::int64_t{1} << 52, std::int64_t{1} << 54, std::int64_t{1} << 58}) {
    tracker.move_to({{Rational(far), 1, 1}, false});
    for (int k = 0; k < 200; ++k) {
      const Lattice_eye eye{{between(random, -9, 9), between(random, -9, 9), between(random, -9, 9)}, 2};
      tracker.move_to(eye.view());
      ASSERT_TRUE(agrees(tracker, stage.graph, on_view(stage.graph, body, eye))) << far << ' ' << k;
    }
  }
}

TEST(Tracker, does_not_trust_a_height_beyond_its_error) {
  Random random(6);
  Body body{{{0, 0, 0}, {7, 1, 2}, {2, 9, 3}, {1, 2, 8}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  const Stage stage(body.soup());
  for (int k = 0; k < 400; ++k) {
    const std::size_t f = random() % 4;
    const Whole n = body.normal(f), p = body.points[body.faces[f][0]], u = minus(body.points[body.faces[f][1]], p),
                v = minus(body.points[body.faces[f][2]], p);
    // Far along the plane, and above it by a few normals; then onto it, straight.
    const std::int64_t s = between(random, -1'000'000'000'000, 1'000'000'000'000),
                       t = between(random, -1'000'000'000'000, 1'000'000'000'000), h = between(random, 1, 4);
    Lattice_eye above{{}, 1}, on{{}, 1};
    for (std::size_t a = 0; a < 3; ++a) {
      on.at[a] = p[a] + s * u[a] + t * v[a];
      above.at[a] = on.at[a] + h * n[a];
    }
    Cut_set_tracker tracker(stage.traits, stage.graph);
    for (const Lattice_eye& eye : {above, on, above}) {
      tracker.move_to(eye.view());
      ASSERT_TRUE(agrees(tracker, stage.graph, on_view(stage.graph, body, eye))) << k;
    }
  }
}

TEST(Tracker, directions_of_any_length_are_decided_in_doubles) {
  const Stage stage(box({-1, -2, -3}, {1, 2, 3}).soup());
  for (const int exponent : {-400, -30, 0, 30, 400}) {
    Cut_set_tracker tracker(stage.traits, stage.graph);
    const Rational length = exact_decimal(1, exponent);
    tracker.move_to({{length, 2 * length, -3 * length}, true});
    EXPECT_EQ(tracker.on_view_count(), 3u);
    EXPECT_EQ(tracker.last().exact, 0u) << exponent;
  }
}
TEST(Tracker, tests_no_node_twice_in_a_move) {
  Body open = box({-1, -2, -3}, {1, 2, 3});
  open.faces.pop_back();
  const Stage stage(open.soup());
  Cut_set_tracker tracker(stage.traits, stage.graph);
  tracker.move_to({{9, 2, 0}, false});  // in the plane of +y, in front of +x
  EXPECT_EQ(tracker.last().tests, 5u);
}

TEST(Tracker, holds_for_one_face_alone) {
  Polygon_soup soup;
  soup.add_point(Rational(0), Rational(0), Rational(0));
  soup.add_point(Rational(1), Rational(0), Rational(0));
  soup.add_point(Rational(0), Rational(1), Rational(0));
  soup.add_face(std::vector<Point_id>{0, 1, 2});
  const Stage stage(soup);
  Cut_set_tracker tracker(stage.traits, stage.graph);
  tracker.move_to({{1, 2, 3}, false});
  EXPECT_TRUE(tracker.on_view(0));
  tracker.move_to({{1, 2, 0}, true});
  EXPECT_FALSE(tracker.on_view(0));
}

/// A square barrel, bent by 2^-bits a ring, with its axis askew; a triangle 2^end away makes doubles coarse.
TEST(Tracker, walks_over_a_barrel_that_doubles_take_for_a_box) {
  for (const long bits : {30, 40, 48, 51, 52, 53, 56, 64})
    for (const int end : {0, 20, 40, 60}) {
      if (test_scenes::is_sanitized() && bits % 3 != end % 3) continue;  // one way in three
      const Rational e = 1 / Rational(Integer(1) << bits);
      Polygon_soup soup;
      const int rings = 9;
      const auto turned = [](const Exact_point& p) {
        return Exact_point{p[0] + 2 * p[1] + 2 * p[2], 2 * p[0] + p[1] - 2 * p[2], -2 * p[0] + 2 * p[1] - p[2]};
      };
      for (int ring = 0; ring < rings; ++ring) {
        const Rational half = 1 + e * (ring * (rings - 1 - ring));
        for (const auto& [x, y] : {std::pair(1, 1), std::pair(-1, 1), std::pair(-1, -1), std::pair(1, -1)}) {
          const Exact_point p = turned({half * x, half * y, Rational(ring - rings / 2)});
          soup.add_point(p[0], p[1], p[2]);
        }
      }
      // The turn keeps orientation: its determinant is 27.
      const auto id = [](int ring, int k) { return static_cast<Point_id>(4 * ring + k % 4); };
      soup.add_face(std::vector<Point_id>{3, 2, 1, 0});
      soup.add_face(std::vector<Point_id>{id(rings - 1, 0), id(rings - 1, 1), id(rings - 1, 2), id(rings - 1, 3)});
      for (int ring = 0; ring + 1 < rings; ++ring)
        for (int k = 0; k < 4; ++k)
          soup.add_face(std::vector<Point_id>{id(ring, k), id(ring, k + 1), id(ring + 1, k + 1), id(ring + 1, k)});
      if (end > 0) {
        const Point_id first = soup.point_count();
        const Rational far(Integer(1) << end);
        soup.add_point(far, far, far);
        soup.add_point(far, Rational(far + 1), far);
        soup.add_point(far, far, Rational(far + 1));
        soup.add_face(std::vector<Point_id>{first, first + 1, first + 2});
      }
      const Stage stage(soup);
      ASSERT_TRUE(stage.graph.is_convex(stage.graph.node(0))) << bits << ' ' << end;
      Cut_set_tracker tracker(stage.traits, stage.graph);
      const auto see = [&](const Exact_point& at, bool at_infinity) {
        const Viewpoint view{turned(at), at_infinity};
        tracker.move_to(view);
        ASSERT_TRUE(agrees(tracker, stage.graph, on_view(stage.graph, view))) << bits << ' ' << end << ' ' << at[2];
      };
      for (const long z : {20l, 30l, 40l, 50l, 60l})
        for (const int sense : {1, -1}) {
          const Rational height = sense * Rational(Integer(1) << z);
          see({0, 0, -height}, false);
          see({0, 0, Rational(sense * 5)}, false);
          see({0, 0, 0}, false);
          see({0, 0, Rational(-sense * 5)}, false);
          see({Rational(1, 3), Rational(1, 7), height}, false);
          see({0, 0, Rational(-sense)}, true);
          see({0, 0, Rational(sense)}, true);
        }
    }
}

TEST(Tracker, forgets_a_far_visit) {
  const Stage stage(generate::make("terrain", 2000, 1));
  const auto box = stage.scene.box();
  const auto tests_near_by = [&](bool visit) {
    Cut_set_tracker tracker(stage.traits, stage.graph);
    tracker.move_to({box[1], false});
    if (visit) {
      tracker.move_to({{exact_decimal(1, 18), 0, exact_decimal(1, 17)}, false});
      tracker.move_to({box[1], false});
    }
    const std::uint64_t before = tracker.counters().tests;
    Exact_point at = box[1];
    for (int k = 0; k < 50; ++k) {
      at[2] += Rational(1, 10000);
      tracker.move_to({at, false});
    }
    EXPECT_TRUE(agrees(tracker, stage.graph, on_view(stage.graph, {at, false})));
    return tracker.counters().tests - before;
  };
  EXPECT_LE(tests_near_by(true), 2 * tests_near_by(false));
}

}  // namespace
}  // namespace cutset_test
