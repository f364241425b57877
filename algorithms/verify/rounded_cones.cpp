#include <sightline/algorithms/verify/rounded_cones.h>

#include <sightline/kernel/number.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sightline::order_check {

namespace {

/// Post: vector = (rounded + errors of less than 2^-52) x 2^exponent.
struct Rounded_vector {
  std::array<double, 3> rounded;
  long exponent = 0;

  explicit Rounded_vector(const Integer_vector& vector) {
    std::array<long, 3> exponents;
    for (std::size_t k = 0; k < 3; ++k) rounded[k] = mpz_get_d_2exp(&exponents[k], vector[k].get_mpz_t());
    exponent = *std::max_element(exponents.begin(), exponents.end());
    for (std::size_t k = 0; k < 3; ++k)  // what is 2^-2000 of the longest may as well be zero
      rounded[k] = std::ldexp(rounded[k], static_cast<int>(std::max(exponents[k] - exponent, -2000L)));
  }
};

}  // namespace

Rounded_cone::Rounded_cone(const Cone& cone) {
  constexpr long range = 900;
  for (const Integer_vector& ray : cone.rays) rays.push_back(Rounded_vector(ray).rounded);
  const Rounded_vector form(cone.nearness);
  long exponent = 0;
  distance = mpz_get_d_2exp(&exponent, cone.distance.get_mpz_t());
  nearness = form.rounded;
  exponent -= form.exponent;
  distance = std::abs(exponent) < range ? std::ldexp(distance, static_cast<int>(exponent))
                                        : std::numeric_limits<double>::quiet_NaN();
}

std::optional<int> side_to_plane(const Rounded_cone& a, std::size_t ray, const Rounded_cone& b) {
  constexpr double error = 0x1p-45;
  const std::array<double, 3>& d = a.rays[ray];
  const auto along = [&](const std::array<double, 3>& u) { return u[0] * d[0] + u[1] * d[1] + u[2] * d[2]; };
  const double height = a.distance * along(b.nearness) - b.distance * along(a.nearness);
  if (height > error * std::max(a.distance, b.distance)) return 1;
  if (height < -error * std::max(a.distance, b.distance)) return -1;
  return std::nullopt;
}

bool nowhere_nearer(const Rounded_cone& a, const Rounded_cone& b) {
  const auto all_are = [](const Rounded_cone& polygon, const Rounded_cone& plane, int side) {
    for (std::size_t ray = 0; ray < polygon.rays.size(); ++ray)
      if (side_to_plane(polygon, ray, plane) != side) return false;
    return true;
  };
  return all_are(a, b, 1) || all_are(b, a, -1);
}

}  // namespace sightline::order_check
