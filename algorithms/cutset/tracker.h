#pragma once
// Tanimoto's cut-set, kept from viewpoint to viewpoint: which faces are on-view, and the edges between those and the
// rest.

#include <sightline/algorithms/cutset/on_view.h>
#include <sightline/algorithms/cutset/watch_list.h>
#include <sightline/kernel/located_point.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/scene/convex_parts.h>
#include <sightline/kernel/scene/face_graph.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/traits/partition_traits.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sightline {

/// What a move took.
struct Cut_set_counters {
  std::uint64_t tests = 0;     ///< on-view predicates
  std::uint64_t away = 0;      ///< of these, of nodes that were not at the cut-set: what finding births takes, and
                               ///< neighbours of what changed
  std::uint64_t exact = 0;     ///< of the tests, what doubles could not decide
  std::uint64_t changed = 0;   ///< nodes that changed
  std::uint64_t births = 0;    ///< clusters of these of which none was at the cut-set
  std::uint64_t searches = 0;  ///< convex bodies that showed no face, searched for one
  std::uint64_t compared = 0;  ///< pairs of faces compared in these searches
  /// Each by its key in reports, in their order.
  template <class Visit>
  static void each(Visit visit) {
    visit("tests", &Cut_set_counters::tests);
    visit("tests_away", &Cut_set_counters::away);
    visit("exact_tests", &Cut_set_counters::exact);
    visit("changed", &Cut_set_counters::changed);
    visit("births", &Cut_set_counters::births);
    visit("searches", &Cut_set_counters::searches);
    visit("compared", &Cut_set_counters::compared);
  }
};

/// The on-view nodes of a face graph and the cut-set, moved from viewpoint to viewpoint. Whatever the move, and
/// wherever the viewpoint is (in planes, inside bodies, at infinity), the answer is that of testing every node. A node
/// that was tested stays as it is until the viewpoint has moved as far as it was from the node's plane. On a convex
/// body only nodes at the cut-set are watched: what else changes hangs together with a change there, but where a body
/// shows no face at all, and then a walk over it finds one or proves the viewpoint inside. All nodes of other
/// components are watched. Cost of a move: O(watched nodes that ran out + changes and their neighbours + watched nodes
/// / 512), and a walk for each convex body that shows nothing. Memory: 64 bytes a node, 20 an edge, 52 for each watched
/// node. Exact: yes. Ref: Tanimoto 1977. Proof: P-50, P-51
template <Partition_traits Traits>
class Cut_set_tracker {
 public:
  /// Before the first move nothing is on-view. Pre: traits and graph are of one scene and outlive the tracker.
  Cut_set_tracker(Traits&&, const Face_graph&) = delete;
  Cut_set_tracker(const Traits&, Face_graph&&) = delete;
  Cut_set_tracker(const Traits& traits, const Face_graph& graph)
      : graph_(&graph),
        tester_(traits, graph),
        nodes_(graph.size()),
        place_(graph.edges().size(), nowhere),
        bodies_(graph.components().size()) {
    links_.reserve(2 * graph.edges().size());
    for (std::uint32_t i = 0; i < graph.size(); ++i) {
      Node& node = nodes_[i];
      node.row = tester_.row(i);
      node.component = graph.component(i);
      node.everywhere = !graph.is_convex(i);
      node.first_link = static_cast<std::uint32_t>(links_.size());
      for (const std::uint32_t e : graph.edges_of(i)) links_.push_back({graph.across(e, i), e});
      node.links = static_cast<std::uint32_t>(links_.size()) - node.first_link;
      if (node.everywhere) update_watch(i);
    }
    for (std::uint32_t c = 0; c < bodies_.size(); ++c) {
      const Face_graph::Component& component = graph.components()[c];
      if (!component.inside) continue;
      bodies_[c].inside = tester_.locate({*component.inside});
      bodies_[c].walk_from = component.node;
      bodies_[c].dark = true;
      dark_.push_back(c);
    }
  }

