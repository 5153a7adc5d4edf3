#pragma once
#include <string>

#include <nlohmann/json.hpp>

#include "robosim_bench/rounds.h"
#include "robosim_bench/workloads.h"

namespace robosim {

/// A workload with a number of robots and of threads.
struct RobotLoad {
  const Workload* workload = nullptr;
  std::size_t robots = 0;
  int threads = 1;
};

/// Measured cost of a RobotLoad.
struct RobotFigures {
  std::string workload;
  std::size_t rays = 0;  ///< Workload::rays
  std::size_t robots = 0;
  int threads = 1;
  Cost robot_step;
  double peak_rss_mb = 0;  ///< of the measuring process
  double make_s = 0;       ///< time to create the world up to the first step
  std::string digest;      ///< of a fixed number of first steps
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RobotFigures, workload, rays, robots, threads, robot_step, peak_rss_mb, make_s,
                                   digest)

/// Measures one load in a separate process.
RobotFigures benchRobots(const RobotLoad& load, std::uint64_t seed, double min_s);

/// Cost of a robot-step of each load, measured alternately in one process.
std::vector<Cost> compareRobots(const std::vector<RobotLoad>& loads, std::uint64_t seed, double min_s);

/// Cost of loading a world from its file up to the first step.
struct LoadingFigures {
  Cost load;
  double rss_growth_mb = 0;  ///< growth of the process after a few steps
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LoadingFigures, load, rss_growth_mb)

/// Writes the world to a file and loads it in a separate process.
LoadingFigures benchLoading(const Workload& workload, std::size_t robots, std::uint64_t seed);

}  // namespace robosim
