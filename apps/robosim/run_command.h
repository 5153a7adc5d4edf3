#pragma once
#include <functional>
#include <string>

#include "robosim/cli11_names.h"
#include "robosim/ros2_arguments.h"
#include "run/local_run.h"
#include "run/run_arguments.h"

namespace robosim {

/// Called for the first step and after each further one.
using ObserveStep = std::function<void()>;

/// Shows a run in a window, which steps it, until the window is closed or a signal ends it.
/// @param speed simulated seconds per second; 0: unlimited
/// @return why the run ended
using RunWindow =
    std::function<EndedBy(LocalRun& run, const RunArguments& arguments, double speed, const ObserveStep& observe)>;

/// What of a run is served, and how.
struct LiveArguments {
  std::string foxglove;  ///< address of --foxglove; empty: none
  std::string web;       ///< address of --web; empty: none
  Ros2Arguments ros2;

  bool isNone() const { return foxglove.empty() && web.empty() && !ros2.is_on; }
};

/// Serves a run to Foxglove, ROS 2 or browsers, and steps it, until it is over or a signal ends it. As RunWindow.
using RunServer = std::function<EndedBy(LocalRun& run, const RunArguments& arguments, const LiveArguments& live,
                                        double speed, const ObserveStep& observe)>;

/// Adds the subcommand `run`, unless the program has it.
/// @param window of --view; null in the executable that has no windows
/// @param server of --foxglove, --ros2 and --web; null in the executable that has no network
void addRunCommand(CLI::App& program, const RunWindow& window, const RunServer& server);

}  // namespace robosim
