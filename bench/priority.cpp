// Components of the priority graph without its arcs, and with them; trees of separating planes; orders of whole faces
// from an eye: bench_priority [--max FACES] [--out FOLDER] CSV on standard output, a line a run; growth and ratios on
// standard error; with --out also priority.csv and priority.svg. Each run is a process of its own.

#include "measure.h"

#include <sightline/harness/generate/scenes.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/algorithms/priority/eye_order.h>
#include <sightline/io/plot.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/harness/generate/shapes.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>
#include <sstream>

using namespace sightline;

namespace {

struct Run {
  double prepare, search;
  std::uint64_t faces, components, largest, nodes, pairs, peak;
};

using Faces = Priority_relation<Exact_traits>;

Run run_implicit(const Scene& scene) {
  const Exact_traits traits(scene);
  Run best{};
  for (int repeat = 0; repeat < 3; ++repeat) {
    const Peak_memory memory;
    const double start = bench::now();
    const Faces faces(traits);
    Implicit_priority_graph<Faces> graph(faces);
    const double prepared = bench::now();
    const Priority_components found = components(graph);
    const double end = bench::now();
    const std::uint64_t peak = memory.bytes();
    if (repeat > 0 && end - start >= best.prepare + best.search) continue;
    const std::uint64_t added = repeat == 0 ? peak : best.peak;
    best = {prepared - start,
            end - prepared,
            faces.size(),
            found.size(),
            found.largest(),
            graph.counters().nodes,
            graph.counters().relation.pairs,
            added};
    if (end - start > 5) break;
  }
  return best;
}

Run run_explicit(const Scene& scene) {
  const Exact_traits traits(scene);
  const Peak_memory memory;
  const double start = bench::now();
  const Faces faces(traits);
  const Explicit_priority_graph graph(faces);
  const double prepared = bench::now();
  const Priority_components found = components(graph);
  const double end = bench::now();
  return {prepared - start,       end - prepared, faces.size(), found.size(), found.largest(), 0,
          graph.counters().pairs, memory.bytes()};
}

/// A tree that cuts nothing (or cuts until no cycle is left), and an order of what is on-view from an eye in the middle
/// of the scene. `components`: planes; `largest`: faces left in cycles, or cuts.
Run run_tree(const Scene& scene, bool split) {
  const Exact_traits traits(scene);
  const Peak_memory memory;
  const double start = bench::now();
  const Priority_tree<Exact_traits> tree = build_priority_tree(traits, {false, split, {}});
  const double built = bench::now();
  const auto box = scene.box();
  Exact_point eye;
  for (std::size_t k = 0; k < 3; ++k)
    eye[k] = box[0][k] + (box[1][k] - box[0][k]) * Rational(static_cast<long>(500 + k), 1009);
  back_to_front(traits, tree, eye);
  const double end = bench::now();
  const Priority_tree_counters& c = tree.counters;
  return {
      built - start,           end - built,   traits.piece_count(), c.planes, split ? c.splits : c.left, c.search.nodes,
      c.search.relation.pairs, memory.bytes()};
}

/// Disjoint convex bodies of about 100 faces in the cells of a cubic lattice, in random order.
Polygon_soup bodies(std::size_t faces) {
  const Polygon_soup body = generate::convex_sphere(100, 1);
  const std::size_t count = std::max<std::size_t>(1, faces / body.face_count());
  std::size_t side = 1;
  while (side * side * side < count) ++side;
  Polygon_soup soup;
  for (const Face_id cell : generate::random_order(side * side * side, 1)) {
    if (soup.face_count() >= count * body.face_count()) break;
    const std::array<std::size_t, 3> at{cell % side, cell / side % side, cell / side / side};
    std::vector<Point_id> points;
    for (Point_id p = 0; p < body.point_count(); ++p) {
      Exact_point q = body.point(p);
      for (std::size_t k = 0; k < 3; ++k) q[k] += 3 * static_cast<long>(at[k]);
      points.push_back(soup.add_point(q[0], q[1], q[2]));
    }
    for (Face_id f = 0; f < body.face_count(); ++f) {
      std::vector<Point_id> loop;
      for (const Point_id p : body.loop(f, 0)) loop.push_back(points[p]);
      soup.add_face(loop);
    }
  }
  return soup;
}

Polygon_soup soup_of(const std::string& kind, std::size_t faces) {
  if (kind == "bodies") return bodies(faces);
  return generate::make(kind, kind.starts_with("city") ? faces / 5 : faces, 1);
}

}  // namespace

