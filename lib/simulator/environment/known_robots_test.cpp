#include "environment/known_robots.h"

#include <gtest/gtest.h>

#include "environment/environment.h"
#include "environment/step_phases.h"
#include "environment/testing/small_world.h"

namespace robosim {
namespace {

std::vector<std::size_t> visited(const KnownRobots& known) {
  std::vector<std::size_t> robots, in_parallel;
  known.inOrder([&](const auto& order) {
    for (std::size_t k = 0; k < order.size(); ++k) robots.push_back(order[k]);
  });
  known.forEach(ParallelExecutor(1), 2, [&](std::size_t robot) { in_parallel.push_back(robot); });
  EXPECT_EQ(robots, in_parallel);
  return robots;
}

TEST(KnownRobots, AreAllUnlessLimited) {
  KnownRobots known(4);
  EXPECT_TRUE(known.areAll());
  EXPECT_EQ(visited(known), (std::vector<std::size_t>{0, 1, 2, 3}));
  known.limitTo(std::vector<std::uint32_t>{1, 3});
  EXPECT_FALSE(known.areAll());
  EXPECT_EQ(visited(known), (std::vector<std::size_t>{1, 3}));
  known.limitTo({});
  EXPECT_FALSE(known.areAll());
  EXPECT_EQ(visited(known), std::vector<std::size_t>());
  known.limitTo(std::vector<std::uint32_t>{0, 1, 2, 3});
  EXPECT_TRUE(known.areAll());
  EXPECT_EQ(visited(known), (std::vector<std::size_t>{0, 1, 2, 3}));
}

TEST(Flags, AreVisitedInOrder) {
  const std::vector<std::uint8_t> flags{1, 0, 0, 1, 1, 0, 1, 0, 0, 0, 0, 0};
  std::vector<std::size_t> set;
  forFlags(flags, [&](std::size_t i) { set.push_back(i); });
  EXPECT_EQ(set, (std::vector<std::size_t>{0, 3, 4, 6}));
  forFlags({}, [](std::size_t) { FAIL(); });
  EXPECT_TRUE(anyFlag(flags));
  EXPECT_FALSE(anyFlag(std::vector<std::uint8_t>(100, 0)));
  EXPECT_FALSE(anyFlag({}));
}

TEST(KnownRobots, NeitherMoveNorMeetTheOthers) {
  World world = emptyWorld(5);
  Fleet fleet;
  addDisc(world, fleet, "a", {0, 0, 0});
  addDisc(world, fleet, "b", {0.6, 0, 0});
  addDisc(world, fleet, "c", {-0.6, 0, 0});
  Environment environment(world, fleet, {});
  // The second one is 0.1 m before the first; the third one would drive on.
  environment.setCommand(0, {.speed_mps = 2});
  environment.setCommand(2, {.speed_mps = 1});
  environment.phases().limitTo(std::vector<std::uint32_t>{0, 1}, {0, 1});
  environment.step();
  EXPECT_NEAR(environment.state().world_from_robot[0].x, 0.1, 2e-6);
  EXPECT_EQ(environment.state().world_from_robot[2].x, -0.6);
  environment.setCommand(0, {.speed_mps = -1});
  environment.step();
  EXPECT_NEAR(environment.state().world_from_robot[0].x, 0, 2e-6);
  environment.step();
  EXPECT_NEAR(environment.state().world_from_robot[0].x, -0.1, 2e-6);
  environment.step();
  EXPECT_NEAR(environment.state().world_from_robot[0].x, -0.2, 2e-6) << "the third one is not in the way";
  const std::uint64_t stalls = environment.state().stalls;

  // Now the first one only: it drives where the second one is, and its stalls are not counted.
  environment.phases().limitTo(std::vector<std::uint32_t>{0}, {1, 1});
  environment.setCommand(0, {.speed_mps = 1});
  for (int i = 0; i < 100; ++i) environment.step();
  EXPECT_NEAR(environment.state().world_from_robot[0].x, 5 - 0.25, 2e-6);
  EXPECT_TRUE(environment.state().stalled[0]);
  EXPECT_EQ(environment.state().stalls, stalls);
}

TEST(KnownRobots, AreNotTheOnlyOnesWhoseMessagesAreRemovedAfterAStep) {
  World world = emptyWorld(5);
  Fleet fleet;
  for (const char* name : {"a", "b", "c"})
    addDisc(world, fleet, name, {static_cast<double>(fleet.robots.size()), 0, 0});
  Environment environment(world, fleet, {});
  environment.phases().limitTo(std::vector<std::uint32_t>{0}, {0, 1});
  const auto messages = [&] {
    std::vector<std::size_t> counts;
    for (const auto& readings : environment.state().readings) counts.push_back(readings.inbox.size());
    return counts;
  };
  using Counts = std::vector<std::size_t>;
  environment.send(0, "b", "x");
  environment.send(0, "c", "y");
  environment.step();
  EXPECT_EQ(messages(), (Counts{0, 1, 1}));
  const State with_messages = environment.state();
  environment.send(0, "c", "z");
  environment.step();
  EXPECT_EQ(messages(), (Counts{0, 0, 1}));
  environment.step();
  EXPECT_EQ(messages(), (Counts{0, 0, 0}));
  environment.restore(with_messages);
  EXPECT_EQ(messages(), (Counts{0, 1, 1}));
  environment.step();
  EXPECT_EQ(messages(), (Counts{0, 0, 0})) << "of a state that was restored";
}

TEST(KnownRobots, HaveTheMotionThatAnotherProcessHasComputed) {
  World world = emptyWorld(5);
  Fleet fleet;
  addDisc(world, fleet, "a", {0, 0, 0});
  addDisc(world, fleet, "b", {2, 0, 0});
  Environment environment(world, fleet, {});
  environment.phases().limitTo(std::vector<std::uint32_t>{0}, {0, 1});
  environment.step();
  environment.phases().motion().world_from_robot[1] = {0.6, 0, 0};
  environment.phases().orders().activity[1] = Activity::halted;
  environment.phases().limitTo(std::vector<std::uint32_t>{0, 1}, {0, 1});
  environment.setCommand(0, {.speed_mps = 1});
  for (int i = 0; i < 5; ++i) environment.step();
  EXPECT_NEAR(environment.state().world_from_robot[0].x, 0.1, 2e-6);
  EXPECT_EQ(environment.state().activity[1], Activity::halted);
}

}  // namespace
}  // namespace robosim
