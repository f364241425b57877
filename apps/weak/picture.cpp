#include "picture.h"

#include "../methods/methods.h"
#include "../support/drawing.h"

#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <optional>

namespace sightline::app {

std::vector<std::string> names_of(const Scene& scene, const Weak_faces& found, std::size_t sources) {
  std::vector<std::string> names(scene.counters().faces_read + sources, "source");
  const auto set = [&](const std::vector<Face_id>& faces, const char* name) {
    for (const Face_id face : faces) names[face] = name;
  };
  set(found.visible, "visible");
  set(found.hidden, "hidden");
  set(found.undecided, "undecided");
  return names;
}

namespace {

/// What pictures show of where they look from.
struct Picture_eye {
  Exact_point at;
  std::optional<std::array<Rational, 4>> cut;  ///< only what is in front of this plane, which the sources lie in
  std::string up;                              ///< as --up, where that is not given
};

Rational value(const std::array<Rational, 4>& h, const Exact_point& p) {
  return h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3];
}

/// Whether at least three of four rays from the middle of a source hit something. In doubles: a sample.
bool is_enclosed(const Occluders& occluders, const Weak_source& source) {
  constexpr int rays = 64;
  Triple p{}, n{source.plane.near[0], source.plane.near[1], source.plane.near[2]};
  for (const Near_point& corner : source.polygon)
    for (std::size_t k = 0; k < 3; ++k) p[k] += corner.near[k] / static_cast<double>(source.polygon.size());
  const double length = std::sqrt(dot(n, n));
  int hits = 0;
  for (int ray = 0; ray < rays; ++ray) {  // even steps up and around a half sphere
    const double up = (ray + 0.5) / rays, flat = std::sqrt(1 - up * up), angle = 2.399963 * ray;
    const Triple around{flat * std::cos(angle), flat * std::sin(angle), up};
    // The half sphere about z, turned so that its top is the normal.
    Triple axis = std::fabs(n[0]) < 0.6 * length ? Triple{1, 0, 0} : Triple{0, 1, 0}, u = cross(n, axis), v, direction;
    const double size = std::sqrt(dot(u, u));
    for (std::size_t k = 0; k < 3; ++k) u[k] /= size;
    v = cross(n, u);
    for (std::size_t k = 0; k < 3; ++k)
      direction[k] = around[0] * u[k] + around[1] * v[k] / length + around[2] * n[k] / length;
    hits += occluders.first_hit(p, direction).has_value();
  }
  return 4 * hits >= 3 * rays;
}

/// The sources' plane, if they lie in one and look to one side of it.
std::optional<std::array<Rational, 4>> plane_of(const Sources& sources) {
  std::optional<std::array<Rational, 4>> plane;
  for (const std::vector<Exact_point>& polygon : sources.points) {
    Exact_point n{};  // Newell's sum, which is right for any start
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      const Exact_point part = cross(minus(polygon[i], polygon[0]), minus(polygon[i + 1], polygon[0]));
      for (std::size_t k = 0; k < 3; ++k) n[k] += part[k];
    }
    if (!plane) plane = {n[0], n[1], n[2], Rational(-dot(n, polygon[0]))};
    const Exact_point first{(*plane)[0], (*plane)[1], (*plane)[2]};
    if (!(dot(n, first) > 0) ||
        std::any_of(polygon.begin(), polygon.end(), [&](const Exact_point& p) { return value(*plane, p) != 0; }))
      return std::nullopt;
  }
  return plane;
}

