#include "maze/pushing/soccer_player.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include <mrpt/math/wrap2pi.h>

#include "base/portable_math.h"
#include "base/portable_pose.h"
#include "maze/message_numbers.h"
#include "maze/pushing/disc_pusher.h"
#include "maze/pushing/low_objects.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

constexpr const char* kBall = "BALL";
constexpr double kMateFresh_s = 0.5;     // age up to which a team-mate's message counts
constexpr double kBallRemembered_s = 3;  // age up to which a ball out of view is where it was
constexpr double kTurnCost_m = 0.4;      // way that equals a radian round the ball
constexpr double kKeeperShare = 0.6;     // of half the goal's width, to which the keeper moves
constexpr double kShot_rad = 0.25;       // error up to which a player shoots
constexpr double kShotFactor = 1.4;      // of the speed, then
constexpr double kRest_m = 0.15;         // distance within which a ball does not move
constexpr double kHeld_m = 0.6;          // distance of a player from a ball that it may hold
constexpr double kHeld_s = 1.5;          // time after which the most impatient player gives way
constexpr int kStallsMax = 8;            // steps
constexpr double kStallBackOff_s = 0.7;

double normOf(const TPoint2D& offset) { return portable::hypot(offset.x, offset.y); }

std::int64_t inMillimetres(double m) { return static_cast<std::int64_t>(std::floor(1000 * m + 0.5)); }

}  // namespace

SoccerPlayer::SoccerPlayer(const ControllerSetup& setup, const SoccerOptions& options)
    : setup_(setup),
      options_(options),
      tracker_(setup.world_from_start.value_or(TPose2D())),
      world_from_robot_(setup.world_from_start.value_or(TPose2D())) {}

void SoccerPlayer::step(Robot& robot) {
  locate(robot);
  readMessages(robot);
  lookForBall(robot);
  if (isFreeing(robot)) return;
  if (!ball_) {
    robot.drive(0, 0.5);  // a ball that a robot hides comes into view
    return;
  }
  if (options_.is_keeper) {
    keep(robot);
  } else if (isNearestToBall(robot)) {
    chase(robot);
  } else {
    support(robot);
  }
}

/// The difference of the squares of the ranges to two corners is linear in the position; heights cancel.
void SoccerPlayer::locate(const Robot& robot) {
  world_from_robot_ = tracker_.update(robot);
  const auto* measurement = robot.measurement(SensorKind::beacons);
  const auto* beacons = measurement ? std::get_if<BeaconRanges>(measurement) : nullptr;
  if (!beacons || beacons->range_m.size() != 4) return;
  double squares[4];
  for (std::size_t i = 0; i < 4; ++i) squares[i] = double{beacons->range_m[i]} * beacons->range_m[i];
  const double length_m = 2 * std::abs(options_.goal_x_m), width_m = 2 * options_.half_width_m;
  world_from_robot_.x = (squares[0] - squares[1] + squares[3] - squares[2]) / (4 * length_m);
  world_from_robot_.y = (squares[0] - squares[3] + squares[1] - squares[2]) / (4 * width_m);
  if (const auto compass_rad = robot.compass()) world_from_robot_.phi = *compass_rad;
}

void SoccerPlayer::readMessages(const Robot& robot) {
  for (const RobotMessage& message : robot.inbox()) {
    const auto numbers = numbersOf(message.text, kBall, 4);
    if (!numbers || (*numbers)[0] != static_cast<std::int64_t>(side())) continue;
    const auto metres = [&](std::size_t i) { return static_cast<double>((*numbers)[i]) / 1000; };
    by_mate_[message.from] = {{metres(1), metres(2)}, metres(3), robot.stepNumber()};
  }
}

double SoccerPlayer::costOf(const TPoint2D& ball) const {
  const PushTask task{ball, options_.ball_radius_m, {options_.goal_x_m, 0}};
  return normOf({ball.x - world_from_robot_.x, ball.y - world_from_robot_.y}) +
         kTurnCost_m * std::abs(pushError(task, world_from_robot_));
}

