#include "rendering/plan_view.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

TEST(PlanView, IsToScaleAndTwelveHundredPixelsLong) {
  const PlanView view({0, 10, 0, 5});
  EXPECT_EQ(view.width(), 1200);
  EXPECT_EQ(view.height(), 676);                   // 5 m and the margins of 44 + 56
  EXPECT_DOUBLE_EQ(view.pixelsPerMetre(), 115.2);  // 1200 without two margins of 24, over 10 m
}

TEST(PlanView, HasXToTheRightAndYUp) {
  const PlanView view({-5, 5, 0, 5});
  const auto upper_left = view.toPixel({-5, 5}), lower_right = view.toPixel({5, 0});
  EXPECT_NEAR(upper_left.x, 24 - 0.5, 1e-9);
  EXPECT_NEAR(upper_left.y, 44 - 0.5, 0.5);  // the height is rounded to whole pixels
  EXPECT_NEAR(lower_right.x, 1200 - 24 - 0.5, 1e-9);
  EXPECT_NEAR(lower_right.y, 676 - 56 - 0.5, 0.5);
}

TEST(PlanView, IsTwelveHundredPixelsHighForATallWorld) {
  const PlanView view({0, 10, 0, 20});
  EXPECT_EQ(view.height(), 1200);
  EXPECT_DOUBLE_EQ(view.pixelsPerMetre(), 55);
  EXPECT_EQ(view.width(), 598);
}

TEST(PlanView, CentresANarrowWorldAboveTheLegend) {
  const PlanView view({0, 1, 0, 100});
  EXPECT_EQ(view.width(), kPlanLayout.short_side_min_px);
  EXPECT_NEAR(view.toPixel({0.5, 0}).x, view.width() / 2.0 - 0.5, 1e-9);
}

TEST(PlanView, ShowsAWorldWithoutExtent) {
  for (const Bounds2D& area : {Bounds2D{3, 3, 4, 4}, Bounds2D{0, 7, 4, 4}}) {
    const PlanView view(area);
    const auto pixel = view.toPixel({area.x_max, area.y_max});
    EXPECT_TRUE(pixel.x >= 0 && pixel.x < view.width() && pixel.y >= 0 && pixel.y < view.height()) << pixel;
  }
}

TEST(PlanView, RoundsLengthsDownToOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(roundLengthUpTo(1), 1);
  EXPECT_DOUBLE_EQ(roundLengthUpTo(4.99), 2);
  EXPECT_DOUBLE_EQ(roundLengthUpTo(73), 50);
  EXPECT_DOUBLE_EQ(roundLengthUpTo(0.19), 0.1);
}

}  // namespace
}  // namespace robosim
