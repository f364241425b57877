#include "methods_of.h"

#include <CGAL/Cartesian.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

namespace sightline::app {

using Double = CGAL::Simple_cartesian<double>;
using Float = CGAL::Simple_cartesian<float>;

Outcome run_double(const Scene& scene, const Task& task, std::optional<Plane> near) {
  return run_points<Double>(scene, task, near);
}
Outcome run_float(const Scene& scene, const Task& task, std::optional<Plane> near) {
  return run_points<Float>(scene, task, near);
}
Outcome run_epick(const Scene& scene, const Task& task, std::optional<Plane> near) {
  return run_points<CGAL::Epick>(scene, task, near);
}
Outcome run_gmpq(const Scene& scene, const Task& task, std::optional<Plane> near) {
  return run_points<CGAL::Cartesian<CGAL::Gmpq>>(scene, task, near);
}

std::optional<Lockstep> run_lockstep(const std::string& kernel, const Scene& scene, const Task& task) {
  if (kernel == "epick") return run_in_lockstep<CGAL::Epick>(scene, task);
  if (kernel == "double") return run_in_lockstep<Double>(scene, task);
  if (kernel == "float") return run_in_lockstep<Float>(scene, task);
  return std::nullopt;
}

}  // namespace sightline::app
