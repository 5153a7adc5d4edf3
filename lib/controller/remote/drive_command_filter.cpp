#include "remote/drive_command_filter.h"

#include <algorithm>
#include <cmath>

#include <mrpt/core/format.h>

namespace robosim {
namespace {

constexpr int kTenths = 10;
/// Fraction of the robot's maximum turn rate.
constexpr double kTurnPart = 0.5;

std::string secondsText(DriveCommandFilter::Clock::duration time) {
  return mrpt::format("%.3g s", std::chrono::duration<double>(time).count());
}

}  // namespace

void DriveCommandFilter::begin(Clock::time_point now) {
  stand("");
  laser_pan_rad_ = 0;
  last_message_ = now;
}

void DriveCommandFilter::obey(const RemoteOrder& order, Clock::time_point when) {
  noteMessage(when);
  const auto accelerate = [&](int tenths) {
    // A speed that DRIVE has set may lie between two tenths.
    const int now_tenths = static_cast<int>(std::lround(kTenths * speed_mps_ / limits_.speed_max_mps));
    speed_mps_ = limits_.speed_max_mps * std::clamp(now_tenths + tenths, -kTenths, kTenths) / kTenths;
  };
  const auto turn = [&](double part) {
    turn_radps_ = part * limits_.turn_max_radps;
    turn_ends_ = when + kTurnTime;
    turn_is_short_ = true;
  };
  switch (order.type) {
    case RemoteType::accelerate:
      accelerate(1);
      break;
    case RemoteType::decelerate:
      accelerate(-1);
      break;
    case RemoteType::turn_left:
      turn(kTurnPart);
      break;
    case RemoteType::turn_right:
      turn(-kTurnPart);
      break;
    case RemoteType::drive:
      if (order.speed_mps) speed_mps_ = std::clamp(*order.speed_mps, -limits_.speed_max_mps, limits_.speed_max_mps);
      if (order.turn_radps)
        turn_radps_ = std::clamp(*order.turn_radps, -limits_.turn_max_radps, limits_.turn_max_radps);
      if (order.turn_radps) turn_is_short_ = false;
      if (order.laser_pan_rad) laser_pan_rad_ = *order.laser_pan_rad;
      break;
    case RemoteType::stop:
      if (speed_mps_ != 0 || turn_radps_ != 0 || order.why.empty()) stop(order.why);
      return;
    default:
      return;  // does not steer
  }
  why_stopped_.clear();
}

void DriveCommandFilter::release(const std::string& why) {
  if (speed_mps_ != 0 || turn_radps_ != 0) stop(why);
}

void DriveCommandFilter::stop(const std::string& why) {
  stand(why);
  is_stopping_ = true;
}

void DriveCommandFilter::stand(const std::string& why) {
  speed_mps_ = turn_radps_ = 0;
  turn_is_short_ = false;
  why_stopped_ = why;
  if (!why.empty()) ++stops_;
}

Command DriveCommandFilter::command(Clock::time_point now, const std::string& driver) {
  if (turn_is_short_ && now >= turn_ends_) {
    turn_radps_ = 0;
    turn_is_short_ = false;
  }
  if (now - last_message_ > dead_man_) release("no message from " + driver + " for " + secondsText(dead_man_));
  return {.speed_mps = speed_mps_,
          .turn_radps = turn_radps_,
          .laser_pan_rad = laser_pan_rad_,
          .by_driver = true,
          .emergency_stop = is_stopping_};
}

}  // namespace robosim
