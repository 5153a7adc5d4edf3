#pragma once
#include <string>
#include <string_view>

#include "environment/model.h"
#include "run/local_run.h"

namespace robosim {

struct DistributionOptions;

/// Bytes that are equal on ranks that take part in one run: they identify the version of RoboSim, the world and the
/// parameters of the model, the controller and neighbour of each robot, and the options that affect the run or how it
/// is distributed. Contents of plugins are not identified.
std::string describeIdentity(const Model& model, const RunOptions& options, const DistributionOptions& distribution);

/// @param own, first describeIdentity() of this rank and of rank 0
/// @throws ConfigError naming what differs between them
void requireSameRun(std::string_view own, std::string_view first);

}  // namespace robosim
