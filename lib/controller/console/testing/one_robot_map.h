#pragma once
#include <memory>

#include "console/map_view.h"

namespace robosim {

/// A map with one robot, Ann, whose true x is 12.25 m.
inline std::shared_ptr<const MapView> oneRobotMap() {
  auto world = std::make_shared<MapWorld>();
  world->name = "maze";
  world->robots = {{"Ann", 0.2, {}}};
  auto view = std::make_shared<MapView>();
  view->world = world;
  view->world_from_robot = {{12.25, 3, 0}};
  view->activity = {Activity::active};
  return view;
}

}  // namespace robosim
