#pragma once
#include <pybind11/pybind11.h>

namespace robosim {

/// Releases Python's lock during its lifetime, as pybind11::gil_scoped_release, but the interpreter may end meanwhile.
///
/// Python ends a daemon thread that requests the lock of an ending interpreter by unwinding its stack, which would call
/// std::terminate() in a destructor. Such a thread waits here until the process has ended. Before the interpreter ends,
/// it waits for calls of the engine in other threads, since the libraries' static data is destroyed afterwards.
class PythonReleased {
 public:
  PythonReleased();
  ~PythonReleased() { acquire(); }
  PythonReleased(const PythonReleased&) = delete;
  PythonReleased& operator=(const PythonReleased&) = delete;

  void acquire();
  void release();

  /// Whether the interpreter ends: a long call in another thread than the one that ends it must return.
  static bool isInterrupted();

 private:
  PyThreadState* state_ = nullptr;
};

/// Makes the interpreter wait at its end. To be called when the module is loaded.
void registerPythonEnd(pybind11::module_& module);

}  // namespace robosim
