// The example of algorithms/levels/README.md.

#include <gtest/gtest.h>

#include <sightline/algorithms/levels/pvs.h>
#include <sightline/kernel/scene/scene.h>

#include <iostream>

#include <sightline/io/read.h>

#include <sstream>

namespace {

void what_rooms_see(const sightline::Polygon_soup& soup, const sightline::Exact_point& eye, std::ostream& out) {
  const sightline::Level_cells level(soup);
  out << level.counters().cells << " cells, " << level.counters().portals << " portals\n";
  if (!level.way_out(eye).empty()) out << "a leak\n";

  const sightline::Pvs pvs = sightline::potentially_visible(level);
  const sightline::Cell_id cell = level.at(eye);
  out << "the cell of the eye sees " << pvs.visible[cell].size() << " of " << level.scene().counters().faces
      << " faces, " << pvs.undecided[cell].size() << " undecided\n";
}

TEST(Example, of_levels_finds_rooms_closed) {
  std::ostringstream out;
  what_rooms_see(sightline::read_scene(SIGHTLINE_SOURCE_DIR "/tests/corpus/general/two_rooms.map"), {64, 64, 24}, out);
  EXPECT_EQ(out.str().find("leak"), std::string::npos);
  EXPECT_NE(out.str().find("cells, "), std::string::npos);
  EXPECT_NE(out.str().find("of 71 faces, 0 undecided"), std::string::npos) << out.str();
}

}  // namespace
