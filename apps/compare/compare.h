#pragma once
// What the questions of sightline compare share: who is asked, each in a process of its own, and how long it took in
// how much memory.

#include "../methods/methods.h"
#include "../methods/weak.h"
#include "../support/tints.h"

#include <sightline/harness/compare/process_memory.h>
#include <sightline/harness/judge/protocol.h>

namespace sightline::app {

struct Compare_arguments {
  Common common;
  std::string command = "order", eye;
  std::vector<std::string> kernels = kernel_names;
  bool kernels_given = false;
  std::size_t max_fragments = 3000;
  std::vector<std::uint32_t> sizes{256, 1024};
  std::vector<int> bits{16, 24, 32};
  std::vector<unsigned> samples{4};  ///< render: n x n rays a pixel
  double near = 0, far = 0;
  Source_arguments sources;
  std::vector<std::size_t> rays{100, 1000, 10000, 100000};
  Weak_task weak;
  std::string svg, html;
  std::string sightlines;  ///< pvs: a folder
  View_arguments view;
  Tint_arguments tints;
  std::string ray_file;
  std::size_t random = 1000;           ///< rays of each kind
  std::vector<Exact_ray> own_rays;     ///< of report's question trace: instead, where there are some
  std::optional<judge::Query> solids;  ///< of report's question boolean: what is asked of the scene's two solids
  /// Rows hold the answer too: of order, see, weak as "said"; of render, trace, cutset and pvs the faces that it has
  /// wrong as "wrong_faces": {"missing": {"faces", "name"}, "extra": the same, "words"}, of cutset and pvs "at", the
  /// viewpoint or a point of the cell, of trace "line": {"face", "from", "to"}, where there is one.
  bool says = false;
};

/// A row of the table: who is asked, and how to judge the answer, in a process of its own.
struct Contestant {
  Json name;  ///< "kernel", "method", and what else tells it from others
  std::function<Json()> judge;
};

/// A question about a scene, the truth about it, and who may be asked.
struct Trial {
  std::vector<Contestant> contestants;         ///< they refer to what the trial holds
  std::function<bool(const Json& row)> right;  ///< what is true of a row of one that claims to be exact

  virtual ~Trial() = default;
};
/// Trials of the questions, whatever the arguments name as SCENE. Errors: as the command has them; Out_of_budget where
/// the truth takes longer than the budget.
std::unique_ptr<Trial> order_trial(const Compare_arguments& arguments, const Polygon_soup& soup);
std::unique_ptr<Trial> see_trial(const Compare_arguments& arguments, const Polygon_soup& soup);
std::unique_ptr<Trial> weak_trial(const Compare_arguments& arguments, const Polygon_soup& soup);
std::unique_ptr<Trial> trace_trial(const Compare_arguments& arguments, const Polygon_soup& soup);
std::unique_ptr<Trial> pvs_trial(const Compare_arguments& arguments, const Polygon_soup& soup);
std::unique_ptr<Trial> render_trial(const Compare_arguments& arguments, const Polygon_soup& soup);

/// Asks a contestant in a child process, since an inexact kernel may do anything, for at most so many seconds (0: as
/// long as it takes) in so many bytes above what this process has (0: any); what became of it otherwise is the row's
/// status: "timed out", "out of memory", "crashed ...", "error: ...".
Json ask_apart(const Contestant& contestant, double seconds, std::uint64_t bytes = 0);

/// Asks all of them, each for at most the budget in seconds (0: none). What claims to be exact must be, as far as
/// `right` can tell from a row; a row whose status begins with "left out" was not asked.
Exit ask(const Trial& trial, double budget, Json& rows);

/// Whether the kernel of a row claims to be exact.
bool claims_to_be_exact(const Json& row);

Exit compare_orders(const Compare_arguments& arguments);
Exit compare_visible(const Compare_arguments& arguments);
Exit compare_weak(const Compare_arguments& arguments);
Exit compare_rays(const Compare_arguments& arguments);
Exit compare_cells(const Compare_arguments& arguments);
Exit compare_images(const Compare_arguments& arguments);

}  // namespace sightline::app
