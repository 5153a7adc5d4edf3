#pragma once
#include "sensors/registry.h"

namespace robosim {

/// Reads <fiducial>: a sensor of fiducial marks with numbers, which objects and robots carry in their middle
/// (Body::fiducial), as Stage has. For sighting i = 1 … count, the nearest first, its values are `id_i`, the mark's
/// number, 0 beyond `id_range_max_m`, -1 for none; `range_i` [m], in plan; `bearing_i` and `orientation_i` [rad], of
/// the body's x axis in the sensor's frame (SightingSensor). A mark is seen from all sides.
std::unique_ptr<Sensor> readFiducial(XmlReader&, const Mount&);

}  // namespace robosim
