// CheckWin: a robot asks whether it is near enough to the gold; the environment decides, reports the winner to all
// robots, and halts them.
#include <gtest/gtest.h>

#include "environment/local_hardware.h"
#include "environment/testing/small_world.h"

namespace robosim {
namespace {

/// Robots of 0.25 m radius near gold of 0.2 m radius at the origin: with its centre at 1.25 m, a robot is 0.8 m away.
struct Contest {
  World world = emptyWorld(10);
  Fleet fleet;

  explicit Contest(double win_distance_m = kWinDistance_m) {
    world.win_distance_m = win_distance_m;
    addGold(world, 0, 0);
  }
  void robot(const std::string& name, double x_m) { addDisc(world, fleet, name, {x_m, 0, 0}); }
  std::unique_ptr<Environment> start() const {
    return std::make_unique<Environment>(world, fleet, EnvironmentOptions{});
  }
};

using Activities = std::vector<Activity>;

TEST(Winning, CheckWinWithinTheWinDistanceWinsAndHaltsAll) {
  Contest contest(0.81);
  contest.robot("a", 5);
  contest.robot("b", 1.25);
  const auto environment = contest.start();
  environment->setCommand(0, {.speed_mps = 1});
  environment->checkWin(1);
  environment->step();
  EXPECT_EQ(environment->state().winner(), 1u);
  for (const auto& readings : environment->state().readings)
    EXPECT_EQ(readings.winner, "b") << "all robots are informed";
  EXPECT_EQ(environment->state().activity, (Activities{Activity::halted, Activity::found}));
  EXPECT_TRUE(environment->allHalted());

  const double x = environment->state().world_from_robot[0].x;
  environment->setCommand(0, {.speed_mps = 1});
  environment->step();
  EXPECT_EQ(environment->state().world_from_robot[0].x, x) << "a halted robot stays halted";
  EXPECT_EQ(environment->state().winner(), 1u);
}

TEST(Winning, DoesNotChangeTheCommandsOfTheStepInWhichItIsDecided) {
  // A replay needs the commands that the robots were driven with: here they kept turning.
  Contest contest(0.81);
  contest.robot("a", 5);
  contest.robot("b", 1.25);
  const auto environment = contest.start();
  for (const std::size_t robot : {0, 1}) environment->setCommand(robot, {.turn_radps = 0.5});
  environment->checkWin(1);
  environment->step();
  ASSERT_EQ(environment->state().winner(), 1u);
  for (const auto& command : environment->state().commands) EXPECT_EQ(command.activity, Activity::active);
  EXPECT_NE(environment->state().turn_radps[0], 0);

  for (const std::size_t robot : {0, 1}) environment->setCommand(robot, {.turn_radps = 0.5});
  environment->step();
  EXPECT_EQ(environment->state().commands[0].activity, Activity::halted);
  EXPECT_EQ(environment->state().commands[1].activity, Activity::found);
}

TEST(Winning, ReportsTooFarOnceAndContinues) {
  Contest contest(0.79);
  contest.robot("a", 1.25);
  const auto environment = contest.start();
  LocalHardware hardware(*environment, 0);
  hardware.checkWin();
  environment->step();
  EXPECT_TRUE(hardware.readings().is_too_far);
  EXPECT_EQ(hardware.readings().winner, "");
  EXPECT_FALSE(environment->allHalted());
  environment->step();
  EXPECT_FALSE(hardware.readings().is_too_far);
}

TEST(Winning, RequiresCheckWin) {
  Contest contest;
  contest.robot("a", 0.5);
  const auto environment = contest.start();
  environment->step();
  EXPECT_EQ(environment->state().winner(), std::nullopt);
}

TEST(Winning, UsesThePoseAfterTheStep) {
  Contest contest(0.75);
  contest.robot("a", -1.25);  // 0.8 m away, and after a step at 1 m/s 0.7 m
  const auto environment = contest.start();
  environment->setCommand(0, {.speed_mps = 1});
  environment->checkWin(0);
  environment->step();
  EXPECT_EQ(environment->state().winner(), 0u);
}

TEST(Winning, NearestOfSeveralWins) {
  Contest contest(1);
  contest.robot("a", -1.25);
  contest.robot("b", 1.2);
  contest.robot("c", 1.8);
  const auto environment = contest.start();
  for (const std::size_t robot : {0, 1, 2}) environment->checkWin(robot);
  environment->step();
  EXPECT_EQ(environment->state().readings[0].winner, "b");
}

TEST(Winning, FirstOfEquallyNearWins) {
  Contest contest(1);
  contest.robot("b", 1.25);
  contest.robot("a", -1.25);
  const auto environment = contest.start();
  for (const std::size_t robot : {1, 0}) environment->checkWin(robot);
  environment->step();
  EXPECT_EQ(environment->state().readings[0].winner, "b");
}

TEST(Winning, MeasuresToTheOutlineOfEveryHotObject) {
  Contest contest;
  addWall(contest.world, 5, 0, 4, 1);  // from x = 3 to x = 7
  contest.world.objects.back().body.heat_celsius = 30;
  contest.robot("a", 2.3);  // 0.45 m from it; 2.45 m from its centre
  const auto environment = contest.start();
  environment->checkWin(0);
  environment->step();
  EXPECT_EQ(environment->state().winner(), 0u);
}

TEST(Winning, IsImpossibleWithoutGold) {
  Contest contest(1000);
  contest.world.objects.clear();
  contest.robot("a", 0);
  const auto environment = contest.start();
  environment->checkWin(0);
  environment->step();
  EXPECT_EQ(environment->state().winner(), std::nullopt);
  EXPECT_TRUE(environment->state().readings[0].is_too_far);
}

TEST(Winning, KeepsTheActivityOfHaltedRobots) {
  Contest contest;
  for (const char* name : {"a", "b", "c"})
    contest.robot(name, 0.5 + 2 * static_cast<double>(contest.fleet.robots.size()));
  const auto environment = contest.start();
  environment->setCommand(1, {.activity = Activity::found});
  environment->step();
  environment->checkWin(0);
  environment->step();
  EXPECT_EQ(environment->state().activity, (Activities{Activity::found, Activity::found, Activity::halted}));
}

TEST(Winning, ChangesTheDigestAlsoWhenRefused) {
  const auto digest_of = [](double win_distance_m, bool asks) {
    Contest contest(win_distance_m);
    contest.robot("a", 1.25);
    const auto environment = contest.start();
    if (asks) environment->checkWin(0);
    environment->step();
    return environment->digest();
  };
  EXPECT_NE(digest_of(0.1, true), digest_of(0.1, false));
  EXPECT_NE(digest_of(0.1, true), digest_of(1, true));
  EXPECT_EQ(digest_of(0.1, false), digest_of(1, false));
}

}  // namespace
}  // namespace robosim
