#pragma once
// Points by number, so that equal ones are seen to be equal, and chains of segments between them. To be read after
// polygons.h.

#include <sightline/algorithms/verify/polygons.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sightline::certificate_check {

/// A hash with a number's digits, not its sign. Another one in each process: nobody makes up numbers that have the
/// same.
std::size_t mixed_digits(std::size_t hash, mpz_srcptr n);

/// Different points, numbered as they come. Points are the same if their numbers are, digit by digit.
class Numbered_points {
 public:
  using Number = std::uint32_t;

  Number add(const Exact_point& p);  ///< its number, which is the next one if it is new
  std::vector<Number> add(const Polygon& polygon);
  std::optional<Number> find(const Exact_point& p) const;  ///< nothing where it was not added
  std::size_t size() const { return points_.size(); }
  const Exact_point& operator[](Number number) const { return points_[number]; }

 private:
  void grow();
  /// Where in the table it is, or would be. Pre: the table is not full.
  std::size_t place_of(const Exact_point& p, std::size_t hash) const;

  std::deque<Exact_point> points_;   // which never move: that would take memory for each
  std::vector<std::size_t> hashes_;  // of the points
  std::vector<Number> table_;        // by hash, open; as long as a power of two
};

/// The corners of polygons by number.
class Numbered_polygons {
 public:
  using Number = Numbered_points::Number;

  void add(const Polygon& polygon) {
    for (const Exact_point& p : polygon) numbers_.push_back(points_.add(p));
    ends_.push_back(numbers_.size());
  }
  void add_point(const Exact_point& p) { points_.add(p); }
  const Numbered_points& points() const { return points_; }
  std::span<const Number> operator[](std::size_t polygon) const {
    const std::size_t begin = polygon == 0 ? 0 : ends_[polygon - 1];
    return std::span(numbers_).subspan(begin, ends_[polygon] - begin);
  }

 private:
  Numbered_points points_;
  std::vector<Number> numbers_;
  std::vector<std::size_t> ends_;
};

/// Where what there is for each number stands, for the corners of a polygon.
template <class Value>
std::vector<const Value*> each_of(const std::vector<Value>& values, std::span<const Numbered_points::Number> numbers) {
  std::vector<const Value*> result;
  result.reserve(numbers.size());
  for (const Numbered_points::Number number : numbers) result.push_back(&values[number]);
  return result;
}

/// Sorts what has a number `from` and one `to`, both less than `numbers`, by these; what has the same stays in order.
/// Cost: O(n) where numbers are not many more than items, else O(n log n).
template <class Item>
void sort_by_ends(std::vector<Item>& items, std::size_t numbers) {
  const auto ends = [](const Item& item) { return std::pair(item.from, item.to); };
  if (items.size() < numbers / 4) {
    std::stable_sort(items.begin(), items.end(), [&](const Item& a, const Item& b) { return ends(a) < ends(b); });
    return;
  }
  std::vector<Item> sorted(items.size());
  for (const auto key : {&Item::to, &Item::from}) {
    std::vector<std::size_t> places(numbers + 1);
    for (const Item& item : items) ++places[item.*key + 1];
    std::partial_sum(places.begin(), places.end(), places.begin());
    for (const Item& item : items) sorted[places[item.*key]++] = item;
    items.swap(sorted);
  }
}

/// A sum of directed segments between numbered points as a chain: two sums are the same chain iff on each line, at each
/// point, the net number of arrivals is the same. A line through a known point is its direction, so the key is
/// (point, direction up to length and sign). Segments with the same two ends cancel first. Proof: P-21b
class Numbered_chain {
 public:
  using Number = Numbered_points::Number;

  void add(std::span<const Number> loop, long multiplicity);
  /// A point where the chain is not zero, the least of them, if there is one. `in_integers`: the points, or none.
  std::optional<Exact_point> nonzero(const Numbered_points& points,
                                     const std::vector<Homogeneous>& in_integers = {}) const;

 private:
  struct Segment {
    Number from, to;  // from < to
    long times;
  };
  std::vector<Segment> segments_;
};

}  // namespace sightline::certificate_check
