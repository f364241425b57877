#pragma once
// What an algorithm that partitions space by planes needs of its geometry: the concept, and convex polygons over any
// model of it.

#include <sightline/kernel/plane.h>
#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/vertex.h>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
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
///   t.meet(i, from, to, s, cutter)  where the edge of piece i from corner `from` (side s, not zero) to corner `to`
///   (side -s) meets the plane t.bound(cutter, s)     the Edge that keeps side s of the plane t.same_plane(g, h),
///   t.same_sense(g, h)   known to be one plane (may miss it, but not for one id); whether coplanar planes face alike
///   t.side(eye, h, counts) the side of a viewpoint
///   t.is_input(v)          whether a vertex is an input vertex
///   t.axis_plane(k, v)     the plane across axis k through an input vertex, if the vertex is one
///   t.coordinate(v, k)     roughly, for choosing among planes; never for deciding
///
/// Laws: side(v, prepare(h)) == -side(v, prepare(h.opposite())); same_plane(g, h) implies side(v, g) == +-side(v, h);
/// side(meet(.., cutter), cutter) == 0; exact models obey them, inexact ones (float, double, Epick's constructions) do
/// not, and algorithms must end all the same. Models: Exact_traits (planes, exact, the default), Point_traits<K> (any
/// CGAL kernel), Lockstep_traits<A, B> (both, compared).
template <class T>
concept Partition_traits = requires(const T t, typename T::Vertex v, typename T::Cutter cutter, typename T::Eye eye,
                                    Plane h, Sign s, Predicate_counts counts, std::uint32_t i, const Corner<T>& corner,
                                    int axis, void (*visit)(typename T::Vertex, typename T::Edge)) {
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
  { t.is_input(v) } -> std::same_as<bool>;
  { t.axis_plane(axis, v) } -> std::same_as<std::optional<Plane>>;
  { t.coordinate(v, axis) } -> std::same_as<double>;
};

/// Asks for the memory that a test of the polygon will read, without waiting for it: first where its corners are, and
/// then, once those are there, its vertices. Polygons of a large cell lie far apart, and a processor waits longer for
/// two of these in a row than a test takes.
template <class Traits>
void fetch_corners(const Convex_polygon<Traits>& polygon) {
  __builtin_prefetch(polygon.corners);
}
template <class Traits>
void fetch_vertices(const Convex_polygon<Traits>& polygon) {
  for (std::uint32_t k = 0; k < std::min(polygon.size, 3u); ++k) __builtin_prefetch(polygon.corners[k].vertex);
}

/// Bounded_traits: Partition_traits that also say where things are in doubles, and how wrong those may be: what a
/// spatial index needs.
///
///   t.approximate(v)       a vertex, with a bound on the error of each coordinate
///   t.approximate(h)       an oriented plane, in the same unit, up to a common factor: each coefficient within a
///   relative 2^-51
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

  Polygon_store() = default;
  Polygon_store(Polygon_store&&) = default;
  Polygon_store& operator=(Polygon_store&&) = default;

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
    traits.append_corners(i, [&](Vertex vertex, typename Traits::Edge edge) {
      scratch_.push_back({add(std::move(vertex)), edge});
    });
    return keep(scratch_, i, traits.supporting_plane(i));
  }
  /// A list that lives as long as the store.
  template <class T>
  std::span<T> list(std::span<const T> items) {
    static_assert(std::is_trivially_destructible_v<T>);
    T* const kept = static_cast<T*>(room(items.size_bytes(), alignof(T)));
    std::uninitialized_copy(items.begin(), items.end(), kept);
    return {kept, items.size()};
  }
  Convex_polygon<Traits> keep(std::span<const Corner<Traits>> corners, std::uint32_t piece, Plane support) {
    if (corners.size() < spare_.size() && !spare_[corners.size()].empty()) {
      Corner<Traits>* const again = spare_[corners.size()].back();
      spare_[corners.size()].pop_back();
      std::copy(corners.begin(), corners.end(), again);
      return {again, static_cast<std::uint32_t>(corners.size()), piece, support};
    }
    return {list(corners).data(), static_cast<std::uint32_t>(corners.size()), piece, support};
  }
  /// Takes the list of corners of a polygon that nobody needs any more, for another. Pre: a store made it that lives as
  /// long as this one.
  void reuse(const Convex_polygon<Traits>& polygon) {
    if (polygon.size < spare_.size()) spare_[polygon.size].push_back(const_cast<Corner<Traits>*>(polygon.corners));
  }

 private:
  struct Block {
    std::unique_ptr<std::byte[]> memory;
    std::size_t size, used;
  };
  void* room(std::size_t bytes, std::size_t alignment) {
    const auto aligned = [&](std::size_t used) { return (used + alignment - 1) / alignment * alignment; };
    if (blocks_.empty() || aligned(blocks_.back().used) + bytes > blocks_.back().size) {
      const std::size_t size = std::max(
          bytes, blocks_.empty() ? std::size_t{1} << 12 : std::min(2 * blocks_.back().size, std::size_t{1} << 20));
      blocks_.push_back({std::make_unique_for_overwrite<std::byte[]>(size), size, 0});
    }
    Block& block = blocks_.back();
    void* const start = block.memory.get() + aligned(block.used);
    block.used = aligned(block.used) + bytes;
    return start;
  }

  static constexpr std::size_t chunk = 512;
  std::vector<std::vector<Vertex>> vertices_;
  std::size_t used_ = 0;
  std::vector<Block> blocks_;
  std::array<std::vector<Corner<Traits>*>, 16> spare_;  // lists of corners to use again, by length
  std::vector<Corner<Traits>> scratch_;
};

