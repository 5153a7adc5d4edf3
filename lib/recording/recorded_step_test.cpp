#include "recording/recorded_step.h"

#include <cstring>
#include <fstream>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>

#include "base/error_list.h"
#include "base/test_folder.h"
#include "recording/byte_archive.h"
#include "recording/memory_bound.h"
#include "recording/observations.h"
#include "recording/rawlog_writer.h"
#include "recording/recording_error.h"
#include "recording/sample_robot.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;

class RecordedStepsTest : public TestFolder {
 protected:
  /// Records steps of two robots, with mail and commands.
  void record(std::size_t steps, RawlogFormat format = RawlogFormat::observations) {
    RawlogWriter writer(file_, robots_, format, RawlogImages::embedded, "first note");
    for (std::size_t step = 0; step < steps; ++step) {
      written_.push_back(readingsAt(step));
      truth_.push_back({TPose2D(1, 0.1 * static_cast<double>(step), 0.25), TPose2D(2, 3, -1)});
      commands_.push_back({{0.1, 0.2, 0.5F, Activity::active, step == 3}, {0.3, -0.4, 0, Activity::halted}});
      writer.write(written_.back(), truth_.back(), commands_.back());
    }
    writer.close("last note");
  }

  std::vector<Readings> readingsAt(std::size_t step) const {
    std::vector<Readings> readings{withoutPictures(sampleReadings(robots_[0], step)),
                                   withoutPictures(sampleReadings(robots_[1], step + 1000))};
    readings[1].time.step = step;
    readings[0].stalled = step % 3 == 0;
    readings[1].is_too_far = step == 7;
    if (step >= 40) readings[0].winner = readings[1].winner = "b";
    if (step % 4 == 1) readings[1].inbox = {{"a", "b", "GOLD"}, {"a", "b", std::string("\0\xff", 2)}};
    return readings;
  }
  /// A picture is compressed anew when it is read.
  Readings withoutPictures(Readings readings) const {
    for (auto& measurement : readings.measurements) {
      if (auto* image = std::get_if<Image>(&measurement)) *image = {};
    }
    return readings;
  }

  std::filesystem::path file_ = in("run.rawlog");
  std::vector<RobotInfo> robots_{sampleRobot("a"), sampleRobot("b")};
  std::vector<std::vector<Readings>> written_;
  std::vector<std::vector<TPose2D>> truth_;
  std::vector<std::vector<Command>> commands_;
};

TEST_F(RecordedStepsTest, EveryReadingCommandAndMessageComesBackBitForBit) {
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
  EXPECT_FALSE(reader.trouble());
  EXPECT_EQ(steps.note(), "last note");
}

TEST_F(RecordedStepsTest, OfAFileThatIsCutOffAllWholeStepsComeBackAndTheRestIsTold) {
  record(50);
  const auto size = std::filesystem::file_size(file_);
  for (const double share : {0.2, 0.5, 0.9, 0.999}) {
    std::filesystem::copy_file(file_, in("cut.rawlog"), std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(in("cut.rawlog"), static_cast<std::uintmax_t>(share * static_cast<double>(size)));
    RawlogReader reader(in("cut.rawlog"));
    RecordedSteps steps(reader, robots_, 0.1);
    std::size_t whole = 0;
    while (const auto step = steps.next()) {
      EXPECT_EQ((*step)[1].readings.measurements, written_[whole][1].measurements);
      ++whole;
    }
    EXPECT_LT(whole, 50U + (share > 0.99 ? 1U : 0U)) << share;
    EXPECT_GT(whole, 50 * share - 30) << share;  // ISA-L's blocks
    ASSERT_TRUE(reader.trouble());
    EXPECT_NE(reader.trouble()->find("ends early"), std::string::npos) << *reader.trouble();
    EXPECT_NE(reader.trouble()->find("cut off"), std::string::npos) << *reader.trouble();
  }
}

TEST_F(RecordedStepsTest, AnyStepThatWasReadCanBeReadAgain) {
  for (const RawlogFormat format : {RawlogFormat::observations, RawlogFormat::sensory_frames}) {
    const bool has_both = format == RawlogFormat::observations;
    written_.clear();
    record(50, format);
    RawlogReader reader(has_both ? file_ : in("run_b.rawlog"), RawlogReader::Places::keep);
    RecordedSteps steps(reader, robots_, 0.1);
    std::vector<std::uint64_t> places;
    do {
      places.push_back(steps.position());
    } while (steps.next());
    EXPECT_EQ(places.back(), RecordedSteps::kNowhere);
    ASSERT_EQ(places.size(), 51U);
    for (const std::size_t k : {49, 0, 20, 21, 3}) {
      steps.seek(places[k]);
      const auto step = steps.next();
      ASSERT_TRUE(step) << k;
      EXPECT_EQ(step->front().is_absent, !has_both);
      if (has_both) {
        EXPECT_EQ(step->front().readings.measurements, written_[k].front().measurements) << k;
      }
      EXPECT_EQ(step->back().readings.measurements, written_[k].back().measurements) << k;
      EXPECT_EQ(step->back().readings.inbox, written_[k].back().inbox) << k;
      EXPECT_EQ(steps.position(), places[k + 1]);
    }
  }
}

std::string refusal(RecordedSteps& steps) {
  try {
    steps.next();
  } catch (const RecordingError& error) {
    return error.what();
  }
  return "none";
}

TEST_F(RecordedStepsTest, ARobotThatTheRecordingKnowsNothingOfIsAbsentWithBlankMeasurements) {
  record(2);
  RawlogReader reader(file_);
  robots_.push_back(sampleRobot("c"));
  RecordedSteps steps(reader, robots_, 0.1);
  for (std::size_t k = 0; k < 2; ++k) {
    const auto step = steps.next();
    ASSERT_TRUE(step);
    EXPECT_FALSE((*step)[1].is_absent);
    EXPECT_EQ((*step)[1].readings.measurements, written_[k][1].measurements);
    const RecordedRobot& absent = (*step)[2];
    EXPECT_TRUE(absent.is_absent);
    EXPECT_FALSE(absent.world_from_robot);
    EXPECT_FALSE(absent.command);
    ASSERT_EQ(absent.readings.measurements.size(), robots_[2].sensors->size());
    EXPECT_EQ(absent.readings.measurements[0], Measurement(Echoes(16)));
  }
}

TEST_F(RecordedStepsTest, OfEachFileOfPairsTheOtherRobotsAreAbsent) {
  record(3, RawlogFormat::sensory_frames);
  RawlogReader reader(in("run_b.rawlog"));
  RecordedSteps steps(reader, robots_, 0.1);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto step = steps.next();
    ASSERT_TRUE(step);
    EXPECT_TRUE((*step)[0].is_absent);
    EXPECT_FALSE((*step)[1].is_absent);
    EXPECT_EQ((*step)[1].readings.measurements, written_[k][1].measurements);
  }
  EXPECT_FALSE(steps.next());
}

