#include "paths.h"

#include <sightline/harness/generate/shapes.h>
#include <sightline/io/number_lines.h>
#include <sightline/io/svg.h>
#include <sightline/io/decimal.h>

namespace sightline::app {

void add_to(Command command, Path_arguments& arguments) {
  command
      .add_option("--path", arguments.path,
                  "viewpoints: a file with X,Y,Z a line; X,Y,Z,0 is the direction of a viewpoint at infinity")
      .reads_file();
  command.add_option("--orbit", arguments.orbit, "this many viewpoints on a level circle round the scene")
      .check(whole_number() & range(1, 100'000'000));
  command.add_option("--radius", arguments.radius, "of the orbit, in half lengths of the scene's longest side")
      .check(range(0.0, 1e9) & finite_number())
      .show_default();
  command.add_option("--height", arguments.height, "of the orbit above the scene's centre, in the same unit")
      .check(range(-1e9, 1e9) & finite_number())
      .show_default();
  command
      .add_option("--motion", arguments.motion,
                  "the object moves instead: a file with W,X,Y,Z,TX,TY,TZ a line, a quaternion of any length and a "
                  "translation, seen from --eye")
      .reads_file();
  command.add_option("--eye", arguments.eye, "with --motion: the eye X,Y,Z; by default a place outside the scene")
      .check(not_empty());
}

void check_usage(const Path_arguments& arguments) {
  if ((arguments.path.empty() ? 0 : 1) + (arguments.motion.empty() ? 0 : 1) + (arguments.orbit > 0 ? 1 : 0) > 1)
    throw Usage_error("give one of --path FILE, --orbit FRAMES and --motion FILE");
  if (!arguments.eye.empty()) {
    if (arguments.motion.empty())
      throw Usage_error("--eye goes with --motion; a single viewpoint is a --path of one line");
    parse_point(arguments.eye, "--eye");
  }
}

void read_lines(const std::string& file, const std::string& wanted,
                const std::function<bool(const std::vector<Rational>&)>& take) {
  const std::string bytes = read_input(file);
  read_number_lines({file, bytes}, wanted, take);
}

static Path round_scene(const Path_arguments& arguments, const Scene& scene) {
  Exact_point centre{0, 0, 0};
  Rational half = 1;
  if (scene.points().size() > 0) {
    const auto box = scene.box();
    half = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      centre[k] = (box[0][k] + box[1][k]) / 2;
      half = std::max(half, Rational((box[1][k] - box[0][k]) / 2));
    }
  }
  constexpr std::int64_t grid = std::int64_t{1} << 30;
  const Rational radius = half * exact(arguments.radius) / Rational(static_cast<long>(grid)),
                 height = half * exact(arguments.height);
  return {arguments.orbit, [centre, radius, height, orbit = arguments.orbit](std::size_t k) {
            const auto [x, y] = generate::circle_point(k, orbit, grid);
            return Viewpoint{{Rational(centre[0] + radius * static_cast<long>(x)),
                              Rational(centre[1] + radius * static_cast<long>(y)), Rational(centre[2] + height)},
                             false};
          }};
}

static Path path_through(std::vector<Viewpoint> viewpoints) {
  const std::size_t size = viewpoints.size();
  return {size, [viewpoints = std::move(viewpoints)](std::size_t k) { return viewpoints[k]; }};
}

Path path_of(const Path_arguments& arguments, const Scene& scene) {
  if (arguments.orbit > 0) return round_scene(arguments, scene);
  std::vector<Viewpoint> path;
  if (!arguments.path.empty()) {
    read_lines(arguments.path, "a viewpoint X,Y,Z, or X,Y,Z,0 with a direction that is not zero",
               [&](const std::vector<Rational>& n) {
                 const bool direction = n.size() == 4 && n[3] == 0 && (n[0] != 0 || n[1] != 0 || n[2] != 0);
                 if (!direction && n.size() != 3) return false;
                 path.push_back({{n[0], n[1], n[2]}, direction});
                 return true;
               });
    return path_through(std::move(path));
  }
  const Viewpoint eye{eye_of(arguments.eye, scene), false};
  read_lines(arguments.motion, "a motion W,X,Y,Z,TX,TY,TZ with a quaternion that is not zero",
             [&](const std::vector<Rational>& n) {
               if (n.size() != 7 || (n[0] == 0 && n[1] == 0 && n[2] == 0 && n[3] == 0)) return false;
               path.push_back(Rigid_motion{{n[0], n[1], n[2], n[3]}, {n[4], n[5], n[6]}}.seen_from(eye));
               return true;
             });
  return path_through(std::move(path));
}

// ---- Pictures

/// Points on a picture of a size, and how deep they are.
struct Projection {
  std::vector<Flat_point> flat;
  std::vector<double> depth;
};

