// What an eye sees: how it scales, what exactness costs, a room as its building grows, and CGAL's envelopes of
// surfaces: bench_see [--max FACES] [--slow SECONDS] [--out FOLDER] Tables on standard output; with --out also see.csv,
// see_rooms.csv, see_envelope.csv and see.svg, see_rooms.svg, see_envelope.svg. Each row is a process of its own, in
// which the runs that it compares take turns; seconds are processor time, the best of up to five turns, but for two
// threads on the clock. A row whose results differ where they must not ends in FAILED.

#include "measure.h"

#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/number_view.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/scenes.h>
#include <sightline/harness/generate/soups.h>
#include <sightline/io/plot.h>
#include <sightline/kernel/time_limit.h>

#include <CGAL/Env_surface_data_traits_3.h>
#include <CGAL/Env_triangle_traits_3.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/envelope_3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <map>

using namespace sightline;

namespace {

constexpr int turns = 5;
constexpr double enough_seconds = 3;  // no further turn after this

using Box = std::array<std::array<double, 3>, 2>;

Box box_of(const Scene& scene) {
  const auto box = scene.box();
  Box result;
  for (std::size_t side = 0; side < 2; ++side)
    for (std::size_t k = 0; k < 3; ++k) result[side][k] = nearest_double(box[side][k]);
  return result;
}
/// To the nearest multiples of 2^-12: an eye's own bits would cost.
Exact_point point(double x, double y, double z) {
  const auto rounded = [](double t) { return exact(std::round(t * 0x1p12) * 0x1p-12); };
  return {rounded(x), rounded(y), rounded(z)};
}
/// A place in multiples of a box's sides.
Exact_point place(const Box& box, double x, double y, double z) {
  const auto at = [&](std::size_t k, double t) { return box[0][k] + t * (box[1][k] - box[0][k]); };
  return point(at(0, x), at(1, y), at(2, z));
}

/// Planes that all of a scene of rooms lies on, across axis k.
std::vector<double> planes_of(const Scene& scene, std::size_t k) {
  std::vector<double> planes;
  for (std::uint32_t p = 0; p < scene.points().size(); ++p) planes.push_back(nearest_double(scene.position(p)[k]));
  std::sort(planes.begin(), planes.end());
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
  return planes;
}
/// In the first cell of a room, where no furniture is, at the height of a person's eyes.
Exact_point in_room(const std::array<std::vector<double>, 2>& planes, std::size_t i, std::size_t j) {
  const auto middle = [](const std::vector<double>& p, std::size_t room) {
    return (p[6 * room + 1] + p[6 * room + 2]) / 2;
  };
  return point(middle(planes[0], i), middle(planes[1], j), 1.5);
}

/// All visible faces, from either side.
template <class Surface>
std::vector<Face_id> seen_by(const Surface& surface) {
  std::vector<Face_id> all;
  std::set_union(surface.visible.begin(), surface.visible.end(), surface.from_behind.begin(), surface.from_behind.end(),
                 std::back_inserter(all));
  return all;
}

Visible_options threads(int n) {
  Visible_options options;
  options.threads = n;
  return options;
}

/// Of this process, which works in one thread: what others do at the same time counts less than on the clock.
void best(double& least, double seconds) { least = least == 0 ? seconds : std::min(least, seconds); }

// ---- How it scales, and what exactness costs

struct Scaling {
  double boxes, exact, doubles;    // processor seconds; of an eye: view and surface
  double one_thread, two_threads;  // on the clock
  std::uint64_t visible, parts, predicates, beyond, wrong, bytes;
  bool same;
};

Scaling measure_scaling(const Scene& scene, const Exact_point& eye) {
  Scaling r{};
  r.same = true;
  const Peak_memory memory;
  const double start = bench::now();
  const double processor_start = processor_seconds();
  const Piece_boxes boxes(scene);
  r.boxes = processor_seconds() - processor_start;
  for (int turn = 0; turn < turns && (turn == 0 || bench::now() - start < enough_seconds); ++turn) {
    const auto timed = [&](double& least, auto work) {
      const double begin = processor_seconds();
      auto made = work();
      best(least, processor_seconds() - begin);
      return made;
    };
    if (turn > 0) timed(r.boxes, [&] { return Piece_boxes(scene); });
    const auto look = [&](int n) { return visible_surface(Exact_view(scene, eye), boxes, threads(n)); };
    const double one = bench::now();
    const auto surface = timed(r.exact, [&] { return look(1); });
    best(r.one_thread, bench::now() - one);
    if (turn == 0) {
      const std::uint64_t peak = memory.bytes();
      r.bytes = peak;
      r.visible = seen_by(surface).size();
      r.parts = surface.parts.size();
      const Predicate_counts& c = surface.counters.predicates;
      r.predicates = c.total();
      r.beyond = c.fixed + c.gmp;
    }
    {
      const auto in_doubles =
          timed(r.doubles, [&] { return visible_surface(Number_view<double>(scene, eye), boxes, threads(1)); });
      std::vector<Face_id> wrong;
      const std::vector<Face_id> right = seen_by(surface), other = seen_by(in_doubles);
      std::set_symmetric_difference(right.begin(), right.end(), other.begin(), other.end(), std::back_inserter(wrong));
      r.wrong = wrong.size();
    }
    const double two = bench::now();
    const auto second = look(2);
    best(r.two_threads, bench::now() - two);
    r.same = r.same && second.visible == surface.visible && second.from_behind == surface.from_behind &&
             second.parts.size() == surface.parts.size();
  }
  return r;
}

struct Place {
  std::string name;
  Exact_point at;
};

/// One eye inside of a scene and one outside, above.
std::vector<Place> eyes_of(const std::string& kind, const Scene& scene) {
  const Box box = box_of(scene);
  const Place above{"above", place(box, -0.3, -0.2, 2)};
  if (kind.starts_with("city")) {
    const double middle = std::floor((box[0][0] + box[1][0]) / 2);  // between boxes, which never reach a cell's corner
    const double side = box[1][0] - box[0][0];
    return {{"street", point(middle + 0x5p-10, middle - 0x3p-10, 0.125)},
            {"above", point(-0.3 * side, -0.2 * side, 0.5 * side)}};
  }
  if (kind == "convex_sphere") return {{"centre", point(0, 0, 0)}, {"outside", point(3, 1, 2)}};
  if (kind == "rooms") {
    const std::array<std::vector<double>, 2> planes{planes_of(scene, 0), planes_of(scene, 1)};
    const std::size_t middle = planes[0].size() / 6 / 2;
    return {{"room", in_room(planes, middle, middle)},
            {"above", point(-0.3 * box[1][0], -0.2 * box[1][1], 0.5 * box[1][0])}};
  }
  if (kind == "terrain") {
    // Above the point in the middle, a few cells high.
    const auto all = static_cast<std::uint32_t>(scene.points().size());
    const auto row = static_cast<std::uint32_t>(std::lround(std::sqrt(static_cast<double>(all))));
    const Exact_point middle = scene.position(std::min(all - 1, row / 2 * row + row / 2));
    const double side = box[1][0] - box[0][0];
    return {{"field", {middle[0] + exact(0x1p-12), middle[1] + exact(0x3p-13), middle[2] + exact(0x3p-10)}},
            {"above", point(-0.25 * side, -0.25 * side, box[1][2] + 0.5 * side)}};
  }
  return {{"inside", place(box, 0.503, 0.499, 0.501)}, above};
}

std::size_t size_of(const std::string& kind, double faces) {
  if (kind.starts_with("city")) return static_cast<std::size_t>(faces / 5);
  if (kind == "rooms") return static_cast<std::size_t>(std::lround(std::sqrt(faces / 220)));
  if (kind == "menger_sponge") return faces < 5e3 ? 2 : faces < 5e4 ? 3 : 4;
  return static_cast<std::size_t>(faces);
}

bool scaling(double max_faces, const std::string& folder) {
  fmt::print("{:<22} {:<8} {:>7} {:>9} {:>9} {:>9} {:>9} {:>7} {:>7} {:>6} {:>8} {:>9} {:>8} {:>6} {:>8}\n", "scene",
             "eye", "faces", "boxes s", "exact s", "double s", "2 threads", "ex/dbl", "1/2 thr", "n^", "visible",
             "parts", "beyond %", "wrong", "bytes/f");
  std::string csv =
      "scene,eye,faces,boxes_seconds,exact_seconds,double_seconds,one_thread_clock,two_threads_clock,exact_by_double,"
      "growth,visible,parts,predicates,beyond_doubles,wrong_in_doubles,bytes\n";
  Log_plot plot("What an eye sees", "faces", "seconds");
  bool ok = true;
  double worst = 0;
  for (const std::string kind :
       {"city", "city_rotated", "soup_constant_density", "convex_sphere", "rooms", "terrain", "menger_sponge"}) {
    std::map<std::string, std::array<double, 2>> last;
    for (const double n : {1e3, 1e4, 1e5, 1e6}) {
      if (n > max_faces * 1.01 || (kind == "menger_sponge" && n > 1e5)) continue;
      const Scene scene(generate::make(kind, size_of(kind, n), 1));
      const auto faces = static_cast<double>(scene.counters().faces);
      if (faces > max_faces * 4) continue;
      for (const Place& eye : eyes_of(kind, scene)) {
        Scaling r{};
        if (!bench::in_child<Scaling>(r, [&] { return measure_scaling(scene, eye.at); }) || !r.same) {
          fmt::print("{:<22} {:<8} {:>7.0f} FAILED\n", kind, eye.name, faces);
          ok = false;
          continue;
        }
        const std::string growth =
            last.count(eye.name)
                ? fmt::format("{:.2f}", std::log(r.exact / last[eye.name][1]) / std::log(faces / last[eye.name][0]))
                : "-";
        last[eye.name] = {faces, r.exact};
        worst = std::max(worst, r.exact / r.doubles);
        const double beyond =
            static_cast<double>(r.beyond) / static_cast<double>(std::max<std::uint64_t>(1, r.predicates));
        fmt::print(
            "{:<22} {:<8} {:>7.0f} {:>9.5f} {:>9.5f} {:>9.5f} {:>9.5f} {:>7.2f} {:>7.2f} {:>6} {:>8} {:>9} {:>8.4f} "
            "{:>6} {:>8.0f}\n",
            kind, eye.name, faces, r.boxes, r.exact, r.doubles, r.two_threads, r.exact / r.doubles,
            r.one_thread / r.two_threads, growth, r.visible, r.parts, 100 * beyond, r.wrong,
            static_cast<double>(r.bytes) / faces);
        std::fflush(stdout);
        csv += fmt::format("{},{},{:.0f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.3f},{},{},{},{},{},{},{}\n", kind,
                           eye.name, faces, r.boxes, r.exact, r.doubles, r.one_thread, r.two_threads,
                           r.exact / r.doubles, growth, r.visible, r.parts, r.predicates, r.beyond, r.wrong, r.bytes);
        plot.add(kind + ", " + eye.name, faces, r.exact);
      }
    }
  }
  fmt::print("exact / double at most {:.2f}\n\n", worst);
  if (!folder.empty()) {
    std::ofstream(folder + "/see.csv") << csv;
    std::ofstream(folder + "/see.svg") << plot.text();
  }
  return ok;
}

// ---- A room in a large building

struct In_rooms {
  double boxes, look;                        // seconds, of an eye: view and surface
  double visible, parts, looked_at, opened;  // a room
};

/// From up to nine rooms, evenly spread.
In_rooms measure_rooms(const Scene& scene) {
  const std::array<std::vector<double>, 2> planes{planes_of(scene, 0), planes_of(scene, 1)};
  const std::size_t n = planes[0].size() / 6, along = std::min<std::size_t>(n, 3);
  In_rooms r{};
  const double start = processor_seconds();
  const Piece_boxes boxes(scene);
  r.boxes = processor_seconds() - start;
  const double all = static_cast<double>(along * along);
  for (std::size_t room = 0; room < along * along; ++room) {
    const Exact_point eye =
        in_room(planes, (2 * (room % along) + 1) * n / (2 * along), (2 * (room / along) + 1) * n / (2 * along));
    double seconds = 0;
    for (int turn = 0; turn < turns; ++turn) {
      const double a = processor_seconds();
      const auto surface = visible_surface(Exact_view(scene, eye), boxes, threads(1));
      best(seconds, processor_seconds() - a);
      if (turn > 0) continue;
      r.visible += static_cast<double>(seen_by(surface).size()) / all;
      r.parts += static_cast<double>(surface.parts.size()) / all;
      r.looked_at += static_cast<double>(surface.counters.looked_at) / all;
      r.opened += static_cast<double>(surface.counters.opened) / all;
    }
    r.look += seconds / all;
  }
  return r;
}

bool rooms(double max_faces, const std::string& folder) {
  fmt::print(
      "A room in a large building, milliseconds an eye (mean of up to nine rooms)\n{:>7} {:>8} {:>9} {:>8} {:>8} {:>8} "
      "{:>8} {:>9} {:>8}\n",
      "rooms", "faces", "boxes", "look", "/ first", "visible", "parts", "looked at", "opened");
  std::string csv = "rooms,faces,boxes_seconds,look_seconds,visible,parts,looked_at,opened\n";
  Log_plot plot("A room in a large building", "faces", "seconds");
  bool ok = true;
  double first = 0;
  for (const double n : {1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6}) {
    if (n > max_faces * 1.01) continue;
    const std::size_t side = size_of("rooms", n);
    const Scene scene(generate::rooms(side, side, 1));
    const std::size_t faces = scene.counters().faces;
    In_rooms r{};
    if (!bench::in_child<In_rooms>(r, [&] { return measure_rooms(scene); })) {
      fmt::print("{:>7} FAILED\n", side * side);
      ok = false;
      continue;
    }
    if (first == 0) first = r.look;
    fmt::print("{:>7} {:>8} {:>9.3f} {:>8.3f} {:>8.2f} {:>8.1f} {:>8.1f} {:>9.1f} {:>8.1f}\n", side * side, faces,
               1e3 * r.boxes, 1e3 * r.look, r.look / first, r.visible, r.parts, r.looked_at, r.opened);
    std::fflush(stdout);
    csv += fmt::format("{},{},{:.6f},{:.6f},{:.2f},{:.2f},{:.2f},{:.2f}\n", side * side, faces, r.boxes, r.look,
                       r.visible, r.parts, r.looked_at, r.opened);
    plot.add("an eye", static_cast<double>(faces), r.look);
    plot.add("boxes, once", static_cast<double>(faces), r.boxes);
  }
  fmt::print("\n");
  if (!folder.empty()) {
    std::ofstream(folder + "/see_rooms.csv") << csv;
    std::ofstream(folder + "/see_rooms.svg") << plot.text();
  }
  return ok;
}

// ---- Envelopes

/// Triangles with x, y in [-1/2, 1/2] and z in [1, 2]: a scene turned so that its top looks at the eye in the origin.
Polygon_soup before_the_eye(const Polygon_soup& soup) {
  Exact_point low = soup.point(0), high = low;
  for (Point_id p = 0; p < soup.point_count(); ++p)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], soup.point(p)[k]);
      high[k] = std::max(high[k], soup.point(p)[k]);
    }
  const Rational side = std::max({Rational(high[0] - low[0]), Rational(high[1] - low[1]), Rational(high[2] - low[2])});
  Polygon_soup result;
  result.file = soup.file;
  for (Point_id p = 0; p < soup.point_count(); ++p) {
    const Exact_point at = soup.point(p);
    result.add_point((at[0] - (low[0] + high[0]) / 2) / side, ((low[1] + high[1]) / 2 - at[1]) / side,
                     1 + (high[2] - at[2]) / side);
  }
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    const auto loop = soup.loop(f);
    for (std::size_t k = 2; k < loop.size(); ++k) result.add_face({loop[0], loop[k - 1], loop[k]});
  }
  return result;
}

