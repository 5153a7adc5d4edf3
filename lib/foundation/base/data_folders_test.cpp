#include "base/data_folders.h"

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "base/temporary_directory.h"

namespace robosim {
namespace {

struct DataFolders : testing::Test {
  ~DataFolders() override { unsetenv("ROBOSIM_PATH"); }
};

TEST_F(DataFolders, OfABuildTreeAreThoseOfTheSourceTree) {
  EXPECT_TRUE(std::filesystem::equivalent(shareFolder(), ROBOSIM_SOURCE_DIR));
  ASSERT_EQ(worldFolders().size(), 1u);
  EXPECT_EQ(worldFolders()[0].path, shareFolder() / "worlds");
  EXPECT_FALSE(worldFolders()[0].is_from_environment);
}

TEST_F(DataFolders, BeginWithThoseInTheEnvironmentVariable) {
  ASSERT_EQ(setenv("ROBOSIM_PATH", "/first::/second worlds:", 1), 0);
  const auto folders = worldFolders();
  ASSERT_EQ(folders.size(), 3u);
  EXPECT_EQ(folders[0].path, "/first");
  EXPECT_TRUE(folders[0].is_from_environment);
  EXPECT_EQ(folders[1].path, "/second worlds");
  EXPECT_EQ(folders[2].path, shareFolder() / "worlds");
}

TEST_F(DataFolders, HaveFilesByNameWithOrWithoutEnding) {
  const auto maze = shareFolder() / "worlds" / "small_maze.xml";
  const auto absolute = std::filesystem::absolute(maze).string();
  for (const std::string name : {"small_maze", "small_maze.xml", "worlds/small_maze", "worlds/small_maze.xml"}) {
    const auto found = findDataFile(name);
    ASSERT_TRUE(found) << name;
    EXPECT_TRUE(std::filesystem::equivalent(*found, maze)) << name;
  }
  EXPECT_EQ(findDataFile(absolute), absolute);
  EXPECT_TRUE(findDataFile("lab.yaml")) << "a map";
  EXPECT_TRUE(findDataFile("rawlogs/slam.rawlog"));
  EXPECT_FALSE(findDataFile("no_such_maze"));
  EXPECT_FALSE(findDataFile("/small_maze")) << "an absolute path is not searched";
  EXPECT_FALSE(findDataFile("worlds")) << "a folder";
  EXPECT_FALSE(findDataFile(""));
}

TEST_F(DataFolders, OfTheEnvironmentVariableHaveFilesFirst) {
  const TemporaryDirectory folder;
  std::ofstream(folder.path() / "small_maze.xml") << "<world/>";
  ASSERT_EQ(setenv("ROBOSIM_PATH", folder.path().c_str(), 1), 0);
  EXPECT_EQ(findDataFile("small_maze"), folder.path() / "small_maze.xml");
}

TEST_F(DataFolders, HaveNoFileThatIsNowhere) {
  EXPECT_EQ(requireDataFile("small_maze"), *findDataFile("small_maze"));
  EXPECT_EQ(requireDataFile("/"), "/") << "reading it reports a better error";
  const TemporaryDirectory folder;
  const auto link = folder.path() / "link";
  std::filesystem::create_symlink("nowhere", link);
  EXPECT_EQ(requireDataFile(link), link);
  try {
    requireDataFile("no_such_maze");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.what(), "no_such_maze: no such file; check the path" + searchedText("no_such_maze"));
  }
}

TEST_F(DataFolders, AreNamedInErrors) {
  ASSERT_EQ(setenv("ROBOSIM_PATH", "/mine", 1), 0);
  const std::string share = shareFolder().string();
  EXPECT_EQ(searchedText("maze"), "; searched are also /mine, " + share + "/worlds, " + share + "/worlds/benchmark, " +
                                      share + "/maps, " + share + "/rawlogs, " + share +
                                      " (ROBOSIM_PATH adds folders)");
  EXPECT_EQ(searchedText("/maze"), "");
}

}  // namespace
}  // namespace robosim
