// Worlds of Stage, from the command line.
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/temporary_directory.h"
#include "tests/scenarios/program.h"

namespace robosim {
namespace {

using nlohmann::json;

constexpr const char* kRoom = "tests/data/stage/room.world";

TEST(Stage, WorldsAreDescribedByCheck) {
  const json check = json::parse(runProgram(std::string("check --json ") + kRoom).out);
  EXPECT_EQ(check["ok"], true) << check;
  EXPECT_EQ(check["kind"], "world of Stage");
  EXPECT_EQ(check["robots"], json::parse(R"(["r0", "r1"])"));
  EXPECT_EQ(check["maps"], 1);
  EXPECT_EQ(check["properties"]["ignored"], 1);
  EXPECT_NE(check["notes"].dump().find("room.world:14: friction is ignored, because"), std::string::npos) << check;
}

TEST(Stage, WorldsRunAsTheyDoConverted) {
  const TemporaryDirectory folder;
  const auto out = folder.path() / "room.xml";
  const Ended converted = runProgram(std::string("convert ") + kRoom + " " + quoted(out));
  EXPECT_EQ(converted.exit_code, 0) << converted.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "robots" / "rover.xml"));
  const std::string options = " --controller wander --time 20 --json";
  const json original = json::parse(runProgram(std::string("run ") + kRoom + options).out);
  const json translated = json::parse(runProgram("run " + quoted(out) + options).out);
  EXPECT_EQ(original["digest"], translated["digest"]);
  EXPECT_GT(original["driven_m"], 1);
}

TEST(Stage, WorldsAreNotReplacedByConvertUnlessForced) {
  const TemporaryDirectory folder;
  const auto out = folder.path() / "room.xml";
  const std::string command = std::string("convert ") + kRoom + " " + quoted(out);
  EXPECT_EQ(runProgram(command).exit_code, 0);
  const Ended again = runProgram(command);
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_NE(again.err.find("room.xml: exists already; --force replaces it"), std::string::npos) << again.err;
  EXPECT_EQ(runProgram(command + " --force").exit_code, 0);
}

TEST(Stage, WorldsOfOtherKindsAreRefused) {
  const TemporaryDirectory folder;
  const auto gazebo = folder.path() / "gazebo.world";
  std::ofstream(gazebo) << "<sdf version='1.6'/>";
  const Ended check = runProgram("check " + quoted(gazebo));
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_NE(check.out.find("is an XML file, such as a world of Gazebo"), std::string::npos) << check.out << check.err;
}

}  // namespace
}  // namespace robosim
