#include "sensors/lidar.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "sensors/swept_pose.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

constexpr double kSinglePrecision_m = 1e-5;  ///< more than its rounding error

TEST(Lidar, MeasuresWallAndFloorInEachLayer) {
  // Layers at -45°, 0° and 45°, columns at -90°, 0°, 90° and 180°; a wall of 1 m ahead, 2 m away.
  const auto lidar = sensorFrom(
      "<lidar z_m='0.5' layers='3' beams='4' elevation_min_deg='-45' elevation_max_deg='45' angle_deg='45'/>");
  ASSERT_EQ(lidar->info().beams.size(), 12U);
  SingleRobotScene robot({block(2.5, 0, 1, 10)});
  const auto ranges = robot.ranges(*lidar);
  const double floor_m = 0.5 * std::sqrt(2);
  for (std::size_t column = 0; column < 4; ++column) EXPECT_NEAR(ranges[column], floor_m, kSinglePrecision_m) << column;
  EXPECT_NEAR(ranges[4 + 1], 2, kSinglePrecision_m);
  EXPECT_NEAR(ranges[4 + 0], 100, kSinglePrecision_m) << "nothing to the right";
  EXPECT_NEAR(ranges[8 + 1], 100, kSinglePrecision_m) << "above the wall";
  const auto measured = robot.sense(*lidar);
  const Echo& ahead = std::get<Echoes>(measured)[1];
  EXPECT_NEAR(ahead.point_m.x, 0.5, kSinglePrecision_m);
  EXPECT_NEAR(ahead.point_m.z, 0, kSinglePrecision_m) << "on the floor";
}

TEST(Lidar, HasEvenlySpacedLayersAndDirections) {
  const auto lidar = sensorFrom("<lidar layers='16' beams='360'/>");
  const auto& beams = lidar->info().beams;
  ASSERT_EQ(beams.size(), 16U * 360U);
  EXPECT_NEAR(beams[0].robot_from_beam.yaw, -179.5 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(beams[359].robot_from_beam.yaw, 179.5 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(beams[0].robot_from_beam.pitch, 15 * kRadPerDeg, 1e-12) << "down";
  EXPECT_NEAR(beams[360].robot_from_beam.pitch, 13 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(beams[15 * 360].robot_from_beam.pitch, -15 * kRadPerDeg, 1e-12) << "up";
  EXPECT_EQ(sensorFrom("<lidar layers='1' elevation_min_deg='0' elevation_max_deg='10'/>")
                ->info()
                .beams[0]
                .robot_from_beam.pitch,
            -5 * kRadPerDeg);
}

TEST(Lidar, MeasuresFromThePoseAtTheTimeOfEachDirection) {
  const std::vector<Solid> solids{block(3, 0, 1, 8), block(-3, 1, 1, 4, 0.3), pillar(0.5, 2, 0.4, 2),
                                  pillar(1, -2, 0.3, 0.3)};
  const auto lidar = sensorFrom(
      "<lidar x_m='0.1' z_m='0.6' layers='5' beams='40' elevation_min_deg='-20' sweep_s='0.05' latency_s='0.02'/>");
  SingleRobotScene robot(solids, {0.1, 0.2, 0.4});
  robot.motion = {.length_m = 0.05, .turn_rad = 0.1};
  const auto ranges = robot.ranges(*lidar);
  const Scene scene(solids, 0, {-20, 20, -20, 20});
  SweptPose pose(PlanarTransform({0.1, 0.2, 0.4}, 0), robot.motion, 0.07 / 0.1, 0.05 / 39 / 0.1);
  for (std::size_t column = 0; column < 40; ++column, pose.next()) {
    for (std::size_t layer = 0; layer < 5; ++layer) {
      const Beam& beam = lidar->info().beams[layer * 40 + column];
      const Ray ray{pose.pointToWorld(originOf(beam)), pose.turnToWorld(directionOf(beam))};
      const Hit hit = scene.castRay(ray, 100);
      const double floor_m = ray.direction.z < 0 ? -ray.origin.z / ray.direction.z : 100;
      EXPECT_NEAR(ranges[layer * 40 + column], std::min({hit.distance_m, floor_m, 100.0}), kSinglePrecision_m)
          << "column " << column << " layer " << layer;
    }
  }
}

TEST(Lidar, ReadsWithTheErrorsOfALaser) {
  const auto lidar = sensorFrom(
      "<lidar z_m='0.5' layers='8' beams='500' field_of_view_deg='10' elevation_min_deg='-1' elevation_max_deg='1'>"
      "<noise std_m='0.03' dropout='0.1'/></lidar>");
  EXPECT_TRUE(lidar->isNoisy());
  SingleRobotScene robot({block(5.5, 0, 1, 10, 0, 9)});
  const auto ranges = robot.ranges(*lidar);
  double lost = 0, sum = 0, squares = 0, count = 0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const auto direction = directionOf(lidar->info().beams[i]);
    if (ranges[i] == 100) {
      ++lost;
      continue;
    }
    const double error_m = ranges[i] - 5 / direction.x;
    ++count;
    sum += error_m;
    squares += error_m * error_m;
  }
  EXPECT_NEAR(lost / 4000, 0.1, 0.02);
  EXPECT_NEAR(sum / count, 0, 0.002);
  EXPECT_NEAR(std::sqrt(squares / count), 0.03, 0.002);
}

TEST(Lidar, RejectsWhatItCannotMeasure) {
  const auto fault = [](const std::string& xml) -> std::string {
    try {
      sensorFrom(xml);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(fault("<lidar layers='128' beams='300'/>").find("makes 38400 in all layers, of at most 32768"),
            std::string::npos);
  EXPECT_NE(fault("<lidar elevation_min_deg='5' elevation_max_deg='4'/>").find("is below elevation_min_deg"),
            std::string::npos);
  EXPECT_NE(fault("<lidar><noise divergence_deg='0.1'/></lidar>").find("scanners with one layer"), std::string::npos);
  EXPECT_NE(fault("<lidar><noise reach_m='20'/></lidar>").find("scanners with one layer"), std::string::npos);
  EXPECT_NE(fault("<lidar interlace_s='0.01'/>").find("interlace_s"), std::string::npos);
}

}  // namespace
}  // namespace robosim
