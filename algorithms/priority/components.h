#pragma once
// Strongly connected components of a priority graph, in an order of priority; and the concept of such a graph.

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sightline {

/// The strongly connected components U_1 .. U_m of a priority graph in a consistent enumeration f: an arc from a member
/// of U_a to one of U_b, a != b, has a < b. So the lowest number has the highest priority, and h(r) = the number of r's
/// component is the partial enumeration of the faces. Post: members of a component ascend.
class Priority_components {
 public:
  Priority_components() = default;
  /// Pre: h(r) < count for each face r, each number taken.
  Priority_components(std::vector<std::uint32_t> h, std::uint32_t count);

  std::size_t size() const { return begin_.empty() ? 0 : begin_.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t c) const {
    return {members_.data() + begin_[c], begin_[c + 1] - begin_[c]};
  }
  /// The partial enumeration: 0-based, lower obscures higher.
  std::uint32_t h(std::uint32_t face) const { return h_[face]; }
  std::size_t faces() const { return h_.size(); }

  std::size_t largest() const;
  /// Components of more than one face.
  std::size_t cyclic() const;

 private:
  std::vector<std::uint32_t> h_, begin_{}, members_;
};

/// A directed graph on faces 0 .. size() - 1 with arcs r1 -> r2 for r1 < r2.
///   g.size(), g.has_arc(i, j)    has_arc may count what it cost
///   components(g)                its components in an order of priority
/// Models: Explicit_priority_graph (a Boost graph), Implicit_priority_graph (no arc is stored).
template <class Graph>
concept Priority_graph = requires(Graph g, std::uint32_t i) {
  { g.size() } -> std::convertible_to<std::size_t>;
  { g.has_arc(i, i) } -> std::same_as<bool>;
  { components(g) } -> std::same_as<Priority_components>;
};

}  // namespace sightline
