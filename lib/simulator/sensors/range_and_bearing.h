#pragma once
#include "sensors/registry.h"

namespace robosim {

/// Reads <range_and_bearing>: distance and direction to the nearest robots in line of sight, as infrared boards of
/// swarm robots measure them. Model: Gutiérrez et al., "Open E-puck Range & Bearing Miniaturized Board for Local
/// Communication in Swarm Robotics" (ICRA 2009), between the centres of robots, with line of sight in place of signal
/// strengths.
///
/// For neighbour i = 1 … count, the nearest first, its values are `robot_i`, its index in the world; `range_i` [m];
/// `bearing_i` [rad], counter-clockwise from the robot's heading, (-π, π]. A neighbour that does not exist has the
/// robot -1, range 0 and bearing 0.
std::unique_ptr<Sensor> readRangeAndBearing(XmlReader&, const Mount&);

}  // namespace robosim
