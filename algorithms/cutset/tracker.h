#pragma once
// Tanimoto's cut-set, kept from viewpoint to viewpoint: which faces are on-view, and the edges between those and the rest.

#include <sightline/algorithms/cutset/expiry_queue.h>
#include <sightline/algorithms/cutset/on_view.h>

#include <vector>

namespace sightline {

/// What a move took.
struct Cut_set_counters {
  std::uint64_t tests = 0;     ///< on-view predicates
  std::uint64_t away = 0;      ///< of these, of nodes that were not at the cut-set: what finding births takes, and neighbours of what changed
  std::uint64_t exact = 0;     ///< of the tests, what doubles could not decide
  std::uint64_t changed = 0;   ///< nodes that changed
  std::uint64_t births = 0;    ///< clusters of these of which none was at the cut-set
  std::uint64_t searches = 0;  ///< convex bodies that showed no face, searched for one
  std::uint64_t compared = 0;  ///< pairs of faces compared in these searches
  Cut_set_counters& operator+=(const Cut_set_counters& other) {
    tests += other.tests, away += other.away, exact += other.exact, changed += other.changed, births += other.births, searches += other.searches, compared += other.compared;
    return *this;
  }
};

/// The on-view nodes of a face graph and the cut-set, moved from viewpoint to viewpoint. Whatever the move, and wherever the viewpoint is (in planes, inside bodies, at infinity), the
/// answer is that of testing every node.
/// A node that was tested stays as it is until the viewpoint has moved as far as it was from the node's plane. On a convex body only nodes at the cut-set are watched: what else changes hangs
/// together with a change there, but where a body shows no face at all, and then a walk over it finds one or proves the viewpoint inside. All nodes of other components are watched.
/// Cost of a move: O(watched nodes that ran out + changes and their neighbours), and a walk for each convex body that shows nothing. Memory: 64 bytes a node, 20 an edge, 16 for each watched node. Exact: yes.
/// Ref: Tanimoto 1977. Proof: P-50, P-51
template <Partition_traits Traits>
class Cut_set_tracker {
 public:
  /// Before the first move nothing is on-view. Pre: traits and graph are of one scene and outlive the tracker.
  Cut_set_tracker(const Traits& traits, const Face_graph& graph) : graph_(&graph), tester_(traits, graph), nodes_(graph.size()), place_(graph.edges().size(), nowhere), bodies_(graph.components().size()) {
    links_.reserve(2 * graph.edges().size());
    for (std::uint32_t i = 0; i < graph.size(); ++i) {
      Node& node = nodes_[i];
      node.row = tester_.row(i), node.component = graph.component(i), node.everywhere = !graph.is_convex(i);
      node.first_link = static_cast<std::uint32_t>(links_.size());
      for (const std::uint32_t e : graph.edges_of(i)) links_.push_back({graph.across(e, i), e});
      node.links = static_cast<std::uint32_t>(links_.size()) - node.first_link;
      if (node.everywhere) start_.push_back(i);
    }
    for (std::uint32_t c = 0; c < bodies_.size(); ++c) {
      const Face_graph::Component& component = graph.components()[c];
      if (!component.inside) continue;
      bodies_[c].inside = tester_.locate({*component.inside}), bodies_[c].walk_from = component.node;
      bodies_[c].dark = true, dark_.push_back(c);
    }
  }

