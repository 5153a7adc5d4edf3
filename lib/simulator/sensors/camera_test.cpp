#include "sensors/camera.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "sensors/blob_finder.h"
#include "sensors/testing/single_robot_scene.h"

namespace robosim {
namespace {

/// ImageSource that records its calls and returns placeholder bytes.
class FakeImages : public ImageSource {
 public:
  void take(const CameraView& camera, const SeenWorld& seen, std::span<const std::uint32_t> robots,
            std::span<std::string> jpegs) override {
    ++calls;
    view = camera;
    poses.assign(seen.world_from_robot.begin(), seen.world_from_robot.end());
    for (std::size_t i = 0; i < robots.size(); ++i) jpegs[i] = "robot " + std::to_string(robots[i]);
  }
  std::vector<Blob> findBlobs(const std::string&, const std::vector<TargetColor>&, unsigned) override { return {}; }

  int calls = 0;
  CameraView view;
  std::vector<mrpt::math::TPose2D> poses;
};

std::string jpeg(const Measurement& measured) { return std::get<Image>(measured).jpeg; }

std::string cameraError(const std::string& xml) {
  try {
    sensorFrom(xml);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "none";
}

TEST(Camera, RendersFromItsMountingPose) {
  const auto camera = sensorFrom(
      "<camera x_m='0.1' y_m='-0.2' z_m='0.3' angle_deg='90' tilt_deg='-30' width_px='64' height_px='48' "
      "field_of_view_deg='90' jpeg_quality='70' antialias='1'/>");
  FakeImages images;
  SingleRobotScene robot({}, {1, 2, 0.5});
  robot.images = &images;
  EXPECT_EQ(jpeg(robot.sense(*camera)), "robot 0");
  EXPECT_EQ(images.poses, std::vector<mrpt::math::TPose2D>{robot.world_from_robot});
  EXPECT_EQ(images.view.info, (CameraInfo{64, 48, M_PI / 2, 10}));
  EXPECT_EQ(images.view.jpeg_quality, 70);
  EXPECT_TRUE(images.view.is_antialiased);
  const auto& pose = images.view.robot_from_camera;
  EXPECT_EQ(mrpt::math::TPoint3D(pose.x, pose.y, pose.z), mrpt::math::TPoint3D(0.1, -0.2, 0.3));
  // It faces the robot's left and 30° down.
  const auto ahead = pose.composePoint({1, 0, 0}) - pose.composePoint({0, 0, 0});
  EXPECT_NEAR(ahead.x, 0, 1e-12);
  EXPECT_NEAR(ahead.y, std::cos(M_PI / 6), 1e-12);
  EXPECT_NEAR(ahead.z, -0.5, 1e-12);
}

TEST(Camera, ReportsItsMountingPoseAndOptics) {
  const auto camera = sensorFrom("<camera x_m='0.1' z_m='0.3' field_of_view_deg='60' rate_hz='2' label='front'/>");
  const SensorInfo& info = camera->info();
  EXPECT_EQ(info.kind, SensorKind::camera);
  EXPECT_EQ(info.label, "front");
  ASSERT_EQ(info.beams.size(), 1u);
  EXPECT_EQ(info.beams[0].robot_from_beam, mrpt::math::TPose3D(0.1, 0, 0.3, 0, 0, 0));
  EXPECT_EQ(info.camera, (CameraInfo{320, 240, 60 * kRadPerDeg, 2}));
  EXPECT_EQ(std::get<Image>(camera->blank()), Image{});
}

TEST(Camera, ReportsItsLensAndTheMomentOfPicturesWithErrors) {
  const auto camera = sensorFrom(
      "<camera><noise std='3' exposure='0.5' exposure_std='0.1' rolling_shutter_s='0.03' k1='-0.2' k2='0.05' "
      "p1='0.001' "
      "p2='0.002' k3='0.01'/></camera>");
  EXPECT_EQ(camera->info().camera.distortion, (LensDistortion{-0.2, 0.05, 0.001, 0.002, 0.01}));
  EXPECT_TRUE(camera->isNoisy());
  FakeImages images;
  SingleRobotScene robot({});
  robot.images = &images;
  robot.motion = {0, 0.05};
  robot.sense(*camera);
  EXPECT_EQ(images.view.errors, (CameraErrors{3, 0.5, 0.1, 0.03}));
  ASSERT_EQ(images.view.moment.turn_radps.size(), 1u);
  EXPECT_NEAR(images.view.moment.turn_radps[0], 0.5, 1e-12);
  const auto first = images.view.moment.seeds;
  robot.sense(*camera);
  EXPECT_NE(images.view.moment.seeds, first);
}

TEST(Camera, RefusesALensThatDoesNotReachTheCorners) {
  // Corners at tan 30° · (1, 0.75): a radius of 0.722, beyond the largest of 0.544.
  EXPECT_EQ(
      cameraError("<camera><noise k1='-0.5'/></camera>"),
      "sensor.xml:1: <noise>: the distortion has no inverse at the corners of the picture; use smaller coefficients "
      "or field of view");
}

TEST(Camera, TakesPicturesAtItsRate) {
  const auto camera = sensorFrom("<camera rate_hz='2.5'/>");  // every fourth step of 0.1 s
  FakeImages images;
  SingleRobotScene robot({});
  robot.images = &images;
  std::string taken;
  for (int step = 1; step <= 9; ++step) taken += jpeg(robot.sense(*camera)).empty() ? '-' : 'x';
  EXPECT_EQ(taken, "---x---x-");
  EXPECT_EQ(images.calls, 2);
}

TEST(Camera, TakesNoPictureWithoutAnImageSource) {
  SingleRobotScene robot({});
  EXPECT_EQ(jpeg(robot.sense(*sensorFrom("<camera/>"))), "");
}

int picturesUntil(std::uint64_t last_step, double period_s, double rate_hz) {
  int pictures = 0;
  for (std::uint64_t step = 0; step <= last_step; ++step) pictures += takesPicture(rate_hz, {step, period_s});
  return pictures;
}

TEST(TakesPicture, KeepsItsRateForAnHourAtAnyStepLength) {
  // One at the start, then `rate_hz` per second, whether or not steps and pictures coincide.
  EXPECT_EQ(picturesUntil(36000, 0.1, 10), 1 + 36000);
  EXPECT_EQ(picturesUntil(36000, 0.1, 5), 1 + 18000);
  EXPECT_EQ(picturesUntil(36000, 0.1, 3), 1 + 10800);
  EXPECT_EQ(picturesUntil(360000, 0.01, 29.97), 1 + 107892);
  EXPECT_EQ(picturesUntil(36000, 0.1, 0.001), 1 + 3);
}

TEST(TakesPicture, TakesOneInEachStepAtTheStepRate) {
  // In double precision, 29 · 0.01 · 100 is less than 29.
  EXPECT_EQ(picturesUntil(1000, 0.01, 100), 1001);
  EXPECT_EQ(picturesUntil(1000, 0.1, 10), 1001);
}

TEST(TakesPicture, TakesOneInEachStepAtRatesAboveTheStepRate) {
  EXPECT_EQ(picturesUntil(100, 0.1, 30), 101);
  EXPECT_EQ(picturesUntil(100, 0.1, 1000), 101);
}

TEST(Camera, RejectsInvalidSettings) {
  EXPECT_EQ(cameraError("<camera width_px='2049'/>"),
            "sensor.xml:1: <camera width_px=\"2049\">: must lie in [1, 2048] pixels; drop it for the default, 320");
  EXPECT_EQ(cameraError("<camera height_px='0'/>"),
            "sensor.xml:1: <camera height_px=\"0\">: must lie in [1, 2048] pixels; drop it for the default, 240");
  EXPECT_EQ(cameraError("<camera height_px='9.5'/>"),
            "sensor.xml:1: <camera height_px=\"9.5\">: must be a whole number of pixels");
  EXPECT_EQ(
      cameraError("<camera field_of_view_deg='180'/>"),
      "sensor.xml:1: <camera field_of_view_deg=\"180\">: must lie in [1, 170] degrees; drop it for the default, 60");
  EXPECT_EQ(cameraError("<camera rate_hz='0'/>"),
            "sensor.xml:1: <camera rate_hz=\"0\">: must lie in (0, 1000] hertz; drop it for the default, 10");
  EXPECT_EQ(cameraError("<camera tilt_deg='91'/>"),
            "sensor.xml:1: <camera tilt_deg=\"91\">: must lie in [-90, 90] degrees; drop it for the default, 0");
  EXPECT_EQ(
      cameraError("<camera zoom='2'/>"),
      "sensor.xml:1: <camera>: unknown attribute zoom=\"2\"; accepted here are: angle_deg, antialias, "
      "field_of_view_deg, "
      "height_px, jpeg_quality, label, layers, model, noise, ptz, range_max_m, rate_hz, tilt_deg, width_px, x_m, y_m, "
      "z_m");
}

}  // namespace
}  // namespace robosim
