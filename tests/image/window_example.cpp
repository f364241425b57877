// The example of concave windows of algorithms/image/README.md, as it stands there.

#include <sightline/algorithms/image/concave_window.h>

#include <iostream>

/// How much of a square is seen through the hole of a frame, and how much is hidden by it.
void look_through(std::ostream& out) {
  using namespace sightline;
  const Image_polygon square{{{1, 1}, {5, 1}, {5, 5}, {1, 5}}, {}};
  const Image_polygon frame{{{0, 0}, {6, 0}, {6, 6}, {0, 6}}, {{{2, 2}, {2, 4}, {4, 4}, {4, 2}}}};
  const Clipped_polygons clipped = clip_to_window(std::vector{square}, std::vector{frame});
  for (const Image_polygon& hidden : clipped.inside)
    out << area(hidden) << " behind it, in a polygon with " << hidden.holes.size() << " hole\n";
  for (const Image_polygon& seen : clipped.outside) out << area(seen) << " through the hole\n";
}

#include <gtest/gtest.h>

#include <sstream>

TEST(Window_example, a_frame_hides_all_but_its_hole) {
  std::ostringstream out;
  look_through(out);
  EXPECT_EQ(out.str(), "12 behind it, in a polygon with 1 hole\n4 through the hole\n");
}
