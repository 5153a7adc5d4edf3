#include "maze/region_market.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using Act = MarketMessage::Act;

/// Robot 1, whose regions have 4 m and map cells 0.1 m; a lease takes 100 steps.
RegionMarket market() { return RegionMarket({.region_m = 4, .cell_m = 0.1, .robot = 1, .lease = 100}); }

TEST(MarketMessage, RoundTrips) {
  EXPECT_EQ((MarketMessage{Act::auction, {3, -1}, 250}.text()), "AUCTION 3 -1 250");
  EXPECT_EQ((MarketMessage{Act::bid, {3, -1}, 240}.text()), "BID 3 -1 240");
  EXPECT_EQ((MarketMessage{Act::sold, {3, -1}, 240, 7}.text()), "SOLD 3 -1 240 7");
  const auto sold = MarketMessage::parse("SOLD 3 -1 240 7");
  ASSERT_TRUE(sold);
  EXPECT_EQ(sold->act, Act::sold);
  EXPECT_EQ(sold->region, (Cell{3, -1}));
  EXPECT_EQ(sold->price_cm, 240);
  EXPECT_EQ(sold->robot, 7);
  EXPECT_EQ(MarketMessage::parse("BID 1 2 3")->act, Act::bid);
  for (const char* text : {"", "BID", "BID 1 2", "SOLD 1 2 3", "AUCTION 1 2 3 4", "BID 1 2 x"}) {
    EXPECT_FALSE(MarketMessage::parse(text)) << text;
  }
}

TEST(RegionMarket, SellsToTheLowestBid) {
  RegionMarket regions = market();
  regions.setStep(10);
  EXPECT_EQ(regions.auction({0, 0}, 500).price_cm, 500);
  regions.bid({0, 0}, 400, 2);
  regions.bid({0, 0}, 450, 3);
  regions.bid({5, 5}, 1, 4);  // another region
  regions.setStep(12);
  EXPECT_FALSE(regions.sale());
  regions.setStep(13);
  const auto sale = regions.sale();
  ASSERT_TRUE(sale);
  EXPECT_EQ(sale->text(), "SOLD 0 0 400 2");
  EXPECT_EQ(regions.ownerOf({0, 0}), 2);
  EXPECT_FALSE(regions.isAuctioning());
}

TEST(RegionMarket, KeepsARegionForWhichNoneBidsLess) {
  RegionMarket regions = market();
  regions.auction({0, 0}, 500);
  regions.bid({0, 0}, 500, 2);
  regions.setStep(3);
  EXPECT_EQ(regions.sale()->robot, 1);
}

TEST(RegionMarket, RegionsAreFreeAfterTheLease) {
  RegionMarket regions = market();
  regions.sold({0, 0}, 10, 3);
  regions.setStep(99);
  EXPECT_EQ(regions.ownerOf({0, 0}), 3);
  regions.setStep(100);
  EXPECT_EQ(regions.ownerOf({0, 0}), -1);
}

TEST(RegionMarket, OfTwoSalesOfARegionTheLowerPriceCounts) {
  RegionMarket regions = market();
  regions.sold({0, 0}, 300, 2);
  regions.sold({0, 0}, 200, 3);
  regions.sold({0, 0}, 250, 4);
  EXPECT_EQ(regions.ownerOf({0, 0}), 3);
  regions.sold({0, 0}, 200, 1);
  EXPECT_EQ(regions.ownerOf({0, 0}), 1) << "of equal prices the first robot";
}

TEST(RegionMarket, PrefersOwnRegionsToFreeOnesAndThoseToOthers) {
  RegionMarket regions = market();
  regions.sold({0, 0}, 10, 1);
  regions.sold({1, 0}, 10, 2);
  EXPECT_EQ(regions.computeCost({39, 0}), 0);
  EXPECT_EQ(regions.computeCost({40, 0}), 600) << "30 m in cells of 0.1 m, 2 each";
  EXPECT_EQ(regions.computeCost({80, 0}), 40) << "2 m";
}

}  // namespace
}  // namespace robosim
