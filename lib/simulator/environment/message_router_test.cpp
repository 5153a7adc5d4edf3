#include "environment/message_router.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "environment/testing/named_robots.h"

namespace robosim {
namespace {

struct Fixture {
  std::vector<mrpt::math::TPose2D> poses{{0, 0, 0}, {3, 4, 0}, {100, 0, 0}};
  std::vector<Readings> readings = std::vector<Readings>(3);
  std::vector<Rare<Outbox>> outboxes = std::vector<Rare<Outbox>>(3);
  std::vector<Activity> activity{Activity::active, Activity::active, Activity::active};
  SimTime time;
  RepeatedValues<double> antenna_z_m{std::vector{0.3, 0.3, 0.3}};
  std::vector<std::uint8_t> may_send{0, 0, 0};
  std::vector<MessageInFlight> in_flight;
  Scene scene{{}, 3, {-10, 110, -10, 10}};
  std::size_t dropped = 0;  ///< in the last step
  MessageLosses lost;       ///< in the last step
  std::uint64_t seed;
  std::vector<FleetRobot> robots = namedRobots({"a", "b", "c"});
  MessageRouter message_router;

  explicit Fixture(const Communication& communication = {}, std::uint64_t the_seed = 1)
      : seed(the_seed), message_router(robots, communication) {}
  void send(std::size_t from, const std::string& to, const std::string& text) {
    message_router.send(from, to, text, outboxes[from]);
    may_send[from] = 1;
  }
  void broadcast(std::size_t from, const std::string& text) {
    message_router.broadcast(from, text, outboxes[from]);
    may_send[from] = 1;
  }
  std::size_t step() {
    ++time.step;
    for (auto& robot : readings) robot.inbox.clear();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (activity[i] == Activity::absent) {
        scene.remove(i);
      } else {
        scene.place(i, {Circle{{poses[i].x, poses[i].y}, 0.2}, {0, 0.3}});
      }
    }
    scene.freeze();
    const auto counts = message_router.deliver(seed, time, {scene, poses, antenna_z_m, activity, may_send}, outboxes,
                                               in_flight, readings);
    dropped = counts.dropped;
    lost = counts.lost;
    return counts.delivered;
  }
  std::vector<std::string> textsOf(std::size_t robot) const {
    std::vector<std::string> texts;
    for (const auto& message : readings[robot].inbox) texts.push_back(message.text);
    return texts;
  }
};

using Texts = std::vector<std::string>;

TEST(MessageRouter, DeliversOnce) {
  Fixture fixture;
  fixture.send(0, "b", "GOLD a");
  EXPECT_EQ(fixture.step(), 1u);
  EXPECT_EQ(fixture.textsOf(1), Texts{"GOLD a"});
  EXPECT_EQ(fixture.readings[1].inbox[0].from, "a");
  EXPECT_TRUE(fixture.textsOf(0).empty());
  EXPECT_EQ(fixture.step(), 0u);
  EXPECT_TRUE(fixture.textsOf(1).empty());
}

TEST(MessageRouter, OrdersBySenderAndTimeOfSending) {
  Fixture fixture;
  fixture.send(2, "b", "c1");
  fixture.send(0, "b", "a1");
  fixture.send(2, "b", "c2");
  fixture.send(0, "b", "a2");
  fixture.step();
  EXPECT_EQ(fixture.textsOf(1), (Texts{"a1", "a2", "c1", "c2"}));
}

TEST(MessageRouter, DeliversOnlyWithinTheRange) {
  Fixture fixture({.range_m = 5, .loss_probability = 0});
  fixture.send(0, "b", "5 m away");
  fixture.send(0, "c", "100 m away");
  EXPECT_EQ(fixture.step(), 1u);
  EXPECT_TRUE(fixture.textsOf(2).empty());
  fixture.poses[1].x = 3.001;
  fixture.send(0, "b", "a millimetre more");
  EXPECT_EQ(fixture.step(), 0u);
}

TEST(MessageRouter, LosesTheGivenShareOfMessages) {
  Fixture fixture({.range_m = {}, .loss_probability = 0.3});
  std::size_t arrived = 0;
  for (int i = 0; i < 4000; ++i) {
    fixture.send(0, "b", "x");
    arrived += fixture.step();
  }
  EXPECT_NEAR(static_cast<double>(arrived), 2800, 4 * std::sqrt(4000 * 0.3 * 0.7));
}

TEST(MessageRouter, RejectsAnUnknownReceiverAndALongText) {
  Fixture fixture;
  EXPECT_THROW(fixture.send(0, "unknown", "x"), std::invalid_argument);
  EXPECT_THROW(fixture.send(0, "b", std::string(kMaxMessageBytes + 1, 'x')), std::invalid_argument);
  fixture.send(0, "b", std::string(kMaxMessageBytes, 'x'));
  EXPECT_EQ(fixture.step(), 1u);
}

TEST(MessageRouter, DropsAndCountsMessagesBeyondTheSendersLimit) {
  Fixture fixture;
  for (std::size_t i = 0; i < kMaxMessagesSent + 7; ++i) fixture.send(0, i % 2 ? "b" : "c", "x");
  EXPECT_EQ(fixture.step(), kMaxMessagesSent);
  EXPECT_EQ(fixture.dropped, 7u);
  fixture.send(0, "b", "y");
  EXPECT_EQ(fixture.step(), 1u) << "the next step has its own limit";
  EXPECT_EQ(fixture.dropped, 0u);
}

TEST(MessageRouter, NamesTheReceiversOfTheLastDelivery) {
  Fixture fixture({.delay_s = 0.1});
  fixture.send(0, "c", "x");
  fixture.send(1, "c", "y");
  fixture.send(2, "a", "z");
  using Robots = std::vector<std::uint32_t>;
  fixture.step();
  EXPECT_EQ(fixture.message_router.receivers(), Robots()) << "the messages are in flight";
  fixture.step();
  EXPECT_EQ(fixture.message_router.receivers(), (Robots{2, 0}));
  fixture.step();
  EXPECT_EQ(fixture.message_router.receivers(), Robots());
}

TEST(MessageRouter, DropsAndCountsMessagesBeyondTheReceiversLimit) {
  Fixture fixture;
  for (std::size_t i = 0; i < InboxLimit::kMaxMessages; ++i) fixture.send(0, "b", "a");
  fixture.send(2, "b", "c");
  fixture.send(2, "a", "c");
  EXPECT_EQ(fixture.step(), InboxLimit::kMaxMessages + 1);
  EXPECT_EQ(fixture.dropped, 1u);
  EXPECT_EQ(fixture.readings[1].inbox.back().from, "a");
  EXPECT_EQ(fixture.textsOf(0), Texts{"c"}) << "another receiver is not affected";
}

TEST(MessageRouter, DropsAndCountsMessagesBeyondTheReceiversLimitOfBytes) {
  Fixture fixture;
  // Each text of 4096 bytes comes with two names of one byte: 63 such messages are 258,174 bytes of the 262,144.
  const std::string longest(kMaxMessageBytes, 'x');
  for (int i = 0; i < 100; ++i) fixture.send(0, "b", longest);
  EXPECT_EQ(fixture.step(), 63u);
  EXPECT_EQ(fixture.dropped, 37u);
}

TEST(MessageRouter, BroadcastsToEveryOtherRobotInItsPlaceAmongTheSendersMessages) {
  Fixture fixture;
  fixture.broadcast(2, "to all");
  fixture.send(1, "a", "first");
  fixture.send(2, "a", "last");
  EXPECT_EQ(fixture.step(), 4u);
  EXPECT_EQ(fixture.textsOf(0), (Texts{"first", "to all", "last"}));
  EXPECT_EQ(fixture.readings[0].inbox[1], (RobotMessage{"c", "a", "to all"}));
  EXPECT_EQ(fixture.textsOf(1), Texts{"to all"});
  EXPECT_EQ(fixture.textsOf(2), Texts{}) << "its sender";
}

TEST(MessageRouter, BroadcastsToRobotsWithinTheRangeAndCountsTheOthers) {
  Fixture fixture({.range_m = 5});
  fixture.broadcast(0, "5 m and 100 m away");
  EXPECT_EQ(fixture.step(), 1u);
  EXPECT_EQ(fixture.textsOf(1).size(), 1u);
  EXPECT_EQ(fixture.lost, MessageLosses{.out_of_range = 1});
  fixture.poses[1].x = 3.001;
  fixture.activity[2] = Activity::absent;
  fixture.broadcast(0, "a millimetre more");
  EXPECT_EQ(fixture.step(), 0u);
  EXPECT_EQ(fixture.lost, (MessageLosses{.out_of_range = 1, .absent = 1}));
}

TEST(MessageRouter, CountsABroadcastOnceForTheSendersLimitAndRate) {
  Fixture fixture;
  for (std::size_t i = 0; i < kMaxMessagesSent + 7; ++i) fixture.broadcast(0, "x");
  EXPECT_EQ(fixture.step(), 2 * kMaxMessagesSent);
  EXPECT_EQ(fixture.dropped, 7u);
  Fixture slow({.rate_hz = 10});  // one message in a step of 0.1 s
  slow.broadcast(0, "x");
  slow.broadcast(0, "y");
  EXPECT_EQ(slow.step(), 2u);
  EXPECT_EQ(slow.step(), 2u);
  EXPECT_EQ(slow.textsOf(2), Texts{"y"});
}

TEST(MessageRouter, RejectsALongBroadcast) {
  Fixture fixture;
  EXPECT_THROW(fixture.broadcast(0, std::string(kMaxMessageBytes + 1, 'x')), std::invalid_argument);
}

TEST(MessageRouter, ABroadcastHasTheFatesOfOneMessageToEachRobot) {
  const Communication communication{.range_m = 90, .loss_probability = 0.3, .burst_gap_s = 1, .burst_s = 1};
  Fixture one(communication), each(communication);
  MessageLosses lost;
  for (int i = 0; i < 300; ++i) {
    for (const std::size_t from : {2, 0, 1}) {
      one.send(from, "b", "before");
      each.send(from, "b", "before");
      one.broadcast(from, std::to_string(i));
      for (std::size_t to = 0; to < 3; ++to) {
        if (to != from) each.send(from, each.message_router.names()[to], std::to_string(i));
      }
    }
    EXPECT_EQ(one.step(), each.step());
    for (std::size_t robot = 0; robot < 3; ++robot) ASSERT_EQ(one.textsOf(robot), each.textsOf(robot)) << i;
    ASSERT_EQ(one.lost, each.lost) << i;
    lost += one.lost;
  }
  EXPECT_GT(lost.out_of_range, 500u);
  EXPECT_GT(lost.by_chance, 100u);
  EXPECT_GT(lost.in_bursts, 50u);
}

TEST(MessageRouter, ReceivesAMessageThatIsDeliveredElsewhereInItsPlaceAmongTheSenders) {
  Fixture fixture({.range_m = 1, .loss_probability = 1});
  const auto receive = [&](std::uint32_t from, const std::string& text) {
    fixture.message_router.receiveNext(fixture.time, 1, from, text, fixture.in_flight);
  };
  receive(2, "c1");
  receive(0, "a1");
  receive(2, "c2");
  receive(0, "a2");
  EXPECT_EQ(fixture.step(), 4u);
  EXPECT_EQ(fixture.textsOf(1), (Texts{"a1", "a2", "c1", "c2"}));
  Fixture perfect;
  perfect.send(1, "a", "b1");
  perfect.message_router.receiveNext(perfect.time, 0, 2, "c1", perfect.in_flight);
  perfect.step();
  EXPECT_EQ(perfect.textsOf(0), (Texts{"b1", "c1"}));
}

}  // namespace
}  // namespace robosim
