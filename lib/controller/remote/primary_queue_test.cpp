#include <gtest/gtest.h>

#include "remote/remote_control.h"

namespace robosim {
namespace {

using Order = std::vector<std::size_t>;

bool any(std::size_t) { return true; }

TEST(PrimaryQueue, StartsWithThePrimaryThenTheListsOrder) {
  EXPECT_EQ(PrimaryQueue(4, 2).order(), (Order{2, 0, 1, 3}));
  EXPECT_EQ(PrimaryQueue(4, 2).primary(), 2u);
}

TEST(PrimaryQueue, ASwitchMovesTheOldPrimaryToTheTail) {
  PrimaryQueue primaries(3, 0);
  for (const Order& order : {Order{1, 2, 0}, Order{2, 0, 1}, Order{0, 1, 2}}) {
    primaries.switchTo(*primaries.next(any));
    EXPECT_EQ(primaries.order(), order);
  }
}

TEST(PrimaryQueue, SkipsUnfitRobotsAndKeepsTheirPositions) {
  PrimaryQueue primaries(4, 0);
  const auto all_but_1 = [](std::size_t robot) { return robot != 1; };
  primaries.switchTo(*primaries.next(all_but_1));
  EXPECT_EQ(primaries.order(), (Order{2, 1, 3, 0}));
  primaries.switchTo(*primaries.next(any));
  EXPECT_EQ(primaries.order(), (Order{1, 3, 0, 2}));
}

TEST(PrimaryQueue, HasNoNextWithoutAnotherFitRobot) {
  EXPECT_EQ(PrimaryQueue(1, 0).next(any), std::nullopt);
  EXPECT_EQ(PrimaryQueue(3, 0).next([](std::size_t robot) { return robot == 0; }), std::nullopt);
}

TEST(PrimaryQueue, SwitchesToASelectedRobot) {
  PrimaryQueue primaries(4, 0);
  primaries.switchTo(3);
  EXPECT_EQ(primaries.order(), (Order{3, 1, 2, 0}));
  primaries.switchTo(3);
  EXPECT_EQ(primaries.order(), (Order{3, 1, 2, 0})) << "it is primary already";
}

}  // namespace
}  // namespace robosim
