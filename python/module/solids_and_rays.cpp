// Rays, and set operations on solids.

#include "bindings.h"

#include <sightline/algorithms/solids/measure.h>

#include <cmath>
#include <limits>
#include <memory>

namespace sightline::python {

namespace {

/// 1: met from the front, -1: from behind, 0: the ray runs along the face.
std::int8_t number_of(Met_side side) { return side == Met_side::front ? 1 : side == Met_side::back ? -1 : 0; }

Ray_start start_of(bool closed) { return closed ? Ray_start::closed : Ray_start::open; }

/// Columns of first hits: face or -1, side, whether others are met there too, t or nan.
struct Columns {
  explicit Columns(std::size_t rays)
      : faces(static_cast<py::ssize_t>(rays)),
        sides(static_cast<py::ssize_t>(rays)),
        tied(static_cast<py::ssize_t>(rays)),
        t(static_cast<py::ssize_t>(rays)) {}
  void set(std::size_t i, std::int64_t face, Met_side side, bool is_tied, double at) {
    const auto k = static_cast<py::ssize_t>(i);
    faces.mutable_at(k) = face;
    sides.mutable_at(k) = face < 0 ? std::int8_t{0} : number_of(side);
    tied.mutable_at(k) = is_tied;
    t.mutable_at(k) = at;
  }
  py::tuple tuple() const { return py::make_tuple(faces, sides, tied, t); }

  py::array_t<std::int64_t> faces;
  py::array_t<std::int8_t> sides;
  py::array_t<bool> tied;
  py::array_t<double> t;
};
constexpr double none = std::numeric_limits<double>::quiet_NaN();

using Points = py::array_t<double, py::array::c_style>;

/// The first hits of rays in doubles. Pre: both are (n, 3).
py::tuple nearest_of(const Model& model, const Points& origins, const Points& directions, bool closed,
                     const Question& question) {
  const auto o = origins.unchecked<2>(), d = directions.unchecked<2>();
  std::vector<Double_ray> rays(static_cast<std::size_t>(o.shape(0)));
  for (py::ssize_t i = 0; i < o.shape(0); ++i) {
    bool is_zero = true;
    for (py::ssize_t k = 0; k < 3; ++k) {
      if (!std::isfinite(o(i, k)) || !std::isfinite(d(i, k)))
        throw py::value_error("ray " + std::to_string(i) + " has a coordinate that is no finite number");
      const auto c = static_cast<std::size_t>(k);
      rays[static_cast<std::size_t>(i)].origin[c] = o(i, k);
      rays[static_cast<std::size_t>(i)].direction[c] = d(i, k);
      is_zero = is_zero && d(i, k) == 0;
    }
    if (is_zero) throw py::value_error("ray " + std::to_string(i) + " has the direction 0");
  }
  const auto found = answer_to(
      question, [model, rays, closed](const Asking& asking) { return nearest(model, rays, start_of(closed), asking); });
  Columns columns(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Nearest_face& hit = found[i];
    const bool is_hit = hit.face != Nearest_face::nothing;
    columns.set(i, is_hit ? std::int64_t{hit.face} : -1, hit.side, hit.tied,
                is_hit ? hit.low + (hit.high - hit.low) / 2 : none);
  }
  return columns.tuple();
}

/// Hits of exact rays, which stay in C++ until they are looked at.
struct Exact_hits {
  std::vector<Exact_ray> rays;
  std::vector<std::vector<Face_hit>> hits;
};

Exact_hits traced(const Model& model, const py::object& origins, const py::object& directions, bool all, bool closed,
                  const Question& question) {
  Exact_hits found;
  for (const py::handle pair : py::module_::import("builtins").attr("zip")(origins, directions)) {
    if (found.rays.size() % 1024 == 0 && PyErr_CheckSignals() != 0) throw py::error_already_set();
    const std::string name = "ray " + std::to_string(found.rays.size());
    const auto both = py::reinterpret_borrow<py::tuple>(pair);
    found.rays.push_back({point_of(both[0], name + ": origin"), point_of(both[1], name + ": direction")});
    if (found.rays.back().direction == Exact_point{0, 0, 0}) throw py::value_error(name + " has the direction 0");
  }
  found.hits = answer_to(question, [model, rays = found.rays, all, closed](const Asking& asking) {
    return all ? trace_all(model, rays, start_of(closed), asking) : trace(model, rays, start_of(closed), asking);
  });
  return found;
}

py::list hits_of(const Exact_hits& found, std::size_t i) {
  py::list all;
  for (const Face_hit& hit : found.hits.at(i))
    all.append(py::make_tuple(hit.face, number_of(hit.side), fraction(hit.t), fraction(hit.until),
                              fractions(point_at(found.rays[i], hit.t))));
  return all;
}

py::tuple firsts_of(const Exact_hits& found) {
  Columns columns(found.hits.size());
  for (std::size_t i = 0; i < found.hits.size(); ++i) {
    const std::vector<Face_hit>& hits = found.hits[i];
    if (hits.empty()) columns.set(i, -1, Met_side::along, false, none);
    else
      columns.set(i, hits[0].face, hits[0].side, hits.size() > 1 && hits[1].t == hits[0].t, nearest_double(hits[0].t));
  }
  return columns.tuple();
}

py::tuple combined(const std::string& operation, const py::list& solids, const std::string& inside,
                   const Question& question) {
  const std::vector<Model> models = models_of(solids);
  const Combined found = answer_to(question, [operation, models, inside](const Asking& asking) {
    return combine(operation, models, inside, asking);
  });
  py::array_t<std::int64_t> sources({static_cast<py::ssize_t>(found.faces.size()), py::ssize_t{2}});
  for (std::size_t f = 0; f < found.faces.size(); ++f) {
    sources.mutable_at(static_cast<py::ssize_t>(f), 0) = found.faces[f].first;
    sources.mutable_at(static_cast<py::ssize_t>(f), 1) = found.faces[f].second;
  }
  return py::make_tuple(found.model, sources, fraction(found.volume), Certifier{found});
}

}  // namespace

void add_solids_and_rays(py::module_& module) {
  py::class_<Exact_hits>(module, "Hits")
      .def("__len__", [](const Exact_hits& found) { return found.hits.size(); })
      .def("of", &hits_of, py::arg("i"))
      .def("firsts", &firsts_of);
  module.def("nearest", &nearest_of, py::arg("model"), py::arg("origins"), py::arg("directions"), py::arg("closed"),
             py::arg("question"));
  module.def("traced", &traced, py::arg("model"), py::arg("origins"), py::arg("directions"), py::arg("all"),
             py::arg("closed"), py::arg("question"));
  module.def(
      "area_of",
      [](const Model& model) {
        const auto bounds =
            answer_to(plain_question(), [model](const Asking&) { return sightline::area(model.soup()); });
        return py::make_tuple(bounds[0], bounds[1]);
      },
      py::arg("model"));
  module.def("combine", &combined, py::arg("operation"), py::arg("solids"), py::arg("inside"), py::arg("question"));
}

}  // namespace sightline::python
