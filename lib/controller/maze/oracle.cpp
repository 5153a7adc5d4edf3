#include "maze/oracle.h"

#include <algorithm>
#include <cmath>

namespace robosim {
namespace {

constexpr double kMapCell_radii = 0.6;
constexpr std::size_t kBeamsUsed = 32;   // per sensor
constexpr double kApproach = 0.8;        // factor of the distance to gold after an arrival without enough heat
constexpr std::uint64_t kPlanSteps = 5;  // between two plans, at least
constexpr double kSlow_mps = 0.05;
constexpr int kReachOfPlan = 1'000'000;  // cost limit: unlimited in practice

}  // namespace

void Oracle::step(Robot& robot) {
  if (!setup_.known_world) return;
  if (!plan_) readMap(robot);
  tracker_.update(robot);
  look(robot);
  if (recovery_.takesOver(robot)) {
    driver_.clear();
    return;
  }
  const bool is_slow = std::abs(robot.odometry().speed_mps) < kSlow_mps;  // in front of an obstacle, if not in a turn
  if (robot.stepNumber() >= plan_from_ && (driver_.empty() || is_slow || driver_.blocked(plan_->map))) findPath(robot);
  if (driver_.empty()) {
    robot.stop();
    return;
  }
  driver_.drive(robot, tracker_.startFromRobot(), plan_->map);
  const auto& pose = tracker_.startFromRobot();
  if (plan_->map.cellAt({pose.x, pose.y}) == driver_.goal()) {
    nearer_ *= kApproach;
    driver_.clear();
  }
}

void Oracle::readMap(const Robot& robot) {
  const KnownWorld& known = *setup_.known_world;
  plan_.emplace(kMapCell_radii * robot.info().radius_m, robot.info().radius_m);
  const int margin = plan_->obstacles.reach();
  const Cell low = plan_->map.cellAt(known.low);
  const Cell high = plan_->map.cellAt(known.center(known.columns * known.rows - 1));
  plan_->map.cover({low.x - margin, low.y - margin}, {high.x + margin, high.y + margin});
  for (std::size_t i = 0; i < known.occupied.size(); ++i) {
    if (known.occupied[i]) plan_->obstacles.learn(plan_->map.cellAt(known.center(i)), Obstacles::kCertain);
  }
}

void Oracle::look(const Robot& robot) {
  for (const auto kind : {SensorKind::sonar, SensorKind::laser, SensorKind::infrared}) {
    const Echoes& echoes = robot.echoes(kind);
    if (echoes.empty()) continue;
    plan_->obstacles.look(tracker_.startFromRobot(), *robot.sensor(kind), echoes,
                          (echoes.size() + kBeamsUsed - 1) / kBeamsUsed);
  }
  plan_->obstacles.clearUnder({tracker_.startFromRobot().x, tracker_.startFromRobot().y});
}

void Oracle::findPath(const Robot& robot) {
  plan_from_ = robot.stepNumber() + kPlanSteps;
  driver_.clear();
  path_.clear();
  const SensorInfo* heat = robot.sensor(SensorKind::heat);
  const auto& pose = tracker_.startFromRobot();
  const Cell start = plan_->map.cellAt({pose.x, pose.y});
  const auto is_goal = [&](const Cell& cell) {
    return std::any_of(setup_.known_world->sources.begin(), setup_.known_world->sources.end(), [&](const auto& source) {
      // By the linear law; the inverse law has its threshold elsewhere, and the robot approaches until it is reached.
      const double share = std::max(0.1, 1 - heat_threshold_ / source.heat_celsius);
      const double distance_m = (plan_->map.center(cell) - source.place).norm();
      return distance_m <= nearer_ * share * (heat ? heat->range_max_m : 1);
    });
  };
  const auto goal = wavefront_.findGoal(plan_->map, start, kReachOfPlan, [&](const Cell& cell) {
    return cell == start || plan_->map[cell].blocked() || !is_goal(cell) ? -1 : 0;
  });
  if (!goal) {
    // Another robot may block the path temporarily.
    plan_->obstacles.removeUncertain();
    nearer_ = std::min(1.0, nearer_ / kApproach);
    return;
  }
  wavefront_.pathTo(plan_->map, *goal, path_);
  driver_.follow(path_);
}

}  // namespace robosim
