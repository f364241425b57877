// The depth sort against exact rays through pixel centres; each of its tests, swaps and cuts on a scene made for it.

#include "same_images.h"

#include <sightline/algorithms/image/newell.h>

#include <gtest/gtest.h>

namespace {

using namespace sightline;
using view_scenes::at;
using view_scenes::Family;
using view_scenes::Points;
using view_scenes::rectangle;
using view_scenes::soup_of;

// ---- Any scene

class Newell : public testing::TestWithParam<Family> {};

TEST_P(Newell, exact_is_what_rays_meet_but_for_ties) {
  std::size_t shown = 0;
  std::uint64_t swaps = 0, splits = 0;
  image_test::for_each_view(GetParam(), 24, [&](const Scene& scene, const Pixel_view& pixels, const std::string& label) {
    const Piece_image truth = centres(Exact_view(scene, pixels.eye), pixels);
    const Piece_image image = newell(scene, pixels, Image_kernel::exact, {.threads = 1});
    EXPECT_EQ(image_test::difference(image, truth, [&](std::size_t i) { return !truth.tied[i]; }), "") << label;
    EXPECT_EQ(image.counters.edge_on, truth.counters.edge_on) << label;
    EXPECT_EQ(image.counters.unordered, 0u) << label;
    const Piece_image again = newell(scene, pixels, Image_kernel::exact, {.threads = 4});
    EXPECT_EQ(again.pieces, image.pieces) << label;
    Image_counters::each([&](const char* key, auto member) {
      EXPECT_EQ(again.counters.*member, image.counters.*member) << label << ": " << key;
    });
    for (const std::uint32_t piece : truth.pieces) shown += piece != Piece_image::nothing;
    swaps += image.counters.swaps;
    splits += image.counters.splits;
  });
  EXPECT_GT(shown, 1000u);
  EXPECT_GT(swaps, 10u);
  if (GetParam() == Family::cyclic || GetParam() == Family::crossing) EXPECT_GT(splits, 30u);
}

TEST_P(Newell, rounded_numbers_make_an_image) {
  image_test::for_each_view(GetParam(), 6, [&](const Scene& scene, const Pixel_view& pixels, const std::string& label) {
    for (const Image_kernel kernel : {Image_kernel::float_numbers, Image_kernel::double_numbers}) {
      const Piece_image image = newell(scene, pixels, kernel, {.threads = 1});
      EXPECT_EQ(image.pieces.size(), std::size_t{pixels.width} * pixels.height);
      EXPECT_TRUE(std::all_of(image.pieces.begin(), image.pieces.end(), [&](std::uint32_t piece) {
        return piece == Piece_image::nothing || piece < scene.pieces().size();
      })) << label;
      EXPECT_EQ(newell(scene, pixels, kernel, {.threads = 4}).pieces, image.pieces) << label;
    }
  });
}
INSTANTIATE_TEST_SUITE_P(All, Newell, testing::ValuesIn(view_scenes::families),
                         [](const auto& family) { return view_scenes::name(family.param); });

TEST(Newell_kernels, are_one_on_dyadic_scenes) { image_test::expect_kernels_agree(newell); }
TEST(Newell_kernels, leave_out_what_is_not_finite) { image_test::expect_without_infinite(newell); }

}  // namespace
