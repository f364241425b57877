#include "exact.h"

#include <sightline/io/number_lines.h>
#include <sightline/kernel/quoted.h>

#include <cmath>

namespace sightline::python {

namespace {

std::string type_name(py::handle value) { return py::str(py::type::handle_of(value).attr("__name__")); }

/// An int of any length.
Integer integer_of(py::handle number) {
  int overflow = 0;
  const long value = PyLong_AsLongAndOverflow(number.ptr(), &overflow);
  if (overflow == 0) return Integer(value);
  const auto digits = py::reinterpret_steal<py::object>(_PyLong_Format(number.ptr(), 16));
  const std::string text = py::str(digits);  // "-0x1f..."
  const bool negative = text[0] == '-';
  const Integer magnitude(text.substr(negative ? 3 : 2), 16);
  return negative ? Integer(-magnitude) : magnitude;
}

py::object python_int(const Integer& n) {
  if (n.fits_slong_p()) return py::int_(n.get_si());
  return py::reinterpret_steal<py::object>(PyLong_FromString(n.get_str(16).c_str(), nullptr, 16));
}

/// What numerator and denominator say. Pre: `number` has both.
Rational quotient_of(py::handle numerator, py::handle denominator) {
  const auto p = py::reinterpret_steal<py::object>(PyNumber_Index(numerator.ptr()));
  const auto q = py::reinterpret_steal<py::object>(PyNumber_Index(denominator.ptr()));
  if (!p || !q) throw py::error_already_set();
  const Integer below = integer_of(q);
  if (below == 0) throw py::value_error("a number has the denominator 0");
  Rational value(integer_of(p), below);
  value.canonicalize();
  return value;
}

}  // namespace

Rational rational_of(py::handle number, const std::string& what) {
  if (PyFloat_Check(number.ptr())) {
    const double value = PyFloat_AsDouble(number.ptr());
    if (!std::isfinite(value))
      throw py::value_error(what + " is " + std::string(py::str(number)) + "; give finite numbers");
    return exact(value);
  }
  if (PyLong_CheckExact(number.ptr())) return Rational(integer_of(number));
  if (PyUnicode_Check(number.ptr())) {
    const std::string text = py::str(number);
    const std::vector<Rational> numbers = numbers_in(text, what + " wants a number");
    if (numbers.size() != 1) throw py::value_error(what + " wants one number, not " + sightline::quoted(text));
    return numbers[0];
  }
  const bool is_bool = PyBool_Check(number.ptr()) || type_name(number).starts_with("bool");
  if (!is_bool && py::hasattr(number, "as_integer_ratio")) {  // Decimal, Fraction, int, numpy's floats
    py::object ratio;
    try {
      ratio = number.attr("as_integer_ratio")();
    } catch (py::error_already_set& error) {
      if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_OverflowError)) throw;
      throw py::value_error(what + " is " + std::string(py::str(number)) + "; give finite numbers");
    }
    const auto pair = py::cast<py::tuple>(ratio);
    return quotient_of(pair[0], pair[1]);
  }
  if (!is_bool && py::hasattr(number, "numerator") && py::hasattr(number, "denominator"))  // numpy's integers, mpq
    return quotient_of(number.attr("numerator"), number.attr("denominator"));
  throw py::type_error(what + " is a " + type_name(number) +
                       "; give int, float, Fraction, Decimal, or text as \"1/3\"");
}

Exact_point point_of(py::handle point, const std::string& what) {
  const std::string wanted = what + " wants three numbers";
  if (PyUnicode_Check(point.ptr())) {
    const std::string text = py::str(point);
    const std::vector<Rational> numbers = numbers_in(text, wanted + " X,Y,Z");
    if (numbers.size() != 3) throw py::value_error(wanted + " X,Y,Z, not " + sightline::quoted(text));
    return {numbers[0], numbers[1], numbers[2]};
  }
  if (!py::isinstance<py::iterable>(point)) throw py::type_error(wanted + ", not a " + type_name(point));
  Exact_point exact;
  std::size_t k = 0;
  for (const py::handle number : py::reinterpret_borrow<py::iterable>(point)) {
    if (k == 3) throw py::value_error(wanted + ", not more");  // there may be no end of them
    exact[k] = rational_of(number, what + '[' + std::to_string(k) + ']');
    ++k;
  }
  if (k != 3) throw py::value_error(wanted + ", not " + std::to_string(k));
  return exact;
}

std::vector<std::vector<Exact_point>> polygons_of(py::handle polygons, const std::string& what) {
  std::vector<std::vector<Exact_point>> all;
  for (const py::handle polygon : polygons) {
    std::vector<Exact_point>& points = all.emplace_back();
    for (const py::handle point : polygon)
      points.push_back(point_of(point, what + ": corner " + std::to_string(points.size())));
  }
  return all;
}

py::object text_of_bytes(const std::string& bytes) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeFSDefaultAndSize(bytes.data(), static_cast<Py_ssize_t>(bytes.size())));
}

py::object fraction(const Rational& value) {
  static const py::handle type = py::object(py::module_::import("fractions").attr("Fraction")).release();
  return type(python_int(value.get_num()), python_int(value.get_den()));
}

py::tuple fractions(const Exact_point& point) {
  return py::make_tuple(fraction(point[0]), fraction(point[1]), fraction(point[2]));
}

}  // namespace sightline::python
