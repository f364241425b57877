// Pictures: exact rays and exact areas against Embree and a depth buffer: bench_render [--max FACES] [--size PIXELS]
// [--family NAME] [--out FOLDER] Tables on standard output; with --out also render.csv, render.svg, and
// antialiasing.svg: error against seconds. Each method of a row is a process of its own, which --limit SECONDS (60)
// ends: nan stands for what did not end, -1 for what could not be counted. Seconds are of one thread, the best of up to
// three turns. A row that is wrong where it must not be ends in FAILED.

#include "measure.h"

#include "../apps/methods/rays.h"

#include <sightline/algorithms/baseline/depth_buffer.h>
#include <sightline/algorithms/image/bsp2d.h>
#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/concave_window.h>
#include <sightline/algorithms/image/means.h>
#include <sightline/algorithms/image/warnock.h>
#include <sightline/algorithms/image/weiler_atherton.h>
#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/harness/compare/image_errors.h>
#include <sightline/harness/compare/pixel_squares.h>
#include <sightline/harness/generate/scenes.h>
#include <sightline/io/plot.h>
#include <sightline/kernel/vectors.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <set>
#include <string>

using namespace sightline;

namespace {

constexpr int turns = 3;
constexpr double enough_seconds = 4;  // no further turn after this

/// The least seconds of some turns, and what the first one made.
template <class Work>
auto timed(double& seconds, Work work) {
  const double start = bench::now();
  auto made = work();
  seconds = bench::now() - start;
  for (int turn = 1; turn < turns && bench::now() - start < enough_seconds; ++turn) {
    const double begin = bench::now();
    work();
    seconds = std::min(seconds, bench::now() - begin);
  }
  return made;
}

Image_options one_thread() {
  Image_options options;
  options.threads = 1;
  return options;
}

// ---- Where one looks from

/// A square picture of 60 degrees from a place in multiples of the scene's box towards its middle.
Pixel_view towards_middle(const Scene& scene, const std::array<double, 3>& from, std::uint32_t size) {
  const auto box = scene.box();
  Pixel_view pixels{{}, {}, {}, {}, size, size};
  std::array<double, 3> look{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double low = nearest_double(box[0][k]), side = nearest_double(box[1][k]) - low;
    const double at = std::round((low + from[k] * side) * 0x1p12) * 0x1p-12;
    pixels.eye[k] = exact(at);
    look[k] = low + 0.49 * side - at;
  }
  const auto unit = [](const std::array<double, 3>& v) {
    const double length = std::sqrt(dot(v, v));
    return std::array<double, 3>{v[0] / length, v[1] / length, v[2] / length};
  };
  pixels.look = unit(look);
  const std::array<double, 3> right = unit(cross(pixels.look, std::array<double, 3>{0, 0, 1})),
                              up = cross(right, pixels.look);
  const double half = std::tan(3.14159265358979 / 6);
  for (std::size_t k = 0; k < 3; ++k) {
    pixels.right[k] = half * right[k];
    pixels.up[k] = half * up[k];
  }
  return pixels;
}

struct Family {
  std::string name;
  std::array<double, 3> from;
  std::size_t (*size)(double faces);
};
const std::array<Family, 4> families{{
    {"city", {-0.1, -0.2, 1.5}, [](double faces) { return static_cast<std::size_t>(faces / 5); }},
    {"soup_constant_density", {-0.4, -0.6, 0.7}, [](double faces) { return static_cast<std::size_t>(faces); }},
    {"rooms",
     {0.13, 0.17, 0.55},
     [](double faces) { return static_cast<std::size_t>(std::lround(std::sqrt(faces / 220))); }},
    {"lattice", {-0.4, -0.6, 0.7}, [](double faces) { return static_cast<std::size_t>(faces / 3); }},
}};

// ---- One ray a pixel

struct Row {
  double centres, warnock, build, rays, depth;
  std::uint64_t exact, tied;
  std::int64_t rays_wrong, depth_wrong;  // or -1
  bool right;
  double see, means;                                         // seconds
  std::array<double, 2> samples, mean_error, largest_error;  // of 4 x 4 and 16 x 16 rays, in shares of a pixel's square
  double exact_error;  // of means by areas, the mean over some pixels, against areas in rationals; or -1
};
constexpr double out_of_time = std::numeric_limits<double>::quiet_NaN();  // seconds and errors of what did not end

/// A colour that tells neighbours apart.
Colour colour_of(std::uint32_t piece) {
  return {double(piece * 2654435761u % 256) / 255, double(piece * 40503u % 256) / 255, double(piece % 7) / 6};
}

/// The seconds that something takes, and what it counts. In a process of its own, which ends after `limit` seconds.
struct Timed {
  double seconds = out_of_time;
  std::int64_t count = -1;
  bool ended() const { return seconds == seconds; }
};
template <class Work, class Count>
Timed limited(unsigned limit, Work work, Count count) {
  Timed all;
  const bool ended = bench::in_child<Timed>(
      all,
      [&] {
        Timed inside;
        const auto made = timed(inside.seconds, work);
        inside.count = count(made);
        return inside;
      },
      limit);
  return ended ? all : Timed();
}

/// What `limit` seconds are not enough for is left out, each method by itself.
Row measure(const Scene& scene, const Pixel_view& pixels, unsigned limit) {
  Row row{};
  row.build = row.rays = row.samples[0] = row.samples[1] = out_of_time;
  row.mean_error = row.largest_error = row.samples;
  row.rays_wrong = row.exact_error = -1;
  const auto nothing = [](const auto&) { return std::int64_t{0}; };
  // 1. Exact rays, and windows.
  const auto look_through_centres = [&] { return centres(Exact_view(scene, pixels.eye), pixels, one_thread()); };
  const Timed of_centres = limited(limit, look_through_centres, nothing);
  row.centres = of_centres.seconds;
  Piece_image truth;
  if (of_centres.ended()) truth = look_through_centres();
  row.exact = truth.counters.exact_sides + truth.counters.exact_depths;
  row.tied = static_cast<std::uint64_t>(std::count(truth.tied.begin(), truth.tied.end(), 1));
  const auto count_wrong = [&](const Piece_image& image) {
    return of_centres.ended() ? static_cast<std::int64_t>(image_errors(scene, truth, image).wrong) : -1;
  };
  const Timed windows = limited(
      limit, [&] { return warnock(scene, pixels, Image_kernel::exact, one_thread()); },
      [&](const Piece_image& image) { return std::int64_t{!of_centres.ended() || image.pieces == truth.pieces}; });
  row.warnock = windows.seconds;
  row.right = windows.count != 0;
  // 2. Depths in floats.
  const Timed depths = limited(
      limit, [&] { return depth_image(scene, pixels); },
      [&](const Depth_image& made) { return count_wrong(made.image); });
  row.depth = depths.seconds;
  row.depth_wrong = depths.count;
  // 3. Means over pixels: by exact areas, beside what an eye sees at all.
  const Piece_boxes boxes(scene);
  Visible_options alone;
  alone.threads = 1;
  const auto look = [&] {
    const Exact_view view(scene, pixels.eye, field_of(pixels));
    return visible_surface(view, boxes, field_of_view(view), alone);
  };
  row.see = limited(limit, look, nothing).seconds;
  const Timed of_means = limited(
      limit,
      [&] {
        std::vector<std::uint8_t> picture(3 * std::size_t{pixels.width} * pixels.height);
        const Exact_view view(scene, pixels.eye, field_of(pixels));
        const auto keep = [&](const Mean_row& of) {
          std::uint8_t* to = &picture[3 * std::size_t{of.y} * pixels.width];
          for (const Colour& colour : of.colours)
            for (const double x : colour) *to++ = static_cast<std::uint8_t>(255 * x + 0.5);
        };
        visible_means(view, visible_surface(view, boxes, field_of_view(view), alone), pixels, colour_of, keep,
                      one_thread());
        return picture;
      },
      nothing);
  row.means = of_means.seconds;
  Mean_image means;
  if (of_means.ended()) {
    const Exact_view view(scene, pixels.eye, field_of(pixels));
    means =
        visible_means(view, visible_surface(view, boxes, field_of_view(view), alone), pixels, colour_of, one_thread());
  }
  const auto error_in_rationals = [&] {
    const Pixel_squares squares(scene, pixels);
    std::vector<Tint> tints;
    for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) tints.push_back({colour_of(i), 1});
    constexpr std::uint32_t along = 8;  // 8 x 8 pixels, evenly
    double sum = 0;
    for (std::uint32_t k = 0; k < along * along; ++k) {
      const std::uint32_t x = (2 * (k % along) + 1) * pixels.width / (2 * along),
                          y = (2 * (k / along) + 1) * pixels.height / (2 * along);
      const Layer right = squares.mean(x, y, tints);
      const std::size_t i = std::size_t{y} * pixels.width + x;
      double error = std::fabs(means.covered[i] - right.alpha);
      for (std::size_t c = 0; c < 3; ++c) error = std::max(error, std::fabs(means.colours[i][c] - right.colour[c]));
      sum += error / (along * along);
    }
    return sum;
  };
  if (of_means.ended() && scene.pieces().size() <= 150000 &&
      !bench::in_child<double>(row.exact_error, error_in_rationals, limit))
    row.exact_error = -1;
  // 4. Rays and means by Embree, once its hierarchy is built.
  if (!app::has_rays()) return row;
  const auto build = [&] { return app::Traced_scene(scene, 1); };
  const Timed of_build = limited(limit, build, nothing);
  row.build = of_build.seconds;
  if (!of_build.ended()) return row;
  const app::Traced_scene traced = build();
  const Timed of_rays = limited(
      limit, [&] { return traced.image(pixels, one_thread()); }, count_wrong);
  row.rays = of_rays.seconds;
  row.rays_wrong = of_rays.count;
  for (std::size_t k = 0; k < 2; ++k) {
    struct Sampled {
      double seconds, mean, largest;
    };
    Sampled sampled{out_of_time, out_of_time, out_of_time};
    const auto sample = [&] {
      Sampled made{0, out_of_time, out_of_time};
      const Mean_image image =
          timed(made.seconds, [&] { return traced.means(pixels, k == 0 ? 4 : 16, colour_of, one_thread()); });
      if (!of_means.ended()) return made;
      double sum = 0;
      made.largest = 0;
      for (std::size_t i = 0; i < means.colours.size(); ++i) {
        double error = std::fabs(means.covered[i] - image.covered[i]);
        for (std::size_t c = 0; c < 3; ++c)
          error = std::max(error, std::fabs(means.colours[i][c] - image.colours[i][c]));
        sum += error;
        made.largest = std::max(made.largest, error);
      }
      made.mean = sum / static_cast<double>(means.colours.size());
      return made;
    };
    if (!bench::in_child<Sampled>(sampled, sample, limit)) continue;
    row.samples[k] = sampled.seconds;
    row.mean_error[k] = sampled.mean;
    row.largest_error[k] = sampled.largest;
  }
  return row;
}

