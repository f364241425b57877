#include <sightline/algorithms/verify/numbered_points.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <random>
#include <span>
#include <utility>

namespace sightline::certificate_check {

namespace {

constexpr Numbered_points::Number empty = std::numeric_limits<Numbered_points::Number>::max();

std::size_t hash_of(const Exact_point& p) {
  std::size_t hash = 0;
  for (const Rational& x : p)
    for (const mpz_srcptr part : {x.get_num_mpz_t(), x.get_den_mpz_t()}) hash = mixed_digits(hash, part);
  return hash;
}

}  // namespace

std::size_t mixed_digits(std::size_t hash, mpz_srcptr n) {
  static const std::array<std::uint64_t, 2> secret = [] {
    std::random_device random;
    std::array<std::uint64_t, 2> words;
    for (std::uint64_t& word : words) word = std::uint64_t{random()} << 32 | random();
    return words;
  }();
  const auto mix = [&](std::uint64_t limb) {
    const unsigned __int128 product = static_cast<unsigned __int128>(hash ^ secret[0]) * (limb ^ secret[1]);
    hash = static_cast<std::size_t>(product) ^ static_cast<std::size_t>(product >> 64);
  };
  mix(mpz_size(n));  // or the same limbs, divided otherwise among several numbers, would have one hash
  for (std::size_t k = 0; k < mpz_size(n); ++k) mix(mpz_getlimbn(n, static_cast<mp_size_t>(k)));
  return hash;
}

std::size_t Numbered_points::place_of(const Exact_point& p, std::size_t hash) const {
  const std::size_t last = table_.size() - 1;
  std::size_t place = hash & last;
  while (table_[place] != empty && (hashes_[table_[place]] != hash || points_[table_[place]] != p))
    place = (place + 1) & last;
  return place;
}

Numbered_points::Number Numbered_points::add(const Exact_point& p) {
  if (2 * (points_.size() + 1) > table_.size()) grow();
  const std::size_t hash = hash_of(p);
  Number& number = table_[place_of(p, hash)];
  if (number == empty) {
    number = static_cast<Number>(points_.size());
    points_.push_back(p);
    hashes_.push_back(hash);
  }
  return number;
}

std::optional<Numbered_points::Number> Numbered_points::find(const Exact_point& p) const {
  if (table_.empty()) return std::nullopt;
  const Number number = table_[place_of(p, hash_of(p))];
  return number == empty ? std::nullopt : std::optional(number);
}

std::vector<Numbered_points::Number> Numbered_points::add(const Polygon& polygon) {
  std::vector<Number> numbers;
  numbers.reserve(polygon.size());
  for (const Exact_point& p : polygon) numbers.push_back(add(p));
  return numbers;
}

void Numbered_points::grow() {
  table_.assign(std::max<std::size_t>(16, 2 * table_.size()), empty);
  const std::size_t last = table_.size() - 1;
  for (Number number = 0; number < points_.size(); ++number) {
    std::size_t place = hashes_[number] & last;
    while (table_[place] != empty) place = (place + 1) & last;
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

namespace {

/// A direction and how often a point is arrived at along its line.
struct Arrival {
  Numbered_points::Number point;
  std::size_t direction;
  long times;
};

bool are_parallel(const Integer_vector& a, const Integer_vector& b) {
  thread_local Integer one, other;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t x = (k + 1) % 3, y = (k + 2) % 3;
    mpz_mul(one.get_mpz_t(), a[x].get_mpz_t(), b[y].get_mpz_t());
    mpz_mul(other.get_mpz_t(), a[y].get_mpz_t(), b[x].get_mpz_t());
    if (one != other) return false;
  }
  return true;
}

/// Whether, of arrivals at one point, those along each line add up to none.
bool cancel(std::span<Arrival> arrivals, const std::vector<Integer_vector>& directions) {
  constexpr std::size_t one_by_one = 8;
  if (arrivals.size() > one_by_one) {
    std::map<Integer_vector, long> sums;
    for (const Arrival& arrival : arrivals) {
      Integer_vector direction = primitive(directions[arrival.direction]);
      if (direction < Integer_vector{}) direction = negated(direction);
      sums[std::move(direction)] += arrival.times;
    }
    return std::all_of(sums.begin(), sums.end(), [](const auto& sum) { return sum.second == 0; });
  }
  while (!arrivals.empty()) {
    const Integer_vector& direction = directions[arrivals[0].direction];
    const auto others = std::partition(arrivals.begin() + 1, arrivals.end(), [&](const Arrival& arrival) {
      return are_parallel(direction, directions[arrival.direction]);
    });
    long sum = 0;
    for (auto arrival = arrivals.begin(); arrival != others; ++arrival) sum += arrival->times;
    if (sum != 0) return false;
    arrivals = {others, arrivals.end()};
  }
  return true;
}

}  // namespace

std::optional<Exact_point> Numbered_chain::nonzero(const Numbered_points& points,
                                                   const std::vector<Homogeneous>& in_integers) const {
  // 1. What is left between points.
  std::vector<Segment> sorted = segments_;
  sort_by_ends(sorted, points.size());
  std::vector<Integer_vector> directions;
  std::vector<Arrival> arrivals;
  for (std::size_t i = 0; i < sorted.size();) {
    auto [from, to, times] = sorted[i];
    for (++i; i < sorted.size() && sorted[i].from == from && sorted[i].to == to; ++i) times += sorted[i].times;
    if (times == 0) continue;
    arrivals.push_back({to, directions.size(), times});
    arrivals.push_back({from, directions.size(), -times});
    directions.push_back(in_integers.empty() ? minus(homogeneous(points[to]), homogeneous(points[from]))
                                             : minus(in_integers[to], in_integers[from]));
  }
  // 2. Laid on lines, where parts of segments may cancel.
  std::sort(arrivals.begin(), arrivals.end(), [](const Arrival& a, const Arrival& b) { return a.point < b.point; });
  const Exact_point* least = nullptr;  // so that what is said does not depend on numbers
  for (std::size_t i = 0, end = 0; i < arrivals.size(); i = end) {
    const Number point = arrivals[i].point;
    while (end < arrivals.size() && arrivals[end].point == point) ++end;
    if ((least == nullptr || points[point] < *least) && !cancel({&arrivals[i], end - i}, directions))
      least = &points[point];
  }
  return least == nullptr ? std::nullopt : std::optional(*least);
}

}  // namespace sightline::certificate_check
