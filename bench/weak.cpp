// Weak visibility: the random-triangle queries that others are measured with, and real rooms. Times of searches,
// certificates and checks. bench_weak [--max K] [--queries N] [--scenes FOLDER] [--sources N] [--out FOLDER]. --events:
// how events alone grow with a scene, and what is left out of them: [--max FACES] [--queries N] [--undivided]

#include "measure.h"

#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/soups.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/events/events.h>
#include <sightline/algorithms/weak_visibility/settle.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/io/read.h>
#include <sightline/algorithms/weak_visibility/search/line_search.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>

using namespace sightline;

namespace {

/// Published, or measured with others' code on a machine of this kind, mean milliseconds: a program with floats and
/// tolerances, and a prototype in doubles without proofs.
struct Others {
  std::size_t triangles;
  double floats, prototype;
};
constexpr Others others[] = {{10, 0.15, 0},  {20, 0.6, 0},  {50, 5.8, 0.06},  {100, 70, 0.7},
                             {200, 951, 37}, {300, 0, 127}, {400, 1700, 112}, {1000, 0, 136}};

std::string ratio(double theirs, double ours) { return theirs > 0 ? fmt::format("{:.1f}", theirs / ours) : "-"; }

void random_triangles(std::size_t most, std::size_t queries, std::ostream& csv) {
  fmt::print("random triangles between two squares, {} queries each, one core, milliseconds; every answer is checked\n",
             queries);
  fmt::print("{:>5} {:>9} {:>9} {:>9} {:>9} {:>8} {:>7} {:>10} {:>9} {:>9} {:>9} {:>9}\n", "k", "mean", "max",
             "prepare", "check", "visible", "hidden", "undecided", "cells", "leaves", "floats/", "proto/");
  csv << "k,mean_ms,max_ms,prepare_ms,check_ms,visible,hidden,undecided,cells,steps\n";
  for (const Others& other : others) {
    if (other.triangles > most) break;
    double total = 0, worst = 0, prepare = 0, check = 0;
    std::size_t steps = 0;
    std::array<std::size_t, 3> answers{};
    Weak_counters counters;
    for (std::size_t t = 0; t < queries; ++t) {
      const Polygon_soup soup = generate::triangles_between_squares(other.triangles, t);
      const Scene scene(soup);
      const double start = bench::now();
      const Occluders occluders(scene);
      const Weak_source source = weak_source(occluders, 0);
      const double ready = bench::now();
      Weak_search_options options;
      Line_search search(occluders, source.polygon, source.plane, occluders.polygon(1), 1, options);
      Weak_answer answer = search.run(counters);
      const double found = bench::now();
      prepare += ready - start;
      total += found - ready;
      worst = std::max(worst, found - ready);
      ++answers[static_cast<std::size_t>(answer.status)];
      steps += answer.all_steps().size();
      // A certificate for this pair alone: nothing is claimed about other faces.
      Weakly_visible all;
      for (Face_id f = 0; f < soup.face_count(); ++f)
        if (f != 1 || answer.status == Weak_status::undecided) all.undecided.push_back(f);
      if (answer.status != Weak_status::undecided) all.pairs.push_back({1, 0, std::move(answer)});
      const Weak_certificate certificate =
          weak_certificate(scene, {scene.corner_points(scene.pieces()[0])}, false, all);
      const double written = bench::now();
      const Verdict verdict = verify_weak(soup, certificate);
      check += bench::now() - written;
      if (!verdict.accepted)
        throw std::logic_error(fmt::format("k = {}, query {}: {}", other.triangles, t, verdict.why));
    }
    const double n = static_cast<double>(queries), mean = 1e3 * total / n;
    fmt::print("{:>5} {:>9.3f} {:>9.2f} {:>9.3f} {:>9.2f} {:>8} {:>7} {:>10} {:>9} {:>9} {:>9} {:>9}\n",
               other.triangles, mean, 1e3 * worst, 1e3 * prepare / n, 1e3 * check / n, answers[1], answers[0],
               answers[2], counters.cells / queries, steps / queries, ratio(other.floats, mean),
               ratio(other.prototype, mean));
    csv << fmt::format("{},{},{},{},{},{},{},{},{},{}\n", other.triangles, mean, 1e3 * worst, 1e3 * prepare / n,
                       1e3 * check / n, answers[1], answers[0], answers[2], counters.cells, steps);
    std::fflush(stdout);
  }
}

/// All faces of a scene from some of its faces, in their order, evenly spread.
void rooms(const std::filesystem::path& folder, std::size_t count, std::ostream& csv) {
  fmt::print("rooms of others, all faces from {} faces each, one core, seconds\n", count);
  fmt::print("{:>28} {:>6} {:>9} {:>9} {:>9} {:>9} {:>8} {:>9} {:>10} {:>9}\n", "scene", "faces", "mean", "max",
             "check", "find/", "visible", "by events", "undecided", "cells");
  csv << "scene,faces,mean_s,max_s,check_s,visible,by_events,undecided,cells\n";
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".qoff") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    const Polygon_soup soup = read_scene(file);
    const Scene scene(soup);
    const Occluders occluders(scene);
    double total = 0, worst = 0, check = 0;
    std::size_t visible = 0, by_events = 0, undecided = 0;
    Weak_counters counters;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t piece = (2 * k + 1) * scene.pieces().size() / (2 * count);
      Weak_options options;
      options.threads = 1;
      const double start = bench::now();
      const std::vector<Weak_source> sources{weak_source(occluders, static_cast<std::uint32_t>(piece))};
      Weakly_visible found = weakly_visible(occluders, sources, options);
      search_thoroughly(occluders, sources, options, found);
      by_events += found.undecided.size();
      Events_options events;
      events.threads = 1;
      settle_by_events(occluders, sources, 300, events, found);  // as the program does
      const double end = bench::now();
      total += end - start;
      worst = std::max(worst, end - start);
      visible += found.visible.size();
      undecided += found.undecided.size();
      by_events -= found.undecided.size();
      counters += found.counters;
      const Weak_certificate certificate =
          weak_certificate(scene, {scene.corner_points(scene.pieces()[piece])}, false, found);
      const double written = bench::now();
      const Verdict verdict = verify_weak(soup, certificate);
      check += bench::now() - written;
      if (!verdict.accepted) throw std::logic_error(fmt::format("{}, piece {}: {}", file.string(), piece, verdict.why));
    }
    const double n = static_cast<double>(count);
    fmt::print("{:>28} {:>6} {:>9.3f} {:>9.3f} {:>9.3f} {:>9.2f} {:>8} {:>9} {:>10} {:>9}\n", file.stem().string(),
               scene.counters().faces, total / n, worst, check / n, total / check, visible / count, by_events,
               undecided, counters.cells / count);
    csv << fmt::format("{},{},{},{},{},{},{},{},{}\n", file.stem().string(), scene.counters().faces, total / n, worst,
                       check / n, visible, by_events, undecided, counters.cells);
    std::fflush(stdout);
  }
}

