#include "robosim/foreign_recording.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationGasSensors.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationRange.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/system/datetime.h>

#include "recording/rawlog_reader.h"
#include "robots/world_source.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;
using mrpt::math::TPose3D;
using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::obs::CObservationRange;

/// More points than a picture can show would only make it slow.
constexpr std::size_t kMostBeams = 2000;

Echo echoOf(const TPose3D& robot_from_beam, float range_m) {
  const auto end = robot_from_beam.composePoint({range_m, 0, 0});
  return {range_m, {static_cast<float>(end.x), static_cast<float>(end.y), static_cast<float>(end.z)}};
}

/// A robot as it is found out, observation by observation.
struct Found {
  std::vector<SensorInfo> sensors;
  std::map<std::string, std::size_t> slot_of_label;
  ShownRobot now;
  bool has_truth = false, has_place = false;

  std::size_t slot(const std::string& label, SensorKind kind) {
    const auto [at, is_new] = slot_of_label.try_emplace(label, sensors.size());
    if (is_new) {
      SensorInfo& sensor = sensors.emplace_back();
      sensor.kind = kind;
      sensor.label = label;
      if (kind == SensorKind::heat) {
        now.readings->measurements.emplace_back(Scalar{});
      } else {
        now.readings->measurements.emplace_back(Echoes{});
      }
    }
    return at->second;
  }

  void take(const std::string& label, const CObservation2DRangeScan& scan) {
    SensorInfo& sensor = sensors[slot(label, SensorKind::laser)];
    auto* const echoes = std::get_if<Echoes>(&now.readings->measurements[slot_of_label[label]]);
    if (!echoes) return;
    sensor.range_max_m = sensor.no_echo_m = scan.maxRange;
    sensor.beams.clear();
    echoes->clear();
    const std::size_t stride = 1 + scan.getScanSize() / kMostBeams;
    for (std::size_t i = 0; i < scan.getScanSize(); i += stride) {
      TPose3D beam = scan.sensorPose.asTPose();
      beam.yaw += scan.getScanAngle(i);
      const bool heard = scan.getScanRangeValidity(i) && scan.getScanRange(i) < scan.maxRange;
      sensor.beams.push_back({beam});
      echoes->push_back(echoOf(beam, heard ? scan.getScanRange(i) : scan.maxRange));
    }
  }

  void take(const std::string& label, const CObservationRange& range) {
    SensorInfo& sensor = sensors[slot(label, SensorKind::sonar)];
    auto* const echoes = std::get_if<Echoes>(&now.readings->measurements[slot_of_label[label]]);
    if (!echoes) return;
    sensor.range_max_m = sensor.no_echo_m = range.maxSensorDistance;
    sensor.beam_width_rad = range.sensorConeApperture;
    sensor.beams.clear();
    echoes->clear();
    for (const auto& sensed : range) {
      sensor.beams.push_back({sensed.sensorPose});
      const bool heard = sensed.sensedDistance > 0 && sensed.sensedDistance < range.maxSensorDistance;
      echoes->push_back(echoOf(sensed.sensorPose, heard ? sensed.sensedDistance : range.maxSensorDistance));
    }
  }

  /// @return whether there was something to show
  bool take(const std::string& label, const CObservation& observation) {
    if (const auto* truth = dynamic_cast<const mrpt::obs::CObservationRobotPose*>(&observation)) {
      const auto& pose = truth->pose.mean;
      now.world_from_robot = {pose.x(), pose.y(), pose.yaw()};
      has_truth = has_place = true;
    } else if (const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation)) {
      if (!has_truth) now.world_from_robot = odometry->odometry.asTPose();
      has_place = true;
    } else if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation)) {
      take(label, *scan);
    } else if (const auto* range = dynamic_cast<const CObservationRange*>(&observation)) {
      take(label, *range);
    } else if (const auto* heat = dynamic_cast<const mrpt::obs::CObservationGasSensors*>(&observation)) {
      if (heat->m_readings.empty() || !heat->m_readings[0].hasTemperature) return false;
      auto* const scalar = std::get_if<Scalar>(&now.readings->measurements[slot(label, SensorKind::heat)]);
      if (scalar) scalar->value = heat->m_readings[0].temperature;
    } else {
      return false;
    }
    return true;
  }
};

