#pragma once
#include <memory>

#include "base/xml_reader.h"
#include "sensors/sensor.h"

namespace robosim {

struct Mount;

/// Reads <gnss>: a satellite receiver, which measures its antenna's position on the earth as GnssFix. Without a
/// georeference of the world it has no fix. Errors of position are a stationary Gaussian process of each axis, as the
/// errors of satellites' clocks and orbits and of the atmosphere change slowly, and white noise of the receiver. The
/// process is linear between independent values every `correlation_s`, with weights that keep its variance, so that it
/// needs no memory.
std::unique_ptr<Sensor> readGnss(XmlReader&, const Mount&);

}  // namespace robosim
