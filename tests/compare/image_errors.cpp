// Errors of images: faces and pixels counted by hand.

#include "support.h"

#include "../soup.h"

#include <sightline/harness/compare/image_errors.h>

using namespace compare_test;

namespace {

TEST(Image_errors, name_the_faces_of_wrong_pixels_and_leave_out_ties) {
  std::vector<std::vector<Exact_point>> squares;
  for (long z = 0; z < 4; ++z) squares.push_back({at(0, 0, z), at(1, 0, z), at(1, 1, z), at(0, 1, z)});
  const Scene scene(test_scenes::soup_of(squares));
  constexpr std::uint32_t nothing = Piece_image::nothing;
  Piece_image truth, image;
  truth.pieces = {0, 1, 2, nothing, 0, 3};
  truth.tied = {0, 0, 0, 0, 1, 0};
  image.pieces = {0, 2, nothing, 3, 3, 3};
  const Image_errors errors = image_errors(scene, truth, image);
  EXPECT_EQ(errors.wrong, 3u);
  EXPECT_EQ(errors.covered, (std::vector<Face_id>{1, 2}));
  EXPECT_EQ(errors.shown, (std::vector<Face_id>{2, 3}));
  EXPECT_EQ(errors.missing, 1u) << "1 is; 2 is shown, elsewhere";
  const Image_errors none = image_errors(scene, truth, truth);
  EXPECT_EQ(none.wrong, 0u);
  EXPECT_TRUE(none.covered.empty());
  EXPECT_TRUE(none.shown.empty());
}

}  // namespace
