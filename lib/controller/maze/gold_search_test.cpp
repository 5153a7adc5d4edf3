#include "maze/gold_search.h"

#include <gtest/gtest.h>

#include "maze/testing/fake_maze.h"

namespace robosim {
namespace {

/// Drives ahead at 0.5 m/s.
class Ahead : public Controller {
 public:
  void step(Robot& robot) override { robot.drive(0.5, 0); }
  std::unique_ptr<Controller> clone() const override { return std::make_unique<Ahead>(); }
};

TEST(GoldSearch, MovesUntilTheHeatExceedsTheThreshold) {
  FakeHardware hardware(16, "next");
  Robot robot(hardware);
  GoldSearch search(std::make_unique<Ahead>(), 8);
  hardware.setHeat(8);
  search.step(robot);
  EXPECT_EQ(hardware.lastCommand().speed_mps, 0.5);
  hardware.setHeat(8.1);
  search.step(robot);
  EXPECT_EQ(robot.activity(), Activity::found);
  EXPECT_EQ(hardware.lastCommand().speed_mps, 0);
  ASSERT_EQ(hardware.sent.size(), 1u);
  EXPECT_EQ(hardware.sent[0], (RobotMessage{"fake", "next", "GOLD fake"}));
}

TEST(GoldSearch, HaltsAndForwardsAReceivedGold) {
  FakeHardware hardware(16, "next");
  Robot robot(hardware);
  GoldSearch search(std::make_unique<Ahead>());
  hardware.mutableReadings().inbox.edit() = {{"before", "fake", "GOLD Finder7"}};
  search.step(robot);
  EXPECT_EQ(robot.activity(), Activity::halted);
  ASSERT_EQ(hardware.sent.size(), 1u);
  EXPECT_EQ(hardware.sent[0].text, "GOLD Finder7");
}

TEST(GoldSearch, IsCopiedWithItsMovement) {
  FakeHardware hardware;
  Robot robot(hardware);
  const GoldSearch search(std::make_unique<Ahead>());
  const auto copy = search.clone();
  copy->step(robot);
  EXPECT_EQ(hardware.lastCommand().speed_mps, 0.5);
}

}  // namespace
}  // namespace robosim
