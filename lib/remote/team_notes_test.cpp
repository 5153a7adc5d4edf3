#include "remote/team_notes.h"

#include <gtest/gtest.h>

namespace robosim {
namespace {

using Kind = TeamNotes::Kind;

struct TeamNotesTest : testing::Test {
  TeamNotesTest() {
    for (const char* name : {"Ann", "Bob"}) {
      robots.push_back({name, "localhost:9001", {}});
      robots.back().news.is_up = true;
    }
    notes.news(robots);
  }

  /// The only news, or an empty text.
  std::string told(Kind kind) {
    const auto news = notes.news(robots);
    return news.size() == 1 && news[0].kind == kind ? news[0].text : "";
  }

  std::vector<RemoteControl::Robot> robots;  ///< Ann is the primary
  TeamNotes notes;
};

TEST_F(TeamNotesTest, TellsEverythingOnce) {
  robots[0].news.state.why_stopped = "nothing heard from Ada for 0.5 s";
  EXPECT_EQ(told(Kind::stopped), "Ann stopped: nothing heard from Ada for 0.5 s.");
  EXPECT_TRUE(notes.news(robots).empty());
  robots[0].news.state.why_stopped = "";
  EXPECT_TRUE(notes.news(robots).empty()) << "that it goes on one can see";
}

TEST_F(TeamNotesTest, TellsWhoIsDownAndUpAgain) {
  robots[1].news.is_up = false;
  robots[1].news.problem = "no robot answers";
  EXPECT_EQ(told(Kind::down), "Bob is down: no robot answers");
  robots[1].news.is_up = true;
  EXPECT_EQ(told(Kind::up), "Bob is up.");
}

TEST_F(TeamNotesTest, TellsHowAskingForTheWinEnded) {
  ++robots[0].news.state.win_refusals;
  EXPECT_EQ(told(Kind::too_far), "Ann is too far from the gold to have won.");
  for (auto& robot : robots) robot.news.state.winner = "Ann";
  EXPECT_EQ(told(Kind::won), "Ann has won");
}

}  // namespace
}  // namespace robosim
