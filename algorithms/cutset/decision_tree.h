#pragma once
// Which faces to test in which order, so that the expected number of on-view tests is least: decision trees (Tanimoto
// 1977, figure 2) for any views and likelihood. Laws, tested: an eye of a listed view ends at that view; a test is made
// only if both answers are possible; no tree of tests expects fewer; no binary tree is below the bound, which tests of
// single faces may not reach: a box takes 64/13 tests, the bound and the paper's figure are 62/13.

#include <sightline/algorithms/cutset/view_cells.h>
#include <sightline/kernel/number.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sightline {

/// A set of faces that may be on-view together, and how likely that is, up to a factor common to all. 0: it must be
/// told apart, but costs nothing.
struct Weighted_view {
  std::uint32_t on_view;  ///< bit k: face k
  Rational weight;
};

/// Tests of faces in a table. It starts at steps[0]; a child is the place of a step, or `leaf` + the place of a view.
/// One view alone has no steps.
struct Decision_tree {
  static constexpr std::uint32_t leaf = 1u << 31;
  static constexpr std::size_t most_states = 25'000'000;  ///< beyond these a search is given up, as a rule

  struct Step {
    std::uint32_t face;     ///< the one to test
    std::uint32_t on, off;  ///< where to go on
  };
  std::vector<Step> steps;           ///< parents first
  std::vector<std::uint32_t> views;  ///< sets of on-view faces, each the end of one path
  Rational expected;                 ///< number of tests
  Rational bound;  ///< the least of any binary tree with these weights at its ends (Huffman's), which tests of single
                   ///< faces may not reach
  std::size_t states = 0;  ///< sets of views that were searched

  /// The faces that are on-view, found by `test(face)`, which says whether one is; `tests` counts the calls. Pre: the
  /// answers are those of one of the views.
  template <class Test>
  std::uint32_t run(Test test, unsigned* tests = nullptr) const {
    std::uint32_t at = steps.empty() ? leaf : 0;
    while (!(at & leaf)) {
      if (tests) ++*tests;
      at = test(steps[at].face) ? steps[at].on : steps[at].off;
    }
    return views[at - leaf];
  }
};

/// Each view of an open set of eyes is as likely as any other; one that only eyes in planes have is possible, with
/// weight 0. No face on-view, from the inside of a convex body, is not possible; with `inside` it is, with weight 0.
std::vector<Weighted_view> uniform_likelihood(std::span<const View_cell> cells, bool inside = false);

namespace decision_tree_detail {

/// Costs by keys that are not 0, in one piece of memory: there may be tens of millions.
template <class Number>
class Cost_table {
 public:
  std::size_t size() const { return size_; }
  const Number* find(std::uint64_t key) const {
    const std::size_t place = place_of(key);
    return keys_[place] == key ? &costs_[place] : nullptr;
  }
  /// Pre: the key is new.
  void add(std::uint64_t key, const Number& cost) {
    if (4 * ++size_ > 3 * keys_.size()) {
      std::vector<std::uint64_t> keys(2 * keys_.size());
      std::vector<Number> costs(2 * keys_.size());
      keys.swap(keys_);
      costs.swap(costs_);
      for (std::size_t k = 0; k < keys.size(); ++k)
        if (keys[k] != 0) put(keys[k], costs[k]);
    }
    put(key, cost);
  }

 private:
  std::size_t place_of(std::uint64_t key) const {
    std::uint64_t mixed = key * 0x9E3779B97F4A7C15u;
    mixed = (mixed ^ mixed >> 32) * 0x9E3779B97F4A7C15u;
    std::size_t place = mixed >> (64 - std::countr_zero(keys_.size()));
    while (keys_[place] != 0 && keys_[place] != key) place = (place + 1) & (keys_.size() - 1);
    return place;
  }
  void put(std::uint64_t key, const Number& cost) {
    const std::size_t place = place_of(key);
    keys_[place] = key;
    costs_[place] = cost;
  }
  std::vector<std::uint64_t> keys_ = std::vector<std::uint64_t>(1024);
  std::vector<Number> costs_ = std::vector<Number>(1024);
  std::size_t size_ = 0;
};

/// The search, on integer weights. A set of views that tests lead to is named by two sets of faces: those that all its
/// views have on-view, and those that some have. It is all views between these two, and the faces of the second that
/// are not in the first are the ones worth a test. Proof: P-53
template <class Number>
class Search {
 public:
  struct View {
    std::uint32_t on_view;
    Number weight;
  };

  Search(std::vector<View> views, std::size_t most_states, const std::function<void()>& ask)
      : views_(std::move(views)), most_states_(most_states), ask_(ask) {}

  /// Fills in steps, views and states. The result: the sum of weight times tests over the views.
  Number build(Decision_tree& tree) {
    grow(tree, views_);
    tree.states = costs_.size();
    return views_.size() < 2 ? Number(0) : best(views_).cost;
  }
  /// The least such sum of any binary tree with these weights at its ends: the two least ends or subtrees are put
  /// together again and again. Ref: Huffman 1952.
  Number bound() const {
    std::vector<Number> ends, subtrees;
    for (const View& view : views_) ends.push_back(view.weight);
    std::sort(ends.begin(), ends.end());
    Number sum = 0;
    std::size_t e = 0, s = 0;
    const auto take = [&]() -> const Number& {
      return s == subtrees.size() || (e < ends.size() && ends[e] <= subtrees[s]) ? ends[e++] : subtrees[s++];
    };
    while (subtrees.size() + 1 < ends.size()) {
      Number both = take();
      both += take();
      sum += both;
      subtrees.push_back(both);
    }
    return sum;
  }

