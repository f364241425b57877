// The front door: answers agree with what stands behind it, with definitions, and with arithmetic done by hand.

#include "models.h"

#include <sightline/harness/generate/families.h>
#include <sightline/sightline.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

using namespace sightline;

TEST(Model, knows_its_faces_areas_and_what_it_left_out) {
  const Model model = lamp_and_lid();
  EXPECT_EQ(model.face_count(), 4u);
  EXPECT_EQ(model.parts().size(), 3u);
  ASSERT_EQ(model.left_out().size(), 1u);
  EXPECT_EQ(model.left_out()[0].face, 3u);
  EXPECT_EQ(model.left_out()[0].why, "zero area");
  EXPECT_DOUBLE_EQ(model.area(0), 64);
  EXPECT_DOUBLE_EQ(model.area(1), 4);
  EXPECT_EQ(model.area(3), 0);
  EXPECT_THROW(model.area(4), std::out_of_range);
}

template <class Of>
concept gives_parts = requires(Of&& of) {
  std::forward<Of>(of).parts();
};
template <class Of>
concept gives_left_out = requires(Of&& of) {
  std::forward<Of>(of).left_out();
};
template <class Of>
concept gives_its_soup = requires(Of&& of) {
  std::forward<Of>(of).soup();
};
template <class Of>
concept gives_its_scene = requires(Of&& of) {
  std::forward<Of>(of).scene();
};

TEST(Model, refers_to_nothing_of_a_temporary) {
  // for (const Part& part : Model::read(file).parts()) would go through parts that are gone.
  static_assert(gives_parts<const Model&> && gives_parts<Model&> && !gives_parts<Model> && !gives_parts<const Model>);
  static_assert(gives_left_out<const Model&> && !gives_left_out<Model> && !gives_left_out<const Model>);
  static_assert(gives_its_soup<const Model&> && !gives_its_soup<Model> && !gives_its_soup<const Model>);
  static_assert(gives_its_scene<const Model&> && !gives_its_scene<Model> && !gives_its_scene<const Model>);
  const auto inside = cube().inside();  // and keeps this
  EXPECT_EQ(Model(inside).face_count(), 6u);
}

TEST(Model, says_what_it_is_made_of) {
  const Facts open = lamp_and_lid().facts();
  EXPECT_EQ(open.points_read, 12u);
  EXPECT_EQ(open.points, 12u);
  EXPECT_EQ(open.faces_read, 4u);
  EXPECT_EQ(open.faces, 3u);
  EXPECT_EQ(open.parts, 3u);
  EXPECT_EQ(open.planes, 3u);
  EXPECT_EQ(open.concave + open.non_planar + open.with_holes, 0u);
  EXPECT_FALSE(open.closed);
  ASSERT_TRUE(open.box);
  EXPECT_EQ((*open.box)[0], (Exact_point{-4, -4, 0}));
  EXPECT_EQ((*open.box)[1], (Exact_point{4, 4, 3}));
  const Facts closed = cube().facts();
  EXPECT_TRUE(closed.closed);
  EXPECT_EQ(closed.planes, 6u);
  EXPECT_FALSE(closed.arithmetic.empty());
  EXPECT_FALSE(Model(Polygon_soup()).facts().box);
}

TEST(Model, refuses_what_is_no_scene) {
  const Points points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<std::array<std::uint32_t, 3>> bad{{0, 1, 3}};
  EXPECT_THROW(Model::of_triangles(points, bad), std::out_of_range);
  const Points infinite{{0, 0, 0}, {1, 0, std::nan("")}, {0, 1, 0}};
  const std::vector<std::array<std::uint32_t, 3>> good{{0, 1, 2}};
  EXPECT_THROW(Model::of_triangles(infinite, good), std::domain_error);
  const std::vector<std::uint32_t> corners{0, 1, 2};
  EXPECT_THROW(Model::of_polygons(points, corners, std::vector<std::uint32_t>{4}), std::invalid_argument);
  EXPECT_THROW(Model::of_polygons(points, corners, std::vector<std::uint32_t>{2}), std::invalid_argument);
  EXPECT_THROW(Model::read("no such file.obj"), std::runtime_error);
}

