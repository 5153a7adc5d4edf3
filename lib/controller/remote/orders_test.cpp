#include "remote/orders.h"

#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "control/testing/fake_hardware.h"
#include "remote/remote_control_robot.h"
#include "remote/response_outbox.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;

v1::ControlRequest transmitted(const v1::ControlRequest& order) {
  v1::ControlRequest received;
  received.ParseFromString(order.SerializeAsString());
  validate(received);
  return received;
}

std::string errorAfter(const std::function<void(v1::ControlRequest&)>& modify) {
  v1::ControlRequest message;
  modify(message);
  try {
    validate(message);
  } catch (const WireError& error) {
    return error.what();
  }
  return "";
}

TEST(Orders, EachRowIsAMessageOfItsOwn) {
  std::set<std::string> messages, names;
  for (const OrderRow& row : kOrders) {
    const v1::ControlRequest order = transmitted(makeOrder(row.type));
    EXPECT_EQ(typeOf(order), row.type) << row.name;
    EXPECT_EQ(order.request_case(), row.request) << row.name;
    messages.insert(order.SerializeAsString());
    names.insert(row.name);
  }
  EXPECT_EQ(messages.size(), kOrders.size());
  EXPECT_EQ(names.size(), kOrders.size());
}

TEST(Orders, EachRequestOfTheProtocolBesidesTheSessionsHasARow) {
  const auto* const request = v1::ControlRequest::descriptor()->FindOneofByName("request");
  for (int i = 0; i < request->field_count(); ++i) {
    const std::string& name = request->field(i)->name();
    const bool has_row = std::any_of(kOrders.begin(), kOrders.end(),
                                     [&](const OrderRow& row) { return row.request == request->field(i)->number(); });
    EXPECT_EQ(has_row, name != "init" && name != "req_all") << name;
  }
  for (int steering = 1; steering <= v1::ControlRequest::Steering_MAX; ++steering) {
    EXPECT_EQ(
        std::count_if(kOrders.begin(), kOrders.end(), [&](const OrderRow& row) { return row.steering == steering; }),
        1);
  }
}

/// The robot's command after an order in a step, from 0.5 m/s and 0.25 rad/s. Its maximum is 1 m/s and 2 rad/s.
Command commandAfter(const v1::ControlRequest& order) {
  FakeHardware hardware;
  DriveCommandFilter filter(hardware.info().type->limits);
  const DriveCommandFilter::Clock::time_point now{1h};
  filter.begin(now);
  filter.obey(driveOrder(0.5, 0.25), now);
  filter.obey(order, now);
  return filter.command(now, "Anna");
}

TEST(Orders, TheFilterFollowsTheRuleOfEachRow) {
  for (const OrderRow& row : kOrders) {
    Command expected{.speed_mps = 0.5, .turn_radps = 0.25, .by_driver = true};
    if (row.rule == OrderRule::stop) expected = {.by_driver = true, .emergency_stop = true};
    if (row.speed_tenths != 0) expected.speed_mps = (5 + row.speed_tenths) / 10.0;
    if (row.turn_part != 0) expected.turn_radps = 2 * row.turn_part;
    EXPECT_EQ(commandAfter(makeOrder(row.type)), expected) << row.name;
    EXPECT_EQ(row.rule == OrderRule::steer, row.speed_tenths != 0 || row.turn_part != 0) << row.name;
  }
}

/// Stands.
class IdleDriver : public Controller {
 public:
  void step(Robot&) override {}
};

TEST(Orders, TheRobotFollowsTheRuleOfEachRow) {
  for (const OrderRow& row : kOrders) {
    FakeHardware hardware;
    hardware.mutableOdometry().speed_mps = 0.5;  // a stop lasts until it stands
    RemoteControlRobot robot(hardware, std::make_unique<IdleDriver>(), {});
    robot.take("Anna", true);
    const auto order = row.rule == OrderRule::set ? driveOrder(0.5) : makeOrder(row.type);
    robot.obey(row.rule == OrderRule::mode ? modeOrder(false) : order);
    EXPECT_EQ(robot.state().autonomous(), row.rule != OrderRule::mode && row.rule != OrderRule::stop) << row.name;
    robot.obey(modeOrder(false));
    robot.obey(order);
    robot.step();
    const bool moves = hardware.lastCommand().speed_mps != 0 || hardware.lastCommand().turn_radps != 0;
    EXPECT_EQ(moves, row.rule == OrderRule::set || row.rule == OrderRule::steer) << row.name;
    EXPECT_EQ(hardware.lastCommand().emergency_stop, row.rule == OrderRule::stop) << row.name;
    EXPECT_EQ(hardware.win_checks, row.type == OrderType::check_win ? 1 : 0) << row.name;
  }
}

