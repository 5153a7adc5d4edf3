#pragma once
#include <optional>

#include "sensors/sensor.h"

namespace robosim {

/// Whether another robot is in view of a sonar, so that its pings may be received: within range, within `half_rad` of
/// the axis, its body at the sonar's height and not hidden. All robots are assumed to ping, at times that do not depend
/// on those of this robot; a received ping is therefore equally likely to appear at any range.
bool mayReceivePing(const Snapshot& now, std::uint32_t robot, const Ray& axis, double half_rad, double range_max_m);

}  // namespace robosim
