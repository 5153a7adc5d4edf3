#pragma once
#include <memory>
#include <string>

#include <pybind11/numpy.h>

#include "simulation.h"

namespace robosim {

/// @name Views of the state, which keep the simulation and cannot be written
///@{
pybind11::array posesOf(const std::shared_ptr<Simulation>& simulation);     ///< float64 (robots, 3)
pybind11::array commandsOf(const std::shared_ptr<Simulation>& simulation);  ///< float64 (robots, 2)
pybind11::array stalledOf(const std::shared_ptr<Simulation>& simulation);   ///< bool (robots,)
///@}

/// Commands the robots without a controller.
/// @throws pybind11::type_error, std::invalid_argument for an array of another type or shape, a command that is not
/// finite, and a simulation whose robots all have controllers
void setCommands(Simulation& simulation, const pybind11::object& argument);

/// Readings of the first sensor of a kind of each robot: float32 (robots, values); NaN where there are none.
/// @param out None, or the array to write to
/// @throws pybind11::type_error, std::invalid_argument for an unsuitable array and an unknown kind
pybind11::array readingsOf(Simulation& simulation, const std::string& kind, const pybind11::object& out);

}  // namespace robosim
