// The plain depth buffer: which pixels a face gets, by hand; and what it is known to get wrong.

#include "../soup.h"

#include <gtest/gtest.h>

#include <sightline/algorithms/baseline/depth_buffer.h>
#include <sightline/harness/generate/random.h>

using namespace sightline;

namespace {

using Points = std::vector<Exact_point>;

Exact_point at(double x, double y, double z) { return {exact(x), exact(y), exact(z)}; }
const Exact_point origin{0, 0, 0};

Scene scene_of(const std::vector<Points>& faces) { return Scene(test_scenes::soup_of(faces)); }
/// A rectangle in an image at a distance: u to the right, v up.
Points rectangle(std::size_t side, double u0, double u1, double v0, double v1, double distance = 1) {
  Points points;
  for (const auto& [u, v] : {std::pair(u0, v0), {u1, v0}, {u1, v1}, {u0, v1}}) {
    const std::array<double, 3> turned{u * distance, v * distance, distance};
    std::array<double, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) p[cube_sides[side].axis[k]] = cube_sides[side].sense[k] * turned[k];
    points.push_back(at(p[0], p[1], p[2]));
  }
  return points;
}
Depth_buffer look(const Scene& scene, std::uint32_t size, int bits = 24, float near = 0, float far = 0) {
  return depth_buffer(scene, origin, {size, bits, near, far});
}
std::size_t count(const Depth_buffer& buffer, std::uint32_t piece) {
  return static_cast<std::size_t>(std::count(buffer.pieces.begin(), buffer.pieces.end(), piece));
}

TEST(Cube_sides, are_photographs_that_cover_the_sphere) {
  for (const Cube_side& side : cube_sides) {
    std::array<std::array<int, 3>, 3> axes{};  // right, up, forward
    for (std::size_t k = 0; k < 3; ++k) axes[k][side.axis[k]] = side.sense[k];
    const auto &r = axes[0], &u = axes[1], &f = axes[2];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      EXPECT_EQ(r[i] * u[j] - r[j] * u[i], -f[k]);
    }
    EXPECT_EQ(side.turned(std::array<int, 3>{f}), (std::array<int, 3>{0, 0, 1}));
    EXPECT_EQ(side.turned(std::array<int, 3>{r}), (std::array<int, 3>{1, 0, 0}));
  }
}

TEST(Depth_buffer, gives_a_square_straight_ahead_the_pixels_that_it_covers) {
  for (std::size_t side = 0; side < 6; ++side) {
    const Depth_buffer buffer = look(scene_of({rectangle(side, -0.5, 0.5, -0.5, 0.5)}), 8);
    EXPECT_EQ(count(buffer, 0), 16u);
    for (std::uint32_t y = 2; y < 6; ++y)
      for (std::uint32_t x = 2; x < 6; ++x) EXPECT_EQ(buffer.piece(side, x, y), 0u);
  }
}

TEST(Depth_buffer, has_x_to_the_right_and_y_up) {
  for (std::size_t side = 0; side < 6; ++side) {
    const Depth_buffer buffer = look(scene_of({rectangle(side, 0.25, 1, 0.75, 1, 3)}), 8);
    EXPECT_EQ(count(buffer, 0), 3u);
    for (const std::uint32_t x : {5, 6, 7}) EXPECT_EQ(buffer.piece(side, x, 7), 0u);
  }
}

TEST(Depth_buffer, shows_both_sides_of_a_face_and_what_is_behind_the_eye_in_the_image_behind) {
  Points square = rectangle(1, -1, 1, -1, 1);
  for (int way = 0; way < 2; ++way) {
    const Depth_buffer buffer = look(scene_of({square}), 4);
    EXPECT_EQ(count(buffer, 0), 16u);
    EXPECT_EQ(buffer.piece(1, 0, 0), 0u);
    std::reverse(square.begin(), square.end());
  }
}

TEST(Depth_buffer, shows_the_nearer_one_in_either_order) {
  const Points near = rectangle(2, -0.5, 0.5, -0.5, 0.5, 2), far = rectangle(2, -1, 1, -1, 1, 3);
  for (const int bits : {16, 24, 32}) {
    EXPECT_EQ(count(look(scene_of({near, far}), 8, bits), 0), 16u);
    EXPECT_EQ(count(look(scene_of({far, near}), 8, bits), 0), 48u);
    EXPECT_EQ(count(look(scene_of({far, near}), 8, bits), 1), 16u);
  }
}

