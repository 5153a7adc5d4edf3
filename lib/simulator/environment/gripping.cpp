#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/portable_pose.h"
#include "environment/environment_impl.h"

namespace robosim {

void Environment::Impl::noteHeld() {
  held.clear();
  if (state.closed_grippers.empty()) return;
  const std::vector<std::uint32_t> moving = movingObjects(objects());
  for (const ClosedGripper& gripper : state.closed_grippers) {
    if (gripper.object.empty()) continue;
    const auto found = std::find_if(moving.begin(), moving.end(),
                                    [&](std::uint32_t object) { return objects()[object].name == gripper.object; });
    if (found == moving.end()) {
      throw std::invalid_argument("a state in which a robot holds '" + gripper.object +
                                  "', which its world does not have; use a state of the same world");
    }
    const auto object = static_cast<std::uint32_t>(found - moving.begin());
    const MovableBody& body = bodies.movable()[object];
    held.push_back({gripper.robot, object, gripper.robot_from_object, body.covering_radius_m, body.heights});
  }
}

void Environment::Impl::openGrippers() {
  const auto opens = [&](const ClosedGripper& gripper) { return !state.commands[gripper.robot].grip; };
  if (std::erase_if(state.closed_grippers, opens) > 0) noteHeld();
}

void Environment::Impl::closeGrippers() {
  for (const auto robot : robots_with_gripper) {
    if (!state.commands[robot].grip || state.isAbsent(robot)) continue;
    auto& closed = state.closed_grippers;
    const auto place = std::lower_bound(closed.begin(), closed.end(), robot,
                                        [](const ClosedGripper& one, std::uint32_t of) { return one.robot < of; });
    if (place != closed.end() && place->robot == robot) continue;
    ClosedGripper gripper{.robot = robot, .object = {}};
    if (const auto object = objectBetweenPaddles(robot)) {
      gripper.object = objects()[movingObjects(objects())[object->object]].name;
      gripper.robot_from_object = object->robot_from_object;
      static_cast<ObjectSpeed&>(motions[object->object]) = {};
      state.object_speeds[object->object] = {};
    }
    closed.insert(place, std::move(gripper));
    noteHeld();
  }
}

std::optional<HeldObject> Environment::Impl::objectBetweenPaddles(std::uint32_t robot) const {
  const GripperOptions& gripper = *fleet().robots[robot].model->gripper;
  const auto& pose = state.world_from_robot[robot];
  std::vector<std::uint32_t> near;
  scene.findMoving({pose.x, pose.y}, gripper.front_m + gripper.reach_m, scene.movingCount(), near);
  std::sort(near.begin(), near.end());
  std::optional<HeldObject> nearest;
  for (const auto moving : near) {
    if (moving < fleet().robots.size()) continue;
    const auto object = static_cast<std::uint32_t>(moving - fleet().robots.size());
    const MovableBody& body = bodies.movable()[object];
    const bool is_taken = heldIndexOf(held, object).has_value();
    const bool is_too_heavy = body.friction_n > fleet().robots[robot].model->push_max_n;
    if (body.isDriven() || is_taken || is_too_heavy) continue;
    if (gripper.z_m < body.heights.z_min_m || gripper.z_m > body.heights.z_max_m) continue;
    const auto& placed = motions[object].world_from_object;
    auto robot_from_object = portable::relative(pose, placed);
    robot_from_object.phi = placed.phi - pose.phi;  // without wrapping, which rounds
    if (!gripper.isBetweenPaddles({robot_from_object.x, robot_from_object.y}, body.covering_radius_m)) continue;
    if (nearest && nearest->robot_from_object.x <= robot_from_object.x) continue;
    nearest = HeldObject{robot, object, robot_from_object, body.covering_radius_m, body.heights};
  }
  return nearest;
}

bool Environment::Impl::carry() {
  bool has_moved = false;
  for (const HeldObject& object : held) {
    const Path& path = paths[object.robot];
    if (path.clippedLength() == 0 && path.clippedTurn() == 0) continue;
    motions[object.object].world_from_object = object.poseAt(path.endPose());
    has_moved = true;
  }
  return has_moved;
}

void Environment::Impl::letGoOf(const std::string& object) {
  for (ClosedGripper& gripper : state.closed_grippers) {
    if (gripper.object == object) gripper.object.clear();
  }
}

void Environment::Impl::letGo(std::size_t robot) {
  if (std::erase_if(state.closed_grippers, [&](const auto& gripper) { return gripper.robot == robot; }) > 0) noteHeld();
}

}  // namespace robosim
