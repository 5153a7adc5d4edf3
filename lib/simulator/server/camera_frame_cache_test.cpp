#include "server/camera_frame_cache.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

/// Readings of a robot whose only sensor is a camera.
Readings readingsWith(const std::string& jpeg, std::uint64_t step) {
  Readings readings;
  readings.time.step = step;
  readings.measurements.push_back(Image{jpeg});
  return readings;
}

TEST(CameraFrameCache, KeepsThePictureOfAWatchedRobotUntilItsCameraTakesTheNext) {
  CameraFrameCache camera_frames;
  camera_frames.update({0}, {readingsWith("first", 10)});
  camera_frames.update({0}, {readingsWith("", 11)});
  ASSERT_NE(camera_frames.find(0, 0), nullptr);
  EXPECT_EQ(camera_frames.find(0, 0)->image.jpeg, "first");
  EXPECT_EQ(camera_frames.find(0, 0)->step, 10u);
  camera_frames.update({0}, {readingsWith("second", 12)});
  EXPECT_EQ(camera_frames.find(0, 0)->image.jpeg, "second");
  EXPECT_EQ(camera_frames.find(0, 0)->step, 12u);
}

TEST(CameraFrameCache, DropsThePicturesOfARobotThatHasNoViewer) {
  CameraFrameCache camera_frames;
  camera_frames.update({0, 1}, {readingsWith("of 0", 10), readingsWith("of 1", 10)});
  camera_frames.update({1}, {readingsWith("", 11), readingsWith("", 11)});
  EXPECT_EQ(camera_frames.find(0, 0), nullptr);
  ASSERT_NE(camera_frames.find(1, 0), nullptr);
  camera_frames.update({0, 1}, {readingsWith("", 500), readingsWith("", 500)});
  EXPECT_EQ(camera_frames.find(0, 0), nullptr) << "the picture of step 10 is not the newest at step 500";
}

TEST(CameraFrameCache, IgnoresRobotsThatTheWorldDoesNotHave) {
  CameraFrameCache camera_frames;
  camera_frames.update({0, 7}, {readingsWith("of 0", 1)});
  EXPECT_EQ(camera_frames.find(7, 0), nullptr);
}

}  // namespace
}  // namespace robosim
