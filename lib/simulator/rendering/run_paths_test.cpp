#include "rendering/run_paths.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

double distanceTo(const TPoint2D& p, const TPoint2D& a, const TPoint2D& b) {
  const TPoint2D along = b - a;
  const double length = along.norm();
  const double share =
      length > 0 ? std::clamp(((p - a).x * along.x + (p - a).y * along.y) / (length * length), 0., 1.) : 0;
  return (p - (a + along * share)).norm();
}

/// Distance of a point from the polyline through the vertices of all time, and the last position.
double distanceTo(const TPoint2D& p, const PathPart& part, const TPoint2D& last) {
  double nearest_m = 1e9;
  for (std::size_t i = 0; i < part.points.size(); ++i) {
    const TPoint2D& to = i + 1 < part.points.size() ? part.points[i + 1].at : last;
    nearest_m = std::min(nearest_m, distanceTo(p, part.points[i].at, to));
  }
  return nearest_m;
}

TEST(RunPaths, OmitsThePointsOfAStraightLineAndKeepsCorners) {
  RunPaths paths;
  std::uint64_t step = 0;
  const auto come_to = [&](double x, double y) {
    paths.add(step, static_cast<double>(step) * 0.1, {{x, y, 0}});
    ++step;
  };
  for (int i = 0; i <= 100; ++i) come_to(0.1 * i, 0);
  for (int i = 1; i <= 50; ++i) come_to(10, 0.1 * i);
  for (int i = 1; i <= 50; ++i) come_to(10, 5 - 0.1 * i);  // back on the same way
  const auto part = paths.between(0, 0, 1e9);
  ASSERT_EQ(part.points.size(), 3U);
  EXPECT_NEAR(part.points[1].at.x, 10, 1e-12);
  EXPECT_NEAR(part.points[1].at.y, 0, 1e-12);
  EXPECT_NEAR(part.points[2].at.y, 5, 1e-12);
  EXPECT_NEAR(part.points[2].time_s, 15, 1e-9);
}

TEST(RunPaths, PassesEveryStepWithinTheStatedDeviation) {
  std::mt19937 rng(5);  // NOLINT(cert-msc51-cpp): reproducible
  std::uniform_real_distribution<double> turn(-0.3, 0.3), speed(-0.02, 0.08);
  for (const std::size_t max_points : {RunPaths::kMaxPoints, std::size_t{60}}) {
    for (int run = 0; run < 20; ++run) {
      RunPaths paths(max_points);
      std::vector<TPoint2D> all;
      mrpt::math::TPose2D robot;
      for (std::uint64_t i = 0; i < 2000; ++i) {
        robot.phi += turn(rng);
        const double by_m = speed(rng);
        robot.x += by_m * std::cos(robot.phi);
        robot.y += by_m * std::sin(robot.phi);
        all.emplace_back(robot.x, robot.y);
        paths.add(i, static_cast<double>(i), {robot});
      }
      const auto part = paths.between(0, 0, 1e9);
      EXPECT_LE(part.points.size(), max_points);
      EXPECT_EQ(part.points.front().time_s, 0) << "reaches the start";
      const double limit_m = max_points == RunPaths::kMaxPoints ? RunPaths::kTolerance_m : paths.deviationMax(0);
      for (const auto& point : all) ASSERT_LE(distanceTo(point, part, all.back()), limit_m + 1e-12);
    }
  }
}

TEST(RunPaths, ShowsThePathOfAnyTime) {
  RunPaths paths;
  for (std::uint64_t i = 0; i <= 100; ++i) {
    const double x = std::min(5.0, 0.1 * static_cast<double>(i)), y = std::max(0.0, 0.1 * static_cast<double>(i) - 5);
    paths.add(i, 0.1 * static_cast<double>(i), {{x, y, 0}});
  }
  EXPECT_EQ(paths.between(0, 0, 3).points.size(), 1U) << "the start; straight on to the robot";
  EXPECT_EQ(paths.between(0, 0, 7).points.size(), 2U) << "the start and the corner";
  const auto later = paths.between(0, 2, 7);
  ASSERT_TRUE(later.begin);
  EXPECT_NEAR(later.begin->x, 2, 1e-9);
  EXPECT_EQ(later.points.size(), 1U);
  const auto after_the_corner = paths.between(0, 6, 7);
  ASSERT_TRUE(after_the_corner.begin);
  EXPECT_NEAR(after_the_corner.begin->y, 1, 1e-9);
}

