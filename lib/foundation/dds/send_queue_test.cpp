#include "dds/send_queue.h"

#include <gtest/gtest.h>

namespace robosim::dds {
namespace {

using Lane = SendQueue::Lane;

/// What waits, in order: the first byte of each message.
std::string popAll(SendQueue& queue) {
  std::string all;
  while (const auto next = queue.pop({})) all += static_cast<char>(next->message[0]);
  return all;
}

std::vector<std::uint8_t> message(char name, std::size_t size = 1) {
  return std::vector<std::uint8_t>(size, static_cast<std::uint8_t>(name));
}

TEST(SendQueue, ReturnsMessagesOfAllWritersInOrder) {
  SendQueue queue;
  const auto a = std::make_shared<Lane>(5), b = std::make_shared<Lane>(5);
  EXPECT_EQ(queue.push(a, message('1')), 0u);
  EXPECT_EQ(queue.push(b, message('2')), 0u);
  EXPECT_EQ(queue.push(a, message('3')), 0u);
  const auto first = queue.pop({});
  ASSERT_TRUE(first);
  EXPECT_EQ(first->lane, a);
  EXPECT_EQ(popAll(queue), "23");
}

TEST(SendQueue, KeepsTheLatestMessagesOfAWriter) {
  SendQueue queue;
  const auto a = std::make_shared<Lane>(2), b = std::make_shared<Lane>(2);
  queue.push(a, message('1'));
  queue.push(a, message('2'));
  queue.push(b, message('x'));
  EXPECT_EQ(queue.push(a, message('3')), 1u);
  EXPECT_EQ(queue.push(a, message('4')), 1u);
  EXPECT_EQ(popAll(queue), "34x");
  EXPECT_EQ(queue.push(a, message('5')), 0u);
  EXPECT_EQ(popAll(queue), "5");
}

TEST(SendQueue, HasABoundForAllMessagesTogether) {
  SendQueue queue;
  const auto a = std::make_shared<Lane>(9), b = std::make_shared<Lane>(9);
  queue.push(a, message('1', SendQueue::kMaxBytes - 1));
  EXPECT_EQ(queue.push(b, message('2', 2)), 1u) << "it has no place";
  EXPECT_EQ(queue.push(b, message('3')), 0u);
  EXPECT_EQ(queue.push(a, message('4', 2)), 1u) << "it replaces the first one";
  EXPECT_EQ(popAll(queue), "43");
}

TEST(SendQueue, PassesAMessageThatIsLargerThanTheBound) {
  SendQueue queue;
  EXPECT_EQ(queue.push(std::make_shared<Lane>(1), message('1', SendQueue::kMaxBytes + 1)), 0u);
  EXPECT_EQ(popAll(queue), "1");
}

TEST(SendQueue, KnowsWhenTheMessagesOfAWriterAreSent) {
  SendQueue queue;
  const auto a = std::make_shared<Lane>(5), b = std::make_shared<Lane>(5);
  EXPECT_TRUE(queue.awaitSent(*a, {}));
  queue.push(a, message('1'));
  queue.push(b, message('2'));
  EXPECT_FALSE(queue.awaitSent(*a, {})) << "it waits";
  queue.pop({});
  EXPECT_FALSE(queue.awaitSent(*a, {})) << "it is being sent";
  queue.pop({});
  EXPECT_TRUE(queue.awaitSent(*a, {}));
  EXPECT_FALSE(queue.awaitSent(*b, {}));
  queue.close();
  EXPECT_FALSE(queue.awaitSent(*b, std::chrono::steady_clock::time_point::max())) << "nothing is sent any more";
}

TEST(SendQueue, ReturnsNothingOnceItIsClosed) {
  SendQueue queue;
  queue.push(std::make_shared<Lane>(1), message('1'));
  EXPECT_FALSE(queue.isClosed());
  queue.close();
  EXPECT_TRUE(queue.isClosed());
  EXPECT_EQ(popAll(queue), "");
}

}  // namespace
}  // namespace robosim::dds
