// A disc that drives towards the edge of an area from inside.
#include <gtest/gtest.h>

#include "geometry/shapes/path.h"
#include "geometry/testing/slow_path.h"

namespace robosim {
namespace {

constexpr Bounds2D kArea{-2, 3, -1, 4};

TEST(FirstExit, StopsTheBoundaryAMicrometreBeforeTheEdge) {
  // With radius 0.5 the centre can reach x = 2.5, y = 3.5, x = -1.5 and y = -0.5, less the gap.
  EXPECT_NEAR(firstExit({{0, 0, 0}, 10, 0}, 0.5, kArea) * 10, 2.5 - kContactGap_m, 1e-12);
  EXPECT_NEAR(firstExit({{0, 0, M_PI / 2}, 10, 0}, 0.5, kArea) * 10, 3.5 - kContactGap_m, 1e-12);
  EXPECT_NEAR(firstExit({{0, 0, 0}, -10, 0}, 0.5, kArea) * 10, 1.5 - kContactGap_m, 1e-12);
  EXPECT_NEAR(firstExit({{0, 0, -M_PI / 2}, 10, 0}, 0.5, kArea) * 10, 0.5 - kContactGap_m, 1e-12);
  EXPECT_EQ(firstExit({{0, 0, 0}, 2.4, 0}, 0.5, kArea), 1) << "too short to reach it";
  EXPECT_EQ(firstExit({{0, 0, 0}, 0, 3}, 0.5, kArea), 1) << "turning on the spot";
  Path path{{0, 0, 0}, 10, 0};
  path.end_fraction = 0.2;
  EXPECT_EQ(firstExit(path, 0.5, kArea), 1) << "no farther than the path's end";
}

TEST(FirstExit, LetsADiscAtOrBeyondTheEdgeOnlyReturnOrSlide) {
  for (double x : {2.5 - kContactGap_m, 2.5, 2.9, 7.0}) {
    EXPECT_EQ(firstExit({{x, 0, M_PI}, 0.5, 0}, 0.5, kArea), 1) << x;
    EXPECT_EQ(firstExit({{x, 0, M_PI / 2}, 0.5, 0}, 0.5, kArea), 1) << x;
    EXPECT_NEAR(firstExit({{x, 0, 0}, 0.5, 0}, 0.5, kArea), 0, 1e-12) << x;
    EXPECT_NEAR(firstExit({{x, 0, 0.1}, 0.5, 0}, 0.5, kArea), 0, 1e-12) << x;
  }
}

TEST(FirstExit, AgreesWithASlowSearchOverRandomPaths) {
  Rng rng(1);
  int exits = 0;
  for (int i = 0; i < 20000; ++i) {
    Path path = randomPath(rng, kArea);
    if (i % 4 == 0) path.end_fraction = rng.uniform();
    const double radius = rng.uniform(0.01, 1);
    if (excessBeyond(kArea, path, radius, 0) > -1e-9L) continue;
    const double fast = firstExit(path, radius, kArea);
    const Real slow = slowFirstExit(path, radius, kArea).value_or(1);
    ASSERT_LT(std::abs(fast - slow) * std::abs(path.length_m), 1e-9L) << "case " << i;
    exits += fast < 1;
  }
  EXPECT_GT(exits, 1000);
}

}  // namespace
}  // namespace robosim
