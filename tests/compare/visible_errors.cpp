// How wrong a visible surface is: zero for exact ones, areas by hand for errors made on purpose, and laws of pixels.

#include "support.h"

#include "../soup.h"

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/kernels.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/harness/compare/visible_errors.h>
#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/scenes.h>
#include <sightline/harness/generate/shapes.h>
#include <sightline/harness/generate/soups.h>
#include <sightline/harness/generate/transform.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

using namespace compare_test;

namespace {

using Points = std::vector<Exact_point>;
constexpr double rounding = 1e-14;
constexpr double side_of_cube = 1.0 / 6;

const Exact_point origin{0, 0, 0};

/// In front of an eye at the origin, in the image towards +y: x to the right, z up; front to the eye.
Points rectangle(const Rational& x0, const Rational& x1, const Rational& z0, const Rational& z1,
                 const Rational& y = 1) {
  return {at(x0 * y, y, z0 * y), at(x1 * y, y, z0 * y), at(x1 * y, y, z1 * y), at(x0 * y, y, z1 * y)};
}
Points reversed(Points points) {
  std::reverse(points.begin(), points.end());
  return points;
}
Scene scene_of(const std::vector<Points>& faces) { return Scene(test_scenes::soup_of(faces)); }
/// The share of the sphere that a rectangle of the image covers, from the integral of the solid angle of [0, x] x [0,
/// y].
double share(double x0, double x1, double y0, double y1) {
  const auto corner = [](double x, double y) { return std::atan2(x * y, std::sqrt(1 + x * x + y * y)); };
  return (corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0)) / (4 * std::numbers::pi);
}

/// A scene, an eye, and all that is made of them.
struct Case {
  Scene scene;
  Exact_point eye;
  Piece_boxes boxes;
  Exact_view view;
  Visible_surface<Exact_view> surface;
  Visible_reference reference;

  Case(Scene s, const Exact_point& e)
      : scene(std::move(s)),
        eye(e),
        boxes(scene),
        view(scene, eye),
        surface(visible_surface(view, boxes, alone())),
        reference(view, surface) {}
  Case(const std::vector<Points>& faces) : Case(scene_of(faces), origin) {}
  Case(const Case&) = delete;

  static Visible_options alone() {
    Visible_options options;
    options.threads = 1;
    return options;
  }
  Visible_errors of(const Visible_surface<Exact_view>& answer) { return reference.errors(view, answer); }
  Visible_errors of_pixels(std::uint32_t size, int bits = 32, float near = 0, float far = 0) {
    return reference.errors(depth_buffer(scene, eye, {size, bits, near, far}));
  }
  template <class FT>
  Visible_errors of_numbers() {
    const Number_view<FT> numbers(scene, eye);
    return reference.errors(numbers, visible_surface(numbers, boxes, alone()));
  }
  /// Parts that show a piece, in the exact surface.
  std::vector<std::size_t> parts_of(std::uint32_t piece) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < surface.parts.size(); ++i)
      if (surface.parts[i].piece == piece) found.push_back(i);
    return found;
  }
};

void expect_none(const Visible_errors& e) {
  EXPECT_EQ(e.wrong, 0);
  EXPECT_EQ(e.tied, 0);
  EXPECT_EQ(e.wrongly_visible, 0u);
  EXPECT_EQ(e.wrongly_hidden, 0u);
  EXPECT_EQ(e.missing, 0u);
  EXPECT_EQ(e.largest_missing, 0);
  EXPECT_EQ(e.gaps, 0);
  EXPECT_EQ(e.overlaps, 0);
  EXPECT_EQ(e.not_finite, 0u);
}

struct Named {
  Polygon_soup soup;
  Exact_point eye;
};
std::vector<Named> scenes() {
  return {
      {generate::soup(40, 0.2, 1), at(ratio(1, 3), -2, ratio(1, 10))},
      {generate::soup(40, 0.2, 2), at(ratio(1, 3), ratio(1, 3), ratio(1, 3))},
      {generate::lattice(2), at(ratio(1, 7), ratio(-5, 2), 3)},
      {generate::crossing(7), at(3, -5, 2)},
      {generate::bars(5), at(1, -9, 4)},
      {generate::menger_sponge(1), at(ratio(1, 2), -3, ratio(1, 2))},
      {generate::city(6, 3, true), at(1, 1, 30)},
      {generate::translated(generate::soup(20, 0.5, 4), at(100000000, 1, -100000000)), at(100000001, 2, -100000003)},
      {generate::scaled(generate::bars(4), exact_decimal(1, -50)),
       at(exact_decimal(1, -50), exact_decimal(-9, -50), exact_decimal(4, -50))}};
}

