#include "python_errors.h"

#include <exception>
#include <utility>

#include "base/error_list.h"
#include "control/controller_error.h"
#include "recording/recording_error.h"

namespace robosim {
namespace {

namespace py = pybind11;

void setError(const char* name, const std::exception& error) {
  PyErr_SetObject(errorClass(name).ptr(), toPython(error.what()).ptr());
}

void translate(std::exception_ptr error) {
  try {
    if (error) std::rethrow_exception(std::move(error));
  } catch (const ConfigError& of_input) {
    setError("ConfigError", of_input);
  } catch (const ControllerError& of_controller) {
    setError("ControllerError", of_controller);
  } catch (const RecordingError& of_recording) {
    setError("RecordingError", of_recording);
  }
}

}  // namespace

py::object errorClass(const char* name) { return py::module_::import("robosim._errors").attr(name); }

py::str toPython(const std::string& bytes) {
  PyObject* text = PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "surrogateescape");
  if (!text) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(text);
}

std::string toBytes(const py::str& text) {
  PyObject* bytes = PyUnicode_AsEncodedString(text.ptr(), "utf-8", "surrogateescape");
  if (!bytes) throw py::error_already_set();
  return py::reinterpret_steal<py::bytes>(bytes);
}

void refuseUnconstructed(py::module_& module) {
  for (const auto& [name, value] : module.attr("__dict__").cast<py::dict>()) {
    if (!PyType_Check(value.ptr())) continue;
    auto* const type = py::detail::get_type_info(reinterpret_cast<PyTypeObject*>(value.ptr()));
    if (!type) continue;
    // pybind11 calls it for an argument without a value.
    type->operator_new = [](std::size_t) -> void* {
      throw py::type_error("the object's constructor has not been called; make it by calling its class");
    };
  }
}

void registerErrors() { py::register_exception_translator(translate); }

}  // namespace robosim
