#include "base/portable_math.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/vector_width.h"

namespace robosim::portable {
namespace {

// Polynomials in z = argument², computed with Sollya (fpminimax, coefficients in double precision).

/// sin r = r + r³·s(z) for |r| ≤ π/4, relative error 2^-57.9.
constexpr std::array kSin = {-0x1.5555555555548p-3, 0x1.111111110f75ep-7,   -0x1.a01a019bf2523p-13,
                             0x1.71de355f3628dp-19, -0x1.ae5e549c42386p-26, 0x1.5d8e4234ac4e3p-33};
/// cos r = 1 − z/2 + z²·c(z) for |r| ≤ π/4, relative error 2^-60.5.
constexpr std::array kCos = {0x1.5555555555555p-5,   -0x1.6c16c16c168c9p-10, 0x1.a01a019f37fc6p-16,
                             -0x1.27e4fa0298e7fp-22, 0x1.1eeb578884a2cp-29,  -0x1.90735193a31ap-37};
/// atan t = t − t³·a(z) for |t| ≤ 1/15, relative error 2^-59.6.
constexpr std::array kAtan = {0x1.5555555555551p-2, -0x1.999999998087bp-3, 0x1.249248726e1a5p-3, -0x1.c71900601982bp-4,
                              0x1.70e3d46bff9c6p-4};
/// log((1 + s) / (1 − s)) = 2s + s·z·l(z) for |s| ≤ 3 − √8, relative error 2^-57.6.
constexpr std::array kLog = {0x1.5555555555558p-1, 0x1.99999999952d9p-2, 0x1.2492492df8968p-2, 0x1.c71c62d91b459p-3,
                             0x1.7462b89ff002fp-3, 0x1.39fdd4fc32cadp-3, 0x1.2b5f4061cb81p-3};

/// Evaluates two coefficients at a time, which halves the dependency chain of Horner's scheme.
template <std::size_t n>
[[gnu::always_inline]] inline double polynomial(const std::array<double, n>& coefficients, double z) {
  const double zz = z * z;
  const auto pair = [&](std::size_t i) {
    return i + 1 < n ? coefficients[i] + coefficients[i + 1] * z : coefficients[i];
  };
  std::size_t i = (n - 1) / 2 * 2;
  double sum = pair(i);
  while (i > 0) sum = pair(i -= 2) + zz * sum;
  return sum;
}

/// A number as the sum of two doubles, the second below the last bit of the first.
struct Sum {
  double high = 0;
  double low = 0;
};

constexpr double kTwoPi = 0x1.921fb54442d18p+2;
constexpr Sum kHalfPi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};

/// π/2 in parts of 33, 33 and 53 bits (Cody & Waite 1980): a whole number up to 2^20 times one of the first two is
/// exact.
constexpr double kHalfPi1 = 0x1.921fb544p+0, kHalfPi2 = 0x1.0b4611a6p-34, kHalfPi3 = 0x1.3198a2e037073p-69;
constexpr double kPerHalfPi = 0x1.45f306dc9c883p-1;
/// Adding and subtracting this rounds to a whole number, which the low bits of the sum hold.
constexpr double kRounder = 0x1.8p52;
constexpr double kReduced_rad = 1024;
/// The sine of a smaller angle is the angle, its cosine 1.
constexpr double kSmall_rad = 0x1p-27;

[[gnu::always_inline]] inline SinCos nearZero(const Sum& angle_rad) {
  const double r = angle_rad.high;
  const double z = r * r;
  const double sin = r + (z * r * polynomial(kSin, z) + angle_rad.low * (1 - z / 2));
  const double half = z / 2;
  const double level = 1 - half;
  const double cos = level + (((1 - level) - half) + (z * z * polynomial(kCos, z) - r * angle_rad.low));
  return {sin, cos};
}

/// @param bit 2 to negate, 0 otherwise
[[gnu::always_inline]] inline double negatedIf(std::uint64_t bit, double x) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) ^ bit << 62);
}

