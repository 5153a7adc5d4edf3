#include "sensors/range_and_bearing.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "base/error_list.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

/// A neighbour as measured.
struct Neighbour {
  double robot, range_m, bearing_rad;
};

/// Robots of 0.2 m radius and 0.3 m height among solids; the first one measures.
std::vector<Neighbour> neighboursOf(const std::vector<mrpt::math::TPose2D>& poses, const Sensor& sensor,
                                    const std::vector<Solid>& solids = {}, std::uint64_t step = 1) {
  Scene scene(solids, poses.size(), {-20, 20, -20, 20});
  std::vector<PlanarTransform> frames;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    scene.place(i, {Circle{{poses[i].x, poses[i].y}, 0.2}, {0, 0.3}});
    frames.emplace_back(poses[i], 0);
  }
  scene.freeze();
  const std::vector<Motion> motions(poses.size());
  const std::vector<float> pans(poses.size());
  SimTime time;
  time.step = step;
  const Snapshot now{.scene = scene,
                     .heat_sources = {},
                     .world_from_robot = poses,
                     .frames = frames,
                     .last_motion = motions,
                     .laser_pan_rad = pans,
                     .time = time,
                     .seed = 1};
  std::vector<Readings> readings(1);
  readings[0].measurements.push_back(sensor.blank());
  const std::uint32_t robot = 0;
  sensor.sense(now, {&robot, 1}, 0, readings);
  const auto& values = std::get<Values>(readings[0].measurements[0]).values;
  EXPECT_EQ(values.size(), sensor.info().quantities.size());
  std::vector<Neighbour> neighbours;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
    if (values[i] >= 0) neighbours.push_back({values[i], values[i + 1], values[i + 2]});
  }
  return neighbours;
}

TEST(RangeAndBearing, MeasuresTheNearestRobotsFirstInTheRobotsFrame) {
  // The robot at (1, 2) faces left (+y). Robot 1 is 2 m ahead, robot 2 is 1 m to its right (bearing -π/2).
  const auto sensor = sensorFrom("<range_and_bearing/>");
  const auto neighbours = neighboursOf({{1, 2, M_PI / 2}, {1, 4, 0}, {2, 2, 1}}, *sensor);
  ASSERT_EQ(neighbours.size(), 2u);
  EXPECT_EQ(neighbours[0].robot, 2);
  EXPECT_NEAR(neighbours[0].range_m, 1, 1e-6);
  EXPECT_NEAR(neighbours[0].bearing_rad, -M_PI / 2, 1e-6);
  EXPECT_EQ(neighbours[1].robot, 1);
  EXPECT_NEAR(neighbours[1].range_m, 2, 1e-6);
  EXPECT_NEAR(neighbours[1].bearing_rad, 0, 1e-6);
}

TEST(RangeAndBearing, MeasuresNoRobotOutOfRangeOrBehindAnObjectOrAnotherRobot) {
  const auto sensor = sensorFrom("<range_and_bearing range_max_m='2.5'/>");
  const std::vector<mrpt::math::TPose2D> poses{{0, 0, 0}, {2.4, 0, 0}, {0, 2.6, 0}, {-1, 0, 0}, {-2, 0, 0}};
  const auto free = neighboursOf(poses, *sensor);
  ASSERT_EQ(free.size(), 2u);  // 1, and 3, which hides 4
  EXPECT_EQ(free[0].robot, 3);
  EXPECT_EQ(free[1].robot, 1);
  const auto walled = neighboursOf(poses, *sensor, {block(1, 0, 0.1, 1)});
  ASSERT_EQ(walled.size(), 1u);
  EXPECT_EQ(walled[0].robot, 3);
  const auto low_wall = neighboursOf(poses, *sensor, {block(1, 0, 0.1, 1, 0, 0.05)});  // below the line at 0.1 m
  EXPECT_EQ(low_wall.size(), 2u);
}

TEST(RangeAndBearing, MeasuresNoMoreRobotsThanItsCount) {
  const auto sensor = sensorFrom("<range_and_bearing count='2'/>");
  const auto neighbours = neighboursOf({{0, 0, 0}, {1, 0, 0}, {0, 1.5, 0}, {-2, 0, 0}}, *sensor);
  ASSERT_EQ(neighbours.size(), 2u);
  EXPECT_EQ(neighbours[0].robot, 1);
  EXPECT_EQ(neighbours[1].robot, 2);
}

TEST(RangeAndBearing, NoiseHasTheGivenDeviations) {
  const auto sensor = sensorFrom("<range_and_bearing><noise std_m='0.1' bearing_std_deg='10'/></range_and_bearing>");
  EXPECT_DOUBLE_EQ(sensor->info().bearing_std_rad, M_PI / 18);
  EXPECT_EQ(sensorFrom("<range_and_bearing/>")->info().bearing_std_rad, 0);
  EXPECT_TRUE(sensor->isNoisy());
  constexpr int kSamples = 4000;
  double range_squares = 0, bearing_squares = 0;
  for (int i = 1; i <= kSamples; ++i) {
    const auto neighbours = neighboursOf({{0, 0, 0}, {2, 0, 0}}, *sensor, {}, static_cast<std::uint64_t>(i));
    ASSERT_EQ(neighbours.size(), 1u);
    range_squares += std::pow(neighbours[0].range_m - 2, 2);
    bearing_squares += std::pow(neighbours[0].bearing_rad, 2);
  }
  // The standard error of a deviation is 1/89 of it. Bounds are four of them.
  const double bearing_std_rad = toRadians(10);
  EXPECT_NEAR(std::sqrt(range_squares / kSamples), 0.1, 4 * 0.1 / 89);
  EXPECT_NEAR(std::sqrt(bearing_squares / kSamples), bearing_std_rad, 4 * bearing_std_rad / 89);
}

TEST(RangeAndBearing, RejectsAnInvalidCount) {
  EXPECT_THROW(sensorFrom("<range_and_bearing count='0'/>"), ConfigError);
  EXPECT_THROW(sensorFrom("<range_and_bearing count='65'/>"), ConfigError);
  EXPECT_THROW(sensorFrom("<range_and_bearing count='2.5'/>"), ConfigError);
}

}  // namespace
}  // namespace robosim
