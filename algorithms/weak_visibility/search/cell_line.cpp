#include <sightline/algorithms/weak_visibility/search/cell_line.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace sightline {

Line_weights Line_weights::middle(const Line_domain& domain) {
  const std::size_t m = domain.source.size(), n = domain.target.size();
  return {std::vector<double>(m, 1.0 / static_cast<double>(m)),
          std::vector<double>(n, 1.0 / static_cast<double>(n)),
          {},
          {}};
}

bool Line_finder::find(const Line_cell& cell, Line_weights& line, Weak_counters& counters) {
  double before = -2;
  for (int round = 0; round < 6; ++round) {
    const double source = improve(cell, line, true, counters);
    if (source > least_margin) {
      improve(cell, line, false, counters);
      return true;
    }
    const double target = improve(cell, line, false, counters);
    if (target > least_margin) {
      improve(cell, line, true, counters);
      return true;
    }
    if (target < before + 1e-3 * std::fabs(before)) return false;
    before = target;
  }
  return false;
}

bool Line_finder::find_exactly(const Line_cell& cell, Line_weights& line, Weak_counters& counters) {
  const std::size_t m = cell.domain->source.size(), n = cell.domain->target.size();
  line.exact_source.clear();
  line.exact_target.clear();
  for (const double w : line.source) line.exact_source.push_back(exact(w));
  for (const double w : line.target) line.exact_target.push_back(exact(w));
  for (int round = 0; round < 4; ++round) {
    const bool source = round % 2 == 0;
    const std::size_t own = source ? m : n;
    // The values of the other end's weights, exactly; rounded, a game in doubles; its basis, exactly.
    ++counters.exact_programs;
    std::vector<std::vector<Rational>> rows(cell.rows.size(), std::vector<Rational>(own));
    game_.restart(own);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      Rational most;
      for (std::size_t i = 0; i < m; ++i)
        for (std::size_t j = 0; j < n; ++j)
          rows[k][source ? i : j] +=
              (source ? line.exact_target[j] : line.exact_source[i]) * cell.exact_value(k, i * n + j);
      for (const Rational& v : rows[k]) most = std::max(most, Rational(abs(v)));
      const long scale =
          static_cast<long>(bit_length(most.get_den())) - static_cast<long>(bit_length(most.get_num())) - 1;
      const std::span<double> values = game_.add_row();
      for (std::size_t c = 0; c < own; ++c) {
        rows[k][c] = times_power(std::move(rows[k][c]), scale);  // within [-1, 1]
        values[c] = nearest_double(rows[k][c]);
      }
    }
    game_.solve();
    std::vector<Rational> solved, weights(own);
    Rational value;
    const std::vector<std::size_t>& columns = game_.tight_columns();
    if (!solve_basis(
            columns, game_.tight_rows(), [&](std::size_t c, std::size_t k) { return rows[k][c]; }, solved, value))
      return false;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (sgn(solved[c]) < 0) return false;
      weights[columns[c]] = solved[c];
    }
    Rational least = 1;  // of the means of rows
    for (const std::vector<Rational>& row : rows) {
      Rational sum, mean;
      for (std::size_t c = 0; c < own; ++c) {
        sum += weights[c] * row[c];
        mean += row[c] / static_cast<long>(own);
      }
      value = std::min(value, sum);
      least = std::min(least, mean);
    }
    (source ? line.exact_source : line.exact_target) = weights;
    if (sgn(value) <= 0) continue;
    // This end off the polygon's boundary, by a step that keeps half of the margin.
    const Rational half(1, 2),
        step = least >= value / 2 ? half : std::min(half, Rational(value / (4 * (value - least))));
    for (Rational& w : source ? line.exact_source : line.exact_target)
      w = (1 - step) * w + step / static_cast<long>(own);
    return make_positive(cell, line, source);
  }
  return false;
}

double Line_finder::improve(const Line_cell& cell, Line_weights& line, bool source, Weak_counters& counters) {
  const std::size_t m = cell.domain->source.size(), n = cell.domain->target.size(), own = source ? m : n;
  game_.restart(own);
  for (std::size_t k = 0; k < cell.rows.size(); ++k) {
    const std::span<double> values = game_.add_row();
    std::fill(values.begin(), values.end(), 0.0);
    for (std::size_t i = 0; i < m; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        const double v = cell.value(k, i * n + j);
        if (source) values[i] += v * line.target[j];
        else values[j] += v * line.source[i];
      }
  }
  ++counters.programs;
  const double value = game_.solve();
  std::vector<double>& weights = source ? line.source : line.target;
  weights.assign(game_.column_weights().begin(), game_.column_weights().end());
  // Off the polygon's boundary, as far as half of the margin allows.
  double centre = 1;
  for (std::size_t k = 0; k < game_.rows(); ++k) {
    double sum = 0;
    for (const double v : game_.row(k)) sum += v;
    centre = std::min(centre, sum / static_cast<double>(own));
  }
  const double step = centre >= value / 2 ? 0.5 : std::min(0.5, value / 2 / (value - centre));
  if (value > 0)
    for (double& w : weights) w = (1 - step) * w + step / static_cast<double>(own);
  return value;
}

bool Line_finder::make_positive(const Line_cell& cell, Line_weights& line, bool source) {
  const std::size_t m = cell.domain->source.size(), n = cell.domain->target.size();
  std::vector<Rational>& weights = source ? line.exact_target : line.exact_source;
  for (Rational step(1, 2);; step /= 1024) {
    std::vector<Rational> moved;
    for (const Rational& w : weights) moved.push_back((1 - step) * w + step / static_cast<long>(weights.size()));
    const std::vector<Rational>&s = source ? line.exact_source : moved, &t = source ? moved : line.exact_target;
    bool inside = true;
    for (std::size_t k = 0; k < cell.rows.size() && inside; ++k) {
      Rational sum;
      for (std::size_t i = 0; i < m; ++i)
        for (std::size_t j = 0; j < n; ++j) sum += s[i] * t[j] * cell.exact_value(k, i * n + j);
      inside = sgn(sum) > 0;
    }
    if (inside) {
      weights = moved;
      break;
    }
    if (bit_length(step.get_den()) > 4000) return false;
  }
  for (std::size_t i = 0; i < m; ++i) line.source[i] = nearest_double(line.exact_source[i]);
  for (std::size_t j = 0; j < n; ++j) line.target[j] = nearest_double(line.exact_target[j]);
  return true;
}

}  // namespace sightline
