#include "world/changed_objects.h"

#include <algorithm>

namespace robosim {
namespace {

/// Makes one change to a list of objects.
struct ObjectChange {
  std::vector<WorldObject>& objects;

  auto named(const std::string& name) const {
    return std::find_if(objects.begin(), objects.end(), [&](const WorldObject& object) { return object.name == name; });
  }

  void operator()(const PlaceBody& place) const {
    const auto object = named(place.name);
    if (object == objects.end()) return;
    auto& pose = object->body.world_from_body;
    pose = {place.x_m, place.y_m, place.heading_rad.value_or(pose.phi)};
  }
  void operator()(const AddObject& add) const { objects.push_back(add.object); }
  void operator()(const AddRobot&) const {}
  void operator()(const RemoveBody& remove) const {
    std::erase_if(objects, [&](const WorldObject& object) { return object.name == remove.name; });
  }
  void operator()(const ChangeObject& change) const {
    const auto object = named(change.name);
    if (object == objects.end()) return;
    Body& body = object->body;
    if (change.heat_celsius) body.heat_celsius = *change.heat_celsius;
    if (change.color) body.color = *change.color;
    if (change.reflectivity) body.reflectivity = *change.reflectivity;
    for (std::size_t i = 0; i < kBodyProperties.size(); ++i) {
      if (change.properties[i]) body.*kBodyProperties[i].value = *change.properties[i];
    }
    if (change.height_m) {
      body.center_z_m += (*change.height_m - body.height_m) / 2;
      body.height_m = *change.height_m;
    }
  }
  void operator()(const ChangeActivity&) const {}
  void operator()(const ChangeRadio&) const {}
  void operator()(const OpenDoor& open) const {
    const auto object = named(open.name);
    if (object != objects.end() && object->door) object->door->open_to = open.share;
  }
  void operator()(const EndRun&) const {}
};

}  // namespace

std::vector<std::uint32_t> movingObjects(const std::vector<WorldObject>& objects) {
  std::vector<std::uint32_t> moving;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (!objects[i].isStationary()) moving.push_back(static_cast<std::uint32_t>(i));
  }
  return moving;
}

std::optional<std::vector<std::uint32_t>> movedBetween(const std::vector<WorldObject>& before,
                                                       const std::vector<WorldObject>& after) {
  if (before.size() != after.size()) return std::nullopt;
  std::vector<std::uint32_t> moved;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (before[i] == after[i]) continue;
    WorldObject placed = before[i];
    placed.body.world_from_body = after[i].body.world_from_body;
    if (placed.door && after[i].door) placed.door->share = after[i].door->share;
    if (placed.walker && after[i].walker) placed.walker->walk = after[i].walker->walk;
    if (placed != after[i]) return std::nullopt;
    moved.push_back(static_cast<std::uint32_t>(i));
  }
  return moved;
}

std::vector<WorldObject> withChange(std::vector<WorldObject> objects, const Change& change) {
  std::visit(ObjectChange{objects}, change);
  return objects;
}

}  // namespace robosim
