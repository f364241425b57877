// Set operations on solids: two spheres against CGAL's corefinement and Nef polyhedra, and Manifold where it is found,
// in the same run, growth up to a million triangles each, many operands. bench_solids [--max TRIANGLES] [--certificates
// [--most FRAGMENTS]] [--only TEXT]. Each row is a process of its own; seconds are of one thread's processor time,
// reading apart; the best of up to five turns, of a check, too. Its ratio is that of a check to the result, with what
// prepares it.

#include "measure.h"

#include <sightline/algorithms/solids/certificate.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/harness/generate/shapes.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/time_limit.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#ifdef SIGHTLINE_MANIFOLD
#include <manifold/manifold.h>
#endif

#include <malloc.h>

#include <cmath>

using namespace sightline;

namespace {

Polygon_soup box(const Exact_point& low, const Exact_point& high) {
  Polygon_soup soup;
  for (std::size_t k = 0; k < 8; ++k)
    soup.add_point((k & 4) != 0 ? high[0] : low[0], (k & 2) != 0 ? high[1] : low[1], (k & 1) != 0 ? high[2] : low[2]);
  soup.add_face({0, 1, 3, 2});
  soup.add_face({4, 6, 7, 5});
  soup.add_face({0, 4, 5, 1});
  soup.add_face({2, 3, 7, 6});
  soup.add_face({0, 2, 6, 4});
  soup.add_face({1, 5, 7, 3});
  return soup;
}

std::vector<Polygon_soup> rotated_cubes(int count) {
  std::vector<Polygon_soup> cubes;
  for (int k = 0; k < count; ++k)
    cubes.push_back(generate::translated(
        generate::rotated(box({-1, -1, -1}, {1, 1, 1}), generate::rotation(5, k % 7 - 3, k % 5 - 2, k % 11 - 5)),
        {Rational(k % 10 * 3, 2), Rational(k / 10 % 10 * 3, 2), Rational(k / 100 * 3, 2)}));
  for (Polygon_soup& cube : cubes) cube = generate::mapped(cube, [](Point_id, const Exact_point& p) { return p; });
  return cubes;
}

std::vector<Polygon_soup> touching_cubes(int side) {
  std::vector<Polygon_soup> cubes;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) cubes.push_back(box({x, y, z}, {x + 1, y + 1, z + 1}));
  return cubes;
}

/// A cube, and all square rods that make it a Menger sponge.
std::vector<Polygon_soup> sponge(int level) {
  int size = 1;
  for (int k = 0; k < level; ++k) size *= 3;
  std::vector<Polygon_soup> all{box({0, 0, 0}, {size, size, size})};
  for (int hole = size / 3; hole > 0; hole /= 3)
    for (int i = hole; i < size; i += 3 * hole)
      for (int j = hole; j < size; j += 3 * hole) {
        all.push_back(box({-1, i, j}, {size + 1, i + hole, j + hole}));
        all.push_back(box({i, -1, j}, {i + hole, size + 1, j + hole}));
        all.push_back(box({i, j, -1}, {i + hole, j + hole, size + 1}));
      }
  return all;
}

/// A disc and what cuts its teeth.
std::vector<Polygon_soup> gear(int teeth) {
  const auto prism = [](const std::vector<std::array<double, 2>>& base, double low, double high) {
    Polygon_soup soup;
    const auto n = static_cast<Point_id>(base.size());
    for (const double z : {low, high})
      for (const auto& [x, y] : base)
        soup.add_point(std::round(x * 0x1p20) * 0x1p-20, std::round(y * 0x1p20) * 0x1p-20, z);
    std::vector<Point_id> bottom, top;
    for (Point_id i = 0; i < n; ++i) {
      bottom.push_back(n - 1 - i);
      top.push_back(n + i);
      soup.add_face({i, (i + 1) % n, n + (i + 1) % n, n + i});
    }
    soup.add_face(bottom);
    soup.add_face(top);
    return soup;
  };
  const auto at = [](double radius, double angle) {
    return std::array<double, 2>{radius * std::cos(angle), radius * std::sin(angle)};
  };
  std::vector<std::array<double, 2>> rim;
  for (int k = 0; k < 4 * teeth; ++k) rim.push_back(at(10, M_PI * (k + 0.5) / (2 * teeth)));
  std::vector<Polygon_soup> all{prism(rim, 0, 1)};
  for (int k = 0; k < teeth; ++k) {
    const double angle = 2 * M_PI * k / teeth, wide = M_PI / (2.2 * teeth);
    all.push_back(
        prism({at(9, angle - wide / 2), at(11, angle - wide), at(11, angle + wide), at(9, angle + wide / 2)}, -1, 2));
  }
  return all;
}

struct Row {
  double prepare = 0, operation = 0, check = 0, peak = 0, check_peak = 0;
  std::size_t faces_in = 0, faces_out = 0, fragments = 0;
  bool closed = false, accepted = true;
};

