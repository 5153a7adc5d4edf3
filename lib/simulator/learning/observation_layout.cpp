#include "learning/observation_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "base/error_list.h"

namespace robosim {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

bool isObservable(const SensorInfo& sensor) {
  return sensor.kind != SensorKind::camera && sensor.kind != SensorKind::blob_finder &&
         sensor.kind != SensorKind::unknown;
}

/// The first sensor of a kind, otherwise the sensor with a label.
std::optional<std::size_t> slotNamed(const std::string& name, const std::vector<SensorInfo>& sensors) {
  for (const bool by_kind : {true, false}) {
    for (std::size_t slot = 0; slot < sensors.size(); ++slot) {
      if (!isObservable(sensors[slot])) continue;
      if (name == (by_kind ? nameOf(sensors[slot].kind) : sensors[slot].label)) return slot;
    }
  }
  return std::nullopt;
}

/// Kinds, and the labels of sensors that are not the first of their kind.
std::vector<std::string> observableNames(const std::vector<SensorInfo>& sensors) {
  std::vector<std::string> names;
  for (const auto& sensor : sensors) {
    if (!isObservable(sensor)) continue;
    const std::string name = nameOf(sensor.kind);
    const bool is_first = std::find(names.begin(), names.end(), name) == names.end();
    names.push_back(is_first ? name : sensor.label);
  }
  names.insert(names.end(), {"stalled", "pose"});
  return names;
}

void bound(ObservationPart& part, std::size_t size, float low, float high) {
  part.size = size;
  part.low.assign(size, low);
  part.high.assign(size, high);
}

void describe(const SensorInfo& sensor, ObservationPart& part) {
  constexpr auto kPi = static_cast<float>(M_PI);
  switch (sensor.kind) {
    case SensorKind::sonar:
    case SensorKind::laser:
    case SensorKind::infrared:
    case SensorKind::beacons:
      return bound(part, sensor.beams.size(), 0, static_cast<float>(sensor.no_echo_m));
    case SensorKind::bumper:
      return bound(part, sensor.beams.size(), 0, 1);
    case SensorKind::odometry:
      bound(part, 5, -kInfinite, kInfinite);
      part.low[2] = -kPi;
      part.high[2] = kPi;
      return;
    case SensorKind::compass:
      return bound(part, 1, -kPi, kPi);
    case SensorKind::values:
      return bound(part, sensor.quantities.size(), -kInfinite, kInfinite);
    default:
      return bound(part, 1, -kInfinite, kInfinite);
  }
}

/// Writes the values of a measurement.
struct MeasurementWriter {
  float* out;

  void operator()(const Echoes& echoes) const {
    std::transform(echoes.begin(), echoes.end(), out, [](const Echo& echo) { return echo.range_m; });
  }
  void operator()(const Scalar& scalar) const { *out = static_cast<float>(scalar.value); }
  void operator()(const Contacts& contacts) const {
    std::transform(contacts.pressed.begin(), contacts.pressed.end(), out, [](auto p) { return static_cast<float>(p); });
  }
  void operator()(const Odometry& odometry) const {
    out[0] = static_cast<float>(odometry.odom_from_robot.x);
    out[1] = static_cast<float>(odometry.odom_from_robot.y);
    out[2] = static_cast<float>(odometry.odom_from_robot.phi);
    out[3] = static_cast<float>(odometry.speed_mps);
    out[4] = static_cast<float>(odometry.turn_radps);
  }
  void operator()(const BeaconRanges& beacons) const { std::copy(beacons.range_m.begin(), beacons.range_m.end(), out); }
  void operator()(const Values& values) const {
    std::transform(values.values.begin(), values.values.end(), out, [](double v) { return static_cast<float>(v); });
  }
  void operator()(const Image&) const {}
  void operator()(const Blobs&) const {}
};

/// @return nullopt if the robot does not have the part
std::optional<ObservationPart> partNamed(const std::string& name, const RobotInfo& robot) {
  ObservationPart part;
  part.name = name;
  if (name == "stalled") {
    part.slot = ObservationPart::kStalled;
    bound(part, 1, 0, 1);
  } else if (name == "pose") {
    part.slot = ObservationPart::kPose;
    bound(part, 3, -kInfinite, kInfinite);
    part.low[2] = -static_cast<float>(M_PI);
    part.high[2] = static_cast<float>(M_PI);
  } else if (const auto slot = slotNamed(name, *robot.sensors)) {
    part.slot = *slot;
    describe((*robot.sensors)[part.slot], part);
  } else {
    return std::nullopt;
  }
  return part;
}

[[noreturn]] void refuse(const RobotInfo& robot, const std::string& what) {
  throw ConfigError("robot '" + robot.name + "' cannot observe " + what + "; observations may be " +
                    listed(observableNames(*robot.sensors)));
}

}  // namespace

std::vector<ObservationLayout> ObservationLayout::ofTeam(std::span<const FleetRobot> robots,
                                                         const std::vector<std::string>& names) {
  for (const auto& name : names) {
    const bool is_of_one = std::any_of(
        robots.begin(), robots.end(), [&](const FleetRobot& robot) { return partNamed(name, robot.info).has_value(); });
    if (!is_of_one) refuse(robots.front().info, "'" + name + "'");
  }
  std::vector<ObservationLayout> layouts;
  for (const auto& robot : robots) {
    layouts.push_back(ofPresent(robot.info, names));
    if (layouts.back().parts_.empty() && !names.empty()) refuse(robot.info, listed(names));
  }
  return layouts;
}

ObservationLayout ObservationLayout::ofPresent(const RobotInfo& robot, const std::vector<std::string>& names) {
  std::vector<std::string> present;
  std::copy_if(names.begin(), names.end(), std::back_inserter(present),
               [&](const std::string& name) { return partNamed(name, robot).has_value(); });
  return {robot, present};
}

ObservationLayout::ObservationLayout(const RobotInfo& robot, const std::vector<std::string>& names) {
  for (const auto& name : names) {
    auto part = partNamed(name, robot);
    if (!part) refuse(robot, "'" + name + "'");
    size_ += part->size;
    parts_.push_back(*std::move(part));
  }
}

bool ObservationLayout::isCompatible(const ObservationLayout& other) const {
  return std::equal(parts_.begin(), parts_.end(), other.parts_.begin(), other.parts_.end(),
                    [](const ObservationPart& a, const ObservationPart& b) {
                      return a.name == b.name && a.slot == b.slot && a.size == b.size && a.low == b.low &&
                             a.high == b.high;
                    });
}

void ObservationLayout::write(const State& state, std::size_t robot, std::span<float> out) const {
  float* at = out.data();
  const Readings& readings = state.readings[robot];
  for (const auto& part : parts_) {
    if (part.slot == ObservationPart::kStalled) {
      *at = readings.stalled ? 1.f : 0.f;
    } else if (part.slot == ObservationPart::kPose) {
      const auto& pose = state.world_from_robot[robot];
      at[0] = static_cast<float>(pose.x);
      at[1] = static_cast<float>(pose.y);
      at[2] = static_cast<float>(pose.phi);
    } else {
      std::visit(MeasurementWriter{at}, readings.measurements[part.slot]);
    }
    at += part.size;
  }
}

}  // namespace robosim
