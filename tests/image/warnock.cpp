// Windows cut into four against exact rays through pixel centres.

#include "same_images.h"

#include <sightline/algorithms/image/warnock.h>

#include <gtest/gtest.h>

namespace {

using namespace sightline;
using view_scenes::Family;

class Warnock : public testing::TestWithParam<Family> {};

TEST_P(Warnock, exact_is_what_rays_meet) {
  const Image_counters counters = image_test::expect_exact_images(GetParam(), warnock);
  EXPECT_GT(counters.windows, test_scenes::least(300u));
}
TEST_P(Warnock, rounded_numbers_make_an_image) { image_test::expect_images(GetParam(), warnock); }
INSTANTIATE_TEST_SUITE_P(All, Warnock, testing::ValuesIn(view_scenes::families),
                         [](const auto& family) { return view_scenes::name(family.param); });

TEST(Warnock_kernels, are_one_on_dyadic_scenes) { image_test::expect_kernels_agree(warnock); }
TEST(Warnock_kernels, leave_out_what_is_not_finite) { image_test::expect_without_infinite(warnock); }

}  // namespace
