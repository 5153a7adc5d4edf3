#pragma once
#include <memory>

#include <pybind11/pybind11.h>

#include "simulation.h"

namespace robosim {

/// Methods of Simulation that change the run from outside.
void bindInterventions(pybind11::class_<Simulation, std::shared_ptr<Simulation>>& simulation);

}  // namespace robosim
