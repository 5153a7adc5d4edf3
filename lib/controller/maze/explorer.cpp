#include "maze/explorer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include <mrpt/math/wrap2pi.h>

#include "base/portable_math.h"
#include "base/portable_pose.h"
#include "maze/laser_surfaces.h"

namespace robosim {
namespace {

constexpr double kCell_radii = 0.6;
constexpr int kSearchReach = 1000000;     // cost limit: unlimited in practice
constexpr int kFollowReach = 400;         // cost: heat is near, but the path to it may lead around walls
constexpr double kCloser = 3;             // cost of ending a cell farther from the likely source
constexpr double kNearSource = 0.6;       // of the sensor's range: how near the likely source it looks
constexpr double kTurnCost = 4;           // cost of a goal at right angles to the robot's heading
constexpr double kSliver = 0.3;           // share of a neighbourhood that must be unsearched to be worth a trip
constexpr std::size_t kBeams = 32;        // maximum number of beams used per sensor
constexpr double kLookTurn_rad = 0.2;     // turn after which the map is updated
constexpr std::uint64_t kLookPause = 10;  // maximum steps between two map updates
constexpr std::uint64_t kPlanPause = 3;   // steps between two plans, at least
constexpr double kFollow_s = 120;         // maximum time, then it explores
constexpr double kExplore_s = 60;         // for so long
constexpr double kNothingLeft_s = 5;      // then it starts a new map
constexpr double kStuck_s = 1.5;
constexpr int kStallMax = 1;  // steps in a row, if sensors are noisy
// Of a robot without headway, however often it has drawn back.
constexpr StuckRecoveryOptions kRecovery{.timeout_s = 60, .headway_radii = 3};
constexpr double kSurfaceCell_m = 0.15;

constexpr std::array kRangeSensors{SensorKind::sonar, SensorKind::laser, SensorKind::infrared};

/// Number of echoes of a sensor per one that is used.
std::size_t strideOf(const Echoes& echoes) { return (echoes.size() + kBeams - 1) / kBeams; }

/// The sonars, if they are noisy.
const SensorInfo* noisySonar(const Robot& robot) {
  const SensorInfo* sonar = robot.sensor(SensorKind::sonar);
  return sonar && sonar->noise_std_m > 0 ? sonar : nullptr;
}

/// Whether any range sensor is noisy; the others are then not taken as exact either.
bool isNoisy(const Robot& robot) {
  return std::any_of(kRangeSensors.begin(), kRangeSensors.end(),
                     [&](SensorKind kind) { return robot.sensor(kind) && robot.sensor(kind)->noise_std_m > 0; });
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

Explorer::Explorer(const Robot& robot, const ControllerSetup& setup, double warm,
                   const mrpt::math::TPose2D& map_from_start)
    : warm_(warm),
      rng_(setup.seed, RandomPurpose::controller, setup.robot),
      recovery_(setup, kRecovery),
      has_noise_(isNoisy(robot)),
      tracker_(map_from_start, has_noise_),
      matcher_(kSurfaceCell_m),
      search_(kCell_radii * robot.info().radius_m, heatRange(robot), robot.info().radius_m) {}

void Explorer::step(Robot& robot, const GoalCost* goal_cost) {
  track(robot);
  look(robot);
  if (recovery_.takesOver(robot)) {
    driver_.clear();
    return;
  }
  if (robot.stepNumber() < back_until_) {
    robot.drive(back_speed_, back_turn_);
    return;
  }
  if (isStuck(robot)) {
    drawBack(robot);
    return;
  }
  if (robot.stepNumber() >= plan_from_ && needsPlan()) plan(robot, goal_cost);
  if (driver_.empty()) {
    robot.drive(0, robot.info().type->limits.turn_max_radps / 2);  // look around
  } else {
    driver_.drive(robot, tracker_.startFromRobot(), search_.map);
  }
}

void Explorer::track(const Robot& robot) {
  const mrpt::math::TPose2D& pose = tracker_.update(robot);
  if (const SensorInfo* sonar = noisySonar(robot)) sonars_.update(*sonar, robot.sonar(), pose);
}

void Explorer::correctPose(const Robot& robot) {
  surfaces_.clear();
  const mrpt::math::TPose2D before = tracker_.startFromRobot();
  if (const SensorInfo* laser = robot.sensor(SensorKind::laser)) {
    addLaserSurfaces(*laser, robot.laser(), strideOf(robot.laser()), surfaces_);
  }
  const SensorInfo* const sonar = noisySonar(robot);
  if (sonar) sonars_.interpret(*sonar, before, surfaces_);
  tracker_.match(surfaces_, matcher_);
  if (sonar) sonars_.correct(before, tracker_.startFromRobot());
}

void Explorer::look(const Robot& robot) {
  const auto& pose = tracker_.startFromRobot();
  const double moved = portable::hypot(pose.x - looked_from_.x, pose.y - looked_from_.y);
  const double turned = std::abs(mrpt::math::wrapToPi(pose.phi - looked_from_.phi));
  if (robot.stepNumber() < look_at_ && moved < search_.map.cellSize() / 2 && turned < kLookTurn_rad) return;
  if (has_noise_) correctPose(robot);
  looked_from_ = pose;
  look_at_ = robot.stepNumber() + kLookPause;

  const Cell at = search_.map.cellAt(place());
  const int reach = std::max(search_.obstacles.reach(), search_.heat.reach());
  search_.map.cover({at.x - reach, at.y - reach}, {at.x + reach, at.y + reach});
  for (const auto kind : kRangeSensors) {
    const Echoes& echoes = robot.echoes(kind);
    if (echoes.empty() || (kind == SensorKind::sonar && noisySonar(robot))) continue;
    search_.obstacles.look(pose, *robot.sensor(kind), echoes, strideOf(echoes));
  }
  if (noisySonar(robot)) {
    for (const auto& ray : sonars_.rays()) search_.obstacles.trace(ray.from, ray.to, ray.hit, ray.is_sure);
  }
  search_.obstacles.clearUnder(place());
  feel(robot);
}

void Explorer::feel(const Robot& robot) {
  const double heat = robot.heat().value_or(0);
  if (!search_.heat.measure(place(), heat)) return;
  if (following_) {
    source_moved_ = true;
  } else if (heat >= warm_ && robot.stepNumber() >= explore_until_) {
    search_.heat.searchFromHere();
    following_ = planToHeat(search_.map.cellAt(place()));
    follow_until_ = robot.stepNumber() + robot.stepsIn(kFollow_s);
  }
}

bool Explorer::needsPlan() {
  if (driver_.empty() || source_moved_ || atGoal()) return true;
  if (search_.obstacles.changes() == seen_changes_) return false;
  seen_changes_ = search_.obstacles.changes();
  return driver_.blocked(search_.map);
}

void Explorer::plan(const Robot& robot, const GoalCost* goal_cost) {
  const std::uint64_t now = robot.stepNumber();
  const Cell start = search_.map.cellAt(place());
  plan_from_ = now + kPlanPause;
  source_moved_ = false;
  driver_.clear();
  if (following_) {
    if (now < follow_until_ && planToHeat(start)) return;
    following_ = false;
    if (now >= follow_until_) explore_until_ = now + robot.stepsIn(kExplore_s);
  }
  if (planToSearch(start, goal_cost)) {
    nothing_left_since_.reset();
    return;
  }
  // Another robot may block the path temporarily.
  plan_from_ = now + robot.stepsIn(1);
  if (!nothing_left_since_) {
    nothing_left_since_ = now;
    search_.obstacles.removeUncertain();
  } else if (now >= *nothing_left_since_ + robot.stepsIn(kNothingLeft_s)) {
    startOver();
  }
}

bool Explorer::planToHeat(const Cell& start) {
  const auto source = search_.heat.source();
  if (!source) return false;
  const Cell center = search_.map.cellAt(source->place);
  const double reach_cells = kNearSource * search_.heat.range() / search_.map.cellSize();
  return planTo(start, kFollowReach, [&](const Cell& cell) {
    if (search_.map[cell].stood) return -1;
    const double distance = portable::hypot(cell.x - center.x, cell.y - center.y);
    return distance > reach_cells ? -1 : static_cast<int>(kCloser * distance);
  });
}

bool Explorer::planToSearch(const Cell& start, const GoalCost* goal_cost) {
  // Of places equally near the one ahead: turning takes time, and straight lanes leave no patches between them.
  const auto& pose = tracker_.startFromRobot();
  const auto ahead = portable::sincos(pose.phi);
  return planTo(start, kSearchReach, [&](const Cell& cell) {
    if (search_.map[cell].searched || isSliver(cell)) return -1;
    const double x = cell.x - start.x, y = cell.y - start.y;
    const int turn = static_cast<int>(kTurnCost * (1 - (x * ahead.cos + y * ahead.sin) / portable::hypot(x, y)));
    return turn + (goal_cost ? goal_cost->computeCost(cell) : 0);
  });
}

template <typename Judge>
bool Explorer::planTo(const Cell& start, int cost_max, const Judge& judge) {
  const auto goal = wavefront_.findGoal(search_.map, start, cost_max, [&](const Cell& cell) {
    return cell == start || search_.map[cell].blocked() ? -1 : judge(cell);
  });
  if (!goal) return false;
  wavefront_.pathTo(search_.map, *goal, path_);
  driver_.follow(path_);
  return true;
}

bool Explorer::isSliver(const Cell& cell) const {
  int open = 0, unsearched = 0;
  for (int y = cell.y - 2; y <= cell.y + 2; ++y) {
    for (int x = cell.x - 2; x <= cell.x + 2; ++x) {
      if (!search_.map.contains({x, y}) || search_.map[{x, y}].blocked()) continue;
      ++open;
      unsearched += search_.map[{x, y}].searched ? 0 : 1;
    }
  }
  return unsearched < kSliver * open;
}

bool Explorer::atGoal() const {
  const Cell& goal = driver_.goal();
  if (following_) return search_.map[goal].stood || search_.map.cellAt(place()) == goal;
  return search_.map[goal].searched;
}

void Explorer::startOver() {
  search_.map.reset();
  search_.heat.reset();
  matcher_.reset();
  driver_.clear();
  nothing_left_since_.reset();
  look_at_ = 0;
  plan_from_ = 0;
  ++rounds_;
}

bool Explorer::isStuck(const Robot& robot) {
  const auto& pose = tracker_.startFromRobot();
  const double moved = portable::hypot(pose.x - moved_from_.x, pose.y - moved_from_.y);
  if (moved > search_.map.cellSize() / 2 || std::abs(mrpt::math::wrapToPi(pose.phi - moved_from_.phi)) > 0.3) {
    moved_from_ = pose;
    moved_at_ = robot.stepNumber();
  }
  // Noisy sensors miss obstacles, and slipping wheels pretend motion.
  stalled_steps_ = has_noise_ && robot.stalled() ? stalled_steps_ + 1 : 0;
  return robot.stepNumber() > moved_at_ + robot.stepsIn(kStuck_s) || stalled_steps_ > kStallMax;
}

void Explorer::drawBack(Robot& robot) {
  const auto& pose = tracker_.startFromRobot();
  const MotionLimits& limits = robot.info().type->limits;
  // The map does not contain the obstacle, which must be directly ahead.
  const double reach = robot.info().radius_m + search_.map.cellSize() / 2;
  search_.obstacles.bump(portable::compose(pose, mrpt::math::TPoint2D(reach, 0)));
  driver_.clear();
  has_drawn_ = true;
  back_until_ = robot.stepNumber() + robot.stepsIn(rng_.uniform(0.5, 3));
  const bool backwards = clearanceInLane(robot, -1) >= clearanceInLane(robot, 1);
  back_speed_ = (backwards ? -1 : 1) * rng_.uniform(0.1, 0.4) * limits.speed_max_mps;
  back_turn_ = rng_.uniform(-0.5, 0.5) * limits.turn_max_radps;
  moved_at_ = back_until_;
}

}  // namespace robosim
