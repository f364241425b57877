#pragma once
// The lines that edges of pieces lie on, numbered as one search meets them.

#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/kernel/line_table.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace sightline {

/// Edges by the lines that they lie on: edges on one line have its number, also where their end points differ. Exact:
/// yes.
class Edge_lines {
 public:
  struct Edge_line {
    Weak_line edge;                       ///< the first edge met on it; the line runs as it does
    std::array<std::uint32_t, 2> points;  ///< that edge's ends
    bool flipped;                         ///< runs against the canonical direction
    Pluecker near;
    Triple from, rest;  ///< its first end, and what that leaves
    Triple along;       ///< the way to the other one
    double reach;       ///< the largest coordinate of its ends
    const Occluders* occluders;
    mutable std::optional<Exact_pluecker> made = {};

    /// Made when it is first asked for, by one thread. Exact: yes.
    const Exact_pluecker& exact() const;
  };
  /// An edge's line: `sense` -1 where it runs the other way.
  struct Edge {
    std::uint32_t line;
    int sense;
  };

  explicit Edge_lines(const Occluders& occluders) : occluders_(&occluders), names_(occluders.scene().points()) {}
  explicit Edge_lines(Occluders&&) = delete;

  std::size_t size() const { return lines_.size(); }
  const Edge_line& operator[](std::uint32_t line) const { return lines_[line]; }
  const std::vector<Edge_line>& all() const { return lines_; }

  /// The edges of a piece, from each corner to the next.
  const std::vector<Edge>& of(std::uint32_t piece);

  /// Whether two lines are in one plane: they meet, or are parallel. Exact: yes.
  static bool coplanar(const Edge_line& a, const Edge_line& b);

 private:
  Edge edge(std::uint32_t piece, std::size_t corner);

  const Occluders* occluders_;
  Line_table names_;  // as many as lines_, in the same order
  std::vector<Edge_line> lines_;
  std::unordered_map<std::uint32_t, std::vector<Edge>> of_piece_;
};

}  // namespace sightline