/// @param x at most kReduced_rad. The result for numbers below kSmall_rad, whose sign may be lost, is not used.
[[gnu::always_inline]] inline SinCos sincosReduced(double x) {
  const double rounded = x * kPerHalfPi + kRounder;
  const double n = rounded - kRounder;
  const double first = x - n * kHalfPi1;  // exact (Sterbenz)
  const double second = n * kHalfPi2;     // exact
  const double r = first - second;
  // TwoSum (Knuth 1969): the rounding error of that difference.
  const double taken = first - r;
  const double lost = (first - (r + taken)) + (taken - second);
  const double rest = lost - n * kHalfPi3;
  const double high = r + rest;
  const SinCos near = nearZero({high, (r - high) + rest});
  // The quadrant is unpredictable, so nothing here branches on it.
  const auto quadrant = std::bit_cast<std::uint64_t>(rounded);
  const bool swapped = (quadrant & 1) != 0;
  return {negatedIf(quadrant & 2, swapped ? near.cos : near.sin),
          negatedIf((quadrant + 1) & 2, swapped ? near.sin : near.cos)};
}

/// Sines and cosines of angles that need no reduction. @return false if one does: then the results are undefined
[[gnu::always_inline]] inline bool sincosOfReduced(const double* __restrict angles_rad, std::size_t count,
                                                   double* __restrict sines, double* __restrict cosines) {
  std::uint64_t beyond = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = angles_rad[i];
    const double size = std::abs(x);
    beyond |= size <= kReduced_rad ? std::uint64_t{0} : std::uint64_t{1};
    const SinCos reduced = sincosReduced(x);
    sines[i] = size < kSmall_rad ? x : reduced.sin;
    cosines[i] = size < kSmall_rad ? 1 : reduced.cos;
  }
  return beyond == 0;
}

/// Table of arctangents of i / 16.
constexpr std::array<Sum, 17> kAtanOf = {{
    {0x0p+0, 0x0p+0},
    {0x1.ff55bb72cfdeap-5, -0x1.c934d86d23f1dp-60},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.7b97b4bce5b02p-3, 0x1.347b0b4f881cap-58},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.362773707ebccp-2, -0x1.963a544b672d8p-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.a64eec3cc23fdp-2, -0x1.24dec1b50b7ffp-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.0657e94db30dp-1, -0x1.d5b495f6349e6p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.345f01cce37bbp-1, 0x1.1021137c71102p-55},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.5d58987169b18p-1, 0x1.0028e4bc5e7cap-57},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.819d0b7158a4dp-1, -0x1.bf76229d3b917p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
}};

/// The leading 26 bits: the product of two such numbers is exact.
double leading(double x) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & ~((std::uint64_t{1} << 27) - 1));
}

/// Arctangent of y / x for 0 < y ≤ x, both of a size that neither overflows nor underflows in products:
/// atan(y/x) = atan(c) + atan((y − c·x) / (x + c·y)) with the nearest c = i / 16 (below 1/16: c = 0).
Sum atanOfQuotient(double y, double x) {
  const double quotient = y / x;
  const auto i = quotient < 0.0625 ? 0U : static_cast<unsigned>(quotient * 32 + 1) / 2;
  const double c = i * 0.0625;
  const double x_high = leading(x);
  const double above = (y - c * x_high) - c * (x - x_high);
  const double below = x + c * y;
  const double per_below = 1 / below;
  const double t = above * per_below;
  // Remainder of the rounded quotient: above − t·below, nearly exact.
  const double t_high = leading(t), t_low = t - t_high;
  const double below_high = leading(below), below_low = below - below_high;
  const double rest = (((above - t_high * below_high) - t_high * below_low) - t_low * below_high) - t_low * below_low;
  const double z = t * t;
  const double low = kAtanOf[i].low + (rest * per_below - z * t * polynomial(kAtan, z));
  // Fast2Sum: the table's entry is the larger, or 0.
  const double high = kAtanOf[i].high + t;
  return {high, ((kAtanOf[i].high - high) + t) + low};
}

}  // namespace

SinCos sincos(double angle_rad) {
  double x = angle_rad;
  if (!(std::abs(x) <= kReduced_rad)) x = std::remainder(x, kTwoPi);
  if (std::abs(x) < kSmall_rad) return {x, 1};
  return sincosReduced(x);
}

