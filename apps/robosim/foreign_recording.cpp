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
#include "robosim/progress.h"
#include "robosim/text.h"
#include "robots/world_source.h"
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

/// Of a recording that has no times at all, entries follow one another like that.
constexpr double kEntry_s = 0.1;

/// More points than a picture can show would only make it slow.
constexpr std::size_t kMostBeams = 2000;

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

enum class Worth { shown, not_for_pictures, out_of_reach };

Worth worthOf(const CObservation& observation) {
  bool is_within_reach = true;
  if (const auto* truth = dynamic_cast<const CObservationRobotPose*>(&observation)) {
    const auto& pose = truth->pose.mean;
    is_within_reach = isWithinReach(pose.x(), pose.y(), pose.yaw());
  } else if (const auto* odometry = dynamic_cast<const CObservationOdometry*>(&observation)) {
    const auto& pose = odometry->odometry;
    is_within_reach = isWithinReach(pose.x(), pose.y(), pose.phi());
  } else if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation)) {
    is_within_reach = isWithinReach(scan->sensorPose.asTPose(), scan->maxRange) && std::isfinite(scan->aperture);
  } else if (const auto* range = dynamic_cast<const CObservationRange*>(&observation)) {
    is_within_reach = std::all_of(range->begin(), range->end(), [&](const auto& sensed) {
      return isWithinReach(sensed.sensorPose, range->maxSensorDistance);
    });
  } else if (const auto* heat = dynamic_cast<const CObservationGasSensors*>(&observation)) {
    if (heat->m_readings.empty() || !heat->m_readings[0].hasTemperature) return Worth::not_for_pictures;
  } else {
    return Worth::not_for_pictures;
  }
  return is_within_reach ? Worth::shown : Worth::out_of_reach;
}

/// A robot as it is found out, observation by observation.
struct Found {
  std::string name;
  std::vector<SensorInfo> sensors;
  std::map<std::string, std::size_t> slot_of_label;
  ShownRobot now;
  bool has_truth = false, has_place = false;
  std::size_t first_placed = 0;  ///< in which moment it was told first where it is

  explicit Found(std::string called) : name(std::move(called)) { now.readings.emplace(); }

  std::size_t slot(const std::string& label, SensorKind kind) {
    const auto [at, is_new] = slot_of_label.try_emplace(label, sensors.size());
    if (is_new) {
      SensorInfo& sensor = sensors.emplace_back();
      sensor.kind = kind;
      sensor.label = label;
    }
    addSilentSensors(now);
    return at->second;
  }

  /// Sensors that a moment does not know as yet have measured nothing.
  void addSilentSensors(ShownRobot& robot) const {
    auto& measurements = robot.readings->measurements;
    for (std::size_t i = measurements.size(); i < sensors.size(); ++i) {
      if (sensors[i].kind == SensorKind::heat) {
        measurements.emplace_back(Scalar{});
      } else {
        measurements.emplace_back(Echoes{});
      }
    }
  }

  void takeRanges(const std::string& label, SensorKind kind, double range_max_m, double beam_width_rad,
                  std::vector<Beam> beams, Echoes echoes) {
    const std::size_t at = slot(label, kind);
    auto* const kept = std::get_if<Echoes>(&now.readings->measurements[at]);
    if (!kept) return;
    *kept = std::move(echoes);
    SensorInfo& sensor = sensors[at];
    sensor.range_max_m = sensor.no_echo_m = range_max_m;
    sensor.beam_width_rad = beam_width_rad;
    // There is a beam for every echo of every moment.
    if (beams.size() >= sensor.beams.size()) sensor.beams = std::move(beams);
  }