 private:
  using Views = std::span<View>;

  struct Part {
    std::uint32_t in_all = ~std::uint32_t{0}, in_some = 0;
    std::size_t count = 0;
    Number weight = 0;

    void add(const View& view) {
      in_all &= view.on_view;
      in_some |= view.on_view;
      weight += view.weight;
      ++count;
    }
  };
  struct Choice {
    Number cost;
    std::uint32_t face;
  };

  static std::size_t split(Views views, std::uint32_t face) {
    return static_cast<std::size_t>(
        std::partition(views.begin(), views.end(),
                       [face](const View& view) { return (view.on_view >> face & 1) != 0; }) -
        views.begin());
  }

  /// The cost of a set, and the lowest face that a best tree may test first. Permutes the views. Pre: there are two.
  Choice best(Views views) {
    if (ask_) ask_();
    Part whole;
    for (const View& view : views) whole.add(view);
    std::optional<Choice> found;
    for (std::uint32_t open = whole.in_some & ~whole.in_all; open != 0; open &= open - 1) {
      const std::uint32_t face = static_cast<std::uint32_t>(std::countr_zero(open));
      std::array<Part, 2> parts;  // off, on
      for (const View& view : views) parts[view.on_view >> face & 1].add(view);
      Number cost = whole.weight;
      bool is_split = false;
      for (const std::size_t on : {1, 0}) {
        if (parts[on].count == 1) continue;
        if (parts[on].count == 2) {
          cost += parts[on].weight;
          continue;
        }
        const std::uint64_t key = std::uint64_t{parts[on].in_all} << 32 | parts[on].in_some;
        if (const Number* known = costs_.find(key)) {
          cost += *known;
          continue;
        }
        if (!is_split) {
          split(views, face);
          is_split = true;
        }
        const Number least = best(on ? views.first(parts[1].count) : views.last(parts[0].count)).cost;
        if (costs_.size() >= most_states_)
          throw std::length_error(
              "a best decision tree of these views takes a search of more than " + std::to_string(most_states_) +
              " sets of views: leave out views that cannot occur, or group the faces and search a tree for each group");
        costs_.add(key, least);
        cost += least;
      }
      if (!found || cost < found->cost) found = Choice{cost, face};
    }
    return *found;
  }

  std::uint32_t grow(Decision_tree& tree, Views views) {
    if (views.size() == 1) {
      tree.views.push_back(views[0].on_view);
      return Decision_tree::leaf + static_cast<std::uint32_t>(tree.views.size() - 1);
    }
    const std::uint32_t place = static_cast<std::uint32_t>(tree.steps.size()), face = best(views).face;
    tree.steps.push_back({face, 0, 0});
    const std::size_t count = split(views, face);
    const std::uint32_t on = grow(tree, views.first(count)), off = grow(tree, views.subspan(count));
    tree.steps[place].on = on;
    tree.steps[place].off = off;
    return place;
  }

  std::vector<View> views_;
  std::size_t most_states_;
  const std::function<void()>& ask_;
  Cost_table<Number> costs_;
};

template <class Number, class Convert>
void fill(Decision_tree& tree, const std::map<std::uint32_t, Integer>& weights, const Integer& total,
          std::size_t most_states, const std::function<void()>& ask, Convert convert) {
  std::vector<typename Search<Number>::View> views;
  for (const auto& [on_view, weight] : weights) views.push_back({on_view, convert(weight)});
  Search<Number> search(std::move(views), most_states, ask);
  tree.bound = Rational(Integer(search.bound()), total);
  tree.expected = Rational(Integer(search.build(tree)), total);
  tree.bound.canonicalize();
  tree.expected.canonicalize();
}

}  // namespace decision_tree_detail

/// A tree of on-view tests that tells these views apart with the least expected number of tests; of several, at each
/// step, the one that tests the lowest face. Pre: faces <= 32, all sets are of these, no weight is negative, some
/// weight is positive; else std::invalid_argument. Degenerate: a view that is given twice counts once, with both
/// weights; one view alone takes no test. Cost: all sets of views that tests lead to are searched, at most 3^faces,
/// each in O(faces) times its views. Below 1 ms for a box, a hexagonal prism or an octahedron, 10 ms for a
/// dodecahedron. For all views of a body whose n planes are in general position (g++ -O2):
///     n         8      12     16     20      22      24
///     views     92     298    696    1350    1793    2324
///     states    1766   24115  2.1e5  1.8e6   5.7e6   2.0e7
///     seconds   0.001  0.02   0.3    5       24      107
///     MB                      8      90      200     770
/// So 20 faces in 10 s, 24 in 1 GB. Weights whose sum has more than 57 bits once they are integers take four times as
/// long. Beyond `most_states` states: std::length_error. `ask` is called for each; what it throws ends it. Exact: yes.
/// Proof: P-53
Decision_tree least_tests(std::span<const Weighted_view> views, unsigned faces,
                          std::size_t most_states = Decision_tree::most_states, const std::function<void()>& ask = {});

}  // namespace sightline
