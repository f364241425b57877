// The law of clipping to concave windows, where what is right is plain to see; and that it comes to what is refused.

#include "../sample.h"

#include <sightline/harness/laws/window_laws.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace window_laws_test {

using namespace sightline;
using State = harness::Outcome::State;

namespace {

Image_loop box(long x, long y, long side) { return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}; }

TEST(Window_laws, pass_what_is_clipped_rightly_and_what_is_refused_rightly) {
  const std::vector<Image_polygon> frame{{box(0, 0, 6), {box(2, 2, 2)}}}, square{{box(1, 1, 4), {}}},
      twice{{box(0, 0, 2), {}}, {box(1, 1, 2), {}}}, beside{{box(0, 0, 2), {box(3, 3, 1)}}};
  EXPECT_EQ(harness::checked_clip(square, frame).state, State::passed);
  EXPECT_EQ(harness::checked_clip(frame, frame).state, State::passed);
  EXPECT_EQ(harness::checked_clip({}, frame).state, State::passed);
  EXPECT_EQ(harness::checked_clip(twice, frame).state, State::passed) << "which overlap";
  const std::vector<Image_polygon> bow{{{{0, 0}, {2, 2}, {2, 0}, {0, 2}}, {}}};
  EXPECT_EQ(harness::checked_clip(bow, frame).state, State::passed) << "which crosses itself, its areas adding up to 0";
  EXPECT_EQ(harness::checked_clip(frame, beside).state, State::passed) << "a hole beside its polygon";
}

TEST(Window_laws, hold_for_what_the_fuzzer_draws) {
  const harness::Check check = harness::windows_check();
  const harness::Posed_scene posed;
  for (std::uint64_t seed = 0; seed < test_scenes::sample(300u); ++seed) {
    generate::Random random(seed);
    const harness::Outcome outcome = check.run(posed, {}, random);
    EXPECT_EQ(outcome.state, State::passed) << "seed " << seed << ": " << outcome.what;
  }
}

}  // namespace

}  // namespace window_laws_test
