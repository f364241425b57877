#pragma once
// A scene ready for exact geometry: points on one integer grid, interned planes, convex pieces, and a list of what was
// set aside.

#include <sightline/kernel/coordinates.h>
#include <sightline/kernel/fixed_integer.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/set_aside.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sightline {

/// A face that is not modelled, and why: the reason, and its text, such as "zero area" or "duplicate of 7".
struct Set_aside {
  Face_id face;
  Set_aside_reason reason;
  std::string why;
};

/// A convex polygon of the scene: a face, or one of the convex pieces that a face was cut into.
struct Piece {
  Face_id face;
  std::uint32_t number;  ///< 0-based within the face
  Plane support;         ///< supporting plane; its front is the face's front
  std::uint32_t first;   ///< corners [first, first + size) of the scene, counterclockwise seen from the front
  std::uint32_t size;
};

/// A corner of a piece, and the bounding plane through the edge to the next corner: not the supporting plane, interior
/// in its front.
struct Piece_corner {
  std::uint32_t point;
  Plane edge;
};

/// What the scene was made of and what became of it.
struct Scene_counters {
  std::size_t points_read = 0, points = 0, faces_read = 0, faces = 0, pieces = 0;
  std::size_t zero_area = 0, duplicates = 0, self_intersecting = 0, no_simple_projection = 0;  ///< set aside
  std::size_t non_planar = 0, concave = 0, with_holes = 0, fanned = 0;
};

/// An exact polygonal scene (design laws in proofs/semantics.md). Input coordinate x is (offset + unit * grid) / scale
/// for an integer grid coordinate; the grid is the coarsest that holds all points, centred, so that 26-bit detail a
/// million units from the origin stays 26-bit detail. Non-planar faces are triangulated, concave ones and ones with
/// holes cut into convex pieces on their own vertices; what cannot be modelled is set aside for a Set_aside_reason and
/// listed. Cost: O(n) hashing, O(k log k) for a face of k vertices. Exact: yes. Proof: P-01, P-02
class Scene {
 public:
  explicit Scene(const Polygon_soup& soup);

  const std::string& file() const { return file_; }
  const Grid_points& points() const { return points_; }
  const Plane_table& planes() const { return planes_; }
  const std::vector<Piece>& pieces() const { return pieces_; }
  std::span<const Piece_corner> corners(const Piece& piece) const {
    return {corners_.data() + piece.first, piece.size};
  }
  const std::vector<Set_aside>& set_aside() const { return set_aside_; }
  const std::vector<Face_id>& non_planar() const { return non_planar_; }
  const std::vector<Face_id>& concave() const { return concave_; }
  const Scene_counters& counters() const { return counters_; }
  const Point_planes& incidences() const { return incidences_; }
  Predicates predicates() const { return {points_, planes_, incidences_}; }

  /// Bit length of the largest coordinate once the whole scene is scaled to integers, and of that scale.
  int bits() const { return bits_read_; }
  int scale_bits() const { return static_cast<int>(bit_length(scale_)) - 1; }

  /// A plane of one's own (a near plane, say) with coefficients in grid coordinates. Take predicates() after it.
  /// Errors: std::overflow_error where it is wider than planes through the scene's points can be.
  Plane add_plane(const std::array<Integer, 4>& h) { return planes_.intern(h[0], h[1], h[2], h[3]); }

  /// An oriented plane in the file's coordinates, up to a positive factor. Exact: yes.
  std::array<Rational, 4> file_coefficients(Plane plane) const {
    return file_coefficients(predicates().coefficients(plane));
  }
  /// The same for coefficients in grid coordinates.
  std::array<Rational, 4> file_coefficients(const std::array<Integer, 4>& h) const;

  /// A point of the file's coordinates as predicates take it.
  Located_point locate(const Exact_point& p) const;

  /// The file's coordinates of a point in homogeneous grid coordinates. Pre: h[3] != 0.
  Exact_point position(const std::array<Integer, 4>& h) const;
  Exact_point position(std::uint32_t point) const {
    return position({points_.integer(point, 0), points_.integer(point, 1), points_.integer(point, 2), 1});
  }
  /// The bounding box of all points used by the file, in its coordinates. Pre: there is a point.
  std::array<Exact_point, 2> box() const;

 private:
  static bool exact_or_infinite(double d, const Rational& value) { return !std::isfinite(d) || exact(d) == value; }

  // ---- Points: common scale, centred grid, equal points merged

  /// Fills the grid and returns, for each point of the soup, its point of the scene.
  std::vector<std::uint32_t> place_points(const Polygon_soup& soup);

  /// The common denominator of most coordinates, where the rest of them is what makes the grid fine; else that of all.
  Integer usual_denominator(const Coordinates& coordinates) const;

  /// `divisor`: scaled coordinates that are its multiples are to be exact in doubles, where the grid is too wide for
  /// that otherwise.
  template <class Number, class Read>
  std::vector<std::uint32_t> place(std::size_t count, Integer divisor, Read read);
  static std::int64_t greatest_divisor(std::int64_t a, std::int64_t b) { return std::gcd(a, b); }
  static Integer greatest_divisor(const Integer& a, const Integer& b) { return gcd(a, b); }
  static Integer integer(std::int64_t n) { return Integer(static_cast<long>(n)); }
  static Integer integer(const Integer& n) { return n; }

