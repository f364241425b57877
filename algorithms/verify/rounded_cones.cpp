#include <sightline/algorithms/verify/rounded_cones.h>

#include <sightline/algorithms/verify/parallel.h>
#include <sightline/kernel/number.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sightline::order_check {

namespace {

/// Post: vector = (rounded + errors of less than 2^-52) x 2^exponent.
struct Scaled_vector {
  Rounded_vector rounded;
  long exponent = 0;

  explicit Scaled_vector(const Integer_vector& vector) {
    std::array<long, 3> exponents;
    for (std::size_t k = 0; k < 3; ++k) rounded[k] = mpz_get_d_2exp(&exponents[k], vector[k].get_mpz_t());
    exponent = *std::max_element(exponents.begin(), exponents.end());
    for (std::size_t k = 0; k < 3; ++k)  // what is 2^-2000 of the longest may as well be zero
      rounded[k] = std::ldexp(rounded[k], static_cast<int>(std::max(exponents[k] - exponent, -2000L)));
  }
};

}  // namespace

Rounded_vector rounded(const Integer_vector& vector) { return Scaled_vector(vector).rounded; }

std::optional<int> sign_in_doubles(const Rounded_vector& a, const Rounded_vector& b) {
  const double value = rounded_dot(a, b);
  if (value > rounding_error) return 1;
  if (value < -rounding_error) return -1;
  return std::nullopt;
}

Rounded_cone::Rounded_cone(const Cone& cone) {
  constexpr long range = 900;
  for (const Integer_vector& ray : cone.rays) rays.push_back(rounded(ray));
  const Scaled_vector form(cone.nearness);
  long exponent = 0;
  distance = mpz_get_d_2exp(&exponent, cone.distance.get_mpz_t());
  nearness = form.rounded;
  sense = cone.sense;
  exponent -= form.exponent;
  distance = std::abs(exponent) < range ? std::ldexp(distance, static_cast<int>(exponent))
                                        : std::numeric_limits<double>::quiet_NaN();
}

std::optional<int> side_to_plane(const Rounded_cone& a, std::size_t ray, const Rounded_cone& b) {
  return Rounded_height(a, b).side(a.rays[ray]);
}

std::optional<int> side_of_edge(const Rounded_cone& a, std::size_t edge, const Rounded_vector& ray) {
  const Rounded_vector &from = a.rays[edge], &to = a.rays[edge + 1 == a.rays.size() ? 0 : edge + 1];
  const Rounded_vector plane{from[1] * to[2] - from[2] * to[1], from[2] * to[0] - from[0] * to[2],
                             from[0] * to[1] - from[1] * to[0]};
  const std::optional<int> sign = sign_in_doubles(plane, ray);
  return sign ? std::optional(*sign * a.sense) : std::nullopt;
}

std::vector<Rounded_cone> rounded(const std::vector<Cone>& cones, const Workers& workers) {
  constexpr std::size_t worth_a_thread = 1000;
  std::vector<Rounded_cone> result(cones.size());
  for_each_below(cones.size(), worth_a_thread, workers, [&](std::size_t i) { result[i] = Rounded_cone(cones[i]); });
  return result;
}

bool nowhere_nearer(const Rounded_cone& a, const Rounded_cone& b) {
  const auto all_are = [](const Rounded_cone& polygon, const Rounded_cone& plane, int side) {
    const Rounded_height height(polygon, plane);
    return std::all_of(polygon.rays.begin(), polygon.rays.end(),
                       [&](const Rounded_vector& ray) { return height.side(ray) == side; });
  };
  return all_are(a, b, 1) || all_are(b, a, -1);
}

}  // namespace sightline::order_check
