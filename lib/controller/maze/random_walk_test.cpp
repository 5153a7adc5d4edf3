#include "maze/random_walk.h"

#include <cmath>

#include <gtest/gtest.h>

#include "maze/testing/fake_maze.h"

namespace robosim {
namespace {

TEST(StepLength, OfAnExponentialDistributionExceedsItsMeanWithProbability1OverE) {
  const auto length = StepLength::exponential(5);
  EXPECT_NEAR(length.exceededBy(std::exp(-1)), 5, 1e-12);
  EXPECT_NEAR(length.exceededBy(std::exp(-3)), 15, 1e-12);
  EXPECT_EQ(length.exceededBy(1), 0);
}

TEST(StepLength, OfAPowerLawGrowsByTheInversePower) {
  // The probability of a length above l is (l / min)^(1 - exponent).
  const auto of_2 = StepLength::powerLaw(2, 0.5, 100);
  EXPECT_EQ(of_2.exceededBy(1), 0.5);
  EXPECT_NEAR(of_2.exceededBy(0.1), 5, 1e-12);
  const auto of_3 = StepLength::powerLaw(3, 1, 100);
  EXPECT_NEAR(of_3.exceededBy(0.25), 2, 1e-12);
  EXPECT_NEAR(of_3.exceededBy(0.01), 10, 1e-12);
}

TEST(StepLength, OfAPowerLawIsCutOff) { EXPECT_EQ(StepLength::powerLaw(2, 1, 30).exceededBy(0.001), 30); }

/// Straight distances driven between two turns, by a walk without obstacles.
std::vector<double> stepsOf(const StepLength& length, int steps) {
  FakeHardware hardware;
  Robot robot(hardware);
  RandomWalk walk({.seed = 1}, length);
  std::vector<double> lengths;
  double driven_m = 0;
  for (int i = 0; i < steps; ++i) {
    walk.step(robot);
    if (hardware.lastCommand().speed_mps == 0 && driven_m > 0) {
      lengths.push_back(driven_m);
      driven_m = 0;
    }
    hardware.advance();
    driven_m += hardware.lastCommand().speed_mps > 0 ? hardware.odometry().speed_mps * 0.1 : 0;
  }
  return lengths;
}

TEST(RandomWalk, DrivesStepsOfTheGivenMeanLength) {
  const auto lengths = stepsOf(StepLength::exponential(8), 60000);
  ASSERT_GT(lengths.size(), 300u);
  double sum = 0;
  for (const double length : lengths) sum += length;
  const auto n = static_cast<double>(lengths.size());
  EXPECT_NEAR(sum / n, 8, 3 * 8 / std::sqrt(n) + 0.5) << "it notices the end of a step at up to 1 m/s · 0.1 s";
}

TEST(RandomWalk, TurnsInAllDirections) {
  FakeHardware hardware;
  Robot robot(hardware);
  RandomWalk walk({.seed = 2}, StepLength::exponential(0.5));
  std::array<int, 4> of_quadrant{};
  for (int i = 0; i < 20000; ++i) {
    walk.step(robot);
    hardware.advance();
    if (hardware.lastCommand().speed_mps == 0) continue;
    const double phi = hardware.odometry().odom_from_robot.phi;
    ++of_quadrant[static_cast<std::size_t>(std::floor((phi + M_PI) / M_PI_2)) % 4];
  }
  for (const int count : of_quadrant) EXPECT_GT(count, 1000);
}

TEST(RandomWalk, TurnsInFrontOfWallsAndTouchesNone) {
  FakeMaze maze(FakeMaze::room(-3, 3, -2, 2), {99, 99}, 0);
  Robot robot(maze.hardware);
  RandomWalk walk({.seed = 3}, StepLength::exponential(100));
  int stalls = 0, turning = 0;
  double driven_m = 0;
  for (int i = 0; i < 5000; ++i) {
    walk.step(robot);
    maze.hardware.advance();
    stalls += robot.stalled() ? 1 : 0;
    turning += maze.hardware.lastCommand().speed_mps == 0 ? 1 : 0;
    driven_m += maze.hardware.odometry().speed_mps * 0.1;
  }
  EXPECT_LT(stalls, 10);
  EXPECT_LT(turning, 4000);
  EXPECT_GT(driven_m, 50);
}

TEST(RandomWalk, OfTheSameSeedIsTheSameAndOfAnotherRobotIsNot) {
  const auto end_of = [](std::uint32_t index) {
    FakeHardware hardware;
    Robot robot(hardware);
    RandomWalk walk({.seed = 4, .robot = index}, StepLength::exponential(2));
    for (int i = 0; i < 500; ++i) {
      walk.step(robot);
      hardware.advance();
    }
    return hardware.odometry().odom_from_robot;
  };
  EXPECT_EQ(end_of(0), end_of(0));
  EXPECT_NE(end_of(0), end_of(1));
}

}  // namespace
}  // namespace robosim
