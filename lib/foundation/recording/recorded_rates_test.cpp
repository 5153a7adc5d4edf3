// Recordings of sensors that do not measure in every step.
#include <cmath>

#include "recording/observations.h"
#include "recording/recorded_step.h"
#include "recording/testing/recorded_steps_test.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;

/// A sample robot whose scanner measures in the steps 0, 1, 5, 9, 13, …: 2.5 times per second, the first time at 0.1 s.
RobotInfo robotWithScanRate(const std::string& name) {
  RobotInfo robot = sampleRobot(name);
  std::vector<SensorInfo> sensors = *robot.sensors;
  sensors[1].times = {.rate_hz = 2.5, .phase_s = 0.1};
  robot.sensors = std::make_shared<const std::vector<SensorInfo>>(std::move(sensors));
  return robot;
}

class RecordedRates : public RecordedStepsTest {
 protected:
  RecordedRates() { robots_ = {robotWithScanRate("a"), sampleRobot("b")}; }

  /// Records steps in which the scanner of robot a keeps its reading between two scans.
  void recordRates(std::size_t from, std::size_t to, RawlogFormat format = RawlogFormat::observations) {
    RawlogWriter writer(file_, robots_, format);
    for (std::size_t step = from; step < to; ++step) {
      auto readings = readingsAt(step);
      const bool is_absent = step >= absent_from_ && step < absent_to_;
      auto& scan = readings[0].measurements[1];
      if (is_absent) {
        for (std::size_t slot = 0; slot < readings[0].measurements.size(); ++slot)
          readings[0].measurements[slot] = blankMeasurement((*robots_[0].sensors)[slot]);
      } else if (!written_.empty() && step > 0 && step % 4 != 1) {
        scan = written_.back()[0].measurements[1];
      }
      written_.push_back(readings);
      const std::vector<Command> commands{{0.1, 0, 0, is_absent ? Activity::absent : Activity::active}, {}};
      writer.write(readings, std::vector<TPose2D>(2), commands);
    }
    writer.close();
  }
  /// Steps with an observation of this label.
  std::vector<std::size_t> stepsOf(const std::string& label, const std::filesystem::path& file) {
    std::vector<std::size_t> steps;
    RawlogReader reader(file);
    while (const auto observation = reader.next()) {
      if (observation->sensorLabel != label) continue;
      steps.push_back(static_cast<std::size_t>(std::llround(secondsSinceStart(observation->timestamp) / 0.1)));
    }
    return steps;
  }
  void expectEveryReading(RecordedSteps& steps) {
    for (const auto& written : written_) {
      const auto step = steps.next();
      ASSERT_TRUE(step);
      EXPECT_EQ((*step)[0].readings.time.step, written[0].time.step);
      for (std::size_t i = 0; i < 2; ++i) {
        if ((*step)[i].is_missing) continue;
        EXPECT_EQ((*step)[i].readings.measurements, written[i].measurements) << i << ", step " << written[0].time.step;
      }
    }
    EXPECT_FALSE(steps.next());
  }

  std::size_t absent_from_ = 0, absent_to_ = 0;
};

TEST_F(RecordedRates, AreThoseOfTheMeasurements) {
  recordRates(0, 20);
  const std::vector<std::size_t> scans{0, 1, 5, 9, 13, 17};
  EXPECT_EQ(stepsOf("a/laser", file_), scans);
  EXPECT_EQ(stepsOf("a/laser/POINTS", file_), scans);
  EXPECT_EQ(stepsOf("a/sonar", file_).size(), 20u);
  EXPECT_EQ(stepsOf("b/laser", file_).size(), 20u);
  RawlogReader reader(file_);
  RecordedSteps steps(reader, robots_, 0.1);
  expectEveryReading(steps);
}

TEST_F(RecordedRates, AreThoseOfTheMeasurementsInPairs) {
  recordRates(0, 20, RawlogFormat::sensory_frames);
  EXPECT_EQ(stepsOf("a/laser", in("run_a.rawlog")), (std::vector<std::size_t>{0, 1, 5, 9, 13, 17}));
  RawlogReader reader(in("run_a.rawlog"));
  RecordedSteps steps(reader, robots_, 0.1);
  expectEveryReading(steps);
}

TEST_F(RecordedRates, KeepTheReadingWhenSeekingBetweenTwoScans) {
  recordRates(0, 20);
  RawlogReader reader(file_, RawlogReader::Access::random);
  RecordedSteps steps(reader, robots_, 0.1);
  std::vector<std::uint64_t> positions;
  do {
    positions.push_back(steps.position());
  } while (steps.next());
  for (const std::size_t k : {19, 3, 12, 0, 8, 9}) {
    steps.seek(positions[k]);
    EXPECT_EQ(steps.position(), positions[k]);
    const auto step = steps.next();
    ASSERT_TRUE(step) << k;
    EXPECT_EQ((*step)[0].readings.time.step, k);
    EXPECT_EQ((*step)[0].readings.measurements, written_[k][0].measurements) << k;
    EXPECT_EQ(steps.position(), positions[k + 1]);
  }
}

TEST_F(RecordedRates, BeginWithTheKeptReadingOfARecordingStartedBetweenTwoScans) {
  recordRates(7, 12);
  EXPECT_EQ(stepsOf("a/laser", file_), (std::vector<std::size_t>{7, 9}));
  RawlogReader reader(file_);
  RecordedSteps steps(reader, robots_, 0.1);
  expectEveryReading(steps);
}

TEST_F(RecordedRates, BeginAgainWithTheFirstScanOfARobotThatWasAbsent) {
  absent_from_ = 6;
  absent_to_ = 8;
  recordRates(0, 12);
  EXPECT_EQ(stepsOf("a/laser", file_), (std::vector<std::size_t>{0, 1, 5, 9}));
  RawlogReader reader(file_, RawlogReader::Access::random);
  RecordedSteps steps(reader, robots_, 0.1);
  expectEveryReading(steps);
}

TEST_F(RecordedRates, MayBeLowerThanThoseOfTheRecording) {
  robots_ = {sampleRobot("a"), sampleRobot("b")};  // repeats the kept scans
  recordRates(0, 8);
  EXPECT_EQ(stepsOf("a/laser", file_).size(), 8u);
  robots_[0] = robotWithScanRate("a");
  RawlogReader reader(file_);
  RecordedSteps steps(reader, robots_, 0.1);
  expectEveryReading(steps);
}

TEST_F(RecordedRates, MustBeThoseOfTheWorld) {
  recordRates(0, 8);
  robots_[0] = sampleRobot("a");  // a scan in every step
  RawlogReader reader(file_);
  RecordedSteps steps(reader, robots_, 0.1);
  EXPECT_TRUE(steps.next());
  EXPECT_TRUE(steps.next());
  EXPECT_EQ(refusal(steps),
            "robot \"a\" is incomplete in step 2 of the recording; give the world that it was made with");
}

}  // namespace
}  // namespace robosim
