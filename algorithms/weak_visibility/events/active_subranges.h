#pragma once
// Active subranges of an event: what blockers leave of its parameters, as a list while they are few, in a segment tree
// where they are many.

#include <sightline/algorithms/weak_visibility/events/quadratic_roots.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sightline {

/// How parameters are compared: first by what stands beside them in a tree.
template <class Key>
struct Subrange_keys {
  using Near = Key;
  static Near near(const Key& key) { return key; }
  /// Less, equal or greater as the result is to 0; `exact` gives the second key.
  template <class Exact>
  static int order(Near near, const Key&, Near other, Exact) {
    return near < other ? -1 : other < near ? 1 : 0;
  }
};
template <>
struct Subrange_keys<Quadratic_root> {
  using Near = std::int64_t;
  static Near near(const Quadratic_root& key) { return key.key(); }
  template <class Exact>
  static int order(Near near, const Quadratic_root& key, Near other, Exact exact) {
    if (Quadratic_root::are_apart(near, other)) return near < other ? -1 : 1;
    return compare(key, exact());
  }
};

/// Disjoint open ranges in order, in a vector. Each range that is subtracted moves what is behind it.
template <class Key>
class Subrange_list {
 public:
  using Range = Open_range<Key>;

  Subrange_list() = default;
  /// Pre: in order, disjoint.
  explicit Subrange_list(std::vector<Range> ranges) : ranges_(std::move(ranges)) {}

  bool empty() const { return ranges_.empty(); }
  const std::vector<Range>& ranges() const { return ranges_; }
  const Range& first() const { return ranges_.front(); }
  const Range& last() const { return ranges_.back(); }
  void subtract(Key low, Key high);

 private:
  std::vector<Range> ranges_;
};

/// The same in a segment tree: a node divides its range at a key, a leaf is an elementary range, active or not. Keys
/// come with what is subtracted; a node of which nothing is left becomes a leaf. Balanced by priorities at random, the
/// same in each run. Cost: O(log n) to subtract, expected, and what is dropped has been inserted; O(n) for all ranges.
template <class Key>
class Subrange_tree {
 public:
  using Range = Open_range<Key>;

  /// Pre: in order, disjoint, not empty.
  explicit Subrange_tree(const std::vector<Range>& ranges);

  bool empty() const { return root_ == nothing; }
  std::vector<Range> ranges() const;
  /// Pre: not empty.
  Range first() const { return end(true); }
  Range last() const { return end(false); }
  void subtract(Key low, Key high);

 private:
  using Keys = Subrange_keys<Key>;
  using Near = typename Keys::Near;
  using Child = std::uint32_t;
  static constexpr Child nothing = 0, all = 1;  // leaves
  struct Node {
    Near near;
    Child front, back;  // below and above the key
  };
  /// What is subtracted. Each key goes into one node at most.
  struct Cut {
    Key &low, &high;
    Near near_low, near_high;
  };

  Node& node(Child child) { return nodes_[child]; }
  /// At random, the same in each run. Ref: Steele, Lea and Flood 2014
  static std::uint64_t priority(Child child) {
    std::uint64_t mixed = (child + std::uint64_t{1}) * 0x9e3779b97f4a7c15;
    mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9;
    mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111eb;
    return mixed ^ (mixed >> 31);
  }
  Child made(Key& key, Near near, Child front, Child back);
  /// What a cut leaves of a child; whether it begins before the child's range, and whether it ends behind it.
  Child without(Child child, Cut& cut, bool from_low, bool to_high);
  /// A node in its place by priority, of which each child is in its own.
  Child settled(Child child);
  void drop(Child child);
  Range end(bool at_low) const;
  template <class Visit>
  void each(Child child, const Key* low, const Key* high, Visit& visit) const;

  Key low_, high_;
  std::vector<Node> nodes_;
  std::deque<Key> keys_;  // of nodes; large, and hardly ever read
  std::vector<Child> free_;
  Child root_ = all;
};

/// A set of parameters of one event: disjoint open ranges, as large as they can be, of which ranges are subtracted.
/// Convention: a finite number of parameters more or less is the same set. Degenerate: what begins where it ends takes
/// nothing away. Exact: as keys are compared. Ref: Plantinga; Preparata and Shamos 1985. Proof: P-75
template <class Key>
class Active_subranges {
 public:
  using Range = Open_range<Key>;

  Active_subranges() = default;
  explicit Active_subranges(Range whole) : list_(std::vector<Range>{std::move(whole)}) {}
  /// Pre: in order, disjoint.
  explicit Active_subranges(std::vector<Range> ranges) : list_(std::move(ranges)) { grow(); }

