// compare see: kernels that partition what an eye sees, and depth buffers.

#include "compare.h"
#include "page.h"

#include <sightline/harness/compare/visible_errors.h>
#include <sightline/algorithms/point_visibility/kernels.h>
#include <sightline/algorithms/point_visibility/visible.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <iostream>
#include <set>

namespace sightline::app {

/// All that is said of a visible surface.
static Json visible_json(const Visible_errors& e) {
  return {{"wrong_area", e.wrong},
          {"tied_area", e.tied},
          {"wrongly_visible", e.wrongly_visible},
          {"wrongly_hidden", e.wrongly_hidden},
          {"missing", e.missing},
          {"largest_missing", e.largest_missing},
          {"gaps", e.gaps},
          {"overlaps", e.overlaps},
          {"not_finite", e.not_finite}};
}
template <class Make_view>
Json judge_view(Make_view make, const Scene& scene, const Visible_options& options, Visible_reference& reference,
                bool says) {
  const Peak_memory memory;
  const Stopwatch watch;
  const Piece_boxes boxes(scene);
  const auto view = make();
  const auto surface = visible_surface(view, boxes, options);
  const double seconds = watch.seconds();
  Json row{{"status", "done"},
           {"seconds", seconds},
           {"peak_bytes", memory.bytes()},
           {"visible", surface.visible.size()},
           {"parts", surface.parts.size()}};
  row["errors"] = visible_json(reference.errors(view, surface));
  if (says) row["said"] = surface.visible;
  return row;
}
static Json judge_kernel(const std::string& kernel, const Scene& scene, const Exact_point& eye,
                         const Visible_options& options, Visible_reference& reference, bool says) {
  const auto with = [&](auto make) { return judge_view(make, scene, options, reference, says); };
  if (kernel == "exact") return with([&] { return Exact_view(scene, eye); });
  if (kernel == "double") return with([&] { return Number_view<double>(scene, eye); });
  if (kernel == "float") return with([&] { return Number_view<float>(scene, eye); });
  if (kernel == "gmpq") return with([&] { return Number_view<CGAL::Gmpq>(scene, eye); });
  return with([&] { return Number_view<CGAL::Exact_predicates_exact_constructions_kernel::FT>(scene, eye); });
}
/// Faces with a piece that has a pixel, and whose front the eye is in front of.
static std::vector<Face_id> shown_faces(const Depth_buffer& buffer, const Exact_view& view) {
  std::set<Face_id> faces;
  for (const std::uint32_t piece : buffer.pieces)
    if (piece != Depth_buffer::nothing && view.eye_side(piece) == CGAL::POSITIVE)
      faces.insert(view.scene().pieces()[piece].face);
  return {faces.begin(), faces.end()};
}
static Json judge_pixels(const Depth_buffer_options& options, const Scene& scene, const Exact_point& eye,
                         Visible_reference& reference, bool says) {
  const Peak_memory memory;
  const Stopwatch watch;
  const Depth_buffer buffer = depth_buffer(scene, eye, options);
  const double seconds = watch.seconds();
  Json row{{"status", "done"},         {"seconds", seconds}, {"peak_bytes", memory.bytes()},
           {"near", buffer.near},      {"far", buffer.far},  {"triangles", buffer.triangles},
           {"clipped", buffer.clipped}};
  row["errors"] = visible_json(reference.errors(buffer));
  if (says) row["said"] = shown_faces(buffer, Exact_view(scene, eye));
  return row;
}

static void print_visible(const Json& rows) {
  const std::string line = "{:<25} {:>8} {:>8} {:>10} {:>8} {:>15} {:>14} {:>7} {:>15} {:>8} {:>8}\n";
  std::cout << fmt::format(fmt::runtime(line), "method", "seconds", "peak MB", "wrong area", "tied", "wrongly visible",
                           "wrongly hidden", "missing", "largest missing", "gaps", "overlaps");
  for (const Json& r : rows) {
    const std::string name = r["method"] == "depth buffer"
                                 ? fmt::format("depth buffer {}, {} bit", r["size"].get<int>(), r["bits"].get<int>())
                                 : r["kernel"].get<std::string>();
    if (r["status"] != "done") {
      std::cout << fmt::format("{:<25} {}\n", name, r["status"].get<std::string>());
      continue;
    }
    const Json& e = r["errors"];
    const auto share = [&](const char* key) { return fmt::format("{:.2g}", e[key].get<double>()); };
    const auto count = [&](const char* key) { return std::to_string(e[key].get<std::uint64_t>()); };
    std::cout << fmt::format(fmt::runtime(line), name, fmt::format("{:.4f}", r["seconds"].get<double>()),
                             fmt::format("{:.1f}", r["peak_bytes"].get<double>() / 1e6), share("wrong_area"),
                             share("tied_area"), count("wrongly_visible"), count("wrongly_hidden"), count("missing"),
                             share("largest_missing"), share("gaps"), share("overlaps"));
  }
}

namespace {

struct See_trial : Trial {
  Compare_arguments arguments;
  Scene scene;
  Exact_point eye;
  Visible_options options;
  Piece_boxes boxes;
  Exact_view view;
  Visible_surface<Exact_view> surface;  // what all are compared with
  Visible_reference reference;