bool pictures(double max_faces, std::uint32_t size, const std::string& only, const std::string& folder,
              unsigned limit) {
  fmt::print("Pictures of {0} x {0} pixels. rays: Embree, without and with its hierarchy; wrong: pixels of {1}\n", size,
             std::uint64_t{size} * size);
  fmt::print("{:<22} {:>8} {:>9} {:>9} {:>9} {:>9} {:>9} {:>7} {:>7} {:>9} {:>9} {:>8}\n", "scene", "faces",
             "centres s", "warnock s", "rays s", "+ tree s", "depth s", "/ rays", "/ both", "rays wr.", "depth wr.",
             "exact");
  std::string means = fmt::format(
      "\nMeans over pixels; errors of a colour from 0 to 1; of exact against areas in rationals, in 64 pixels\n"
      "{:<22} {:>8} {:>6} {:>9} {:>9} {:>7} {:>10} {:>9} {:>10} {:>10} {:>9} {:>10} {:>10}\n",
      "scene", "faces", "size", "see s", "exact s", "/ see", "mean err.", "4 x 4 s", "mean err.", "largest",
      "16 x 16 s", "mean err.", "largest");
  std::string csv =
      "scene,faces,centres_seconds,warnock_seconds,rays_seconds,tree_seconds,depth_seconds,rays_wrong,depth_wrong,tied,"
      "by_integers,see_seconds,exact_seconds,rays4_seconds,rays4_mean,rays4_largest,rays16_seconds,rays16_mean,"
      "rays16_largest,exact_mean,size\n";
  Log_plot error_plot("Anti-aliasing: what it costs, and how far it is off", "seconds",
                      "mean error of a colour from 0 to 1");
  Log_plot plot("Pictures of cities, soups, rooms and lattices", "faces", "seconds");
  bool ok = true;
  for (const Family& family : families)
    for (const double n : {1e3, 1e4, 1e5, 1e6}) {
      if (n > max_faces * 1.01 || (!only.empty() && family.name != only)) continue;
      Scene scene(generate::make(family.name, family.size(n), 1));
      const auto faces = static_cast<double>(scene.counters().faces);
      const Pixel_view pixels = towards_middle(scene, family.from, size);
      Row r{};
      if (!bench::in_child<Row>(r, [&] { return measure(scene, pixels, limit); }) || !r.right) {
        fmt::print("{:<22} {:>8.0f} FAILED\n", family.name, faces);
        ok = false;
        continue;
      }
      fmt::print("{:<22} {:>8.0f} {:>9.4f} {:>9.4f} {:>9.4f} {:>9.4f} {:>9.4f} {:>7.2f} {:>7.2f} {:>9} {:>9} {:>8}\n",
                 family.name, faces, r.centres, r.warnock, r.rays, r.build, r.depth, r.centres / r.rays,
                 r.centres / (r.rays + r.build), r.rays_wrong, r.depth_wrong, r.exact);
      std::fflush(stdout);
      means += fmt::format(
          "{:<22} {:>8.0f} {:>6} {:>9.4f} {:>9.4f} {:>7.2f} {:>10.2e} {:>9.4f} {:>10.2e} {:>10.2e} {:>9.4f} {:>10.2e} "
          "{:>10.2e}\n",
          family.name, faces, pixels.width, r.see, r.means, r.means / r.see, r.exact_error, r.samples[0],
          r.mean_error[0], r.largest_error[0], r.samples[1], r.mean_error[1], r.largest_error[1]);
      csv += fmt::format(
          "{},{:.0f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{},{},{},{},{:.6f},{:.6f},{:.6f},{:.3e},{:.3e},{:.6f},"
          "{:.3e},{:.3e}\n",
          family.name, faces, r.centres, r.warnock, r.rays, r.build, r.depth, r.rays_wrong, r.depth_wrong, r.tied,
          r.exact, r.see, r.means, r.samples[0], r.mean_error[0], r.largest_error[0], r.samples[1], r.mean_error[1],
          r.largest_error[1], r.exact_error, pixels.width);
      if (r.exact_error >= 0) error_plot.add("exact areas", r.means, r.exact_error);
      if (app::has_rays()) {
        error_plot.add("4 x 4 rays", r.samples[0] + r.build, r.mean_error[0]);
        error_plot.add("16 x 16 rays", r.samples[1] + r.build, r.mean_error[1]);
      }
      plot.add("exact rays, " + family.name, faces, r.centres);
      plot.add("exact areas, " + family.name, faces, r.means);
      plot.add("Embree, " + family.name, faces, r.rays + r.build);
    }
  fmt::print("{}", means);
  if (!folder.empty()) {
    std::ofstream(folder + "/render.csv") << csv;
    std::ofstream(folder + "/render.svg") << plot.text();
    std::ofstream(folder + "/antialiasing.svg") << error_plot.text();
  }
  return ok;
}

