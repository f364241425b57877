// To be read after polygons.cpp, from top to bottom: how two cones lie to each other, then which one is nearer.

#include <sightline/algorithms/verify/pairs.h>

#include <sightline/kernel/number.h>

#include <algorithm>
#include <limits>

namespace sightline::order_check {

void Pair_check::Sides::find(const Cone& a, const Cone& b) {
  inside.assign(b.rays.size(), 1);
  crossings.clear();
  for (std::size_t i = 0; i < a.edge_planes.size(); ++i) {
    const int first = sign_of_dot(a.edge_planes[i], b.rays[0]);
    int side = first;
    for (std::size_t j = 0; j < b.rays.size(); ++j) {
      if (side < 0) inside[j] = 0;
      const int next = j + 1 < b.rays.size() ? sign_of_dot(a.edge_planes[i], b.rays[j + 1]) : first;
      if (side * next < 0) crossings.push_back({i, j});
      side = next;
    }
  }
}

void Pair_check::find_farther(const Cone& a, const Cone& b) {
  for (std::size_t k = 0; k < 3; ++k) {
    mpz_mul(farther_[k].get_mpz_t(), a.distance.get_mpz_t(), b.nearness[k].get_mpz_t());
    mpz_submul(farther_[k].get_mpz_t(), b.distance.get_mpz_t(), a.nearness[k].get_mpz_t());
  }
}

namespace {

/// Whether d is where `farther` says that the first of two polygons is the nearer one.
bool is_nearer(const Integer_vector& farther, const Integer_vector& d) { return sign_of_dot(farther, d) < 0; }

/// Whether of so many signs none is the wrong one: known(k) where doubles can tell, exact(k) is asked last.
template <class Known, class Exact>
bool none_is(int wrong, std::size_t count, const Known& known, const Exact& exact) {
  thread_local std::vector<std::size_t> open;
  open.clear();
  for (std::size_t k = 0; k < count; ++k) {
    const std::optional<int> sign = known(k);
    if (!sign) open.push_back(k);
    else if (*sign == wrong) return false;
  }
  return std::none_of(open.begin(), open.end(), [&](std::size_t k) { return exact(k) == wrong; });
}

/// separates(), by doubles where they can tell.
bool separates(const Cone& a, const Rounded_cone& rounded_a, const Cone& b, const Rounded_cone& rounded_b) {
  for (std::size_t i = 0; i < a.edge_planes.size(); ++i)
    if (none_is(
            1, b.rays.size(), [&](std::size_t k) { return side_of_edge(rounded_a, i, rounded_b.rays[k]); },
            [&](std::size_t k) { return sign_of_dot(a.edge_planes[i], b.rays[k]); }))
      return true;
  return false;
}

}  // namespace

bool Pair_check::nearer_somewhere(const Cone& a, const Rounded_cone& rounded_a, const Cone& b,
                                  const Rounded_cone& rounded_b) {
  if (a.distance == b.distance && a.nearness == b.nearness) return false;  // in one plane
  // Where doubles can tell of no ray that it is on the wrong side, the others are asked exactly.
  bool has_farther = false;
  const auto farther_at = [&](const Integer_vector& d) {
    if (!has_farther) find_farther(a, b);
    has_farther = true;
    return sign_of_dot(farther_, d);
  };
  if (none_is(
          -1, a.rays.size(), [&](std::size_t k) { return side_to_plane(rounded_a, k, rounded_b); },
          [&](std::size_t k) { return farther_at(a.rays[k]); }) ||
      none_is(
          1, b.rays.size(), [&](std::size_t k) { return side_to_plane(rounded_b, k, rounded_a); },
          [&](std::size_t k) { return -farther_at(b.rays[k]); }))
    return false;
  if (separates(a, rounded_a, b, rounded_b) || separates(b, rounded_b, a, rounded_a)) return false;
  if (!has_farther) find_farther(a, b);
  return nearer_in_common_part(a, b);
}

bool Pair_check::nearer_somewhere(const Cone& a, const Cone& b) {
  // a may nowhere be the nearer one. Often it is in all of a cone.
  find_farther(a, b);
  const auto nearer = [&](const Integer_vector& d) { return is_nearer(farther_, d); };
  if (std::none_of(b.rays.begin(), b.rays.end(), nearer) || std::none_of(a.rays.begin(), a.rays.end(), nearer))
    return false;
  if (certificate_check::separates(a, b) || certificate_check::separates(b, a)) return false;
  return nearer_in_common_part(a, b);
}

bool Pair_check::nearer_in_common_part(const Cone& a, const Cone& b) {
  a_sides_.find(a, b);
  b_sides_.find(b, a);

  // Directions that span the common part of the cones: rays of one in the other, and where two edges cross.
  common_.clear();
  for (std::size_t i = 0; i < a.rays.size(); ++i)
    if (b_sides_.inside[i]) common_.push_back(a.rays[i]);
  for (std::size_t j = 0; j < b.rays.size(); ++j)
    if (a_sides_.inside[j]) common_.push_back(b.rays[j]);
  for (const auto& [i, j] : a_sides_.crossings) {
    const Integer_vector &from = a.rays[i], &to = a.rays[(i + 1) % a.rays.size()];
    const Integer side_of_from = dot(b.edge_planes[j], from), side_of_to = dot(b.edge_planes[j], to);
    if (sgn(side_of_from) * sgn(side_of_to) >= 0) continue;
    Integer_vector d;  // on b's edge plane j, between the two rays of a
    for (std::size_t k = 0; k < 3; ++k) d[k] = abs(side_of_to) * from[k] + abs(side_of_from) * to[k];
    if (sign_of_dot(b.nearness, d) > 0) common_.push_back(primitive(d));  // otherwise -d is in b's cone, not d
  }

  // Has the common part an inside? Then the sum of what spans it is strictly inside a's edge planes.
  Integer_vector middle;
  for (const Integer_vector& d : common_)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += d[k];
  for (const Integer_vector& plane : a.edge_planes)
    if (sign_of_dot(plane, middle) <= 0) return false;
  return std::any_of(common_.begin(), common_.end(), [&](const Integer_vector& d) { return is_nearer(farther_, d); });
}

namespace {

/// Leaves of a cone, as rays that span it, the part in which d[i] +- d[j], or its opposite, is not negative; nothing
/// where that has no inside.
struct Half_space {
  std::size_t i, j;
  bool minus, opposite;

