#include "recording/observation_times.h"

#include <limits>

#include <gtest/gtest.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/system/datetime.h>

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

}  // namespace
}  // namespace robosim
