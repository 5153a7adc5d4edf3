#include "environment/robot_groups.h"

#include <algorithm>
#include <map>
#include <utility>

#include "geometry/shapes/path.h"
#include "robots/drive_kinematics.h"

namespace robosim {
namespace {

RobotGroup makeGroup(const RobotModel& model, const std::vector<std::size_t>& slots, double period_s) {
  RobotGroup group{
      &model, {}, {}, model.radius_m + groundSpeedMax(model.type->drive, model.type->limits) * period_s, {}};
  for (const auto slot : slots) {
    const Sensor& sensor = *model.sensors[slot];
    group.reach_m = std::max(group.reach_m, reachOf(sensor));
    (sensor.sensesInHostProcess() ? group.host_slots : group.slots).push_back(slot);
  }
  group.reach_m += kContactGap_m;
  return group;
}

std::vector<std::size_t> sensedSlots(const RobotModel& model, std::size_t robot, const IsSensed& is_sensed) {
  std::vector<std::size_t> slots;
  for (std::size_t slot = 0; slot < model.sensors.size(); ++slot) {
    if (!is_sensed || is_sensed(robot, slot)) slots.push_back(slot);
  }
  return slots;
}

}  // namespace

double reachOf(const Sensor& sensor) { return sensor.usesNeighbours() ? beamReach(sensor.info()) : 0; }

std::span<const std::uint32_t> RobotGroup::within(RobotRange range) const {
  if (range.begin <= robots.front() && robots.back() < range.end) return robots;
  const auto begin = std::lower_bound(robots.begin(), robots.end(), range.begin);
  return {begin, std::lower_bound(begin, robots.end(), range.end)};
}

RobotGroups::RobotGroups(const Fleet& fleet, double period_s, const IsSensed& is_sensed) {
  std::map<std::pair<const RobotModel*, std::vector<std::size_t>>, std::uint32_t> group_of;
  number_of.reserve(fleet.robots.size());
  for (std::uint32_t i = 0; i < fleet.robots.size(); ++i) {
    const RobotModel* model = fleet.robots[i].model.get();
    const auto slots = sensedSlots(*model, i, is_sensed);
    const auto [found, is_new] = group_of.emplace(std::pair(model, slots), static_cast<std::uint32_t>(groups.size()));
    if (is_new) {
      groups.push_back(makeGroup(*model, slots, period_s));
      have_slots |= !groups.back().slots.empty();
      have_host_slots |= !groups.back().host_slots.empty();
    }
    groups[found->second].robots.push_back(i);
    number_of.push_back(found->second);
  }
}

}  // namespace robosim
