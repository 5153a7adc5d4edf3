#pragma once
#include <chrono>
#include <string>

#include "net/access.h"

namespace robosim {

/// Line of the audit log, "audit: 2027-01-31T18:00:00Z anna (ipv4:192.0.2.7:4711): pause": time (UTC), name of the
/// token, peer, and action. Control characters of peer and action are escaped.
std::string auditLine(const Identity& client, const std::string& peer, const std::string& action,
                      Access::Clock::time_point when = Access::Clock::now());

}  // namespace robosim
