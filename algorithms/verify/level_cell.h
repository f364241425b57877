#pragma once
// Checks that a certificate of weak visibility is about a cell of a level: that its sources are all ways out of the
// cell. Rationals and corners only; shares nothing with what makes cells. Laws: proofs/levels.md (P-88b).

#include <sightline/algorithms/verify/verdict.h>
#include <sightline/algorithms/verify/weak.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace sightline {

namespace weak_check {
class Known_scene;
}

/// What is said of a cell, beside the certificate of what can be seen from its portals.
struct Cell_statement {
  std::vector<std::vector<Exact_point>> walls;  ///< convex polygons, counterclockwise as seen from outside of the cell
  std::vector<Face_id> within;                  ///< the faces that look into the cell, in any order
};

/// Whether the walls bound a cell, the certificate's sources are its portals, and the certificate is right: (0)
/// verify_weak() accepts the certificate, or it has no source and its fragments are the scene; (1) the walls are those
/// of a closed convex polyhedron with an inside; (2) no fragment passes through its inside; (3) each source lies in a
/// wall, looks out of the cell, and no fragment covers some of it; (4) what of a wall no source covers, fragments
/// cover, unless no fragment is beyond its plane; (5) `within` are the faces that cover some of a wall, with their
/// front to the inside. Degenerate: a side of the cell may be many walls, with corners of some in edges of others;
/// touching is not passing through, nor covering. Pre: none; rejects whatever is wrong. Post: `why` is one line. Cost:
/// verify_weak(), and walls times fragments; of a wall that no fragment covers alone, those upon it times the parts
/// that they leave of it. Exact: yes, without filters. Proof: P-88b
Verdict verify_level_cell(const Polygon_soup& soup, const Cell_statement& cell, const Weak_certificate& certificate,
                          const Verify_options& options = {});

/// The same for one cell of a level after the other: what certificates say of the scene, if the one before said the
/// same, is not checked again. Not thread-safe. Exact: yes
class Level_cell_checker {
 public:
  /// Pre: the soup outlives it.
  explicit Level_cell_checker(const Polygon_soup& soup, Verify_options options = {});
  Level_cell_checker(Polygon_soup&&, Verify_options = {}) = delete;
  ~Level_cell_checker();

  Verdict check(const Cell_statement& cell, const Weak_certificate& certificate);
  /// Of the cell that was accepted last the walls of which sources and faces leave some uncovered, as no fragment is
  /// beyond: a way for who walks, though not for who looks.
  const std::vector<std::size_t>& open_walls() const { return open_walls_; }

 private:
  const Polygon_soup& soup_;
  Verify_options options_;
  std::unique_ptr<const weak_check::Known_scene> scene_;
  std::vector<std::size_t> open_walls_;
};

}  // namespace sightline
