#pragma once
#include <string>

#include "base/ros_distribution.h"
#include "environment/world_changes.h"
#include "robots/robot_selection.h"
#include "robots/view_layers.h"
#include "robots/world_source.h"
#include "run/local_run.h"
#include "run/run_summary.h"

namespace robosim {

/// Settings of a run, local or served.
struct RunArguments {
  std::string world;
  WorldChanges changes;
  RunOptions run;
  double time_s = 1800;
  std::string speed = "max";
  std::string record;
  bool is_recorded_on_request = false;  ///< the recording is off until it is requested
  std::string rawlog_format = "obs";
  std::string record_images = "embedded";
  RosDistribution distribution = RosDistribution::jazzy;  ///< of messages of ROS 2
  std::string picture;
  ViewLayers layers;    ///< of the picture
  RobotSelection only;  ///< of the picture
  bool json = false;

  /// Whether the time limit is reached.
  bool timeIsUp(const SimTime& now) const;
};

/// Why no robot can be added during a run with these outputs; empty if robots can be added.
std::string whyNoAdditions(const RunArguments& arguments);

/// The world given by the arguments, including their changes. @throws ConfigError
WorldSource readRunSource(const RunArguments& arguments);

/// What the arguments and the run say about the result; without what only the caller knows, such as the elapsed time.
RunSummary summaryOf(const RunArguments& arguments, const LocalRun& run, EndedBy ended_by);

/// Prints a summary in the form that the arguments request.
void printSummary(const RunSummary& summary, const RunArguments& arguments);

}  // namespace robosim
