#pragma once
#include <memory>

#include "dds/participant.h"

namespace robosim::dds {

/// Joins a domain by Cyclone DDS. Participants of one process in one domain share its configuration, that of the first
/// of them.
/// @throws ConfigError as cycloneConfig() @throws std::runtime_error when that is not possible, and why
std::unique_ptr<Participant> joinByCyclone(const Options& options);

}  // namespace robosim::dds

/// joinByCyclone() for dlsym(). The caller owns the result.
extern "C" robosim::dds::Participant* robosimJoinDds(const robosim::dds::Options& options);
