// compare render: every method of sightline render against exact rays through the same pixels.

#include "compare.h"
#include "page.h"

#include "../methods/images.h"
#include "../support/pixels.h"

#include <sightline/harness/compare/image_errors.h>
#include <sightline/io/plot.h>

#include <iostream>

namespace sightline::app {

/// What all are compared with: one of them.
struct Image_truth {
  Piece_image pieces;
  std::optional<Blended_image> blended;  ///< where faces let something through
};

static Json errors_of(const Scene& scene, const Image_outcome& outcome, const Image_truth& truth) {
  if (outcome.blended) {
    const Colour_errors e = colour_errors(*truth.blended, *outcome.blended);
    return {{"wrong", e.wrong},
            {"wrong_share", static_cast<double>(e.wrong) / std::max(1.0, static_cast<double>(e.pixels - e.tied))},
            {"largest", e.largest},
            {"mean", e.mean}};
  }
  const Image_errors e = image_errors(scene, truth.pieces, *outcome.pieces);
  return {{"wrong", e.wrong},
          {"wrong_share", static_cast<double>(e.wrong) / std::max(1.0, static_cast<double>(e.pixels - e.tied))},
          {"missing", e.missing},
          {"largest_missing", e.largest_missing}};
}

static Json judge_image(Scene& scene, const Pixel_view& pixels, const Image_task& task, const std::vector<Tint>& tints,
                        int threads, const Image_truth& truth) {
  Image_options options;
  options.threads = threads;
  const Peak_memory memory;
  if (task.method == "exact") {
    const Stopwatch watch;
    const Exact_view view(scene, pixels.eye, field_of(pixels));
    run_means(
        view, pixels, tints, [](const Mean_row&) {}, options);
    return {{"status", "done"}, {"seconds", watch.seconds()}, {"peak_bytes", memory.bytes()}};
  }
  const Image_outcome outcome = run_image(scene, pixels, task, options);
  const std::uint64_t bytes = memory.bytes();
  return {{"status", "done"},
          {"seconds", outcome.seconds},
          {"peak_bytes", bytes},
          {"errors", errors_of(scene, outcome, truth)}};
}

static std::string name_of(const Json& r) {
  std::string name = r["method"].get<std::string>();
  if (r.contains("bits")) return fmt::format("{}, {} bit", name, r["bits"].get<int>());
  if (has_image_kernels(name)) name += ", " + r["kernel"].get<std::string>();
  return name;
}

static void print_images(const Json& rows, bool transparent) {
  const std::string line = "{:<22} {:>8} {:>8} {:>9} {:>8} {:>8} {:>15}\n";
  std::cout << fmt::format(fmt::runtime(line), "method", "seconds", "peak MB", "wrong", "share",
                           transparent ? "mean" : "missing", transparent ? "largest error" : "largest missing");
  for (const Json& r : rows) {
    if (r["status"] != "done") {
      std::cout << fmt::format("{:<22} {}\n", name_of(r), r["status"].get<std::string>());
      continue;
    }
    const auto error = [&](const char* key) {
      if (!r.contains("errors")) return std::string("-");
      const Json& e = r["errors"][key];
      return e.is_number_float() ? fmt::format("{:.2g}", e.get<double>()) : std::to_string(e.get<std::uint64_t>());
    };
    std::cout << fmt::format(fmt::runtime(line), name_of(r), fmt::format("{:.4f}", r["seconds"].get<double>()),
                             fmt::format("{:.1f}", r["peak_bytes"].get<double>() / 1e6), error("wrong"),
                             error("wrong_share"), error(transparent ? "mean" : "missing"),
                             error(transparent ? "largest" : "largest_missing"));
  }
}

static std::string image_plot(const Json& rows, bool transparent) {
  Log_plot plot("Pictures: what methods cost, and get wrong", "seconds",
                transparent ? "mean error of a colour, of 255" : "share of the pixels that show another face");
  for (const Json& r : rows) {
    if (r["status"] != "done" || !r.contains("errors")) continue;
    const std::string method = r["method"];
    plot.add(method, r["seconds"].get<double>(), r["errors"][transparent ? "mean" : "wrong_share"].get<double>());
  }
  return plot.text();
}

namespace {

struct Image_trial : Trial {
  Compare_arguments arguments;
  Scene scene;
  Exact_point eye;
  Pixel_view pixels;
  Exact_view view;
  int threads;
  std::vector<Tint> tints;
  bool transparent;
  Image_truth truth;
  std::uint64_t tied = 0;

