// Sizes on screen: squares and slivers whose solid angles are known by hand, alone and behind a portal; cells of two
// rooms, and what shows that they see a face.

#include "support.h"

#include "../soup.h"

#include <sightline/algorithms/levels/pvs.h>
#include <sightline/harness/compare/cell_sights.h>
#include <sightline/kernel/scene/scene.h>

#include <numbers>

using namespace compare_test;

namespace {

using Face_corners = std::vector<Exact_point>;
const Exact_point zero_eye{0, 0, 0};

/// Across the y axis, front to an eye at a smaller y.
Face_corners across_y(const Rational& x0, const Rational& x1, const Rational& z0, const Rational& z1,
                      const Rational& y) {
  return {at(x0, y, z0), at(x1, y, z0), at(x1, y, z1), at(x0, y, z1)};
}
Face_corners turned_round(Face_corners corners) {
  std::reverse(corners.begin(), corners.end());
  return corners;
}
/// Solid angle of [0, x] x [0, z] at distance y, by its integral, in pixels.
double pixels_by_hand(double x, double z, double y) {
  return 512 * 512 * std::atan2(x * z, y * std::sqrt(x * x + y * y + z * z));
}

TEST(Screen_sizes, are_counted_from_each_bound_on) {
  Screen_sizes sizes;
  for (const double pixels : {0.0, 0.99, 1.0, 9.0, 10.0, 99.0, 100.0, 999.0, 1000.0, 1e6, 5e5}) sizes.add(pixels);
  EXPECT_EQ(sizes.counts, (std::array<std::size_t, 5>{2, 2, 2, 2, 3}));
  EXPECT_EQ(sizes.largest, 1e6);
  EXPECT_EQ(sizes.measured(), 11u);
}

TEST(Screen_sizes, of_the_side_of_a_cube_are_a_sixth_of_the_sphere_and_of_a_pixel_one) {
  const Rational half = ratio(1, 1024);
  const Model model(test_scenes::soup_of({across_y(-1, 1, -1, 1, 1), across_y(-half, half, -half, half, -1)}));
  const double sphere = 4 * std::numbers::pi / pixel_angle;
  EXPECT_NEAR(size_alone(model, zero_eye, 0), sphere / 6, 1e-6);
  EXPECT_EQ(size_alone(model, zero_eye, 1), 0) << "it turns its back";
  EXPECT_NEAR(size_alone(model, at(0, -2, 0), 1), 1, 2e-6);
  EXPECT_EQ(size_alone(model, at(7, 1, 7), 0), 0) << "the eye is in its plane";
}

TEST(Screen_sizes, of_what_is_seen_are_what_a_portal_leaves) {
  // A wall at y = 1 with a hole of 2/5 x 2/5 to the right and upwards of the axis; behind it a square that is larger.
  const Rational hole = ratio(2, 5);
  const Model model(
      test_scenes::soup_of({across_y(-9, 0, -9, 9, 1), across_y(hole, 9, -9, 9, 1), across_y(0, hole, -9, 0, 1),
                            across_y(0, hole, hole, 9, 1), across_y(-8, 8, -8, 8, 4),
                            turned_round(across_y(-8, 8, -8, 8, 6)), across_y(-1, 1, -1, 1, -2)}));
  const std::map<Face_id, Seen_face> seen = seen_faces(model, zero_eye);
  EXPECT_FALSE(seen.contains(5)) << "behind the square";
  EXPECT_FALSE(seen.contains(6)) << "seen from behind";
  ASSERT_TRUE(seen.contains(4));
  const Seen_face& square = seen.at(4);
  EXPECT_NEAR(square.pixels, pixels_by_hand(0.4, 0.4, 1), 1e-6);
  EXPECT_NEAR(size_alone(model, zero_eye, 4), 4 * pixels_by_hand(8, 8, 4), 1e-6);
  double all = 0;
  for (const auto& [face, of_face] : seen) all += of_face.pixels;
  EXPECT_NEAR(all, 4 * pixels_by_hand(9, 9, 1), 1e-5) << "the wall, and the square in its hole";
}

TEST(Screen_sizes, of_slivers_are_right_to_their_last_digits) {
  // 1 by 10^-12 at distance 1, and the middle and the width of what is seen of it.
  const Rational thin = ratio(1, 1'000'000'000'000);
  const Model model(test_scenes::soup_of({across_y(0, 1, 0, thin, 1)}));
  const Seen_face sliver = seen_faces(model, zero_eye).at(0);
  EXPECT_NEAR(sliver.pixels / (512 * 512 * 1e-12 * std::sqrt(0.5)), 1, 1e-9);
  EXPECT_NEAR(sliver.width / (1e-12 * std::sqrt(0.5) / (std::numbers::pi / 4)), 1, 1e-9);
  EXPECT_EQ(sliver.middle, at(ratio(1, 2), 1, thin / 2));
}

TEST(Screen_sizes, have_the_middle_of_the_largest_part) {
  // A post before a square leaves a third of it to the left and more to the right.
  const Model model(test_scenes::soup_of({across_y(-3, 3, -1, 1, 2), across_y(ratio(-1, 2), 0, -2, 2, 1)}));
  const Seen_face seen = seen_faces(model, zero_eye).at(0);
  EXPECT_GT(seen.middle[0], 0);
  EXPECT_NEAR(seen.pixels, 2 * pixels_by_hand(3, 1, 2) + 2 * (pixels_by_hand(3, 1, 2) - pixels_by_hand(1, 1, 2)), 1e-6);
}

/// Two rooms, 7 and 8 units long, 8 wide and high, about x = 0, and a hole of one unit in the wall between them, which
/// has no thickness. Faces 0 to 3 are the wall's front to the first room, 4 to 7 to the second, from 14 on the sides of
/// panels in that.
struct Two_rooms {
  Polygon_soup soup;
  Level_cells level;
  Occluders occluders;
  Model model;
  Cell_sights sights;

