#include "dds/cyclone/cyclone_participant.h"

#include <deque>
#include <mutex>

#include <gtest/gtest.h>

#include "base/error_list.h"
#include "dds/testing/domain.h"
#include "ros/messages.h"

namespace robosim::dds {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// What a reader has received.
class Inbox {
 public:
  OnSample taker() {
    return [this](const Sample& sample) {
      const std::lock_guard lock(mutex_);
      messages_.emplace_back(sample.message.begin(), sample.message.end());
    };
  }
  std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return messages_.size();
  }
  Bytes at(std::size_t i) const {
    const std::lock_guard lock(mutex_);
    return messages_.at(i);
  }
  /// The last message. @pre size() > 0
  Bytes last() const {
    const std::lock_guard lock(mutex_);
    return messages_.back();
  }

 private:
  mutable std::mutex mutex_;
  std::deque<Bytes> messages_;
};

template <ros::Message M>
Bytes encoded(const M& message) {
  Bytes bytes;
  ros::encode(message, bytes);
  return bytes;
}

Topic textTopic(TopicDelivery delivery = TopicDelivery::steady) {
  return {"/robot1/text", &ros::typeOf<ros::String>(), delivery};
}

/// Two participants in one domain.
struct CycloneParticipantTest : testing::Test {
  std::unique_ptr<Participant> sender = joinByCyclone({.domain = testDomain()});
  std::unique_ptr<Participant> receiver = joinByCyclone({.domain = testDomain()});
  Inbox inbox;
};

TEST_F(CycloneParticipantTest, PassesTheBytesOfMessagesUnchanged) {
  const auto writer = sender->write(textTopic());
  const auto reader = receiver->read(textTopic(), Receipt::reliable, inbox.taker());
  ASSERT_TRUE(eventually([&] { return writer->readers() == 1 && reader->writers() == 1; }));
  EXPECT_EQ(writer->arrivals(), 1u);
  for (const char* const text : {"", "a", "ab", "abc", "abcd"}) {
    const Bytes message = encoded(ros::String{text});
    const std::size_t before = inbox.size();
    writer->write(message);
    ASSERT_TRUE(eventually([&] { return inbox.size() > before; }));
    EXPECT_EQ(inbox.last(), message) << text;
  }
  EXPECT_EQ(sender->lost(), 0u);
}

TEST_F(CycloneParticipantTest, PassesLargeMessages) {
  const Topic map{"/map", &ros::typeOf<ros::OccupancyGrid>(), TopicDelivery::latched};
  ros::OccupancyGrid grid;
  grid.info.width = 2000;
  grid.info.height = 2001;
  grid.data.resize(2000 * 2001);
  for (std::size_t i = 0; i < grid.data.size(); ++i) grid.data[i] = static_cast<std::int8_t>(i % 101);
  const auto writer = sender->write(map);
  const auto reader = receiver->read(map, Receipt::reliable, inbox.taker());
  ASSERT_TRUE(eventually([&] { return writer->readers() == 1; }));
  writer->write(encoded(grid));
  ASSERT_TRUE(eventually([&] { return inbox.size() == 1; }));
  EXPECT_EQ(inbox.last(), encoded(grid));
}

TEST_F(CycloneParticipantTest, KeepsTheLastMessageOfALatchedTopicForLaterReaders) {
  const auto latched = sender->write(textTopic(TopicDelivery::latched));
  latched->write(encoded(ros::String{"first"}));
  latched->write(encoded(ros::String{"second"}));
  const auto reader = receiver->read(textTopic(TopicDelivery::latched), Receipt::reliable, inbox.taker());
  ASSERT_TRUE(eventually([&] { return inbox.size() > 0; }));
  EXPECT_EQ(inbox.last(), encoded(ros::String{"second"}));
  Inbox of_volatile;
  const auto best_effort = receiver->read(textTopic(TopicDelivery::latched), Receipt::best_effort, of_volatile.taker());
  ASSERT_TRUE(eventually([&] { return latched->readers() == 2; }));
  latched->write(encoded(ros::String{"third"}));
  ASSERT_TRUE(eventually([&] { return of_volatile.size() > 0; }));
  EXPECT_EQ(of_volatile.at(0), encoded(ros::String{"third"}));
}

