#pragma once
// The same tree and the same order by every kernel, behind one interface, so that each kernel is compiled once.

#include "../support/picture.h"

#include <sightline/algorithms/bsp/options.h>
#include <sightline/algorithms/bsp/traverse.h>
#include <sightline/algorithms/verify/order.h>

#include <optional>
#include <string>
#include <vector>

namespace sightline::app {

inline const std::vector<std::string> kernel_names{"exact", "epeck", "gmpq", "epick", "double", "float"};

struct Task {
  Bsp_options bsp;
  std::optional<Exact_point> eye;  ///< none: only build the tree
  /// Only what is in front of this plane (grid coordinates), by making it the root.
  std::optional<std::array<Integer, 4>> near;
  bool keep_fragments = true;
};

struct Outcome {
  Bsp_counters tree;
  Traversal_counters walk;
  double build_seconds = 0, order_seconds = 0;
  std::vector<Drawn> drawn;  ///< back to front
  Order_cuts cuts;           ///< of all that is drawn, unless something was left out
  /// Fragments of an inexact kernel with coordinates that are no numbers; they are left out.
  std::uint64_t not_finite = 0;
};

/// Builds the tree of a scene by the named kernel and walks it. The scene takes the near plane. Errors: Usage_error for
/// a name that is none.
Outcome run_method(const std::string& kernel, Scene& scene, const Task& task);

/// Sides that the kernel would have got wrong while the exact kernel builds its tree and walks it; nothing for kernels
/// whose numbers are exact.
struct Lockstep {
  std::uint64_t asked = 0, opposite = 0, false_zero = 0, missed_zero = 0;
};
std::optional<Lockstep> run_lockstep(const std::string& kernel, const Scene& scene, const Task& task);

}  // namespace sightline::app
