#pragma once
// Disjoint sets of things 0 to n - 1.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace sightline {

/// Each set is known by its first member. Cost: of n operations O(n log n).
struct Union_find {
  std::vector<std::uint32_t> parent;
  explicit Union_find(std::size_t n) : parent(n) { std::iota(parent.begin(), parent.end(), 0u); }
  std::uint32_t find(std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  void join(std::uint32_t i, std::uint32_t j) {
    i = find(i);
    j = find(j);
    parent[std::max(i, j)] = std::min(i, j);
  }
  /// Numbers of the sets, in the order of their first members, which are added to `first`, an empty list.
  std::vector<std::uint32_t> numbers(std::vector<std::uint32_t>& first) {
    std::vector<std::uint32_t> number(parent.size());
    for (std::uint32_t i = 0; i < parent.size(); ++i) {
      const std::uint32_t root = find(i);
      if (root == i) {
        number[i] = static_cast<std::uint32_t>(first.size());
        first.push_back(i);
      } else number[i] = number[root];
    }
    return number;
  }
};

}  // namespace sightline
