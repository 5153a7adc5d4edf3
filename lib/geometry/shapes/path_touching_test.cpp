// A disc that touches a box, at the distance of a clipped move or slightly nearer because of rounding.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "geometry/shapes/path.h"

namespace robosim {
namespace {

constexpr double kRadius_m = 0.25;

TEST(PathTouchingABox, IsFreeToLeaveAndToSlideFromExactlyAtTheContact) {
  const OrientedBox wall = OrientedBox::from({0, 0, 0}, 2, 1);
  const double contact = 1 + kRadius_m + kContactGap_m;
  for (const double x : {std::nextafter(contact, 0.), contact, std::nextafter(contact, 9.)}) {
    for (int degrees = -90; degrees <= 90; degrees += 5) {
      const Path path{{x, 0.2, degrees * M_PI / 180}, 0.05, 0};
      EXPECT_EQ(firstContact(path, kRadius_m, wall), 1) << "leaving at " << degrees << " degrees from " << x;
    }
    for (int degrees = 95; degrees <= 265; degrees += 5) {
      const Path path{{x, 0.2, degrees * M_PI / 180}, 0.05, 0};
      EXPECT_NEAR(firstContact(path, kRadius_m, wall), 0, 1e-12) << "approaching at " << degrees << " degrees";
    }
  }
}

TEST(PathTouchingABox, IsFreeToLeaveFromTheEndOfAnyClippedMove) {
  const OrientedBox wall = OrientedBox::from({0.1, -0.3, 0.7}, 1.3, 0.1);
  for (int i = 0; i < 2000; ++i) {
    const double direction = i * 0.1;
    const mrpt::math::TPose2D outside{0.1 - 2 * std::cos(direction), -0.3 - 2 * std::sin(direction), direction};
    Path towards{outside, 2, 0};
    towards.end_fraction = firstContact(towards, kRadius_m, wall);
    ASSERT_LT(towards.end_fraction, 1);
    mrpt::math::TPose2D touching = towards.endPose();
    touching.phi += M_PI;
    EXPECT_EQ(firstContact({touching, 0.05, 0}, kRadius_m, wall), 1) << "turned back from direction " << direction;
  }
}

}  // namespace
}  // namespace robosim