// ---- Parts of a partition

TEST(Visible_errors, of_the_exact_answer_against_itself_are_zero) {
  for (Named& named : scenes()) {
    SCOPED_TRACE(named.soup.file);
    Case c(Scene(named.soup), named.eye);
    expect_none(c.of(c.surface));
  }
}

TEST(Visible_errors, of_other_exact_numbers_are_zero) {
  for (Named& named : scenes()) {
    SCOPED_TRACE(named.soup.file);
    Case c(Scene(named.soup), named.eye);
    expect_none(c.of_numbers<CGAL::Gmpq>());
    expect_none(c.of_numbers<CGAL::Exact_predicates_exact_constructions_kernel::FT>());
  }
}

TEST(Visible_errors, of_an_empty_scene_are_zero) {
  Case c(Scene(Polygon_soup()), origin);
  expect_none(c.of(c.surface));
  expect_none(c.of_pixels(4));
}

TEST(Visible_errors, of_doubles_are_below_those_of_floats_in_general_position) {
  double doubles = 0, floats = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    Case c(Scene(generate::soup(60, 0.2, seed)), at(ratio(1, 2), ratio(1, 3), ratio(2, 5)));
    const Visible_errors d = c.of_numbers<double>(), f = c.of_numbers<float>();
    doubles += d.wrong + d.gaps + d.overlaps;
    floats += f.wrong + f.gaps + f.overlaps;
    EXPECT_EQ(d.wrongly_visible + d.wrongly_hidden + d.missing + d.not_finite, 0u);
  }
  EXPECT_LT(doubles, 1e-11);
  EXPECT_GT(floats, 1e-9);
  EXPECT_LT(floats, 1e-2);
}

TEST(Visible_errors, of_doubles_are_seen_where_walls_stand_on_a_floor) {
  // The foot of a wall lies in the line where wall and floor cross: planes through the eye that are one, and that
  // doubles meet anywhere.
  Case c(Scene(generate::city(12, 3, true)), at(2, 3, 40));
  const Visible_errors d = c.of_numbers<double>();
  EXPECT_GT(d.wrong, 1e-7);
  EXPECT_LT(d.wrong, 1e-2);
}

TEST(Visible_errors, a_part_left_out_is_a_gap_and_wrong_where_something_is_seen) {
  Case c({rectangle(ratio(-1, 2), ratio(1, 2), ratio(-1, 2), ratio(1, 2))});
  auto answer = c.surface;
  std::erase_if(answer.parts, [](const auto& part) { return part.piece == 0; });
  const double square = share(-0.5, 0.5, -0.5, 0.5);
  Visible_errors e = c.of(answer);
  EXPECT_NEAR(e.gaps, square, rounding);
  EXPECT_NEAR(e.wrong, square, rounding);
  EXPECT_EQ(e.overlaps, 0);
  EXPECT_EQ(e.missing, 1u);
  EXPECT_NEAR(e.largest_missing, square, rounding);
  EXPECT_EQ(e.wrongly_hidden, 0u) << "its list of visible faces is right";

  answer = c.surface;
  std::erase_if(answer.parts, [&](const auto& part) { return part.piece == answer.nothing; });
  e = c.of(answer);
  EXPECT_NEAR(e.gaps, 1 - square, rounding);
  EXPECT_EQ(e.wrong, 0) << "nothing is to be seen there";
}

TEST(Visible_errors, a_part_given_twice_is_an_overlap) {
  Case c({rectangle(ratio(-1, 2), ratio(1, 2), ratio(-1, 2), ratio(1, 2))});
  auto answer = c.surface;
  for (const std::size_t i : c.parts_of(0)) answer.parts.push_back(answer.parts[i]);
  const Visible_errors e = c.of(answer);
  EXPECT_NEAR(e.overlaps, share(-0.5, 0.5, -0.5, 0.5), rounding);
  EXPECT_EQ(e.wrong, 0);
  EXPECT_EQ(e.gaps, 0);
}

