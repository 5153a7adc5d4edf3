// Worlds that consist of maps, in one process and in several, from the command line.
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "client/viewer.h"
#include "tests/scenarios/panel.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/served_world.h"

namespace robosim {
namespace {

using nlohmann::json;

TEST(Maps, AllShippedMapsLoad) {
  int maps = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ROBOSIM_SOURCE_DIR "/maps")) {
    if (!isMapFile(entry.path()) || recognizeMapFormat(entry.path()) == MapFormat::picture) continue;
    const json check = json::parse(runProgram("check --json '" + entry.path().string() + "'").out);
    EXPECT_EQ(check["ok"], true) << check;
    EXPECT_EQ(check["maps"], 1) << check;
    ++maps;
  }
  EXPECT_EQ(maps, 3);
}

TEST(Maps, AreDescribedByCheck) {
  const Ended check = runProgram("check worlds/courtyard_and_office.xml");
  EXPECT_EQ(check.exit_code, 0);
  for (const char* part : {"200 × 150 cells of 0.1 m, 2,941 of them occupied, in 68 boxes",
                           "463 × 320 cells of 0.02 m, 607 of them occupied, in 182 boxes; 10 walls"}) {
    EXPECT_NE(check.out.find(part), std::string::npos) << part << "\n" << check.out;
  }
}

TEST(Maps, ContainGoldThatRobotsFind) {
  const json run = json::parse(runProgram("run worlds/lab_map.xml --json").out);
  EXPECT_EQ(run["gold_found"], true);
  EXPECT_EQ(run["ended_by"], "all_halted");
}

TEST(Maps, CanBeRunWithoutAWorldFile) {
  const json run = json::parse(runProgram("run maps/office.map --controller wander --time 30 --json").out);
  EXPECT_EQ(run["robots"], 1) << "at the home that the map has";
  EXPECT_GT(run["driven_m"], 5);
  const Ended without_robots = runProgram("run maps/lab.yaml");
  EXPECT_EQ(without_robots.exit_code, 1);
  EXPECT_NE(without_robots.err.find("maps/lab.yaml: has no robots; add at least one"), std::string::npos)
      << without_robots.err;
}

TEST(Maps, AreSentToRobotsWorkersAndViewers) {
  const std::string file = "worlds/courtyard_and_office.xml";  // an image and an ActivMedia map
  const json in_one = json::parse(runProgram("run " + file + " --json --controller wander --time 20").out);
  ServedWorld::Options options;
  options.world = file;
  options.robots_elsewhere = true;
  options.last_step = 200;
  ServedWorld world(options);
  const auto worker = startWorker(world.connectOptions().address);
  world.waitForLog(": ready");
  Viewer viewer(world.connectOptions());
  EXPECT_EQ(startSolids(viewer.run().world.world).size(), 68u + 182u + 10u);
  std::vector<std::unique_ptr<StartedProgram>> robots;
  for (const auto& name : world.robotNames()) robots.push_back(startRobots({name}, world.connectOptions().address));
  EXPECT_EQ(world.wait(), Served::to_its_end);
  EXPECT_EQ(countOf("disconnected", world.log()) + countOf("has left", world.log()), 0u) << world.log();
  EXPECT_EQ(world.digest(), in_one["digest"].get<std::string>());
}

TEST(Maps, AreSentWithAWorldByAControlPanel) {
  ServedWorld::Options options;
  options.server.is_paused = true;
  ServedWorld world(options);
  Panel panel(world);
  EXPECT_EQ(panel.load("worlds/lab_map.xml").world(), "lab_map");
  panel.step(100);
  const json in_one = json::parse(runProgram("run worlds/lab_map.xml --json --controller wander --time 10").out);
  world.end();
  EXPECT_EQ(world.digest(), in_one["digest"].get<std::string>());
}

TEST(Maps, AreNotReadFromTheServersDiskForAReceivedWorld) {
  ServedWorld::Options options;
  options.server.is_paused = true;
  ServedWorld world(options);
  v1::WorldSource source;
  source.set_file("a.xml");
  source.set_text("<world><surface><map file='" ROBOSIM_SOURCE_DIR "/maps/lab.yaml'/></surface></world>");
  const grpc::Status how = howLoadEnds(world.connectOptions(), source.SerializeAsString(), 10'000);
  EXPECT_EQ(how.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_NE(how.error_message().find("/maps/lab.yaml: did not come with the world"), std::string::npos)
      << how.error_message();
}

TEST(Maps, MissingMapsStopTheServerAtStart) {
  const auto file = emptyFolder() / "a.xml";
  std::ofstream(file) << "<world><surface>\n<map file='none.yaml'/>\n</surface></world>";
  for (const char* how : {"run", "serve", "check"}) {
    const Ended ended = runProgram(std::string(how) + " '" + file.string() + "'");
    EXPECT_EQ(ended.exit_code, 1) << how;
    EXPECT_NE((ended.err + ended.out).find("a.xml:2: <map file=\"none.yaml\">: "), std::string::npos)
        << how << ended.err << ended.out;
  }
}

}  // namespace
}  // namespace robosim
