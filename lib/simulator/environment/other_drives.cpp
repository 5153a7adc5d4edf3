// Motion of robots whose drive is not differential: apart from the steps of all others, which thus stay as short.
#include "base/portable_math.h"
#include "environment/environment_impl.h"

namespace robosim {

DriveMotion Environment::Impl::motionOf(std::size_t robot) const {
  return {{state.speed_mps[robot], state.turn_radps[robot]}, state.drives[robot]};
}

void Environment::Impl::setMotion(std::size_t robot, const DriveMotion& motion) {
  state.speed_mps[robot] = motion.speeds.speed_mps;
  state.turn_radps[robot] = motion.speeds.turn_radps;
  state.drives[robot] = motion.state;
}

void Environment::Impl::driveOtherwise(std::size_t robot) {
  const Drive& drive = drives[robot];
  const Command& command = state.commands[robot];
  setMotion(robot, reachableMotion(drive, motionOf(robot), command, limits[robot], model->period_s));
  paths[robot] = pathOf(drive, state.world_from_robot[robot], motionOf(robot), model->period_s);
}

void Environment::Impl::noteOtherMotion(std::size_t robot) {
  Motion& motion = state.last_motion[robot];
  if (paths[robot].direction_rad != 0) {
    const auto [sin, cos] = portable::sincos(paths[robot].direction_rad);
    motion.lateral_m = motion.length_m * sin;
    motion.length_m *= cos;
  }
  if (state.stalled[robot]) setMotion(robot, stopped(drives[robot], motionOf(robot)));
}

}  // namespace robosim