/// Rays of a cone around what before_the_eye() returns.
std::vector<Exact_point> cone() {
  return {point(-0.625, -0.625, 1), point(0.625, -0.625, 1), point(0.625, 0.625, 1), point(-0.625, 0.625, 1)};
}

struct Ours {
  double scene, surface;  // seconds; surface: boxes, view and surface
  std::uint64_t visible, parts, edge_on;
};

std::vector<Face_id> measure_ours(const Polygon_soup& soup, Ours& r) {
  std::vector<Face_id> seen;
  const double start = bench::now();
  for (int turn = 0; turn < turns && (turn == 0 || bench::now() - start < enough_seconds); ++turn) {
    const double a = processor_seconds();
    const Scene scene(soup);
    const double b = processor_seconds();
    const Piece_boxes boxes(scene);
    const Exact_view view(scene, point(0, 0, 0), field_of(cone()));
    const auto surface = visible_surface(view, boxes, field_of_view(view), threads(1));
    const double c = processor_seconds();
    best(r.scene, b - a);
    best(r.surface, c - b);
    seen = seen_by(surface);
    r.visible = seen.size();
    r.parts = surface.parts.size();
    r.edge_on = 0;
    for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) r.edge_on += view.eye_side(i) == CGAL::ZERO;
  }
  return seen;
}

