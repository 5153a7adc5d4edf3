#include "remote/remote_control_robot.h"

#include <gtest/gtest.h>

#include "control/testing/fake_hardware.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;

/// Drives ahead at 0.5 m/s, and records its messages.
class Cruiser : public Controller {
 public:
  explicit Cruiser(std::vector<std::string>& received) : received_(received) {}
  void step(Robot& robot) override {
    for (const auto& message : robot.inbox()) received_.push_back(message.text);
    if (robot.heat() > 10) {
      robot.halt(Activity::found);
    } else {
      robot.drive(0.5, 0);
    }
  }

 private:
  std::vector<std::string>& received_;
};

/// Commands its robot once and then never again.
class OnlyOnce : public Controller {
 public:
  void step(Robot& robot) override {
    if (!done_) robot.drive(0.25, 0);
    done_ = true;
  }

 private:
  bool done_ = false;
};

struct RemoteControlRobotTest : testing::Test {
  FakeHardware hardware;
  std::vector<std::string> received, log;
  RemoteControlRobot::Clock::time_point now{1h};
  RemoteControlRobot::Options options{
      .now = [this] { return now; },
      .log = [this](const std::string& line) { log.push_back(line); },
  };
  RemoteControlRobot robot{hardware, std::make_unique<Cruiser>(received), options};

  /// A time step of a tenth of a second.
  void step() {
    robot.step();
    hardware.advance();
    now += 100ms;
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }
};

TEST_F(RemoteControlRobotTest, IsAutonomousInitially) {
  step();
  EXPECT_EQ(hardware.lastCommand(), (Command{.speed_mps = 0.5}));
  EXPECT_TRUE(robot.state().autonomous());
  EXPECT_EQ(robot.state().speed_mps(), 0.5);
}

TEST_F(RemoteControlRobotTest, ExecutesTheDriversOrdersInsteadOfTheControllers) {
  step();
  robot.take("Anna", false);
  step();
  EXPECT_EQ(hardware.lastCommand(), (Command{.by_driver = true})) << "stands until it is steered";
  robot.obey(driveOrder(-0.25, 1));
  step();
  EXPECT_EQ(hardware.lastCommand(), (Command{.speed_mps = -0.25, .turn_radps = 1, .by_driver = true}));
  EXPECT_EQ(robot.state().driver(), "Anna");
  EXPECT_EQ(robot.state().turn_radps(), 1);
}

TEST_F(RemoteControlRobotTest, DiscardsAPendingOrderWhenADriverTakesIt) {
  robot.take("Anna", false);
  step();
  robot.obey(driveOrder(0.5, 1));
  robot.take("Bert", false);
  step();
  EXPECT_EQ(hardware.lastCommand(), (Command{.by_driver = true}));
}

TEST_F(RemoteControlRobotTest, ExecutesTheControllersCommandsAgainWhenSetAutonomous) {
  robot.take("Anna", false);
  robot.obey(driveOrder(-0.25, 1));
  step();
  robot.setAutonomous(true);
  step();
  EXPECT_EQ(hardware.lastCommand(), (Command{.speed_mps = 0.5}));
  robot.obey(driveOrder(0.1, 0));
  step();
  EXPECT_EQ(hardware.lastCommand(), (Command{.speed_mps = 0.5})) << "an autonomous robot is not steered";
}

TEST_F(RemoteControlRobotTest, ChangesTheSourceOfCommandsWithoutAJumpInSpeed) {
  steps(20);
  double before = hardware.odometry().speed_mps;
  EXPECT_EQ(before, 0.5);
  const auto& limits = hardware.info().type->limits;
  for (int i = 0; i < 60; ++i) {
    if (i == 0) robot.take("Anna", false);
    if (i % 10 == 5) robot.obey(driveOrder(1, 2));
    if (i == 30) robot.setAutonomous(true);
    if (i == 45) robot.setAutonomous(false);
    step();
    const double change = hardware.odometry().speed_mps - before;
    EXPECT_LE(change, limits.accel_mps2 * 0.1 + 1e-12);
    EXPECT_GE(change, -limits.decel_mps2 * 0.1 - 1e-12);
    before = hardware.odometry().speed_mps;
  }
}

