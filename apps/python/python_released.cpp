#include "python_released.h"

#include <atomic>
#include <chrono>
#include <thread>

#include <pthread.h>
#include <unistd.h>

namespace robosim {
namespace {

namespace py = pybind11;

constexpr std::chrono::seconds kWaitMax{10};  ///< for a call that does not ask isInterrupted(), such as loading a world

std::atomic<int> engine_calls = 0;  ///< without Python's lock
std::atomic<bool> is_ending = false;
std::atomic<std::thread::id> ending_thread;

[[noreturn]] void waitForTheProcessToEnd() {
  for (;;) pause();
}

/// Called by Python's atexit, with the lock, before daemon threads are ended.
void endCalls() {
  ending_thread = std::this_thread::get_id();
  is_ending = true;
  const py::gil_scoped_release no_python;
  const auto give_up = std::chrono::steady_clock::now() + kWaitMax;
  while (engine_calls > 0 && std::chrono::steady_clock::now() < give_up) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace

PythonReleased::PythonReleased() { release(); }

bool PythonReleased::isInterrupted() { return is_ending && ending_thread.load() != std::this_thread::get_id(); }

void PythonReleased::release() {
  if (state_) return;
  state_ = PyEval_SaveThread();
  if (isInterrupted()) waitForTheProcessToEnd();
  ++engine_calls;
}

void PythonReleased::acquire() {
  if (!state_) return;
  --engine_calls;
  if (isInterrupted()) waitForTheProcessToEnd();
  try {
    PyEval_RestoreThread(state_);
  } catch (...) {  // the stack is unwound by pthread_exit()
    waitForTheProcessToEnd();
  }
  state_ = nullptr;
}

void registerPythonEnd(py::module_& module) {
  pthread_atfork(nullptr, nullptr, [] { engine_calls = 0; });  // a child has no other threads
  module.def("_end_calls", endCalls);
  py::module_::import("atexit").attr("register")(module.attr("_end_calls"));
}

}  // namespace robosim
