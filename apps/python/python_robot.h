#pragma once
#include <memory>
#include <string>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "simulation.h"

namespace robosim {

/// Python's class Robot: the view that a controller has of its robot. Of a robot that has a controller of this program,
/// only the readings may be used.
class PythonRobot {
 public:
  PythonRobot(Simulation& simulation, std::size_t index);

  /// @throws std::invalid_argument when the simulation no longer exists, and as requireUsable()
  Robot& toRead() const;
  /// Values of a sensor, as in an observation (ObservationLayout). @throws ConfigError for a sensor without values
  pybind11::array readings(const std::string& sensor) const;
  /// @throws std::invalid_argument also when a controller of this program drives the robot
  Robot& toCommand() const;

 private:
  std::weak_ptr<Simulation> simulation_;
  std::size_t index_;
  bool may_command_;
};

void bindRobot(pybind11::module_& module);

/// Picture of the first sensor of a kind or of the sensor with a label: uint8, shape (height, width, 3): red, green,
/// blue; None in a step without one, and for a robot without a sensor of that kind.
/// @throws std::invalid_argument for a name that is neither, and a sensor that takes no pictures
pybind11::object robotImage(const Robot& robot, const std::string& sensor);

/// Python's class Message of a message to a robot.
pybind11::list inboxOf(const Readings& readings);

}  // namespace robosim
