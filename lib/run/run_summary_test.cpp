#include "run/run_summary.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace robosim
