#pragma once
#include <string>

#include "hardware/command.h"
#include "hardware/readings.h"
#include "hardware/robot_info.h"

namespace robosim {

/// A robot as its controller sees it, wherever it is: simulated in this process, at the far end of a connection,
/// replayed from a recording, or made of metal. This is where the simulator side and the controller side meet.
///
/// Between two time steps the readings stand still; whoever runs the controllers lets each of them look, and take its
/// decision, once a step.
class Hardware {
 public:
  virtual ~Hardware() = default;

  virtual const RobotInfo& info() const = 0;
  /// What was sensed at the end of the last time step.
  virtual const Readings& readings() const = 0;
  /// Takes effect in the next time step; the last command before it counts, and stands until there is another.
  virtual void command(const Command&) = 0;
  /// @throws std::invalid_argument when there is no robot of the name `to`, or the text is longer than
  /// kMaxMessageBytes.
  virtual void send(const std::string& to, const std::string& text) = 0;
  /// Asks, with the next time step, whether this robot has won (2005: CheckWin): Readings::winner and `is_too_far` are
  /// the answer.
  virtual void checkWin() = 0;
};

}  // namespace robosim
