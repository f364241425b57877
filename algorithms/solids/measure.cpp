#include <sightline/algorithms/solids/measure.h>

#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sightline {

namespace {

/// The sum of many rationals, halves first: denominators grow as late as they can.
class Long_sum {
 public:
  void add(Rational value) {
    for (std::size_t filled = ++count_; filled % 2 == 0; filled /= 2) {
      value += parts_.back();
      parts_.pop_back();
    }
    parts_.push_back(std::move(value));
  }
  Rational sum() {
    while (parts_.size() > 1) {
      const Rational last = std::move(parts_.back());
      parts_.pop_back();
      parts_.back() += last;
    }
    return parts_.empty() ? Rational() : parts_[0];
  }

 private:
  std::vector<Rational> parts_;
  std::size_t count_ = 0;
};

}  // namespace

Exact_point doubled_area_vector(const Polygon_soup& soup, Face_id f) {
  Exact_point sum;
  for (std::size_t k = 0; k < soup.loop_count(f); ++k) {
    const std::span<const Point_id> loop = soup.loop(f, k);
    if (loop.size() < 3) continue;
    const Exact_point origin = soup.point(loop[0]);
    Exact_point before = minus(soup.point(loop[1]), origin);
    for (std::size_t i = 2; i < loop.size(); ++i) {
      const Exact_point next = minus(soup.point(loop[i]), origin);
      const Exact_point part = cross(before, next);
      for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += part[axis];
      before = next;
    }
  }
  return sum;
}

Rational volume(const Polygon_soup& soup) {
  // Whole points, in units of the common denominator of those that have a short one, are summed as integers.
  Integer scale = 1;
  for (const auto& [denominator, uses] : soup.coordinates.denominators())
    if (const Integer next = lcm(scale, denominator); bit_length(next) <= 256) scale = next;
  std::vector<std::array<Integer, 3>> whole(soup.point_count());
  std::vector<bool> is_whole(soup.point_count());
  for (Point_id p = 0; p < soup.point_count(); ++p) {
    const Exact_point at = soup.point(p);
    is_whole[p] = true;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!mpz_divisible_p(scale.get_mpz_t(), at[k].get_den_mpz_t())) is_whole[p] = false;
      else whole[p][k] = at[k].get_num() * (scale / at[k].get_den());
    }
  }
  Integer wholes;
  Long_sum others;
  for (Face_id f = 0; f < soup.face_count(); ++f)
    for (std::size_t k = 0; k < soup.loop_count(f); ++k) {
      const std::span<const Point_id> loop = soup.loop(f, k);
      for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
        const Point_id p = loop[0], q = loop[i], r = loop[i + 1];
        if (is_whole[p] && is_whole[q] && is_whole[r]) wholes += dot(whole[p], cross(whole[q], whole[r]));
        else others.add(dot(soup.point(p), cross(soup.point(q), soup.point(r))));
      }
    }
  Rational sum(wholes, Integer(scale * scale * scale));
  sum.canonicalize();
  return (sum + others.sum()) / 6;
}

std::array<double, 2> area(const Polygon_soup& soup) {
  double low = 0, high = 0;
  const double up = std::numeric_limits<double>::infinity();
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    const Exact_point n = doubled_area_vector(soup, f);
    // Its length, scaled so that squares neither overflow nor vanish.
    double largest = 0;
    std::array<double, 3> near;
    for (std::size_t k = 0; k < 3; ++k) {
      near[k] = std::fabs(nearest_double(n[k]));
      largest = std::max(largest, near[k]);
    }
    if (largest == 0) {
      if (sgn(n[0]) != 0 || sgn(n[1]) != 0 || sgn(n[2]) != 0) high = std::nextafter(high, up);
      continue;
    }
    if (std::isinf(largest)) {
      low = std::max(low, std::numeric_limits<double>::max() / 2);
      high = up;
      continue;
    }
    double squares = 0;
    for (const double x : near) squares += (x / largest) * (x / largest);
    const double length = std::sqrt(squares) / 2 * largest;
    low = std::nextafter(low + length * (1 - 0x1p-48), -up);
    high = std::nextafter(high + length * (1 + 0x1p-48) + 0x1p-1070, up);
  }
  return {std::max(0.0, low), high};
}

}  // namespace sightline
