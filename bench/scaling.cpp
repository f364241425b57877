// How building a tree scales, and what exactness costs: bench_scaling [--max FACES] [--slow SECONDS] [--out FOLDER]
// CSV on standard output, a line a run; ratios and growth on standard error; with --out also scaling.csv and
// scaling.svg. Each run is a process of its own; seconds are the best of three where a run is short. Peak memory is
// what the run added.

#include "measure.h"

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/bsp/traverse.h>
#include <sightline/harness/generate/scenes.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/io/plot.h>
#include <sightline/io/read.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/traits/point_traits.h>
#include <sightline/harness/generate/soups.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>
#include <random>
#include <sstream>

using namespace sightline;

struct Run {
  double build, order;
  std::uint64_t pieces, fragments, splits, depth, peak, fixed, tests;
};

template <class Traits>
static Run run(const Scene& scene, const Traits& traits, int threads) {
  Run best{};
  for (int repeat = 0; repeat < 3; ++repeat) {
    Bsp_options options;
    options.threads = threads;
    const Peak_memory memory;
    const double start = bench::now();
    const auto tree = build_bsp(traits, options);
    const double build = bench::now() - start;
    const std::uint64_t peak = memory.bytes();
    const auto box = scene.box();
    const double order_start = bench::now();
    std::uint64_t visited = 0;
    traverse(traits, tree, traits.eye(box[1]), Direction::back_to_front, [&](const auto&, Sign) { ++visited; });
    const double order = bench::now() - order_start;
    const Bsp_counters& c = tree.counters;
    if (repeat == 0)
      best = {build,          order,   c.pieces, c.fragments,
              c.splits,       c.depth, peak,     c.predicates.fixed + c.predicates.gmp,
              c.polygon_tests};
    best.build = std::min(best.build, build);
    best.order = std::min(best.order, order);
    if (build > 1) break;
  }
  return best;
}

static Run run_kernel(const std::string& kernel, const Scene& scene) {
  if (kernel == "exact") return run(scene, Exact_traits(scene), 1);
  if (kernel == "exact_2_threads") return run(scene, Exact_traits(scene), 2);
  if (kernel == "double") return run(scene, Point_traits<CGAL::Simple_cartesian<double>>(scene), 1);
  return run(scene, Point_traits<CGAL::Epeck>(scene), 1);
}

/// n random triangles: a centre in the unit cube, corners up to 1/5 from it on each axis; all on a grid of 2^-20. Each
/// is cut tens of times.
static Polygon_soup deep_soup(std::size_t n) {
  std::mt19937_64 random(1);
  const auto between = [&](long low, long high) {
    return static_cast<double>(low + static_cast<long>(random() % static_cast<unsigned long>(high - low + 1))) *
           0x1p-20;
  };
  Polygon_soup soup;
  for (std::size_t i = 0; i < n; ++i) {
    const double centre[3] = {between(0, 1 << 20), between(0, 1 << 20), between(0, 1 << 20)};
    Point_id last = 0;
    for (int k = 0; k < 3; ++k) {
      const double x = between(-209715, 209715), y = between(-209715, 209715), z = between(-209715, 209715);
      last = soup.add_point(centre[0] + x, centre[1] + y, centre[2] + z);
    }
    soup.add_face({last - 2, last - 1, last});
  }
  return soup;
}

static Polygon_soup soup_of(const std::string& kind, std::size_t size, const char* scenes) {
  if (size == 0) return read_scene(std::filesystem::path(scenes) / kind);
  if (kind == "dense_soup") return generate::soup(size, 0.4, 1);
  if (kind == "deep_soup") return deep_soup(size);
  if (const std::size_t end = kind.find(" in 27ths"); end != std::string::npos)
    return generate::scaled(generate::make(kind.substr(0, end), size, 1), Rational(1, 27));
  if (const std::size_t end = kind.find(" rotated"); end != std::string::npos)
    return generate::rotated(generate::make(kind.substr(0, end), size, 1), generate::rotation(1, 2, 3, 4));
  return generate::make(kind, size, 1);
}

