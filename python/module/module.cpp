// The module _sightline: what python/sightline stands on.

#include "bindings.h"

#include <sightline/io/input.h>

PYBIND11_MODULE(_sightline, module) {
  namespace py = pybind11;
  using namespace sightline;
  using namespace sightline::python;

  // Errors of files and of budgets have classes of their own; indices, values and memory have Python's.
  static const py::handle input_error =
      py::object(py::module_::import("sightline._errors").attr("InputError")).release();
  static const py::handle out_of_budget =
      py::object(py::module_::import("sightline._errors").attr("OutOfBudget")).release();
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const Input_error& error) {
      const py::object byte = error.byte ? py::object(py::int_(*error.byte)) : py::none();
      const py::object line = error.line > 0 ? py::object(py::int_(error.line)) : py::none();
      const py::object column = error.line > 0 ? py::object(py::int_(error.column)) : py::none();
      const py::object said = text_of_bytes(error.what()), file = text_of_bytes(error.file);
      PyErr_SetObject(input_error.ptr(), input_error(said, file, line, column, byte).ptr());
    } catch (const Out_of_budget& error) {
      PyErr_SetString(out_of_budget.ptr(), error.what());
    }
  });

  py::module_::import("atexit").attr("register")(py::cpp_function(&wait_for_what_was_left));
  module.attr("version") = SIGHTLINE_VERSION;
  add_scene(module);
  add_answers(module);
  add_solids_and_rays(module);
  add_shadows(module);
  add_pictures(module);
  add_levels(module);
  add_harness(module);
}
