#include <sightline/algorithms/weak_visibility/search/line_cell.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sightline {
namespace {

/// e with all numbers less than 2^e in size, one of them at least 2^(e - 2); 0 where all are 0.
long exponent_of_largest(const std::vector<Rational>& numbers) {
  const auto largest = std::max_element(numbers.begin(), numbers.end(),
                                        [](const Rational& a, const Rational& b) { return cmp(abs(a), abs(b)) < 0; });
  if (sgn(*largest) == 0) return 0;
  return static_cast<long>(bit_length(largest->get_num())) - static_cast<long>(bit_length(largest->get_den())) + 1;
}

}  // namespace

Line_domain::Line_domain(Shared_polygon s, Shared_polygon t)
    : shared_source(std::move(s)), shared_target(std::move(t)), source(*shared_source), target(*shared_target) {
  for (const Near_point& p : source) source_size = std::max(source_size, size(p.near));
  for (const Near_point& q : target) target_size = std::max(target_size, size(q.near));
  pairs = pairs_of(source, target);
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
  r.error = side_error(ends(source_size, target_size), line.ends);
  // 1. One side on all pairs? Integers are asked only if doubles do not show both signs.
  bool positive = false, negative = false;
  for (const double v : r.values) {
    positive |= v > r.error;
    negative |= v < -r.error;
  }
  std::vector<std::size_t> zeros;
  for (std::size_t c = 0; c < r.values.size() && !(positive && negative); ++c) {
    if (std::fabs(r.values[c]) > r.error) continue;
    const int sign = sgn(dot(exact_pluecker_of(c), line.exact));
    positive |= sign > 0;
    negative |= sign < 0;
    if (sign == 0) zeros.push_back(c);
  }
  r.decided = positive == negative ? 0 : positive ? 1 : -1;
  // 2. At most 1. Where it is decided nobody asks for more than its sign.
  if (most >= 0x1p30 * r.error) {
    r.exponent = -std::ilogb(most) - 1;
    const double scale = std::ldexp(1.0, static_cast<int>(r.exponent));
    for (double& v : r.values) v *= scale;
    r.error *= scale;
  } else if (r.decided == 0) {  // small polygons, a line close to all of them, or far away: integers, rounded once
    std::vector<Rational> sides;
    for (std::size_t c = 0; c < pairs.size(); ++c) sides.push_back(exact_side(line, c, frame));
    r.exponent = -exponent_of_largest(sides);
    for (std::size_t c = 0; c < pairs.size(); ++c)
      r.values[c] = nearest_double(times_power(std::move(sides[c]), r.exponent));
    r.error = 0x1p-52;
  }
  for (const std::size_t c : zeros) r.values[c] = 0;
  return r;
}

Rational Line_cell::exact_value(std::size_t row, std::size_t c) const {
  const Rational& v = domain->exact_sides(*lines, rows[row].literal.line, *frame)[c];
  return factor_of(row, rows[row].literal.sign > 0 ? v : Rational(-v));
}

}  // namespace sightline