  Image_trial(const Compare_arguments& all, const Polygon_soup& soup)
      : arguments(all),
        scene(soup),
        eye(eye_of(arguments.eye, scene)),
        pixels(pixels_of(arguments.view, eye, scene)),
        view(scene, eye),
        threads(arguments.common.threads == 0 ? 1 : arguments.common.threads),
        tints(tints_of(arguments.tints, arguments.common.scene, view, arguments.view.shade == "lambert")),
        transparent(is_transparent(tints)) {
    // 1. What all are compared with; on one thread, since processes are made after it.
    Image_options alone;
    alone.threads = 1;
    alone.progress = arguments.common.within_budget([](std::size_t, std::size_t) {});
    if (transparent) truth.blended = blended_centres(view, pixels, tints, alone);
    else truth.pieces = centres(view, pixels, alone);
    const std::vector<std::uint8_t>& ties = transparent ? truth.blended->tied : truth.pieces.tied;
    tied = static_cast<std::uint64_t>(std::count(ties.begin(), ties.end(), 1));

    // 2. Who is asked.
    for (const std::string& method : image_methods) {
      if (!is_built(method) || (transparent ? !shows_through(method) : method == "weighted")) continue;
      if (method == "depth" || method == "weighted") {
        for (const int bits : arguments.bits)
          add({{"kernel", "float"}, {"method", method}, {"bits", bits}}, {method, "float", bits, seed()});
        continue;
      }
      if (method == "rays") {
        add({{"kernel", "float"}, {"method", method}}, {method, "float", 24, seed()});
        continue;
      }
      for (const std::string& kernel : has_image_kernels(method) ? image_kernels : std::vector<std::string>{"exact"})
        if (!arguments.kernels_given || kernel == "exact" ||
            std::find(arguments.kernels.begin(), arguments.kernels.end(), kernel) != arguments.kernels.end())
          add({{"kernel", kernel}, {"method", method}}, {method, kernel, 24, seed()});
    }
    right = [](const Json& r) {
      return !is_true_method(r["method"]) || !r.contains("errors") || r["errors"]["wrong"] == 0;
    };
  }

  std::uint64_t seed() const { return arguments.common.seed; }
  void add(Json name, Image_task task) {
    task.tints = transparent ? &tints : nullptr;
    contestants.push_back(
        {std::move(name), [this, task] { return judge_image(scene, pixels, task, tints, threads, truth); }});
  }
  static Pixel_view pixels_of(View_arguments of_image, const Exact_point& eye, const Scene& scene) {
    if (of_image.canvas.size.empty()) of_image.canvas.size = "512x512";
    return pixel_view(aimed(of_image.view(eye, scene), scene));
  }
};

}  // namespace

std::unique_ptr<Trial> render_trial(const Compare_arguments& arguments, const Polygon_soup& soup) {
  return std::make_unique<Image_trial>(arguments, soup);
}

Exit compare_images(const Compare_arguments& arguments) {
  const Common& common = arguments.common;
  arguments.view.check_usage();
  const Image_trial trial(arguments, common.read());
  const Exact_point& eye = trial.eye;
  Json rows = Json::array();
  const Exit exit = ask(trial, common.budget, rows);
  if (!arguments.html.empty()) write_comparison(arguments, trial.scene, rows, &eye);
  if (!arguments.svg.empty()) write_file(arguments.svg, image_plot(rows, trial.transparent));
  if (write_json(common, "compare", trial.scene,
                 {{"question", "render"},
                  {"eye", point_json(eye)},
                  {"width", trial.pixels.width},
                  {"height", trial.pixels.height},
                  {"tied", trial.tied},
                  {"transparent", trial.transparent},
                  {"rows", rows}},
                 {{"threads", trial.threads}}, Json::object()))
    return exit;
  scene_rows(trial.scene);
  row("eye", fmt::format("({}, {}, {})", to_string(eye[0]), to_string(eye[1]), to_string(eye[2])));
  row("picture", fmt::format("{} x {} pixels, {} ties", trial.pixels.width, trial.pixels.height, trial.tied));
  print_images(rows, trial.transparent);
  return exit;
}

}  // namespace sightline::app
