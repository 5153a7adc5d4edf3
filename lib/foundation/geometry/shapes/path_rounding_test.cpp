// Contacts far from the world's origin, where coordinates have fewer decimals: at 5,000 km (UTM northings) neighbouring
// doubles are 0.9 nm apart.
#include <cmath>

#include <gtest/gtest.h>

#include "base/angle_units.h"
#include "geometry/shapes/path.h"

namespace robosim {
namespace {

using mrpt::math::TPoint2D;

constexpr double kRadius_m = 0.25;
constexpr double kStep_m = 0.05;
constexpr double kOriginOffsets_m[] = {0, 1e3, 1e5, 5e6};

class PathFarFromTheOrigin : public testing::TestWithParam<double> {};

/// A wall of 40 m with a given direction, and a disc that touches the middle of its left side.
struct WallAndDisc {
  WallAndDisc(double offset_m, double direction_rad)
      : wall(OrientedBox::from({offset_m, offset_m / 3, direction_rad}, 40, 0.2)),
        out(-std::sin(direction_rad), std::cos(direction_rad)),
        pose{offset_m + out.x * (0.1 + kRadius_m + kContactGap_m),
             offset_m / 3 + out.y * (0.1 + kRadius_m + kContactGap_m), direction_rad} {}

  OrientedBox wall;
  TPoint2D out;
  mrpt::math::TPose2D pose;
};

TEST_P(PathFarFromTheOrigin, SlidesAlongAnObliqueWallWithoutAStall) {
  for (int degrees = 0; degrees < 360; degrees += 7) {
    WallAndDisc scene(GetParam(), toRadians(degrees));
    for (int step = 0; step < 100; ++step) {
      const Path path{scene.pose, step % 2 == 0 ? kStep_m : -kStep_m, 0};
      ASSERT_EQ(firstContact(path, kRadius_m, scene.wall), 1) << degrees << " degrees, step " << step;
      scene.pose = path.endPose();
    }
    EXPECT_NEAR(distance(scene.wall, TPoint2D(scene.pose.x, scene.pose.y)) - kRadius_m, kContactGap_m, 2e-7);
  }
}

TEST_P(PathFarFromTheOrigin, SlidesPastARoundPillarWithoutAStall) {
  for (int degrees = 0; degrees < 360; degrees += 7) {
    const double direction_rad = toRadians(degrees);
    const TPoint2D out(-std::sin(direction_rad), std::cos(direction_rad));
    const double reach_m = 1 + kRadius_m + kContactGap_m;
    const Circle pillar{{GetParam(), GetParam() / 3}, 1};
    const mrpt::math::TPose2D pose{pillar.center.x + out.x * reach_m, pillar.center.y + out.y * reach_m, direction_rad};
    EXPECT_EQ(firstContact({pose, kStep_m, 0}, kRadius_m, pillar), 1) << degrees << " degrees";
    EXPECT_EQ(firstContact({pose, -kStep_m, 0}, kRadius_m, pillar), 1) << degrees << " degrees, backwards";
  }
}

TEST_P(PathFarFromTheOrigin, StopsATouchingDiscThatTurnsTowardsTheWall) {
  for (int degrees = 0; degrees < 360; degrees += 7) {
    WallAndDisc scene(GetParam(), toRadians(degrees));
    scene.pose.phi -= 0.01;  // approaches by 0.5 mm a step
    for (int step = 0; step < 100; ++step) {
      Path path{scene.pose, kStep_m, 0};
      path.end_fraction = firstContact(path, kRadius_m, scene.wall);
      scene.pose = path.endPose();
    }
    EXPECT_NEAR(distance(scene.wall, TPoint2D(scene.pose.x, scene.pose.y)) - kRadius_m, kContactGap_m, 1e-8)
        << degrees << " degrees";
  }
}

TEST_P(PathFarFromTheOrigin, SlidesAlongTheEdgeOfTheAreaWithoutAStall) {
  const double at_m = GetParam();
  const Bounds2D area{at_m - 100, at_m + 100, at_m - 100, at_m + 100};
  mrpt::math::TPose2D pose{area.x_max - kRadius_m - kContactGap_m, at_m, M_PI / 2};
  for (int step = 0; step < 100; ++step) {
    const Path path{pose, kStep_m, 0};
    ASSERT_EQ(firstExit(path, kRadius_m, area), 1) << "step " << step;
    pose = path.endPose();
  }
}

TEST_P(PathFarFromTheOrigin, LetsTwoTouchingDiscsDriveSideBySide) {
  for (int degrees = 0; degrees < 360; degrees += 7) {
    const double direction_rad = toRadians(degrees);
    const double apart_m = 2 * kRadius_m + kContactGap_m;
    mrpt::math::TPose2D a{GetParam(), GetParam() / 3, direction_rad};
    mrpt::math::TPose2D b{a.x - std::sin(direction_rad) * apart_m, a.y + std::cos(direction_rad) * apart_m,
                          direction_rad};
    for (int step = 0; step < 100; ++step) {
      const Path of_a{a, kStep_m, 0};
      const Path of_b{b, kStep_m, 0};
      ASSERT_FALSE(collide(of_a, kRadius_m, of_b, kRadius_m)) << degrees << " degrees, step " << step;
      a = of_a.endPose();
      b = of_b.endPose();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Offsets, PathFarFromTheOrigin, testing::ValuesIn(kOriginOffsets_m),
                         [](const auto& test) { return "m" + std::to_string(static_cast<long>(test.param)); });

// A disc that touches a box, at the distance of a clipped move or slightly nearer because of rounding.

TEST(PathTouchingABox, IsFreeToLeaveAndToSlideFromExactlyAtTheContact) {
  const OrientedBox wall = OrientedBox::from({0, 0, 0}, 2, 1);
  const double contact = 1 + kRadius_m + kContactGap_m;
  for (const double x : {std::nextafter(contact, 0.), contact, std::nextafter(contact, 9.)}) {
    for (int degrees = -90; degrees <= 90; degrees += 5) {
      const Path path{{x, 0.2, toRadians(degrees)}, 0.05, 0};
      EXPECT_EQ(firstContact(path, kRadius_m, wall), 1) << "leaving at " << degrees << " degrees from " << x;
    }
    for (int degrees = 95; degrees <= 265; degrees += 5) {
      const Path path{{x, 0.2, toRadians(degrees)}, 0.05, 0};
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
