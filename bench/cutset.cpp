// Cut-sets against testing every face: convex bodies of 10^3 to 10^6 faces, the paper's example, and real meshes
// subdivided to 10^5 faces: bench_cutset [--max FACES] [--scenes FOLDER] [--out FOLDER] CSV on standard output, a line
// a run; ratios and growth on standard error; with --out also cutset.csv and cutset.svg. Every frame's count of on-view
// faces is compared with the exact count now and then, so a wrong frame ends the run.

#include "measure.h"

#include <sightline/kernel/scene/face_mesh.h>
#include <sightline/algorithms/cutset/tracker.h>
#include <sightline/algorithms/cutset/update_1977.h>
#include <sightline/harness/generate/scenes.h>
#include <sightline/io/plot.h>
#include <sightline/io/read.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/harness/generate/shapes.h>
#include <sightline/io/decimal.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <sstream>

using namespace sightline;

namespace {

/// What one tests without a thought: all planes in doubles, as fast as the machine reads them. Wrong where rounding is.
struct All_planes {
  std::vector<double> a, b, c, d;
  std::vector<std::uint8_t> on;

  explicit All_planes(const Face_graph& graph) {
    const Predicates predicates = graph.scene().predicates();
    for (std::uint32_t i = 0; i < graph.size(); ++i) {
      const Prepared_plane h = predicates.prepare(graph.plane(i));
      a.push_back(h.a);
      b.push_back(h.b);
      c.push_back(h.c);
      d.push_back(h.d);
    }
    on.resize(a.size());
  }
  [[gnu::noinline, gnu::target_clones("avx512f", "avx2", "default"), gnu::optimize("O3")]] static void test(
      std::size_t n, const double* a, const double* b, const double* c, const double* d, double x, double y, double z,
      std::uint8_t* on) {
    for (std::size_t i = 0; i < n; ++i) on[i] = a[i] * x + b[i] * y + c[i] * z + d[i] > 0;
  }
  void test(double x, double y, double z) {
    test(a.size(), a.data(), b.data(), c.data(), d.data(), x, y, z, on.data());
  }
};

struct Run {
  double build, tracker, plain, all;       // seconds: graph and tracker, then a frame
  double tests, plain_tests, cut, births;  // a frame
  std::uint64_t nodes, first_tests, wrong, peak;
};

/// A level circle round the scene's middle, three half sides away and one above it, the first `frames` of `circle`
/// places.
std::vector<Viewpoint> orbit(const Scene& scene, std::size_t frames, std::uint64_t circle) {
  const auto box = scene.box();
  Exact_point centre{0, 0, 0};
  Rational half = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    centre[k] = (box[0][k] + box[1][k]) / 2;
    half = std::max(half, Rational((box[1][k] - box[0][k]) / 2));
  }
  std::vector<Viewpoint> path;
  for (std::size_t k = 0; k < frames; ++k) {
    const auto [x, y] = generate::circle_point(k, circle, std::int64_t{1} << 30);
    const double r = nearest_double(half) * 3 / 0x1p30;
    path.push_back({{Rational(centre[0] + exact(static_cast<double>(x) * r)),
                     Rational(centre[1] + exact(static_cast<double>(y) * r)), Rational(centre[2] + half)},
                    false});
  }
  return path;
}

Run run(const Polygon_soup& soup, std::uint64_t circle) {
  const Scene scene(soup);
  const Exact_traits traits(scene);
  constexpr std::size_t thirds = 3, third = 360;  // the fastest third counts: others may have been interrupted
  const std::vector<Viewpoint> path = orbit(scene, 1 + thirds * third, circle);
  Run r{};
  const std::uint64_t before = process_memory("self", "VmRSS");
  const double start = bench::now();
  const Face_graph graph(scene);
  Cut_set_tracker tracker(traits, graph);
  r.build = bench::now() - start;
  r.nodes = graph.size();
  r.peak = process_memory("self", "VmRSS") - before;
  tracker.move_to(path[0]);
  r.first_tests = tracker.last().tests;
  std::vector<std::size_t> counts{tracker.on_view_count()};
  const double frames = static_cast<double>(path.size() - 1);
  const auto a_frame = [&](auto move) {
    double best = 1e300;
    for (std::size_t part = 0; part < thirds; ++part) {
      const double begin = bench::now();
      for (std::size_t k = 1 + part * third; k <= (part + 1) * third; ++k) move(path[k]);
      best = std::min(best, (bench::now() - begin) / third);
    }
    return best;
  };
  r.tracker = a_frame([&](const Viewpoint& view) {
    tracker.move_to(view);
    r.cut += static_cast<double>(tracker.cut_edges().size()) / frames;
    counts.push_back(tracker.on_view_count());
  });
  r.tests = static_cast<double>(tracker.counters().tests - r.first_tests) / frames;
  r.births = static_cast<double>(tracker.counters().births) / frames;
  if (graph.is_convex(0)) {
    Cut_set_1977 plain(traits, graph, path[0], Reading_1977::mended);
    std::uint64_t tests = 0;
    r.plain = a_frame([&](const Viewpoint& view) { tests += plain.update_1977(view); });
    r.plain_tests = static_cast<double>(tests) / frames;
  }
  All_planes all(graph);
  Predicate_counts predicates;
  r.all = a_frame([&](const Viewpoint& view) {
    const Located_point eye = scene.locate(view.at);
    all.test(eye.ax, eye.ay, eye.az);
  });
  for (std::size_t k = 0; k < path.size(); k += 40) {
    const Located_point eye = scene.locate(path[k].at);
    std::size_t on = 0;
    for (std::uint32_t i = 0; i < graph.size(); ++i)
      on += traits.side(eye, graph.plane(i), predicates) == CGAL::POSITIVE;
    r.wrong += on != counts[k];
  }
  return r;
}

