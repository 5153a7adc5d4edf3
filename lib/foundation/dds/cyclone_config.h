#pragma once
#include <string>

#include "dds/participant.h"

namespace robosim::dds {

/// Configuration of Cyclone DDS for a domain, as XML. Without an interface, only programs on this machine are found and
/// served: by unicast to the ports of up to kMaxParticipants participants on 127.0.0.1, because a loopback interface
/// usually has no multicast. With one, others are found by multicast, and Options::peers by unicast.
/// Source: Cyclone DDS 0.10, docs/manual/options.md. @throws ConfigError for text that is no interface or address
std::string cycloneConfig(const Options& options);

/// Participants of a machine that find each other by unicast.
inline constexpr int kMaxParticipants = 100;

}  // namespace robosim::dds
