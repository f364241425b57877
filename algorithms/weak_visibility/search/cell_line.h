#pragma once
// A line of a cell, by small linear programs: the best end for a fixed other end, in turn.

#include <sightline/algorithms/weak_visibility/search/line_cell.h>
#include <sightline/algorithms/weak_visibility/search/matrix_game.h>
#include <sightline/algorithms/weak_visibility/weak_answer.h>
#include <sightline/kernel/number.h>

#include <vector>

namespace sightline {

/// A line between two polygons: weights of their vertices, each with sum 1.
struct Line_weights {
  std::vector<double> source, target;
  /// In proportion to exact weights, all positive; where doubles are too coarse to be in the cell.
  std::vector<Integer> exact_source, exact_target;

  static Line_weights middle(const Line_domain& domain);
};

/// Moves lines into a cell. What it finds in doubles is a proposal; a line found in rationals is strictly in the cell.
class Line_finder {
 public:
  /// Improves one end for the other, in turn, until a line is strictly in the cell; then once more, to be well inside.
  bool find(const Line_cell& cell, Line_weights& line, Weak_counters& counters);

  /// A cell's rows in units of 2^-192 of the least power of two above their entries, each rounded down: a mixture of
  /// pairs that is positive here is so in the cell.
  using Whole_rows = std::vector<std::vector<Integer>>;
  static Whole_rows whole_rows(const Line_cell& cell);

  /// The same in integers, for cells that are thinner than what doubles tell apart. Exact: yes, a line that it finds
  /// is in the cell; one that is there may be missed. Cost: four games of a few hundred bits.
  bool find_exactly(const Line_cell& cell, const Whole_rows& whole, Line_weights& line, Weak_counters& counters);

 private:
  static constexpr double least_margin = 1e-11;

  static constexpr long bits = 192;

  double improve(const Line_cell& cell, Line_weights& line, bool source, Weak_counters& counters);

  Matrix_game<double> game_;
  Matrix_game<Rational> exact_game_;
};

}  // namespace sightline
