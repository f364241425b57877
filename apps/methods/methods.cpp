#include "methods_of.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

namespace sightline::app {

Outcome run_epeck(const Scene& scene, const Task& task, std::optional<Plane> near) {
  return run_points<CGAL::Epeck>(scene, task, near);
}

Outcome run_method(const std::string& kernel, Scene& scene, const Task& task) {
  std::optional<Plane> near;
  if (task.near) near = scene.add_plane(*task.near);
  if (kernel == "exact") {
    Bsp_options options = task.bsp;
    if (near) options.first.push_back(*near);
    return run_traits(scene, Exact_traits(scene), task, options);
  }
  if (kernel == "epeck") return run_epeck(scene, task, near);
  if (kernel == "gmpq") return run_gmpq(scene, task, near);
  if (kernel == "epick") return run_epick(scene, task, near);
  if (kernel == "double") return run_double(scene, task, near);
  if (kernel == "float") return run_float(scene, task, near);
  throw Usage_error("no kernel '" + kernel + "'");
}

}  // namespace sightline::app
