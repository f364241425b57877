// compare weak: what polygons see, by lines, events, one blocker alone, doubles, and rays.

#include "compare.h"
#include "page.h"

#include <sightline/harness/compare/weak_errors.h>
#include <sightline/io/plot.h>

#include <iostream>

namespace sightline::app {

/// A method's answer, and where it differs from the exact one.
static Json judge_weak(const std::string& method, const Occluders& occluders, const Sources& sources,
                       const Weak_task& task, const Weak_faces& exact, bool says) {
  const Peak_memory memory;
  const Stopwatch watch;
  const Weak_outcome outcome = run_weak_method(method, occluders, sources, task);
  const double seconds = watch.seconds();
  const Weak_errors e = weak_errors(exact, outcome.found);
  Json row{{"status", "done"},
           {"seconds", seconds},
           {"peak_bytes", memory.bytes()},
           {"visible", outcome.found.visible.size()},
           {"errors",
            {{"wrongly_visible", e.wrongly_visible},
             {"wrongly_hidden", e.wrongly_hidden},
             {"undecided", e.undecided},
             {"unjudged", e.unjudged}}}};
  if (says) row["said"] = outcome.found.visible;
  return row;
}

static std::string weak_name(const Json& r) {
  const std::string method = r["method"];
  return method == "sample" ? fmt::format("sample, {} rays", r["rays"].get<std::size_t>()) : method;
}

static void print_weak(const Json& rows) {
  const std::string line = "{:<22} {:>9} {:>9} {:>8} {:>16} {:>15} {:>10}\n";
  std::cout << fmt::format(fmt::runtime(line), "method", "seconds", "peak MB", "visible", "wrongly visible",
                           "wrongly hidden", "undecided");
  for (const Json& r : rows) {
    if (r["status"] != "done") {
      std::cout << fmt::format("{:<22} {}\n", weak_name(r), r["status"].get<std::string>());
      continue;
    }
    const Json& e = r["errors"];
    std::cout << fmt::format(fmt::runtime(line), weak_name(r), fmt::format("{:.4f}", r["seconds"].get<double>()),
                             fmt::format("{:.1f}", r["peak_bytes"].get<double>() / 1e6),
                             r["visible"].get<std::size_t>(), e["wrongly_visible"].get<std::size_t>(),
                             e["wrongly_hidden"].get<std::size_t>(), e["undecided"].get<std::size_t>());
  }
}

static std::string weak_plot(const Json& rows, const Canvas_arguments& canvas) {
  Log_plot plot("Faces seen from polygons: what methods cost, and get wrong", "seconds",
                "faces wrongly visible, wrongly hidden, or undecided");
  const auto [width, height] = canvas.size_or({860, 560});
  const std::string background = canvas.background_or("#ffffff");
  plot.set_canvas(width, height, background, ink_on(background));
  for (const Json& r : rows) {
    if (r["status"] != "done") continue;
    const Json& e = r["errors"];
    const std::string method = r["method"];
    plot.set_colour(method, colour_of_method(method));
    plot.add(method, r["seconds"].get<double>(),
             e["wrongly_visible"].get<double>() + e["wrongly_hidden"].get<double>() + e["undecided"].get<double>());
  }
  return plot.text();
}

namespace {

struct Weak_trial : Trial {
  Compare_arguments arguments;
  Scene scene;
  Stopwatch watch;
  Occluders occluders;
  Sources sources;
  double prepare_seconds;
  Weak_task task;
  Weak_faces exact;

  Weak_trial(const Compare_arguments& all, const Polygon_soup& soup)
      : arguments(all),
        scene(scene_of(soup)),
        occluders(scene),
        sources(sources_of(arguments.sources, arguments.common, soup, occluders, arguments.common.within_budget())),
        prepare_seconds(watch.seconds()),
        task(arguments.weak) {
    // 1. What all are compared with: lines, then events; on one thread, since processes are made after it.
    const Common& common = arguments.common;
    task.two_sided = arguments.sources.two_sided;
    task.seed = common.seed;
    Weak_task alone = task;
    alone.threads = 1;
    alone.out_of_time = Time_limit(common.budget).end();
    exact = run_weak_method("lines", occluders, sources, alone).found;

    // 2. Who is asked.
    task.threads = common.threads == 0 ? 1 : common.threads;
    std::size_t edges = 0;  // that events would have to do with at most
    for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece)
      for (const Weak_source& source : sources.polygons)
        edges = std::max(edges, edges_between(occluders, source, piece));
    add("exact", "lines");
    add("exact", "events");
    if (is_asked("exact") && edges > task.event_edges)
      contestants.back().judge = [edges, most = task.event_edges] {
        return Json{{"status", fmt::format("left out: {} edges near a pair, --event-edges allows {}", edges, most)}};
      };
    add("exact", "conservative");
    add("double", "doubles");
    for (const std::size_t rays : arguments.rays) {
      if (!is_asked("double")) break;
      Weak_task sampling = task;
      sampling.rays = rays;
      contestants.push_back({{{"kernel", "double"}, {"method", "sample"}, {"rays", rays}}, [this, sampling] {
                               return judge_weak("sample", occluders, sources, sampling, exact, arguments.says);
                             }});
    }
    right = [](const Json& r) {
      return r["errors"]["wrongly_hidden"] == 0 &&
             (r["method"] == "conservative" || r["errors"]["wrongly_visible"] == 0);
    };
  }

  bool is_asked(const std::string& kernel) const {
    return std::find(arguments.kernels.begin(), arguments.kernels.end(), kernel) != arguments.kernels.end();
  }
  void add(const std::string& kernel, const std::string& method) {
    if (is_asked(kernel))
      contestants.push_back({{{"kernel", kernel}, {"method", method}}, [this, method] {
                               return judge_weak(method, occluders, sources, task, exact, arguments.says);
                             }});
  }
};

}  // namespace

std::unique_ptr<Trial> weak_trial(const Compare_arguments& arguments, const Polygon_soup& soup) {
  return std::make_unique<Weak_trial>(arguments, soup);
}

Exit compare_weak(const Compare_arguments& arguments) {
  const Common& common = arguments.common;
  if (arguments.kernels_given)
    for (const std::string& kernel : arguments.kernels)
      if (kernel != "exact" && kernel != "double")
        throw Usage_error("--kernels: weak knows exact and double, not " + kernel);
  const Weak_trial trial(arguments, common.read());
  const Weak_faces& exact = trial.exact;
  Json rows = Json::array();
  Exit exit = ask(trial, common.budget, rows);
  if (exit == Exit::done && !exact.undecided.empty()) exit = Exit::undecided;
  if (!arguments.html.empty()) write_comparison(arguments, trial.scene, rows, nullptr, &exact.visible);
  if (!arguments.svg.empty()) write_file(arguments.svg, weak_plot(rows, arguments.view.canvas));
  Json result{{"question", "weak"},
              {"visible", exact.visible.size()},
              {"hidden", exact.hidden.size()},
              {"undecided", exact.undecided.size()},
              {"rows", rows}};
  if (write_json(common, "compare", trial.scene, std::move(result), {{"threads", trial.task.threads}},
                 {{"prepare", trial.prepare_seconds}}))
    return exit;
  scene_rows(trial.scene);
  row("sources", fmt::format("{} convex polygons", trial.sources.polygons.size()));
  row("exact", fmt::format("{} visible, {} hidden, {} undecided", exact.visible.size(), exact.hidden.size(),
                           exact.undecided.size()));
  print_weak(rows);
  return exit;
}

}  // namespace sightline::app
