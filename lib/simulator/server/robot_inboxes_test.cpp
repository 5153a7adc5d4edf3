#include "server/robot_inboxes.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

std::vector<RobotMessage> one(const std::string& text) { return {{"Ann", "Bob", text}}; }

RobotInboxes twoRobots() {
  RobotInboxes inboxes;
  inboxes.reset(2);
  return inboxes;
}

TEST(RobotInboxes, KeepMessagesUntilTheirStepIsConfirmed) {
  RobotInboxes inboxes = twoRobots();
  inboxes.add(1, 5, one("a"));
  inboxes.add(1, 7, one("b"));
  inboxes.confirm(1, 4);
  ASSERT_EQ(inboxes.count(1), 2u);
  EXPECT_EQ(inboxes.unconfirmed(1)[0].text, "a");
  inboxes.confirm(1, 6);
  ASSERT_EQ(inboxes.count(1), 1u);
  EXPECT_EQ(inboxes.unconfirmed(1)[0].text, "b");
  EXPECT_EQ(inboxes.count(0), 0u);
  EXPECT_EQ(inboxes.dropped(), 0u);
}

TEST(RobotInboxes, DropTheOldestMessagesBeyondTheirBoundAndCountThem) {
  RobotInboxes inboxes = twoRobots();
  for (std::uint64_t step = 1; step <= RobotInboxes::kMessagesMax + 3; ++step) {
    inboxes.add(0, step, one(std::to_string(step)));
  }
  EXPECT_EQ(inboxes.count(0), RobotInboxes::kMessagesMax);
  EXPECT_EQ(inboxes.unconfirmed(0).front().text, "4");
  EXPECT_EQ(inboxes.dropped(), 3u);
}

TEST(RobotInboxes, DropNothingThatOneStepDelivered) {
  RobotInboxes inboxes = twoRobots();
  const std::vector<RobotMessage> many(RobotInboxes::kMessagesMax + 10, {"Ann", "Bob", "x"});
  inboxes.add(0, 1, many);
  EXPECT_EQ(inboxes.count(0), many.size());
}

}  // namespace
}  // namespace robosim