TEST_F(RemoteControlRobotTest, RepeatsTheControllersLastCommandAfterRemoteControl) {
  RemoteControlRobot once(hardware, std::make_unique<OnlyOnce>(), options);
  once.step();
  once.take("Anna", false);
  once.obey(driveOrder(1, 1));
  once.step();
  once.setAutonomous(true);
  once.step();
  EXPECT_EQ(hardware.lastCommand(), (Command{.speed_mps = 0.25}));
}

TEST_F(RemoteControlRobotTest, DeliversMessagesReceivedDuringRemoteControlToTheController) {
  const auto deliver = [&](const std::string& text) {
    hardware.mutableReadings().inbox.edit() = {{"other", hardware.info().name, text}};
  };
  robot.take("Anna", false);
  deliver("first");
  step();
  deliver("second");
  step();
  EXPECT_TRUE(received.empty());
  robot.setAutonomous(true);
  deliver("third");
  step();
  EXPECT_EQ(received, (std::vector<std::string>{"first", "second", "third"}));
  step();
  EXPECT_EQ(received.size(), 3u) << "each of them once";
}

TEST_F(RemoteControlRobotTest, ExecutesTheNewestOfSeveralOrdersOfAStep) {
  robot.take("Anna", false);
  for (int i = 0; i < 1000; ++i) robot.obey(makeOrder(OrderType::accelerate));
  step();
  EXPECT_DOUBLE_EQ(hardware.lastCommand().speed_mps, 0.1) << "a tenth of the maximum, once";
  robot.obey(driveOrder(1, 0));
  robot.obey(driveOrder(0.25, 0));
  robot.obey(makeOrder(OrderType::alive));
  step();
  EXPECT_EQ(hardware.lastCommand().speed_mps, 0.25);
}

TEST_F(RemoteControlRobotTest, StopsAfterTheDeadManTimeoutAndLogsTheReasonOnce) {
  robot.take("Anna", false);
  robot.obey(driveOrder(0.5, 0));
  steps(6);
  EXPECT_EQ(hardware.lastCommand().speed_mps, 0.5);
  steps(3);
  EXPECT_EQ(hardware.lastCommand(), (Command{.by_driver = true, .emergency_stop = true}));
  EXPECT_EQ(robot.state().why_stopped(), "no message from Anna for 0.5 s");
  EXPECT_EQ(log, std::vector<std::string>{"fake stops: no message from Anna for 0.5 s"});
}

TEST_F(RemoteControlRobotTest, LogsTheReasonOfARemoteControlsStop) {
  robot.take("Anna", false);
  robot.obey(driveOrder(0.5, 0));
  step();
  robot.obey(stopOrder("Anna's page is hidden"));
  step();
  EXPECT_EQ(hardware.lastCommand().speed_mps, 0);
  EXPECT_EQ(log, std::vector<std::string>{"fake stops: Anna's page is hidden"});
}

TEST_F(RemoteControlRobotTest, AStopOfTheDriverEndsTheAutonomousMode) {
  robot.take("Anna", true);
  steps(20);
  EXPECT_EQ(hardware.odometry().speed_mps, 0.5) << "its controller drives";
  robot.obey(makeOrder(OrderType::stop));
  EXPECT_FALSE(robot.state().autonomous());
  step();
  EXPECT_EQ(hardware.lastCommand(), (Command{.by_driver = true, .emergency_stop = true}));
  EXPECT_EQ(robot.state().why_stopped(), "");
  EXPECT_EQ(log, std::vector<std::string>{"fake stops, and is no longer autonomous"});
  steps(10);
  EXPECT_EQ(hardware.odometry().speed_mps, 0) << "it stands until it is steered";
}

TEST_F(RemoteControlRobotTest, AStopWithAReasonHasNoEffectInAutonomousMode) {
  robot.take("Anna", true);
  step();
  robot.obey(stopOrder("Anna's page is hidden"));
  step();
  EXPECT_TRUE(robot.state().autonomous());
  EXPECT_EQ(hardware.lastCommand(), (Command{.speed_mps = 0.5}));
  EXPECT_EQ(log, std::vector<std::string>{});
}