/// The eye that is asked for. By default behind sources that look into a room, a little to the side, far enough to see
/// all visible faces within 70 degrees, what is behind the sources cut away; outside the scene for other sources.
Picture_eye picture_eye(const Weak_arguments& arguments, const Occluders& occluders, const Sources& sources,
                        const std::vector<Exact_point>& visible) {
  const Scene& scene = occluders.scene();
  const std::optional<std::array<Rational, 4>> plane = arguments.eye.empty() ? plane_of(sources) : std::nullopt;
  if (!plane || visible.empty() ||
      std::none_of(sources.polygons.begin(), sources.polygons.end(),
                   [&](const Weak_source& source) { return is_enclosed(occluders, source); }))
    return {eye_of(arguments.eye, scene), std::nullopt, ""};

  // 1. A frame on the source: its middle, its normal, and upwards or, where that is the normal, to the south.
  const std::vector<Exact_point>& polygon = sources.points[0];
  Exact_point middle{};
  for (const Exact_point& p : polygon)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += p[k] / Rational(static_cast<long>(polygon.size()));
  const auto unit = [](Direction3 a) {
    const double size = std::max({std::fabs(a[0]), std::fabs(a[1]), std::fabs(a[2])});
    for (double& x : a) x /= size;
    const double length = std::sqrt(dot(a, a));
    for (double& x : a) x /= length;
    return a;
  };
  const auto rounded = [](const Exact_point& p) {
    return Direction3{nearest_double(p[0]), nearest_double(p[1]), nearest_double(p[2])};
  };
  const auto& h = *plane;
  const Rational largest = std::max({Rational(abs(h[0])), Rational(abs(h[1])), Rational(abs(h[2]))});
  const Direction3 n = unit(rounded({Rational(h[0] / largest), Rational(h[1] / largest), Rational(h[2] / largest)}));
  const bool upright = std::fabs(n[2]) < 0.9;
  Direction3 aside = upright ? Direction3{0, 0, 1} : Direction3{0, -1, 0};
  const double along = dot(aside, n);
  for (std::size_t k = 0; k < 3; ++k) aside[k] -= along * n[k];
  aside = unit(aside);

  // 2. How far behind: as far as the visible point that needs most.
  constexpr double widest = 0.7, lean = 0.3;  // the tangent of half of 70 degrees; aside for each unit behind
  std::vector<Exact_point> ways;
  Rational unit_of_way = 0;  // so that no square is beyond doubles
  for (const Exact_point& p : visible)
    for (const Rational& x : ways.emplace_back(minus(p, middle))) unit_of_way = std::max(unit_of_way, Rational(abs(x)));
  if (unit_of_way == 0) unit_of_way = 1;
  double behind = 0;
  for (Exact_point& way : ways) {
    for (Rational& x : way) x /= unit_of_way;
    const Direction3 v = rounded(way);
    const double depth = std::max(0.0, dot(v, n)), far = std::sqrt(std::max(0.0, dot(v, v) - dot(v, n) * dot(v, n)));
    behind = std::max(behind, far / widest - depth);
  }
  const double size = nearest_double(Rational((scene.box()[1][0] - scene.box()[0][0]) / unit_of_way));
  behind = std::max(behind, 0.01 * size);
  Picture_eye eye{middle, plane, upright ? "" : "0,1,0"};
  for (std::size_t k = 0; k < 3; ++k) eye.at[k] += unit_of_way * exact(behind * (lean * aside[k] - n[k]));
  return eye;
}

/// Corners of the faces of which `wanted` holds, as far as they are in front of a plane, if there is one.
std::vector<Exact_point> corners_of(const Scene& scene, const std::optional<std::array<Rational, 4>>& cut,
                                    const std::function<bool(const Piece&)>& wanted) {
  std::vector<Exact_point> points;
  for (const Piece& piece : scene.pieces()) {
    if (!wanted(piece)) continue;
    const auto corners = scene.corners(piece);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Exact_point p = scene.position(corners[i].point),
                        q = scene.position(corners[(i + 1) % corners.size()].point);
      if (!cut) {
        points.push_back(p);
        continue;
      }
      const Rational a = value(*cut, p), b = value(*cut, q);
      if (a >= 0) points.push_back(p);
      if ((a < 0 && b > 0) || (a > 0 && b < 0)) {
        Exact_point& between = points.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) between[k] = p[k] + (q[k] - p[k]) * (a / (a - b));
      }
    }
  }
  return points;
}

/// A plane in grid coordinates, on the same side of which are the same points.
std::array<Integer, 4> on_grid(const std::array<Rational, 4>& h, const Scene& scene) {
  // A point of the grid is at origin + step times its coordinates.
  const Exact_point origin = scene.position({0, 0, 0, 1});
  const Rational step = scene.position({1, 0, 0, 1})[0] - origin[0];
  const std::array<Rational, 4> there{h[0] * step, h[1] * step, h[2] * step, value(h, origin)};
  Integer denominators = 1;
  for (const Rational& x : there) denominators = lcm(denominators, x.get_den());
  std::array<Integer, 4> grid;
  for (std::size_t k = 0; k < 4; ++k) grid[k] = Rational(there[k] * denominators).get_num();
  return grid;
}

}  // namespace

