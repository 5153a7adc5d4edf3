#pragma once
#include <pybind11/pybind11.h>

namespace robosim {

/// Function _read_rawlog(), which robosim/recording.py wraps.
void bindRecording(pybind11::module_& module);

}  // namespace robosim
