#include "maze/heat_trace.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr double kRange_m = 1.5, kRadius_m = 0.25;

struct HeatTraceTest : testing::Test {
  HeatTraceTest() { map.cover({-60, -60}, {60, 60}); }
  /// Measures by the linear law along a straight path.
  void measureAlong(const TPoint2D& from, const TPoint2D& to, const TPoint2D& source, double temperature) {
    for (int i = 0; i <= 20; ++i) {
      const TPoint2D at = from + (to - from) * (i / 20.0);
      trace.measure(at, temperature * std::max(0.0, 1 - (at - source).norm() / kRange_m));
    }
  }

  MazeMap map{0.15};
  HeatTrace trace{map, kRange_m, kRadius_m};
};

TEST_F(HeatTraceTest, HasNoSourceWithoutHeat) {
  measureAlong({-2, 0}, {2, 0}, {0, 9}, 20);
  EXPECT_FALSE(trace.source());
}

TEST_F(HeatTraceTest, EstimatesTheSourceAndItsTemperature) {
  const TPoint2D source(0.6, 0.75);
  measureAlong({-2, 0}, {1, 0}, source, 20);
  measureAlong({1, 0}, {1, 1.2}, source, 20);  // around a corner: a straight path alone leaves the side undetermined
  const auto found = trace.source();
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->place.x, source.x, 0.15);
  EXPECT_NEAR(found->place.y, source.y, 0.15);
  EXPECT_NEAR(found->temperature, 20, 2);
}

TEST_F(HeatTraceTest, EstimatesTheSourceFromNoisyMeasurements) {
  Rng rng(3);
  const TPoint2D source(-0.5, 0.4);
  for (int i = 0; i < 60; ++i) {
    const TPoint2D at(rng.uniform(-1.5, 1.5), rng.uniform(-1.5, 1.5));
    trace.measure(at, 20 * std::max(0.0, 1 - (at - source).norm() / kRange_m) + 0.5 * rng.gaussian());
  }
  const auto found = trace.source();
  ASSERT_TRUE(found);
  EXPECT_LT((found->place - source).norm(), 0.25);
}

TEST_F(HeatTraceTest, EstimatesASourceOfTheInverseLaw) {
  Rng rng(4);
  const TPoint2D source(-0.5, 0.4);
  for (int i = 0; i < 60; ++i) {
    const TPoint2D at(rng.uniform(-1.5, 1.5), rng.uniform(-1.5, 1.5));
    const double away = std::max(0.45, (at - source).norm());  // the bodies of robot and gold keep them apart
    trace.measure(at, away < kRange_m ? 3 / away : 0);
  }
  const auto found = trace.source();
  ASSERT_TRUE(found);
  EXPECT_LT((found->place - source).norm(), 0.4);
}

TEST_F(HeatTraceTest, MarksSearchedCells) {
  trace.measure({0.07, 0.07}, 0);
  // 1.5 m − 2.5 robot radii = 0.875 m.
  EXPECT_TRUE(map[map.cellAt({0.8, 0.07})].searched);
  EXPECT_FALSE(map[map.cellAt({1.05, 0.07})].searched);
  EXPECT_TRUE(map[map.cellAt({0.2, 0.2})].stood);
  EXPECT_FALSE(map[map.cellAt({0.4, 0.07})].stood);
}

TEST_F(HeatTraceTest, IgnoresASecondMeasurementAtTheSamePlace) {
  EXPECT_TRUE(trace.measure({0, 0}, 0));
  EXPECT_FALSE(trace.measure({0.1, 0}, 0));
  EXPECT_TRUE(trace.measure({0.2, 0}, 0));
  trace.reset();
  EXPECT_TRUE(trace.measure({0.2, 0}, 0));
}

TEST_F(HeatTraceTest, ForgetsAHotterSourceWithAReset) {
  const TPoint2D hot(-3, 0.3), warm(3, 0.3);
  measureAlong({-4, 0}, {-2, 0}, hot, 20);
  ASSERT_TRUE(trace.source());
  map.reset();
  trace.reset();
  EXPECT_FALSE(trace.source());
  measureAlong({2, 0}, {3, 0}, warm, 9);
  ASSERT_TRUE(trace.source());
  EXPECT_LT((trace.source()->place - warm).norm(), 0.8);
}

TEST_F(HeatTraceTest, EstimatesTheNextSourceAfterSearchFromHere) {
  const TPoint2D hot(-3, 0.3), warm(3, 0.3);
  measureAlong({-4, 0}, {-2, 0}, hot, 20);
  measureAlong({2, 0}, {3, 0}, warm, 9);
  ASSERT_TRUE(trace.source());
  EXPECT_LT((trace.source()->place - hot).norm(), 0.8);
  trace.searchFromHere();
  ASSERT_TRUE(trace.source());
  EXPECT_LT((trace.source()->place - warm).norm(), 0.8);
}

}  // namespace
}  // namespace robosim
