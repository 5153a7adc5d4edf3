#pragma once
#include <cstdint>
#include <vector>

#include "dynamics/group_moment.h"

namespace robosim {

/// Gaps that shifts leave at least, unless objects are wedged [m].
constexpr double kGapMin_m = kContactGap_m / 4;

/// Shifts objects until nothing is nearer to them than kContactGap_m, by the shortest way in (x, y, turn_radius ·
/// turn): nonlinear Gauss-Seidel, each contact with both of its points at once.
/// @param pushing set to 1 for each pair that was too near
void shiftApart(const PushingGroup& group, const Island& island, GroupMoment& moment,
                std::vector<std::uint8_t>& pushing);

}  // namespace robosim
