#include "recording/observation_times.h"

#include <chrono>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationComment.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/system/datetime.h>

#include "base/testing/test_folder.h"
#include "recording/byte_archive.h"
#include "recording/rawlog_reader.h"

namespace robosim {
namespace {

mrpt::obs::CObservationOdometry madeAt(mrpt::Clock::time_point time) {
  mrpt::obs::CObservationOdometry odometry;
  odometry.timestamp = time;
  return odometry;
}

mrpt::Clock::time_point unixTime(double time_s) { return mrpt::Clock::fromDouble(time_s); }

TEST(ObservationTimes, AreRelativeToTheFirstObservationAndMayBeNegative) {
  ObservationTimes times;
  EXPECT_EQ(times.of(madeAt(unixTime(1.2e9)), 1), 0);
  EXPECT_DOUBLE_EQ(times.of(madeAt(unixTime(1.2e9 + 2.5)), 2), 2.5);
  EXPECT_DOUBLE_EQ(times.of(madeAt(unixTime(1.2e9 - 1)), 3), -1);
}

TEST(ObservationTimes, UseThePreviousTimeWithoutATimestamp) {
  ObservationTimes times;
  times.of(madeAt(unixTime(1.2e9)), 1);
  times.of(madeAt(unixTime(1.2e9 + 3)), 2);
  EXPECT_DOUBLE_EQ(times.of(madeAt(INVALID_TIMESTAMP), 3), 3);
  EXPECT_DOUBLE_EQ(times.of(madeAt(unixTime(1.2e9 + 4)), 4), 4);
}

TEST(ObservationTimes, AreNotRelativeToAComment) {
  // The rawlog test_rtk_path of mrpt-common begins with a comment that was added years after the measurements.
  mrpt::obs::CObservationComment comment;
  comment.timestamp = unixTime(1.5e9);
  ObservationTimes times;
  EXPECT_EQ(times.of(comment, 1), 0);
  EXPECT_EQ(times.of(madeAt(unixTime(1.2e9)), 2), 0);
  EXPECT_DOUBLE_EQ(times.of(madeAt(unixTime(1.2e9 + 2)), 3), 2);
  EXPECT_DOUBLE_EQ(times.of(comment, 4), 2);
}

TEST(ObservationTimes, CountEntriesAsStepsWithoutTimestamps) {
  ObservationTimes times;
  for (const std::uint64_t entry : {3, 4, 4, 7}) {
    EXPECT_DOUBLE_EQ(times.of(madeAt(INVALID_TIMESTAMP), entry), 0.1 * static_cast<double>(entry - 3));
  }
  EXPECT_DOUBLE_EQ(times.of(madeAt(unixTime(1.2e9)), 8), 0.5) << "later timestamps continue from there";
  EXPECT_DOUBLE_EQ(times.of(madeAt(unixTime(1.2e9 + 1)), 9), 1.5);
}

TEST(ObservationTimes, SupportAnyTwoTimestamps) {
  using Ticks = mrpt::Clock::duration;
  const mrpt::Clock::time_point earliest{Ticks(std::numeric_limits<Ticks::rep>::min())};
  const mrpt::Clock::time_point latest{Ticks(std::numeric_limits<Ticks::rep>::max())};
  EXPECT_DOUBLE_EQ(secondsBetween(earliest, latest), 1.8446744073709552e12);
  EXPECT_DOUBLE_EQ(secondsBetween(latest, earliest), -1.8446744073709552e12);
}

class StampedRecordingTest : public TestFolder {
 protected:
  /// Writes observations with timestamps of these distances. @returns the times of the observations
  std::vector<double> timesOf(const std::vector<mrpt::Clock::duration>& stamps, std::size_t sources = 1) {
    ByteArchive archive;
    for (std::size_t i = 0; i < stamps.size(); ++i) {
      auto odometry = madeAt(unixTime(1.2e9) + stamps[i]);
      odometry.sensorLabel = std::to_string(i % sources);
      archive << odometry;
    }
    const auto file = in("a.rawlog");
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(archive.bytes.data()), static_cast<std::streamsize>(archive.bytes.size()));
    RawlogReader reader(file);
    ObservationTimes times(file);
    std::vector<double> result;
    while (const auto observation = reader.next()) result.push_back(times.of(*observation, reader.entries()));
    return result;
  }
};

TEST_F(StampedRecordingTest, OfOneMomentIsAStepPerEntry) {
  using std::chrono::microseconds;
  const std::vector<double> steps{0, 0.1, 0.2, 3 * 0.1};
  EXPECT_EQ(timesOf({microseconds(0), microseconds(20), microseconds(40), microseconds(70)}), steps);
  EXPECT_EQ(timesOf(std::vector<mrpt::Clock::duration>(4)), steps) << "equal timestamps";
}

TEST_F(StampedRecordingTest, OfAFastSensorKeepsItsTimes) {
  using std::chrono::microseconds;
  const auto times = timesOf({microseconds(0), microseconds(500), microseconds(1000)});
  ASSERT_EQ(times.size(), 3u);
  EXPECT_NEAR(times[2], 1e-3, 1e-6);
}

TEST_F(StampedRecordingTest, OfManySourcesAtOneTimeKeepsIt) {
  EXPECT_EQ(timesOf(std::vector<mrpt::Clock::duration>(300), 300), std::vector<double>(300, 0.0));
}

}  // namespace
}  // namespace robosim
