#pragma once
// Sets of subranges against one bit for each elementary range.

#include "support.h"

#include <sightline/algorithms/weak_visibility/events/active_subranges.h>

#include <vector>

namespace fuzz {

/// The square root of d / count^2, as one of several fractions.
inline Quadratic_root grid_root(std::size_t d, std::size_t count, unsigned factor) {
  return {Integer(0), 1, Integer(static_cast<unsigned long>(d * factor * factor)),
          Integer(static_cast<unsigned long>(count * factor))};
}

/// Ranges as they follow from bits; the k-th bit is between keys k and k + 1.
inline std::vector<std::array<std::size_t, 2>> runs_of(const std::vector<bool>& bits) {
  std::vector<std::array<std::size_t, 2>> runs;
  for (std::size_t k = 0; k < bits.size(); ++k) {
    if (!bits[k]) continue;
    if (k > 0 && bits[k - 1]) runs.back()[1] = k + 1;
    else runs.push_back({k, k + 1});
  }
  return runs;
}

inline void active_subranges(std::string_view bytes) {
  Bytes from(bytes);
  static constexpr std::array counts{2, 3, 8, 16};
  const auto count = static_cast<std::size_t>(counts[from.below(counts.size())]);
  const std::size_t keys = count * count;  // square roots of 0 to count^2, by count
  const auto key = [&](std::size_t d) { return grid_root(d, count, static_cast<unsigned>(1 + from.below(3))); };
  const auto are_runs = [&](const std::vector<Parameter_range>& ranges, const std::vector<bool>& bits) {
    const auto runs = runs_of(bits);
    return ranges.size() == runs.size() &&
           std::equal(runs.begin(), runs.end(), ranges.begin(), [&](const auto& run, const Parameter_range& range) {
             return range.low == grid_root(run[0], count, 1) && range.high == grid_root(run[1], count, 1);
           });
  };
  const auto drawn = [&](std::vector<bool>& bits) {
    const Parameter_range whole{Quadratic_root(0), Quadratic_root(1)};
    Subrange_list<Quadratic_root> list({whole});
    Subrange_tree<Quadratic_root> tree({whole});
    Active_subranges<Quadratic_root> active(whole);
    bits.assign(keys, true);
    const bool narrow = from.below(2) == 0, comb = from.below(4) == 0;  // a comb leaves as many as there may be
    std::size_t tooth = from.below(3);
    for (std::size_t k = comb ? keys : from.below(narrow ? 96 : 12); k > 0 && !from.empty(); --k) {
      std::size_t low = from.below(comb && k > 8 ? 1 : keys + 1),
                  high = narrow ? std::min(keys, low + from.below(3)) : from.below(keys + 1);
      if (comb && k > 8) {
        if (tooth >= keys) {
          k = 9;
          continue;
        }
        low = tooth;
        high = low + 1;
        tooth += 2;
      }
      for (std::size_t bit = low; bit < high; ++bit) bits[bit] = false;
      list.subtract(key(low), key(high));
      tree.subtract(key(low), key(high));
      active.subtract(key(low), key(high));
      require(tree.empty() == list.empty() && active.empty() == list.empty(), "all sets know whether anything is left");
      if (list.empty()) break;
      require(tree.first().low == list.first().low && tree.first().high == list.first().high &&
                  tree.last().low == list.last().low && tree.last().high == list.last().high &&
                  active.first().low == list.first().low && active.last().high == list.last().high,
              "first and last ranges");
    }
    require(are_runs(list.ranges(), bits), "the list's ranges are those of bits");
    require(are_runs(tree.ranges(), bits), "the tree's ranges are those of bits");
    require(are_runs(active.ranges(), bits), "the set's ranges are those of bits");
    if (list.empty()) {  // nothing is asked of nothing
      subtract_where(active, {}, [](const Rational&) -> bool { throw Finding("a place is looked at in no range"); });
    } else {
      Subrange_tree<Quadratic_root> rest(list.ranges());
      rest.subtract(key(0), list.first().low);
      rest.subtract(list.last().high, key(keys));
      require(are_runs(rest.ranges(), bits), "what is beyond all ranges takes nothing away");
    }
    return active;
  };
  std::vector<bool> a, b;
  const Active_subranges<Quadratic_root> p = drawn(a), q = drawn(b);
  std::vector<bool> either(keys), both(keys);
  for (std::size_t k = 0; k < keys; ++k) {
    either[k] = a[k] || b[k];
    both[k] = a[k] && b[k];
  }
  require(are_runs(merged(p, q).ranges(), either), "merged: what is in either");
  require(are_runs(common(p, q).ranges(), both), "common: what is in both");
}

}  // namespace fuzz