  explicit Two_rooms(const std::vector<Face_corners>& panels)
      : soup(made(panels)), level(soup), occluders(level.scene()), model(soup), sights(level, occluders, model) {}

  static Polygon_soup made(const std::vector<Face_corners>& panels) {
    std::vector<Face_corners> faces;
    const Rational l = ratio(-1, 2), h = ratio(1, 2);
    const auto wall = [](const Rational& y0, const Rational& y1, const Rational& z0, const Rational& z1) {
      return Face_corners{at(0, y0, z0), at(0, y0, z1), at(0, y1, z1), at(0, y1, z0)};
    };
    for (const Face_corners& part : {wall(-4, 4, -4, l), wall(-4, 4, h, 4), wall(-4, l, l, h), wall(h, 4, l, h)})
      faces.push_back(part);
    for (std::size_t k = 0; k < 4; ++k) faces.push_back(turned_round(faces[k]));
    const Exact_point a{-7, -4, -4}, b{8, 4, 4};
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const bool high : {false, true}) {
        Face_corners side;
        const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
        for (const auto& [far_i, far_j] : {std::pair(false, false), {true, false}, {true, true}, {false, true}}) {
          Exact_point p;
          p[axis] = high ? b[axis] : a[axis];
          p[i] = far_i ? b[i] : a[i];
          p[j] = far_j ? b[j] : a[j];
          side.push_back(p);
        }
        faces.push_back(high ? turned_round(side) : side);
      }
    for (const Face_corners& panel : panels) {
      faces.push_back(panel);
      faces.push_back(turned_round(panel));
    }
    return test_scenes::soup_of(faces);
  }
};
/// Behind the hole: from the middle of the first room it hides what it does not from nearer.
const std::vector<Face_corners> panel_across{{at(2, -1, -1), at(2, 1, -1), at(2, 1, 1), at(2, -1, 1)}};
/// In a plane with that middle, which sees it edge-on; and behind it a square, of which it sees all in one part, since
/// no axis is in the way.
const Rational near_axis = ratio(1, 20), off_axis = ratio(1, 5), past_axis = ratio(1, 2);
const std::vector<Face_corners> panel_along{
    {at(3, 0, 0), at(5, 0, 0), at(5, past_axis, past_axis), at(3, past_axis, past_axis)},
    {at(6, near_axis, near_axis), at(6, near_axis, off_axis), at(6, off_axis, off_axis), at(6, off_axis, near_axis)}};

