#include "base/atomic_file.h"

#include <cerrno>
#include <fstream>
#include <functional>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "base/input_file.h"
#include "base/testing/file_size_limit.h"
#include "base/testing/test_folder.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public TestFolder {
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

TEST_F(AtomicFileTest, AppearsUnderItsNameAtCommit) {
  const fs::path file = folder_ / "a.txt";
  std::ofstream(file) << "before";
  {
    AtomicFile output(file);
    output.write("after");
    EXPECT_EQ(textOf(file), "before");
    output.finish();
    EXPECT_EQ(textOf(file), "before");
    output.commit();
    EXPECT_EQ(textOf(file), "after");
  }
  EXPECT_EQ(textOf(file), "after");
  EXPECT_FALSE(fs::exists(file.string() + ".part"));
}

TEST_F(AtomicFileTest, LeavesNoChangesWithoutCommit) {
  const fs::path file = folder_ / "a.txt";
  std::ofstream(file) << "before";
  {
    AtomicFile output(file);
    output.write("after");
  }
  checkWritable(file);
  checkWritable(folder_ / "new.txt");
  EXPECT_EQ(textOf(file), "before");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(AtomicFileTest, FollowsLinks) {
  fs::create_symlink("real.txt", folder_ / "link.txt");
  std::ofstream(folder_ / "real.txt") << "before";
  AtomicFile output(folder_ / "link.txt");
  output.write("after");
  output.commit();
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
  EXPECT_EQ(textOf(folder_ / "real.txt"), "after");
}

TEST_F(AtomicFileTest, DoesNotFollowALinkInPlaceOfItsPart) {
  const fs::path file = folder_ / "a.txt", other = folder_ / "other.txt";
  std::ofstream(other) << "kept";
  fs::create_symlink("other.txt", file.string() + ".part");
  EXPECT_EQ(errorOf([&] { AtomicFile{file}; }),
            file.string() + ": cannot be created: Too many levels of symbolic links; choose another file");
  EXPECT_EQ(textOf(other), "kept");
}

TEST_F(AtomicFileTest, ReportsWhyAFileCannotBeCreated) {
  const std::string here = folder_.string();
  EXPECT_EQ(errorOf([&] { checkWritable(folder_); }), here + ": is a folder; name a file in it");
  EXPECT_EQ(errorOf([&] { checkWritable(here + "/"); }), here + "/: is no name for a file; give one");
  EXPECT_EQ(errorOf([&] { checkWritable(here + "/none/a.txt"); }),
            here + "/none/a.txt: cannot be created: the folder " + here +
                "/none does not exist; create it, or choose another");
  EXPECT_EQ(errorOf([&] { checkWritable("/dev/null"); }),
            "/dev/null: is not a regular file, and would be replaced; choose another name");
}

TEST_F(AtomicFileTest, ReportsAFullDisk) {
  const fs::path file = folder_ / "a.txt";
  std::ofstream(file) << "before";
  const FileSizeLimit full(100'000);
  const std::string expected = file.string() + ": cannot be written (File too large); choose another place";
  for (const std::size_t piece : {std::size_t{200'000}, std::size_t{1'000}}) {
    AtomicFile output(file);
    for (std::size_t written = 0; written < 200'000; written += piece) output.write(std::string(piece, 'x'));
    EXPECT_EQ(output.error(), EFBIG);
    EXPECT_EQ(errorOf([&] { output.finish(); }), expected);
    EXPECT_EQ(errorOf([&] { output.finish(); }), expected);
    EXPECT_EQ(errorOf([&] { output.commit(); }), expected);
  }
  EXPECT_EQ(textOf(file), "before");
  EXPECT_FALSE(fs::exists(file.string() + ".part"));
}

TEST_F(AtomicFileTest, ReportsAFullDiskForBufferedBytes) {
  AtomicFile output(folder_ / "a.txt");
  const FileSizeLimit full(3);
  output.write("four");
  EXPECT_EQ(output.error(), 0);
  EXPECT_NE(errorOf([&] { output.finish(); }).find("File too large"), std::string::npos);
}

TEST_F(AtomicFileTest, KeepsTheOrderOfSmallAndLargeWrites) {
  const std::string large(100'000, 'x');
  AtomicFile output(folder_ / "a.txt");
  output.write("a");
  output.write(large);
  output.write("b");
  output.commit();
  EXPECT_EQ(readWholeFile(folder_ / "a.txt", 1 << 20, "is it?"), "a" + large + "b");
}

TEST_F(AtomicFileTest, ReadsAtMostTheMaximumSize) {
  std::ofstream(folder_ / "a.txt") << std::string(2 << 20, 'x');
  EXPECT_EQ(readWholeFile(folder_ / "a.txt", 2 << 20, "is it?").size(), 2u << 20);
  EXPECT_EQ(errorOf([&] { readWholeFile(folder_ / "a.txt", 1 << 20, "is it?"); }),
            (folder_ / "a.txt").string() + ": is larger than 1 MiB, the most that is read; is it?");
  EXPECT_EQ(errorOf([&] { textOf(folder_); }), folder_.string() + ": is a directory; name a file in it");
  EXPECT_EQ(errorOf([&] { textOf(folder_ / "b"); }), (folder_ / "b").string() + ": no such file; check the path");
}

}  // namespace
}  // namespace robosim
