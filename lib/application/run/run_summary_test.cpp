#include "run/run_summary.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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

TEST(RunSummary, CountsLostMessagesByCause) {
  RunSummary summary;
  summary.messages = 7;
  EXPECT_NE(summary.text().find("\nmessages   7\n"), std::string::npos) << summary.text();
  summary.messages_sent = 20;
  summary.messages_lost.out_of_range = 10;
  summary.messages_lost.in_bursts = 2;
  EXPECT_NE(summary.text().find("\nmessages   7, and 12 lost: 10 out of range, 2 in bursts\n"), std::string::npos)
      << summary.text();
  const auto json = summary.json();
  EXPECT_EQ(json["messages_sent"], 20);
  EXPECT_EQ(json["messages_lost"]["out_of_range"], 10);
  EXPECT_EQ(json["messages_lost"]["by_chance"], 0);
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
