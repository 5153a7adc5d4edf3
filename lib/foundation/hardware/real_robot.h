#pragma once
#include <chrono>
#include <functional>
#include <stdexcept>

#include "hardware/hardware.h"

namespace robosim {

/// The connection with a robot is lost. The message states which, why, and what to do.
class RobotLinkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A robot outside of this program, whose steps are those of its own clock: a real one, or one of another simulator.
/// Usage as NetworkHardware:
///
///     do { … the controller reads and commands robot … } while (robot.nextStep());
///     robot.close();
class RealRobot : public Hardware {
 public:
  static constexpr std::chrono::seconds kSilenceWarning{1};  ///< without readings: logged, and the robot is stopped
  static constexpr std::chrono::seconds kSilenceMax{8};      ///< without readings, as in ARIA's programs

  /// Sends the command, and waits for the next readings. @return false when the program is interrupted, and at the end
  /// of a log @throws RobotLinkError when the connection is lost, or the robot is silent for too long
  virtual bool nextStep() = 0;
  /// Stops the robot, takes steps until it stands, also when the program is interrupted, and ends the connection.
  /// @param each_step called after each of these steps @throws RobotLinkError when the connection is lost
  virtual void close(const std::function<void()>& each_step = [] {}) = 0;
};

}  // namespace robosim
