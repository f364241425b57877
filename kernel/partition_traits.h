#pragma once
// What an algorithm that partitions space by planes needs of its geometry: the concept, and convex polygons over any model of it.

#include <sightline/kernel/predicates.h>

#include <concepts>
#include <cstddef>
#include <deque>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

namespace sightline {

/// A corner of a convex polygon: a vertex, and what bounds the polygon between it and the next corner.
template <class Traits>
struct Corner {
  const typename Traits::Vertex* vertex;
  [[no_unique_address]] typename Traits::Edge edge;
};

/// A convex polygon, a part of piece `piece` of the scene, counterclockwise seen from the piece's front.
template <class Traits>
struct Convex_polygon {
  const Corner<Traits>* corners;
  std::uint32_t size;
  std::uint32_t piece;
  Plane support;  ///< the piece's supporting plane

  const Corner<Traits>* begin() const { return corners; }
  const Corner<Traits>* end() const { return corners + size; }
};

/// Partition_traits: planes, vertices and sides for algorithms that split convex polygons by planes.
///
///   T::Vertex, T::Edge     a corner's position; what is remembered of an edge (empty for point-based models)
///   T::Cutter              a plane made ready for many sides
///   T::Eye                 a viewpoint
///   t.piece_count()        pieces of the scene, 0-based
///   t.append_corners(i, f) calls f(Vertex, Edge) for each corner of piece i, counterclockwise
///   t.face(i), t.supporting_plane(i)  the face that piece i is of; its oriented plane
///   t.prepare(h)           the cutter of an oriented plane
///   t.side(v, cutter, counts)    front, on or behind
///   t.meet(i, from, to, s, cutter)  where the edge of piece i from corner `from` (side s, not zero) to corner `to` (side -s) meets the plane
///   t.bound(cutter, s)     the Edge that keeps side s of the plane
///   t.same_plane(g, h), t.same_sense(g, h)   known to be one plane (may miss it); whether coplanar planes face alike
///   t.side(eye, h, counts) the side of a viewpoint
///   t.axis_plane(k, v)     the plane across axis k through an input vertex, if the vertex is one
///   t.coordinate(v, k)     roughly, for choosing among planes; never for deciding
///
/// Laws: side(v, prepare(h)) == -side(v, prepare(h.opposite())); same_plane(g, h) implies side(v, g) == +-side(v, h);
/// side(meet(.., cutter), cutter) == 0; exact models obey them, inexact ones (float, double, Epick's constructions) do not, and algorithms must
/// end all the same.
/// Models: Exact_traits (planes, exact, the default), Point_traits<K> (any CGAL kernel), Lockstep_traits<A, B> (both, compared).
template <class T>
concept Partition_traits = requires(const T t, typename T::Vertex v, typename T::Cutter cutter, typename T::Eye eye, Plane h, Sign s, Predicate_counts counts,
                                    std::uint32_t i, const Corner<T>& corner, int axis, void (*visit)(typename T::Vertex, typename T::Edge)) {
  typename T::Edge;
  { t.piece_count() } -> std::convertible_to<std::size_t>;
  t.append_corners(i, visit);
  { t.face(i) } -> std::same_as<std::uint32_t>;
  { t.supporting_plane(i) } -> std::same_as<Plane>;
  { t.prepare(h) } -> std::same_as<typename T::Cutter>;
  { t.side(v, cutter, counts) } -> std::same_as<Sign>;
  { t.meet(i, corner, corner, s, cutter) } -> std::same_as<typename T::Vertex>;
  { t.bound(cutter, s) } -> std::same_as<typename T::Edge>;
  { t.same_plane(h, h) } -> std::same_as<bool>;
  { t.same_sense(h, h) } -> std::same_as<bool>;
  { t.side(eye, h, counts) } -> std::same_as<Sign>;
  { t.axis_plane(axis, v) } -> std::same_as<std::optional<Plane>>;
  { t.coordinate(v, axis) } -> std::same_as<double>;
};

/// Bounded_traits: Partition_traits that also say where things are in doubles, and how wrong those may be: what a spatial index needs.
///
///   t.approximate(v)       a vertex, with a bound on the error of each coordinate
///   t.approximate(h)       an oriented plane, in the same unit, up to a common factor: each coefficient within a relative 2^-51
/// Models: Exact_traits, Point_traits<K>.
template <class T>
concept Bounded_traits = Partition_traits<T> && requires(const T t, typename T::Vertex v, Plane h) {
  { t.approximate(v) } -> std::same_as<Approximate_point>;
  { t.approximate(h) } -> std::same_as<Approximate_plane>;
};

/// Memory for polygons that live as long as what they were made for. Addresses stay; nothing is freed before the whole.
template <class Traits>
class Polygon_store {
 public:
  using Vertex = typename Traits::Vertex;

