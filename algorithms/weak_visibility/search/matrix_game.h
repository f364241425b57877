#pragma once
// Matrix games by the simplex method: the best mixture of columns against the worst row, and the mixture of rows that
// proves it.

#include <sightline/kernel/number.h>
#include <sightline/kernel/time_limit.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace sightline {

/// The game max over mixtures x of columns, min over rows k, of sum_c x_c a(k, c). A positive value says that some
/// mixture is positive in all rows; a mixture of rows that is at most 0 in all columns proves that none is. Rows come
/// one at a time. Values are expected within [-1, 1], or the shift that makes them positive is not one. Cost: O(rows x
/// columns) a step. Exact: with rational numbers; with doubles what it proposes is checked by those who ask. Proof:
/// P-71
template <class Number>
class Matrix_game {
 public:
  /// Asked before each step: solve() ends where it says so, with what a check will not accept.
  void end_when(std::function<bool()> out_of_time) { out_of_time_ = std::move(out_of_time); }
  void restart(std::size_t columns) {
    columns_ = columns;
    rows_ = 0;
    entries_.clear();
  }
  std::size_t rows() const { return rows_; }
  /// Room for the values of one more row.
  std::span<Number> add_row() {
    entries_.resize(entries_.size() + columns_);
    ++rows_;
    return {entries_.data() + (rows_ - 1) * columns_, columns_};
  }
  std::span<const Number> row(std::size_t k) const { return {entries_.data() + k * columns_, columns_}; }

  /// The value of the game. Pre: a row and a column. Post: column_weights(), row_weights() are optimal mixtures,
  /// tight_columns(), tight_rows() the basis.
  Number solve() {
    start();
    run();
    return finish();
  }

  /// What the value would be with one more row: a few steps from where solve() ended. Pre: solve(). Post: nothing has
  /// changed.
  Number value_with(std::span<const Number> row) requires std::is_floating_point_v<Number> {
    const std::vector<Number> before = tableau_;
    const std::vector<std::size_t> basic = basic_, other = other_;
    // The new variable's place in the tableau: its column times the inverse of the basis, which stands in the places of
    // slack variables.
    const std::size_t wide = rows_ + 2;
    tableau_.assign((columns_ + 1) * wide, Number(0));
    for (std::size_t line = 0; line <= columns_; ++line) {
      std::copy_n(&before[line * (rows_ + 1)], rows_, &tableau_[line * wide]);
      tableau_[line * wide + rows_ + 1] = before[line * (rows_ + 1) + rows_];
    }
    const auto added = [&](std::size_t line) -> Number& { return tableau_[line * wide + rows_]; };
    added(columns_) = -1;
    for (std::size_t line = 0; line < columns_; ++line)
      if (basic[line] >= rows_) added(line) = row[basic[line] - rows_] + shift;
    for (std::size_t k = 0; k < rows_; ++k)
      if (other[k] >= rows_)
        for (std::size_t line = 0; line <= columns_; ++line)
          added(line) += before[line * (rows_ + 1) + k] * (row[other[k] - rows_] + shift);
    other_.push_back(rows_ + columns_);  // a name of its own
    ++rows_;
    run();
    const Number sum = at(columns_, rows_);
    --rows_;
    tableau_ = before;
    basic_ = basic;
    other_ = other;
    return sum > 0 ? 1 / sum - shift : Number(1);
  }

  std::span<const Number> column_weights() const { return x_; }  ///< sum 1
  std::span<const Number> row_weights() const { return y_; }     ///< sum 1
  const std::vector<std::size_t>& tight_columns() const { return tight_columns_; }
  const std::vector<std::size_t>& tight_rows() const { return tight_rows_; }

 private:
  static constexpr bool is_exact = !std::is_floating_point_v<Number>;
  using Entry = std::conditional_t<is_exact, Integer, Number>;
  static constexpr int shift = 2, max_steps = 300;
  // Exact games that take more steps are not solved, and say so by what is checked.
  static constexpr int careful_after = 150;

