// Camera pictures in recordings: embedded, or in files.
#include <fstream>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CRawlog.h>

#include "base/testing/file_size_limit.h"
#include "base/testing/test_folder.h"
#include "recording/measurements.h"
#include "recording/rawlog_writer.h"
#include "recording/recording_error.h"
#include "recording/testing/sample_robot.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;
using mrpt::obs::CRawlog;

using RawlogImagesTest = TestFolder;

CRawlog loadedRawlog(const fs::path& file) {
  CRawlog rawlog;
  EXPECT_TRUE(rawlog.loadFromRawLogFile(file.string()));
  return rawlog;
}

/// Two robots with cameras that take an image in every second of ten steps.
struct SeeingRun {
  std::vector<RobotInfo> robots{seeingRobot("robot 1"), seeingRobot("robot/1")};

  std::vector<Readings> readings(std::uint64_t step) const {
    std::vector<Readings> all;
    for (std::size_t i = 0; i < robots.size(); ++i) {
      all.push_back(sampleReadings(robots[i], 1000 * i + step));
      all.back().time = {step, 0.1};
    }
    return all;
  }
  void record(RawlogWriter& writer, std::uint64_t from = 0) const {
    for (std::uint64_t step = from; step < from + 10; ++step) writer.write(readings(step), {});
    writer.close();
  }
  const std::string& jpeg(std::size_t robot, std::uint64_t step) const {
    static std::vector<Readings> kept;
    kept = readings(step);
    return std::get<Image>(kept[robot].measurements[1]).jpeg;
  }
};

