#include "learning/observation_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

#include "base/error_list.h"
#include "hardware/measurement_fields.h"

namespace robosim {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// How many numbers of a record an observation contains: the first ones. Of an echo its range only, since its point
/// follows from that and the beam.
template <typename M>
constexpr std::size_t kObservedCount = kFieldCount<M>;
template <>
constexpr std::size_t kObservedCount<Echoes> = 1;
/// Not the lateral speed, which only omnidirectional and tracked robots have.
template <>
constexpr std::size_t kObservedCount<Odometry> = 5;

/// Calls visit(field, number) for each number of a measurement that an observation contains, record by record.
template <typename M, typename Visit>
void forObserved(M& measurement, const Visit& visit) {
  using Of = std::remove_const_t<M>;
  for ([[maybe_unused]] auto& record : Description<Of>::records(measurement)) {
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      (visit(std::get<i>(Description<Of>::fields), std::get<i>(Description<Of>::fields).get(record)), ...);
    }
    (std::make_index_sequence<kObservedCount<Of>>());
  }
}

/// Whether its kind of measurement consists of numbers, or of pictures that are equal on every machine.
bool isObservable(const SensorInfo& sensor) {
  if (sensor.kind == SensorKind::unknown) return false;
  if (sensor.kind == SensorKind::camera) return sensor.camera.isRaycast();
  return std::visit([]<typename M>(const M&) { return kObservedCount<M> > 0; }, blankMeasurement(sensor));
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

/// Bounds of a number: those of its field, and what the sensor's own description adds.
template <typename Get>
std::pair<float, float> boundsOf(const SensorInfo& sensor, const Field<Get>& field) {
  constexpr auto kPi = static_cast<float>(M_PI);
  const std::string_view name = field.name;
  if (name == "range" && sensor.no_echo_m > 0) return {0.f, static_cast<float>(sensor.no_echo_m)};
  if (name == "heading" || sensor.kind == SensorKind::compass) return {-kPi, kPi};
  using Limits = std::numeric_limits<double>;
  return {field.min == Limits::lowest() ? -kInfinite : static_cast<float>(field.min),
          field.max == Limits::max() ? kInfinite : static_cast<float>(field.max)};
}

void describe(const SensorInfo& sensor, ObservationPart& part) {
  std::visit(
      [&](const auto& blank) {
        forObserved(blank, [&](const auto& field, const auto&) {
          const auto [low, high] = boundsOf(sensor, field);
          part.low.push_back(low);
          part.high.push_back(high);
        });
      },
      blankMeasurement(sensor));
  part.size = part.low.size();
  if (sensor.kind != SensorKind::camera) return;
  part.picture = sensor.camera;
  part.range_max_m = sensor.range_max_m;
}

/// Writes the values of a measurement.
struct MeasurementWriter {
  float* out;

  template <typename M>
  void operator()(const M& measurement) const {
    float* at = out;
    forObserved(measurement, [&](const auto&, const auto& number) { *at++ = static_cast<float>(number); });
  }
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

bool ObservationLayout::isCompatible(const ObservationLayout& other) const { return parts_ == other.parts_; }

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
