// sightline compare: the same question to several kernels and methods, each in a process of its own: time, memory, error.

#include "methods.h"

#include <sightline/algorithms/compare/order_errors.h>
#include <sightline/algorithms/compare/visible_errors.h>

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iostream>

namespace sightline::app {

struct Compare_arguments {
  Common common;
  std::string command = "order", eye;
  std::vector<std::string> kernels = kernel_names;
  bool kernels_given = false;
  std::size_t max_fragments = 3000;
  std::vector<std::uint32_t> sizes{256, 1024};
  std::vector<int> bits{16, 24, 32};
  double near = 0, far = 0;
};

/// A row of the table: who is asked, and how to judge the answer, in a process of its own.
struct Contestant {
  Json name;  ///< "kernel", "method", and what else tells it from others
  std::function<Json()> judge;
};

/// A value of /proc/self/status in bytes.
static std::uint64_t process_memory(const std::string& key) {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(key + ":")) return std::stoull(line.substr(key.size() + 1)) * 1024;
  return 0;
}

/// The peak of a process in bytes, above what it begins with.
class Peak_memory {
 public:
  Peak_memory() { std::ofstream("/proc/self/clear_refs") << 5, before_ = process_memory("VmRSS"); }  // forgets the parent's peak
  std::uint64_t bytes() const {
    const std::uint64_t peak = process_memory("VmHWM");
    return peak > before_ ? peak - before_ : 0;
  }

 private:
  std::uint64_t before_ = 0;
};

/// All that is said of one kernel's order.
static Json judge_order(const std::string& kernel, Scene& scene, const Compare_arguments& arguments, const Task& task) {
  const Peak_memory memory;
  Task timed = task;
  timed.keep_fragments = false;
  const Outcome outcome = run_method(kernel, scene, timed);
  const std::uint64_t peak = memory.bytes();
  Json row{{"status", "done"}, {"seconds", outcome.build_seconds + outcome.order_seconds},
           {"build_seconds", outcome.build_seconds}, {"order_seconds", outcome.order_seconds}, {"peak_bytes", peak},
           {"splits", outcome.tree.splits}, {"fragments", outcome.tree.fragments}, {"depth", outcome.tree.depth}, {"predicates", predicates_json(outcome.tree.predicates)}};

  Json errors = Json::object();
  if (const std::optional<Lockstep> lockstep = run_lockstep(kernel, scene, task)) {
    errors["sides_asked"] = lockstep->asked, errors["sides_wrong"] = lockstep->opposite + lockstep->false_zero + lockstep->missed_zero;
    errors["sides_opposite"] = lockstep->opposite, errors["sides_false_zero"] = lockstep->false_zero, errors["sides_missed_zero"] = lockstep->missed_zero;
  }
  if (task.eye) {
    const Outcome drawn = run_method(kernel, scene, task);
    std::vector<Order_fragment> fragments;
    for (const Drawn& item : drawn.drawn) fragments.push_back(item.fragment);
    const Order_errors e = order_errors(scene, *task.eye, fragments, arguments.max_fragments);
    errors["fragments_degenerate"] = e.degenerate + drawn.tree.degenerate, errors["fragments_not_finite"] = drawn.not_finite;
    errors["pairs"] = e.pairs;
    errors["pairs_wrong"] = fragments.size() > arguments.max_fragments ? Json() : Json(e.wrong);
    errors["pairs_wrong_beyond_rounding"] = fragments.size() > arguments.max_fragments ? Json() : Json(e.wrong_beyond_rounding);
    errors["area_lost"] = nearest_double(e.lost), errors["area_overlapping"] = nearest_double(e.overlapping), errors["area_outside"] = nearest_double(e.outside);
    errors["tiles_exactly"] = e.lost == 0 && e.overlapping == 0 && e.outside == 0 && drawn.not_finite == 0;
  }
  row["errors"] = errors;
  return row;
}

