#pragma once
// Sorting by small numbers.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sightline {

/// Brings items into the order of a key below `keys`, those with the same key in the order that they had; and says
/// where those of each key begin, and at the end how many there are. Cost: O(items + keys).
template <class Item>
std::vector<std::size_t> in_order_of(std::vector<Item>& items, std::size_t keys, std::uint32_t Item::*key) {
  std::vector<std::size_t> first(keys + 1);
  for (const Item& item : items) ++first[item.*key];
  std::size_t sum = 0;
  for (std::size_t& f : first) sum += std::exchange(f, sum);
  std::vector<std::size_t> next = first;
  std::vector<Item> sorted(items.size());
  for (Item& item : items) sorted[next[item.*key]++] = std::move(item);
  items = std::move(sorted);
  return first;
}

}  // namespace sightline
