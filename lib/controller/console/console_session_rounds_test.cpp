// ConsoleSession: rounds of visitors, and results of the day.
#include <gtest/gtest.h>

#include "console/testing/console_session_fixture.h"

namespace robosim {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// Rounds of 60 s, with the tokens kTokens.
struct ConsoleRoundsTest : testing::Test {
  ConsoleHarness console{
      kTokens, {"Ann", "Bob", "Cid"}, Rounds::Options{.length = seconds(60), .teams = {"Red", "Blue"}}};

  ConsoleRoundsTest() {
    console.run.phase = RunView::Phase::running;
    console.run.may_replace = true;
    console.step();
  }
  PageId visitor(const std::string& name, const std::string& token = kOnlyAnn) {
    const PageId page = console.join(token, name);
    console.send(page, R"({"type":"join","name":")" + name + R"(","team":"Red"})");
    return page;
  }
  /// The run is replaced, as the round that begins requires.
  void replaceRun() {
    console.tick(milliseconds(50));
    RobotNews& robot = console.row.front().news;
    EXPECT_FALSE(robot.is_up) << "it leaves the previous run";
    console.tick(milliseconds(50));
    robot.is_up = true;
    robot.state.clear_winner();
    console.run.phase = RunView::Phase::running;
    console.run.may_restart = false;
    console.run.may_replace = true;
    console.tick(milliseconds(50));
    EXPECT_GT(console.resumptions, 0u);
    console.step();
  }
  /// Time in which the pages acknowledge their updates.
  void wait(int time_s) {
    for (int i = 0; i < time_s; ++i) {
      for (auto& [id, page] : console.pages) {
        if (page.is_leaving) continue;
        console.read(id);
        console.acknowledge(id);
      }
      console.tick(seconds(1));
    }
  }
  void win() {
    console.row.front().news.state.set_winner("Ann");
    console.run.phase = RunView::Phase::ended;
    console.run.may_restart = true;
    console.run.may_replace = false;
    console.step();
  }
  bool received(PageId page, std::string_view text) {
    console.read(page);
    return console.page(page).has(text);
  }
  PageId holder() const { return console.session.lockHolder(); }
  bool isAutonomous() const { return console.row.front().news.state.autonomous(); }
};

TEST_F(ConsoleRoundsTest, GivesTheControlLockToVisitorsInTurn) {
  const PageId ada = visitor("Ada");
  const PageId bea = visitor("Bea");
  replaceRun();
  EXPECT_EQ(console.restarts, 1u);
  EXPECT_EQ(holder(), ada);
  EXPECT_TRUE(received(bea, R"("queue":[{"page":2,"name":"Bea","team":"Red"}])"));
  console.takeOrders();
  wait(60);
  EXPECT_EQ(holder(), 0u);
  const auto orders = console.takeOrders();
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_EQ(textOf(orders[0].order), "stop: Ada's round is over");
  wait(12);
  EXPECT_TRUE(received(bea, R"("phase":"called")"));
  console.send(bea, R"({"type":"start"})");
  replaceRun();
  EXPECT_EQ(holder(), bea);
}

TEST_F(ConsoleRoundsTest, ListsTheWinsOfTheDayAndStoresThem) {
  const PageId ada = visitor("Ada");
  replaceRun();
  win();
  EXPECT_EQ(holder(), 0u);
  EXPECT_TRUE(
      received(ada, R"("name":"Ada","team":"Red","number":1,"won":true,"time_s":0.1,"distance_m":null,"rank":1)"));
  EXPECT_NE(console.saved.find(R"("name": "Ada")"), std::string::npos) << console.saved;
  console.today = "2027-01-02";
  console.tick(seconds(1));
  EXPECT_TRUE(received(ada, R"("best":[],"standings":[])"));
}

TEST_F(ConsoleRoundsTest, TheRobotExploresBetweenRoundsUntilTheNextVisitorHasControl) {
  console.row.front().news.state.set_autonomous(false);
  console.row.front().news.state.set_activity(v1::ACTIVITY_ACTIVE);
  console.row.front().news.state.set_is_yours(true);
  wait(4);
  EXPECT_FALSE(isAutonomous());
  wait(2);
  EXPECT_TRUE(isAutonomous());
  visitor("Ada");
  replaceRun();
  EXPECT_NE(holder(), 0u);
}

TEST_F(ConsoleRoundsTest, ARobotThatAVisitorHasStoppedStandsUntilAVisitorJoins) {
  RobotNews& robot = console.row.front().news;
  robot.state.set_activity(v1::ACTIVITY_ACTIVE);
  robot.state.set_is_yours(true);
  const PageId ada = visitor("Ada");
  replaceRun();
  console.send(ada, R"({"type":"stop"})");
  console.send(ada, R"({"type":"leave"})");
  robot.state.set_autonomous(false);
  wait(60);
  EXPECT_FALSE(isAutonomous());
  visitor("Bea");
  console.send(console.pages.rbegin()->first, R"({"type":"leave"})");
  wait(10);
  EXPECT_TRUE(isAutonomous());
}

TEST_F(ConsoleRoundsTest, AfterAWinTheRobotExploresInANewRun) {
  visitor("Ada");
  replaceRun();
  win();
  wait(12);  // the result is displayed
  wait(4);
  EXPECT_EQ(console.restarts, 1u);
  wait(1);
  EXPECT_EQ(console.restarts, 2u);
}

TEST_F(ConsoleRoundsTest, APageThatLeavesOrDisconnectsEndsItsRoundAndTheRobotStops) {
  const PageId ada = visitor("Ada");
  const PageId bea = visitor("Bea");
  replaceRun();
  console.takeOrders();
  console.close(ada);
  const auto orders = console.takeOrders();
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_TRUE(orders[0].order.has_stop());
  console.tick();
  EXPECT_TRUE(received(bea, R"("phase":"called")"));
  console.send(bea, R"({"type":"leave"})");
  console.tick();
  EXPECT_TRUE(received(console.join(kViewer), R"("phase":"idle")"));
}

TEST_F(ConsoleRoundsTest, AVisitorMayDoNoMoreThanADriver) {
  const PageId viewer = visitor("Vic", kViewer);
  EXPECT_TRUE(received(viewer, "Your token permits watching, not driving."));
  const PageId ada = visitor("Ada");
  replaceRun();
  ASSERT_EQ(holder(), ada);
  console.send(ada, R"({"type":"skip"})");
  EXPECT_TRUE(received(ada, "Your token does not permit ending a round."));
  const PageId both = console.join(kAnnAndBob, "Bo");
  console.send(both, R"({"type":"take"})");
  EXPECT_TRUE(received(both, "Visitors drive in turn"));
  console.send(ada, R"({"type":"switch"})");
  console.send(ada, R"({"type":"play_again"})");
  console.tick();
  EXPECT_EQ(console.primary(), "Ann");
  EXPECT_EQ(console.restarts, 1u);
  EXPECT_EQ(holder(), ada);
}

TEST_F(ConsoleRoundsTest, AnOperatorEndsARound) {
  visitor("Ada");
  replaceRun();
  const PageId olga = console.join(kOperator, "Olga");
  console.send(olga, R"({"type":"skip"})");
  console.tick(milliseconds(50));
  EXPECT_EQ(holder(), 0u);
  EXPECT_TRUE(console.hasLogged("skip (page of Olga)"));
}

TEST_F(ConsoleRoundsTest, DisconnectsAPageThatInventsATeam) {
  const PageId ada = console.join(kOnlyAnn, "Ada");
  console.send(ada, R"({"type":"join","name":"Ada","team":"Pink"})");
  EXPECT_EQ(console.page(ada).why, "a team that this console does not offer");
}

TEST_F(ConsoleSessionTest, WithoutRoundsTheWinOfTheDriverIsListedOnce) {
  const PageId ada = driver();
  for (int i = 0; i < 3; ++i) {
    console.row.front().news.state.set_winner("Ann");
    console.step();
  }
  EXPECT_TRUE(received(ada, R"("rounds":null,"result":{"page":1,"name":"Ada","team":"","number":1,"won":true)"));
  EXPECT_FALSE(received(ada, R"("number":2)"));
  console.send(ada, R"({"type":"join"})");
  console.send(ada, R"({"type":"leave"})");
  EXPECT_EQ(holder(), ada) << "there are no rounds";
}

TEST_F(ConsoleSessionTest, WithoutRoundsAnotherRobotsWinIsNotListed) {
  const PageId ada = driver();
  console.row.front().news.state.set_winner("Bob");
  console.step();
  EXPECT_TRUE(received(ada, R"("result":null,"best":[])"));
}

}  // namespace
}  // namespace robosim
