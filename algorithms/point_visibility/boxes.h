#pragma once
// A tree of boxes around the pieces of a scene: what lies wholly behind something, or outside of a field of view, is
// never looked at piece by piece.

#include <sightline/kernel/located_point.h>
#include <sightline/kernel/scene/scene.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sightline {

struct Prepared_plane;

/// Boxes in the grid's approximate coordinates, rounded outwards, halved at the median of their longest side. It serves
/// any number of eyes. Cost: O(n log n), in parallel. Exact: no, conservative; nothing is decided by a box but that all
/// in it is away.
class Piece_boxes {
 public:
  struct Box {
    std::array<double, 3> low, high;
  };
  /// Up to 32 corners of a piece: all of them, as a rule, else what a chord cuts off, of the piece or of what other
  /// chords have left of it.
  struct Chunk {
    std::uint32_t piece, first, size;
  };
  struct Node {
    Box box;
    std::uint32_t first, count;  ///< its chunks
    std::uint32_t second;        ///< the second child; the first is the next node; 0: a leaf
  };
  static constexpr std::uint32_t leaf_size = 4, chunk_size = 32;

  explicit Piece_boxes(const Scene& scene);

  std::span<const Node> nodes() const { return nodes_; }  ///< the root first; none for an empty scene
  std::span<const Chunk> chunks() const { return chunks_; }
  std::span<const std::uint32_t> points(const Chunk& chunk) const { return {points_.data() + chunk.first, chunk.size}; }

  /// Whether all of a box is strictly behind a plane, for certain.
  static bool is_behind(const Box& box, const Prepared_plane& h);
  /// Whether all of a box is strictly behind a plane through the eye, for certain. `size`: of its normal; each entry is
  /// within `error`.
  static bool is_behind(const Box& box, const std::array<double, 3>& n, double size, double error,
                        const Located_point& eye);
  /// At most the distance from the eye, but for rounding by a relative 2^-50 and errors of the eye. 0 where that is too
  /// far for its square.
  static double distance(const Box& box, const Located_point& eye);

 private:
  struct Entry {
    Box box;
    std::uint32_t piece, first, step, size;  // corners first, first + step, ... of the piece, 0 beyond the last
  };
  static std::uint32_t corner(const Scene& scene, const Entry& entry, std::uint32_t k);
  static std::vector<Entry> entries_of(const Scene& scene);

  /// How many nodes a tree of so many chunks has: of each two halves at most two sizes differ, so this takes a step for
  /// each level.
  static std::uint32_t nodes_for(std::uint32_t count);
  /// Node `at` for entries [first, first + count), which come into the order of the tree.
  void build(std::vector<Entry>& entries, std::uint32_t at, std::uint32_t first, std::uint32_t count);
  void place(const Scene& scene, const std::vector<Entry>& entries);

  std::vector<Node> nodes_;
  std::vector<Chunk> chunks_;  // in the order of the tree
  std::vector<std::uint32_t> points_;
};

inline bool Piece_boxes::is_behind(const Box& box, const std::array<double, 3>& n, double size, double error,
                                   const Located_point& eye) {
  const std::array<double, 3> e{eye.ax, eye.ay, eye.az};
  double value = 0, reach = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = (n[k] > 0 ? box.high[k] : box.low[k]) - e[k];
    value += n[k] * x;
    reach = std::max({reach, std::fabs(x), std::fabs(e[k])});
  }
  return value <
         -(reach * error + 0x1p-52 * (8 * reach * size) + 2 * size * eye.error + 0x1p-1000 * (1 + size));  // P-60
}

}  // namespace sightline
