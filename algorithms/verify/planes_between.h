#pragma once
// Pairs that need not be compared, as a plane of the sequence itself is between them. To be read after rounded_cones.h.

#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/rounded_cones.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline::order_check {

/// Shows of pairs of a sequence that the earlier one is nowhere nearer than the later one. The sequence is cut at the
/// place of one of its polygons, and so is each part, until single ones are left. Of an earlier polygon beyond that
/// one's plane and a later one before it no more is to be asked. Proof: P-20
class Planes_between {
 public:
  /// Pre: `rounded` are the cones, but for those that are edge-on; both outlive it. Cost: O(n log n) sides of polygons
  /// to planes, for any sequence.
  Planes_between(const std::vector<Cone>& cones, const std::vector<Rounded_cone>& rounded, const Workers& workers = 1);

  /// Whether a plane is between them; what has no such plane may be in order all the same. Pre: earlier < later,
  /// neither is edge-on.
  bool in_order(std::size_t earlier, std::size_t later) const {
    const Path &a = paths_[earlier], &b = paths_[later];
    const int part = std::countl_zero(a.turns ^ b.turns);  // the least part that has both; it was cut between them
    return part < deepest && ((a.apart & b.apart) << part & first) != 0;
  }

 private:
  /// The parts that hold a polygon, the whole sequence first, a bit for each.
  struct Path {
    std::uint64_t turns = 0;  ///< 1: it is behind the cut
    std::uint64_t apart = 0;  ///< 1: it is on its side of the cut's plane, or in it
  };

  static constexpr int deepest = 64;
  static constexpr std::uint64_t first = std::uint64_t{1} << 63;

  /// Of the sequence: [begin, end), and how many parts hold it.
  struct Part {
    std::size_t begin, end;
    int depth;
    std::size_t size() const { return end - begin; }
  };

  /// Cuts a part, its polygons shared out. Returns its two parts, none where it has one polygon.
  std::vector<Part> cut(const Part& part, const Workers& workers);
  void cut_to_the_end(const Part& part);
  /// Whether polygon i is on its side of the plane of polygon `at`: beyond it if it is earlier, before it if not.
  bool is_apart(std::size_t i, std::size_t at) const;

  const std::vector<Cone>& cones_;
  const std::vector<Rounded_cone>& rounded_;
  std::vector<Path> paths_;
};

}  // namespace sightline::order_check
