#pragma once
// Cells of lines: those between two convex polygons that pass certain edges on certain sides.

#include <sightline/algorithms/weak_visibility/edge_lines.h>
#include <sightline/algorithms/weak_visibility/line_space.h>
#include <sightline/kernel/line_table.h>
#include <sightline/kernel/number.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace sightline {

/// The sides of a line on all pairs of vertices of two polygons, scaled by a power of two to at most 1. Of a row that
/// is decided only that is to be asked. Proof: P-70
struct Side_row {
  std::vector<double> values;
  double error;
  long exponent = 0;                 ///< of that scale
  int decided;                       ///< 1: nowhere negative, -1: nowhere positive, 0: neither
  std::vector<Rational> exact = {};  ///< unscaled, once they are asked for
};

/// A piece that may come between the polygons.
struct Candidate {
  std::uint32_t piece;
  int sense;    ///< 1: source in front and target behind, -1: the other way round, 0: one of them is on both sides
  float share;  ///< of all lines, that it blocks, by samples
  std::uint32_t edge = 0;  ///< the one that the last line passed outside
};

/// Two convex polygons, the sides of lines on them, and what may come between. The lines from the one to the other are
/// mixtures of pairs of vertices.
struct Line_domain {
  using Shared_polygon =
      std::shared_ptr<const Near_polygon>;  // most domains share one of them with the domain that they are a part of

  Line_domain(Shared_polygon s, Shared_polygon t);

  const Exact_pluecker& exact_pluecker_of(std::size_t c);
  /// The side of a line on a pair of vertices in near coordinates, for points with last coordinate 1. Exact: yes.
  Rational exact_side(const Edge_lines::Edge_line& line, std::size_t c, const Near_frame& frame);
  /// All of them, made when they are first asked for. Exact: yes.
  const std::vector<Rational>& exact_sides(const Edge_lines& lines, std::uint32_t id, const Near_frame& frame);
  /// The line's row, made when it is first asked for. Its signs are exact where it is decided.
  const Side_row& row(const Edge_lines& lines, std::uint32_t id, const Near_frame& frame) {
    return row_at(lines, id, frame);
  }

  std::size_t pair_count() const { return source.size() * target.size(); }
  /// Made when they are first asked for, as most domains end before.
  const std::vector<Pluecker>& pairs();

  Shared_polygon shared_source, shared_target;
  const Near_polygon &source, &target;
  double source_size = 0, target_size = 0;
  std::vector<Exact_pluecker> exact_pairs;  ///< once they are asked for
  std::vector<std::unique_ptr<Side_row>> rows;
  std::vector<Candidate> candidates;  ///< once they are asked for: `settled`
  bool settled = false;
  int bisections = 0, narrowed = 0, sectors = 0;  ///< how often it was made smaller, and how

 private:
  void make_ways();
  Side_row& row_at(const Edge_lines& lines, std::uint32_t id, const Near_frame& frame);
  Side_row row_of(const Edge_lines::Edge_line& line, const Near_frame& frame);
  Integer weight_of(std::size_t c) const;  ///< the product of a pair's last coordinates

  std::vector<Pluecker> pairs_;
  std::vector<Triple> ways_;  // of pairs, from source to target, once a row is asked for
  double longest_ = 0;        // of them
};

/// A line that is passed on the side `sign`.
struct Literal {
  std::uint32_t line;
  int sign;
};

/// What a cell asks of its lines: of a path of literals those that its polygons do not decide.
struct Line_cell {
  struct Row {
    std::size_t place;  ///< of the path
    Literal literal;
    const Side_row* sides;
  };
  Line_domain* domain;
  const Edge_lines* lines;
  const Near_frame* frame;
  std::vector<Row> rows;

  std::size_t pairs() const { return domain->pair_count(); }
  double value(std::size_t row, std::size_t c) const { return rows[row].literal.sign * rows[row].sides->values[c]; }
  /// What value() is a rounded one of. Exact: yes.
  Rational exact_value(std::size_t row, std::size_t c) const;
  /// A weight of a scaled row as a factor of the unscaled one.
  Rational factor_of(std::size_t row, Rational weight) const {
    return times_power(std::move(weight), rows[row].sides->exponent);
  }
};

}  // namespace sightline