  void take(const std::string& label, const CObservation2DRangeScan& scan) {
    std::vector<Beam> beams;
    Echoes echoes;
    const std::size_t stride = 1 + scan.getScanSize() / kMostBeams;
    for (std::size_t i = 0; i < scan.getScanSize(); i += stride) {
      TPose3D beam = scan.sensorPose.asTPose();
      // MRPT shares the aperture out between the beams, and so has no angle for a single one.
      if (scan.getScanSize() > 1) beam.yaw += scan.getScanAngle(i);
      const bool heard = scan.getScanRangeValidity(i) && scan.getScanRange(i) < scan.maxRange;
      beams.push_back({beam});
      echoes.push_back(echoOf(beam, heard ? scan.getScanRange(i) : scan.maxRange));
    }
    takeRanges(label, SensorKind::laser, scan.maxRange, 0, std::move(beams), std::move(echoes));
  }

  void take(const std::string& label, const CObservationRange& range) {
    std::vector<Beam> beams;
    Echoes echoes;
    for (const auto& sensed : range) {
      beams.push_back({sensed.sensorPose});
      const bool heard = sensed.sensedDistance > 0 && sensed.sensedDistance < range.maxSensorDistance;
      echoes.push_back(echoOf(sensed.sensorPose, heard ? sensed.sensedDistance : range.maxSensorDistance));
    }
    takeRanges(label, SensorKind::sonar, range.maxSensorDistance, range.sensorConeApperture, std::move(beams),
               std::move(echoes));
  }

  /// @param observation that is worth to be shown
  void take(const std::string& label, const CObservation& observation) {
    if (const auto* truth = dynamic_cast<const CObservationRobotPose*>(&observation)) {
      const auto& pose = truth->pose.mean;
      has_truth = true;
      moveTo({pose.x(), pose.y(), pose.yaw()});
    } else if (const auto* odometry = dynamic_cast<const CObservationOdometry*>(&observation)) {
      if (!has_truth) moveTo(odometry->odometry.asTPose());
    } else if (const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation)) {
      take(label, *scan);
    } else if (const auto* range = dynamic_cast<const CObservationRange*>(&observation)) {
      take(label, *range);
    } else if (const auto* heat = dynamic_cast<const CObservationGasSensors*>(&observation)) {
      auto* const scalar = std::get_if<Scalar>(&now.readings->measurements[slot(label, SensorKind::heat)]);
      if (scalar) scalar->value = heat->m_readings[0].temperature;
    }
  }

  void moveTo(const TPose2D& world_from_robot) {
    now.world_from_robot = world_from_robot;
    has_place = true;
  }
};

/// Robots that look like Pioneers, each with the sensors that were found.
LoadedWorld worldOf(const std::string& file, const std::vector<Found>& found, const Bounds2D& bounds) {
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
    info.name = found[i].name.empty() ? "robot" : found[i].name;
    info.sensors = std::make_shared<const std::vector<SensorInfo>>(found[i].sensors);
  }
  return world;
}

/// An observation on its way to a moment.
struct Heard {
  CObservation::Ptr observation;
  LabelParts label;
  std::uint64_t entry = 0;  ///< of the file
  mrpt::Clock::time_point stamp;
  double time_s = 0;  ///< since the recording's beginning
};

/// Tells the time of each, and puts them in its order. What has no stamp was made with the one before it.
void setTimes(std::vector<Heard>& heard) {
  const auto stamped =
      std::find_if(heard.begin(), heard.end(), [](const Heard& one) { return one.stamp != INVALID_TIMESTAMP; });
  if (stamped == heard.end()) {
    for (auto& one : heard) one.time_s = kEntry_s * static_cast<double>(one.entry - heard.front().entry);
    return;
  }
  auto last = stamped->stamp;
  for (auto& one : heard) {
    if (one.stamp == INVALID_TIMESTAMP) one.stamp = last;
    last = one.stamp;
  }
  std::stable_sort(heard.begin(), heard.end(), [](const Heard& a, const Heard& b) { return a.stamp < b.stamp; });
  // Unsigned, so that even the farthest two stamps are no overflow.
  const auto ticks = [](const Heard& one) { return static_cast<std::uint64_t>(one.stamp.time_since_epoch().count()); };
  constexpr double kTicksPerSecond = mrpt::Clock::period::den;
  const std::uint64_t first = ticks(heard.front());
  for (auto& one : heard) one.time_s = static_cast<double>(ticks(one) - first) / kTicksPerSecond;
}

