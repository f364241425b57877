// What laws ask by brute force, where the answer is plain to see; and that the laws that ask it do.

#include "../sample.h"

#include <sightline/harness/laws/flat_faces.h>
#include <sightline/harness/laws/fuzz.h>
#include <sightline/harness/laws/priority_laws.h>
#include <sightline/harness/laws/solid_laws.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <optional>

namespace {

using namespace sightline;
using generate::at;
using generate::ratio;
using harness::Flat_face;

const Flat_face square(generate::rectangle(0, 2, 0, 2, 0));  // front up

TEST(Flat_faces, are_pierced_from_the_front_and_inside) {
  EXPECT_EQ(harness::pierced_at(square, at(1, 1, 3), at(0, 0, -1)), std::optional<Rational>(3));
  EXPECT_EQ(harness::pierced_at(square, at(1, 1, -3), at(0, 0, 1)), std::nullopt) << "from behind";
  EXPECT_EQ(harness::pierced_at(square, at(1, 1, 3), at(0, 0, 1)), std::nullopt) << "away from it";
  EXPECT_EQ(harness::pierced_at(square, at(1, 1, 0), at(0, 0, -1)), std::nullopt) << "from its plane";
  EXPECT_EQ(harness::pierced_at(square, at(0, 1, 3), at(0, 0, -1)), std::nullopt) << "on an edge";
  EXPECT_EQ(harness::pierced_at(square, at(3, 1, 3), at(0, 0, -1)), std::nullopt) << "beside it";
}

TEST(Flat_faces, are_met_from_both_sides_and_on_their_boundary) {
  EXPECT_EQ(harness::met_at(square, at(0, 0, -3), at(0, 0, 2)), std::optional<Rational>(ratio(3, 2)));
  EXPECT_EQ(harness::met_at(square, at(1, 1, 0), at(0, 0, 1)), std::optional<Rational>(0));
  EXPECT_EQ(harness::met_at(square, at(1, 1, 1), at(0, 0, 1)), std::nullopt);
  EXPECT_EQ(harness::met_at(square, at(-2, 1, 0), at(1, 0, 0)), std::optional<Rational>(2)) << "in its plane";
  EXPECT_EQ(harness::met_at(square, at(-2, 0, 0), at(1, 0, 0)), std::optional<Rational>(2)) << "along an edge";
  EXPECT_EQ(harness::met_at(square, at(-1, 1, 0), at(1, -1, 0)), std::optional<Rational>(1)) << "through a corner";
  EXPECT_EQ(harness::met_at(square, at(-1, 0, 0), at(1, -1, 0)), std::nullopt) << "past a corner";
  EXPECT_EQ(harness::met_at(square, at(3, 1, 0), at(1, 0, 0)), std::nullopt) << "behind the origin";
}

TEST(Flat_faces, are_seen_over_others_from_eyes_before_both) {
  const Flat_face over(generate::rectangle(2, 4, 0, 2, 1)), tilted({at(0, 0, -1), at(2, 0, 1), at(2, 2, 1)});
  EXPECT_TRUE(harness::sees_over(at(7, 1, 3), over, square));
  EXPECT_FALSE(harness::sees_over(at(7, 1, 3), square, over));
  EXPECT_FALSE(harness::sees_over(at(2, 1, 3), over, square)) << "the cones touch";
  EXPECT_FALSE(harness::sees_over(at(9, 1, 1), over, square)) << "from its plane";
  EXPECT_FALSE(harness::sees_over(at(7, 1, ratio(1, 2)), over, square)) << "from below it";
  EXPECT_TRUE(harness::sees_over(at(2, 1, 9), tilted, square) && harness::sees_over(at(2, 1, 9), square, tilted))
      << "they cross";
  EXPECT_TRUE(harness::cross_each_other(tilted, square) && harness::cross_each_other(square, tilted));
  EXPECT_FALSE(harness::cross_each_other(over, square));
  EXPECT_FALSE(harness::cross_each_other(Flat_face({at(0, 0, 0), at(0, 2, 0), at(0, 0, 2)}), square)) << "an edge";
}

TEST(Flat_faces, are_seen_over_others_from_regions_that_reach_such_eyes) {
  const Flat_face over(generate::rectangle(2, 4, 0, 2, 1));
  EXPECT_TRUE(harness::some_eye_sees_over({at(7, 1, 3), at(-9, 1, 3)}, over, square));
  EXPECT_TRUE(harness::some_eye_sees_over({at(9, -5, 3), at(9, 7, 3)}, over, square)) << "between two that do not";
  EXPECT_FALSE(harness::some_eye_sees_over({at(2, 1, 3), at(-9, 1, 3)}, over, square)) << "it touches them";
  EXPECT_FALSE(harness::some_eye_sees_over({}, over, square));
  EXPECT_FALSE(harness::some_eye_sees_over({at(7, 1, 3)}, square, over));
}

TEST(Brute_force, is_asked_of_every_family_and_agrees) {
  for (const harness::Check& check :
       {harness::region_check(), harness::rays_check(), harness::pixels_check(), harness::splits_check(),
        harness::points_check(), harness::first_hit_check(), harness::parts_check(), harness::face_graph_check()}) {
    std::size_t asked = 0, drawn = 0;
    for (const generate::Family& family : generate::families()) {
      harness::Fuzz_case which;
      which.family = family.name;
      which.parameters.size = family.small_size;
      for (which.parameters.seed = 1; which.parameters.seed <= test_scenes::sample(36u); ++which.parameters.seed) {
        const harness::Posed_scene posed = harness::make(which);
        if (posed.soup.face_count() > 40) continue;
        generate::Random random(++drawn);
        const harness::Outcome outcome = check.run(posed, {}, random);
        EXPECT_NE(outcome.state, harness::Outcome::State::failed)
            << check.name << ": " << harness::to_string(which) << ": " << outcome.what;
        asked += outcome.state == harness::Outcome::State::passed;
      }
    }
    EXPECT_GT(asked, test_scenes::least(10u)) << check.name;
  }
}

}  // namespace
