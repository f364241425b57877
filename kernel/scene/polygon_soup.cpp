#include <sightline/kernel/scene/polygon_soup.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace sightline {

namespace {

std::string no_coordinate(double x) { return std::to_string(x) + " is no coordinate; give the point finite ones"; }

}  // namespace

void Exact_point::check_finite(double x, int axis) {
  if (!std::isfinite(x)) throw std::domain_error(std::string("a point's ") + "xyz"[axis] + ": " + no_coordinate(x));
}

Exact_point scaled_to_one(Exact_point v) {
  std::optional<long> largest;
  for (const Rational& x : v)
    if (sgn(x) != 0) largest = std::max(largest.value_or(binary_exponent(x)), binary_exponent(x));
  if (largest)
    for (Rational& x : v) x = times_power(std::move(x), -(*largest + 1));
  return v;
}

Point_id Polygon_soup::add_point(const Rational& x, const Rational& y, const Rational& z) {
  coordinates.push(x);
  coordinates.push(y);
  coordinates.push(z);
  return static_cast<Point_id>(point_count() - 1);
}

Point_id Polygon_soup::add_point(double x, double y, double z) {
  for (const double coordinate : {x, y, z})
    if (!std::isfinite(coordinate))
      throw std::domain_error("point " + std::to_string(point_count()) + ": " + no_coordinate(coordinate));
  coordinates.push_double(x);
  coordinates.push_double(y);
  coordinates.push_double(z);
  return static_cast<Point_id>(point_count() - 1);
}

Point_id Polygon_soup::add_point(const std::array<std::int64_t, 3>& numerators, std::int64_t denominator) {
  for (const std::int64_t numerator : numerators) coordinates.push_ratio(numerator, denominator);
  return static_cast<Point_id>(point_count() - 1);
}

void Polygon_soup::check_corners() const {
  const auto is_there = [this](Point_id p) { return p < point_count(); };
  if (std::all_of(corners_.begin(), corners_.end(), is_there)) return;
  for (Face_id f = 0; f < face_count(); ++f)
    for (std::size_t k = 0; k < loop_count(f); ++k)
      for (const Point_id p : loop(f, k))
        if (!is_there(p))
          throw std::out_of_range("face " + std::to_string(f) + " has the corner " + std::to_string(p) +
                                  ", and there are " + std::to_string(point_count()) + " points, counted from 0");
}

}  // namespace sightline
