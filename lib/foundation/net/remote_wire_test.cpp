#include "net/remote_wire.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace robosim {
namespace {

RemoteOrder roundTripped(const RemoteOrder& order) {
  v1::ControlRequest message;
  encode(order, message);
  return decode(message);
}

std::string errorAfter(const std::function<void(v1::ControlRequest&)>& modify) {
  v1::ControlRequest message;
  modify(message);
  try {
    decode(message);
  } catch (const WireError& error) {
    return error.what();
  }
  return "";
}

TEST(RemoteWire, RoundTripsAnInit) {
  const RemoteOrder decoded = roundTripped(
      {.type = RemoteType::init, .robot = "Pioneer1", .driver = "Jürgen", .autonomous = true, .only_observe = true});
  EXPECT_EQ(decoded.type, RemoteType::init);
  EXPECT_EQ(decoded.robot, "Pioneer1");
  EXPECT_EQ(decoded.driver, "Jürgen");
  EXPECT_TRUE(decoded.autonomous);
  EXPECT_TRUE(decoded.only_observe);
}

TEST(RemoteWire, RoundTripsADriveCommandWithAbsentValues) {
  RemoteOrder order{.type = RemoteType::drive};
  order.speed_mps = 0;
  const RemoteOrder decoded = roundTripped(order);
  EXPECT_EQ(decoded.speed_mps, 0);
  EXPECT_EQ(decoded.turn_radps, std::nullopt);
  EXPECT_EQ(decoded.laser_pan_rad, std::nullopt);
}

TEST(RemoteWire, RoundTripsEveryType) {
  for (int type = 0; type <= static_cast<int>(RemoteType::req_all); ++type) {
    EXPECT_EQ(static_cast<int>(roundTripped({.type = static_cast<RemoteType>(type)}).type), type);
  }
}

TEST(RemoteWire, RejectsInvalidOrders) {
  EXPECT_EQ(errorAfter([](auto& m) { m.mutable_init()->set_protocol(kProtocolVersion); }), "");
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
}

TEST(RemoteWire, TruncatesAReasonToStopAtAUtf8Boundary) {
  const std::string text_of_119_bytes(119, 'x');
  EXPECT_EQ(roundTripped({.type = RemoteType::stop, .why = text_of_119_bytes + "ü and more"}).why, text_of_119_bytes);
  v1::ControlRequest message;
  message.mutable_stop()->set_why(std::string(5000, 'y'));
  EXPECT_EQ(decode(message).why, std::string(120, 'y')) << "the robot stops, however long the reason is";
}

TEST(RemoteWire, RoundTripsARobotState) {
  const RemoteState state{.autonomous = false,
                          .driver = "Anna",
                          .is_yours = true,
                          .speed_mps = 0.5,
                          .turn_radps = -0.25,
                          .activity = Activity::halted,
                          .why_stopped = "why",
                          .winner = "Scout1",
                          .win_refusals = 3,
                          .stalled = true,
                          .stops = 4,
                          .driven_m = 12.5,
                          .is_stopping = true};
  v1::RobotState message;
  encode(state, message);
  EXPECT_EQ(decode(message), state);
  message.clear_driven_m();
  EXPECT_EQ(decode(message).driven_m, std::nullopt) << "a robot without odometry";
}

TEST(RemoteWire, RejectsInvalidStates) {
  v1::RobotState message;
  message.set_activity(static_cast<v1::Activity>(9));
  EXPECT_THROW(decode(message), WireError);
  message.Clear();
  message.set_speed_mps(std::nan(""));
  EXPECT_THROW(decode(message), WireError);
  message.set_speed_mps(0);
  message.set_activity(v1::ACTIVITY_ACTIVE);
  EXPECT_NO_THROW(decode(message));
  message.set_driven_m(std::nan(""));
  EXPECT_THROW(decode(message), WireError);
}

}  // namespace
}  // namespace robosim
