#include <sightline/algorithms/verify/numbered_points.h>

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace sightline::certificate_check {

namespace {

constexpr Numbered_points::Number empty = std::numeric_limits<Numbered_points::Number>::max();

std::size_t hash_of(const Exact_point& p) {
  std::size_t hash = 0;
  for (const Rational& x : p)
    for (const mpz_srcptr part : {x.get_num_mpz_t(), x.get_den_mpz_t()})
      for (std::size_t k = 0; k < mpz_size(part); ++k)
        hash = (hash ^ hash >> 29 ^ mpz_getlimbn(part, static_cast<mp_size_t>(k))) * 0x9e3779b97f4a7c15;
  return hash ^ hash >> 32;
}

}  // namespace

Numbered_points::Number Numbered_points::add(const Exact_point& p) {
  if (2 * (points_.size() + 1) > table_.size()) grow();
  const std::size_t hash = hash_of(p);
  for (std::size_t place = hash % table_.size();; place = place + 1 == table_.size() ? 0 : place + 1) {
    Number& number = table_[place];
    if (number == empty) {
      number = static_cast<Number>(points_.size());
      points_.push_back(p);
      hashes_.push_back(hash);
    } else if (hashes_[number] != hash || points_[number] != p) {
      continue;
    }
    return number;
  }
}

std::vector<Numbered_points::Number> Numbered_points::add(const Polygon& polygon) {
  std::vector<Number> numbers;
  numbers.reserve(polygon.size());
  for (const Exact_point& p : polygon) numbers.push_back(add(p));
  return numbers;
}

void Numbered_points::grow() {
  table_.assign(std::max<std::size_t>(16, 4 * points_.size()), empty);
  for (Number number = 0; number < points_.size(); ++number) {
    std::size_t place = hashes_[number] % table_.size();
    while (table_[place] != empty) place = place + 1 == table_.size() ? 0 : place + 1;
    table_[place] = number;
  }
}

void Numbered_chain::add(std::span<const Number> loop, long multiplicity) {
  if (loop.empty()) return;
  Number from = loop.back();
  for (const Number to : loop) {
    if (from < to) segments_.push_back({from, to, multiplicity});
    if (to < from) segments_.push_back({to, from, -multiplicity});
    from = to;
  }
}

std::optional<Exact_point> Numbered_chain::nonzero(const Numbered_points& points) const {
  // 1. What is left between points.
  std::vector<Segment> sorted = segments_, left;
  std::sort(sorted.begin(), sorted.end(),
            [](const Segment& a, const Segment& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); });
  for (std::size_t i = 0; i < sorted.size();) {
    Segment sum = sorted[i];
    for (++i; i < sorted.size() && sorted[i].from == sum.from && sorted[i].to == sum.to; ++i)
      sum.times += sorted[i].times;
    if (sum.times != 0) left.push_back(sum);
  }
  // 2. Laid on lines, where parts of segments may cancel.
  std::map<std::pair<Integer_vector, Number>, long> arrivals;
  for (const auto& [from, to, times] : left) {
    Integer_vector direction = primitive(minus(homogeneous(points[to]), homogeneous(points[from])));
    if (direction < Integer_vector{}) direction = negated(direction);
    arrivals[{direction, to}] += times;
    arrivals[{std::move(direction), from}] -= times;
  }
  const Exact_point* least = nullptr;  // so that what is said does not depend on numbers
  for (const auto& [place, count] : arrivals)
    if (count != 0 && (least == nullptr || points[place.second] < *least)) least = &points[place.second];
  return least == nullptr ? std::nullopt : std::optional(*least);
}

}  // namespace sightline::certificate_check
