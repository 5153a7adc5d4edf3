#pragma once
#include <string>

#include <mrpt/obs/CObservation.h>

#include "hardware/command.h"
#include "hardware/readings.h"

namespace robosim {

/// The label's second half for what a person who drives a robot does.
inline constexpr const char* kDriver = "DRIVER";

/// What happens to one robot besides what its sensors measure, as a stock MRPT observation: a CObservationRawDAQ with
/// the label DRIVER in each step in which something of it changes.
///
///  * Analog outputs (AOUT_double) 0, 1, 2: the speed [m/s], turn [rad/s] and laser pan [rad] that a driver commands
///  * digital output 0: a person drives (Command::by_driver); 0 once the robot's controller has it again
///  * digital output 1: the robot has asked whether it has won, and is too far from the gold
///  * digital output 2: the robot has won
class Remarks {
 public:
  explicit Remarks(std::string robot) : robot_(std::move(robot)) {}

  /// @param command that the robot obeyed in the step whose readings these are
  /// @return null when there is nothing to say
  mrpt::obs::CObservation::Ptr of(const Readings& readings, const Command& command);

 private:
  struct Told {
    Command command;
    std::uint8_t outputs = 0;
    bool operator==(const Told&) const = default;
  };
  std::string robot_;
  Told told_;
};

}  // namespace robosim
