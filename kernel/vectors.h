#pragma once
// Vectors of three coordinates: differences, products of two of them. Of any number; as exact as that is.

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>

namespace sightline {

using Triple = std::array<double, 3>;  ///< a point or a vector in doubles

/// A class of vectors that is made of its coordinates, as Exact_point is: what is computed of two of them is one, too.
template <class Vector>
concept Own_vector = std::derived_from<Vector, std::array<typename Vector::value_type, 3>>;

/// a - b
template <class Number>
std::array<Number, 3> minus(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {Number(a[0] - b[0]), Number(a[1] - b[1]), Number(a[2] - b[2])};
}

template <Own_vector Vector>
Vector minus(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class Number>
Number dot(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return Number(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}

/// a x b: a, b and it are positively oriented.
template <class Number>
std::array<Number, 3> cross(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {Number(a[1] * b[2] - a[2] * b[1]), Number(a[2] * b[0] - a[0] * b[2]), Number(a[0] * b[1] - a[1] * b[0])};
}

template <Own_vector Vector>
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class Number>
bool is_zero(const std::array<Number, 3>& a) {
  return a[0] == 0 && a[1] == 0 && a[2] == 0;
}

/// The mean of points, of which there is one.
template <class Points>
auto middle_of(const Points& points) {
  std::decay_t<decltype(points[0])> sum = points[0];
  for (std::size_t i = 1; i < points.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) sum[k] += points[i][k];
  for (auto& x : sum) x /= static_cast<long>(points.size());
  return sum;
}

}  // namespace sightline