TEST_F(RemoteControlRobotTest, ALaterOrderOfTheSameStepDoesNotSupersedeAStop) {
  robot.take("Anna", false);
  robot.obey(driveOrder(0.5, 0));
  step();
  robot.obey(makeOrder(OrderType::stop));
  robot.obey(driveOrder({}, 1));
  step();
  EXPECT_EQ(hardware.lastCommand(), (Command{.turn_radps = 1, .by_driver = true, .emergency_stop = true}));
}

TEST_F(RemoteControlRobotTest, MergesDriveOrdersOfAStep) {
  robot.take("Anna", false);
  robot.obey(driveOrder(0.5, 0));
  step();
  robot.obey(driveOrder(0));
  robot.obey(driveOrder({}, 1));
  step();
  EXPECT_EQ(hardware.lastCommand(), (Command{.turn_radps = 1, .by_driver = true}));
  robot.obey(driveOrder(0, 0));
  robot.obey(makeOrder(OrderType::accelerate));
  step();
  EXPECT_EQ(hardware.lastCommand(), (Command{.speed_mps = 0.1, .by_driver = true})) << "a tenth of its maximum";
}

TEST_F(RemoteControlRobotTest, StopsAndHasNoDriverWhenTheDriverDisconnects) {
  robot.take("Anna", false);
  robot.obey(driveOrder(0.5, 0));
  step();
  robot.release("its remote control has disconnected");
  step();
  EXPECT_EQ(hardware.lastCommand().speed_mps, 0);
  EXPECT_EQ(robot.state().driver(), "");
  EXPECT_FALSE(robot.state().autonomous()) << "it waits for the next driver";
  EXPECT_EQ(log, std::vector<std::string>{"fake stops: its remote control has disconnected"});
}

TEST_F(RemoteControlRobotTest, AnAutonomousRobotContinuesWhenTheDriverDisconnects) {
  robot.take("Anna", true);
  step();
  robot.release("its remote control has disconnected");
  step();
  EXPECT_EQ(hardware.lastCommand().speed_mps, 0.5);
  EXPECT_TRUE(log.empty());
}

TEST_F(RemoteControlRobotTest, RequestsCheckWinOnceAndCountsRefusals) {
  robot.take("Anna", false);
  robot.obey(makeOrder(OrderType::check_win));
  step();
  step();
  EXPECT_EQ(hardware.win_checks, 1);
  hardware.mutableReadings().is_too_far = true;
  step();
  hardware.mutableReadings().is_too_far = false;
  step();
  EXPECT_EQ(robot.state().win_refusals(), 1u);
}

TEST_F(RemoteControlRobotTest, AddsTheDistanceDrivenInAllModes) {
  hardware.mutableOdometry().odom_from_robot = {5, 5, 0};  // where the odometry begins does not count
  step();
  EXPECT_EQ(robot.state().driven_m(), 0);
  robot.take("Anna", false);
  hardware.mutableOdometry().odom_from_robot = {8, 9, 0};
  step();
  EXPECT_DOUBLE_EQ(robot.state().driven_m(), 5);
  robot.setAutonomous(true);
  hardware.mutableOdometry().odom_from_robot = {8, 7, 1};
  step();
  EXPECT_DOUBLE_EQ(robot.state().driven_m(), 7);
}

TEST_F(RemoteControlRobotTest, ReportsTheWinnerAndHalts) {
  hardware.mutableReadings().winner = "other";
  step();
  EXPECT_EQ(robot.state().winner(), "other");
  EXPECT_EQ(robot.state().activity(), v1::ACTIVITY_HALTED);
}

TEST_F(RemoteControlRobotTest, ARobotHaltedByItsControllerStaysHalted) {
  hardware.setHeat(20);
  step();
  robot.take("Anna", false);
  robot.obey(driveOrder(0.5, 0));
  step();
  EXPECT_EQ(hardware.lastCommand().activity, Activity::found);
  EXPECT_EQ(robot.state().activity(), v1::ACTIVITY_FOUND);
}

}  // namespace
}  // namespace robosim
