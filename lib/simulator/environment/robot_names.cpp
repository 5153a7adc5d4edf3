#include "environment/robot_names.h"

#include <algorithm>
#include <numeric>

namespace robosim {

void RobotNames::setRobots(std::span<const FleetRobot> robots) {
  robots_ = robots;
  by_name_.resize(robots.size());
  std::iota(by_name_.begin(), by_name_.end(), 0U);
  std::sort(by_name_.begin(), by_name_.end(), [&](auto a, auto b) { return (*this)[a] < (*this)[b]; });
  has_list_ = false;
}

std::optional<std::uint32_t> RobotNames::find(const std::string& name) const {
  const auto found = std::lower_bound(by_name_.begin(), by_name_.end(), name,
                                      [&](std::uint32_t robot, const std::string& of) { return (*this)[robot] < of; });
  if (found == by_name_.end() || (*this)[*found] != name) return std::nullopt;
  return *found;
}

const std::vector<std::string>& RobotNames::list() const {
  if (has_list_) return list_;
  const std::lock_guard lock(making_list_);
  if (has_list_) return list_;
  list_.clear();
  for (const FleetRobot& robot : robots_) list_.push_back(robot.info.name);
  has_list_ = true;
  return list_;
}

}  // namespace robosim
