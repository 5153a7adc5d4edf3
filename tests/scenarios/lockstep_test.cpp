// A run is identical for any distribution of robots and geometry over processes.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/scenarios/robot_processes.h"
#include "tests/scenarios/served_world.h"

namespace robosim {
namespace {

constexpr int kSteps = 60;
const char* const kWorld = "worlds/open_100.xml";

ServedWorld::Options robotsElsewhere(const std::string& world, std::uint64_t last_step) {
  ServedWorld::Options options;
  options.world = world;
  options.robots_elsewhere = true;
  options.last_step = last_step;
  return options;
}

std::string digestInOneProcess(const std::string& world, int steps, const std::string& controller) {
  const Ended run =
      runProgram("run " + world + " --json --controller " + controller + " --time " + std::to_string(steps / 10));
  return nlohmann::json::parse(run.out)["digest"];
}

/// Distributes the world's robots over processes, round-robin.
std::vector<std::unique_ptr<StartedProgram>> startAllRobots(const ServedWorld& world, std::size_t processes,
                                                            const std::string& controller) {
  std::vector<std::vector<std::string>> hands(processes);
  const auto& names = world.robotNames();
  for (std::size_t i = 0; i < names.size(); ++i) hands[i % processes].push_back(names[i]);
  std::vector<std::unique_ptr<StartedProgram>> started;
  for (const auto& hand : hands) started.push_back(startRobots(hand, world.connectOptions().address, controller));
  return started;
}

std::string digestWith(std::size_t processes, std::size_t workers) {
  ServedWorld world(robotsElsewhere(kWorld, kSteps));
  std::vector<std::unique_ptr<StartedProgram>> helpers;
  for (std::size_t i = 0; i < workers; ++i) helpers.push_back(startWorker(world.connectOptions().address));
  if (workers > 0) world.waitForLog(": ready", workers);
  const auto robots = startAllRobots(world, processes, "wander");
  EXPECT_EQ(world.wait(), Served::to_its_end);
  for (const auto& process : robots) EXPECT_EQ(process->wait().exit_code, 0) << process->error();
  for (const auto& process : helpers) EXPECT_EQ(process->wait().exit_code, 0) << process->error();
  EXPECT_EQ(countOf("disconnected", world.log()) + countOf("has left", world.log()), 0u) << world.log();
  return world.digest();
}

TEST(Lockstep, IsIdenticalForAnyNumberOfProcessesAndGeometryWorkers) {
  const std::string one_process = digestInOneProcess(kWorld, kSteps, "wander");
  for (const std::size_t processes : {1, 3, 10}) {
    for (const std::size_t workers : {0, 1, 2}) {
      EXPECT_EQ(digestWith(processes, workers), one_process) << processes << " processes, " << workers << " workers";
    }
  }
}

TEST(Lockstep, IsIdenticalWithForkedRobotProcesses) {
  const auto in_one = nlohmann::json::parse(runProgram("run worlds/small_maze.xml --json --controller wander").out);
  ServedWorld world(robotsElsewhere("worlds/small_maze.xml", in_one["steps"]));
  const auto robots = startRobots({"Pioneer1", "Scout1", "--separate-processes"}, world.connectOptions().address);
  EXPECT_EQ(world.wait(), Served::to_its_end);
  EXPECT_EQ(robots->wait().exit_code, 0) << robots->error();
  EXPECT_EQ(world.digest(), in_one["digest"].get<std::string>());
  EXPECT_NE(world.log().find("robot Pioneer1 ("), std::string::npos) << world.log();
  EXPECT_NE(world.log().find("robot Scout1 ("), std::string::npos) << world.log();
}

TEST(Lockstep, ReportsFailedChildProcesses) {
  ServedWorld world(robotsElsewhere("worlds/small_maze.xml", 5));
  const auto robots = startRobots({"Unknown1", "Unknown2", "--separate-processes"}, world.connectOptions().address);
  EXPECT_NE(robots->wait().exit_code, 0);
  EXPECT_NE(robots->error().find("2 of 2 processes failed"), std::string::npos) << robots->error();
}

TEST(Lockstep, DeliversGoldMessagesBetweenProcesses) {
  const Ended run = runProgram("run worlds/small_maze.xml --json");
  const auto in_one = nlohmann::json::parse(run.out);
  ASSERT_GE(in_one["messages"].get<int>(), 1);
  ServedWorld world(robotsElsewhere("worlds/small_maze.xml", in_one["steps"]));
  const auto robots = startAllRobots(world, 2, "gold_finder");
  EXPECT_EQ(world.wait(), Served::to_its_end);
  EXPECT_EQ(world.digest(), in_one["digest"].get<std::string>());
  EXPECT_EQ(world.state().messages_delivered, in_one["messages"]);
}

TEST(Lockstep, ReportsAwaitedRobotsAndTakesNoStepBefore) {
  ServedWorld world(robotsElsewhere("worlds/small_maze.xml", 5));
  world.waitForLog("waiting for Pioneer1, Scout1\n");
  const auto pioneer = startRobots({"Pioneer1"}, world.connectOptions().address);
  world.waitForLog("waiting for Scout1\n");
  EXPECT_EQ(world.state().time.step, 0u);
  const auto scout = startRobots({"Scout1"}, world.connectOptions().address);
  EXPECT_EQ(world.wait(), Served::to_its_end);
  EXPECT_EQ(countOf("all robots are connected", world.log()), 1u);
}

}  // namespace
}  // namespace robosim
