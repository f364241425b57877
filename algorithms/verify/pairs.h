#pragma once
// Pairs of cones that an eye sees polygons in: which of two is nearer, and which pairs there are to ask that of. To be
// read after polygons.h.

#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/verdict.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace sightline::order_check {

using namespace certificate_check;

/// Compares two fragments. Kept apart from the loop over the pairs, with its own memory, so that the loop can be split.
class Pair_check {
 public:
  /// Whether a is strictly nearer than b in some direction inside both cones. Pre: neither is edge-on. Proof: P-20
  bool nearer_somewhere(const Cone& a, const Cone& b);

 private:
  /// How the rays of cone b lie about the edge planes of cone a.
  struct Sides {
    std::vector<char> inside;  ///< whether ray j of b is in the closed cone a
    /// (i, j): rays j and j + 1 of b are strictly on different sides of a's edge plane i.
    std::vector<std::pair<std::size_t, std::size_t>> crossings;

    void find(const Cone& a, const Cone& b);
  };

  Sides a_sides_, b_sides_;  // of a's planes at b's rays, of b's planes at a's rays
  std::vector<Integer_vector> common_;
};

/// Hands on pairs of cones, one of each of two lists, but not those with a plane through the eye between them, which
/// have no open set in common. Planes, of edges of the cones, share out both lists, each part once more by others,
/// until a part is small or a plane does not help. A pair may be handed on more than once. Cost: about O(n log n) and
/// the pairs; a plane is tested against all rays of a part. Proof: P-20
template <class Take>
class Pairs {
 public:
  using Places = std::vector<std::size_t>;

  /// take(i, j): cones to compare. Edge-on ones are left out.
  Pairs(const std::vector<Cone>& cones, Take take) : cones_(cones), take_(std::move(take)) {}

  /// progress(share): of all pairs, those that are done with, in [0, 1]; before each cone of a part.
  void each(Places a, Places b, const std::function<void(double)>& progress = {}) {
    const auto edge_on = [&](std::size_t i) { return cones_[i].edge_on; };
    std::erase_if(a, edge_on);
    std::erase_if(b, edge_on);
    progress_ = progress;
    done_ = 0;
    share_out(a, b, 1, 0);
  }

 private:
  static constexpr std::size_t small = 16;
  static constexpr unsigned deepest = 64, tries = 6;

  struct Halves {
    Places front, behind;  // and what is on both sides, in both
  };
  Halves halves(const Places& places, const Integer_vector& plane) const {
    Halves result;
    for (const std::size_t i : places) {
      bool in_front = false, at_back = false;
      for (const Integer_vector& ray : cones_[i].rays) {
        const int side = sign_of_dot(plane, ray);
        in_front = in_front || side > 0;
        at_back = at_back || side < 0;
        if (in_front && at_back) break;
      }
      if (in_front) result.front.push_back(i);
      if (at_back) result.behind.push_back(i);
    }
    return result;
  }
  void share_out(const Places& a, const Places& b, double share, unsigned depth) {
    const auto pairs = [](const Places& x, const Places& y) {
      return static_cast<double>(x.size()) * static_cast<double>(y.size());
    };
    if (std::min(a.size(), b.size()) > 0 && a.size() + b.size() > small && depth < deepest)
      for (unsigned k = 0; k < tries; ++k) {
        const Places& from = k % 2 == 0 ? a : b;
        const Cone& cone = cones_[from[(2 * k + 1) * from.size() / (2 * tries)]];
        const Integer_vector& plane = cone.edge_planes[(k + depth) % cone.edge_planes.size()];
        const Halves first = halves(a, plane), second = halves(b, plane);
        if (pairs(first.front, second.front) + pairs(first.behind, second.behind) > 0.75 * pairs(a, b)) continue;
        share_out(first.front, second.front, share / 2, depth + 1);
        share_out(first.behind, second.behind, share / 2, depth + 1);
        return;
      }
    for (std::size_t k = 0; k < a.size(); ++k) {
      if (progress_) progress_(std::min(1.0, done_ + share * static_cast<double>(k) / static_cast<double>(a.size())));
      for (const std::size_t j : b) take_(a[k], j);
    }
    done_ += share;
  }

  const std::vector<Cone>& cones_;
  Take take_;
  std::function<void(double)> progress_;
  double done_ = 0;
};

/// Calls of Pairs' progress as those of Verify_options, with `total` things in all.
std::function<void(double)> share_of(const Verify_options& options, std::size_t total);

}  // namespace sightline::order_check
