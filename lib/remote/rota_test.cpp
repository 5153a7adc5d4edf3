#include "remote/rota.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using Row = std::vector<std::size_t>;

bool any(std::size_t) { return true; }

TEST(Rota, BeginsWithThePrimaryAndThenTheListsOrder) {
  EXPECT_EQ(Rota(4, 2).row(), (Row{2, 0, 1, 3}));
  EXPECT_EQ(Rota(4, 2).primary(), 2u);
}

TEST(Rota, OnASwitchTheOldPrimaryGoesToTheTailAndTheHeadOfTheOthersIsPrimary) {
  Rota rota(3, 0);
  for (const Row& row : {Row{1, 2, 0}, Row{2, 0, 1}, Row{0, 1, 2}}) {
    rota.switchTo(*rota.next(any));
    EXPECT_EQ(rota.row(), row);
  }
}

TEST(Rota, PassesOverThoseThatAreNotFitAndKeepsTheirPlaces) {
  Rota rota(4, 0);
  const auto all_but_1 = [](std::size_t robot) { return robot != 1; };
  rota.switchTo(*rota.next(all_but_1));
  EXPECT_EQ(rota.row(), (Row{2, 1, 3, 0}));
  rota.switchTo(*rota.next(any));
  EXPECT_EQ(rota.row(), (Row{1, 3, 0, 2}));
}

TEST(Rota, HasNoNextWhenNoOtherIsFit) {
  EXPECT_EQ(Rota(1, 0).next(any), std::nullopt);
  EXPECT_EQ(Rota(3, 0).next([](std::size_t robot) { return robot == 0; }), std::nullopt);
}

TEST(Rota, SwitchesToARobotOfOnesChoice) {
  Rota rota(4, 0);
  rota.switchTo(3);
  EXPECT_EQ(rota.row(), (Row{3, 1, 2, 0}));
  rota.switchTo(3);
  EXPECT_EQ(rota.row(), (Row{3, 1, 2, 0})) << "it is primary already";
}

}  // namespace
}  // namespace robosim
