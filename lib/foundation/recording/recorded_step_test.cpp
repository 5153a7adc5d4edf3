#include "recording/recorded_step.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <zlib.h>

#include "base/error_list.h"
#include "base/memory_bound.h"
#include "recording/byte_archive.h"
#include "recording/observations.h"
#include "recording/rawlog_writer.h"
#include "recording/recording_error.h"
#include "recording/testing/recorded_steps_test.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;

TEST_F(RecordedStepsTest, RoundTripReadingsCommandsAndMessagesExactly) {
  record(50);
  RawlogReader reader(file_);
  RecordedSteps steps(reader, robots_, 0.1);
  EXPECT_EQ(steps.note(), "first note");
  for (std::size_t k = 0; k < 50; ++k) {
    const auto step = steps.next();
    ASSERT_TRUE(step) << k;
    ASSERT_EQ(step->size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      const RecordedRobot& read = (*step)[i];
      EXPECT_EQ(read.readings.time.step, k);
      EXPECT_EQ(read.readings.measurements, written_[k][i].measurements) << "robot " << i << ", step " << k;
      EXPECT_EQ(read.readings.stalled, written_[k][i].stalled);
      EXPECT_EQ(read.readings.laser_pan_rad, written_[k][i].laser_pan_rad);
      EXPECT_EQ(read.readings.inbox, written_[k][i].inbox);
      EXPECT_EQ(read.readings.is_too_far, written_[k][i].is_too_far);
      EXPECT_EQ(read.readings.winner, written_[k][i].winner);
      EXPECT_EQ(read.command, commands_[k][i]);
      ASSERT_TRUE(read.world_from_robot);
      EXPECT_EQ(read.world_from_robot->y, truth_[k][i].y);
      EXPECT_NEAR(read.world_from_robot->phi, truth_[k][i].phi, 1e-15);
    }
  }
  EXPECT_FALSE(steps.next());
  EXPECT_FALSE(reader.readError());
  EXPECT_EQ(steps.note(), "last note");
}

TEST_F(RecordedStepsTest, HaveARobotThatWasAddedFromItsFirstStepOnAlsoAfterSeeking) {
  constexpr std::size_t kAddedAt = 5, kSteps = 10;
  const std::vector<RobotInfo> first{robots_[0]};
  for (const char* name : {"run.rawlog", "run.mcap"}) {
    written_.clear();
    RawlogWriter writer(in(name), first, RawlogFormat::observations, RawlogImages::embedded, "first note");
    for (std::size_t k = 0; k < kSteps; ++k) {
      written_.push_back(readingsAt(k));
      for (auto& readings : written_.back()) readings.winner.clear();
      const std::size_t count = k < kAddedAt ? 1 : 2;
      std::vector<std::string> comments;
      if (k == kAddedAt) {
        writer.addRobot(robots_[1]);
        comments.push_back("adds b");
      }
      writer.write(std::span(written_.back()).first(count), std::vector<TPose2D>(count), std::vector<Command>(count),
                   comments);
    }
    writer.close("last note");

    RawlogReader reader(in(name), RawlogReader::Access::random);
    RecordedSteps steps(reader, first, 0.1, Pictures::keep, [&](const std::string& comment) {
      return comment == "adds b" ? std::optional(robots_[1]) : std::nullopt;
    });
    std::vector<std::uint64_t> positions;
    for (std::size_t k = 0; k < kSteps; ++k) {
      positions.push_back(steps.position());
      const auto step = steps.next();
      ASSERT_TRUE(step) << k;
      ASSERT_EQ(step->size(), k < kAddedAt ? 1u : 2u);
      EXPECT_EQ(step->back().readings.measurements, written_[k][step->size() - 1].measurements) << k;
    }
    for (const std::size_t k : {8, 2, 5, 4}) {
      steps.seek(positions[k]);
      const auto step = steps.next();
      ASSERT_TRUE(step && step->size() == 2) << k;
      EXPECT_EQ(isAbsent((*step)[1]), k < kAddedAt) << k;
      EXPECT_EQ((*step)[0].readings.measurements, written_[k][0].measurements) << k;
    }
  }
}

