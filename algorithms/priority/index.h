#pragma once
// A spatial index of oriented faces for one question: is there a live face that face i may obscure (or that may obscure
// it)?

#include <sightline/algorithms/priority/relation.h>
#include <sightline/kernel/counters.h>
#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/traits/partition_traits.h>
#include <sightline/kernel/vectors.h>
#include <sightline/kernel/vertex.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace sightline {

/// What a search looked at.
struct Index_counters {
  std::uint64_t nodes = 0;  ///< nodes of the index visited
  std::uint64_t hits = 0, misses = 0;
  Relation_counters relation;
  /// Each by its key in reports, in their order; those of the relation among them.
  template <class Visit>
  static void each(Visit visit) {
    visit("index_nodes", &Index_counters::nodes);
    visit("hits", &Index_counters::hits);
    visit("misses", &Index_counters::misses);
    visit("", &Index_counters::relation);
  }
};

/// Which arcs of a face to follow.
enum class Follow { obscured, obscuring };  ///< faces j with i < j; faces j with j < i

/// A tree of boxes over the faces' corners; each node also bounds its faces' planes, and counts the faces that are
/// live. A node is passed over only where doubles prove that none of its faces can have the arc (P-31); faces are asked
/// exactly.
template <Bounded_traits Traits>
class Priority_index {
 public:
  using Relation = Priority_relation<Traits>;

