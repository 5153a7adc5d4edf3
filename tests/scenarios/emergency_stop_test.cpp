// A driver's Stop, the driver's silence and the loss of the remote control brake a driven robot as hard as its type
// can.
#include <chrono>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "environment/environment.h"
#include "environment/local_hardware.h"
#include "environment/testing/small_world.h"
#include "maze/controllers.h"
#include "remote/remote_control_robot.h"
#include "robots/fleet.h"
#include "robots/robot_types.h"
#include "run/local_run.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;

/// A Pioneer in a large empty world, driven by Anna: 0.3 m/s² usually, 2 m/s² in an emergency; steps of 0.1 s.
class DrivenPioneer {
 public:
  explicit DrivenPioneer(double speed_mps) {
    World world = emptyWorld(20);
    Fleet fleet;
    FleetRobot robot = robotOfType(robotTypesIn({ROBOSIM_SOURCE_DIR "/worlds/robots"}), "pioneer3dx");
    robot.info.name = "P";
    fleet.robots.push_back(robot);
    environment_ = std::make_unique<Environment>(std::move(world), std::move(fleet), EnvironmentOptions{});
    hardware_ = std::make_unique<LocalHardware>(*environment_, 0);
    robot_ = std::make_unique<RemoteControlRobot>(*hardware_, makeController("still", {}, "P"),
                                                  RemoteControlRobot::Options{.now = [this] { return now_; }});
    robot_->take("Anna", false);
    for (int i = 0; i < 60; ++i) drive(speed_mps);
    EXPECT_DOUBLE_EQ(this->speed(), speed_mps);
  }

  RemoteControlRobot& robot() { return *robot_; }
  double speed() const { return environment_->state().speed_mps[0]; }
  void drive(double speed_mps) {
    robot_->obey(driveOrder(speed_mps, 0));
    step();
  }
  void step() {
    robot_->step();
    environment_->step();
    now_ += 100ms;
  }
  /// Takes steps until the robot stands. @return the distance driven in them [m]
  double pathToStand() {
    const double from_m = environment_->state().driven_m[0];
    for (int i = 0; i < 100 && (i == 0 || speed() != 0); ++i) step();
    return environment_->state().driven_m[0] - from_m;
  }

 private:
  std::chrono::steady_clock::time_point now_{};
  std::unique_ptr<Environment> environment_;
  std::unique_ptr<LocalHardware> hardware_;
  std::unique_ptr<RemoteControlRobot> robot_;
};

// From 1 m/s: 0.8, 0.6, 0.4, 0.2 and 0 m/s for 0.1 s each. From 0.44 m/s: 0.24, 0.04 and 0 m/s.
TEST(EmergencyStop, OfTheDriverBrakesWithin20CentimetresFrom1MetrePerSecond) {
  DrivenPioneer fast(1);
  fast.robot().obey(stopOrder());
  EXPECT_NEAR(fast.pathToStand(), 0.1 * (0.8 + 0.6 + 0.4 + 0.2), 1e-9);
  DrivenPioneer slow(0.44);
  slow.robot().obey(stopOrder());
  EXPECT_NEAR(slow.pathToStand(), 0.1 * (0.24 + 0.04), 1e-9);
}

// Without a stop, at 0.3 m/s²: 0.97, 0.94, … 0.01 m/s, 33 · 1 m/s - 0.03 m/s · (1 + 2 + … + 33).
TEST(EmergencyStop, IsNotMadeByADriverWhoSlowsDown) {
  DrivenPioneer pioneer(1);
  pioneer.drive(0);
  EXPECT_NEAR(pioneer.pathToStand() + 0.097, 0.1 * (33 - 0.03 * 33 * 34 / 2), 1e-9);
}

TEST(EmergencyStop, IsMadeWithoutAMessageOfTheDriverAndWithoutRemoteControl) {
  DrivenPioneer silent(1);  // the dead-man timeout is 0.5 s: 0.6 s after the last message
  EXPECT_NEAR(silent.pathToStand(), 0.5 * 1 + 0.1 * (0.8 + 0.6 + 0.4 + 0.2), 1e-9);
  EXPECT_EQ(silent.robot().state().why_stopped(), "no message from Anna for 0.5 s");
  DrivenPioneer lost(1);
  lost.robot().release("its remote control has disconnected");
  EXPECT_NEAR(lost.pathToStand(), 0.2, 1e-9);
}

TEST(EmergencyStop, IsReportedUntilTheRobotStands) {
  DrivenPioneer pioneer(0.44);
  EXPECT_FALSE(pioneer.robot().state().is_stopping());
  pioneer.robot().obey(stopOrder("Anna's page is hidden"));
  EXPECT_TRUE(pioneer.robot().state().is_stopping());
  pioneer.step();  // 0.24 m/s
  pioneer.step();  // 0.04 m/s
  pioneer.step();  // 0, as measured in the next step
  EXPECT_TRUE(pioneer.robot().state().is_stopping());
  pioneer.step();
  EXPECT_FALSE(pioneer.robot().state().is_stopping());
  EXPECT_EQ(pioneer.robot().state().why_stopped(), "Anna's page is hidden");
  pioneer.drive(0.1);
  EXPECT_DOUBLE_EQ(pioneer.speed(), 0.03) << "steered again";
  EXPECT_FALSE(pioneer.robot().state().is_stopping());
}

}  // namespace
}  // namespace robosim
