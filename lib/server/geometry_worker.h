#pragma once
#include <functional>
#include <string>

#include "net/dial.h"

namespace robosim {

/// Works for an environment elsewhere: keeps a replica of its world, and does its share of each step, until the run is
/// over.
/// @param log takes one line
/// @throws ConnectionError when nobody answers, the environment hangs up, or is gone; ConfigError for a world that
/// cannot be built here.
void workForEnvironment(const DialOptions& dial_options, int threads,
                        const std::function<void(const std::string&)>& log);

}  // namespace robosim
