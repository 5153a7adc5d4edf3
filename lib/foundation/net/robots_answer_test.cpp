// Decoding of what a process of robots answers to a step.
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hardware/inbox_limit.h"
#include "net/robot_wire.h"
#include "net/wire_error.h"

namespace robosim {
namespace {

/// Error text for an answer of a process with two robots; empty for a valid one.
std::string errorFor(const v1::StepAnswer& message) {
  RobotsAnswer answer;
  try {
    decode(message, 2, answer);
  } catch (const WireError& error) {
    return error.what();
  }
  return "";
}

TEST(RobotsAnswer, DecodesCommandsMessagesAndWinChecks) {
  const Command command{0.5, -0.25, 0.125f, Activity::found, true, true};
  v1::StepAnswer message;
  message.set_step(7);
  message.add_commands()->set_process_robot(1);
  encode(command, *message.mutable_commands(0)->mutable_command());
  message.add_messages()->set_to("Scout1");
  message.mutable_messages(0)->set_text(std::string(kMaxMessageBytes, '\0'));
  message.add_win_checks(1);
  message.set_messages_dropped(3);
  RobotsAnswer answer;
  decode(message, 2, answer);
  EXPECT_EQ(answer.win_checks, std::vector<ProcessRobotIndex>{ProcessRobotIndex{1}});
  EXPECT_EQ(answer.messages_dropped, 3u);
  EXPECT_EQ(answer.step, 7u);
  ASSERT_EQ(answer.orders.size(), 1u);
  EXPECT_EQ(answer.orders[0].robot, ProcessRobotIndex{1});
  EXPECT_EQ(answer.orders[0].command, command);
  ASSERT_EQ(answer.messages.size(), 1u);
  EXPECT_EQ(answer.messages[0].to, "Scout1");
  EXPECT_EQ(answer.messages[0].text.size(), kMaxMessageBytes);
}

TEST(RobotsAnswer, DecodesTheRobotsWhoseCamerasTakePictures) {
  v1::StepAnswer message;
  message.add_pictures(1);
  RobotsAnswer answer;
  decode(message, 2, answer);
  EXPECT_EQ(answer.pictures, std::vector{ProcessRobotIndex{1}});
  decode(v1::StepAnswer(), 2, answer);
  EXPECT_TRUE(answer.pictures.empty());
  message.add_pictures(2);
  EXPECT_THROW(decode(message, 2, answer), WireError);
}

TEST(RobotsAnswer, DecodesABroadcastAndRejectsOneThatNamesAReceiver) {
  v1::StepAnswer message;
  auto& sent = *message.add_messages();
  sent.set_to_all(true);
  sent.set_text("all");
  RobotsAnswer answer;
  decode(message, 1, answer);
  ASSERT_EQ(answer.messages.size(), 1u);
  EXPECT_TRUE(answer.messages[0].to_all);
  EXPECT_EQ(answer.messages[0].text, "all");
  sent.set_to("Scout1");
  EXPECT_EQ(errorFor(message), "a message to all robots that also names a receiver; leave `to` empty");
}

TEST(RobotsAnswer, RejectsAnImplausibleNumberOfDroppedMessages) {
  v1::StepAnswer message;
  message.set_messages_dropped(std::uint64_t{1} << 32);
  EXPECT_EQ(errorFor(message), "");
  message.set_messages_dropped((std::uint64_t{1} << 32) + 1);
  EXPECT_EQ(errorFor(message), "messages_dropped is 4294967297; the most is 4294967296");
}

TEST(RobotsAnswer, RejectsNonFiniteSpeeds) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity}) {
    v1::StepAnswer message;
    message.add_commands()->mutable_command()->set_speed_mps(bad);
    EXPECT_NE(errorFor(message).find("has a speed_mps of "), std::string::npos) << errorFor(message);
    message.mutable_commands(0)->mutable_command()->set_speed_mps(0);
    message.mutable_commands(0)->mutable_command()->set_turn_radps(bad);
    EXPECT_NE(errorFor(message).find("has a turn_radps of "), std::string::npos);
    message.mutable_commands(0)->mutable_command()->set_turn_radps(0);
    message.mutable_commands(0)->mutable_command()->set_laser_pan_rad(static_cast<float>(bad));
    EXPECT_NE(errorFor(message).find("has a laser_pan_rad of "), std::string::npos);
    message.mutable_commands(0)->mutable_command()->set_laser_pan_rad(0);
    message.mutable_commands(0)->mutable_command()->mutable_camera_head()->set_tilt_rad(bad);
    EXPECT_NE(errorFor(message).find("has a camera_head.tilt_rad of "), std::string::npos);
  }
}