  // ---- Faces: planes, convex pieces, what is set aside

  using Loop = std::vector<std::uint32_t>;

  void add_faces(const Polygon_soup& soup, const std::vector<std::uint32_t>& merged);
  /// `of`: what goes behind the reason's text.
  void set_aside(Face_id f, Set_aside_reason reason, const std::string& of = {});

  // Faces are made in the narrowest of three number types. In g-bit coordinates a normal has 2 g + 2 bits, a normal
  // times a difference 3 g + 6, and the area vector of a loop of up to 2^28 corners 28 more: 30 bits fit 128, 72 bits
  // fit 256.
  template <class Number>
  using Vector = std::array<Number, 3>;

  template <class Number>
  Vector<Number> at(std::uint32_t p) const;
  template <class Number>
  static Vector<Number> difference(const Vector<Number>& a, const Vector<Number>& b);
  template <class Number>
  static Vector<Number> cross(const Vector<Number>& a, const Vector<Number>& b);
  template <class Number>
  static Number dot(const Vector<Number>& a, const Vector<Number>& b);
  template <class Number>
  static bool is_zero(const Vector<Number>& a);

  /// Twice the area vector of a loop. Exact: yes.
  template <class Number>
  Vector<Number> area_vector(const Loop& loop) const;

  /// Adds the convex pieces of a face, or says why it has none.
  template <class Number>
  std::optional<Set_aside_reason> add_face(Face_id f, const std::vector<Loop>& loops);

  template <class Number>
  std::optional<Set_aside_reason> add_planar_face(Face_id f, const Vector<Number>& normal,
                                                  const std::vector<Loop>& loops);

  template <class Number>
  std::optional<Set_aside_reason> add_non_planar_face(Face_id f, const Vector<Number>& normal,
                                                      const std::vector<Loop>& loops);

  /// Whether the pieces' directed edges add up to those of the loops: in a projection an edge-on part of a non-planar
  /// face can get lost.
  template <class Number>
  bool has_boundary(const Convex_parts& parts, const std::vector<std::uint32_t>& ids, const std::vector<Loop>& loops,
                    int axis) const;

  template <class Number>
  bool all_collinear(const Loop& loop) const;
  template <class Number>
  bool all_coplanar(const std::vector<Loop>& loops) const;
  template <class Number>
  static int dominant(const Vector<Number>& n);
  /// The two axes of the projection along `axis` in which the front's counterclockwise is the plane's.
  static std::array<int, 2> projection(int axis, bool mirrored) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    return mirrored ? std::array<int, 2>{j, i} : std::array<int, 2>{i, j};
  }

  /// Whether a loop is a convex polygon walked once counterclockwise in the projection; `corners` then are its vertices
  /// that are not straight.
  template <class Number>
  bool is_convex(const Loop& loop, int axis, bool mirrored, Loop& corners) const;

  /// Whether two different points of the loops have one projection.
  bool hides_a_point(const std::vector<Loop>& loops, int axis) const;

  template <class Cut>
  Convex_parts project(const std::vector<Loop>& loops, int axis, bool mirrored, std::vector<std::uint32_t>& ids,
                       Cut cut) const;
  static Loop named(const Loop& indices, const std::vector<std::uint32_t>& ids) {
    Loop loop;
    for (const std::uint32_t k : indices) loop.push_back(ids[k]);
    return loop;
  }

  static bool fits(__int128 n) { return n < (__int128{1} << 62) + 1 && n > -(__int128{1} << 62) - 1; }
  Plane intern(const Vector<__int128>& n, __int128 d);
  Plane intern(const Vector<Fixed_integer<4>>& n, const Fixed_integer<4>& d);
  Plane intern(const Vector<Integer>& n, const Integer& d) { return planes_.intern(n[0], n[1], n[2], d); }

  /// Adds a convex piece. Each edge is bounded by the plane through it parallel to the dominant axis of the normal:
  /// half as many bits as a face plane, and one plane for edges that project to one line. With s the sign of
  /// normal[axis], (s unit x edge) points inward, since (s unit x edge) . (normal x edge) = s normal[axis] |edge|^2 >
  /// 0. Proof: P-05
  template <class Number>
  void add_piece(Face_id f, std::uint32_t number, const Vector<Number>& normal, const Loop& loop);

  std::string file_;
  Integer scale_ = 1, unit_ = 1;
  std::array<Integer, 3> offset_;
  std::array<std::array<Integer, 3>, 2> box_;
  int bits_read_ = 0;
  Grid_points points_;
  Plane_table planes_;
  Point_planes incidences_;
  std::vector<Piece> pieces_;
  std::vector<Piece_corner> corners_;
  std::vector<Set_aside> set_aside_;
  std::vector<Face_id> non_planar_, concave_;
  Scene_counters counters_;
};

}  // namespace sightline
