#pragma once
#include "robots/fleet.h"
#include "world/intervention.h"

namespace robosim {

/// A fleet with one more robot, the last. The others remain as they are, also in their colours; the new one has that of
/// its element, else that of its type if no other robot has it, else one of paletteColor().
/// @throws ConfigError for an unknown or faulty type, and when the robots would exceed kWorldBeamsMax or
/// kWorldModelRaysMax, or their pictures kWorldPictureBytesMax
Fleet withRobot(Fleet fleet, const AddRobot& robot);

}  // namespace robosim
