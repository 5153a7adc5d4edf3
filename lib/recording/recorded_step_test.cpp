#include "recording/recorded_step.h"

#include <fstream>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>

#include "base/error_list.h"
#include "recording/byte_archive.h"
#include "recording/observations.h"
#include "recording/rawlog_writer.h"
#include "recording/recording_error.h"
#include "recording/sample_robot.h"
#include "recording/test_folder.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;

class RecordedStepsTest : public TestFolder {
 protected:
  /// Records steps of two robots, with mail and commands.
  void record(std::size_t steps, RawlogFormat format = RawlogFormat::observations) {
    RawlogWriter writer(file, robots, format, RawlogImages::embedded, "first note");
    for (std::size_t step = 0; step < steps; ++step) {
      written.push_back(readingsAt(step));
      truth.push_back({TPose2D(1, 0.1 * static_cast<double>(step), 0.25), TPose2D(2, 3, -1)});
      commands.push_back({{0.1, 0.2, 0.5F, Activity::active, step == 3}, {0.3, -0.4, 0, Activity::halted}});
      writer.write(written.back(), truth.back(), commands.back());
    }
    writer.close("last note");
  }

  std::vector<Readings> readingsAt(std::size_t step) const {
    std::vector<Readings> readings{withoutPictures(sampleReadings(robots[0], step)),
                                   withoutPictures(sampleReadings(robots[1], step + 1000))};
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

  std::filesystem::path file = in("run.rawlog");
  std::vector<RobotInfo> robots{sampleRobot("a"), sampleRobot("b")};
  std::vector<std::vector<Readings>> written;
  std::vector<std::vector<TPose2D>> truth;
  std::vector<std::vector<Command>> commands;
};

TEST_F(RecordedStepsTest, EveryReadingCommandAndMessageComesBackBitForBit) {
  record(50);
  RawlogReader reader(file);
  RecordedSteps steps(reader, robots, 0.1);
  EXPECT_EQ(steps.note(), "first note");
  for (std::size_t k = 0; k < 50; ++k) {
    const auto step = steps.next();
    ASSERT_TRUE(step) << k;
    ASSERT_EQ(step->size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      const RecordedRobot& read = (*step)[i];
      EXPECT_EQ(read.readings.time.step, k);
      EXPECT_EQ(read.readings.measurements, written[k][i].measurements) << "robot " << i << ", step " << k;
      EXPECT_EQ(read.readings.stalled, written[k][i].stalled);
      EXPECT_EQ(read.readings.laser_pan_rad, written[k][i].laser_pan_rad);
      EXPECT_EQ(read.readings.inbox, written[k][i].inbox);
      EXPECT_EQ(read.readings.is_too_far, written[k][i].is_too_far);
      EXPECT_EQ(read.readings.winner, written[k][i].winner);
      EXPECT_EQ(read.command, commands[k][i]);
      ASSERT_TRUE(read.world_from_robot);
      EXPECT_EQ(read.world_from_robot->y, truth[k][i].y);
      EXPECT_NEAR(read.world_from_robot->phi, truth[k][i].phi, 1e-15);
    }
  }
  EXPECT_FALSE(steps.next());
  EXPECT_FALSE(reader.trouble());
  EXPECT_EQ(steps.note(), "last note");
}

TEST_F(RecordedStepsTest, OfAFileThatIsCutOffAllWholeStepsComeBackAndTheRestIsTold) {
  record(50);
  const auto size = std::filesystem::file_size(file);
  for (const double share : {0.2, 0.5, 0.9, 0.999}) {
    std::filesystem::copy_file(file, in("cut.rawlog"), std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(in("cut.rawlog"), static_cast<std::uintmax_t>(share * static_cast<double>(size)));
    RawlogReader reader(in("cut.rawlog"));
    RecordedSteps steps(reader, robots, 0.1);
    std::size_t whole = 0;
    while (const auto step = steps.next()) {
      EXPECT_EQ((*step)[1].readings.measurements, written[whole][1].measurements);
      ++whole;
    }
    EXPECT_LT(whole, 50U + (share > 0.99 ? 1U : 0U)) << share;
    EXPECT_GT(whole, 50 * share - 30) << share;  // ISA-L's blocks
    ASSERT_TRUE(reader.trouble());
    EXPECT_NE(reader.trouble()->find("ends early"), std::string::npos) << *reader.trouble();
    EXPECT_NE(reader.trouble()->find("cut off"), std::string::npos) << *reader.trouble();
  }
}

TEST_F(RecordedStepsTest, ARobotThatTheRecordingDoesNotHaveIsTold) {
  record(2);
  RawlogReader reader(file);
  robots.push_back(sampleRobot("c"));
  RecordedSteps steps(reader, robots, 0.1);
  try {
    steps.next();
    FAIL();
  } catch (const RecordingError& error) {
    EXPECT_EQ(std::string(error.what()),
              "robot \"c\" is not whole in step 0 of the recording; give the world that it was made with");
  }
}

TEST_F(RecordedStepsTest, AFileOfPairsReadsBackToo) {
  robots = {sampleRobot("a")};
  RawlogWriter writer(file, robots, RawlogFormat::sensory_frames, RawlogImages::embedded, "note");
  const std::vector<Readings> readings{withoutPictures(sampleReadings(robots[0], 0))};
  const std::vector<Command> command{{0.5, 0, 0, Activity::active}};
  writer.write(readings, {}, command);
  writer.close();
  RawlogReader reader(file);
  RecordedSteps steps(reader, robots, 0.1);
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
  std::ofstream(file) << "<world/>";
  EXPECT_NE(refusal(file).find("is no MRPT rawlog"), std::string::npos);
  std::ofstream(file, std::ios::trunc).close();
  EXPECT_NE(refusal(file).find("is no MRPT rawlog"), std::string::npos);
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
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(archive.bytes.data()), static_cast<std::streamsize>(archive.bytes.size()));
  RawlogReader reader(file);
  EXPECT_TRUE(reader.next());
  EXPECT_FALSE(reader.next());
  ASSERT_TRUE(reader.trouble());
  EXPECT_NE(reader.trouble()->find("after 1 entry"), std::string::npos) << *reader.trouble();
  EXPECT_NE(reader.trouble()->find("the next entry cannot be read"), std::string::npos) << *reader.trouble();
}

TEST_F(RecordedStepsTest, AnUncompressedRawlogOfOthersIsReadAsWell) {
  ByteArchive archive;
  mrpt::obs::CObservation2DRangeScan scan;
  scan.sensorLabel = "SICK";
  archive << scan;
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(archive.bytes.data()), static_cast<std::streamsize>(archive.bytes.size()));
  RawlogReader reader(file);
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
