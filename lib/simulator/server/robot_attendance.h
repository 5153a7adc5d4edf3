#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "environment/run_report.h"
#include "hardware/command.h"
#include "server/run_info.h"

namespace robosim {

/// Register of the networked robots: which have a process, which have lost theirs, and the steps they missed. A robot
/// is lost while it is active and its process, having joined this run, is disconnected. A halted robot needs no
/// process.
class RobotAttendance {
 public:
  /// Starts a run in which no robot has joined.
  void reset(const RunInfo& run_info);

  /// Continues with the robots that have been added to a run.
  void addRobots(const RunInfo& run_info);

  /// @param continues whether the process has driven the robot in this run before, and connects again
  /// @param step of the run @param is_active whether the robot is active
  void join(std::size_t robot, bool continues, std::uint64_t step, bool is_active);
  /// @param is_active whether the robot was active when its process left
  void leave(std::size_t robot, bool is_active);
  /// Counts a step taken with the robots currently present.
  /// @param activity of all robots
  void countStep(std::span<const Activity> activity);

  std::vector<std::string> neverJoined() const;  ///< networked robots
  std::vector<std::string> absent() const;       ///< networked robots without a process, of any activity
  std::size_t present() const;
  /// Robots that are currently lost.
  std::vector<std::size_t> lost(std::span<const Activity> activity) const;
  /// Each robot that has been lost in this run.
  std::vector<LostRobot> losses(std::span<const Activity> activity) const;

 private:
  struct Entry {
    bool is_networked = false;
    bool has_joined = false;
    bool is_present = false;
    std::uint64_t times_lost = 0;
    std::uint64_t steps_missed = 0;
    std::uint64_t restarts = 0;
    std::uint64_t joined_step = 0;  ///< of the first process
  };
  std::vector<std::string> names_;
  std::vector<Entry> entries_;                  ///< by robot
  std::vector<std::size_t> left_while_active_;  ///< robots that were active when their process left
};

}  // namespace robosim
