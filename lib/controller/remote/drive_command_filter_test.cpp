#include "remote/drive_command_filter.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using namespace std::chrono_literals;

constexpr MotionLimits kLimits{
    .speed_max_mps = 2, .turn_max_radps = 1, .accel_mps2 = 0.5, .decel_mps2 = 1, .turn_accel_radps2 = 4};

struct DriveCommandFilterTest : testing::Test {
  DriveCommandFilter filter{kLimits};
  DriveCommandFilter::Clock::time_point now{1h};

  DriveCommandFilterTest() { filter.begin(now); }
  void order(OrderType type) { filter.obey(makeOrder(type), now); }
  void drive(std::optional<double> speed_mps, std::optional<double> turn_radps) {
    filter.obey(driveOrder(speed_mps, turn_radps), now);
  }
  Command command() { return filter.command(now, "Anna"); }
};

TEST_F(DriveCommandFilterTest, StandsUntilTheFirstOrder) {
  EXPECT_EQ(command(), (Command{.speed_mps = 0, .turn_radps = 0, .by_driver = true}));
  EXPECT_EQ(filter.whyStopped(), "");
}

TEST_F(DriveCommandFilterTest, AcceleratesByATenthOfTheMaximum) {
  for (const double expected : {0.2, 0.4, 0.6}) {
    order(OrderType::accelerate);
    EXPECT_DOUBLE_EQ(command().speed_mps, expected);
  }
  for (int i = 0; i < 20; ++i) order(OrderType::accelerate);
  EXPECT_DOUBLE_EQ(command().speed_mps, 2);
}

TEST_F(DriveCommandFilterTest, ClampsALateralSpeedToTheMaximumWhichMostRobotsLack) {
  filter.obey(driveOrder(1, {}, {}, 0.5), now);
  EXPECT_EQ(command(), (Command{.speed_mps = 1, .by_driver = true}));
  MotionLimits limits = kLimits;
  limits.lateral_max_mps = 0.4;
  filter = DriveCommandFilter(limits);
  filter.begin(now);
  filter.obey(driveOrder({}, {}, {}, -0.5), now);
  EXPECT_EQ(command(), (Command{.by_driver = true, .lateral_mps = -0.4}));
  filter.obey(stopOrder("left"), now);
  EXPECT_EQ(command().lateral_mps, 0);
}

TEST_F(DriveCommandFilterTest, DeceleratesThroughStandstillToDrivingBackwards) {
  drive(0.4, {});
  for (const double expected : {0.2, 0.0, -0.2}) {
    order(OrderType::decelerate);
    EXPECT_EQ(command().speed_mps, expected);
  }
  for (int i = 0; i < 20; ++i) order(OrderType::decelerate);
  EXPECT_DOUBLE_EQ(command().speed_mps, -2);
}

TEST_F(DriveCommandFilterTest, TurnsFor300MillisecondsAfterTheLastTurnOrder) {
  order(OrderType::turn_left);
  EXPECT_DOUBLE_EQ(command().turn_radps, 0.5);
  now += 200ms;
  order(OrderType::turn_left);
  now += 299ms;
  EXPECT_DOUBLE_EQ(command().turn_radps, 0.5);
  now += 1ms;
  EXPECT_EQ(command().turn_radps, 0);
  order(OrderType::turn_right);
  EXPECT_DOUBLE_EQ(command().turn_radps, -0.5);
}

TEST_F(DriveCommandFilterTest, KeepsTheSpeedDuringATurn) {
  drive(1, {});
  order(OrderType::turn_right);
  EXPECT_EQ(command().speed_mps, 1);
}

TEST_F(DriveCommandFilterTest, LimitsSpeedAndTurnToTheMaximum) {
  drive(1.5, -0.25);
  EXPECT_EQ(command().speed_mps, 1.5);
  EXPECT_EQ(command().turn_radps, -0.25);
  drive(-100, 100);
  EXPECT_EQ(command().speed_mps, -2);
  EXPECT_EQ(command().turn_radps, 1);
}

TEST_F(DriveCommandFilterTest, KeepsValuesThatADriveOrderOmits) {
  drive(1, 0.5);
  drive({}, 0.25);
  EXPECT_EQ(command().speed_mps, 1);
  drive(0.5, {});
  EXPECT_EQ(command().turn_radps, 0.25);
}

TEST_F(DriveCommandFilterTest, ATurnSetByDriveDoesNotExpire) {
  order(OrderType::turn_left);
  drive({}, 0.25);
  now += 400ms;
  EXPECT_EQ(command().turn_radps, 0.25);
}

TEST_F(DriveCommandFilterTest, StopsOnAStopOrder) {
  drive(1, 1);
  order(OrderType::stop);
  EXPECT_EQ(command(), (Command{.by_driver = true, .emergency_stop = true}));
  EXPECT_EQ(filter.whyStopped(), "");
}

