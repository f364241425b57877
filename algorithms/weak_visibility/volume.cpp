#include <sightline/algorithms/weak_visibility/volume.h>

#include <sightline/kernel/scene/closed.h>
#include <sightline/kernel/scene/exact_plane.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/time_limit.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <utility>

namespace sightline {
namespace {

using Polygon = std::vector<Exact_point>;

/// Nearest doubles of the least and the largest coordinates: rounding keeps their order, so that what is apart in them
/// is apart.
using Near_ranges = std::array<std::array<double, 2>, 3>;

bool are_apart(const Near_ranges& a, const Near_ranges& b, std::size_t k) {
  return a[k][1] < b[k][0] || b[k][1] < a[k][0];
}
bool are_apart(const Near_ranges& a, const Near_ranges& b) {
  return are_apart(a, b, 0) || are_apart(a, b, 1) || are_apart(a, b, 2);
}
Near_ranges ranges_of(const Polygon& points) {
  const std::array<Exact_point, 2> box = exact_box(points);
  Near_ranges ranges;
  for (std::size_t k = 0; k < 3; ++k) ranges[k] = {nearest_double(box[0][k]), nearest_double(box[1][k])};
  return ranges;
}

Exact_point normal_of(const Exact_plane& h) { return {h[0], h[1], h[2]}; }

/// Between p and q, of which the heights above a plane are given, where that is. Pre: they are on both sides of it.
Exact_point crossing(const Exact_point& p, const Exact_point& q, const Rational& at, const Rational& after) {
  const Rational share = at / (at - after);
  Exact_point point;
  for (std::size_t k = 0; k < 3; ++k) point[k] = p[k] + share * (q[k] - p[k]);
  return point;
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
    if (sgn(at) * sgn(after) < 0) part.push_back(crossing(p, q, at, after));
  }
  return beyond ? part : Polygon{};
}

/// The corners of what a convex polygon has in a plane.
Polygon in_plane(const Polygon& polygon, const Exact_plane& h) {
  Polygon common;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Exact_point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Rational at = exact_height(h, p), after = exact_height(h, q);
    if (sgn(at) == 0) common.push_back(p);
    if (sgn(at) * sgn(after) < 0) common.push_back(crossing(p, q, at, after));
  }
  return common;
}

/// Whether what has these corners may meet the inside of a convex polygon that has the same plane: not where it is
/// beyond an edge, or on it.
bool may_meet_inside(const Polygon& common, const Polygon& polygon, const Exact_plane& plane) {
  for (std::size_t i = 0; i < polygon.size() && !common.empty(); ++i) {
    const Exact_point& a = polygon[i];
    const Exact_point inwards = cross(normal_of(plane), minus(polygon[(i + 1) % polygon.size()], a));
    if (std::all_of(common.begin(), common.end(), [&](const Exact_point& p) { return dot(inwards, minus(p, a)) <= 0; }))
      return false;
  }
  return !common.empty();
}

/// Directions of which any finite number of planes and edges lets some pass.
Exact_point direction_of_ray(long k) { return {Rational(1000003), Rational(7919 * k), Rational(104729 + k * k)}; }

/// The first coordinate, which grows along a ray of the first direction, and two numbers that stay the same.
Near_ranges along_first_rays(const Polygon& points) {
  const Exact_point d = direction_of_ray(1);
  Polygon turned;
  for (const Exact_point& p : points)
    turned.push_back({p[0], Rational(d[0] * p[1] - d[1] * p[0]), Rational(d[0] * p[2] - d[2] * p[0])});
  return ranges_of(turned);
}

}  // namespace

struct Weak_volume::Face {
  Polygon polygon;
  Exact_plane plane;
  int times;  // that it is given
  Near_ranges box = ranges_of(polygon), along_rays = along_first_rays(polygon);

  /// By how much the winding number on a ray from m is more before it than beyond; 0 too where m is in its plane, and
  /// the ray is not. Nothing where the ray meets an edge, or is in its plane.
  std::optional<int> step_along(const Exact_point& m, const Exact_point& direction) const {
    const int slope = sgn(dot(normal_of(plane), direction)), at = sgn(exact_height(plane, m));
    if (slope == 0 && at == 0) return std::nullopt;
    if (slope * at >= 0) return 0;
    bool meets_edge = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Exact_point a = minus(polygon[i], m), b = minus(polygon[(i + 1) % polygon.size()], m);
      const int side = slope * sgn(dot(direction, cross(a, b)));
      if (side < 0) return 0;
      meets_edge |= side == 0;
    }
    if (meets_edge) return std::nullopt;
    return slope * times;
  }
};

Weak_volume::~Weak_volume() = default;