  void value(Integer& result, const Integer_vector& d) const {
    (minus ? mpz_sub : mpz_add)(result.get_mpz_t(), d[i].get_mpz_t(), d[j].get_mpz_t());
    if (opposite) mpz_neg(result.get_mpz_t(), result.get_mpz_t());
  }
  /// How rays lie to it.
  struct Sides {
    bool any_in = false, any_out = false;
  };
  Sides sides_of(const std::vector<Integer_vector>& rays) const {
    thread_local Integer at_ray;
    Sides sides;
    for (const Integer_vector& ray : rays) {
      value(at_ray, ray);
      sides.any_in = sides.any_in || sgn(at_ray) > 0;
      sides.any_out = sides.any_out || sgn(at_ray) < 0;
    }
    return sides;
  }
  /// Leaves of a cone, as rays that span it, the part in here; nothing where that has no inside.
  void clip(std::vector<Integer_vector>& rays) const {
    const auto [any_in, any_out] = sides_of(rays);
    if (any_in && !any_out) return;
    std::vector<Integer_vector> kept;
    Integer here, there;
    for (std::size_t k = 0; any_in && k < rays.size(); ++k) {
      const Integer_vector& next = rays[(k + 1) % rays.size()];
      value(here, rays[k]);
      value(there, next);
      if (sgn(here) >= 0) kept.push_back(rays[k]);
      if (sgn(here) * sgn(there) >= 0) continue;
      Integer_vector& d = kept.emplace_back();
      for (std::size_t m = 0; m < 3; ++m) d[m] = abs(there) * rays[k][m] + abs(here) * next[m];
    }
    rays = std::move(kept);
  }
};

/// n / d in units of 2^-60, rounded downwards and upwards. Pre: |n| <= d, d > 0.
std::pair<std::int64_t, std::int64_t> in_units(const Integer& n, const Integer& d) {
  thread_local Integer quotient, rest;
  mpz_mul_2exp(quotient.get_mpz_t(), n.get_mpz_t(), 60);
  mpz_fdiv_qr(quotient.get_mpz_t(), rest.get_mpz_t(), quotient.get_mpz_t(), d.get_mpz_t());
  const std::int64_t low = quotient.get_si();
  return {low, low + (sgn(rest) != 0)};
}

}  // namespace

std::optional<Window> window_of(const Cone& cone, std::size_t side) {
  const std::size_t axis = side / 2, others[] = {(axis + 1) % 3, (axis + 2) % 3};
  const bool opposite = side % 2 != 0;
  const auto is_away = [&](const Integer_vector& ray) { return sgn(ray[axis]) * (opposite ? -1 : 1) <= 0; };
  if (std::all_of(cone.rays.begin(), cone.rays.end(), is_away)) return std::nullopt;
  // 1. The part of the cone in which the coordinate of the side is the largest: mostly none or all of it.
  std::vector<Integer_vector> part;
  std::array<Half_space, 4> across{};
  std::size_t count = 0;
  for (const std::size_t other : others)
    for (const bool minus : {false, true}) {
      const Half_space half{axis, other, minus, opposite};
      const auto [any_in, any_out] = half.sides_of(cone.rays);
      if (!any_in) return std::nullopt;
      if (any_out) across[count++] = half;
    }
  if (count > 0) part = cone.rays;
  for (std::size_t k = 0; k < count; ++k) {
    across[k].clip(part);
    if (part.empty()) return std::nullopt;
  }
  const std::vector<Integer_vector>& rays = count > 0 ? part : cone.rays;
  // 2. The box around where its rays meet the side.
  Window window;
  for (std::size_t k = 0; k < 2; ++k) {
    window.low[k] = std::numeric_limits<std::int64_t>::max();
    window.high[k] = std::numeric_limits<std::int64_t>::min();
    for (const Integer_vector& d : rays) {
      thread_local Integer depth;
      mpz_abs(depth.get_mpz_t(), d[axis].get_mpz_t());
      const auto [low, high] = in_units(d[others[k]], depth);
      window.low[k] = std::min(window.low[k], low);
      window.high[k] = std::max(window.high[k], high);
    }
  }
  return window;
}

std::function<void(double)> share_of(const Verify_options& options, std::size_t total) {
  if (!options.progress) return {};
  return [&options, total](double share) {
    options.progress(static_cast<std::size_t>(share * static_cast<double>(total)), total);
  };
}

}  // namespace sightline::order_check
