#include "images.h"

#include "../support/tints.h"
#include "rays.h"

#include <sightline/algorithms/baseline/blended_depth.h>
#include <sightline/algorithms/image/bsp2d.h>
#include <sightline/algorithms/image/newell.h>
#include <sightline/algorithms/image/number_painter.h>
#include <sightline/algorithms/image/painter.h>
#include <sightline/algorithms/image/scan_line.h>
#include <sightline/algorithms/image/warnock.h>
#include <sightline/algorithms/image/weiler_atherton.h>
#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/point_visibility/number_view.h>
#include <sightline/algorithms/priority/kernels.h>

#include <map>
#include <set>
#include <utility>

namespace sightline::app {

bool has_image_kernels(const std::string& method) {
  return method.starts_with("painter") || method == "newell" || method == "scan-line" || method == "warnock" ||
         method == "weiler-atherton" || method == "bsp" || method == "graph";
}
bool is_built(const std::string& method) { return method != "rays" || has_rays(); }
bool is_true_method(const std::string& method) {
  return !method.starts_with("painter") && method != "depth" && method != "rays" && method != "weighted";
}
bool shows_through(const std::string& method) {
  static const std::set<std::string> solid{"rays", "warnock", "weiler-atherton", "bsp2d"};
  return solid.count(method) == 0;
}

static Image_kernel kernel_of(const std::string& name) {
  if (name == "float") return Image_kernel::float_numbers;
  return name == "double" ? Image_kernel::double_numbers : Image_kernel::exact;
}

/// Fragments farthest first, by the tree in a kernel's numbers.
static std::vector<Painted_polygon> by_tree(Scene& scene, const Exact_point& eye, const std::string& kernel,
                                            const Image_options& options, std::uint64_t seed) {
  Task task;
  task.eye = eye;
  task.bsp.seed = seed;
  task.bsp.threads = options.threads;
  task.bsp.progress = options.progress;
  std::vector<std::uint32_t> first(scene.counters().faces_read);  // piece of each face
  for (std::uint32_t i = static_cast<std::uint32_t>(scene.pieces().size()); i-- > 0;) first[scene.pieces()[i].face] = i;
  std::vector<Painted_polygon> polygons;
  for (Drawn& drawn : run_method(kernel, scene, task).drawn)
    polygons.push_back({first[drawn.fragment.face] + drawn.fragment.piece, std::move(drawn.fragment.vertices)});
  return polygons;
}

/// The same by the priority graph.
template <class Traits>
std::vector<Painted_polygon> by_graph_in(const Traits& traits, const Exact_point& eye, const Image_options& options) {
  const Priority_tree<Traits> tree = build_priority_tree(traits, {true, false, options.progress});
  std::vector<Painted_polygon> polygons;
  for (const Convex_polygon<Traits>& polygon : back_to_front(traits, tree, eye, options.progress).polygons) {
    Painted_polygon& painted = polygons.emplace_back(Painted_polygon{polygon.piece, {}});
    for (const Corner<Traits>& corner : polygon) painted.corners.push_back(traits.position(*corner.vertex));
  }
  return polygons;
}
static std::vector<Painted_polygon> by_graph(const Scene& scene, const Exact_point& eye, const std::string& kernel,
                                             const Image_options& options) {
  if (kernel == "exact") return by_graph_in(Exact_traits(scene), eye, options);
  try {
    return kernel == "float" ? by_graph_in(Float_traits(scene), eye, options)
                             : by_graph_in(Double_traits(scene), eye, options);
  } catch (const std::domain_error&) {
    throw Usage_error("coordinates are beyond the range of --kernel " + kernel + ": take exact");
  }
}

template <class V>
Piece_image by_windows(const V& view, const Pixel_view& pixels, const Image_options& options) {
  const Visible_options visible{options.threads, options.progress};
  return paint(view, weiler_atherton(view, field_of_view(view), visible), pixels, options);
}

/// What a method shows that gives a visible surface.
static Piece_image by_surface(const Scene& scene, const Pixel_view& pixels, const Image_task& task,
                              const Image_options& options) {
  const auto field = field_of(pixels);
  if (task.method == "weiler-atherton") {
    if (task.kernel == "float") return by_windows(Number_view<float>(scene, pixels.eye, field), pixels, options);
    if (task.kernel == "double") return by_windows(Number_view<double>(scene, pixels.eye, field), pixels, options);
    return by_windows(Exact_view(scene, pixels.eye, field), pixels, options);
  }
  const Exact_view view(scene, pixels.eye, field);
  Bsp2d_options trees;
  trees.threads = options.threads;
  trees.seed = task.seed;
  trees.progress = options.progress;
  return paint(view, bsp2d(view, field_of_view(view), trees).surface, pixels, options);
}

/// Polygons farthest first, by the methods that paint.
static std::vector<Painted_polygon> painting(Scene& scene, const Pixel_view& pixels, const Image_task& task,
                                             const Image_options& options) {
  static const std::map<std::string, Painter_key> keys{{"painter-min", Painter_key::nearest},
                                                       {"painter-max", Painter_key::farthest},
                                                       {"painter-mean", Painter_key::mean}};
  if (task.method == "bsp") return by_tree(scene, pixels.eye, task.kernel, options, task.seed);
  if (task.method == "graph") return by_graph(scene, pixels.eye, task.kernel, options);
  if (task.method == "newell") return newell_order(scene, pixels, kernel_of(task.kernel), options).polygons;
  return heedless_order(scene, pixels, keys.at(task.method), kernel_of(task.kernel));
}

static Blended_image blended(Blended_depth&& depth, const Pixel_view& pixels) {
  Blended_image image{pixels.width, pixels.height, std::move(depth.layers), {}, {}};
  image.counters.drawn = depth.triangles;
  image.counters.edge_on = depth.not_finite;
  return image;
}

static Blended_image run_blended(Scene& scene, const Pixel_view& pixels, const Image_task& task,
                                 const Image_options& options) {
  const Image_kernel kernel = kernel_of(task.kernel);
  Depth_buffer_options depth;
  depth.bits = task.bits;
  if (task.method == "centres") return blended_centres(Exact_view(scene, pixels.eye), pixels, *task.tints, options);
  if (task.method == "scan-line") return blended_scan_line(scene, pixels, kernel, *task.tints, options);
  if (task.method == "depth") return blended(depth_blended(scene, pixels, *task.tints, depth), pixels);
  if (task.method == "weighted") return blended(weighted_blended(scene, pixels, *task.tints, depth), pixels);
  return blended_painting(painting(scene, pixels, task, options), pixels, kernel, *task.tints, options);
}

static Piece_image run_opaque(Scene& scene, const Pixel_view& pixels, const Image_task& task,
                              const Image_options& options, std::optional<Depth_image>& depth_buffer) {
  const Image_kernel kernel = kernel_of(task.kernel);
  if (task.method == "centres") return centres(Exact_view(scene, pixels.eye), pixels, options);
  if (task.method == "scan-line") return scan_line(scene, pixels, kernel, options);
  if (task.method == "warnock") return warnock(scene, pixels, kernel, options);
  if (task.method == "weiler-atherton" || task.method == "bsp2d") return by_surface(scene, pixels, task, options);
  if (task.method == "rays") return Traced_scene(scene, options.threads).image(pixels, options);
  if (task.method == "depth" || task.method == "weighted") {
    Depth_buffer_options depth;
    depth.bits = task.bits;
    depth_buffer = depth_image(scene, pixels, depth);
    return std::move(depth_buffer->image);
  }
  return paint(painting(scene, pixels, task, options), pixels, kernel, options);
}

Image_outcome run_image(Scene& scene, const Pixel_view& pixels, const Image_task& task, const Image_options& options) {
  Image_outcome outcome;
  const Stopwatch watch;
  if (task.tints != nullptr) outcome.blended = run_blended(scene, pixels, task, options);
  else outcome.pieces = run_opaque(scene, pixels, task, options, outcome.depth);
  outcome.seconds = watch.seconds();
  return outcome;
}

void run_means(const Exact_view& view, const Pixel_view& pixels, const std::vector<Tint>& tints,
               const std::function<void(const Mean_row&)>& visit, const Image_options& options) {
  if (is_transparent(tints)) {
    blended_means(view, pixels, tints, visit, options);
    return;
  }
  Visible_options visible;
  visible.threads = options.threads;
  visible.progress = options.progress;
  const auto surface = visible_surface(view, Piece_boxes(view.scene()), field_of_view(view), visible);
  visible_means(
      view, surface, pixels, [&](std::uint32_t piece) { return tints[piece].colour; }, visit, options);
}

}  // namespace sightline::app
