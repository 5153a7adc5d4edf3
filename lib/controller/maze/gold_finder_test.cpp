#include "maze/gold_finder.h"

#include <gtest/gtest.h>

#include "maze/testing/fake_maze.h"

namespace robosim {
namespace {

/// A robot without obstacles, whose neighbour is "next".
struct GoldFinderTest : testing::Test {
  void receive(std::vector<RobotMessage> messages) { hardware.mutableReadings().inbox = std::move(messages); }
  void step() {
    finder.step(robot);
    hardware.advance();
  }
  std::vector<std::string> sentTexts() const {
    std::vector<std::string> texts;
    for (const auto& message : hardware.sent) texts.push_back(message.to + ": " + message.text);
    return texts;
  }
  using Texts = std::vector<std::string>;

  FakeHardware hardware{16, "next"};
  Robot robot{hardware};
  GoldFinder finder{{.seed = 1}};
};

TEST_F(GoldFinderTest, FindsGoldWhereHeatExceedsTheThreshold) {
  hardware.setHeat(10);
  step();
  EXPECT_EQ(robot.activity(), Activity::active);
  hardware.setHeat(10.01);
  step();
  EXPECT_EQ(robot.activity(), Activity::found);
}

TEST_F(GoldFinderTest, SendsGoldWithItsOwnNameAsSource) {
  hardware.setHeat(12);
  step();
  EXPECT_EQ(sentTexts(), Texts{"next: GOLD fake"});
  step();
  step();
  EXPECT_EQ(sentTexts(), Texts{"next: GOLD fake"});
}

TEST_F(GoldFinderTest, HaltsAndForwardsAReceivedGold) {
  receive({{"before", "fake", "GOLD Finder7"}});
  step();
  EXPECT_EQ(robot.activity(), Activity::halted);
  EXPECT_EQ(sentTexts(), Texts{"next: GOLD Finder7"});
  EXPECT_EQ(hardware.lastCommand().speed_mps, 0);
}

TEST_F(GoldFinderTest, EndsTheRingAtTheSource) {
  hardware.setHeat(12);
  step();
  receive({{"before", "fake", "GOLD fake"}});
  step();
  EXPECT_EQ(sentTexts(), Texts{"next: GOLD fake"});
  EXPECT_EQ(robot.activity(), Activity::found);
}

TEST_F(GoldFinderTest, SendsOneMessagePerStep) {
  receive({{"a", "fake", "GOLD A"}, {"b", "fake", "GOLD B"}, {"c", "fake", "GOLD C"}});
  step();
  EXPECT_EQ(sentTexts(), Texts{"next: GOLD A"});
  step();
  EXPECT_EQ(sentTexts(), (Texts{"next: GOLD A", "next: GOLD B"}));
  step();
  step();
  EXPECT_EQ(sentTexts(), (Texts{"next: GOLD A", "next: GOLD B", "next: GOLD C"}));
}

TEST_F(GoldFinderTest, ForwardsTheMessageOfEachSourceOnce) {
  for (int i = 0; i < 5; ++i) {
    receive({{"before", "fake", "GOLD A"}});
    step();
  }
  EXPECT_EQ(sentTexts(), Texts{"next: GOLD A"});
}

TEST_F(GoldFinderTest, ForwardsTheMessageOfAnotherSourceAfterItHasFoundGold) {
  hardware.setHeat(12);
  receive({{"before", "fake", "GOLD A"}});
  step();
  EXPECT_EQ(robot.activity(), Activity::found);
  step();
  EXPECT_EQ(sentTexts(), (Texts{"next: GOLD fake", "next: GOLD A"}));
}

TEST_F(GoldFinderTest, DoesNotFindGoldAfterItHasHalted) {
  receive({{"before", "fake", "GOLD A"}});
  step();
  hardware.setHeat(12);
  step();
  EXPECT_EQ(robot.activity(), Activity::halted);
  EXPECT_EQ(sentTexts(), Texts{"next: GOLD A"});
}

TEST_F(GoldFinderTest, IgnoresOtherMessages) {
  receive({{"before", "fake", "hello"}, {"before", "fake", "GOLD"}});
  step();
  EXPECT_EQ(robot.activity(), Activity::active);
  EXPECT_TRUE(hardware.sent.empty());
}

TEST(GoldFinder, WithoutANeighbourHaltsAndSendsNothing) {
  FakeHardware hardware;
  Robot robot(hardware);
  GoldFinder finder({});
  hardware.setHeat(12);
  finder.step(robot);
  EXPECT_EQ(robot.activity(), Activity::found);
  EXPECT_TRUE(hardware.sent.empty());
}

TEST(GoldFinder, UsesTheThresholdOfItsOptions) {
  FakeHardware hardware;
  Robot robot(hardware);
  GoldFinder finder({}, {.heat_threshold = 5});
  hardware.setHeat(6);
  finder.step(robot);
  EXPECT_EQ(robot.activity(), Activity::found);
}

TEST(GoldFinder, FindsTheGold) {
  auto walls = FakeMaze::room(-1, 6, -1, 4);
  walls.push_back(FakeMaze::box(2.5, 0.85, 0.1, 3.7));
  FakeMaze maze(walls, {5.3, -0.4}, 20);
  Robot robot(maze.hardware);
  GoldFinder finder({.seed = 3});
  int steps = 0;
  for (; steps < 1500 && robot.activity() == Activity::active; ++steps) {
    finder.step(robot);
    maze.hardware.advance();
  }
  EXPECT_EQ(robot.activity(), Activity::found);
  EXPECT_GT(*robot.heat(), 10);
}

}  // namespace
}  // namespace robosim
