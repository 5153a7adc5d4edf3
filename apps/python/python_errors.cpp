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

namespace {

PyCFunctionWithKeywords pybind11_call = nullptr;  ///< what pybind11 calls for every function

/// The same, but its error for arguments of the wrong types names the argument (robosim/_arguments.py).
PyObject* callExplained(PyObject* self, PyObject* arguments, PyObject* keywords) {
  PyObject* const result = pybind11_call(self, arguments, keywords);
  if (result || !PyErr_ExceptionMatches(PyExc_TypeError)) return result;
  const py::error_scope error;  // restored at the end, unless the explanation replaces it
  try {
    py::object given = py::reinterpret_borrow<py::object>(error.value);
    const auto named = keywords ? py::reinterpret_borrow<py::dict>(keywords) : py::dict();
    const py::object text = py::module_::import("robosim._arguments")
                                .attr("explain")(py::str(given), py::reinterpret_borrow<py::object>(arguments), named);
    if (!text.is_none()) {
      auto& replaced = const_cast<py::error_scope&>(error);
      Py_SETREF(replaced.value, py::object(text).release().ptr());
      Py_CLEAR(replaced.trace);
    }
  } catch (const py::error_already_set&) {  // the error of pybind11 remains
  }
  return nullptr;
}

/// Replaces pybind11's call of a function, method, or accessor of a property.
void explain(py::handle member) {
  if (!member || member.is_none()) return;
  PyObject* function = member.ptr();
  if (PyInstanceMethod_Check(function)) function = PyInstanceMethod_Function(function);
  if (Py_IS_TYPE(function, &PyStaticMethod_Type)) return explain(member.attr("__func__"));
  if (Py_IS_TYPE(function, &PyProperty_Type)) return explain(member.attr("fset"));
  if (!PyCFunction_Check(function)) return;
  PyMethodDef& method = *reinterpret_cast<PyCFunctionObject*>(function)->m_ml;
  if ((method.ml_flags & (METH_VARARGS | METH_KEYWORDS)) != (METH_VARARGS | METH_KEYWORDS)) return;
  const auto call = reinterpret_cast<PyCFunctionWithKeywords>(reinterpret_cast<void (*)()>(method.ml_meth));
  if (!pybind11_call) pybind11_call = call;
  if (call != pybind11_call) return;
  method.ml_meth = reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(callExplained));
}

}  // namespace

void explainArguments(py::module_& module) {
  for (const auto& [name, value] : module.attr("__dict__").cast<py::dict>()) {
    if (!PyType_Check(value.ptr())) {
      explain(value);
      continue;
    }
    const auto members = py::dict(py::reinterpret_borrow<py::object>(value.attr("__dict__")));
    for (const auto& [member_name, member] : members) explain(member);
  }
}

void registerErrors() { py::register_exception_translator(translate); }

}  // namespace robosim
