#pragma once
// Exact numbers across the border: what Python calls a number, as a rational, and rationals as Fractions.

#include <sightline/sightline.h>

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace sightline::python {

namespace py = pybind11;

/// The rational that a number is: int, float, Fraction, Decimal, numpy's scalars, or text "0.1" or "p/q". Errors:
/// TypeError for what is no number (bool is none), ValueError for nan, infinity and other text; both begin with `what`.
/// Exact: yes.
Rational rational_of(py::handle number, const std::string& what);

/// A point of three numbers in a sequence or an array, or the text "X,Y,Z". Errors: as above, and ValueError where they
/// are not three.
Exact_point point_of(py::handle point, const std::string& what);
std::vector<std::vector<Exact_point>> polygons_of(py::handle polygons, const std::string& what);

/// A Fraction; a point of three of them.
/// Bytes of the system, as a file's name, as text, in Python's way: os.fsencode() gives them back.
py::object text_of_bytes(const std::string& bytes);

py::object fraction(const Rational& value);
py::tuple fractions(const Exact_point& point);

}  // namespace sightline::python
