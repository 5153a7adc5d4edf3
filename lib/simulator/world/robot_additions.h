#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "world/intervention.h"

namespace robosim {

/// The robots that interventions have added to a world during a run, in the order of their addition. They are the last
/// in the world's order. Copies share one list, which never changes.
class RobotAdditions {
 public:
  RobotAdditions() = default;
  explicit RobotAdditions(std::vector<AddRobot> robots)
      : robots_(robots.empty() ? nullptr : std::make_shared<const std::vector<AddRobot>>(std::move(robots))) {}

  std::span<const AddRobot> list() const { return robots_ ? *robots_ : std::span<const AddRobot>(); }
  std::size_t size() const { return list().size(); }
  /// These, and another robot.
  RobotAdditions with(const AddRobot& robot) const {
    std::vector<AddRobot> all(list().begin(), list().end());
    all.push_back(robot);
    return RobotAdditions(std::move(all));
  }
  bool operator==(const RobotAdditions& other) const {
    return robots_ == other.robots_ || (robots_ && other.robots_ && *robots_ == *other.robots_);
  }

 private:
  std::shared_ptr<const std::vector<AddRobot>> robots_;  ///< null: none
};

}  // namespace robosim
