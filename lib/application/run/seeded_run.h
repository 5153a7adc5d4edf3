#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "environment/environment.h"
#include "environment/start_poses.h"
#include "run/run_summary.h"

namespace robosim {

/// One of many independent runs.
struct SeededRun {
  std::string controller;              ///< of all robots, as TypeChoice::text(); empty: those of the world
  std::vector<std::string> observers;  ///< they do not log
  std::uint64_t seed = 1;
  double time_s = 1800;         ///< simulated time limit
  double period_s = 0.1;        ///< time step
  double breakdown_mean_s = 0;  ///< RunOptions::breakdown_mean_s
};

/// Runs a world from random start poses on the calling thread. Cameras take pictures if something reads them
/// (needPictures()).
/// @param starts of the same world
/// @param observe called before the first step and after each one; empty: nothing
/// @return nullopt when interrupted
/// @throws ConfigError, ControllerError, ObserverError
std::optional<RunSummary> runSeeded(const LoadedWorld& world, const RandomStarts& starts, const SeededRun& how,
                                    const std::function<bool()>& is_interrupted,
                                    const std::function<void(const Environment&)>& observe = {});

}  // namespace robosim
