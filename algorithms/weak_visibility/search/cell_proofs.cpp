#include <sightline/algorithms/weak_visibility/search/cell_proofs.h>

#include <sightline/kernel/number.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>

namespace sightline {

double Cell_proofs::relax(const Line_cell& cell, Weak_counters& counters) {
  game_.restart(cell.pairs());
  for (std::size_t k = 0; k < cell.rows.size(); ++k) {
    const std::span<double> values = game_.add_row();
    for (std::size_t c = 0; c < values.size(); ++c) values[c] = cell.value(k, c);
  }
  ++counters.programs;
  return game_.solve();
}

Cell_proofs::Relaxation Cell_proofs::by_relaxation(const Line_cell& cell, std::vector<Multiplier>& proof,
                                                   Weak_counters& counters) const {
  // 1. The weights as they are: by doubles, with their errors.
  std::vector<Weighted> proposal;
  for (std::size_t k = 0; k < cell.rows.size(); ++k)
    if (const double w = game_.row_weights()[k]; w > 1e-13) proposal.push_back({k, w, {}});
  if (is_proof_in_doubles(cell, proposal)) {
    for (const Weighted& w : proposal)
      proof.push_back({cell.rows[w.row].place, cell.factor_of(w.row, exact(w.near)), {}, {}});
    return Relaxation::empty;
  }
  // 2. The exact solution for the basis that doubles ended with.
  ++counters.exact_programs;
  const std::vector<std::size_t>& rows = game_.tight_rows();
  std::vector<Rational> weights;
  Rational value;
  if (!solve_basis(
          rows, game_.tight_columns(), [&](std::size_t k, std::size_t c) { return cell.exact_value(k, c); }, weights,
          value, out_of_time_))
    return Relaxation::unclear;
  std::vector<Weighted> kept;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (sgn(weights[k]) < 0) return Relaxation::unclear;
    if (sgn(weights[k]) > 0) kept.push_back({rows[k], 0, weights[k]});
  }
  if (sgn(value) > 0) return Relaxation::has_room;
  return conclude(cell, kept, proof) ? Relaxation::empty : Relaxation::unclear;
}

bool Cell_proofs::by_exact_relaxation(const Line_cell& cell, std::vector<Multiplier>& proof, Weak_counters& counters) {
  if (cell.rows.size() * cell.pairs() > 1500) return false;
  std::size_t bits = 0;
  for (const Line_cell::Row& row : cell.rows)
    for (const Rational& side : cell.domain->exact_sides(*cell.lines, row.literal.line, *cell.frame))
      bits += bit_length(side.get_num());
  if (bits > 150000) return false;
  ++counters.exact_programs;
  exact_game_.restart(cell.pairs());
  for (std::size_t k = 0; k < cell.rows.size(); ++k) {
    const std::span<Rational> values = exact_game_.add_row();
    for (std::size_t c = 0; c < values.size(); ++c) values[c] = cell.exact_value(k, c);
  }
  if (sgn(exact_game_.solve()) > 0) return false;
  std::vector<Weighted> proposal;
  for (std::size_t k = 0; k < cell.rows.size(); ++k)
    if (sgn(exact_game_.row_weights()[k]) > 0) proposal.push_back({k, 0, exact_game_.row_weights()[k]});
  return conclude(cell, proposal, proof);
}

bool Cell_proofs::at_corner(const Line_cell& cell, std::vector<Multiplier>& proof, Weak_counters& counters) {
  const std::size_t n = cell.rows.size();
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = a + 1; b < n; ++b) {
      if (!Edge_lines::coplanar(line_of(cell, a), line_of(cell, b))) continue;
      for (std::size_t c = b + 1; c < n; ++c) {
        if (!Edge_lines::coplanar(line_of(cell, a), line_of(cell, c)) ||
            !Edge_lines::coplanar(line_of(cell, b), line_of(cell, c)))
          continue;
        for (const bool source : {true, false})
          if (corner_proof(cell, {a, b, c}, source, proof)) {
            ++counters.corners;
            return true;
          }
      }
    }
  return false;
}

/// The products of a cell's lines with heights above planes of one polygon's edges: a row is an edge and a line of the
/// cell, a column a pair (i, k) of the polygon's corners, i <= k, and a corner of the other polygon.
class Cell_proofs::Form_products {
 public:
  /// Both outlive it. `source`: the polygon is the cell's source.
  Form_products(const Line_cell& cell, const Edge_forms& edges, bool source)
      : cell_(cell),
        edges_(edges),
        source_(source),
        own_(source ? cell.domain->source.size() : cell.domain->target.size()),
        other_(source ? cell.domain->target.size() : cell.domain->source.size()) {}

  std::size_t rows() const { return own_ * cell_.rows.size(); }
  std::size_t columns() const { return own_ * (own_ + 1) / 2 * other_; }
  std::size_t edge_of(std::size_t row) const { return row / cell_.rows.size(); }
  std::size_t line_of(std::size_t row) const { return row % cell_.rows.size(); }

