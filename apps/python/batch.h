#pragma once
#include <pybind11/pybind11.h>

namespace robosim {

/// Class _Batch, on which the learning environments of robosim/vector_env.py and parallel_env.py are built.
void bindBatch(pybind11::module_& module);

}  // namespace robosim