// ---- Regions instead of pixels

/// What a city of 10,000 faces shows, cut along the edges of nearest polygons, and by a tree of what is covered.
bool regions(std::uint32_t size) {
  const Family& city = families[0];
  Scene scene(generate::make(city.name, city.size(1e4), 1));
  const Pixel_view pixels = towards_middle(scene, city.from, size);
  const Exact_view view(scene, pixels.eye, field_of(pixels));
  Visible_options alone;
  alone.threads = 1;
  Bsp2d_options trees;
  trees.threads = 1;
  std::array<double, 3> seconds{};
  const Visible_surface<Exact_view> seen =
      timed(seconds[0], [&] { return visible_surface(view, Piece_boxes(scene), field_of_view(view), alone); });
  const Visible_surface<Exact_view> windows =
      timed(seconds[1], [&] { return weiler_atherton(view, field_of_view(view), alone); });
  const Visible_surface<Exact_view> covered =
      timed(seconds[2], [&] { return bsp2d(view, field_of_view(view), trees).surface; });
  const auto faces = [&](const Visible_surface<Exact_view>& surface) {
    std::set<Face_id> found;
    for (const auto& part : surface.parts)
      if (part.piece != surface.nothing) found.insert(scene.pieces()[part.piece].face);
    return found;
  };
  const bool ok = faces(seen) == faces(windows) && faces(seen) == faces(covered);
  fmt::print("\nRegions of a city of {} faces\nsee              {:.4f} s, {} parts\n", scene.counters().faces,
             seconds[0], seen.parts.size());
  fmt::print("weiler-atherton  {:.4f} s, {} parts, {:.2f} x see\n", seconds[1], windows.parts.size(),
             seconds[1] / seconds[0]);
  fmt::print("bsp2d            {:.4f} s, {} parts, {:.2f} x see{}\n", seconds[2], covered.parts.size(),
             seconds[2] / seconds[0], ok ? "" : " FAILED");
  return ok;
}

