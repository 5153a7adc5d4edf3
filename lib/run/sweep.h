#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "run/run_summary.h"

namespace robosim {

/// The choices that a text with lists of values stands for, in order: "flocking cohesion=0.1,0.3 radius_m=1,2" is four.
/// @throws ConfigError for a malformed text, and for more than 10,000 choices
std::vector<std::string> expandedChoices(const std::string& choice);

/// Many independent runs: each controller in each world, with several seeds.
struct SweepOptions {
  std::vector<std::string> controllers{""};  ///< of all robots, as TypeChoice::text(); "": those of the world
  std::vector<std::string> observers;        ///< of each run; they do not log
  std::uint64_t seed = 1;                    ///< of the first run, incremented by 1 for each further run
  std::size_t runs = 20;                     ///< of each controller in each world, with different start poses
  double time_s = 1800;                      ///< simulated time limit of a run
  double period_s = 0.1;                     ///< time step
  int threads = 1;                           ///< concurrent runs; does not affect the results
};

/// The runs of one controller in one world.
struct SweepGroup {
  std::string world, controller;
  std::vector<RunSummary> runs;  ///< those completed, in order of their seeds
};

/// Runs all, each from random start poses (RandomStarts).
/// @param is_interrupted ends the sweep early; runs not completed are missing
/// @param progress called after each run with the number of runs completed
/// @return by world, then by controller
/// @throws ConfigError, ControllerError, ObserverError
std::vector<SweepGroup> sweep(const std::vector<LoadedWorld>& worlds, const SweepOptions& options,
                              const std::function<bool()>& is_interrupted,
                              const std::function<void(std::size_t done)>& progress);

}  // namespace robosim
