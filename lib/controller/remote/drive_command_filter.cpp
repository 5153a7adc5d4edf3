#include "remote/drive_command_filter.h"

#include <algorithm>
#include <cmath>

#include <mrpt/core/format.h>

#include "base/seconds.h"

namespace robosim {
namespace {

constexpr int kTenths = 10;

std::string secondsText(Seconds time) { return mrpt::format("%.3g s", time.count()); }

}  // namespace

void DriveCommandFilter::begin(Clock::time_point now) {
  stand("");
  laser_pan_rad_ = 0;
  last_message_ = now;
}

void DriveCommandFilter::obey(const v1::ControlRequest& order, Clock::time_point when) {
  noteMessage(when);
  const OrderRow& row = rowOf(typeOf(order));
  switch (row.rule) {
    case OrderRule::steer:
      steer(row, when);
      break;
    case OrderRule::set:
      set(order.drive());
      break;
    case OrderRule::stop:
      if (isDriving() || whyOf(order).empty()) stop(std::string(whyOf(order)));
      return;
    default:
      return;  // does not steer
  }
  why_stopped_.clear();
}

void DriveCommandFilter::steer(const OrderRow& row, Clock::time_point when) {
  if (row.speed_tenths != 0) {
    // A speed that DRIVE has set may lie between two tenths.
    const int now_tenths = static_cast<int>(std::lround(kTenths * speed_mps_ / limits_.speed_max_mps));
    speed_mps_ = limits_.speed_max_mps * std::clamp(now_tenths + row.speed_tenths, -kTenths, kTenths) / kTenths;
  }
  if (row.turn_part != 0) {
    turn_radps_ = row.turn_part * limits_.turn_max_radps;
    turn_ends_ = when + kTurnTime;
    turn_is_short_ = true;
  }
}

void DriveCommandFilter::set(const v1::ControlRequest::Drive& drive) {
  if (drive.has_speed_mps()) speed_mps_ = std::clamp(drive.speed_mps(), -limits_.speed_max_mps, limits_.speed_max_mps);
  if (drive.has_turn_radps()) {
    turn_radps_ = std::clamp(drive.turn_radps(), -limits_.turn_max_radps, limits_.turn_max_radps);
    turn_is_short_ = false;
  }
  if (drive.has_lateral_mps()) {
    lateral_mps_ = std::clamp(drive.lateral_mps(), -limits_.lateral_max_mps, limits_.lateral_max_mps);
  }
  if (drive.has_laser_pan_rad()) laser_pan_rad_ = drive.laser_pan_rad();
}

void DriveCommandFilter::release(const std::string& why) {
  if (isDriving()) stop(why);
}

void DriveCommandFilter::stop(const std::string& why) {
  stand(why);
  is_stopping_ = true;
}

void DriveCommandFilter::stand(const std::string& why) {
  speed_mps_ = turn_radps_ = lateral_mps_ = 0;
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
          .emergency_stop = is_stopping_,
          .lateral_mps = lateral_mps_};
}

}  // namespace robosim
