#include "base/data_folders.h"

#include <cstdlib>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace robosim