/// Size of the decompressed data of a truncated gzip file of members.
std::size_t unpackedSize(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<char> in((std::istreambuf_iterator<char>(stream)), {}), out(1 << 16);
  z_stream inflating{};
  EXPECT_EQ(inflateInit2(&inflating, 15 + 16), Z_OK);
  inflating.next_in = reinterpret_cast<Bytef*>(in.data());
  inflating.avail_in = static_cast<unsigned>(in.size());
  std::size_t size = 0;
  int result = Z_OK;
  do {
    inflating.next_out = reinterpret_cast<Bytef*>(out.data());
    inflating.avail_out = static_cast<unsigned>(out.size());
    result = inflate(&inflating, Z_NO_FLUSH);
    size += out.size() - inflating.avail_out;
    if (result == Z_STREAM_END) result = inflateReset(&inflating);
  } while (result == Z_OK && (inflating.avail_in > 0 || inflating.avail_out == 0));
  inflateEnd(&inflating);
  return size;
}

TEST_F(RecordedStepsTest, ReadAllCompleteStepsOfATruncatedFile) {
  record(50);
  const auto size = std::filesystem::file_size(file_);
  std::vector<std::uint64_t> begins;  // positions of the steps in the decompressed file
  {
    RawlogReader reader(file_, RawlogReader::Access::random);
    RecordedSteps steps(reader, robots_, 0.1);
    do {
      begins.push_back(steps.position());
    } while (steps.next());
    begins.pop_back();
  }
  ASSERT_EQ(begins.size(), 50U);
  for (const double share : {0.2, 0.5, 0.9, 0.999}) {
    std::filesystem::copy_file(file_, in("cut.rawlog"), std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(in("cut.rawlog"), static_cast<std::uintmax_t>(share * static_cast<double>(size)));
    RawlogReader reader(in("cut.rawlog"));
    RecordedSteps steps(reader, robots_, 0.1);
    std::size_t complete_steps = 0;
    while (const auto step = steps.next()) {
      EXPECT_EQ((*step)[1].readings.measurements, written_[complete_steps][1].measurements);
      ++complete_steps;
    }
    // A step is known to be complete once the first observation of the next one was read.
    const auto left = unpackedSize(in("cut.rawlog"));
    const auto begun = static_cast<std::size_t>(std::lower_bound(begins.begin(), begins.end(), left) - begins.begin());
    EXPECT_GT(begun, 50 * share - 5) << share;
    EXPECT_GE(complete_steps + 2, begun) << share;
    EXPECT_LE(complete_steps + 1, begun) << share;
    ASSERT_TRUE(reader.readError());
    EXPECT_NE(reader.readError()->find("ends early"), std::string::npos) << *reader.readError();
    EXPECT_NE(reader.readError()->find("cut off"), std::string::npos) << *reader.readError();
  }
}

TEST_F(RecordedStepsTest, SeekToAnyStepReadBefore) {
  for (const RawlogFormat format : {RawlogFormat::observations, RawlogFormat::sensory_frames}) {
    const bool has_both = format == RawlogFormat::observations;
    written_.clear();
    record(50, format);
    RawlogReader reader(has_both ? file_ : in("run_b.rawlog"), RawlogReader::Access::random);
    RecordedSteps steps(reader, robots_, 0.1);
    std::vector<std::uint64_t> positions;
    do {
      positions.push_back(steps.position());
    } while (steps.next());
    EXPECT_EQ(positions.back(), RecordedSteps::kEnd);
    ASSERT_EQ(positions.size(), 51U);
    for (const std::size_t k : {49, 0, 20, 21, 3}) {
      steps.seek(positions[k]);
      const auto step = steps.next();
      ASSERT_TRUE(step) << k;
      EXPECT_EQ(step->front().is_missing, !has_both);
      if (has_both) {
        EXPECT_EQ(step->front().readings.measurements, written_[k].front().measurements) << k;
      }
      EXPECT_EQ(step->back().readings.measurements, written_[k].back().measurements) << k;
      EXPECT_EQ(step->back().readings.inbox, written_[k].back().inbox) << k;
      EXPECT_EQ(steps.position(), positions[k + 1]);
    }
  }
}

TEST_F(RecordedStepsTest, IndexStepsWithoutMeasurementsAndReadThemAfterwards) {
  record(20);
  RawlogReader reader(file_, RawlogReader::Access::random);
  RecordedSteps steps(reader, robots_, 0.1);
  std::vector<std::uint64_t> places;
  for (std::size_t k = 0; k < 20; ++k) {
    places.push_back(steps.position());
    const auto step = steps.nextWithoutMeasurements();
    ASSERT_TRUE(step) << k;
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ((*step)[i].world_from_robot->y, truth_[k][i].y);
      EXPECT_EQ((*step)[i].command, commands_[k][i]);
      EXPECT_EQ((*step)[i].readings.inbox, written_[k][i].inbox);
      EXPECT_EQ((*step)[i].readings.measurements.size(), written_[k][i].measurements.size());
    }
  }
  EXPECT_FALSE(steps.nextWithoutMeasurements());
  for (const std::size_t k : {std::size_t{7}, std::size_t{0}, std::size_t{19}}) {
    steps.seek(places[k]);
    const auto step = steps.next();
    ASSERT_TRUE(step) << k;
    EXPECT_EQ((*step)[1].readings.measurements, written_[k][1].measurements) << k;
  }
}

