#include "viewing/foreign_observation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationBeaconRanges.h>
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationGPS.h>
#include <mrpt/obs/CObservationGasSensors.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationRotatingScan.h>

#include "base/angle_units.h"
#include "hardware/numbered_quantities.h"
#include "recording/cone_aperture.h"
#include "viewing/foreign_cloud.h"
#include "world/occupancy_grid.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;
using mrpt::math::TPose3D;
using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationBeaconRanges;
using mrpt::obs::CObservationBearingRange;
using mrpt::obs::CObservationGasSensors;
using mrpt::obs::CObservationGPS;
using mrpt::obs::CObservationOdometry;
using mrpt::obs::CObservationRange;
using mrpt::obs::CObservationRobotPose;
using mrpt::obs::CObservationRotatingScan;

/// Maximum number of points per scan, and of landmarks and beacons; more would only slow down drawing.
constexpr std::size_t kMaxBeams = 2000, kMaxLandmarks = 200;

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
  const double aperture_rad = scan.rightToLeft ? scan.aperture : -scan.aperture;
  for (std::size_t i = 0; i < scan.getScanSize(); i += stride) {
    TPose3D beam = scan.sensorPose.asTPose();
    // As scan.getScanAngle(i), which has the precision of a float, and no angle for a single beam.
    if (scan.getScanSize() > 1) {
      beam.yaw += aperture_rad * (static_cast<double>(i) / static_cast<double>(scan.getScanSize() - 1) - 0.5);
    }
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

/// The middle row of a scanner that rotates: the elevations of its rows are not recorded, and the middle one looks
/// nearly level.
Ranges rangesOf(const CObservationRotatingScan& scan) {
  Ranges ranges;
  const auto row = scan.rangeImage.rows() / 2;
  const auto columns = scan.rangeImage.cols();
  const auto stride = 1 + columns / static_cast<long>(kMaxBeams);
  const TPose3D mount = scan.sensorPose.asTPose();
  for (long i = 0; i < columns; i += stride) {
    TPose3D beam = mount;
    beam.yaw += scan.startAzimuth + scan.azimuthSpan * static_cast<double>(i) / static_cast<double>(columns);
    const double range_m = scan.rangeImage(row, i) * scan.rangeResolution;
    const bool observed = range_m > 0 && range_m < scan.maxRange;
    ranges.beams.push_back({beam});
    ranges.echoes.push_back(echoOf(beam, static_cast<float>(observed ? range_m : scan.maxRange)));
  }
  return ranges;
}
std::size_t beamsIn(const CObservationRotatingScan& scan) {
  const auto columns = static_cast<std::size_t>(scan.rangeImage.cols());
  const std::size_t stride = 1 + columns / kMaxBeams;
  return (columns + stride - 1) / stride;
}

/// Horizontal ranges and bearings to landmarks, as of a sensor with neighbourQuantities().
Values bearingsOf(const CObservationBearingRange& bearings) {
  Values values;
  for (std::size_t i = 0; i < std::min(bearings.sensedData.size(), kMaxLandmarks); ++i) {
    const auto& sensed = bearings.sensedData[i];
    const double range_m = sensed.range * std::cos(sensed.pitch), bearing_rad = sensed.yaw;
    if (!isWithinReach(range_m, 0, bearing_rad)) continue;
    values.values.insert(values.values.end(),
                         {static_cast<double>(std::max(0, sensed.landmarkID)), range_m, bearing_rad});
  }
  return values;
}

BeaconRanges toBeaconRanges(const CObservationBeaconRanges& beacons) {
  BeaconRanges ranges;
  for (std::size_t i = 0; i < std::min(beacons.sensedData.size(), kMaxLandmarks); ++i) {
    const float range_m = beacons.sensedData[i].sensedDistance;
    ranges.range_m.push_back(range_m >= 0 && range_m <= kMapReach_m ? range_m : std::numeric_limits<float>::max());
  }
  return ranges;
}

std::optional<Geodetic> positionIn(const CObservationGPS& gps) {
  if (gps.hasMsgClass<mrpt::obs::gnss::Message_NMEA_GGA>()) {
    const auto& fix = gps.getMsgByClass<mrpt::obs::gnss::Message_NMEA_GGA>().fields;
    if (fix.fix_quality != 0) return Geodetic{fix.latitude_degrees, fix.longitude_degrees};
  }
  if (gps.hasMsgClass<mrpt::obs::gnss::Message_NMEA_RMC>()) {
    const auto& fix = gps.getMsgByClass<mrpt::obs::gnss::Message_NMEA_RMC>().fields;
    if (fix.validity_char == 'A') return Geodetic{fix.latitude_degrees, fix.longitude_degrees};
  }
  return std::nullopt;
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
  if (const auto* scan = dynamic_cast<const CObservationRotatingScan*>(&observation)) {
    if (scan->rangeImage.size() == 0) return ObservationKind::ignored;
    return within(isWithinReach(scan->sensorPose.asTPose(), static_cast<float>(scan->maxRange)) &&
                      std::isfinite(scan->startAzimuth) && std::isfinite(scan->azimuthSpan) &&
                      std::isfinite(scan->rangeResolution),
                  ObservationKind::scan);
  }
  if (isCloud(observation)) {
    mrpt::poses::CPose3D mount;
    observation.getSensorPose(mount);
    if (!isWithinReach(mount.asTPose(), 0)) return ObservationKind::out_of_range;
    return pointsOf(observation).empty() ? ObservationKind::ignored : ObservationKind::points;
  }
  if (const auto* bearings = dynamic_cast<const CObservationBearingRange*>(&observation)) {
    return within(isWithinReach(bearings->sensorLocationOnRobot.asTPose(), 0), ObservationKind::bearings);
  }
  if (const auto* beacons = dynamic_cast<const CObservationBeaconRanges*>(&observation)) {
    const auto& all = beacons->sensedData;
    return within(std::all_of(all.begin(), all.end(),
                              [](const auto& sensed) {
                                const auto& at = sensed.sensorLocationOnRobot;
                                return isWithinReach(at.x(), at.y(), at.z());
                              }),
                  ObservationKind::beacons);
  }
  if (const auto* gps = dynamic_cast<const CObservationGPS*>(&observation)) {
    const auto at = positionIn(*gps);
    if (!at) return ObservationKind::ignored;
    return within(std::abs(at->latitude_deg) <= 90 && std::abs(at->longitude_deg) <= 360, ObservationKind::satellites);
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

Geodetic observedPosition(const CObservation& observation) {
  return positionIn(dynamic_cast<const CObservationGPS&>(observation)).value();
}

mrpt::math::TPoint2D localMetres(const Geodetic& origin, const Geodetic& position) {
  constexpr double kEquator_m = 6378137, kFlattening = 1 / 298.257223563;  // WGS 84
  constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);
  struct Axes {
    double x, y, z;
  };
  const auto fixed_to_earth = [&](const Geodetic& at) -> Axes {
    const double latitude = at.latitude_deg * kRadPerDeg, longitude = at.longitude_deg * kRadPerDeg;
    const double normal_m = kEquator_m / std::sqrt(1 - kEccentricity2 * std::sin(latitude) * std::sin(latitude));
    return {normal_m * std::cos(latitude) * std::cos(longitude), normal_m * std::cos(latitude) * std::sin(longitude),
            normal_m * (1 - kEccentricity2) * std::sin(latitude)};
  };
  const Axes from = fixed_to_earth(origin), to = fixed_to_earth(position);
  const double x = to.x - from.x, y = to.y - from.y, z = to.z - from.z;
  const double latitude = origin.latitude_deg * kRadPerDeg, longitude = origin.longitude_deg * kRadPerDeg;
  return {-std::sin(longitude) * x + std::cos(longitude) * y,
          -std::sin(latitude) * (std::cos(longitude) * x + std::sin(longitude) * y) + std::cos(latitude) * z};
}

Measurement observedMeasurement(const CObservation& observation) {
  if (const auto* scan = dynamic_cast<const CObservationRotatingScan*>(&observation)) return rangesOf(*scan).echoes;
  if (const auto* bearings = dynamic_cast<const CObservationBearingRange*>(&observation)) return bearingsOf(*bearings);
  if (const auto* beacons = dynamic_cast<const CObservationBeaconRanges*>(&observation))
    return toBeaconRanges(*beacons);
  if (isCloud(observation)) {
    return pointsOf(observation);
  }
  if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation)) return rangesOf(*scan).echoes;
  if (const auto* range = dynamic_cast<const CObservationRange*>(&observation)) return rangesOf(*range).echoes;
  return Scalar{dynamic_cast<const CObservationGasSensors&>(observation).m_readings.at(0).temperature};
}