void SoccerPlayer::lookForBall(Robot& robot) {
  const std::uint64_t now = robot.stepNumber();
  const std::optional<Sighting> before = ball_;
  const auto objects = lowObjects(robot, options_.ball_radius_m);
  if (!objects.empty()) {
    const TPoint2D ball = portable::compose(world_from_robot_, objects.front());
    ball_ = {ball, costOf(ball), now};
    if (!options_.is_keeper) {
      robot.broadcast(messageText(kBall, {static_cast<std::int64_t>(side()), inMillimetres(ball.x),
                                          inMillimetres(ball.y), inMillimetres(ball_->cost_m)}));
    }
  } else {
    for (const auto& [name, sighting] : by_mate_) {
      if (!ball_ || sighting.step > ball_->step) ball_ = sighting;
    }
    if (ball_ && now > ball_->step + robot.stepsIn(kBallRemembered_s)) ball_.reset();
  }
  if (!before || !ball_ || ball_->step <= before->step) return;
  const double elapsed_s = static_cast<double>(ball_->step - before->step) * robot.readings().time.period_s;
  ball_mps_ = ball_mps_ * 0.5 + (ball_->ball - before->ball) * (0.5 / elapsed_s);
}

bool SoccerPlayer::isNearestToBall(const Robot& robot) const {
  const double own_m = costOf(ball_->ball);
  return std::none_of(by_mate_.begin(), by_mate_.end(), [&](const auto& mate) {
    const Sighting& theirs = mate.second;
    const bool is_fresh = theirs.step + robot.stepsIn(kMateFresh_s) >= robot.stepNumber();
    return is_fresh && (theirs.cost_m < own_m || (theirs.cost_m == own_m && mate.first < robot.name()));
  });
}

/// Backs off after several stalls in a row, and from a ball that does not move, which another robot or a wall holds.
/// Players have different patience, so that one of two that hold the ball between them gives way.
bool SoccerPlayer::isFreeing(Robot& robot) {
  const std::uint64_t now = robot.stepNumber();
  stalls_ = robot.stalled() ? stalls_ + 1 : 0;
  const TPoint2D place(world_from_robot_.x, world_from_robot_.y);
  if (!ball_ || normOf(ball_->ball - rest_) > kRest_m || normOf(ball_->ball - place) > kHeld_m) {
    rest_ = ball_ ? ball_->ball : place;
    rest_step_ = now;
  }
  const bool is_held = now > rest_step_ + robot.stepsIn(kHeld_s * (1 + 0.4 * (setup_.robot * 2 % 5)));
  if (stalls_ >= kStallsMax || is_held) {
    stalls_ = 0;
    rest_step_ = now;
    back_until_ = robot.stepNumber() + robot.stepsIn(kStallBackOff_s);
  }
  if (robot.stepNumber() >= back_until_) return false;
  robot.drive(-0.4 * options_.speed_mps, setup_.robot % 2 == 0 ? 0.8 : -0.8);
  return true;
}

/// Where the ball is to go: into the goal; along a wall where there is no room for the robot behind the ball.
TPoint2D SoccerPlayer::aim(const Robot& robot) const {
  const TPoint2D& ball = ball_->ball;
  const TPoint2D goal(options_.goal_x_m + 0.3 * side(), freeGoal_y_m(robot));
  const double behind_m = robot.info().radius_m + options_.ball_radius_m;
  const TPoint2D way = goal - ball;
  const TPoint2D behind = ball - way * (behind_m / normOf(way));
  const double radius_m = robot.info().radius_m;
  const double end_m = std::abs(options_.goal_x_m);
  const double corner_m = end_m + options_.half_width_m - options_.corner_m;  // |x| + |y| on a wall across a corner
  const bool is_in_own_half = side() * ball.x < 0;
  const double outward = std::copysign(1.0, ball.y);
  if (std::abs(behind.y) > options_.half_width_m - radius_m) return {ball.x + 2 * side(), ball.y};
  if (std::abs(behind.x) + std::abs(behind.y) > corner_m - std::numbers::sqrt2 * radius_m) {
    return {ball.x + side(), ball.y + (is_in_own_half ? outward : -outward)};
  }
  if (-side() * behind.x > end_m - radius_m && std::abs(ball.y) > options_.goal_half_width_m) {
    return {ball.x, ball.y + outward};
  }
  return goal;
}

