#include "base/progress.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class ProgressTest : public testing::Test {
 protected:
  ~ProgressTest() override { std::fclose(file_); }
  std::function<Progress::Clock::time_point()> clock() {
    return [this] { return now_; };
  }
  std::string text() {
    std::string read(10000, '\0');
    std::rewind(file_);
    read.resize(std::fread(read.data(), 1, read.size(), file_));
    return read;
  }
  std::FILE* file_ = std::tmpfile();
  Progress::Clock::time_point now_{};
};

TEST_F(ProgressTest, IsALinePerMinuteWithoutATerminal) {
  {
    Progress progress(file_, false, clock());
    EXPECT_FALSE(progress.due());
    now_ += milliseconds(59'999);
    EXPECT_FALSE(progress.due());
    progress.show("not due");
    now_ += milliseconds(1);
    EXPECT_TRUE(progress.due());
    progress.show("run 1 of 9, 8 min left");
    progress.show("twice");
    EXPECT_FALSE(progress.due());
    now_ += seconds(60);
    EXPECT_TRUE(progress.due());
    progress.show("run 2 of 9, 7 min left");
  }
  EXPECT_EQ(text(), "run 1 of 9, 8 min left\nrun 2 of 9, 7 min left\n");
}

TEST_F(ProgressTest, IsALineThatIsRewrittenOnATerminal) {
  {
    Progress progress(file_, true, clock());
    EXPECT_TRUE(progress.due());
    progress.show("longer");
    now_ += milliseconds(199);
    EXPECT_FALSE(progress.due());
    now_ += milliseconds(1);
    EXPECT_TRUE(progress.due());
    progress.show("short");
  }
  EXPECT_EQ(text(), "\rlonger\rshort \r     \r");
}

TEST(RemainingTime, IsThatAtTheMeanSpeedSoFar) {
  EXPECT_EQ(remainingTime(10, 0, 400), "") << "unknown before the first";
  EXPECT_EQ(remainingTime(10, 100, 400), "30 s left");
  EXPECT_EQ(remainingTime(10, 400, 400), "0 s left");
  EXPECT_EQ(remainingTime(60, 100, 300), "120 s left");
  EXPECT_EQ(remainingTime(60, 100, 400), "3 min left");
  EXPECT_EQ(remainingTime(3600, 1, 4), "3.0 h left");
  EXPECT_EQ(remainingTime(86400, 1, 4), "3.0 days left");
  EXPECT_EQ(commaRemainingTime(10, 100, 400), ", 30 s left");
  EXPECT_EQ(commaRemainingTime(10, 0, 400), "");
}

}  // namespace
}  // namespace robosim
