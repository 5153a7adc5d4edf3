#pragma once
#include <memory>

#include "dds/participant.h"

namespace robosim {

/// Joins a domain of ROS 2 by joinByCyclone() of dds/cyclone, in a library that is loaded when this is called.
/// @throws ConfigError when this installation lacks the library, or as joinByCyclone() @throws std::runtime_error
std::unique_ptr<dds::Participant> joinDds(const dds::Options& options);

}  // namespace robosim