struct Theirs {
  double seconds;
  std::uint64_t visible, faces, differ;
};

/// The lower envelope of the triangles' images under (x, y, z) -> (x / z, y / z, -1 / z), which takes rays of the eye
/// to vertical lines, nearer points lower. One that the eye is in the plane of becomes vertical, and is on no face of
/// the envelope.
Theirs measure_envelope(const Polygon_soup& soup) {
  using Kernel = CGAL::Epeck;
  using Traits = CGAL::Env_surface_data_traits_3<CGAL::Env_triangle_traits_3<Kernel>, Face_id>;
  std::vector<Kernel::Point_3> images;
  for (Point_id p = 0; p < soup.point_count(); ++p) {
    const Exact_point at = soup.point(p);
    const auto number = [](const Rational& value) { return Field_number<Kernel::FT>::from(value); };
    images.push_back({number(at[0] / at[2]), number(at[1] / at[2]), number(-1 / at[2])});
  }
  std::vector<Traits::Surface_3> triangles;
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    const auto loop = soup.loop(f);
    triangles.emplace_back(Kernel::Triangle_3(images[loop[0]], images[loop[1]], images[loop[2]]), f);
  }
  Theirs r{};
  CGAL::Envelope_diagram_2<Traits> diagram;
  const double start = processor_seconds();
  CGAL::lower_envelope_3(triangles.begin(), triangles.end(), diagram);
  r.seconds = processor_seconds() - start;
  std::vector<Face_id> seen;
  for (auto face = diagram.faces_begin(); face != diagram.faces_end(); ++face)
    for (auto surface = face->surfaces_begin(); surface != face->surfaces_end(); ++surface)
      seen.push_back(surface->data());
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  Ours ours{};
  const std::vector<Face_id> by_us = measure_ours(soup, ours);
  std::vector<Face_id> differ;
  std::set_symmetric_difference(seen.begin(), seen.end(), by_us.begin(), by_us.end(), std::back_inserter(differ));
  r.visible = seen.size();
  r.faces = diagram.number_of_faces();
  r.differ = differ.size();
  return r;
}