TEST_F(RecordedStepsTest, MarkRobotsWithoutObservationsAsAbsent) {
  record(2);
  RawlogReader reader(file_);
  robots_.push_back(sampleRobot("c"));
  RecordedSteps steps(reader, robots_, 0.1);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto step = steps.next();
    ASSERT_TRUE(step);
    EXPECT_FALSE((*step)[1].is_missing);
    EXPECT_EQ((*step)[1].readings.measurements, written_[k][1].measurements);
    const RecordedRobot& absent = (*step)[2];
    EXPECT_TRUE(absent.is_missing);
    EXPECT_FALSE(absent.world_from_robot);
    EXPECT_FALSE(absent.command);
    ASSERT_EQ(absent.readings.measurements.size(), robots_[2].sensors->size());
    EXPECT_EQ(absent.readings.measurements[0], Measurement(Echoes(16)));
  }
}

TEST_F(RecordedStepsTest, MarkTheOtherRobotsOfAFileOfPairsAsAbsent) {
  record(3, RawlogFormat::sensory_frames);
  RawlogReader reader(in("run_b.rawlog"));
  RecordedSteps steps(reader, robots_, 0.1);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto step = steps.next();
    ASSERT_TRUE(step);
    EXPECT_TRUE((*step)[0].is_missing);
    EXPECT_FALSE((*step)[1].is_missing);
    EXPECT_EQ((*step)[1].readings.measurements, written_[k][1].measurements);
  }
  EXPECT_FALSE(steps.next());
}

TEST_F(RecordedStepsTest, ReportOtherSensorsAndOtherRobots) {
  record(2);
  std::vector<SensorInfo> sensors = *robots_[1].sensors;
  sensors.push_back(plainSensor(SensorKind::heat, "another"));
  robots_[1].sensors = std::make_shared<const std::vector<SensorInfo>>(sensors);
  RawlogReader reader(file_);
  RecordedSteps steps(reader, robots_, 0.1);
  EXPECT_EQ(refusal(steps),
            "robot \"b\" is incomplete in step 0 of the recording; give the world that it was made with");
  RawlogReader again(file_);
  RecordedSteps others(again, {sampleRobot("c"), sampleRobot("d")}, 0.1);
  EXPECT_EQ(refusal(others), "none of these robots is in the recording; give the world that it was made with");
}

