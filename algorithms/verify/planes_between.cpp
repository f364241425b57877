#include <sightline/algorithms/verify/planes_between.h>

#include <sightline/kernel/number.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace sightline::order_check {

using namespace certificate_check;

namespace {

/// For the side of the plane of b on which a ray of a meets the polygon of a, as side_to_plane(), exactly: the sign of
/// its product with the ray. It is met at t where nearness.d t = distance.
void find_height(Integer_vector& height, const Cone& a, const Cone& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    mpz_mul(height[k].get_mpz_t(), a.distance.get_mpz_t(), b.nearness[k].get_mpz_t());
    mpz_submul(height[k].get_mpz_t(), b.distance.get_mpz_t(), a.nearness[k].get_mpz_t());
  }
}

}  // namespace

Planes_between::Planes_between(const std::vector<Cone>& cones, const std::vector<Rounded_cone>& rounded,
                               const Workers& workers)
    : cones_(cones), rounded_(rounded), paths_(cones.size()) {
  constexpr std::size_t large = 4096;  // threads share its polygons; of smaller parts each has its own
  std::vector<Part> parts{{0, cones.size(), 0}}, small;
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    if (part.size() < large) small.push_back(part);
    else
      for (const Part& half : cut(part, workers)) parts.push_back(half);
  }
  for_each_below(small.size(), 1, workers, [&](std::size_t i) { cut_to_the_end(small[i]); });
}

bool Planes_between::is_apart(std::size_t i, std::size_t at) const {
  if (cones_[i].edge_on || cones_[at].edge_on) return false;
  const int own_side = i < at ? 1 : -1;
  // Where doubles can tell of no ray that it is on the wrong side, the others are asked exactly.
  thread_local std::vector<std::size_t> open;
  open.clear();
  for (std::size_t ray = 0; ray < cones_[i].rays.size(); ++ray) {
    const std::optional<int> side = side_to_plane(rounded_[i], ray, rounded_[at]);
    if (!side) open.push_back(ray);
    else if (*side == -own_side) return false;
  }
  if (open.empty()) return true;
  const Cone &own = cones_[i], &plane = cones_[at];
  if (own.distance == plane.distance && own.nearness == plane.nearness) return true;  // in it
  thread_local Integer_vector height;
  find_height(height, own, plane);
  return std::none_of(open.begin(), open.end(),
                      [&](std::size_t ray) { return sign_of_dot(height, own.rays[ray]) == -own_side; });
}

std::vector<Planes_between::Part> Planes_between::cut(const Part& part, const Workers& workers) {
  constexpr std::size_t candidates = 5, samples = 24, block = 512;
  const auto [begin, end, depth] = part;
  const std::size_t size = part.size();
  if (size < 2 || depth == deepest) return {};
  // 1. Of a few polygons about the middle the one whose plane has most of a few others on their sides.
  std::size_t at = begin + size / 2, most = 0;
  for (std::size_t c = 0; c < candidates && size > candidates * samples; ++c) {
    const std::size_t candidate = begin + size / 4 + size / 2 * c / candidates;
    std::size_t count = 0;
    for (std::size_t s = 0; s < samples; ++s) count += is_apart(begin + size * s / samples, candidate);
    if (count > most) most = count, at = candidate;
  }
  // 2. Who is on its side. That polygon itself is in its plane, and begins the part behind the cut.
  const std::uint64_t bit = first >> depth;
  for_each_below((size + block - 1) / block, 1, workers, [&](std::size_t k) {
    for (std::size_t i = begin + k * block; i < std::min(end, begin + (k + 1) * block); ++i) {
      if (i >= at) paths_[i].turns |= bit;
      if (is_apart(i, at)) paths_[i].apart |= bit;
    }
  });
  return {{begin, at, depth + 1}, {at, end, depth + 1}};
}

void Planes_between::cut_to_the_end(const Part& part) {
  for (const Part& half : cut(part, 1)) cut_to_the_end(half);
}

}  // namespace sightline::order_check
