#include "hardware/measurement_times.h"

#include <string>

#include <gtest/gtest.h>

namespace robosim {
namespace {

/// The steps from 0 to `last`, of 0.1 s, in which a sensor measures.
std::string stepsOf(const MeasurementTimes& times, std::uint64_t last) {
  std::string steps;
  for (std::uint64_t step = 0; step <= last; ++step) {
    if (times.isDue({step, 0.1})) steps += std::to_string(step) + " ";
  }
  return steps;
}

TEST(MeasurementTimes, AreTheFirstStepsAtOrAfterEachDueTime) {
  EXPECT_EQ(stepsOf({}, 4), "0 1 2 3 4 ") << "without a rate in every step";
  EXPECT_EQ(stepsOf({.rate_hz = 5}, 8), "0 2 4 6 8 ");
  EXPECT_EQ(stepsOf({.rate_hz = 4}, 10), "0 3 5 8 10 ") << "at 0.25 s, 0.5 s, 0.75 s, 1 s";
  EXPECT_EQ(stepsOf({.rate_hz = 2.5, .phase_s = 0.1}, 9), "0 1 5 9 ") << "in step 0, then at 0.1 s, 0.5 s, 0.9 s";
  EXPECT_EQ(stepsOf({.rate_hz = 100}, 3), "0 1 2 3 ") << "at most one per step";
}

TEST(MeasurementTimes, AreExactAfterManySteps) {
  const MeasurementTimes times{.rate_hz = 5};
  for (std::uint64_t step = 1'000'000'000; step < 1'000'000'100; ++step) {
    EXPECT_EQ(times.isDue({step, 0.1}), step % 2 == 0) << step;
  }
}

}  // namespace
}  // namespace robosim
