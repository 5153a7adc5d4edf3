// Camera pictures in recordings: embedded, or in files.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CRawlog.h>

#include "base/testing/file_size_limit.h"
#include "base/testing/test_folder.h"
#include "hardware/camera_head.h"
#include "recording/byte_archive.h"
#include "recording/measurements.h"
#include "recording/observation_writer.h"
#include "recording/rawlog_reader.h"
#include "recording/rawlog_writer.h"
#include "recording/recorded_step.h"
#include "recording/recording_error.h"
#include "recording/testing/sample_robot.h"
#include "recording/unpacked_file.h"

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

TEST_F(RawlogImagesTest, RecordTheAimOfACameraOnAHead) {
  SensorInfo head = plainSensor(SensorKind::values, "ptz");
  head.quantities = CameraAim::quantities();
  SensorInfo camera = sampleCamera();
  camera.pans = true;
  RobotInfo robot;
  robot.name = "robot";
  robot.sensors = std::make_shared<const std::vector<SensorInfo>>(std::vector<SensorInfo>{head, camera});
  Readings readings;
  readings.time = {0, 0.1};
  readings.measurements = {CameraAim{0.5, 0.25, 3}.values(), Image{sampleJpeg(camera, 100)}};
  RawlogWriter writer(in("run.rawlog"), std::vector{robot});
  writer.write({&readings, 1}, {});
  writer.close();
  const CRawlog rawlog = loadedRawlog(in("run.rawlog"));
  const mrpt::obs::CObservationImage* seen = nullptr;
  for (std::size_t i = 0; i < rawlog.size(); ++i) {
    if (!seen) seen = dynamic_cast<const mrpt::obs::CObservationImage*>(rawlog.getAsObservation(i).get());
  }
  ASSERT_TRUE(seen);
  // As one that is mounted so, with a third of the field of view of 1.2 rad: MRPT's z axis is the optical axis.
  const mrpt::math::TPose3D pose = seen->cameraPose.asTPose();
  const auto axis = pose.composePoint(mrpt::math::TPoint3D(0, 0, 1)) - mrpt::math::TPoint3D(pose.x, pose.y, pose.z);
  EXPECT_NEAR(std::atan2(axis.y, axis.x), 0.1 + 0.5, 1e-9);
  EXPECT_NEAR(std::asin(axis.z), 0.25, 1e-9);
  EXPECT_NEAR(seen->cameraParams.fx(), 24 / std::tan(0.2), 1e-9);
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

/// Fixture with an uncompressed recording of a SeeingRun in which bytes can be damaged.
class DamagedPictureTest : public TestFolder {
 protected:
  DamagedPictureTest() {
    RawlogWriter writer(in("run.rawlog"), run_.robots);
    run_.record(writer);
    UnpackedFile unpacked(in("run.rawlog"));
    bytes_.resize(1 << 20);
    bytes_.resize(unpacked.read(bytes_.data(), bytes_.size()));
  }

  /// Position of a picture of the first robot.
  std::size_t pictureAt(std::uint64_t step) const {
    const std::size_t at = bytes_.find(run_.jpeg(0, step));
    EXPECT_NE(at, std::string::npos);
    return at;
  }
  fs::path write() const {
    std::ofstream(in("damaged.rawlog"), std::ios::binary) << bytes_;
    return in("damaged.rawlog");
  }

  SeeingRun run_;
  std::string bytes_;
};

/// Labels of all observations that can be read.
std::multiset<std::string> labelsIn(RawlogReader& reader) {
  std::multiset<std::string> labels;
  while (const auto observation = reader.next()) labels.insert(observation->sensorLabel);
  return labels;
}

TEST_F(DamagedPictureTest, IsLeftOutAndAllOtherEntriesAreRead) {
  RawlogReader whole(in("run.rawlog"));
  auto expected = labelsIn(whole);
  EXPECT_FALSE(whole.isDamaged());
  ASSERT_EQ(expected.count("robot 1/camera"), 5u);
  expected.erase(expected.find("robot 1/camera"));
  bytes_[pictureAt(4)] = 'G';
  RawlogReader reader(write());
  EXPECT_EQ(labelsIn(reader), expected);
  EXPECT_TRUE(reader.isDamaged());
  EXPECT_FALSE(reader.endsEarly());
  const std::string error = reader.readError().value_or("none");
  EXPECT_EQ(error.rfind(in("damaged.rawlog").string() + ": a picture is damaged and left out, in entry ", 0), 0u)
      << error;
  EXPECT_NE(error.find("Not a JPEG file: starts with 0x47 0xd8"), std::string::npos) << error;
}

TEST_F(DamagedPictureTest, IsCounted) {
  for (const std::uint64_t step : {2, 4, 8}) bytes_[pictureAt(step)] = 'G';
  RawlogReader reader(write());
  EXPECT_EQ(labelsIn(reader).count("robot 1/camera"), 2u);
  const std::string error = reader.readError().value_or("none");
  EXPECT_NE(error.find(": 3 pictures are damaged and left out, the first in entry "), std::string::npos) << error;
}

TEST_F(DamagedPictureTest, IsBlankInRecordedSteps) {
  bytes_[pictureAt(4)] = 'G';
  RawlogReader reader(write());
  RecordedSteps steps(reader, run_.robots, 0.1);
  std::vector<bool> has_picture;
  while (const auto step = steps.next()) {
    has_picture.push_back(!std::get<Image>((*step)[0].readings.measurements[1]).jpeg.empty());
  }
  EXPECT_EQ(has_picture, (std::vector<bool>{true, false, true, false, false, false, true, false, true, false}));
}

TEST_F(DamagedPictureTest, NeverEndsTheProcess) {
  // Every byte of a picture and of the fields before it, among them its size and those of the class CImage.
  const std::size_t begin = pictureAt(4) - 60, end = pictureAt(4) + run_.jpeg(0, 4).size();
  for (std::size_t at = begin; at < end; ++at) {
    const char before = bytes_[at];
    for (const char flip : {'\x01', '\xff'}) {
      bytes_[at] = static_cast<char>(before ^ flip);
      RawlogReader reader(write());
      EXPECT_GE(labelsIn(reader).count("robot 1/camera"), 2u) << at - begin;
    }
    bytes_[at] = before;
  }
}

TEST_F(DamagedPictureTest, InAFileOfItsOwnIsReportedWithItsName) {
  fs::create_directories(in("run_Images"));
  std::ofstream(in("run_Images/a.jpg")) << "GIF89a";
  mrpt::obs::CObservationImage observation;
  observation.image.setExternalStorage("a.jpg");
  const std::string expected =
      in("run_Images/a.jpg").string() + ": is a damaged JPEG file, or none: Not a JPEG file: starts with 0x47 0x49";
  const auto error_of = [](const auto& function) -> std::string {
    try {
      function();
    } catch (const RecordingError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(error_of([&] { measurementFrom(observation, sampleCamera(), 0, in("run_Images")); }), expected);
  ObservationWriter writer(in("part.rawlog"), in("run_Images"));
  EXPECT_EQ(error_of([&] { writer.write(observation); }), expected);
}

/// A rawlog of one gray picture, whose size is stated wrongly.
TEST_F(RawlogImagesTest, RejectsMorePixelsThanThePictureHas) {
  mrpt::obs::CObservationImage observation;
  observation.image.resize(40, 30, mrpt::img::CH_GRAY);
  ByteArchive archive;
  archive << observation;
  const std::uint8_t sizes[] = {40, 0, 0, 0, 30, 0, 0, 0};
  const auto at = std::search(archive.bytes.begin(), archive.bytes.end(), std::begin(sizes), std::end(sizes));
  ASSERT_NE(at, archive.bytes.end());
  const auto write = [&] {
    std::ofstream(in("gray.rawlog"), std::ios::binary)
        .write(reinterpret_cast<const char*>(archive.bytes.data()), static_cast<std::streamsize>(archive.bytes.size()));
  };
  write();
  RawlogReader whole(in("gray.rawlog"));
  EXPECT_TRUE(whole.next());
  *(at + 4) = 1;  // rows
  write();
  RawlogReader reader(in("gray.rawlog"));
  EXPECT_FALSE(reader.next());
  EXPECT_NE(reader.readError().value_or("").find("a picture has more bytes than pixels"), std::string::npos);
}

}  // namespace
}  // namespace robosim
