#pragma once
#include <cstddef>
#include <vector>

#include "robosim/v1/robots.pb.h"
#include "server/run_info.h"

namespace robosim {

/// Checks the protocol version of a robots' process, and that it does not belong to another world or run.
/// @throws WireError
void checkHello(const v1::RobotsHello& hello, const RunInfo& run_info);

/// Indices in the world of the robots named by a hello, in its order.
/// @throws WireError for a robot that the world does not have, that the environment drives itself, or that is named
/// twice.
std::vector<std::size_t> resolveRobots(const v1::RobotsHello& hello, const RunInfo& run_info);

}  // namespace robosim
