#include "environment/robot_groups.h"

#include <algorithm>
#include <map>

#include "geometry/shapes/path.h"

namespace robosim {
namespace {

double reachOf(const RobotModel& model, double period_s) {
  double reach_m = model.radius_m + model.limits.speed_max_mps * period_s;
  for (const auto& sensor : model.sensors) reach_m = std::max(reach_m, robosim::reachOf(*sensor));
  return reach_m + kContactGap_m;
}

}  // namespace

double reachOf(const Sensor& sensor) { return sensor.usesNeighbours() ? beamReach(sensor.info()) : 0; }

std::span<const std::uint32_t> RobotGroup::within(RobotRange range) const {
  const auto begin = std::lower_bound(robots.begin(), robots.end(), range.begin);
  return {begin, std::lower_bound(begin, robots.end(), range.end)};
}

RobotGroups::RobotGroups(const Fleet& fleet, double period_s) {
  std::map<const RobotModel*, std::uint32_t> group_of;
  for (std::uint32_t i = 0; i < fleet.robots.size(); ++i) {
    const RobotModel* model = fleet.robots[i].model.get();
    const auto [found, is_new] = group_of.emplace(model, static_cast<std::uint32_t>(groups.size()));
    if (is_new) groups.push_back({model, reachOf(*model, period_s), {}});
    groups[found->second].robots.push_back(i);
    number_of.push_back(found->second);
  }
}

}  // namespace robosim
