#pragma once
#include <string>

namespace robosim::arcos {

/// The readings of an analogue gyro in a cycle (packet_type::gyro): four means over 25 ms of its voltage, which is 2.5
/// V at rest and 2.5 V less at 300°/s, counter-clockwise, by a converter of 10 bits for 5 V; programs of ARIA divide
/// the rate by the scale of their parameter file, 1.626 for all robots. What is rounded off a reading is added to the
/// next one.
std::string encodeGyro(double turn_radps);

}  // namespace robosim::arcos
