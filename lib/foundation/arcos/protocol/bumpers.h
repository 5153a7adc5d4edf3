#pragma once
#include <cstdint>

#include "arcos/protocol/parameters.h"

namespace robosim::arcos {

/// Where a SIP reports contact at a direction of the body: in its front or rear byte, by a bit.
struct BumperPlace {
  bool is_front = true;
  std::uint8_t bit = 0;  ///< 0 if the robot type has no bumper there
};

/// Bumpers are counted clockwise: those in front from the left side to the right, those behind from the right side to
/// the left. Bit 0 is the stall of a wheel.
/// @param direction_rad robot frame, counter-clockwise from straight ahead
BumperPlace bumperAt(double direction_rad, const Parameters& parameters);

}  // namespace robosim::arcos
