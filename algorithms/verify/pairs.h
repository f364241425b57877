#pragma once
// Pairs of cones that an eye sees polygons in: which of two is nearer, and which pairs there are to ask that of. To be
// read after polygons.h and rounded_cones.h.

#include <sightline/algorithms/verify/parallel.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/rounded_cones.h>
#include <sightline/algorithms/verify/verdict.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace sightline::order_check {

using namespace certificate_check;

/// Compares two fragments. Kept apart from the loop over the pairs, with its own memory, so that the loop can be split.
class Pair_check {
 public:
  /// Whether a is strictly nearer than b in some direction inside both cones. Pre: neither is edge-on. Proof: P-20
  bool nearer_somewhere(const Cone& a, const Cone& b);
  /// The same by doubles where they can tell. Pre: the rounded ones are the cones.
  bool nearer_somewhere(const Cone& a, const Rounded_cone& rounded_a, const Cone& b, const Rounded_cone& rounded_b);

 private:
  /// How the rays of cone b lie about the edge planes of cone a.
  struct Sides {
    std::vector<char> inside;  ///< whether ray j of b is in the closed cone a
    /// (i, j): rays j and j + 1 of b are strictly on different sides of a's edge plane i.
    std::vector<std::pair<std::size_t, std::size_t>> crossings;

    void find(const Cone& a, const Cone& b);
  };

  bool nearer_in_common_part(const Cone& a, const Cone& b);
  void find_farther(const Cone& a, const Cone& b);

  Integer_vector farther_;   // 1/t of b minus 1/t of a is linear in the direction
  Sides a_sides_, b_sides_;  // of a's planes at b's rays, of b's planes at a's rays
  std::vector<Integer_vector> common_;
};

/// What a cone covers of a side of the cube [-1, 1]^3 about the eye, as a box around it, in units of 2^-60, rounded
/// outwards.
struct Window {
  std::size_t cone = 0;
  std::array<std::int64_t, 2> low{}, high{};  ///< low < high
};

constexpr std::size_t cube_sides = 6;

/// The window of a cone on one of the six sides; none where they have no open set in common. `cone.cone` is left 0.
/// Exact: the corners before they are rounded. Proof: P-20
std::optional<Window> window_of(const Cone& cone, std::size_t side);

/// Hands on pairs of cones, one of each of two lists, but not those that are seen to have no open set in common: on no
/// side of a cube about the eye their windows overlap, or a plane through the eye is between them. Both lists are cut
/// in two where windows allow it, else by planes of edges of the cones, each part once more, until a part is small or
/// no cut helps. A pair may be handed on more than once. Cost: about O(n log n) and the pairs. Proof: P-20
template <class Take>
class Pairs {
 public:
  using Places = std::vector<std::size_t>;

  /// take(i, j): cones to compare, from any thread. Edge-on ones are left out. Pre: `rounded` are the cones; both
  /// outlive it.
  Pairs(const std::vector<Cone>& cones, const std::vector<Rounded_cone>& rounded, Take take)
      : cones_(cones), rounded_(rounded), take_(std::move(take)) {}

  /// progress(share): of all pairs, those that are done with, in [0, 1]; before each cone of a part, from any thread,
  /// but never from two at once.
  void each(const Places& a, const Places& b, const Workers& workers,
            const std::function<void(double)>& progress = {}) {
    each_of_parts(a, &b, workers, progress);
  }
  /// Of the pairs of one list, each in one of its two senses, whichever.
  void each(const Places& all, const Workers& workers, const std::function<void(double)>& progress = {}) {
    each_of_parts(all, nullptr, workers, progress);
  }

 private:
  using Windows = std::vector<Window>;

  void each_of_parts(const Places& a, const Places* b, const Workers& workers,
                     const std::function<void(double)>& progress) {
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
    progress_ = progress;
    done_ = 0;
    for_each_below(parts.size(), 1, all < worth_threads ? 1 : workers.threads,
                   [&](std::size_t i) { share_out(parts[i]); });
  }

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
  Take take_;
  std::function<void(double)> progress_;
  double done_ = 0;
  std::mutex of_progress_;
};

/// Calls of Pairs' progress as those of Verify_options, with `total` things in all.
std::function<void(double)> share_of(const Verify_options& options, std::size_t total);

}  // namespace sightline::order_check