TEST(RobotsAnswer, KeepsTheCommandOfACamerasHead) {
  v1::StepAnswer message;
  v1::Command& wire = *message.add_commands()->mutable_command();
  RobotsAnswer answer;
  for (const CameraHeadCommand& head : {CameraHeadCommand{{0.5, -0.25, 4}, 1.5, 0.75}, CameraHeadCommand{}}) {
    const Command command{.speed_mps = 1, .camera_head = head};
    encode(command, wire);
    decode(message, 1, answer);
    ASSERT_EQ(answer.orders.size(), 1u);
    EXPECT_EQ(answer.orders[0].command, command);
  }
  wire.mutable_camera_head()->set_pan_rad(1);
  decode(message, 1, answer);
  EXPECT_EQ(*answer.orders[0].command.camera_head, (CameraHeadCommand{{1, 0, 1}})) << "no zoom is 1";
}

TEST(RobotsAnswer, RejectsUnknownActivitiesInvalidRobotsAndLongMessages) {
  v1::StepAnswer message;
  message.add_commands()->mutable_command()->set_activity(static_cast<v1::Activity>(4));
  EXPECT_EQ(errorFor(message),
            "the command for robot 0 has the activity 4; there are 1 (active), 2 (halted) and 3 "
            "(found)");
  message.Clear();
  message.add_commands()->set_process_robot(2);
  EXPECT_EQ(errorFor(message),
            "a command for robot 2 of 2; a connection may only command the robots of its hello, counted from 0");
  message.Clear();
  message.add_messages()->set_process_robot(0xFFFFFFFF);
  EXPECT_NE(errorFor(message).find("a message for robot 4294967295 of 2"), std::string::npos);
  message.Clear();
  message.add_win_checks(2);
  EXPECT_NE(errorFor(message).find("a CheckWin request for robot 2 of 2"), std::string::npos);
  message.Clear();
  message.add_messages()->set_text(std::string(kMaxMessageBytes + 1, 'x'));
  EXPECT_EQ(errorFor(message), "a message of 4097 bytes; the most is 4096");
}

TEST(RobotsAnswer, LimitsTheMessagesOfEachRobot) {
  v1::StepAnswer message;
  for (std::uint32_t robot : {0, 1}) {
    for (std::size_t i = 0; i < kMaxMessagesSent; ++i) message.add_messages()->set_process_robot(robot);
  }
  EXPECT_EQ(errorFor(message), "");
  message.add_messages();
  RobotsAnswer answer;
  try {
    decode(message, 2, answer);
    ADD_FAILURE();
  } catch (const WireError& error) {
    EXPECT_STREQ(error.what(), "more than 1024 messages of a robot in one step");
    EXPECT_EQ(reasonOf(error.status()), v1::ERROR_REASON_TOO_MANY_MESSAGES);
  }
}

TEST(RobotsAnswer, TreatsAnUnspecifiedActivityOfACommandAsActive) {
  EXPECT_EQ(decode(v1::Command(), 0).activity, Activity::active);
  EXPECT_EQ(decode(v1::ACTIVITY_UNSPECIFIED), std::nullopt) << "elsewhere it is an error";
}

}  // namespace
}  // namespace robosim
