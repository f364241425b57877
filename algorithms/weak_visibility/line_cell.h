#pragma once
// Cells of lines: those between two convex polygons that pass certain edges on certain sides.

#include <sightline/algorithms/weak_visibility/edge_lines.h>

#include <memory>

namespace sightline {

/// The sides of a line on all pairs of vertices of two polygons, scaled by a power of two to at most 1.
struct Side_row {
  std::vector<double> values;
  double error;
  int exponent;                      ///< of that scale
  int decided;                       ///< 1: nowhere negative, -1: nowhere positive, 0: neither
  std::vector<Rational> exact = {};  ///< unscaled, once they are asked for
};

/// A piece that may come between the polygons.
struct Candidate {
  std::uint32_t piece;
  int sense;    ///< 1: source in front and target behind, -1: the other way round, 0: one of them is on both sides
  float share;  ///< of all lines, that it blocks, by samples
};

/// Two convex polygons, the sides of lines on them, and what may come between. The lines from the one to the other are
/// mixtures of pairs of vertices.
struct Line_domain {
  using Shared_polygon =
      std::shared_ptr<const Near_polygon>;  // most domains share one of them with the domain that they are a part of

  Line_domain(Shared_polygon s, Shared_polygon t)
      : shared_source(std::move(s)), shared_target(std::move(t)), source(*shared_source), target(*shared_target) {
    for (const Near_point& p : source) source_size = std::max(source_size, size(p.near));
    for (const Near_point& q : target) target_size = std::max(target_size, size(q.near));
    for (const Near_point& p : source)
      for (const Near_point& q : target) pairs.push_back(pair_numbers(p.near, q.near));
  }

  const Exact_six& exact_pair_of(std::size_t c) {
    if (exact_pairs.empty())
      for (const Near_point& p : source)
        for (const Near_point& q : target) exact_pairs.push_back(exact_pair(p.exact, q.exact));
    return exact_pairs[c];
  }
  /// The side of a line on a pair of vertices in near coordinates, for points with last coordinate 1. Exact: yes.
  Rational exact_side(const Edge_lines::Line& line, std::size_t c, const Near_frame& frame) {
    return frame.near_cubic(dot(exact_pair_of(c), line.exact),
                            Integer(source[c / target.size()].exact[3] * target[c % target.size()].exact[3]));
  }
  /// All of them, made when they are first asked for. Exact: yes.
  const std::vector<Rational>& exact_sides(const Edge_lines& lines, std::uint32_t id, const Near_frame& frame) {
    std::vector<Rational>& exact = row_at(lines, id, frame).exact;
    for (std::size_t c = exact.size(); c < pairs.size(); ++c) exact.push_back(exact_side(lines[id], c, frame));
    return exact;
  }
  /// The line's row, made when it is first asked for. Its signs are exact where it is decided.
  const Side_row& row(const Edge_lines& lines, std::uint32_t id, const Near_frame& frame) {
    return row_at(lines, id, frame);
  }

  Shared_polygon shared_source, shared_target;
  const Near_polygon &source, &target;
  double source_size = 0, target_size = 0;
  std::vector<Six> pairs;
  std::vector<Exact_six> exact_pairs;  ///< once they are asked for
  std::vector<std::unique_ptr<Side_row>> rows;
  std::vector<Candidate> candidates;  ///< once they are asked for: `settled`
  bool settled = false;
  int bisections = 0, narrowed = 0;

 private:
  Side_row& row_at(const Edge_lines& lines, std::uint32_t id, const Near_frame& frame) {
    if (rows.size() <= id) rows.resize(lines.size());
    if (!rows[id]) rows[id] = std::make_unique<Side_row>(row_of(lines[id], frame));
    return *rows[id];
  }
  Side_row row_of(const Edge_lines::Line& line, const Near_frame& frame) {
    Side_row r;
    r.values.reserve(pairs.size());
    double most = 0;
    for (const Six& pair : pairs) {
      r.values.push_back(dot(pair, line.near));
      most = std::max(most, std::fabs(r.values.back()));
    }
    r.error = 0x1p-46 * ((source_size + target_size) * line.ends_product + source_size * target_size * line.ends_sum) +
              0x1p-1000;
    if (most < 0x1p30 * r.error) {  // small polygons, or a line close to all of them: integers, rounded once
      most = 0;
      for (std::size_t c = 0; c < r.values.size(); ++c) {
        r.values[c] = nearest_double(exact_side(line, c, frame));
        most = std::max(most, std::fabs(r.values[c]));
      }
      r.error = 0x1p-52 * most + 0x1p-1060;
    }
    r.exponent = most > 0x1p-900 ? -std::ilogb(most) - 1 : 0;
    const double scale = std::ldexp(1.0, r.exponent);
    for (double& v : r.values) v *= scale;
    r.error *= scale;
    // One side on all pairs? Integers are asked only if doubles do not show both signs.
    bool positive = false, negative = false;
    for (const double v : r.values) positive |= v > r.error, negative |= v < -r.error;
    for (std::size_t c = 0; c < r.values.size() && !(positive && negative); ++c) {
      if (std::fabs(r.values[c]) > r.error) continue;
      const int sign = sgn(dot(exact_pair_of(c), line.exact));
      positive |= sign > 0, negative |= sign < 0;
      if (sign == 0) r.values[c] = 0;
    }
    r.decided = positive == negative ? 0 : positive ? 1 : -1;
    return r;
  }
};

/// x 2^exponent. Exact: yes.
inline Rational times_power(Rational x, long exponent) {
  if (exponent >= 0) mpq_mul_2exp(x.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
  else mpq_div_2exp(x.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  return x;
}

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

  std::size_t pairs() const { return domain->pairs.size(); }
  double value(std::size_t row, std::size_t c) const { return rows[row].literal.sign * rows[row].sides->values[c]; }
  /// What value() is a rounded one of. Exact: yes.
  Rational exact_value(std::size_t row, std::size_t c) const {
    const Rational& v = domain->exact_sides(*lines, rows[row].literal.line, *frame)[c];
    return factor_of(row, rows[row].literal.sign > 0 ? v : Rational(-v));
  }
  /// A weight of a scaled row as a factor of the unscaled one.
  Rational factor_of(std::size_t row, Rational weight) const {
    return times_power(std::move(weight), rows[row].sides->exponent);
  }
};

}  // namespace sightline
