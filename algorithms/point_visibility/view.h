#pragma once
// What visibility from a point stands on: planes through the eye, the rays where two of them meet, and the faces as
// linear forms of the ray.

#include <sightline/kernel/plane.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/sign.h>

#include <array>
#include <concepts>
#include <cstdint>

namespace sightline {

/// A plane through the eye by what it is made of, which is always of the input: an edge (two points of the scene), the
/// line where two pieces' planes cross, or where any plane of the scene cuts a piece, a coordinate axis, or a side of
/// the field of view. Planes of equal names are equal; the converse does not hold.
struct Eye_plane_name {
  std::uint32_t a = 0, b = 0;

  static constexpr std::uint32_t kind_mask = 0xF0000000u, axis_kind = 0x80000000u, field_kind = 0x90000000u,
                                 crossing_kind = 0xA0000000u, cut_kind = 0xB0000000u;
  static constexpr Eye_plane_name edge(std::uint32_t p, std::uint32_t q) {
    return p < q ? Eye_plane_name{p, q} : Eye_plane_name{q, p};
  }
  static constexpr Eye_plane_name axis(std::uint32_t k) { return {axis_kind | k, 0}; }
  static constexpr Eye_plane_name field(std::uint32_t k) { return {field_kind | k, 0}; }
  static constexpr Eye_plane_name crossing(std::uint32_t f, std::uint32_t g) {
    return f < g ? Eye_plane_name{crossing_kind | f, g} : Eye_plane_name{crossing_kind | g, f};
  }
  /// `plane`: its id, in a table or as an axis plane's.
  static constexpr Eye_plane_name cut(std::uint32_t f, std::uint32_t plane) { return {cut_kind | f, plane}; }

  constexpr std::uint32_t kind() const { return (a & 0x80000000u) == 0 ? 0 : a & kind_mask; }
  constexpr std::uint32_t index() const { return a & ~kind_mask; }
  constexpr bool is_edge() const { return kind() == 0; }
  constexpr bool has_point(std::uint32_t p) const { return is_edge() && (a == p || b == p); }
  friend constexpr bool operator==(Eye_plane_name, Eye_plane_name) = default;
};

struct Approximate_vector {
  double x, y, z;
};
/// The normal of a plane through the eye: each entry within `error`, the sum of magnitudes at most `size`.
struct Approximate_eye_plane {
  std::array<double, 3> normal;
  double size, error;
};

/// The geometry of a scene as seen from an eye. Models: Exact_view, Number_view. Laws of exact models: side() and
/// nearer() are the signs of the rational numbers that they stand for; side(opposite(w), r) == -side(w, r); nearer(f,
/// g, r) == -nearer(g, f, r); side(w, meet(w, u)) == ZERO.
///
/// A piece that the eye is not in the plane of is 1/t = q . r for a ray r, t the distance along it: linear, so all that
/// is asked of depth is the sign of a linear form.
template <class V>
concept View = requires(const V& view, const typename V::Plane& w, const typename V::Ray& r, std::uint32_t i,
                        Predicate_counts& counts) {
  { V::is_exact } -> std::convertible_to<bool>;
  { view.scene() } -> std::convertible_to<const Scene&>;
  { view.eye_side(i) } -> std::same_as<Sign>;  ///< of the eye to piece i's plane
  {
    view.edge(i, i)
    } -> std::same_as<typename V::Plane>;  ///< through the eye and points p, q; a ray r is in front iff (p - eye) x (q
                                           ///< - eye) . r > 0
  { view.axis(i) } -> std::same_as<typename V::Plane>;  ///< across axis i, its front where the coordinate is larger
  { view.crossing(i, i) } -> std::same_as<typename V::Plane>;  ///< in front of it piece f's plane is nearer than g's
  { view.opposite(w) } -> std::same_as<typename V::Plane>;
  { view.axis_ray(i, true) } -> std::same_as<typename V::Ray>;
  {
    view.meet(w, w, counts)
    } -> std::same_as<typename V::Ray>;  ///< along the product of the two normals. Pre: they are not parallel
  { view.side(w, r, counts) } -> std::same_as<Sign>;
  { view.side(w, i, counts) } -> std::same_as<Sign>;       ///< of a point of the scene
  { view.nearer(i, i, r, counts) } -> std::same_as<Sign>;  ///< POSITIVE where f's plane is met nearer along r than g's
  {
    view.beyond(i, i, counts)
    } -> std::same_as<Sign>;  ///< POSITIVE where point p is on the other side of piece f's plane than the eye
  { view.same_plane(i, i) } -> std::same_as<bool>;
  { view.approximate(w) } -> std::same_as<Approximate_eye_plane>;
  { view.approximate(r) } -> std::same_as<Approximate_vector>;         ///< of any length
  { view.nearness(i, Approximate_vector()) } -> std::same_as<double>;  ///< about 1/t
  {
    view.farthest(i, r)
    } -> std::same_as<double>;  ///< at least the distance along r to piece f's plane, as Piece_boxes measures it;
                                ///< infinite where unknown
  {
    view.position(i, r)
    } -> std::same_as<Exact_point>;  ///< where ray r meets piece i's plane, in the file's coordinates
};

}  // namespace sightline
