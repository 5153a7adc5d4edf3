#pragma once
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <pybind11/numpy.h>

namespace robosim {

/// "(3, 2)"
inline std::string shapeText(const std::vector<pybind11::ssize_t>& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i) text += (i ? ", " : "") + std::to_string(shape[i]);
  return text + (shape.size() == 1 ? ",)" : ")");
}

inline std::vector<pybind11::ssize_t> shapeOf(const pybind11::array& array) {
  return {array.shape(), array.shape() + array.ndim()};
}

/// @throws std::invalid_argument
inline void requireShape(const char* what, const pybind11::array& array, const std::vector<pybind11::ssize_t>& shape) {
  if (shapeOf(array) == shape) return;
  throw std::invalid_argument(std::string(what) + " have the shape " + shapeText(shapeOf(array)) + "; it must be " +
                              shapeText(shape) + ", as of np.zeros(" + shapeText(shape) + ")");
}

/// An argument as a contiguous array of T, converted if necessary: numbers of other types, lists.
/// @throws pybind11::type_error for anything but numbers, std::invalid_argument for another shape
template <typename T>
pybind11::array_t<T> numbersOf(const char* what, const pybind11::object& argument,
                               const std::vector<pybind11::ssize_t>& shape) {
  namespace py = pybind11;
  const py::array given = py::array::ensure(argument);
  if (!given) {
    PyErr_Clear();
    throw py::type_error(std::string(what) + " must be an array of numbers of shape " + shapeText(shape) +
                         "; for example np.zeros(" + shapeText(shape) + ")");
  }
  const char kind = given.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u') {
    throw py::type_error(std::string(what) + " must be an array of numbers, not of " +
                         py::str(given.dtype()).cast<std::string>() + "; for example np.zeros(" + shapeText(shape) +
                         ")");
  }
  requireShape(what, given, shape);
  const auto converted = py::array_t<T, py::array::c_style | py::array::forcecast>::ensure(given);
  if (!converted) throw py::error_already_set();
  return converted;
}

/// An array of the caller that results are written to; it is not converted.
/// @throws pybind11::type_error for another type, std::invalid_argument for another shape and an array that is not
/// contiguous or cannot be written
template <typename T>
T* resultsOf(const char* what, pybind11::array& array, const std::vector<pybind11::ssize_t>& shape) {
  namespace py = pybind11;
  if (!py::dtype::of<T>().equal(array.dtype())) {
    throw py::type_error(std::string(what) + " are of type " + py::str(array.dtype()).cast<std::string>() +
                         "; it must be " + py::str(py::dtype::of<T>()).cast<std::string>());
  }
  requireShape(what, array, shape);
  if (!(array.flags() & py::array::c_style) || !array.writeable()) {
    throw std::invalid_argument(std::string(what) + " must be in a contiguous array that can be written");
  }
  return static_cast<T*>(array.mutable_data());
}

/// @throws std::invalid_argument
inline void requireFinite(const char* what, double value) {
  if (std::isfinite(value)) return;
  throw std::invalid_argument(std::string(what) + " is not finite; it must be a number, for example 0.5");
}

}  // namespace robosim
