#include "console/team_events.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using Kind = TeamEvents::Kind;

struct TeamEventsTest : testing::Test {
  TeamEventsTest() {
    for (const char* name : {"Ann", "Bob"}) {
      robots.push_back({name, "localhost:9001", {}});
      robots.back().news.is_up = true;
    }
    events.news(robots);
  }

  /// The text of the only event; empty unless there is exactly one, of this kind.
  std::string eventOf(Kind kind) {
    const auto news = events.news(robots);
    return news.size() == 1 && news[0].kind == kind ? news[0].text : "";
  }

  std::vector<TeamRobot> robots;  ///< Ann is the primary
  TeamEvents events;
};

TEST_F(TeamEventsTest, ReportsEachEventOnce) {
  robots[0].news.state.set_why_stopped("no message from Ada for 0.5 s");
  EXPECT_EQ(eventOf(Kind::stopped), "Ann stopped: no message from Ada for 0.5 s.");
  EXPECT_TRUE(events.news(robots).empty());
  robots[0].news.state.set_why_stopped("");
  EXPECT_TRUE(events.news(robots).empty()) << "the end of a stop is no event";
}

TEST_F(TeamEventsTest, ReportsLostRobotsAndTheirReturn) {
  robots[1].news.is_up = false;
  robots[1].news.problem = "no robot answers";
  const auto down = events.news(robots);
  ASSERT_EQ(down.size(), 1u);
  EXPECT_EQ(down[0].kind, Kind::down);
  EXPECT_EQ(down[0].text, "Bob is down.");
  EXPECT_EQ(down[0].detail, "no robot answers");
  EXPECT_EQ(down[0].line(), "Bob is down: no robot answers");
  robots[1].news.is_up = true;
  EXPECT_EQ(eventOf(Kind::up), "Bob is up.");
}

TEST_F(TeamEventsTest, OmitsRobotsThatLeaveAtTheEndOfTheRunAndJoinTheNext) {
  for (auto& robot : robots) {
    robot.news.is_up = false;
    robot.news.is_over = true;
    robot.news.problem = "the run is over";
  }
  EXPECT_TRUE(events.news(robots).empty());
  for (auto& robot : robots) {
    robot.news.is_up = true;
    robot.news.is_over = false;
    robot.news.problem.clear();
  }
  EXPECT_TRUE(events.news(robots).empty());
}

TEST_F(TeamEventsTest, ReportsTheResultOfCheckWin) {
  robots[0].news.state.set_win_refusals(robots[0].news.state.win_refusals() + 1);
  EXPECT_EQ(eventOf(Kind::too_far), "Ann is too far from the gold to have won.");
  for (auto& robot : robots) robot.news.state.set_winner("Ann");
  EXPECT_EQ(eventOf(Kind::won), "Ann has won");
}

}  // namespace
}  // namespace robosim
