#include "base/wrapped_angle.h"

#include <bit>
#include <cstdint>

#include <gtest/gtest.h>

#include "base/random.h"

namespace robosim {
namespace {

std::uint64_t bitsOf(double number) { return std::bit_cast<std::uint64_t>(number); }

TEST(WrappedAngle, HasTheBitsOfMrptsFunction) {
  Rng rng(1);
  for (int i = 0; i < 10000; ++i) {
    const double angle_rad = rng.uniform(-10, 10);
    ASSERT_EQ(bitsOf(wrappedAngle(angle_rad)), bitsOf(mrpt::math::wrapToPi(angle_rad))) << angle_rad;
  }
  for (const double angle_rad : {0.0, -0.0, M_PI, -M_PI, 2 * M_PI, -2 * M_PI, 3 * M_PI}) {
    EXPECT_EQ(bitsOf(wrappedAngle(angle_rad)), bitsOf(mrpt::math::wrapToPi(angle_rad))) << angle_rad;
  }
}

}  // namespace
}  // namespace robosim
