#include <sightline/algorithms/weak_visibility/volume.h>

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/bsp/query.h>
#include <sightline/kernel/scene/closed.h>
#include <sightline/kernel/scene/exact_plane.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace sightline {
namespace {

using Polygon = std::vector<Exact_point>;

Bsp_options one_thread() {
  Bsp_options options;
  options.threads = 1;
  return options;
}

bool apart(const std::array<Exact_point, 2>& a, const std::array<Exact_point, 2>& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a[1][k] < b[0][k] || b[1][k] < a[0][k]) return true;
  return false;
}

/// The part of a convex polygon with sign * height >= 0; empty where that has no inside.
Polygon clipped(const Polygon& polygon, const Exact_plane& h, int sign) {
  Polygon part;
  bool beyond = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Exact_point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Rational at = sign * exact_height(h, p), after = sign * exact_height(h, q);
    beyond |= sgn(at) > 0;
    if (sgn(at) >= 0) part.push_back(p);
    if (sgn(at) * sgn(after) >= 0) continue;
    const Rational share = at / (at - after);
    Exact_point crossing;
    for (std::size_t k = 0; k < 3; ++k) crossing[k] = p[k] + share * (q[k] - p[k]);
    part.push_back(crossing);
  }
  return beyond ? part : Polygon{};
}

}  // namespace

struct Weak_volume::Space {
  explicit Space(const Polygon_soup& soup) : scene(soup), traits(scene), tree(build_bsp(traits, one_thread())) {}
  Scene scene;
  Exact_traits traits;
  Exact_tree tree;
};

Weak_volume::~Weak_volume() = default;

Weak_volume::Weak_volume(const Polygon_soup& soup) : space_(std::make_unique<const Space>(soup)) {
  const Scene& scene = space_->scene;
  if (scene.pieces().empty()) throw std::invalid_argument("a volume has no faces; give those of a closed polyhedron");
  if (!closure(scene).closed)
    throw std::invalid_argument(
        "the faces of a volume do not close up; add those that are missing, and turn the others so that all fronts "
        "look outwards, or all inwards");
  for (const Piece& piece : scene.pieces()) {
    Polygon& polygon = polygons_.emplace_back();
    for (const Piece_corner& corner : scene.corners(piece)) polygon.push_back(scene.position(corner.point));
    planes_.push_back(scene.file_coefficients(piece.support));
    boxes_.push_back(exact_box(polygon));
  }
  Polygon corners;
  for (const std::array<Exact_point, 2>& box : boxes_) corners.insert(corners.end(), box.begin(), box.end());
  box_ = exact_box(corners);
  for (std::size_t k = 0; k < polygons_.size(); ++k) add_surface(polygons_[k], planes_[k]);
  if (surface_.empty())
    throw std::invalid_argument("the faces of a volume enclose nothing; give those of a closed polyhedron");
}

bool Weak_volume::sees_from_within(const std::vector<Exact_point>& polygon, bool behind) const {
  if (apart(exact_box(polygon), box_)) return false;
  const Exact_plane plane = exact_plane(polygon);
  const std::vector<Polygon> parts = parts_of(polygon);
  return std::any_of(parts.begin(), parts.end(),
                     [&](const Polygon& part) { return is_inside_beside(part, plane, behind ? -1 : 1); });
}

std::vector<Weak_volume::Polygon> Weak_volume::parts_of(const Polygon& polygon) const {
  std::vector<Polygon> parts{polygon};
  const std::array<Exact_point, 2> box = exact_box(polygon);
  for (std::size_t k = 0; k < polygons_.size(); ++k) {
    if (apart(box, boxes_[k])) continue;
    std::vector<Polygon> cut;
    for (Polygon& part : parts) {
      Polygon front = clipped(part, planes_[k], 1), behind = clipped(part, planes_[k], -1);
      if (!front.empty() && !behind.empty()) {
        cut.push_back(std::move(front));
        cut.push_back(std::move(behind));
      } else cut.push_back(std::move(part));
    }
    parts = std::move(cut);
  }
  return parts;
}

