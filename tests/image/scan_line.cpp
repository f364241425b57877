// Spans of rows against exact rays through pixel centres.

#include "same_images.h"

#include <sightline/algorithms/image/scan_line.h>

#include <gtest/gtest.h>

namespace {

using namespace sightline;
using view_scenes::Family;

class Scan_line : public testing::TestWithParam<Family> {};

TEST_P(Scan_line, exact_is_what_rays_meet) {
  const Image_counters counters = image_test::expect_exact_images(GetParam(), scan_line);
  EXPECT_GT(counters.spans, 300u);
}
TEST_P(Scan_line, rounded_numbers_make_an_image) { image_test::expect_images(GetParam(), scan_line); }
INSTANTIATE_TEST_SUITE_P(All, Scan_line, testing::ValuesIn(view_scenes::families),
                         [](const auto& family) { return view_scenes::name(family.param); });

TEST(Scan_line_kernels, are_one_on_dyadic_scenes) { image_test::expect_kernels_agree(scan_line); }
TEST(Scan_line_kernels, leave_out_what_is_not_finite) { image_test::expect_without_infinite(scan_line); }

}  // namespace
