#include "aria/actions/action_ratio_input.h"

#include <algorithm>
#include <cmath>

#include "aria/pioneer_robot.h"

namespace robosim {
namespace {

constexpr double kKeyTurn_percent = 50;
constexpr const char* kKeydriveName = "keydrive";
constexpr const char* kJoydriveName = "joydrive";

}  // namespace

void ActionRatioInput::setRatios(double trans, double rot, double throttle) {
  trans_ = std::clamp(trans, -100.0, 100.0);
  rot_ = std::clamp(rot, -100.0, 100.0);
  throttle_ = std::clamp(throttle, 0.0, 100.0);
}

void ActionRatioInput::setParameters(double full_throttle_forwards, double full_throttle_backwards,
                                     double rot_at_full_forwards, double rot_at_full_backwards, double rot_at_stopped) {
  speeds_ = {full_throttle_forwards, full_throttle_backwards, rot_at_full_forwards, rot_at_full_backwards,
             rot_at_stopped};
}

bool ActionRatioInput::addFireCallback(const std::string& name, int priority, Functor functor) {
  return on_fire_.add(name, priority, std::move(functor));
}

int ActionRatioInput::addActivateCallback(Functor functor, ListPos::Pos position) {
  return on_activate_.add(std::move(functor), position);
}

int ActionRatioInput::addDeactivateCallback(Functor functor, ListPos::Pos position) {
  return on_deactivate_.add(std::move(functor), position);
}

void ActionRatioInput::activate() {
  if (isActive()) return;
  Action::activate();
  setRatios(0, 0, 0);
  on_activate_.call();
}

void ActionRatioInput::deactivate() {
  if (!isActive()) return;
  Action::deactivate();
  on_deactivate_.call();
}

ActionDesired ActionRatioInput::fire(PioneerRobot& robot, const ActionDesired&) {
  on_fire_.run();
  const double full = robot.getTransVelMax(), turn = robot.getRotVelMax();
  const Speeds speeds = speeds_.value_or(Speeds{full, full, turn, turn, turn});
  const double part = trans_ / 100 * throttle_ / 100;
  const double vel = part * (part > 0 ? speeds.forwards : speeds.backwards);
  const double rot_max =
      std::lerp(speeds.rot_at_stopped, part > 0 ? speeds.rot_at_forwards : speeds.rot_at_backwards, std::abs(part));
  ActionDesired desired;
  desired.setVel(vel);
  desired.setRotVel(rot_ / 100 * throttle_ / 100 * rot_max);
  return desired;
}

RatioInputKeydrive::RatioInputKeydrive(ActionRatioInput& input, int priority, double vel_increment)
    : input_(input), increment_(vel_increment) {
  input.addFireCallback(kKeydriveName, priority, [this] { fire(); });
  on_deactivate_ = input.addDeactivateCallback([this] {
    keys_.release();
    stop();
  });
}

RatioInputKeydrive::~RatioInputKeydrive() {
  input_.remFireCallback(kKeydriveName);
  input_.remDeactivateCallback(on_deactivate_);
}

void RatioInputKeydrive::fire() {
  const PioneerRobot* robot = input_.getRobot();
  const auto accelerate = [this](double change) { trans_ = std::clamp(trans_ + change, -100.0, 100.0); };
  keys_.claim(robot ? robot->getKeyHandler() : nullptr, {{KeyHandler::UP, [=, this] { accelerate(increment_); }},
                                                         {KeyHandler::DOWN, [=, this] { accelerate(-increment_); }},
                                                         {KeyHandler::LEFT, [this] { rot_ = kKeyTurn_percent; }},
                                                         {KeyHandler::RIGHT, [this] { rot_ = -kKeyTurn_percent; }},
                                                         {KeyHandler::SPACE, [this] { stop(); }}});
  input_.setRatios(trans_, rot_, 100);
  rot_ = 0;
}

RatioInputJoydrive::RatioInputJoydrive(ActionRatioInput& input, JoyHandler& joystick, int priority,
                                       bool stop_if_no_button_pressed)
    : input_(input), joystick_(joystick), stops_(stop_if_no_button_pressed) {
  input.addFireCallback(kJoydriveName, priority, [this] { fire(); });
}

RatioInputJoydrive::~RatioInputJoydrive() { input_.remFireCallback(kJoydriveName); }

void RatioInputJoydrive::fire() {
  const auto state = joystick_.read();
  if (!state) return;
  if (isReleased(*state)) {
    input_.setRatios(100 * state->y, -100 * state->x, 100);
  } else if (stops_) {
    input_.setRatios(0, 0, 0);
  }
}

}  // namespace robosim
