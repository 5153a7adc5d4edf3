#include "maze/pushing/box_pusher.h"

#include <algorithm>
#include <cmath>

#include "maze/message_numbers.h"
#include "maze/path_driver.h"

namespace robosim {
namespace {

constexpr double kBoxGap_m = 0.03;       // gap at which the robot is at the box
constexpr double kLead_m = 0.01;         // by which a robot may be ahead of the others
constexpr double kCourseGain_per_s = 2;  // turn rate per heading error
constexpr double kLane_per_m = 1;        // heading error per distance from its lane

}  // namespace

void BoxPusher::step(Robot& robot) {
  tracker_.update(robot);
  for (const RobotMessage& message : robot.inbox()) {
    if (message.text == "READY") pushed_m_.emplace(message.from, 0);
    if (const auto pushed = numbersOf(message.text, "PUSHED", 1)) {
      pushed_m_[message.from] = static_cast<double>((*pushed)[0]) / 1000;
    }
  }
  if (is_at_box_) {
    push(robot);
  } else {
    approach(robot);
  }
}

void BoxPusher::approach(Robot& robot) {
  const double gap_m = clearanceInLane(robot, 1);
  if (gap_m > kBoxGap_m && !robot.stalled()) {
    const double braking_mps =
        std::sqrt(2 * robot.info().type->limits.decel_mps2 * std::max(0.0, gap_m - kBoxGap_m / 2));
    robot.drive(std::min({options_.speed_mps, braking_mps, std::max(0.02, gap_m)}),
                -kCourseGain_per_s * tracker_.startFromRobot().phi);
    return;
  }
  is_at_box_ = true;
  box_x_m_ = tracker_.startFromRobot().x;
  robot.stop();
  robot.broadcast("READY");
}

void BoxPusher::push(Robot& robot) {
  if (static_cast<int>(pushed_m_.size()) + 1 < options_.team) {
    robot.stop();
    robot.broadcast("READY");
    return;
  }
  const auto& start_from_robot = tracker_.startFromRobot();
  const double pushed_m = start_from_robot.x - box_x_m_;
  robot.broadcast(messageText("PUSHED", {static_cast<std::int64_t>(std::floor(1000 * pushed_m))}));
  if (pushed_m >= options_.distance_m) {
    robot.halt();
    return;
  }
  const bool is_ahead = std::any_of(pushed_m_.begin(), pushed_m_.end(),
                                    [&](const auto& other) { return pushed_m > other.second + kLead_m; });
  const double heading_rad = std::clamp(-kLane_per_m * start_from_robot.y, -0.3, 0.3);
  robot.drive(is_ahead ? 0 : options_.speed_mps, kCourseGain_per_s * (heading_rad - start_from_robot.phi));
}

}  // namespace robosim
