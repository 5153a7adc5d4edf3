// Shared libraries that each subcommand loads: what a subcommand does not use must not delay its start.
#include <regex>

#include <gtest/gtest.h>

#include "robosim/subcommands.h"
#include "tests/scenarios/program.h"

namespace robosim {
namespace {

/// Names of all shared libraries that an executable in the program's folder loads, one per line.
std::string librariesOf(const std::string& executable) {
  const auto folder = std::filesystem::path(ROBOSIM_PROGRAM).parent_path();
  const Ended ldd = runCommand("ldd '" + (folder / executable).string() + "'");
  EXPECT_EQ(ldd.exit_code, 0) << ldd.err;
  EXPECT_NE(ldd.out.find("libstdc++"), std::string::npos) << ldd.out;
  return ldd.out;
}

bool loads(const std::string& libraries, const std::string& pattern) {
  return std::regex_search(libraries, std::regex(pattern));
}

TEST(Libraries, OfHelpAndVersionAreThoseOfTheLanguage) {
  EXPECT_FALSE(loads(librariesOf("robosim"), "mrpt|opencv|grpc|protobuf|glfw|nanogui|OpenGL|boost|ssl"));
}

TEST(Libraries, OfSubcommandsWithoutNetworkIncludeNeitherGrpcNorWindows) {
  for (const char* subcommand : {"run", "check", "replay", "export", "bench"}) {
    EXPECT_FALSE(loads(librariesOf(subcommandNamed(subcommand)->part), "grpc|protobuf|glfw|nanogui|mrpt-gui"))
        << subcommand;
  }
}

TEST(Libraries, AreReportedWhenASubcommandIsNotInstalled) {
  const auto folder = emptyFolder();
  std::filesystem::copy_file(ROBOSIM_PROGRAM, folder / "robosim");
  const Ended ended = runCommand("'" + (folder / "robosim").string() + "' run worlds/small_maze.xml");
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.err, "robosim: cannot start " + (folder / "robosim-run").string() +
                           ": No such file or directory; install RoboSim again\n");
}

}  // namespace
}  // namespace robosim
