#pragma once
#include <string>

#include "control/robot.h"

namespace robosim {

/// The gripper of a Pioneer with the names of ARIA's ArGripper. Like the robots of this simulator, it has no lift: the
/// functions of the lift have no effect, and it is always at its end. The paddles close and open within a step. In
/// ARIA it is made of the ArRobot, here of the Robot that a PioneerRobot is made of.
class Gripper {
 public:
  enum Type { QUERYTYPE, GENIO, USERIO, GRIPPAC, NOGRIPPER };

  /// @param robot must outlive this
  explicit Gripper(Robot& robot) : robot_(robot) {}

  /// @name Commands
  /// @return whether the robot has a gripper
  ///@{
  bool gripOpen();
  bool gripClose();
  bool gripStop() { return robot_.hasGripper(); }  ///< without effect
  bool liftUp() { return robot_.hasGripper(); }    ///< without effect
  bool liftDown() { return robot_.hasGripper(); }  ///< without effect
  bool liftStop() { return robot_.hasGripper(); }  ///< without effect
  bool gripperStore() { return gripClose(); }
  bool gripperDeploy() { return gripOpen(); }
  bool gripperHalt() { return robot_.hasGripper(); }  ///< without effect
  ///@}

  /// @name State in this step
  ///@{
  Type getType() const { return robot_.hasGripper() ? GENIO : NOGRIPPER; }
  int getGripState() const;       ///< 1: open, 2: closed; 0 without a gripper
  int getPaddleState() const;     ///< 3: both paddles press on an object or each other; 0: neither
  int getBreakBeamState() const;  ///< 0: no light barrier is interrupted, 1: the inner one, 2: the outer one, 3: both
  bool isGripMoving() const { return false; }
  bool isLiftMoving() const { return false; }
  bool isLiftMaxed() const { return robot_.hasGripper(); }
  std::string stateText() const;  ///< what ArGripper::logState() logs
                                  ///@}

 private:
  Robot& robot_;
};

}  // namespace robosim