/// A triangle mesh subdivided by Loop's scheme until it has as many faces, rounded to doubles.
Polygon_soup subdivided(const Polygon_soup& soup, std::size_t faces) {
  using Mesh = OpenMesh::TriMesh_ArrayKernelT<Face_mesh_traits>;
  Mesh mesh;
  const Scene scene(soup);
  std::vector<Mesh::VertexHandle> vertices;
  for (std::uint32_t p = 0; p < scene.points().size(); ++p) {
    const Exact_point at = scene.position(p);
    vertices.push_back(mesh.add_vertex({nearest_double(at[0]), nearest_double(at[1]), nearest_double(at[2])}));
  }
  omerr().disable();
  for (const Piece& piece : scene.pieces()) {
    const auto corners = scene.corners(piece);
    for (std::size_t k = 2; k < corners.size(); ++k)
      mesh.add_face(vertices[corners[0].point], vertices[corners[k - 1].point], vertices[corners[k].point]);
  }
  omerr().enable();
  OpenMesh::Subdivider::Uniform::LoopT<Mesh, double> loop;
  loop.attach(mesh);
  while (mesh.n_faces() < faces) loop(1);
  loop.detach();
  Polygon_soup result;
  result.file = soup.file;
  for (const auto v : mesh.vertices()) result.add_point(mesh.point(v)[0], mesh.point(v)[1], mesh.point(v)[2]);
  for (const auto f : mesh.faces()) {
    std::vector<Point_id> corners;
    for (const auto v : mesh.fv_range(f)) corners.push_back(static_cast<Point_id>(v.idx()));
    result.add_face(corners);
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  double max_faces = 1e5;
  std::string folder, scenes;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string option = argv[i];
    if (option == "--max") max_faces = std::atof(argv[i + 1]);
    else if (option == "--scenes") scenes = argv[i + 1];
    else if (option == "--out") folder = argv[i + 1];
    else {
      std::cerr << "bench_cutset [--max FACES] [--scenes FOLDER] [--out FOLDER]\n";
      return 2;
    }
  }
  std::ostringstream csv;
  const auto print = [&](const std::string& line) {
    std::cout << line << std::endl;
    csv << line << '\n';
  };
  print(
      "scene,nodes,degrees_a_frame,build_seconds,frame_seconds,update_1977_seconds,all_faces_seconds,tests,update_1977_"
      "tests,cut_edges,births,first_tests,bytes_a_node,wrong");
  Log_plot plot("A frame of an orbit", "faces", "seconds");
  bool failed = false;
  const auto measure = [&](const std::string& name, const Polygon_soup& soup, std::uint64_t circle) {
    Run r{};
    if (!bench::in_child<Run>(r, [&] { return run(soup, circle); }) || r.wrong > 0) {
      failed = true;
      std::cerr << name << ": FAILED\n";
    }
    const double nodes = static_cast<double>(r.nodes), degrees = 360.0 / static_cast<double>(circle);
    print(fmt::format("{},{},{:.3g},{:.4f},{:.3e},{:.3e},{:.3e},{:.1f},{:.1f},{:.1f},{:.2f},{},{:.0f},{}", name,
                      r.nodes, degrees, r.build, r.tracker, r.plain, r.all, r.tests, r.plain_tests, r.cut, r.births,
                      r.first_tests, static_cast<double>(r.peak) / nodes, r.wrong));
    std::cerr << fmt::format(
        "{:<22} {:>8} faces, {:>4.2g} degrees a frame: {:>9.1f} tests, {:.2f} a cut edge, 1/{:<6.0f} of all; {:>8.1f} "
        "us, all faces / tracker = {:.1f}",
        name, r.nodes, degrees, r.tests, r.tests / r.cut, nodes / r.tests, 1e6 * r.tracker, r.all / r.tracker);
    if (r.plain > 0)
      std::cerr << fmt::format("; 1977: {:.2f} a cut edge, {:.1f}% saved, {:.1f} us", r.plain_tests / r.cut,
                               100 - 100 * r.plain_tests / nodes, 1e6 * r.plain);
    std::cerr << '\n';
    plot.add(fmt::format("{}, {:.2g} degrees: cut-set", name, degrees), nodes, r.tracker);
    plot.add("all faces in doubles", nodes, r.all);
    return r;
  };

  for (const std::uint64_t circle : {360, 3600, 36000}) {
    double first_nodes = 0, first_seconds = 0;
    for (const double n : {1e3, 1e4, 1e5, 1e6}) {
      if (n > max_faces * 1.01) continue;
      const Run r = measure("convex_sphere", generate::convex_sphere(static_cast<std::size_t>(n)), circle);
      if (first_nodes > 0)
        std::cerr << fmt::format(
            "{:<22} growth n^{:.2f}\n", "",
            std::log(r.tracker / first_seconds) / std::log(static_cast<double>(r.nodes) / first_nodes));
      else {
        first_nodes = static_cast<double>(r.nodes);
        first_seconds = r.tracker;
      }
    }
  }
  for (const std::uint64_t circle : {360, 3600}) measure("paper_1256", generate::convex_sphere(1256), circle);
  if (!scenes.empty()) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(scenes))
      if (entry.is_regular_file()) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const auto& file : files) measure(file.stem().string(), subdivided(read_scene(file), 100'000), 360);
  }
  if (!folder.empty()) {
    std::ofstream(folder + "/cutset.csv") << csv.str();
    std::ofstream(folder + "/cutset.svg") << plot.text();
  }
  return failed;
}