TEST(RunPaths, AddsNothingWhileARobotStands) {
  RunPaths paths;
  for (std::uint64_t i = 0; i < 10000; ++i)
    paths.add(i, static_cast<double>(i), {{1, 2, 0.001 * static_cast<double>(i)}});
  EXPECT_EQ(paths.between(0, 0, 1e9).points.size(), 1U);
}

TEST(RunPaths, BeginsAgainWhenTimeGoesBack) {
  RunPaths paths;
  for (std::uint64_t i = 0; i < 10; ++i) paths.add(i, static_cast<double>(i), {{static_cast<double>(i * i), 0, 0}});
  paths.add(2, 2, {{7, 7, 0}});
  const auto part = paths.between(0, 0, 1e9);
  ASSERT_EQ(part.points.size(), 1U);
  EXPECT_EQ(part.points[0].at.y, 7);
}

TEST(RunPaths, HasGapsAfterLongSkippedSteps) {
  RunPaths paths;
  paths.add(0, 0, {{1, 0, 0}});
  paths.add(50, 5, {{1.9, 0, 0}});    // short enough for a straight line
  paths.add(100, 10, {{4, 0, 0}});    // 2 m, unseen
  paths.add(101, 10.1, {{6, 0, 0}});  // a fast robot
  const auto part = paths.between(0, 0, 1e9);
  ASSERT_EQ(part.points.size(), 3U);
  EXPECT_FALSE(part.points[1].is_after_gap);
  EXPECT_EQ(part.points[1].at.x, 1.9);
  EXPECT_TRUE(part.points[2].is_after_gap);
  EXPECT_EQ(part.points[2].at.x, 4);
}

TEST(RunPaths, HaveAGapWhereARobotWasAbsent) {
  RunPaths paths;
  RunSnapshot snapshot;
  snapshot.robots.resize(1);
  const auto add = [&](std::uint64_t step, double x_m, Activity activity) {
    snapshot.step = step;
    snapshot.time_s = static_cast<double>(step);
    snapshot.robots[0].world_from_robot = {x_m, 0, 0};
    snapshot.robots[0].activity = activity;
    paths.add(snapshot);
  };
  add(0, 5, Activity::absent);
  EXPECT_TRUE(paths.between(0, 0, 1e9).points.empty());
  add(1, 5, Activity::active);
  add(2, 5.5, Activity::active);
  add(3, 5.5, Activity::absent);
  add(4, 5.2, Activity::active);
  const auto points = paths.between(0, 0, 1e9).points;
  ASSERT_EQ(points.size(), 3U);
  EXPECT_FALSE(points[0].is_after_gap);
  EXPECT_FALSE(points[1].is_after_gap);
  EXPECT_TRUE(points[2].is_after_gap);
}

TEST(RunPaths, BoundsTheNumberOfVerticesOfManyRobots) {
  RunPaths paths;
  std::vector<mrpt::math::TPose2D> robots(200000);
  for (std::uint64_t i = 0; i < 60; ++i) {
    for (std::size_t k = 0; k < robots.size(); ++k) {
      robots[k] = {static_cast<double>(i), static_cast<double>(i % 2 + k), 0};
    }
    paths.add(i, static_cast<double>(i), robots);
  }
  for (const std::size_t k : {0U, 199999U}) EXPECT_LE(paths.between(k, 0, 1e9).points.size(), 16U);
}

}  // namespace
}  // namespace robosim
