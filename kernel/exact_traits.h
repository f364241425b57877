#pragma once
// The default model of Partition_traits: plane-defined polygons, exact, on the arithmetic that the scene needs.

#include <sightline/kernel/partition_traits.h>
#include <sightline/kernel/scene/scene.h>

namespace sightline {

/// Vertices are input points or meets of three planes, edges are planes, signs come from the cascade of predicates.h. Exact: yes. Proof: P-05
class Exact_traits {
 public:
  using Vertex = sightline::Vertex;
  struct Edge {
    Plane bound;           ///< the bounding plane, interior in its front
    std::uint32_t beyond;  ///< another plane that is known to hold the edge (the neighbouring face's), or Vertex::no_plane
  };
  using Cutter = Prepared_plane;
  using Eye = Located_point;
  static constexpr bool is_exact = true;

  /// Pre: the scene outlives the traits, and takes no further planes.
  explicit Exact_traits(const Scene& scene) : scene_(&scene), predicates_(scene.predicates()) {}

  const Scene& scene() const { return *scene_; }
  const Predicates& predicates() const { return predicates_; }

  std::size_t piece_count() const { return scene_->pieces().size(); }
  Face_id face(std::uint32_t piece) const { return scene_->pieces()[piece].face; }
  Plane supporting_plane(std::uint32_t piece) const { return scene_->pieces()[piece].support; }
  template <class Function>
  void append_corners(std::uint32_t i, Function function) const {
    const Piece& piece = scene_->pieces()[i];
    const std::span<const Piece_corner> corners = scene_->corners(piece);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Piece_corner& before = corners[k == 0 ? corners.size() - 1 : k - 1];
      const std::uint32_t next = corners[k + 1 == corners.size() ? 0 : k + 1].point;
      const std::uint32_t beyond = scene_->incidences().other_plane(corners[k].point, next, piece.support.id());
      function(predicates_.input_vertex(corners[k].point, piece.support.id(), before.edge.id(), corners[k].edge.id()), Edge{corners[k].edge, beyond});
    }
  }

  Cutter prepare(Plane plane) const { return predicates_.prepare(plane); }
  Sign side(const Vertex& v, const Cutter& cutter, Predicate_counts& counts) const { return predicates_.side(v, cutter, counts); }
  Vertex meet(std::uint32_t piece, const Corner<Exact_traits>& from, const Corner<Exact_traits>&, Sign, const Cutter& cutter) const {
    return predicates_.meet(supporting_plane(piece).id(), from.edge.bound.id(), cutter.plane.id(), from.edge.beyond);
  }
  Edge bound(const Cutter& cutter, Sign keep) const { return {keep == CGAL::POSITIVE ? cutter.plane : cutter.plane.opposite(), Vertex::no_plane}; }
  bool same_plane(Plane g, Plane h) const { return g.id() == h.id(); }
  bool same_sense(Plane g, Plane h) const { return g == h; }  // planes of faces are interned

  Eye eye(const Exact_point& p) const { return scene_->locate(p); }
  Sign side(const Eye& eye, Plane plane, Predicate_counts& counts) const { return predicates_.side(eye, plane, counts); }

  std::optional<Plane> axis_plane(int axis, const Vertex& v) const {
    if (!v.is_input()) return std::nullopt;
    const Plane known = scene_->planes().find_axis_plane(axis, scene_->points().coordinate(v.point, axis), scene_->points().limbs());
    return known.valid() ? known : Plane::across(axis, v.point);
  }
  double coordinate(const Vertex& v, int axis) const { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
  Approximate_point approximate(const Vertex& v) const { return {v.x, v.y, v.z, v.error}; }
  Approximate_plane approximate(Plane plane) const {
    const Prepared_plane h = predicates_.prepare(plane);
    return {h.a, h.b, h.c, h.d, h.exact};
  }

  /// Whether edge k of a polygon, from its corner k on, gains height over a plane. The edge runs along bound x support, as its inside is in front of its bound.
  Sign slope(const Convex_polygon<Exact_traits>& polygon, std::uint32_t k, const Cutter& cutter, Predicate_counts& counts) const {
    return predicates_.orientation(cutter.plane, polygon.corners[k].edge.bound, polygon.support, counts);
  }
  /// The turn from edge k to edge l, counterclockwise seen from the front.
  Sign turn(const Convex_polygon<Exact_traits>& polygon, std::uint32_t k, std::uint32_t l, Predicate_counts& counts) const {
    return predicates_.orientation(polygon.support, polygon.corners[k].edge.bound, polygon.corners[l].edge.bound, counts);
  }

  Exact_point position(const Vertex& v) const { return scene_->position(predicates_.homogeneous(v)); }

 private:
  const Scene* scene_;
  Predicates predicates_;
};

static_assert(Partition_traits<Exact_traits>);

}  // namespace sightline