// ---- Events alone

/// n bars along x at height 4 and n along y at height 6, with gaps of two thirds of a bar, between a small lamp, face
/// 0, and a ceiling of 2 n x 2 n squares.
Polygon_soup grids(std::size_t n, std::uint64_t) {
  const long count = static_cast<long>(n);
  const Rational lamp = generate::ratio(1, 10 * count);
  generate::Faces faces{generate::rectangle(-lamp, lamp, -lamp, lamp, 0)};
  for (long k = 0; k < count; ++k) {
    const Rational low = generate::ratio(2 * k - count, count), high = low + generate::ratio(6, 5 * count);
    faces.push_back(generate::rectangle(-2, 2, low, high, 4));
    faces.push_back(generate::rectangle(low, high, -2, 2, 6));
  }
  const auto at = [&](long k) { return generate::ratio(k - count, count); };
  for (long i = 0; i < 2 * count; ++i)
    for (long k = 0; k < 2 * count; ++k)
      faces.push_back(generate::reversed(generate::rectangle(at(i), at(i + 1), at(k), at(k + 1), 10)));
  return generate::soup_of(faces);
}

/// All faces by events, from face 0 or from faces in order, evenly spread; means, and what the time went to.
void events_alone(std::size_t most, std::size_t queries, bool undivided, std::ostream& csv) {
  struct Family {
    const char* name;
    std::vector<std::size_t> sizes;
    bool from_first;
    std::function<Polygon_soup(std::size_t, std::uint64_t)> make;
  };
  const std::vector<Family> families{
      {"triangles", {25, 50, 100, 200, 400}, true, generate::triangles_between_squares},
      {"grids", {4, 8, 16, 32}, true, grids},
      {"rooms", {1, 2, 4, 8}, false, [](std::size_t n, std::uint64_t t) { return generate::rooms(n, n, t); }},
      {"city", {10, 40, 160, 640}, false, [](std::size_t n, std::uint64_t t) { return generate::city(n, t, true); }}};
  fmt::print("all faces by events alone, {} sources each, one core, seconds; counts are means\n", queries);
  fmt::print("{:>10} {:>5} {:>6} {:>9} {:>9} {:>8} {:>8} {:>9} {:>8} {:>8} {:>6} {:>8} {:>9} {:>9} {:>9} {:>8}\n",
             "scene", "size", "faces", "mean", "max", "visible", "hidden", "undecided", "shafts", "covered", "left",
             "pencils", "triples", "nowhere", "blocked", "cells");
  csv << "scene,size,faces,mean_s,max_s,visible,hidden,undecided,shafts,shafts_covered,shafts_left,pencils,triples,"
         "nowhere,blocked,cells\n";
  for (const Family& family : families)
    for (const std::size_t size : family.sizes) {
      double total = 0, worst = 0;
      std::size_t faces = 0;
      std::array<std::size_t, 3> answers{};
      Event_counters sum;
      for (std::size_t t = 0; t < queries; ++t) {
        const Polygon_soup soup = family.make(size, t + 1);
        const Scene scene(soup);
        faces = scene.counters().faces;
        if (faces > most) break;
        const Occluders occluders(scene);
        const std::size_t from = family.from_first ? 0 : (2 * t + 1) * scene.pieces().size() / (2 * queries);
        Events_options options;
        options.threads = 1;
        if (undivided) options.undivided = std::numeric_limits<std::size_t>::max();
        const double start = bench::now();
        const Weakly_visible_by_events found =
            weakly_visible_by_events(occluders, {weak_source(occluders, static_cast<std::uint32_t>(from))}, options);
        const double seconds = bench::now() - start;
        total += seconds;
        worst = std::max(worst, seconds);
        answers[0] += found.visible.size();
        answers[1] += found.hidden.size();
        answers[2] += found.undecided.size();
        sum += found.counters;
      }
      if (faces > most) break;
      const std::array<std::size_t, 11> columns{answers[0],
                                                answers[1],
                                                answers[2],
                                                sum.shafts,
                                                sum.shafts_covered + sum.shafts_together,
                                                sum.shafts_left,
                                                sum.horizon + sum.edge_vertex,
                                                sum.triple,
                                                sum.off_edges + sum.off_polygons,
                                                sum.covered,
                                                sum.cells};
      const auto mean = [&](std::size_t k) { return columns[k] / queries; };
      const double n = static_cast<double>(queries);
      fmt::print(
          "{:>10} {:>5} {:>6} {:>9.4f} {:>9.4f} {:>8} {:>8} {:>9} {:>8} {:>8} {:>6} {:>8} {:>9} {:>9} {:>9} {:>8}\n",
          family.name, size, faces, total / n, worst, mean(0), mean(1), mean(2), mean(3), mean(4), mean(5), mean(6),
          mean(7), mean(8), mean(9), mean(10));
      csv << fmt::format("{},{},{},{},{}", family.name, size, faces, total / n, worst);
      for (std::size_t k = 0; k < columns.size(); ++k) csv << ',' << mean(k);
      csv << '\n';
      std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Weak visibility: random triangles, and real rooms");
  std::size_t most = 1000, queries = 40, sources = 10;
  std::string scenes, out;
  app.add_option("--max", most, "the most triangles")->capture_default_str();
  app.add_option("--queries", queries, "for each number of triangles")->capture_default_str();
  app.add_option("--scenes", scenes, "a folder of .qoff files, instead of random triangles");
  app.add_option("--sources", sources, "faces of each scene that look")->capture_default_str();
  app.add_option("--out", out, "a folder for CSV");
  bool events = false, undivided = false;
  app.add_flag("--events", events, "events alone, as scenes grow, instead");
  app.add_flag("--undivided", undivided, "with --events: shafts are searched whole");
  CLI11_PARSE(app, argc, argv);
  std::ofstream csv;
  if (!out.empty())
    csv.open(std::filesystem::path(out) / (events           ? "weak_events.csv"
                                           : scenes.empty() ? "weak_triangles.csv"
                                                            : "weak_rooms.csv"));
  if (events) events_alone(most, queries, undivided, csv);
  else if (scenes.empty()) random_triangles(most, queries, csv);
  else rooms(scenes, sources, csv);
}
