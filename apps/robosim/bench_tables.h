#pragma once
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "robosim/bench_rays.h"
#include "robosim/bench_robots.h"
#include "robosim/bench_targets.h"

namespace robosim {

/// The workload that has no robots: benchRays().
constexpr const char* kRays = "rays";

/// @name For a program, an object a line
///@{
nlohmann::ordered_json lineOf(const RobotFigures& figures);
/// A place that 181 rays are cast from counts as a robot there, and casting them as its step.
std::vector<nlohmann::ordered_json> linesOf(const RayBench& bench);
///@}

/// @name For a person
///@{
std::string tableOf(const std::vector<RobotFigures>& loads);
std::string tableOf(const RayBench& bench);
std::string tableOf(const std::vector<Target>& targets);
///@}

}  // namespace robosim
