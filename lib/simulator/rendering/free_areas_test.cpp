#include "rendering/free_areas.h"

#include <numbers>

#include <gtest/gtest.h>

#include "hardware/numbered_quantities.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

/// At (1, 2), turned to the left.
RobotSnapshot robotAtOneTwo() {
  RobotSnapshot robot;
  robot.world_from_robot = {1, 2, std::numbers::pi / 2};
  return robot;
}

TEST(SightLines, LeadFromTheSensorToEachNeighbourOrLandmark) {
  SensorInfo sensor;
  sensor.kind = SensorKind::values;
  sensor.quantities = neighbourQuantities(2);
  sensor.beams = {{{0.5, 0, 0, 0, 0, 0}}};
  // Neighbour 7, 3 m ahead of the sensor, which is 0.5 m before the robot's centre; and none.
  const auto lines = sightLines(robotAtOneTwo(), sensor, Values{{7, 3, 0, -1, 0, 0}});
  ASSERT_EQ(lines.size(), 1u);
  ASSERT_EQ(lines[0].size(), 2u);
  EXPECT_NEAR((lines[0][0] - TPoint2D(1, 2.5)).norm(), 0, 1e-12);
  EXPECT_NEAR((lines[0][1] - TPoint2D(1, 5.5)).norm(), 0, 1e-12);
}

TEST(SightLines, AreACircleThroughABeaconWhoseDirectionIsUnknown) {
  SensorInfo sensor;
  sensor.kind = SensorKind::beacons;
  sensor.no_echo_m = 10;
  sensor.beams = {{{0, 0, 0, 0, 0, 0}}, {{0, 0, 0, 0, 0, 0}}};
  const auto lines = sightLines(robotAtOneTwo(), sensor, BeaconRanges{{4, 10}});
  ASSERT_EQ(lines.size(), 1u) << "the second beacon is not received";
  EXPECT_NEAR((lines[0].front() - lines[0].back()).norm(), 0, 1e-9);
  for (const auto& point : lines[0]) EXPECT_NEAR((point - TPoint2D(1, 2)).norm(), 4, 1e-6);
}

TEST(SightLines, AreNoneForOtherValues) {
  SensorInfo sensor;
  sensor.kind = SensorKind::values;
  sensor.quantities = {{"co2", "ppm"}, {"no2", "ppm"}, {"o3", "ppm"}};
  EXPECT_TRUE(sightLines(robotAtOneTwo(), sensor, Values{{1, 2, 3}}).empty());
}

TEST(FreeAreas, AreNoneForACloudOfPoints) {
  SensorInfo sensor;
  sensor.kind = SensorKind::laser;
  sensor.range_max_m = 100;
  EXPECT_TRUE(freeAreas(robotAtOneTwo(), sensor, Echoes(5), 0.1).empty());
}

}  // namespace
}  // namespace robosim
