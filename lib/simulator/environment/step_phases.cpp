#include "environment/step_phases.h"

#include "environment/environment_impl.h"

namespace robosim {

void StepPhases::begin() { impl_->begin(); }
void StepPhases::clip(RobotRange range) {
  impl_->move_authorisation.clip(impl_->scene, impl_->workers, range, impl_->paths);
}
void StepPhases::judge(RobotRange range) {
  impl_->move_authorisation.judge(impl_->scene, impl_->workers, range, impl_->paths);
}
void StepPhases::move() { impl_->move(); }
void StepPhases::sense(RobotRange range) { impl_->sense(range, Environment::Impl::SensorGroup::anywhere); }
void StepPhases::finish() { impl_->finish(); }

PhaseResults StepPhases::results() {
  auto& digest = impl_->state.digest;
  return {impl_->paths, impl_->move_authorisation.stays(), impl_->state.readings, digest ? &*digest : nullptr};
}
StepOrders StepPhases::orders() {
  State& state = impl_->state;
  return {state.commands, state.outboxes, impl_->may_send, state.win_requests, state.activity};
}

void StepPhases::senseFully(RobotRange range) { impl_->sense(range, Environment::Impl::SensorGroup::all); }
void StepPhases::conclude() {
  impl_->deliverMessages();
  impl_->conclude();
}
void StepPhases::keepReadings(RobotRange range) { impl_->keepReadings(range); }
void StepPhases::digest(RobotRange range) { impl_->share.digested = range; }

void StepPhases::limitTo(std::span<const std::uint32_t> known, RobotRange counted) {
  impl_->known.limitTo(known);
  impl_->counted = counted;
  impl_->placeBodies();
}

MotionState StepPhases::motion() {
  State& state = impl_->state;
  return {state.world_from_robot, state.speed_mps, state.turn_radps,    state.drives, state.last_motion,
          state.driven_m,         state.stalled,   state.laser_pan_rad, state.stalls};
}

}  // namespace robosim
