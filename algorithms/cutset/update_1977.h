#pragma once
// The update of the cut-set as it was published in 1977, to compare with, and to show where it fails. Take tracker.h
// for answers.

#include <sightline/algorithms/cutset/on_view.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/scene/face_graph.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/traits/partition_traits.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace sightline {

/// How the paper is read.
enum class Reading_1977 {
  literal,  ///< an edge is added to the cut-set only as an unchecked neighbour is tested
  mended    ///< the edges of every node that changed are compared anew
};

/// Tanimoto's update for one convex polyhedron: tests both ends of each edge of the cut-set, and searches on from those
/// that changed. Wrong, without notice: literal: wherever a node that changed has a neighbour that was checked already,
/// as an end of another edge; mended: where the faces that were on-view all go and the new ones do not touch them, and
/// where no face was on-view before. Proof: P-50 Cost of an update: about two tests for each edge of the cut-set. Each
/// test is exact. Ref: Tanimoto 1977, section III.
template <Partition_traits Traits>
class Cut_set_1977 {
 public:
  /// Tests every node. Pre: traits and graph are of one scene and outlive this.
  Cut_set_1977(Traits&&, const Face_graph&, const Viewpoint&, Reading_1977) = delete;
  Cut_set_1977(const Traits&, Face_graph&&, const Viewpoint&, Reading_1977) = delete;
  Cut_set_1977(const Traits& traits, const Face_graph& graph, const Viewpoint& start, Reading_1977 reading)
      : graph_(&graph), tester_(traits, graph), reading_(reading), on_(graph.size()), checked_(graph.size(), 0) {
    const auto eye = tester_.locate(start);
    for (std::uint32_t i = 0; i < graph.size(); ++i) {
      rows_.push_back(tester_.row(i));
      on_[i] = tester_.test(i, rows_[i], eye, predicates_).on;
    }
    for (std::uint32_t e = 0; e < graph.edges().size(); ++e)
      if (is_cut(e)) cut_.push_back(e);
  }

  /// The update for a new viewpoint. Returns the number of tests.
  std::uint64_t update_1977(const Viewpoint& view) {
    const auto eye = tester_.locate(view);
    ++frame_;
    std::uint64_t tests = 0;
    std::vector<std::uint32_t> changed, stack;
    const auto check = [&](std::uint32_t i) {
      if (checked_[i] == frame_) return;
      checked_[i] = frame_;
      ++tests;
      if (const bool on = tester_.test(i, rows_[i], eye, predicates_).on; on != on_[i]) {
        on_[i] = on;
        changed.push_back(i);
        stack.push_back(i);
      }
    };
    for (const std::uint32_t e : cut_) {
      check(graph_->edges()[e].first);
      check(graph_->edges()[e].second);
    }
    std::vector<bool> is_changed(graph_->size());
    for (const std::uint32_t i : changed) is_changed[i] = true;
    const auto gone = [&](std::uint32_t e) {
      return is_changed[graph_->edges()[e].first] || is_changed[graph_->edges()[e].second];
    };
    if (reading_ == Reading_1977::literal) std::erase_if(cut_, gone);
    while (!stack.empty()) {
      const std::uint32_t i = stack.back();
      stack.pop_back();
      for (const std::uint32_t e : graph_->edges_of(i)) {
        const std::uint32_t j = graph_->across(e, i);
        if (checked_[j] == frame_) continue;
        check(j);
        if (reading_ == Reading_1977::literal && on_[j] != on_[i]) cut_.push_back(e);
      }
    }
    if (reading_ == Reading_1977::literal) return tests;
    for (const std::uint32_t i : changed)
      for (const std::uint32_t e : graph_->edges_of(i)) cut_.push_back(e);
    std::sort(cut_.begin(), cut_.end());
    cut_.erase(std::unique(cut_.begin(), cut_.end()), cut_.end());
    std::erase_if(cut_, [&](std::uint32_t e) { return !is_cut(e); });
    return tests;
  }

  bool on_view(std::uint32_t node) const { return on_[node]; }
  const std::vector<std::uint32_t>& cut_edges() const { return cut_; }

 private:
  bool is_cut(std::uint32_t e) const { return on_[graph_->edges()[e].first] != on_[graph_->edges()[e].second]; }

  const Face_graph* graph_;
  On_view<Traits> tester_;
  Reading_1977 reading_;
  std::vector<typename On_view<Traits>::Row> rows_;
  std::vector<bool> on_;
  std::vector<std::uint64_t> checked_;  // the update in which a node was tested last
  std::vector<std::uint32_t> cut_;
  std::uint64_t frame_ = 0;
  Predicate_counts predicates_;
};

}  // namespace sightline