Weak_volume::Weak_volume(const Polygon_soup& soup,
                         const std::function<void(std::size_t done, std::size_t all)>& progress) {
  const Scene scene(soup);
  if (scene.pieces().empty()) throw std::invalid_argument("a volume has no faces; give those of a closed polyhedron");
  if (!closure(scene).closed)
    throw std::invalid_argument(
        "the faces of a volume do not close up; add those that are missing, and turn the others so that all fronts "
        "look outwards, or all inwards");
  const std::vector<int> times = times_given(scene);
  for (const Piece& piece : scene.pieces())
    faces_.push_back({scene.corner_points(piece), scene.file_coefficients(piece.support), times[faces_.size()]});
  Polygon corners;
  for (const Face& face : faces_) corners.insert(corners.end(), face.polygon.begin(), face.polygon.end());
  box_ = ranges_of(corners);
  for (std::size_t k = 0; k < faces_.size(); ++k)
    add_surface(k, [&] {
      if (progress) progress(k, faces_.size());
    });
  if (surface_.empty())
    throw std::invalid_argument("the faces of a volume enclose nothing; give those of a closed polyhedron");
}

bool Weak_volume::sees_from_within(const std::vector<Exact_point>& polygon, bool behind) const {
  if (are_apart(ranges_of(polygon), box_)) return false;
  const Exact_plane plane = exact_plane(polygon);
  const std::vector<Polygon> parts = parts_of(polygon, plane, [] {}).polygons;
  return std::any_of(parts.begin(), parts.end(),
                     [&](const Polygon& part) { return winding_beside(part, plane, behind ? -1 : 1) != 0; });
}

Weak_volume::Parts Weak_volume::parts_of(const Polygon& polygon, const Exact_plane& plane, const Go_on& go_on) const {
  Parts parts{{polygon}, 0};
  const Near_ranges box = ranges_of(polygon);
  for (const Face& face : faces_) {
    if (are_apart(box, face.box)) continue;
    const Polygon common = in_plane(face.polygon, plane);
    if (!may_meet_inside(common, polygon, plane)) continue;
    parts.covers += common.size() == face.polygon.size();
    std::vector<Polygon> cut;
    for (Polygon& part : parts.polygons) {
      go_on();
      Polygon front, behind;
      if (may_meet_inside(common, part, plane)) {
        front = clipped(part, face.plane, 1);
        behind = clipped(part, face.plane, -1);
      }
      if (!front.empty() && !behind.empty()) {
        cut.push_back(std::move(front));
        cut.push_back(std::move(behind));
      } else cut.push_back(std::move(part));
    }
    parts.polygons = std::move(cut);
  }
  return parts;
}

int Weak_volume::winding_beside(const Polygon& part, const Exact_plane& plane, int beside) const {
  Exact_point mean{0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    for (const Exact_point& p : part) mean[k] += p[k];
    mean[k] /= static_cast<long>(part.size());
  }
  const Near_ranges of_mean = along_first_rays({mean});
  for (long k = 1;; ++k) {
    Exact_point direction = direction_of_ray(k);
    const int towards = beside * sgn(dot(normal_of(plane), direction));
    if (towards == 0) continue;
    for (Rational& x : direction) x *= towards;
    const auto misses = [&](const Near_ranges& of_face) {
      return are_apart(of_mean, of_face, 1) || are_apart(of_mean, of_face, 2) ||
             (towards > 0 ? of_face[0][1] < of_mean[0][0] : of_face[0][0] > of_mean[0][1]);
    };
    std::optional<int> winding = 0;
    for (std::size_t f = 0; f < faces_.size() && winding; ++f) {
      if (k == 1 && misses(faces_[f].along_rays)) continue;
      const std::optional<int> step = faces_[f].step_along(mean, direction);
      winding = step ? std::optional(*winding + *step) : std::nullopt;
    }
    if (winding) return *winding;
  }
}

void Weak_volume::add_surface(std::size_t k, const Go_on& go_on) {
  const Face& face = faces_[k];
  const Parts parts = parts_of(face.polygon, face.plane, go_on);
  std::vector<int> looks;  // 1: to its front, -1: to its back, 0: the inside is on both sides, or on none
  for (const Polygon& part : parts.polygons) {
    go_on();
    const int front = winding_beside(part, face.plane, 1),
              behind = parts.covers == 1 ? front + face.times : winding_beside(part, face.plane, -1);
    looks.push_back(int{behind != 0} - int{front != 0});
  }
  const auto add = [&](Polygon part, int look) {
    if (look < 0) std::reverse(part.begin(), part.end());
    if (look != 0) surface_.push_back(std::move(part));
  };
  if (std::all_of(looks.begin(), looks.end(), [&](int look) { return look == looks[0]; }))
    return add(face.polygon, looks[0]);
  for (std::size_t p = 0; p < parts.polygons.size(); ++p) add(parts.polygons[p], looks[p]);
}

std::vector<Face_id> add_seen_from_within(const Scene& scene, const Weak_volume& volume, bool two_sided,
                                          Weakly_visible& found, const std::function<bool()>& out_of_time) {
  std::vector<Face_id> within, unasked;
  for (const Piece& piece : scene.pieces()) {
    if (!unasked.empty() || has_run_out(out_of_time)) {
      unasked.push_back(piece.face);
      continue;
    }
    if ((!within.empty() && within.back() == piece.face) ||
        std::binary_search(found.visible.begin(), found.visible.end(), piece.face))
      continue;
    const std::vector<Exact_point> polygon = scene.corner_points(piece);
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