void sincos(std::span<const double> angles_rad, double* sines, double* cosines) {
  const std::size_t count = angles_rad.size();
  constexpr std::size_t kFew = 2;  // without vectors they take less time
  if (count > kFew && withVectors<sincosOfReduced>(angles_rad.data(), count, sines, cosines)) return;
  for (std::size_t i = 0; i < count; ++i) {
    const auto [sin, cos] = sincos(angles_rad[i]);
    sines[i] = sin;
    cosines[i] = cos;
  }
}

double atan2(double y, double x) {
  const double along = std::abs(x), aside = std::abs(y);
  if (std::isnan(x) || std::isnan(y)) return std::numeric_limits<double>::quiet_NaN();
  const bool steep = aside > along;
  double more = steep ? aside : along;
  double less = steep ? along : aside;
  Sum angle;
  if (std::isinf(less)) {
    angle = kAtanOf[16];  // both are infinite
  } else if (more == 0 || less <= more * 0x1p-28) {
    angle = {more == 0 ? 0 : less / more, 0};  // the arctangent of so small a number is the number
  } else {
    const double scale = more > 0x1p500 ? 0x1p-600 : more < 0x1p-500 ? 0x1p600 : 1;
    angle = atanOfQuotient(less * scale, more * scale);
  }
  // Turned and mirrored to the quadrant: base ± angle.
  Sum base;
  double sign = 1;
  if (steep) {
    base = kHalfPi;
    sign = std::signbit(x) ? 1 : -1;
  } else if (std::signbit(x)) {
    base = {2 * kHalfPi.high, 2 * kHalfPi.low};
    sign = -1;
  }
  const double high = base.high + sign * angle.high;
  const double lost = (base.high - high) + sign * angle.high;  // Fast2Sum: the base is the larger, or 0
  return std::copysign(high + (lost + (base.low + sign * angle.low)), y);
}

double log(double x) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!(x > 0) || x == kInfinity) return x == 0 ? -kInfinity : x > 0 ? x : std::numeric_limits<double>::quiet_NaN();
  int exponent = 0;
  if (x < 0x1p-1022) {
    x *= 0x1p54;
    exponent = -54;
  }
  // x = 2^k·m with m within [√½, √2).
  constexpr std::uint64_t kRootHalf = 0x3fe6a09e667f3bcd;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const std::int64_t k = static_cast<std::int64_t>(bits - kRootHalf) >> 52;
  const double m = std::bit_cast<double>(bits - (static_cast<std::uint64_t>(k) << 52));
  const double power = static_cast<double>(k + exponent);
  constexpr double kLn2High = 0x1.62e42fefp-1, kLn2Low = 0x1.473de6af278edp-34;  // 33 bits: power times it is exact
  const double f = m - 1;
  const double s = f / (2 + f);
  const double z = s * s;
  const double half = f * f / 2;
  return power * kLn2High - ((half - (s * (half + z * polynomial(kLog, z)) + power * kLn2Low)) - f);
}

double exp(double x) {
  constexpr double kLargest = 709.78, kSmallest = -708;
  if (!(x <= kLargest)) return x > kLargest ? std::numeric_limits<double>::infinity() : x;
  if (x < kSmallest) return 0;
  // x = k·ln 2 + r with |r| ≤ ln 2 / 2; ln 2 as a sum of 33 bits and the rest, so that k times the first is exact.
  constexpr double kLn2High = 0x1.62e42fefp-1, kLn2Low = 0x1.473de6af278edp-34, kPerLn2 = 1.4426950408889634;
  const double k = std::floor(x * kPerLn2 + 0.5);
  const double high = x - k * kLn2High;
  const double low = k * kLn2Low;
  const double r = high - low;
  // Taylor's series; the remainder is below 2^-60.
  constexpr int kTerms = 14;
  double sum = 0;
  for (int n = kTerms; n >= 2; --n) sum = (sum + 1) * r / n;
  const double lost = (high - r) - low;
  const double power = 1 + (r + (r * sum + lost));
  return power * std::bit_cast<double>(static_cast<std::uint64_t>(static_cast<std::int64_t>(k) + 1023) << 52);
}

}  // namespace robosim::portable
