#include "base/whole_file.h"

#include <functional>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "base/test_folder.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

class WholeFileTest : public TestFolder {
 protected:
  static std::string textOf(const fs::path& file) { return readWholeFile(file, 1000, "is it?"); }
  static std::string errorOf(const std::function<void()>& act) {
    try {
      act();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "none";
  }
};

TEST_F(WholeFileTest, HasItsNameOnlyFromCommitOn) {
  const fs::path file = folder_ / "a.txt";
  std::ofstream(file) << "before";
  {
    WholeFile whole(file);
    whole.write("after");
    EXPECT_EQ(textOf(file), "before");
    whole.finish();
    EXPECT_EQ(textOf(file), "before");
    whole.commit();
    EXPECT_EQ(textOf(file), "after");
  }
  EXPECT_EQ(textOf(file), "after");
  EXPECT_FALSE(fs::exists(file.string() + ".part"));
}

TEST_F(WholeFileTest, LeavesEverythingAsItWasWithoutCommit) {
  const fs::path file = folder_ / "a.txt";
  std::ofstream(file) << "before";
  {
    WholeFile whole(file);
    whole.write("after");
  }
  checkWritable(file);
  checkWritable(folder_ / "new.txt");
  EXPECT_EQ(textOf(file), "before");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(WholeFileTest, WritesThroughALink) {
  fs::create_symlink("real.txt", folder_ / "link.txt");
  std::ofstream(folder_ / "real.txt") << "before";
  WholeFile whole(folder_ / "link.txt");
  whole.write("after");
  whole.commit();
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
  EXPECT_EQ(textOf(folder_ / "real.txt"), "after");
}

TEST_F(WholeFileTest, SaysWhyThereCanBeNoSuchFile) {
  const std::string here = folder_.string();
  EXPECT_EQ(errorOf([&] { checkWritable(folder_); }), here + ": is a folder; name a file in it");
  EXPECT_EQ(errorOf([&] { checkWritable(here + "/"); }), here + "/: is no name for a file; give one");
  EXPECT_EQ(errorOf([&] { checkWritable(here + "/none/a.txt"); }),
            here +
                "/none/a.txt: cannot be written (No such file or directory); check that its folder exists and may be "
                "written to");
  EXPECT_EQ(errorOf([&] { checkWritable("/dev/null"); }),
            "/dev/null: is no ordinary file, and another would take its place; choose another name");
}

TEST_F(WholeFileTest, SaysWhenTheDiskIsFull) {
  const fs::path file = folder_ / "a.txt";
  fs::create_symlink("/dev/full", file.string() + ".part");
  const std::string told = file.string() + ": cannot be written (No space left on device); choose another place";
  {
    WholeFile whole(file);
    whole.write("some");
    EXPECT_EQ(errorOf([&] { whole.finish(); }), told);
  }
  fs::create_symlink("/dev/full", file.string() + ".part");
  WholeFile whole(file);
  whole.write(std::string(1 << 20, 'x'));  // more than waits for the end
  EXPECT_EQ(errorOf([&] { whole.commit(); }), told);
}

TEST_F(WholeFileTest, ReadsNoMoreThanItMay) {
  std::ofstream(folder_ / "a.txt") << std::string(2 << 20, 'x');
  EXPECT_EQ(readWholeFile(folder_ / "a.txt", 2 << 20, "is it?").size(), 2u << 20);
  EXPECT_EQ(errorOf([&] { readWholeFile(folder_ / "a.txt", 1 << 20, "is it?"); }),
            (folder_ / "a.txt").string() + ": is larger than 1 MiB, the most that is read; is it?");
  EXPECT_EQ(errorOf([&] { textOf(folder_); }), folder_.string() + ": is a directory; name a file in it");
  EXPECT_EQ(errorOf([&] { textOf(folder_ / "b"); }), (folder_ / "b").string() + ": no such file; check the path");
}

}  // namespace
}  // namespace robosim