// ---- Weiler and Atherton's windows as they are published

/// A convex piece in the image's plane, as far as it is in the image, or what is left of it.
struct Image_piece {
  Image_polygon polygon;
  std::uint32_t piece;
  std::array<double, 4> box;  // least x and y, largest x and y; rounded outwards by more than an ulp

  Image_piece(Image_polygon of, std::uint32_t number) : polygon(std::move(of)), piece(number), box{2, 2, -2, -2} {
    for (const Image_point& p : polygon.outer)
      for (std::size_t k = 0; k < 2; ++k) {
        box[k] = std::min(box[k], p[k].get_d() - 0x1p-50);
        box[k + 2] = std::max(box[k + 2], p[k].get_d() + 0x1p-50);
      }
  }
  bool is_near(const Image_piece& other) const {
    return box[0] <= other.box[2] && other.box[0] <= box[2] && box[1] <= other.box[3] && other.box[1] <= box[3];
  }
};

/// Polygons clip one another by clip_to_window(): the first of a list all that come after it, the outside of which goes
/// on, as one list. Faces that pierce each other are not looked for.
class Concave_windows {
 public:
  std::size_t clips = 0, bits = 0, polygons = 0;
  std::set<Face_id> faces;

  Concave_windows(const Scene& scene, const Pixel_view& pixels) : scene_(scene), nearness_(scene.pieces().size()) {
    const auto exactly = [](const std::array<double, 3>& v) {
      return Exact_point{exact(v[0]), exact(v[1]), exact(v[2])};
    };
    const Exact_point look = exactly(pixels.look), right = exactly(pixels.right), up = exactly(pixels.up);
    const std::array<Exact_point, 3> axes{cross(up, look), cross(look, right), cross(right, up)};
    const Rational volume = dot(look, axes[2]);
    std::vector<std::pair<Rational, Image_piece>> sorted;  // by the square of the distance to the nearest corner
    for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) {
      std::vector<Exact_point> corners;  // across, upwards, forward
      Rational nearest = -1;
      for (const Piece_corner& corner : scene.corners(scene.pieces()[i])) {
        const Exact_point d = minus(scene.position(corner.point), pixels.eye);
        if (const Rational square = dot(d, d); nearest < 0 || square < nearest) nearest = square;
        corners.push_back({Rational(dot(d, axes[0]) / volume), Rational(dot(d, axes[1]) / volume),
                           Rational(dot(d, axes[2]) / volume)});
      }
      const Exact_point normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
      const Rational offset = dot(normal, corners[0]);
      if (offset == 0) continue;  // edge-on
      for (std::size_t k = 0; k < 3; ++k) nearness_[i][k] = normal[k] / offset;
      // Within the image, and a little in front of the eye.
      const Rational forward(1, 1024);
      cut(corners, {0, 0, 1}, forward);
      for (const long sense : {1, -1}) {
        cut(corners, {Rational(sense), 0, 1}, 0);
        cut(corners, {0, Rational(sense), 1}, 0);
      }
      Image_polygon flat;
      for (const Exact_point& p : corners) flat.outer.push_back({Rational(p[0] / p[2]), Rational(p[1] / p[2])});
      if (offset > 0) std::reverse(flat.outer.begin(), flat.outer.end());
      if (flat.outer.size() >= 3 && area(flat) != 0) sorted.emplace_back(nearest, Image_piece(flat, i));
    }
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Image_piece> list;
    for (auto& [distance, piece] : sorted) list.push_back(std::move(piece));
    show(std::move(list));
  }

 private:
  static void cut(std::vector<Exact_point>& corners, const Exact_point& normal, const Rational& least) {
    std::vector<Exact_point> kept;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Exact_point &p = corners[k], &q = corners[(k + 1) % corners.size()];
      const Rational at_p = dot(normal, p) - least, at_q = dot(normal, q) - least;
      if (at_p >= 0) kept.push_back(p);
      if (sgn(at_p) * sgn(at_q) >= 0) continue;
      const Rational t = at_p / (at_p - at_q);
      kept.push_back(
          {Rational(p[0] + t * (q[0] - p[0])), Rational(p[1] + t * (q[1] - p[1])), Rational(p[2] + t * (q[2] - p[2]))});
    }
    corners = std::move(kept);
  }
  /// Where two do not pierce each other, by the corner at which they are farthest apart.
  bool is_before(const Image_piece& one, std::uint32_t other) const {
    const Exact_point difference = minus(nearness_[one.piece], nearness_[other]);
    Rational most = 0;
    for (const Image_point& p : one.polygon.outer) {
      const Rational at = difference[0] * p[0] + difference[1] * p[1] + difference[2];
      if (abs(at) > abs(most)) most = at;
    }
    return most > 0;
  }
  void show(std::vector<Image_piece> list) {
    while (!list.empty()) {
      Image_piece first = std::move(list.front());
      std::vector<Image_piece> before, outside;
      for (std::size_t k = 1; k < list.size(); ++k) {
        if (!first.is_near(list[k])) {
          outside.push_back(std::move(list[k]));
          continue;
        }
        ++clips;
        Clipped_polygons parts = clip_to_window({&list[k].polygon, 1}, {&first.polygon, 1});
        for (Image_polygon& part : parts.outside) outside.emplace_back(std::move(part), list[k].piece);
        for (Image_polygon& part : parts.inside)
          if (Image_piece of(std::move(part), list[k].piece); is_before(of, first.piece))
            before.push_back(std::move(of));
      }
      if (before.empty()) {
        ++polygons;
        faces.insert(scene_.pieces()[first.piece].face);
        for (const Image_point& p : first.polygon.outer)
          for (const Rational& x : p) bits = std::max(bits, mpz_sizeinbase(x.get_den_mpz_t(), 2));
      } else {  // which clip it
        before.push_back(std::move(first));
        show(std::move(before));
      }
      list = std::move(outside);
    }
  }

  const Scene& scene_;
  std::vector<Exact_point> nearness_;  // of each piece: 1 / t at (x, y) of the image, as a x + b y + c
};

