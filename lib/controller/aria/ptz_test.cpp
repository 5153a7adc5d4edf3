#include "aria/ptz.h"

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

constexpr double kDeg = kRadPerDeg;

/// A robot with a camera of 45° on a head with other limits on each side.
struct Seeing {
  FakeHardware hardware;
  std::size_t slot = hardware.addSensor(SensorKind::values, {}, CameraAim{}.values());

  Seeing() {
    const std::size_t camera = hardware.addSensor(SensorKind::camera, {0}, Image{});
    auto sensors = std::make_shared<std::vector<SensorInfo>>(*hardware.info().sensors);
    (*sensors)[slot].quantities = CameraAim::quantities();
    (*sensors)[slot].head = {-98 * kDeg, 80 * kDeg, -30 * kDeg, 88 * kDeg, 15, 90 * kDeg, 69 * kDeg, 5};
    (*sensors)[camera].pans = true;
    (*sensors)[camera].camera = {320, 240, 45 * kDeg, 10};
    hardware.mutableInfo().sensors = sensors;
  }
  void set(const CameraAim& aim) { hardware.mutableReadings().measurements[slot] = aim.values(); }
  const CameraHeadCommand& commanded() const { return *hardware.lastCommand().camera_head; }
};

TEST(AriaPtz, CommandsDegreesToTheRightAndUp) {
  Seeing of;
  Robot robot(of.hardware);
  PTZ ptz(robot);
  EXPECT_TRUE(ptz.panTilt(30, -10));
  EXPECT_NEAR(of.commanded().aim.pan_rad, -30 * kDeg, 1e-12);
  EXPECT_NEAR(of.commanded().aim.tilt_rad, -10 * kDeg, 1e-12);
  ptz.panRel(-50);
  ptz.tiltRel(15);
  EXPECT_NEAR(of.commanded().aim.pan_rad, 20 * kDeg, 1e-12);
  EXPECT_NEAR(of.commanded().aim.tilt_rad, 5 * kDeg, 1e-12);
  ptz.tilt(0);
  ptz.pan(7);
  EXPECT_NEAR(of.commanded().aim.pan_rad, -7 * kDeg, 1e-12);
  EXPECT_EQ(of.commanded().aim.tilt_rad, 0);
  ptz.setInverted(true);
  ptz.panTilt(10, 20);
  EXPECT_NEAR(of.commanded().aim.pan_rad, 10 * kDeg, 1e-12);
  EXPECT_NEAR(of.commanded().aim.tilt_rad, -20 * kDeg, 1e-12);
}

TEST(AriaPtz, LimitsCommandsToTheCamera) {
  Seeing of;
  Robot robot(of.hardware);
  PTZ ptz(robot);
  EXPECT_NEAR(ptz.getMaxPosPan(), 98, 1e-9);
  EXPECT_NEAR(ptz.getMaxNegPan(), -80, 1e-9);
  EXPECT_NEAR(ptz.getMaxTilt(), 88, 1e-9);
  EXPECT_NEAR(ptz.getMinTilt(), -30, 1e-9);
  EXPECT_NEAR(ptz.getMaxPanSpeed(), 90, 1e-9);
  EXPECT_NEAR(ptz.getMaxTiltSlew(), 69, 1e-9);
  ptz.panTilt(-120, 100);
  EXPECT_NEAR(of.commanded().aim.pan_rad, 80 * kDeg, 1e-12);
  ptz.panRel(10);
  EXPECT_NEAR(of.commanded().aim.pan_rad, 70 * kDeg, 1e-12) << "from the limit";
  EXPECT_NEAR(of.commanded().aim.tilt_rad, 88 * kDeg, 1e-12);
  ptz.setInverted(true);
  EXPECT_NEAR(ptz.getMaxPosPan(), 80, 1e-9);
  EXPECT_NEAR(ptz.getMaxNegTilt(), -88, 1e-9);
}

TEST(AriaPtz, CountsTheZoomAsACanonDoes) {
  Seeing of;
  Robot robot(of.hardware);
  PTZ ptz(robot);
  EXPECT_EQ(ptz.getMaxZoom(), 1960);
  EXPECT_TRUE(ptz.zoom(980));
  EXPECT_NEAR(of.commanded().aim.zoom, 8, 1e-12) << "half of the way from 1 to 15";
  ptz.zoomRel(140);
  EXPECT_NEAR(of.commanded().aim.zoom, 9, 1e-12);
  ptz.zoom(5000);
  EXPECT_NEAR(of.commanded().aim.zoom, 15, 1e-12);
  EXPECT_NEAR(ptz.getFOVAtMinZoom(), 45, 1e-9);
  EXPECT_NEAR(ptz.getFOVAtMaxZoom(), 3, 1e-9);
}

TEST(AriaPtz, ReportsWhereTheCameraIsAndHaltsItThere) {
  Seeing of;
  Robot robot(of.hardware);
  PTZ ptz(robot);
  of.set({0.5 * kDeg, 20 * kDeg, 8});
  ptz.panTilt(90, 40);
  ptz.zoom(0);
  ptz.panSlew(45);
  EXPECT_NEAR(ptz.getPan(), -0.5, 1e-9);
  EXPECT_NEAR(ptz.getTilt(), 20, 1e-9);
  EXPECT_EQ(ptz.getZoom(), 980);
  EXPECT_NEAR(ptz.getPanSlew(), 45, 1e-9);
  EXPECT_NEAR(ptz.getTiltSlew(), 69, 1e-9);
  EXPECT_NEAR(of.commanded().pan_radps, 45 * kDeg, 1e-12);
  ptz.haltPanTilt();
  EXPECT_EQ(of.commanded().aim, (CameraAim{0.5 * kDeg, 20 * kDeg, 1}));
  ptz.haltZoom();
  EXPECT_EQ(of.commanded().aim.zoom, 8);
  robot.drive(0.5, 1);
  robot.stopInEmergency();
  EXPECT_EQ(of.commanded().aim, (CameraAim{0.5 * kDeg, 20 * kDeg, 8})) << "whatever the robot drives";
  EXPECT_TRUE(ptz.init());
  EXPECT_EQ(of.commanded().aim, CameraAim{});
}

TEST(AriaPtz, IsMissingOnARobotWithoutOne) {
  FakeHardware hardware;
  Robot robot(hardware);
  PTZ ptz(robot);
  EXPECT_FALSE(ptz.panTilt(10, 10));
  EXPECT_FALSE(ptz.zoom(10));
  EXPECT_FALSE(ptz.canZoom());
  EXPECT_EQ(ptz.getMaxZoom(), 0);
  EXPECT_EQ(ptz.getMaxPan(), 0);
  EXPECT_EQ(ptz.getZoom(), 0);
  EXPECT_EQ(hardware.lastCommand(), Command{});
}

}  // namespace
}  // namespace robosim