/// Robots that look like Pioneers, each with the sensors that were found.
LoadedWorld worldOf(const std::string& file, const std::vector<std::pair<std::string, Found>>& found,
                    const Bounds2D& bounds) {
  WorldSource source;
  source.file = file;
  source.robot_types = robotTypesIn(robotTypeFolders(file));
  source.text = "<world><surface><size><xmin>-1e6</xmin><xmax>1e6</xmax><ymin>-1e6</ymin><ymax>1e6</ymax></size>";
  for (std::size_t i = 0; i < found.size(); ++i) {
    source.text += "<object><shape><robot><model>pioneer3dx</model><name>robot" + std::to_string(i) + "</name><x>" +
                   std::to_string(2 * i) + "</x><y>0</y></robot></shape></object>";
  }
  source.text += "</surface></world>";
  LoadedWorld world = loadWorld(source, {});
  world.world.bounds = bounds;
  for (std::size_t i = 0; i < found.size(); ++i) {
    RobotInfo& info = world.fleet.robots[i].info;
    info.name = found[i].first.empty() ? "robot" : found[i].first;
    info.sensors = std::make_shared<const std::vector<SensorInfo>>(found[i].second.sensors);
  }
  return world;
}

}  // namespace

ForeignRecording readForeignRecording(const std::string& file) {
  RawlogReader reader(file);
  ForeignRecording recording;
  std::vector<std::pair<std::string, Found>> found;  // in the order in which they appear
  std::optional<mrpt::Clock::time_point> first, last;
  Bounds2D bounds{-1, 1, -1, 1};
  while (const auto observation = reader.next()) {
    const LabelParts parts = partsOf(observation->sensorLabel);
    auto at = std::find_if(found.begin(), found.end(), [&](const auto& f) { return f.first == parts.robot; });
    if (at == found.end()) {
      Found robot;
      robot.now.readings.emplace();
      at = found.insert(at, {parts.robot, std::move(robot)});
    }
    if (!at->second.take(parts.sensor, *observation)) continue;
    if (!first) first = observation->timestamp;
    // What has one timestamp is one moment.
    if (!last || *last != observation->timestamp) {
      recording.moments.emplace_back();
      last = observation->timestamp;
    }
    Shown& moment = recording.moments.back();
    moment.step = recording.moments.size() - 1;
    moment.time_s = mrpt::system::timeDifference(*first, *last);
    moment.robots.clear();
    for (const auto& robot : found) moment.robots.push_back(robot.second.now);
    const TPose2D& pose = at->second.now.world_from_robot;
    constexpr double kAround_m = 2;
    bounds = {std::min(bounds.x_min, pose.x - kAround_m), std::max(bounds.x_max, pose.x + kAround_m),
              std::min(bounds.y_min, pose.y - kAround_m), std::max(bounds.y_max, pose.y + kAround_m)};
  }
  if (recording.moments.empty()) {
    throw ConfigError(file + ": holds nothing that can be shown: no pose, odometry, scan or range" +
                      (reader.trouble() ? "; " + *reader.trouble() : ""));
  }
  // Who appeared later was nowhere before: shown at its first place, without readings.
  for (auto& moment : recording.moments) moment.robots.resize(found.size());
  for (auto& moment : recording.moments) {
    for (std::size_t i = 0; i < found.size(); ++i) {
      auto& readings = moment.robots[i].readings;
      // Sensors that appeared later have not measured yet.
      if (readings && readings->measurements.size() != found[i].second.sensors.size()) readings.reset();
    }
  }
  recording.world = worldOf(file, found, bounds);
  recording.trouble = reader.trouble().value_or("");
  return recording;
}

}  // namespace robosim
