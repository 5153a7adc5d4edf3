#include "net/remote_wire.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

namespace robosim {
namespace {

RemoteOrder carried(const RemoteOrder& order) {
  wire::ToRobot message;
  encode(order, message);
  return decode(message);
}

std::string complaintAfter(const std::function<void(wire::ToRobot&)>& spoil) {
  wire::ToRobot message;
  message.set_protocol(kProtocolVersion);
  spoil(message);
  try {
    decode(message);
  } catch (const WireError& error) {
    return error.what();
  }
  return "";
}

TEST(RemoteWire, CarriesAnInit) {
  const RemoteOrder heard = carried(
      {.type = RemoteType::init, .robot = "Pioneer1", .driver = "Jürgen", .autonomous = true, .only_watch = true});
  EXPECT_EQ(heard.type, RemoteType::init);
  EXPECT_EQ(heard.robot, "Pioneer1");
  EXPECT_EQ(heard.driver, "Jürgen");
  EXPECT_TRUE(heard.autonomous);
  EXPECT_TRUE(heard.only_watch);
}

TEST(RemoteWire, CarriesADriveCommandAndWhatItLeavesOut) {
  RemoteOrder order{.type = RemoteType::drive};
  order.speed_mps = 0;
  const RemoteOrder heard = carried(order);
  EXPECT_EQ(heard.speed_mps, 0);
  EXPECT_EQ(heard.turn_radps, std::nullopt);
  EXPECT_EQ(heard.laser_pan_rad, std::nullopt);
}

TEST(RemoteWire, CarriesEveryTypeThereIs) {
  for (int type = 0; type <= wire::RemoteType_MAX; ++type) {
    EXPECT_EQ(static_cast<int>(carried({.type = static_cast<RemoteType>(type)}).type), type);
  }
}

TEST(RemoteWire, RefusesAnOrderThatMakesNoSense) {
  EXPECT_EQ(complaintAfter([](auto&) {}), "");
  EXPECT_EQ(complaintAfter([](auto& m) { m.set_type(static_cast<wire::RemoteType>(14)); }),
            "a message of the type 14; there are 0 (INIT) to 13 (REQ_ALL)");
  EXPECT_EQ(complaintAfter([](auto& m) { m.set_speed_mps(std::nan("")); }),
            "a drive command with a speed_mps of nan; it must be a finite number");
  EXPECT_EQ(complaintAfter([](auto& m) { m.set_turn_radps(std::numeric_limits<double>::infinity()); }),
            "a drive command with a turn_radps of inf; it must be a finite number");
  EXPECT_NE(complaintAfter([](auto& m) { m.set_laser_pan_rad(std::nanf("")); }), "");
  EXPECT_EQ(complaintAfter([](auto& m) { m.set_driver(std::string(61, 'x')); }),
            "a driver's name of 61 bytes; the most is 60");
  EXPECT_EQ(complaintAfter([](auto& m) { m.set_driver("a\nb"); }), "a driver's name with control characters");
  EXPECT_NE(complaintAfter([](auto& m) { m.set_protocol(2); }), "");
}

TEST(RemoteWire, CarriesARobotsState) {
  const RemoteState state{.autonomous = false,
                          .driver = "Anna",
                          .is_yours = true,
                          .speed_mps = 0.5,
                          .turn_radps = -0.25,
                          .activity = Activity::halted,
                          .why_stopped = "why",
                          .winner = "Scout1",
                          .win_refusals = 3};
  wire::RemoteState message;
  encode(state, message);
  EXPECT_EQ(decode(message), state);
}

TEST(RemoteWire, RefusesAStateThatMakesNoSense) {
  wire::RemoteState message;
  message.set_activity(static_cast<wire::Activity>(9));
  EXPECT_THROW(decode(message), WireError);
  message.Clear();
  message.set_speed_mps(std::nan(""));
  EXPECT_THROW(decode(message), WireError);
}

}  // namespace
}  // namespace robosim