  /// In doubles, divided by the edge's greatest height.
  void fill(Matrix_game<double>& game) const {
    game.restart(columns());
    for (std::size_t a = 0; a < own_; ++a) {
      std::vector<double> near;
      for (const Rational& h : edges_.heights[a]) near.push_back(nearest_double(Rational(h / edges_.most[a])));
      for (std::size_t r = 0; r < cell_.rows.size(); ++r) {
        const std::span<double> values = game.add_row();
        std::size_t c = 0;
        for (std::size_t i = 0; i < own_; ++i)
          for (std::size_t k = i; k < own_; ++k)
            for (std::size_t j = 0; j < other_; ++j)
              values[c++] = 0.5 * (near[i] * cell_.value(r, pair(k, j)) + near[k] * cell_.value(r, pair(i, j)));
      }
    }
  }

  /// Twice the exact product, not divided.
  Rational operator()(std::size_t row, std::size_t column) const {
    const std::size_t a = edge_of(row), r = line_of(row), j = column % other_;
    std::size_t i = 0, rest = column / other_;
    while (rest >= own_ - i) {
      rest -= own_ - i;
      ++i;
    }
    return Rational(edges_.heights[a][i] * cell_.exact_value(r, pair(i + rest, j)) +
                    edges_.heights[a][i + rest] * cell_.exact_value(r, pair(i, j)));
  }

 private:
  std::size_t pair(std::size_t i, std::size_t j) const { return source_ ? i * other_ + j : j * own_ + i; }

  const Line_cell& cell_;
  const Edge_forms& edges_;
  bool source_;
  std::size_t own_, other_;
};

bool Cell_proofs::by_forms(const Line_cell& cell, bool source, bool thoroughly, std::vector<Multiplier>& proof,
                           Weak_counters& counters) {
  const Near_polygon& own = source ? cell.domain->source : cell.domain->target;
  Edge_forms edges;
  const Form_products products(cell, edges, source);
  if (products.columns() > 400 || cell.rows.size() > 60) return false;
  if (!edges_of(own, *planes_[source ? 0 : 1], edges)) return false;

  // 1. The game of all products.
  products.fill(wide_);
  ++counters.form_programs;
  const double result = wide_.solve();
  if (result > (thoroughly ? 5e-12 : 1e-12)) return false;

  // 2. Exact weights, under which no sum is positive.
  const Row_weights weights = form_weights(products, edges, result, thoroughly);
  if (weights.empty()) return false;
  for (std::size_t c = 0; c < products.columns(); ++c) {
    Rational sum;
    for (const auto& [row, weight] : weights) sum += weight * products(row, c);
    if (sgn(sum) > 0) return false;
  }

  // 3. One form for each line.
  std::map<std::size_t, std::array<Rational, 4>> sums;
  for (const auto& [row, weight] : weights)
    for (std::size_t k = 0; k < 4; ++k)
      sums[products.line_of(row)][k] += weight * Rational(edges.forms[products.edge_of(row)][k]);
  for (const auto& [row, sum] : sums) {
    const auto [form, common] = Over_common(sum);
    Multiplier& multiplier =
        proof.emplace_back(Multiplier{cell.rows[row].place, cell.factor_of(row, Rational(Integer(1), common)), {}, {}});
    (source ? multiplier.source : multiplier.target) = form;
  }
  ++counters.by_forms;
  return true;
}

Cell_proofs::Row_weights Cell_proofs::form_weights(const Form_products& products, const Edge_forms& edges,
                                                   double result, bool thoroughly) {
  const auto of_edge = [&](std::size_t row) -> const Rational& { return edges.most[products.edge_of(row)]; };
  Row_weights weights;
  if (result < -1e-11) {  // there is room: the very doubles
    for (std::size_t row = 0; row < wide_.rows(); ++row)
      if (wide_.row_weights()[row] > 1e-10) weights.push_back({row, exact(wide_.row_weights()[row]) / of_edge(row)});
  } else if (thoroughly && wide_.rows() * products.columns() <= 1000 && exact_games_ < most_exact_games) {
    ++exact_games_;
    std::size_t bits = 0;
    exact_game_.restart(products.columns());
    for (std::size_t row = 0; row < wide_.rows(); ++row) {
      const std::span<Rational> values = exact_game_.add_row();
      for (std::size_t c = 0; c < values.size(); ++c) {
        values[c] = products(row, c) / of_edge(row);
        bits += bit_length(values[c].get_num()) + bit_length(values[c].get_den());
      }
    }
    if (bits > most_bits || sgn(exact_game_.solve()) > 0) return {};
    for (std::size_t row = 0; row < wide_.rows(); ++row)
      if (sgn(exact_game_.row_weights()[row]) > 0)
        weights.push_back({row, exact_game_.row_weights()[row] / of_edge(row)});
  } else {  // those of the basis
    const std::vector<std::size_t>& rows = wide_.tight_rows();
    std::vector<Rational> solved;
    Rational exact_result;
    if (!solve_basis(rows, wide_.tight_columns(), products, solved, exact_result, out_of_time_)) return {};
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (sgn(solved[k]) < 0) return {};
      if (sgn(solved[k]) > 0) weights.push_back({rows[k], solved[k]});
    }
  }
  return weights;
}