Row measured(const std::vector<Polygon_soup>& solids, Set_operation operation, std::size_t most_certified) {
  Row row;
  const Peak_memory peak;
  run_with_threads(1, [&] {
    Set_options options;
    options.operation = operation;
    double since = processor_seconds();
    for (int turn = 0; turn < 5 && (turn == 0 || processor_seconds() - since < 2); ++turn) {
      double begin = processor_seconds();
      const Operands operands(solids);
      row.closed = flaws(operands).empty();
      const double prepared = processor_seconds() - begin;
      begin = processor_seconds();
      const Set_result result = set_operation(operands, options);
      const double done = processor_seconds() - begin;
      if (turn == 0 || prepared + done < row.prepare + row.operation) {
        row.prepare = prepared;
        row.operation = done;
      }
      row.faces_in = result.counters.faces;
      row.faces_out = result.soup.face_count();
      row.fragments = result.counters.fragments;
    }
    row.peak = static_cast<double>(peak.bytes()) / 0x1p20;
    if (row.fragments > most_certified) return;
    Polygon_soup surface;
    Solid_certificate certificate;
    {
      options.keep_fragments = true;
      const Operands operands(solids);
      Set_result result = set_operation(operands, options);
      certificate = solid_certificate(operands, options, result);
      surface = std::move(result.soup);
    }
    Verify_options verifying;
    verifying.threads = 1;
    malloc_trim(0);              // what was freed is no room for what is measured
    const Peak_memory checking;  // beside operands and certificate
    since = processor_seconds();
    for (int turn = 0; turn < 5 && (turn == 0 || processor_seconds() - since < 2); ++turn) {
      const double begin = processor_seconds();
      row.accepted &= verify_solids(solids, certificate, &surface, verifying).accepted;
      const double done = processor_seconds() - begin;
      if (turn == 0 || done < row.check) row.check = done;
    }
    row.check_peak = static_cast<double>(checking.bytes()) / 0x1p20;
  });
  return row;
}

void print_row(const std::string& name, const std::vector<Polygon_soup>& solids, Set_operation operation,
               std::size_t most_certified) {
  Row row;
  const bool ran = bench::in_child<Row>(row, [&] { return measured(solids, operation, most_certified); });
  fmt::print("{:<26} {:>8} {:>9} {:>9.4f} {:>9.4f} {:>9} {:>9} {:>8.0f} {}{}\n", name, solids.size(), row.faces_in,
             row.prepare, row.operation, row.fragments, row.faces_out, row.peak,
             row.check > 0 ? fmt::format("{:>9.4f} {:>5.1f} {:>8.0f}", row.check,
                                         row.check / (row.prepare + row.operation), row.check_peak)
                           : "-",
             ran && row.closed && row.accepted ? "" : " FAILED");
  std::fflush(stdout);
}

using Cgal_kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Cgal_mesh = CGAL::Surface_mesh<Cgal_kernel::Point_3>;

std::array<Cgal_mesh, 2> cgal_meshes(const std::vector<Polygon_soup>& solids) {
  std::array<Cgal_mesh, 2> meshes;
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<Cgal_mesh::Vertex_index> ids;
    for (Point_id p = 0; p < solids[k].point_count(); ++p) {
      const Exact_point at = solids[k].point(p);
      ids.push_back(meshes[k].add_vertex({at[0].get_d(), at[1].get_d(), at[2].get_d()}));
    }
    for (Face_id f = 0; f < solids[k].face_count(); ++f) {
      const auto loop = solids[k].loop(f);
      meshes[k].add_face(ids[loop[0]], ids[loop[1]], ids[loop[2]]);
    }
  }
  return meshes;
}

/// Seconds of CGAL's Nef polyhedra with Epeck: to make them of meshes, and to unite them; one turn.
std::array<double, 2> nef_polyhedra(const std::vector<Polygon_soup>& solids) {
  using Nef = CGAL::Nef_polyhedron_3<Cgal_kernel>;
  std::array<Cgal_mesh, 2> meshes = cgal_meshes(solids);
  const double begin = processor_seconds();
  const Nef first(meshes[0]), second(meshes[1]);
  const double converted = processor_seconds();
  const Nef result = first.join(second);
  const double united = result.is_empty() ? converted : processor_seconds();
  return {converted - begin, united - converted};
}

/// Seconds of CGAL's corefinement with Epeck, meshes made before; the best of five.
double corefinement(const std::vector<Polygon_soup>& solids, Set_operation operation) {
  namespace processing = CGAL::Polygon_mesh_processing;
  double best = 0;
  for (int turn = 0; turn < 5; ++turn) {
    std::array<Cgal_mesh, 2> meshes = cgal_meshes(solids);
    Cgal_mesh result;
    const double begin = processor_seconds();
    if (operation == Set_operation::unite) processing::corefine_and_compute_union(meshes[0], meshes[1], result);
    else if (operation == Set_operation::intersect)
      processing::corefine_and_compute_intersection(meshes[0], meshes[1], result);
    else processing::corefine_and_compute_difference(meshes[0], meshes[1], result);
    const double seconds = processor_seconds() - begin;
    if (turn == 0 || seconds < best) best = seconds;
  }
  return best;
}