TEST(Questions, refuse_a_coordinate_that_is_no_number) {
  const Model model = lamp_and_lid();
  Tracker tracker = track(model);
  for (const double x : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    EXPECT_THROW(see(model, {x, 1, 2}), std::domain_error);
    EXPECT_THROW(order(model, {1, x, 2}), std::domain_error);
    EXPECT_THROW(see_along(model, {0, 0, 10}, {0, 0, x}), std::domain_error);
    EXPECT_THROW(tracker.move_to({1, 2, static_cast<float>(x)}), std::domain_error);
    EXPECT_THROW(trace(model, std::vector<Exact_ray>{{{0, x, 0}, {0, 0, 1}}}), std::domain_error);
    EXPECT_THROW(weakly_visible(model, {{{0, 0, 0}, {1, x, 0}, {0, 1, 0}}}), std::domain_error);
  }
  try {
    see(model, {1, std::nan(""), 2});
    FAIL();
  } catch (const std::domain_error& error) {
    EXPECT_EQ(std::string(error.what()), "a point's y: nan is no coordinate; give the point finite ones");
  }
}

TEST(Model, reads_a_file) {
  const std::filesystem::path corpus = std::filesystem::path(SIGHTLINE_SOURCE_DIR) / "tests" / "corpus" / "general";
  const Model model = Model::read(corpus / "cube.off");
  EXPECT_EQ(model.face_count(), 6u);
  EXPECT_EQ(priority_graph(model).cyclic, 0u);
}

TEST(Order, is_accepted_and_puts_the_lid_before_the_floor) {
  const Model model = lamp_and_lid();
  const Visibility_order found = order(model, {0, 0, 10});
  ASSERT_EQ(found.parts.size(), 3u);
  EXPECT_EQ(found.parts[0].face, 0u);
  EXPECT_EQ(found.parts[1].face, 1u);
  EXPECT_EQ(found.parts[2].face, 2u);
  const std::string certificate = found.certificate();
  EXPECT_TRUE(verify(model, certificate).accepted);
  // The same claim about another eye, from below, is false.
  std::string forged = certificate;
  const std::size_t eye = forged.find("\"10\"");
  ASSERT_NE(eye, std::string::npos);
  forged.replace(eye, 4, "\"-10\"");
  EXPECT_FALSE(verify(model, forged).accepted);
  EXPECT_THROW(verify(model, "{}"), std::invalid_argument);
}

TEST(Priority, has_the_cycle_of_three_bars_in_one_component) {
  // Three plates, each of which hides the next one in part.
  Points points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const Points bars{{-3, 1, 0}, {3, 1, 1},  {3, 2, 1},  {1, -3, 1}, {1, 3, 0},
                    {2, 3, 0},  {3, -2, 0}, {-3, 3, 1}, {-2, 3, 1}};
  for (std::uint32_t k = 0; k < 3; ++k) triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
  const Model model = Model::of_triangles(bars, triangles);
  const Priority found = priority_graph(model);
  std::size_t parts = 0;
  for (const std::vector<std::uint32_t>& component : found.components) parts += component.size();
  EXPECT_EQ(parts, model.parts().size());
  EXPECT_TRUE(verify(model, found.certificate()).accepted);
  EXPECT_EQ(priority_graph(cube()).components.size(), 6u);
}

TEST(Tracker, agrees_with_the_definition_on_a_path_around_a_cube) {
  const Model model = cube();
  Tracker tracker = track(model);
  EXPECT_TRUE(tracker.on_view().empty());
  std::vector<Face_id> before;
  for (const Exact_point& p :
       std::vector<Exact_point>{{3, 0, 0}, {3, 2, 0}, {1, 0, 0}, {0, 0, 0}, {-3, -2, 5}, {2, 2, 2}}) {
    const std::vector<Face_id> changed = tracker.move_to(p);
    std::vector<Face_id> expected;
    for (Face_id face = 0; face < 6; ++face) {
      const Rational x = p[face / 2];
      if (face % 2 == 0 ? x < -1 : x > 1) expected.push_back(face);
    }
    EXPECT_EQ(tracker.on_view(), expected);
    std::vector<Face_id> difference;
    std::set_symmetric_difference(before.begin(), before.end(), expected.begin(), expected.end(),
                                  std::back_inserter(difference));
    EXPECT_EQ(changed, difference);
    before = expected;
  }
  try {
    tracker.on_view(6);
    FAIL();
  } catch (const std::out_of_range& error) {
    EXPECT_EQ(std::string(error.what()), "face 6 is not there: there are 6, counted from 0");
  }
}