TEST_F(DriveCommandFilterTest, MakesAnEmergencyStopUntilTheRobotStands) {
  drive(1, 1);
  order(OrderType::stop);
  drive(0.5, 0);
  EXPECT_TRUE(command().emergency_stop) << "a later order takes effect when the robot stands";
  filter.endStop();
  EXPECT_EQ(command(), (Command{.speed_mps = 0.5, .by_driver = true}));
  drive(0, 0);
  EXPECT_EQ(command(), (Command{.by_driver = true})) << "no stop";
}

TEST_F(DriveCommandFilterTest, ReportsTheReasonOfAStopThatTheDriverDidNotRequest) {
  filter.obey(stopOrder("Anna's page is hidden"), now);
  EXPECT_EQ(filter.whyStopped(), "") << "the robot stood";
  drive(1, 1);
  filter.obey(stopOrder("Anna's page is hidden"), now);
  EXPECT_EQ(command(), (Command{.by_driver = true, .emergency_stop = true}));
  EXPECT_EQ(filter.whyStopped(), "Anna's page is hidden");
  order(OrderType::stop);
  EXPECT_EQ(filter.whyStopped(), "");
}

TEST_F(DriveCommandFilterTest, StopsAfterTheDeadManTimeoutAndReportsTheReason) {
  drive(1, 0.5);
  now += 500ms;
  EXPECT_EQ(command().speed_mps, 1);
  now += 1ms;
  EXPECT_EQ(command(), (Command{.by_driver = true, .emergency_stop = true}));
  EXPECT_EQ(filter.whyStopped(), "no message from Anna for 0.5 s");
}

TEST_F(DriveCommandFilterTest, CountsStopsWithAReason) {
  drive(1, 1);
  order(OrderType::stop);
  EXPECT_EQ(filter.stops(), 0u) << "the driver has requested it";
  drive(1, 1);
  now += 501ms;
  command();
  command();
  EXPECT_EQ(filter.stops(), 1u) << "the dead-man timeout, once";
  drive(1, 1);
  EXPECT_EQ(filter.whyStopped(), "");
  filter.obey(stopOrder("Anna's page is hidden"), now);
  EXPECT_EQ(filter.stops(), 2u);
  filter.begin(now);
  EXPECT_EQ(filter.stops(), 2u);
}

TEST_F(DriveCommandFilterTest, AliveResetsTheDeadManTimeout) {
  drive(1, 0);
  for (int i = 0; i < 10; ++i) {
    now += 400ms;
    order(OrderType::alive);
    EXPECT_EQ(command().speed_mps, 1);
  }
}

TEST_F(DriveCommandFilterTest, StandsAfterATimeoutUntilTheNextOrder) {
  drive(1, 0);
  now += 1s;
  command();
  order(OrderType::alive);
  EXPECT_EQ(command().speed_mps, 0);
  EXPECT_NE(filter.whyStopped(), "");
  order(OrderType::accelerate);
  EXPECT_DOUBLE_EQ(command().speed_mps, 0.2);
  EXPECT_EQ(filter.whyStopped(), "");
}

TEST_F(DriveCommandFilterTest, ReportsNoTimeoutOfAStandingRobot) {
  now += 1h;
  command();
  EXPECT_EQ(filter.whyStopped(), "");
}

TEST_F(DriveCommandFilterTest, AnOrderOlderThanTheTimeoutHasNoEffect) {
  const auto came = now;
  now += 1s;
  filter.obey(makeOrder(OrderType::accelerate), came);
  EXPECT_EQ(command().speed_mps, 0);
  EXPECT_EQ(filter.whyStopped(), "no message from Anna for 0.5 s");
}

TEST_F(DriveCommandFilterTest, StopsAtOnceWhenTheDriverDisconnects) {
  drive(1, 0);
  filter.release("its remote control has disconnected");
  EXPECT_EQ(command(), (Command{.by_driver = true, .emergency_stop = true}));
  EXPECT_EQ(filter.whyStopped(), "its remote control has disconnected");
}

TEST_F(DriveCommandFilterTest, HasAConfigurableDeadManTimeout) {
  DriveCommandFilter patient(kLimits, 2500ms);
  patient.begin(now);
  patient.obey(makeOrder(OrderType::accelerate), now);
  now += 2500ms;
  EXPECT_DOUBLE_EQ(patient.command(now, "Anna").speed_mps, 0.2);
  now += 1ms;
  patient.command(now, "Anna");
  EXPECT_EQ(patient.whyStopped(), "no message from Anna for 2.5 s");
}

}  // namespace
}  // namespace robosim
