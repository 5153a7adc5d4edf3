#include "recording/remarks.h"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationRawDAQ.h>
#include <mrpt/obs/CRawlog.h>

#include "recording/observations.h"
#include "recording/rawlog_writer.h"
#include "recording/sample_robot.h"
#include "recording/test_folder.h"

namespace robosim {
namespace {

using mrpt::obs::CObservationRawDAQ;
using mrpt::obs::CRawlog;

constexpr Command kDriven{.speed_mps = 0.5, .turn_radps = -0.25, .laser_pan_rad = 0.125f, .by_driver = true};

Readings readingsAt(std::uint64_t step) {
  Readings readings;
  readings.time = {step, 0.1};
  return readings;
}

std::vector<std::uint8_t> outputsOf(const mrpt::obs::CObservation::Ptr& remark) {
  return remark ? dynamic_cast<const CObservationRawDAQ&>(*remark).DOUT : std::vector<std::uint8_t>{};
}

TEST(Remarks, TellADriversCommandWheneverItChangesAndWhenTheControllerHasTheRobotAgain) {
  Remarks remarks("robot1");
  EXPECT_FALSE(remarks.of(readingsAt(0), {.speed_mps = 1})) << "its controller's";
  const auto first = remarks.of(readingsAt(1), kDriven);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->sensorLabel, "robot1/DRIVER");
  EXPECT_EQ(first->timestamp, timestampOf({1, 0.1}));
  EXPECT_EQ(dynamic_cast<const CObservationRawDAQ&>(*first).AOUT_double, (std::vector<double>{0.5, -0.25, 0.125}));
  EXPECT_EQ(outputsOf(first), std::vector<std::uint8_t>{1});

  EXPECT_FALSE(remarks.of(readingsAt(2), kDriven)) << "the same again";
  EXPECT_EQ(outputsOf(remarks.of(readingsAt(3), {.speed_mps = 0.3})), std::vector<std::uint8_t>{0});
  EXPECT_FALSE(remarks.of(readingsAt(4), {.speed_mps = 0.4}));
}

TEST(Remarks, TellThatADriverAskedInVainWhetherTheRobotHasWon) {
  Remarks remarks("robot1");
  Readings too_far = readingsAt(1);
  too_far.is_too_far = true;
  EXPECT_EQ(outputsOf(remarks.of(too_far, kDriven)), std::vector<std::uint8_t>{3});
}

TEST(Remarks, TellThatThisRobotHasWonAndNothingOfAnother) {
  Remarks remarks("robot1"), others("robot2");
  Readings won = readingsAt(1);
  won.winner = "robot1";
  EXPECT_FALSE(others.of(won, {}));
  EXPECT_EQ(outputsOf(remarks.of(won, kDriven)), std::vector<std::uint8_t>{5});
}

using RemarksInARecording = TestFolder;

TEST_F(RemarksInARecording, ComeBackFromEitherFormAndItsCommentNamesTheWinner) {
  const RobotInfo robot = sampleRobot("robot1");
  for (const auto format : {RawlogFormat::observations, RawlogFormat::sensory_frames}) {
    RawlogWriter writer(in("run.rawlog"), std::span(&robot, 1), format);
    for (std::uint64_t step = 0; step < 3; ++step) {
      Readings readings = sampleReadings(robot, step);
      if (step == 2) readings.winner = "robot1";
      writer.write(std::span(&readings, 1), {}, std::span(&kDriven, 1));
    }
    writer.close();

    CRawlog rawlog;
    ASSERT_TRUE(rawlog.loadFromRawLogFile(in("run.rawlog").string()));
    EXPECT_EQ(rawlog.getCommentText(), "[run]\nwinner = robot1\n");
    std::vector<std::uint8_t> outputs;
    const auto note = [&](const mrpt::obs::CObservation::Ptr& observation) {
      if (observation->sensorLabel == "robot1/DRIVER") outputs.push_back(outputsOf(observation).at(0));
    };
    for (std::size_t i = 0; i < rawlog.size(); ++i) {
      if (rawlog.getType(i) == CRawlog::etObservation) note(rawlog.getAsObservation(i));
      if (rawlog.getType(i) != CRawlog::etSensoryFrame) continue;
      for (const auto& observation : *rawlog.getAsObservations(i)) note(observation);
    }
    EXPECT_EQ(outputs, (std::vector<std::uint8_t>{1, 5}));
  }
}

}  // namespace
}  // namespace robosim