  /// Pre: the relation outlives the index. Post: all faces are live. Cost: O(n log n).
  explicit Priority_index(Relation&&) = delete;
  explicit Priority_index(const Relation& relation) : relation_(&relation) {
    const std::uint32_t n = relation.size();
    measure();
    order_.resize(n);
    place_.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) order_[i] = i;
    if (n > 0) build();
    for (std::uint32_t p = 0; p < n; ++p) {
      place_[order_[p]] = p;
      placed_planes_.push_back(planes_[order_[p]]);
    }
    revive();
  }

  /// Makes all faces live again, but for those that are marked, where there are marks.
  void revive(const std::vector<char>& except = {}) {
    dead_.assign(order_.size(), 0);
    for (std::uint32_t p = 0; p < except.size(); ++p) dead_[p] = except[order_[p]];
    for (std::size_t k = nodes_.size(); k-- > 0;) {
      Node& node = nodes_[k];
      if (node.right == none)
        node.live = static_cast<std::uint32_t>(std::count(dead_.begin() + node.begin, dead_.begin() + node.end, 0));
      else node.live = nodes_[k + 1].live + nodes_[node.right].live;
      tighten(node);
    }
  }
  bool is_live(std::uint32_t face) const { return dead_[place_[face]] == 0; }
  /// Pre: the face is live. Cost: O(log n).
  void remove(std::uint32_t face) {
    dead_[place_[face]] = 1;
    bool changed = true;
    for (std::uint32_t node = leaf_of_[place_[face]]; node != none; node = nodes_[node].parent) {
      --nodes_[node].live;
      changed = changed && tighten(nodes_[node]);
    }
  }

  /// The first live face from place `from` on that `accept` takes, of those that doubles cannot rule out; sets `from`
  /// to the place after it, so that a later call goes on there. Nothing where there is none. `accept(j)` decides
  /// exactly.
  template <class Accept>
  std::optional<std::uint32_t> next(std::uint32_t i, Follow follow, std::uint32_t& from, Index_counters& counters,
                                    Accept accept) const {
    if (nodes_.empty()) return std::nullopt;
    std::array<std::uint32_t, 64> stack;
    std::size_t top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const Node& node = nodes_[stack[--top]];
      if (node.end <= from || node.live == 0) continue;
      ++counters.nodes;
      const bool forth = follow == Follow::obscured;
      if (forth ? ruled_out<1>(node, i) : ruled_out<-1>(node, i)) continue;
      if (node.right != none) {
        stack[top++] = node.right;
        stack[top++] = static_cast<std::uint32_t>(&node - nodes_.data()) + 1;
        continue;
      }
      for (std::uint32_t p = std::max(node.begin, from); p < node.end; ++p)
        if (dead_[p] == 0 && order_[p] != i && !(forth ? plane_rules_out<1>(p, i) : plane_rules_out<-1>(p, i)) &&
            accept(order_[p])) {
          from = p + 1;
          ++counters.hits;
          return order_[p];
        }
    }
    from = static_cast<std::uint32_t>(order_.size());
    ++counters.misses;
    return std::nullopt;
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  static constexpr std::uint32_t leaf_size = 4;
  static constexpr double right_sign = -0.5;  // as slack: integers that are not positive are below 0.5
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  /// In preorder; the left child of a node follows it.
  struct Node {
    Triple low, high;  ///< of corners
    Triple centre;
    Triple normal_low, normal_high;  ///< of planes scaled to largest normal entry 1
    double offset_low, offset_high;  ///< of their values at the centre
    Triple lean;                     ///< the middle of the normals
    double slab_low, slab_high;      ///< of corners along it
    double slack;                    ///< the largest of its planes'
    std::uint32_t begin, end;        ///< places of its faces
    std::uint32_t right, parent, live;
  };
  struct Oriented_plane {
    Triple normal;  ///< largest entry 1
    double offset;
    double slack;  ///< how far its computed values may be off; below 0 where their signs are right
  };

  // ---- The faces in doubles

  void measure() {
    const std::uint32_t n = relation_->size();
    const Traits& traits = relation_->traits();
    first_.resize(n + std::size_t{1});
    planes_.resize(n);
    double range = 0, error = 0;
    std::vector<bool> is_axis_plane;
    for (std::uint32_t i = 0; i < n; ++i) {
      first_[i] = static_cast<std::uint32_t>(corners_.size());
      for (const Corner<Traits>& corner : (*relation_)[i]) {
        const Approximate_point p = traits.approximate(*corner.vertex);
        corners_.push_back({p.x, p.y, p.z});
        for (const double x : corners_.back()) range = std::max(range, std::fabs(x));
        error = std::max(error, p.error);
      }
      const Approximate_plane h = traits.approximate(relation_->plane(i));
      const double largest = std::max({std::fabs(h.a), std::fabs(h.b), std::fabs(h.c)});
      planes_[i] = {{h.a / largest, h.b / largest, h.c / largest}, h.d / largest, 0};
      // Across an axis, in integers: a value is the rounded sum of two, so its sign is right.
      is_axis_plane.push_back(h.exact && largest == 1 && std::fabs(h.a) + std::fabs(h.b) + std::fabs(h.c) == 1);
      if (!(largest > 0x1p-900 && largest < 0x1p900 && std::fabs(planes_[i].offset) < 0x1p900)) usable_ = false;
    }
    first_[n] = static_cast<std::uint32_t>(corners_.size());
    usable_ = usable_ && range < 0x1p900 && error < infinity;
    // Normal entries are at most 1: corners are to blame for 3 error, planes for 7 range 2^-50, sums for 19 range 24 x
    // 2^-53. P-31
    slack_ = 4 * error + 0x1p-42 * range + 0x1p-900;
    for (std::uint32_t i = 0; i < n; ++i) planes_[i].slack = is_axis_plane[i] && error == 0 ? right_sign : slack_;
    for (const Oriented_plane& h : planes_)
      if (!(std::fabs(h.offset) <= 4 * range + 0x1p-900)) usable_ = false;  // it does not pass where its corners are
  }

  // ---- The tree

  void build() {
    const std::uint32_t n = static_cast<std::uint32_t>(order_.size());
    leaf_of_.resize(n);
    // Faces that look the same way are together, so that the bounds of their planes are tight.
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return heading(a) < heading(b); });
    std::array<std::uint32_t, 7> first_of{};
    for (std::uint32_t h = 0; h < 7; ++h)
      first_of[h] = static_cast<std::uint32_t>(
          std::lower_bound(order_.begin(), order_.end(), h,
                           [&](std::uint32_t face, std::uint32_t heading_of) { return heading(face) < heading_of; }) -
          order_.begin());

    struct Range {
      std::uint32_t begin, end, parent;
      bool is_right;
    };
    std::vector<Range> stack{{0, n, none, false}};
    while (!stack.empty()) {
      const Range range = stack.back();
      stack.pop_back();
      const std::uint32_t number = static_cast<std::uint32_t>(nodes_.size());
      if (range.is_right) nodes_[range.parent].right = number;
      nodes_.push_back(bounds(range.begin, range.end));
      nodes_.back().parent = range.parent;
      const std::uint32_t from = heading(order_[range.begin]), to = heading(order_[range.end - 1]);
      if (from == to && range.end - range.begin <= leaf_size) {
        std::fill(leaf_of_.begin() + range.begin, leaf_of_.begin() + range.end, number);
        continue;
      }
      const std::uint32_t middle =
          from == to ? range.begin + (range.end - range.begin) / 2 : first_of[(from + to + 1) / 2];
      if (from == to) divide(range.begin, middle, range.end);
      stack.push_back({middle, range.end, number, true});
      stack.push_back({range.begin, middle, number, false});
    }
  }

  /// Which of six ways a face looks: the axis of its largest normal entry, and its sign.
  std::uint32_t heading(std::uint32_t face) const {
    const Triple& v = planes_[face].normal;
    const std::size_t k = std::fabs(v[0]) >= 1 ? 0 : std::fabs(v[1]) >= 1 ? 1 : 2;
    return static_cast<std::uint32_t>(2 * k + (v[k] > 0));
  }

  /// Divides at the median: of the planes, where all are parallel, else along the axis on which the centres of the
  /// faces' boxes are spread most. Parallel planes in their order make one of the two conditions of an arc all or
  /// nothing in all but two nodes of a level, and the other one is then as good as its bound: no search is led astray.
  /// Divided by place, a city's would be, √n times.
  void divide(std::uint32_t begin, std::uint32_t middle, std::uint32_t end) {
    Triple low = nowhere(1), high = nowhere(-1);
    for (std::uint32_t p = begin; p < end; ++p)
      for (std::size_t k = 0; k < 3; ++k) {
        const double x = centre_of(order_[p], k);
        low[k] = std::min(low[k], x);
        high[k] = std::max(high[k], x);
      }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    const Oriented_plane& first = planes_[order_[begin]];
    const bool parallel = std::all_of(order_.begin() + begin, order_.begin() + end,
                                      [&](std::uint32_t face) { return planes_[face].normal == first.normal; });
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) {
                       if (parallel && planes_[a].offset != planes_[b].offset)
                         return planes_[a].offset < planes_[b].offset;
                       const double x = centre_of(a, axis), y = centre_of(b, axis);
                       return x != y ? x < y : a < b;
                     });
  }
  double centre_of(std::uint32_t face, std::size_t axis) const {
    double low = infinity, high = -infinity;
    for (std::uint32_t c = first_[face]; c < first_[face + 1]; ++c) {
      low = std::min(low, corners_[c][axis]);
      high = std::max(high, corners_[c][axis]);
    }
    return low + (high - low) / 2;
  }

  Node bounds(std::uint32_t begin, std::uint32_t end) const {
    Node node{nowhere(1), nowhere(-1), {},         nowhere(1), nowhere(-1), infinity, -infinity, {},
              infinity,   -infinity,   right_sign, begin,      end,         none,     none,      0};
    for (std::uint32_t p = begin; p < end; ++p)
      for (std::uint32_t c = first_[order_[p]]; c < first_[order_[p] + 1]; ++c)
        for (std::size_t k = 0; k < 3; ++k) {
          node.low[k] = std::min(node.low[k], corners_[c][k]);
          node.high[k] = std::max(node.high[k], corners_[c][k]);
        }
    for (std::uint32_t p = begin; p < end; ++p)
      node.slack = std::max(
          node.slack, planes_[order_[p]].normal == planes_[order_[begin]].normal ? planes_[order_[p]].slack : slack_);
    if (node.slack > 0)  // else values are to have the right sign, which they have at the origin
      for (std::size_t k = 0; k < 3; ++k) node.centre[k] = node.low[k] + (node.high[k] - node.low[k]) / 2;
    for (std::uint32_t p = begin; p < end; ++p) {
      const Oriented_plane& h = planes_[order_[p]];
      double at_centre = h.offset;
      for (std::size_t k = 0; k < 3; ++k) {
        node.normal_low[k] = std::min(node.normal_low[k], h.normal[k]);
        node.normal_high[k] = std::max(node.normal_high[k], h.normal[k]);
        at_centre += h.normal[k] * node.centre[k];
      }
      node.offset_low = std::min(node.offset_low, at_centre);
      node.offset_high = std::max(node.offset_high, at_centre);
    }
    for (std::size_t k = 0; k < 3; ++k) node.lean[k] = (node.normal_low[k] + node.normal_high[k]) / 2;
    for (std::uint32_t p = begin; p < end; ++p)
      for (std::uint32_t c = first_[order_[p]]; c < first_[order_[p] + 1]; ++c) {
        const double along = dot(node.lean, corners_[c]);
        node.slab_low = std::min(node.slab_low, along);
        node.slab_high = std::max(node.slab_high, along);
      }
    return node;
  }

  /// Bounds the live faces of a node only; slab, and offsets at a centre, stay as they were for all. Returns whether
  /// anything changed. Pre: the children are tight. Post: the same bounds whichever order faces died in.
  bool tighten(Node& node) {
    Triple low = nowhere(1), high = nowhere(-1), normal_low = nowhere(1), normal_high = nowhere(-1);
    double offset_low = infinity, offset_high = -infinity;
    const auto join = [](Triple& least, Triple& most, const Triple& least_of, const Triple& most_of) {
      for (std::size_t k = 0; k < 3; ++k) {
        least[k] = std::min(least[k], least_of[k]);
        most[k] = std::max(most[k], most_of[k]);
      }
    };
    if (node.right == none) {
      for (std::uint32_t p = node.begin; p < node.end; ++p) {
        if (dead_[p] != 0) continue;
        for (std::uint32_t c = first_[order_[p]]; c < first_[order_[p] + 1]; ++c)
          join(low, high, corners_[c], corners_[c]);
        join(normal_low, normal_high, placed_planes_[p].normal, placed_planes_[p].normal);
        offset_low = std::min(offset_low, placed_planes_[p].offset);
        offset_high = std::max(offset_high, placed_planes_[p].offset);
      }
    } else {
      for (const Node* child : {&node + 1, &nodes_[node.right]}) {
        if (child->live == 0) continue;
        join(low, high, child->low, child->high);
        join(normal_low, normal_high, child->normal_low, child->normal_high);
        offset_low = std::min(offset_low, child->offset_low);
        offset_high = std::max(offset_high, child->offset_high);
      }
    }
    const bool at_origin = node.slack < 0;
    const bool changed = low != node.low || high != node.high || normal_low != node.normal_low ||
                         normal_high != node.normal_high ||
                         (at_origin && (offset_low != node.offset_low || offset_high != node.offset_high));
    node.low = low;
    node.high = high;
    node.normal_low = normal_low;
    node.normal_high = normal_high;
    if (at_origin) {
      node.offset_low = offset_low;
      node.offset_high = offset_high;
    }
    return changed;
  }
  static Triple nowhere(int sign) { return {sign * infinity, sign * infinity, sign * infinity}; }

  // ---- Ruling out

  /// Whether no face j of the node can have i < j (S = 1) or j < i (S = -1): no corner of the node is on side -S of i's
  /// plane, or no corner of i on side S of any plane of the node. Proof: P-31
  template <int S>
  bool ruled_out(const Node& node, std::uint32_t i) const {
    if (!usable_) return false;
    const Oriented_plane& h = planes_[i];
    if (S * h.offset + least_in_box<S>(node, h.normal) > h.slack) return true;
    if (is_behind<S>(node, i)) return true;
    // The least of S h over the meet of the box with the slab, by h = share lean + rest, for any share.
    const double share = std::clamp(dot(h.normal, node.lean) / dot(node.lean, node.lean), -2.0,
                                    2.0);  // where lean is 0, nothing is ruled out
    const Triple rest{h.normal[0] - share * node.lean[0], h.normal[1] - share * node.lean[1],
                      h.normal[2] - share * node.lean[2]};
    return S * h.offset + std::min(S * share * node.slab_low, S * share * node.slab_high) +
               least_in_box<S>(node, rest) >
           slack_;
  }

  /// Whether no corner of i is on side S of any plane of the node.
  template <int S>
  bool is_behind(const Node& node, std::uint32_t i) const {
    const double base = S > 0 ? node.offset_high : -node.offset_low;
    for (std::uint32_t c = first_[i]; c < first_[i + 1]; ++c) {
      double most = base;  // of S g at the corner, for planes g of the node
      for (std::size_t k = 0; k < 3; ++k) {
        const double arm = S * (corners_[c][k] - node.centre[k]);
        most += std::max(arm * node.normal_low[k], arm * node.normal_high[k]);
      }
      if (most >= -node.slack) return false;
    }
    return true;
  }

  template <int S>
  static double least_in_box(const Node& node, const Triple& v) {
    double least = 0;
    for (std::size_t k = 0; k < 3; ++k) least += std::min(S * v[k] * node.low[k], S * v[k] * node.high[k]);
    return least;
  }

  /// The same for the face at one place.
  template <int S>
  bool plane_rules_out(std::uint32_t place, std::uint32_t i) const {
    if (!usable_ || relation_->has_many_corners(i)) return false;
    const Oriented_plane& g = placed_planes_[place];
    for (std::uint32_t c = first_[i]; c < first_[i + 1]; ++c)
      if (S * (dot(g.normal, corners_[c]) + g.offset) >= -g.slack) return false;
    return true;
  }

  const Relation* relation_;
  std::vector<Triple> corners_;
  std::vector<std::uint32_t> first_;
  std::vector<Oriented_plane> planes_, placed_planes_;  // by face, by place
  double slack_ = 0;
  bool usable_ = true;                  // doubles bound everything
  std::vector<std::uint32_t> order_;    // faces by place
  std::vector<std::uint32_t> place_;    // and back
  std::vector<std::uint32_t> leaf_of_;  // node of each leaf_size places
  std::vector<char> dead_;
  std::vector<Node> nodes_;
};

extern template class Priority_index<Exact_traits>;  // compiled once

}  // namespace sightline
