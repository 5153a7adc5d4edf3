#include "recording/gzip_file.h"

#include <fstream>
#include <sstream>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <mrpt/io/CFileGZInputStream.h>
#include <sys/file.h>
#include <unistd.h>

#include "base/error_list.h"
#include "base/random.h"
#include "base/test_folder.h"
#include "recording/full_disk.h"
#include "recording/recording_error.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

using GzipFileTest = TestFolder;

/// Bytes that do not compress.
std::vector<std::uint8_t> noise(std::size_t size) {
  Rng rng(7);
  std::vector<std::uint8_t> bytes(size);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(rng());
  return bytes;
}

std::vector<std::uint8_t> unpacked(const fs::path& file) {
  mrpt::io::CFileGZInputStream in;
  EXPECT_TRUE(in.open(file.string()));
  std::vector<std::uint8_t> bytes(10'000'000);
  bytes.resize(in.Read(bytes.data(), bytes.size()));
  return bytes;
}

void writeText(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

std::string textOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::string configErrorFor(const fs::path& file) {
  try {
    GzipFile refused(file);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "none";
}

/// Takes root's power over everybody's files from a test that was started by root.
class WithoutPower {
 public:
  WithoutPower() : before_(geteuid()) { EXPECT_EQ(seteuid(before_ == 0 ? 65534 : before_), 0); }
  ~WithoutPower() { EXPECT_EQ(seteuid(before_), 0); }

 private:
  uid_t before_;
};

TEST_F(GzipFileTest, MrptUnpacksWhatWasWrittenInPieces) {
  const auto all = noise(300'000);
  GzipFile file(in("a.rawlog"));
  for (std::size_t at = 0; at < all.size(); at += 100'000) file.write(std::span(all).subspan(at, 100'000));
  file.commit();
  EXPECT_EQ(unpacked(in("a.rawlog")), all);
}

TEST_F(GzipFileTest, IsAWholeGzipFileEvenWithNothingInIt) {
  GzipFile(in("empty.rawlog")).commit();
  EXPECT_EQ(unpacked(in("empty.rawlog")), std::vector<std::uint8_t>());
  EXPECT_GT(fs::file_size(in("empty.rawlog")), 0u);
}

TEST_F(GzipFileTest, HasItsNameOnlyWhenItIsWhole) {
  writeText(in("a.rawlog"), "the recording before");
  GzipFile file(in("a.rawlog"));
  file.write(noise(200'000));
  EXPECT_EQ(textOf(in("a.rawlog")), "the recording before");
  EXPECT_TRUE(fs::exists(in("a.rawlog.part")));
  file.commit();
  EXPECT_EQ(unpacked(in("a.rawlog")), noise(200'000));
  EXPECT_FALSE(fs::exists(in("a.rawlog.part")));
}

TEST_F(GzipFileTest, LeavesNothingBehindWhenItIsNotCommitted) {
  writeText(in("a.rawlog"), "the recording before");
  GzipFile(in("a.rawlog")).write(noise(200'000));
  EXPECT_EQ(textOf(in("a.rawlog")), "the recording before");
  EXPECT_FALSE(fs::exists(in("a.rawlog.part")));
}

TEST_F(GzipFileTest, GivesUpOnAFullDiskWhileWriting) {
  writeText(in("a.rawlog"), "the recording before");
  GzipFile file(in("a.rawlog"));
  const FullDisk full(100'000);
  try {
    file.write(noise(1'000'000));
    FAIL() << "a file of 1 MB on a disk of 100 kB";
  } catch (const RecordingError& error) {
    EXPECT_EQ(error.what(), in("a.rawlog").string() +
                                ": the recording could not be written: File too large; make room, or record elsewhere");
  }
  EXPECT_EQ(textOf(in("a.rawlog")), "the recording before");
  EXPECT_FALSE(fs::exists(in("a.rawlog.part")));
  EXPECT_THROW(file.write(noise(1)), RecordingError);
  EXPECT_THROW(file.commit(), RecordingError);
  EXPECT_EQ(textOf(in("a.rawlog")), "the recording before");
}

TEST_F(GzipFileTest, GivesUpOnADiskThatIsFullOnlyForTheLastBytes) {
  writeText(in("a.rawlog"), "the recording before");
  GzipFile file(in("a.rawlog"));
  file.write(noise(1'000));
  const FullDisk full(fs::file_size(in("a.rawlog.part")));
  EXPECT_THROW(file.commit(), RecordingError);
  EXPECT_EQ(textOf(in("a.rawlog")), "the recording before");
  EXPECT_FALSE(fs::exists(in("a.rawlog.part")));
}

TEST_F(GzipFileTest, RefusesAFolder) {
  EXPECT_EQ(configErrorFor(folder_), folder_.string() + ": is a folder; give the name of a file in it, such as " +
                                         (folder_ / "run.rawlog").string());
}

TEST_F(GzipFileTest, RefusesNoNameAtAll) {
  EXPECT_EQ(configErrorFor(""), ": is no name for a recording; give a file's, such as run.rawlog");
}

TEST_F(GzipFileTest, RefusesAFolderThatIsNotThere) {
  EXPECT_EQ(configErrorFor(in("no/such/a.rawlog")), in("no/such/a.rawlog.part").string() +
                                                        ": cannot be made: the folder " + in("no/such").string() +
                                                        " does not exist; make it, or record to another");
  EXPECT_FALSE(fs::exists(in("no")));
}

TEST_F(GzipFileTest, RefusesAFileInPlaceOfAFolder) {
  writeText(in("file"), "");
  EXPECT_NE(configErrorFor(in("file/a.rawlog")).find("is no folder"), std::string::npos);
}

TEST_F(GzipFileTest, RefusesAFolderThatItMayNotWriteTo) {
  fs::permissions(folder_, fs::perms(0555));
  const WithoutPower without;
  EXPECT_EQ(configErrorFor(in("a.rawlog")), in("a.rawlog.part").string() + ": cannot be made: the folder " +
                                                folder_.string() +
                                                " is not writable (Permission denied); record to another");
}

TEST_F(GzipFileTest, RefusesAFolderOfTheSystemThatTakesNoFiles) {
  EXPECT_NE(configErrorFor("/proc/a.rawlog").find("the folder /proc is not writable"), std::string::npos);
}

TEST_F(GzipFileTest, RefusesAFileThatItMayNotOverwrite) {
  fs::permissions(folder_, fs::perms(0777));
  writeText(in("a.rawlog"), "keep me");
  fs::permissions(in("a.rawlog"), fs::perms(0444));
  const WithoutPower without;
  EXPECT_EQ(configErrorFor(in("a.rawlog")),
            in("a.rawlog").string() + ": must not be overwritten; choose another name, or make the file writable");
}

TEST_F(GzipFileTest, RefusesToTakeThePlaceOfADevice) {
  EXPECT_EQ(configErrorFor("/dev/null"),
            "/dev/null: is no ordinary file, and a recording would take its place; choose another name");
}

TEST_F(GzipFileTest, RefusesToShareAFileWithAnotherRecording) {
  GzipFile first(in("a.rawlog"));
  EXPECT_EQ(configErrorFor(in("a.rawlog")),
            in("a.rawlog.part").string() + ": another program is recording there; record to another file");
  first.commit();
  EXPECT_EQ(configErrorFor(in("a.rawlog")), "none");
}

TEST_F(GzipFileTest, TakesOverWhatAKilledProgramLeft) {
  writeText(in("a.rawlog.part"), std::string(100'000, 'x'));
  GzipFile file(in("a.rawlog"));
  file.write(noise(10));
  file.commit();
  EXPECT_EQ(unpacked(in("a.rawlog")), noise(10));
}

TEST_F(GzipFileTest, LeavesALinkALink) {
  fs::create_directories(in("elsewhere"));
  writeText(in("elsewhere/b.rawlog"), "the recording before");
  fs::create_symlink(in("elsewhere/b.rawlog"), in("a.rawlog"));
  GzipFile file(in("a.rawlog"));
  file.write(noise(10));
  file.commit();
  EXPECT_TRUE(fs::is_symlink(in("a.rawlog")));
  EXPECT_EQ(unpacked(in("elsewhere/b.rawlog")), noise(10));
}

}  // namespace
}  // namespace robosim
