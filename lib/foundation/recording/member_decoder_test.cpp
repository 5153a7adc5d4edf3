// Recordings are read alike with any number of threads.
#include "recording/member_decoder.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <mrpt/io/CFileGZOutputStream.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CRawlog.h>
#include <mrpt/serialization/CArchive.h>

#include "base/error_list.h"
#include "base/memory_bound.h"
#include "base/testing/test_folder.h"
#include "hardware/robot_message.h"
#include "recording/byte_archive.h"
#include "recording/gzip_file.h"
#include "recording/gzip_members.h"
#include "recording/member_index.h"
#include "recording/observation_writer.h"
#include "recording/rawlog_reader.h"
#include "recording/rawlog_writer.h"
#include "recording/testing/sample_robot.h"
#include "recording/unpacked_file.h"
#include "tests/stock_tools.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;

/// What a reader returns of a file.
struct Reading {
  std::vector<std::string> observations;  ///< serialised
  std::vector<std::uint64_t> positions, entries;
  std::uint64_t skipped = 0;
  std::string error;
  bool ends_early = false, is_damaged = false;
  bool operator==(const Reading&) const = default;
};

class MemberDecoderTest : public TestFolder {
 protected:
  /// Two robots for some steps, 8 kB each.
  void record(std::uint64_t steps, RawlogFormat format = RawlogFormat::observations) {
    const std::vector<RobotInfo> robots{sampleRobot("a"), sampleRobot("b")};
    RawlogWriter writer(file_, robots, format, RawlogImages::embedded, "a note");
    for (std::uint64_t step = 0; step < steps; ++step) {
      std::vector<Readings> readings{sampleReadings(robots[0], step), sampleReadings(robots[1], step + 7)};
      for (auto& of_robot : readings) of_robot.time = {step, 0.1};
      writer.write(readings, {});
    }
    writer.close("another note");
  }

  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void replace(const std::string& content) const { std::ofstream(file_, std::ios::binary) << content; }

  Reading read(int threads) const {
    RawlogReader reader(file_, RawlogReader::Access::sequential, threads);
    Reading reading;
    while (const auto observation = reader.next()) {
      ByteArchive archive;
      archive << *observation;
      reading.observations.emplace_back(archive.bytes.begin(), archive.bytes.end());
      reading.positions.push_back(reader.position());
      reading.entries.push_back(reader.entries());
    }
    reading.skipped = reader.skippedEntries();
    reading.error = reader.readError().value_or("");
    reading.ends_early = reader.endsEarly();
    reading.is_damaged = reader.isDamaged();
    return reading;
  }
  /// Of one thread, after others were compared with it.
  Reading readAlike() const {
    const Reading expected = read(1);
    for (const int threads : {2, 5}) {
      const Reading reading = read(threads);
      EXPECT_EQ(reading.error, expected.error) << threads;
      EXPECT_EQ(reading.observations.size(), expected.observations.size()) << threads;
      EXPECT_TRUE(reading == expected) << threads;
    }
    return expected;
  }

  fs::path file_ = in("run.rawlog");
};

TEST_F(MemberDecoderTest, ReadsWhatOneThreadReads) {
  record(150);
  const Reading reading = readAlike();
  EXPECT_GT(reading.observations.size(), 150U * 2 * 8);
  EXPECT_EQ(reading.error, "");
}

TEST_F(MemberDecoderTest, ReadsPairsOfActionsAndFrames) {
  record(150, RawlogFormat::sensory_frames);
  file_ = in("run_b.rawlog");
  EXPECT_GT(readAlike().observations.size(), 150U * 8);
}

TEST_F(MemberDecoderTest, EndsWhereAFileIsCut) {
  record(120);
  const std::string all = bytes();
  const std::size_t whole = read(1).observations.size();
  // Also within the index, which ends the file, and within headers.
  for (const std::size_t size :
       {all.size() - 1, all.size() - 30, all.size() * 9 / 10, all.size() / 2, std::size_t{3000}}) {
    replace(all.substr(0, size));
    const Reading reading = readAlike();
    EXPECT_TRUE(reading.ends_early) << size;
    EXPECT_FALSE(reading.is_damaged) << size;
    EXPECT_NE(reading.error.find("cut off"), std::string::npos) << reading.error;
    EXPECT_GE(reading.observations.size() + 5 + whole / 10, whole * size / all.size()) << size;
  }
}

TEST_F(MemberDecoderTest, EndsAtADamagedMember) {
  // A sanitizer ends the program at the first allocation as large as damaged content states (fuzz_rawlog covers it).
  if (!MemoryBound::kBounds) return;
  record(150);
  const std::string all = bytes();
  for (std::size_t at = all.size() / 12; at < all.size(); at += all.size() / 12) {
    std::string damaged = all;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
    replace(damaged);
    readAlike();
  }
}

