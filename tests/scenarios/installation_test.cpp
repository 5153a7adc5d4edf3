// The program installed by `cmake --install`, away from the source tree, which it must not refer to.
#include <fstream>
#include <iterator>
#include <memory>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/temporary_directory.h"
#include "tests/scenarios/program.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

/// Installed into one folder, which is then renamed: an installation can be moved.
class Installation : public testing::Test {
 protected:
  void SetUp() override {
    if (folder_) return;
    folder_ = std::make_unique<TemporaryDirectory>();
    const Ended ended = runCommand(ROBOSIM_CMAKE " --install '" ROBOSIM_BUILD_DIR "' --component robosim --prefix " +
                                   quoted(*folder_ / "first"));
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    fs::rename(*folder_ / "first", prefix());
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static fs::path prefix() { return *folder_ / "prefix"; }
  static Ended run(const std::string& arguments) {
    return runCommand("cd / && " + quoted(prefix() / "bin" / "robosim") + " " + arguments);
  }
  /// A world with one robot of a type, in a folder without robot types.
  static fs::path worldWith(const std::string& type) {
    const fs::path file = *folder_ / (type + ".xml");
    std::ofstream(file)
        << R"(<world><surface><size><xmin>-5</xmin><xmax>5</xmax><ymin>-5</ymin><ymax>5</ymax></size>
<object><shape><robot><model>)" +
               type + R"(</model><name>R</name><x>0</x><y>0</y><direction>0</direction></robot></shape></object>
</surface></world>)";
    return file;
  }

  static std::unique_ptr<TemporaryDirectory> folder_;
};
std::unique_ptr<TemporaryDirectory> Installation::folder_;

TEST_F(Installation, RunsShippedWorldsAndMapsLikeTheBuild) {
  for (const std::string world : {"worlds/small_maze.xml", "worlds/lab_map.xml"}) {
    const std::string options = " --json --time 20 --controller wander";
    const Ended built = runProgram("run " + world + options);
    const Ended installed = run("run " + quoted(prefix() / "share" / "robosim" / world) + options);
    ASSERT_EQ(installed.exit_code, 0) << installed.err;
    EXPECT_EQ(nlohmann::json::parse(installed.out)["digest"], nlohmann::json::parse(built.out)["digest"]) << world;
  }
}

TEST_F(Installation, FindsShippedFilesByNameFromAnyFolder) {
  for (const std::string& arguments :
       {std::string("run small_maze --time 1"), std::string("run worlds/small_maze.xml --time 1"),
        std::string("check lab_map"), std::string("replay rawlogs/opho2_1.rawlog --check opho2_1"),
        "view lab.yaml --offscreen " + quoted(*folder_ / "lab.png"),
        "export small_maze " + quoted(*folder_ / "maze.svg")}) {
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.exit_code, 0) << arguments << ": " << ended.err;
  }
  const Ended none = run("run no_such_maze");
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_NE(none.err.find("no_such_maze: no such file; check the path; searched are also " +
                          (prefix() / "share" / "robosim" / "worlds").string()),
            std::string::npos)
      << none.err;
}

TEST_F(Installation, FindsItsRobotTypesForWorldsElsewhere) {
  const Ended ended = run("run --time 1 " + quoted(worldWith("scout")));
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
}

TEST_F(Installation, NamesTheFoldersSearchedForAnUnknownRobotType) {
  const Ended ended = run("check " + quoted(worldWith("tortoise")));
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.out.find((prefix() / "share" / "robosim" / "worlds" / "robots").string()), std::string::npos)
      << ended.out;
}

TEST_F(Installation, ReportsAMissingLibraryBeforeTheRunWithItsPackage) {
  // As where only the package of the engine is installed
  const fs::path library = prefix() / "lib" / ("librobosim-program.so." ROBOSIM_SOVERSION);
  fs::rename(library, *folder_ / "hidden");
  const std::string error =
      "cannot load the library for maps, recordings, pictures and replays (librobosim-program.so." ROBOSIM_SOVERSION
      ": cannot open shared object file: No such file or directory); install the package "
      "librobosim-extra" ROBOSIM_SOVERSION ", or RoboSim again";
  EXPECT_EQ(run("run small_maze --time 1").exit_code, 0);
  for (const std::string& arguments : {"run small_maze --time 1 --record " + quoted(*folder_ / "missing.rawlog"),
                                       std::string("check lab_map"), std::string("export small_maze --help")}) {
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.exit_code, 1) << arguments;
    EXPECT_NE((ended.out + ended.err).find(error), std::string::npos) << arguments << ": " << ended.out << ended.err;
  }
  fs::rename(*folder_ / "hidden", library);
}

TEST_F(Installation, StartsEachOfItsExecutables) {
  EXPECT_EQ(run("--version").exit_code, 0);
  for (const char* subcommand : {"run", "serve", "view"}) {
    const Ended ended = run(std::string(subcommand) + " --help");
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_NE(ended.out.find(std::string("robosim ") + subcommand), std::string::npos) << ended.out;
  }
}

TEST_F(Installation, ReplaysAShippedRecording) {
  const Ended ended = run("replay " + quoted(prefix() / "share" / "robosim" / "rawlogs" / "opho2_1.rawlog"));
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
}

// Instrumented programs contain the paths of their source files.
#ifndef __SANITIZE_ADDRESS__
TEST_F(Installation, ContainsNoPathOfTheSourceTree) {
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(prefix())) {
    if (!entry.is_regular_file()) continue;
    ++files;
    std::ifstream in(entry.path(), std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    EXPECT_EQ(bytes.find(ROBOSIM_SOURCE_DIR "/"), std::string::npos) << entry.path();
  }
  EXPECT_GT(files, 50);
}
#endif

TEST_F(Installation, AWheelHasItsLibrariesBesideTheExtensionAndFindsThemThere) {
  const fs::path wheel = *folder_ / "wheel";
  const Ended installed = runCommand(
      ROBOSIM_CMAKE " --install '" ROBOSIM_BUILD_DIR "' --component robosim-wheel --prefix " + quoted(wheel));
  ASSERT_EQ(installed.exit_code, 0) << installed.err;
  const Ended paths = runCommand("find " + quoted(wheel) + " -name '*.so*' -exec readelf --dynamic {} +");
  EXPECT_EQ(countOf("Library runpath: [", paths.out), 7u) << "the extension and six libraries\n" << paths.out;
  EXPECT_EQ(countOf("Library runpath: [$ORIGIN:$ORIGIN/robosim]", paths.out), 6u) << "beside, and its codecs\n"
                                                                                  << paths.out;
  EXPECT_EQ(countOf(":$ORIGIN]", paths.out), 1u) << "the extension also names the folder of an installation\n"
                                                 << paths.out;
  EXPECT_EQ(paths.out.find(ROBOSIM_BUILD_DIR), std::string::npos) << paths.out;
}

}  // namespace
}  // namespace robosim