Measurement emptyMeasurement(const SensorInfo& sensor) {
  switch (sensor.kind) {
    case SensorKind::heat:
      return Scalar{};
    case SensorKind::beacons:
      return BeaconRanges{};
    case SensorKind::values:
      return Values{};
    default:
      return Echoes{};
  }
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
  } else if (const auto* rotating = dynamic_cast<const CObservationRotatingScan*>(&observation)) {
    sensor.kind = SensorKind::laser;
    update_ranges(*rotating, rotating->maxRange);
  } else if (isCloud(observation)) {
    sensor.kind = SensorKind::laser;  // without beams: a cloud of points
    sensor.range_max_m = sensor.no_echo_m = 2 * kMapReach_m;
  } else if (const auto* bearings = dynamic_cast<const CObservationBearingRange*>(&observation)) {
    sensor.kind = SensorKind::values;
    const std::size_t count = std::clamp<std::size_t>(bearings->sensedData.size(), 1, kMaxLandmarks);
    if (3 * count > sensor.quantities.size()) sensor.quantities = neighbourQuantities(count);
    sensor.beams = {{bearings->sensorLocationOnRobot.asTPose()}};
  } else if (const auto* beacons = dynamic_cast<const CObservationBeaconRanges*>(&observation)) {
    sensor.kind = SensorKind::beacons;
    sensor.no_echo_m = kMapReach_m;
    for (std::size_t i = sensor.beams.size(); i < std::min(beacons->sensedData.size(), kMaxLandmarks); ++i) {
      const auto& at = beacons->sensedData[i].sensorLocationOnRobot;
      sensor.beams.push_back({{at.x(), at.y(), at.z(), 0, 0, 0}});
    }
  } else if (const auto* range = dynamic_cast<const CObservationRange*>(&observation)) {
    sensor.kind = SensorKind::sonar;
    sensor.beam_width_rad = coneAperture(*range);
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
  if (const auto* scan = dynamic_cast<const CObservationRotatingScan*>(&observation)) {
    return boxAround(rangesOf(*scan), scan->maxRange);
  }
  if (isCloud(observation)) {
    return boxAround({{}, pointsOf(observation)}, kMapReach_m);
  }
  if (const auto* bearings = dynamic_cast<const CObservationBearingRange*>(&observation)) {
    const TPose3D mount = bearings->sensorLocationOnRobot.asTPose();
    const Values values = bearingsOf(*bearings);
    Ranges ranges;
    for (std::size_t i = 0; i < values.values.size(); i += 3) {
      const TPose3D beam(mount.x, mount.y, mount.z, mount.yaw + values.values[i + 2], 0, 0);
      ranges.echoes.push_back(echoOf(beam, static_cast<float>(values.values[i + 1])));
    }
    return boxAround(std::move(ranges), kMapReach_m);
  }
  return {};
}

}  // namespace robosim
