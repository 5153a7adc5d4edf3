#pragma once
#include <string>

#include "distributed/ranks/rank_group.h"

namespace robosim {

/// Calls every operation of a group, on all its ranks, with texts of different lengths, also empty ones.
/// @return the first fault; empty for none
std::string faultOf(RankGroup& group);

}  // namespace robosim