  See_trial(const Compare_arguments& all, const Polygon_soup& soup)
      : arguments(all),
        scene(scene_of(soup)),
        eye(eye_of(arguments.eye, scene)),
        boxes(scene),
        view(scene, eye),
        surface(visible_surface(view, boxes, alone(arguments.common))),
        reference(view, surface) {
    options.threads = arguments.common.threads == 0 ? 1 : arguments.common.threads;
    for (const std::string& kernel : arguments.kernels)
      if (kernel != "epick")
        contestants.push_back({{{"kernel", kernel}, {"method", "partition"}}, [this, kernel] {
                                 return judge_kernel(kernel, scene, eye, options, reference, arguments.says);
                               }});
    for (const double plane : {arguments.near, arguments.far})  // 0: automatic
      if (plane != 0 && (static_cast<float>(plane) == 0 || std::isinf(static_cast<float>(plane))))
        throw Usage_error(fmt::format("--near and --far are floats, and {} is none", plane));
    if (arguments.near != 0 && arguments.far != 0 &&
        !(static_cast<float>(arguments.near) < static_cast<float>(arguments.far)))
      throw Usage_error(
          fmt::format("--near {} is not before --far {}: give a smaller one", arguments.near, arguments.far));
    for (const std::uint32_t size : arguments.sizes)
      for (const int bits : arguments.bits) {
        const Depth_buffer_options pixels{size, bits, static_cast<float>(arguments.near),
                                          static_cast<float>(arguments.far)};
        contestants.push_back({{{"kernel", "float"}, {"method", "depth buffer"}, {"size", size}, {"bits", bits}},
                               [this, pixels] { return judge_pixels(pixels, scene, eye, reference, arguments.says); }});
      }
    right = [](const Json& r) {
      const Json& e = r["errors"];
      for (const char* key : {"wrongly_visible", "wrongly_hidden", "missing", "not_finite"})
        if (e[key] != 0) return false;
      return e["wrong_area"] < 1e-9;  // equal parts may differ by 10^-12: visible_errors.h
    };
  }

  /// On one thread, since processes are made after it.
  static Visible_options alone(const Common& common) {
    Visible_options options;
    options.threads = 1;
    options.progress = common.within_budget();
    return options;
  }
};

}  // namespace

std::unique_ptr<Trial> see_trial(const Compare_arguments& arguments, const Polygon_soup& soup) {
  return std::make_unique<See_trial>(arguments, soup);
}

Exit compare_visible(const Compare_arguments& arguments) {
  const Common& common = arguments.common;
  if (arguments.kernels_given &&
      std::find(arguments.kernels.begin(), arguments.kernels.end(), "epick") != arguments.kernels.end())
    throw Usage_error("--kernels: epick answers order and bsp only; its constructions are those of double");
  const See_trial trial(arguments, common.read());
  const auto& [scene, eye, visible] = std::tie(trial.scene, trial.eye, trial.surface.visible);
  Json rows = Json::array();
  const Exit exit = ask(trial, common.budget, rows);
  if (!arguments.html.empty()) write_comparison(arguments, scene, rows, &eye, &visible);
  if (write_json(common, "compare", scene,
                 {{"question", "see"}, {"eye", point_json(eye)}, {"visible", visible.size()}, {"rows", rows}},
                 {{"threads", trial.options.threads}}, Json::object()))
    return exit;
  scene_rows(scene);
  row("eye", fmt::format("({}, {}, {})", to_string(eye[0]), to_string(eye[1]), to_string(eye[2])));
  row("visible", fmt::format("{} of {} faces", visible.size(), scene.counters().faces));
  print_visible(rows);
  return exit;
}

}  // namespace sightline::app
