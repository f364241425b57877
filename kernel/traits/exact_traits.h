#pragma once
// The default model of Partition_traits: plane-defined polygons, exact, on the arithmetic that the scene needs.

#include <sightline/kernel/fixed_integer.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/traits/partition_traits.h>
#include <sightline/kernel/vertex.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace sightline {

/// Vertices are input points or meets of three planes, edges are planes, signs come from the cascade of predicates.h.
/// Exact: yes. Proof: P-05
class Exact_traits {
 public:
  using Vertex = sightline::Vertex;
  struct Edge {
    Plane bound;  ///< the bounding plane, interior in its front
    /// Another plane that is known to hold the edge (the neighbouring face's), or Vertex::no_plane.
    std::uint32_t beyond;
  };
  using Cutter = Prepared_plane;
  using Eye = Located_point;
  static constexpr bool is_exact = true;

  /// Pre: the scene outlives the traits, and takes no further planes.
  explicit Exact_traits(Scene&&) = delete;
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
      function(predicates_.input_vertex(corners[k].point, piece.support.id(), before.edge.id(), corners[k].edge.id()),
               Edge{corners[k].edge, beyond});
    }
  }

  Cutter prepare(Plane plane) const { return predicates_.prepare(plane); }
  Sign side(const Vertex& v, const Cutter& cutter, Predicate_counts& counts) const {
    return predicates_.side(v, cutter, counts);
  }
  Vertex meet(std::uint32_t piece, const Corner<Exact_traits>& from, const Corner<Exact_traits>&, Sign,
              const Cutter& cutter) const {
    return predicates_.meet(supporting_plane(piece).id(), from.edge.bound.id(), cutter.plane.id(), from.edge.beyond);
  }
  Edge bound(const Cutter& cutter, Sign keep) const {
    return {keep == CGAL::POSITIVE ? cutter.plane : cutter.plane.opposite(), Vertex::no_plane};
  }
  bool same_plane(Plane g, Plane h) const { return g.id() == h.id(); }
  bool same_sense(Plane g, Plane h) const { return g == h; }  // planes of faces are interned

  Eye eye(const Exact_point& p) const { return scene_->locate(p); }
  Sign side(const Eye& eye, Plane plane, Predicate_counts& counts) const {
    return predicates_.side(eye, plane, counts);
  }

  bool is_input(const Vertex& v) const { return v.is_input(); }
  std::optional<Plane> axis_plane(int axis, const Vertex& v) const {
    if (!v.is_input()) return std::nullopt;
    const Plane known =
        scene_->planes().find_axis_plane(axis, scene_->points().coordinate(v.point, axis), scene_->points().limbs());
    return known.valid() ? known : Plane::across(axis, v.point);
  }
  double coordinate(const Vertex& v, int axis) const { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
  Approximate_point approximate(const Vertex& v) const { return {v.x, v.y, v.z, v.error}; }
  Approximate_plane approximate(Plane plane) const {
    const Prepared_plane h = predicates_.prepare(plane);
    return {h.a, h.b, h.c, h.d, h.exact};
  }

  /// Whether edge k of a polygon, from its corner k on, gains height over a plane. The edge runs along bound x support,
  /// as its inside is in front of its bound.
  Sign slope(const Convex_polygon<Exact_traits>& polygon, std::uint32_t k, const Cutter& cutter,
             Predicate_counts& counts) const {
    return predicates_.orientation(cutter.plane, polygon.corners[k].edge.bound, polygon.support, counts);
  }
  /// The turn from edge k to edge l, counterclockwise seen from the front.
  Sign turn(const Convex_polygon<Exact_traits>& polygon, std::uint32_t k, std::uint32_t l,
            Predicate_counts& counts) const {
    return predicates_.orientation(polygon.support, polygon.corners[k].edge.bound, polygon.corners[l].edge.bound,
                                   counts);
  }

  Exact_point position(const Vertex& v) const { return scene_->position(predicates_.homogeneous(v)); }

 private:
  const Scene* scene_;
  Predicates predicates_;
};

static_assert(Partition_traits<Exact_traits>);

/// A few planes, to find where polygons lie to all of them at once: each corner is read once, and its values at two
/// planes are computed in one go.
template <>
class Plane_group<Exact_traits> {
 public:
  static constexpr std::size_t most = 6;
  using Positions = std::array<std::uint64_t, most>;

