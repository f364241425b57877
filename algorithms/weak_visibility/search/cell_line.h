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
  std::vector<Rational> exact_source, exact_target;  ///< where doubles are too coarse to be in the cell

  static Line_weights middle(const Line_domain& domain);
};

/// Moves lines into a cell. What it finds in doubles is a proposal; a line found in rationals is strictly in the cell.
class Line_finder {
 public:
  /// Improves one end for the other, in turn, until a line is strictly in the cell; then once more, to be well inside.
  bool find(const Line_cell& cell, Line_weights& line, Weak_counters& counters);

  /// The same in rationals. Exact: yes.
  bool find_exactly(const Line_cell& cell, Line_weights& line, Weak_counters& counters);

 private:
  static constexpr double least_margin = 1e-11;

  double improve(const Line_cell& cell, Line_weights& line, bool source, Weak_counters& counters);

  /// Gives the vertices of the fixed end some weight each, so little that the line stays strictly in the cell.
  static bool make_positive(const Line_cell& cell, Line_weights& line, bool source);

  Matrix_game<double> game_;
};

}  // namespace sightline
