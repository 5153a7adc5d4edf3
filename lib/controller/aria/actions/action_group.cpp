#include "aria/actions/action_group.h"

#include "aria/actions/action_bumpers.h"
#include "aria/actions/action_decelerating_limiter.h"
#include "aria/actions/action_joydrive.h"
#include "aria/actions/action_keydrive.h"
#include "aria/stock_actions.h"

namespace robosim {
namespace {

void addTeleop(ActionGroup& group, JoyHandler* joystick) {
  // Without a button the joystick leaves the motion to the keys.
  group.addAction(std::make_unique<ActionJoydrive>(joystick, "joydrive", 400, 15, false), 50);
  group.addAction(std::make_unique<ActionKeydrive>(), 45);
}

}  // namespace

void ActionGroup::addAction(Action& action, int priority) {
  robot_.addAction(action, priority);
  actions_.push_back(&action);
}

bool ActionGroup::remAction(Action& action) {
  if (std::erase(actions_, &action) == 0) return false;
  robot_.remAction(action);
  std::erase_if(owned_, [&](const auto& owned) { return owned.get() == &action; });
  return true;
}

void ActionGroup::removeActions() {
  for (Action* action : actions_) robot_.remAction(*action);
  actions_.clear();
  owned_.clear();
}

void ActionGroup::activate() {
  for (Action* action : actions_) action->activate();
}

void ActionGroup::activateExclusive() {
  robot_.deactivateActions();
  activate();
}

void ActionGroup::deactivate() {
  for (Action* action : actions_) action->deactivate();
}

ActionGroupInput::ActionGroupInput(PioneerRobot& robot)
    : ActionGroup(robot), input_(&addAction(std::make_unique<ActionInput>(), 50)) {}

ActionGroupStop::ActionGroupStop(PioneerRobot& robot) : ActionGroup(robot) {
  addAction(std::make_unique<ActionStop>(), 50);
}

ActionGroupTeleop::ActionGroupTeleop(PioneerRobot& robot, JoyHandler* joystick) : ActionGroup(robot) {
  addAction(std::make_unique<ActionDeceleratingLimiter>("limit forwards", true), 100);
  addAction(std::make_unique<ActionDeceleratingLimiter>("limit backwards", false), 95);
  addTeleop(*this, joystick);
}

ActionGroupUnguardedTeleop::ActionGroupUnguardedTeleop(PioneerRobot& robot, JoyHandler* joystick) : ActionGroup(robot) {
  addTeleop(*this, joystick);
}

ActionGroupWander::ActionGroupWander(PioneerRobot& robot, double forward_vel, double avoid_front_dist, double avoid_vel,
                                     double avoid_turn_amt)
    : ActionGroup(robot) {
  addAction(std::make_unique<ActionBumpers>(), 100);
  addAction(std::make_unique<ActionStallRecover>(), 90);
  addAction(std::make_unique<ActionAvoidFront>("avoid front", avoid_front_dist, avoid_vel, avoid_turn_amt), 80);
  addAction(std::make_unique<ActionConstantVelocity>("constant velocity", forward_vel), 10);
}

}  // namespace robosim
