#pragma once
// Tanimoto's cut-set, kept from viewpoint to viewpoint: which faces are on-view, and the edges between those and the rest.

#include <sightline/algorithms/cutset/expiry_queue.h>
#include <sightline/algorithms/cutset/on_view.h>

namespace sightline {

/// What a move took.
struct Cut_set_counters {
  std::uint64_t tests = 0;     ///< on-view predicates
  std::uint64_t exact = 0;     ///< of these, what doubles could not decide
  std::uint64_t changed = 0;   ///< nodes that changed
  std::uint64_t births = 0;    ///< clusters of these of which none was at the cut-set
  std::uint64_t searches = 0;  ///< convex bodies that showed no face, searched for one
  std::uint64_t compared = 0;  ///< pairs of faces compared in these searches
  Cut_set_counters& operator+=(const Cut_set_counters& other) {
    tests += other.tests, exact += other.exact, changed += other.changed, births += other.births, searches += other.searches, compared += other.compared;
    return *this;
  }
};

/// The on-view nodes of a face graph and the cut-set, moved from viewpoint to viewpoint. Whatever the move, and wherever the viewpoint is (in planes, inside bodies, at infinity), the
/// answer is that of testing every node.
/// A node that was tested stays as it is until the viewpoint has moved as far as it was from the node's plane. On a convex body only nodes at the cut-set are watched: what else changes hangs
/// together with a change there, but where a body shows no face at all, and then a walk over it finds one or proves the viewpoint inside. All nodes of other components are watched.
/// Cost of a move: O(watched nodes that ran out + changes and their neighbours), and a walk for each convex body that shows nothing. Memory: about 100 bytes a node. Exact: yes.
/// Ref: Tanimoto 1977. Proof: P-50, P-51
template <Partition_traits Traits>
class Cut_set_tracker {
 public:
  /// Before the first move nothing is on-view. Pre: traits and graph are of one scene and outlive the tracker.
  Cut_set_tracker(const Traits& traits, const Face_graph& graph) : graph_(&graph), tester_(traits, graph), nodes_(graph.size()), place_(graph.edges().size(), nowhere), edges_at_(graph.components().size()), walk_from_(graph.components().size()) {
    for (std::uint32_t i = 0; i < graph.size(); ++i) {
      nodes_[i].everywhere = !graph.is_convex(i);
      if (nodes_[i].everywhere) start_.push_back(i);
    }
    inside_.resize(graph.components().size()), in_dark_.resize(graph.components().size());
    for (std::uint32_t c = 0; c < graph.components().size(); ++c) {
      const Face_graph::Component& component = graph.components()[c];
      walk_from_[c] = component.node;
      if (!component.inside) continue;
      inside_[c] = tester_.locate({*component.inside});
      dark_.push_back(c), in_dark_[c] = true;
    }
  }

  /// Moves the viewpoint. Errors: std::invalid_argument for a direction of length zero; the tracker then is where it was.
  const Cut_set_counters& move_to(const Viewpoint& view) {
    typename On_view<Traits>::Eye next = tester_.locate(view);
    last_ = {}, changed_.clear(), ++frame_;
    const double distance = eye_ ? On_view<Traits>::distance(*eye_, next) : std::numeric_limits<double>::infinity();
    if (distance == 0) return last_;
    eye_ = std::move(next);

    // What ran out on the way: tested, and from what changed on to its neighbours.
    expired_.clear();
    if (const double path = std::nextafter(path_ + distance, std::numeric_limits<double>::infinity()); path < far) path_ = path, queue_.advance(path, expired_);
    else forget_all();
    for (const std::uint32_t i : expired_) nodes_[i].queued = false;
    for (const std::uint32_t i : expired_)
      if (is_watched(i)) look_at(i);
    spread();
    settle(0);

    // Convex bodies without an on-view face.
    std::size_t kept = 0;
    for (std::size_t k = 0; k < dark_.size(); ++k) {
      const std::uint32_t c = dark_[k];
      const std::size_t before = changed_.size();
      if (edges_at_[c] == 0 && walk(c)) {
        spread();
        settle(before);
      }
      if (edges_at_[c] == 0) dark_[kept++] = c;
      else in_dark_[c] = false;
    }
    dark_.resize(kept);

    last_.changed = changed_.size();
    counters_ += last_;
    return last_;
  }

  bool on_view(std::uint32_t node) const { return nodes_[node].on; }
  std::size_t on_view_count() const { return on_view_; }
  /// The edges of the graph between an on-view and an off-view node, in no order that means anything.
  const std::vector<std::uint32_t>& cut_edges() const { return cut_; }
  /// The nodes that the last move changed, each once.
  const std::vector<std::uint32_t>& changed() const { return changed_; }
  /// Of the last move; of all so far.
  const Cut_set_counters& last() const { return last_; }
  const Cut_set_counters& counters() const { return counters_; }
  const Predicate_counts& predicates() const { return predicates_; }

 private:
  struct Node {
    double until = -1;                  // its status holds while the path is no longer than this
    std::uint32_t cut_edges = 0;        // at it
    std::uint32_t met = 0;              // frame in which it changed
    bool on = false, queued = false, everywhere = false;  // everywhere: watched wherever the cut-set is
  };
  static constexpr std::uint32_t nowhere = ~std::uint32_t{0};
  static constexpr double far = 0x1p1000;

  bool is_watched(std::uint32_t i) const { return nodes_[i].everywhere || nodes_[i].cut_edges > 0; }

