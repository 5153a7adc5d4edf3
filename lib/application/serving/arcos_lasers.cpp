#include "serving/arcos_lasers.h"

#include <algorithm>
#include <cmath>

#include "base/angle_units.h"
#include "sensors/laser.h"

namespace robosim {
namespace {

/// SICK LMS200 at its longest range, where the robot type has no laser.
LaserOptions defaultLaser() {
  LaserOptions options;
  options.robot_from_laser = {0, 0, 0.2};
  options.range_max_m = 32;
  options.no_return_m = 32.767;
  return options;
}

double firstDirection(const arcos::LaserRequest& laser) { return laser.start_deg * kRadPerDeg; }
double fieldOfView(const arcos::LaserRequest& laser) {
  return static_cast<double>(laser.beamCount() - 1) * laser.increment_centideg / 100 * kRadPerDeg;
}

/// The first laser of a model; its number of sensors if there is none.
std::size_t laserSlot(const RobotModel& model) {
  const auto found = std::find_if(model.sensors.begin(), model.sensors.end(),
                                  [](const auto& sensor) { return sensor->info().kind == SensorKind::laser; });
  return static_cast<std::size_t>(found - model.sensors.begin());
}

/// Whether a laser has the beams of a request.
bool answers(const SensorInfo& info, const arcos::LaserRequest& laser) {
  constexpr double kSame_rad = 1e-9;
  const std::size_t n = laser.beamCount();
  if (info.pans || info.beams.size() != n) return false;
  const double first_rad = info.beams.front().robot_from_beam.yaw, last_rad = info.beams.back().robot_from_beam.yaw;
  return std::abs(first_rad - firstDirection(laser)) < kSame_rad &&
         std::abs(last_rad - first_rad - fieldOfView(laser)) < kSame_rad;
}

std::shared_ptr<const Sensor> laserFor(const RobotModel& model, const arcos::LaserRequest& laser) {
  LaserOptions options = defaultLaser();
  if (const std::size_t slot = laserSlot(model); slot < model.sensors.size()) {
    const SensorInfo& info = model.sensors[slot]->info();
    const auto& mount = info.beams.front().robot_from_beam;
    options.robot_from_laser = {mount.x, mount.y, mount.z};
    options.range_min_m = info.range_min_m;
    options.range_max_m = info.range_max_m;
    options.no_return_m = info.no_echo_m;
  }
  options.beams = static_cast<int>(laser.beamCount());
  options.field_of_view_rad = fieldOfView(laser);
  options.direction_rad = firstDirection(laser) + options.field_of_view_rad / 2;
  return makeLaser(options);
}

std::uint16_t inMillimetres(float range_m, const SensorInfo& info) {
  if (range_m >= static_cast<float>(info.range_max_m)) return arcos::kNoEcho_mm;
  return static_cast<std::uint16_t>(std::min<long>(std::lround(range_m * 1000), arcos::kNoEcho_mm - 1));
}

void convert(const Echoes& echoes, const SensorInfo& info, std::vector<std::uint16_t>& ranges_mm) {
  ranges_mm.clear();
  for (const Echo& echo : echoes) ranges_mm.push_back(inMillimetres(echo.range_m, info));
}

}  // namespace

ArcosLasers::ArcosLasers(Environment& environment) : environment_(environment) {}

ArcosLasers::Group& ArcosLasers::groupOf(const RobotModel& model, const arcos::LaserRequest& laser) {
  const auto [group, is_new] =
      groups_.try_emplace(Key{&model, laser.start_deg, laser.end_deg, laser.increment_centideg});
  if (is_new) group->second.sensor = laserFor(model, laser);
  return group->second;
}

void ArcosLasers::measure(std::span<const Request> requests) {
  for (auto& [key, group] : groups_) {
    group.robots.clear();
    group.ranges.clear();
  }
  readings_.resize(environment_.robotCount());  // robots may have been added
  for (const Request& request : requests) {
    const RobotModel& model = *environment_.fleet().robots[request.robot].model;
    const std::size_t slot = laserSlot(model);
    if (slot < model.sensors.size() && answers(model.sensors[slot]->info(), request.laser)) {
      const auto& measurements = environment_.state().readings[request.robot].measurements;
      convert(std::get<Echoes>(measurements[slot]), model.sensors[slot]->info(), *request.ranges);
      continue;
    }
    Group& group = groupOf(model, request.laser);
    group.robots.push_back(request.robot);
    group.ranges.push_back(request.ranges);
    readings_[request.robot].measurements.assign(1, group.sensor->blank());
  }
  // Programs may request ever new scans; sensors without a request are not kept.
  std::erase_if(groups_, [](const auto& entry) { return entry.second.robots.empty(); });
  for (auto& [key, group] : groups_) {
    environment_.measure(*group.sensor, group.robots, readings_);
    for (std::size_t i = 0; i < group.robots.size(); ++i) {
      const auto& echoes = std::get<Echoes>(readings_[group.robots[i]].measurements.front());
      convert(echoes, group.sensor->info(), *group.ranges[i]);
    }
  }
}

}  // namespace robosim
