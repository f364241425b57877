#pragma once
// Matrix games by the simplex method: the best mixture of columns against the worst row, and the mixture of rows that proves it.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace sightline {

/// The game max over mixtures x of columns, min over rows k, of sum_c x_c a(k, c). A positive value says that some mixture is positive in all rows; a mixture of
/// rows that is at most 0 in all columns proves that none is. Rows come one at a time. Values are expected within [-1, 1], or the shift that makes them positive
/// is not one. Cost: O(rows x columns) a step. Exact: no; what it proposes is checked by those who ask. Proof: P-71
class Matrix_game {
 public:
  void restart(std::size_t columns) { columns_ = columns, rows_ = 0, entries_.clear(); }
  std::size_t rows() const { return rows_; }
  /// Room for the values of one more row.
  std::span<double> add_row() {
    entries_.resize(entries_.size() + columns_);
    ++rows_;
    return {entries_.data() + (rows_ - 1) * columns_, columns_};
  }
  void remove_row() { entries_.resize(--rows_ * columns_); }
  std::span<const double> row(std::size_t k) const { return {entries_.data() + k * columns_, columns_}; }

  /// The value of the game. Pre: a row and a column. Post: column_weights(), row_weights() are optimal mixtures, tight_columns(), tight_rows() the basis.
  double solve() {
    start();
    for (int step = 0; step < max_steps; ++step) {
      const std::size_t entering = entering_row(step);
      if (entering == rows_) break;
      const std::size_t leaving = leaving_column(entering);
      if (leaving == columns_) break;  // by rounding only: entries are positive
      pivot(leaving, entering);
    }
    return finish();
  }

  std::span<const double> column_weights() const { return x_; }  ///< sum 1
  std::span<const double> row_weights() const { return y_; }     ///< sum 1
  const std::vector<std::size_t>& tight_columns() const { return tight_columns_; }
  const std::vector<std::size_t>& tight_rows() const { return tight_rows_; }

 private:
  static constexpr double shift = 2;
  static constexpr int max_steps = 300, careful_after = 150;

  // The linear program: most sum of y >= 0 with sum_k y_k (a(k, c) + shift) <= 1 in each column c. The tableau is condensed: a line for each basic variable,
  // a place for each other one; variables k < rows are y_k, rows + c is the slack of column c.
  double& at(std::size_t line, std::size_t place) { return tableau_[line * (rows_ + 1) + place]; }
  void start() {
    tableau_.assign((columns_ + 1) * (rows_ + 1), 1.0);
    for (std::size_t c = 0; c < columns_; ++c)
      for (std::size_t k = 0; k < rows_; ++k) at(c, k) = entries_[k * columns_ + c] + shift;
    for (std::size_t k = 0; k < rows_; ++k) at(columns_, k) = -1;
    at(columns_, rows_) = 0;
    basic_.resize(columns_), other_.resize(rows_);
    for (std::size_t c = 0; c < columns_; ++c) basic_[c] = rows_ + c;
    for (std::size_t k = 0; k < rows_; ++k) other_[k] = k;
  }
  std::size_t entering_row(int step) {
    std::size_t best = rows_;
    double least = -1e-11;
    for (std::size_t k = 0; k < rows_; ++k) {
      const double cost = at(columns_, k);
      if (cost >= least) continue;
      best = k, least = cost;
      if (step > careful_after) break;  // the first one: no cycles for long
    }
    return best;
  }
  std::size_t leaving_column(std::size_t entering) {
    std::size_t best = columns_;
    double least = 0;
    for (std::size_t c = 0; c < columns_; ++c) {
      const double slope = at(c, entering);
      if (slope <= 1e-11) continue;
      const double ratio = at(c, rows_) / slope;
      if (best == columns_ || ratio < least || (ratio == least && basic_[c] < basic_[best])) best = c, least = ratio;
    }
    return best;
  }
  void pivot(std::size_t line, std::size_t place) {
    const double inverse = 1 / at(line, place);
    double* own = &at(line, 0);
    for (std::size_t k = 0; k <= rows_; ++k) own[k] *= inverse;
    own[place] = inverse;
    for (std::size_t c = 0; c <= columns_; ++c) {
      if (c == line) continue;
      double* other = &at(c, 0);
      const double factor = other[place];
      if (factor == 0) continue;
      other[place] = 0;
      for (std::size_t k = 0; k <= rows_; ++k) other[k] -= factor * own[k];
    }
    std::swap(basic_[line], other_[place]);
  }
  double finish() {
    x_.assign(columns_, 0), y_.assign(rows_, 0);
    tight_columns_.clear(), tight_rows_.clear();
    double columns = 0, rows = 0;
    for (std::size_t c = 0; c < columns_; ++c)
      if (basic_[c] < rows_) rows += y_[basic_[c]] = std::max(0.0, at(c, rows_)), tight_rows_.push_back(basic_[c]);
    for (std::size_t k = 0; k < rows_; ++k)
      if (other_[k] >= rows_) columns += x_[other_[k] - rows_] = std::max(0.0, at(columns_, k)), tight_columns_.push_back(other_[k] - rows_);
    for (double& x : x_) x /= columns;
    for (double& y : y_) y /= rows;
    return 1 / rows - shift;
  }

  std::size_t columns_ = 0, rows_ = 0;
  std::vector<double> entries_, tableau_, x_, y_;
  std::vector<std::size_t> basic_, other_, tight_columns_, tight_rows_;
};

}  // namespace sightline