/// Where a convex polygon lies to a plane.
enum class Position { on = 0, behind = 1, in_front = 2, across = 3 };

/// Working memory of split() and classify(), to be reused from call to call.
template <class Traits>
struct Split_scratch {
  std::vector<Sign> sides;
  std::array<std::vector<Corner<Traits>>, 2> corners;
};

/// The position that a front corner and a corner behind make.
inline Position position_of(bool front, bool behind) { return static_cast<Position>(2 * front + behind); }

/// Where a polygon lies to a plane. Degenerate: one that touches the plane from one side is on that side.
template <class Traits>
Position position(const Traits& traits, const Convex_polygon<Traits>& polygon, const typename Traits::Cutter& cutter,
                  Predicate_counts& counts) {
  bool front = false, behind = false;
  for (const Corner<Traits>& corner : polygon) {
    const Sign s = traits.side(*corner.vertex, cutter, counts);
    front |= s == CGAL::POSITIVE;
    behind |= s == CGAL::NEGATIVE;
  }
  return position_of(front, behind);
}

/// A few planes, to find where polygons lie to all of them at once. Exact_traits has one of its own.
template <class Traits>
class Plane_group {
 public:
  static constexpr std::size_t most = 6;              ///< planes
  using Positions = std::array<std::uint64_t, most>;  ///< of a polygon to each of the planes, as numbers of Position

  /// Pre: 1 to `most` planes.
  void prepare(const Traits& traits, std::span<const Plane> planes) {
    planes_.assign(planes.begin(), planes.end());
    cutters_.clear();
    for (const Plane plane : planes) cutters_.push_back(traits.prepare(plane));
  }
  /// Where each polygon lies to each plane: on those known to be its own, else as position() says.
  void find(const Traits& traits, std::span<const Convex_polygon<Traits>> polygons, Positions* positions,
            Predicate_counts& counts) const {
    for (const Convex_polygon<Traits>& polygon : polygons) {
      for (std::size_t k = 0; k < planes_.size(); ++k) {
        const bool own = traits.same_plane(polygon.support, planes_[k]);
        if (own) ++counts.combinatorial;
        (*positions)[k] =
            static_cast<std::uint64_t>(own ? Position::on : position(traits, polygon, cutters_[k], counts));
      }
      ++positions;
    }
  }

 private:
  std::vector<Plane> planes_;
  std::vector<typename Traits::Cutter> cutters_;
};

/// Where a polygon lies to a plane, as position() says, and the sides of all corners in the scratch, for split().
template <class Traits>
Position classify(const Traits& traits, const Convex_polygon<Traits>& polygon, const typename Traits::Cutter& cutter,
                  Split_scratch<Traits>& scratch, Predicate_counts& counts) {
  if (scratch.sides.size() < polygon.size) scratch.sides.resize(polygon.size);
  bool front = false, behind = false;
  for (std::uint32_t i = 0; i < polygon.size; ++i) {
    const Sign s = traits.side(*polygon.corners[i].vertex, cutter, counts);
    scratch.sides[i] = s;
    front |= s == CGAL::POSITIVE;
    behind |= s == CGAL::NEGATIVE;
  }
  return position_of(front, behind);
}

/// Splits a polygon that is across a plane, as classify() found it with the same scratch. Returns its part behind and
/// its part in front. For an exact model both are convex polygons of at least three corners that tile it and hold the
/// very same crossing vertices. An inexact model may give fewer than three corners.
template <class Traits>
std::array<Convex_polygon<Traits>, 2> split(const Traits& traits, const Convex_polygon<Traits>& polygon,
                                            const typename Traits::Cutter& cutter, Split_scratch<Traits>& scratch,
                                            Polygon_store<Traits>& store) {
  const std::array<typename Traits::Edge, 2> bound{traits.bound(cutter, CGAL::NEGATIVE),
                                                   traits.bound(cutter, CGAL::POSITIVE)};
  // Each corner adds at most two to a part.
  if (scratch.corners[0].size() < 2 * polygon.size) {
    scratch.corners[0].resize(2 * polygon.size);
    scratch.corners[1].resize(2 * polygon.size);
  }
  std::array<Corner<Traits>*, 2> end{scratch.corners[0].data(), scratch.corners[1].data()};
  for (std::uint32_t i = 0; i < polygon.size; ++i) {
    const std::uint32_t after = i + 1 == polygon.size ? 0 : i + 1;
    const Corner<Traits>& corner = polygon.corners[i];
    const Sign here = scratch.sides[i], next = scratch.sides[after];
    if (here == CGAL::ZERO) {
      *end[0]++ = {corner.vertex, next == CGAL::NEGATIVE ? corner.edge : bound[0]};
      *end[1]++ = {corner.vertex, next == CGAL::POSITIVE ? corner.edge : bound[1]};
      continue;
    }
    const std::size_t side = here == CGAL::POSITIVE;
    *end[side]++ = corner;
    if (next == -here) {
      const auto* const crossing = store.add(traits.meet(polygon.piece, corner, polygon.corners[after], here, cutter));
      *end[side]++ = {crossing, bound[side]};
      *end[1 - side]++ = {crossing, corner.edge};
    }
  }
  const auto part = [&](std::size_t side) {
    return store.keep({scratch.corners[side].data(), end[side]}, polygon.piece, polygon.support);
  };
  return {part(0), part(1)};
}

}  // namespace sightline
