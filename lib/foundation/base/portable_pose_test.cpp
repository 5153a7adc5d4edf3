#include "base/portable_pose.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.h"

namespace robosim::portable {
namespace {

using mrpt::math::TPoint2D;
using mrpt::math::TPose2D;

TEST(PortablePose, ComposesAPoseTurnedByAQuarter) {
  // From (1, 2) facing +y: 3 ahead is (1, 5), 1 to the left is (0, 5).
  const TPose2D a_from_c = compose(TPose2D(1, 2, std::numbers::pi / 2), TPose2D(3, 1, std::numbers::pi));
  EXPECT_NEAR(a_from_c.x, 0, 1e-15);
  EXPECT_NEAR(a_from_c.y, 5, 1e-15);
  EXPECT_NEAR(a_from_c.phi, -std::numbers::pi / 2, 1e-15);
  const TPoint2D point = compose(TPose2D(1, 2, std::numbers::pi / 2), TPoint2D(3, 1));
  EXPECT_EQ(point.x, a_from_c.x);
  EXPECT_EQ(point.y, a_from_c.y);
}

TEST(PortablePose, RelativeUndoesCompose) {
  const TPose2D b_from_c = relative(TPose2D(1, 2, std::numbers::pi / 2), TPose2D(0, 5, -std::numbers::pi / 2));
  EXPECT_NEAR(b_from_c.x, 3, 1e-15);
  EXPECT_NEAR(b_from_c.y, 1, 1e-15);
  EXPECT_NEAR(std::abs(b_from_c.phi), std::numbers::pi, 1e-15);
  const TPose2D b_from_a = inverse(TPose2D(1, 2, std::numbers::pi / 2));
  EXPECT_NEAR(b_from_a.x, -2, 1e-15);
  EXPECT_NEAR(b_from_a.y, 1, 1e-15);
  EXPECT_NEAR(b_from_a.phi, -std::numbers::pi / 2, 1e-15);
}

TEST(PortablePose, AgreesWithMrptsOperators) {
  Rng rng(1);
  for (int i = 0; i < 10000; ++i) {
    const TPose2D a(rng.uniform(-100, 100), rng.uniform(-100, 100), rng.uniform(-4, 4));
    const TPose2D b(rng.uniform(-100, 100), rng.uniform(-100, 100), rng.uniform(-4, 4));
    const TPose2D sum = compose(a, b), mrpt_sum = a + b;
    const TPose2D difference = relative(a, b), mrpt_difference = b - a;
    ASSERT_NEAR(sum.x, mrpt_sum.x, 1e-12);
    ASSERT_NEAR(sum.y, mrpt_sum.y, 1e-12);
    ASSERT_NEAR(std::remainder(sum.phi - mrpt_sum.phi, 2 * std::numbers::pi), 0, 1e-12);
    ASSERT_NEAR(difference.x, mrpt_difference.x, 1e-12);
    ASSERT_NEAR(difference.y, mrpt_difference.y, 1e-12);
    ASSERT_NEAR(std::remainder(difference.phi - mrpt_difference.phi, 2 * std::numbers::pi), 0, 1e-12);
  }
}

}  // namespace
}  // namespace robosim::portable
