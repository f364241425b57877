// Spans of rows against exact rays through pixel centres.

#include "same_images.h"

#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/scan_line.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace {

using namespace sightline;
using view_scenes::Family;

class Scan_line : public testing::TestWithParam<Family> {};

TEST_P(Scan_line, exact_is_what_rays_meet) {
  const Image_counters counters = image_test::expect_exact_images(GetParam(), scan_line);
  EXPECT_GT(counters.spans, test_scenes::least(300u));
}
TEST_P(Scan_line, rounded_numbers_make_an_image) { image_test::expect_images(GetParam(), scan_line); }
INSTANTIATE_TEST_SUITE_P(All, Scan_line, testing::ValuesIn(view_scenes::families),
                         [](const auto& family) { return view_scenes::name(family.param); });

TEST(Scan_line_kernels, are_one_on_dyadic_scenes) { image_test::expect_kernels_agree(scan_line); }
TEST(Scan_line_kernels, leave_out_what_is_not_finite) { image_test::expect_without_infinite(scan_line); }

const Pixel_view ahead{{0, 0, 0}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, 8, 8};

TEST(Scan_line_spans, of_one_face_are_shown_without_a_look_at_centres) {
  const Scene scene(view_scenes::soup_of({view_scenes::rectangle(-1, 1, -1, 1, -4)}));
  const Piece_image image = scan_line(scene, ahead, Image_kernel::exact, {.threads = 1});
  EXPECT_GT(std::count(image.pieces.begin(), image.pieces.end(), 0u), 0);
  EXPECT_EQ(image.counters.centres, 0u);
}

TEST(Scan_line_spans, of_faces_that_meet_at_a_centre_end_there) {
  // As near as each other in the third column, where the nearer face so far ends, too.
  const Pixel_view row{{0, 0, 0}, {0, 0, 1}, {4, 0, 0}, {0, 1, 0}, 4, 1};
  const Rational half(1, 2), sixteenth(1, 16);
  const Scene scene(view_scenes::soup_of({{{-16, -1, 5}, {2, -1, half}, {2, 1, half}, {-16, 1, 5}},
                                          {{-1, -1, sixteenth}, {4, -1, 1}, {4, 1, 1}, {-1, 1, sixteenth}}}));
  const Piece_image truth = centres(Exact_view(scene, row.eye), row);
  EXPECT_EQ(truth.pieces, (std::vector<std::uint32_t>{1, 1, 1, 0}));
  for (const Image_kernel kernel : {Image_kernel::float_numbers, Image_kernel::double_numbers, Image_kernel::exact})
    EXPECT_EQ(scan_line(scene, row, kernel, {.threads = 1}).pieces, truth.pieces);
}

TEST(Scan_line_spans, of_faces_that_cross_flatly_end_where_they_do) {
  // Two faces whose slopes are 2^-80 apart.
  const Rational hair = Rational(1) / Rational(Integer(1) << 80);
  Polygon_soup soup;
  for (const int sense : {-1, 1}) {
    std::vector<Point_id> loop;
    for (const auto& [x, y] : {std::pair{-8, -8}, {8, -8}, {8, 8}, {-8, 8}})
      loop.push_back(soup.add_point(x, y, Rational(Rational(x) / 16 + sense * x * hair - 4)));
    soup.add_face(loop);
  }
  const Scene scene(soup);
  const Piece_image truth = centres(Exact_view(scene, ahead.eye), ahead);
  for (const std::uint32_t piece : {0u, 1u}) EXPECT_EQ(std::count(truth.pieces.begin(), truth.pieces.end(), piece), 32);
  EXPECT_EQ(scan_line(scene, ahead, Image_kernel::exact, {.threads = 1}).pieces, truth.pieces);
}

}  // namespace
