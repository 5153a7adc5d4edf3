#include "base/portable_math.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/vector_width.h"

namespace robosim::portable {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kPi = 3.14159265358979323846;

/// The difference from a reference of more digits, in units of the last place of a double of its size.
double ulps(double value, long double reference) {
  const int exponent = std::ilogb(static_cast<double>(reference));
  const long double ulp = std::ldexp(1.0L, std::max(exponent - 52, -1074));
  return static_cast<double>(std::abs(static_cast<long double>(value) - reference) / ulp);
}

/// A number whose logarithm is evenly distributed, of either sign.
double anySize(Rng& rng, int exponent_min, int exponent_max) {
  const auto exponents = static_cast<std::uint32_t>(exponent_max - exponent_min);
  const int exponent = exponent_min + static_cast<int>(rng.below(exponents));
  const double size = std::ldexp(rng.uniform(1, 2), exponent);
  return rng.below(2) == 0 ? size : -size;
}

std::uint64_t bitsOf(double x) { return std::bit_cast<std::uint64_t>(x); }

TEST(PortableMath, SineAndCosineAreWithinNineTenthsOfAnUlp) {
  Rng rng(1);
  double worst = 0;
  for (int i = 0; i < 200000; ++i) {
    const double x = i % 4 == 0 ? rng.uniform(-1024, 1024) : i % 4 == 1 ? anySize(rng, -40, 10) : rng.uniform(-4, 4);
    const auto [sin, cos] = sincos(x);
    worst = std::max(
        {worst, ulps(sin, std::sin(static_cast<long double>(x))), ulps(cos, std::cos(static_cast<long double>(x)))});
    ASSERT_LT(worst, 0.9) << "at " << x;
  }
  EXPECT_GT(worst, 0.5);  // the reference has more digits than a double
}

TEST(PortableMath, SinesAndCosinesOfManyAnglesAreThoseOfEach) {
  const VectorWidth widest = vector_width;
  for (const VectorWidth width : {VectorWidth::sse2, VectorWidth::avx2, VectorWidth::avx512}) {
    if (width > widest) continue;
    setVectorWidth(width);
    Rng rng(1);
    for (std::size_t count = 0; count < 200; ++count) {
      std::vector<double> angles_rad{0.0, -0.0, 1024, -1024, 1e-9, -1e-310, kPi / 4, -kPi / 2};
      if (count % 3 == 1) angles_rad.insert(angles_rad.end(), {1025, kInfinity, kNaN, 1e300});
      angles_rad.resize(std::min(count, angles_rad.size()));
      while (angles_rad.size() < count)
        angles_rad.push_back(rng.below(4) == 0 ? anySize(rng, -40, 10) : rng.uniform(-7, 7));
      std::vector<double> sines(count), cosines(count);
      sincos(angles_rad, sines.data(), cosines.data());
      for (std::size_t i = 0; i < count; ++i) {
        const auto [sin, cos] = sincos(angles_rad[i]);
        if (std::isnan(sin)) {
          ASSERT_TRUE(std::isnan(sines[i]) && std::isnan(cosines[i]));
          continue;
        }
        ASSERT_EQ(bitsOf(sines[i]), bitsOf(sin)) << "at " << angles_rad[i];
        ASSERT_EQ(bitsOf(cosines[i]), bitsOf(cos)) << "at " << angles_rad[i];
      }
    }
  }
  setVectorWidth(widest);
}

TEST(PortableMath, SineOfTheDoublesNearestToMultiplesOfPiKeepsItsDigits) {
  // π − the double nearest to it = 1.2246467991473531772e-16, and so for its halves.
  EXPECT_EQ(sin(kPi), 1.2246467991473532e-16);
  EXPECT_EQ(cos(kPi / 2), 6.123233995736766e-17);
  EXPECT_EQ(cos(kPi), -1);
  EXPECT_EQ(sin(kPi / 2), 1);
  for (int n = 1; n <= 650; ++n) {
    for (const double x : {n * (kPi / 2), std::nextafter(n * (kPi / 2), 0)}) {
      const auto [sin, cos] = sincos(x);
      ASSERT_LT(ulps(sin, std::sin(static_cast<long double>(x))), 1) << n;
      ASSERT_LT(ulps(cos, std::cos(static_cast<long double>(x))), 1) << n;
    }
  }
}

TEST(PortableMath, SineAndCosineOfSpecialValues) {
  EXPECT_EQ(bitsOf(sin(0.0)), bitsOf(0.0));
  EXPECT_EQ(bitsOf(sin(-0.0)), bitsOf(-0.0));
  EXPECT_EQ(cos(-0.0), 1);
  EXPECT_EQ(sin(0x1p-1074), 0x1p-1074);
  for (const double x : {kInfinity, -kInfinity, kNaN}) {
    EXPECT_TRUE(std::isnan(sin(x))) << x;
    EXPECT_TRUE(std::isnan(cos(x))) << x;
  }
}

TEST(PortableMath, SineIsOddAndCosineIsEven) {
  Rng rng(2);
  for (int i = 0; i < 10000; ++i) {
    const double x = anySize(rng, -10, 30);
    ASSERT_EQ(sin(-x), -sin(x)) << x;
    ASSERT_EQ(cos(-x), cos(x)) << x;
  }
}

TEST(PortableMath, SineBeyond1024RadiansIsThatOfAnAngleWithinOneBit) {
  Rng rng(3);
  for (int i = 0; i < 10000; ++i) {
    const double x = anySize(rng, 10, 40);
    const double bit = std::abs(x) * 0x1p-52;
    ASSERT_NEAR(sin(x), static_cast<double>(std::sin(static_cast<long double>(x))), bit) << x;
    ASSERT_NEAR(cos(x), static_cast<double>(std::cos(static_cast<long double>(x))), bit) << x;
  }
}

TEST(PortableMath, ArctangentIsWithinNineTenthsOfAnUlp) {
  Rng rng(4);
  double worst = 0;
  for (int i = 0; i < 200000; ++i) {
    double y = rng.uniform(-1, 1), x = rng.uniform(-1, 1);
    if (i % 3 == 0) y = anySize(rng, -40, 40);
    if (i % 5 == 0) x = std::ldexp(x, 1000), y = std::ldexp(y, 950);
    if (i % 5 == 1) x = std::ldexp(x, -950), y = std::ldexp(y, -950);
    worst = std::max(worst, ulps(atan2(y, x), std::atan2(static_cast<long double>(y), static_cast<long double>(x))));
    ASSERT_LT(worst, 0.9) << y << ", " << x;
  }
  EXPECT_GT(worst, 0.5);
}

TEST(PortableMath, ArctangentOfTheEightDirectionsAndOfSpecialValues) {
  EXPECT_EQ(atan2(0, 1), 0);
  EXPECT_EQ(atan2(1, 1), kPi / 4);
  EXPECT_EQ(atan2(1, 0), kPi / 2);
  EXPECT_EQ(atan2(1, -1), 3 * kPi / 4);
  EXPECT_EQ(atan2(0, -1), kPi);
  EXPECT_EQ(atan2(-1, -1), -3 * kPi / 4);
  EXPECT_EQ(atan2(-1, 0), -kPi / 2);
  EXPECT_EQ(atan2(-1, 1), -kPi / 4);
  EXPECT_EQ(bitsOf(atan2(0.0, 0.0)), bitsOf(0.0));
  EXPECT_EQ(bitsOf(atan2(-0.0, 0.0)), bitsOf(-0.0));
  EXPECT_EQ(atan2(0.0, -0.0), kPi);
  EXPECT_EQ(atan2(-0.0, -0.0), -kPi);
  EXPECT_EQ(atan2(-0.0, -1), -kPi);
  EXPECT_EQ(atan2(kInfinity, kInfinity), kPi / 4);
  EXPECT_EQ(atan2(kInfinity, -kInfinity), 3 * kPi / 4);
  EXPECT_EQ(atan2(-kInfinity, 3), -kPi / 2);
  EXPECT_EQ(atan2(3, kInfinity), 0);
  EXPECT_EQ(atan2(3, -kInfinity), kPi);
  EXPECT_EQ(atan2(0x1p-1074, 1), 0x1p-1074);
  EXPECT_TRUE(std::isnan(atan2(kNaN, 1)));
  EXPECT_TRUE(std::isnan(atan2(1, kNaN)));
}

TEST(PortableMath, LogarithmIsWithinNineTenthsOfAnUlp) {
  Rng rng(5);
  double worst = 0;
  for (int i = 0; i < 200000; ++i) {
    const double x = i % 4 == 0   ? std::abs(anySize(rng, -1074, 1023))
                     : i % 4 == 1 ? rng.uniform(0.99, 1.01)
                                  : rng.uniform(1e-9, 3);
    worst = std::max(worst, ulps(log(x), std::log(static_cast<long double>(x))));
    ASSERT_LT(worst, 0.9) << x;
  }
  EXPECT_GT(worst, 0.5);
}

TEST(PortableMath, LogarithmOfSpecialValues) {
  EXPECT_EQ(log(1), 0);
  EXPECT_EQ(log(2), 0.69314718055994530942);
  EXPECT_EQ(log(0x1p-1074), -1074 * 0.69314718055994530942);
  EXPECT_EQ(log(0.0), -kInfinity);
  EXPECT_EQ(log(-0.0), -kInfinity);
  EXPECT_EQ(log(kInfinity), kInfinity);
  EXPECT_TRUE(std::isnan(log(-1)));
  EXPECT_TRUE(std::isnan(log(kNaN)));
}

TEST(PortableMath, ExponentialIsWithinOneAndAHalfUlp) {
  Rng rng(5);
  double worst = 0;
  for (int i = 0; i < 200000; ++i) {
    const double x = i % 2 ? rng.uniform(-700, 700) : rng.uniform(-1, 1);
    worst = std::max(worst, ulps(exp(x), std::exp(static_cast<long double>(x))));
  }
  EXPECT_LT(worst, 1.5);
  EXPECT_EQ(exp(0), 1);
  EXPECT_EQ(exp(-1000), 0);
  EXPECT_EQ(exp(1000), kInfinity);
  EXPECT_EQ(exp(-kInfinity), 0);
  EXPECT_TRUE(std::isnan(exp(std::numeric_limits<double>::quiet_NaN())));
}

TEST(PortableMath, HypotenuseIsWithinAnUlpAndAFifth) {
  Rng rng(6);
  for (int i = 0; i < 200000; ++i) {
    double x = rng.uniform(-1, 1), y = rng.uniform(-1, 1);
    if (i % 3 == 0) y = anySize(rng, -30, 30);
    if (i % 5 == 0) x = std::ldexp(x, 1000), y = std::ldexp(y, 980);
    if (i % 5 == 1) x = std::ldexp(x, -1000), y = std::ldexp(y, -1000);
    ASSERT_LT(ulps(hypot(x, y), std::hypot(static_cast<long double>(x), static_cast<long double>(y))), 1.2)
        << x << ", " << y;
  }
}

TEST(PortableMath, HypotenuseOfPythagoreanTriplesAndOfSpecialValues) {
  EXPECT_EQ(hypot(3, 4), 5);
  EXPECT_EQ(hypot(-5, 12), 13);
  EXPECT_EQ(hypot(0x3p1000, 0x4p1000), 0x5p1000);
  EXPECT_EQ(hypot(0x3p-1000, 0x4p-1000), 0x5p-1000);
  EXPECT_EQ(hypot(0, 0), 0);
  EXPECT_EQ(hypot(0, -2), 2);
  EXPECT_EQ(hypot(kInfinity, 1), kInfinity);
  EXPECT_TRUE(std::isnan(hypot(kNaN, 1)));
}

// Reference bits, computed on x86-64 by g++ 12; must be equal on every processor, compiler and library.
TEST(PortableMath, GivesTheSameBitsEverywhere) {
  std::uint64_t hash = 0;
  const auto add = [&](double x) { hash = std::rotl(hash, 5) * 0x9e3779b97f4a7c15 + bitsOf(x); };
  Rng rng(7);
  for (int i = 0; i < 20000; ++i) {
    const double x = anySize(rng, -30, 20), y = anySize(rng, -30, 20);
    const auto [sin, cos] = sincos(x);
    for (const double value : {sin, cos, atan2(y, x), log(std::abs(x)), hypot(x, y)}) add(value);
  }
  EXPECT_EQ(hash, 2542101863926141886u);
}

}  // namespace
}  // namespace robosim::portable
