#pragma once
// The priority relation of Fuchs, Kedem and Naylor: which face may obscure which, from anywhere.
// r1 < r2 ("r1 may obscure r2"): from some eye strictly in front of both planes some ray meets r1 strictly before r2.
// Laws, tested:
//   r1 < r2  iff  some corner of r1 is strictly in front of r2's plane and some corner of r2 strictly behind r1's
//   (P-30); never r < r; with both faces turned round, r1 < r2 becomes r2 < r1; coplanar faces, and faces back to back
//   or face to face, have no arc.

#include <sightline/algorithms/priority/bimodal.h>
#include <sightline/kernel/counters.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/traits/partition_traits.h>

#include <cstdint>
#include <span>
#include <vector>

namespace sightline {

/// What asking for arcs cost.
struct Relation_counters {
  std::uint64_t pairs = 0;  ///< pairs of faces compared corner by corner
  Predicate_counts predicates;
  /// Each by its key in reports, in their order.
  template <class Visit>
  static void each(Visit visit) {
    visit("pairs", &Relation_counters::pairs);
    visit("predicates", &Relation_counters::predicates);
  }
};

/// The arcs between two faces.
struct Arcs {
  bool forth = false;  ///< a < b
  bool back = false;   ///< b < a
};

/// Convex polygons as members of the relation: the pieces of a scene, or what they were cut into. Polygons are 0-based
/// in the order added.
template <Partition_traits Model>
class Priority_relation {
 public:
  using Traits = Model;
  using Polygon = Convex_polygon<Traits>;

  /// All pieces of the scene. Pre: the traits outlive the relation.
  explicit Priority_relation(Traits&&) = delete;
  explicit Priority_relation(const Traits& traits) : traits_(&traits) {
    polygons_.reserve(traits.piece_count());
    cutters_.reserve(traits.piece_count());
    for (std::uint32_t i = 0; i < traits.piece_count(); ++i) add(store_.piece(traits, i));
  }
  /// Of these polygons only. Pre: their corners live as long as the relation.
  Priority_relation(Traits&&, std::span<const Polygon>) = delete;
  Priority_relation(const Traits& traits, std::span<const Polygon> polygons) : traits_(&traits) {
    for (const Polygon& polygon : polygons) add(polygon);
  }
  Priority_relation(Priority_relation&&) = default;

  /// Pre: the polygon's corners live as long as the relation.
  void add(const Polygon& polygon) {
    polygons_.push_back(polygon);
    cutters_.push_back(traits_->prepare(polygon.support));
  }

  const Traits& traits() const { return *traits_; }
  const Priority_relation& faces() const { return *this; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(polygons_.size()); }
  const Polygon& operator[](std::uint32_t i) const { return polygons_[i]; }
  Plane plane(std::uint32_t i) const { return polygons_[i].support; }
  const typename Traits::Cutter& cutter(std::uint32_t i) const { return cutters_[i]; }

  /// Whether i < j. Degenerate: a corner in the other's plane is neither in front nor behind; faces that touch or cross
  /// are judged the same way, and faces that cross obscure each other. Cost: O(corners), ends at the first corner that
  /// decides; O(log corners) where there are many. Exact: as the traits are. Source: Fuchs, Kedem, Naylor 1979,
  /// Theorem. Proof: P-30
  bool may_obscure(std::uint32_t i, std::uint32_t j, Relation_counters& counters) const {
    ++counters.pairs;
    return !known_coplanar(i, j) && has_corner(j, CGAL::NEGATIVE, i, counters) &&
           has_corner(i, CGAL::POSITIVE, j, counters);
  }

  /// Both i < j and j < i, in one look at each corner.
  Arcs arcs(std::uint32_t i, std::uint32_t j, Relation_counters& counters) const {
    ++counters.pairs;
    if (known_coplanar(i, j)) return {};
    if (has_many_corners(i) || has_many_corners(j)) return {may_obscure(i, j, counters), may_obscure(j, i, counters)};
    const unsigned at = static_cast<unsigned>(position(*traits_, polygons_[i], cutters_[j], counters.predicates));
    if (at == static_cast<unsigned>(Position::on)) return {};
    const unsigned to = static_cast<unsigned>(position(*traits_, polygons_[j], cutters_[i], counters.predicates));
    return {(at & in_front) != 0 && (to & behind) != 0, (at & behind) != 0 && (to & in_front) != 0};
  }

  /// Some corner of polygon i strictly on the given side of polygon j's plane: the witness of half an arc. Returns its
  /// place, or i's size. Pre: side != ZERO.
  std::uint32_t find_corner(std::uint32_t i, Sign side, std::uint32_t j, Predicate_counts& counts) const {
    const Polygon& polygon = polygons_[i];
    if constexpr (Slope_traits<Traits>)
      if (has_many_corners(i)) {
        const typename Traits::Cutter cutter =
            side == CGAL::POSITIVE ? cutters_[j] : traits_->prepare(plane(j).opposite());
        const std::uint32_t highest = highest_corner(*traits_, polygon, cutter, counts);
        return traits_->side(*polygon.corners[highest].vertex, cutter, counts) == CGAL::POSITIVE ? highest
                                                                                                 : polygon.size;
      }
    for (std::uint32_t k = 0; k < polygon.size; ++k)
      if (traits_->side(*polygon.corners[k].vertex, cutters_[j], counts) == side) return k;
    return polygon.size;
  }

  /// Whether a face's corners are not all looked at.
  bool has_many_corners(std::uint32_t i) const { return Slope_traits<Traits> && polygons_[i].size > many_corners; }

 private:
  static constexpr unsigned in_front = static_cast<unsigned>(Position::in_front),
                            behind = static_cast<unsigned>(Position::behind);

  // From here on bisection was faster than looking at all (measured: 128 corners 272 ns against 308, 512
  // corners 940 against 371).
  static constexpr std::uint32_t many_corners = 160;
  bool known_coplanar(std::uint32_t i, std::uint32_t j) const { return traits_->same_plane(plane(i), plane(j)); }
  bool has_corner(std::uint32_t i, Sign side, std::uint32_t j, Relation_counters& counters) const {
    return find_corner(i, side, j, counters.predicates) < polygons_[i].size;
  }

  const Traits* traits_;
  std::vector<Polygon> polygons_;
  std::vector<typename Traits::Cutter> cutters_;
  Polygon_store<Traits> store_;
};

extern template class Priority_relation<Exact_traits>;  // compiled once, in relation.cpp

}  // namespace sightline
