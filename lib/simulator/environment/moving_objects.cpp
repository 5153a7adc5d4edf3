#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "environment/environment_impl.h"

namespace robosim {

void Environment::Impl::noteMotions() {
  motions.clear();
  const std::vector<std::uint32_t> moving = movingObjects(objects());
  if (moving.size() != state.object_speeds.size()) {
    throw std::invalid_argument(
        "a state whose moving objects are not those of its world; use a state of the same world");
  }
  for (const auto i : moving) {
    const WorldObject& object = objects()[i];
    ObjectMotion& motion =
        motions.emplace_back(ObjectMotion{state.object_speeds[motions.size()], object.body.world_from_body});
    if (object.door) {
      motion.open_to = object.door->open_to;
      motion.door_share = object.door->share;
    }
    if (object.walker) motion.walk = object.walker->walk;
  }
  noteHeld();
}

void Environment::Impl::useObjects() {
  bodies.setObjects(objects());
  object_mover = moverOfObjects();
}

ObjectMover Environment::Impl::moverOfObjects() const {
  std::vector<Belt> belts;
  for (const auto& object : objects()) {
    if (object.conveyor) belts.push_back(Belt::from(object));
  }
  std::vector<PushingDisc> discs;  // unused, and not stored, where nothing moves
  if (!bodies.movable().empty()) discs = ofRobots(fleet(), pushingDiscOf);
  return {bodies.movable(), std::move(belts), std::move(discs), model->world.bounds};
}

void Environment::Impl::moveObjects() {
  const bool have_moved = object_mover.move(scene, workers, model->period_s, state.seed, held, paths, motions);
  if (!carry() && !have_moved) return;
  for (std::size_t i = 0; i < paths.size(); ++i) state.stalled[i] = paths[i].end_fraction < 1 ? 1 : 0;
  const std::vector<std::uint32_t> moving = movingObjects(objects());
  bool have_changed = false;
  for (std::size_t k = 0; k < motions.size(); ++k) {
    state.object_speeds[k] = motions[k];
    const WorldObject& object = objects()[moving[k]];
    have_changed |= object.body.world_from_body != motions[k].world_from_object ||
                    (object.walker && object.walker->walk != motions[k].walk);
  }
  if (!have_changed) return;
  std::vector<WorldObject> moved = objects();
  for (std::size_t k = 0; k < motions.size(); ++k) {
    WorldObject& object = moved[moving[k]];
    object.body.world_from_body = motions[k].world_from_object;
    if (object.door) object.door->share = motions[k].door_share;
    if (object.walker) object.walker->walk = motions[k].walk;
  }
  state.objects = ChangedObjects(std::move(moved));
}

void Environment::Impl::setObjects(std::vector<WorldObject> objects, const std::string& changed) {
  state.object_speeds = speedsOf(objects, changed);
  letGoOf(changed);
  state.objects = ChangedObjects(std::move(objects));
  ++pose_changes;
  useObjects();
  noteMotions();
  placeBodies();
}

std::vector<ObjectSpeed> Environment::Impl::speedsOf(const std::vector<WorldObject>& objects_then,
                                                     const std::string& at_rest) const {
  std::map<std::string, ObjectSpeed> now;
  const auto& objects_now = objects();
  std::size_t k = 0;
  for (const auto object : movingObjects(objects_now)) now[objects_now[object].name] = state.object_speeds[k++];
  now.erase(at_rest);
  std::vector<ObjectSpeed> speeds;
  for (const auto object : movingObjects(objects_then)) {
    const auto found = now.find(objects_then[object].name);
    speeds.push_back(found == now.end() ? ObjectSpeed{} : found->second);
  }
  return speeds;
}

}  // namespace robosim
