#pragma once
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "robots/fleet.h"
#include "world/world.h"

namespace robosim {

/// @name Descriptions for the page of a run, as run.js documents them
/// Lengths in metres to 0.1 mm, angles in radians, colours as "#rrggbb".
///@{
/// Bounds, maps, and what else is constant during a run.
nlohmann::ordered_json pageWorld(const World& world);
/// The objects, in their order.
nlohmann::ordered_json pageObjects(const std::vector<WorldObject>& objects);
/// A robot, with the index of its type in `types`; appends the type if it is not there.
nlohmann::ordered_json pageRobot(const FleetRobot& robot, nlohmann::ordered_json& types);
///@}

/// The text of a JSON value; invalid UTF-8 is replaced.
std::string textOf(const nlohmann::ordered_json& json);

}  // namespace robosim
