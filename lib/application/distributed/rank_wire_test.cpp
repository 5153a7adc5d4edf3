#include "distributed/rank_wire.h"

#include <cmath>

#include <gtest/gtest.h>

#include "environment/step_phases.h"

namespace robosim {
namespace {

/// What some robots' controllers have requested, on one rank.
struct Orders {
  std::vector<Command> commands;
  std::vector<Rare<Outbox>> outboxes;
  std::vector<std::uint8_t> may_send, win_requests;
  std::vector<Activity> activity;

  explicit Orders(std::size_t robots)
      : commands(robots),
        outboxes(robots),
        may_send(robots),
        win_requests(robots),
        activity(robots, Activity::active) {}
  StepOrders all() { return {commands, outboxes, may_send, win_requests, activity}; }
};

/// Bytes about robots 1 to 3 of 5, of which all receivers know 1 and 3, after `decide` has changed the orders.
template <typename Decide>
std::string bytesAfter(Orders& orders, const Decide& decide) {
  OrdersWriter writer;
  writer.begin(orders.all(), {1, 4});
  decide();
  writer.end(orders.all(), std::vector<std::uint32_t>{1, 3});
  return std::string(writer.forAll());
}

TEST(OrdersWriter, WritesChangedCommandsOfRobotsThatTheReceiverKnows) {
  Orders from(5), to(5);
  const std::string bytes = bytesAfter(from, [&] {
    from.commands[2].speed_mps = 2;
    from.commands[3] = {.speed_mps = 0.5, .turn_radps = -1, .laser_pan_rad = 0.25F};
  });
  readOrders(bytes, {1, 4}, to.all());
  EXPECT_EQ(to.commands[2], Command());
  EXPECT_EQ(to.commands[3], from.commands[3]);
  EXPECT_EQ(bytesAfter(from, [&] { from.commands[2].speed_mps = 3; }), "") << "the receiver does not know robot 2";
}

TEST(OrdersWriter, WritesCommandsForOneReceiverSeparately) {
  Orders from(5), to(5);
  OrdersWriter writer;
  writer.begin(from.all(), {1, 4});
  from.commands[1].speed_mps = 1;
  from.commands[3].speed_mps = 3;
  writer.end(from.all(), {});
  EXPECT_EQ(writer.forAll(), "");
  std::string bytes, none;
  writer.writeCommands(from.all(), std::vector<std::uint32_t>{2, 3}, bytes);
  readCommands(bytes, {1, 4}, to.all());
  EXPECT_EQ(to.commands[1], Command());
  EXPECT_EQ(to.commands[3], from.commands[3]);
  writer.writeCommands(from.all(), std::vector<std::uint32_t>{2}, none);
  EXPECT_EQ(none, "");
  EXPECT_THROW(readCommands(bytes, {1, 3}, to.all()), std::runtime_error);
}

TEST(OrdersWriter, DistinguishesNegativeZero) {
  Orders from(5), to(5);
  const std::string bytes = bytesAfter(from, [&] { from.commands[3].turn_radps = -0.0; });
  readOrders(bytes, {1, 4}, to.all());
  EXPECT_TRUE(std::signbit(to.commands[3].turn_radps));
}

TEST(OrdersWriter, WritesMessagesRequestsAndActivityOfAllRobots) {
  Orders from(5), to(5);
  to.activity[3] = Activity::found;
  const std::string bytes = bytesAfter(from, [&] {
    from.outboxes[2].emplace().messages.push_back({4, "hello"});
    from.outboxes[2]->messages.push_back({kEveryOtherRobot, "all"});
    from.outboxes[2]->surplus = 7;
    from.win_requests[1] = 1;
    from.commands[2].activity = from.commands[3].activity = Activity::halted;
  });
  readOrders(bytes, {1, 4}, to.all());
  EXPECT_EQ(to.outboxes[2], from.outboxes[2]);
  EXPECT_EQ(to.may_send, (std::vector<std::uint8_t>{0, 0, 1, 0, 0}));
  EXPECT_EQ(to.win_requests, from.win_requests);
  EXPECT_EQ(to.activity[2], Activity::halted);
  EXPECT_EQ(to.activity[3], Activity::found) << "has ended before";
}

TEST(OrdersWriter, ReadsOnlyOrdersOfTheSendersRobots) {
  Orders from(5), to(5);
  const std::string bytes = bytesAfter(from, [&] { from.commands[3].speed_mps = 2; });
  EXPECT_THROW(readOrders(bytes, {1, 3}, to.all()), std::runtime_error);
  EXPECT_THROW(readOrders(bytes + "x", {1, 4}, to.all()), std::runtime_error);
  EXPECT_THROW(readOrders(bytes.substr(1), {1, 4}, to.all()), std::runtime_error);
}

/// Results of a robot with a sensor that measures named numbers, on one rank.
struct Measured {
  std::vector<Readings> readings{1};

  explicit Measured(std::vector<double> values) { readings[0].measurements = {Values{std::move(values)}}; }
  PhaseResults results() { return {{}, {}, readings, nullptr}; }
};

TEST(ReadingsBytes, ContainAnyNumberThatASensorMeasures) {
  Measured from({std::nan(""), -INFINITY, 1}), to({0, 0, 0});
  std::string bytes;
  writeReadings(from.results(), {0, 1}, bytes);
  readReadings(bytes, {0, 1}, to.results());
  const auto& values = std::get<Values>(to.readings[0].measurements[0]).values;
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_EQ(values[1], -INFINITY);
  EXPECT_EQ(values[2], 1);
}

TEST(ReadingsBytes, OfAnotherSizeAreRejectedWithAnErrorAboutRanks) {
  Measured from({1, 2}), to({0, 0, 0});
  std::string bytes, error;
  writeReadings(from.results(), {0, 1}, bytes);
  try {
    readReadings(bytes, {0, 1}, to.results());
  } catch (const std::runtime_error& e) {
    error = e.what();
  }
  EXPECT_EQ(error,
            "another rank has sent invalid readings: they end too early; use the same version of RoboSim on all "
            "machines");
}

}  // namespace
}  // namespace robosim
