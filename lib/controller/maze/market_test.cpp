#include "maze/market.h"

#include <gtest/gtest.h>

#include "maze/testing/fake_maze.h"

namespace robosim {
namespace {

const mrpt::math::TPose2D kMarketStart(2, 2, 0);  // in the middle of region (0, 0)

struct MarketTest : testing::Test {
  MarketTest() { hardware.robot_names = {"fake", "other", "third"}; }
  void step(std::vector<RobotMessage> inbox = {}) {
    hardware.sent.clear();
    hardware.mutableReadings().inbox = std::move(inbox);
    market.step(robot);
    hardware.advance();
  }
  std::vector<std::string> deals() const {
    std::vector<std::string> texts;
    for (const auto& message : hardware.sent) {
      if (MarketMessage::parse(message.text)) texts.push_back(message.to + ": " + message.text);
    }
    return texts;
  }
  FakeHardware hardware;
  Robot robot{hardware};
  Market market{{.seed = 1, .world_from_start = kMarketStart}};
};

TEST_F(MarketTest, AuctionsTheRegionOfItsNextFrontier) {
  step();
  const auto offers = deals();
  ASSERT_EQ(offers.size(), 2u) << "to both others";
  const auto offer = MarketMessage::parse(offers[0].substr(offers[0].find(' ') + 1));
  ASSERT_TRUE(offer);
  EXPECT_EQ(offer->act, MarketMessage::Act::auction);
  // The price is the distance to the centre of the region, whose coordinates are multiples of 4 m plus 2 m.
  const double x = 4.0 * offer->region.x + 2 - 2, y = 4.0 * offer->region.y + 2 - 2;
  EXPECT_EQ(offer->price_cm, std::llround(100 * std::hypot(x, y)));
}

TEST_F(MarketTest, SellsToABidderAfterThreeSteps) {
  step();
  const auto offer = MarketMessage::parse(deals().at(0).substr(7));
  ASSERT_TRUE(offer);
  step();
  const MarketMessage bid{MarketMessage::Act::bid, offer->region, offer->price_cm - 1};
  step({{"third", "fake", bid.text()}});
  step();
  MarketMessage sale = bid;
  sale.act = MarketMessage::Act::sold;
  sale.robot = 2;
  EXPECT_EQ(deals().at(0), "other: " + sale.text());
  EXPECT_EQ(deals().at(1), "third: " + sale.text());
}

TEST_F(MarketTest, BidsForARegionThatItReachesAtLowerCost) {
  step();
  // Region (10, 0): centre (42, 2), 40 m from here; the detour to the present goal is shorter than 20 m.
  step({{"other", "fake", "AUCTION 10 0 9000"}});
  ASSERT_EQ(deals().size(), 1u);
  const auto bid = MarketMessage::parse(deals()[0].substr(7));
  EXPECT_EQ(bid->act, MarketMessage::Act::bid);
  EXPECT_GE(bid->price_cm, 3999);
  EXPECT_LT(bid->price_cm, 6000);
  step({{"other", "fake", "AUCTION 10 0 3900"}});
  EXPECT_TRUE(deals().empty());
}

TEST_F(MarketTest, LeavesRegionsOfOthersToThem) {
  // All regions around are sold to the robot `other` but those to the left.
  std::vector<RobotMessage> sales;
  for (int y = -2; y <= 2; ++y) {
    for (int x = 0; x <= 2; ++x) {
      sales.push_back({"other", "fake", MarketMessage{MarketMessage::Act::sold, {x, y}, 1, 1}.text()});
    }
  }
  step(sales);
  const auto offer = MarketMessage::parse(deals().at(0).substr(7));
  ASSERT_TRUE(offer);
  EXPECT_LT(offer->region.x, 0);
}

TEST(Market, WithoutItsStartSendsNothing) {
  FakeHardware hardware;
  hardware.robot_names = {"fake", "other"};
  Robot robot(hardware);
  Market market({.seed = 1});
  for (int i = 0; i < 30; ++i) {
    market.step(robot);
    hardware.advance();
  }
  EXPECT_TRUE(hardware.sent.empty());
  EXPECT_NE(hardware.odometry().odom_from_robot, mrpt::math::TPose2D());
}

TEST(Market, FindsTheGold) {
  auto walls = FakeMaze::room(-1, 6, -1, 4);
  walls.push_back(FakeMaze::box(2.5, 0.85, 0.1, 3.7));
  FakeMaze maze(walls, {5.3, -0.4}, 20);
  Robot robot(maze.hardware);
  Market market({.seed = 3, .world_from_start = kMarketStart});
  for (int i = 0; i < 1500 && robot.activity() == Activity::active; ++i) {
    market.step(robot);
    maze.hardware.advance();
  }
  EXPECT_EQ(robot.activity(), Activity::found);
}

}  // namespace
}  // namespace robosim