  const Vertex* add(Vertex vertex) {
    if (used_ == chunk || vertices_.empty()) {
      vertices_.emplace_back().reserve(chunk);
      used_ = 0;
    }
    ++used_;
    return &vertices_.back().emplace_back(std::move(vertex));
  }
  /// Piece i of the scene as a polygon.
  Convex_polygon<Traits> piece(const Traits& traits, std::uint32_t i) {
    scratch_.clear();
    traits.append_corners(i, [&](Vertex vertex, typename Traits::Edge edge) { scratch_.push_back({add(std::move(vertex)), edge}); });
    return keep(scratch_, i, traits.supporting_plane(i));
  }
  /// A list that lives as long as the store.
  template <class T>
  std::span<T> list(std::span<const T> items) {
    static_assert(std::is_trivially_destructible_v<T>);
    T* const kept = static_cast<T*>(lists_->allocate(items.size() * sizeof(T), alignof(T)));
    std::uninitialized_copy(items.begin(), items.end(), kept);
    return {kept, items.size()};
  }
  Convex_polygon<Traits> keep(std::span<const Corner<Traits>> corners, std::uint32_t piece, Plane support) {
    return {list(corners).data(), static_cast<std::uint32_t>(corners.size()), piece, support};
  }

 private:
  static constexpr std::size_t chunk = 512;
  std::deque<std::vector<Vertex>> vertices_;
  std::size_t used_ = 0;
  std::unique_ptr<std::pmr::monotonic_buffer_resource> lists_ = std::make_unique<std::pmr::monotonic_buffer_resource>();
  std::vector<Corner<Traits>> scratch_;
};

/// Where a convex polygon lies to a plane.
enum class Position { on = 0, behind = 1, in_front = 2, across = 3 };

/// Working memory of split() and classify(), to be reused from call to call.
template <class Traits>
struct Split_scratch {
  std::vector<Sign> sides;
  std::vector<Corner<Traits>> corners;
  std::vector<const typename Traits::Vertex*> crossings;
};

/// The position that a front corner and a corner behind make.
inline Position position_of(bool front, bool behind) { return static_cast<Position>(2 * front + behind); }

/// Where a polygon lies to a plane. Degenerate: one that touches the plane from one side is on that side.
template <class Traits>
Position position(const Traits& traits, const Convex_polygon<Traits>& polygon, const typename Traits::Cutter& cutter, Predicate_counts& counts) {
  bool front = false, behind = false;
  for (const Corner<Traits>& corner : polygon) {
    const Sign s = traits.side(*corner.vertex, cutter, counts);
    front |= s == CGAL::POSITIVE, behind |= s == CGAL::NEGATIVE;
  }
  return position_of(front, behind);
}

/// The same, and the sides of all corners in the scratch, for split().
template <class Traits>
Position classify(const Traits& traits, const Convex_polygon<Traits>& polygon, const typename Traits::Cutter& cutter, Split_scratch<Traits>& scratch, Predicate_counts& counts) {
  if (scratch.sides.size() < polygon.size) scratch.sides.resize(polygon.size);
  bool front = false, behind = false;
  for (std::uint32_t i = 0; i < polygon.size; ++i) {
    const Sign s = traits.side(*polygon.corners[i].vertex, cutter, counts);
    scratch.sides[i] = s;
    front |= s == CGAL::POSITIVE, behind |= s == CGAL::NEGATIVE;
  }
  return position_of(front, behind);
}

/// The part of a polygon on side `keep` of a plane, given in the scratch the sides of its corners and a vertex for each edge that crosses.
/// For an exact model and a polygon across the plane both parts are convex polygons of at least three corners that tile it and hold the very
/// same crossing vertices. An inexact model may give fewer than three corners.
template <class Traits>
Convex_polygon<Traits> part(const Convex_polygon<Traits>& polygon, Sign keep, typename Traits::Edge bound, Split_scratch<Traits>& scratch, Polygon_store<Traits>& store) {
  scratch.corners.clear();
  auto crossing = scratch.crossings.begin();
  for (std::uint32_t i = 0; i < polygon.size; ++i) {
    const Corner<Traits>& corner = polygon.corners[i];
    const Sign here = scratch.sides[i], next = scratch.sides[i + 1 == polygon.size ? 0 : i + 1];
    if (here == keep) {
      scratch.corners.push_back(corner);
      if (next == -keep) scratch.corners.push_back({*crossing++, bound});
    } else if (here == CGAL::ZERO) {
      scratch.corners.push_back({corner.vertex, next == keep ? corner.edge : bound});
    } else if (next == keep) {
      scratch.corners.push_back({*crossing++, corner.edge});
    }
  }
  return store.keep(scratch.corners, polygon.piece, polygon.support);
}

/// Splits a polygon that is across a plane, as classify() found it with the same scratch. Returns its part behind and its part in front.
template <class Traits>
std::array<Convex_polygon<Traits>, 2> split(const Traits& traits, const Convex_polygon<Traits>& polygon, const typename Traits::Cutter& cutter,
                                            Split_scratch<Traits>& scratch, Polygon_store<Traits>& store) {
  scratch.crossings.clear();
  for (std::uint32_t i = 0; i < polygon.size; ++i) {
    const std::uint32_t next = i + 1 == polygon.size ? 0 : i + 1;
    if (scratch.sides[i] * scratch.sides[next] < 0)
      scratch.crossings.push_back(store.add(traits.meet(polygon.piece, polygon.corners[i], polygon.corners[next], scratch.sides[i], cutter)));
  }
  return {part(polygon, CGAL::NEGATIVE, traits.bound(cutter, CGAL::NEGATIVE), scratch, store), part(polygon, CGAL::POSITIVE, traits.bound(cutter, CGAL::POSITIVE), scratch, store)};
}

}  // namespace sightline
