#include "maze/scan_matcher.h"

#include <cmath>

#include <gtest/gtest.h>
#include <mrpt/math/wrap2pi.h>

#include "base/angle_units.h"
#include "base/portable_pose.h"
#include "base/random.h"
#include "maze/laser_surfaces.h"
#include "maze/sonar_regions.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

/// Points on the walls of a room of 4 × 4 m about (0, 0), as seen from a pose.
std::vector<SurfacePoint> roomFrom(const TPose2D& pose) {
  std::vector<SurfacePoint> points;
  for (int side = 0; side < 4; ++side) {
    for (double along = -1.5; along < 1.6; along += 0.25) {
      const TPose2D turned(0, 0, side * M_PI / 2);
      const TPoint2D at = portable::compose(turned, TPoint2D(2, along));
      const TPose2D robot_from_world = portable::inverse(pose);
      const TPose2D turn(0, 0, robot_from_world.phi);
      points.push_back({portable::compose(robot_from_world, at),
                        portable::compose(turn, portable::compose(turned, TPoint2D(-1, 0))), 0.02});
    }
  }
  return points;
}

TEST(ScanMatcher, CorrectsTheDriftOfTheOdometry) {
  ScanMatcher matcher(0.15);
  PoseFilter filter;
  TPose2D truth;
  // The odometry measures 3 % more of each turn, and 2 % less of each distance.
  for (int i = 0; i < 400; ++i) {
    const TPose2D motion(0.05, 0, 0.1);
    truth = portable::compose(truth, motion);
    filter.move({motion.x * 0.98, 0, motion.phi * 1.03});
    matcher.match(roomFrom(truth), filter);
  }
  EXPECT_NEAR(filter.startFromRobot().x, truth.x, 0.03);
  EXPECT_NEAR(filter.startFromRobot().y, truth.y, 0.03);
  EXPECT_NEAR(mrpt::math::wrapToPi(filter.startFromRobot().phi - truth.phi), 0, 0.02);
}

TEST(PoseFilter, EstimatesTheDeviationOfTheCompassByTheOdometry) {
  // Without the estimate, the heading would be off by up to 12°, twice the amplitude.
  constexpr double kAmplitude_rad = toRadians(6);
  Rng rng(3);
  PoseFilter filter;
  double truth = 0, squares = 0;
  const auto compass = [&] { return mrpt::math::wrapToPi(1 + truth + kAmplitude_rad * std::sin(1 + truth)); };
  filter.turnTo(compass());
  for (int i = 0; i < 3000; ++i) {
    const double turn = 0.05 * (i / 200 % 2 == 0 ? 1 : -1);
    truth = mrpt::math::wrapToPi(truth + turn);
    filter.move({0.05, 0, turn * 1.01 + 0.005 * rng.gaussian()});
    filter.turnTo(mrpt::math::wrapToPi(compass() + 0.03 * rng.gaussian()));
    const double off = mrpt::math::wrapToPi(filter.startFromRobot().phi - truth);
    if (i >= 2000) squares += off * off / 1000;
  }
  EXPECT_LT(std::sqrt(squares), toRadians(2));
}

TEST(SurfaceMap, DistinguishesTheSidesOfAThinWall) {
  SurfaceMap map(0.15);
  for (int i = 0; i < 3; ++i) {
    map.add({{1.00, 0}, {-1, 0}, 0.02});
    map.add({{1.05, 0}, {1, 0}, 0.02});
  }
  EXPECT_NEAR(map.nearest({{1.02, 0}, {-1, 0}, 0.02})->point_m.x, 1.00, 1e-9);
  EXPECT_NEAR(map.nearest({{1.02, 0}, {1, 0}, 0.02})->point_m.x, 1.05, 1e-9);
  EXPECT_FALSE(map.nearest({{1.02, 0}, {0, 1}, 0.02}));
}

