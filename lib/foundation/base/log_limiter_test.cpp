#include "base/log_limiter.h"

#include <vector>

#include <gtest/gtest.h>

namespace robosim {
namespace {

using namespace std::chrono_literals;

class LogLimiterTest : public testing::Test {
 protected:
  void writeTimes(int times, const std::string& kind) {
    for (int i = 0; i < times; ++i) limiter.write(kind, kind + " line");
  }

  LogLimiter::Clock::time_point now{100s};
  std::vector<std::string> lines;
  LogLimiter limiter{[this](const std::string& line) { lines.push_back(line); }, [this] { return now; }, 3};
};

TEST_F(LogLimiterTest, WritesTheFirstLinesOfASecondAndCountsTheOthers) {
  writeTimes(3 + 40, "viewer");
  EXPECT_EQ(lines, std::vector<std::string>(3, "viewer line"));
  now += 1s;
  writeTimes(1, "viewer");
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[3], "viewer: 40 more lines within 1 s suppressed (limit: 3 lines/s)");
  EXPECT_EQ(lines[4], "viewer line");
}

TEST_F(LogLimiterTest, LimitsEachKindIndependently) {
  writeTimes(100, "viewer");
  writeTimes(2, "robot");
  EXPECT_EQ(lines, (std::vector<std::string>{"viewer line", "viewer line", "viewer line", "robot line", "robot line"}));
}

TEST_F(LogLimiterTest, WritesEveryLineWithinTheLimit) {
  for (int second = 0; second < 5; ++second) {
    writeTimes(3, "robot");
    now += 1s;
  }
  EXPECT_EQ(lines, std::vector<std::string>(15, "robot line"));
}

TEST_F(LogLimiterTest, ReportsSuppressedLinesOfPastSecondsOnce) {
  writeTimes(5, "viewer");
  limiter.reportSuppressed();
  EXPECT_EQ(lines.size(), 3u) << "the second is not over";
  now += 1s;
  limiter.reportSuppressed();
  limiter.reportSuppressed();
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[3], "viewer: 2 more lines within 1 s suppressed (limit: 3 lines/s)");
}

}  // namespace
}  // namespace robosim
