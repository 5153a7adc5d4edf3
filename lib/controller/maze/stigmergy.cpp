#include "maze/stigmergy.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "base/portable_math.h"
#include "base/random.h"
#include "control/echo.h"

namespace robosim {
namespace {

constexpr int kDirections = 16;
constexpr double kTurnCost = 0.1;      // of turning by 180°, in units of a visit
constexpr double kRandomCost = 0.02;   // decides among equal directions
constexpr double kBlockedCost = 1000;  // of a direction without room for the next cell

}  // namespace

double clearanceTowards(const Robot& robot, double bearing_rad) {
  const double radius = robot.info().radius_m;
  const auto [sin, cos] = portable::sincos(bearing_rad);
  double clearance = std::numeric_limits<double>::infinity();
  for (const auto kind : {SensorKind::sonar, SensorKind::laser, SensorKind::infrared}) {
    const SensorInfo* sensor = robot.sensor(kind);
    for (const Echo& echo : robot.echoes(kind)) {
      const double x = cos * echo.point_m.x + sin * echo.point_m.y, y = cos * echo.point_m.y - sin * echo.point_m.x;
      if (x <= 0 || std::abs(y) >= radius || !isEcho(*sensor, echo)) continue;
      clearance = std::min(clearance, x - std::sqrt(radius * radius - y * y));
    }
  }
  return clearance;
}

Stigmergy::Stigmergy(const ControllerSetup& setup, const StigmergyOptions& options)
    : setup_(setup),
      options_(options),
      recovery_(setup),
      tracker_(setup.world_from_start.value_or(mrpt::math::TPose2D())) {}

void Stigmergy::step(Robot& robot) {
  if (!trails_) trails_.emplace(options_.cell_m, options_.evaporation_s, robot.readings().time.period_s);
  tracker_.update(robot);
  mark(robot);
  const bool has_ended = step_.hasEnded(robot);
  if (recovery_.takesOver(robot)) {
    step_.drop();
    return;
  }
  if (has_ended) choose(robot);
  step_.drive(robot);
}

void Stigmergy::mark(Robot& robot) {
  const auto& pose = tracker_.startFromRobot();
  const Cell here = trails_->cellAt({pose.x, pose.y});
  if (last_cell_ != here) {
    last_cell_ = here;
    trails_->visit(here, robot.stepNumber());
    if (setup_.world_from_start) robot.broadcast(TrailMessage{here}.text());
  }
  if (!setup_.world_from_start) return;
  for (const RobotMessage& message : robot.inbox()) {
    if (const auto trail = TrailMessage::parse(message.text)) trails_->visit(trail->cell, robot.stepNumber());
  }
}

void Stigmergy::choose(const Robot& robot) {
  Rng rng(setup_.seed, RandomPurpose::controller, setup_.robot, 0, robot.stepNumber());
  has_drawn_ = true;
  const auto& pose = tracker_.startFromRobot();
  double best_turn_rad = 0, best_cost = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kDirections; ++i) {
    const double turn_rad = (i - kDirections / 2) * 2 * std::numbers::pi / kDirections;
    const auto [sin, cos] = portable::sincos(pose.phi + turn_rad);
    const mrpt::math::TPoint2D ahead(pose.x + options_.cell_m * cos, pose.y + options_.cell_m * sin);
    double cost = trails_->amount(trails_->cellAt(ahead), robot.stepNumber()) +
                  kTurnCost * std::abs(turn_rad) / std::numbers::pi + kRandomCost * rng.uniform();
    const double clearance_m = clearanceTowards(robot, turn_rad) - stoppingGap(robot);
    if (clearance_m < options_.cell_m) cost += kBlockedCost * (1 - std::max(0.0, clearance_m) / options_.cell_m);
    if (cost >= best_cost) continue;
    best_cost = cost;
    best_turn_rad = turn_rad;
  }
  step_.begin(best_turn_rad, options_.cell_m);
}

}  // namespace robosim
