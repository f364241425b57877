#pragma once
// The scene as an eye sees it, in chunks of pieces and in boxes: on which side of a plane through the eye they are, and
// whether they meet a region. And what is known of a region that is not settled yet.

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/lazy_table.h>
#include <sightline/algorithms/point_visibility/view.h>
#include <sightline/algorithms/point_visibility/visible_region.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/kernel/located_point.h>
#include <sightline/kernel/plane.h>
#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/prepared_plane.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/sign.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sightline::visible_detail {

/// A chunk that may meet the region, with a bit for each edge plane that has parts of the region on both sides.
struct Item {
  std::uint32_t chunk, active;
  bool covers() const { return active == 0; }
};

/// A box that has not been opened, by its node.
struct Closed_box {
  std::uint32_t node;
  double distance;  // from the eye
  friend bool operator<(const Closed_box& a, const Closed_box& b) {
    return a.distance != b.distance ? a.distance > b.distance : a.node > b.node;
  }  // a heap has the nearest first
};

/// What is looked through in a region: pieces that are met there one behind the other, nearest first. All that is met
/// before the last is among them, so boxes behind its plane, where the eye is, hold nothing else.
struct Looked_through {
  const std::vector<std::uint32_t>& pieces;
  Prepared_plane last;

  bool has(std::uint32_t piece) const { return std::find(pieces.begin(), pieces.end(), piece) != pieces.end(); }
  bool passes(const Piece_boxes::Box& box) const { return Piece_boxes::is_behind(box, last); }
};

/// A region and what may be seen in it.
template <View V>
struct Task {
  Region<V> region;
  std::vector<Item> items;
  std::vector<Closed_box> boxes;                      // a heap
  std::uint32_t cover = Visible_surface<V>::nothing;  // the chunk that is nearest of those that cover the region
  std::vector<std::uint32_t> tied;                    // chunks in the plane of the cover that come after it
  std::uint32_t depth = 0;
  const Looked_through* through = nullptr;  // or nothing is

  bool has_cover() const { return cover != Visible_surface<V>::nothing; }
  void remove_item(std::size_t i) {
    items[i] = items.back();
    items.pop_back();
  }
};

template <View V>
class Chunks {
 public:
  using Plane = typename V::Plane;

  Chunks(const V& view, const Piece_boxes& boxes)
      : view_(view), boxes_(boxes), eye_(located_eye(view)), edges_(boxes.chunks().size()) {}

  const V& view() const { return view_; }
  const Located_point& eye() const { return eye_; }
  const Piece_boxes& boxes() const { return boxes_; }
  const Piece_boxes::Node& node(const Closed_box& box) const { return boxes_.nodes()[box.node]; }
  std::uint32_t piece_of(std::uint32_t chunk) const { return boxes_.chunks()[chunk].piece; }
  std::span<const std::uint32_t> points_of(std::uint32_t chunk) const { return boxes_.points(boxes_.chunks()[chunk]); }

  /// The planes through the eye and a chunk's edges, its inside in their front. Pre: it is not edge-on.
  const Plane* edges_of(std::uint32_t chunk) const {
    return edges_.at(chunk, [&](std::size_t c) { return make_edges(static_cast<std::uint32_t>(c)); }).data();
  }

  /// A chunk of which nothing is known in a region.
  Item with_all_edges(std::uint32_t chunk) const {
    const std::uint32_t size = boxes_.chunks()[chunk].size;
    return {chunk, size == 32 ? ~0u : (1u << size) - 1};
  }
  /// Updates which edges of a chunk cut the region. Returns whether it may still meet it.
  bool update(Item& item, const Region<V>& region, Predicate_counts& counts) const {
    const Plane* edges = item.active != 0 ? edges_of(item.chunk) : nullptr;
    for (std::uint32_t bits = item.active; bits != 0; bits &= bits - 1) {
      const auto k = static_cast<std::uint32_t>(std::countr_zero(bits));
      const Plane& edge = edges[k];
      bool inside = false, outside = false;
      for (const typename V::Ray& r : region.rays) {
        const Sign s = view_.side(edge, r, counts);
        inside = inside || s == CGAL::POSITIVE;
        outside = outside || s == CGAL::NEGATIVE;
        if (inside && outside) break;
      }
      if (!inside) return false;
      if (!outside) item.active &= ~(1u << k);
    }
    return true;
  }
  /// Whether a chunk and a region in front of its plane have an open set in common. Proof: P-62
  bool meets(std::uint32_t chunk, const Region<V>& region, Predicate_counts& counts) const {
    Item item = with_all_edges(chunk);
    return update(item, region, counts) && (item.covers() || !is_outside(chunk, region, counts));
  }

