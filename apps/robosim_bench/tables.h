#pragma once
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "robosim_bench/enki.h"
#include "robosim_bench/rays.h"
#include "robosim_bench/robots.h"
#include "robosim_bench/targets.h"

namespace robosim {

/// Name of the workload without robots: benchRays().
constexpr const char* kRays = "rays";
/// Name of the comparison of the workload `infrared` in RoboSim and in Enki: benchEnki().
constexpr const char* kEnki = "enki";

/// @name JSON output, one object per line
///@{
nlohmann::ordered_json toJson(const RobotFigures& figures);
/// Ray casting in the fields of robots: a place with 181 rays is a robot, and casting them is its step.
std::vector<nlohmann::ordered_json> toJsonLines(const RayBench& bench);
std::vector<nlohmann::ordered_json> toJsonLines(const EnkiBench& bench);
///@}

/// @name Text tables
///@{
std::string toTable(const std::vector<RobotFigures>& loads);
std::string toTable(const RayBench& bench);
std::string toTable(const EnkiBench& bench);
std::string toTable(const std::vector<Target>& targets);
///@}

}  // namespace robosim
