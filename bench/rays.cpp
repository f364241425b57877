// Rays: what a ray meets first, exactly, against Embree and an exact BSP tree: bench_rays [--faces N] [--rays N]
// [--family NAME]. One
// row for each family of scenes and of rays; one thread, user seconds, the least of three turns. Wrong: rays for which
// Embree says another face than is met first, or none, or one where there is none. A row in which the tree disagrees
// ends in FAILED.

#include "../apps/methods/rays.h"

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/rays/by_tree.h>
#include <sightline/algorithms/rays/tracer.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/scenes.h>
#include <sightline/kernel/time_limit.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

using namespace sightline;

namespace {

/// The least seconds of three turns.
template <class Work>
double timed(Work work) {
  double least = 1e300;
  for (int turn = 0; turn < 3; ++turn) {
    const double begin = processor_seconds();
    work();
    least = std::min(least, processor_seconds() - begin);
  }
  return least;
}

struct Family {
  const char* name;
  std::size_t (*size)(double faces);
};
constexpr std::array<Family, 3> families{{
    {"city", [](double faces) { return static_cast<std::size_t>(faces / 5); }},
    {"soup_constant_density", [](double faces) { return static_cast<std::size_t>(faces); }},
    {"terrain", [](double faces) { return static_cast<std::size_t>(faces); }},
}};

/// Rays of a kind: from anywhere in the scene's box anywhere; from above it to points in it; from anywhere to corners.
std::vector<Double_ray> rays_of(std::string_view kind, const Scene& scene, std::size_t count) {
  generate::Random random(7);
  const auto box = scene.box();
  const auto share = [&] { return static_cast<double>(random.below(1u << 20)) * 0x1p-20; };
  const auto inside = [&](std::size_t k) {
    const double low = nearest_double(box[0][k]), high = nearest_double(box[1][k]);
    return low + share() * (high - low);
  };
  std::vector<Double_ray> rays(count);
  for (Double_ray& ray : rays) {
    for (std::size_t k = 0; k < 3; ++k) {
      ray.origin[k] = inside(k);
      ray.direction[k] = 2 * share() - 1 + 0x1p-30;
    }
    if (kind == "above") {
      ray.origin[2] = nearest_double(box[1][2]) * 3 + 1;
      for (std::size_t k = 0; k < 3; ++k) ray.direction[k] = inside(k) - ray.origin[k];
    } else if (kind == "corners") {
      const Exact_point p = scene.position(static_cast<std::uint32_t>(random.below(scene.points().size())));
      for (std::size_t k = 0; k < 3; ++k) {
        ray.origin[k] = std::round(ray.origin[k] * 0x1p10) * 0x1p-10;
        ray.direction[k] = nearest_double(Rational(p[k] - exact(ray.origin[k])));
      }
    }
  }
  return rays;
}

void measure(const Scene& scene, const std::string& name, std::size_t count) {
  double begin = processor_seconds();
  const Ray_tracer tracer(scene);
  const double build = processor_seconds() - begin;
  begin = processor_seconds();
  const app::Traced_scene embree(scene, 1), watertight(scene, 1, true);
  const double embree_build = (processor_seconds() - begin) / 2;
  Bsp_options options;
  options.threads = 1;
  const Exact_traits traits(scene);
  const Exact_tree tree = build_bsp(traits, options);
  for (const char* kind : {"anywhere", "above", "corners"}) {
    const std::vector<Double_ray> rays = rays_of(kind, scene, count);
    std::vector<Ray_tracer::Nearest> truth(count);
    std::vector<std::uint32_t> floats(count), robust(count);
    Ray_counters counters;
    const double ours = timed([&] {
      counters = {};
      for (std::size_t i = 0; i < count; ++i) truth[i] = tracer.nearest(rays[i], Ray_start::open, counters);
    });
    const double theirs = timed([&] {
      for (std::size_t i = 0; i < count; ++i) floats[i] = embree.first(rays[i]).piece;
    });
    const double safe = timed([&] {
      for (std::size_t i = 0; i < count; ++i) robust[i] = watertight.first(rays[i]).piece;
    });
    // Ties are whatever a method says.
    std::size_t wrong = 0, robust_wrong = 0, tied = 0, hit = 0, checked = 0;
    bool right = true;
    for (std::size_t i = 0; i < count; ++i) {
      const auto face = [&](std::uint32_t piece) {
        return piece == Piece_image::nothing ? Ray_tracer::Nearest::nothing : scene.pieces()[piece].face;
      };
      hit += truth[i].face != Ray_tracer::Nearest::nothing;
      tied += truth[i].tied;
      wrong += truth[i].tied ? floats[i] == Piece_image::nothing : face(floats[i]) != truth[i].face;
      robust_wrong += truth[i].tied ? robust[i] == Piece_image::nothing : face(robust[i]) != truth[i].face;
      if (i % (count / 200) != 0) continue;
      ++checked;
      const std::vector<Face_hit> exact = first_hits(traits, tree, rays[i].exact());
      right = right && (exact.empty() ? truth[i].face == Ray_tracer::Nearest::nothing
                                      : truth[i].face == exact.front().face && truth[i].tied == (exact.size() > 1) &&
                                            sightline::exact(truth[i].low) <= exact.front().t &&
                                            exact.front().t <= sightline::exact(truth[i].high));
    }
    const double each = 1e9 / static_cast<double>(count);
    fmt::print(
        "{:<22} {:>7} {:<9} {:>7.1f} {:>7.1f} {:>7.1f} {:>6.2f} {:>6.2f} {:>6} {:>6} {:>8} {:>8} {:>9} {:>7.1f} "
        "{:>7.1f} "
        "{:>8.3f} {:>8.3f}{}\n",
        name, scene.counters().faces, kind, ours * each, theirs * each, safe * each, ours / theirs, ours / safe, hit,
        tied, wrong, robust_wrong, counters.exact_pieces,
        static_cast<double>(counters.boxes) / static_cast<double>(count),
        static_cast<double>(counters.pieces) / static_cast<double>(count), build, embree_build,
        right && checked > 0 ? "" : " FAILED");
  }
}

}  // namespace

int main(int argc, char** argv) {
  double faces = 1e5;
  std::size_t count = 200000;
  std::string_view only;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::string_view(argv[i]) == "--faces") faces = std::atof(argv[i + 1]);
    if (std::string_view(argv[i]) == "--family") only = argv[i + 1];
    if (std::string_view(argv[i]) == "--rays") count = std::strtoull(argv[i + 1], nullptr, 10);
  }
  fmt::print("{:<22} {:>7} {:<9} {:>7} {:>7} {:>7} {:>6} {:>6} {:>6} {:>6} {:>8} {:>8} {:>9} {:>7} {:>7} {:>8} {:>8}\n",
             "scene", "faces", "rays", "ns", "Embree", "robust", "ratio", "ratio", "hit", "tied", "wrong", "robust",
             "exact", "boxes", "pieces", "build", "Embree");
  for (const Family& family : families)
    if (only.empty() || only == family.name)
      measure(Scene(generate::make(family.name, family.size(faces), 1)), family.name,
              std::max<std::size_t>(count, 200));
}