// No checksum is of a header: the sizes that it states may be wrong.
TEST_F(MemberDecoderTest, ReadsAllMembersAfterADamagedHeader) {
  record(80);
  const std::string all = bytes();
  const std::size_t count = read(1).observations.size();
  for (std::size_t at = 0; at < MemberHeader::kBytes; ++at) {
    std::string damaged = all;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    replace(damaged);
    try {
      const Reading expected = read(1);
      EXPECT_TRUE(read(2) == expected) << at;
      // The sizes are only used by the decoder.
      EXPECT_TRUE(at < 16 || expected.observations.size() == count) << at;
    } catch (const ConfigError&) {
      EXPECT_THROW(read(2), ConfigError) << at;
    }
  }
}

TEST_F(MemberDecoderTest, AllocatesNoMemoryForImpossibleSizes) {
  record(80);
  const std::string all = bytes();
  const auto size = MemberHeader::parse(std::vector<std::uint8_t>(all.begin(), all.end()))->packed;
  // The size that the second member states is possible in this file, which has a hole, but not for its content.
  constexpr std::uint32_t kHole = 700'000'000;
  std::string damaged = all;
  for (int i = 0; i < 4; ++i) damaged[size + 16 + static_cast<std::size_t>(i)] = static_cast<char>(kHole >> (8 * i));
  replace(damaged);
  fs::resize_file(file_, damaged.size() + kHole);
  EXPECT_GT(readAlike().observations.size(), 80U * 2 * 8);
}

// After the index of the first file, there are further members.
TEST_F(MemberDecoderTest, ReadsPagesOfTheIndexThatAreDamaged) {
  record(80);
  const std::string first = bytes();
  record(20);
  const std::string all = first + bytes();
  const auto page = first.rfind("RI") - 12;  // the only one
  for (const std::size_t at : {page, page + 3, page + 10, page + 12, page + 14, first.size() - 30, first.size() - 12,
                               first.size() - 10, first.size() - 8, first.size() - 1}) {
    std::string damaged = all;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x11);
    replace(damaged);
    const Reading reading = readAlike();
    EXPECT_GT(reading.observations.size(), 80U * 2 * 8) << at;
  }
}

TEST_F(MemberDecoderTest, ReportsAWrongChecksumOfAnyMember) {
  record(150);
  const std::string all = bytes();
  std::vector<std::size_t> ends;
  for (std::size_t at = 0; at + MemberHeader::kBytes < all.size();) {
    const auto header =
        MemberHeader::parse(std::vector<std::uint8_t>(all.begin() + static_cast<std::ptrdiff_t>(at), all.end()));
    if (!header) break;  // the index
    ends.push_back(at += header->packed);
  }
  ASSERT_GE(ends.size(), 3U);
  for (const std::size_t end : ends) {
    std::string damaged = all;
    damaged[end - 8] = static_cast<char>(damaged[end - 8] ^ 1);
    replace(damaged);
    const Reading reading = readAlike();
    EXPECT_TRUE(reading.is_damaged) << end;
    EXPECT_NE(reading.error.find("incorrect data check"), std::string::npos) << reading.error;
  }
}

TEST_F(MemberDecoderTest, ReadsFilesInARowAndGzipFilesOfOtherPrograms) {
  record(80);
  const std::string first = bytes();
  {
    mrpt::io::CFileGZOutputStream stream(file_.string());
    auto archive = mrpt::serialization::archiveFrom(stream);
    mrpt::obs::CObservationOdometry odometry;
    archive << odometry;
  }
  const std::string foreign = bytes();
  EXPECT_EQ(readAlike().observations.size(), 1U);
  replace(first);
  const std::size_t count = readAlike().observations.size();
  replace(first + first);
  EXPECT_EQ(readAlike().observations.size(), 2 * count);
  replace(first + foreign + first);
  EXPECT_EQ(readAlike().observations.size(), 2 * count + 1);
  replace(foreign + first);
  EXPECT_EQ(readAlike().observations.size(), count + 1);
  replace(first + "rubbish");
  EXPECT_EQ(readAlike().observations.size(), count);
}

TEST_F(MemberDecoderTest, EndsWhereItBeginsWithoutThreads) {
  record(20);
  MemberDecoder decoder(MemberDecoder::open(file_), {}, 0);
  EXPECT_FALSE(decoder.next());
  EXPECT_EQ(decoder.end().packed, 0U);
  EXPECT_EQ(decoder.end().unpacked, 0U);
}

TEST_F(MemberDecoderTest, CanBeAbandoned) {
  record(300);
  RawlogReader reader(file_, RawlogReader::Access::sequential, 4);
  for (int i = 0; i < 800; ++i) ASSERT_TRUE(reader.next());
}

