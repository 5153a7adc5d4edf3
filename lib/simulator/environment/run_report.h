#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace robosim {

/// Policy for a process that leaves while one of its robots is active.
enum class OnLostRobot {
  wait,       ///< no step is taken until a process drives the robot again
  continue_,  ///< the robot stands still, and the run continues
  fail,       ///< the run ends
};

/// Name of a policy in options and reports: "wait", "continue", "fail".
const char* nameOf(OnLostRobot policy);

/// A robot whose process left while the robot was active.
struct LostRobot {
  std::string name;
  std::uint64_t times = 0;         ///< number of times its process left
  std::uint64_t steps_missed = 0;  ///< steps taken without it
  bool is_lost = false;            ///< currently without a process
  /// Number of times that another process, whose controller has no memory of the run, drove the active robot from then
  /// on. A process that connects again continues its controller.
  std::uint64_t restarts = 0;
  bool operator==(const LostRobot&) const = default;
};

/// A geometry worker that was disconnected because of what it sent.
struct RejectedWorker {
  std::string peer;
  std::uint64_t step = 0;
  std::string reason;
  bool operator==(const RejectedWorker&) const = default;
};

/// Contributions and failures of the clients of a served run. It distinguishes a complete run from a run that finished
/// without some of its robots or with results of an untrusted worker.
struct RunReport {
  OnLostRobot on_lost_robot = OnLostRobot::wait;
  std::vector<LostRobot> lost_robots;            ///< in the world's order
  std::uint64_t messages_lost = 0;               ///< between robots, because a process was absent
  std::uint64_t geometry_workers = 0;            ///< connections of workers whose results the run has used
  std::uint64_t geometry_results = 0;            ///< robots × parts of steps that workers computed
  std::uint64_t results_checked = 0;             ///< of those, recomputed by the environment and compared
  std::uint64_t corrupted_messages = 0;          ///< of workers: discarded because their checksum did not match
  std::vector<RejectedWorker> rejected_workers;  ///< for wrong or impossible results

  /// Whether the run took every step with all of its robots, and no message was lost.
  bool hasAllRobots() const;
  /// Names of the robots whose controller was restarted during the run: repeating it without the restarts gives another
  /// run.
  std::vector<std::string> restartedRobots() const;
  /// Whether no worker returned a wrong or impossible result. Otherwise earlier results of that worker, which only a
  /// sample has checked, may be wrong as well.
  bool isTrusted() const { return rejected_workers.empty(); }
};

}  // namespace robosim
