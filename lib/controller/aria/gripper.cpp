#include "aria/gripper.h"

namespace robosim {

bool Gripper::gripOpen() {
  robot_.release();
  return robot_.hasGripper();
}

bool Gripper::gripClose() {
  robot_.grip();
  return robot_.hasGripper();
}

int Gripper::getGripState() const {
  if (!robot_.hasGripper()) return 0;
  return robot_.gripper().is_closed ? 2 : 1;
}

int Gripper::getPaddleState() const { return robot_.gripper().is_closed ? 3 : 0; }

int Gripper::getBreakBeamState() const {
  const GripperState state = robot_.gripper();
  return (state.inner_beam ? 1 : 0) + (state.outer_beam ? 2 : 0);
}

std::string Gripper::stateText() const {
  if (!robot_.hasGripper()) return "There is no gripper.";
  static constexpr const char* kBeams[] = {"none", "inner", "outer", "both"};
  return std::string("lift at its end, paddles ") + (getGripState() == 2 ? "closed" : "open") +
         ", light barriers interrupted: " + kBeams[getBreakBeamState()];
}

}  // namespace robosim
