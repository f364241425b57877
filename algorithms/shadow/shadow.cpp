#include <sightline/algorithms/shadow/shadow.h>

#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/point_visibility/visible_region.h>
#include <sightline/algorithms/point_visibility/visible_surface.h>
#include <sightline/kernel/threads.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <stdexcept>
#include <utility>

namespace sightline {

namespace {

using Seen_surface = Visible_surface<Exact_view>;
using Light_cone = Seen_surface::Cone;

/// One piece in the view of the light, down the trees of what is seen.
class Parting {
 public:
  Parting(const Exact_view& view, const Seen_surface& surface, std::uint32_t piece, Shadow_counters& counters)
      : view_(view), surface_(surface), piece_(piece), counters_(counters) {}

  std::vector<Shadow_part> parts() {
    ++counters_.pieces;
    const Light_cone whole = cone();
    for (std::size_t k = 0; k < surface_.cones.size(); ++k) {
      // The part of the piece in a cone that the view began with.
      Light_cone inside = whole;
      bool any = true;
      for (const Exact_view::Plane& side : surface_.cones[k].sides) {
        const Sides sides = sides_of(inside, side);
        if (sides.front && sides.behind) inside = std::move(cut(inside, side)[0]);
        any = sides.front && !inside.rays.empty();
        if (!any) break;
      }
      if (any) descend(surface_.roots[k], std::move(inside));
    }
    std::vector<Shadow_part> made;
    for (const Made& part : made_) {
      std::vector<Exact_point> corners;
      for (const Exact_view::Ray& r : part.cone.rays) corners.push_back(view_.position(piece_, r));
      if (view_.eye_side(piece_) == CGAL::POSITIVE) std::reverse(corners.begin(), corners.end());
      made.push_back({piece_, part.by, view_.eye_side(piece_), std::move(corners)});
    }
    return made;
  }

 private:
  struct Made {
    Light_cone cone;
    std::uint32_t by;
  };

  /// The directions to the piece; its corners run clockwise around them where the light is in front.
  Light_cone cone() const {
    const std::span<const Piece_corner> corners = view_.scene().corners(view_.scene().pieces()[piece_]);
    std::vector<std::uint32_t> points;
    for (const Piece_corner& corner : corners) points.push_back(corner.point);
    if (view_.eye_side(piece_) == CGAL::POSITIVE) std::reverse(points.begin(), points.end());
    Light_cone cone;
    for (std::size_t k = 0; k < points.size(); ++k) {
      cone.rays.push_back(view_.ray(points[k]));
      cone.sides.push_back(view_.edge(points[k], points[k + 1 == points.size() ? 0 : k + 1]));
    }
    return cone;
  }

  /// Whether a cone has rays strictly in front of a plane, and behind it.
  struct Sides {
    bool front = false, behind = false;
  };
  Sides sides_of(const Light_cone& cone, const Exact_view::Plane& w) {
    Sides sides;
    for (const Exact_view::Ray& r : cone.rays) {
      const Sign s = view_.side(w, r, counts_);
      sides.front = sides.front || s == CGAL::POSITIVE;
      sides.behind = sides.behind || s == CGAL::NEGATIVE;
    }
    return sides;
  }
  /// The parts in front of a plane and behind it. Pre: it has some of the cone on either side.
  std::array<Light_cone, 2> cut(const Light_cone& cone, const Exact_view::Plane& w) {
    ++counters_.cuts;
    return visible_detail::cut(view_, cone, w, counts_);
  }

  /// Parts a cone below a child of the tree; two parts of it with one answer are one again.
  void descend(std::int32_t child, Light_cone cone) {
    // Past nodes that do not cut it, which are as many as the tree is deep.
    while (child >= 0) {
      const Seen_surface::Node& node = surface_.nodes[static_cast<std::size_t>(child)];
      const Sides sides = sides_of(cone, node.plane);
      if (sides.front && sides.behind) break;
      child = sides.front ? node.front : node.behind;
    }
    if (child < 0) {
      const std::uint32_t seen = surface_.parts[static_cast<std::size_t>(~child)].piece;
      if (seen == Seen_surface::nothing) throw std::logic_error("a piece in directions in which nothing is seen");
      const bool lit = seen == piece_ || view_.same_plane(seen, piece_);
      made_.push_back({std::move(cone), lit ? Shadow_part::nothing : seen});
      return;
    }
    const Seen_surface::Node& node = surface_.nodes[static_cast<std::size_t>(child)];
    std::array<Light_cone, 2> halves = cut(cone, node.plane);
    const std::size_t before = made_.size();
    if (!halves[0].rays.empty()) descend(node.front, std::move(halves[0]));
    const std::size_t middle = made_.size();
    if (!halves[1].rays.empty()) descend(node.behind, std::move(halves[1]));
    if (middle == before + 1 && made_.size() == before + 2 && made_[before].by == made_[middle].by) {
      ++counters_.merged;
      made_.pop_back();
      made_[before].cone = std::move(cone);
    }
  }

  const Exact_view& view_;
  const Seen_surface& surface_;
  std::uint32_t piece_;
  Shadow_counters& counters_;
  Predicate_counts counts_;
  std::vector<Made> made_;
};

}  // namespace

Shadows shadows(const Exact_view& light, const Piece_boxes& boxes, const Shadow_options& options) {
  const Scene& scene = light.scene();
  // 1. What the light sees.
  Visible_options seeing;
  seeing.threads = options.threads;
  seeing.progress = options.progress;
  const Seen_surface surface = visible_surface(light, boxes, seeing);

  // 2. Each piece by what is seen in its directions.
  std::vector<std::vector<Shadow_part>> of_piece(scene.pieces().size());
  Per_thread<Shadow_counters> counters;
  std::atomic<std::size_t> done{0};
  run_with_threads(options.threads, [&] {
    parallel_for(of_piece.size(), [&](std::size_t i) {
      const auto piece = static_cast<std::uint32_t>(i);
      const Sign side = light.eye_side(piece);
      if (side == CGAL::POSITIVE || (side == CGAL::NEGATIVE && options.two_sided))
        of_piece[i] = Parting(light, surface, piece, counters.local()).parts();
      const std::size_t now = ++done;
      if (options.progress && (now % 256 == 0 || now == of_piece.size())) options.progress(now, of_piece.size());
    });
  });

  // 3. In order.
  Shadows result;
  counters.for_each([&](Shadow_counters& c) { result.counters += c; });
  std::vector<bool> turned(scene.counters().faces_read), lit(turned.size()), kept(turned.size());
  for (std::size_t i = 0; i < of_piece.size(); ++i) {
    const Face_id face = scene.pieces()[i].face;
    kept[face] = true;
    for (Shadow_part& part : of_piece[i]) {
      turned[face] = true;
      lit[face] = lit[face] || part.is_lit();
      result.parts.push_back(std::move(part));
    }
  }
  for (Face_id face = 0; face < kept.size(); ++face) {
    if (lit[face]) result.lit.push_back(face);
    if (kept[face] && !turned[face]) result.away.push_back(face);
  }
  return result;
}

}  // namespace sightline