int main(int argc, char** argv) {
  double max_faces = 1e5;
  std::string folder;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string option = argv[i];
    if (option == "--max") max_faces = std::atof(argv[i + 1]);
    else if (option == "--out") folder = argv[i + 1];
    else {
      std::cerr << "bench_priority [--max FACES] [--out FOLDER]\n";
      return 2;
    }
  }
  std::ostringstream csv;
  const auto print = [&](const std::string& line) {
    std::cout << line << std::endl;
    csv << line << '\n';
  };
  print(
      "scene,faces,method,prepare_seconds,search_seconds,components,largest,index_nodes,pairs,peak_bytes,bytes_per_"
      "face");
  Log_plot plot("Components of a priority graph", "faces", "seconds");
  for (const std::string kind :
       {"city", "city_rotated", "bodies", "convex_sphere", "soup_constant_density", "rooms", "terrain"}) {
    double first_faces = 0, first_seconds = 0;
    for (const double n : {1e3, 1e4, 1e5, 1e6}) {
      if (n > max_faces * 1.01) continue;
      const Scene scene(soup_of(kind, kind == "rooms" ? static_cast<std::size_t>(std::lround(std::sqrt(n / 220)))
                                                      : static_cast<std::size_t>(n)));
      std::map<std::string, double> seconds;
      for (const std::string method : {"implicit", "explicit", "tree", "split"}) {
        if (method == "explicit" && n > 1e4) continue;
        if ((method == "tree" || method == "split") && n > (method == "tree" ? 1e5 : 1e4)) continue;
        Run r{};
        if (!bench::in_child<Run>(r, [&] {
              return method == "implicit"   ? run_implicit(scene)
                     : method == "explicit" ? run_explicit(scene)
                                            : run_tree(scene, method == "split");
            })) {
          std::cerr << kind << ' ' << method << ": failed\n";
          return 1;
        }
        seconds[method] = r.prepare + r.search;
        const double faces = static_cast<double>(r.faces);
        print(fmt::format("{},{},{},{:.6f},{:.6f},{},{},{},{},{},{:.0f}", kind, r.faces, method, r.prepare, r.search,
                          r.components, r.largest, r.nodes, r.pairs, r.peak, static_cast<double>(r.peak) / faces));
        plot.add(kind + ' ' + method, faces, seconds[method]);
        if (method == "tree" || method == "split")
          std::cerr << fmt::format("{:<24} {:>8} faces: {} {:.3f} s, {} planes, {} {}, order {:.4f} s\n", kind, r.faces,
                                   method, r.prepare, r.components, r.largest,
                                   method == "tree" ? "left in cycles" : "cuts", r.search);
        if (method != "implicit") continue;
        std::cerr << fmt::format("{:<24} {:>8} faces: {:.3f} s", kind, r.faces, seconds[method]);
        if (first_faces > 0)
          std::cerr << fmt::format(", growth n^{:.2f}",
                                   std::log(seconds[method] / first_seconds) / std::log(faces / first_faces));
        else std::cerr << (first_faces = faces, first_seconds = seconds[method], "");
        std::cerr << '\n';
      }
      if (seconds.count("explicit"))
        std::cerr << fmt::format("{:<24} {:>8} faces: explicit / implicit = {:.0f}\n", kind, scene.pieces().size(),
                                 seconds["explicit"] / seconds["implicit"]);
    }
  }
  if (!folder.empty()) {
    std::ofstream(folder + "/priority.csv") << csv.str();
    std::ofstream(folder + "/priority.svg") << plot.text();
  }
}
