// Worlds with <scatter> and <include>: every program sees the places that the seed of the run determines.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rendering/plan.h"
#include "robots/fleet.h"
#include "robots/world_source.h"
#include "tests/scenarios/program.h"
#include "tests/scenarios/serving.h"

namespace robosim {
namespace {

constexpr const char* kSwarm = "worlds/scatter_swarm.xml";

std::string digestOf(const std::string& arguments) {
  const Ended run = runProgram(arguments + " --json");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return nlohmann::json::parse(run.out).at("digest");
}

TEST(ScatteredWorld, DiffersBySeedAndIsRepeatable) {
  const std::string run = std::string("run ") + kSwarm + " --time 5 --seed ";
  EXPECT_EQ(digestOf(run + "7"), digestOf(run + "7"));
  EXPECT_NE(digestOf(run + "7"), digestOf(run + "8"));
}

TEST(ScatteredWorld, IsRepeatedFromItsRecording) {
  const auto folder = emptyFolder();
  const auto rawlog = (folder / "run.rawlog").string();
  ASSERT_EQ(runProgram(std::string("run ") + kSwarm + " --time 5 --seed 7 --record '" + rawlog + "'").exit_code, 0);
  const Ended check = runProgram(std::string("replay --check ") + kSwarm + " '" + rawlog + "'");
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  const Ended controller = runProgram("replay --controller wander --robot Scout20 '" + rawlog + "'");
  EXPECT_EQ(controller.exit_code, 0) << controller.out << controller.err;
}

TEST(ScatteredWorld, IsLoadedWithTheSeedOfTheLoad) {
  Serving serving({"--paused", "--json", "--time", "5"});
  const Ended load = runProgram("control " + serving.address() + " load " + kSwarm + " --seed 7");
  ASSERT_EQ(load.exit_code, 0) << load.err;
  ASSERT_EQ(runProgram("control " + serving.address() + " start").exit_code, 0);
  const Ended ended = serving.program().wait();
  EXPECT_NE(ended.out.find(digestOf(std::string("run ") + kSwarm + " --time 5 --seed 7")), std::string::npos)
      << ended.out << ended.err;
}

TEST(ScatteredWorld, IsExportedWithTheSeedOfARun) {
  const auto folder = emptyFolder();
  const auto plan = [&](const std::string& seed) {
    const auto file = folder / "plan.svg";
    const Ended ended = runProgram(std::string("export ") + kSwarm + " " + quoted(file) + seed);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return textOf(file);
  };
  const auto planOfRun = [](std::uint64_t seed) {
    const LoadedWorld loaded = loadWorld(std::string(ROBOSIM_SOURCE_DIR "/") + kSwarm, {}, seed);
    return planPicture(requirePictureFormat("plan.svg"), loaded.world, loaded.fleet, startOf(loaded.fleet));
  };
  EXPECT_EQ(plan(" --seed 7"), planOfRun(7));
  EXPECT_EQ(plan(""), planOfRun(1));
  EXPECT_NE(planOfRun(7), planOfRun(1));
}

TEST(ScatteredWorld, RefusesToOverwriteAnIncludedFile) {
  const auto folder = emptyFolder();
  ASSERT_EQ(runCommand("cp -r worlds/scatter_swarm.xml worlds/parts '" + folder.string() + "'").exit_code, 0);
  const Ended run = runProgram("run '" + (folder / "scatter_swarm.xml").string() + "' --record '" +
                               (folder / "parts/hall_30x20.xml").string() + "'");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("which this command reads"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace robosim
