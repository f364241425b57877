#pragma once
// What the questions of sightline compare share: who is asked, each in a process of its own, and how long it took in
// how much memory.

#include "../methods/methods.h"
#include "../methods/weak.h"
#include "../support/tints.h"

#include <sightline/harness/compare/process_memory.h>

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
  Source_arguments sources;
  std::vector<std::size_t> rays{100, 1000, 10000, 100000};
  Weak_task weak;
  std::string svg;
  View_arguments view;
  Tint_arguments tints;
  std::string ray_file;
  std::size_t random = 1000;  ///< rays of each kind
};

/// A row of the table: who is asked, and how to judge the answer, in a process of its own.
struct Contestant {
  Json name;  ///< "kernel", "method", and what else tells it from others
  std::function<Json()> judge;
};

/// Asks all of them, each for at most the budget in seconds (0: none). What claims to be exact must be, as far as
/// `right` can tell from a row; a row whose status begins with "left out" was not asked.
Exit ask(const std::vector<Contestant>& contestants, double budget, Json& rows,
         const std::function<bool(const Json&)>& right);

Exit compare_orders(const Compare_arguments& arguments);
Exit compare_visible(const Compare_arguments& arguments);
Exit compare_weak(const Compare_arguments& arguments);
Exit compare_rays(const Compare_arguments& arguments);
Exit compare_cells(const Compare_arguments& arguments);
Exit compare_images(const Compare_arguments& arguments);

}  // namespace sightline::app
