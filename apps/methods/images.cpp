#include "images.h"

#include <sightline/algorithms/image/newell.h>
#include <sightline/algorithms/image/painter.h>
#include <sightline/algorithms/image/scan_line.h>
#include <sightline/algorithms/image/warnock.h>
#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/priority/eye_order.h>
#include <sightline/algorithms/priority/tree.h>

#include <map>
#include <utility>

namespace sightline::app {

bool has_image_kernels(const std::string& method) {
  return method.starts_with("painter") || method == "newell" || method == "scan-line" || method == "warnock" ||
         method == "bsp";
}
bool is_true_method(const std::string& method) { return !method.starts_with("painter") && method != "depth"; }

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

/// The same by the priority graph, exactly.
static std::vector<Painted_polygon> by_graph(const Scene& scene, const Exact_point& eye, const Image_options& options) {
  const Exact_traits traits(scene);
  const Priority_tree<Exact_traits> tree = build_priority_tree(traits, {true, false, options.progress});
  std::vector<Painted_polygon> polygons;
  for (const Convex_polygon<Exact_traits>& polygon : back_to_front(traits, tree, eye, options.progress).polygons) {
    Painted_polygon& painted = polygons.emplace_back(Painted_polygon{polygon.piece, {}});
    for (const Corner<Exact_traits>& corner : polygon) painted.corners.push_back(traits.position(*corner.vertex));
  }
  return polygons;
}

Image_outcome run_image(Scene& scene, const Pixel_view& pixels, const Image_task& task, const Image_options& options) {
  const Image_kernel kernel = kernel_of(task.kernel);
  Image_outcome outcome;
  const Stopwatch watch;
  if (task.method == "centres") {
    outcome.pieces = centres(Exact_view(scene, pixels.eye), pixels, options);
  } else if (task.method == "depth") {
    Depth_buffer_options depth;
    depth.bits = task.bits;
    outcome.depth = depth_image(scene, pixels, depth);
    outcome.pieces = std::move(outcome.depth->image);
  } else if (task.method == "newell") {
    outcome.pieces = newell(scene, pixels, kernel, options);
  } else if (task.method == "scan-line") {
    outcome.pieces = scan_line(scene, pixels, kernel, options);
  } else if (task.method == "warnock") {
    outcome.pieces = warnock(scene, pixels, kernel, options);
  } else if (task.method == "bsp") {
    outcome.pieces = paint(by_tree(scene, pixels.eye, task.kernel, options, task.seed), pixels, kernel, options);
  } else if (task.method == "graph") {
    outcome.pieces = paint(by_graph(scene, pixels.eye, options), pixels, kernel, options);
  } else {
    static const std::map<std::string, Painter_key> keys{{"painter-min", Painter_key::nearest},
                                                         {"painter-max", Painter_key::farthest},
                                                         {"painter-mean", Painter_key::mean}};
    outcome.pieces = heedless_painter(scene, pixels, keys.at(task.method), kernel, options);
  }
  outcome.seconds = watch.seconds();
  return outcome;
}

Mean_image run_means(const Exact_view& view, const Pixel_view& pixels,
                     const std::function<Colour(std::uint32_t piece)>& colour, const Image_options& options) {
  Visible_options visible;
  visible.threads = options.threads;
  visible.progress = options.progress;
  const auto surface = visible_surface(view, Piece_boxes(view.scene()), field_of_view(view), visible);
  return visible_means(view, surface, pixels, colour, options);
}

}  // namespace sightline::app
