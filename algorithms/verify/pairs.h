#pragma once
// Pairs of cones that an eye sees polygons in: which of two is nearer, and which pairs there are to ask that of. To be
// read after polygons.h and rounded_cones.h.

#include <sightline/algorithms/verify/parallel.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/rounded_cones.h>
#include <sightline/algorithms/verify/verdict.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
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
class Pairs {
 public:
  using Places = std::vector<std::size_t>;
  using Take = std::function<void(std::size_t i, std::size_t j)>;  ///< cones to compare, from any thread

  /// Edge-on cones are left out. Pre: `rounded` are the cones; both outlive it.
  Pairs(const std::vector<Cone>& cones, const std::vector<Rounded_cone>& rounded, Take take)
      : cones_(cones), rounded_(rounded), take_(std::move(take)) {}

  /// progress(share): of all pairs, those that are done with, in [0, 1]; before each cone of a part, from any thread,
  /// but never from two at once.
  void each(const Places& a, const Places& b, const Workers& workers,
            const std::function<void(double)>& progress = {}) const;
  /// Of the pairs of one list, each in one of its two senses, whichever.
  void each(const Places& all, const Workers& workers, const std::function<void(double)>& progress = {}) const;

 private:
  const std::vector<Cone>& cones_;
  const std::vector<Rounded_cone>& rounded_;
  Take take_;
};

/// Calls of Pairs' progress as those of Verify_options, with `total` things in all.
std::function<void(double)> share_of(const Verify_options& options, std::size_t total);

}  // namespace sightline::order_check
