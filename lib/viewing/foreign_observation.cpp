#include "viewing/foreign_observation.h"

#include <algorithm>
#include <cmath>

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationGasSensors.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include "recording/cone_aperture.h"
#include "world/occupancy_grid.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;
using mrpt::math::TPose3D;
using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationGasSensors;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CObservationRange;
using mrpt::obs::CObservationRobotPose;

/// Maximum number of points per scan; more would only slow down drawing.
constexpr std::size_t kMaxBeams = 2000;

Echo echoOf(const TPose3D& robot_from_beam, float range_m) {
  const auto end = robot_from_beam.composePoint({range_m, 0, 0});
  return {range_m, {static_cast<float>(end.x), static_cast<float>(end.y), static_cast<float>(end.z)}};
}

bool isWithinReach(double x_m, double y_m, double angle_rad) {
  return std::isfinite(angle_rad) && std::abs(x_m) <= kMapReach_m && std::abs(y_m) <= kMapReach_m;
}

bool isWithinReach(const TPose3D& robot_from_sensor, float range_max_m) {
  return isWithinReach(robot_from_sensor.x, robot_from_sensor.y, robot_from_sensor.yaw) &&
         std::isfinite(robot_from_sensor.z) && std::isfinite(robot_from_sensor.pitch) &&
         std::isfinite(robot_from_sensor.roll) && range_max_m >= 0 && range_max_m <= kMapReach_m;
}

/// An observation with one echo per beam.
struct Ranges {
  std::vector<Beam> beams;
  Echoes echoes;
};

std::size_t strideOf(const CObservation2DRangeScan& scan) { return 1 + scan.getScanSize() / kMaxBeams; }

std::size_t beamsIn(const CObservation2DRangeScan& scan) {
  return (scan.getScanSize() + strideOf(scan) - 1) / strideOf(scan);
}
std::size_t beamsIn(const CObservationRange& range) { return range.sensedData.size(); }

Ranges rangesOf(const CObservation2DRangeScan& scan) {
  Ranges ranges;
  const std::size_t stride = strideOf(scan);
  for (std::size_t i = 0; i < scan.getScanSize(); i += stride) {
    TPose3D beam = scan.sensorPose.asTPose();
    // MRPT divides the aperture among the beams, and so gives no angle for a single beam.
    if (scan.getScanSize() > 1) beam.yaw += scan.getScanAngle(i);
    const bool observed = scan.getScanRangeValidity(i) && scan.getScanRange(i) < scan.maxRange;
    ranges.beams.push_back({beam});
    ranges.echoes.push_back(echoOf(beam, observed ? scan.getScanRange(i) : scan.maxRange));
  }
  return ranges;
}

Ranges rangesOf(const CObservationRange& range) {
  Ranges ranges;
  for (const auto& sensed : range) {
    ranges.beams.push_back({sensed.sensorPose});
    const bool observed = sensed.sensedDistance > 0 && sensed.sensedDistance < range.maxSensorDistance;
    ranges.echoes.push_back(echoOf(sensed.sensorPose, observed ? sensed.sensedDistance : range.maxSensorDistance));
  }
  return ranges;
}

Surroundings boxAround(Ranges ranges, double range_max_m) {
  constexpr double kQuantile = 0.9;
  auto& echoes = ranges.echoes;
  std::erase_if(echoes, [&](const Echo& echo) { return echo.range_m >= range_max_m; });
  const auto count = static_cast<std::ptrdiff_t>(std::ceil(kQuantile * static_cast<double>(echoes.size())));
  std::nth_element(echoes.begin(), echoes.begin() + count, echoes.end(),
                   [](const Echo& a, const Echo& b) { return a.range_m < b.range_m; });
  Surroundings box;
  for (auto echo = echoes.begin(); echo != echoes.begin() + count; ++echo) {
    const auto& at = echo->point_m;
    box = {std::min(box.x_min, at.x), std::max(box.x_max, at.x), std::min(box.y_min, at.y), std::max(box.y_max, at.y)};
  }
  return box;
}

}  // namespace

ObservationKind observationKind(const CObservation& observation) {
  const auto within = [](bool is_within_reach, ObservationKind kind) {
    return is_within_reach ? kind : ObservationKind::out_of_range;
  };
  if (const auto* truth = dynamic_cast<const CObservationRobotPose*>(&observation)) {
    const auto& pose = truth->pose.mean;
    return within(isWithinReach(pose.x(), pose.y(), pose.yaw()), ObservationKind::truth);
  }
  if (const auto* odometry = dynamic_cast<const CObservationOdometry*>(&observation)) {
    const auto& pose = odometry->odometry;
    return within(isWithinReach(pose.x(), pose.y(), pose.phi()), ObservationKind::odometry);
  }
  if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation)) {
    return within(isWithinReach(scan->sensorPose.asTPose(), scan->maxRange) && std::isfinite(scan->aperture),
                  ObservationKind::scan);
  }
  if (const auto* range = dynamic_cast<const CObservationRange*>(&observation)) {
    return within(
        std::all_of(range->begin(), range->end(),
                    [&](const auto& sensed) { return isWithinReach(sensed.sensorPose, range->maxSensorDistance); }),
        ObservationKind::ranges);
  }
  if (const auto* heat = dynamic_cast<const CObservationGasSensors*>(&observation)) {
    return heat->m_readings.empty() || !heat->m_readings[0].hasTemperature ? ObservationKind::ignored
                                                                           : ObservationKind::heat;
  }
  return ObservationKind::ignored;
}

TPose2D observedPose(const CObservation& observation) {
  if (const auto* odometry = dynamic_cast<const CObservationOdometry*>(&observation)) {
    return odometry->odometry.asTPose();
  }
  const auto& pose = dynamic_cast<const CObservationRobotPose&>(observation).pose.mean;
  return {pose.x(), pose.y(), pose.yaw()};
}

Measurement observedMeasurement(const CObservation& observation) {
  if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation)) return rangesOf(*scan).echoes;
  if (const auto* range = dynamic_cast<const CObservationRange*>(&observation)) return rangesOf(*range).echoes;
  return Scalar{dynamic_cast<const CObservationGasSensors&>(observation).m_readings.at(0).temperature};
}

Measurement emptyMeasurement(const SensorInfo& sensor) {
  return sensor.kind == SensorKind::heat ? Measurement(Scalar{}) : Measurement(Echoes{});
}

void updateDescription(SensorInfo& sensor, const CObservation& observation) {
  const auto update_ranges = [&](const auto& ranges, double range_max_m) {
    sensor.range_max_m = sensor.no_echo_m = range_max_m;
    // One beam per echo of every moment.
    if (beamsIn(ranges) > sensor.beams.size()) sensor.beams = rangesOf(ranges).beams;
  };
  if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation)) {
    sensor.kind = SensorKind::laser;
    update_ranges(*scan, scan->maxRange);
  } else if (const auto* range = dynamic_cast<const CObservationRange*>(&observation)) {
    sensor.kind = SensorKind::sonar;
    sensor.beam_width_rad = coneAperture_rad(*range);
    update_ranges(*range, range->maxSensorDistance);
  } else {
    sensor.kind = SensorKind::heat;
  }
}

Surroundings observedSurroundings(const CObservation& observation) {
  if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation)) {
    return boxAround(rangesOf(*scan), scan->maxRange);
  }
  if (const auto* range = dynamic_cast<const CObservationRange*>(&observation)) {
    return boxAround(rangesOf(*range), range->maxSensorDistance);
  }
  return {};
}

}  // namespace robosim
