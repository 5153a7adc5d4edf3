// A controller with parameters is the same in every subcommand that runs controllers.
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/testing/test_folder.h"
#include "base/xml_element.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/served_world.h"

namespace robosim {
namespace {

using nlohmann::json;

const char* const kChosen = "wall_follower distance_radii=3";

class ChosenControllers : public TestFolder {
 protected:
  /// The small maze, in which Pioneer1 has this <controller> element.
  std::string worldWith(const std::string& controller) const {
    std::string text = readXmlText(ROBOSIM_SOURCE_DIR "/worlds/small_maze.xml");
    const std::string first = "<controller>gold_finder</controller>";
    text.replace(text.find(first), first.size(), controller);
    std::ofstream(in("maze.xml")) << text;
    return quoted(in("maze.xml"));
  }
};

json summaryOf(const std::string& arguments) {
  const Ended run = runProgram("run " + arguments + " --json --time 20");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return json::parse(run.out);
}

TEST_F(ChosenControllers, AreTheSameInTheWorldAndOnTheCommandLine) {
  const std::string world = worldWith(R"(<controller name="wall_follower" distance_radii="3"/>)");
  const std::string in_world = summaryOf(world)["digest"];
  EXPECT_NE(in_world, summaryOf(worldWith("<controller>wall_follower</controller>"))["digest"]);
  const std::string all = std::string("worlds/small_maze.xml --controller \"") + kChosen + "\"";
  EXPECT_EQ(summaryOf(all)["digest"], summaryOf(all)["digest"]);
  EXPECT_NE(summaryOf(all)["digest"], summaryOf("worlds/small_maze.xml --controller wall_follower")["digest"]);
}

TEST_F(ChosenControllers, AreTheSameOverTheNetworkAndInAReplay) {
  const std::string log = quoted(in("run.rawlog"));
  const json summary = summaryOf(std::string("worlds/small_maze.xml --controller \"") + kChosen + "\" --record " + log);
  ServedWorld::Options options;
  options.robots_elsewhere = true;
  options.last_step = summary["steps"];
  ServedWorld world(options);
  const auto robots = startRobots({"Pioneer1", "Scout1"}, world.connectOptions().address, kChosen);
  EXPECT_EQ(world.wait(), Served::to_its_end);
  EXPECT_EQ(robots->wait().exit_code, 0) << robots->error();
  EXPECT_EQ(world.digest(), summary["digest"].get<std::string>());
  const Ended check = runProgram("replay " + log + " --check worlds/small_maze.xml");
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  const Ended same = runProgram("replay " + log + " --controller recorded");
  EXPECT_NE(same.out.find("commands are the recorded ones"), std::string::npos) << same.out << same.err;
  EXPECT_EQ(same.out.find("differ"), std::string::npos) << same.out;
  const Ended other = runProgram("replay " + log + " --controller wall_follower");
  EXPECT_NE(other.out.find("commands differ"), std::string::npos) << other.out << other.err;
}

TEST_F(ChosenControllers, AreCheckedWithFileAndLine) {
  const std::string world = worldWith(R"(<controller name="wall_follower" distance="3"/>)");
  for (const std::string command : {"check ", "run ", "bench gold "}) {
    const Ended ended = runProgram(command + world);
    EXPECT_EQ(ended.exit_code, 1) << command;
    const std::string text = ended.out + ended.err;  // check prints errors as its result
    EXPECT_NE(
        text.find("maze.xml:104: robot 'Pioneer1': controller 'wall_follower': there is no parameter 'distance'; it "
                  "has: distance_radii"),
        std::string::npos)
        << text;
  }
  for (const std::string command : {"run worlds/small_maze.xml", "bench gold worlds/small_maze.xml", "robot Pioneer1",
                                    "replay rawlogs/driven.rawlog"}) {
    const Ended ended = runProgram(command + " --controller \"wall_follower distance_radii=100\"");
    EXPECT_EQ(ended.exit_code, 1) << command;
    EXPECT_NE(ended.err.find("parameter distance_radii=100 is out of bounds; use 0.5 to 10 robot radii"),
              std::string::npos)
        << command << ": " << ended.err;
  }
}

TEST_F(ChosenControllers, AreListedWithDefaultBoundsUnitAndHelp) {
  const Ended text = runProgram("controllers wall_follower");
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_NE(text.out.find(
                "distance_radii  default 1.5  0.5 to 10 robot radii  distance between the robot's edge and the wall"),
            std::string::npos)
      << text.out;
  const json all = json::parse(runProgram("controllers --json").out);
  ASSERT_EQ(all.size(), 17u);
  EXPECT_EQ(all[2]["parameters"][0]["default"], 1.5);
  EXPECT_EQ(all[0]["needs"], json({"odometry", "heat"}));
  const Ended unknown = runProgram("controllers wall_folower");
  EXPECT_EQ(unknown.exit_code, 1);
  EXPECT_EQ(unknown.err,
            "robosim controllers: there is no controller 'wall_folower'; known are: gold_finder, wander, "
            "wall_follower, still, "
            "random_walk, levy_walk, wall_search, heat_gradient, stigmergy, oracle, coordinated_frontiers, market, "
            "forage, soccer, push_together, hold_door, pass_door\n");
}

TEST_F(ChosenControllers, SensorsAreListedWithTheirSettings) {
  const json all = json::parse(runProgram("sensors --json").out);
  EXPECT_EQ(all.size(), 21u);
  for (const auto& sensor : all) EXPECT_FALSE(sensor["settings"].empty()) << sensor["name"];
  const Ended laser = runProgram("sensors laser");
  EXPECT_NE(laser.out.find("range_max_m"), std::string::npos) << laser.out;
  EXPECT_NE(laser.out.find("noise/std_m"), std::string::npos) << laser.out;
}

}  // namespace
}  // namespace robosim
