#include "paths.h"

#include <sightline/harness/generate/shapes.h>
#include <sightline/io/number_lines.h>
#include <sightline/io/svg.h>
#include <sightline/io/decimal.h>

#include <map>
#include <set>

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
  for (const auto& [option, is_given] : {std::pair("--radius", arguments.radius != Path_arguments{}.radius),
                                         {"--height", arguments.height != Path_arguments{}.height}})
    if (arguments.orbit == 0 && is_given)
      throw Usage_error(fmt::format("{} is of an orbit: add --orbit FRAMES, or leave it out", option));
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

std::vector<Exact_ray> read_rays(const std::string& file) {
  std::vector<Exact_ray> rays;
  read_lines(file, "X,Y,Z,DX,DY,DZ, an origin and a direction that is not 0", [&](const std::vector<Rational>& n) {
    if (n.size() != 6 || (n[3] == 0 && n[4] == 0 && n[5] == 0)) return false;
    rays.push_back({{n[0], n[1], n[2]}, {n[3], n[4], n[5]}});
    return true;
  });
  return rays;
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

namespace {

/// Points on a picture, in units of their own, and how deep they are; and the part of the picture that shows them.
struct Projection {
  std::vector<Flat_point> flat;
  std::vector<double> depth;
  Flat_point least{-1, -1}, most{1, 1};

  double wide() const { return std::max(1e-9, most[0] - least[0]); }
  double high() const { return std::max(1e-9, most[1] - least[1]); }
  /// Moves all into a picture of a size.
  void fit(double width, double height) {
    const double scale = 0.94 * std::min(width / wide(), height / high());
    for (Flat_point& p : flat)
      p = {width / 2 + scale * (p[0] - (least[0] + most[0]) / 2),
           height / 2 + scale * (p[1] - (least[1] + most[1]) / 2)};
  }
};

/// The points as seen from a viewpoint; the part that shows them is all of them where they are in front of it. `points`
/// and `eye` are from the scene's centre, its longest side two long.
Projection projection_of(const std::vector<Direction3>& points, const Viewpoint& viewpoint, const Direction3& eye,
                         const Scene& scene) {
  const bool parallel = viewpoint.at_infinity;
  View view;
  view.eye = viewpoint.at;
  if (parallel) {
    const Exact_point towards = scaled_to_one(viewpoint.at);
    for (std::size_t k = 0; k < 3; ++k) view.look[k] = -nearest_double(towards[k]);
  }
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
  if (parallel || std::sqrt(dot(eye, eye)) > 1.01 * reach) {
    to.least = {1e300, 1e300};
    to.most = {-1e300, -1e300};
    for (const Flat_point& p : to.flat)
      for (std::size_t k = 0; k < 2; ++k) {
        to.least[k] = std::min(to.least[k], p[k]);
        to.most[k] = std::max(to.most[k], p[k]);
      }
  }
  return to;
}

/// The faces of nodes that are on-view in one frame and not in another.
std::set<Face_id> faces_of(const Face_graph& graph, const std::vector<bool>& on, const std::vector<bool>& off) {
  std::set<Face_id> faces;
  const std::vector<Piece>& pieces = graph.scene().pieces();
  for (std::uint32_t i = 0; i < pieces.size(); ++i)
    if (on[graph.node(i)] && !off[graph.node(i)]) faces.insert(pieces[i].face);
  return faces;
}

/// A colour as it is in the light, or darker, by a shade from -1 to 1.
std::string shaded(const std::array<int, 3>& colour, double shade) {
  const auto part = [&](int x) { return static_cast<int>(std::lround(x * (0.85 + 0.15 * shade))); };
  return fmt::format("#{:02x}{:02x}{:02x}", part(colour[0]), part(colour[1]), part(colour[2]));
}

/// All points of a scene as each of some frames sees them: none where the scene has no faces.
std::vector<Projection> projections_of(const Scene& scene, const std::vector<Outline>& outlines) {
  if (scene.counters().faces == 0) return {};
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
  std::vector<Projection> frames;
  for (const Outline& outline : outlines)
    frames.push_back(
        projection_of(points, outline.view, outline.view.at_infinity ? Direction3{} : place(outline.view.at), scene));
  return frames;
}

/// Frames beside each other: up to four in a row.
struct Strip {
  static constexpr double title = 38, legend = 28;  // above each frame, and beneath all
  std::size_t columns, rows;

  explicit Strip(std::size_t frames)
      : columns(std::min<std::size_t>(4, std::max<std::size_t>(1, frames))),
        rows(std::max<std::size_t>(1, (frames + columns - 1) / columns)) {}
  /// The picture's size, of frames so wide, each as high as the highest needs.
  std::array<int, 2> size(const std::vector<Projection>& frames, double wide) const {
    double steepest = 0.3;
    for (const Projection& frame : frames) steepest = std::max(steepest, frame.high() / frame.wide());
    return {static_cast<int>(static_cast<double>(columns) * wide),
            static_cast<int>(static_cast<double>(rows) * (std::min(1.2, steepest) * wide + title) + legend)};
  }
};

/// A frame in its place in the picture.
struct Placed_frame {
  Projection projection;
  double left, top, wide, high;

  Placed_frame(Projection fitted, const std::array<double, 2>& size, std::size_t column, std::size_t row)
      : projection(std::move(fitted)),
        left(static_cast<double>(column) * size[0]),
        top(static_cast<double>(row) * (size[1] + Strip::title) + Strip::title),
        wide(size[0]),
        high(size[1]) {
    projection.fit(wide, high);
  }
  Flat_point at(std::uint32_t p) const { return {left + projection.flat[p][0], top + projection.flat[p][1]}; }
  bool shows(std::uint32_t p) const {
    const Flat_point& flat = projection.flat[p];
    return projection.depth[p] > 1e-3 && flat[0] >= 0 && flat[0] <= wide && flat[1] >= 0 && flat[1] <= high;
  }
};

/// The pieces that are on-view and shown wholly, the far ones first.
std::vector<std::uint32_t> painters_order(const Face_graph& graph, const std::vector<bool>& on_view,
                                          const Placed_frame& frame) {
  const Scene& scene = graph.scene();
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) {
    const auto corners = scene.corners(scene.pieces()[i]);
    if (!on_view[graph.node(i)] ||
        !std::all_of(corners.begin(), corners.end(), [&](const Piece_corner& c) { return frame.shows(c.point); }))
      continue;
    double sum = 0;
    for (const Piece_corner& corner : corners) sum += frame.projection.depth[corner.point];
    order.emplace_back(-sum / static_cast<double>(corners.size()), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> pieces;
  for (const auto& [far, i] : order) pieces.push_back(i);
  return pieces;
}

/// On-view faces, those green that `before` has off-view.
void draw_faces(Svg& svg, const Face_graph& graph, const Outline& outline, const std::vector<bool>& before,
                const Placed_frame& frame, bool lit) {
  const Scene& scene = graph.scene();
  std::map<Face_id, std::size_t> polygons;  // of each face, so far
  for (const std::uint32_t i : painters_order(graph, outline.on_view, frame)) {
    const Face_id face = scene.pieces()[i].face;
    const bool is_born = !before[graph.node(i)];
    std::vector<Flat_point> polygon;
    std::vector<Exact_point> corners;
    for (const Piece_corner& corner : scene.corners(scene.pieces()[i])) {
      polygon.push_back(frame.at(corner.point));
      if (lit) corners.push_back(scene.position(corner.point));
    }
    const std::array<int, 3> colour = is_born ? std::array{0xa9, 0xd6, 0xa0} : std::array{0xe3, 0xe8, 0xee};
    svg.polygon(std::move(polygon), shaded(colour, lit ? shade_of(corners) : 1), is_born ? "#5b9e6f" : "#9aa7b5",
                scene.pieces().size() > 3000 ? 0.15 : 0.4,
                fmt::format("frame-{}-face-{}-{}", outline.number, face, ++polygons[face]),
                fmt::format("face {}{}", face, is_born ? ", became on-view" : ""));
  }
}

void draw_cut_set(Svg& svg, const Face_graph& graph, const std::vector<bool>& on_view, const Placed_frame& frame) {
  for (const Face_graph::Edge& edge : graph.edges())
    if (on_view[edge.first] != on_view[edge.second] && frame.shows(edge.from) && frame.shows(edge.to))
      svg.line(frame.at(edge.from), frame.at(edge.to), "#c0392b", 1.2);
}

/// What changed since the frame before, in words; null: it is the first.
std::string change_words(const Face_graph& graph, const Outline& outline, const Outline* before) {
  if (before == nullptr) return "the first frame";
  return fmt::format("since {}: {} became on-view, {} off-view", before->number,
                     faces_of(graph, outline.on_view, before->on_view).size(),
                     faces_of(graph, before->on_view, outline.on_view).size());
}

}  // namespace

std::string painted(const Face_graph& graph, const std::vector<Outline>& outlines, const Canvas_arguments& canvas,
                    bool lit) {
  // 1. The frames, each as high as the highest needs.
  std::vector<Projection> frames = projections_of(graph.scene(), outlines);
  const Strip strip(outlines.size());
  const std::array<int, 2> size = canvas.size_or(strip.size(frames, 300));
  const std::array<double, 2> of_frame{
      size[0] / static_cast<double>(strip.columns),
      std::max(1.0, (size[1] - Strip::legend) / static_cast<double>(strip.rows) - Strip::title)};
  const std::string background = canvas.background_or("#ffffff"), ink = ink_on(background);
  Svg svg(size[0], size[1], background);
  if (graph.scene().counters().faces == 0) return svg.text();

  // 2. In each its on-view faces, the cut-set over them, and what changed.
  for (std::size_t number = 0; number < outlines.size(); ++number) {
    const Outline& outline = outlines[number];
    const Outline* const before = number == 0 ? nullptr : &outlines[number - 1];
    const Placed_frame frame(std::move(frames[number]), of_frame, number % strip.columns, number / strip.columns);
    draw_faces(svg, graph, outline, before == nullptr ? outline.on_view : before->on_view, frame, lit);
    draw_cut_set(svg, graph, outline.on_view, frame);
    svg.label(frame.left + 6, frame.top - 22, 12, outline.title, "start", ink);
    svg.label(frame.left + 6, frame.top - 7, 12, change_words(graph, outline, before), "start", ink);
  }
  svg.label(6, size[1] - 10, 12,
            "grey: on-view faces; green: those that became on-view since the frame drawn before; red: edges of the "
            "cut-set, between on-view and off-view",
            "start", ink);
  return svg.text();
}

}  // namespace sightline::app