/// Small cities by windows that are concave and have holes, one a polygon, against many convex ones.
bool concave_windows(std::uint32_t size, unsigned limit) {
  struct Run {
    double seconds;
    std::size_t clips, bits, polygons;
    bool same;
  };
  bool ok = true;
  fmt::print("\nWindows of Weiler and Atherton, convex ones and concave ones with holes\n");
  for (const double n : {1e2, 5e2, 2e3}) {
    Scene scene(generate::make(families[0].name, families[0].size(n), 1));
    const Pixel_view pixels = towards_middle(scene, families[0].from, size);
    const Exact_view view(scene, pixels.eye, field_of(pixels));
    Visible_options alone;
    alone.threads = 1;
    double seconds = 0;
    const auto convex = timed(seconds, [&] { return weiler_atherton(view, field_of_view(view), alone); });
    std::set<Face_id> faces;
    for (const auto& part : convex.parts)
      if (part.piece != convex.nothing) faces.insert(scene.pieces()[part.piece].face);
    fmt::print("city of {:>5} faces: convex {:.4f} s, {} parts; concave ", scene.counters().faces, seconds,
               convex.parts.size());
    std::fflush(stdout);
    Run run{};
    const bool ended = bench::in_child<Run>(
        run,
        [&] {
          const double start = bench::now();
          const Concave_windows windows(scene, pixels);
          return Run{bench::now() - start, windows.clips, windows.bits, windows.polygons, windows.faces == faces};
        },
        limit);
    if (!ended) {
      fmt::print("not in {} s\n", limit);
      continue;
    }
    fmt::print("{:.2f} s, {:.0f} x, {} polygons, {} clips, denominators of up to {} bits{}\n", run.seconds,
               run.seconds / seconds, run.polygons, run.clips, run.bits, run.same ? "" : " FAILED");
    ok = ok && run.same;
  }
  return ok;
}

