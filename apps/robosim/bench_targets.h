#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "robosim/bench_rays.h"
#include "robosim/bench_robots.h"
#include "robosim/bench_small_run.h"

namespace robosim {

/// What RoboSim wants to reach in speed is told of these sizes.
constexpr std::size_t kSome = 1000;
constexpr std::size_t kMany = 100000;

/// Everything that is measured for the targets.
struct SpeedFigures {
  RayBench rays;
  std::vector<RobotFigures> loads;  ///< those of standardLoads()
  std::vector<Cost> sonar_sector;   ///< of a robot-step, among kSome robots, one thread
  std::vector<Cost> some_many;      ///< the same of kSome and kMany robots with sonars
  std::vector<Cost> one_two;        ///< the same of kMany with one thread, and with two
  LoadingFigures some_loaded;       ///< of the world of kSome robots with sonars
  LoadingFigures many_loaded;
  SmallRunFigures small_run;
};

/// Every workload with 100, 1,000 and 10,000 robots by one thread and 1,000 by two; and the sonars with 100,000 by
/// both.
std::vector<RobotLoad> standardLoads();

/// Something RoboSim wants to reach, and whether it does.
struct Target {
  std::string what;
  std::string wanted;
  std::string measured;
  std::optional<bool> met;  ///< nothing where it could not be measured
};

std::vector<Target> targetsOf(const SpeedFigures& figures);

}  // namespace robosim
