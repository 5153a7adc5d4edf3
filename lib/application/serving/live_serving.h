#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "net/access.h"
#include "run/local_run.h"
#include "serving/foxglove_serving.h"
#include "serving/page_serving.h"
#include "serving/robot_drivers.h"
#include "serving/ros2_serving.h"

namespace robosim {

struct LiveOptions {
  std::optional<FoxgloveOptions> foxglove;
  std::optional<Ros2Options> ros2;
  std::optional<PageOptions> page;
  Access access;                                                            ///< rights to drive, by token
  std::function<void(const std::string&)> log = [](const std::string&) {};  ///< takes one line; thread-safe

  bool isNone() const { return !foxglove && !ros2 && !page; }
};

/// Serves the runs of a program by the topics of ROS 2 to Foxglove and to ROS 2, whose clients share the drivers of the
/// robots, and on a page to browsers. All functions are called by the thread that steps the environment; none of them
/// waits.
class LiveServing {
 public:
  /// Opens the ports and joins the domain. @throws as FoxgloveServing, Ros2Serving and PageServing
  explicit LiveServing(const LiveOptions& options);

  /// Serves a run instead of the one before, which must still exist. @param run must outlive its time here
  /// @param run_id another one for each run
  /// @param why_not_driven by robot: why it cannot be driven; empty if this process has its controller
  void begin(LocalRun& run, const std::string& run_id, std::uint64_t seed,
             const std::vector<std::string>& why_not_driven);
  /// Serves the robots that have been added to the run, too. Parameters as of begin()
  void addRobots(LocalRun& run, const std::vector<std::string>& why_not_driven);
  /// Handles requests, and sends the state to new clients. Between steps, at least every ServingState::kPollInterval.
  /// @param is_over whether the run is over, and can no longer be changed
  void poll(RunControl& control, const FoxgloveRecording& recording, bool is_over, const Intervene& intervene);
  /// Sends the messages of a step.
  void stepped();
  /// By robot: whether its pictures are received. Empty for none.
  std::vector<std::uint8_t> pictured() const;

 private:
  FoxgloveRun foxgloveRun(const Environment& environment) const;

  RobotDrivers drivers_;
  std::string run_id_;
  std::uint64_t seed_ = 0;
  std::unique_ptr<FoxgloveServing> foxglove_;  ///< null: none
  std::unique_ptr<Ros2Serving> ros2_;          ///< null: none
  std::unique_ptr<PageServing> page_;          ///< null: none
};

}  // namespace robosim
