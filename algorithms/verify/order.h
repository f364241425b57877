#pragma once
// Checks a back-to-front order without trusting, or sharing a line with, whatever made it: rationals and integers only.
// Laws: proofs/order_certificate.md (P-20 .. P-22). To be read in one sitting, from top to bottom.

#include <sightline/algorithms/verify/covering.h>

#include <bitset>

namespace sightline {

/// The claim "drawn in this order, every fragment covers only what is not nearer than itself, and the fragments are the scene".
/// Fragments are farthest first.
struct Order_certificate : Covering {
  Exact_point eye;
  bool on_view = false;  ///< of the on-view pieces only: the others, which the eye is not strictly in front of, may be left out
};

namespace order_check {

using namespace certificate_check;

// ---- Pairs ------------------------------------------------------------------------------------------------------------------

/// How the rays of cone b lie about the edge planes of cone a.
struct Sides {
  std::vector<char> inside;                                    ///< whether ray j of b is in the closed cone a
  std::vector<std::pair<std::size_t, std::size_t>> crossings;  ///< (i, j): rays j and j + 1 of b are strictly on different sides of a's edge plane i

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

/// Which of some planes through the eye have a cone wholly on one side. Two cones on different sides of one plane have no open set in common, whichever planes one takes; these are edge
/// planes of cones spread over the order. Most pairs need nothing else.
class Side_table {
 public:
  explicit Side_table(const std::vector<Cone>& cones) : sides_(cones.size()) {
    const std::size_t planes = std::min(most_planes, cones.size() / 4);
    for (std::size_t k = 0; k < planes; ++k) {
      const Cone& from = cones[k * cones.size() / planes];
      if (from.edge_on) continue;
      const Integer_vector& plane = from.edge_planes[k % from.edge_planes.size()];
      for (std::size_t i = 0; i < cones.size(); ++i) {
        bool front = true, behind = true;
        for (const Integer_vector& ray : cones[i].rays) {
          const int side = sign_of_dot(plane, ray);
          front = front && side >= 0, behind = behind && side <= 0;
        }
        sides_[i].front[k] = front, sides_[i].behind[k] = behind;
      }
    }
  }
  bool apart(std::size_t i, std::size_t j) const { return (sides_[i].front & sides_[j].behind).any() || (sides_[i].behind & sides_[j].front).any(); }

 private:
  static constexpr std::size_t most_planes = 256;
  struct Sides_of_one {
    std::bitset<most_planes> front, behind;
  };
  std::vector<Sides_of_one> sides_;
};

// ---- The order --------------------------------------------------------------------------------------------------------------

/// The first pair (earlier, later), by the later one's place in [begin, end), where the earlier one is nearer somewhere.
inline std::optional<std::pair<std::size_t, std::size_t>> first_misordered(const std::vector<Cone>& cones, std::size_t begin, std::size_t end,
                                                                           const Verify_options& options) {
  const Side_table sides(cones);
  Pair_check check;
  for (std::size_t later = begin; later < end; ++later) {
    if (options.progress) options.progress(later, cones.size());
    if (cones[later].edge_on) continue;
    for (std::size_t earlier = 0; earlier < later; ++earlier)
      if (!cones[earlier].edge_on && !sides.apart(earlier, later) && check.nearer_somewhere(cones[earlier], cones[later])) return std::pair(earlier, later);
  }
  return std::nullopt;
}

/// The certificate, step by step; throws a Rejection.
inline void check(const Polygon_soup& soup, const Order_certificate& certificate, const Verify_options& options) {
  // 1. The eye is a point, and the fragments are the scene.
  if (!canonical(certificate.eye)) reject("the eye is not a point in canonical numbers");
  check_covering(soup, certificate, certificate.on_view ? &certificate.eye : nullptr);

  // 2. No fragment is nearer than one that is drawn after it.
  std::vector<Cone> cones;
  for (const Order_fragment& fragment : certificate.fragments) cones.emplace_back(fragment.vertices, certificate.eye);
  const auto pair = first_misordered(cones, 0, cones.size(), options);
  if (pair) {
    const auto [earlier, later] = *pair;
    const auto full_name = [&](std::size_t i) { return name("fragment", i) + " (" + name("face", certificate.fragments[i].face) + ")"; };
    reject(full_name(earlier) + " is drawn before " + full_name(later) + " but is nearer somewhere in their overlap", {earlier, later});
  }
  if (options.progress) options.progress(cones.size(), cones.size());
}

}  // namespace order_check

/// Whether the certificate proves a back-to-front order of the scene: (1) for each two fragments whose cones from the eye
/// overlap in an open set, the earlier one is nowhere nearer than the later one; (2) the fragments of each face that is drawn
/// tile it (its pieces, where it has such; a non-planar face must), but, if it says `on_view`, those that the eye is not in front of may be left out; (3) each face is drawn, or set aside for a true reason.
/// Degenerate: fragments seen edge-on (the eye in their plane) may stand anywhere; contact in an edge or a point is no overlap;
/// equal distance is in order both ways. A face whose edges cross although it winds nowhere but 0 or 1 times may be tiled or
/// set aside. Pre: none on the certificate; rejects whatever is wrong with it. Post: `why` is one line.
/// Cost: quadratic in the fragments, each pair in the product of their corners at most; a set-aside "self-intersecting" face is
/// quadratic in its corners. Exact: yes, without filters. Proof: P-20, P-21, P-22
inline Verdict verify_order(const Polygon_soup& soup, const Order_certificate& certificate, const Verify_options& options = {}) {
  try {
    order_check::check(soup, certificate, options);
  } catch (const order_check::Rejection& rejection) {
    return rejection.verdict;
  }
  return {true, std::to_string(certificate.fragments.size()) + " fragments in back-to-front order, every " + (certificate.on_view ? "on-view " : "") + "face drawn once or set aside for a true reason", {}};
}

}  // namespace sightline
