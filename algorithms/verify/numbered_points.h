#pragma once
// Points by number, so that equal ones are seen to be equal, and chains of segments between them. To be read after
// polygons.h.

#include <sightline/algorithms/verify/polygons.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace sightline::certificate_check {

/// Different points, numbered as they come. Points are the same if their numbers are, digit by digit.
class Numbered_points {
 public:
  using Number = std::uint32_t;

  Number add(const Exact_point& p);  ///< its number, which is the next one if it is new
  std::vector<Number> add(const Polygon& polygon);
  std::size_t size() const { return points_.size(); }
  const Exact_point& operator[](Number number) const { return points_[number]; }

 private:
  void grow();

  std::vector<Exact_point> points_;
  std::vector<std::size_t> hashes_;  // of the points
  std::vector<Number> table_;        // by hash, open; size() or more: empty
};

/// A sum of directed segments between numbered points as a chain: two sums are the same chain iff on each line, at each
/// point, the net number of arrivals is the same. A line through a known point is its direction, so the key is
/// (direction up to sign, point). Segments with the same two ends cancel first. Proof: P-21b
class Numbered_chain {
 public:
  using Number = Numbered_points::Number;

  void add(std::span<const Number> loop, long multiplicity);
  /// A point where the chain is not zero, the least of them, if there is one.
  std::optional<Exact_point> nonzero(const Numbered_points& points) const;

 private:
  struct Segment {
    Number from, to;  // from < to
    long times;
  };
  std::vector<Segment> segments_;
};

}  // namespace sightline::certificate_check
