#pragma once
#include <memory>
#include <vector>

#include "aria/action.h"
#include "aria/actions/action_input.h"
#include "aria/actions/joy_handler.h"

namespace robosim {

/// Actions that are activated and deactivated together, as ARIA's ArActionGroup. On destruction it removes its actions
/// from the robot.
class ActionGroup {
 public:
  /// @param robot must outlive this.
  explicit ActionGroup(PioneerRobot& robot) : robot_(robot) {}
  virtual ~ActionGroup() { removeActions(); }
  ActionGroup(const ActionGroup&) = delete;
  ActionGroup& operator=(const ActionGroup&) = delete;

  /// Adds an action to the robot and to this group. @param action must outlive its entry
  void addAction(Action& action, int priority);
  /// The same for an action that the group owns. @return the action
  template <typename A>
  A& addAction(std::unique_ptr<A> action, int priority) {
    A& added = *action;
    addAction(added, priority);
    owned_.push_back(std::move(action));
    return added;
  }
  bool remAction(Action& action);  ///< @return false when it is not in the group
  void removeActions();            ///< removes all from the robot, and destroys those that it owns
  void activate();
  void activateExclusive();  ///< deactivates all other actions of the robot
  void deactivate();
  const std::vector<Action*>& getActionList() const { return actions_; }

 private:
  PioneerRobot& robot_;
  std::vector<Action*> actions_;
  std::vector<std::unique_ptr<Action>> owned_;
};

// ARIA's groups, each made to be active alone (activateExclusive()). All are active at first.

/// Motion that the program sets.
class ActionGroupInput : public ActionGroup {
 public:
  explicit ActionGroupInput(PioneerRobot& robot);
  ActionInput& getActionInput() { return *input_; }

 private:
  ActionInput* input_;
};

/// Stands still.
class ActionGroupStop : public ActionGroup {
 public:
  explicit ActionGroupStop(PioneerRobot& robot);
};

/// Arrow keys, and a joystick if there is one, with speed limits before obstacles.
class ActionGroupTeleop : public ActionGroup {
 public:
  /// @param joystick must outlive this; null for none
  explicit ActionGroupTeleop(PioneerRobot& robot, JoyHandler* joystick = nullptr);
};

/// The same without the limits.
class ActionGroupUnguardedTeleop : public ActionGroup {
 public:
  explicit ActionGroupUnguardedTeleop(PioneerRobot& robot, JoyHandler* joystick = nullptr);
};

/// Wanders: recovers from bumps and stalls, avoids obstacles ahead, and otherwise drives ahead.
class ActionGroupWander : public ActionGroup {
 public:
  explicit ActionGroupWander(PioneerRobot& robot, double forward_vel = 400, double avoid_front_dist = 450,
                             double avoid_vel = 200, double avoid_turn_amt = 15);
};

}  // namespace robosim