TEST(Visible_errors, a_part_of_another_face_is_wrong_and_of_another_piece_of_its_face_is_not) {
  // An L, which is two pieces, and a square beside it.
  const Points l{at(ratio(-1, 2), 1, 0),
                 at(0, 1, 0),
                 at(0, 1, ratio(1, 4)),
                 at(ratio(-1, 4), 1, ratio(1, 4)),
                 at(ratio(-1, 4), 1, ratio(1, 2)),
                 at(ratio(-1, 2), 1, ratio(1, 2))};
  Case c({l, rectangle(ratio(1, 4), ratio(1, 2), 0, ratio(1, 2))});
  ASSERT_EQ(c.scene.pieces().size(), 3u);
  auto answer = c.surface;
  for (const std::size_t i : c.parts_of(0)) answer.parts[i].piece = 1;
  expect_none(c.of(answer));

  answer = c.surface;
  for (const std::size_t i : c.parts_of(2)) answer.parts[i].piece = 0;
  answer.visible = {0};
  const Visible_errors e = c.of(answer);
  EXPECT_NEAR(e.wrong, share(0.25, 0.5, 0, 0.5), rounding) << "in the plane of the L, but not on it";
  EXPECT_EQ(e.tied, 0);
  EXPECT_EQ(e.gaps, 0);
  EXPECT_EQ(e.wrongly_hidden, 1u);
  EXPECT_EQ(e.wrongly_visible, 0u);
  EXPECT_EQ(e.missing, 1u);
}

TEST(Visible_errors, faces_that_the_answer_lists_and_the_eye_does_not_see_are_counted) {
  Case c({rectangle(-1, 1, -1, 1), rectangle(-1, 1, -1, 1, 2), rectangle(-1, 1, -1, 1, 3)});
  auto answer = c.surface;
  answer.visible = {1, 2};
  const Visible_errors e = c.of(answer);
  EXPECT_EQ(e.wrongly_visible, 2u);
  EXPECT_EQ(e.wrongly_hidden, 1u);
  EXPECT_EQ(e.missing, 0u);
  EXPECT_EQ(e.wrong, 0);
}

// ---- Pixels

TEST(Pixel_errors, are_zero_where_a_face_covers_its_pixels) {
  Case c({rectangle(ratio(-1, 2), ratio(1, 2), ratio(-1, 4), 1, 3)});
  expect_none(c.of_pixels(8));
  expect_none(c.of_pixels(64, 16));
}

TEST(Pixel_errors, are_what_a_pixel_shows_beyond_a_face_that_covers_half_of_it) {
  for (const auto& [x0, x1] :
       {std::pair<Rational, Rational>(ratio(-1, 1), 0), {0, 1}}) {  // the centre goes with the left edge
    Case c({rectangle(x0, x1, -1, 1)});
    const Visible_errors e = c.of_pixels(1);
    EXPECT_NEAR(e.wrong, side_of_cube / 2, rounding);
    EXPECT_EQ(e.missing, x0 == 0 ? 0u : 1u);
  }
  Case c({rectangle(ratio(-1, 2), 1, -1, 1)});
  EXPECT_NEAR(c.of_pixels(1).wrong, share(-1, -0.5, -1, 1), rounding);
  // Of the pixel from (1/4, 1/4) to (1/2, 1/2), half of the triangle below the diagonal is another face's.
  Case diagonal({{at(ratio(1, 4), 1, ratio(1, 4)), at(ratio(1, 2), 1, ratio(1, 4)), at(ratio(1, 2), 1, ratio(1, 2))}});
  const Visible_errors e = diagonal.of_pixels(8);
  EXPECT_NEAR(e.wrong, share(0.25, 0.5, 0.25, 0.5) / 2, rounding) << "symmetric, whichever side the centre goes with";
}

