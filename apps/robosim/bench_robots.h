#pragma once
#include <string>

#include <nlohmann/json.hpp>

#include "robosim/bench_rounds.h"
#include "robosim/workloads.h"

namespace robosim {

/// A standard workload, so many robots, stepped by so many threads.
struct RobotLoad {
  const Workload* workload = nullptr;
  std::size_t robots = 0;
  int threads = 1;
};

/// What it cost.
struct RobotFigures {
  std::string workload;
  std::size_t robots = 0;
  int threads = 1;
  Cost robot_step;
  double peak_rss_mb = 0;  ///< of the process that did nothing else
  double make_s = 0;       ///< the world, until the first step could be taken
  std::string digest;      ///< of the first steps, of which there are as many always
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RobotFigures, workload, robots, threads, robot_step, peak_rss_mb, make_s, digest)

/// Measures one load, in a process of its own.
RobotFigures benchRobots(const RobotLoad& load, std::uint64_t seed, double least_s);

/// What a robot-step of each costs, in turns, in one process.
std::vector<Cost> compareRobots(const std::vector<RobotLoad>& loads, std::uint64_t seed, double least_s);

/// What it takes to have a world from its file, ready to be stepped.
struct LoadingFigures {
  double load_s = 0;
  double rss_growth_mb = 0;  ///< what the process held more than before, once some steps had been taken
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LoadingFigures, load_s, rss_growth_mb)

/// Writes the world to a file, and loads that in a process of its own.
LoadingFigures benchLoading(const Workload& workload, std::size_t robots, std::uint64_t seed);

}  // namespace robosim