TEST_F(RecordedStepsTest, ReadWithoutImagesWhenTheirFolderIsMissing) {
  const std::vector<RobotInfo> seeing{seeingRobot("a")};
  RawlogWriter writer(file_, seeing, RawlogFormat::observations, RawlogImages::external);
  const std::vector<Readings> readings{sampleReadings(seeing[0], 0)};
  writer.write(readings, {});
  writer.close();
  std::filesystem::remove_all(in("run_Images"));
  RawlogReader reader(file_);
  RecordedSteps steps(reader, seeing, 0.1, Pictures::leave_out);
  const auto step = steps.next();
  ASSERT_TRUE(step);
  EXPECT_EQ((*step)[0].readings.measurements[0], readings[0].measurements[0]);
  EXPECT_EQ((*step)[0].readings.measurements[1], Measurement(Image{}));
  EXPECT_EQ((*step)[0].readings.measurements[2], readings[0].measurements[2]) << "blobs lie in the rawlog itself";
  RawlogReader again(file_);
  RecordedSteps with_pictures(again, seeing, 0.1);
  EXPECT_NE(refusal(with_pictures).find("is the folder of pictures beside the recording?"), std::string::npos);
}

TEST_F(RecordedStepsTest, ReadAFileOfPairs) {
  robots_ = {sampleRobot("a")};
  RawlogWriter writer(file_, robots_, RawlogFormat::sensory_frames, RawlogImages::embedded, "note");
  const std::vector<Readings> readings{withoutPictures(sampleReadings(robots_[0], 0))};
  const std::vector<Command> command{{0.5, 0, 0, Activity::active}};
  writer.write(readings, {}, command);
  writer.close();
  RawlogReader reader(file_);
  RecordedSteps steps(reader, robots_, 0.1);
  const auto step = steps.next();
  ASSERT_TRUE(step);
  EXPECT_EQ((*step)[0].readings.measurements, readings[0].measurements);
  EXPECT_EQ((*step)[0].command, command[0]);
  EXPECT_FALSE((*step)[0].world_from_robot);
}

std::string refusal(const std::filesystem::path& file) {
  try {
    RawlogReader reader(file);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "none";
}

TEST_F(RecordedStepsTest, RejectOtherFiles) {
  std::ofstream(file_) << "<world/>";
  EXPECT_NE(refusal(file_).find("is no MRPT rawlog"), std::string::npos);
  std::ofstream(file_, std::ios::trunc).close();
  EXPECT_NE(refusal(file_).find("is no MRPT rawlog"), std::string::npos);
  EXPECT_NE(refusal(folder_).find("is a directory"), std::string::npos);
  EXPECT_NE(refusal(in("none")).find("no such file"), std::string::npos);
}

TEST_F(RecordedStepsTest, ReportPositionAndCauseOfADamagedEntry) {
  ByteArchive archive;
  mrpt::obs::CObservationOdometry odometry;
  archive << odometry;
  const std::size_t first = archive.bytes.size();
  archive << odometry;
  archive.bytes[first + 20] ^= 0x55;  // in the second's class name
  std::ofstream(file_, std::ios::binary)
      .write(reinterpret_cast<const char*>(archive.bytes.data()), static_cast<std::streamsize>(archive.bytes.size()));
  RawlogReader reader(file_);
  EXPECT_TRUE(reader.next());
  EXPECT_FALSE(reader.next());
  ASSERT_TRUE(reader.readError());
  EXPECT_NE(reader.readError()->find("after 1 entry"), std::string::npos) << *reader.readError();
  EXPECT_NE(reader.readError()->find("the next entry cannot be read"), std::string::npos) << *reader.readError();
}

/// Fixture with a file of an odometry and a scan in which a size field is too large.
class DamagedCountTest : public RecordedStepsTest {
 protected:
  /// @param count bytes of the size field and of the data after it
  void write(const std::vector<std::uint8_t>& count, std::uint32_t damaged) {
    ByteArchive archive;
    mrpt::obs::CObservationOdometry odometry;
    odometry.sensorLabel = "WHEELS";
    archive << odometry;
    const std::size_t first = archive.bytes.size();
    mrpt::obs::CObservation2DRangeScan scan;
    scan.sensorLabel = "SCANNER";
    scan.resizeScanAndAssign(3, 4, true);
    archive << scan;
    const auto at = std::search(archive.bytes.begin() + static_cast<std::ptrdiff_t>(first), archive.bytes.end(),
                                count.begin(), count.end());
    ASSERT_NE(at, archive.bytes.end());
    std::memcpy(&*at, &damaged, sizeof damaged);
    std::ofstream(file_, std::ios::binary)
        .write(reinterpret_cast<const char*>(archive.bytes.data()), static_cast<std::streamsize>(archive.bytes.size()));
  }
  void expectRefusal();
};

void DamagedCountTest::expectRefusal() {
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  RawlogReader reader(file_);
  EXPECT_TRUE(reader.next());
  EXPECT_FALSE(reader.next());
  getrusage(RUSAGE_SELF, &after);
  ASSERT_TRUE(reader.readError());
  EXPECT_NE(reader.readError()->find("after 1 entry"), std::string::npos) << *reader.readError();
  EXPECT_NE(reader.readError()->find("the next entry requests more than 256 MiB; it is damaged"), std::string::npos)
      << *reader.readError();
  constexpr long kMiB_kib = 1024;
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, (MemoryBound::kBounds ? 100 : 2000) * kMiB_kib);
}