bool Weak_volume::is_inside_beside(const Polygon& part, const Exact_plane& plane, int beside) const {
  Exact_point mean{0, 0, 0}, direction;
  for (std::size_t k = 0; k < 3; ++k) {
    for (const Exact_point& p : part) mean[k] += p[k];
    mean[k] /= static_cast<long>(part.size());
    direction[k] = beside * plane[k];
  }
  Rational step = 1;
  for (const Exact_plane& h : planes_) {
    const Rational at = exact_height(h, mean), slope = h[0] * direction[0] + h[1] * direction[1] + h[2] * direction[2];
    if (sgn(at) * sgn(slope) < 0) step = std::min(step, Rational(-at / (2 * slope)));
  }
  for (Predicate_counts counts;; step /= 2) {
    Exact_point beside_it;
    for (std::size_t k = 0; k < 3; ++k) beside_it[k] = mean[k] + step * direction[k];
    const Location location = locate_point(space_->traits, space_->tree, beside_it, true, counts).location;
    if (location != Location::on)
      return location == Location::inside;  // on: in a face upright on the part, that the surface passes twice
  }
}

void Weak_volume::add_surface(const Polygon& polygon, const Exact_plane& plane) {
  const std::vector<Polygon> parts = parts_of(polygon);
  std::vector<int> looks;  // 1: to its front, -1: to its back, 0: the inside is on both sides, or on none
  for (const Polygon& part : parts)
    looks.push_back(int{is_inside_beside(part, plane, -1)} - int{is_inside_beside(part, plane, 1)});
  const auto add = [&](Polygon part, int look) {
    if (look < 0) std::reverse(part.begin(), part.end());
    if (look != 0) surface_.push_back(std::move(part));
  };
  if (std::all_of(looks.begin(), looks.end(), [&](int look) { return look == looks[0]; }))
    return add(polygon, looks[0]);
  for (std::size_t k = 0; k < parts.size(); ++k) add(parts[k], looks[k]);
}

std::vector<Face_id> add_seen_from_within(const Scene& scene, const Weak_volume& volume, bool two_sided,
                                          Weakly_visible& found, const std::function<bool()>& out_of_time) {
  std::vector<Face_id> within, unasked;
  for (const Piece& piece : scene.pieces()) {
    if (!unasked.empty() || (out_of_time && out_of_time())) {
      unasked.push_back(piece.face);
      continue;
    }
    if ((!within.empty() && within.back() == piece.face) ||
        std::binary_search(found.visible.begin(), found.visible.end(), piece.face))
      continue;
    std::vector<Exact_point> polygon;
    for (const Piece_corner& corner : scene.corners(piece)) polygon.push_back(scene.position(corner.point));
    if (volume.sees_from_within(polygon, false) || (two_sided && volume.sees_from_within(polygon, true)))
      within.push_back(piece.face);
  }
  std::vector<Face_id> left;  // hidden from the surface, as far as that was found
  std::copy_if(found.hidden.begin(), found.hidden.end(), std::back_inserter(left), [&](Face_id face) {
    return std::binary_search(unasked.begin(), unasked.end(), face) &&
           !std::binary_search(within.begin(), within.end(), face);
  });
  const auto is_left = [&](Face_id face) { return std::binary_search(left.begin(), left.end(), face); };
  std::erase_if(found.hidden, is_left);
  std::erase_if(found.unproved, is_left);
  std::erase_if(found.pairs, [&](const auto& pair) { return is_left(scene.pieces()[pair.piece].face); });
  found.undecided.insert(found.undecided.end(), left.begin(), left.end());
  std::sort(found.undecided.begin(), found.undecided.end());

  const auto is_within = [&](Face_id face) { return std::binary_search(within.begin(), within.end(), face); };
  const auto of_face = [&](const Weakly_visible::Pair& pair) { return is_within(scene.pieces()[pair.piece].face); };
  std::erase_if(found.hidden, is_within);
  std::erase_if(found.undecided, is_within);
  std::erase_if(found.pairs, of_face);
  std::erase_if(found.open, of_face);
  for (std::vector<Face_id>* list : {&found.visible, &found.unproved}) {
    list->insert(list->end(), within.begin(), within.end());
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  return within;
}

}  // namespace sightline