int main(int argc, char** argv) {
  double max_faces = 1e5, slow = 20;
  std::string folder;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string option = argv[i];
    if (option == "--max") max_faces = std::atof(argv[i + 1]);
    else if (option == "--slow") slow = std::atof(argv[i + 1]);
    else if (option == "--out") folder = argv[i + 1];
    else {
      std::cerr << "bench_scaling [--max FACES] [--slow SECONDS] [--out FOLDER]\n";
      return 2;
    }
  }
  struct Case {
    std::string kind;
    std::size_t size;
    double faces;
  };
  std::vector<Case> cases;
  for (const double n : {1e3, 1e4, 1e5, 1e6}) {
    const std::size_t faces = static_cast<std::size_t>(n);
    cases.push_back({"soup_constant_density", faces, n});
    cases.push_back({"city", faces / 5, n});
    cases.push_back({"convex_sphere", faces, n});
    cases.push_back({"rooms", static_cast<std::size_t>(std::lround(std::sqrt(n / 220))), n});
  }
  for (const std::size_t n : {100u, 300u, 1000u}) cases.push_back({"dense_soup", n, static_cast<double>(n)});
  for (const std::size_t n : {500u, 1000u, 2000u}) cases.push_back({"deep_soup", n, static_cast<double>(n)});
  // Axis-parallel on small integers, where an interval is as good as a number, and in 27ths or turned by a rational
  // rotation, where it is not.
  for (const std::string turned : {"", " in 27ths", " rotated"}) {
    for (const std::size_t n : {6u, 15u, 32u, 69u})
      cases.push_back({"lattice" + turned, n, 3.0 * static_cast<double>(n * n * n)});
    for (const std::size_t n : {2u, 3u, 4u})
      cases.push_back({"menger_sponge_merged" + turned, n, n == 2 ? 1e3 : n == 3 ? 1e4 : 2e5});
  }
  const char* scenes = std::getenv("SIGHTLINE_SCENES");
  if (scenes != nullptr)
    for (const char* name : {"a_interior/fd1_E1M1.qoff", "a_interior/lq_lq_e0m4.world.qoff",
                             "a_interior/gpl/id_dm4.world.qoff", "a_interior/gpl/id_e1m7.world.qoff"})
      cases.push_back({name, 0, 2000});
  else std::cerr << "real rooms left out: SIGHTLINE_SCENES is not set\n";
  std::stable_sort(cases.begin(), cases.end(), [](const Case& a, const Case& b) { return a.kind < b.kind; });

  std::ostringstream csv;
  const auto print = [&](const std::string& line) {
    std::cout << line << std::endl;
    csv << line << '\n';
  };
  print(
      "scene,faces,kernel,build_seconds,order_seconds,fragments,splits,depth,peak_bytes,bytes_per_fragment,polygon_"
      "tests,beyond_doubles");
  Log_plot plot("Building a BSP tree", "faces", "seconds");
  std::map<std::string, std::map<double, double>> growth;
  for (const Case& c : cases) {
    if (c.faces > max_faces * 1.01) continue;
    const Polygon_soup soup = soup_of(c.kind, c.size, scenes);
    const Scene scene(soup);
    std::map<std::string, double> seconds;
    for (const std::string kernel : {"exact", "exact_2_threads", "double", "epeck"}) {
      if (kernel == "epeck" && seconds["double"] * 60 > slow) continue;
      Run r{};
      if (!bench::in_child<Run>(r, [&] { return run_kernel(kernel, scene); })) {
        std::cerr << c.kind << ' ' << kernel << ": failed\n";
        return 1;
      }
      seconds[kernel] = r.build;
      print(fmt::format("{},{},{},{:.6f},{:.6f},{},{},{},{},{:.0f},{},{}", c.kind, r.pieces, kernel, r.build, r.order,
                        r.fragments, r.splits, r.depth, r.peak,
                        static_cast<double>(r.peak) / static_cast<double>(std::max<std::uint64_t>(1, r.fragments)),
                        r.tests, r.fixed));
      if (kernel == "exact" || kernel == "double")
        plot.add(c.kind.substr(c.kind.find_last_of('/') + 1) + ' ' + kernel, static_cast<double>(r.pieces), r.build);
      if (kernel == "exact") growth[c.kind][static_cast<double>(r.pieces)] = r.build;
    }
    std::cerr << fmt::format(
        "{:<36} {:>8} faces: exact / double = {:.2f}, epeck / exact = {}, one / two threads = {:.2f}\n", c.kind,
        scene.counters().faces, seconds["exact"] / seconds["double"],
        seconds.count("epeck") ? fmt::format("{:.1f}", seconds["epeck"] / seconds["exact"]) : "-",
        seconds["exact"] / seconds["exact_2_threads"]);
  }
  for (const auto& [kind, points] : growth) {
    if (points.size() < 2) continue;
    const auto &first = *points.begin(), &last = *points.rbegin();
    std::cerr << fmt::format("{:<36} grows like n^{:.2f} from {:.0f} to {:.0f} faces\n", kind,
                             std::log(last.second / first.second) / std::log(last.first / first.first), first.first,
                             last.first);
  }
  if (!folder.empty()) {
    std::ofstream(folder + "/scaling.csv") << csv.str();
    std::ofstream(folder + "/scaling.svg") << plot.text();
  }
}