std::string bytesOf(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::set<std::string> namesIn(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

TEST_F(RawlogImagesTest, EmbedsImagesByDefault) {
  const SeeingRun run;
  RawlogWriter writer(in("run.rawlog"), run.robots);
  run.record(writer);
  EXPECT_EQ(filesInFolder(), std::set<std::string>{"run.rawlog"});
  CRawlog rawlog = loadedRawlog(in("run.rawlog"));
  int pictures = 0;
  for (std::size_t i = 0; i < rawlog.size(); ++i) {
    const auto seen = std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(rawlog.getAsObservation(i));
    if (!seen) continue;
    ++pictures;
    EXPECT_EQ(seen->image.getWidth(), 48u);
    EXPECT_EQ(seen->image.getHeight(), 32u);
  }
  EXPECT_EQ(pictures, 10);
}

TEST_F(RawlogImagesTest, WritesExternalImagesWhereMrptFindsThem) {
  const SeeingRun run;
  RawlogWriter writer(in("run.rawlog"), run.robots, RawlogFormat::observations, RawlogImages::external);
  run.record(writer);
  EXPECT_EQ(filesInFolder(), (std::set<std::string>{"run.rawlog", "run_Images"}));
  EXPECT_EQ(namesIn(in("run_Images")).size(), 10u);
  EXPECT_EQ(bytesOf(in("run_Images") / "robot_1_camera_00000004.jpg"), run.jpeg(0, 4));
  EXPECT_EQ(bytesOf(in("run_Images") / "robot_1_camera_2_00000004.jpg"), run.jpeg(1, 4));

  CRawlog rawlog = loadedRawlog(in("run.rawlog"));
  mrpt::img::CImage::setImagesPathBase(in("run_Images").string());  // as stock programs do
  std::size_t next[] = {0, 0};
  for (std::size_t i = 0; i < rawlog.size(); ++i) {
    const auto seen = std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(rawlog.getAsObservation(i));
    if (!seen) continue;
    const std::size_t robot = seen->sensorLabel == "robot 1/camera" ? 0 : 1;
    const std::uint64_t step = 2 * next[robot]++;
    EXPECT_EQ(std::get<Image>(measurementFrom(*seen, sampleCamera(), 0, in("run_Images"))).jpeg, run.jpeg(robot, step));
    EXPECT_EQ(seen->image.getWidth(), 48u);
  }
  EXPECT_EQ(next[0], 5u);
  EXPECT_EQ(next[1], 5u);
}

TEST_F(RawlogImagesTest, WritesAFolderOfImagesPerRobotWithFrames) {
  const SeeingRun run;
  RawlogWriter writer(in("run.rawlog"), run.robots, RawlogFormat::sensory_frames, RawlogImages::external);
  run.record(writer);
  EXPECT_EQ(filesInFolder(), (std::set<std::string>{"run_robot_1.rawlog", "run_robot_1_Images", "run_robot_1_2.rawlog",
                                                    "run_robot_1_2_Images"}));
  EXPECT_EQ(namesIn(in("run_robot_1_2_Images")).size(), 5u);
}

TEST_F(RawlogImagesTest, RemovesImagesOfUnclosedRecordingsAndEmptyFolders) {
  const SeeingRun run;
  {
    RawlogWriter writer(in("run.rawlog"), run.robots, RawlogFormat::observations, RawlogImages::external);
    for (std::uint64_t step = 0; step < 2000; ++step) writer.write(run.readings(step % 10), {});
    EXPECT_TRUE(fs::exists(in("run_Images.part")));
  }
  EXPECT_EQ(filesInFolder(), std::set<std::string>());
  const std::vector<RobotInfo> blind{sampleRobot("robot1")};
  RawlogWriter writer(in("blind.rawlog"), blind, RawlogFormat::observations, RawlogImages::external);
  const std::vector<Readings> readings{sampleReadings(blind[0], 0)};
  writer.write(readings, {});
  writer.close();
  EXPECT_EQ(filesInFolder(), std::set<std::string>{"blind.rawlog"});
}

TEST_F(RawlogImagesTest, ReplacesEarlierImagesOfTheSameNames) {
  const SeeingRun run;
  for (const std::uint64_t from : {0, 4}) {
    RawlogWriter writer(in("run.rawlog"), run.robots, RawlogFormat::observations, RawlogImages::external);
    run.record(writer, from);
  }
  EXPECT_EQ(filesInFolder(), (std::set<std::string>{"run.rawlog", "run_Images"}));
  EXPECT_EQ(namesIn(in("run_Images")).size(), 14u);
}

TEST_F(RawlogImagesTest, DoesNotCommitAnIncompleteRecording) {
  const SeeingRun run;
  RawlogWriter writer(in("run.rawlog"), run.robots, RawlogFormat::observations, RawlogImages::external);
  {
    const FileSizeLimit full(100);
    const auto write_on = [&] {
      for (std::uint64_t step = 0; step < 2000; ++step) writer.write(run.readings(step), {});
    };
    EXPECT_THROW(write_on(), RecordingError);
  }
  for (std::uint64_t step = 0; step < 10; ++step) writer.write(run.readings(step), {});  // the disk has space again
  EXPECT_THROW(writer.close(), RecordingError);
  EXPECT_FALSE(fs::exists(in("run.rawlog")));
}

TEST_F(RawlogImagesTest, ReplacesEarlierImagesOnlyAfterTheRawlogIsCommitted) {
  const SeeingRun run;
  fs::create_directories(in("run_Images"));
  std::ofstream(in("run_Images/robot_1_camera_00000004.jpg")) << "an earlier picture";
  RawlogWriter writer(in("run.rawlog"), run.robots, RawlogFormat::observations, RawlogImages::external);
  for (std::uint64_t step = 0; step < 10; ++step) writer.write(run.readings(step), {});
  fs::create_directories(in("run.rawlog"));  // a folder, which cannot be replaced
  EXPECT_THROW(writer.close(), RecordingError);
  EXPECT_EQ(bytesOf(in("run_Images/robot_1_camera_00000004.jpg")), "an earlier picture");
  EXPECT_EQ(namesIn(in("run_Images")).size(), 1u);
}

TEST_F(RawlogImagesTest, ReportsImagesThatCannotBeWritten) {
  const SeeingRun run;
  RawlogWriter writer(in("run.rawlog"), run.robots, RawlogFormat::observations, RawlogImages::external);
  const FileSizeLimit full(100);
  try {
    run.record(writer);
    FAIL() << "pictures on a full disk";
  } catch (const RecordingError& error) {
    EXPECT_EQ(error.what(), in("run_Images.part/robot_1_camera_00000000.jpg").string() +
                                ": the recording's pictures could not be written: File too large; free disk space, "
                                "or record elsewhere");
  }
}

}  // namespace
}  // namespace robosim
