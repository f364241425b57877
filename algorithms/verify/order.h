#pragma once
// Checks a back-to-front order without trusting, or sharing a line with, whatever made it: rationals and integers only.
// Laws: proofs/order_certificate.md (P-20 .. P-22). To be read in one sitting, from top to bottom.

#include <sightline/algorithms/verify/covering.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace sightline {

/// The claim "drawn in this order, every fragment covers only what is not nearer than itself, and the fragments are the
/// scene". Fragments are farthest first.
struct Order_certificate : Covering {
  Exact_point eye;
  bool on_view =
      false;  ///< of the on-view pieces only: the others, which the eye is not strictly in front of, may be left out
};

namespace order_check {

using namespace certificate_check;

// ---- Pairs

/// How the rays of cone b lie about the edge planes of cone a.
struct Sides {
  std::vector<char> inside;  ///< whether ray j of b is in the closed cone a
  std::vector<std::pair<std::size_t, std::size_t>>
      crossings;  ///< (i, j): rays j and j + 1 of b are strictly on different sides of a's edge plane i

  void find(const Cone& a, const Cone& b);
};

/// Compares two fragments. Kept apart from the loop over the pairs, with its own memory, so that the loop can be split.
class Pair_check {
 public:
  /// Whether a is strictly nearer than b in some direction inside both cones. Pre: neither is edge-on. Proof: P-20
  bool nearer_somewhere(const Cone& a, const Cone& b);

 private:
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

// ---- The order

/// The first pair (earlier, later), by the later one's place and then the earlier one's, where the earlier one is
/// nearer somewhere.
std::optional<std::pair<std::size_t, std::size_t>> first_misordered(const std::vector<Cone>& cones,
                                                                    const Verify_options& options);

/// The certificate, step by step; throws a Rejection.
void check(const Polygon_soup& soup, const Order_certificate& certificate, const Verify_options& options);

}  // namespace order_check

/// Whether the certificate proves a back-to-front order of the scene: (1) for each two fragments whose cones from the
/// eye overlap in an open set, the earlier one is nowhere nearer than the later one; (2) the fragments of each face
/// that is drawn tile it (its pieces, where it has such; a non-planar face must), but, if it says `on_view`, those that
/// the eye is not in front of may be left out; (3) each face is drawn, or set aside for a true reason. Degenerate:
/// fragments seen edge-on (the eye in their plane) may stand anywhere; contact in an edge or a point is no overlap;
/// equal distance is in order both ways. A face whose edges cross although it winds nowhere but 0 or 1 times may be
/// tiled or set aside. Pre: none on the certificate; rejects whatever is wrong with it. Post: `why` is one line. Cost:
/// about O(n log n) for n fragments and the pairs that overlap, each in the product of their corners at most; quadratic
/// at worst; a set-aside "self-intersecting" face is quadratic in its corners. Exact: yes, without filters. Proof:
/// P-20, P-21, P-22
Verdict verify_order(const Polygon_soup& soup, const Order_certificate& certificate,
                     const Verify_options& options = {});

}  // namespace sightline
