#pragma once
#include <string>
#include <vector>

#include "hardware/base_link.h"
#include "hardware/command.h"
#include "hardware/readings.h"
#include "hardware/referee_link.h"
#include "hardware/robot_info.h"

namespace robosim {

/// Interface between a controller and its robot, which may be simulated in this process, connected over the network,
/// replayed from a recording, or real. Separates the controller side from the simulator side.
///
/// The readings are constant between two time steps. Each controller is called once per step.
class Hardware {
 public:
  virtual ~Hardware() = default;

  virtual const RobotInfo& info() const = 0;
  /// Names of all robots of the run in the world's order, including this one: the valid receivers of messages.
  virtual const std::vector<std::string>& robots() const = 0;
  /// Measurements at the end of the last time step.
  virtual const Readings& readings() const = 0;
  /// Sets the command for the next time step. The last command before a step is used, and kept until the next one.
  virtual void command(const Command&) = 0;
  /// The command for the next time step: the last one of command(), or the initial one. The hardware is its only owner,
  /// so that a controller whose robot is restored to another state continues from the command of that state.
  virtual const Command& lastCommand() const = 0;
  /// Sends a message to another robot.
  /// @throws std::invalid_argument when there is no robot named `to`, or the text is longer than
  /// kMaxMessageBytes.
  virtual void send(const std::string& to, const std::string& text) = 0;
  /// Sends a message to every other robot. The default sends one to each, in the world's order; hardware that takes it
  /// as one message overrides this.
  /// @throws std::invalid_argument when the text is longer than kMaxMessageBytes.
  virtual void broadcast(const std::string& text) {
    for (const std::string& other : robots()) {
      if (other != info().name) send(other, text);
    }
  }
  /// The referee of this robot's contest; null, the default, for hardware without one, whose readings then name no
  /// winner. Robot::checkWin() has no effect without a referee, so that a controller's source does not depend on it.
  virtual RefereeLink* referee() { return nullptr; }
  /// The controller of this robot's base; null, the default, for a simulated robot.
  virtual BaseLink* base() { return nullptr; }
};

}  // namespace robosim
