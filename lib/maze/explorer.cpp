#include "maze/explorer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <mrpt/math/wrap2pi.h>

namespace robosim {
namespace {

constexpr double kCell_radii = 0.6;
constexpr int kSearchReach = 1000000;     // cost: anywhere
constexpr int kFollowReach = 400;         // cost: heat is near, but the way to it may lead round some walls
constexpr double kCloser = 3;             // cost of ending a cell farther from the likely source
constexpr double kNearSource = 0.6;       // of the sensor's range: how near the likely source it looks
constexpr double kTurn = 4;               // cost of a goal at right angles to the robot's heading
constexpr double kSliver = 0.3;           // share of a neighbourhood that must be unsearched to be worth a trip
constexpr std::size_t kBeams = 32;        // of a sensor that are taken in at most
constexpr double kLookTurn_rad = 0.2;     // turn after which it looks again
constexpr std::uint64_t kLookPause = 10;  // steps between two looks, at most
constexpr std::uint64_t kPlanPause = 3;   // steps between two plans, at least
constexpr double kFollow_s = 120;         // then it gives up, and explores on
constexpr double kExplore_s = 60;         // for so long
constexpr double kNothingLeft_s = 5;      // then it begins anew
constexpr double kStuck_s = 1.5;

std::uint64_t stepsIn(double seconds, const Robot& robot) {
  return static_cast<std::uint64_t>(std::ceil(seconds / robot.readings().time.period_s));
}

double heatRange(const Robot& robot) {
  for (const auto kind : {SensorKind::heat, SensorKind::odometry}) {
    if (robot.sensor(kind)) continue;
    throw std::invalid_argument("robot '" + robot.name() + "' has no " + nameOf(kind) +
                                ", which a gold finder needs; add <" + nameOf(kind) + "/> to its model");
  }
  return robot.sensor(SensorKind::heat)->range_max_m;
}

}  // namespace

Explorer::Explorer(const Robot& robot, const ControllerSetup& setup, double warm)
    : warm_(warm),
      rng_(setup.seed, RandomPurpose::controller, setup.robot),
      map_(kCell_radii * robot.info().radius_m),
      obstacles_(map_, robot.info().radius_m),
      heat_(map_, heatRange(robot), robot.info().radius_m) {}

void Explorer::step(Robot& robot) {
  tracker_.update(robot);
  look(robot);
  if (robot.stepNumber() < back_until_) {
    robot.drive(back_speed_, back_turn_);
    return;
  }
  if (isStuck(robot)) {
    drawBack(robot);
    return;
  }
  if (robot.stepNumber() >= plan_from_ && needsPlan()) plan(robot);
  if (driver_.empty()) {
    robot.drive(0, robot.info().limits.turn_max_radps / 2);  // look around
  } else {
    driver_.drive(robot, tracker_.startFromRobot(), map_);
  }
}

void Explorer::look(const Robot& robot) {
  const auto& pose = tracker_.startFromRobot();
  const double moved = std::hypot(pose.x - looked_from_.x, pose.y - looked_from_.y);
  const double turned = std::abs(mrpt::math::wrapToPi(pose.phi - looked_from_.phi));
  if (robot.stepNumber() < look_at_ && moved < map_.cellSize() / 2 && turned < kLookTurn_rad) return;
  looked_from_ = pose;
  look_at_ = robot.stepNumber() + kLookPause;

  const Cell at = map_.cellAt(place());
  const int reach = std::max(obstacles_.reach(), heat_.reach());
  map_.cover({at.x - reach, at.y - reach}, {at.x + reach, at.y + reach});
  for (const auto kind : {SensorKind::sonar, SensorKind::laser, SensorKind::infrared}) {
    const Echoes& echoes = robot.echoes(kind);
    if (echoes.empty()) continue;
    obstacles_.look(pose, *robot.sensor(kind), echoes, (echoes.size() + kBeams - 1) / kBeams);
  }
  obstacles_.clearUnder(place());
  feel(robot);
}

void Explorer::feel(const Robot& robot) {
  const double heat = robot.heat().value_or(0);
  if (!heat_.measure(place(), heat)) return;
  if (following_) {
    source_moved_ = true;
  } else if (heat >= warm_ && robot.stepNumber() >= explore_until_) {
    heat_.searchFromHere();
    following_ = planToHeat(map_.cellAt(place()));
    follow_until_ = robot.stepNumber() + stepsIn(kFollow_s, robot);
  }
}

bool Explorer::needsPlan() {
  if (driver_.empty() || source_moved_ || atGoal()) return true;
  if (obstacles_.changes() == seen_changes_) return false;
  seen_changes_ = obstacles_.changes();
  return driver_.blocked(map_);
}

void Explorer::plan(const Robot& robot) {
  const std::uint64_t now = robot.stepNumber();
  const Cell start = map_.cellAt(place());
  plan_from_ = now + kPlanPause;
  source_moved_ = false;
  driver_.clear();
  if (following_) {
    if (now < follow_until_ && planToHeat(start)) return;
    following_ = false;
    if (now >= follow_until_) explore_until_ = now + stepsIn(kExplore_s, robot);
  }
  if (planToSearch(start)) {
    nothing_left_since_.reset();
    return;
  }
  // Perhaps only another robot stands in the way, and goes on.
  plan_from_ = now + stepsIn(1, robot);
  if (!nothing_left_since_) {
    nothing_left_since_ = now;
    obstacles_.forgetDoubtful();
  } else if (now >= *nothing_left_since_ + stepsIn(kNothingLeft_s, robot)) {
    startOver();
  }
}

bool Explorer::planToHeat(const Cell& start) {
  const auto source = heat_.source();
  if (!source) return false;
  const Cell center = map_.cellAt(source->place);
  const double reach_cells = kNearSource * heat_.range() / map_.cellSize();
  return planTo(start, kFollowReach, [&](const Cell& cell) {
    if (map_[cell].stood) return -1;
    const double distance = std::hypot(cell.x - center.x, cell.y - center.y);
    return distance > reach_cells ? -1 : static_cast<int>(kCloser * distance);
  });
}

bool Explorer::planToSearch(const Cell& start) {
  // Of places equally near the one ahead: turning takes time, and straight lanes leave no patches between them.
  const auto& pose = tracker_.startFromRobot();
  const double ahead_x = std::cos(pose.phi), ahead_y = std::sin(pose.phi);
  return planTo(start, kSearchReach, [&](const Cell& cell) {
    if (map_[cell].searched || isSliver(cell)) return -1;
    const double x = cell.x - start.x, y = cell.y - start.y;
    return static_cast<int>(kTurn * (1 - (x * ahead_x + y * ahead_y) / std::hypot(x, y)));
  });
}

template <typename Judge>
bool Explorer::planTo(const Cell& start, int cost_max, const Judge& judge) {
  const auto goal = wavefront_.findGoal(map_, start, cost_max, [&](const Cell& cell) {
    return cell == start || map_[cell].blocked() ? -1 : judge(cell);
  });
  if (!goal) return false;
  wavefront_.wayTo(map_, *goal, way_);
  driver_.follow(way_);
  return true;
}

bool Explorer::isSliver(const Cell& cell) const {
  int open = 0, unsearched = 0;
  for (int y = cell.y - 2; y <= cell.y + 2; ++y) {
    for (int x = cell.x - 2; x <= cell.x + 2; ++x) {
      if (!map_.contains({x, y}) || map_[{x, y}].blocked()) continue;
      ++open;
      unsearched += map_[{x, y}].searched ? 0 : 1;
    }
  }
  return unsearched < kSliver * open;
}

bool Explorer::atGoal() const {
  const Cell& goal = driver_.goal();
  if (following_) return map_[goal].stood || map_.cellAt(place()) == goal;
  return map_[goal].searched;
}

void Explorer::startOver() {
  map_.reset();
  heat_.reset();
  driver_.clear();
  nothing_left_since_.reset();
  look_at_ = 0;
  plan_from_ = 0;
  ++rounds_;
}

bool Explorer::isStuck(const Robot& robot) {
  const auto& pose = tracker_.startFromRobot();
  const double moved = std::hypot(pose.x - moved_from_.x, pose.y - moved_from_.y);
  if (moved > map_.cellSize() / 2 || std::abs(mrpt::math::wrapToPi(pose.phi - moved_from_.phi)) > 0.3) {
    moved_from_ = pose;
    moved_at_ = robot.stepNumber();
  }
  return robot.stepNumber() > moved_at_ + stepsIn(kStuck_s, robot);
}

void Explorer::drawBack(Robot& robot) {
  const auto& pose = tracker_.startFromRobot();
  const MotionLimits& limits = robot.info().limits;
  // Whatever holds it, the map does not know it: it is just ahead.
  const double reach = robot.info().radius_m + map_.cellSize() / 2;
  obstacles_.bump({pose.x + reach * std::cos(pose.phi), pose.y + reach * std::sin(pose.phi)});
  driver_.clear();
  back_until_ = robot.stepNumber() + stepsIn(rng_.uniform(0.5, 3), robot);
  const bool backwards = roomInLane(robot, -1) >= roomInLane(robot, 1);
  back_speed_ = (backwards ? -1 : 1) * rng_.uniform(0.1, 0.4) * limits.speed_max_mps;
  back_turn_ = rng_.uniform(-0.5, 0.5) * limits.turn_max_radps;
  moved_at_ = back_until_;
}

}  // namespace robosim
