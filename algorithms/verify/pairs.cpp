// To be read after polygons.cpp, from top to bottom: how two cones lie to each other, then which one is nearer.

#include <sightline/algorithms/verify/pairs.h>

#include <sightline/kernel/number.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

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

// ---- Pairs: two lists are cut into parts, in halves again and again

namespace {

/// One turn of Pairs.
class Pair_search {
 public:
  using Places = Pairs::Places;

  Pair_search(const std::vector<Cone>& cones, const std::vector<Rounded_cone>& rounded, const Pairs::Take& take,
              const std::function<void(double)>& progress)
      : cones_(cones), rounded_(rounded), take_(take), progress_(progress) {}

  /// `b`: nothing for the pairs of a.
  void run(const Places& a, const Places* b, const Workers& workers) {
    // 1. Windows, and parts that threads can share, in halves.
    std::vector<Part> parts;
    double all = 0;
    for (std::size_t side = 0; side < cube_sides; ++side) {
      Part part;
      part.a = windows(a, side, workers);
      part.one_list = b == nullptr;
      if (b != nullptr) part.b = &a == b ? part.a : windows(*b, side, workers);
      if (part.pairs() == 0) continue;
      all += part.pairs();
      parts.push_back(std::move(part));
    }
    for (Part& part : parts) part.share = part.pairs() / all;
    for (std::size_t round = 0; round < rounds_for_threads; ++round) halve_all(parts);
    // 2. Each part by itself.
    for_each_below(parts.size(), 1, all < worth_threads ? 1 : workers.threads,
                   [&](std::size_t i) { share_out(parts[i]); });
  }

 private:
  using Windows = std::vector<Window>;

  static constexpr std::size_t small = 16, crowded = 100;  // below them, cuts by windows and by planes do not pay
  static constexpr unsigned deepest = 64, tries = 6;
  static constexpr std::size_t rounds_for_threads = 4, enough_windows = 1000;
  static constexpr double worth_threads = 1e5;  // pairs

  /// Windows of both lists, or of the only one. Pairs whose lower corners have their join in the region are this
  /// part's.
  struct Part {
    Windows a, b;
    Window region{0, {least, least}, {most, most}};
    double share = 0;  // of the work
    unsigned depth = 0;
    bool one_list = false;  // a
    std::size_t size() const { return a.size() + (one_list ? a : b).size(); }
    double pairs() const {
      const auto n = static_cast<double>(a.size());
      return one_list ? n * (n - 1) / 2 : n * static_cast<double>(b.size());
    }

    static constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min(),
                                  most = std::numeric_limits<std::int64_t>::max();
  };
  struct Halves {
    Part front, behind;  // and what is on both sides, in both
    void pass_on(const Part& whole) {
      for (Part* half : {&front, &behind}) {
        half->region = whole.region;
        half->one_list = whole.one_list;
        half->share = whole.share / 2;
        half->depth = whole.depth + 1;
      }
    }
    /// Whether fewer pairs are left, enough fewer to be worth it.
    bool help(const Part& whole) const { return front.pairs() + behind.pairs() <= 0.75 * whole.pairs(); }
  };

  Windows windows(const Places& places, std::size_t side, const Workers& workers) const {
    std::vector<std::optional<Window>> all(places.size());
    for_each_below(places.size(), enough_windows, workers, [&](std::size_t k) {
      if (cones_[places[k]].edge_on) return;
      all[k] = window_of(cones_[places[k]], side);
      if (all[k]) all[k]->cone = places[k];
    });
    Windows result;
    for (const std::optional<Window>& window : all)
      if (window) result.push_back(*window);
    return result;
  }

