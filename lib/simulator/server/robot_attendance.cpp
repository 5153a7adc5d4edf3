#include "server/robot_attendance.h"

#include <algorithm>

namespace robosim {

void RobotAttendance::reset(const RunInfo& run_info) {
  names_ = run_info.robot_names;
  entries_.assign(names_.size(), {});
  for (std::size_t i = 0; i < entries_.size(); ++i) entries_[i].is_networked = run_info.is_networked[i] != 0;
  left_while_active_.clear();
}

void RobotAttendance::addRobots(const RunInfo& run_info) {
  names_ = run_info.robot_names;
  for (std::size_t i = entries_.size(); i < names_.size(); ++i) {
    entries_.push_back({});
    entries_[i].is_networked = run_info.is_networked[i] != 0;
  }
}

void RobotAttendance::join(std::size_t robot, bool continues, std::uint64_t step, bool is_active) {
  Entry& entry = entries_[robot];
  if (!entry.has_joined) {
    entry.joined_step = step;
  } else if (!continues && is_active && step > entry.joined_step) {
    ++entry.restarts;
  }
  entry.has_joined = entry.is_present = true;
  std::erase(left_while_active_, robot);
}

void RobotAttendance::leave(std::size_t robot, bool is_active) {
  Entry& entry = entries_[robot];
  if (!entry.is_present) return;
  entry.is_present = false;
  if (!is_active) return;
  left_while_active_.push_back(robot);
  ++entry.times_lost;
}

void RobotAttendance::countStep(std::span<const Activity> activity) {
  for (const auto robot : lost(activity)) ++entries_[robot].steps_missed;
}

std::vector<std::string> RobotAttendance::neverJoined() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].is_networked && !entries_[i].has_joined) names.push_back(names_[i]);
  }
  return names;
}

std::vector<std::string> RobotAttendance::absent() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].is_networked && !entries_[i].is_present) names.push_back(names_[i]);
  }
  return names;
}

std::size_t RobotAttendance::present() const {
  return static_cast<std::size_t>(
      std::count_if(entries_.begin(), entries_.end(), [](const Entry& entry) { return entry.is_present; }));
}

std::vector<std::size_t> RobotAttendance::lost(std::span<const Activity> activity) const {
  std::vector<std::size_t> robots;
  for (const auto robot : left_while_active_) {
    if (activity[robot] == Activity::active) robots.push_back(robot);
  }
  std::sort(robots.begin(), robots.end());
  return robots;
}

std::vector<LostRobot> RobotAttendance::losses(std::span<const Activity> activity) const {
  const std::vector<std::size_t> now = lost(activity);
  std::vector<LostRobot> all;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Entry& entry = entries_[i];
    if (entry.times_lost == 0 && entry.restarts == 0) continue;
    all.push_back({names_[i], entry.times_lost, entry.steps_missed, std::binary_search(now.begin(), now.end(), i),
                   entry.restarts});
  }
  return all;
}

}  // namespace robosim