// The messages that 12 robots receive make a step of 10 MB, which is more than a member holds: 11 of them are in the
// first one, and the last one is in a member of its own also if it is small.
TEST_F(MemberDecoderTest, ReadsStepsThatAreLargerThanAMember) {
  std::vector<RobotInfo> robots;
  for (int i = 0; i < 12; ++i) robots.push_back(sampleRobot("r" + std::to_string(i)));
  const std::vector<mrpt::math::TPose2D> truth(robots.size(), {1, 2, 3});
  const std::vector<Command> commands(robots.size());
  for (const std::size_t messages_of_last : {200, 0}) {
    std::vector<Readings> readings;
    for (const auto& robot : robots) {
      readings.push_back(sampleReadings(robot, 3));
      readings.back().inbox.edit().assign(200, {"r0", robot.name, std::string(kMaxMessageBytes, 'x')});
    }
    readings.back().inbox.edit().resize(messages_of_last);
    {
      RawlogWriter writer(file_, robots);
      for (std::uint64_t step = 0; step < 2; ++step) {
        for (auto& of_robot : readings) of_robot.time = {step, 0.1};
        writer.write(readings, truth, commands);
      }
      writer.close();
    }
    const auto index = MemberIndex::read(file_);
    ASSERT_TRUE(index);
    std::vector<std::uint32_t> steps;
    for (const auto& member : index->members) steps.push_back(member.steps);
    EXPECT_EQ(steps, (std::vector<std::uint32_t>{1, 0, 1, 0})) << messages_of_last;
    const Reading one = read(1), two = read(2);
    EXPECT_TRUE(one == two);
    EXPECT_EQ(one.observations.size() % 2, 0U);
    RawlogReader reader(file_, RawlogReader::Access::random);
    reader.seek(index->members[2].unpacked);
    const auto first = reader.next();
    ASSERT_TRUE(first);
    EXPECT_TRUE(first->sensorLabel.starts_with("r0/")) << first->sensorLabel;
  }
}

// Ten members of 10 MB do not all wait at the same time, and one of 17 MiB is read without the decoder.
TEST_F(MemberDecoderTest, ReadsLargeMembers) {
  const auto comment_of = [](std::size_t size) {
    mrpt::obs::CObservationComment comment;
    comment.text.assign(size, 'x');
    ByteArchive archive;
    archive << comment;
    return archive.bytes;
  };
  GzipFile file(file_);
  for (int i = 0; i < 10; ++i) {
    file.write(comment_of(10'000'000));
    file.endMember();
  }
  file.write(comment_of(std::size_t{17} << 20));
  file.endMember();
  file.write(comment_of(100));
  file.commit();
  MemberDecoder decoder(MemberDecoder::open(file_), {}, 8);
  std::size_t count = 0;
  while (decoder.next()) ++count;
  EXPECT_EQ(count, 10U);
  RawlogReader reader(file_, RawlogReader::Access::sequential, 8);
  count = 0;
  while (reader.next()) ++count;
  EXPECT_EQ(count, 12U);
  EXPECT_FALSE(reader.readError());
}

TEST_F(MemberDecoderTest, StockProgramsReadMembers) {
  record(150);
  const std::size_t count = read(2).observations.size();
  mrpt::obs::CRawlog rawlog;
  ASSERT_TRUE(rawlog.loadFromRawLogFile(file_.string()));
  EXPECT_EQ(rawlog.size() + 2, count) << "MRPT keeps comments apart";
  EXPECT_EQ(runTool("gzip -t run.rawlog", folder_).exit_code, 0);
  UnpackedFile content(file_);
  std::uint64_t size = 0;
  std::vector<char> piece(1 << 20);
  while (const std::size_t got = content.read(piece.data(), piece.size())) size += got;
  const ToolRun zcat = runTool("zcat run.rawlog | wc -c", folder_);
  EXPECT_EQ(std::stoull(zcat.output), size) << zcat.output;
  const ToolRun python = runTool("python3 -c \"import gzip; print(len(gzip.open('run.rawlog').read()))\"", folder_);
  EXPECT_EQ(std::stoull(python.output), size) << python.output;
  const ToolRun edit = runTool("rawlog-edit --info -i run.rawlog", folder_);
  EXPECT_EQ(edit.exit_code, 0);
  EXPECT_NE(edit.output.find(std::to_string(count)), std::string::npos) << edit.output;
}

TEST_F(MemberDecoderTest, ObservationsOfOneTimeAreWrittenToOneMember) {
  record(150);
  {
    RawlogReader reader(file_);
    ObservationWriter writer(in("copy.rawlog"), "");
    while (const auto observation = reader.next()) writer.write(*observation);
    writer.commit();
  }
  const Reading original = read(1);
  file_ = in("copy.rawlog");
  EXPECT_EQ(readAlike().observations.size(), original.observations.size());
  const auto index = MemberIndex::read(file_);
  ASSERT_TRUE(index);
  ASSERT_GT(index->members.size(), 2U);
  EXPECT_FALSE(index->summary.has_traces);
  RawlogReader reader(file_, RawlogReader::Access::random);
  for (const auto& member : index->members) {
    reader.seek(member.unpacked);
    const auto first = reader.next();
    ASSERT_TRUE(first);
    EXPECT_TRUE(member.unpacked == 0 || first->sensorLabel.starts_with("a/")) << "the first robot begins a step";
  }
}

}  // namespace
}  // namespace robosim
