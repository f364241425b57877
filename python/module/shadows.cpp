// What lights reach, and what shadows the rest.

#include "bindings.h"

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/shadow/shadow.h>
#include <sightline/algorithms/shadow/volume.h>
#include <sightline/algorithms/solids/measure.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/threads.h>

#include <memory>
#include <tuple>
#include <utility>

namespace sightline::python {

namespace {

struct Shadow_answer {
  std::vector<Part> parts;
  std::vector<std::int64_t> by;  ///< of each part the face that shadows it; -1: it is lit
  std::vector<bool> from_front;
  std::vector<Face_id> lit, away;
};

/// Of a light, or of the sun in a direction.
py::tuple shadow_of(const Model& model, const py::object& at, bool is_sun, const Question& question) {
  const Exact_point place = point_of(at, is_sun ? "sun" : "light");
  if (is_sun && place == Exact_point{0, 0, 0}) throw py::value_error("sun: (0, 0, 0) is no direction");
  const auto found = answer_to(question, [model, place, is_sun](const Asking& asking) {
    const Scene scene(model.soup());
    const Exact_view view = is_sun ? Exact_view(scene, Sun{place}) : Exact_view(scene, place);
    Shadow_options options;
    options.two_sided = asking.two_sided;
    options.threads = asking.threads;
    options.progress = progress_within_budget(asking);
    Shadows made = shadows(view, Piece_boxes(scene), options);
    auto answer = std::make_shared<Shadow_answer>();
    for (Shadow_part& part : made.parts) {
      const Piece& piece = scene.pieces()[part.piece];
      answer->parts.push_back({piece.face, piece.number, std::move(part.vertices)});
      answer->by.push_back(part.is_lit() ? -1 : std::int64_t{scene.pieces()[part.by].face});
      answer->from_front.push_back(part.side == CGAL::POSITIVE);
    }
    answer->lit = std::move(made.lit);
    answer->away = std::move(made.away);
    return std::shared_ptr<const Shadow_answer>(std::move(answer));
  });
  const Parts parts{found->parts.size(), [found](std::size_t i) -> const Part& { return found->parts[i]; },
                    [found](std::size_t i) { return found->from_front[i]; }};
  return py::make_tuple(ids(found->lit), ids(found->away), ids(found->by), parts);
}

/// The space behind faces, as a scene; how much it holds; the box that it is cut at.
py::tuple dark_space_of(const Model& model, const py::object& at, bool is_sun, const Question& question) {
  const Exact_point place = point_of(at, is_sun ? "sun" : "light");
  const auto [space, holds, box] = answer_to(question, [model, place, is_sun](const Asking& asking) {
    const Scene scene(model.soup());
    Shadow_volume made;
    const auto progress = progress_within_budget(asking);
    run_with_threads(asking.threads, [&] {
      made = is_sun ? shadow_volume(scene, Sun{place}, progress) : shadow_volume(scene, place, progress);
    });
    Rational size = volume(made.soup);
    return std::tuple(Model(std::move(made.soup)), std::move(size), std::move(made.box));
  });
  return py::make_tuple(space, fraction(holds), py::make_tuple(fractions(box[0]), fractions(box[1])));
}

}  // namespace

void add_shadows(py::module_& module) {
  module.def("shadow", &shadow_of, py::arg("model"), py::arg("at"), py::arg("is_sun"), py::arg("question"));
  module.def("dark_space", &dark_space_of, py::arg("model"), py::arg("at"), py::arg("is_sun"), py::arg("question"));
}

}  // namespace sightline::python
