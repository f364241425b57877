#pragma once
// Pairs that need not be compared, as a plane of the sequence itself is between them. To be read after rounded_cones.h.

#include <sightline/algorithms/verify/order.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/rounded_cones.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace sightline::order_check {

/// Where a sequence may be cut.
struct Cut_places {
  std::span<const std::uint32_t> depths = {};  ///< of the polygons, as in Order_cuts; none, or one for each
  struct Cut {
    std::size_t place;
    std::uint32_t depth;
    Cone plane;  ///< met as it says, but without rays
    Rounded_cone in_doubles;
  };
  std::vector<Cut> others = {};  ///< from the first place to the last
};

/// Where a certificate says that its fragments may be cut; its depths must outlast it. Left out are planes that the eye
/// is in front of, or that are none, and all but one at each place, of the least depth, between fragments; and all if
/// the depths are not as many as the fragments.
Cut_places cut_places(const Order_certificate& certificate, const Workers& workers = 1);

/// Shows of pairs of a sequence that the earlier one is nowhere nearer than the later one. The sequence is cut at the
/// place of one of its polygons, and so is each part, until single ones are left. Of an earlier polygon beyond that
/// one's plane and a later one before it no more is to be asked. Proof: P-20
class Planes_between {
 public:
  /// Cuts where `places` say, the least depth first; and without them, or where that leaves more than a few polygons
  /// not settled, where a few of the polygons let it seem best.
  /// Pre: `rounded` are the cones, but for those that are edge-on; all outlive it, and so do the depths. Cost: O(n log
  /// n) sides of polygons to planes, for any sequence and any depths.
  Planes_between(const std::vector<Cone>& cones, const std::vector<Rounded_cone>& rounded, const Workers& workers = 1,
                 Cut_places places = {});

  /// Whether a polygon is on its side of all planes by which parts that hold it were cut, or edge-on, down to itself
  /// alone. No two such need be compared.
  bool is_settled(std::size_t polygon) const { return settled_[polygon] != 0; }

  /// Whether a plane is between them; what has no such plane may be in order all the same. Pre: earlier < later,
  /// neither is edge-on.
  bool in_order(std::size_t earlier, std::size_t later) const {
    const Path &a = paths_[earlier], &b = paths_[later];
    const int part = std::countl_zero(a.turns ^ b.turns);  // the least part that has both; it was cut between them
    return (part < deepest && ((a.apart & b.apart) << part & first) != 0) ||
           (of_samples_ != nullptr && of_samples_->in_order(earlier, later));
  }

 private:
  /// The parts that hold a polygon, the whole sequence first, a bit for each.
  struct Path {
    std::uint64_t turns = 0;  ///< 1: it is behind the cut
    std::uint64_t apart = 0;  ///< 1: it is on its side of the cut's plane, or in it
  };

  static constexpr int deepest = 64;  ///< of what paths tell
  /// Of what settles polygons: below so many cuts a part of a size is followed no more. Parts of a tree that are so
  /// deep are small; those of depths that take away one polygon at a time are not, and would be asked about each time.
  /// Of a few polygons, all.
  int deepest_part(std::size_t size) const {
    constexpr std::size_t few = 1024;
    return cones_.size() <= few ? int{few} : deepest + 8 * static_cast<int>(std::bit_width(cones_.size() / size));
  }
  static constexpr std::uint64_t first = std::uint64_t{1} << 63;

  /// Of the sequence: [begin, end), and how many parts hold it.
  struct Part {
    std::size_t begin, end;
    int depth;
    std::size_t size() const { return end - begin; }
  };

  /// Before the polygon at a place.
  struct Cut {
    std::size_t place;
    const Cone* plane;
    const Rounded_cone* in_doubles;
  };

  /// Cuts a part, its polygons shared out. Returns its two parts, none where it has one polygon, or no cut helps.
  std::vector<Part> cut(const Part& part, const Workers& workers);
  void cut_to_the_end(const Part& part, const Workers& worker);
  /// Pre: it has two polygons, or more.
  Cut cut_by_depth(const Part& part) const;
  Cut cut_by_samples(const Part& part) const;
  Cut at_plane_of(std::size_t polygon, std::size_t place) const {
    return {place, &cones_[polygon], &rounded_[polygon]};
  }
  /// Whether polygon i is on its side of the plane at a cut: beyond it if it is earlier, before it if not.
  bool is_apart(std::size_t i, const Cut& cut) const;

  const std::vector<Cone>& cones_;
  const std::vector<Rounded_cone>& rounded_;
  Cut_places places_;
  std::vector<Path> paths_;
  std::vector<char> settled_;
  std::unique_ptr<const Planes_between> of_samples_;  ///< cut without places
};

}  // namespace sightline::order_check
