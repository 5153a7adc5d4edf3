#include "rendering/camera_effects.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace robosim {
namespace {

/// 100 × 80 pixels with a focal length of 50 pixels.
CameraView smallCamera() { return {.info = {100, 80, M_PI / 2, 10}, .robot_from_camera = {}}; }

/// A pinhole's picture that is white in one column (given by its centre's offset from the axis, in pixels).
cv::Mat columnAt(const CameraInfo& info, double off_px) {
  cv::Mat picture(static_cast<int>(info.height_px), static_cast<int>(info.width_px), CV_8UC3, cv::Scalar::all(0));
  const int column = static_cast<int>(std::lround(info.width_px / 2.0 + off_px - 0.5));
  picture.col(column).setTo(cv::Scalar::all(255));
  return picture;
}

/// Offset of the brightest column of a row from the optical axis [pixels].
double brightestAt(const cv::Mat& picture, int row) {
  cv::Mat gray;
  cv::cvtColor(picture.row(row), gray, cv::COLOR_BGR2GRAY);
  cv::Point place;
  cv::minMaxLoc(gray, nullptr, nullptr, nullptr, &place);
  return place.x + 0.5 - picture.cols / 2.0;
}

TEST(CameraEffects, KeepTheSizeOfAPictureWithoutLensAndShutter) {
  CameraView camera = smallCamera();
  camera.errors.noise_std = 5;
  EXPECT_EQ(pinholeFor(camera), camera.info);
}

TEST(CameraEffects, ShowWhatALensShows) {
  // k1 = -0.2: what a pinhole shows at 40.5 px, 0.81, appears at 0.81 · (1 - 0.2 · 0.6561) = 0.7037, 35.2 px.
  CameraView camera = smallCamera();
  camera.info.distortion.k1 = -0.2;
  const CameraInfo pinhole = pinholeFor(camera);
  EXPECT_GT(pinhole.width_px, 100u) << "a barrel lens shows more than the pinhole";
  EXPECT_NEAR(pinhole.focalLength(), 50, 1e-9);
  const cv::Mat picture = withCameraErrors(columnAt(pinhole, 40.5), camera, 0, 1);
  EXPECT_EQ(picture.size(), cv::Size(100, 80));
  EXPECT_NEAR(brightestAt(picture, 40), 35.2, 0.8);
}

TEST(CameraEffects, ShowRowsOfARollingShutterFromEarlierHeadings) {
  // The robot turns to the left by 0.2 rad while 80 rows are read. The top row is read 0.2 · 79.5 / 80 rad before: what
  // is 0.5 px to the right of the axis at the end was nearer to the left side's heading then, and appears 0.199 rad
  // further to the left: 0.01 - 0.199 = -0.189 rad, at 50 · tan(-0.189) = -9.5 px.
  CameraView camera = smallCamera();
  camera.errors.rolling_shutter_s = 0.1;
  const cv::Mat picture = withCameraErrors(columnAt(pinholeFor(camera), 0.5), camera, 2, 1);
  EXPECT_NEAR(brightestAt(picture, 0), -9.5, 0.8);
  EXPECT_NEAR(brightestAt(picture, 79), 0.5, 0.8);
}

TEST(CameraEffects, ScaleTheBrightnessUntilItSaturates) {
  CameraView camera = smallCamera();
  camera.errors.exposure = 1.5;
  const cv::Mat gray(80, 100, CV_8UC3, cv::Scalar(40, 100, 200));
  EXPECT_EQ(withCameraErrors(gray, camera, 0, 1).at<cv::Vec3b>(0, 0), cv::Vec3b(60, 150, 255));
}

TEST(CameraEffects, AddNoiseOfTheGivenSpreadToEachPixel) {
  CameraView camera = smallCamera();
  camera.errors.noise_std = 8;
  const cv::Mat gray(80, 100, CV_8UC3, cv::Scalar::all(128));
  cv::Scalar mean, spread;
  const cv::Mat noisy = withCameraErrors(gray, camera, 0, 1);
  cv::meanStdDev(noisy, mean, spread);
  for (int color = 0; color < 3; ++color) {
    EXPECT_NEAR(mean[color], 128, 4 * 8 / std::sqrt(8000.0));
    EXPECT_NEAR(spread[color], 8, 4 * 8 / std::sqrt(16000.0));
  }
  EXPECT_EQ(cv::norm(noisy, withCameraErrors(gray, camera, 0, 1)), 0) << "the same seed";
  EXPECT_NE(cv::norm(noisy, withCameraErrors(gray, camera, 0, 2)), 0);
}

}  // namespace
}  // namespace robosim
