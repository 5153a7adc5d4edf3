#pragma once
#include "sensors/registry.h"

namespace robosim {

/// Reads <ground>: sensors under the robot that read how bright the floor is at the points below them, as foot-bots
/// and e-pucks have.
///
/// The floor's areas are the objects that are not above it (Body::isFloor()); of several at a point, the last one in
/// the world's order is on top. Below them are the maps without height (WorldMap::isFloor()). The reading `grey_i` is
/// the luma of its colour, 0.299 red + 0.587 green + 0.114 blue (ITU-R BT.601), in [0, 1]; 1, white, where there is
/// none. Omitted: the size of the spot that a real sensor sees, and light from elsewhere.
std::unique_ptr<Sensor> readGround(XmlReader&, const Mount&);

/// The luma of a colour, [0, 1].
double greyOf(const std::array<float, 3>& rgb);

}  // namespace robosim
