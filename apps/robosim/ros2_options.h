#pragma once
#include <functional>
#include <optional>
#include <string>

#include "robosim/ros2_arguments.h"
#include "serving/ros2_serving.h"

namespace robosim {

/// What --ros2 requests; nullopt without it. @param distribution whose messages are sent
/// @param has_tokens whether other clients need tokens
/// @param log takes one line; thread-safe @throws ConfigError for options that do not fit
std::optional<Ros2Options> ros2Options(const Ros2Arguments& arguments, RosDistribution distribution, bool has_tokens,
                                       const std::function<void(const std::string&)>& log);

}  // namespace robosim
