#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "robosim_bench/enki.h"
#include "robosim_bench/rays.h"
#include "robosim_bench/recorded_run.h"
#include "robosim_bench/robots.h"

namespace robosim {

/// Numbers of robots that the speed targets refer to.
constexpr std::size_t kSome = 1000;
constexpr std::size_t kMany = 100000;

/// All figures that the targets depend on.
struct SpeedFigures {
  RayBench rays;
  EnkiBench enki;
  std::vector<RobotFigures> loads;  ///< of standardLoads()
  std::vector<Cost> sonar_sector;   ///< of a robot-step, among kSome robots, one thread
  std::vector<Cost> some_many;      ///< the same of kSome and kMany robots with sonars
  std::vector<Cost> one_two;        ///< the same of kMany with one thread, and with two
  LoadingFigures some_loaded;       ///< of the world of kSome robots with sonars
  LoadingFigures many_loaded;
  RecordingFigures small_run;
};

/// Every workload with 100, 1,000 and 10,000 robots by one thread and 1,000 by two; and the sonar workloads with
/// 100,000 by one and by two.
std::vector<RobotLoad> standardLoads();

/// A speed target and its result.
struct Target {
  std::string what;
  std::string target;
  std::string measured;
  std::optional<bool> met;  ///< nullopt if it could not be measured
};

std::vector<Target> readTargets(const SpeedFigures& figures);

}  // namespace robosim