struct Shown {
  std::size_t from_middle = 0, through_portals = 0, hidden = 0;
};
Shown expect_what_is_visible(const std::vector<Face_corners>& panels) {
  Two_rooms rooms(panels);
  const Pvs exact = potentially_visible(rooms.level);
  Shown shown;
  for (Cell_id cell = 0; cell < rooms.level.cells().size(); ++cell) {
    if (exact.is_asked[cell] == 0) continue;
    const std::vector<Face_id>& within = rooms.level.cells()[cell].faces;
    std::vector<Face_id> asked, expected, found;
    for (Face_id face = 0; face < rooms.soup.face_count(); ++face) {
      if (std::binary_search(within.begin(), within.end(), face)) continue;
      asked.push_back(face);
      const std::vector<Face_id>& visible = exact.visible[cell];
      if (std::binary_search(visible.begin(), visible.end(), face)) expected.push_back(face);
      else ++shown.hidden;
    }
    for (const Cell_sightline& line : rooms.sights.sightlines(cell, asked, {})) {
      found.push_back(line.face);
      EXPECT_EQ(rooms.level.at(line.from), cell);
      const bool is_middle = line.from == rooms.level.inside(cell);
      ++(is_middle ? shown.from_middle : shown.through_portals);
      // The segment meets the face first, from its front.
      Exact_ray way{line.from, {}};
      for (std::size_t k = 0; k < 3; ++k) way.direction[k] = line.to[k] - line.from[k];
      const std::vector<Face_hit> first = trace(rooms.model, std::span(&way, 1)).front();
      EXPECT_TRUE(std::any_of(
          first.begin(), first.end(),
          [&](const Face_hit& hit) { return hit.face == line.face && hit.side == Met_side::front && hit.t == 1; }))
          << "cell " << cell << ", face " << line.face;
      EXPECT_GT(rooms.sights.seen(line.from, line.face, {}).pixels, 0);
      // Twice as far back is another cell, unless it is the middle.
      if (!is_middle) {
        bool leaves = false;
        for (long times = 1; times < 4096 && !leaves; times *= 2) {
          Exact_point back;
          for (std::size_t k = 0; k < 3; ++k) back[k] = line.from[k] - way.direction[k] * times;
          leaves = rooms.level.at(back) != cell;
          EXPECT_TRUE(leaves) << "the eye is near the far side of its cell";
        }
      }
    }
    EXPECT_EQ(found, expected) << "cell " << cell;
  }
  return shown;
}

TEST(Cell_sights, show_each_pair_that_is_visible_and_no_other) {
  const Shown past = expect_what_is_visible(panel_across), along = expect_what_is_visible(panel_along);
  EXPECT_GT(past.from_middle, 0u);
  EXPECT_GT(past.through_portals, 0u);
  EXPECT_GT(past.hidden, 0u);
  EXPECT_GT(along.through_portals, 0u) << "the panel is edge-on, and in the way";
}

TEST(Cell_sights, of_what_a_cell_does_not_see_are_sizes_from_its_middle) {
  Two_rooms rooms(panel_across);
  const Cell_id cell = rooms.level.at({-4, 0, 0});
  const Exact_point eye = rooms.level.inside(cell);
  for (Face_id face = 0; face < rooms.soup.face_count(); ++face)
    EXPECT_EQ(rooms.sights.size_alone(cell, face), size_alone(rooms.model, eye, face));
  EXPECT_EQ(rooms.sights.seen(eye, 7, {}).pixels, 0) << "it looks into the other room";
}

TEST(Cell_sights, end_when_the_time_is_over) {
  Two_rooms rooms(panel_across);
  const Cell_id cell = rooms.level.at({-4, 0, 0});
  EXPECT_THROW(rooms.sights.sightlines(cell, {11}, [] { return true; }), Out_of_budget);
  EXPECT_THROW(rooms.sights.seen({1, 2, 3}, 11, [] { return true; }), Out_of_budget);
  EXPECT_NO_THROW(rooms.sights.seen({1, 2, 3}, 11, [] { return false; }));
}

}  // namespace
