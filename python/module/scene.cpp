// Scenes from arrays and files, and what they are made of.

#include "bindings.h"

#include <sightline/harness/generate/transform.h>
#include <sightline/io/exact_text.h>
#include <sightline/io/off.h>
#include <sightline/io/read.h>
#include <sightline/io/write.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

namespace sightline::python {

namespace {

std::string place(const char* name, py::ssize_t i, py::ssize_t k) {
  return std::string(name) + '[' + std::to_string(i) + ", " + std::to_string(k) + ']';
}

// ---- Points

void push(Coordinates& to, std::int64_t value) { to.push_decimal(value, 0); }
void push(Coordinates& to, double value) { to.push_double(value); }

/// Appends points of a number type; says whether the array has it. Doubles have to be finite.
template <class T>
bool add_points(Polygon_soup& soup, const py::array& points) {
  if (!py::isinstance<py::array_t<T>>(points)) return false;
  const auto at = py::reinterpret_borrow<py::array_t<T>>(points).template unchecked<2>();
  const py::gil_scoped_release released;
  for (py::ssize_t i = 0; i < at.shape(0); ++i)
    for (py::ssize_t k = 0; k < 3; ++k) {
      if constexpr (std::is_floating_point_v<T>) {
        if (!std::isfinite(at(i, k)))
          throw std::domain_error(place("V", i, k) + " is " + std::to_string(at(i, k)) + "; give finite coordinates");
        push(soup.coordinates, static_cast<double>(at(i, k)));
      } else {
        push(soup.coordinates, static_cast<std::int64_t>(at(i, k)));
      }
    }
  return true;
}

/// Numbers of any kind; unless `any_denominator`, within what a file may have of them.
void add_objects(Polygon_soup& soup, const py::array& points, bool any_denominator) {
  Common_denominator common;
  const auto at = py::reinterpret_borrow<py::array_t<PyObject*>>(points).unchecked<2>();
  for (py::ssize_t i = 0; i < at.shape(0); ++i) {
    if (i % 1024 == 0 && PyErr_CheckSignals() != 0) throw py::error_already_set();
    for (py::ssize_t k = 0; k < 3; ++k) {
      const Rational coordinate = rational_of(at(i, k), place("V", i, k));
      const std::string why = any_denominator ? "" : common.why_not(coordinate, "give floats, or round them");
      if (!why.empty()) throw py::value_error(place("V", i, k) + ": " + why);
      soup.coordinates.push(coordinate);
    }
  }
}

// ---- Faces

template <class T>
[[noreturn]] void fail_corner(std::size_t face, T corner, std::size_t points) {
  throw std::out_of_range("F: face " + std::to_string(face) + " has the corner " + std::to_string(corner) +
                          ", and there are " + std::to_string(points) + " points, counted from 0");
}

/// Appends faces of a number type: rows of corners, or loops of one row; says whether the array has it.
template <class T>
bool add_faces(Polygon_soup& soup, const py::array& corners, std::span<const std::int64_t> loops,
               std::span<const std::int64_t> faces) {
  if (!py::isinstance<py::array_t<T>>(corners)) return false;
  const std::size_t points = soup.point_count();
  std::vector<Point_id> loop;
  const auto push_corner = [&](std::size_t face, T corner) {
    if (static_cast<std::uint64_t>(corner) >= points)  // a negative one too
      fail_corner(face, corner, points);
    loop.push_back(static_cast<Point_id>(corner));
  };
  const auto typed = py::reinterpret_borrow<py::array_t<T>>(corners);
  if (corners.ndim() == 2) {
    const auto at = typed.template unchecked<2>();
    const py::gil_scoped_release released;
    for (py::ssize_t i = 0; i < at.shape(0); ++i) {
      loop.clear();
      for (py::ssize_t k = 0; k < at.shape(1); ++k) push_corner(static_cast<std::size_t>(i), at(i, k));
      soup.add_face(loop);
    }
    return true;
  }
  const auto at = typed.template unchecked<1>();
  for (std::size_t f = 0; f + 1 < faces.size(); ++f)
    for (auto l = static_cast<std::size_t>(faces[f]); l < static_cast<std::size_t>(faces[f + 1]); ++l) {
      loop.clear();
      for (std::int64_t c = loops[l]; c < loops[l + 1]; ++c) push_corner(f, at(c));
      if (static_cast<std::int64_t>(l) == faces[f]) soup.add_face(loop);
      else soup.add_hole(loop);
    }
  return true;
}

/// Places where something begins, and one more where the last ends. Errors: ValueError that says what is wrong.
void check_starts(std::span<const std::int64_t> starts, std::size_t end, const std::string& name, const std::string& of,
                  std::int64_t least) {
  if (starts.empty() || starts.front() != 0 || starts.back() != static_cast<std::int64_t>(end))
    throw py::value_error(name + " has to begin with 0 and end with " + std::to_string(end) + ", the number of " + of);
  for (std::size_t i = 1; i < starts.size(); ++i)
    if (starts[i] < starts[i - 1] || starts[i] - starts[i - 1] < least)
      throw py::value_error(name + '[' + std::to_string(i) + "] is " + std::to_string(starts[i]) + ", after " +
                            std::to_string(starts[i - 1]) +
                            (least > 0 ? "; a face has at least one loop" : "; give them in ascending order"));
}

using Starts = py::array_t<std::int64_t, py::array::c_style>;

/// A scene of arrays, each number as it is. Pre: V is (n, 3), of doubles, floats, 64-bit or 32-bit integers or objects;
/// F of integers: (m, k), or one row, whose loops and faces begin where `loops` and `faces` say.
Model model_of(const py::array& points, const py::array& corners, const Starts& loop_starts, const Starts& face_starts,
               const Question& question, bool any_denominator) {
  const std::span loops(loop_starts.data(), static_cast<std::size_t>(loop_starts.size()));
  const std::span faces(face_starts.data(), static_cast<std::size_t>(face_starts.size()));
  Polygon_soup soup;
  soup.file = "arrays";
  soup.coordinates.reserve(3 * static_cast<std::size_t>(points.shape(0)));
  if (!add_points<double>(soup, points) && !add_points<float>(soup, points) &&
      !add_points<std::int64_t>(soup, points) && !add_points<std::int32_t>(soup, points))
    add_objects(soup, points, any_denominator);
  if (corners.ndim() == 1) {
    check_starts(loops, static_cast<std::size_t>(corners.shape(0)), "offsets", "corners", 0);
    check_starts(faces, loops.size() - 1, "face_offsets", "loops", 1);
  }
  if (!add_faces<std::int64_t>(soup, corners, loops, faces) && !add_faces<std::int32_t>(soup, corners, loops, faces) &&
      !add_faces<std::uint32_t>(soup, corners, loops, faces) && !add_faces<std::uint64_t>(soup, corners, loops, faces))
    throw py::type_error("F wants integers");
  return answer_to(question, [soup = std::move(soup)](const Asking&) mutable { return Model(std::move(soup)); });
}

// ---- What it is made of

py::dict facts_of(const Model& model) {
  const Facts facts = answer_to(plain_question(), [model](const Asking&) { return model.facts(); });
  py::dict all;
  all["points_read"] = facts.points_read;
  all["points"] = facts.points;
  all["faces_read"] = facts.faces_read;
  all["faces"] = facts.faces;
  all["parts"] = facts.parts;
  all["concave"] = facts.concave;
  all["non_planar"] = facts.non_planar;
  all["with_holes"] = facts.with_holes;
  all["planes"] = facts.planes;
  all["bits"] = facts.bits;
  all["arithmetic"] = facts.arithmetic;
  all["closed"] = facts.closed;
  all["box"] = facts.box ? py::object(py::make_tuple(fractions((*facts.box)[0]), fractions((*facts.box)[1])))
                         : py::object(py::none());
  return all;
}

Parts parts_of(const Model& model) {
  const std::size_t count = answer_to(plain_question(), [model](const Asking&) { return model.parts().size(); });
  return {count, [model](std::size_t i) -> const Part& { return model.parts()[i]; }, {}};
}

py::list left_out_of(const Model& model) {
  py::list all;
  const auto left_out = answer_to(plain_question(), [model](const Asking&) { return model.left_out(); });
  for (const Left_out& entry : left_out) all.append(py::make_tuple(entry.face, entry.why));
  return all;
}

/// A scene of a file: coordinates rounded to doubles first, if so wished, and all loops backwards.
Model read(const std::string& file, bool round, bool flip, const Question& question) {
  return answer_to(question, [file, round, flip](const Asking&) {
    Read_options options;
    options.round_to_double = round;
    Polygon_soup soup = read_scene(file, options);
    return Model(flip ? generate::faces_reversed(soup) : std::move(soup));
  });
}

void write(const Model& model, const std::string& file) {
  try {
    answer_to(plain_question(), [model, file](const Asking& asking) {
      write_scene(model.soup(), file, asking.progress);
      return true;
    });
  } catch (const Not_representable& error) {
    throw py::value_error(error.what());
  } catch (const std::runtime_error& error) {
    PyErr_SetString(PyExc_OSError, error.what());
    throw py::error_already_set();
  }
}

template <class Measure>
py::array_t<double> measured(const Parts& parts, Measure measure) {
  return array_of(answer_to(plain_question(), [parts, measure](const Asking&) {
    std::vector<double> all(parts.count);
    for (std::size_t i = 0; i < parts.count; ++i) all[i] = measure(parts.at(i));
    return all;
  }));
}

void append_rounded(std::vector<double>& to, const std::vector<Exact_point>& points) {
  for (const Exact_point& p : points)
    for (const Rational& coordinate : p) to.push_back(nearest_double(coordinate));
}

/// Corners of all parts, and where those of each begin.
py::tuple all_points_of(const Parts& parts) {
  auto [points, offsets] = answer_to(plain_question(), [parts](const Asking&) {
    std::pair<std::vector<double>, std::vector<std::int64_t>> all{{}, {0}};
    for (std::size_t i = 0; i < parts.count; ++i) {
      append_rounded(all.first, parts.at(i).corners);
      all.second.push_back(static_cast<std::int64_t>(all.first.size() / 3));
    }
    return all;
  });
  return py::make_tuple(array_of(std::move(points), true), array_of(std::move(offsets)));
}

struct Flat_faces {
  std::vector<std::int64_t> corners, loops{0}, faces{0};
};
Flat_faces flat_faces_of(const Polygon_soup& soup) {
  Flat_faces flat;
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    for (std::size_t k = 0; k < soup.loop_count(f); ++k) {
      const auto loop = soup.loop(f, k);
      flat.corners.insert(flat.corners.end(), loop.begin(), loop.end());
      flat.loops.push_back(static_cast<std::int64_t>(flat.corners.size()));
    }
    flat.faces.push_back(static_cast<std::int64_t>(flat.loops.size() - 1));
  }
  return flat;
}
py::tuple arrays_of(Flat_faces&& flat) {
  return py::make_tuple(array_of(std::move(flat.corners)), array_of(std::move(flat.loops)),
                        array_of(std::move(flat.faces)));
}

std::vector<double> rounded_points(const Polygon_soup& soup) {
  std::vector<double> all(soup.coordinates.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = nearest_double(soup.coordinates[i]);
  return all;
}

}  // namespace

py::array_t<double> rounded(const std::vector<Exact_point>& points) {
  std::vector<double> all;
  append_rounded(all, points);
  return array_of(std::move(all), true);
}

py::array points_of(const Polygon_soup& soup, bool exact) {
  if (!exact) return array_of(rounded_points(soup), true);
  py::list all;
  for (std::size_t i = 0; i < soup.coordinates.size(); ++i) all.append(fraction(soup.coordinates[i]));
  const py::module_ numpy = py::module_::import("numpy");
  py::object array = numpy.attr("empty")(py::make_tuple(soup.point_count(), 3), py::arg("dtype") = "object");
  array.attr("flat") = all;
  return array;
}

py::tuple faces_of(const Polygon_soup& soup) { return arrays_of(flat_faces_of(soup)); }

void add_scene(py::module_& module) {
  py::class_<Question>(module, "Question")
      .def(py::init([](int threads, py::object progress, double budget, bool two_sided) {
             return Question{threads, std::move(progress), budget, two_sided};
           }),
           py::arg("threads"), py::arg("progress"), py::arg("budget"), py::arg("two_sided"));

  py::class_<Parts>(module, "Parts")
      .def("__len__", [](const Parts& parts) { return parts.count; })
      .def(
          "face", [](const Parts& parts, std::size_t i) { return parts.at(i).face; }, py::arg("i"))
      .def(
          "piece", [](const Parts& parts, std::size_t i) { return parts.at(i).piece; }, py::arg("i"))
      .def(
          "from_front",
          [](const Parts& parts, std::size_t i) -> py::object {
            return parts.from_front ? py::object(py::bool_(parts.from_front(i))) : py::object(py::none());
          },
          py::arg("i"))
      .def(
          "corners",
          [](const Parts& parts, std::size_t i) {
            py::tuple corners(parts.at(i).corners.size());
            for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = fractions(parts.at(i).corners[k]);
            return corners;
          },
          py::arg("i"))
      .def(
          "points", [](const Parts& parts, std::size_t i) { return rounded(parts.at(i).corners); }, py::arg("i"))
      .def("faces",
           [](const Parts& parts) {
             return array_of(answer_to(plain_question(), [parts](const Asking&) {
               std::vector<std::int64_t> all(parts.count);
               for (std::size_t i = 0; i < parts.count; ++i) all[i] = parts.at(i).face;
               return all;
             }));
           })
      .def("fronts",
           [](const Parts& parts) {
             py::array_t<bool> all(static_cast<py::ssize_t>(parts.count));
             for (std::size_t i = 0; i < parts.count; ++i)
               all.mutable_data()[i] = !parts.from_front || parts.from_front(i);
             return all;
           })
      .def("all_points", &all_points_of)
      .def("areas", [](const Parts& parts) { return measured(parts, [](const Part& part) { return part.area(); }); })
      .def(
          "solid_angles",
          [](const Parts& parts, const py::object& eye) {
            return measured(parts, [eye = point_of(eye, "eye")](const Part& part) { return part.solid_angle(eye); });
          },
          py::arg("eye"));

  py::class_<Model>(module, "Model")
      .def_static("of_arrays", &model_of, py::arg("points"), py::arg("corners"), py::arg("loops"), py::arg("faces"),
                  py::arg("question"), py::arg("any_denominator") = false)
      .def_static("read", &read, py::arg("file"), py::arg("round"), py::arg("flip"), py::arg("question"))
      .def("write", &write, py::arg("file"))
      .def_property_readonly("file", [](const Model& model) { return text_of_bytes(model.soup().file); })
      .def_property_readonly("face_count", &Model::face_count)
      .def_property_readonly("point_count", [](const Model& model) { return model.soup().point_count(); })
      .def("left_out", &left_out_of)
      .def("parts", &parts_of)
      .def("facts", &facts_of)
      .def(
          "points",
          [](const Model& model, bool exact) -> py::array {
            if (exact) return points_of(model.soup(), true);
            const auto rounding = [model](const Asking&) { return rounded_points(model.soup()); };
            return array_of(answer_to(plain_question(), rounding), true);
          },
          py::arg("exact"))
      .def("faces", [](const Model& model) {
        return arrays_of(answer_to(plain_question(), [model](const Asking&) { return flat_faces_of(model.soup()); }));
      });
}

}  // namespace sightline::python