TEST_F(DamagedCountTest, RejectsTooLongLabelsWithoutAllocating) {
  write({7, 0, 0, 0, 'S', 'C'}, 768U << 20);
  expectRefusal();
}

TEST_F(DamagedCountTest, RejectsTooLargeScansWithoutAllocating) {
  write({3, 0, 0, 0, 0, 0, 0x80, 0x40}, 192U << 20);  // 3 ranges; 4 m
  expectRefusal();
}

TEST_F(DamagedCountTest, RereadsEntriesBeforeTheDamage) {
  write({7, 0, 0, 0, 'S', 'C'}, 768U << 20);
  RawlogReader reader(file_, RawlogReader::Access::random);
  ASSERT_TRUE(reader.next());
  const auto first = reader.position();
  EXPECT_FALSE(reader.next());
  EXPECT_TRUE(reader.readError());
  for (int i = 0; i < 2; ++i) {
    reader.seek(first);
    EXPECT_FALSE(reader.readError());
    const auto again = reader.next();
    ASSERT_TRUE(again);
    EXPECT_EQ(again->sensorLabel, "WHEELS");
    EXPECT_FALSE(reader.next());
    EXPECT_TRUE(reader.readError());
  }
}

TEST_F(RecordedStepsTest, ReadImagesOfTwoRecordingsConcurrently) {
  const std::vector<RobotInfo> seeing{seeingRobot("a")};
  std::vector<std::vector<Readings>> written;
  for (const std::uint64_t seed : {0, 100}) {
    RawlogWriter writer(in("run" + std::to_string(seed) + ".rawlog"), seeing, RawlogFormat::observations,
                        RawlogImages::external);
    written.push_back({sampleReadings(seeing[0], seed)});
    written.back()[0].time.step = 0;
    writer.write(written.back(), {});
    writer.close();
  }
  ASSERT_NE(written[0][0].measurements[1], written[1][0].measurements[1]);
  RawlogReader first(in("run0.rawlog")), second(in("run100.rawlog"));
  RecordedSteps first_steps(first, seeing, 0.1), second_steps(second, seeing, 0.1);
  EXPECT_EQ((*first_steps.next())[0].readings.measurements, written[0][0].measurements);
  EXPECT_EQ((*second_steps.next())[0].readings.measurements, written[1][0].measurements);
}

TEST_F(RecordedStepsTest, ReadUncompressedRawlogsOfOtherPrograms) {
  ByteArchive archive;
  mrpt::obs::CObservation2DRangeScan scan;
  scan.sensorLabel = "SICK";
  archive << scan;
  std::ofstream(file_, std::ios::binary)
      .write(reinterpret_cast<const char*>(archive.bytes.data()), static_cast<std::streamsize>(archive.bytes.size()));
  RawlogReader reader(file_);
  const auto read = reader.next();
  ASSERT_TRUE(read);
  EXPECT_EQ(read->sensorLabel, "SICK");
  EXPECT_FALSE(reader.next());
  EXPECT_FALSE(reader.readError());
}

}  // namespace
}  // namespace robosim
