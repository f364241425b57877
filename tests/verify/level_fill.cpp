// Cells of a level, by hand: boxes in a row.

#include "scenes.h"

#include <sightline/algorithms/verify/level_fill.h>

namespace verify_fill_test {
namespace {

using namespace verify_test;

/// The box [from, to] x [0, 1] x [0, 1]; its first wall looks to lower x, its second one to higher x.
Cell_of_level cell(std::uint64_t number, long from, long to) {
  const auto across = [](long x) { return Points{at(x, 0, 0), at(x, 0, 1), at(x, 1, 1), at(x, 1, 0)}; };
  const auto side = [&](long y) { return Points{at(from, y, 0), at(to, y, 0), at(to, y, 1), at(from, y, 1)}; };
  return {number,
          {across(from), reversed(across(to)), side(0), reversed(side(1)), reversed(rectangle(from, to, 0, 1, 0)),
           rectangle(from, to, 0, 1, 1)},
          false,
          {}};
}
std::vector<Cell_of_level> two_cells() { return {cell(7, 0, 1), cell(8, 1, 2)}; }

std::string why(const std::vector<Cell_of_level>& cells, bool accepted = false, const Polygon_soup& soup = {}) {
  const Verdict verdict = verify_level_fill(soup, cells);
  EXPECT_EQ(verdict.accepted, accepted) << verdict.why;
  return verdict.why;
}

TEST(Level_fill, by_boxes_in_a_row) {
  EXPECT_EQ(why(two_cells(), true), "2 cells fill a box about the scene, 0 of them have certificates");
  EXPECT_EQ(why({cell(7, 0, 1), cell(8, 0, 1)}), "cell 8 has wall 0 that cell 7 has too, the same way round");
  EXPECT_EQ(why({cell(7, 0, 1), cell(8, 2, 3)}), "cell 7 has wall 1 with no cell beyond it, at (1, 1, 0)");
  EXPECT_EQ(why({}), "the volumes of cells do not sum to that of the box about them");
  std::vector<Cell_of_level> with_none = two_cells();
  with_none.push_back({9, {}, true, {}});
  EXPECT_EQ(why(with_none), "cell 9: it has no walls");
  Polygon_soup beyond;
  for (const long x : {0, 2, 3}) beyond.add_point(x, x % 2, 1);
  beyond.add_face({0, 1, 2});
  EXPECT_EQ(why(two_cells(), false, beyond), "face 0 has a corner that no cell is about");
}

TEST(Level_fill, has_no_way_to_a_cell_without_a_certificate) {
  std::vector<Cell_of_level> cells = two_cells();
  cells[0].has_certificate = true;
  cells[0].sources = {cells[0].walls[0]};  // in a side of the box
  EXPECT_EQ(why(cells, true), "2 cells fill a box about the scene, 1 of them have certificates");
  cells[0].sources.push_back(cells[0].walls[1]);
  EXPECT_EQ(why(cells), "cell 7: through source 1 there is a way to cell 8, which has no certificate");
  cells[1].has_certificate = true;
  EXPECT_EQ(why(cells, true), "2 cells fill a box about the scene, 2 of them have certificates");
}

TEST(Level_fill, has_no_wall_open_to_a_cell_without_a_certificate) {
  std::vector<Cell_of_level> cells = two_cells();
  cells[0].has_certificate = true;
  cells[0].open_walls = {0};  // in a side of the box
  EXPECT_EQ(why(cells, true), "2 cells fill a box about the scene, 1 of them have certificates");
  cells[0].open_walls = {0, 1};
  EXPECT_EQ(
      why(cells),
      "cell 7: some of wall 1 is covered by no source and no face, and beyond is cell 8, which has no certificate");
  cells[1].has_certificate = true;
  EXPECT_EQ(why(cells, true), "2 cells fill a box about the scene, 2 of them have certificates");
  cells[1].open_walls = {6};
  EXPECT_EQ(why(cells), "cell 8 has no wall 6");
}

}  // namespace
}  // namespace verify_fill_test
