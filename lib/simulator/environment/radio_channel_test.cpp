#include "environment/radio_channel.h"

#include <cmath>

#include <gtest/gtest.h>

#include "environment/message_router.h"
#include "environment/testing/named_robots.h"

namespace robosim {
namespace {

Solid wallAt(double x_m, double height_m = 1) { return {OrientedBox::from({x_m, 0, 0}, 0.1, 4), {0, height_m}}; }

/// Two robots, a at the origin and b at x = 10, whose antennas are 0.3 m high.
struct TwoRobots {
  Scene scene;
  std::vector<mrpt::math::TPose2D> poses{{0, 0, 0}, {10, 0, 0}};
  RepeatedValues<double> antenna_z_m{std::vector{0.3, 0.3}};
  std::vector<Activity> activity{Activity::active, Activity::active};
  std::vector<Rare<Outbox>> outboxes = std::vector<Rare<Outbox>>(2);
  std::vector<std::uint8_t> may_send{0, 0};
  std::vector<MessageInFlight> in_flight;
  std::vector<Readings> readings = std::vector<Readings>(2);
  SimTime time;
  std::vector<FleetRobot> robots = namedRobots({"a", "b"});
  MessageRouter router;
  MessageCounts counts;

  explicit TwoRobots(const Communication& communication, const std::vector<Solid>& solids = {})
      : scene(solids, 0, {-20, 20, -20, 20}), router(robots, communication) {}
  void send(const std::string& text) {
    router.send(0, "b", text, outboxes[0]);
    may_send[0] = 1;
  }
  void step() {
    ++time.step;
    for (auto& robot : readings) robot.inbox.clear();
    counts = router.deliver(7, time, {scene, poses, antenna_z_m, activity, may_send}, outboxes, in_flight, readings);
  }
  std::size_t received() const { return readings[1].inbox.size(); }
};

TEST(Radio, CountsWallsOnTheLineBetweenTheAntennas) {
  const Scene scene({wallAt(2), wallAt(3), wallAt(5, 0.2), wallAt(12)}, 0, {-20, 20, -20, 20});
  EXPECT_EQ(RadioChannel::wallsBetween(scene, {0, 0, 0.3}, {10, 0, 0.3}), 2) << "not the low one, nor the one beyond";
  EXPECT_EQ(RadioChannel::wallsBetween(scene, {10, 0, 0.3}, {0, 0, 0.3}), 2);
  EXPECT_EQ(RadioChannel::wallsBetween(scene, {0, 0, 0.3}, {0, 8, 0.3}), 0);
}

TEST(Radio, CountsSolidsThatTouchOnTheLineAsOneWall) {
  // A diagonal wall of a map: squares of 0.25 m along the line from (0, 0) to (4, 4), each of which touches the next at
  // a corner, then a gap of 0.1 m and another square.
  std::vector<Solid> squares;
  for (int i = 4; i < 8; ++i) squares.push_back({OrientedBox::from({0.25 * i, 0.25 * i, 0}, 0.25, 0.25), {0, 1}});
  const auto walls = [&] {
    return RadioChannel::wallsBetween(Scene(squares, 0, {-20, 20, -20, 20}), {0, 0, 0.3}, {4, 4, 0.3});
  };
  EXPECT_EQ(walls(), 1);
  squares.push_back({OrientedBox::from({2.1, 2.1, 0}, 0.25, 0.25), {0, 1}});
  EXPECT_EQ(walls(), 2);
  squares.push_back({OrientedBox::from({1.9, 1.9, 0}, 0.3, 0.3), {0, 1}});
  EXPECT_EQ(walls(), 1) << "the gap is filled";
}

TEST(Radio, CountsAWallInWhichAnAntennaIs) {
  const Scene scene({wallAt(0), wallAt(10)}, 0, {-20, 20, -20, 20});
  EXPECT_EQ(RadioChannel::wallsBetween(scene, {0, 0, 0.3}, {10, 0, 0.3}), 2);
}

TEST(Radio, WallsTakeRange) {
  // 10 m and two walls of 2.4 m each: 14.8 m.
  for (const auto& [range_m, arrives] : {std::pair{14.9, true}, {14.7, false}}) {
    TwoRobots robots({.range_m = range_m, .wall_range_m = 2.4}, {wallAt(2), wallAt(3)});
    robots.send("x");
    robots.step();
    EXPECT_EQ(robots.received(), arrives ? 1u : 0u);
    EXPECT_EQ(robots.counts.lost.stopped_by_walls, arrives ? 0u : 1u);
  }
}

TEST(Radio, EachWallStopsItsShareOfTheMessages) {
  TwoRobots robots({.wall_loss = 0.5}, {wallAt(2), wallAt(3)});
  std::size_t arrived = 0, stopped = 0;
  for (int i = 0; i < 4000; ++i) {
    robots.send("x");
    robots.step();
    arrived += robots.received();
    stopped += robots.counts.lost.stopped_by_walls;
  }
  EXPECT_NEAR(static_cast<double>(arrived), 1000, 4 * std::sqrt(4000 * 0.25 * 0.75));
  EXPECT_EQ(arrived + stopped, 4000u);
}

TEST(Radio, BurstsHaveTheGivenMeanDurationAndGap) {
  // Steps of 0.1 s: r = 0.1 / 0.5 = 0.2, p = 0.1 / 2 = 0.05. A fifth of the time is bad, in bursts of 5 steps.
  const Communication communication{.burst_gap_s = 2, .burst_s = 0.5};
  const RadioChannel channel(communication);
  int bad = 0, bursts = 0;
  bool was_bad = false;
  constexpr int n = 40000;
  for (int step = 1; step <= n; ++step) {
    const bool is_bad = channel.isBad(3, {static_cast<std::uint64_t>(step), 0.1}, 4, 9);
    bad += is_bad ? 1 : 0;
    bursts += is_bad && !was_bad ? 1 : 0;
    was_bad = is_bad;
  }
  // Successive states correlate by 1 - p - r = 0.75: n / 7 independent ones.
  EXPECT_NEAR(static_cast<double>(bad) / n, 0.2, 4 * std::sqrt(0.2 * 0.8 * 7 / n));
  EXPECT_NEAR(static_cast<double>(bad) / bursts, 5, 4 * 5 / std::sqrt(bursts));
}

TEST(Radio, ChannelsAreTheSameBothWaysAndDifferBetweenPairs) {
  const Communication communication{.burst_gap_s = 1, .burst_s = 1};
  const RadioChannel channel(communication);
  int differ = 0;
  for (std::uint64_t step = 0; step < 200; ++step) {
    const SimTime now{step, 0.1};
    EXPECT_EQ(channel.isBad(3, now, 1, 2), channel.isBad(3, now, 2, 1));
    differ += channel.isBad(3, now, 1, 2) != channel.isBad(3, now, 1, 3) ? 1 : 0;
  }
  EXPECT_GT(differ, 30);
}

TEST(Radio, MessagesInABurstAreLostTogether) {
  TwoRobots robots({.burst_gap_s = 2, .burst_s = 0.5});
  std::size_t lost = 0;
  for (int i = 0; i < 1000; ++i) {
    robots.send("x");
    robots.send("y");
    robots.step();
    EXPECT_TRUE(robots.received() == 0 || robots.received() == 2);
    lost += robots.counts.lost.in_bursts;
  }
  EXPECT_NEAR(static_cast<double>(lost), 400, 4 * 2 * std::sqrt(1000 * 0.2 * 0.8 * 7));
}

TEST(Radio, DelaysByWholeStepsAndKeepsTheOrder) {
  // 0.25 s are three steps of 0.1 s beyond the next one.
  TwoRobots robots({.delay_s = 0.25});
  robots.send("first");
  robots.step();
  robots.send("second");
  EXPECT_EQ(robots.received(), 0u);
  for (int i = 0; i < 2; ++i) {
    robots.step();
    EXPECT_EQ(robots.received(), 0u);
  }
  robots.step();
  ASSERT_EQ(robots.received(), 1u);
  EXPECT_EQ(robots.readings[1].inbox[0].text, "first");
  robots.step();
  ASSERT_EQ(robots.received(), 1u);
  EXPECT_EQ(robots.readings[1].inbox[0].text, "second");
  EXPECT_TRUE(robots.in_flight.empty());
}

TEST(Radio, LosesDelayedMessagesToARobotThatHasLeft) {
  TwoRobots robots({.delay_s = 0.1});
  robots.send("x");
  robots.step();
  robots.activity[1] = Activity::absent;
  robots.step();
  EXPECT_EQ(robots.counts.lost.absent, 1u);
  EXPECT_EQ(robots.received(), 0u);
}

TEST(Radio, MessagesBeyondTheRateWaitInTheOutbox) {
  // 15 messages per second in steps of 0.1 s: one and two in turn.
  TwoRobots robots({.rate_hz = 15});
  for (int i = 0; i < 5; ++i) robots.send(std::to_string(i));
  std::string received;
  for (int step = 0; step < 4; ++step) {
    robots.step();
    for (const auto& message : robots.readings[1].inbox) received += message.text;
    received += '|';
  }
  EXPECT_EQ(received, "0|12|3|4|");
}

}  // namespace
}  // namespace robosim