TEST(SurfaceMap, ReturnsOnlySurfacesThatWereSeenRepeatedly) {
  SurfaceMap map(0.15);
  map.add({{1, 0}, {-1, 0}, 0.02});
  EXPECT_FALSE(map.nearest({{1, 0}, {-1, 0}, 0.02}));
  map.add({{1, 0}, {-1, 0}, 0.02});
  map.add({{1, 0}, {-1, 0}, 0.02});
  EXPECT_TRUE(map.nearest({{1, 0}, {-1, 0}, 0.02}));
  map.reset();
  EXPECT_FALSE(map.nearest({{1, 0}, {-1, 0}, 0.02}));
}

/// A sensor with beams from the centre in the given directions, and its echoes at these ranges.
struct Beams {
  Beams(const std::vector<double>& bearings_deg, const std::vector<double>& ranges_m) {
    sensor.range_max_m = sensor.no_echo_m = 5;
    for (std::size_t i = 0; i < bearings_deg.size(); ++i) {
      const double yaw = toRadians(bearings_deg[i]);
      auto& beam = sensor.beams.emplace_back();
      beam.robot_from_beam.yaw = yaw;
      auto& echo = echoes.emplace_back();
      echo.range_m = static_cast<float>(ranges_m[i]);
      echo.point_m = {static_cast<float>(ranges_m[i] * std::cos(yaw)), static_cast<float>(ranges_m[i] * std::sin(yaw)),
                      0};
    }
  }
  SensorInfo sensor;
  Echoes echoes;
};

TEST(LaserSurfaces, FaceTheRobot) {
  std::vector<double> bearings_deg, ranges_m;
  for (int i = -4; i <= 4; ++i) {
    bearings_deg.push_back(2 * i);
    ranges_m.push_back(2 / std::cos(toRadians(2 * i)));  // a wall 2 m ahead
  }
  const Beams scan(bearings_deg, ranges_m);
  std::vector<SurfacePoint> points;
  addLaserSurfaces(scan.sensor, scan.echoes, 1, points);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].point_m.x, 2, 1e-6);
  EXPECT_NEAR(points[0].normal.x, -1, 1e-6);
}

TEST(SonarRegions, MergeTheEchoesOfOneWallIntoThePointAheadOfTheMiddleSonar) {
  const Beams ring({-60, -30, 0, 30, 60}, {5, 1, 1, 1, 5});
  SonarRegions regions;
  regions.update(ring.sensor, ring.echoes, {});
  std::vector<SurfacePoint> surfaces;
  regions.interpret(ring.sensor, {}, surfaces);
  ASSERT_EQ(surfaces.size(), 1u);
  EXPECT_NEAR(surfaces[0].point_m.x, 1, 1e-6);
  EXPECT_NEAR(surfaces[0].point_m.y, 0, 1e-6);
  EXPECT_NEAR(surfaces[0].normal.x, -1, 1e-6);
}

TEST(SonarRegions, EndTheRaysOfSonarsWithoutEchoAtWallsThatOthersSee) {
  const Beams ring({-60, -30, 0, 30, 60}, {5, 1, 1, 1, 5});
  SonarRegions regions;
  regions.update(ring.sensor, ring.echoes, {});
  std::vector<SurfacePoint> surfaces;
  regions.interpret(ring.sensor, {}, surfaces);
  int hits = 0;
  for (const auto& ray : regions.rays()) {
    hits += ray.hit ? 1 : 0;
    if (!ray.hit) {
      EXPECT_LT(ray.to.x, 1);
    }
  }
  EXPECT_EQ(hits, 1);
}

TEST(SonarRegions, CountAnUnchangedReadingOnce) {
  const Beams ring({-30, 0, 30}, {1, 1, 1});
  SonarRegions regions;
  std::vector<SurfacePoint> surfaces;
  regions.update(ring.sensor, ring.echoes, {});
  regions.interpret(ring.sensor, {}, surfaces);
  surfaces.clear();
  regions.update(ring.sensor, ring.echoes, {0.1, 0, 0});
  regions.interpret(ring.sensor, {0.1, 0, 0}, surfaces);
  EXPECT_TRUE(surfaces.empty());
  EXPECT_TRUE(regions.rays().empty());
}

}  // namespace
}  // namespace robosim
