#pragma once
#include <vector>

#include "dynamics/group_moment.h"

namespace robosim {

/// The farthest that an object may move in a part of a step [m].
double islandReach(const PushingGroup& group, double duration_s);

/// Divides the bodies of a group that may move in a part of a step into islands. Objects at rest that nothing can touch
/// are in none.
/// @param from where the bodies are  @param robots_to where the robots are at the end, unless they are blocked
std::vector<Island> islandsOf(const PushingGroup& group, const GroupMoment& from,
                              const std::vector<mrpt::math::TPoint2D>& robots_to, double duration_s);

}  // namespace robosim
