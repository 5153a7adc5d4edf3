#pragma once
#include <memory>

#include "base/xml_reader.h"
#include "sensors/sensor.h"

namespace robosim {

struct Mount;

/// Reads <encoders>: the angles by which the two wheels of a differential drive, or those of two tracks, have turned
/// since the start [rad], and their speeds in the last step [rad/s]: of a wheel of radius r at half the track t beside
/// the centre, (length ∓ turn · t / 2) / r. Errors are those of the wheels themselves (WheelErrors), as in <odometry>.
/// The counts of an encoder are the angle times its resolution; that they are whole numbers is not modelled.
std::unique_ptr<Sensor> readEncoders(XmlReader&, const Mount&);

}  // namespace robosim
