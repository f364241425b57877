// Speed against error: how often each arithmetic gets the side of a vertex wrong, near and far from degeneracy.
// bench_error [--out FOLDER] A query is four planes of triangles on a grid: three meet in a vertex, the fourth passes
// the very same point, or is moved off it by `distance` grid units in one corner; all moved by `offset` grid units from
// the origin. CSV on standard output; with --out also error.csv and error.svg.

#include "measure.h"

#include <sightline/harness/generate/random.h>
#include <sightline/io/plot.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/kernel/traits/point_traits.h>

#include <CGAL/Cartesian.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <random>
#include <sstream>

using namespace sightline;

namespace {

/// n quadruples of triangles through (or `distance` units off) common lattice points.
Polygon_soup queries(std::size_t n, long distance, double offset) {
  Polygon_soup soup;
  std::mt19937_64 random(1);
  const auto step = [&] { return static_cast<double>(static_cast<long>(random() % 2001) - 1000); };
  for (std::size_t i = 0; i < n; ++i) {
    const double point[3] = {offset + step(), offset + step(), offset + step()};
    for (int k = 0; k < 4; ++k) {
      // The common point is p + (a b)/... inside the triangle's plane: p = (q0 + q1)/2 for corners q0 = p + d, q1 = p -
      // d, so that no corner is the point itself.
      const double d[3] = {step(), step(), step()}, e[3] = {step(), step(), step()};
      Point_id id[3];
      const auto corner = [&](double s, double t, double off) {
        return soup.add_point(point[0] + s * d[0] + t * e[0], point[1] + s * d[1] + t * e[1],
                              point[2] + s * d[2] + t * e[2] + off);
      };
      id[0] = corner(1, 0, k == 3 ? static_cast<double>(distance) : 0);
      id[1] = corner(-1, 0, 0);
      id[2] = corner(0, 1, 0);
      soup.add_face({id[0], id[1], id[2]});
    }
  }
  return soup;
}

struct Result {
  double nanoseconds = 0;
  std::size_t asked = 0, wrong = 0, opposite = 0;
};

/// Makes the vertex of the first three planes by cutting the first triangle's edge line with two planes, as algorithms
/// do: two meets.
template <class K>
Result ask_points(const Scene& scene, const std::vector<Sign>& truth) {
  const Point_traits<K> traits(scene);
  Result result;
  std::vector<Sign> answers;
  const double start = bench::now();
  for (std::uint32_t i = 0; i + 3 < traits.piece_count(); i += 4) {
    const auto f = traits.prepare(traits.supporting_plane(i)), g = traits.prepare(traits.supporting_plane(i + 1)),
               h = traits.prepare(traits.supporting_plane(i + 2));
    // Cramer's rule, in the kernel's own numbers.
    using FT = typename K::FT;
    const FT bc = g.b() * h.c() - g.c() * h.b(), ca = g.c() * h.a() - g.a() * h.c(), ab = g.a() * h.b() - g.b() * h.a();
    const FT ad = g.a() * h.d() - g.d() * h.a(), bd = g.b() * h.d() - g.d() * h.b(), cd = g.c() * h.d() - g.d() * h.c();
    const FT w = f.a() * bc + f.b() * ca + f.c() * ab;
    if (w == FT(0)) {
      answers.push_back(CGAL::ZERO);
      continue;
    }
    const typename K::Point_3 p((f.c() * bd - f.b() * cd - f.d() * bc) / w, (f.a() * cd - f.c() * ad - f.d() * ca) / w,
                                (f.b() * ad - f.a() * bd - f.d() * ab) / w);
    answers.push_back(traits.prepare(traits.supporting_plane(i + 3)).oriented_side(p));
  }
  result.nanoseconds = (bench::now() - start) * 1e9 / static_cast<double>(std::max<std::size_t>(1, answers.size()));
  for (std::size_t i = 0; i < answers.size(); ++i) {
    ++result.asked;
    result.wrong += answers[i] != truth[i];
    result.opposite += answers[i] * truth[i] < 0;
  }
  return result;
}

Result ask_exact(const Scene& scene, std::vector<Sign>& truth, bool gmp) {
  const Exact_traits traits(scene);
  Predicate_counts counts;
  Result result;
  truth.clear();
  const double start = bench::now();
  for (std::uint32_t i = 0; i + 3 < traits.piece_count(); i += 4) {
    const auto plane = [&](std::uint32_t k) { return traits.supporting_plane(i + k); };
    try {
      const Vertex v = traits.predicates().meet(plane(0).id(), plane(1).id(), plane(2).id());
      truth.push_back(gmp ? traits.predicates().side_exact<Integer>(v, plane(3))
                          : traits.side(v, traits.prepare(plane(3)), counts));
    } catch (const std::domain_error&) {
      truth.push_back(CGAL::ZERO);
    }
  }
  result.nanoseconds = (bench::now() - start) * 1e9 / static_cast<double>(std::max<std::size_t>(1, truth.size()));
  result.asked = truth.size();
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string folder = argc == 3 && std::string(argv[1]) == "--out" ? argv[2] : "";
  std::ostringstream csv;
  const auto print = [&](const std::string& line) {
    std::cout << line << std::endl;
    csv << line << '\n';
  };
  print("kernel,distance,offset,asked,wrong,opposite,nanoseconds");
  Log_plot plot("Sides that are wrong, by what they cost (each dot a distance and an offset)",
                "nanoseconds for a vertex and its side", "share wrong");
  for (const double offset : {0.0, 1e6, 1e9})
    for (const long distance : {0L, 1L, 1000L}) {
      const Scene scene(queries(4000, distance, offset));
      std::vector<Sign> by_gmp, truth;
      ask_exact(scene, by_gmp, true);
      const auto report = [&](const std::string& kernel, const Result& r) {
        print(fmt::format("{},{},{:g},{},{},{},{:.1f}", kernel, distance, offset, r.asked, r.wrong, r.opposite,
                          r.nanoseconds));
        plot.add(kernel, r.nanoseconds, static_cast<double>(r.wrong) / static_cast<double>(r.asked));
      };
      Result exact = ask_exact(scene, truth, false);
      for (std::size_t i = 0; i < truth.size(); ++i) exact.wrong += truth[i] != by_gmp[i];
      report("exact", exact);
      report("float", ask_points<CGAL::Simple_cartesian<float>>(scene, by_gmp));
      report("double", ask_points<CGAL::Simple_cartesian<double>>(scene, by_gmp));
      report("epick", ask_points<CGAL::Epick>(scene, by_gmp));
      report("epeck", ask_points<CGAL::Epeck>(scene, by_gmp));
      report("gmpq", ask_points<CGAL::Cartesian<CGAL::Gmpq>>(scene, by_gmp));
    }
  if (!folder.empty()) {
    std::ofstream(folder + "/error.csv") << csv.str();
    std::ofstream(folder + "/error.svg") << plot.text();
  }
}
