#include "control/robot.h"

#include <gtest/gtest.h>

#include "control/echo.h"
#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

TEST(Robot, ReadsTheFirstSensorOfEachKind) {
  FakeHardware hardware;
  hardware.setSonarRange(3, 1.5);
  hardware.setLaserRange(4);
  hardware.setHeat(7);
  hardware.mutableOdometry().odom_from_robot = {1, 2, 0.5};
  const Robot robot(hardware);
  EXPECT_EQ(robot.sonar().size(), 16u);
  EXPECT_EQ(robot.sonar()[3].range_m, 1.5f);
  EXPECT_EQ(robot.laser()[0].range_m, 4.f);
  EXPECT_EQ(robot.heat(), 7.);
  EXPECT_EQ(*robot.measurement(SensorKind::heat), Measurement(Scalar{7}));
  EXPECT_EQ(robot.measurement(robot.sensor(SensorKind::heat)->label), robot.measurement(SensorKind::heat));
  EXPECT_EQ(robot.odometry().odom_from_robot.y, 2);
  EXPECT_EQ(robot.sensor(SensorKind::heat)->range_max_m, 3);
}

TEST(Robot, ReturnsNoReadingForAMissingSensor) {
  FakeHardware hardware;
  const Robot robot(hardware);
  EXPECT_TRUE(robot.infrared().empty());
  EXPECT_TRUE(robot.bumper().empty());
  EXPECT_EQ(robot.compass(), std::nullopt);
  EXPECT_EQ(robot.measurement(SensorKind::values), nullptr);
  EXPECT_EQ(robot.measurement("range_and_bearing"), nullptr);
  EXPECT_EQ(robot.sensor(SensorKind::compass), nullptr);
}

TEST(Robot, WithoutAnySensorHasIdentityOdometry) {
  FakeHardware hardware;
  hardware.mutableInfo().sensors = std::make_shared<std::vector<SensorInfo>>();
  hardware.mutableReadings().measurements.clear();
  const Robot robot(hardware);
  EXPECT_EQ(robot.odometry(), Odometry{});
  EXPECT_TRUE(robot.sonar().empty());
  EXPECT_EQ(robot.heat(), std::nullopt);
}

TEST(Robot, ReturnsTheTimeOfItsReadings) {
  FakeHardware hardware;
  const Robot robot(hardware);
  for (int i = 0; i < 7; ++i) hardware.advance();
  EXPECT_EQ(robot.stepNumber(), 7u);
  EXPECT_DOUBLE_EQ(robot.time(), 0.7);
}

TEST(Robot, CommandsTheHeadOfItsCamera) {
  FakeHardware hardware;
  {
    Robot robot(hardware);
    robot.aimCamera(1, 1);
    robot.zoomCamera(3);
    EXPECT_EQ(hardware.lastCommand(), Command{}) << "it has none";
    EXPECT_EQ(robot.cameraAim(), CameraAim{});
    EXPECT_EQ(robot.cameraHead(), nullptr);
  }
  const std::size_t slot = hardware.addSensor(SensorKind::values, {}, CameraAim{0.25, 0.5, 2}.values());
  auto sensors = std::make_shared<std::vector<SensorInfo>>(*hardware.info().sensors);
  (*sensors)[slot].quantities = CameraAim::quantities();
  (*sensors)[slot].head.zoom_max = 16;
  hardware.mutableInfo().sensors = sensors;
  Robot robot(hardware);
  ASSERT_TRUE(robot.cameraHead());
  EXPECT_EQ(robot.cameraHead()->zoom_max, 16);
  EXPECT_EQ(robot.cameraAim(), (CameraAim{0.25, 0.5, 2}));
  robot.zoomCamera(3);
  robot.limitCameraSpeed(0.5, 0.25);
  robot.aimCamera(1, -0.5);
  robot.drive(0.5, 0);
  EXPECT_EQ(hardware.lastCommand(),
            (Command{.speed_mps = 0.5, .camera_head = CameraHeadCommand{{1, -0.5, 3}, 0.5, 0.25}}));
  robot.stopCamera();
  EXPECT_EQ(hardware.lastCommand(),
            (Command{.speed_mps = 0.5, .camera_head = CameraHeadCommand{{0.25, 0.5, 2}, 0.5, 0.25}}));
  robot.halt();
  EXPECT_EQ(hardware.lastCommand().camera_head->aim, (CameraAim{0.25, 0.5, 2}));
}

TEST(Robot, PassesItsCommandsOn) {
  FakeHardware hardware;
  Robot robot(hardware);
  robot.drive(0.3, -0.2);
  robot.panLaser(0.5);
  EXPECT_EQ(hardware.lastCommand(), (Command{.speed_mps = 0.3, .turn_radps = -0.2, .laser_pan_rad = 0.5f}));
  robot.stop();
  EXPECT_EQ(hardware.lastCommand(), (Command{.laser_pan_rad = 0.5f}));
}

TEST(Robot, HasALateralSpeedIfItsDriveIsOmnidirectional) {
  FakeHardware hardware;
  Robot robot(hardware);
  try {
    robot.drive(0.1, 0.2, 0.3);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(
        error.what(),
        "robot 'fake' has a drive of the type differential, which has no lateral speed; use 0, or a robot with "
        "<drive type=\"omni\"/>");
  }
  hardware.setDrive({.kind = DriveKind::omni});
  robot.drive(0.1, 0.2, 0.3);
  EXPECT_EQ(hardware.lastCommand(), (Command{.speed_mps = 0.1, .turn_radps = 0.2, .lateral_mps = 0.3}));
  robot.stop();
  EXPECT_EQ(hardware.lastCommand(), Command());
}

