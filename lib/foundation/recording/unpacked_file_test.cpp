#include "recording/unpacked_file.h"

#include <cstring>
#include <fstream>
#include <numeric>
#include <random>

#include <gtest/gtest.h>
#include <zlib.h>

#include "base/error_list.h"
#include "base/testing/test_folder.h"

namespace robosim {
namespace {

using Access = UnpackedFile::Access;

class UnpackedFileTest : public TestFolder {
 protected:
  /// 13 MB that compress to a third: words that encode their position, mixed with noise.
  static std::string content(std::size_t size = 13'000'000) {
    std::string bytes(size, 'x');
    std::mt19937 random(1);
    for (std::size_t i = 0; i + 12 <= size; i += 12) {
      const auto where = static_cast<std::uint32_t>(i), noise = static_cast<std::uint32_t>(random());
      std::memcpy(&bytes[i], &where, 4);
      std::memcpy(&bytes[i + 4], &noise, 2);
    }
    return bytes;
  }
  /// Appends to a file as a separate gzip member.
  void pack(const std::string& bytes, int level = 1) {
    const gzFile out = gzopen(file_.c_str(), ("ab" + std::to_string(level)).c_str());
    gzwrite(out, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(out);
  }
  static std::string readAll(UnpackedFile& from) {
    std::string all, piece(99'991, '\0');
    while (const std::size_t got = from.read(piece.data(), piece.size())) all.append(piece, 0, got);
    return all;
  }
  static std::string readSome(UnpackedFile& from, std::uint64_t position, std::size_t size) {
    std::string bytes(size, '\0');
    from.seek(position);
    EXPECT_EQ(from.position(), position);
    bytes.resize(from.read(bytes.data(), size));
    return bytes;
  }
  void expectThatItCanBeWound(const std::string& bytes) {
    UnpackedFile unpacked(file_, Access::random);
    EXPECT_EQ(readAll(unpacked), bytes);
    EXPECT_TRUE(unpacked.atEnd());
    std::mt19937 random(2);
    for (int tries = 0; tries < 60; ++tries) {
      const std::uint64_t at = random() % bytes.size();
      ASSERT_EQ(readSome(unpacked, at, 5000), bytes.substr(at, 5000)) << at;
    }
    unpacked.seek(bytes.size() - 3);
    EXPECT_EQ(readAll(unpacked), bytes.substr(bytes.size() - 3));
    EXPECT_TRUE(unpacked.atEnd());
    EXPECT_EQ(unpacked.fault(), "");
    unpacked.seek(0);
    EXPECT_EQ(readAll(unpacked), bytes) << "all of it again";
  }

  std::filesystem::path file_ = in("bytes.gz");
};

TEST_F(UnpackedFileTest, SeeksInAGzipFile) {
  const std::string bytes = content();
  pack(bytes);
  expectThatItCanBeWound(bytes);
}

TEST_F(UnpackedFileTest, SeeksInSeveralMembersAndStoredBlocks) {
  const std::string bytes = content();
  const std::size_t third = bytes.size() / 3;
  for (int i = 0; i < 3; ++i) pack(bytes.substr(third * static_cast<std::size_t>(i), third), i == 1 ? 0 : 6);
  expectThatItCanBeWound(bytes.substr(0, 3 * third));
}

TEST_F(UnpackedFileTest, SeeksInAnUncompressedFile) {
  const std::string bytes = content();
  std::ofstream(file_, std::ios::binary) << bytes;
  expectThatItCanBeWound(bytes);
}

TEST_F(UnpackedFileTest, PeekedBytesAreReadAgain) {
  pack("rawlog");
  UnpackedFile unpacked(file_);
  char head[3];
  ASSERT_EQ(unpacked.peek(head, 3), 3U);
  EXPECT_EQ(std::string(head, 3), "raw");
  EXPECT_EQ(unpacked.position(), 0U);
  EXPECT_FALSE(unpacked.atEnd());
  EXPECT_EQ(readAll(unpacked), "rawlog");
  EXPECT_EQ(unpacked.peek(head, 3), 0U);
  EXPECT_TRUE(unpacked.atEnd());
}

TEST_F(UnpackedFileTest, ReadsATruncatedFileUpToItsEnd) {
  const std::string bytes = content();
  pack(bytes);
  std::filesystem::resize_file(file_, std::filesystem::file_size(file_) / 2);
  UnpackedFile unpacked(file_, Access::random);
  const std::string half = readAll(unpacked);
  EXPECT_GT(half.size(), bytes.size() / 3);
  EXPECT_EQ(half, bytes.substr(0, half.size()));
  EXPECT_FALSE(unpacked.atEnd());
  EXPECT_EQ(unpacked.fault(), "it is cut off");
  EXPECT_EQ(readSome(unpacked, half.size() - 100, 200), half.substr(half.size() - 100));
  EXPECT_EQ(unpacked.fault(), "it is cut off");
  EXPECT_EQ(readSome(unpacked, 5'000'000, 100), bytes.substr(5'000'000, 100));
  EXPECT_EQ(unpacked.fault(), "");
}

TEST_F(UnpackedFileTest, ReportsDamage) {
  const std::string bytes = content(1'000'000);
  pack(bytes);
  std::fstream damaged(file_, std::ios::binary | std::ios::in | std::ios::out);
  damaged.seekp(200'000);
  damaged << std::string(64, '\xff');
  damaged.close();
  for (const Access access : {Access::sequential, Access::random}) {
    UnpackedFile unpacked(file_, access);
    readAll(unpacked);
    EXPECT_FALSE(unpacked.atEnd());
    EXPECT_NE(unpacked.fault(), "");
  }
}

TEST_F(UnpackedFileTest, IgnoresDataAfterAGzipFile) {
  pack("rawlog");
  std::ofstream(file_, std::ios::binary | std::ios::app) << "rubbish";
  UnpackedFile unpacked(file_);
  EXPECT_EQ(readAll(unpacked), "rawlog");
  EXPECT_TRUE(unpacked.atEnd());
}

TEST_F(UnpackedFileTest, ThrowsForAMissingFile) { EXPECT_THROW(UnpackedFile(in("none")), ConfigError); }

}  // namespace
}  // namespace robosim
