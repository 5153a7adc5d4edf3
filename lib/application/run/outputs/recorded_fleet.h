#pragma once
#include <optional>
#include <string>

#include "robots/fleet.h"

namespace robosim {

/// Adds the robot that a comment of a recording adds (robotAddedBy()) to the fleet of the steps that follow it.
/// @return nullopt when it adds none, or the fleet has it already
/// @throws ConfigError for an invalid comment, and a robot type that is unknown here
std::optional<RobotInfo> addRecordedRobot(const std::string& comment, Fleet& fleet);

}  // namespace robosim