TEST_F(CycloneParticipantTest, DistinguishesTopicsOfOneNameByTheirTypes) {
  const Topic plain{"/robot1/cmd_vel", &ros::typeOf<ros::Twist>(), TopicDelivery::steady};
  const Topic stamped{"/robot1/cmd_vel", &ros::typeOf<ros::TwistStamped>(), TopicDelivery::steady};
  Inbox of_stamped;
  const auto reader = receiver->read(plain, Receipt::best_effort, inbox.taker());
  const auto stamped_reader = receiver->read(stamped, Receipt::best_effort, of_stamped.taker());
  const auto writer = sender->write(stamped);
  const auto plain_writer = sender->write(plain);
  ASSERT_TRUE(eventually([&] { return writer->readers() == 1 && plain_writer->readers() == 1; }));
  writer->write(encoded(ros::TwistStamped{{{}, "base"}, {{0.1, 0, 0}, {0, 0, 0.5}}}));
  plain_writer->write(encoded(ros::Twist{{0.2, 0, 0}, {}}));
  ASSERT_TRUE(eventually([&] { return inbox.size() == 1 && of_stamped.size() == 1; }));
  EXPECT_EQ(ros::decode<ros::TwistStamped>(of_stamped.at(0)).twist.angular.z, 0.5);
  EXPECT_EQ(ros::decode<ros::Twist>(inbox.at(0)).linear.x, 0.2);
}

TEST_F(CycloneParticipantTest, DoesNotReceiveItsOwnMessages) {
  const auto writer = sender->write(textTopic());
  Inbox own;
  const auto own_reader = sender->read(textTopic(), Receipt::reliable, own.taker());
  const auto reader = receiver->read(textTopic(), Receipt::reliable, inbox.taker());
  ASSERT_TRUE(eventually([&] { return writer->readers() >= 1; }));
  writer->write(encoded(ros::String{"a"}));
  ASSERT_TRUE(eventually([&] { return inbox.size() == 1; }));
  EXPECT_EQ(own.size(), 0u);
}

TEST_F(CycloneParticipantTest, TellsWritersApartAndFollowsTheirEnds) {
  std::mutex mutex;
  std::vector<std::uint64_t> writers;
  const auto reader = receiver->read(textTopic(), Receipt::reliable, [&](const Sample& sample) {
    const std::lock_guard lock(mutex);
    writers.push_back(sample.writer);
  });
  const auto count = [&] {
    const std::lock_guard lock(mutex);
    return writers.size();
  };
  const auto a = sender->write(textTopic());
  {
    const auto b = sender->write(textTopic());
    ASSERT_TRUE(eventually([&] { return a->readers() == 1 && b->readers() == 1; }));
    a->write(encoded(ros::String{"a"}));
    ASSERT_TRUE(eventually([&] { return count() == 1; }));
    b->write(encoded(ros::String{"b"}));
    ASSERT_TRUE(eventually([&] { return count() == 2; }));
    EXPECT_NE(writers[0], writers[1]);
    EXPECT_EQ(reader->writers(), 2);
  }
  EXPECT_TRUE(eventually([&] { return reader->writers() == 1; }));
}

TEST_F(CycloneParticipantTest, LogsExceptionsOfAReader) {
  std::mutex mutex;
  std::string log;
  const auto logging = joinByCyclone({.domain = testDomain(), .log = [&](const std::string& line) {
                                        const std::lock_guard lock(mutex);
                                        log += line + "\n";
                                      }});
  const auto reader = logging->read(textTopic(), Receipt::reliable,
                                    [](const Sample& sample) { ros::decode<ros::String>(sample.message.first(5)); });
  const auto writer = sender->write(textTopic());
  ASSERT_TRUE(eventually([&] { return writer->readers() == 1; }));
  writer->write(encoded(ros::String{"a"}));
  EXPECT_TRUE(eventually([&] {
    const std::lock_guard lock(mutex);
    return log.find("/robot1/text: ") != std::string::npos;
  })) << log;
}

TEST(CycloneParticipant, ReportsAnInterfaceThatDoesNotExist) {
  try {
    joinByCyclone({.domain = testDomain(), .interface = "nonexistent0"});
    FAIL() << "it has joined";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("nonexistent0"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace robosim::dds
