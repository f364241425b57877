// sightline render: a picture of a scene by each method that visible surfaces are found with.

#include "methods/images.h"
#include "methods/rays.h"
#include "support/pixels.h"
#include "support/png.h"
#include "support/tints.h"

#include <map>

namespace sightline::app {

namespace {

struct Render_arguments {
  Common common;
  View_arguments view;
  Tint_arguments tints;
  std::string eye, method = "exact", kernel = "exact", png;
  int bits = 24, samples = 1;
};

/// A picture before its background, in the making.
class Canvas {
 public:
  Canvas(const Pixel_view& pixels, const std::string& background)
      : width_(pixels.width),
        height_(pixels.height),
        behind_(rgba_of(background)),
        bytes_(4 * std::size_t{pixels.width} * pixels.height) {}

  /// A pixel's colour times its opacity, 0 to 255, and its opacity, 0 to 1. Different pixels may be set at once.
  void set(std::size_t pixel, const Colour& colour, double opacity) {
    const double through = 1 - std::min(1.0, opacity), whole = 255 * (1 - through) + through * behind_[3];
    const auto rounded = [](double x) { return static_cast<std::uint8_t>(std::clamp(x, 0.0, 255.0) + 0.5); };
    for (std::size_t k = 0; k < 3; ++k) {
      const double seen = colour[k] + through * behind_[k] * behind_[3] / 255;
      bytes_[4 * pixel + k] = rounded(whole >= 0.5 ? seen * 255 / whole : 0);
    }
    bytes_[4 * pixel + 3] = rounded(whole);
  }
  void set(const Mean_row& row) {
    for (std::size_t x = 0; x < width_; ++x) set(std::size_t{row.y} * width_ + x, row.colours[x], row.covered[x]);
  }
  void set(const Piece_image& image, const std::vector<Tint>& tints) {
    for (std::size_t i = 0; i < image.pieces.size(); ++i) {
      const bool empty = image.pieces[i] == Piece_image::nothing;
      set(i, empty ? Colour{} : tints[image.pieces[i]].colour, empty ? 0 : 1);
    }
  }
  void set(const Blended_image& image) {
    for (std::size_t i = 0; i < image.layers.size(); ++i) set(i, image.layers[i].colour, image.layers[i].alpha);
  }

  std::string png() const { return app::png(width_, height_, bytes_); }

