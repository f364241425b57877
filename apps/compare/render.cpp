// compare render: every method of sightline render against exact rays through the same pixels.

#include "compare.h"
#include "page.h"

#include "../methods/images.h"
#include "../methods/rays.h"
#include "../support/pixels.h"

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/harness/compare/image_errors.h>
#include <sightline/harness/compare/pixel_squares.h>
#include <sightline/harness/generate/random.h>
#include <sightline/io/plot.h>

#include <atomic>
#include <iostream>

namespace sightline::app {

/// What all are compared with: one of them.
struct Image_truth {
  Piece_image pieces;
  std::optional<Blended_image> blended;  ///< where faces let something through
  // Where none does:
  std::optional<Mean_image> means;  ///< by areas, for those that take samples
  std::vector<double> areas;        ///< of each face, in pixels
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

static Layer mean_at(const Mean_image& image, std::size_t pixel) {
  return {image.colours[pixel], image.covered[pixel]};
}

static Json mean_errors_json(const Mean_errors& e) {
  return {{"compared", e.compared},
          {"off", e.off},
          {"off_share", static_cast<double>(e.off) / std::max(1.0, static_cast<double>(e.compared))},
          {"largest", e.largest},
          {"mean", e.mean()}};
}

/// Some pixels of an image, drawn at random: at most 192 whose centre shows another thing than the next one to the
/// right or below, and as many others as make 256.
static std::vector<std::size_t> pixels_to_check(const Pixel_view& pixels, const Image_truth& truth,
                                                std::uint64_t seed) {
  const auto differ = [&](std::size_t i, std::size_t j) {
    return truth.blended ? difference(truth.blended->layers[i], truth.blended->layers[j]) > 0
                         : truth.pieces.pieces[i] != truth.pieces.pieces[j];
  };
  std::vector<std::size_t> borders, others;
  for (std::size_t i = 0; i < std::size_t{pixels.width} * pixels.height; ++i) {
    const bool is_last = (i + 1) % pixels.width == 0, is_lowest = i / pixels.width + 1 == pixels.height;
    const bool is_border = (!is_last && differ(i, i + 1)) || (!is_lowest && differ(i, i + pixels.width));
    (is_border ? borders : others).push_back(i);
  }
  generate::Random random(seed);
  random.shuffle(borders);
  random.shuffle(others);
  borders.resize(std::min<std::size_t>(borders.size(), 192));
  others.resize(std::min<std::size_t>(others.size(), 256 - borders.size()));
  borders.insert(borders.end(), others.begin(), others.end());
  return borders;
}

/// Means by areas against areas in rationals, and whether what centres show is there.
static Json judge_exact(const Scene& scene, const Pixel_view& pixels, const std::vector<Tint>& tints,
                        std::uint64_t seed, const Image_options& options, const Image_truth& truth) {
  const Peak_memory memory;
  const Stopwatch watch;
  Mean_image made = Mean_image::empty(pixels);
  {
    const Exact_view view(scene, pixels.eye, field_of(pixels));
    run_means(
        view, pixels, tints, [&](const Mean_row& row) { made.set(row); }, options);
  }
  Json row{{"status", "done"}, {"seconds", watch.seconds()}, {"peak_bytes", memory.bytes()}};
  const Pixel_squares squares(scene, pixels);
  Mean_errors e;
  for (const std::size_t i : pixels_to_check(pixels, truth, seed))
    e.add(
        squares.mean(static_cast<std::uint32_t>(i % pixels.width), static_cast<std::uint32_t>(i / pixels.width), tints),
        mean_at(made, i));
  row["errors"] = mean_errors_json(e);
  if (truth.blended) return row;
  std::vector<std::uint64_t> missing(truth.areas.size());  // pixels of each
  for (std::size_t i = 0; i < truth.pieces.pieces.size(); ++i)
    if (const std::uint32_t piece = truth.pieces.pieces[i]; piece != Piece_image::nothing && !truth.pieces.tied[i])
      if (const Face_id face = scene.pieces()[piece].face; truth.areas[face] == 0) ++missing[face];
  row["errors"]["missing"] = missing.size() - static_cast<std::size_t>(std::count(missing.begin(), missing.end(), 0));
  row["errors"]["largest_missing"] = missing.empty() ? 0 : *std::max_element(missing.begin(), missing.end());
  return row;
}

/// Means of n x n rays a pixel against those by areas, and faces that no ray meets.
static Json judge_samples(const Scene& scene, const Pixel_view& pixels, const std::vector<Tint>& tints, unsigned n,
                          const Image_options& options, const Image_truth& truth) {
  std::vector<std::atomic<bool>> met(truth.areas.size());
  const auto colour = [&](std::uint32_t piece) {
    met[scene.pieces()[piece].face].store(true, std::memory_order_relaxed);
    return tints[piece].colour;
  };
  const Peak_memory memory;
  const Stopwatch watch;
  const Mean_image made = Traced_scene(scene, options.threads).means(pixels, n, colour, options);
  Json row{{"status", "done"}, {"seconds", watch.seconds()}, {"peak_bytes", memory.bytes()}};
  Mean_errors e;
  for (std::size_t i = 0; i < made.colours.size(); ++i) e.add(mean_at(*truth.means, i), mean_at(made, i));
  std::uint64_t missing = 0;
  double largest = 0;
  for (std::size_t f = 0; f < met.size(); ++f)
    if (truth.areas[f] > 0 && !met[f]) {
      ++missing;
      largest = std::max(largest, truth.areas[f]);
    }
  row["errors"] = mean_errors_json(e);
  row["errors"]["missing"] = missing;
  row["errors"]["largest_missing"] = largest;
  return row;
}

static Json judge_image(Scene& scene, const Pixel_view& pixels, const Image_task& task, const std::vector<Tint>& tints,
                        int threads, const Image_truth& truth, bool says) {
  Image_options options;
  options.threads = threads;
  if (task.method == "exact") return judge_exact(scene, pixels, tints, task.seed, options, truth);
  const Peak_memory memory;
  const Image_outcome outcome = run_image(scene, pixels, task, options);
  const std::uint64_t bytes = memory.bytes();
  Json row{{"status", "done"},
           {"seconds", outcome.seconds},
           {"peak_bytes", bytes},
           {"errors", errors_of(scene, outcome, truth)}};
  if (!says || outcome.blended) return row;
  const Image_errors e = image_errors(scene, truth.pieces, *outcome.pieces);
  row["wrong_faces"] = {
      {"missing", {{"faces", e.covered}, {"name", "not shown where it is seen"}}},
      {"extra", {{"faces", e.shown}, {"name", "shown where it is not"}}},
      {"words",
       fmt::format("{} of {} x {} pixels show another face than what a ray through their middle meets, or none",
                   e.wrong, pixels.width, pixels.height)}};
  return row;
}

static std::string name_of(const Json& r) {
  std::string name = r["method"].get<std::string>();
  if (r.contains("bits")) return fmt::format("{}, {} bit", name, r["bits"].get<int>());
  if (r.contains("samples")) return fmt::format("{0}, {1} x {1}", name, r["samples"].get<int>());
  if (has_image_kernels(name)) name += ", " + r["kernel"].get<std::string>();
  return name;
}

/// Whether its pixels are means over their squares, which centres say nothing about.
static bool shows_means(const Json& r) { return r["method"] == "exact" || r.contains("samples"); }

static std::string error_of(const Json& r, const char* key) {
  if (!r["errors"].contains(key)) return "-";
  const Json& e = r["errors"][key];
  return e.is_number_float() ? fmt::format("{:.2g}", e.get<double>()) : std::to_string(e.get<std::uint64_t>());
}

/// A row of the tables: the first cell to the left, the others to the right.
static void print_cells(const std::vector<std::string>& cells) {
  std::string line = fmt::format("{:<23} {:>8} {:>8} {:>9}", cells[0], cells[1], cells[2], cells[3]);
  for (std::size_t k = 4; k < cells.size(); ++k)
    line += fmt::format(" {:>{}}", cells[k], k + 1 < cells.size() ? 8 : 15);
  std::cout << line << '\n';
}

/// Who asks at centres, and below who makes means.
static void print_images(const Json& rows, bool transparent) {
  const auto print = [&](bool means, const std::vector<const char*>& keys) {
    for (const Json& r : rows) {
      if (shows_means(r) != means) continue;
      if (r["status"] != "done") {
        std::cout << fmt::format("{:<23} {}\n", name_of(r), r["status"].get<std::string>());
        continue;
      }
      std::vector<std::string> cells{name_of(r), fmt::format("{:.4f}", r["seconds"].get<double>()),
                                     fmt::format("{:.1f}", r["peak_bytes"].get<double>() / 1e6)};
      for (const char* key : keys) cells.push_back(error_of(r, key));
      print_cells(cells);
    }
  };
  if (transparent) {
    print_cells({"method", "seconds", "peak MB", "wrong", "share", "mean", "largest error"});
    print(false, {"wrong", "wrong_share", "mean", "largest"});
  } else {
    print_cells({"method", "seconds", "peak MB", "wrong", "share", "missing", "largest missing"});
    print(false, {"wrong", "wrong_share", "missing", "largest_missing"});
  }
  print_cells({"means over pixels", "seconds", "peak MB", "compared", "off", "share", "mean", "largest", "missing",
               "largest missing"});
  print(true, {"compared", "off", "off_share", "mean", "largest", "missing", "largest_missing"});
}

static std::string image_plot(const Json& rows, bool transparent) {
  Log_plot plot("Pictures: what methods cost, and get wrong", "seconds",
                transparent ? "mean error of a colour, of 255" : "share of the pixels that show another face");
  for (const Json& r : rows) {
    if (r["status"] != "done" || (!transparent && shows_means(r))) continue;
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
        scene(scene_of(soup)),
        eye(eye_of(arguments.eye, scene)),
        pixels(pixels_of(arguments.view, eye, scene)),
        view(scene, eye),
        threads(arguments.common.threads == 0 ? 1 : arguments.common.threads),
        tints(tints_of(arguments.tints, arguments.common.scene, view, arguments.view.shade == "lambert")),
        transparent(is_transparent(tints)) {
    // 1. What all are compared with; on one thread, since processes are made after it.
    Image_options alone;
    alone.threads = 1;
    alone.progress = arguments.common.within_budget();
    if (transparent) truth.blended = blended_centres(view, pixels, tints, alone);
    else truth.pieces = centres(view, pixels, alone);
    if (!transparent) {
      const Exact_view in_field(scene, eye, field_of(pixels));
      Visible_options visible;
      visible.threads = 1;
      visible.progress = alone.progress;
      const auto surface = visible_surface(in_field, Piece_boxes(scene), field_of_view(in_field), visible);
      truth.areas = seen_areas(in_field, surface, pixels);
      if (has_rays() && !arguments.samples.empty())
        truth.means = visible_means(
            in_field, surface, pixels, [&](std::uint32_t piece) { return tints[piece].colour; }, alone);
    }
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
        for (const unsigned n : arguments.samples)
          contestants.push_back({{{"kernel", "float"}, {"method", method}, {"samples", n}}, [this, n] {
                                   Image_options options;
                                   options.threads = threads;
                                   return judge_samples(scene, pixels, tints, n, options, truth);
                                 }});
        continue;
      }
      for (const std::string& kernel : has_image_kernels(method) ? image_kernels : std::vector<std::string>{"exact"})
        if (!arguments.kernels_given || kernel == "exact" ||
            std::find(arguments.kernels.begin(), arguments.kernels.end(), kernel) != arguments.kernels.end())
          add({{"kernel", kernel}, {"method", method}}, {method, kernel, 24, seed()});
    }
    right = [](const Json& r) {
      if (shows_means(r)) return r["errors"]["off"] == 0 && r["errors"].value("missing", 0) == 0;
      return !is_true_method(r["method"]) || r["errors"]["wrong"] == 0;
    };
  }

  std::uint64_t seed() const { return arguments.common.seed; }
  void add(Json name, Image_task task) {
    task.tints = transparent ? &tints : nullptr;
    contestants.push_back({std::move(name), [this, task] {
                             return judge_image(scene, pixels, task, tints, threads, truth, arguments.says);
                           }});
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
