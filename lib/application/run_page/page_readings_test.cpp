#include "run_page/page_readings.h"

#include <cmath>
#include <limits>
#include <utility>

#include <gtest/gtest.h>

#include "run_page/page_bytes.h"

namespace robosim {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
const auto silent = [](const std::string&) {};

TEST(PageReadings, RoundsToAPowerOfTenOfWhichTheValuesSpanAThousand) {
  EXPECT_DOUBLE_EQ(roundingStep("co2_ppm", false, 400, 1399), 0.1);
  EXPECT_DOUBLE_EQ(roundingStep("co2_ppm", false, 0, 1000), 1);
  EXPECT_DOUBLE_EQ(roundingStep("latitude_deg", false, 52.1, 52.1002), 1e-7);
  EXPECT_EQ(roundingStep("count", true, 0, 1e6), 1) << "whole numbers are exact";
}

TEST(PageReadings, RoundsLengthsAndAnglesToAThousandthAtMost) {
  EXPECT_DOUBLE_EQ(roundingStep("x_m", false, -200, 200), 1e-3);
  EXPECT_DOUBLE_EQ(roundingStep("range_3_m", false, 0.1, 0.6), 1e-4);
  EXPECT_DOUBLE_EQ(roundingStep("heading_rad", false, -3.1, 3.1), 1e-3);
}

TEST(PageReadings, RoundsHugeNumbersToWhatJavaScriptCanHold) {
  EXPECT_GE(2e15 * roundingStep("ain", false, 1e300, 1.1e300), 1e300);
  EXPECT_GE(2e15 * roundingStep("x_m", false, 1e300, 1e300), 1e300);
  EXPECT_GT(roundingStep("ain", true, 0, 1e18), 1);
  EXPECT_EQ(roundingStep("ain", true, 0, 2e15), 1);
}

TEST(PageReadings, RoundToAFiniteStepWhateverTheValuesSpan) {
  const double most = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
  for (const auto& [min, max] : {std::pair(-most, most), std::pair(0.0, least), std::pair(-least, -least),
                                 std::pair(most, most), std::pair(-2.0, std::nextafter(-2.0, 0.0))}) {
    for (const char* name : {"ain", "x_m"}) {
      const double step = roundingStep(name, false, min, max);
      EXPECT_GE(step, 1e-300) << min << " " << max;
      EXPECT_LE(step, 1e300) << min << " " << max;
      EXPECT_LE(std::max(std::abs(min), std::abs(max)) / step, 2e15) << min << " " << max;
    }
  }
}

/// tests/browser/run_page_data_test.mjs decodes the same text with the page's program.
TEST(PageReadings, EncodeNegativeNumbersThatDifferByTheirLastBit) {
  PageReadings readings;
  std::uint64_t moment = 0;
  for (const double value : {-2.0, std::nextafter(-2.0, 0.0), -2.0}) {
    ASSERT_TRUE(readings.keepsNext(0, "x"));
    readings.add(0, "x", moment++, {"a"}, {value}, {0});
  }
  const auto blocks = readings.encode(1'000'000, silent);
  EXPECT_DOUBLE_EQ(blocks[0].head["columns"][0][1].get<double>(), 1e-11);
  // Moments 0 +1 +1; -2e11 as 2 * 2e11 - 1 + 1, no difference as 1.
  PageBytes bytes;
  for (const std::uint64_t number : {0ULL, 1ULL, 1ULL, 400'000'000'000ULL, 1ULL, 1ULL}) bytes.add(number);
  EXPECT_EQ(blocks[0].packed, packedForPage(bytes.bytes()));
}

TEST(PageReadings, AreEncodedByColumnWithDifferences) {
  PageReadings readings;
  const std::vector<std::string> names{"a", "b"};
  const double values[][2] = {{5, 1}, {7, kNone}, {4, 1}};
  for (std::uint64_t i = 0; i < 3; ++i) {
    ASSERT_TRUE(readings.keepsNext(2, "x"));
    readings.add(2, "x", 10 * i, names, {values[i][0], values[i][1]}, {1, 1});
  }
  const auto blocks = readings.encode(1'000'000, silent);
  ASSERT_EQ(blocks.size(), 1u);
  EXPECT_EQ(blocks[0].head.dump(),
            R"({"sensor":"x","stride":1,"columns":[["a",1.0],["b",1.0]],"lists":[[0,1]],"series":[[2,0,3]]})");
  // Moments 0 +10 +10; a: +5 +2 -3, as 11 5 6; b: +1, none, 0, as 3 0 1.
  EXPECT_EQ(blocks[0].packed, packedForPage(std::string("\0\12\12\13\5\6\3\0\1", 9)));
}

TEST(PageReadings, KeepEveryNthReadingOfTheSensorThatTakesMost) {
  PageReadings readings;
  double noise = 0.5;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    noise = std::fmod(noise * 997.13, 1);
    if (readings.keepsNext(0, "many"))
      readings.add(0, "many", i, {"range_0_m", "range_1_m"}, {5 * noise, noise}, {0, 0});
    if (readings.keepsNext(0, "few")) readings.add(0, "few", i, {"state"}, {1}, {1});
  }
  const auto blocks = readings.encode(4000, silent);
  const auto stride = blocks[0].head["stride"].get<int>();
  EXPECT_GT(stride, 1);
  EXPECT_EQ(blocks[0].head["series"][0][2].get<int>(), (4000 + stride - 1) / stride);
  EXPECT_EQ(blocks[1].head["stride"].get<int>(), 1);
  EXPECT_LE(blocks[0].packed.size() + blocks[1].packed.size(), 4000u);
}

TEST(PageReadings, JoinColumnsOfTheSameNameOfSeveralRobots) {
  PageReadings readings;
  ASSERT_TRUE(readings.keepsNext(0, "x"));
  readings.add(0, "x", 0, {"a", "b"}, {1, 2}, {1, 1});
  ASSERT_TRUE(readings.keepsNext(1, "x"));
  readings.add(1, "x", 0, {"b", "c"}, {3, 4}, {1, 1});
  const auto head = readings.encode(1000, silent)[0].head;
  EXPECT_EQ(head["columns"].size(), 3u);
  EXPECT_EQ(head["lists"].dump(), "[[0,1],[1,2]]");
}

TEST(PageReadings, RefuseReadingsWhereEachSeriesHasOneOnly) {
  PageReadings readings;
  const std::size_t columns = 200;
  std::vector<std::string> names(columns);
  for (std::size_t i = 0; i < columns; ++i) names[i] = std::to_string(i);
  const std::vector<double> values(columns, 1);
  const std::vector<std::uint8_t> is_whole(columns, 1);
  std::size_t kept = 0;
  const std::size_t robots = PageReadings::kMaxValues / columns + 100;
  for (std::size_t robot = 0; robot < robots; ++robot) {
    if (!readings.keepsNext(robot, "x")) continue;
    readings.add(robot, "x", 0, names, values, is_whole);
    ++kept;
  }
  EXPECT_EQ(kept, PageReadings::kMaxValues / columns + 1);
  ASSERT_EQ(readings.remarks().size(), 1u);
  EXPECT_EQ(readings.remarks()[0],
            "The page does not contain the last 99 readings: the recording has too many sensors.");
}

TEST(PageReadings, ThinTheLargestSensorOfThoseThatHaveSeveralReadings) {
  PageReadings readings;
  std::vector<std::string> names;
  std::vector<double> values;
  for (int i = 0; i < 3000; ++i) {
    names.push_back("c" + std::to_string(i));
    values.push_back(std::fmod(i * 997.13, 1));
  }
  ASSERT_TRUE(readings.keepsNext(0, "wide"));
  readings.add(0, "wide", 0, names, values, std::vector<std::uint8_t>(names.size(), 0));
  for (std::uint64_t i = 0; i < 64; ++i) {
    if (readings.keepsNext(0, "long")) readings.add(0, "long", i, {"a"}, {values[i]}, {0});
  }
  const auto blocks = readings.encode(0, silent);
  EXPECT_EQ(blocks[0].head["stride"].get<int>(), 1);
  EXPECT_EQ(blocks[1].head["stride"].get<int>(), 64);
}

TEST(PageReadings, KeepValuesByNameWhenColumnsChangeTheirOrder) {
  PageReadings readings;
  ASSERT_TRUE(readings.keepsNext(0, "x"));
  readings.add(0, "x", 0, {"a", "b"}, {1, 2}, {1, 1});
  ASSERT_TRUE(readings.keepsNext(1, "x"));
  readings.add(1, "x", 0, {"b", "a"}, {5, 6}, {1, 1});
  ASSERT_TRUE(readings.keepsNext(1, "x"));
  readings.add(1, "x", 1, {"a", "c", "b"}, {8, 9, 7}, {1, 1, 1});
  const auto blocks = readings.encode(1000, silent);
  EXPECT_EQ(blocks[0].head["lists"].dump(), "[[0,1],[1,0,2]]");
  // Robot 0: moment 0; a 1, b 2. Robot 1: moments 0 +1; b 5 +2, a 6 +2, c none 9.
  EXPECT_EQ(blocks[0].packed, packedForPage(std::string("\0\3\5\0\1\13\5\15\5\0\23", 11)));
}

TEST(PageReadings, BoundTheNumberOfColumns) {
  PageReadings readings;
  for (std::size_t i = 0; i < PageReadings::kMaxColumns + 3; ++i) {
    const std::string sensor = "s" + std::to_string(i / 5);
    if (readings.keepsNext(0, sensor)) readings.add(0, sensor, i, {"c" + std::to_string(i)}, {1}, {1});
  }
  ASSERT_EQ(readings.remarks().size(), 1u);
  EXPECT_EQ(readings.remarks()[0],
            "Of the readings, the page contains 50,000 quantities; values of others are left out: 3.");
}

TEST(PageBytes, AreGroupsOfSevenBits) {
  PageBytes bytes;
  bytes.add(127);
  bytes.add(300);
  bytes.addSigned(-1);
  bytes.addSigned(64);
  EXPECT_EQ(bytes.bytes(), std::string("\x7f\xac\x02\x01\x80\x01"));
}

}  // namespace
}  // namespace robosim
