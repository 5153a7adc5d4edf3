#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "base/random_blocks.h"
#include "base/testing/vector_widths.h"
#include "base/ziggurat.h"

namespace robosim {
namespace {

std::vector<double> drawn(Rng rng, int n = 20000) {
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(rng.gaussian());
  return values;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum / static_cast<double>(a.size());
}

TEST(Rng, ReturnsThePublishedPhiloxNumbers) {
  // Random123's known answer for Philox 4x32-10, counter 0 and key 0: 6627e8d5 e169c58d bc57ac4c 9b00dbd8; drawn from
  // the block's end.
  Rng rng(0, RandomPurpose::sensor_noise);
  EXPECT_EQ(rng(), 0x9b00dbd8u);
  EXPECT_EQ(rng(), 0xbc57ac4cu);
  EXPECT_EQ(rng(), 0xe169c58du);
  EXPECT_EQ(rng(), 0x6627e8d5u);
}

TEST(Rng, ReturnsTheSameNumbersForTheSameArguments) {
  Rng first(42, RandomPurpose::controller, 7, 3, 1000), again(42, RandomPurpose::controller, 7, 3, 1000);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(first(), again());
}

TEST(RandomBlocks, AreTheNumbersOfRng) {
  Rng rng(0x123456789abcdef0u, RandomPurpose::sensor_noise, 7, 3, 1000);
  RandomBlocks blocks;
  forEachVectorWidth([&](VectorWidth width) {
    rng.skipToBlock(0);
    blocks.draw(0x123456789abcdef0u, RandomPurpose::sensor_noise, 7, 3, 1000, 101);
    for (std::size_t i = 0; i < 101; ++i) {
      for (const auto& words : blocks.words) ASSERT_EQ(words[i], rng()) << i << nameOf(width);
    }
  });
}

TEST(Ziggurat, HasTheDistributionFunctionOfAGaussian) {
  Rng rng(11);
  constexpr int n = 400000;
  std::vector<double> drawn;
  for (int i = 0; i < n; ++i) {
    drawn.push_back(Ziggurat::instance().gaussian(rng(), [&] { return Rng(static_cast<std::uint64_t>(i) + 1000); }));
  }
  std::sort(drawn.begin(), drawn.end());
  double ks = 0;
  for (int i = 0; i < n; ++i) {
    ks = std::max(ks, std::abs(0.5 * std::erfc(-drawn[static_cast<std::size_t>(i)] / M_SQRT2) - (i + 0.5) / n));
  }
  EXPECT_LT(ks, 1.63 / std::sqrt(n)) << "exceeded in 1 % of cases";
  // Beyond the tail's begin: 2 · P(g > 3.4426) = 5.76e-4, 230 numbers.
  const auto tail = std::count_if(drawn.begin(), drawn.end(), [](double g) { return std::abs(g) > 3.442619855899; });
  EXPECT_NEAR(static_cast<double>(tail), 230, 4 * 15.2);
}

TEST(Rng, NeverRepeatsABlockWithinAStream) {
  Rng rng(1);
  std::set<std::uint64_t> pairs;
  for (int i = 0; i < 50000; ++i) pairs.insert((static_cast<std::uint64_t>(rng()) << 32) | rng());
  EXPECT_EQ(pairs.size(), 50000u);
}

TEST(Rng, UniformIsUniformInZeroToOne) {
  Rng rng(3);
  constexpr int n = 100000, bins = 100;
  std::vector<int> count(bins, 0);
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double u = rng.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
    squares += u * u;
    ++count[static_cast<std::size_t>(u * bins)];
  }
  EXPECT_NEAR(sum / n, 0.5, 4 * std::sqrt(1. / 12 / n));
  EXPECT_NEAR(squares / n, 1. / 3, 4 * std::sqrt(4. / 45 / n));
  double chi_squared = 0;
  for (const int c : count) chi_squared += (c - n / bins) * (c - n / bins) / static_cast<double>(n / bins);
  EXPECT_NEAR(chi_squared, bins - 1, 4 * std::sqrt(2. * (bins - 1)));
}

TEST(Rng, UniformStaysWithinItsBounds) {
  Rng rng(4);
  double low = 10, high = -10;
  for (int i = 0; i < 10000; ++i) {
    const double u = rng.uniform(-2, 3);
    low = std::min(low, u);
    high = std::max(high, u);
  }
  EXPECT_GE(low, -2);
  EXPECT_LT(high, 3);
  EXPECT_NEAR(low, -2, 0.01);
  EXPECT_NEAR(high, 3, 0.01);
}

TEST(Rng, GaussianHasMeanZeroDeviationOneAndNormalTails) {
  constexpr int n = 200000;
  double sum = 0, squares = 0, fourths = 0;
  int beyond_two = 0;
  for (const double g : drawn(Rng(5), n)) {
    sum += g;
    squares += g * g;
    fourths += g * g * g * g;
    beyond_two += std::abs(g) > 2;
  }
  EXPECT_NEAR(sum / n, 0, 4 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1, 4 * std::sqrt(2. / n));
  EXPECT_NEAR(fourths / n, 3, 4 * std::sqrt(96. / n));
  const double share = 0.0455;
  EXPECT_NEAR(beyond_two / static_cast<double>(n), share, 4 * std::sqrt(share / n));
}

TEST(Rng, StreamsWithDifferentArgumentsAreIndependent) {
  const std::vector<double> one = drawn(Rng(1, RandomPurpose::sensor_noise, 2, 3, 4));
  const double bound = 4 / std::sqrt(static_cast<double>(one.size()));
  EXPECT_NEAR(correlation(one, drawn(Rng(2, RandomPurpose::sensor_noise, 2, 3, 4))), 0, bound);
  EXPECT_NEAR(correlation(one, drawn(Rng(1ull << 32 | 1, RandomPurpose::sensor_noise, 2, 3, 4))), 0, bound);
  EXPECT_NEAR(correlation(one, drawn(Rng(1, RandomPurpose::message_loss, 2, 3, 4))), 0, bound);
  EXPECT_NEAR(correlation(one, drawn(Rng(1, RandomPurpose::sensor_noise, 3, 3, 4))), 0, bound);
  EXPECT_NEAR(correlation(one, drawn(Rng(1, RandomPurpose::sensor_noise, 2, 4, 4))), 0, bound);
  EXPECT_NEAR(correlation(one, drawn(Rng(1, RandomPurpose::sensor_noise, 2, 3, 5))), 0, bound);
}

TEST(Rng, StreamsOfTwoPurposesDifferForEveryItem) {
  const auto of_no_item = Rng(1, RandomPurpose::message_loss, 2)();
  for (int bit = 0; bit < 24; ++bit) {
    EXPECT_NE(Rng(1, RandomPurpose::sensor_noise, 2, std::uint32_t{1} << bit)(), of_no_item) << bit;
  }
}

TEST(Rng, FirstNumbersOfConsecutiveStepsAreIndependent) {
  // As for sensor noise: one number per step.
  constexpr int n = 20000;
  double sum = 0, squares = 0, products = 0, before = 0;
  for (int step = 0; step < n; ++step) {
    const double g = Rng(9, RandomPurpose::sensor_noise, 1, 1, static_cast<std::uint64_t>(step)).gaussian();
    sum += g;
    squares += g * g;
    products += g * before;
    before = g;
  }
  EXPECT_NEAR(sum / n, 0, 4 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1, 4 * std::sqrt(2. / n));
  EXPECT_NEAR(products / n, 0, 4 / std::sqrt(n));
}

TEST(Rng, BelowIsUniform) {
  Rng rng(6);
  constexpr int n = 60000;
  std::vector<int> count(6, 0);
  for (int i = 0; i < n; ++i) ++count.at(rng.below(6));
  for (const int c : count) EXPECT_NEAR(c, n / 6, 4 * std::sqrt(n * 5. / 36));
  EXPECT_EQ(rng.below(1), 0u);
}

}  // namespace
}  // namespace robosim
