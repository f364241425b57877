#include <sightline/algorithms/weak_visibility/search/line_cell.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace sightline {
Line_domain::Line_domain(Shared_polygon s, Shared_polygon t)
    : shared_source(std::move(s)), shared_target(std::move(t)), source(*shared_source), target(*shared_target) {
  for (const Near_point& p : source) source_size = std::max(source_size, size(p.near));
  for (const Near_point& q : target) target_size = std::max(target_size, size(q.near));
}

const std::vector<Pluecker>& Line_domain::pairs() {
  if (pairs_.empty()) pairs_ = pairs_of(source, target);
  return pairs_;
}

void Line_domain::make_ways() {
  if (!ways_.empty()) return;
  ways_.reserve(pair_count());
  for (const Near_point& p : source)
    for (const Near_point& q : target) {
      ways_.push_back(way_between(p.near, p.rest, q.near, q.rest));
      longest_ = std::max(longest_, size(ways_.back()));
    }
}

const Exact_pluecker& Line_domain::exact_pluecker_of(std::size_t c) {
  if (exact_pairs.empty())
    for (const Near_point& p : source)
      for (const Near_point& q : target) exact_pairs.push_back(pluecker_of_pair(p.exact, q.exact));
  return exact_pairs[c];
}

Rational Line_domain::exact_side(const Edge_lines::Edge_line& line, std::size_t c, const Near_frame& frame) {
  return frame.near_cubic(dot(exact_pluecker_of(c), line.exact()), weight_of(c));
}

Integer Line_domain::weight_of(std::size_t c) const {
  return source[c / target.size()].exact[3] * target[c % target.size()].exact[3];
}

const std::vector<Rational>& Line_domain::exact_sides(const Edge_lines& lines, std::uint32_t id,
                                                      const Near_frame& frame) {
  std::vector<Rational>& exact = row_at(lines, id, frame).exact;
  for (std::size_t c = exact.size(); c < pair_count(); ++c) exact.push_back(exact_side(lines[id], c, frame));
  return exact;
}

Side_row& Line_domain::row_at(const Edge_lines& lines, std::uint32_t id, const Near_frame& frame) {
  if (rows.size() <= id) rows.resize(lines.size());
  if (!rows[id]) rows[id] = std::make_unique<Side_row>(row_of(lines[id], frame));
  return *rows[id];
}

Side_row Line_domain::row_of(const Edge_lines::Edge_line& line, const Near_frame& frame) {
  make_ways();
  Side_row r;
  r.values.reserve(pair_count());
  double most = 0, between = 0;
  for (std::size_t i = 0; i < source.size(); ++i) {
    const Triple to_line = way_between(source[i].near, source[i].rest, line.from, line.rest),
                 moment = cross(line.along, to_line);
    between = std::max(between, size(to_line));
    for (std::size_t j = 0; j < target.size(); ++j) {
      const Triple& way = ways_[i * target.size() + j];
      r.values.push_back(dot(moment, way));
      most = std::max(most, std::fabs(r.values.back()));
    }
  }
  r.error = side_error(longest_, size(line.along), between, source_size + target_size + line.reach);
  // 1. One side on all pairs? Integers are asked only if doubles do not show both signs.
  bool positive = false, negative = false;
  for (const double v : r.values) {
    positive |= v > r.error;
    negative |= v < -r.error;
  }
  std::vector<std::size_t> zeros;
  for (std::size_t c = 0; c < r.values.size() && !(positive && negative); ++c) {
    if (std::fabs(r.values[c]) > r.error) continue;
    const std::optional<int> small =
        line.occluders->small_side(source[c / target.size()], target[c % target.size()], line.points);
    const int sign = small ? *small : sgn(dot(exact_pluecker_of(c), line.exact()));
    positive |= sign > 0;
    negative |= sign < 0;
    if (sign == 0) zeros.push_back(c);
  }
  r.decided = positive == negative ? 0 : positive ? 1 : -1;
  // 2. At most 1. Where it is decided nobody asks for more than its sign.
  if (std::isfinite(r.error) && most >= 0x1p30 * r.error) {
    r.exponent = -std::ilogb(most) - 1;
    const double scale = std::ldexp(1.0, static_cast<int>(r.exponent));
    for (double& v : r.values) v *= scale;
    r.error *= scale;
  } else if (r.decided == 0) {  // small polygons, a line close to all of them, or far away: integers, rounded once
    std::vector<Integer> sides;
    long largest = std::numeric_limits<long>::min();
    for (std::size_t c = 0; c < pair_count(); ++c) {
      sides.push_back(dot(exact_pluecker_of(c), line.exact()));
      if (sgn(sides[c]) != 0) largest = std::max(largest, frame.exponent_of_cubic(sides[c], weight_of(c)));
    }
    r.exponent = largest == std::numeric_limits<long>::min() ? 0 : -largest;
    for (std::size_t c = 0; c < pair_count(); ++c) r.values[c] = frame.near_cubic(sides[c], weight_of(c), r.exponent);
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
