// Robots that are not in the world: Environment::remove(), and place(), which brings them back.
#include <gtest/gtest.h>

#include "base/random.h"
#include "environment/environment.h"
#include "environment/state_bytes.h"
#include "environment/testing/probe_run.h"
#include "environment/testing/small_world.h"

namespace robosim {
namespace {

constexpr std::size_t kLast = ProbeRun::kRobots - 1;

/// Commands that depend on the seed, the robot and the step only.
void driveRandomly(Environment& environment, std::uint64_t seed) {
  for (std::uint32_t i = 0; i < environment.robotCount(); ++i) {
    Rng rng(seed, RandomPurpose::test, i, 1, environment.time().step / 20);
    environment.setCommand(i, {.speed_mps = rng.uniform(-1, 1), .turn_radps = rng.uniform(-2, 2)});
    environment.send(i, environment.robotNames()[(i + 1) % kLast], "here");
  }
  environment.step();
}

TEST(AbsentRobot, IsNeitherSensedNorInTheWay) {
  std::uint64_t stalls = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::shared_ptr<const Model> larger = ProbeRun(seed).environment().model();
    // Random numbers depend on a robot's number, so the others are the same in a world that never had the last one.
    const auto smaller = std::make_shared<Model>(*larger);
    smaller->fleet.robots.pop_back();
    Environment with_absent(larger, initialState(*larger), 2);
    with_absent.remove(kLast);
    Environment without(smaller, initialState(*smaller));
    for (int step = 0; step < 60; ++step) {
      driveRandomly(with_absent, seed);
      driveRandomly(without, seed);
    }
    const State &a = with_absent.state(), &b = without.state();
    for (std::size_t i = 0; i < kLast; ++i) {
      EXPECT_EQ(a.world_from_robot[i], b.world_from_robot[i]) << "robot " << i << ", seed " << seed;
      EXPECT_EQ(a.readings[i], b.readings[i]) << "robot " << i << ", seed " << seed;
    }
    EXPECT_EQ(a.stalls, b.stalls);
    stalls += a.stalls;
    EXPECT_EQ(a.messages_delivered, b.messages_delivered);
  }
  EXPECT_GT(stalls, 100u);
}

struct TwoDiscs {
  TwoDiscs() {
    World world = emptyWorld(5);
    Fleet fleet;
    addDisc(world, fleet, "first", {0, 0, 0});
    addDisc(world, fleet, "second", {1, 0, 0});
    environment = std::make_unique<Environment>(std::move(world), std::move(fleet), EnvironmentOptions{});
  }
  std::unique_ptr<Environment> environment;
};

TEST(AbsentRobot, LeavesNoTraceInTheDigestOfAVisitBetweenTwoSteps) {
  const auto digest_of = [](bool visits) {
    const TwoDiscs discs;
    Environment& environment = *discs.environment;
    environment.setCommand(1, {.speed_mps = 0.5});
    environment.step();
    environment.remove(1);
    environment.step();
    if (visits) {  // at its start, where it was before it drove
      EXPECT_TRUE(environment.enter(1));
      environment.remove(1);
    }
    environment.step();
    return environment.digest();
  };
  EXPECT_EQ(digest_of(true), digest_of(false));
}

TEST(AbsentRobot, ChangesTheDigestByItsAbsence) {
  const auto digest_without = [](std::vector<std::size_t> absent) {
    const TwoDiscs discs;
    discs.environment->remove(absent);
    discs.environment->step();
    return discs.environment->digest();
  };
  EXPECT_NE(digest_without({0}), digest_without({1}));
  EXPECT_NE(digest_without({0}), digest_without({}));
}

TEST(AbsentRobot, EntersAtItsStartWithoutAnIntervention) {
  const TwoDiscs discs;
  Environment& environment = *discs.environment;
  EXPECT_FALSE(environment.enter(1)) << "it is in the world";
  environment.remove(1);
  EXPECT_TRUE(environment.enter(1));
  EXPECT_EQ(environment.state().interventions_applied, 0u);
  environment.remove(1);
  EXPECT_EQ(environment.apply({"test", PlaceBody{"first", 1, 0}}), "");
  EXPECT_FALSE(environment.enter(1)) << "the first robot is there";
  EXPECT_EQ(environment.state().interventions_applied, 1u);
}

TEST(AbsentRobot, NeitherMovesNorReceivesMessages) {
  TwoDiscs discs;
  Environment& environment = *discs.environment;
  environment.send(0, "second", "before");
  environment.remove(1);
  environment.send(0, "second", "after");
  environment.setCommand(1, {.speed_mps = 1});
  environment.step();
  const State& state = environment.state();
  EXPECT_EQ(state.activity[1], Activity::absent);
  EXPECT_EQ(state.world_from_robot[1].x, 1);
  EXPECT_EQ(state.driven_m[1], 0);
  EXPECT_TRUE(state.readings[1].inbox.empty());
  EXPECT_EQ(state.messages_delivered, 0u);
}

TEST(AbsentRobot, ComesBackAtRestWithBlankReadingsWhereItIsFree) {
  TwoDiscs discs;
  Environment& environment = *discs.environment;
  environment.setCommand(1, {.speed_mps = 1});
  for (int i = 0; i < 5; ++i) environment.step();
  const auto odometry = [&] { return std::get<Odometry>(environment.state().readings[1].measurements[0]); };
  EXPECT_NEAR(odometry().odom_from_robot.x, 0.5, 1e-9);
  environment.remove(1);
  environment.step();
  EXPECT_EQ(environment.apply({"test", PlaceBody{"second", 0.3, 0}}),
            "'second' would overlap 'first'; choose another place");
  EXPECT_EQ(environment.state().activity[1], Activity::absent);
  EXPECT_EQ(environment.apply({"test", PlaceBody{"second", -2, 1}}), "");
  EXPECT_EQ(environment.state().activity[1], Activity::active);
  environment.step();
  EXPECT_EQ(environment.state().world_from_robot[1].x, -2) << "the earlier command has no effect";
  EXPECT_EQ(odometry().odom_from_robot.x, 0);
}

TEST(AbsentRobot, CannotLeaveByItsCommand) {
  TwoDiscs discs;
  discs.environment->setCommand(0, {.speed_mps = 1, .activity = Activity::absent});
  discs.environment->step();
  EXPECT_EQ(discs.environment->state().activity[0], Activity::active);
  EXPECT_NEAR(discs.environment->state().world_from_robot[0].x, 0.1, 1e-9);
}

TEST(AbsentRobot, KeepsARunGoing) {
  TwoDiscs discs;
  Environment& environment = *discs.environment;
  environment.remove(1);
  environment.setCommand(0, {.activity = Activity::halted});
  environment.step();
  EXPECT_FALSE(environment.allHalted());
}

TEST(AbsentRobot, IsPartOfASavedState) {
  TwoDiscs discs;
  Environment& environment = *discs.environment;
  environment.remove(1);
  environment.step();
  const State loaded = stateFromBytes(*environment.model(), toBytes(*environment.model(), environment.state()));
  EXPECT_EQ(loaded, environment.state());
}

}  // namespace
}  // namespace robosim