TEST(See, from_inside_a_cube_turned_inwards_all_of_it_shares_out_the_sphere) {
  // The cube with its faces turned round, seen from its centre: each face is 4 pi / 6.
  const Points points{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                      {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  std::vector<std::uint32_t> corners{0, 4, 7, 3, 1, 2, 6, 5, 0, 1, 5, 4, 3, 7, 6, 2, 0, 3, 2, 1, 4, 5, 6, 7};
  std::reverse(corners.begin(), corners.end());
  const Model model = Model::of_polygons(points, corners, std::vector<std::uint32_t>(6, 4));
  const Seen seen = see(model, {0, 0, 0});
  EXPECT_EQ(seen.visible.size(), 6u);
  for (Face_id face = 0; face < 6; ++face) {
    EXPECT_NEAR(seen.solid_angle(face), 4 * std::numbers::pi / 6, 1e-13);
    EXPECT_NEAR(seen.area(face), 4, 1e-13);
  }
  EXPECT_TRUE(verify(model, seen.certificate()).accepted);
  // From off the centre they still share out the sphere.
  const Seen aside = see(model, {Rational(1, 3), Rational(-1, 2), Rational(999, 1000)});
  double sum = 0;
  for (Face_id face = 0; face < 6; ++face) sum += aside.solid_angle(face);
  EXPECT_NEAR(sum, 4 * std::numbers::pi, 1e-12);
}

/// [-1, 1]^2 at height 0, its corners times a power of two.
Part square_part(long power) {
  const Rational one = times_power(Rational(1), power);
  return {0, 0, {{-one, -one, 0}, {one, -one, 0}, {one, one, 0}, {-one, one, 0}}};
}

TEST(Part, is_as_large_as_it_is_and_looks_at_any_scale_and_distance) {
  for (const long power : {-1000L, -500L, 0L, 500L, 1000L}) {
    const Part square = square_part(power);
    if (std::labs(power) <= 500) EXPECT_EQ(square.area(), std::ldexp(4.0, 2 * static_cast<int>(power))) << power;
    // From height h above the middle it has 4 atan(1 / (h sqrt(2 + h^2))).
    for (const long height : {-2000L, -600L, -60L, -40L, -1L, 0L, 3L, 100L, 400L}) {
      const double h = std::ldexp(1.0, static_cast<int>(height)),
                   expected = 4 * std::atan2(1, height > 50 ? h * h : h * std::sqrt(2 + h * h));
      EXPECT_NEAR(square.solid_angle({0, 0, times_power(Rational(1), power + height)}) / expected, 1, 1e-13)
          << power << ' ' << height;
    }
    // As near above a place on the diagonal, which parts it into triangles; above an edge, a corner; and beside it.
    for (const long height : {-2000L, -600L, -60L}) {
      const auto from = [&](const Rational& x, const Rational& y) {
        return square.solid_angle(
            {times_power(x, power), times_power(y, power), times_power(Rational(1), power + height)});
      };
      EXPECT_NEAR(from(Rational(1, 2), Rational(1, 2)), 2 * std::numbers::pi, 1e-12);
      EXPECT_NEAR(from(1, Rational(1, 3)), std::numbers::pi, 1e-12);
      EXPECT_NEAR(from(1, 1), std::numbers::pi / 2, 1e-12);
      EXPECT_NEAR(from(2, 2), 0, 1e-12);
    }
    EXPECT_EQ(square.solid_angle({0, 0, 0}), 0) << "in its plane";
  }
}

TEST(See, what_is_hidden_has_no_area) {
  const Model model = lamp_and_lid();
  const Seen seen = see(model, {0, 0, 2});
  EXPECT_EQ(seen.visible, (std::vector<Face_id>{0, 1, 2}));
  // From (0, 0, 2) the lid hides the square [-2, 2]^2 of the floor.
  EXPECT_NEAR(seen.area(0), 64 - 16, 1e-12);
  EXPECT_NEAR(seen.area(1), 4, 1e-12);
  EXPECT_EQ(seen.area(3), 0) << "it was left out";
  EXPECT_THROW(seen.area(4), std::out_of_range);
  EXPECT_THROW(seen.solid_angle(4), std::out_of_range);
}

TEST(See, lists_all_faces_of_one_plane_that_are_seen_and_gives_the_part_to_one) {
  Polygon_soup soup;
  for (const auto& [x, y, z] : {std::array{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}) soup.add_point(x, y, z);
  soup.add_face({0, 2, 1});
  soup.add_face({0, 1, 2});
  const Seen seen = see(Model(soup), {0, 0, 1});
  EXPECT_EQ(seen.visible, std::vector<Face_id>{1});
  EXPECT_EQ(seen.from_behind, std::vector<Face_id>{0});
  for (const Seen::Visible_part& part : seen.parts) EXPECT_EQ(part.face, 1u);
  EXPECT_EQ(seen.area(0), 0);
  EXPECT_NEAR(seen.area(1), 0.5, 1e-14);
}

TEST(Weak, a_lamp_lights_lid_and_floor_and_both_answers_are_proved) {
  const Model model = lamp_and_lid();
  const Weak_visibility lit = weakly_visible(model, 2);
  EXPECT_EQ(lit.visible, (std::vector<Face_id>{0, 1}));
  EXPECT_EQ(lit.hidden, (std::vector<Face_id>{2}));
  EXPECT_TRUE(lit.undecided.empty());
  EXPECT_TRUE(verify(model, lit.certificate()).accepted);
  // From a small square on the lid's back nothing but the floor.
  const Rational e(1, 10);
  const std::vector<std::vector<Exact_point>> below{
      {{-e, e, Rational(9, 10)}, {e, e, Rational(9, 10)}, {e, -e, Rational(9, 10)}, {-e, -e, Rational(9, 10)}}};
  EXPECT_EQ(weakly_visible(model, below).visible, (std::vector<Face_id>{0}));
  EXPECT_THROW(weakly_visible(model, Face_id{3}), std::out_of_range);
  EXPECT_THROW(weakly_visible(model, {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}), std::invalid_argument);
}

TEST(Weak, counts_backs_where_both_sides_count_and_is_proved) {
  const Model model = lamp_and_lid();
  // From a square below the floor that looks up: the floor's back alone is to be seen.
  const std::vector<std::vector<Exact_point>> below{{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}}};
  EXPECT_TRUE(weakly_visible(model, below).visible.empty());
  Asking both;
  both.two_sided = true;
  const Weak_visibility seen = weakly_visible(model, below, both);
  EXPECT_EQ(seen.visible, (std::vector<Face_id>{0}));
  EXPECT_TRUE(verify(model, seen.certificate()).accepted);
}

TEST(Along, between_its_events_sees_what_see_sees_there_and_is_proved) {
  generate::Family_parameters parameters;
  parameters.seed = 3;
  parameters.size = 20;
  const Model model(generate::family("triangles_between_squares").make(parameters).soup);
  const Exact_point from{-5, -4, 3}, to{6, 5, 4};
  for (const bool two_sided : {false, true}) {
    Asking asking;
    asking.two_sided = two_sided;
    const auto seen_at = [&](const Rational& t) {
      Exact_point eye;
      for (std::size_t k = 0; k < 3; ++k) eye[k] = from[k] + t * (to[k] - from[k]);
      const Seen seen = see(model, eye);
      std::set<Face_id> faces(seen.visible.begin(), seen.visible.end());
      if (two_sided) faces.insert(seen.from_behind.begin(), seen.from_behind.end());
      return faces;
    };
    const Seen_along along = see_along(model, from, to, asking);
    std::set<Face_id> now(along.at_start.begin(), along.at_start.end()), ever;
    EXPECT_EQ(now, seen_at(0));
    Rational last = 0;
    std::size_t irrational = 0;
    for (const Seen_along::Event& event : along.events) {
      const auto [low, high] = event.t.bounds();
      irrational += low < high;
      EXPECT_NEAR(nearest_double(low), event.t.near(), 1e-15);
      EXPECT_NEAR(nearest_double(high), event.t.near(), 1e-15);
      EXPECT_EQ(now, seen_at((last + low) / 2));
      ever.insert(now.begin(), now.end());
      for (const Seen_along::Change& change : event.changes) {
        EXPECT_EQ(now.contains(change.face), change.before);
        if (change.after) now.insert(change.face);
        else now.erase(change.face);
        EXPECT_FALSE(change.kind.empty());
      }
      last = high;
    }
    ever.insert(now.begin(), now.end());
    EXPECT_GT(along.events.size(), 20u);
    EXPECT_GT(irrational, 0u);
    EXPECT_EQ(now, seen_at((last + 1) / 2));
    EXPECT_EQ((std::set<Face_id>(along.at_end.begin(), along.at_end.end())), seen_at(1));
    EXPECT_EQ(along.visible, std::vector<Face_id>(ever.begin(), ever.end()));
    EXPECT_TRUE(verify(model, along.certificate()).accepted);
  }
  EXPECT_THROW(see_along(model, from, from), std::invalid_argument);
}

TEST(Trace, meets_the_lid_before_the_floor_and_passes_over_what_it_leaves) {
  const Model model = lamp_and_lid();
  const std::vector<Exact_ray> rays{{{0, 0, 2}, {0, 0, -1}},
                                    {{0, 0, 3}, {0, 0, Rational(-1, 3)}},
                                    {{3, 3, 3}, {0, 0, -2}},
                                    {{9, 9, 3}, {0, 0, -1}},
                                    {{0, 0, -1}, {0, 0, 1}}};
  const auto first = trace(model, rays);
  ASSERT_EQ(first.size(), 5u);
  EXPECT_EQ(first[0], (std::vector<Face_hit>{{1, Met_side::front, 1, 1}}));
  EXPECT_EQ(first[1], (std::vector<Face_hit>{{1, Met_side::front, 6, 6}}));  // it leaves the lamp
  EXPECT_EQ(first[2], (std::vector<Face_hit>{{0, Met_side::front, Rational(3, 2), Rational(3, 2)}}));
  EXPECT_TRUE(first[3].empty());
  EXPECT_EQ(first[4], (std::vector<Face_hit>{{0, Met_side::back, 1, 1}}));
  const auto all = trace_all(model, rays);
  EXPECT_EQ(all[0], (std::vector<Face_hit>{{1, Met_side::front, 1, 1}, {0, Met_side::front, 2, 2}}));
  EXPECT_EQ(trace(model, rays, Ray_start::closed)[1][0].face, 2u);

  const std::vector<Double_ray> doubles{{{0, 0, 2}, {0, 0, -1}}, {{9, 9, 3}, {0, 0, -1}}};
  const auto found = nearest(model, doubles);
  EXPECT_EQ(found[0].face, 1u);
  EXPECT_FALSE(found[0].tied);
  EXPECT_LE(found[0].low, 1);
  EXPECT_GE(found[0].high, 1);
  EXPECT_NEAR(found[0].low, found[0].high, 1e-12);
  EXPECT_EQ(found[1].face, Nearest_face::nothing);
  EXPECT_THROW(trace(model, std::vector<Exact_ray>{{{0, 0, 0}, {0, 0, 0}}}), std::domain_error);
}

TEST(Combine, has_the_volumes_of_two_cubes_that_share_one) {
  const Model one = cube();
  Polygon_soup moved = one.soup();
  moved.coordinates = {};
  for (Point_id p = 0; p < one.soup().point_count(); ++p)
    for (const Rational& x : one.soup().point(p)) moved.coordinates.push(x + 1);
  const Model other(moved);
  for (const auto& [operation, volume] :
       {std::pair("union", 15), {"intersection", 1}, {"difference", 7}, {"symmetric-difference", 14}}) {
    const Combined found = combine(operation, {one, other});
    EXPECT_EQ(found.volume, volume) << operation;
    EXPECT_TRUE(found.model.facts().closed) << operation;
    ASSERT_EQ(found.faces.size(), found.model.face_count());
    for (const auto& [solid, face] : found.faces) EXPECT_TRUE(solid < 2 && face < 6);
    const Checked checked = verify({one, other}, found.model, found.certificate());
    EXPECT_TRUE(checked.accepted) << operation << ": " << checked.why;
    EXPECT_FALSE(verify({other, one}, one, found.certificate()).accepted) << operation;
  }
  EXPECT_THROW(combine("minus", {one, other}), std::invalid_argument);
  EXPECT_THROW(combine("union", {one, other}, "even"), std::invalid_argument);
  EXPECT_THROW(combine("union", {one, lamp_and_lid()}), std::invalid_argument);
}

TEST(Combine, results_are_made_ready_once_whatever_thread_asks_first) {
  const Combined found = combine("union", {cube(), cube()});
  const Combined copy = found;
  const auto [low, high] = found.area();
  EXPECT_TRUE(low <= 24 && 24 <= high && high - low < 1e-9) << low << ' ' << high;
  std::vector<const Scene*> scenes(8);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < scenes.size(); ++i)
    threads.emplace_back([&, i] { scenes[i] = &(i % 2 == 0 ? found : copy).model.scene(); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(scenes, std::vector<const Scene*>(scenes.size(), scenes[0]));
  EXPECT_EQ(found.model.facts().faces, 6u);
}

TEST(See, in_a_field_sees_what_is_within_it) {
  const Model model = lamp_and_lid();
  const std::vector<Exact_point> down{{-1, -1, -4}, {-1, 1, -4}, {1, 1, -4}, {1, -1, -4}};  // the lid covers it
  const Seen seen = see_in_field(model, {0, 0, 2}, down);
  EXPECT_EQ(seen.visible, std::vector<Face_id>{1});
  EXPECT_DOUBLE_EQ(seen.area(1), 0.25);
  EXPECT_TRUE(verify(model, seen.certificate()).accepted);
  EXPECT_THROW(see_in_field(model, {0, 0, 2}, {down[3], down[2], down[1], down[0]}), std::invalid_argument);
  EXPECT_THROW(see_in_field(model, {0, 0, 2}, {down[0], down[1]}), std::invalid_argument);
}

TEST(See, draws_lines_with_what_hides_them) {
  const Model model = lamp_and_lid();
  const std::vector<Seen::Line> lines = see(model, {0, 0, 2}).lines();
  ASSERT_EQ(lines.size(), 12u);
  std::size_t hidden = 0;
  for (const Seen::Line& line : lines) {
    EXPECT_EQ(line.kind, "boundary");
    EXPECT_EQ(line.faces.size(), 1u);
    EXPECT_EQ(line.stretches.front().from, 0);
    EXPECT_EQ(line.stretches.back().to, 1);
    for (const auto& stretch : line.stretches) hidden += stretch.hidden_by.has_value();
  }
  EXPECT_EQ(hidden, 0u);  // the lid's shadow ends within the floor
  const std::vector<Seen::Line> below = see(model, {0, 0, -1}).lines();
  ASSERT_EQ(below.size(), 12u);
  hidden = 0;
  for (const Seen::Line& line : below)
    for (const auto& stretch : line.stretches)
      if (stretch.hidden_by) {
        EXPECT_EQ(*stretch.hidden_by, 0u);
        ++hidden;
      }
  EXPECT_EQ(hidden, 8u);  // the floor hides lid and lamp
}

TEST(Weak_visibility, is_possible_at_least_where_it_is) {
  const Model model = lamp_and_lid();
  const Weak_visibility sure = weakly_visible(model, 2), quick = possibly_visible(model, sources_of(model, 2));
  EXPECT_TRUE(std::includes(quick.visible.begin(), quick.visible.end(), sure.visible.begin(), sure.visible.end()));
  EXPECT_EQ(quick.visible.size() + quick.hidden.size(), 3u);
  EXPECT_TRUE(verify(model, quick.certificate()).accepted);
  EXPECT_THROW(sources_of(model, 3), std::out_of_range);
}

TEST(Answers, are_the_same_at_any_number_of_threads_and_outlive_the_model) {
  Seen one, two;
  std::string order_certificate;
  {
    const Model model = lamp_and_lid();
    one = see(model, {0, 0, 2}, {1, {}});
    two = see(model, {0, 0, 2}, {4, {}});
    order_certificate = order(model, {1, 2, 3}, {3, {}}).certificate();
  }
  EXPECT_EQ(one.certificate(), two.certificate());
  EXPECT_EQ(order_certificate, order(lamp_and_lid(), {1, 2, 3}, {1, {}}).certificate());
}

}  // namespace
