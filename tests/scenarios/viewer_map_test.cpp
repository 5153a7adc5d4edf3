// The console's map, received from a served world.
#include "client/viewer_map.h"

#include <gtest/gtest.h>

#include "tests/scenarios/panel.h"
#include "tests/scenarios/served_world.h"
#include "tests/scenarios/wait.h"

namespace robosim {
namespace {

/// The map's world once it has this name.
std::shared_ptr<const MapWorld> mapNamed(const std::string& name, ViewerMap& map, Panel& panel) {
  waitUntil("the map shows " + name, [&] {
    panel.status();
    const auto world = map.newest()->world;
    return world && world->name == name;
  });
  return map.newest()->world;
}

TEST(ViewerMap, ShowsObjectsAndRobotsAtTheirSizes) {
  ServedWorld world(paused());
  Panel panel(world);
  ViewerMap map(world.connectOptions());
  EXPECT_EQ(map.newest()->world, nullptr);
  map.setWatched(true);
  const auto shown = mapNamed("small_maze", map, panel);
  const LoadedWorld loaded = loadWorld(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml", {});
  EXPECT_EQ(shown->x_max_m, loaded.world.bounds.x_max);
  ASSERT_EQ(shown->objects.size(), loaded.world.objects.size());
  int long_boxes = 0;
  for (std::size_t i = 0; i < shown->objects.size(); ++i) {
    const Body& body = loaded.world.objects[i].body;
    const MapWorld::Object& object = shown->objects[i];
    EXPECT_EQ(object.world_from_object, body.world_from_body) << i;
    EXPECT_EQ(object.is_hot, body.heat_celsius != 0) << i;
    if (const auto* cube = std::get_if<Cube>(&body.shape)) {
      EXPECT_EQ(object.length_m, cube->length_m) << i;
      EXPECT_EQ(object.width_m, cube->width_m) << i;
      long_boxes += cube->length_m > cube->width_m ? 1 : 0;
    } else {
      EXPECT_EQ(object.radius_m, std::get<Cylinder>(body.shape).radius_m) << i;
    }
  }
  EXPECT_GT(long_boxes, 0);
  ASSERT_EQ(shown->robots.size(), 2u);
  EXPECT_EQ(shown->robots[0].name, "Pioneer1");
  EXPECT_EQ(shown->robots[0].radius_m, loaded.fleet.robots[0].info.radius_m);
}

TEST(ViewerMap, ShowsObjectsAtTheirPresentPlaces) {
  ServedWorld world(paused());
  Panel panel(world);
  ViewerMap map(world.connectOptions());
  map.setWatched(true);
  const auto at_first = mapNamed("small_maze", map, panel);
  const auto added = parseChange(
      "<add><cylinder><name>puck</name><x>0</x><y>0</y><z>5</z><radius>0.1</radius><height>0.2</height></cylinder></"
      "add>",
      "test");
  panel.supervise(added);
  waitUntil("the map has the puck", [&] {
    panel.status();
    return map.newest()->world->objects.size() == at_first->objects.size() + 1;
  });
  const auto with_puck = map.newest();
  EXPECT_EQ(with_puck->world_from_object, nullptr);
  EXPECT_EQ(with_puck->world->objects.back().radius_m, 0.1);
  panel.supervise(PlaceBody{"puck", 0.5, 0.25});
  waitUntil("the puck has moved", [&] {
    panel.status();
    return map.newest()->world_from_object != nullptr;
  });
  const auto moved = map.newest();
  EXPECT_EQ(moved->world, with_puck->world) << "the same map";
  ASSERT_EQ(moved->world_from_object->size(), with_puck->world->objects.size());
  EXPECT_EQ(moved->world_from_object->back(), mrpt::math::TPose2D(0.5, 0.25, 0));
  EXPECT_EQ(moved->world_from_object->front(), with_puck->world->objects.front().world_from_object);
}

TEST(ViewerMap, FollowsALoadedWorldAndDisconnectsWithoutViewers) {
  ServedWorld world(paused());
  Panel panel(world);
  ViewerMap map(world.connectOptions());
  map.setWatched(true);
  mapNamed("small_maze", map, panel);
  EXPECT_EQ(panel.status().viewers(), 1u);
  panel.load("worlds/open_100.xml");
  EXPECT_EQ(mapNamed("open_100", map, panel)->robots.size(), 100u);
  map.setWatched(false);
  waitUntil("the map's connection has ended", [&] { return panel.status().viewers() == 0; });
}

TEST(ViewerMap, ShowsARobotThatIsAdded) {
  ServedWorld world(paused());
  Panel panel(world);
  ViewerMap map(world.connectOptions());
  map.setWatched(true);
  panel.load("worlds/open_100.xml");
  EXPECT_EQ(mapNamed("open_100", map, panel)->robots.size(), 100u);
  const LoadedWorld loaded = loadWorld(ROBOSIM_SOURCE_DIR "/worlds/open_100.xml", {});
  panel.supervise(RemoveBody{loaded.fleet.robots[0].info.name});
  panel.supervise(AddRobot{"New", "scout", loaded.fleet.robots[0].world_from_start, "still"});
  waitUntil("the map has the robot", [&] {
    panel.status();
    const auto view = map.newest();
    EXPECT_EQ(view->problem, "");
    return view->world && view->world->robots.size() == 101;
  });
  EXPECT_EQ(map.newest()->world->robots.back().name, "New");
  EXPECT_EQ(panel.status().robots(), 101u);
}

}  // namespace
}  // namespace robosim
