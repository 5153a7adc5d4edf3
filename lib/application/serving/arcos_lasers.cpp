#include "serving/arcos_lasers.h"

#include <algorithm>
#include <cmath>

#include "base/angle_units.h"
#include "sensors/laser.h"
#include "sensors/reflectance.h"

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

/// A laser of a model by its number; the model's number of sensors if there is none.
std::size_t laserSlot(const RobotModel& model, std::size_t number) {
  std::size_t slot = 0;
  for (; slot < model.sensors.size(); ++slot) {
    if (model.sensors[slot]->info().kind == SensorKind::laser && number-- == 0) break;
  }
  return slot;
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

LaserOptions optionsFor(const RobotModel& model, std::size_t number, const arcos::LaserRequest& laser) {
  LaserOptions options = defaultLaser();
  if (const std::size_t slot = laserSlot(model, number); slot < model.sensors.size()) {
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
  return options;
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

bool ArcosLasers::has(const RobotModel& model, std::size_t number) {
  return number == 0 || laserSlot(model, number) < model.sensors.size();
}

ArcosLasers::Group& ArcosLasers::groupOf(const RobotModel& model, const Request& request) {
  const auto& laser = request.laser;
  const auto [group, is_new] =
      groups_.try_emplace(Key{&model, request.number, laser.start_deg, laser.end_deg, laser.increment_centideg});
  if (is_new) {
    const LaserOptions options = optionsFor(model, request.number, laser);
    group->second.sensor = makeLaser(options);
    group->second.reflectance = makeReflectance(group->second.sensor->info());
  }
  return group->second;
}

bool ArcosLasers::hasReflectors() const {
  const auto& objects = environment_.objects();
  return std::any_of(objects.begin(), objects.end(),
                     [](const auto& object) { return object.body.reflectivity >= kReflectorReturn; });
}

void ArcosLasers::measure(const Sensor& sensor, const std::vector<std::uint32_t>& robots) {
  for (const auto robot : robots) readings_[robot].measurements.assign(1, sensor.blank());
  environment_.measure(sensor, robots, readings_);
}

void ArcosLasers::measure(std::span<const Request> requests) {
  for (auto& [key, group] : groups_) {
    group.robots.clear();
    group.measured.clear();
    group.scans.clear();
  }
  const bool has_reflectors = hasReflectors();
  readings_.resize(environment_.robotCount());  // robots may have been added
  for (const Request& request : requests) {
    const RobotModel& model = *environment_.fleet().robots[request.robot].model;
    const std::size_t slot = laserSlot(model, request.number);
    const bool is_measured = slot < model.sensors.size() && answers(model.sensors[slot]->info(), request.laser);
    if (is_measured) {
      const auto& measurements = environment_.state().readings[request.robot].measurements;
      convert(std::get<Echoes>(measurements[slot]), model.sensors[slot]->info(), request.scan->ranges_mm);
    }
    request.scan->reflectance.clear();
    if (is_measured && !has_reflectors) continue;
    Group& group = groupOf(model, request);
    group.robots.push_back(request.robot);
    group.scans.push_back(request.scan);
    if (is_measured) group.measured.push_back(request.robot);
  }
  // Programs may request ever new scans; sensors without a request are not kept.
  std::erase_if(groups_, [](const auto& entry) { return entry.second.robots.empty(); });
  for (auto& [key, group] : groups_) {
    const auto echoesOf = [this, &robots = group.robots](std::size_t i) -> const Echoes& {
      return std::get<Echoes>(readings_[robots[i]].measurements.front());
    };
    if (group.measured.size() < group.robots.size()) measure(*group.sensor, group.robots);
    for (std::size_t i = 0; i < group.robots.size(); ++i) {
      if (std::find(group.measured.begin(), group.measured.end(), group.robots[i]) != group.measured.end()) continue;
      convert(echoesOf(i), group.sensor->info(), group.scans[i]->ranges_mm);
    }
    if (!has_reflectors) continue;
    measure(*group.reflectance, group.robots);
    for (std::size_t i = 0; i < group.robots.size(); ++i) {
      for (const Echo& returned : echoesOf(i)) {
        const bool is_reflector = returned.range_m >= static_cast<float>(kReflectorReturn);
        group.scans[i]->reflectance.push_back(is_reflector ? arcos::kReflector : std::uint8_t{0});
      }
    }
  }
}

}  // namespace robosim
