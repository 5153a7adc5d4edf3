#include "run/run_summary.h"

#include <gtest/gtest.h>

#include "run/run_outputs.h"

namespace robosim {
namespace {

TEST(RunSummary, ComparesLateCommandsWithTheCommandsOfAllRobots) {
  RunSummary summary;
  summary.robots = 3;
  summary.steps = 10;
  EXPECT_EQ(summary.text().find("\nlate"), std::string::npos) << "a run in lockstep";
  summary.late = 4;
  EXPECT_NE(summary.text().find("\nlate       4 commands, of 30\n"), std::string::npos) << summary.text();
}

TEST(RunSummary, ReportsEveryCorruptedMessage) {
  RunSummary summary;
  summary.report.emplace();
  EXPECT_EQ(summary.text().find("corrupted"), std::string::npos);
  summary.report->corrupted_messages = 1;
  EXPECT_NE(summary.text().find("corrupted  1 messages of geometry workers, discarded"), std::string::npos)
      << summary.text();
}

TEST(RunArguments, EndARunAtItsTimeLimit) {
  RunArguments arguments;
  arguments.time_s = 0.3;  // 3 · 0.1 is slightly more
  EXPECT_FALSE(arguments.timeIsUp({2, 0.1}));
  EXPECT_TRUE(arguments.timeIsUp({3, 0.1}));
  arguments.time_s = 0.7;  // 7 · 0.1 is slightly more
  EXPECT_FALSE(arguments.timeIsUp({6, 0.1}));
  EXPECT_TRUE(arguments.timeIsUp({7, 0.1}));
}

}  // namespace
}  // namespace robosim