  void prepare(const Exact_traits& traits, std::span<const Plane> planes) {
    size_ = planes.size();
    for (std::size_t k = 0; k < size_; ++k) planes_[k] = traits.prepare(planes[k]);
    for (std::size_t k = 0; k < size_; k += 2) {
      const Prepared_plane &g = planes_[k],
                           &h = planes_[std::min(k + 1, size_ - 1)];  // the last one twice where their number is odd
      const auto certain = [](const Prepared_plane& plane) { return plane.exact ? ~std::uint64_t{0} : 0; };
      Two& two = twos_[k / 2];
      two.a = Doubles{g.a, h.a};
      two.b = Doubles{g.b, h.b};
      two.c = Doubles{g.c, h.c};
      two.d = Doubles{g.d, h.d};
      two.norm = Doubles{g.norm, h.norm};
      two.id = Ids{g.plane.id(), g.plane.id(), h.plane.id(), h.plane.id()};
      two.bound[0] = Doubles{g.exact ? 0 : g.bound, h.exact ? 0 : h.bound};
      two.certain[0] = Bits{certain(g), certain(h)};
      two.bound[1] = Doubles{g.bound, h.bound};
      two.certain[1] = Bits{};
    }
  }

  void find(const Exact_traits& traits, std::span<const Convex_polygon<Exact_traits>> polygons, Positions* positions,
            Predicate_counts& counts) const {
    if (size_ <= 2) find_in<1>(traits, polygons, positions, counts);
    else if (size_ <= 4) find_in<2>(traits, polygons, positions, counts);
    else find_in<3>(traits, polygons, positions, counts);
  }

 private:
  using Doubles [[gnu::vector_size(16)]] = double;
  using Bits [[gnu::vector_size(16)]] = std::uint64_t;
  using Ids [[gnu::vector_size(16)]] = std::uint32_t;
  struct Two {
    Doubles a, b, c, d, norm;
    Ids id;                        ///< each twice
    std::array<Doubles, 2> bound;  ///< at vertices that are exact integers, and at others
    std::array<Bits, 2> certain;   ///< whether the value is the true one there
  };

  /// find() for as many pairs of planes; a function of its own, as compilers run out of registers where it is part of a
  /// larger one.
  template <std::size_t Pairs>
  [[gnu::noinline]] void find_in(const Exact_traits& traits, std::span<const Convex_polygon<Exact_traits>> polygons,
                                 Positions* positions, Predicate_counts& counts) const {
    for (const Convex_polygon<Exact_traits>& polygon : polygons) find_one<Pairs>(traits, polygon, *positions++, counts);
  }
  template <std::size_t Pairs>
  void find_one(const Exact_traits& traits, const Convex_polygon<Exact_traits>& polygon, Positions& positions,
                Predicate_counts& counts) const {
    // Predicates::side_filtered() of all corners to all planes: value > bound and value < -bound as the sign bits of
    // bound - value and bound + value. Those are the signs of the true differences, as doubles underflow gradually, and
    // +0 where the two are equal; neither is NaN, as values are finite. Where all is in exact integers the bound is 0
    // and what is neither is zero for certain.
    std::array<Bits, Pairs> front{}, behind{}, known;
    known.fill(~Bits{});
    for (const Corner<Exact_traits>& corner : polygon) {
      const Vertex& v = *corner.vertex;
      const std::size_t inexact = std::bit_cast<std::uint64_t>(v.error) != 0;  // errors are not negative
      for (std::size_t k = 0; k < Pairs; ++k) {
        const Two& h = twos_[k];
        const Doubles value = h.a * v.x + h.b * v.y + h.c * v.z + h.d;
        const Doubles bound = h.bound[inexact] + v.error * h.norm;
        const Bits positive = std::bit_cast<Bits>(bound - value), negative = std::bit_cast<Bits>(bound + value);
        front[k] |= positive;
        behind[k] |= negative;
        known[k] &= positive | negative | h.certain[inexact];
      }
    }
    Bits all = ~Bits{};
    for (std::size_t k = 0; k < Pairs; ++k) {
      const Bits own =
          std::bit_cast<Bits>(twos_[k].id == polygon.support.id());  // all corners are on the polygon's own plane
      const Bits found = ((front[k] >> 62 & 2) | behind[k] >> 63) & ~own;
      positions[2 * k] = found[0];
      positions[2 * k + 1] = found[1];
      known[k] |= own;
      all &= known[k];
    }
    counts.filtered += size_ * polygon.size;
    if ((all[0] & all[1]) >> 63 != 0) return;
    for (std::size_t k = 0; k < size_; ++k)
      if (known[k / 2][k % 2] >> 63 == 0) find_alone(traits, polygon, k, positions, counts);
  }

  /// The position to plane k, where doubles do not tell it.
  [[gnu::noinline]] void find_alone(const Exact_traits& traits, const Convex_polygon<Exact_traits>& polygon,
                                    std::size_t k, Positions& positions, Predicate_counts& counts) const {
    counts.filtered -= polygon.size;
    positions[k] = static_cast<std::uint64_t>(position(traits, polygon, planes_[k], counts));
  }

  std::size_t size_ = 0;
  std::array<Prepared_plane, most> planes_;
  std::array<Two, most / 2> twos_;
};

}  // namespace sightline
