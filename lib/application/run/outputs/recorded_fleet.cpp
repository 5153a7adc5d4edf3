#include "run/outputs/recorded_fleet.h"

#include <algorithm>
#include <utility>

#include "robots/added_robot.h"
#include "run/outputs/intervention_note.h"

namespace robosim {

std::optional<RobotInfo> addRecordedRobot(const std::string& comment, Fleet& fleet) {
  const auto added = robotAddedBy(comment);
  if (!added) return std::nullopt;
  const bool is_known = std::any_of(fleet.robots.begin(), fleet.robots.end(),
                                    [&](const FleetRobot& robot) { return robot.info.name == added->name; });
  if (is_known) return std::nullopt;
  fleet = withRobot(std::move(fleet), *added);
  return fleet.robots.back().info;
}

}  // namespace robosim