/// All that is said of a visible surface.
static Json visible_json(const Visible_errors& e) {
  return {{"wrong_area", e.wrong}, {"tied_area", e.tied}, {"wrongly_visible", e.wrongly_visible}, {"wrongly_hidden", e.wrongly_hidden}, {"missing", e.missing},
          {"largest_missing", e.largest_missing}, {"gaps", e.gaps}, {"overlaps", e.overlaps}, {"not_finite", e.not_finite}};
}
template <class Make_view>
Json judge_view(Make_view make, const Scene& scene, const Visible_options& options, Visible_reference& reference) {
  const Peak_memory memory;
  const Stopwatch watch;
  const Piece_boxes boxes(scene);
  const auto view = make();
  const auto surface = visible_surface(view, boxes, options);
  const double seconds = watch.seconds();
  Json row{{"status", "done"}, {"seconds", seconds}, {"peak_bytes", memory.bytes()}, {"visible", surface.visible.size()}, {"parts", surface.parts.size()}};
  row["errors"] = visible_json(reference.errors(view, surface));
  return row;
}
static Json judge_kernel(const std::string& kernel, const Scene& scene, const Exact_point& eye, const Visible_options& options, Visible_reference& reference) {
  const auto with = [&](auto make) { return judge_view(make, scene, options, reference); };
  if (kernel == "exact") return with([&] { return Exact_view(scene, eye); });
  if (kernel == "double") return with([&] { return Number_view<double>(scene, eye); });
  if (kernel == "float") return with([&] { return Number_view<float>(scene, eye); });
  if (kernel == "gmpq") return with([&] { return Number_view<CGAL::Gmpq>(scene, eye); });
  return with([&] { return Number_view<CGAL::Exact_predicates_exact_constructions_kernel::FT>(scene, eye); });
}
static Json judge_pixels(const Depth_buffer_options& options, const Scene& scene, const Exact_point& eye, Visible_reference& reference) {
  const Peak_memory memory;
  const Stopwatch watch;
  const Depth_buffer buffer = depth_buffer(scene, eye, options);
  const double seconds = watch.seconds();
  Json row{{"status", "done"}, {"seconds", seconds}, {"peak_bytes", memory.bytes()}, {"near", buffer.near}, {"far", buffer.far}, {"triangles", buffer.triangles}, {"clipped", buffer.clipped}};
  row["errors"] = visible_json(reference.errors(buffer));
  return row;
}

/// Asks a contestant in a child process, since an inexact kernel may do anything, for at most the budget; what became of it otherwise is the row's status.
static Json judge_apart(const Contestant& contestant, double limit) {
  const auto named = [&](const Json& row) {
    Json all = contestant.name;
    all.update(row);
    return all;
  };
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe to be had");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process to be had");
  if (child == 0) {
    close(ends[0]);
    std::string text;
    try {
      text = contestant.judge().dump();
    } catch (const std::exception& error) {
      text = Json{{"status", std::string("error: ") + error.what()}}.dump();
    }
    for (std::size_t written = 0; written < text.size();) {
      const ssize_t n = write(ends[1], text.data() + written, text.size() - written);
      if (n <= 0) break;
      written += static_cast<std::size_t>(n);
    }
    _exit(0);
  }
  close(ends[1]);
  const Stopwatch watch;
  std::string text, status = "crashed";
  for (;;) {
    pollfd waiting{ends[0], POLLIN, 0};
    const int left = limit > 0 ? static_cast<int>(std::clamp(1000 * (limit - watch.seconds()), 0.0, 1e9)) : -1;
    if (poll(&waiting, 1, left) == 0) {
      kill(child, SIGKILL);
      status = "timed out";
      break;
    }
    char buffer[4096];
    const ssize_t n = read(ends[0], buffer, sizeof buffer);
    if (n <= 0) break;
    text.append(buffer, static_cast<std::size_t>(n));
  }
  close(ends[0]);
  int how = 0;
  waitpid(child, &how, 0);
  if (status != "timed out") {
    if (Json row = Json::parse(text, nullptr, false); !row.is_discarded()) return named(row);
    if (WIFSIGNALED(how)) status += fmt::format(" (signal {})", WTERMSIG(how));
  }
  return named({{"status", status}});
}

static void print_orders(const Json& rows) {
  std::cout << fmt::format("{:<8} {:>9} {:>9} {:>9} {:>9} {:>12} {:>11} {:>15} {:>10} {:>10}\n", "kernel", "build s", "order s", "peak MB", "splits", "sides wrong",
                           "pairs wrong", "beyond rounding", "area lost", "overlap");
  for (const Json& r : rows) {
    if (r["status"] != "done") {
      std::cout << fmt::format("{:<8} {}\n", r["kernel"].get<std::string>(), r["status"].get<std::string>());
      continue;
    }
    const Json& e = r["errors"];
    const auto count = [&](const char* key) { return !e.contains(key) || e[key].is_null() ? std::string("-") : std::to_string(e[key].get<std::uint64_t>()); };
    const auto share = [&](const char* key) { return e.contains(key) ? fmt::format("{:.2g}", e[key].get<double>()) : std::string("-"); };
    std::cout << fmt::format("{:<8} {:>9.4f} {:>9.5f} {:>9.1f} {:>9} {:>12} {:>11} {:>15} {:>10} {:>10}\n", r["kernel"].get<std::string>(), r["build_seconds"].get<double>(),
                             r["order_seconds"].get<double>(), r["peak_bytes"].get<double>() / 1e6, r["splits"].get<std::uint64_t>(), count("sides_wrong"), count("pairs_wrong"),
                             count("pairs_wrong_beyond_rounding"), share("area_lost"), share("area_overlapping"));
  }
}

