#pragma once
#include <string>

#include "dds/participant.h"

namespace robosim::dds {

/// Configuration of Cyclone DDS for a domain, as XML. Participants of this machine are found by unicast to the ports of
/// the first kMaxParticipants on 127.0.0.1, and by multicast, which leaves this machine only if an interface is named;
/// Options::peers are found by unicast.
/// Source: Cyclone DDS 0.10, docs/manual/options.md. @throws ConfigError for text that is no interface or address
std::string cycloneConfig(const Options& options);

/// Participants of a machine that find each other by unicast.
inline constexpr int kMaxParticipants = 100;

}  // namespace robosim::dds
