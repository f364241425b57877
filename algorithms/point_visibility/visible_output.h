#pragma once
// What comes of regions: leaves, put together again where two show the same, and the tree of cuts above them.

#include <sightline/algorithms/point_visibility/view.h>
#include <sightline/algorithms/point_visibility/visible_region.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/scene/polygon_soup.h>
#include <sightline/kernel/scene/scene.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sightline::visible_detail {

/// What one thread makes of a region: as in Visible_surface, with a tree of its own.
template <View V>
struct Output {
  using Surface = Visible_surface<V>;

  std::vector<typename Surface::Part> parts;
  std::vector<typename V::Ray> rays;
  std::vector<typename Surface::Node> nodes;
  std::int32_t root = Surface::no_child;
  Visible_counters counters;

  /// A region in which one piece is seen, or none. Returns the leaf: a child as nodes have it.
  std::int32_t add(std::uint32_t piece, const Region<V>& region) {
    parts.push_back({piece, static_cast<std::uint32_t>(region.rays.size()), rays.size()});
    rays.insert(rays.end(), region.rays.begin(), region.rays.end());
    return ~static_cast<std::int32_t>(parts.size() - 1);
  }
  /// A region that a plane cuts. Two parts of it that show the same are one. Pre: the children are the latest that were
  /// added.
  std::int32_t merge(const typename V::Plane& w, const std::array<std::int32_t, 2>& children, const Region<V>& region) {
    if (children[0] == Surface::no_child) return children[1];
    if (children[1] == Surface::no_child) return children[0];
    if (children[0] < 0 && children[1] < 0) {
      const auto first = parts[parts.size() - 2], second = parts.back();
      if (first.piece == second.piece) {
        parts.resize(parts.size() - 2);
        rays.resize(first.first);
        ++counters.merged;
        return add(first.piece, region);
      }
    }
    nodes.push_back({w, children[0], children[1]});
    return static_cast<std::int32_t>(nodes.size() - 1);
  }
};

/// Puts one output behind another, or behind a surface. Returns what `child` of it becomes there.
template <View V, class To>
std::int32_t append(const Output<V>& from, std::int32_t child, To& to) {
  using Surface = Visible_surface<V>;
  const auto parts = static_cast<std::int32_t>(to.parts.size()), nodes = static_cast<std::int32_t>(to.nodes.size());
  const auto moved = [&](std::int32_t c) { return c == Surface::no_child ? c : c < 0 ? c - parts : c + nodes; };
  for (typename Surface::Part part : from.parts) {
    part.first += to.rays.size();
    to.parts.push_back(part);
  }
  for (const typename Surface::Node& node : from.nodes)
    to.nodes.push_back({node.plane, moved(node.front), moved(node.behind)});
  to.rays.insert(to.rays.end(), from.rays.begin(), from.rays.end());
  to.counters += from.counters;
  return moved(child);
}

/// Which faces have been seen, from which side; by any thread.
template <View V>
class Seen_faces {
 public:
  explicit Seen_faces(const V& view) : view_(view), sides_(view.scene().counters().faces_read) {}

  void note(std::uint32_t piece) {
    if (!has(piece)) sides_[face_of(piece)].fetch_or(side_bit(piece), std::memory_order_relaxed);
  }
  bool has(std::uint32_t piece) const {
    return (sides_[face_of(piece)].load(std::memory_order_relaxed) & side_bit(piece)) != 0;
  }
  void list_in(Visible_surface<V>& surface) const {
    for (Face_id f = 0; f < sides_.size(); ++f) {
      if ((sides_[f] & from_front) != 0) surface.visible.push_back(f);
      if ((sides_[f] & from_behind) != 0) surface.from_behind.push_back(f);
    }
  }

 private:
  static constexpr unsigned char from_front = 1, from_behind = 2;
  unsigned char side_bit(std::uint32_t piece) const {
    return view_.eye_side(piece) == CGAL::POSITIVE ? from_front : from_behind;
  }
  Face_id face_of(std::uint32_t piece) const { return view_.scene().pieces()[piece].face; }

  const V& view_;
  std::vector<std::atomic<unsigned char>> sides_;  // of each face, from_front and from_behind
};

}  // namespace sightline::visible_detail
