#include <algorithm>
#include <utility>

#include "environment/environment_impl.h"

namespace robosim {

std::shared_ptr<const Model> Environment::Impl::modelWith(const RobotAdditions& additions) const {
  const auto same =
      std::find_if(models.begin(), models.end(), [&](const auto& one) { return one->additions == additions; });
  return same == models.end() ? withAdditions(*model, additions) : *same;
}

void Environment::Impl::useModel(std::shared_ptr<const Model> other) {
  model = std::move(other);
  if (std::find(models.begin(), models.end(), model) == models.end()) models.push_back(model);
  const std::size_t count = fleet().robots.size();
  bodies = PlacedBodies(*model, objects());
  move_authorisation = MoveAuthorisation(ofRobots(fleet(), moverOf), model->world.bounds);
  object_mover = moverOfObjects();
  message_router.setRobots(fleet().robots);
  robot_groups = RobotGroups(fleet(), model->period_s, is_sensed);
  limits = RepeatedValues(ofRobots(fleet(), limitsOf));
  drives = drivesOf(fleet());
  known = KnownRobots(count);
  counted = everyRobot();
  paths.assign(count, Path());
  former_motion = formerMotionOf(fleet());
  antenna_z_m = RepeatedValues(ofRobots(fleet(), antennaOf));
  noteGrippers();
  if (!is_shared) share = {everyRobot(), everyRobot()};
  if (images_of) images = images_of(*model);
}

void Environment::Impl::replaceState(State other) {
  former_arrays.push_back({std::move(state.world_from_robot), std::move(state.commands), std::move(state.stalled)});
  state = std::move(other);
}

void Environment::Impl::addRobot(std::shared_ptr<const Model> larger) {
  State with_robot = state;
  addLastRobot(with_robot, *larger);
  replaceState(std::move(with_robot));
  useModel(std::move(larger));
  state.all_halted_step.reset();
  ++pose_changes;
  noteState();
  placeBodies();
}

void Environment::Impl::restoreWithOtherRobots(const State& saved) {
  auto other = modelWith(saved.additions);
  requireSameShape(saved, initialState(*other));
  replaceState(saved);
  useModel(std::move(other));
  noteState();
  placeBodies();
}

}  // namespace robosim