void draw(const Weak_arguments& arguments, Polygon_soup soup, const Occluders& occluders, const Sources& sources,
          const std::vector<std::string>& names) {
  // 1. The camera.
  const auto is_visible = [&](const Piece& piece) { return names[piece.face] == "visible"; };
  const std::optional<std::array<Rational, 4>> plane = plane_of(sources);
  const Picture_eye eye = picture_eye(arguments, occluders, sources, corners_of(occluders.scene(), plane, is_visible));
  const auto is_shown = [&](const Piece& piece) {
    return value(occluders.scene().file_coefficients(piece.support), eye.at) > 0;
  };
  std::vector<Exact_point> shown = corners_of(occluders.scene(), eye.cut, is_shown),
                           lit = corners_of(occluders.scene(), eye.cut, is_visible);
  for (const std::vector<Exact_point>& polygon : sources.points) {
    std::vector<Point_id> loop;
    for (const Exact_point& p : polygon) {
      loop.push_back(soup.add_point(p[0], p[1], p[2]));
      shown.push_back(p);
      lit.push_back(p);
    }
    soup.add_face(loop);
  }
  Scene scene(soup);
  constexpr double room_for_the_legend = 36;
  View_arguments camera = arguments.view;
  if (camera.up.empty()) camera.up = eye.up;
  View view = camera.view(eye.at, scene, shown, room_for_the_legend);
  if (eye.cut) {  // a large building is shown as far as it takes to show what is visible
    const View of_lit = camera.view(eye.at, scene, lit, room_for_the_legend);
    if (view.field > 1.4 * of_lit.field) view = of_lit;
  }

  // 2. What is in front of the cut, or of the near plane, farthest first.
  Task task;
  task.eye = eye.at;
  task.bsp.threads = arguments.common.threads;
  task.near = eye.cut ? on_grid(*eye.cut, scene) : near_plane(view, scene);
  std::vector<Drawn> drawn = run_method("exact", scene, task).drawn;

  // 3. Sources are drawn last where one looks through them, and else where they are.
  for (const std::vector<Face_id>* list :
       {&arguments.sources.faces,
        &arguments.sources.solid})  // faces of the scene that are sources: themselves, not their doubles
    for (const Face_id face : *list)
      for (Drawn& item : drawn)
        if (item.fragment.face == face) item.fragment.face = static_cast<Face_id>(names.size() - 1);
  const auto is_source = [&](const Drawn& item) { return names[item.fragment.face] == "source"; };
  std::erase_if(drawn, [&](const Drawn& item) {
    if (!eye.cut) return item.side != CGAL::POSITIVE && !is_source(item);
    const auto in_cut = [&](const Exact_point& p) { return value(*eye.cut, p) == 0; };
    return item.side != CGAL::POSITIVE || is_source(item) ||
           std::all_of(item.fragment.vertices.begin(), item.fragment.vertices.end(), in_cut);
  });
  Svg svg = empty_picture(view);
  paint(svg, view, drawn, true, [&](const Drawn& item, double shade) {
    const std::string& name = names[item.fragment.face];
    const auto [hue, strength, light] = name == "visible"  ? std::tuple(38, 85, 62)
                                        : name == "hidden" ? std::tuple(215, 12, 60)
                                        : name == "source" ? std::tuple(350, 75, 50)
                                                           : std::tuple(290, 60, 55);
    return Look{fmt::format("hsl({},{}%,{:.0f}%)", hue, strength, light + 14 * shade),
                name == "source" ? name : fmt::format("face {}: {}", item.fragment.face, name)};
  });
  if (eye.cut)
    for (std::size_t i = 0; i < sources.points.size(); ++i) {
      std::vector<Flat_point> outline;
      for (const Exact_point& p : sources.points[i]) outline.push_back(projected(view, p));
      svg.polygon(std::move(outline), "#d0204030", "#d02040", 1.6, fmt::format("source-{}", i + 1), "source");
    }
  svg.label(12, 22, 14, "orange: visible, grey: hidden, violet: undecided, red: the source", "start",
            ink_on(view.background));
  write_file(arguments.svg, svg.text());
}

Grouped_polygons drawing_of(const Scene& scene, const Sources& sources, const std::vector<std::string>& names) {
  Grouped_polygons polygons;
  const std::uint32_t visible = polygons.add_group("visible", drawing_colours::seen),
                      hidden = polygons.add_group("hidden", drawing_colours::hidden),
                      undecided = polygons.add_group("undecided", drawing_colours::open),
                      source = polygons.add_group("source", drawing_colours::source);
  add_pieces(polygons, scene, [&](std::uint32_t piece) {
    const std::string& name = names[scene.pieces()[piece].face];
    return name == "visible" ? visible : name == "hidden" ? hidden : undecided;
  });
  for (const std::vector<Exact_point>& polygon : sources.points)
    polygons.add_polygon(source, Grouped_polygons::no_face, polygon);
  return polygons;
}

}  // namespace sightline::app