  static Halves cut_windows(const Part& part, std::size_t axis) {
    std::vector<std::int64_t> middles;
    for (const Windows* list : {&part.a, &part.b})
      for (const Window& w : *list) middles.push_back(w.low[axis] / 2 + w.high[axis] / 2);
    const auto median = middles.begin() + static_cast<std::ptrdiff_t>(middles.size() / 2);
    std::nth_element(middles.begin(), median, middles.end());
    Halves halves;
    const auto share = [&](const Windows& from, Windows& front, Windows& behind) {
      for (const Window& w : from) {
        if (w.high[axis] > *median) front.push_back(w);
        if (w.low[axis] < *median) behind.push_back(w);
      }
    };
    share(part.a, halves.front.a, halves.behind.a);
    share(part.b, halves.front.b, halves.behind.b);
    halves.pass_on(part);
    halves.front.region.low[axis] = halves.behind.region.high[axis] = *median;
    return halves;
  }
  Halves cut_cones(const Part& part, const Integer_vector& plane) const {
    Halves halves;
    const Rounded_vector in_doubles = rounded(plane);
    const auto share = [&](const Windows& from, Windows& front, Windows& behind) {
      for (const Window& w : from) {
        bool in_front = false, at_back = false;
        const std::vector<Integer_vector>& rays = cones_[w.cone].rays;
        for (std::size_t k = 0; k < rays.size(); ++k) {
          const std::optional<int> known = sign_in_doubles(in_doubles, rounded_[w.cone].rays[k]);
          const int side = known ? *known : sign_of_dot(plane, rays[k]);
          in_front = in_front || side > 0;
          at_back = at_back || side < 0;
          if (in_front && at_back) break;
        }
        if (in_front) front.push_back(w);
        if (at_back) behind.push_back(w);
      }
    };
    share(part.a, halves.front.a, halves.behind.a);
    share(part.b, halves.front.b, halves.behind.b);
    halves.pass_on(part);
    return halves;
  }

  /// Two parts of fewer pairs in all, by windows if they allow it, else by planes; nothing where neither helps.
  std::optional<Halves> halved(const Part& part) const {
    const std::size_t size = part.size();
    if (size <= small || part.depth >= deepest) return std::nullopt;
    for (const std::size_t axis : {part.depth % 2, 1 - part.depth % 2})
      if (Halves halves = cut_windows(part, axis); halves.help(part)) return halves;
    for (unsigned k = 0; k < tries && size > crowded; ++k) {
      const Windows& from = k % 2 == 0 || part.one_list ? part.a : part.b;
      const Cone& cone = cones_[from[(2 * k + 1) * from.size() / (2 * tries)].cone];
      const Integer_vector& plane = cone.edge_planes[(k + part.depth) % cone.edge_planes.size()];
      if (Halves halves = cut_cones(part, plane); halves.help(part)) return halves;
    }
    return std::nullopt;
  }

  void halve_all(std::vector<Part>& parts) const {
    std::vector<Part> next;
    for (Part& part : parts) {
      if (std::optional<Halves> halves = halved(part)) {
        next.push_back(std::move(halves->front));
        next.push_back(std::move(halves->behind));
      } else {
        next.push_back(std::move(part));
      }
    }
    parts = std::move(next);
  }

  void share_out(const Part& part) {
    if (part.pairs() == 0) return;
    if (const std::optional<Halves> halves = halved(part)) {
      share_out(halves->front);
      share_out(halves->behind);
      return;
    }
    for (std::size_t i = 0; i < part.a.size(); ++i) {
      const Window& a = part.a[i];
      count(part.share / static_cast<double>(part.a.size()));
      const Windows& others = part.one_list ? part.a : part.b;
      for (std::size_t j = part.one_list ? i + 1 : 0; j < others.size(); ++j)
        if (overlap_here(a, others[j], part.region)) take_(a.cone, others[j].cone);
    }
  }
  void count(double share) {
    if (!progress_) return;
    const std::lock_guard lock(of_progress_);
    progress_(std::min(1.0, done_));
    done_ += share;
  }

  static bool overlap_here(const Window& a, const Window& b, const Window& region) {
    for (std::size_t k = 0; k < 2; ++k) {
      const std::int64_t low = std::max(a.low[k], b.low[k]);
      if (low >= a.high[k] || low >= b.high[k] || low < region.low[k] || low >= region.high[k]) return false;
    }
    return true;
  }

  const std::vector<Cone>& cones_;
  const std::vector<Rounded_cone>& rounded_;
  const Pairs::Take& take_;
  const std::function<void(double)>& progress_;
  double done_ = 0;
  std::mutex of_progress_;
};

}  // namespace

void Pairs::each(const Places& a, const Places& b, const Workers& workers,
                 const std::function<void(double)>& progress) const {
  Pair_search(cones_, rounded_, take_, progress).run(a, &b, workers);
}

void Pairs::each(const Places& all, const Workers& workers, const std::function<void(double)>& progress) const {
  Pair_search(cones_, rounded_, take_, progress).run(all, nullptr, workers);
}

std::function<void(double)> share_of(const Verify_options& options, std::size_t total) {
  if (!options.progress) return {};
  return [&options, total](double share) {
    options.progress(static_cast<std::size_t>(share * static_cast<double>(total)), total);
  };
}

}  // namespace sightline::order_check
