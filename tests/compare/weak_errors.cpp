// Errors of weak visibility: faces counted by hand.

#include <sightline/harness/compare/weak_errors.h>

#include <gtest/gtest.h>

namespace {

using namespace sightline;

TEST(Weak_errors, are_faces_on_the_wrong_list) {
  const Weak_faces exact{{0, 1, 2, 3}, {4, 5, 6}, {7, 8}};
  const Weak_errors none = weak_errors(exact, exact);
  EXPECT_EQ(none.all(), 0u);
  EXPECT_EQ(none.unjudged, 2u);
  const Weak_errors some = weak_errors(exact, {{0, 4, 7}, {1, 2, 5}, {3, 6, 8}});
  EXPECT_EQ(some.wrongly_visible, 1u);
  EXPECT_EQ(some.wrongly_hidden, 2u);
  EXPECT_EQ(some.undecided, 2u);
  EXPECT_EQ(some.unjudged, 2u);
  EXPECT_EQ(some.all(), 5u);
}

}  // namespace