  /// Moves the viewpoint. Errors: std::invalid_argument for a direction of length zero; the tracker then is where it was.
  const Cut_set_counters& move_to(const Viewpoint& view) {
    typename On_view<Traits>::Eye next = tester_.locate(view);
    last_ = {}, changed_.clear();
    const double distance = eye_ ? On_view<Traits>::distance(*eye_, next) : std::numeric_limits<double>::infinity();
    if (distance == 0) return last_;
    eye_ = std::move(next);

    // What ran out on the way: tested, and from what changed on to its neighbours.
    expired_.clear();
    // A way so long that its last bits are no small steps any more begins anew: 2^77 bounds are 2^30 times the size of scene and viewpoint.
    if (const double path = std::nextafter(path_ + distance, std::numeric_limits<double>::infinity()); path < far && path < 0x1p77 * eye_->bound) path_ = path, queue_.advance(path, expired_);
    else forget_all();
    for (std::size_t k = 0; k < expired_.size(); ++k) {
      if (k + ahead < expired_.size()) fetch(&nodes_[expired_[k + ahead]]);
      Node& node = nodes_[expired_[k]];
      node.queued = false;
      if (is_watched(node)) look_at(expired_[k]);
    }
    spread();
    settle(0);

    // Convex bodies without an on-view face.
    std::size_t kept = 0;
    for (std::size_t k = 0; k < dark_.size(); ++k) {
      const std::uint32_t c = dark_[k];
      const std::size_t before = changed_.size();
      if (bodies_[c].cut_edges == 0 && walk(bodies_[c])) {
        ++last_.births;
        spread();
        settle(before);
      }
      if (bodies_[c].cut_edges == 0) dark_[kept++] = c;
      else bodies_[c].dark = false;
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
  struct alignas(64) Node {  // one line of the cache
    typename On_view<Traits>::Row row;
    double until = -1;                     // its status holds while the path is no longer than this
    std::uint32_t first_link = 0, links = 0, component = 0;
    std::uint32_t cut_edges = 0;           // at it
    bool on = false, queued = false;
    bool everywhere = false;               // watched wherever the cut-set is
    bool met = false;                      // it changed, is watched everywhere, and its cluster is not yet found
    std::uint32_t turned = 0;              // the number of the latest search in which it changed
  };
  /// A neighbour and the edge to it.
  struct Link {
    std::uint32_t node, edge;
  };
  /// An edge between a node that changed and one that did not.
  struct Flip {
    std::uint32_t node;
    Link link;
  };
  /// A component: what is kept of convex bodies.
  struct Body {
    std::optional<typename On_view<Traits>::Eye> inside;
    std::uint32_t cut_edges = 0, walk_from = 0;
    bool dark = false;                     // it is in the list of bodies that may show no face
  };
  static constexpr std::uint32_t nowhere = ~std::uint32_t{0};
  static constexpr double far = 0x1p1000;
  static constexpr std::size_t ahead = 16;

  // On large bodies most of the time of a move is waiting for memory: what is read soon is asked for before.
  static void fetch(const void* place) { __builtin_prefetch(place); }
  std::span<const Link> links(const Node& node) const { return {links_.data() + node.first_link, node.links}; }
  static bool is_watched(const Node& node) { return node.everywhere || node.cut_edges > 0; }

  /// Makes the status of a node known; one that changed is spread later.
  void look_at(std::uint32_t i) {
    Node& node = nodes_[i];
    if (node.until >= path_) return;
    const auto answer = tester_.test(i, node.row, *eye_, predicates_);
    ++last_.tests, last_.away += node.cut_edges == 0, last_.exact += answer.clear == 0;
    node.until = std::max(path_, std::min((path_ + answer.clear) * (1 - 0x1p-52), far));  // rounded down
    if (is_watched(node)) watch(i);
    if (answer.on == node.on) return;
    node.on = answer.on, node.turned = search_, node.met = node.everywhere;
    answer.on ? ++on_view_ : --on_view_;
    changed_.push_back(i), stack_.push_back(i);
    fetch(links_.data() + node.first_link);
  }
  void watch(std::uint32_t i) {
    if (nodes_[i].queued) return;
    nodes_[i].queued = true;
    queue_.push(nodes_[i].until, i);
  }
  /// Looks at the neighbours of what changed, and at theirs. Once it was looked at, a node's status is known: an edge to one that did not change comes into the cut-set, or leaves it, and an edge
  /// between two that changed stays what it was.
  void spread() {
    while (!stack_.empty()) {
      wave_.swap(stack_);
      for (const std::uint32_t i : wave_)
        for (const Link& link : links(nodes_[i])) fetch(&nodes_[link.node]), fetch(&place_[link.edge]);
      for (const std::uint32_t i : wave_)
        for (const Link& link : links(nodes_[i])) {
          look_at(link.node);
          if (nodes_[link.node].turned != search_) flips_.push_back({i, link});
        }
      wave_.clear();
    }
  }

  /// Brings the cut-set up to the changes from number `begin` on, and counts births.
  void settle(std::size_t begin) {
    count_births(begin);
    for (const Flip& flip : flips_) turn_over(flip.node, flip.link);
    for (const Flip& flip : flips_)
      for (const std::uint32_t i : {flip.node, flip.link.node})
        if (nodes_[i].cut_edges > 0) watch(i);
    flips_.clear();
    if (++search_ != 0) return;
    search_ = 1;
    for (Node& node : nodes_) node.turned = 0;
  }
  /// Of what changed, clusters that were not at the cut-set. A convex body has none: there all that changes hangs together with a change at the cut-set, but where it showed no face (P-50).
  void count_births(std::size_t begin) {
    for (std::size_t k = begin; k < changed_.size(); ++k) {
      if (!nodes_[changed_[k]].met) continue;
      bool at_cut = false;
      const auto take = [&](std::uint32_t i) {
        nodes_[i].met = false, at_cut |= nodes_[i].cut_edges > 0;
        stack_.push_back(i);
      };
      take(changed_[k]);
      while (!stack_.empty()) {
        const std::uint32_t i = stack_.back();
        stack_.pop_back();
        for (const Link& link : links(nodes_[i]))
          if (nodes_[link.node].met) take(link.node);
      }
      last_.births += !at_cut;
    }
  }
  void turn_over(std::uint32_t i, const Link& link) {
    Body& body = bodies_[nodes_[i].component];
    std::uint32_t& place = place_[link.edge];
    if (place == nowhere) {
      place = static_cast<std::uint32_t>(cut_.size());
      cut_.push_back(link.edge);
      ++nodes_[i].cut_edges, ++nodes_[link.node].cut_edges, ++body.cut_edges;
      return;
    }
    place_[cut_.back()] = place, cut_[place] = cut_.back();
    cut_.pop_back();
    place = nowhere;
    --nodes_[i].cut_edges, --nodes_[link.node].cut_edges;
    if (--body.cut_edges == 0 && body.inside && !body.dark) body.dark = true, dark_.push_back(nodes_[i].component);
  }

  /// Walks over a convex body, all of whose nodes are held off-view, to an on-view node. False: there is none, the viewpoint is inside or on the body. Each step goes to a node with a higher
  /// ratio of its height below the viewpoint to its depth above the point inside; one that has no higher neighbour is the highest of all. Proof: P-50
  bool walk(Body& body) {
    ++last_.searches;
    std::uint32_t& at = body.walk_from;
    look_at(at);
    while (stack_.empty()) {
      std::uint32_t best = at;
      for (const Link& link : links(nodes_[at])) {
        look_at(link.node);
        if (!stack_.empty()) break;
        ++last_.compared;
        if (tester_.is_higher(link.node, best, *eye_, *body.inside)) best = link.node;
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
        if (!nodes_[i].everywhere && !nodes_[i].queued) nodes_[i].queued = true, expired_.push_back(i);  // once
  }

  const Face_graph* graph_;
  On_view<Traits> tester_;
  std::vector<Node> nodes_;
  std::vector<Link> links_;                        // of all nodes, one after the other
  std::vector<std::uint32_t> start_;              // nodes that are watched everywhere
  std::vector<std::uint32_t> cut_, place_;        // the cut-set; the place of each edge in it
  std::vector<Body> bodies_;                      // by component
  std::vector<std::uint32_t> dark_;               // convex bodies that may show no face
  std::optional<typename On_view<Traits>::Eye> eye_;
  double path_ = 0;  // at least the way since the start
  Expiry_queue queue_;  // of the watched nodes, and of some that no longer are
  std::vector<std::uint32_t> expired_, stack_, wave_, changed_;
  std::vector<Flip> flips_;
  std::uint32_t search_ = 1;  // a move makes one, and one more for each body that showed no face
  std::size_t on_view_ = 0;
  Cut_set_counters last_, counters_;
  Predicate_counts predicates_;
};

}  // namespace sightline
