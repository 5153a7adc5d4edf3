#include "hardware/lens_distortion.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(LensDistortion, MovesPointsByItsCoefficients) {
  // r² = 0.5: radial 1 + 0.2 · 0.5 + 0.4 · 0.25 = 1.2.
  const auto radial = LensDistortion{.k1 = 0.2, .k2 = 0.4}.distort({0.5, 0.5});
  EXPECT_NEAR(radial.x, 0.6, 1e-12);
  EXPECT_NEAR(radial.y, 0.6, 1e-12);
  // x: 2 · 0.1 · 0.25 + 0.2 · (0.5 + 0.5) = 0.25; y: 0.1 · (0.5 + 0.5) + 2 · 0.2 · 0.25 = 0.2.
  const auto tangential = LensDistortion{.p1 = 0.1, .p2 = 0.2}.distort({0.5, 0.5});
  EXPECT_NEAR(tangential.x, 0.75, 1e-12);
  EXPECT_NEAR(tangential.y, 0.7, 1e-12);
  EXPECT_NEAR((LensDistortion{.k3 = 1}.distort({1, 0}).x), 2, 1e-12);
}

TEST(LensDistortion, IsInverted) {
  const LensDistortion lens{.k1 = -0.25, .k2 = 0.05, .p1 = 0.001, .p2 = -0.002, .k3 = 0.01};
  for (double x = -0.6; x <= 0.6; x += 0.2) {
    for (double y = -0.5; y <= 0.5; y += 0.25) {
      LensDistortion::Point ideal;
      ASSERT_TRUE(lens.undistort({x, y}, ideal));
      EXPECT_NEAR(lens.distort(ideal).x, x, 1e-8);
      EXPECT_NEAR(lens.distort(ideal).y, y, 1e-8);
    }
  }
}

TEST(LensDistortion, HasNoInverseBeyondItsLargestRadius) {
  // r · (1 - r²/2) is at most 0.544, at r = 0.816.
  LensDistortion::Point ideal;
  EXPECT_FALSE((LensDistortion{.k1 = -0.5}.undistort({0.6, 0}, ideal)));
}

}  // namespace
}  // namespace robosim
