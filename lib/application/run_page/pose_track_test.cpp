#include "run_page/pose_track.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"

namespace robosim {
namespace {

using mrpt::math::TPose2D;
using Key = PoseTrack::Key;

/// The pose that a page shows at a time, by linear interpolation between keys [m, rad].
TPose2D restored(const std::vector<Key>& keys, double time_s) {
  std::size_t i = 0;
  while (i + 1 < keys.size() && static_cast<double>(keys[i + 1].time_us) * 1e-6 <= time_s + 1e-9) ++i;
  const Key& from = keys[i];
  const Key& to = i + 1 < keys.size() && !keys[i + 1].is_after_gap ? keys[i + 1] : from;
  const double duration = static_cast<double>(to.time_us - from.time_us) * 1e-6;
  const double part = duration > 0 ? (time_s - static_cast<double>(from.time_us) * 1e-6) / duration : 0;
  const auto between = [&](std::int64_t a, std::int64_t b) {
    return static_cast<double>(a) + part * static_cast<double>(b - a);
  };
  return {between(from.x_mm, to.x_mm) * 1e-3, between(from.y_mm, to.y_mm) * 1e-3,
          between(from.heading_ddeg, to.heading_ddeg) / 10 * M_PI / 180};
}

double turnBetween(double a_rad, double b_rad) { return std::abs(std::remainder(a_rad - b_rad, 2 * M_PI)); }

TEST(PoseTrack, KeepsTheEndsOfAStraightDriveAtConstantSpeed) {
  PoseTrack track;
  for (int step = 0; step <= 100; ++step) track.add(step, 0.1 * step, {0.05 * step, 2, 0});
  const auto keys = track.keys();
  ASSERT_EQ(keys.size(), 2u);
  EXPECT_EQ(keys[0].x_mm, 0);
  EXPECT_EQ(keys[1].x_mm, 5000);
  EXPECT_EQ(keys[1].y_mm, 2000);
  EXPECT_EQ(keys[1].moment, 100u);
  EXPECT_EQ(keys[1].driven_mm, 5000);
}

TEST(PoseTrack, KeepsTheMomentAtWhichARobotStops) {
  PoseTrack track;
  for (int step = 0; step <= 20; ++step) track.add(step, 0.1 * step, {0.05 * std::min(step, 10), 0, 0});
  const auto keys = track.keys();
  ASSERT_EQ(keys.size(), 3u);
  EXPECT_EQ(keys[1].moment, 10u);
  EXPECT_EQ(keys[1].x_mm, 500);
}

TEST(PoseTrack, ContinuesAHeadingBeyondAHalfTurn) {
  PoseTrack track;
  for (int step = 0; step <= 40; ++step) track.add(step, 0.1 * step, {0, 0, std::remainder(0.2 * step, 2 * M_PI)});
  // 8 rad are 458.4°.
  EXPECT_EQ(track.keys().back().heading_ddeg, 4584);
}

TEST(PoseTrack, RestoresEveryPoseOfARandomDriveWithinTheStatedDeviation) {
  Rng rng(7);
  std::vector<TPose2D> poses{{1, -2, 3}};
  double speed = 0, turn = 0;
  for (int step = 0; step < 3000; ++step) {
    if (step % 20 == 0) {
      speed = rng.uniform(-0.5, 1.0);
      turn = step % 60 == 0 ? 0 : rng.uniform(-2, 2);
    }
    const TPose2D& last = poses.back();
    poses.emplace_back(last.x + 0.1 * speed * std::cos(last.phi), last.y + 0.1 * speed * std::sin(last.phi),
                       std::remainder(last.phi + 0.1 * turn, 2 * M_PI));
  }
  PoseTrack track;
  for (std::size_t i = 0; i < poses.size(); ++i) track.add(i, 0.1 * static_cast<double>(i), poses[i]);
  // Tolerance of the line, and half a unit each of the line and of the pose.
  double position_m = 0.002, heading_deg = 0.2;
  std::size_t before = poses.size();
  for (TrackTolerance tolerance; tolerance.position_mm <= 8; tolerance = tolerance.doubled()) {
    if (tolerance.position_mm > 1) {
      track = track.coarser(tolerance);
      position_m += static_cast<double>(tolerance.position_mm) * 1e-3;
      heading_deg += static_cast<double>(tolerance.heading_ddeg) * 0.1;
    }
    const auto keys = track.keys();
    EXPECT_LT(keys.size(), before);
    before = keys.size();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const TPose2D shown = restored(keys, 0.1 * static_cast<double>(i));
      ASSERT_NEAR(shown.x, poses[i].x, position_m) << i;
      ASSERT_NEAR(shown.y, poses[i].y, position_m) << i;
      ASSERT_LE(turnBetween(shown.phi, poses[i].phi), heading_deg * M_PI / 180) << i;
    }
  }
}

TEST(PoseTrack, DoesNotJoinPosesAcrossAGap) {
  PoseTrack track;
  for (int step = 0; step < 5; ++step) track.add(step, step, {1.0 * step, 0, 0});
  track.interrupt();
  for (int step = 8; step < 12; ++step) track.add(step, step, {50, 1.0 * step, 0});
  const auto keys = track.keys();
  ASSERT_EQ(keys.size(), 4u);
  EXPECT_TRUE(keys[0].is_after_gap);
  EXPECT_FALSE(keys[1].is_after_gap);
  EXPECT_EQ(keys[1].x_mm, 4000);
  EXPECT_TRUE(keys[2].is_after_gap);
  EXPECT_EQ(keys[2].moment, 8u);
  EXPECT_EQ(keys[3].driven_mm, 4000 + 3000) << "the way of the gap is not counted";
}

TEST(PoseTrack, AcceptsSeveralMomentsAtOneTime) {
  PoseTrack track;
  track.add(0, 1, {0, 0, 0});
  track.add(1, 1, {1, 0, 0});
  track.add(2, 2, {2, 0, 0});
  const auto keys = track.keys();
  for (std::size_t i = 1; i < keys.size(); ++i) EXPECT_LT(keys[i - 1].moment, keys[i].moment);
  EXPECT_EQ(keys.back().x_mm, 2000);
}

TEST(PoseTrack, ForgetsAPoseWhoseTimeIsFarAhead) {
  PoseTrack with, without;
  for (int step = 0; step <= 40; ++step) {
    const TPose2D pose{step < 20 ? 1 : 1 + 0.03 * (step - 20), 2, 0};
    if (step == 17) {
      with.add(step, 1e9, {1.4, 2, 0.3});
      continue;
    }
    with.add(step, 0.1 * step, pose);
    without.add(step, 0.1 * step, pose);
  }
  PageBytes bytes, expected;
  addKeys(with.keys(), true, bytes);
  addKeys(without.keys(), true, expected);
  EXPECT_EQ(bytes.bytes(), expected.bytes());
}

TEST(PoseTrack, ForgetsAFirstPoseWhoseTimeIsFarAhead) {
  PoseTrack track;
  track.add(0, 1e9, {50, 50, 0});
  track.add(1, 0.1, {1, 0, 0});
  track.add(2, 0.2, {2, 0, 0});
  const auto keys = track.keys();
  ASSERT_EQ(keys.size(), 2u);
  EXPECT_EQ(keys[0].x_mm, 1000);
  EXPECT_EQ(keys[1].driven_mm, 1000);
}

TEST(PoseTrack, IsEncodedByColumns) {
  PoseTrack track;
  track.add(0, 0, {0.001, 0, 0});
  track.add(3, 0.3, {0.002, -0.001, 0});
  PageBytes bytes;
  addKeys(track.keys(), true, bytes);
  // Two keys; moments 0, +3 (as 6); one gap, at 0; x +1 +1; y 0 -1; heading 0 0; driven 0 +1 (0.0014 m).
  EXPECT_EQ(bytes.bytes(), std::string("\2\0\6\1\0\2\2\0\1\0\0\0\2", 13));
}

}  // namespace
}  // namespace robosim
