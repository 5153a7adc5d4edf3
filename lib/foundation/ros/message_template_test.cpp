#include "ros/message_template.h"

#include <gtest/gtest.h>

#include "ros/messages.h"

namespace robosim::ros {
namespace {

template <Message M>
std::vector<std::uint8_t> encodingOf(const M& message) {
  std::vector<std::uint8_t> bytes;
  encode(message, bytes);
  return bytes;
}

std::vector<std::uint8_t> bytesOf(const MessageTemplate& message) {
  return {message.bytes().begin(), message.bytes().end()};
}

TEST(MessageTemplate, ReplacesNumbersAndNothingElse) {
  Odometry message;
  message.header.frame_id = "odom";  // 5 bytes with its NUL, so that padding follows
  message.child_frame_id = "base";
  MessageTemplate made(message, message.header.stamp.sec, message.pose.pose.orientation.w,
                       message.twist.twist.angular.z);
  EXPECT_EQ(bytesOf(made), encodingOf(message));
  message.header.stamp.sec = 7;
  message.pose.pose.orientation.w = -0.5;
  message.twist.twist.angular.z = 0.25;
  made.set(0, std::int32_t{7});
  made.set(1, -0.5);
  made.set(2, 0.25);
  EXPECT_EQ(bytesOf(made), encodingOf(message));
}

TEST(MessageTemplate, ReplacesNumbersOfSequences) {
  LaserScan scan;
  scan.ranges = {1, 2, 3};
  scan.intensities = {4};
  MessageTemplate made(scan, scan.ranges, scan.intensities);
  made.set(0, 9.0f, 2);
  made.set(1, 8.0f, 0);
  EXPECT_EQ(decode<LaserScan>(made.bytes()).ranges, (std::vector<float>{1, 2, 9}));
  EXPECT_EQ(decode<LaserScan>(made.bytes()).intensities, (std::vector<float>{8}));
  const std::vector<float> others{5, 6, 7};
  made.set(0, std::span(others));
  EXPECT_EQ(decode<LaserScan>(made.bytes()).ranges, others);
}

TEST(MessageTemplate, ReplacesNumbersOfMessagesInASequence) {
  TFMessage message;
  message.transforms.resize(2);
  message.transforms[0].child_frame_id = "a";
  message.transforms[1].child_frame_id = "bcd";
  MessageTemplate made(message);
  for (const auto& transform : message.transforms) made.add(message, transform.transform.translation.y);
  message.transforms[1].transform.translation.y = 3;
  made.set(1, 3.0);
  EXPECT_EQ(bytesOf(made), encodingOf(message));
}

}  // namespace
}  // namespace robosim::ros
