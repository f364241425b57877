#pragma once
// Which vertices, and which lines of edges, are the same in space, whatever planes they were made of.

#include <sightline/algorithms/solids/operands.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/row_table.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/vertex.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline {

/// The numbers of things that have a key in common, in the order in which they were added.
class Keyed_ids {
 public:
  explicit Keyed_ids(std::size_t limbs) : keys_(limbs) {}
  static constexpr std::uint32_t none = Row_table::none;

  /// The first with that key, or none.
  std::uint32_t first(const Limb* key) const {
    const std::uint32_t row = keys_.find(key);
    return row == Row_table::none ? none : first_[row];
  }
  /// The one after it with the same key, or none.
  std::uint32_t next(std::uint32_t id) const { return next_[id]; }
  /// Pre: ids are added in their order, from 0 on.
  void add(const Limb* key);

 private:
  Row_table keys_;
  std::vector<std::uint32_t> first_, last_;  // by key
  std::vector<std::uint32_t> next_;          // by id
};

/// The vertices of a result: equal in space, equal ids. What two have in common modulo a prime is asked first; only
/// where that is the same, whether one is in the planes of the other. Cost: some 0.2 us where the planes are new, and
/// that once more for each other name of a vertex. Exact: yes. Proof: P-114
class Vertex_ids {
 public:
  explicit Vertex_ids(const Operands& operands);

  std::uint32_t id(const Vertex& v);
  std::size_t size() const { return vertices_.size(); }
  /// In homogeneous grid coordinates, the last of them positive. Cost: made when first asked for.
  const std::array<Integer, 4>& at(std::uint32_t id) const;
  /// The id of an input point, or none.
  std::uint32_t of_point(std::uint32_t point) const { return of_point_[point]; }
  static constexpr std::uint32_t none = Keyed_ids::none;

  /// Whether a vertex comes before another along an axis. Exact: filtered
  bool is_before(std::uint32_t a, std::uint32_t b, std::size_t axis) const;

  const Predicate_counts& counts() const { return counts_; }

 private:
  std::uint32_t find_or_add(const Vertex& v);
  bool is_same(const Vertex& v, const Vertex& known);

  const Predicates predicates_;
  std::vector<std::uint32_t> of_point_;
  Row_table triples_{2};                  // of planes, ascending
  std::vector<std::uint32_t> of_triple_;  // vertices
  Keyed_ids by_residues_{2};
  std::vector<Vertex> vertices_;  // as they were first met, but for better doubles
  mutable std::vector<std::array<Integer, 4>> exact_;
  Predicate_counts counts_;
};

/// The lines of edges, as meets of two planes: equal in space, equal ids. As above. Exact: yes. Proof: P-114
class Line_ids {
 public:
  explicit Line_ids(const Operands& operands) : predicates_(operands.predicates()) {}

  /// Of two planes that are not parallel.
  std::uint32_t id(std::uint32_t p, std::uint32_t q);
  /// The same, of an edge whose ends are these vertices: of edges with the same ends the line is the same.
  std::uint32_t id(std::uint32_t p, std::uint32_t q, std::uint32_t from, std::uint32_t to);

  std::size_t size() const { return lines_.size(); }
  /// The first axis that the line is not across.
  std::size_t axis(std::uint32_t id) const { return lines_[id].axis; }

 private:
  struct Line {
    std::uint32_t p, q;
    std::uint8_t axis;
  };
  std::uint32_t find_or_add(std::uint32_t p, std::uint32_t q);
  std::array<Integer, 6> minors(std::uint32_t p, std::uint32_t q) const;

  const Predicates predicates_;
  Row_table pairs_{1}, ends_{1};                  // of planes, and of vertices, the lesser first
  std::vector<std::uint32_t> of_pair_, of_ends_;  // lines
  Keyed_ids by_residues_{3};
  std::vector<Line> lines_;
};

}  // namespace sightline