static void print_visible(const Json& rows) {
  const std::string line = "{:<25} {:>8} {:>8} {:>10} {:>8} {:>15} {:>14} {:>7} {:>15} {:>8} {:>8}\n";
  std::cout << fmt::format(fmt::runtime(line), "method", "seconds", "peak MB", "wrong area", "tied", "wrongly visible", "wrongly hidden", "missing", "largest missing", "gaps", "overlaps");
  for (const Json& r : rows) {
    const std::string name = r["method"] == "depth buffer" ? fmt::format("depth buffer {}, {} bit", r["size"].get<int>(), r["bits"].get<int>()) : r["kernel"].get<std::string>();
    if (r["status"] != "done") {
      std::cout << fmt::format("{:<25} {}\n", name, r["status"].get<std::string>());
      continue;
    }
    const Json& e = r["errors"];
    const auto share = [&](const char* key) { return fmt::format("{:.2g}", e[key].get<double>()); };
    const auto count = [&](const char* key) { return std::to_string(e[key].get<std::uint64_t>()); };
    std::cout << fmt::format(fmt::runtime(line), name, fmt::format("{:.4f}", r["seconds"].get<double>()), fmt::format("{:.1f}", r["peak_bytes"].get<double>() / 1e6), share("wrong_area"), share("tied_area"),
                             count("wrongly_visible"), count("wrongly_hidden"), count("missing"), share("largest_missing"), share("gaps"), share("overlaps"));
  }
}

static bool is_exact(const Json& row) { return row["kernel"] == "exact" || row["kernel"] == "epeck" || row["kernel"] == "gmpq"; }

/// Asks all of them. What claims to be exact must be, as far as `right` can tell from a row.
static Exit ask(const std::vector<Contestant>& contestants, double budget, Json& rows, const std::function<bool(const Json&)>& right) {
  bool disagree = false, undecided = false;
  for (const Contestant& contestant : contestants) {
    rows.push_back(judge_apart(contestant, budget));
    const Json& r = rows.back();
    if (!is_exact(r)) continue;
    if (r["status"] == "timed out") undecided = true;
    else if (r["status"] != "done" || !right(r)) disagree = true;
  }
  return disagree ? Exit::disagreement : undecided ? Exit::undecided : Exit::done;
}

static Exit compare_orders(const Compare_arguments& arguments) {
  const Common& common = arguments.common;
  Scene scene(common.read());
  Task task;
  task.bsp.seed = common.seed, task.bsp.threads = common.threads == 0 ? 1 : common.threads;
  if (arguments.command == "order") task.eye = eye_of(arguments.eye, scene);
  std::vector<Contestant> contestants;
  for (const std::string& kernel : arguments.kernels)
    contestants.push_back({{{"kernel", kernel}, {"method", "bsp"}}, [&scene, &arguments, &task, kernel] { return judge_order(kernel, scene, arguments, task); }});
  Json rows = Json::array();
  const Exit exit = ask(contestants, common.budget, rows, [&](const Json& r) {
    return !task.eye || (!(r["errors"]["pairs_wrong"].is_number() && r["errors"]["pairs_wrong"] != 0) && r["errors"]["tiles_exactly"] == true);
  });
  if (write_json(common, "compare", scene, {{"question", arguments.command}, {"rows", rows}}, {{"threads", task.bsp.threads}}, Json::object())) return exit;
  scene_rows(scene);
  print_orders(rows);
  return exit;
}

