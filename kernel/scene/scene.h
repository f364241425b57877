#pragma once
// A scene ready for exact geometry: points on one integer grid, interned planes, convex pieces, and a list of what was
// set aside.

#include <sightline/kernel/number.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/scene/grid.h>
#include <sightline/kernel/scene/pieces.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sightline {

class Predicates;
struct Prepared_plane;

/// An exact polygonal scene (design laws in proofs/semantics.md). Points lie on the coarsest integer grid that holds
/// them all, centred (Scene_grid). Non-planar faces are triangulated, concave ones and ones with holes cut into convex
/// pieces on their own vertices; what cannot be modelled is set aside for a Set_aside_reason and listed.
/// Errors: std::out_of_range where a face names a point that there is not; std::length_error for 2^28 points or 2^30
/// faces and more.
/// Cost: O(n) hashing, O(k log k) for a face of k vertices (see cut_face). Exact: yes. Proof: P-00, P-01, P-02
class Scene {
 public:
  explicit Scene(const Polygon_soup& soup);

  const std::string& file() const& { return file_; }
  const Grid_points& points() const& { return grid_.points(); }
  const Plane_table& planes() const& { return faces_.planes; }
  const std::vector<Piece>& pieces() const& { return faces_.pieces; }
  std::span<const Piece_corner> corners(const Piece& piece) const& {
    return {faces_.corners.data() + piece.first, piece.size};
  }
  const std::vector<Set_aside>& set_aside() const& { return faces_.set_aside; }
  const std::vector<Face_id>& non_planar() const& { return faces_.non_planar; }
  const std::vector<Face_id>& concave() const& { return faces_.concave; }
  const Scene_counters& counters() const& { return faces_.counters; }
  const Point_planes& incidences() const& { return incidences_; }
  Predicates predicates() const&;  ///< of `kernel/predicates.h`

  // Of a temporary none of them, which would refer to what is gone.
  void file() const&& = delete;
  void points() const&& = delete;
  void planes() const&& = delete;
  void pieces() const&& = delete;
  void corners(const Piece& piece) const&& = delete;
  void set_aside() const&& = delete;
  void non_planar() const&& = delete;
  void concave() const&& = delete;
  void counters() const&& = delete;
  void incidences() const&& = delete;
  void predicates() const&& = delete;

  Prepared_plane prepared(Plane plane) const;  ///< as predicates() make it, for those that need no more of them

  /// Bit length of the largest coordinate once the whole scene is scaled to integers, and of that scale.
  int bits() const { return grid_.bits(); }
  int scale_bits() const { return grid_.scale_bits(); }

  /// A plane of one's own (a near plane, say) with coefficients in grid coordinates. Take predicates() after it.
  /// Errors: std::overflow_error where it is wider than planes through the scene's points can be.
  Plane add_plane(const std::array<Integer, 4>& h) { return faces_.planes.intern(h[0], h[1], h[2], h[3]); }

  /// An oriented plane in the file's coordinates, up to a positive factor. Exact: yes.
  std::array<Rational, 4> file_coefficients(Plane plane) const;
  /// The same for coefficients in grid coordinates.
  std::array<Rational, 4> file_coefficients(const std::array<Integer, 4>& h) const {
    return grid_.file_coefficients(h);
  }

  /// A point of the file's coordinates as predicates take it.
  Located_point locate(const Exact_point& p) const { return grid_.locate(p); }

  /// The file's coordinates of a point in homogeneous grid coordinates. Pre: h[3] != 0.
  Exact_point position(const std::array<Integer, 4>& h) const { return grid_.position(h); }
  Exact_point position(std::uint32_t point) const { return grid_.position(point); }
  /// Corners of a piece in file coordinates.
  std::vector<Exact_point> corner_points(const Piece& piece) const;
  /// The bounding box of all points used by the file, in its coordinates. Pre: there is a point.
  std::array<Exact_point, 2> box() const { return grid_.box(); }
  /// The same of the corners of the faces that are kept. Pre: there is one. Cost: O(corners)
  std::array<Exact_point, 2> box_of_faces() const;

 private:
  std::string file_;
  Scene_grid grid_;
  Scene_faces faces_;
  Point_planes incidences_;
};

}  // namespace sightline
