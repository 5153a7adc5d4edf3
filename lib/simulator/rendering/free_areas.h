#pragma once
#include <variant>
#include <vector>

#include <mrpt/math/TPoint2D.h>

#include "hardware/readings.h"
#include "hardware/sensor_info.h"
#include "robots/fleet.h"
#include "robots/run_snapshot.h"

namespace robosim {

/// Areas that one range sensor has measured as free, as polygons [m, world frame]: of a laser with more than two beams
/// the area of the scan, otherwise a sector for each beam, as far as its echo. None for a sensor without beams, whose
/// echoes are a cloud of points.
/// @param arc_piece_m length of the straight pieces of a sector's arc; at most 12 pieces
std::vector<std::vector<mrpt::math::TPoint2D>> freeAreas(const RobotSnapshot& robot, const SensorInfo& sensor,
                                                         const Echoes& echoes, double arc_piece_m);

/// What a robot has measured by range and bearing or by range alone, as polylines [m, world frame]: from the sensor to
/// each neighbour, landmark, light or mark (Values of a sensor with a sightingSize()); a circle about the sensor
/// through each beacon (BeaconRanges), whose direction it does not measure. Empty for other kinds of sensor.
std::vector<std::vector<mrpt::math::TPoint2D>> sightLines(const RobotSnapshot& robot, const SensorInfo& sensor,
                                                          const Measurement& measurement);

/// Calls visit(const RobotSnapshot&, const SensorInfo&, lines) for each sensor of the present robots that has
/// sightLines().
template <typename Visit>
void forEachSightLines(const Fleet& fleet, const RunSnapshot& snapshot, const Visit& visit) {
  for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
    const RobotSnapshot& robot = snapshot.robots[i];
    if (!robot.readings || !robot.isPresent()) continue;
    const auto& sensors = *fleet.robots[i].info.sensors;
    for (std::size_t k = 0; k < sensors.size(); ++k) {
      const auto lines = sightLines(robot, sensors[k], robot.readings->measurements[k]);
      if (!lines.empty()) visit(robot, sensors[k], lines);
    }
  }
}

/// Calls visit(const RobotSnapshot&, const SensorInfo&, const Echoes&) for each range sensor of the present robots that
/// have readings.
template <typename Visit>
void forEachEchoes(const Fleet& fleet, const RunSnapshot& snapshot, const Visit& visit) {
  for (std::size_t i = 0; i < snapshot.robots.size(); ++i) {
    const RobotSnapshot& robot = snapshot.robots[i];
    if (!robot.readings || !robot.isPresent()) continue;
    const auto& sensors = *fleet.robots[i].info.sensors;
    for (std::size_t k = 0; k < sensors.size(); ++k) {
      if (const auto* echoes = std::get_if<Echoes>(&robot.readings->measurements[k])) visit(robot, sensors[k], *echoes);
    }
  }
}

}  // namespace robosim
