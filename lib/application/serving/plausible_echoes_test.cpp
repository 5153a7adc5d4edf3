#include "wire/plausible_echoes.h"

#include <gtest/gtest.h>

#include "environment/environment.h"
#include "robots/fleet.h"
#include "run/outputs/standard_parts.h"

namespace robosim {
namespace {

TEST(PlausibleEchoesOfWorlds, IncludeAllMeasurementsInTheShippedWorlds) {
  useStandardParts();  // a world has a map
  for (const char* file : {"small_maze.xml", "open_100.xml", "courtyard_and_office.xml", "maze_20x20.xml"}) {
    LoadedWorld world = loadWorld(std::string(ROBOSIM_SOURCE_DIR "/worlds/") + file, {});
    Environment environment(std::move(world.world), std::move(world.fleet), EnvironmentOptions{});
    for (std::size_t i = 0; i < environment.robotCount(); ++i) {
      environment.setCommand(i, {0.4, 0.3, 0.5f, Activity::active});
    }
    for (int step = 0; step < 20; ++step) environment.step();
    for (std::size_t i = 0; i < environment.robotCount(); ++i) {
      const auto& sensors = environment.fleet().robots[i].model->sensors;
      for (std::size_t slot = 0; slot < sensors.size(); ++slot) {
        if (sensors[slot]->sensesInHostProcess()) continue;
        EXPECT_EQ(faultOf(std::get<Echoes>(environment.state().readings[i].measurements[slot]), sensors[slot]->info()),
                  "")
            << file;
      }
    }
  }
}

}  // namespace
}  // namespace robosim