TEST(Depth_buffer, interpolates_depth_in_perspective) {
  // A face from (4, -4) to (1, 1), seen from (0, 0), is at distance 1.6 straight ahead; in the middle of the corners'
  // depths it would be farther or nearer.
  const Points slanted{at(4, 4, -1), at(1, -1, -1), at(1, -1, 1), at(4, 4, 1)};
  EXPECT_EQ(look(scene_of({slanted, rectangle(0, -0.1, 0.1, -0.1, 0.1, 1.625)}), 64).piece(0, 32, 32), 0u);
  EXPECT_EQ(look(scene_of({slanted, rectangle(0, -0.1, 0.1, -0.1, 0.1, 1.5)}), 64).piece(0, 32, 32), 1u);
}

TEST(Depth_buffer, interpolates_depth_of_faces_that_go_through_the_far_plane) {
  const Points slanted{at(4, 4, -1), at(1, -1, -1), at(1, -1, 1), at(4, 4, 1)};
  const Scene scene = scene_of({slanted, rectangle(0, -0.1, 0.1, -0.1, 0.1, 1.55)});
  EXPECT_EQ(look(scene, 64, 24, 0.5, 3).piece(0, 32, 32), 1u) << "the face is at distance 1.6 there";
}

TEST(Depth_buffer, cannot_tell_planes_apart_that_its_bits_do_not) {
  // At distance 1 between planes at 1/2 and 2, 10^-6 is 7 x 10^-7 of the depths: 0.04 steps of 16 bits, 11 of 24.
  const Scene scene = scene_of({rectangle(0, -0.5, 0.5, -0.5, 0.5, 1 + 1e-6), rectangle(0, -0.5, 0.5, -0.5, 0.5, 1)});
  EXPECT_EQ(count(look(scene, 8, 16, 0.5, 2), 0), 16u) << "the one drawn first";
  EXPECT_EQ(count(look(scene, 8, 24, 0.5, 2), 1), 16u);
  EXPECT_EQ(count(look(scene, 8, 32, 0.5, 2), 1), 16u);
  // 10^-9 is no difference to a float.
  EXPECT_EQ(count(look(scene_of({rectangle(0, -0.5, 0.5, -0.5, 0.5, 1 + 1e-9), rectangle(0, -0.5, 0.5, -0.5, 0.5, 1)}),
                       8, 32, 0.5, 2),
                  0),
            16u);
}

TEST(Depth_buffer, loses_a_sliver_between_pixel_centres) {
  EXPECT_EQ(count(look(scene_of({rectangle(0, 0.01, 0.02, -1, 1)}), 8), 0), 0u);
  EXPECT_EQ(count(look(scene_of({rectangle(0, 0.12, 0.13, -1, 1)}), 8), 0), 8u)
      << "and makes one wide that holds centres";
}

TEST(Depth_buffer, draws_a_centre_on_an_edge_with_the_left_and_top_ones) {
  EXPECT_EQ(count(look(scene_of({rectangle(0, -1, 0, -1, 1)}), 1), 0), 0u);
  EXPECT_EQ(count(look(scene_of({rectangle(0, 0, 1, -1, 1)}), 1), 0), 1u);
  EXPECT_EQ(count(look(scene_of({rectangle(0, -1, 1, -1, 0)}), 1), 0), 1u);
  EXPECT_EQ(count(look(scene_of({rectangle(0, -1, 1, 0, 1)}), 1), 0), 0u);
}

TEST(Depth_buffer, gives_each_pixel_of_a_square_to_one_of_the_triangles_that_it_is_cut_into) {
  generate::Random random(7);
  for (int round = 0; round < 50; ++round) {
    const Points square = rectangle(3, -0.75, 0.75, -0.5, 1);
    const auto number = [&] { return static_cast<double>(random.between(-8, 8)) / 16; };
    const double u = number(), v = number();
    const Exact_point middle = rectangle(3, u, u, v, v)[0];
    std::size_t sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Scene triangle = scene_of({{square[k], square[(k + 1) % 4], middle}});
      sum += count(look(triangle, 32), 0);
    }
    EXPECT_EQ(sum, 24u * 24u) << u << ' ' << v;
  }
}