/// Where just one robot has a name, what comes without one is its, too: so actions have none.
void nameTheNameless(std::vector<Heard>& heard) {
  std::string only;
  for (const auto& one : heard) {
    if (one.label.robot.empty() || one.label.robot == only) continue;
    if (!only.empty()) return;
    only = one.label.robot;
  }
  for (auto& one : heard) one.label.robot = only;
}

/// All that can be shown, in the order of time.
std::vector<Heard> readAll(RawlogReader& reader, std::string& trouble) {
  std::vector<Heard> heard;
  std::size_t out_of_reach = 0;
  Progress progress;
  while (auto observation = reader.next()) {
    const Worth worth = worthOf(*observation);
    if (worth == Worth::out_of_reach) ++out_of_reach;
    if (worth == Worth::shown) {
      heard.push_back({observation, partsOf(observation->sensorLabel), reader.entries(), observation->timestamp, 0});
    }
    if (progress.due()) progress.show("reading, " + withCommas(reader.entries()) + " entries …");
  }
  trouble = reader.trouble().value_or("");
  if (out_of_reach > 0) {
    trouble += (trouble.empty() ? "" : "; ") + withCommas(out_of_reach) +
               " observations lie more than 10,000 km away, or nowhere; left out";
  }
  nameTheNameless(heard);
  setTimes(heard);
  return heard;
}

/// Robots that appear later stand at their first place from the beginning, and sensors have measured nothing before
/// they spoke.
void completeEarlyMoments(std::vector<Shown>& moments, const std::vector<Found>& found) {
  for (auto& moment : moments) {
    moment.robots.resize(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (moment.robots[i].readings) found[i].addSilentSensors(moment.robots[i]);
    }
  }
  for (std::size_t i = 0; i < found.size(); ++i) {
    const TPose2D place = moments[found[i].first_placed].robots[i].world_from_robot;
    for (std::size_t k = 0; k < found[i].first_placed; ++k) moments[k].robots[i].world_from_robot = place;
  }
}

}  // namespace

ForeignRecording readForeignRecording(const std::string& file) {
  RawlogReader reader(file);
  ForeignRecording recording;
  std::vector<Heard> heard = readAll(reader, recording.trouble);
  if (heard.empty()) {
    throw ConfigError(file + ": holds nothing that can be shown: no pose, odometry, scan or range" +
                      (recording.trouble.empty() ? "" : "; " + recording.trouble));
  }
  std::vector<Found> found;  // in the order in which they appear
  Bounds2D bounds{-1, 1, -1, 1};
  for (auto& one : heard) {
    auto robot = std::find_if(found.begin(), found.end(), [&](const Found& f) { return f.name == one.label.robot; });
    if (robot == found.end()) robot = found.insert(robot, Found(one.label.robot));
    // What has one time is one moment.
    if (recording.moments.empty() || recording.moments.back().time_s != one.time_s) recording.moments.emplace_back();
    if (!robot->has_place) robot->first_placed = recording.moments.size() - 1;
    robot->take(one.label.sensor, *one.observation);
    one.observation.reset();
    Shown& moment = recording.moments.back();
    moment.step = recording.moments.size() - 1;
    moment.time_s = one.time_s;
    moment.robots.clear();
    for (const auto& known : found) moment.robots.push_back(known.now);
    const TPose2D& pose = robot->now.world_from_robot;
    constexpr double kAround_m = 2;
    bounds = {std::min(bounds.x_min, pose.x - kAround_m), std::max(bounds.x_max, pose.x + kAround_m),
              std::min(bounds.y_min, pose.y - kAround_m), std::max(bounds.y_max, pose.y + kAround_m)};
  }
  completeEarlyMoments(recording.moments, found);
  recording.world = worldOf(file, found, bounds);
  return recording;
}

}  // namespace robosim