TEST_F(RecordedStepsTest, ARobotWithAnotherSensorAndAWorldOfOtherRobotsAreTold) {
  record(2);
  std::vector<SensorInfo> sensors = *robots_[1].sensors;
  sensors.push_back(plainSensor(SensorKind::heat, "another"));
  robots_[1].sensors = std::make_shared<const std::vector<SensorInfo>>(sensors);
  RawlogReader reader(file_);
  RecordedSteps steps(reader, robots_, 0.1);
  EXPECT_EQ(refusal(steps),
            "robot \"b\" is not whole in step 0 of the recording; give the world that it was made with");
  RawlogReader again(file_);
  RecordedSteps others(again, {sampleRobot("c"), sampleRobot("d")}, 0.1);
  EXPECT_EQ(refusal(others), "none of these robots is in the recording; give the world that it was made with");
}

TEST_F(RecordedStepsTest, WithoutItsFolderOfPicturesARecordingComesBackWithoutPictures) {
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

TEST_F(RecordedStepsTest, AFileOfPairsReadsBackToo) {
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

TEST_F(RecordedStepsTest, WhatIsNoRawlogIsRefused) {
  std::ofstream(file_) << "<world/>";
  EXPECT_NE(refusal(file_).find("is no MRPT rawlog"), std::string::npos);
  std::ofstream(file_, std::ios::trunc).close();
  EXPECT_NE(refusal(file_).find("is no MRPT rawlog"), std::string::npos);
  EXPECT_NE(refusal(folder_).find("is a folder"), std::string::npos);
  EXPECT_NE(refusal(in("none")).find("No such file"), std::string::npos);
}

TEST_F(RecordedStepsTest, ADamagedEntryEndsTheReadingWithAWordOnWhereAndWhy) {
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
  ASSERT_TRUE(reader.trouble());
  EXPECT_NE(reader.trouble()->find("after 1 entry"), std::string::npos) << *reader.trouble();
  EXPECT_NE(reader.trouble()->find("the next entry cannot be read"), std::string::npos) << *reader.trouble();
}

/// Has a file of an odometry and a scan, in which a number that says how much follows is too great.
class DamagedCountTest : public RecordedStepsTest {
 protected:
  /// @param count the bytes of the number, and of what follows it
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
  ASSERT_TRUE(reader.trouble());
  EXPECT_NE(reader.trouble()->find("after 1 entry"), std::string::npos) << *reader.trouble();
  EXPECT_NE(reader.trouble()->find("the next entry asks for more than 256 MiB; it is damaged"), std::string::npos)
      << *reader.trouble();
  constexpr long kMiB_kib = 1024;
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, (MemoryBound::kBounds ? 100 : 2000) * kMiB_kib);
}

TEST_F(DamagedCountTest, ALabelThatIsLongerThanAnyEndsTheReadingAndTakesNoMemory) {
  write({7, 0, 0, 0, 'S', 'C'}, 768U << 20);
  expectRefusal();
}

TEST_F(DamagedCountTest, AScanOfMoreRangesThanAnyEndsTheReadingAndTakesNoMemory) {
  write({3, 0, 0, 0, 0, 0, 0x80, 0x40}, 192U << 20);  // 3 ranges; 4 m
  expectRefusal();
}

TEST_F(RecordedStepsTest, AnUncompressedRawlogOfOthersIsReadAsWell) {
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
  EXPECT_EQ(partsOf("SICK").robot, "");
  EXPECT_EQ(partsOf("r1/sonar/POINTS").robot, "r1");
  EXPECT_EQ(partsOf("r1/sonar/POINTS").sensor, "sonar/POINTS");
  EXPECT_FALSE(reader.next());
  EXPECT_FALSE(reader.trouble());
}

}  // namespace
}  // namespace robosim
