#pragma once
#include "sensors/registry.h"

namespace robosim {

/// Reads <omni_camera>: a camera below a curved mirror that sees coloured lights all around, as foot-bots have: the
/// LEDs of other robots (Command::led_color), in the middle of their tops, and the lights of objects
/// (Body::light_cd), in the colour of their bodies. For sighting i = 1 … count, the nearest first, its values are
/// `color_i`, 0xRRGGBB, -1 for none; `range_i` [m], in plan; `bearing_i` [rad] (SightingSensor). Omitted: blobs of
/// lights that are close together merge in a real picture, and colours vary with the exposure.
std::unique_ptr<Sensor> readOmniCamera(XmlReader&, const Mount&);

}  // namespace robosim
