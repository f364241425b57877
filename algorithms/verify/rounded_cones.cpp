#include <sightline/algorithms/verify/rounded_cones.h>

#include <sightline/kernel/number.h>

#include <algorithm>
#include <cmath>

namespace sightline::order_check {

namespace {

/// The numbers times one power of two, the longest in [1/2, 1), each with an error of less than 2^-52.
template <std::size_t n>
std::array<double, n> rounded(const std::array<const Integer*, n>& numbers) {
  std::array<double, n> result;
  std::array<long, n> exponents;
  long largest = 0;
  for (std::size_t k = 0; k < n; ++k) {
    result[k] = mpz_get_d_2exp(&exponents[k], numbers[k]->get_mpz_t());
    largest = std::max(largest, exponents[k]);
  }
  for (std::size_t k = 0; k < n; ++k)  // what is 2^-2000 of the longest may as well be zero
    result[k] = std::ldexp(result[k], static_cast<int>(std::max(exponents[k] - largest, -2000L)));
  return result;
}

}  // namespace

Rounded_cone::Rounded_cone(const Cone& cone) {
  for (const Integer_vector& ray : cone.rays) rays.push_back(rounded<3>({&ray[0], &ray[1], &ray[2]}));
  nearness = rounded<4>({&cone.nearness[0], &cone.nearness[1], &cone.nearness[2], &cone.distance});
}

std::optional<int> side_to_plane(const Rounded_cone& a, std::size_t ray, const Rounded_cone& b) {
  constexpr double error = 0x1p-45;
  const std::array<double, 3>& d = a.rays[ray];
  const auto along = [&](const std::array<double, 4>& u) { return u[0] * d[0] + u[1] * d[1] + u[2] * d[2]; };
  const double height = a.nearness[3] * along(b.nearness) - b.nearness[3] * along(a.nearness);
  if (std::abs(height) <= error) return std::nullopt;
  return height > 0 ? 1 : -1;
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
