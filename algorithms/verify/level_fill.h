#pragma once
// Checks that cells fill a level, and that no way leads out of those that have certificates. Rationals and corners
// only; shares nothing with what makes cells. Laws: proofs/levels.md (P-88e).

#include <sightline/algorithms/verify/verdict.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline {

/// What is said of one of all cells.
struct Cell_of_level {
  std::uint64_t cell = 0;                       ///< its number, for messages
  std::vector<std::vector<Exact_point>> walls;  ///< convex polygons, counterclockwise as seen from outside of the cell
  bool has_certificate = false;
  std::vector<std::vector<Exact_point>> sources;  ///< of its certificate; none where that is not to be checked
  std::vector<std::size_t> open_walls =
      {};  ///< places of walls that its check found uncovered, though nothing is beyond
};

/// Whether cells fill a box that holds the scene, each point of it off their walls in one: (1) the walls of each are
/// those of a closed convex polyhedron with an inside; (2) each wall is that of one other cell, corner by corner, the
/// other way round, or lies in a side of the box about all corners; (3) the volumes of cells sum to that of the box;
/// (4) no corner of a face is beyond it. And (5) each source of a cell lies in a wall with a cell that has a
/// certificate too, or in a side of the box, and open walls are such: nobody gets from cells with certificates to one
/// without. Degenerate: walls
/// of two cells that overlap, but are not the same polygon, are rejected. Pre: none; rejects whatever is wrong. Post:
/// `why` is one line. `options`: of them, progress before each cell of each step, from this thread. Cost: O(walls log
/// walls), and sources of a cell times its walls. Exact: yes, without filters. Proof: P-88e
Verdict verify_level_fill(const Polygon_soup& soup, const std::vector<Cell_of_level>& cells,
                          const Verify_options& options = {});

}  // namespace sightline