TEST(Pixel_errors, a_sliver_between_centres_is_missing_with_its_area) {
  Case c({rectangle(ratio(1, 100), ratio(2, 100), -1, 1), rectangle(ratio(-3, 100), ratio(-1, 100), -1, 1)});
  const Visible_errors e = c.of_pixels(8);
  EXPECT_EQ(e.wrongly_hidden, 2u);
  EXPECT_EQ(e.missing, 2u);
  EXPECT_NEAR(e.largest_missing, share(-0.03, -0.01, -1, 1), rounding);
  EXPECT_NEAR(e.wrong, share(0.01, 0.02, -1, 1) + share(-0.03, -0.01, -1, 1), rounding);
  EXPECT_EQ(c.of_pixels(200).missing, 0u);
}

TEST(Pixel_errors, planes_that_bits_do_not_tell_apart_are_wrong_all_over) {
  Case c({rectangle(-1, 1, -1, 1, 1 + exact_decimal(1, -6)), rectangle(-1, 1, -1, 1)});
  const Visible_errors e = c.of_pixels(8, 16, 0.5, 2);
  EXPECT_NEAR(e.wrong, side_of_cube, rounding);
  EXPECT_EQ(e.tied, 0);
  EXPECT_EQ(e.wrongly_visible, 1u);
  EXPECT_EQ(e.wrongly_hidden, 1u);
  EXPECT_NEAR(e.largest_missing, side_of_cube, rounding);
  expect_none(c.of_pixels(8, 24, 0.5, 2));
}

TEST(Pixel_errors, another_face_in_the_same_place_is_tied_and_not_wrong) {
  // The exact surface shows the front of the second; the buffer what it drew first.
  Case c({reversed(rectangle(-1, 1, -1, 1)), rectangle(0, 1, -1, 1)});
  ASSERT_EQ(c.parts_of(1).size(), 2u);
  const Visible_errors e = c.of_pixels(8);
  EXPECT_EQ(e.wrong, 0);
  EXPECT_NEAR(e.tied, side_of_cube / 2, rounding);
  EXPECT_EQ(e.wrongly_hidden, 1u);
  EXPECT_EQ(e.missing, 1u);
}

TEST(Pixel_errors, what_is_nearer_than_the_near_plane_is_wrong) {
  Case c({rectangle(ratio(-1, 2), ratio(1, 2), ratio(-1, 2), ratio(1, 2))});
  EXPECT_NEAR(c.of_pixels(8, 24, 2, 4).wrong, share(-0.5, 0.5, -0.5, 0.5), rounding);
}

TEST(Pixel_errors, fall_about_as_one_over_the_size) {
  std::vector<double> wrong(5, 0.0);
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    Case c(Scene(generate::soup(60, 0.2, seed)), at(ratio(1, 2), ratio(1, 3), ratio(2, 5)));
    for (std::size_t k = 0; k < wrong.size(); ++k) wrong[k] += c.of_pixels(16u << k).wrong;
  }
  for (std::size_t k = 1; k < wrong.size(); ++k) {
    EXPECT_GT(wrong[k - 1] / wrong[k], 1.6) << (16u << k);
    EXPECT_LT(wrong[k - 1] / wrong[k], 2.5) << (16u << k);
  }
}

TEST(Pixel_errors, are_the_areas_of_rectangles_in_pixels) {
  Case c({rectangle(ratio(-1, 3), ratio(1, 2), ratio(-1, 5), ratio(2, 3)), rectangle(-1, 1, -1, 1, 2)});
  const Depth_buffer buffer = depth_buffer(c.scene, c.eye, {3, 32, 0, 0});
  double wrong = 0;
  for (std::uint32_t y = 0; y < 3; ++y)
    for (std::uint32_t x = 0; x < 3; ++x) {
      // Pixel [u, u + 2/3] x [v, v + 2/3] and the rectangle.
      const double u = 2.0 * x / 3 - 1, v = 2.0 * y / 3 - 1;
      const double l = std::max(u, -1.0 / 3), r = std::min(u + 2.0 / 3, 0.5), b = std::max(v, -0.2),
                   t = std::min(v + 2.0 / 3, 2.0 / 3);
      const double in = l < r && b < t ? share(l, r, b, t) : 0;
      wrong += buffer.piece(2, x, y) == 0 ? share(u, u + 2.0 / 3, v, v + 2.0 / 3) - in : in;
    }
  EXPECT_NEAR(c.reference.errors(buffer).wrong, wrong, rounding);
  EXPECT_GT(wrong, 0.01);
}

}  // namespace