  // The linear program: most sum of y >= 0 with sum_k y_k (a(k, c) + shift) <= 1 in each column c. The tableau is
  // condensed: a line for each basic variable, a place for each other one; variables k < rows are y_k, rows + c is the
  // slack of column c. Exact entries are integers over denominator_; so that they are short, y_k is measured in units
  // of scales_[k], and the slack of c in parts of which there are scales_[rows + c].
  Entry& at(std::size_t line, std::size_t place) { return tableau_[line * (rows_ + 1) + place]; }
  void start() {
    tableau_.assign((columns_ + 1) * (rows_ + 1), Entry(1));
    if constexpr (is_exact) {
      denominator_ = 1;
      choose_scales();
      for (std::size_t c = 0; c < columns_; ++c) {
        for (std::size_t k = 0; k < rows_; ++k) {
          const Rational entry = (entries_[k * columns_ + c] + shift) * scales_[rows_ + c] * scales_[k];
          at(c, k) = entry.get_num();
        }
        at(c, rows_) = scales_[rows_ + c];
      }
      for (std::size_t k = 0; k < rows_; ++k) at(columns_, k) = -scales_[k];
    } else {
      for (std::size_t c = 0; c < columns_; ++c)
        for (std::size_t k = 0; k < rows_; ++k) at(c, k) = entries_[k * columns_ + c] + shift;
      for (std::size_t k = 0; k < rows_; ++k) at(columns_, k) = -1;
    }
    at(columns_, rows_) = 0;
    basic_.resize(columns_);
    other_.resize(rows_);
    for (std::size_t c = 0; c < columns_; ++c) basic_[c] = rows_ + c;
    for (std::size_t k = 0; k < rows_; ++k) other_[k] = k;
  }
  /// What a column's denominators have in common, then what is left of those of each row.
  void choose_scales() {
    scales_.assign(rows_ + columns_, Integer(0));
    for (std::size_t c = 0; c < columns_; ++c)
      for (std::size_t k = 0; k < rows_; ++k)
        scales_[rows_ + c] = gcd(scales_[rows_ + c], entries_[k * columns_ + c].get_den());
    for (std::size_t k = 0; k < rows_; ++k) {
      scales_[k] = 1;
      for (std::size_t c = 0; c < columns_; ++c)
        scales_[k] = lcm(scales_[k], Integer(entries_[k * columns_ + c].get_den() / scales_[rows_ + c]));
    }
  }
  void run() {
    for (int step = 0; step < max_steps; ++step) {
      const std::size_t entering = entering_row(step);
      if (entering == rows_ || has_run_out(out_of_time_)) break;
      const std::size_t leaving = leaving_column(entering);
      if (leaving == columns_) break;  // by rounding only: entries are positive
      pivot(leaving, entering);
    }
  }
  /// Whether what place k costs is less than what place l does, both in units of before they were scaled.
  bool costs_less(std::size_t k, std::size_t l) {
    if constexpr (is_exact) {
      const auto scaled = [&](std::size_t one, std::size_t by) {  // its cost times what is below the other's
        Integer cost = at(columns_, one);
        if (other_[one] >= rows_) cost *= scales_[other_[one]];
        if (other_[by] < rows_) cost *= scales_[other_[by]];
        return cost;
      };
      return scaled(k, l) < scaled(l, k);
    } else {
      return at(columns_, k) < at(columns_, l);
    }
  }
  std::size_t entering_row(int step) {
    std::size_t best = rows_;
    for (std::size_t k = 0; k < rows_; ++k) {
      if (at(columns_, k) >= (is_exact ? Entry(0) : Entry(-1e-11))) continue;
      if (best != rows_ && !costs_less(k, best)) continue;
      best = k;
      if (step > careful_after) break;  // the first one: no cycles for long
    }
    return best;
  }
  std::size_t leaving_column(std::size_t entering) {
    std::size_t best = columns_;
    const auto is_less = [&](std::size_t c, std::size_t d) {
      if constexpr (is_exact) {
        const int order = cmp(at(c, rows_) * at(d, entering), at(d, rows_) * at(c, entering));
        return order < 0 || (order == 0 && basic_[c] < basic_[d]);
      } else {
        const Number one = at(c, rows_) / at(c, entering), other = at(d, rows_) / at(d, entering);
        return one < other || (one == other && basic_[c] < basic_[d]);
      }
    };
    for (std::size_t c = 0; c < columns_; ++c) {
      if (at(c, entering) <= (is_exact ? Entry(0) : Entry(1e-11))) continue;
      if (best == columns_ || is_less(c, best)) best = c;
    }
    return best;
  }
  void pivot(std::size_t line, std::size_t place) {
    if constexpr (is_exact) pivot_integers(line, place);
    else pivot_numbers(line, place);
    std::swap(basic_[line], other_[place]);
  }
  void pivot_numbers(std::size_t line, std::size_t place) {
    const Number inverse = 1 / at(line, place);
    Number* own = &at(line, 0);
    for (std::size_t k = 0; k <= rows_; ++k) own[k] *= inverse;
    own[place] = inverse;
    for (std::size_t c = 0; c <= columns_; ++c) {
      if (c == line) continue;
      Number* other = &at(c, 0);
      const Number factor = other[place];
      if (factor == 0) continue;
      other[place] = 0;
      for (std::size_t k = 0; k <= rows_; ++k) other[k] -= factor * own[k];
    }
  }
  /// All over the pivot instead of the one before it, which divides what comes of it.
  void pivot_integers(std::size_t line, std::size_t place) {
    const Integer pivot = at(line, place);
    Integer* own = &at(line, 0);
    for (std::size_t c = 0; c <= columns_; ++c) {
      if (c == line) continue;
      Integer* other = &at(c, 0);
      const Integer factor = other[place];
      for (std::size_t k = 0; k <= rows_; ++k) {
        if (k == place) continue;
        other[k] *= pivot;
        mpz_submul(other[k].get_mpz_t(), factor.get_mpz_t(), own[k].get_mpz_t());
        mpz_divexact(other[k].get_mpz_t(), other[k].get_mpz_t(), denominator_.get_mpz_t());
      }
      other[place] = -factor;
    }
    own[place] = denominator_;
    denominator_ = pivot;
  }
  Number finish() {
    x_.assign(columns_, 0);
    y_.assign(rows_, 0);
    tight_columns_.clear();
    tight_rows_.clear();
    Number columns = 0, rows = 0;
    const auto in_its_unit = [&](const Entry& x, std::size_t variable) -> Number {
      if (x <= 0) return Number(0);
      if constexpr (is_exact) return Number(Integer(x * scales_[variable]));
      else return x;
    };
    for (std::size_t c = 0; c < columns_; ++c)
      if (basic_[c] < rows_) {
        rows += y_[basic_[c]] = in_its_unit(at(c, rows_), basic_[c]);
        tight_rows_.push_back(basic_[c]);
      }
    for (std::size_t k = 0; k < rows_; ++k)
      if (other_[k] >= rows_) {
        columns += x_[other_[k] - rows_] = in_its_unit(at(columns_, k), other_[k]);
        tight_columns_.push_back(other_[k] - rows_);
      }
    if (!(columns > 0) || !(rows > 0)) return 1;  // entries beyond what was asked for: weights that prove nothing
    for (Number& x : x_) x /= columns;
    for (Number& y : y_) y /= rows;
    if constexpr (is_exact) return Number(denominator_) / rows - shift;
    else return 1 / rows - shift;
  }