 private:
  std::uint32_t width_, height_;
  std::array<int, 4> behind_;
  std::vector<std::uint8_t> bytes_;
};

/// What a method made.
struct Rendered {
  Canvas canvas;
  Image_outcome outcome;  ///< of `exact`, only its seconds
};

Rendered render(Scene& scene, const View& view, const Render_arguments& arguments, const Image_options& options) {
  const Pixel_view pixels = pixel_view(view);
  const std::vector<Tint> tints = tints_of(arguments.tints, arguments.common.scene, Exact_view(scene, pixels.eye),
                                           arguments.view.shade == "lambert", options.progress);
  const bool transparent = is_transparent(tints);
  if (transparent && !shows_through(arguments.method))
    throw Usage_error(
        fmt::format("--method {} shows only what is first, and some faces let light through: take "
                    "exact, centres, scan-line, bsp or graph, or --alpha 1",
                    arguments.method));
  const auto colour = [&](std::uint32_t piece) { return tints[piece].colour; };
  Rendered rendered{{pixels, view.background}, {}};
  const Stopwatch watch;
  if (arguments.method == "exact") {
    run_means(
        Exact_view(scene, pixels.eye, field_of(pixels)), pixels, tints,
        [&](const Mean_row& row) { rendered.canvas.set(row); }, options);
  } else if (arguments.samples > 1) {
    const Mean_image means =
        Traced_scene(scene, options.threads).means(pixels, static_cast<unsigned>(arguments.samples), colour, options);
    for (std::uint32_t y = 0; y < pixels.height; ++y) rendered.canvas.set(means.row(y));
  } else {
    rendered.outcome = run_image(
        scene, pixels,
        {arguments.method, arguments.kernel, arguments.bits, arguments.common.seed, transparent ? &tints : nullptr},
        options);
    if (transparent) rendered.canvas.set(*rendered.outcome.blended);
    else rendered.canvas.set(*rendered.outcome.pieces, tints);
    return rendered;
  }
  rendered.outcome.seconds = watch.seconds();
  return rendered;
}

/// Pixels of each face that has any.
Json faces_json(const Scene& scene, const Piece_image& image, std::uint64_t& shown) {
  std::map<Face_id, std::uint64_t> pixels;
  for (const std::uint32_t piece : image.pieces)
    if (piece != Piece_image::nothing) {
      ++pixels[scene.pieces()[piece].face];
      ++shown;
    }
  Json faces = Json::array();
  for (const auto& [face, count] : pixels) faces.push_back({{"face", face}, {"pixels", count}});
  return faces;
}

Json direction_json(const Direction3& v) { return {v[0], v[1], v[2]}; }

}  // namespace

static Exit run(const Render_arguments& arguments) {
  const Common& common = arguments.common;
  if (!arguments.eye.empty()) parse_point(arguments.eye, "--eye");  // a usage error comes before a long read
  arguments.view.check_usage();
  if (arguments.png.empty() && common.json.empty()) throw Usage_error("nothing to write: give --png, or --json");
  if (arguments.kernel != "exact" && !has_image_kernels(arguments.method))
    throw Usage_error(fmt::format("--method {} has its own numbers: leave out --kernel", arguments.method));
  if (arguments.samples > 1 && arguments.method != "rays")
    throw Usage_error("--samples is for --method rays; exact shows means without samples");
  if (arguments.bits != Render_arguments{}.bits && arguments.method != "depth" && arguments.method != "weighted")
    throw Usage_error("--bits is for --method depth and weighted");
  Scene scene = scene_of(common.read());
  const Exact_point eye = eye_of(arguments.eye, scene);
  Progress progress("drawing");
  Image_options options;
  options.threads = common.threads;
  options.progress = common.within_budget(progress);
  const View view = aimed(arguments.view.view(eye, scene, View_arguments::usual_margin, options.progress), scene);
  const Pixel_view pixels = pixel_view(view);
  const Rendered rendered = render(scene, view, arguments, options);
  if (!arguments.png.empty()) write_file(arguments.png, rendered.canvas.png());
  progress.clear();

  std::uint64_t shown = 0, tied = 0;
  Json result{{"eye", point_json(eye)},
              {"method", arguments.method},
              {"look", direction_json(pixels.look)},
              {"right", direction_json(pixels.right)},
              {"up", direction_json(pixels.up)},
              {"width", pixels.width},
              {"height", pixels.height}};
  const std::string own = is_true_method(arguments.method) ? "exact" : "float";
  Json counters{{"kernel", has_image_kernels(arguments.method) ? arguments.kernel : own}};
  if (rendered.outcome.pieces) {
    const Piece_image& image = *rendered.outcome.pieces;
    result["faces"] = faces_json(scene, image, shown);
    counters["pixels"] = shown;
  }
  const std::vector<std::uint8_t>* ties = rendered.outcome.ties();
  if (const Image_counters* drawn = rendered.outcome.counters()) append_counters(counters, *drawn);
  if (ties != nullptr && !ties->empty()) {
    tied = static_cast<std::uint64_t>(std::count(ties->begin(), ties->end(), 1));
    counters["tied"] = tied;
  }
  if (rendered.outcome.depth) {
    counters["bits"] = arguments.bits;
    counters["near"] = rendered.outcome.depth->near;
    counters["far"] = rendered.outcome.depth->far;
    counters["not_finite"] = rendered.outcome.depth->not_finite;
  }
  const std::size_t faces = rendered.outcome.pieces ? result["faces"].size() : 0;
  if (write_json(common, "render", scene, std::move(result), counters, {{"render", rendered.outcome.seconds}}))
    return Exit::done;

  scene_rows(scene);
  row("eye", fmt::format("({}, {}, {})", to_string(eye[0]), to_string(eye[1]), to_string(eye[2])));
  row("picture", fmt::format("{} x {} pixels, {:.4g} degrees wide", pixels.width, pixels.height, view.field));
  if (rendered.outcome.pieces) {
    row("shown",
        fmt::format("{} faces in {} pixels{}", faces, shown, tied > 0 ? fmt::format(", {} of them ties", tied) : ""));
  }
  if (const Image_counters* c = rendered.outcome.counters())
    row("looked at", fmt::format("{} polygons, {} times at a centre; {} sides and {} depths by integers", c->drawn,
                                 c->centres, c->exact_sides, c->exact_depths));
  row("seconds", fmt::format("{:.4f} ({}{})", rendered.outcome.seconds, arguments.method,
                             has_image_kernels(arguments.method) ? ", " + arguments.kernel : ""));
  return Exit::done;
}

void add_render(Command program) {
  const Command command =
      program.add_command("render", "A picture of a scene, by each method there is to find what is visible");
  auto a = std::make_shared<Render_arguments>();
  a->common.add_to(command);
  add_eye_option(command, a->eye);
  command
      .add_option(
          "--method", a->method,
          "exact: each pixel the mean over its square of what is seen, without samples, layer behind layer where "
          "faces let light through; centres: what an "
          "exact ray through its centre meets first; depth: a depth buffer, in floats; weighted: the same, "
          "where faces let light through weighted blending; rays: what Embree's "
          "rays through centres meet, in floats; painter-min, "
          "painter-max, painter-mean: faces sorted by the depth of their nearest corner, farthest corner or "
          "corners' mean, which is often wrong; newell: sorted by depth, compared pair by pair, and cut where "
          "there is no order; scan-line: row by row, from edge to edge; warnock: in windows, "
          "each cut into four until one face is first in it; weiler-atherton: directions cut along the edges "
          "of the nearest polygon; bsp2d: near to far by a tree, clipped by another one of what is covered; "
          "bsp, graph: painted in the orders of `sightline order`")
      .check(one_of(image_methods))
      .show_default();
  command
      .add_option("--kernel", a->kernel,
                  "arithmetic of the painters, newell, scan-line, warnock, weiler-atherton, bsp and graph")
      .check(one_of({"exact", "double", "float"}))
      .show_default();
  command.add_option("--bits", a->bits, "of a depth: 1 to 31, or 32 for floats; for --method depth and weighted")
      .check(range(1, 32))
      .show_default();
  command.add_option("--samples", a->samples, "n x n rays a pixel; for --method rays")
      .check(range(1, 64))
      .show_default();
  command.add_option("--png", a->png, "the picture").writes_file(".png");
  a->tints.add_to(command);
  a->view.add_to(command);
  command.footer(
      "Example: sightline render room.off --eye 0.5,-3,1.7 --png room.png\n"
      "Centres on a border belong to the face; where several faces are met at once, one is shown: seen from its front "
      "before from behind, then the lower face id.");
  command.set_action([a] { return run(*a); });
}

}  // namespace sightline::app
