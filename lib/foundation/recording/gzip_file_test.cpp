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
#include "base/testing/file_size_limit.h"
#include "base/testing/test_folder.h"
#include "recording/recording_error.h"
#include "recording/unpacked_file.h"

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

std::vector<std::uint8_t> unpacked(const fs::path& file, std::size_t size_max = 10'000'000) {
  mrpt::io::CFileGZInputStream in;
  EXPECT_TRUE(in.open(file.string()));
  std::vector<std::uint8_t> bytes(size_max);
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

/// Drops root privileges of a test that was started by root.
class WithoutPower {
 public:
  WithoutPower() : before_(geteuid()) { EXPECT_EQ(seteuid(before_ == 0 ? 65534 : before_), 0); }
  ~WithoutPower() { EXPECT_EQ(seteuid(before_), 0); }

 private:
  uid_t before_;
};

TEST_F(GzipFileTest, IsReadableByMrptWhenWrittenInPieces) {
  const auto all = noise(300'000);
  GzipFile file(in("a.rawlog"));
  for (std::size_t at = 0; at < all.size(); at += 100'000) file.write(std::span(all).subspan(at, 100'000));
  file.commit();
  EXPECT_EQ(unpacked(in("a.rawlog")), all);
}

TEST_F(GzipFileTest, DoesNotAppearUnderItsNameBeforeCommit) {
  GzipFile file(in("a.rawlog"));
  file.write(noise(1'000));
  file.finish();
  file.finish();
  EXPECT_FALSE(fs::exists(in("a.rawlog")));
  EXPECT_EQ(unpacked(in("a.rawlog.part")), noise(1'000));
  file.commit();
  EXPECT_EQ(unpacked(in("a.rawlog")), noise(1'000));
}

TEST_F(GzipFileTest, KeepsWritesOfSeveralPiecesIntact) {
  std::vector<std::uint8_t> bytes(2 * GzipFile::kMaxPiece + 12345);
  for (std::size_t i = 0; i < bytes.size(); i += 4096) bytes[i] = static_cast<std::uint8_t>(i >> 12);
  GzipFile file(in("a.rawlog"));
  file.write(bytes);
  file.commit();
  EXPECT_TRUE(unpacked(in("a.rawlog"), bytes.size() + 1) == bytes);
}

TEST_F(GzipFileTest, IsAValidGzipFileWithoutData) {
  GzipFile(in("empty.rawlog")).commit();
  EXPECT_EQ(unpacked(in("empty.rawlog")), std::vector<std::uint8_t>());
  EXPECT_GT(fs::file_size(in("empty.rawlog")), 0u);
}

TEST_F(GzipFileTest, AppearsUnderItsNameWhenComplete) {
  writeText(in("a.rawlog"), "the recording before");
  GzipFile file(in("a.rawlog"));
  file.write(noise(200'000));
  EXPECT_EQ(textOf(in("a.rawlog")), "the recording before");
  EXPECT_TRUE(fs::exists(in("a.rawlog.part")));
  file.commit();
  EXPECT_EQ(unpacked(in("a.rawlog")), noise(200'000));
  EXPECT_FALSE(fs::exists(in("a.rawlog.part")));
}

TEST_F(GzipFileTest, RemovesItsPartWithoutCommit) {
  writeText(in("a.rawlog"), "the recording before");
  GzipFile(in("a.rawlog")).write(noise(200'000));
  EXPECT_EQ(textOf(in("a.rawlog")), "the recording before");
  EXPECT_FALSE(fs::exists(in("a.rawlog.part")));
}

TEST_F(GzipFileTest, FailsOnAFullDiskWhileWriting) {
  writeText(in("a.rawlog"), "the recording before");
  GzipFile file(in("a.rawlog"));
  const FileSizeLimit full(100'000);
  try {
    file.write(noise(1'000'000));
    file.endMember();
    FAIL() << "a file of 1 MB on a disk of 100 kB";
  } catch (const RecordingError& error) {
    EXPECT_EQ(error.what(),
              in("a.rawlog").string() +
                  ": the recording could not be written: File too large; free disk space, or record elsewhere");
  }
  EXPECT_EQ(textOf(in("a.rawlog")), "the recording before");
  EXPECT_FALSE(fs::exists(in("a.rawlog.part")));
  EXPECT_THROW(file.write(noise(1)), RecordingError);
  EXPECT_THROW(file.commit(), RecordingError);
  EXPECT_EQ(textOf(in("a.rawlog")), "the recording before");
}

TEST_F(GzipFileTest, FailsWhenTheDiskIsFullForTheLastBytes) {
  writeText(in("a.rawlog"), "the recording before");
  GzipFile file(in("a.rawlog"));
  file.write(noise(1'000));
  const FileSizeLimit full(fs::file_size(in("a.rawlog.part")));
  EXPECT_THROW(file.commit(), RecordingError);
  EXPECT_EQ(textOf(in("a.rawlog")), "the recording before");
  EXPECT_FALSE(fs::exists(in("a.rawlog.part")));
}

TEST_F(GzipFileTest, RejectsAFolder) {
  EXPECT_EQ(configErrorFor(folder_), folder_.string() + ": is a folder; name a file in it");
}

TEST_F(GzipFileTest, RejectsAnEmptyName) { EXPECT_EQ(configErrorFor(""), ": is no name for a file; give one"); }

TEST_F(GzipFileTest, RejectsAMissingFolder) {
  EXPECT_EQ(configErrorFor(in("no/such/a.rawlog")), in("no/such/a.rawlog").string() +
                                                        ": cannot be created: the folder " + in("no/such").string() +
                                                        " does not exist; create it, or choose another");
  EXPECT_FALSE(fs::exists(in("no")));
}

TEST_F(GzipFileTest, RejectsAFileInPlaceOfAFolder) {
  writeText(in("file"), "");
  EXPECT_NE(configErrorFor(in("file/a.rawlog")).find("is no folder"), std::string::npos);
}

TEST_F(GzipFileTest, RejectsAFolderWithoutWritePermission) {
  fs::permissions(folder_, fs::perms(0555));
  const WithoutPower without;
  EXPECT_EQ(configErrorFor(in("a.rawlog")), in("a.rawlog").string() + ": cannot be created: the folder " +
                                                folder_.string() +
                                                " is not writable (Permission denied); choose another");
}

TEST_F(GzipFileTest, RejectsASystemFolder) {
  EXPECT_NE(configErrorFor("/proc/a.rawlog").find("the folder /proc is not writable"), std::string::npos);
}

TEST_F(GzipFileTest, RejectsAWriteProtectedFile) {
  fs::permissions(folder_, fs::perms(0777));
  writeText(in("a.rawlog"), "keep me");
  fs::permissions(in("a.rawlog"), fs::perms(0444));
  const WithoutPower without;
  EXPECT_EQ(configErrorFor(in("a.rawlog")),
            in("a.rawlog").string() + ": must not be overwritten; choose another name, or make the file writable");
}

TEST_F(GzipFileTest, RejectsADevice) {
  EXPECT_EQ(configErrorFor("/dev/null"),
            "/dev/null: is not a regular file, and would be replaced; choose another name");
}

TEST_F(GzipFileTest, RejectsAFileThatIsBeingRecorded) {
  GzipFile first(in("a.rawlog"));
  EXPECT_EQ(configErrorFor(in("a.rawlog")),
            in("a.rawlog.part").string() + ": another program is writing there; choose another file");
  first.commit();
  EXPECT_EQ(configErrorFor(in("a.rawlog")), "none");
}

TEST_F(GzipFileTest, ReplacesThePartOfAKilledProgram) {
  writeText(in("a.rawlog.part"), std::string(100'000, 'x'));
  GzipFile file(in("a.rawlog"));
  file.write(noise(10));
  file.commit();
  EXPECT_EQ(unpacked(in("a.rawlog")), noise(10));
}

TEST_F(GzipFileTest, KeepsLinks) {
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