TEST(Orders, TheRobotsPortAnswersTheRequestsAmongTheRowsAndNoOthers) {
  FakeHardware hardware;
  RemoteControlRobot robot(hardware, std::make_unique<IdleDriver>(), {});
  const PortRobot port_robot(robot);
  for (const OrderRow& row : kOrders) {
    ResponseOutbox outbox(port_robot, {});
    EXPECT_EQ(outbox.request(row.type), row.rule == OrderRule::request) << row.name;
    outbox.addReadings(false);
    EXPECT_EQ(outbox.isEmpty(), row.rule != OrderRule::request) << row.name;
    EXPECT_EQ(row.right == Right::look, row.rule == OrderRule::request) << row.name << ": the right to watch suffices";
    if (outbox.isEmpty()) continue;
    v1::ControlResponse message;
    outbox.takeNext(message);
    EXPECT_EQ(message.reading().kind(), nameOf(row.sensor));
  }
}

TEST(Orders, OnlyAModeOrAStopDiscardsADrive) {
  for (const OrderRow& row : kOrders) {
    const bool discards = row.rule == OrderRule::mode || row.rule == OrderRule::stop;
    EXPECT_EQ(supersedes(row.rule, OrderRule::set), discards) << row.name;
    EXPECT_EQ(supersedes(row.rule, OrderRule::stop), discards) << row.name;
    EXPECT_FALSE(supersedes(row.rule, OrderRule::at_once)) << row.name;
    EXPECT_FALSE(supersedes(row.rule, OrderRule::mode)) << row.name;
    EXPECT_FALSE(supersedes(row.rule, OrderRule::request)) << row.name;
  }
}

TEST(Orders, ADriveHasOnlyTheValuesGiven) {
  const v1::ControlRequest order = transmitted(driveOrder(0));
  EXPECT_TRUE(order.drive().has_speed_mps());
  EXPECT_EQ(order.drive().speed_mps(), 0);
  EXPECT_FALSE(order.drive().has_turn_radps());
  EXPECT_FALSE(order.drive().has_laser_pan_rad());
  const v1::ControlRequest merged = mergeDrive(driveOrder(0.5, {}, 0.25), driveOrder(0, 1));
  EXPECT_EQ(merged.SerializeAsString(), driveOrder(0, 1, 0.25).SerializeAsString());
}

TEST(Orders, AreRefusedWithAReason) {
  EXPECT_EQ(errorAfter([](auto& m) { m.mutable_init()->set_protocol(kProtocolVersion); }), "");
  EXPECT_EQ(errorAfter([](auto& m) { m.mutable_req_all(); }), "");
  EXPECT_EQ(errorAfter([](auto&) {}),
            "a message of a remote control without a known request; see doc/remote_control.md");
  EXPECT_EQ(errorAfter([](auto& m) { m.mutable_steer(); }), "a steering order of the unknown type 0; there are 1 to 4");
  EXPECT_EQ(errorAfter([](auto& m) { m.mutable_req_reading()->set_kind("compass"); }),
            "a request for a sensor of the kind 'compass'; there are 'heat', 'laser' and 'sonar'");
  EXPECT_EQ(errorAfter([](auto& m) { m.mutable_drive()->set_speed_mps(std::nan("")); }),
            "a drive command with a speed_mps of nan; it must be a finite number");
  EXPECT_EQ(errorAfter([](auto& m) { m.mutable_drive()->set_turn_radps(std::numeric_limits<double>::infinity()); }),
            "a drive command with a turn_radps of inf; it must be a finite number");
  EXPECT_NE(errorAfter([](auto& m) { m.mutable_drive()->set_laser_pan_rad(std::nanf("")); }), "");
  EXPECT_NE(errorAfter([](auto& m) { m.mutable_init()->set_protocol(2); }), "");
  const auto error_of_driver = [](const std::string& name) {
    return errorAfter([&](auto& m) {
      m.mutable_init()->set_protocol(kProtocolVersion);
      m.mutable_init()->set_driver(name);
    });
  };
  EXPECT_EQ(error_of_driver(std::string(61, 'x')), "a driver's name of 61 bytes; the most is 60");
  EXPECT_EQ(error_of_driver("a\nb"), "a driver's name with control characters");
  EXPECT_EQ(errorAfter([](auto& m) { m.mutable_stop()->set_why("a\nb"); }), "a reason to stop with control characters");
}

TEST(Orders, TruncateAReasonToStopAtAUtf8Boundary) {
  const std::string text_of_119_bytes(119, 'x');
  EXPECT_EQ(stopOrder(text_of_119_bytes + "ü and more").stop().why(), text_of_119_bytes);
  v1::ControlRequest message;
  message.mutable_stop()->set_why(std::string(5000, 'y'));
  EXPECT_EQ(whyOf(transmitted(message)), std::string(120, 'y')) << "the robot stops, however long the reason is";
}

TEST(RobotStates, AreRefusedWithNumbersThatAreNotFiniteOrAnUnknownActivity) {
  v1::RobotState state = initialState();
  EXPECT_NO_THROW(validate(state));
  state.set_activity(static_cast<v1::Activity>(9));
  EXPECT_THROW(validate(state), WireError);
  state = initialState();
  state.clear_activity();
  EXPECT_THROW(validate(state), WireError);
  state = initialState();
  state.set_speed_mps(std::nan(""));
  EXPECT_THROW(validate(state), WireError);
  state = initialState();
  state.set_driven_m(std::nan(""));
  EXPECT_THROW(validate(state), WireError);
}

}  // namespace
}  // namespace robosim
