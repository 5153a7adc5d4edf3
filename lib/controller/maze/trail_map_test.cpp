#include "maze/trail_map.h"

#include <cmath>

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(TrailMap, AddsVisitsThatEvaporate) {
  TrailMap trails(1, 10, 0.1);  // decays to 1/e in 100 steps
  EXPECT_EQ(trails.amount({0, 0}, 0), 0);
  trails.visit({0, 0}, 0);
  EXPECT_EQ(trails.amount({0, 0}, 0), 1);
  EXPECT_NEAR(trails.amount({0, 0}, 100), std::exp(-1), 1e-12);
  trails.visit({0, 0}, 100);
  EXPECT_NEAR(trails.amount({0, 0}, 200), std::exp(-1) + std::exp(-2), 1e-12);
  EXPECT_EQ(trails.amount({1, 0}, 200), 0);
}

TEST(TrailMap, DividesThePlaneIntoSquares) {
  const TrailMap trails(0.5, 10, 0.1);
  EXPECT_EQ(trails.cellAt({0.9, -0.1}), (Cell{1, -1}));
}

TEST(TrailMessage, RoundTrips) {
  EXPECT_EQ((TrailMessage{{3, -4}}.text()), "TRAIL 3 -4");
  EXPECT_EQ(TrailMessage::parse("TRAIL 3 -4")->cell, (Cell{3, -4}));
  for (const char* text :
       {"", "TRAIL", "TRAIL 3", "TRAIL 3 4 5", "TRAIL 3 x", "TRAIL 3  4", "TRAIL 3 9999999999", "T 3 4"}) {
    EXPECT_FALSE(TrailMessage::parse(text)) << text;
  }
}

}  // namespace
}  // namespace robosim
