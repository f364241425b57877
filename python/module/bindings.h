#pragma once
// What the module consists of: each source adds its part. Everything is named and explained for users in
// python/sightline; here C++ answers, and answers become arrays.

#include "exact.h"
#include "waiting.h"

#include <sightline/sightline.h>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace sightline::python {

/// Parts of faces, which stay in C++ until they are looked at.
struct Parts {
  std::size_t count = 0;
  std::function<const Part&(std::size_t)> at;
  std::function<bool(std::size_t)> from_front;  ///< where that is known
};

/// A certificate that is made when it is asked for.
struct Certifier {
  Answer answer;
};

template <class T>
py::array_t<std::int64_t> ids(const std::vector<T>& values) {
  py::array_t<std::int64_t> array(static_cast<py::ssize_t>(values.size()));
  std::copy(values.begin(), values.end(), array.mutable_data());
  return array;
}
/// An array of numbers that are already there, of one dimension or of points.
template <class T>
py::array_t<T> array_of(std::vector<T>&& values, bool of_points = false) {
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  const auto count = static_cast<py::ssize_t>(kept->size());
  T* const data = kept->data();
  const py::capsule owner(kept.release(), [](void* all) { delete static_cast<std::vector<T>*>(all); });
  if (of_points) return py::array_t<T>({count / 3, py::ssize_t{3}}, data, owner);
  return py::array_t<T>(count, data, owner);
}

/// Points as (n, 3) doubles, each the nearest.
py::array_t<double> rounded(const std::vector<Exact_point>& points);
/// All points of a soup as (n, 3): doubles, each the nearest, or objects: Fractions.
py::array points_of(const Polygon_soup& soup, bool exact);
/// Its faces: corners one loop after the other, where loops begin, and where faces begin among loops.
py::tuple faces_of(const Polygon_soup& soup);

inline std::vector<Model> models_of(const py::list& scenes) {
  std::vector<Model> models;
  for (const py::handle scene : scenes) models.push_back(py::cast<Model>(scene));
  return models;
}

/// The convex polygons that look: of a face of that number, or as given. Errors: IndexError where there is no such
/// face.
std::vector<std::vector<Exact_point>> sources_of(const Model& model, const py::object& source);

void add_scene(py::module_& module);
void add_answers(py::module_& module);
void add_solids_and_rays(py::module_& module);
void add_shadows(py::module_& module);
void add_pictures(py::module_& module);
void add_levels(py::module_& module);
void add_harness(py::module_& module);

}  // namespace sightline::python
