#include <sightline/algorithms/weak_visibility/search/line_cell.h>

#include <algorithm>
#include <cmath>

namespace sightline {

Line_domain::Line_domain(Shared_polygon s, Shared_polygon t)
    : shared_source(std::move(s)), shared_target(std::move(t)), source(*shared_source), target(*shared_target) {
  for (const Near_point& p : source) source_size = std::max(source_size, size(p.near));
  for (const Near_point& q : target) target_size = std::max(target_size, size(q.near));
  for (const Near_point& p : source)
    for (const Near_point& q : target) pairs.push_back(pluecker_of_pair(p.near, q.near));
}

const Exact_pluecker& Line_domain::exact_pluecker_of(std::size_t c) {
  if (exact_pairs.empty())
    for (const Near_point& p : source)
      for (const Near_point& q : target) exact_pairs.push_back(pluecker_of_pair(p.exact, q.exact));
  return exact_pairs[c];
}

Rational Line_domain::exact_side(const Edge_lines::Edge_line& line, std::size_t c, const Near_frame& frame) {
  return frame.near_cubic(dot(exact_pluecker_of(c), line.exact),
                          Integer(source[c / target.size()].exact[3] * target[c % target.size()].exact[3]));
}

const std::vector<Rational>& Line_domain::exact_sides(const Edge_lines& lines, std::uint32_t id,
                                                      const Near_frame& frame) {
  std::vector<Rational>& exact = row_at(lines, id, frame).exact;
  for (std::size_t c = exact.size(); c < pairs.size(); ++c) exact.push_back(exact_side(lines[id], c, frame));
  return exact;
}

Side_row& Line_domain::row_at(const Edge_lines& lines, std::uint32_t id, const Near_frame& frame) {
  if (rows.size() <= id) rows.resize(lines.size());
  if (!rows[id]) rows[id] = std::make_unique<Side_row>(row_of(lines[id], frame));
  return *rows[id];
}

Side_row Line_domain::row_of(const Edge_lines::Edge_line& line, const Near_frame& frame) {
  Side_row r;
  r.values.reserve(pairs.size());
  double most = 0;
  for (const Pluecker& pair : pairs) {
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
  for (const double v : r.values) {
    positive |= v > r.error;
    negative |= v < -r.error;
  }
  for (std::size_t c = 0; c < r.values.size() && !(positive && negative); ++c) {
    if (std::fabs(r.values[c]) > r.error) continue;
    const int sign = sgn(dot(exact_pluecker_of(c), line.exact));
    positive |= sign > 0;
    negative |= sign < 0;
    if (sign == 0) r.values[c] = 0;
  }
  r.decided = positive == negative ? 0 : positive ? 1 : -1;
  return r;
}

Rational times_power(Rational x, long exponent) {
  if (exponent >= 0) mpq_mul_2exp(x.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
  else mpq_div_2exp(x.get_mpq_t(), x.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  return x;
}

Rational Line_cell::exact_value(std::size_t row, std::size_t c) const {
  const Rational& v = domain->exact_sides(*lines, rows[row].literal.line, *frame)[c];
  return factor_of(row, rows[row].literal.sign > 0 ? v : Rational(-v));
}

}  // namespace sightline