static Exit compare_visible(const Compare_arguments& arguments) {
  const Common& common = arguments.common;
  if (arguments.kernels_given && std::find(arguments.kernels.begin(), arguments.kernels.end(), "epick") != arguments.kernels.end())
    throw Usage_error("--kernels: epick answers order and bsp only; its constructions are those of double");
  const Scene scene(common.read());
  const Exact_point eye = eye_of(arguments.eye, scene);
  Visible_options options;
  options.threads = common.threads == 0 ? 1 : common.threads;

  // What all are compared with; on one thread, since processes are made after it.
  Visible_options alone;
  alone.threads = 1;
  alone.progress = common.within_budget([](std::size_t, std::size_t) {});
  const Piece_boxes boxes(scene);
  const Exact_view view(scene, eye);
  const auto surface = visible_surface(view, boxes, alone);
  Visible_reference reference(view, surface);

  std::vector<Contestant> contestants;
  for (const std::string& kernel : arguments.kernels)
    if (kernel != "epick") contestants.push_back({{{"kernel", kernel}, {"method", "partition"}}, [&, kernel] { return judge_kernel(kernel, scene, eye, options, reference); }});
  for (const std::uint32_t size : arguments.sizes)
    for (const int bits : arguments.bits) {
      const Depth_buffer_options pixels{size, bits, static_cast<float>(arguments.near), static_cast<float>(arguments.far)};
      contestants.push_back({{{"kernel", "float"}, {"method", "depth buffer"}, {"size", size}, {"bits", bits}}, [&, pixels] { return judge_pixels(pixels, scene, eye, reference); }});
    }
  Json rows = Json::array();
  const Exit exit = ask(contestants, common.budget, rows, [](const Json& r) {
    const Json& e = r["errors"];
    for (const char* key : {"wrongly_visible", "wrongly_hidden", "missing", "not_finite"})
      if (e[key] != 0) return false;
    return e["wrong_area"] < 1e-12;  // a sum of areas in doubles
  });
  if (write_json(common, "compare", scene, {{"question", "see"}, {"eye", point_json(eye)}, {"visible", surface.visible.size()}, {"rows", rows}}, {{"threads", options.threads}}, Json::object())) return exit;
  scene_rows(scene);
  row("eye", fmt::format("({}, {}, {})", to_string(eye[0]), to_string(eye[1]), to_string(eye[2])));
  row("visible", fmt::format("{} of {} faces", surface.visible.size(), scene.counters().faces));
  print_visible(rows);
  return exit;
}

}  // namespace sightline::app

void add_compare(CLI::App& app) {
  using namespace sightline::app;
  CLI::App* command = app.add_subcommand("compare", "The same question to several kernels and methods: seconds, memory, and errors against exact");
  auto a = std::make_shared<Compare_arguments>();
  a->common.add_to(*command);
  command->add_option("COMMAND", a->command, "the question")->check(CLI::IsMember({"order", "bsp", "see"}))->capture_default_str();
  command->add_option("--eye", a->eye, "the eye X,Y,Z, for order and see; by default a place outside the scene")->check(not_empty);
  CLI::Option* kernels = command->add_option("--kernels", a->kernels, "which kernels, with commas; see asks all but epick")->delimiter(',')->check(CLI::IsMember(kernel_names))->capture_default_str();
  command->add_option("--max-fragments", a->max_fragments, "order: compare all pairs up to this many fragments")->check(sightline::app::whole_number)->capture_default_str();
  command->add_option("--sizes", a->sizes, "see: depth buffers of so many pixels along each side of a cube, with commas")->delimiter(',')->check(sightline::app::whole_number)->check(CLI::Range(1, 16384))->capture_default_str();
  command->add_option("--bits", a->bits, "see: bits of their depths, with commas; 32: floats")->delimiter(',')->check(sightline::app::whole_number)->check(CLI::Range(1, 32))->capture_default_str();
  command->add_option("--near", a->near, "see: their near plane; by default from the scene's box, at least 1/4096 of the far one")->check(sightline::app::finite_number)->check(CLI::PositiveNumber);
  command->add_option("--far", a->far, "see: their far plane; by default from the scene's box")->check(sightline::app::finite_number)->check(CLI::PositiveNumber);
  command->footer("order, bsp. sides wrong: of the exact kernel's own queries, those that the kernel answers differently (asked of inexact kernels).\n"
                  "pairs wrong: overlapping fragments drawn in the wrong order; beyond rounding: by more than 2^-20 of the distance.\n"
                  "see. Areas are shares of the sphere of directions. wrong area: another face is shown than the exact one, or none; tied: another one of its plane that is there too;\n"
                  "wrongly visible, wrongly hidden: faces, against the exact list; missing: visible faces that are shown nowhere, with the largest area of one;\n"
                  "gaps, overlaps: directions with no part, and with two. Example: sightline compare town.off see --sizes 512,2048 --bits 24\n"
                  "--budget is for each kernel. Threads: 1 unless given. Exit code 1: a kernel that claims to be exact was not.");
  set_action(*command, [a, kernels] {
    a->kernels_given = kernels->count() > 0;
    return a->command == "see" ? compare_visible(*a) : compare_orders(*a);
  });
}
