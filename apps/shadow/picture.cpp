#include "picture.h"

#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace sightline::app {

namespace {

using Corners = std::vector<Direction3>;

/// A normal, as long as twice the area.
Direction3 area_normal_of(const Corners& corners) {
  Direction3 normal{};
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const Direction3 n = cross(minus(corners[k - 1], corners[0]), minus(corners[k], corners[0]));
    for (std::size_t i = 0; i < 3; ++i) normal[i] += n[i];
  }
  return normal;
}

/// The axis that a polygon is steepest to.
std::size_t axis_of(const Corners& corners) {
  const Direction3 normal = area_normal_of(corners);
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::fabs(normal[k]) > std::fabs(normal[axis])) axis = k;
  return axis;
}

/// Twice its area.
double size_of(const Corners& corners) {
  const Direction3 normal = area_normal_of(corners);
  return std::sqrt(dot(normal, normal));
}

/// What is in both of two convex polygons of one plane, which is not parallel to the axis.
Corners common_part(Corners polygon, const Corners& by, std::size_t axis) {
  const std::size_t x = (axis + 1) % 3, y = (axis + 2) % 3;
  const double sense = area_normal_of(by)[axis] < 0 ? -1 : 1;
  for (std::size_t k = 0; k < by.size() && !polygon.empty(); ++k) {
    const Direction3 &a = by[k], &b = by[(k + 1) % by.size()];
    const auto inside = [&](const Direction3& p) {
      return ((b[x] - a[x]) * (p[y] - a[y]) - (b[y] - a[y]) * (p[x] - a[x])) * sense;
    };
    Corners left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Direction3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const double at_p = inside(p), at_q = inside(q);
      if (at_p >= 0) left.push_back(p);
      if ((at_p < 0) == (at_q < 0)) continue;
      const double share = at_p / (at_p - at_q);
      left.push_back({p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1]), p[2] + share * (q[2] - p[2])});
    }
    polygon = std::move(left);
  }
  return polygon.size() < 3 ? Corners() : polygon;
}

Corners rounded_corners(const Near_doubles& doubles, const std::vector<Exact_point>& corners) {
  Corners all;
  for (const Exact_point& p : corners) all.push_back(doubles.point(p));
  return all;
}

/// A part of what the eye sees, with how many lights reach it, and what shadows it from the last one that does not.
struct Shown {
  std::uint32_t piece;
  Sign side;
  bool is_small;  ///< in the picture
  std::size_t lights = 0;
  bool turned = false;  ///< to a light
  std::uint32_t by = Shadow_part::nothing;
  Corners corners = {};

  /// What looks alike is one shape.
  auto look() const { return std::tuple(piece, lights, turned, by); }
};

using Flat_box = std::array<Flat_point, 2>;  // least, most
constexpr Flat_box empty_box{{{1e300, 1e300}, {-1e300, -1e300}}};
void add_to(Flat_box& box, const Flat_point& p) {
  for (std::size_t k = 0; k < 2; ++k) {
    box[0][k] = std::min(box[0][k], p[k]);
    box[1][k] = std::max(box[1][k], p[k]);
  }
}
Flat_box box_of(const std::vector<Flat_point>& points) {
  Flat_box box = empty_box;
  for (const Flat_point& p : points) add_to(box, p);
  return box;
}

/// The parts that a light makes of one side of a piece, found by where they are on it: a ground has thousands.
class Parts_on_piece {
 public:
  void add(const Shadow_part& part, Corners corners) { parts_.push_back({&part, std::move(corners), {}}); }
  bool empty() const { return parts_.empty(); }