bool Cell_proofs::conclude(const Line_cell& cell, const std::vector<Weighted>& proposal,
                           std::vector<Multiplier>& proof) {
  if (proposal.empty() || !is_proof(cell, proposal)) return false;
  for (const Weighted& w : proposal) proof.push_back({cell.rows[w.row].place, cell.factor_of(w.row, w.exact), {}, {}});
  return true;
}

bool Cell_proofs::is_proof_in_doubles(const Line_cell& cell, const std::vector<Weighted>& weights) {
  const double rounding = 0x1p-52 * static_cast<double>(weights.size() + 2);  // of a product and as many sums
  for (std::size_t c = 0; c < cell.pairs(); ++c) {
    double sum = 0, error = 0x1p-1000;
    for (const Weighted& w : weights) {
      const double v = w.near * cell.value(w.row, c);
      sum += v;
      error += 1.0001 * (w.near * cell.rows[w.row].sides->error + rounding * std::fabs(v));
    }
    if (!(sum < -error)) return false;
  }
  return true;
}

bool Cell_proofs::is_proof(const Line_cell& cell, const std::vector<Weighted>& weights) {
  for (std::size_t c = 0; c < cell.pairs(); ++c) {
    Rational sum;
    for (const Weighted& w : weights) sum += w.exact * cell.exact_value(w.row, c);
    if (sgn(sum) > 0) return false;
  }
  return true;
}

bool Cell_proofs::corner_proof(const Line_cell& cell, const std::array<std::size_t, 3>& rows, bool source,
                               std::vector<Multiplier>& proof) const {
  const auto direction = [&](std::size_t k) {
    const Exact_pluecker& l = line_of(cell, rows[k % 3]).exact();
    return std::array<Integer, 3>{l[0], l[1], l[2]};
  };
  if (sgn(dot(direction(0), cross(direction(1), direction(2)))) == 0) return false;  // in one plane, or parallel
  std::vector<Multiplier> multipliers;
  int all = 0;  // the sign of all terms
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<Integer, 3> normal = cross(direction(k + 1), direction(k + 2));
    const std::array<Integer, 3> v = occluders_->grid_point(line_of(cell, rows[(k + 1) % 3]).points[0]);
    Weak_step::Form h{normal[0], normal[1], normal[2], Integer(-dot(normal, v))};
    const Near_plane plane = near_plane(occluders_->frame(), h);
    const Near_polygon& polygon = source ? cell.domain->source : cell.domain->target;
    const int position = side(plane, polygon);
    if (position == both_sides) return false;
    const Line_cell::Row& row = cell.rows[rows[k]];
    const int sign = position * row.literal.sign;
    if (sign == 0) continue;
    if (all == 0) all = sign;
    if (sign != all) return false;
    if (sign * row.literal.sign < 0)
      for (Integer& x : h) x = -x;
    Multiplier& m = multipliers.emplace_back(Multiplier{row.place, Rational(1), {}, {}});
    (source ? m.source : m.target) = h;
  }
  if (multipliers.empty()) return false;
  proof = std::move(multipliers);
  return true;
}

bool Cell_proofs::edges_of(const Near_polygon& polygon, const Near_plane& plane, Edge_forms& edges) {
  for (std::size_t a = 0; a < polygon.size(); ++a) {
    edges.forms.push_back(form_of(polygon, a, plane));
    std::vector<Rational>& heights = edges.heights.emplace_back();
    for (const Near_point& p : polygon) {
      Rational& height = heights.emplace_back(value({edges.forms[a], {}}, p), p.exact[3]);
      height.canonicalize();
    }
    if (sgn(*std::min_element(heights.begin(), heights.end())) < 0) return false;
    edges.most.push_back(*std::max_element(heights.begin(), heights.end()));
  }
  return true;
}

Weak_step::Form Cell_proofs::form_of(const Near_polygon& polygon, std::size_t edge, const Near_plane& plane) {
  const std::array<Integer, 4>&a = polygon[edge].exact, &b = polygon[(edge + 1) % polygon.size()].exact;
  std::array<Integer, 3> along;
  for (std::size_t k = 0; k < 3; ++k) along[k] = a[3] * b[k] - b[3] * a[k];
  const std::array<Integer, 4>& n = plane.exact;
  const std::array<Integer, 3> inward{n[1] * along[2] - n[2] * along[1], n[2] * along[0] - n[0] * along[2],
                                      n[0] * along[1] - n[1] * along[0]};
  Weak_step::Form form{inward[0] * a[3], inward[1] * a[3], inward[2] * a[3],
                       Integer(-(inward[0] * a[0] + inward[1] * a[1] + inward[2] * a[2]))};
  const Integer common = gcd(gcd(form[0], form[1]), gcd(form[2], form[3]));
  for (Integer& x : form) x /= common;
  return form;
}

}  // namespace sightline