  bool empty() const { return tree_ ? tree_->empty() : list_.empty(); }
  /// From the lowest to the highest. Cost: all of them.
  std::vector<Range> ranges() const { return tree_ ? tree_->ranges() : list_.ranges(); }
  /// The lowest, and the highest. Pre: not empty. Cost: O(log n)
  Range first() const { return tree_ ? tree_->first() : list_.first(); }
  Range last() const { return tree_ ? tree_->last() : list_.last(); }
  /// Cost: O(log n) and what disappears, expected.
  void subtract(Key low, Key high) {
    if (tree_) return tree_->subtract(std::move(low), std::move(high));
    list_.subtract(std::move(low), std::move(high));
    grow();
  }
  /// What is in either. Cost: O(n + m)
  friend Active_subranges merged(const Active_subranges& a, const Active_subranges& b) {
    return Active_subranges(united(a.ranges(), b.ranges()));
  }
  /// What is in both. Cost: O(n + m)
  friend Active_subranges common(const Active_subranges& a, const Active_subranges& b) {
    return Active_subranges(intersected(a.ranges(), b.ranges()));
  }

  /// More ranges than this are in a tree: bench_handmade --benchmark_filter=subranges
  static constexpr std::size_t most_listed = 32;

 private:
  static std::vector<Range> united(const std::vector<Range>& a, const std::vector<Range>& b);
  static std::vector<Range> intersected(const std::vector<Range>& a, const std::vector<Range>& b);
  void grow() {
    if (list_.ranges().size() <= most_listed) return;
    tree_.emplace(list_.ranges());
    list_ = {};
  }

  Subrange_list<Key> list_;
  std::optional<Subrange_tree<Key>> tree_;
};

/// Takes away where something holds that changes at roots of polynomials only. `holds(s)` is asked once between two of
/// them. Degenerate: what holds just at a root takes nothing away. Exact: if `holds` is
template <class Holds>
void subtract_where(Active_subranges<Quadratic_root>& active, std::span<const Quadratic> polynomials, Holds holds) {
  if (active.empty()) return;
  for (Parameter_range& part : divided({active.first().low, active.last().high}, polynomials))
    if (holds(inner_rational(part))) active.subtract(std::move(part.low), std::move(part.high));
}

// ---- List

template <class Key>
void Subrange_list<Key>::subtract(Key low, Key high) {
  if (!(low < high)) return;
  // 1. The ranges that it meets.
  const auto first =
      std::partition_point(ranges_.begin(), ranges_.end(), [&](const Range& range) { return !(low < range.high); });
  const auto last = std::partition_point(first, ranges_.end(), [&](const Range& range) { return range.low < high; });
  if (first == last) return;
  // 2. What is left of the first and of the last.
  const bool before = first->low < low, behind = high < (last - 1)->high;
  if (before && behind && last - first == 1) {
    Range rest{std::move(high), std::move(first->high)};
    first->high = std::move(low);
    ranges_.insert(last, std::move(rest));
    return;
  }
  if (before) first->high = std::move(low);
  if (behind) (last - 1)->low = std::move(high);
  ranges_.erase(first + (before ? 1 : 0), last - (behind ? 1 : 0));
}

// ---- Tree

template <class Key>
Subrange_tree<Key>::Subrange_tree(const std::vector<Range>& ranges)
    : low_(ranges.front().low), high_(ranges.back().high), nodes_(2), keys_(2, low_) {
  for (std::size_t k = 1; k < ranges.size(); ++k) subtract(ranges[k - 1].high, ranges[k].low);
}

template <class Key>
typename Subrange_tree<Key>::Child Subrange_tree<Key>::made(Key& key, Near near, Child front, Child back) {
  if (free_.empty()) {
    nodes_.push_back({near, front, back});
    keys_.push_back(std::move(key));
    return static_cast<Child>(nodes_.size() - 1);
  }
  const Child child = free_.back();
  free_.pop_back();
  nodes_[child] = {near, front, back};
  keys_[child] = std::move(key);
  return child;
}

template <class Key>
void Subrange_tree<Key>::subtract(Key low, Key high) {
  if (!(low < high) || !(low < high_) || !(low_ < high)) return;
  Cut cut{low, high, Keys::near(low), Keys::near(high)};
  root_ = without(root_, cut, !(low_ < low), !(high < high_));
}