  /// Moves the viewpoint. Errors: std::invalid_argument for a direction of length zero; the tracker then is where it
  /// was.
  const Cut_set_counters& move_to(const Viewpoint& view) {
    typename On_view<Traits>::Eye next = tester_.locate(view);
    last_ = {};
    changed_.clear();
    const double distance = eye_ ? On_view<Traits>::distance(*eye_, next) : std::numeric_limits<double>::infinity();
    if (distance == 0) return last_;
    eye_ = std::move(next);

    // A way so long that its last bits are no small steps any more begins anew: 2^77 bounds are 2^30 times the size of
    // scene and viewpoint.
    if (const double path = std::nextafter(path_ + distance, std::numeric_limits<double>::infinity());
        path < Watch_list::far && path < 0x1p77 * eye_->bound)
      path_ = path;
    else forget_all();

    // What ran out on the way: tested, and from what changed on to its neighbours.
    open_.clear();
    const Watch_list::Confirmed confirmed = watched_.test(*eye_, path_, open_);
    last_.tests = confirmed.nodes;
    last_.away = confirmed.away;
    predicates_.filtered += confirmed.nodes;
    for (const std::uint32_t i : open_) fetch(&nodes_[i]);
    for (const std::uint32_t i : open_) look_at(i);
    settle(0);

    // Convex bodies without an on-view face.
    std::size_t kept = 0;
    for (std::size_t k = 0; k < dark_.size(); ++k) {
      const std::uint32_t c = dark_[k];
      const std::size_t before = changed_.size();
      if (bodies_[c].cut_edges == 0 && walk(bodies_[c])) {
        ++last_.births;
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
  static constexpr std::uint32_t nowhere = Watch_list::nowhere;
  static constexpr std::size_t ahead = 8;
  /// How a node that changed counts among births.
  enum class Cluster : std::uint8_t {
    none,   ///< not: its body is convex, or its cluster was counted
    away,   ///< it was not at the cut-set
    at_cut  ///< it was
  };
  struct alignas(64) Node {  // one line of the cache
    typename On_view<Traits>::Row row;
    double until = -1;  // its status holds while the path is no longer than this; of a watched one the list knows it
    std::uint32_t first_link = 0, links = 0, component = 0;
    std::uint32_t cut_edges = 0;    // at it
    std::uint32_t place = nowhere;  // in the list of what is watched
    bool on = false;
    bool everywhere = false;  // watched wherever the cut-set is
    bool turned = false;      // it changed, and that is not settled
    Cluster cluster = Cluster::none;
  };
  /// A neighbour and the edge to it.
  struct Link {
    std::uint32_t node, edge;
  };
  /// A component: what is kept of convex bodies.
  struct Body {
    std::optional<typename On_view<Traits>::Eye> inside;
    std::uint32_t cut_edges = 0, walk_from = 0;
    bool dark = false;  // it is in the list of bodies that may show no face
  };

  // What is read soon is asked for before.
  static void fetch(const void* place) { __builtin_prefetch(place); }
  std::span<const Link> links(const Node& node) const { return {links_.data() + node.first_link, node.links}; }
  /// Whether a node's status is that of this move. Once what ran out has been looked at, all that is watched is known.
  bool is_known(const Node& node) const { return node.place != nowhere || node.until >= path_; }

  /// Makes the status of a node known.
  void look_at(std::uint32_t i) {
    Node& node = nodes_[i];
    const auto answer = tester_.test(i, node.row, *eye_, predicates_);
    ++last_.tests;
    last_.away += node.cut_edges == 0;
    last_.exact += answer.clear == 0;
    node.until = std::max(path_, std::min((path_ + answer.clear) * (1 - 0x1p-52), Watch_list::far));  // rounded down
    if (node.place != nowhere) watched_.set_until(node.place, node.until);
    if (answer.on == node.on) return;
    node.on = answer.on;
    node.turned = true;
    if (node.everywhere) node.cluster = node.cut_edges > 0 ? Cluster::at_cut : Cluster::away;
    answer.on ? ++on_view_ : --on_view_;
    changed_.push_back(i);
    fetch(links_.data() + node.first_link);
  }
  /// Watches a node, or no longer, as its cut edges want it. Pre: its status is known, and `until` too where it is
  /// watched and stays so.
  void update_watch(std::uint32_t i) {
    Node& node = nodes_[i];
    if (node.everywhere || node.cut_edges > 0) {
      if (node.place == nowhere) node.place = watched_.take();
      watched_.set(node.place, i, node.row, node.on, node.until, node.cut_edges > 0);
    } else if (node.place != nowhere) {
      node.until = watched_.remove(node.place);
      node.place = nowhere;
    }
  }

  /// From what changed, number `begin` on, to its neighbours and on to theirs. Once it was looked at, a node's status
  /// is known: an edge to one that did not change comes into the cut-set, or leaves it, and an edge between two that
  /// changed stays what it was.
  void settle(std::size_t begin) {
    for (std::size_t k = begin; k < changed_.size(); ++k) {
      if (k + ahead < changed_.size())
        for (const Link& link : links(nodes_[changed_[k + ahead]])) {
          fetch(&nodes_[link.node]);
          fetch(&place_[link.edge]);
        }
      Node& node = nodes_[changed_[k]];
      Body& body = bodies_[node.component];
      for (const Link& link : links(node)) {
        Node& other = nodes_[link.node];
        if (!is_known(other)) look_at(link.node);
        if (other.turned) continue;
        const bool enters = other.on != node.on;
        (enters ? entering_ : leaving_).push_back(link.edge);
        for (std::uint32_t* count : {&node.cut_edges, &other.cut_edges, &body.cut_edges}) *count += enters ? 1u : ~0u;
        if (other.everywhere) watched_.set_at_cut(other.place, other.cut_edges > 0);
        else if ((other.cut_edges > 0) != (other.place != nowhere)) update_watch(link.node);
      }
      update_watch(changed_[k]);
      if (body.cut_edges == 0 && body.inside && !body.dark) {
        body.dark = true;
        dark_.push_back(node.component);
      }
    }
    count_births(begin);
    update_cut();
    for (std::size_t k = begin; k < changed_.size(); ++k) nodes_[changed_[k]].turned = false;
  }
  /// An edge that enters the cut-set takes the place of one that leaves it, where there is one.
  void update_cut() {
    while (!entering_.empty() && !leaving_.empty()) {
      const std::uint32_t place = std::exchange(place_[leaving_.back()], nowhere);
      place_[entering_.back()] = place;
      cut_[place] = entering_.back();
      entering_.pop_back();
      leaving_.pop_back();
    }
    for (const std::uint32_t e : entering_) {
      place_[e] = static_cast<std::uint32_t>(cut_.size());
      cut_.push_back(e);
    }
    for (const std::uint32_t e : leaving_) {
      place_[cut_.back()] = place_[e];
      cut_[place_[e]] = cut_.back();
      cut_.pop_back();
      place_[e] = nowhere;
    }
    entering_.clear();
    leaving_.clear();
  }
  /// Of what changed, clusters that were not at the cut-set. A convex body has none: there all that changes hangs
  /// together with a change at the cut-set, but where it showed no face (P-50).
  void count_births(std::size_t begin) {
    for (std::size_t k = begin; k < changed_.size(); ++k) {
      if (nodes_[changed_[k]].cluster == Cluster::none) continue;
      bool at_cut = false;
      const auto take = [&](std::uint32_t i) {
        at_cut |= std::exchange(nodes_[i].cluster, Cluster::none) == Cluster::at_cut;
        stack_.push_back(i);
      };
      take(changed_[k]);
      while (!stack_.empty()) {
        const std::uint32_t i = stack_.back();
        stack_.pop_back();
        for (const Link& link : links(nodes_[i]))
          if (nodes_[link.node].cluster != Cluster::none) take(link.node);
      }
      last_.births += !at_cut;
    }
  }
  /// Walks over a convex body, all of whose nodes are held off-view, to an on-view node. False: there is none, the
  /// viewpoint is inside or on the body. Each step goes to a node with a higher ratio of its height below the viewpoint
  /// to its depth above the point inside; one that has no higher neighbour is the highest of all. Proof: P-50
  bool walk(Body& body) {
    ++last_.searches;
    std::uint32_t& at = body.walk_from;
    const std::size_t before = changed_.size();
    if (!is_known(nodes_[at])) look_at(at);
    while (changed_.size() == before) {
      std::uint32_t best = at;
      for (const Link& link : links(nodes_[at])) {
        if (!is_known(nodes_[link.node])) look_at(link.node);
        if (changed_.size() != before) break;
        ++last_.compared;
        if (tester_.is_higher(link.node, best, *eye_, *body.inside)) best = link.node;
      }
      if (best == at) break;
      at = best;
    }
    return changed_.size() != before;
  }

  /// Where no distance was travelled that means anything: from a point to a direction, from nowhere.
  void forget_all() {
    path_ = 0;
    watched_.forget_all();
    for (Node& node : nodes_) node.until = -1;
  }

  const Face_graph* graph_;
  On_view<Traits> tester_;
  std::vector<Node> nodes_;
  std::vector<Link> links_;                 // of all nodes, one after the other
  std::vector<std::uint32_t> cut_, place_;  // the cut-set; the place of each edge in it
  std::vector<Body> bodies_;                // by component
  std::vector<std::uint32_t> dark_;         // convex bodies that may show no face
  std::optional<typename On_view<Traits>::Eye> eye_;
  double path_ = 0;  // at least the way since the start
  Watch_list watched_;
  std::vector<std::uint32_t> open_, changed_, entering_, leaving_, stack_;
  std::size_t on_view_ = 0;
  Cut_set_counters last_, counters_;
  Predicate_counts predicates_;
};

extern template class Cut_set_tracker<Exact_traits>;  // compiled once

}  // namespace sightline