  void prepare() {
    if (parts_.empty()) return;
    axis_ = axis_of(parts_[0].corners);
    whole_ = empty_box;
    for (One& one : parts_) {
      one.box = box(one.corners);
      for (const Flat_point& p : one.box) add_to(whole_, p);
    }
    side_ = std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(static_cast<double>(parts_.size()))), 1, 512);
    cells_.assign(side_ * side_, {});
    seen_.assign(parts_.size(), 0);
    for (std::uint32_t i = 0; i < parts_.size(); ++i)
      for_each_cell(parts_[i].box, [&](auto& cell) { cell.push_back(i); });
  }

  /// visit(part, what it has in common with a polygon of the piece), in their order.
  template <class Visit>
  void cut(const Corners& polygon, Visit visit) {
    const Flat_box at = box(polygon);
    ++asked_;
    std::vector<std::uint32_t> near;
    for_each_cell(at, [&](const auto& cell) {
      for (const std::uint32_t i : cell)
        if (std::exchange(seen_[i], asked_) != asked_ && are_near(parts_[i].box, at)) near.push_back(i);
    });
    std::sort(near.begin(), near.end());
    for (const std::uint32_t i : near)
      if (Corners common = common_part(polygon, parts_[i].corners, axis_); !common.empty())
        visit(*parts_[i].part, std::move(common));
  }

 private:
  struct One {
    const Shadow_part* part;
    Corners corners;
    Flat_box box;
  };

  Flat_box box(const Corners& corners) const {
    Flat_box box = empty_box;
    for (const Direction3& p : corners) add_to(box, {p[(axis_ + 1) % 3], p[(axis_ + 2) % 3]});
    return box;
  }
  static bool are_near(const Flat_box& a, const Flat_box& b) {
    return a[0][0] <= b[1][0] && b[0][0] <= a[1][0] && a[0][1] <= b[1][1] && b[0][1] <= a[1][1];
  }
  template <class Visit>
  void for_each_cell(const Flat_box& box, Visit visit) {
    const auto cell = [&](double x, std::size_t k) {
      const double at = (x - whole_[0][k]) / (whole_[1][k] - whole_[0][k]) * static_cast<double>(side_);
      return at > 0 ? std::min(side_ - 1, static_cast<std::size_t>(std::min(at, 1e9))) : 0;  // 0 for no number, too
    };
    for (std::size_t y = cell(box[0][1], 1); y <= cell(box[1][1], 1); ++y)
      for (std::size_t x = cell(box[0][0], 0); x <= cell(box[1][0], 0); ++x) visit(cells_[y * side_ + x]);
  }

  std::vector<One> parts_;
  std::size_t axis_ = 0, side_ = 1;
  Flat_box whole_{};
  std::vector<std::vector<std::uint32_t>> cells_;
  std::vector<std::uint64_t> seen_;
  std::uint64_t asked_ = 0;
};

Look look_of(const Scene& scene, const Shown& one, std::size_t lights, double shade) {
  const std::string face = fmt::format("face {}", scene.pieces()[one.piece].face);
  const double light = static_cast<double>(one.lights) / static_cast<double>(lights);
  const auto mixed = [&](int dark, int bright, double by_shade) {
    return static_cast<int>(std::clamp(dark + light * (bright - dark) + by_shade * shade, 0.0, 255.0));
  };
  const double less = one.turned ? 1 : 0.72;  // what is turned away is darkest
  const std::string fill =
      fmt::format("#{:02x}{:02x}{:02x}", static_cast<int>(less * mixed(98, 232, 26)),
                  static_cast<int>(less * mixed(104, 206, 26)), static_cast<int>(less * mixed(128, 140, 22)));
  if (!one.turned) return {fill, face + ", turned away"};
  if (one.by == Shadow_part::nothing) return {fill, face + ", lit"};
  return {fill, fmt::format("{}, {}in the shadow of face {}", face,
                            one.lights > 0 ? fmt::format("lit by {} of {}, ", one.lights, lights) : "",
                            scene.pieces()[one.by].face)};
}

/// A view that is asked for many points.
class Camera {
 public:
  Camera(const View& view, const Near_doubles& doubles)
      : view_(view), axes_(axes_of(view)), doubles_(doubles), from_(doubles.point(view.eye)) {}

  const View& view() const { return view_; }
  const Near_doubles& doubles() const { return doubles_; }
  std::vector<Flat_point> picture_of(const Corners& corners) const {
    std::vector<Flat_point> points;
    for (const Direction3& p : corners) points.push_back(projected(view_, axes_, minus(p, from_)));
    return points;
  }

 private:
  View view_;
  Axes axes_;
  Near_doubles doubles_;
  Direction3 from_;
};

/// The parts that an eye sees, with what is small in its picture.
std::vector<Shown> seen_parts(const Scene& scene, const Piece_boxes& boxes, const Exact_point& eye,
                              const Camera& camera, const Visible_options& options) {
  const Exact_view seen_from(scene, eye, field_of(corner_rays(camera.view())));
  const auto surface = visible_surface(seen_from, boxes, field_of_view(seen_from), options);
  std::vector<Shown> shown;
  for (const auto& part : surface.parts) {
    if (part.piece == surface.nothing) continue;
    Corners corners = rounded_corners(camera.doubles(), vertices(seen_from, surface, part));
    const auto [least, most] = box_of(camera.picture_of(corners));
    Shown& one = shown.emplace_back(Shown{part.piece, seen_from.eye_side(part.piece), false});
    one.is_small = most[0] - least[0] < 1 && most[1] - least[1] < 1;
    one.corners = std::move(corners);
  }
  return shown;
}

