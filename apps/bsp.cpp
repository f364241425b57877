// sightline bsp: builds the tree of a scene and says what it took.

#include "methods/methods.h"

#include <sightline/kernel/predicates.h>

namespace sightline::app {

struct Bsp_arguments {
  Common common;
  std::string kernel = "exact";
  unsigned candidates = 5;
};

static Exit run(const Bsp_arguments& arguments) {
  const Common& common = arguments.common;
  Scene scene = scene_of(common.read());
  Progress progress("building");
  Task task;
  task.bsp.candidates = arguments.candidates;
  task.bsp.seed = common.seed;
  task.bsp.threads = common.threads;
  task.bsp.progress = common.within_budget(progress);
  const Outcome outcome = run_method(arguments.kernel, scene, task);
  progress.clear();
  const Bsp_counters& c = outcome.tree;

  const Json result{{"nodes", c.nodes}, {"depth", c.depth}, {"splits", c.splits}, {"fragments", c.fragments}};
  const Json counters{{"kernel", arguments.kernel},       {"pieces", c.pieces},
                      {"free_planes", c.free_planes},     {"degenerate", c.degenerate},
                      {"polygon_tests", c.polygon_tests}, {"predicates", predicates_json(c.predicates)}};
  if (write_json(common, "bsp", scene, result, counters, {{"build", outcome.build_seconds}})) return Exit::done;
  scene_rows(scene);
  row("tree", fmt::format("{} nodes ({} on free planes), depth {}, {} fragments after {} splits", c.nodes,
                          c.free_planes, c.depth, c.fragments, c.splits));
  if (c.degenerate > 0) row("lost", fmt::format("{} fragments of fewer than three corners", c.degenerate));
  const auto share = [&](std::uint64_t n) {
    return c.predicates.total() == 0 ? 0.0 : 100.0 * static_cast<double>(n) / static_cast<double>(c.predicates.total());
  };
  if (arguments.kernel == "exact")
    row("sides",
        fmt::format("{}: {:.4g}% combinatorial, {:.4g}% by doubles, {:.2g}% in {} bits, {:.2g}% in GMP",
                    c.predicates.total(), share(c.predicates.combinatorial), share(c.predicates.filtered),
                    share(c.predicates.fixed), name(scene.predicates().arithmetic()), share(c.predicates.gmp)));
  else row("sides", std::to_string(c.predicates.total()));
  row("seconds", fmt::format("{:.3f} to build ({})", outcome.build_seconds, arguments.kernel));
  return Exit::done;
}

void add_bsp(Command program) {
  const Command command = program.add_command("bsp", "Builds the BSP tree of a scene: nodes, splits, depth, fragments");
  auto arguments = std::make_shared<Bsp_arguments>();
  arguments->common.add_to(command);
  command.add_option("--kernel", arguments->kernel, "arithmetic").check(one_of(kernel_names)).show_default();
  command.add_option("--candidates", arguments->candidates, "face planes tried for each node")
      .check(range(1, 1000))
      .show_default();
  command.set_action([arguments] { return run(*arguments); });
}

}  // namespace sightline::app
