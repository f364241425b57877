// compare order, compare bsp: kernels that build the same tree.

#include "compare.h"
#include "page.h"

#include <sightline/harness/compare/order_errors.h>

#include <iostream>

namespace sightline::app {

/// Faces and parts, farthest first.
static Json drawn_json(const std::vector<Drawn>& drawn) {
  Json all = Json::array();
  for (const Drawn& item : drawn) {
    Json points = Json::array();
    for (const Exact_point& p : item.fragment.vertices) points.push_back(point_json(p));
    all.push_back({item.fragment.face, std::move(points)});
  }
  return all;
}

/// All that is said of one kernel's order.
static Json judge_order(const std::string& kernel, Scene& scene, const Compare_arguments& arguments, const Task& task) {
  const Peak_memory memory;
  Task timed = task;
  timed.keep_fragments = false;
  const Outcome outcome = run_method(kernel, scene, timed);
  const std::uint64_t peak = memory.bytes();
  Json row{{"status", "done"},
           {"seconds", outcome.build_seconds + outcome.order_seconds},
           {"build_seconds", outcome.build_seconds},
           {"order_seconds", outcome.order_seconds},
           {"peak_bytes", peak},
           {"splits", outcome.tree.splits},
           {"fragments", outcome.tree.fragments},
           {"depth", outcome.tree.depth},
           {"predicates", predicates_json(outcome.tree.predicates)}};

  Json errors = Json::object();
  if (const std::optional<Lockstep> lockstep = run_lockstep(kernel, scene, task)) {
    errors["sides_asked"] = lockstep->asked;
    errors["sides_wrong"] = lockstep->opposite + lockstep->false_zero + lockstep->missed_zero;
    errors["sides_opposite"] = lockstep->opposite;
    errors["sides_false_zero"] = lockstep->false_zero;
    errors["sides_missed_zero"] = lockstep->missed_zero;
  }
  if (task.eye) {
    const Outcome drawn = run_method(kernel, scene, task);
    std::vector<Order_fragment> fragments;
    for (const Drawn& item : drawn.drawn) fragments.push_back(item.fragment);
    const Order_errors e = order_errors(scene, *task.eye, fragments, arguments.max_fragments);
    errors["fragments_degenerate"] = e.degenerate + drawn.tree.degenerate;
    errors["fragments_not_finite"] = drawn.not_finite;
    errors["pairs"] = e.pairs;
    errors["pairs_wrong"] = fragments.size() > arguments.max_fragments ? Json() : Json(e.wrong);
    errors["pairs_wrong_beyond_rounding"] =
        fragments.size() > arguments.max_fragments ? Json() : Json(e.wrong_beyond_rounding);
    errors["area_lost"] = nearest_double(e.lost);
    errors["area_overlapping"] = nearest_double(e.overlapping);
    errors["area_outside"] = nearest_double(e.outside);
    errors["tiles_exactly"] = e.lost == 0 && e.overlapping == 0 && e.outside == 0 && drawn.not_finite == 0;
  }
  row["errors"] = errors;
  if (arguments.says && task.eye) row["said"] = drawn_json(run_method(kernel, scene, task).drawn);
  return row;
}

static void print_orders(const Json& rows) {
  std::cout << fmt::format("{:<8} {:>9} {:>9} {:>9} {:>9} {:>12} {:>11} {:>15} {:>10} {:>10}\n", "kernel", "build s",
                           "order s", "peak MB", "splits", "sides wrong", "pairs wrong", "beyond rounding", "area lost",
                           "overlap");
  for (const Json& r : rows) {
    if (r["status"] != "done") {
      std::cout << fmt::format("{:<8} {}\n", r["kernel"].get<std::string>(), r["status"].get<std::string>());
      continue;
    }
    const Json& e = r["errors"];
    const auto count = [&](const char* key) {
      return !e.contains(key) || e[key].is_null() ? std::string("-") : std::to_string(e[key].get<std::uint64_t>());
    };
    const auto share = [&](const char* key) {
      return e.contains(key) ? fmt::format("{:.2g}", e[key].get<double>()) : std::string("-");
    };
    std::cout << fmt::format("{:<8} {:>9.4f} {:>9.5f} {:>9.1f} {:>9} {:>12} {:>11} {:>15} {:>10} {:>10}\n",
                             r["kernel"].get<std::string>(), r["build_seconds"].get<double>(),
                             r["order_seconds"].get<double>(), r["peak_bytes"].get<double>() / 1e6,
                             r["splits"].get<std::uint64_t>(), count("sides_wrong"), count("pairs_wrong"),
                             count("pairs_wrong_beyond_rounding"), share("area_lost"), share("area_overlapping"));
  }
}

namespace {

struct Order_trial : Trial {
  Compare_arguments arguments;
  Scene scene;
  Task task;

  Order_trial(const Compare_arguments& all, const Polygon_soup& soup) : arguments(all), scene(scene_of(soup)) {
    const Common& common = arguments.common;
    task.bsp.seed = common.seed;
    task.bsp.threads = common.threads == 0 ? 1 : common.threads;
    if (arguments.command == "order") task.eye = eye_of(arguments.eye, scene);
    for (const std::string& kernel : arguments.kernels)
      contestants.push_back({{{"kernel", kernel}, {"method", "bsp"}},
                             [this, kernel] { return judge_order(kernel, scene, arguments, task); }});
    right = [has_eye = task.eye.has_value()](const Json& r) {
      return !has_eye || (!(r["errors"]["pairs_wrong"].is_number() && r["errors"]["pairs_wrong"] != 0) &&
                          r["errors"]["tiles_exactly"] == true);
    };
  }
};

}  // namespace

std::unique_ptr<Trial> order_trial(const Compare_arguments& arguments, const Polygon_soup& soup) {
  return std::make_unique<Order_trial>(arguments, soup);
}

Exit compare_orders(const Compare_arguments& arguments) {
  const Common& common = arguments.common;
  const Order_trial trial(arguments, common.read());
  Json rows = Json::array();
  const Exit exit = ask(trial, common.budget, rows);
  if (!arguments.html.empty())
    write_comparison(arguments, trial.scene, rows, trial.task.eye ? &*trial.task.eye : nullptr);
  if (write_json(common, "compare", trial.scene, {{"question", arguments.command}, {"rows", rows}},
                 {{"threads", trial.task.bsp.threads}}, Json::object()))
    return exit;
  scene_rows(trial.scene);
  print_orders(rows);
  return exit;
}

}  // namespace sightline::app