TEST(Robot, OnceHaltedIgnoresCommands) {
  FakeHardware hardware;
  Robot robot(hardware);
  robot.drive(0.3, 0.1);
  robot.halt(Activity::found);
  EXPECT_EQ(hardware.lastCommand(), Command{.activity = Activity::found});
  robot.drive(0.3, 0.1);
  EXPECT_EQ(hardware.lastCommand(), Command{.activity = Activity::found});
  EXPECT_EQ(robot.activity(), Activity::found);
}

TEST(Robot, KeepsThePanOfItsLaserWhenItHalts) {
  FakeHardware hardware;
  Robot robot(hardware);
  robot.panLaser(0.5);
  robot.halt();
  EXPECT_EQ(hardware.lastCommand(), (Command{.laser_pan_rad = 0.5F, .activity = Activity::halted}));
}

TEST(Robot, KeepsTheColourOfItsLedsWhileItDrivesStopsAndHalts) {
  FakeHardware hardware;
  Robot robot(hardware);
  EXPECT_EQ(robot.leds(), (std::array<float, 3>{0, 0, 0}));
  robot.setLeds({1, 0.2F, 0});
  EXPECT_EQ(hardware.lastCommand(), Command{.led_color = 0xff3300});
  EXPECT_EQ(robot.leds(), (std::array<float, 3>{1, 0.2F, 0}));
  robot.drive(0.3, 0.1);
  EXPECT_EQ(hardware.lastCommand(), (Command{.speed_mps = 0.3, .turn_radps = 0.1, .led_color = 0xff3300}));
  robot.stopInEmergency();
  EXPECT_EQ(hardware.lastCommand(), (Command{.emergency_stop = true, .led_color = 0xff3300}));
  robot.halt();
  robot.setLeds({-1, 2, 0});
  EXPECT_EQ(hardware.lastCommand(), (Command{.activity = Activity::halted, .led_color = 0x00ff00})) << "limited";
}

TEST(Robot, SendsAndReceivesMessages) {
  FakeHardware hardware;
  Robot robot(hardware);
  robot.send("other", "hello");
  ASSERT_EQ(hardware.sent.size(), 1u);
  EXPECT_EQ(hardware.sent[0], (RobotMessage{"fake", "other", "hello"}));
  hardware.mutableReadings().inbox.edit() = {{"other", "fake", "hi"}};
  ASSERT_EQ(robot.inbox().size(), 1u);
  EXPECT_EQ(robot.inbox()[0].text, "hi");
}

TEST(Robot, SendsABroadcastToEachOtherRobotOverHardwareWithoutBroadcasts) {
  FakeHardware hardware;
  hardware.robot_names = {"b", "fake", "a"};
  Robot robot(hardware);
  EXPECT_EQ(robot.robots(), hardware.robot_names);
  robot.broadcast("hi");
  EXPECT_EQ(hardware.sent, (std::vector<RobotMessage>{{"fake", "b", "hi"}, {"fake", "a", "hi"}}));
}

TEST(Robot, RequestsCheckWinFromItsReferee) {
  FakeHardware hardware;
  Robot robot(hardware);
  robot.checkWin();
  EXPECT_EQ(hardware.win_checks, 1);
}

/// The least that hardware has to implement: a robot without a referee.
class BareHardware : public Hardware {
 public:
  BareHardware() { info_.sensors = std::make_shared<std::vector<SensorInfo>>(); }
  const RobotInfo& info() const override { return info_; }
  const std::vector<std::string>& robots() const override { return robots_; }
  const Readings& readings() const override { return readings_; }
  void command(const Command&) override {}
  const Command& lastCommand() const override { return command_; }
  void send(const std::string&, const std::string&) override {}

 private:
  RobotInfo info_;
  std::vector<std::string> robots_;
  Readings readings_;
  Command command_;
};

TEST(Robot, IgnoresCheckWinOnHardwareWithoutAReferee) {
  BareHardware hardware;
  Robot robot(hardware);
  robot.checkWin();
  EXPECT_EQ(robot.winner(), "");
  EXPECT_FALSE(robot.readings().is_too_far);
}

TEST(Robot, HasNoBaseStateOnHardwareWithoutABaseController) {
  BareHardware hardware;
  Robot robot(hardware);
  robot.enableMotors(false);
  robot.enableSonar(false);
  EXPECT_EQ(robot.baseState(), BaseState{});
}

TEST(Robot, SwitchesMotorsAndSonarsOfItsBase) {
  FakeHardware hardware;
  hardware.base_link.emplace();
  Robot robot(hardware);
  EXPECT_EQ(robot.baseState().motors_enabled, true);
  robot.enableMotors(false);
  robot.enableSonar(false);
  EXPECT_EQ(robot.baseState().motors_enabled, false);
  EXPECT_FALSE(hardware.base_link->sonar_on);
}

TEST(Echo, RequiresARangeBelowTheSensorsMaximum) {
  // 8.1 has no exact float: the reading of a sensor without an echo must not count as an echo through rounding.
  SensorInfo sensor;
  sensor.range_max_m = sensor.no_echo_m = 8.1;
  EXPECT_FALSE(isEcho(sensor, {static_cast<float>(8.1), {}}));
  EXPECT_TRUE(isEcho(sensor, {8.09f, {}}));
}

}  // namespace
}  // namespace robosim