template <class Key>
typename Subrange_tree<Key>::Child Subrange_tree<Key>::without(Child child, Cut& cut, bool from_low, bool to_high) {
  if (child == nothing) return nothing;
  if (from_low && to_high) {
    drop(child);
    return nothing;
  }
  if (child == all) {
    if (from_low) return made(cut.high, cut.near_high, nothing, all);
    if (to_high) return made(cut.low, cut.near_low, all, nothing);
    const Child above = made(cut.high, cut.near_high, nothing, all);
    return settled(made(cut.low, cut.near_low, all, above));
  }
  const Near near = node(child).near;
  const auto key = [&]() -> const Key& { return keys_[child]; };
  const int low = from_low ? -1 : Keys::order(cut.near_low, cut.low, near, key),
            high = to_high ? 1 : Keys::order(cut.near_high, cut.high, near, key);
  if (low < 0) {
    const Child front = without(node(child).front, cut, from_low, high >= 0);
    node(child).front = front;
  }
  if (high > 0) {
    const Child back = without(node(child).back, cut, low <= 0, to_high);
    node(child).back = back;
  }
  // What is left of a node, and whether its key still divides anything.
  const Child front = node(child).front, back = node(child).back;
  Child rest = child;
  if (front == nothing && back == nothing) rest = nothing;
  else if (front == nothing && back > all && node(back).front == nothing) rest = back;
  else if (back == nothing && front > all && node(front).back == nothing) rest = front;
  if (rest == child) return settled(child);
  free_.push_back(child);
  return rest;
}

template <class Key>
typename Subrange_tree<Key>::Child Subrange_tree<Key>::settled(Child child) {
  const Child front = node(child).front, back = node(child).back;
  const std::uint64_t own = priority(child), before = front > all ? priority(front) : 0,
                      behind = back > all ? priority(back) : 0;
  if (own >= before && own >= behind) return child;
  if (before >= behind) {
    node(child).front = node(front).back;
    const Child lower = settled(child);
    node(front).back = lower;
    return front;
  }
  node(child).back = node(back).front;
  const Child lower = settled(child);
  node(back).front = lower;
  return back;
}

template <class Key>
void Subrange_tree<Key>::drop(Child child) {
  if (child <= all) return;
  std::vector<Child> left{child};
  while (!left.empty()) {
    const Child next = left.back();
    left.pop_back();
    free_.push_back(next);
    for (const Child below : {node(next).front, node(next).back})
      if (below > all) left.push_back(below);
  }
}

template <class Key>
template <class Visit>
void Subrange_tree<Key>::each(Child child, const Key* low, const Key* high, Visit& visit) const {
  if (child == nothing) return;
  if (child == all) return visit(*low, *high);
  each(nodes_[child].front, low, &keys_[child], visit);
  each(nodes_[child].back, &keys_[child], high, visit);
}

template <class Key>
std::vector<Open_range<Key>> Subrange_tree<Key>::ranges() const {
  std::vector<Range> ranges;
  auto visit = [&](const Key& low, const Key& high) { ranges.push_back({low, high}); };
  each(root_, &low_, &high_, visit);
  return ranges;
}

template <class Key>
Open_range<Key> Subrange_tree<Key>::end(bool at_low) const {
  const Key *low = &low_, *high = &high_;
  for (Child child = root_; child != all;) {
    const Node& its = nodes_[child];
    const bool is_front = at_low ? its.front != nothing : its.back == nothing;
    (is_front ? high : low) = &keys_[child];
    child = is_front ? its.front : its.back;
  }
  return {*low, *high};
}

// ---- Two sets

template <class Key>
std::vector<Open_range<Key>> Active_subranges<Key>::united(const std::vector<Range>& a, const std::vector<Range>& b) {
  std::vector<Range> both;
  std::merge(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both),
             [](const Range& x, const Range& y) { return x.low < y.low; });
  std::vector<Range> ranges;
  for (const Range& range : both) {
    if (ranges.empty() || ranges.back().high < range.low) ranges.push_back(range);
    else if (ranges.back().high < range.high) ranges.back().high = range.high;
  }
  return ranges;
}

template <class Key>
std::vector<Open_range<Key>> Active_subranges<Key>::intersected(const std::vector<Range>& a,
                                                                const std::vector<Range>& b) {
  std::vector<Range> ranges;
  for (auto p = a.begin(), q = b.begin(); p != a.end() && q != b.end();) {
    const Key &low = p->low < q->low ? q->low : p->low, &high = p->high < q->high ? p->high : q->high;
    if (low < high) ranges.push_back({low, high});
    const bool p_ends = p->high < q->high;
    if (!p_ends) ++q;
    else ++p;
  }
  return ranges;
}

}  // namespace sightline
