#pragma once
// What a set operation starts from: the faces of all solids on one grid, with one table of planes.

#include <sightline/kernel/plane.h>
#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/scene/face_cutter.h>
#include <sightline/kernel/scene/grid.h>
#include <sightline/kernel/scene/pieces.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/vertex.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sightline {

class Predicates;

/// The convex pieces of all operands' faces. Faces are numbered on from one operand to the next, and so are pieces.
/// What a Scene does not do: a face that is given twice counts twice, for winding numbers do.
/// Errors: std::out_of_range where a face names a point that there is not; std::length_error for 2^28 points or 2^30
/// faces and more. Cost: O(n) hashing. Exact: yes. Proof: P-00, P-01, P-02
class Operands {
 public:
  explicit Operands(std::span<const Polygon_soup> solids);

  std::size_t size() const { return first_face_.size() - 1; }
  std::uint32_t operand_of_piece(std::size_t piece) const { return operand_[piece]; }
  /// The operand, and the face's number in it.
  std::pair<std::uint32_t, Face_id> source_of(Face_id face) const;
  std::size_t face_count() const { return first_face_.back(); }

  const Grid_points& points() const { return grid_.points(); }
  const Plane_table& planes() const { return faces_.planes; }
  const std::vector<Piece>& pieces() const { return faces_.pieces; }
  /// Edges have planes from make_edges() on: most pieces meet nothing, and are asked for none.
  std::span<const Piece_corner> corners(std::size_t piece) const {
    return {faces_.corners.data() + pieces()[piece].first, pieces()[piece].size};
  }
  /// Makes the planes through the edges of a piece, unless it has them. Predicates that were made before do not know
  /// them.
  void make_edges(std::size_t piece) { bound_piece(points(), faces_, piece); }
  const std::vector<Set_aside>& set_aside() const { return faces_.set_aside; }
  const std::vector<Face_id>& non_planar() const { return faces_.non_planar; }
  const Scene_counters& counters() const { return faces_.counters; }
  Predicates predicates() const&;  ///< of `kernel/predicates.h`
  Predicates predicates() const&& = delete;
  /// The same, with room for the planes of some edges: these do not move all planes to another place.
  Operands with_room_for_edges() const;
  /// Corner k of a piece. Pre: make_edges().
  Vertex vertex(const Predicates& predicates, std::size_t piece, std::size_t k) const;
  /// The file's coordinates of a point in homogeneous grid coordinates. Pre: h[3] != 0.
  Exact_point position(const std::array<Integer, 4>& h) const { return grid_.position(h); }
  Exact_point position(std::uint32_t point) const { return grid_.position(point); }
  /// Appends a point, as position() has it.
  Point_id add_point(std::uint32_t point, Polygon_soup& soup) const { return grid_.add_point(point, soup); }

 private:
  Operands() = default;

  Scene_grid grid_;
  Scene_faces faces_;
  Point_planes incidences_;
  std::vector<Face_id> first_face_;     // of each operand; then how many there are
  std::vector<std::uint32_t> operand_;  // of each piece
};

/// Whether a piece is all that its face became.
bool is_whole_face(const Operands& operands, std::size_t piece);

/// Why an operand bounds no solid: an edge without its opposite, or a face that has no surface of its own.
struct Operand_flaw {
  std::uint32_t operand;
  Face_id face;     ///< of the operand
  std::string why;  ///< "self-intersecting" and the like; empty: the edge from `from` to `to` is open
  Exact_point from, to;
};

/// What is wrong with the operands, in their order: faces that cross themselves, and the edges on lines where the
/// operand's oriented boundary is not zero, each once (closure() of kernel/scene/closed.h, but by
/// operand). Empty: each operand gives every point off its faces a winding number. Degenerate: no faces are closed.
/// Cost: O(edges log edges). Exact: yes. Proof: P-08
std::vector<Operand_flaw> flaws(const Operands& operands);

}  // namespace sightline
