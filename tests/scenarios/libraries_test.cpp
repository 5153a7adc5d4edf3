// Shared libraries that each subcommand loads: what a subcommand does not use must not delay its start.
#include <regex>
#include <set>
#include <sstream>
#include <string>

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

/// The shared library that programs and plugins use.
const std::filesystem::path kLibrary = ROBOSIM_BUILD_DIR "/apps/robosim/librobosim.so";

/// The functions and variables that a file defines, except inline ones.
std::set<std::string> definitionsIn(const std::filesystem::path& file, const std::string& options) {
  const Ended nm = runCommand("nm --defined-only " + options + " " + quoted(file));
  EXPECT_EQ(nm.exit_code, 0) << nm.err;
  std::set<std::string> names;
  const std::regex definition("[0-9a-f]+ [TDBR] (_ZN.*)");
  std::istringstream lines(nm.out);
  std::smatch found;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, found, definition)) names.insert(found[1]);
  }
  return names;
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

TEST(Libraries, OfSubcommandsWithoutNetworkAreTheseOnly) {
  // MRPT's pictures, which its observations refer to, need OpenCV; OpenGL and fonts are used when a picture is drawn.
  const std::set<std::string> allowed{"OpenGL",
                                      "asan",
                                      "c",
                                      "cairo",
                                      "crypto",
                                      "expat",
                                      "fmt",
                                      "fontconfig",
                                      "freetype",
                                      "gcc_s",
                                      "isal",
                                      "m",
                                      "mrpt-core",
                                      "mrpt-img",
                                      "mrpt-io",
                                      "mrpt-maps",
                                      "mrpt-math",
                                      "mrpt-obs",
                                      "mrpt-opengl",
                                      "mrpt-poses",
                                      "mrpt-rtti",
                                      "mrpt-serialization",
                                      "mrpt-system",
                                      "octomap",
                                      "octomath",
                                      "opencv_core",
                                      "opencv_imgcodecs",
                                      "opencv_imgproc",
                                      "spdlog",
                                      "stdc++",
                                      "tbb",
                                      "tinyxml2",
                                      "ubsan",
                                      "xxhash",
                                      "yaml-cpp",
                                      "z"};
  const Ended readelf = runCommand("readelf --dynamic " + quoted(kLibrary));
  ASSERT_EQ(readelf.exit_code, 0) << readelf.err;
  const std::regex needed(R"(\(NEEDED\).*\[lib(.*?)\.so)");
  int count = 0;
  for (std::sregex_iterator found(readelf.out.begin(), readelf.out.end(), needed), end; found != end;
       ++found, ++count) {
    EXPECT_EQ(allowed.count((*found)[1]), 1u) << (*found)[1];
  }
  EXPECT_GT(count, 20);
}

TEST(Libraries, HaveTheOnlyCopyOfWhatProgramsShareWithPlugins) {
  const auto shared = definitionsIn(kLibrary, "--dynamic");
  EXPECT_GT(shared.size(), 500u);
  for (const char* program : {"robosim-run", "robosim-net", "robosim-view"}) {
    for (const auto& name : definitionsIn(std::filesystem::path(ROBOSIM_PROGRAM).parent_path() / program, "")) {
      EXPECT_EQ(shared.count(name), 0u) << program << " has its own copy of " << name;
    }
  }
}

TEST(Libraries, AreReportedWhenASubcommandIsNotInstalled) {
  const auto folder = emptyFolder();
  std::filesystem::create_directory(folder / "bin");
  std::filesystem::copy_file(ROBOSIM_PROGRAM, folder / "bin" / "robosim");
  const Ended ended = runCommand(quoted(folder / "bin" / "robosim") + " run worlds/small_maze.xml");
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_EQ(ended.err, "robosim: cannot start " + (folder / "libexec/robosim/robosim-run").string() +
                           ": No such file or directory; there is no " + (folder / "bin/robosim-run").string() +
                           " either"
                           "; install RoboSim again\n");
}

}  // namespace
}  // namespace robosim