  std::function<bool()> out_of_time_;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<Number> entries_, x_, y_;
  std::vector<Entry> tableau_;
  Integer denominator_ = 1;      // of exact entries
  std::vector<Integer> scales_;  // of exact ones, by variable
  std::vector<std::size_t> basic_, other_, tight_columns_, tight_rows_;
};

/// Gauss and Jordan: the solution of n equations, lines of n factors and a right side. False where there is no single
/// one, or no time. Cost: O(n^3). Exact: with rational numbers
template <class Number>
bool solve_equations(std::vector<std::vector<Number>>& a, std::vector<Number>& solution,
                     const std::function<bool()>& out_of_time = {}) {
  const std::size_t n = a.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (has_run_out(out_of_time)) return false;
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (cmp(abs(a[i][k]), abs(a[pivot][k])) > 0) pivot = i;
    if (sgn(a[pivot][k]) == 0) return false;
    std::swap(a[pivot], a[k]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k || sgn(a[i][k]) == 0) continue;
      const Number factor = a[i][k] / a[k][k];
      for (std::size_t j = k; j <= n; ++j) a[i][j] -= factor * a[k][j];
    }
  }
  solution.clear();
  for (std::size_t k = 0; k < n; ++k) solution.push_back(a[k][n] / a[k][k]);
  return true;
}

/// The mixture of rows of a game's basis that gives all of its columns the same value: a square system, a(row, column)
/// by `entry`. (For the mixture of columns: with their roles exchanged.) A value that is clear of zero stays so when
/// weights are rounded, so that they are found, and returned, with 512 bits; rationals, whose length grows with that of
/// the entries and their number, are left for values that may be zero. False where there is no single solution (unless
/// rounding makes one), no time, or more than 16 rows. Exact: where the value is zero; otherwise a proposal that is
/// checked by those who ask.
template <class Entry>
bool solve_basis(const std::vector<std::size_t>& rows, const std::vector<std::size_t>& columns, Entry entry,
                 std::vector<Rational>& weights, Rational& value, const std::function<bool()>& out_of_time = {}) {
  const std::size_t n = rows.size() + 1;
  if (columns.size() != rows.size() || n > 17) return false;
  std::vector<std::vector<Rational>> a(n, std::vector<Rational>(n + 1));
  for (std::size_t i = 0; i + 1 < n; ++i) {
    for (std::size_t k = 0; k + 1 < n; ++k) a[i][k] = entry(rows[k], columns[i]);
    a[i][n - 1] = -1;
    a[n - 1][i] = 1;
  }
  a[n - 1][n] = 1;

  // 1. In floats of many bits.
  constexpr mp_bitcnt_t bits = 512;
  std::vector<std::vector<mpf_class>> near(n, std::vector<mpf_class>(n + 1, mpf_class(0, bits)));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k <= n; ++k) mpf_set_q(near[i][k].get_mpf_t(), a[i][k].get_mpq_t());
  std::vector<mpf_class> rounded;
  mpf_class least(1, bits);
  mpf_div_2exp(least.get_mpf_t(), least.get_mpf_t(), bits / 2);
  const auto is_clear = [&](const mpf_class& x) { return cmp(abs(x), least) > 0; };
  if (solve_equations(near, rounded) && is_clear(rounded.back())) {
    weights.assign(n, Rational());
    for (std::size_t k = 0; k < n; ++k)
      if (is_clear(rounded[k])) mpq_set_f(weights[k].get_mpq_t(), rounded[k].get_mpf_t());
    // 2. In rationals.
  } else if (!solve_equations(a, weights, out_of_time)) {
    return false;
  }
  value = weights.back();
  weights.pop_back();
  return true;
}

}  // namespace sightline
