// sightline compare: the same question to several kernels, each in a process of its own: time, memory, error.

#include "methods.h"

#include <sightline/algorithms/compare/order_errors.h>

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
  std::size_t max_fragments = 3000;
};

/// A value of /proc/self/status in bytes.
static std::uint64_t process_memory(const std::string& key) {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(key + ":")) return std::stoull(line.substr(key.size() + 1)) * 1024;
  return 0;
}

/// All that is said of one kernel. Runs in a child process, since an inexact kernel may do anything.
static Json judge(const std::string& kernel, Scene& scene, const Compare_arguments& arguments, const Task& task) {
  std::ofstream("/proc/self/clear_refs") << 5;  // forget the parent's peak
  const std::uint64_t before = process_memory("VmRSS");
  Task timed = task;
  timed.keep_fragments = false;
  const Outcome outcome = run_method(kernel, scene, timed);
  const std::uint64_t peak = process_memory("VmHWM");
  Json row{{"kernel", kernel}, {"method", "bsp"}, {"status", "done"}, {"seconds", outcome.build_seconds + outcome.order_seconds},
           {"build_seconds", outcome.build_seconds}, {"order_seconds", outcome.order_seconds}, {"peak_bytes", peak > before ? peak - before : 0},
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

/// Runs judge() in a child, for at most the budget; what became of it otherwise is the row's status.
static Json judge_apart(const std::string& kernel, Scene& scene, const Compare_arguments& arguments, const Task& task) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe to be had");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process to be had");
  if (child == 0) {
    close(ends[0]);
    std::string text;
    try {
      text = judge(kernel, scene, arguments, task).dump();
    } catch (const std::exception& error) {
      text = Json{{"kernel", kernel}, {"method", "bsp"}, {"status", std::string("error: ") + error.what()}}.dump();
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
  const double limit = arguments.common.budget;
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
    if (Json row = Json::parse(text, nullptr, false); !row.is_discarded()) return row;
    if (WIFSIGNALED(how)) status += fmt::format(" (signal {})", WTERMSIG(how));
  }
  return {{"kernel", kernel}, {"method", "bsp"}, {"status", status}};
}

static void print(const Json& rows) {
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

static Exit run(const Compare_arguments& arguments) {
  const Common& common = arguments.common;
  Scene scene(common.read());
  Task task;
  task.bsp.seed = common.seed, task.bsp.threads = common.threads == 0 ? 1 : common.threads;
  if (arguments.command == "order") task.eye = eye_of(arguments.eye, scene);
  Json rows = Json::array();
  bool disagree = false, undecided = false;
  for (const std::string& kernel : arguments.kernels) {
    rows.push_back(judge_apart(kernel, scene, arguments, task));
    const Json& r = rows.back();
    if (kernel != "exact" && kernel != "epeck" && kernel != "gmpq") continue;
    // What claims to be exact must be.
    if (r["status"] == "timed out") undecided = true;
    else if (r["status"] != "done") disagree = true;
    else if (task.eye && (r["errors"]["pairs_wrong"].is_number() && r["errors"]["pairs_wrong"] != 0)) disagree = true;
    else if (task.eye && r["errors"]["tiles_exactly"] != true) disagree = true;
  }
  const Exit exit = disagree ? Exit::disagreement : undecided ? Exit::undecided : Exit::done;
  if (write_json(common, "compare", scene, {{"question", arguments.command}, {"rows", rows}}, {{"threads", task.bsp.threads}}, Json::object())) return exit;
  scene_rows(scene);
  print(rows);
  return exit;
}

}  // namespace sightline::app

void add_compare(CLI::App& app) {
  using namespace sightline::app;
  CLI::App* command = app.add_subcommand("compare", "The same question to several kernels: seconds, memory, and errors against exact");
  auto a = std::make_shared<Compare_arguments>();
  a->common.add_to(*command);
  command->add_option("COMMAND", a->command, "the question")->check(CLI::IsMember({"order", "bsp"}))->capture_default_str();
  command->add_option("--eye", a->eye, "the eye X,Y,Z, for order; by default a place outside the scene")->check(not_empty);
  command->add_option("--kernels", a->kernels, "which kernels, with commas")->delimiter(',')->check(CLI::IsMember(kernel_names))->capture_default_str();
  command->add_option("--max-fragments", a->max_fragments, "compare all pairs up to this many fragments")->check(sightline::app::whole_number)->capture_default_str();
  command->footer("sides wrong: of the exact kernel's own queries, those that the kernel answers differently (asked of inexact kernels).\n"
                  "pairs wrong: overlapping fragments drawn in the wrong order; beyond rounding: by more than 2^-20 of the distance.\n"
                  "--budget is for each kernel. Threads: 1 unless given. Exit code 1: a kernel that claims to be exact was not.");
  set_action(*command, [a] { return run(*a); });
}
