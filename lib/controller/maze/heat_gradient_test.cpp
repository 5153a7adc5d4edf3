#include "maze/heat_gradient.h"

#include <gtest/gtest.h>

#include "maze/testing/fake_maze.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

TEST(HeatSlope, IsTheGradientOfAPlane) {
  HeatSlope slope(0.1);
  for (const TPoint2D place : {TPoint2D(0, 0), TPoint2D(1, 0), TPoint2D(1, 1), TPoint2D(0, 1)}) {
    slope.measure(place, 7 + 3 * place.x - 2 * place.y);
  }
  ASSERT_TRUE(slope.gradient());
  EXPECT_NEAR(slope.gradient()->x, 3, 1e-12);
  EXPECT_NEAR(slope.gradient()->y, -2, 1e-12);
}

TEST(HeatSlope, IsUnknownOnALineAndForTwoPlaces) {
  HeatSlope slope(0.1);
  slope.measure({0, 0}, 1);
  slope.measure({1, 0.5}, 2);
  EXPECT_FALSE(slope.gradient());
  for (int i = 2; i < 8; ++i) slope.measure({i * 1.0, i * 0.5}, i);
  EXPECT_FALSE(slope.gradient());
}

TEST(HeatSlope, UsesTheLatestPlacesOfAtLeastTheSpacing) {
  HeatSlope slope(0.5);
  slope.measure({0, 0}, 0);
  slope.measure({0.4, 0}, 100);  // too near
  slope.measure({1, 0}, 1);
  slope.measure({0, 1}, 0);
  EXPECT_NEAR(slope.gradient()->x, 1, 1e-12);
  // Twelve later measurements of another plane replace them.
  for (int i = 0; i < 12; ++i) slope.measure({i % 2 * 1.0, i / 2 % 2 * 1.0}, 5.0 * (i / 2 % 2));
  EXPECT_NEAR(slope.gradient()->x, 0, 1e-12);
  EXPECT_NEAR(slope.gradient()->y, 5, 1e-12);
}

TEST(HeatGradient, DrivesToAHeatSource) {
  // From 2 m beside the source, in whose range of 3 m the heat falls from 20 to 0.
  FakeMaze maze({}, {1, 2}, 20);
  Robot robot(maze.hardware);
  HeatGradient controller({.seed = 1}, StepLength::exponential(5), 2);
  double hottest = 0;
  for (int i = 0; i < 300; ++i) {
    controller.step(robot);
    maze.hardware.advance();
    hottest = std::max(hottest, *robot.heat());
  }
  EXPECT_GT(hottest, 18) << "within 0.3 m";
  EXPECT_FALSE(controller.hasDrawnRandomNumbers() && hottest < 18);
}

TEST(HeatGradient, WalksAtRandomWithoutHeat) {
  FakeHardware hardware, of_walk;
  Robot robot(hardware), walker(of_walk);
  HeatGradient controller({.seed = 1}, StepLength::exponential(5), 2);
  RandomWalk walk({.seed = 1}, StepLength::exponential(5));
  hardware.setHeat(1.9);
  for (int i = 0; i < 200; ++i) {
    controller.step(robot);
    walk.step(walker);
    hardware.advance();
    of_walk.advance();
  }
  EXPECT_EQ(hardware.odometry().odom_from_robot, of_walk.odometry().odom_from_robot);
}

}  // namespace
}  // namespace robosim
