// Questions, and their answers as arrays, parts and certificates.

#include "bindings.h"

#include <sightline/harness/generate/transform.h>

namespace sightline::python {

namespace {

template <class Found>
Certifier certifier(const Found& found) {
  return {found};
}

/// The parts of an answer, which keeps them.
template <class Found>
Parts parts_in(const std::shared_ptr<const Found>& found) {
  return {found->parts.size(), [found](std::size_t i) -> const Part& { return found->parts[i]; }, {}};
}

py::tuple order_of(const Model& model, const py::object& at, const Question& question) {
  const Exact_point eye = point_of(at, "eye");
  const auto found = answer_to(question, [model, eye](const Asking& asking) {
    return std::make_shared<const Visibility_order>(order(model, eye, asking));
  });
  return py::make_tuple(parts_in(found), certifier(*found));
}

py::tuple graph_of(const Model& model, const Question& question) {
  const Priority found = answer_to(question, [model](const Asking& asking) { return priority_graph(model, asking); });
  py::list components;
  for (const std::vector<std::uint32_t>& component : found.components) components.append(ids(component));
  return py::make_tuple(components, found.cyclic, certifier(found));
}

/// A drawing that is made when it is asked for.
struct Drawing {
  std::shared_ptr<const Seen> seen;
};

py::list lines_of(const Drawing& drawing) {
  const std::vector<Seen::Line> lines =
      answer_to(plain_question(), [seen = drawing.seen](const Asking& asking) { return seen->lines(asking.progress); });
  py::list all;
  for (const Seen::Line& line : lines) {
    py::list stretches;
    for (const Seen::Line::Stretch& part : line.stretches)
      stretches.append(py::make_tuple(fraction(part.from), fraction(part.to),
                                      part.hidden_by ? py::object(py::int_(*part.hidden_by)) : py::object(py::none())));
    py::list faces;
    for (const Face_id face : line.faces) faces.append(face);
    all.append(
        py::make_tuple(line.kind, py::make_tuple(fractions(line.ends[0]), fractions(line.ends[1])), faces, stretches));
  }
  return all;
}

/// All around, or in the cone of some rays.
py::tuple seen_by(const Model& model, const py::object& at, const py::object& frustum, const Question& question) {
  const Exact_point eye = point_of(at, "eye");
  std::vector<Exact_point> field;
  for (const py::handle ray : frustum) field.push_back(point_of(ray, "frustum: ray " + std::to_string(field.size())));
  const auto found = answer_to(question, [model, eye, field](const Asking& asking) {
    return std::make_shared<const Seen>(field.empty() ? see(model, eye, asking)
                                                      : see_in_field(model, eye, field, asking));
  });
  Parts parts = parts_in(found);
  parts.from_front = [found](std::size_t i) { return found->parts[i].from_front; };
  return py::make_tuple(ids(found->visible), ids(found->from_behind), std::move(parts), Drawing{found},
                        certifier(*found));
}

/// Errors: IndexError where there is no such face.
Face_id checked_face(const Model& model, const py::handle& face) {
  int overflow = 0;
  const long long id = PyLong_AsLongLongAndOverflow(face.ptr(), &overflow);
  if (overflow != 0 || id < 0 || static_cast<std::uint64_t>(id) >= model.face_count())
    throw std::out_of_range("face " + std::string(py::str(face)) + " is not there: there are " +
                            std::to_string(model.face_count()) + ", counted from 0");
  return static_cast<Face_id>(id);
}

/// From what `source` says, where it is not None; from the insides of solids; and of what some faces of the scene
/// bound.
py::tuple weak_from(const Model& model, const py::object& source, const py::list& solids, const py::list& faces,
                    bool conservative, const Question& question) {
  std::vector<Polygon_soup> volumes;
  for (const Model& solid : models_of(solids)) volumes.push_back(solid.soup());
  if (!faces.empty()) {
    std::vector<Face_id> bounds;
    for (const py::handle face : faces) bounds.push_back(checked_face(model, face));
    std::vector<bool> is_left_out(model.face_count());
    for (const Left_out& one : model.left_out()) is_left_out[one.face] = true;
    for (const Face_id face : bounds)
      if (is_left_out[face])
        throw std::out_of_range("face " + std::to_string(face) + " is not there, or was left out: see left_out()");
    volumes.push_back(generate::with_faces(model.soup(), bounds));
  }
  std::vector<std::vector<Exact_point>> sources;
  if (!source.is_none()) sources = sources_of(model, source);
  const Weak_visibility found = answer_to(question, [model, volumes, sources, conservative](const Asking& asking) {
    return conservative ? possibly_visible_from_solids(model, volumes, sources, asking)
                        : weakly_visible_from_solids(model, volumes, sources, asking);
  });
  return py::make_tuple(ids(found.visible), ids(found.hidden), ids(found.undecided), certifier(found));
}

py::tuple moment(const Quadratic_root& t) {
  const std::optional<Rational> root = t.rational();
  const Quadratic f = t.polynomial();
  const auto [low, high] = t.bounds();
  const auto whole = [](const Integer& x) { return py::int_(py::str(to_string(x))); };
  return py::make_tuple(root ? fraction(*root) : py::object(py::none()),
                        py::make_tuple(whole(f.c[2]), whole(f.c[1]), whole(f.c[0])),
                        py::make_tuple(fraction(low), fraction(high)), t.near());
}

py::tuple seen_along(const Model& model, const py::object& start, const py::object& end, const Question& question) {
  const Exact_point from = point_of(start, "start"), to = point_of(end, "end");
  const Seen_along found =
      answer_to(question, [model, from, to](const Asking& asking) { return see_along(model, from, to, asking); });
  py::list events;
  for (const Seen_along::Event& event : found.events) {
    py::list changes;
    for (const Seen_along::Change& change : event.changes) {
      py::list edges;
      for (const auto& [part, corner] : change.edges) edges.append(py::make_tuple(part, corner));
      changes.append(py::make_tuple(change.face, change.before, change.at, change.after, change.kind, edges));
    }
    events.append(py::make_tuple(moment(event.t), changes));
  }
  return py::make_tuple(events, ids(found.at_start), ids(found.at_end), ids(found.visible), certifier(found));
}

py::tuple verdict_on_solids(const py::list& solids, const Model& result, const std::string& certificate,
                            const Question& question) {
  const std::vector<Model> models = models_of(solids);
  const Checked checked = answer_to(question, [models, result, certificate](const Asking& asking) {
    return verify(models, result, certificate, asking);
  });
  return py::make_tuple(checked.accepted, checked.why);
}

py::tuple verdict_on(const Model& model, const std::string& certificate, const Question& question) {
  const Checked checked =
      answer_to(question, [model, certificate](const Asking& asking) { return verify(model, certificate, asking); });
  return py::make_tuple(checked.accepted, checked.why);
}

}  // namespace

std::vector<std::vector<Exact_point>> sources_of(const Model& model, const py::object& source) {
  if (!py::isinstance<py::int_>(source)) return polygons_of(source, "source");
  return sightline::sources_of(model, checked_face(model, source));
}

void add_answers(py::module_& module) {
  py::class_<Certifier>(module, "Certifier").def("text", [](const Certifier& certifier) {
    return answer_to(plain_question(),
                     [answer = certifier.answer](const Asking& asking) { return answer.certificate(asking.progress); });
  });

  py::class_<Tracker>(module, "Tracker")
      .def(py::init([](const Model& model) {
             return answer_to(plain_question(), [model](const Asking&) { return track(model); });
           }),
           py::arg("model"))
      .def(
          "move_to", [](Tracker& tracker, const py::object& eye) { return ids(tracker.move_to(point_of(eye, "eye"))); },
          py::arg("eye"))
      .def(
          "is_on_view", [](const Tracker& tracker, Face_id face) { return tracker.on_view(face); }, py::arg("face"))
      .def("on_view", [](const Tracker& tracker) { return ids(tracker.on_view()); });

  module.def("order", &order_of, py::arg("model"), py::arg("eye"), py::arg("question"));
  module.def("graph", &graph_of, py::arg("model"), py::arg("question"));
  py::class_<Drawing>(module, "Drawing").def("lines", &lines_of);
  module.def("see", &seen_by, py::arg("model"), py::arg("eye"), py::arg("frustum"), py::arg("question"));
  module.def("weakly_visible", &weak_from, py::arg("model"), py::arg("source"), py::arg("solids"), py::arg("faces"),
             py::arg("conservative"), py::arg("question"));
  module.def("see_along", &seen_along, py::arg("model"), py::arg("start"), py::arg("end"), py::arg("question"));
  module.def("verify_solids", &verdict_on_solids, py::arg("solids"), py::arg("result"), py::arg("certificate"),
             py::arg("question"));
  module.def("verify", &verdict_on, py::arg("model"), py::arg("certificate"), py::arg("question"));
}

}  // namespace sightline::python