#ifdef SIGHTLINE_MANIFOLD
manifold::MeshGL64 manifold_mesh(const Polygon_soup& solid) {
  manifold::MeshGL64 mesh;
  mesh.numProp = 3;
  for (Point_id p = 0; p < solid.point_count(); ++p)
    for (const Rational& x : solid.point(p)) mesh.vertProperties.push_back(x.get_d());
  for (Face_id f = 0; f < solid.face_count(); ++f)
    mesh.triVerts.insert(mesh.triVerts.end(), solid.loop(f).begin(), solid.loop(f).end());
  return mesh;
}

/// Seconds of Manifold, which rounds: to take meshes, and to unite them; the best of five.
std::array<double, 2> by_manifold(const std::vector<Polygon_soup>& solids) {
  const std::array<manifold::MeshGL64, 2> meshes{manifold_mesh(solids[0]), manifold_mesh(solids[1])};
  std::array<double, 2> best{1e9, 1e9};
  for (int turn = 0; turn < 5; ++turn) {
    const double begin = processor_seconds();
    const manifold::Manifold first(meshes[0]), second(meshes[1]);
    if (first.NumTri() + second.NumTri() == 0) return {};
    const double taken = processor_seconds();
    const manifold::Manifold result = first + second;
    if (result.NumTri() == 0) return {};  // which is not computed before it is asked for
    best = std::min(best, {taken - begin, processor_seconds() - taken},
                    [](const auto& a, const auto& b) { return a[0] + a[1] < b[0] + b[1]; });
  }
  return best;
}
#endif

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Set operations on solids");
  double most = 1e5;
  std::size_t most_certified = 50000;
  bool certificates = false;
  std::string only;
  app.add_option("--max", most, "triangles of each sphere");
  app.add_flag("--certificates", certificates, "checked too");
  app.add_option("--most", most_certified, "fragments of a certificate that is checked")->capture_default_str();
  app.add_option("--only", only, "rows of which the name has this in it");
  CLI11_PARSE(app, argc, argv);
  if (!certificates) most_certified = 0;
  const auto is_asked_for = [&](const std::string& name) { return name.find(only) != std::string::npos; };

  fmt::print("{:<26} {:>8} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8} {:>9} {:>5} {:>8}\n", "solids", "operands", "faces",
             "prepare s", "boolean s", "fragments", "result", "peak MB", "check s", "ratio", "peak MB");
  for (const int side : {64, 200, 708}) {
    const double triangles = 2.0 * side * side;
    if (triangles > 1.01 * most) break;
    const std::string name = fmt::format("two spheres, {}", 2 * side * side);
    if (!is_asked_for(name)) continue;
    const std::vector<Polygon_soup> solids{generate::triangulated_sphere(side, side + 1, 0),
                                           generate::triangulated_sphere(side, side + 1, 0.7)};
    print_row(name, solids, Set_operation::unite, most_certified);
    if (side != 64) continue;
    const auto print_corefinement = [&](Set_operation operation) {
      double corefined = 0;
      bench::in_child<double>(corefined, [&] { return corefinement(solids, operation); });
      fmt::print("{:<26} {:>28.4f}\n", "  CGAL corefinement, Epeck", corefined);
    };
    print_corefinement(Set_operation::unite);
#ifdef SIGHTLINE_MANIFOLD
    std::array<double, 2> rounded{};
    bench::in_child<std::array<double, 2>>(rounded, [&] { return by_manifold(solids); });
    fmt::print("{:<26} {:>18.4f} {:>9.4f}\n", "  Manifold, doubles", rounded[0], rounded[1]);
#endif
    std::array<double, 2> nef{};
    bench::in_child<std::array<double, 2>>(nef, [&] { return nef_polyhedra(solids); });
    fmt::print("{:<26} {:>18.4f} {:>9.4f}\n", "  CGAL Nef, Epeck", nef[0], nef[1]);
    for (const Set_operation operation : {Set_operation::intersect, Set_operation::subtract}) {
      print_row(fmt::format("  their {}", sightline::name(operation)), solids, operation, most_certified);
      print_corefinement(operation);
    }
  }
  const auto print_if_asked_for = [&](const std::string& name, auto solids, Set_operation operation) {
    if (is_asked_for(name)) print_row(name, solids(), operation, most_certified);
  };
  print_if_asked_for(
      "1,000 rotated cubes", [] { return rotated_cubes(1000); }, Set_operation::unite);
  print_if_asked_for(
      "20^3 touching cubes", [] { return touching_cubes(20); }, Set_operation::unite);
  for (const int level : {2, 3, 4})
    print_if_asked_for(
        fmt::format("Menger sponge, level {}", level), [&] { return sponge(level); }, Set_operation::subtract);
  print_if_asked_for(
      "gear of 1,000 cuts", [] { return gear(1000); }, Set_operation::subtract);
}
