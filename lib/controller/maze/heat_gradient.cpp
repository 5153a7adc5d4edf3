#include "maze/heat_gradient.h"

#include <algorithm>
#include <cmath>

#include <mrpt/math/wrap2pi.h>

#include "base/portable_math.h"
#include "maze/path_driver.h"

namespace robosim {
namespace {

constexpr std::size_t kKept = 12;
constexpr double kSpacing_radii = 0.3;
constexpr double kSpread = 0.02;    // of the lesser to the greater extent of the places, both squared
constexpr double kSpeed = 0.4;      // fraction of the maximum speed
constexpr double kArc_radii = 1.5;  // radius of the arc, in robot radii
constexpr double kDetour_s = 4;     // random walk after an obstacle
constexpr double kTurnRate_per_s = 2;

}  // namespace

void HeatSlope::measure(const mrpt::math::TPoint2D& place, double heat) {
  if (!measurements_.empty() && (place - measurements_.back().place).norm() < spacing_m_) return;
  if (measurements_.size() == kKept) measurements_.erase(measurements_.begin());
  measurements_.push_back({place, heat});
}

std::optional<mrpt::math::TPoint2D> HeatSlope::gradient() const {
  if (measurements_.size() < 3) return std::nullopt;
  mrpt::math::TPoint2D mean(0, 0);
  double mean_heat = 0;
  const auto n = static_cast<double>(measurements_.size());
  for (const auto& [place, heat] : measurements_) {
    mean += place * (1 / n);
    mean_heat += heat / n;
  }
  double xx = 0, xy = 0, yy = 0, xh = 0, yh = 0;
  for (const auto& [place, heat] : measurements_) {
    const double x = place.x - mean.x, y = place.y - mean.y, h = heat - mean_heat;
    xx += x * x;
    xy += x * y;
    yy += y * y;
    xh += x * h;
    yh += y * h;
  }
  // The determinant is the product of the squared extents along the principal axes, the trace their sum.
  const double determinant = xx * yy - xy * xy;
  if (determinant <= kSpread * (xx + yy) * (xx + yy)) return std::nullopt;
  return mrpt::math::TPoint2D((yy * xh - xy * yh) / determinant, (xx * yh - xy * xh) / determinant);
}

void HeatGradient::step(Robot& robot) {
  const auto& pose = tracker_.update(robot);
  if (!slope_) slope_.emplace(kSpacing_radii * robot.info().radius_m);
  const double heat = robot.heat().value_or(0);
  slope_->measure({pose.x, pose.y}, heat);
  if (heat < warm_ || robot.stepNumber() < walk_until_) {
    walk_.step(robot);
  } else {
    ascend(robot);
  }
}

void HeatGradient::ascend(Robot& robot) {
  if (robot.stalled() || clearanceInLane(robot, 1) < stoppingGap(robot)) {
    walk_until_ = robot.stepNumber() + robot.stepsIn(kDetour_s);
    walk_.step(robot);
    return;
  }
  const MotionLimits& limits = robot.info().type->limits;
  const double speed_mps = kSpeed * limits.speed_max_mps;
  const auto gradient = slope_->gradient();
  if (!gradient || gradient->norm() == 0) {
    robot.drive(speed_mps, std::min(limits.turn_max_radps, speed_mps / (kArc_radii * robot.info().radius_m)));
    return;
  }
  const double off_rad =
      mrpt::math::wrapToPi(portable::atan2(gradient->y, gradient->x) - tracker_.startFromRobot().phi);
  const double ahead = std::max(0.0, portable::cos(off_rad));
  robot.drive(speed_mps * ahead, std::clamp(kTurnRate_per_s * off_rad, -limits.turn_max_radps, limits.turn_max_radps));
}

}  // namespace robosim
