#include "recording/rawlog_writer.h"

#include <algorithm>
#include <fstream>
#include <memory>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CRawlog.h>

#include "base/error_list.h"
#include "base/testing/file_size_limit.h"
#include "base/testing/test_folder.h"
#include "recording/measurements.h"
#include "recording/observations.h"
#include "recording/recording_error.h"
#include "recording/testing/sample_robot.h"

namespace robosim {
namespace {

namespace fs = std::filesystem;
using mrpt::math::TPose2D;
using mrpt::obs::CRawlog;

using RawlogWriterTest = TestFolder;

struct SampleRun {
  explicit SampleRun(const std::vector<std::string>& names) {
    for (const auto& name : names) robots.push_back(sampleRobot(name));
  }

  std::vector<Readings> readings(std::uint64_t step) const {
    std::vector<Readings> all;
    for (std::size_t i = 0; i < robots.size(); ++i) {
      all.push_back(sampleReadings(robots[i], 1000 * i + step));
      all.back().time = {step, 0.1};
    }
    return all;
  }

  std::vector<TPose2D> truth(std::uint64_t step) const {
    std::vector<TPose2D> all;
    for (std::size_t i = 0; i < robots.size(); ++i) all.emplace_back(0.1 * static_cast<double>(step), i, 0.5);
    return all;
  }

  void record(RawlogWriter& writer, std::uint64_t steps) const {
    for (std::uint64_t step = 0; step < steps; ++step) writer.write(readings(step), truth(step));
    writer.close();
  }

