#include "maze/path_driver.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <mrpt/math/wrap2pi.h>

#include "base/portable_math.h"
#include "control/echo.h"

namespace robosim {
namespace {

constexpr std::size_t kLookAhead = 8;            // cells
constexpr std::size_t kLookAheadWhereTight = 2;  // cells
constexpr std::size_t kWatchAhead = 24;          // cells
constexpr double kTurnGain_per_s = 2.5;
constexpr double kTurnOnSpot_rad = 1.0;  // above this heading error it turns on the spot
constexpr double kBendSpeed = 0.5;       // of its maximum speed, at the end of a straight segment
constexpr double kGap_m = 0.05;          // distance kept from obstacles in front

/// The highest speed from which a robot can brake to `end_mps` within `clearance_m`, if it starts one step late.
double brakingSpeed(double clearance_m, double end_mps, double decel_mps2, double period_s) {
  const double loss = decel_mps2 * period_s;
  return std::sqrt(loss * loss + 2 * decel_mps2 * clearance_m + end_mps * end_mps) - loss;
}

/// Whether a robot can drive straight from one cell to another with clearance: no cell on the line is close to a wall.
bool isRoomy(const MazeMap& map, const Cell& from, const Cell& to) {
  const int steps = ringDistance(from, to);
  for (int i = 1; i <= steps; ++i) {
    const auto between = [&](int a, int b) {
      return static_cast<int>(std::lround(a + (b - a) * static_cast<double>(i) / steps));
    };
    const Cell cell{between(from.x, to.x), between(from.y, to.y)};
    if (map.contains(cell) && map[cell].walls_close > 0) return false;
  }
  return true;
}

}  // namespace

double clearanceInLane(const Robot& robot, int direction) {
  const double radius = robot.info().radius_m;
  double clearance = std::numeric_limits<double>::infinity();
  for (const auto kind : {SensorKind::sonar, SensorKind::laser, SensorKind::infrared}) {
    const SensorInfo* sensor = robot.sensor(kind);
    for (const Echo& echo : robot.echoes(kind)) {
      const double x = direction * echo.point_m.x, y = echo.point_m.y;
      if (x <= 0 || std::abs(y) >= radius || !isEcho(*sensor, echo)) continue;
      clearance = std::min(clearance, x - std::sqrt(radius * radius - y * y));
    }
  }
  return clearance;
}

void PathDriver::follow(const std::vector<Cell>& path) {
  path_ = path;
  next_ = 0;
}

bool PathDriver::blocked(const MazeMap& map) const {
  const std::size_t end = std::min(path_.size(), next_ + kWatchAhead);
  // The first cells may be blocked: the robot is about to leave them.
  for (std::size_t i = next_ + 2; i < end; ++i) {
    if (map.contains(path_[i]) && map[path_[i]].blocked()) return true;
  }
  return false;
}

void PathDriver::advance(const MazeMap& map, const mrpt::math::TPoint2D& robot) {
  const auto distance = [&](std::size_t i) { return (map.center(path_[i]) - robot).norm(); };
  while (next_ + 1 < path_.size() && distance(next_ + 1) <= distance(next_)) ++next_;
}

Cell PathDriver::aim(const MazeMap& map, const Cell& robot) const {
  std::size_t i = std::min(next_ + kLookAhead, path_.size() - 1);
  const std::size_t nearest = std::min(next_ + kLookAheadWhereTight, path_.size() - 1);
  while (i > nearest && !isRoomy(map, robot, path_[i])) --i;
  return path_[i];
}

void PathDriver::drive(Robot& robot, const mrpt::math::TPose2D& start_from_robot, const MazeMap& map) {
  const mrpt::math::TPoint2D at(start_from_robot.x, start_from_robot.y);
  advance(map, at);
  const mrpt::math::TPoint2D aim_point = map.center(aim(map, map.cellAt(at)));
  const double off =
      mrpt::math::wrapToPi(portable::atan2(aim_point.y - at.y, aim_point.x - at.x) - start_from_robot.phi);

  const double to_aim = (aim_point - at).norm();
  const bool at_end = next_ + 1 == path_.size();
  if (at_end && to_aim < map.cellSize() / 2) {
    robot.stop();
    return;
  }
  const MotionLimits& limits = robot.info().type->limits;
  double speed = 0;
  if (std::abs(off) < kTurnOnSpot_rad) {
    // Slow enough to brake within the clearance, and to reach the target point with kBendSpeed.
    const double clearance = std::max(0.0, clearanceInLane(robot, 1) - kGap_m);
    const double bend_mps = at_end ? 0 : kBendSpeed * limits.speed_max_mps;
    const double on_course = portable::cos(off * M_PI_2 / kTurnOnSpot_rad);
    const double period_s = robot.readings().time.period_s;
    speed = std::min({limits.speed_max_mps * on_course, brakingSpeed(clearance, 0, limits.decel_mps2, period_s),
                      brakingSpeed(to_aim, bend_mps, limits.decel_mps2, period_s)});
  }
  robot.drive(speed, std::clamp(kTurnGain_per_s * off, -limits.turn_max_radps, limits.turn_max_radps));
}

}  // namespace robosim
