#pragma once
#include "sensors/registry.h"

namespace robosim {

/// Reads <light>: light sensors on the robot's rim, as foot-bots, e-pucks and Kheperas have.
///
/// `light_i` is the illuminance [lx] of a flat photodiode by all lights within range: the sum of I cos(θ) / d², with a
/// light's intensity I [cd], its distance d, at least 1 cm, and the angle θ between the sensor's axis and the direction
/// to the light; nothing from behind (θ >= 90°). This is the inverse-square cosine law of a point source (DiLaura et
/// al., *The Lighting Handbook*, IES, 10th ed., 2011; Lambert, *Photometria*, 1760). A light is the middle of its body;
/// other bodies cast shadows, the robot that carries the sensor does not. Omitted: ambient light, reflections, the
/// spectrum, and that a real source is no point.
std::unique_ptr<Sensor> readLight(XmlReader&, const Mount&);

}  // namespace robosim