  std::vector<RobotInfo> robots;
};

CRawlog loaded(const fs::path& file) {
  CRawlog rawlog;
  EXPECT_TRUE(rawlog.loadFromRawLogFile(file.string()));
  return rawlog;
}

TEST_F(RawlogWriterTest, IsReadableByMrptWithEveryReadingInOrder) {
  const SampleRun run({"robot1", "robot2"});
  RawlogWriter writer(in("run.rawlog"), run.robots);
  run.record(writer, 50);

  CRawlog rawlog = loaded(in("run.rawlog"));
  const std::size_t sensors = run.robots[0].sensors->size();
  ASSERT_EQ(rawlog.size(), 50 * 2 * (1 + sensors));
  std::size_t entry = 0;
  for (std::uint64_t step = 0; step < 50; ++step) {
    const auto readings = run.readings(step);
    for (std::size_t r = 0; r < 2; ++r) {
      RobotObservations expected(run.robots[r]);
      for (const auto& observation : expected.of(readings[r], run.truth(step)[r])) {
        const auto read = rawlog.getAsObservation(entry++);
        ASSERT_EQ(read->sensorLabel, observation->sensorLabel);
        EXPECT_EQ(read->timestamp, observation->timestamp);
        for (std::size_t slot = 0; slot < sensors; ++slot) {
          const SensorInfo& sensor = (*run.robots[r].sensors)[slot];
          if (read->sensorLabel != Label{run.robots[r].name, sensor.label, ""}.text()) continue;
          expectSameReading(measurementFrom(*read, sensor, readings[r].laser_pan_rad), readings[r].measurements[slot],
                            read->sensorLabel);
        }
      }
    }
  }
}

TEST_F(RawlogWriterTest, WritesEveryStepOnceInManyBatches) {
  const std::vector<std::string> names{"robot1", "robot2", "robot3", "robot4"};
  for (const std::size_t robots : {1, 2, 4}) {
    const SampleRun run({names.begin(), names.begin() + static_cast<std::ptrdiff_t>(robots)});
    RawlogWriter writer(in("run.rawlog"), run.robots);
    run.record(writer, 1300);
    CRawlog rawlog = loaded(in("run.rawlog"));
    const std::size_t a_step = robots * (1 + run.robots[0].sensors->size());
    ASSERT_EQ(rawlog.size(), 1300 * a_step);
    for (std::size_t entry = 0; entry < rawlog.size(); ++entry) {
      ASSERT_EQ(rawlog.getAsObservation(entry)->timestamp, toTimestamp({entry / a_step, 0.1})) << "entry " << entry;
    }
  }
}

TEST_F(RawlogWriterTest, KeepsExactPicturesOfTwoBatchesOnly) {
  // 2^20 depths are 4 MiB, and a batch ends at 32 MiB: 8 steps wait, and 8 are written.
  SensorInfo camera = sampleCamera();
  camera.camera.width_px = 2048;
  camera.camera.height_px = 512;
  camera.camera.layers = {false, true, false};
  camera.range_max_m = 5;
  RobotInfo robot;
  robot.name = "A";
  robot.sensors = std::make_shared<const std::vector<SensorInfo>>(std::vector<SensorInfo>{camera});
  RawlogWriter writer(folder_ / "pictures.rawlog", {&robot, 1});
  std::vector<std::weak_ptr<const RawPicture>> pictures;
  const auto alive = [&] {
    return std::count_if(pictures.begin(), pictures.end(), [](const auto& picture) { return !picture.expired(); });
  };
  for (std::uint64_t step = 0; step < 20; ++step) {
    RawPicture raw{2048, 512, 5, {}, {}, {}};
    raw.depth_m.resize(raw.pixels());
    Readings readings;
    readings.time = {step, 0.1};
    const auto picture = std::make_shared<const RawPicture>(std::move(raw));
    pictures.push_back(picture);
    readings.measurements = {Image{"", picture}};
    writer.write({&readings, 1}, {});
    ASSERT_LE(alive(), 16 + 1) << step << ", with that of the loop";
  }
  writer.close();
  EXPECT_EQ(alive(), 0);
  EXPECT_EQ(loaded(folder_ / "pictures.rawlog").size(), 20u);
}

TEST_F(RawlogWriterTest, KeepsTheGroundTruthOfEachRobot) {
  const SampleRun run({"robot1", "robot2"});
  RawlogWriter writer(in("run.rawlog"), run.robots);
  run.record(writer, 11);
  CRawlog rawlog = loaded(in("run.rawlog"));
  const auto last = rawlog.getAsObservation(rawlog.size() - 1 - run.robots[1].sensors->size());
  ASSERT_EQ(last->sensorLabel, "robot2/GROUND_TRUTH");
  const auto& pose = dynamic_cast<const mrpt::obs::CObservationRobotPose&>(*last).pose.mean;
  EXPECT_EQ(pose.x(), 1);
  EXPECT_EQ(pose.y(), 1);
  EXPECT_NEAR(pose.yaw(), 0.5, 1e-12);
}

TEST_F(RawlogWriterTest, RecordsRobotsWithoutGroundTruth) {
  const SampleRun run({"robot1"});
  RawlogWriter writer(in("run.rawlog"), run.robots);
  writer.write(run.readings(0), {});
  writer.close();
  CRawlog rawlog = loaded(in("run.rawlog"));
  ASSERT_EQ(rawlog.size(), run.robots[0].sensors->size());
  EXPECT_EQ(rawlog.getAsObservation(1)->sensorLabel, "robot1/sonar");
}

TEST_F(RawlogWriterTest, WritesEqualFilesForEqualRuns) {
  const SampleRun run({"robot1"});
  for (const char* name : {"a.rawlog", "b.rawlog"}) {
    RawlogWriter writer(in(name), run.robots);
    run.record(writer, 20);
  }
  const auto bytes = [&](const char* name) {
    std::ifstream file(in(name), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(bytes("a.rawlog"), bytes("b.rawlog"));
}

TEST_F(RawlogWriterTest, WritesFilesThatAreReadableWhenTruncated) {
  const SampleRun run({"robot1"});
  RawlogWriter writer(in("run.rawlog"), run.robots);
  run.record(writer, 1300);
  const CRawlog complete = loaded(in("run.rawlog"));
  fs::resize_file(in("run.rawlog"), fs::file_size(in("run.rawlog")) / 2);

  CRawlog half;
  half.loadFromRawLogFile(in("run.rawlog").string());
  EXPECT_GT(half.size(), complete.size() / 3);
  EXPECT_LT(half.size(), complete.size() * 2 / 3);
  for (std::size_t i = 0; i < half.size(); ++i) {
    ASSERT_EQ(half.getAsObservation(i)->asString(), complete.getAsObservation(i)->asString());
  }
}

TEST_F(RawlogWriterTest, LeavesAReadablePartWhenKilled) {
  const SampleRun run({"robot1"});
  RawlogWriter writer(in("run.rawlog"), run.robots);
  for (std::uint64_t step = 0; step < 5000; ++step) writer.write(run.readings(step), run.truth(step));
  fs::copy_file(in("run.rawlog.part"), in("left.rawlog"));
  CRawlog left;
  left.loadFromRawLogFile(in("left.rawlog").string());
  // Up to two batches of 512 steps, and some 120 steps more inside the compressor, were still in memory.
  EXPECT_GT(left.size(), 3850 * (1 + run.robots[0].sensors->size()));
}

TEST_F(RawlogWriterTest, DiscardsARecordingThatIsNotClosed) {
  const SampleRun run({"robot1"});
  { RawlogWriter(in("run.rawlog"), run.robots).write(run.readings(0), run.truth(0)); }
  EXPECT_EQ(filesInFolder(), std::set<std::string>());
}

/// Records until an error is thrown, at the latest by close().
std::string errorOf(RawlogWriter& writer, const SampleRun& run, std::uint64_t steps) {
  try {
    run.record(writer, steps);
  } catch (const RecordingError& error) {
    return error.what();
  }
  return "none";
}

TEST_F(RawlogWriterTest, FailsOnAFullDiskDuringALongRecording) {
  std::ofstream(in("run.rawlog")) << "the recording before";
  const SampleRun run({"robot1"});
  RawlogWriter writer(in("run.rawlog"), run.robots);
  const FileSizeLimit full(100'000);
  EXPECT_THROW(for (std::uint64_t step = 0; step < 5000; ++step) writer.write(run.readings(step), run.truth(step)),
               RecordingError);
  EXPECT_NO_THROW(writer.write(run.readings(0), run.truth(0)));  // still buffered in memory
  EXPECT_THROW(writer.close(), RecordingError);
  EXPECT_EQ(filesInFolder(), std::set<std::string>{"run.rawlog"});
  EXPECT_EQ(fs::file_size(in("run.rawlog")), std::string("the recording before").size());
}

TEST_F(RawlogWriterTest, FailsOnAFullDiskInCloseOfAShortRecording) {
  std::ofstream(in("run.rawlog")) << "the recording before";
  const SampleRun run({"robot1", "robot2"});
  RawlogWriter writer(in("run.rawlog"), run.robots);
  const FileSizeLimit full(1000);
  EXPECT_NE(errorOf(writer, run, 10).find("run.rawlog: the recording could not be written: File too large"),
            std::string::npos);
  EXPECT_EQ(filesInFolder(), std::set<std::string>{"run.rawlog"});
  EXPECT_EQ(fs::file_size(in("run.rawlog")), std::string("the recording before").size());
}

// Actions and sensory frames

TEST_F(RawlogWriterTest, PairsAnActionWithTheFrameOfTheFollowingMeasurements) {
  const SampleRun run({"robot1"});
  RawlogWriter writer(in("run.rawlog"), run.robots, RawlogFormat::sensory_frames);
  run.record(writer, 10);
  EXPECT_EQ(writer.files(), std::vector<fs::path>{in("run.rawlog")});

  CRawlog rawlog = loaded(in("run.rawlog"));
  ASSERT_EQ(rawlog.size(), 20u);
  for (std::uint64_t step = 0; step < 10; ++step) {
    EXPECT_EQ(rawlog.getType(2 * step), CRawlog::etActionCollection);
    const auto frame = rawlog.getAsObservations(2 * step + 1);
    ASSERT_EQ(frame->size(), 1 + run.robots[0].sensors->size());
    EXPECT_EQ(frame->getObservationByIndex(0)->sensorLabel, "robot1/GROUND_TRUTH");
    const auto readings = run.readings(step)[0];
    const auto& odometry_info = (*run.robots[0].sensors)[6];
    ASSERT_EQ(odometry_info.kind, SensorKind::odometry);
    EXPECT_EQ(measurementFrom(*frame->getObservationByIndex(1), odometry_info, 0), readings.measurements[6]);
  }
}

TEST_F(RawlogWriterTest, WritesActionsAsOdometryIncrementsInTheRobotsFrame) {
  RobotInfo robot;
  robot.name = "robot1";
  robot.sensors = std::make_shared<const std::vector<SensorInfo>>(
      std::vector<SensorInfo>{plainSensor(SensorKind::odometry, "odometry")});
  RawlogWriter writer(in("run.rawlog"), std::span(&robot, 1), RawlogFormat::sensory_frames);
  // The robot starts at (1, 1) facing y, drives 0.2 m ahead, then turns left by 0.1.
  std::vector<Readings> step(1);
  for (const TPose2D& odom_from_robot :
       {TPose2D(1, 1, M_PI / 2), TPose2D(1, 1.2, M_PI / 2), TPose2D(1, 1.2, M_PI / 2 + 0.1)}) {
    step[0].measurements = {Odometry{odom_from_robot, 0, 0}};
    writer.write(step, {});
    ++step[0].time.step;
  }
  writer.close();

  CRawlog rawlog = loaded(in("run.rawlog"));
  const auto increment = [&](std::size_t i) {
    const auto action = rawlog.getAsAction(2 * i)->getActionByClass<mrpt::obs::CActionRobotMovement2D>();
    EXPECT_EQ(action->timestamp, toTimestamp({i, 0.1}));
    EXPECT_EQ(action->estimationMethod, mrpt::obs::CActionRobotMovement2D::emOdometry);
    EXPECT_NEAR(action->poseChange->getMeanVal().distanceTo(action->rawOdometryIncrementReading), 0, 1e-12);
    return action->rawOdometryIncrementReading.asTPose();
  };
  const auto expect_near = [](const TPose2D& pose, const TPose2D& expected) {
    EXPECT_NEAR(pose.x, expected.x, 1e-12);
    EXPECT_NEAR(pose.y, expected.y, 1e-12);
    EXPECT_NEAR(pose.phi, expected.phi, 1e-12);
  };
  expect_near(increment(0), {0, 0, 0});
  expect_near(increment(1), {0.2, 0, 0});
  expect_near(increment(2), {0, 0, 0.1});
}

TEST_F(RawlogWriterTest, WritesAFileOfFramesPerRobot) {
  const SampleRun run({"robot1", "robot2"});
  RawlogWriter writer(in("run.rawlog"), run.robots, RawlogFormat::sensory_frames);
  run.record(writer, 3);
  EXPECT_EQ(writer.files(), (std::vector<fs::path>{in("run_robot1.rawlog"), in("run_robot2.rawlog")}));
  EXPECT_EQ(filesInFolder(), (std::set<std::string>{"run_robot1.rawlog", "run_robot2.rawlog"}));
  EXPECT_EQ(loaded(in("run_robot2.rawlog")).getAsObservations(1)->getObservationByIndex(0)->sensorLabel,
            "robot2/GROUND_TRUTH");
}

TEST_F(RawlogWriterTest, WritesUniqueFilesForRobotsWithInvalidFileNames) {
  const SampleRun run({"../a b", "../a_b", "a/b", ".._a_b_2"});
  RawlogWriter writer(in("run.rawlog"), run.robots, RawlogFormat::sensory_frames);
  run.record(writer, 1);
  EXPECT_EQ(filesInFolder(), (std::set<std::string>{"run_.._a_b.rawlog", "run_.._a_b_2.rawlog", "run_a_b.rawlog",
                                                    "run_.._a_b_2_4.rawlog"}));
}

TEST_F(RawlogWriterTest, RejectsActionsOfARobotWithoutOdometry) {
  RobotInfo robot;
  robot.name = "robot1";
  robot.sensors = std::make_shared<const std::vector<SensorInfo>>();
  try {
    const RawlogWriter refused(in("run.rawlog"), std::span(&robot, 1), RawlogFormat::sensory_frames);
    FAIL() << "actions of a robot without odometry";
  } catch (const ConfigError& error) {
    EXPECT_EQ(error.what(),
              in("run.rawlog").string() +
                  ": robot \"robot1\" has no odometry, which a recording of actions and sensory frames is made "
                  "from; give it one, or record observations only");
  }
  EXPECT_EQ(filesInFolder(), std::set<std::string>());
}

}  // namespace
}  // namespace robosim
