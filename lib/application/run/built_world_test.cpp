// The example of doc/world_file.md: a world built in C++, run, and written.
#include <gtest/gtest.h>

#include "robots/fleet.h"
#include "robots/scatter.h"
#include "run/local_run.h"
#include "world/world_file.h"

namespace robosim {
namespace {

TEST(BuiltWorld, RunsAsItsWrittenFile) {
  World world;
  world.name = "built";
  world.bounds = {-8, 8, -8, 8};
  Body gold;
  gold.shape = Cylinder{0.2};
  gold.world_from_body = {5, 3, 0};
  gold.center_z_m = 0.25;
  gold.height_m = 0.5;
  gold.heat_celsius = 20;
  world.objects.push_back({.name = "Gold", .body = gold, .line = {}});
  Scatter scouts;
  scouts.count = 10;
  scouts.gap_m = 0.5;
  RobotPlacement scout;
  scout.name = "Scout";
  scout.model = "scout";
  scout.controller = "wander";
  scouts.copied = scout;
  world.scatters.push_back(scouts);

  const RobotTypes types = robotTypesIn({ROBOSIM_SOURCE_DIR "/worlds/robots"});
  ErrorList errors;
  placeScattered(world, "built.xml", types, 7, errors);
  Fleet fleet = buildFleet(world, "built.xml", types, checkController, errors);
  errors.throwIfAny();

  LocalRun run({world, std::move(fleet)}, {});
  LocalRun again(loadWorldToRun(WorldSource{"built.xml", toXml(world), types}, ""), {});
  for (int i = 0; i < 50; ++i) {
    run.step();
    again.step();
    ASSERT_EQ(run.environment().state().world_from_robot, again.environment().state().world_from_robot);
  }
}

}  // namespace
}  // namespace robosim
