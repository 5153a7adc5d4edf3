#include "robots/added_robot.h"

#include <utility>
#include <vector>

#include "base/nearest_name.h"
#include "robots/ray_budget.h"
#include "robots/robot_colors.h"
#include "robots/robot_type_folders_text.h"
#include "robots/robot_type_includes.h"

namespace robosim {
namespace {

/// The model of a type. One that was not known is read from its file and added to the fleet's types.
std::shared_ptr<const RobotModel> modelOfType(const std::string& type, Fleet& fleet) {
  if (fleet.known_types) {
    const auto& models = fleet.known_types->models;
    if (const auto read = models.find(type); read != models.end()) return read->second;
  }
  KnownTypes known = fleet.known_types ? *fleet.known_types : KnownTypes();
  // The types of a world that was read completely are those that it uses; others lie in the same folders.
  RobotTypes all = known.types;
  for (const auto& one : robotTypesIn(robotTypeFolders(known.world_file))) all.insert(one);
  const auto found = all.find(type);
  if (found == all.end()) {
    std::vector<std::string> names;
    for (const auto& one : all) names.push_back(one.first);
    throw ConfigError("there is no robot type '" + type + "'" + didYouMean(type, names) + "; " +
                      (names.empty() ? "none is known" : "known are: " + listed(names)) + "; " +
                      robotTypeFoldersText());
  }
  ErrorList errors;
  auto model = std::make_shared<const RobotModel>(
      modelOf(readRobotType(found->second), found->second.file.string(), {}, errors));
  errors.throwIfAny();
  known.types.insert(*found);
  known.models[type] = model;
  fleet.known_types = std::make_shared<const KnownTypes>(std::move(known));
  return model;
}

}  // namespace

Fleet withRobot(Fleet fleet, const AddRobot& added) {
  RobotPlacement placement;
  placement.name = added.name;
  placement.world_from_robot = added.world_from_robot;
  placement.neighbour = added.neighbour;
  placement.controller = added.controller;
  fleet.robots.push_back(placedRobot(placement, modelOfType(added.model, fleet)));
  setColorOfLast(fleet, added.color);
  RayBudget budget;
  for (const FleetRobot& one : fleet.robots) {
    if (const std::string excess = budget.add(one.model); !excess.empty()) {
      throw ConfigError("with it " + excess);
    }
  }
  return fleet;
}

}  // namespace robosim