/// Says of what is shown that it is in a part that a light makes.
void put_into(Shown& one, const Shadow_part& part) {
  one.turned = true;
  one.lights += part.is_lit();
  if (!part.is_lit()) one.by = part.by;
}

/// The part that has most in common with a polygon; null where none has any.
const Shadow_part* largest_common(Parts_on_piece& parts, const Corners& polygon) {
  double most = -1;
  const Shadow_part* largest = nullptr;
  parts.cut(polygon, [&](const Shadow_part& part, const Corners& common) {
    if (const double size = size_of(common); size > most) {
      most = size;
      largest = &part;
    }
  });
  return largest;
}

/// What is shown, cut into the parts that one more light makes; what is small stays whole.
std::vector<Shown> cut_by_light(std::vector<Shown> shown, const Shadows& light, const Near_doubles& doubles,
                                const Visible_options& options) {
  std::map<std::pair<std::uint32_t, Sign>, Parts_on_piece> by_piece;  // the light is on that side
  for (const Shadow_part& part : light.parts)
    by_piece[{part.piece, part.side}].add(part, rounded_corners(doubles, part.vertices));
  for (auto& [piece, parts] : by_piece) parts.prepare();
  std::vector<Shown> finer;
  for (Shown& one : shown) {
    options.progress(0, shown.size());
    const auto parts = by_piece.find({one.piece, one.side});
    if (parts != by_piece.end() && !one.is_small) {
      parts->second.cut(one.corners, [&](const Shadow_part& part, Corners&& common) {
        put_into(
            finer.emplace_back(Shown{one.piece, one.side, false, one.lights, one.turned, one.by, std::move(common)}),
            part);
      });
      continue;
    }
    if (parts != by_piece.end())
      if (const Shadow_part* largest = largest_common(parts->second, one.corners)) put_into(one, *largest);
    finer.push_back(std::move(one));
  }
  return finer;
}

/// What looks alike, as one shape of the picture.
struct Shape {
  const Shown* first;
  std::vector<std::vector<Flat_point>> polygons;
};

/// In the order in which their first parts are shown.
std::vector<Shape> shapes_of(const std::vector<Shown>& shown, const Camera& camera) {
  std::map<decltype(shown[0].look()), std::size_t> places;
  std::vector<Shape> shapes;
  for (const Shown& one : shown) {
    const auto [place, is_new] = places.try_emplace(one.look(), shapes.size());
    if (is_new) shapes.push_back({&one, {}});
    shapes[place->second].polygons.push_back(camera.picture_of(one.corners));
  }
  return shapes;
}

/// The n-th shape of face 7 has the id face-7-n.
void draw_shapes(Svg& svg, const Scene& scene, const std::vector<Shape>& shapes, std::size_t lights, bool shaded) {
  std::map<Face_id, std::size_t> of_face;
  for (const auto& [first, polygons] : shapes) {
    const Piece& piece = scene.pieces()[first->piece];
    std::vector<Exact_point> corners = scene.corner_points(piece);
    if (first->side == CGAL::NEGATIVE) std::reverse(corners.begin(), corners.end());
    const Look look = look_of(scene, *first, lights, shaded ? shade_of(corners) : 0);
    svg.shape(polygons, look.fill, look.fill, 0.4, fmt::format("face-{}-{}", piece.face, ++of_face[piece.face]),
              look.title);
  }
}

}  // namespace

std::size_t draw(const Shadow_arguments& arguments, const Scene& scene, const Piece_boxes& boxes,
                 const std::vector<Shadows>& all, const Exact_point& eye) {
  const View view = arguments.view.view(eye, scene);
  Svg svg = empty_picture(view);
  std::size_t whole = 0;
  if (scene.counters().faces > 0) {
    const Camera camera(view, near_doubles(scene.box_of_faces()));
    Visible_options options;
    options.threads = arguments.common.threads;
    options.progress = arguments.common.within_budget();
    std::vector<Shown> shown = seen_parts(scene, boxes, eye, camera, options);
    whole = static_cast<std::size_t>(
        std::count_if(shown.begin(), shown.end(), [](const Shown& one) { return one.is_small; }));
    for (const Shadows& light : all) shown = cut_by_light(std::move(shown), light, camera.doubles(), options);
    draw_shapes(svg, scene, shapes_of(shown, camera), all.size(), view.lit);
  }
  write_file(arguments.svg, svg.text());
  return whole;
}

}  // namespace sightline::app
