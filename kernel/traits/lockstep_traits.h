#pragma once
// Two models of Partition_traits side by side: the first decides, the second is asked the same and its mistakes are
// counted.

#include <sightline/kernel/plane.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/traits/partition_traits.h>
#include <sightline/kernel/vertex.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace sightline {

/// Runs model `Judged` in lockstep with the exact model `Truth`: every side is decided by Truth and also asked of
/// Judged, every vertex is made by both. So both see the same queries throughout, and a wrong sign is counted once
/// instead of changing all that follows. Pre: Judged names planes by piece, as Point_traits does; planes asked for are
/// supporting planes of pieces or axis planes. Exact: yes, as Truth is.
template <class Truth, class Judged>
class Lockstep_traits {
 public:
  struct Vertex {
    typename Truth::Vertex truth;
    typename Judged::Vertex judged;
  };
  struct Edge {
    [[no_unique_address]] typename Truth::Edge truth;
    [[no_unique_address]] typename Judged::Edge judged;
  };
  struct Cutter {
    typename Truth::Cutter truth;
    typename Judged::Cutter judged;
  };
  struct Eye {
    typename Truth::Eye truth;
    typename Judged::Eye judged;
  };

  Lockstep_traits(Truth&&, const Judged&) = delete;
  Lockstep_traits(const Truth&, Judged&&) = delete;
  Lockstep_traits(const Truth& truth, const Judged& judged) : truth_(&truth), judged_(&judged) {
    // Judged knows a plane by a piece that lies on it.
    for (std::uint32_t piece = 0; piece < truth.piece_count(); ++piece) {
      const Plane plane = truth.supporting_plane(piece);
      if (plane.id() >= names_.size()) names_.resize(plane.id() + 1);
      if (Plane& name = names_[plane.id()]; !name.valid())
        name = plane.flipped() ? judged.supporting_plane(piece).opposite() : judged.supporting_plane(piece);
    }
  }

  /// Sides asked, and sides that Judged got wrong: a wrong non-zero sign, a zero that is none, a non-zero that is zero.
  struct Mistakes {
    std::uint64_t asked = 0, opposite = 0, false_zero = 0, missed_zero = 0;
    std::uint64_t wrong() const { return opposite + false_zero + missed_zero; }
  };
  Mistakes mistakes() const { return {asked_.load(), opposite_.load(), false_zero_.load(), missed_zero_.load()}; }

  std::size_t piece_count() const { return truth_->piece_count(); }
  std::uint32_t face(std::uint32_t piece) const { return truth_->face(piece); }
  Plane supporting_plane(std::uint32_t piece) const { return truth_->supporting_plane(piece); }
  template <class Function>
  void append_corners(std::uint32_t i, Function function) const {
    std::vector<std::pair<typename Truth::Vertex, typename Truth::Edge>> corners;
    truth_->append_corners(i, [&](const auto& v, const auto& e) { corners.emplace_back(v, e); });
    std::size_t k = 0;
    judged_->append_corners(i, [&](const auto& v, const auto& e) {
      function(Vertex{corners[k].first, v}, Edge{corners[k].second, e});
      ++k;
    });
  }

  Cutter prepare(Plane plane) const { return {truth_->prepare(plane), judged_->prepare(judged_name(plane))}; }
  Sign side(const Vertex& v, const Cutter& cutter, Predicate_counts& counts) const {
    Predicate_counts ignored;
    return compare(truth_->side(v.truth, cutter.truth, counts), judged_->side(v.judged, cutter.judged, ignored));
  }
  Vertex meet(std::uint32_t piece, const Corner<Lockstep_traits>& from, const Corner<Lockstep_traits>& to,
              Sign side_from, const Cutter& cutter) const {
    const Corner<Truth> truth_from{&from.vertex->truth, from.edge.truth}, truth_to{&to.vertex->truth, to.edge.truth};
    const Corner<Judged> judged_from{&from.vertex->judged, from.edge.judged},
        judged_to{&to.vertex->judged, to.edge.judged};
    return {truth_->meet(piece, truth_from, truth_to, side_from, cutter.truth),
            judged_->meet(piece, judged_from, judged_to, side_from, cutter.judged)};
  }
  Edge bound(const Cutter& cutter, Sign keep) const {
    return {truth_->bound(cutter.truth, keep), judged_->bound(cutter.judged, keep)};
  }
  bool same_plane(Plane g, Plane h) const { return truth_->same_plane(g, h); }
  bool same_sense(Plane g, Plane h) const { return truth_->same_sense(g, h); }
  Eye eye(const Exact_point& p) const { return {truth_->eye(p), judged_->eye(p)}; }
  Sign side(const Eye& eye, Plane plane, Predicate_counts& counts) const {
    Predicate_counts ignored;
    return compare(truth_->side(eye.truth, plane, counts), judged_->side(eye.judged, judged_name(plane), ignored));
  }
  bool is_input(const Vertex& v) const { return judged_->is_input(v.judged); }
  std::optional<Plane> axis_plane(int axis, const Vertex& v) const {
    return judged_->axis_plane(axis, v.judged);
  }  // a name that both know
  double coordinate(const Vertex& v, int axis) const { return truth_->coordinate(v.truth, axis); }
  Exact_point position(const Vertex& v) const { return truth_->position(v.truth); }

 private:
  Sign compare(Sign truth, Sign judged) const {
    asked_.fetch_add(1, std::memory_order_relaxed);
    if (truth != judged)
      (truth == CGAL::ZERO    ? missed_zero_
       : judged == CGAL::ZERO ? false_zero_
                              : opposite_)
          .fetch_add(1, std::memory_order_relaxed);
    return truth;
  }
  Plane judged_name(Plane plane) const {
    if (plane.is_axis_plane()) return plane;
    return plane.flipped() ? names_[plane.id()].opposite() : names_[plane.id()];
  }

  const Truth* truth_;
  const Judged* judged_;
  std::vector<Plane> names_;  // Judged's name of each canonical plane of Truth that a piece lies on
  mutable std::atomic<std::uint64_t> asked_{0}, opposite_{0}, false_zero_{0}, missed_zero_{0};
};

}  // namespace sightline
