#pragma once
#include "sensors/registry.h"

namespace robosim {

/// Reads <beacons>, an ultra-wideband receiver: ranges to radio beacons at fixed positions in the world. Walls and
/// robots between antenna and beacon delay the signal. Model: Jourdan, Dardari & Win, "Position Error Bound for UWB
/// Localization in Dense Cluttered Environments" (2008), with one bias for all obstacles instead of one that grows with
/// thickness.
std::unique_ptr<Sensor> readBeacons(XmlReader&, const Mount&);

}  // namespace robosim