  bool same_plane(std::uint32_t f, std::uint32_t g) const { return view_.same_plane(piece_of(f), piece_of(g)); }
  /// Whether chunk f is shown where both are met at once.
  bool comes_first(std::uint32_t f, std::uint32_t g) const {
    const std::uint32_t a = piece_of(f), b = piece_of(g);
    const Sign side_a = view_.eye_side(a), side_b = view_.eye_side(b);
    if (side_a != side_b) return side_a == CGAL::POSITIVE;
    const Piece &p = view_.scene().pieces()[a], &q = view_.scene().pieces()[b];
    return p.face != q.face ? p.face < q.face : p.number <= q.number;
  }
  /// A direction inside a chunk, approximately.
  Approximate_vector middle_of(std::uint32_t chunk) const {
    const Grid_points& points = view_.scene().points();
    Approximate_vector sum{0, 0, 0};
    for (const std::uint32_t p : points_of(chunk)) {
      sum.x += points.approximate(p, 0) - eye_.ax;
      sum.y += points.approximate(p, 1) - eye_.ay;
      sum.z += points.approximate(p, 2) - eye_.az;
    }
    return sum;
  }
  /// Whether a direction is inside a chunk's cone, as far as doubles say so.
  bool holds(std::uint32_t chunk, const Approximate_vector& direction) const {
    const Plane* edges = edges_of(chunk);
    return std::all_of(edges, edges + points_of(chunk).size(), [&](const Plane& w) {
      const std::array<double, 3> n = view_.approximate(w).normal;
      return n[0] * direction.x + n[1] * direction.y + n[2] * direction.z > 0;
    });
  }

  /// The same of a direction in the region, which need be held to the edges only that cut it.
  bool holds(const Item& item, const Approximate_vector& direction) const {
    const Plane* edges = item.active != 0 ? edges_of(item.chunk) : nullptr;
    for (std::uint32_t bits = item.active; bits != 0; bits &= bits - 1) {
      const std::array<double, 3> n = view_.approximate(edges[std::countr_zero(bits)]).normal;
      if (!(n[0] * direction.x + n[1] * direction.y + n[2] * direction.z > 0)) return false;
    }
    return true;
  }

  bool is_behind(std::uint32_t chunk, const Plane& w, Predicate_counts& counts) const {
    for (const std::uint32_t p : points_of(chunk))
      if (view_.side(w, p, counts) == CGAL::POSITIVE) return false;
    return true;
  }
  bool is_behind(const Piece_boxes::Node& node, const Plane& w) const {
    const Approximate_eye_plane a = view_.approximate(w);
    if constexpr (requires { view_.is_sun(); })
      if (view_.is_sun()) return is_behind_for_sun(node.box, a);
    return Piece_boxes::is_behind(node.box, a.normal, a.size, a.error, eye_);
  }
  /// At most the distance of what is in a box, as `farthest` of the view measures it; of a sun, of which that says
  /// nothing, by which boxes come one after the other.
  double distance(const Piece_boxes::Box& box) const {
    if constexpr (requires { view_.is_sun(); })
      if (view_.is_sun()) {
        const std::array<double, 3>& d = view_.towards_sun();
        double nearest = 0;
        for (std::size_t k = 0; k < 3; ++k) nearest += d[k] * (d[k] > 0 ? box.high[k] : box.low[k]);
        return -nearest;
      }
    return Piece_boxes::distance(box, eye_);
  }
  /// Whether it is behind a side of the region, so none of it is in there.
  bool is_outside(std::uint32_t chunk, const Region<V>& region, Predicate_counts& counts) const {
    return std::any_of(region.sides.begin(), region.sides.end(),
                       [&](const Plane& w) { return is_behind(chunk, w, counts); });
  }
  bool is_outside(const Piece_boxes::Node& node, const Region<V>& region) const {
    return std::any_of(region.sides.begin(), region.sides.end(), [&](const Plane& w) { return is_behind(node, w); });
  }

 private:
  /// Whether all of a box is strictly behind a plane through the sun, for certain. P-96
  bool is_behind_for_sun(const Piece_boxes::Box& box, const Approximate_eye_plane& w) const {
    const std::array<double, 4> plane = view_.sun_plane(w);
    double value = plane[3], reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      value += plane[k] * (plane[k] > 0 ? box.high[k] : box.low[k]);
      reach = std::max({reach, std::fabs(box.high[k]), std::fabs(box.low[k])});
    }
    return value < -((w.error + 0x1p-49 * w.size) * (4 * reach + std::fabs(view_.sun_last())) + 0x1p-1000);
  }
  static Located_point located_eye(const V& view) {
    if constexpr (requires { view.located_eye(); }) return view.located_eye();
    else return view.scene().locate(view.eye());
  }
  std::vector<Plane> make_edges(std::uint32_t chunk) const {
    const std::span<const std::uint32_t> points = points_of(chunk);
    // Counterclockwise as seen from the front is clockwise around the rays from an eye in front.
    const bool turned = view_.eye_side(piece_of(chunk)) == CGAL::POSITIVE;
    std::vector<Plane> edges;
    edges.reserve(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      const std::uint32_t p = points[k], q = points[k + 1 == points.size() ? 0 : k + 1];
      edges.push_back(turned ? view_.edge(q, p) : view_.edge(p, q));
    }
    return edges;
  }

  const V& view_;
  const Piece_boxes& boxes_;
  Located_point eye_;
  Lazy_table<std::vector<Plane>, 1> edges_;
};

}  // namespace sightline::visible_detail
