#include <sightline/algorithms/weak_visibility/search/cell_line.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>

namespace sightline {
namespace {

/// Weights of few bits, all of them positive.
std::vector<Integer> whole_weights(const std::vector<double>& weights) {
  std::vector<Integer> whole;
  for (const double w : weights) whole.push_back(Integer(std::max(1.0, std::round(std::ldexp(w, 20)))));
  return whole;
}

std::vector<double> near_weights(const std::vector<Integer>& weights) {
  const Integer sum = std::accumulate(weights.begin(), weights.end(), Integer(0));
  std::vector<double> near;
  for (const Integer& w : weights) near.push_back(nearest_double(Rational(w, sum)));
  return near;
}

}  // namespace

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

Line_finder::Whole_rows Line_finder::whole_rows(const Line_cell& cell) {
  Whole_rows rows(cell.rows.size(), std::vector<Integer>(cell.pairs()));
  for (std::size_t k = 0; k < rows.size(); ++k)
    for (std::size_t c = 0; c < rows[k].size(); ++c) {
      const Rational value = times_power(cell.exact_value(k, c), bits);
      mpz_fdiv_q(rows[k][c].get_mpz_t(), value.get_num_mpz_t(), value.get_den_mpz_t());
    }
  return rows;
}

bool Line_finder::find_exactly(const Line_cell& cell, const Whole_rows& whole, Line_weights& line,
                               Weak_counters& counters) {
  const std::size_t m = cell.domain->source.size(), n = cell.domain->target.size();
  line.exact_source = whole_weights(line.source);
  line.exact_target = whole_weights(line.target);
  for (int round = 0; round < 4; ++round) {
    const bool source = round % 2 == 0;
    std::vector<Integer>& own = source ? line.exact_source : line.exact_target;
    const std::vector<Integer>& fixed = source ? line.exact_target : line.exact_source;
    // 1. The game of this end's vertices, for the other end as it is.
    std::vector<std::vector<Integer>> rows(whole.size(), std::vector<Integer>(own.size()));
    for (std::size_t k = 0; k < whole.size(); ++k)
      for (std::size_t i = 0; i < m; ++i)
        for (std::size_t j = 0; j < n; ++j) rows[k][source ? i : j] += fixed[source ? j : i] * whole[k][i * n + j];
    ++counters.exact_programs;
    exact_game_.restart(own.size());
    for (const std::vector<Integer>& row : rows) {
      std::size_t longest = 0;
      for (const Integer& v : row) longest = std::max(longest, bit_length(v));
      const std::span<Rational> values = exact_game_.add_row();
      for (std::size_t c = 0; c < own.size(); ++c)
        values[c] = times_power(Rational(row[c]), -static_cast<long>(longest));  // within [-1, 1]
    }
    const Rational margin = exact_game_.solve();
    const auto keeps_half_of_it = [&] {
      const Rational least = margin / 2 * std::accumulate(own.begin(), own.end(), Integer(0));
      for (std::size_t k = 0; k < exact_game_.rows(); ++k) {
        Rational sum;
        for (std::size_t c = 0; c < own.size(); ++c) sum += own[c] * exact_game_.row(k)[c];
        if (sum < least) return false;
      }
      return true;
    };
    // 2. Its best weights, in so many bits, all of them positive: `even` times as much for all.
    const auto set_weights = [&](long many, long even) {
      for (std::size_t c = 0; c < own.size(); ++c) {
        const Rational weight = times_power(exact_game_.column_weights()[c], many);
        mpz_fdiv_q(own[c].get_mpz_t(), weight.get_num_mpz_t(), weight.get_den_mpz_t());
        own[c] += Integer(1) << static_cast<mp_bitcnt_t>(even);
      }
    };
    if (sgn(margin) <= 0) {
      set_weights(bits, 0);
      continue;
    }
    for (long many = 32; many <= bits; many *= 2)
      for (long even = many - 1; even > 0; even /= 2) {
        set_weights(many, even);
        if (keeps_half_of_it()) {
          line.source = near_weights(line.exact_source);
          line.target = near_weights(line.exact_target);
          return true;
        }
      }
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

}  // namespace sightline