/// The place in the goal with the most room between the way of the ball and other robots in view.
double SoccerPlayer::freeGoal_y_m(const Robot& robot) const {
  const auto* measurement = robot.measurement(kHighLaser);
  const auto* echoes = measurement ? std::get_if<Echoes>(measurement) : nullptr;
  const double free_m = options_.goal_half_width_m - options_.ball_radius_m;
  double best_y_m = 0, best_room_m = -1;
  for (const double share : {0.0, 0.35, -0.35, 0.7, -0.7}) {
    const TPoint2D way = TPoint2D(options_.goal_x_m, share * free_m) - ball_->ball;
    const double length_m = std::max(0.01, normOf(way));
    double room_m = 0.4;  // more is as good
    if (!echoes) break;
    for (const Echo& echo : *echoes) {
      const TPoint2D place = portable::compose(world_from_robot_, TPoint2D(echo.point_m.x, echo.point_m.y));
      const TPoint2D from_ball = place - ball_->ball;
      const double along_m = (from_ball.x * way.x + from_ball.y * way.y) / length_m;
      const double aside_m = std::abs(from_ball.y * way.x - from_ball.x * way.y) / length_m;
      if (along_m > 0 && along_m < length_m) room_m = std::min(room_m, aside_m);
    }
    if (room_m <= best_room_m) continue;
    best_room_m = room_m;
    best_y_m = share * free_m;
  }
  return best_y_m;
}

void SoccerPlayer::chase(Robot& robot) {
  // Where the ball will be when the robot has turned and come closer.
  const double ahead_s = std::min(0.6, 0.25 * ball_->cost_m);
  const TPoint2D ball = ball_->ball + ball_mps_ * ahead_s;
  const PushTask task{ball, options_.ball_radius_m, aim(robot)};
  const bool is_aligned = std::abs(pushError(task, world_from_robot_)) < kShot_rad;
  pushDisc(robot, world_from_robot_, task, (is_aligned ? kShotFactor : 1) * options_.speed_mps);
}

void SoccerPlayer::keep(Robot& robot) {
  const TPoint2D& ball = ball_->ball;
  const double line_x_m = -options_.goal_x_m + 0.3 * side();
  const bool is_close = normOf(ball - TPoint2D(-options_.goal_x_m, 0)) < 1.3 && normOf(ball_mps_) < 0.4;
  if (is_close) {
    chase(robot);
    return;
  }
  // The line from the ball to the middle of the goal, or the ball's course, where it meets the keeper's line.
  double y_m = ball.y * std::clamp(0.6 / std::max(0.6, side() * (ball.x - line_x_m)), 0.0, 1.0);
  if (side() * ball_mps_.x < -0.3) y_m = ball.y + ball_mps_.y * (line_x_m - ball.x) / ball_mps_.x;
  y_m = std::clamp(y_m, -kKeeperShare * options_.goal_half_width_m, kKeeperShare * options_.goal_half_width_m);
  const TPoint2D place(line_x_m, y_m);
  if (std::abs(world_from_robot_.x - line_x_m) > 0.25) {
    driveTo(robot, world_from_robot_, place, options_.speed_mps, 0.1);
    return;
  }
  // Along its line, ahead or back.
  const double upright_rad = world_from_robot_.phi > 0 ? std::numbers::pi / 2 : -std::numbers::pi / 2;
  const double turn_rad = mrpt::math::wrapToPi(upright_rad - world_from_robot_.phi);
  const double way_m = (y_m - world_from_robot_.y) * (upright_rad > 0 ? 1 : -1);
  const double braking_mps = std::sqrt(robot.info().type->limits.decel_mps2 * std::abs(way_m));
  const double speed_mps =
      std::abs(turn_rad) > 0.4 ? 0 : std::copysign(std::min(options_.speed_mps, braking_mps), way_m);
  robot.drive(speed_mps, 4 * turn_rad);
}

void SoccerPlayer::support(Robot& robot) {
  const TPoint2D& ball = ball_->ball;
  const double aside_m = setup_.robot % 2 == 0 ? 0.8 : -0.8;
  const double x_m = ball.x - 1.6 * side();
  const double y_max_m = options_.half_width_m - 0.6;
  const TPoint2D place(std::clamp(x_m, -std::abs(options_.goal_x_m) + 1.2, std::abs(options_.goal_x_m) - 1.2),
                       std::clamp(0.5 * ball.y + aside_m, -y_max_m, y_max_m));
  driveTo(robot, world_from_robot_, place, 0.7 * options_.speed_mps, 0.2);
}

}  // namespace robosim