TEST(Depth_buffer, cuts_triangles_that_reach_behind_the_eye) {
  // A floor in all directions, far beyond the guard band: all that is below the horizon.
  const Scene floor = scene_of({{at(-1e6, -1e6, -1), at(3e6, -1e6, -1), at(-1e6, 3e6, -1)}});
  const Depth_buffer buffer = look(floor, 16, 32, 0.5);
  for (std::uint32_t y = 0; y < 16; ++y)
    for (std::uint32_t x = 0; x < 16; ++x) {
      for (std::size_t side = 0; side < 4; ++side)
        EXPECT_EQ(buffer.piece(side, x, y), y < 8 ? 0u : buffer.nothing) << side << ' ' << x << ' ' << y;
      EXPECT_EQ(buffer.piece(4, x, y), buffer.nothing);
      EXPECT_EQ(buffer.piece(5, x, y), 0u);
    }
  EXPECT_EQ(buffer.clipped, 4u);
  const Depth_buffer usual = look(floor, 16);
  EXPECT_EQ(usual.near, usual.far / 4096) << "beyond the floor below";
  EXPECT_EQ(count(usual, 0), 0u);
}

TEST(Depth_buffer, loses_what_is_nearer_than_the_near_plane) {
  const Scene scene = scene_of({rectangle(0, -0.5, 0.5, -0.5, 0.5)});
  EXPECT_EQ(count(look(scene, 4, 24, 0.875), 0), 4u);
  const Depth_buffer lost = look(scene, 4, 24, 1.25, 2);
  EXPECT_EQ(count(lost, 0), 0u);
  EXPECT_EQ(lost.clipped, 1u);
}

TEST(Depth_buffer, has_a_near_plane_in_front_of_a_scene_that_the_eye_is_outside_of) {
  const Depth_buffer buffer = look(scene_of({rectangle(0, -1, 1, -1, 1, 8), rectangle(0, -1, 1, -1, 1, 16)}), 4);
  EXPECT_FLOAT_EQ(buffer.near, 7.5f);
  EXPECT_FLOAT_EQ(buffer.far, 17);
  EXPECT_EQ(count(buffer, 0), 16u);
}

TEST(Depth_buffer, of_faces_edge_on_and_of_nothing_is_empty) {
  EXPECT_EQ(count(look(scene_of({{at(1, 0, -1), at(2, 0, -1), at(2, 0, 1)}}), 16), 0), 0u);
  const Depth_buffer empty = look(Scene(Polygon_soup()), 2);
  EXPECT_EQ(empty.pieces, std::vector<std::uint32_t>(24, empty.nothing));
}

TEST(Depth_buffer, counts_what_floats_do_not_hold) {
  for (const double size : {1e300, 1e39, 1e-300}) {
    const Depth_buffer buffer = look(scene_of({rectangle(0, -1, 1, -1, 1, size)}), 2);
    EXPECT_EQ(buffer.not_finite, 1u) << size;
    EXPECT_EQ(count(buffer, 0), 0u);
  }
}

TEST(Depth_buffer, refuses_sizes_bits_and_planes_that_make_no_sense) {
  const Scene scene = scene_of({rectangle(0, -1, 1, -1, 1)});
  EXPECT_THROW(look(scene, 0), std::invalid_argument);
  EXPECT_THROW(look(scene, 16385), std::invalid_argument);
  EXPECT_THROW(look(scene, 4, 0), std::invalid_argument);
  EXPECT_THROW(look(scene, 4, 33), std::invalid_argument);
  EXPECT_THROW(look(scene, 4, 24, -1), std::invalid_argument);
  EXPECT_THROW(look(scene, 4, 24, 3, 2), std::invalid_argument);
  // Directions in one plane, and such as span more than doubles hold.
  Pixel_view pixels{origin, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, 4, 4};
  EXPECT_NO_THROW(depth_image(scene, pixels));
  pixels.right = pixels.up;
  EXPECT_THROW(depth_image(scene, pixels), std::invalid_argument);
  EXPECT_THROW(depth_image(scene, {origin, {0, 0, 0x1p400}, {0x1p400, 0, 0}, {0, 0x1p400, 0}, 4, 4}),
               std::invalid_argument);
}

}  // namespace
