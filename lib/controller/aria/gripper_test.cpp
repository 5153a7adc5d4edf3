#include "aria/gripper.h"

#include <gtest/gtest.h>

#include "control/testing/fake_hardware.h"
#include "hardware/gripper_state.h"

namespace robosim {
namespace {

struct Gripping {
  FakeHardware hardware;
  std::size_t slot = hardware.addSensor(SensorKind::values, {}, GripperState{}.values());

  Gripping() {
    auto sensors = std::make_shared<std::vector<SensorInfo>>(*hardware.info().sensors);
    (*sensors)[slot].quantities = GripperState::quantities();
    hardware.mutableInfo().sensors = sensors;
  }
  void set(const GripperState& state) { hardware.mutableReadings().measurements[slot] = state.values(); }
};

TEST(AriaGripper, OpensAndClosesByCommand) {
  Gripping of;
  Robot robot(of.hardware);
  Gripper gripper(robot);
  EXPECT_EQ(gripper.getType(), Gripper::GENIO);
  EXPECT_TRUE(gripper.gripClose());
  EXPECT_TRUE(of.hardware.lastCommand().grip);
  robot.drive(0.5, 1);
  robot.stopInEmergency();
  EXPECT_TRUE(of.hardware.lastCommand().grip) << "it stays closed whatever the robot drives";
  EXPECT_TRUE(gripper.gripperDeploy());
  EXPECT_FALSE(of.hardware.lastCommand().grip);
}

TEST(AriaGripper, ReportsItsStateAsAriaDoes) {
  Gripping of;
  Robot robot(of.hardware);
  const Gripper gripper(robot);
  EXPECT_EQ(gripper.getGripState(), 1);
  EXPECT_EQ(gripper.getPaddleState(), 0);
  of.set({.is_closed = true, .holds = true, .inner_beam = true});
  EXPECT_TRUE(robot.held());
  EXPECT_EQ(gripper.getGripState(), 2);
  EXPECT_EQ(gripper.getPaddleState(), 3);
  EXPECT_EQ(gripper.getBreakBeamState(), 1);
  EXPECT_TRUE(gripper.isLiftMaxed());
  EXPECT_EQ(gripper.stateText(), "lift at its end, paddles closed, light barriers interrupted: inner");
  of.set({.outer_beam = true});
  EXPECT_EQ(gripper.getBreakBeamState(), 2);
}

TEST(AriaGripper, IsMissingOnARobotWithoutOne) {
  FakeHardware hardware;
  Robot robot(hardware);
  Gripper gripper(robot);
  EXPECT_EQ(gripper.getType(), Gripper::NOGRIPPER);
  EXPECT_FALSE(gripper.gripClose());
  EXPECT_EQ(gripper.getGripState(), 0);
  EXPECT_EQ(gripper.stateText(), "There is no gripper.");
}

}  // namespace
}  // namespace robosim