/// The points as seen from a viewpoint; all of them fill the picture where all are in front of it. `points` and `eye`
/// are from the scene's centre, its longest side two long.
static Projection projected(const std::vector<Direction3>& points, const Viewpoint& viewpoint, const Direction3& eye,
                            const Scene& scene, double wide, double high) {
  const bool parallel = viewpoint.at_infinity;
  View view;
  view.eye = viewpoint.at;
  if (parallel)
    for (std::size_t k = 0; k < 3; ++k) view.look[k] = -nearest_double(viewpoint.at[k]);
  view = aimed(view, scene);
  const Axes axes = axes_of(view);
  Projection to;
  double reach = 1;
  for (const Direction3& p : points) {
    const Direction3 v{p[0] - eye[0], p[1] - eye[1], p[2] - eye[2]};
    to.depth.push_back(parallel ? dot(v, view.look) + 10 : dot(v, view.look));
    const double over = parallel ? 1 : to.depth.back();
    to.flat.push_back({dot(v, axes.right) / over, -dot(v, axes.up) / over});
    reach = std::max(reach, std::sqrt(dot(p, p)));
  }
  std::array<double, 2> least{-1, -1}, most{1, 1};
  if (parallel || std::sqrt(dot(eye, eye)) > 1.01 * reach) {
    least = {1e300, 1e300};
    most = {-1e300, -1e300};
    for (const Flat_point& p : to.flat)
      for (std::size_t k = 0; k < 2; ++k) {
        least[k] = std::min(least[k], p[k]);
        most[k] = std::max(most[k], p[k]);
      }
  }
  const double scale =
      0.94 * std::min(wide / std::max(1e-9, most[0] - least[0]), high / std::max(1e-9, most[1] - least[1]));
  for (Flat_point& p : to.flat)
    p = {wide / 2 + scale * (p[0] - (least[0] + most[0]) / 2), high / 2 + scale * (p[1] - (least[1] + most[1]) / 2)};
  return to;
}

std::string painted(const Face_graph& graph, const std::vector<Outline>& outlines) {
  const Scene& scene = graph.scene();
  constexpr int wide = 300, high = 240, title = 20;
  const int columns = static_cast<int>(std::min<std::size_t>(4, std::max<std::size_t>(1, outlines.size()))),
            rows = (static_cast<int>(outlines.size()) + columns - 1) / columns;
  Svg svg(columns * wide, std::max(1, rows) * (high + title), "#ffffff");
  if (scene.counters().faces == 0) return svg.text();
  const auto box = scene.box();
  Exact_point centre;
  Rational half = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    centre[k] = (box[0][k] + box[1][k]) / 2;
    half = std::max(half, Rational((box[1][k] - box[0][k]) / 2));
  }
  const auto place = [&](const Exact_point& p) {
    return Direction3{nearest_double(Rational((p[0] - centre[0]) / half)),
                      nearest_double(Rational((p[1] - centre[1]) / half)),
                      nearest_double(Rational((p[2] - centre[2]) / half))};
  };
  std::vector<Direction3> points;
  for (std::uint32_t p = 0; p < scene.points().size(); ++p) points.push_back(place(scene.position(p)));

  for (std::size_t number = 0; number < outlines.size(); ++number) {
    const Outline& outline = outlines[number];
    const Projection to = projected(
        points, outline.view, outline.view.at_infinity ? Direction3{} : place(outline.view.at), scene, wide, high);
    const double left = static_cast<double>(static_cast<int>(number) % columns * wide),
                 top = static_cast<double>(static_cast<int>(number) / columns * (high + title) + title);
    const auto at = [&](std::uint32_t p) { return Flat_point{left + to.flat[p][0], top + to.flat[p][1]}; };
    const auto shown = [&](std::uint32_t p) {
      return to.depth[p] > 1e-3 && to.flat[p][0] >= 0 && to.flat[p][0] <= wide && to.flat[p][1] >= 0 &&
             to.flat[p][1] <= high;
    };
    // On-view faces, the far ones first; then the cut-set.
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) {
      const auto corners = scene.corners(scene.pieces()[i]);
      if (!outline.on_view[graph.node(i)] ||
          !std::all_of(corners.begin(), corners.end(), [&](const Piece_corner& c) { return shown(c.point); }))
        continue;
      double sum = 0;
      for (const Piece_corner& corner : corners) sum += to.depth[corner.point];
      order.emplace_back(-sum / static_cast<double>(corners.size()), i);
    }
    std::sort(order.begin(), order.end());
    for (const auto& [far, i] : order) {
      std::vector<Flat_point> polygon;
      for (const Piece_corner& corner : scene.corners(scene.pieces()[i])) polygon.push_back(at(corner.point));
      svg.polygon(std::move(polygon), "#e3e8ee", "#9aa7b5", scene.pieces().size() > 3000 ? 0.15 : 0.4);
    }
    for (const Face_graph::Edge& edge : graph.edges())
      if (outline.on_view[edge.first] != outline.on_view[edge.second] && shown(edge.from) && shown(edge.to))
        svg.line(at(edge.from), at(edge.to), "#c0392b", 1.2);
    svg.label(left + 6, top - 6, 12, outline.title);
  }
  return svg.text();
}

}  // namespace sightline::app