Polygon_soup envelope_scene(const std::string& kind, std::size_t triangles) {
  if (kind == "soup, edges 1/3") return generate::soup(triangles, 1.0 / 3, 1);
  if (kind == "city" || kind == "city_rotated")
    return generate::make(kind, std::max<std::size_t>(1, triangles / 10), 1);
  if (kind == "menger_sponge") return generate::menger_sponge(triangles < 1000 ? 1 : 2);
  if (kind == "grid") return generate::grid(triangles < 100 ? 2 : triangles < 1000 ? 4 : 6);
  if (kind == "terrain") return generate::terrain(triangles, 1);
  return generate::make(kind, triangles, 1);
}

bool envelopes(double max_faces, double slow, const std::string& folder) {
  fmt::print(
      "Against lower envelopes in one cone, one thread; ours: boxes, view and surface; ratio: envelope / ours, and "
      "with our scene's construction\n{:<22} {:>9} {:>9} {:>9} {:>11} {:>9} {:>9} {:>8} {:>8} {:>8} {:>8} {}\n",
      "scene", "triangles", "scene s", "ours s", "envelope s", "ratio", "in all", "visible", "parts", "faces",
      "edge-on", "sets");
  std::string csv =
      "scene,triangles,scene_seconds,seconds,envelope_seconds,visible,parts,envelope_faces,edge_on,outcome\n";
  Log_plot plot("Visible surface, and lower envelope", "triangles", "seconds");
  bool ok = true;
  double least = 1e300;
  for (const std::string kind : {"soup_constant_density", "soup", "soup, edges 1/3", "city", "city_rotated", "terrain",
                                 "stacked", "menger_sponge", "grid"}) {
    std::size_t before = 0;
    for (const double n : {10.0, 30.0, 100.0, 300.0, 1e3, 3e3, 1e4, 3e4, 1e5}) {
      if (n > max_faces * 1.01 || (kind == "menger_sponge" && (n < 100 || n > 1000)) || (kind == "grid" && n > 1000))
        continue;
      const Polygon_soup soup = before_the_eye(envelope_scene(kind, static_cast<std::size_t>(n)));
      const std::size_t triangles = soup.face_count();
      if (triangles == before) continue;
      before = triangles;
      Ours ours{};
      Theirs theirs{};
      if (!bench::in_child<Ours>(ours, [&] {
            Ours r{};
            measure_ours(soup, r);
            return r;
          })) {
        fmt::print("{:<22} {:>9} FAILED\n", kind, triangles);
        ok = false;
        continue;
      }
      const double start = bench::now();
      const bool done = bench::in_child<Theirs>(theirs, [&] {
        alarm(static_cast<unsigned>(slow));
        return measure_envelope(soup);
      });
      const double waited = bench::now() - start;
      const bool late = !done && waited >= std::floor(slow);
      const std::string outcome = !done                ? late ? "envelope: stopped" : "envelope: crashed"
                                  : theirs.differ == 0 ? "same"
                                                       : fmt::format("{} DIFFER", theirs.differ);
      ok = ok && (!done || theirs.differ == 0);
      const double seconds = done ? theirs.seconds : waited;
      fmt::print("{:<22} {:>9} {:>9.5f} {:>9.5f} {:>11} {:>9} {:>9} {:>8} {:>8} {:>8} {:>8} {}\n", kind, triangles,
                 ours.scene, ours.surface, done || late ? fmt::format("{}{:.4f}", late ? "> " : "", seconds) : "-",
                 done || late ? fmt::format("{}{:.1f}", late ? "> " : "", seconds / ours.surface) : "-",
                 done || late ? fmt::format("{}{:.1f}", late ? "> " : "", seconds / (ours.surface + ours.scene)) : "-",
                 ours.visible, ours.parts, theirs.faces, ours.edge_on, outcome);
      std::fflush(stdout);
      csv += fmt::format("{},{},{:.6f},{:.6f},{:.6f},{},{},{},{},{}\n", kind, triangles, ours.scene, ours.surface,
                         done || late ? seconds : 0.0, ours.visible, ours.parts, theirs.faces, ours.edge_on, outcome);
      plot.add(kind + ", ours", static_cast<double>(triangles), ours.surface);
      if (done) {
        plot.add(kind + ", envelope", static_cast<double>(triangles), seconds);
        least = std::min(least, seconds / ours.surface);
      }
      if (late) break;
    }
  }
  fmt::print("envelope / ours at least {:.1f}\n", least);
  if (!folder.empty()) {
    std::ofstream(folder + "/see_envelope.csv") << csv;
    std::ofstream(folder + "/see_envelope.svg") << plot.text();
  }
  return ok;
}

}  // namespace

int main(int argc, char** argv) {
  double max_faces = 1e5, slow = 60;
  std::string folder;
  for (int i = 1; i < argc; i += 2) {
    const std::string option = argv[i];
    if (i + 1 < argc && option == "--max") max_faces = std::atof(argv[i + 1]);
    else if (i + 1 < argc && option == "--slow") slow = std::atof(argv[i + 1]);
    else if (i + 1 < argc && option == "--out") folder = argv[i + 1];
    else {
      std::cerr << "bench_see [--max FACES] [--slow SECONDS] [--out FOLDER]\n";
      return 2;
    }
  }
  const bool scaled = scaling(max_faces, folder), in_rooms = rooms(max_faces, folder),
             compared = envelopes(max_faces, slow, folder);
  return scaled && in_rooms && compared ? 0 : 1;
}
