#include "maze/explorer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <mrpt/math/wrap2pi.h>

namespace robosim {
namespace {

constexpr double kCell_radii = 0.6;
constexpr int kSearchReach = 100000;      // cost: anywhere
constexpr int kFollowReach = 400;         // cost: heat is near, but the way to it may lead round some walls
constexpr int kCloser = 3;                // cost of ending a cell farther from the likely source
constexpr double kTurn = 4;               // cost of a goal at right angles to the robot's heading
constexpr double kSliver = 0.3;           // share of a neighbourhood that must be unsearched to be worth a trip
constexpr std::size_t kLaserBeams = 31;   // that are taken in of a scan
constexpr std::uint64_t kPlanPause = 3;   // steps between two plans, at least
constexpr std::uint64_t kLookPause = 10;  // steps between two looks, at most
constexpr double kFollow_s = 120;         // then it gives up, and explores on
constexpr double kExplore_s = 60;         // for so long
constexpr double kStuck_s = 1.5;

std::uint64_t stepsIn(double seconds, const Robot& robot) {
  return static_cast<std::uint64_t>(std::ceil(seconds / robot.readings().time.period_s));
}

double heatRange(const Robot& robot) {
  for (const auto kind : {SensorKind::heat, SensorKind::odometry}) {
    if (robot.sensor(kind)) continue;
    throw std::invalid_argument("robot '" + robot.name() + "' has no " + nameOf(kind) +
                                ", which a gold finder needs; give its model an <" + nameOf(kind) + "/>");
  }
  return robot.sensor(SensorKind::heat)->range_max_m;
}

}  // namespace

Explorer::Explorer(const Robot& robot, const ControllerSetup& setup, double warm)
    : setup_(setup),
      warm_(warm),
      map_(kCell_radii * robot.info().radius_m),
      obstacles_(map_, robot.info().radius_m),
      heat_(map_, heatRange(robot), robot.info().radius_m),
      rng_(setup.seed, RandomPurpose::controller, setup.robot) {}

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
  if (robot.stepNumber() >= planned_step_ + kPlanPause) {
    bool new_plan = driver_.empty() || atGoal();
    if (!new_plan && obstacles_.changes() != planned_changes_) {
      planned_changes_ = obstacles_.changes();
      new_plan = driver_.blocked(map_);
    }
    if (new_plan) plan(robot);
  }
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
  if (looked_ && moved < map_.cellSize() / 2 && turned < 0.2 && robot.stepNumber() < looked_step_ + kLookPause) return;
  looked_ = true;
  looked_from_ = pose;
  looked_step_ = robot.stepNumber();

  const Cell at = map_.cellAt(place());
  const int reach = std::max(Obstacles::kReach_cells, heat_.reach()) + 4;
  map_.cover({at.x - reach, at.y - reach}, {at.x + reach, at.y + reach});
  if (const SensorInfo* sonar = robot.sensor(SensorKind::sonar)) obstacles_.look(pose, *sonar, robot.sonar());
  if (const SensorInfo* laser = robot.sensor(SensorKind::laser)) {
    obstacles_.look(pose, *laser, robot.laser(), (robot.laser().size() + kLaserBeams - 1) / kLaserBeams);
  }
  obstacles_.clearUnder(place());

  const double heat = robot.heat().value_or(0);
  if (!heat_.measure(place(), heat)) return;
  if (!following_ && heat >= warm_ && robot.stepNumber() >= explore_until_) {
    following_ = true;
    follow_until_ = robot.stepNumber() + stepsIn(kFollow_s, robot);
  }
  if (following_) driver_.clear();  // the likely source has moved: plan anew
}

void Explorer::plan(const Robot& robot) {
  planned_step_ = robot.stepNumber();
  planned_changes_ = obstacles_.changes();
  const Cell start = map_.cellAt(place());
  driver_.clear();
  if (following_) {
    if (robot.stepNumber() < follow_until_ && planToHeat(start)) return;
    following_ = false;
    explore_until_ = robot.stepNumber() + stepsIn(kExplore_s, robot);
  }
  if (planToSearch(start)) return;
  obstacles_.forgetDoubtful();
  if (planToSearch(start)) return;
  startOver();
}

bool Explorer::planToHeat(const Cell& start) {
  const auto source = heat_.source();
  if (!source) return false;
  const Cell center = map_.cellAt(source->place);
  const double cell_m = map_.cellSize();
  const double reach_cells = 0.6 * heat_.range() / cell_m;
  const auto judge = [&](const Cell& cell) {
    if (map_[cell].stood || map_[cell].blocked()) return -1;
    const double distance = std::hypot(cell.x - center.x, cell.y - center.y);
    return distance > reach_cells ? -1 : static_cast<int>(kCloser * distance);
  };
  const auto goal = wavefront_.findGoal(map_, start, kFollowReach, judge);
  if (!goal || *goal == start) return false;
  wavefront_.wayTo(map_, *goal, way_);
  driver_.follow(way_);
  return true;
}

bool Explorer::planToSearch(const Cell& start) {
  // Of places equally near the one ahead: turning takes time, and straight lanes leave no patches between them.
  const auto& pose = tracker_.startFromRobot();
  const double ahead_x = std::cos(pose.phi), ahead_y = std::sin(pose.phi);
  const auto judge = [&](const Cell& cell) {
    if (map_[cell].searched || map_[cell].blocked() || isSliver(cell)) return -1;
    const double x = cell.x - start.x, y = cell.y - start.y;
    return static_cast<int>(kTurn * (1 - (x * ahead_x + y * ahead_y) / std::hypot(x, y)));
  };
  const auto goal = wavefront_.findGoal(map_, start, kSearchReach, judge);
  if (!goal || *goal == start) return false;
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

void Explorer::startOver() {
  map_.reset();
  heat_.reset();
  looked_ = false;
  ++rounds_;
}

bool Explorer::atGoal() const {
  const Cell& goal = driver_.goal();
  if (following_) return map_[goal].stood || ringDistance(map_.cellAt(place()), goal) == 0;
  return map_[goal].searched;
}

bool Explorer::isStuck(const Robot& robot) {
  const auto& pose = tracker_.startFromRobot();
  const double moved = std::hypot(pose.x - moved_from_.x, pose.y - moved_from_.y);
  if (moved > map_.cellSize() / 2 || std::abs(mrpt::math::wrapToPi(pose.phi - moved_from_.phi)) > 0.3) {
    moved_from_ = pose;
    moved_step_ = robot.stepNumber();
  }
  return robot.stepNumber() > moved_step_ + stepsIn(kStuck_s, robot);
}

void Explorer::drawBack(Robot& robot) {
  const auto& pose = tracker_.startFromRobot();
  const MotionLimits& limits = robot.info().limits;
  // Whatever holds it, the map did not know: it is just ahead.
  const double reach = robot.info().radius_m + map_.cellSize() / 2;
  obstacles_.bump({pose.x + reach * std::cos(pose.phi), pose.y + reach * std::sin(pose.phi)});
  driver_.clear();
  back_until_ = robot.stepNumber() + stepsIn(rng_.uniform(0.5, 3), robot);
  back_speed_ = -rng_.uniform(0.1, 0.4) * limits.speed_max_mps;
  back_turn_ = rng_.uniform(-0.5, 0.5) * limits.turn_max_radps;
  moved_step_ = back_until_;
}

}  // namespace robosim