  /// Makes the status of a node known; one that changed is spread later.
  void look_at(std::uint32_t i) {
    Node& node = nodes_[i];
    if (node.until >= path_) return;
    const auto answer = tester_.test(i, *eye_, predicates_);
    ++last_.tests, last_.exact += answer.clear == 0;
    node.until = std::max(path_, std::min(std::nextafter(path_ + answer.clear, 0.0), far));  // rounded down
    if (is_watched(i)) watch(i);
    if (answer.on == node.on) return;
    node.on = answer.on, node.met = frame_;
    answer.on ? ++on_view_ : --on_view_;
    changed_.push_back(i), stack_.push_back(i);
  }
  void watch(std::uint32_t i) {
    if (nodes_[i].queued) return;
    nodes_[i].queued = true;
    queue_.push(nodes_[i].until, i);
  }
  /// Looks at the neighbours of what changed, and at theirs.
  void spread() {
    while (!stack_.empty()) {
      const std::uint32_t i = stack_.back();
      stack_.pop_back();
      for (const std::uint32_t e : graph_->edges_of(i)) look_at(graph_->across(e, i));
    }
  }

  /// Brings the cut-set up to the changes from number `begin` on, and counts births.
  void settle(std::size_t begin) {
    // Clusters: their members' frames become 0 as they are found.
    for (std::size_t k = begin; k < changed_.size(); ++k) {
      if (nodes_[changed_[k]].met != frame_) continue;
      bool at_cut = false;
      const auto take = [&](std::uint32_t i) {
        nodes_[i].met = 0, at_cut |= nodes_[i].cut_edges > 0;
        stack_.push_back(i);
      };
      take(changed_[k]);
      while (!stack_.empty()) {
        const std::uint32_t i = stack_.back();
        stack_.pop_back();
        for (const std::uint32_t e : graph_->edges_of(i))
          if (const std::uint32_t j = graph_->across(e, i); nodes_[j].met == frame_) take(j);
      }
      last_.births += !at_cut;
    }
    // An edge between two nodes that changed is turned over twice.
    for (std::size_t k = begin; k < changed_.size(); ++k)
      for (const std::uint32_t e : graph_->edges_of(changed_[k])) turn_over(e);
    for (std::size_t k = begin; k < changed_.size(); ++k)
      for (const std::uint32_t e : graph_->edges_of(changed_[k])) {
        const Face_graph::Edge& edge = graph_->edges()[e];
        if (place_[e] != nowhere) watch(edge.first), watch(edge.second);
      }
  }
  void turn_over(std::uint32_t e) {
    const Face_graph::Edge& edge = graph_->edges()[e];
    const std::uint32_t c = graph_->component(edge.first);
    if (place_[e] == nowhere) {
      place_[e] = static_cast<std::uint32_t>(cut_.size());
      cut_.push_back(e);
      ++nodes_[edge.first].cut_edges, ++nodes_[edge.second].cut_edges, ++edges_at_[c];
      return;
    }
    place_[cut_.back()] = place_[e];
    cut_[place_[e]] = cut_.back();
    cut_.pop_back();
    place_[e] = nowhere;
    --nodes_[edge.first].cut_edges, --nodes_[edge.second].cut_edges;
    if (--edges_at_[c] == 0 && inside_[c] && !in_dark_[c]) in_dark_[c] = true, dark_.push_back(c);
  }

  /// Walks over a convex body, all of whose nodes are held off-view, to an on-view node. False: there is none, the viewpoint is inside or on the body. Each step goes to a node with a higher
  /// ratio of its height below the viewpoint to its depth above the point inside; one that has no higher neighbour is the highest of all. Proof: P-50
  bool walk(std::uint32_t c) {
    ++last_.searches;
    std::uint32_t& at = walk_from_[c];
    look_at(at);
    while (stack_.empty()) {
      std::uint32_t best = at;
      for (const std::uint32_t e : graph_->edges_of(at)) {
        const std::uint32_t j = graph_->across(e, at);
        look_at(j);
        if (!stack_.empty()) break;
        ++last_.compared;
        if (tester_.is_higher(j, best, *eye_, *inside_[c])) best = j;
      }
      if (best == at) break;
      at = best;
    }
    return !stack_.empty();
  }

  /// Where no distance was travelled that means anything: from a point to a direction, from nowhere.
  void forget_all() {
    path_ = 0, queue_ = {};
    for (Node& node : nodes_) node.until = -1, node.queued = false;
    expired_ = start_;
    for (const std::uint32_t e : cut_)
      for (const std::uint32_t i : {graph_->edges()[e].first, graph_->edges()[e].second})
        if (!nodes_[i].everywhere) expired_.push_back(i);
  }

  const Face_graph* graph_;
  On_view<Traits> tester_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> start_;                                     // nodes that are watched everywhere
  std::vector<std::optional<typename On_view<Traits>::Eye>> inside_;    // of convex components
  std::vector<std::uint32_t> cut_, place_, edges_at_, dark_, walk_from_;  // cut-set; place of an edge in it; its edges by component; convex components that may have none; where their walks begin
  std::vector<bool> in_dark_;
  std::optional<typename On_view<Traits>::Eye> eye_;
  double path_ = 0;  // at least the way since the start
  Expiry_queue queue_;
  std::vector<std::uint32_t> expired_, stack_, changed_;
  std::size_t on_view_ = 0;
  std::uint32_t frame_ = 0;
  Cut_set_counters last_, counters_;
  Predicate_counts predicates_;
};

}  // namespace sightline
