#pragma once
// Checks a back-to-front order without trusting, or sharing a line with, whatever made it: rationals and integers only.
// Laws: proofs/order_certificate.md (P-20 .. P-22). To be read in one sitting, from top to bottom.

#include <sightline/algorithms/verify/covering.h>

#include <numeric>

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
// ------------------------------------------------------------------------------------------------------------------

/// How the rays of cone b lie about the edge planes of cone a.
struct Sides {
  std::vector<char> inside;  ///< whether ray j of b is in the closed cone a
  std::vector<std::pair<std::size_t, std::size_t>>
      crossings;  ///< (i, j): rays j and j + 1 of b are strictly on different sides of a's edge plane i

  void find(const Cone& a, const Cone& b) {
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
};

/// Compares two fragments. Kept apart from the loop over the pairs, with its own memory, so that the loop can be split.
class Pair_check {
 public:
  /// Whether a is strictly nearer than b in some direction inside both cones. Pre: neither is edge-on. Proof: P-20
  bool nearer_somewhere(const Cone& a, const Cone& b) {
    if (a.nearness == b.nearness && a.distance == b.distance) return false;  // one plane: equally far everywhere
    if (separates(a, b) || separates(b, a)) return false;
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

    // 1/t of b minus 1/t of a is linear in the direction: a may nowhere be the nearer one.
    Integer_vector farther;
    for (std::size_t k = 0; k < 3; ++k) farther[k] = a.distance * b.nearness[k] - b.distance * a.nearness[k];
    for (const Integer_vector& d : common_)
      if (sign_of_dot(farther, d) < 0) return true;
    return false;
  }

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
    std::erase_if(a, edge_on), std::erase_if(b, edge_on);
    progress_ = progress, done_ = 0;
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
        in_front = in_front || side > 0, at_back = at_back || side < 0;
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
inline std::function<void(double)> share_of(const Verify_options& options, std::size_t total) {
  if (!options.progress) return {};
  return [&options, total](double share) {
    options.progress(static_cast<std::size_t>(share * static_cast<double>(total)), total);
  };
}

// ---- The order
// --------------------------------------------------------------------------------------------------------------

/// The first pair (earlier, later), by the later one's place and then the earlier one's, where the earlier one is
/// nearer somewhere.
inline std::optional<std::pair<std::size_t, std::size_t>> first_misordered(const std::vector<Cone>& cones,
                                                                           const Verify_options& options) {
  Pair_check check;
  std::optional<std::pair<std::size_t, std::size_t>> first;  // (later, earlier)
  Pairs pairs(cones, [&](std::size_t earlier, std::size_t later) {
    if (earlier < later && (!first || std::pair(later, earlier) < *first) &&
        check.nearer_somewhere(cones[earlier], cones[later]))
      first = std::pair(later, earlier);
  });
  std::vector<std::size_t> all(cones.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  pairs.each(all, all, share_of(options, cones.size()));
  if (first) std::swap(first->first, first->second);
  return first;
}

/// The certificate, step by step; throws a Rejection.
inline void check(const Polygon_soup& soup, const Order_certificate& certificate, const Verify_options& options) {
  // 1. The eye is a point, and the fragments are the scene.
  if (!canonical(certificate.eye)) reject("the eye is not a point in canonical numbers");
  check_covering(soup, certificate, certificate.on_view ? &certificate.eye : nullptr);

  // 2. No fragment is nearer than one that is drawn after it.
  std::vector<Cone> cones;
  for (const Order_fragment& fragment : certificate.fragments) cones.emplace_back(fragment.vertices, certificate.eye);
  const auto pair = first_misordered(cones, options);
  if (pair) {
    const auto [earlier, later] = *pair;
    const auto full_name = [&](std::size_t i) {
      return name("fragment", i) + " (" + name("face", certificate.fragments[i].face) + ")";
    };
    reject(full_name(earlier) + " is drawn before " + full_name(later) + " but is nearer somewhere in their overlap",
           {earlier, later});
  }
  if (options.progress) options.progress(cones.size(), cones.size());
}

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
inline Verdict verify_order(const Polygon_soup& soup, const Order_certificate& certificate,
                            const Verify_options& options = {}) {
  return certificate_check::verdict_of([&] {
    order_check::check(soup, certificate, options);
    return std::to_string(certificate.fragments.size()) + " fragments in back-to-front order, every " +
           (certificate.on_view ? "on-view " : "") + "face drawn once or set aside for a true reason";
  });
}

}  // namespace sightline