// ---- How fast a depth buffer fills pixels

/// Squares behind one another, farthest first, each of them all over the picture.
void fill(std::uint32_t size) {
  constexpr long layers = 64;
  Polygon_soup soup;
  for (long depth = layers; depth >= 1; --depth) {
    std::vector<Point_id> square;
    for (const auto& [x, y] : {std::pair(-2L, -2L), {2L, -2L}, {2L, 2L}, {-2L, 2L}})
      square.push_back(soup.add_point(Rational(depth * x), Rational(depth * y), Rational(-depth)));
    soup.add_face(square);
  }
  Scene scene(soup);
  const Pixel_view pixels{{0, 0, 0}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, size, size};
  double seconds = 0;
  const Depth_image image = timed(seconds, [&] { return depth_image(scene, pixels); });
  const double count = static_cast<double>(layers) * size * size;
  fmt::print(
      "\nA depth buffer fills {:.1f} million pixels a second and core ({} layers of {} x {}, nearest piece {})\n",
      count / seconds / 1e6, layers, size, size, image.image.pieces[0]);
}

}  // namespace

int main(int argc, char** argv) {
  double max_faces = 1e5;
  std::uint32_t size = 1024;
  std::string only, folder;
  unsigned limit = 60;
  for (int k = 1; k + 1 < argc; k += 2) {
    const std::string option = argv[k];
    if (option == "--max") max_faces = std::atof(argv[k + 1]);
    else if (option == "--size") size = static_cast<std::uint32_t>(std::atoi(argv[k + 1]));
    else if (option == "--family") only = argv[k + 1];
    else if (option == "--out") folder = argv[k + 1];
    else if (option == "--limit") limit = static_cast<unsigned>(std::atoi(argv[k + 1]));
  }
  bool ok = pictures(max_faces, size, only, folder, limit);
  if (only.empty() || only == families[0].name) {
    ok = regions(size) && ok;
    ok = concave_windows(size, limit) && ok;
  }
  fill(size);
  return ok ? 0 : 1;
}
