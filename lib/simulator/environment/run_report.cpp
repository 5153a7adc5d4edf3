#include "environment/run_report.h"

#include <algorithm>

namespace robosim {

const char* nameOf(OnLostRobot policy) {
  switch (policy) {
    case OnLostRobot::wait:
      return "wait";
    case OnLostRobot::continue_:
      return "continue";
    case OnLostRobot::fail:
      return "fail";
  }
  return "";
}

std::vector<std::string> RunReport::restartedRobots() const {
  std::vector<std::string> names;
  for (const auto& robot : lost_robots) {
    if (robot.restarts > 0) names.push_back(robot.name);
  }
  return names;
}

bool RunReport::hasAllRobots() const {
  return messages_lost == 0 && std::none_of(lost_robots.begin(), lost_robots.end(), [](const LostRobot& robot) {
           return robot.is_lost || robot.steps_missed > 0;
         });
}

}  // namespace robosim
