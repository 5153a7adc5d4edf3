#include "simulation_arrays.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include "array_arguments.h"

namespace robosim {
namespace {

namespace py = pybind11;

using SimulationHandle = std::shared_ptr<Simulation>;

const State& stateToRead(const Simulation& simulation) {
  requireUsable(simulation, SimulationAccess::read);
  return simulation.environment().state();
}

py::ssize_t robotsOf(const Simulation& simulation) { return static_cast<py::ssize_t>(simulation.robotCount()); }

/// A read-only array over memory of the simulation, which it keeps.
template <typename T>
py::array viewOf(const SimulationHandle& simulation, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
                 const T* data) {
  const py::capsule owner(new SimulationHandle(simulation),
                          [](void* kept) { delete static_cast<SimulationHandle*>(kept); });
  py::array view(py::dtype::of<T>(), std::move(shape), std::move(strides), data, owner);
  py::detail::array_proxy(view.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return view;
}

}  // namespace

py::array posesOf(const SimulationHandle& simulation) {
  const auto& poses = stateToRead(*simulation).world_from_robot;
  static_assert(sizeof(mrpt::math::TPose2D) == 3 * sizeof(double));
  return viewOf<double>(simulation, {robotsOf(*simulation), 3}, {sizeof poses[0], sizeof(double)},
                        poses.empty() ? nullptr : &poses[0].x);
}

py::array commandsOf(const SimulationHandle& simulation) {
  const auto& commands = stateToRead(*simulation).commands;
  static_assert(offsetof(Command, turn_radps) == offsetof(Command, speed_mps) + sizeof(double));
  return viewOf<double>(simulation, {robotsOf(*simulation), 2}, {sizeof commands[0], sizeof(double)},
                        commands.empty() ? nullptr : &commands[0].speed_mps);
}

py::array stalledOf(const SimulationHandle& simulation) {
  const auto& stalled = stateToRead(*simulation).stalled;
  return viewOf<bool>(simulation, {robotsOf(*simulation)}, {1}, reinterpret_cast<const bool*>(stalled.data()));
}

void setCommands(Simulation& simulation, const py::object& argument) {
  requireUsable(simulation, SimulationAccess::command);
  const py::ssize_t robots = robotsOf(simulation);
  const auto given = numbersOf<double>("commands", argument, {robots, 2});
  const auto command = given.unchecked<2>();
  bool is_any_driven = false;
  for (py::ssize_t i = 0; i < robots; ++i) {
    const auto robot = static_cast<std::size_t>(i);
    is_any_driven |= simulation.isDrivenByCommands(robot);
    if (!simulation.isDrivenByCommands(robot) || (std::isfinite(command(i, 0)) && std::isfinite(command(i, 1))))
      continue;
    throw std::invalid_argument("the command of robot '" + simulation.environment().robotNames()[robot] + "' (row " +
                                std::to_string(i) + ") is not finite");
  }
  if (!is_any_driven) {
    throw std::invalid_argument(std::string("every robot has a controller, which commands it; make the simulation with "
                                            "controller='") +
                                kNoController + "'");
  }
  for (py::ssize_t i = 0; i < robots; ++i) {
    const auto robot = static_cast<std::size_t>(i);
    if (simulation.isDrivenByCommands(robot)) simulation.robot(robot).drive(command(i, 0), command(i, 1));
  }
}

py::array readingsOf(Simulation& simulation, const std::string& kind, const py::object& out) {
  requireUsable(simulation, SimulationAccess::read);
  const auto& layouts = simulation.layoutsOf(kind);
  std::size_t size = 0;
  for (const auto& layout : layouts) size = std::max(size, layout ? layout->size() : 0);
  const std::vector<py::ssize_t> shape{robotsOf(simulation), static_cast<py::ssize_t>(size)};
  if (!out.is_none() && !py::isinstance<py::array>(out)) throw py::type_error("out must be a NumPy array");
  py::array array = out.is_none() ? py::array_t<float>(shape) : py::reinterpret_borrow<py::array>(out);
  float* row = resultsOf<float>("readings", array, shape);
  const State& state = simulation.environment().state();
  for (std::size_t i = 0; i < layouts.size(); ++i, row += size) {
    const std::size_t own = layouts[i] ? layouts[i]->size() : 0;
    if (layouts[i]) layouts[i]->write(state, i, {row, own});
    std::fill(row + own, row + size, std::numeric_limits<float>::quiet_NaN());
  }
  return array;
}

}  // namespace robosim
