// ConsoleSession: the control lock, driving, switching, and events of the team.
#include <algorithm>

#include <gtest/gtest.h>

#include "console/testing/console_session_fixture.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;

// ---- Control lock ----

TEST_F(ConsoleSessionTest, GivesTheControlLockToOnePageAtATime) {
  const PageId ada = driver("Ada");
  const PageId bea = console.join("", "Bea");
  console.send(bea, R"({"type":"take"})");
  EXPECT_TRUE(received(bea, "Ada drives; you may watch."));
  EXPECT_TRUE(received(bea, R"("control_lock":{"holder":1,"name":"Ada"},"pages":2)"));
  EXPECT_EQ(holder(), ada);
  console.send(ada, R"({"type":"release"})");
  EXPECT_EQ(orders(), "Ann stop: Ada has released control");
  console.send(bea, R"({"type":"take"})");
  EXPECT_EQ(holder(), bea);
  EXPECT_EQ(console.row.front().news.state.driver(), "Bea");
}

TEST_F(ConsoleSessionTest, IgnoresDrivingMessagesOfPagesWithoutTheControlLock) {
  const PageId ada = driver();
  const PageId mallory = console.join("", "Mallory");
  for (const auto& row : pageMessageRows()) {
    if (row.page != PageMessageRow::Page::holds_lock) continue;
    console.send(mallory, std::string(R"({"type":")") + row.name + "\"}");
  }
  console.tick(1s);
  EXPECT_EQ(orders(), "");
  EXPECT_EQ(console.switches, 0u);
  EXPECT_EQ(holder(), ada);
  EXPECT_FALSE(console.row.front().news.state.autonomous() && console.row.front().news.state.driver().empty());
}

TEST_F(ConsoleSessionTest, ReleasesTheControlLockOfAPageThatDisconnects) {
  const PageId ada = driver();
  console.send(ada, R"({"type":"drive","speed":1})");
  console.close(ada);
  EXPECT_EQ(orders(), "Ann drive speed 1, Ann stop: Ada's page has disconnected");
  EXPECT_EQ(holder(), 0u);
}

TEST_F(ConsoleSessionTest, ReleasesTheControlLockOfAPageWithAnInvalidFrame) {
  const PageId ada = driver();
  console.send(ada, R"({"type":"drive","speed":1})");
  console.invalidFrame(ada, "a binary message; messages are text");
  EXPECT_EQ(orders(), "Ann drive speed 1, Ann stop: Ada's page was disconnected");
  EXPECT_EQ(holder(), 0u);
  EXPECT_TRUE(console.page(ada).is_leaving);
  EXPECT_EQ(console.page(ada).why, "a binary message; messages are text");
  EXPECT_TRUE(console.hasLogged("disconnected a page at 127.0.0.1: a binary message"));
}

TEST_F(ConsoleSessionTest, TakingControlAgainClaimsTheRobotAndDiscardsOrders) {
  const PageId ada = driver();
  console.send(ada, R"({"type":"accelerate"})");
  console.send(ada, R"({"type":"drive","speed":1})");  // waits for 10 ms
  console.row.front().news.state.set_driver("");
  console.send(ada, R"({"type":"take"})");
  console.tick(1s);
  EXPECT_EQ(orders(), "Ann accelerate");
  EXPECT_EQ(console.row.front().news.state.driver(), "Ada");
}

TEST_F(ConsoleSessionTokensTest, DeniesTheControlLockToTokensThatDoNotPermitThePrimary) {
  for (const auto& [token, why] :
       {std::pair{kOnlyBob, "Your token is not for Ann."}, {kViewer, "Your token permits watching, not driving."}}) {
    const PageId page = console.join(token);
    console.send(page, R"({"type":"take"})");
    console.send(page, R"({"type":"drive","speed":1})");
    EXPECT_TRUE(received(page, why));
    EXPECT_EQ(holder(), 0u);
  }
  EXPECT_EQ(orders(), "");
}

TEST_F(ConsoleSessionTokensTest, AWeakerTokenEndsControlAndTheOrdersThatWait) {
  const PageId ada = driver("Ada", kAnnAndBob);
  console.send(ada, R"({"type":"accelerate"})");
  console.send(ada, R"({"type":"drive","speed":1})");  // waits for 10 ms
  console.hello(ada, kViewer, "Ada");
  console.tick(1s);
  EXPECT_EQ(orders(), "Ann accelerate, Ann stop: Ada has presented another token");
  EXPECT_EQ(holder(), 0u);
}

// ---- Driving ----

TEST_F(ConsoleSessionTest, ConvertsFractionsToTheRobotsSpeeds) {
  const PageId ada = driver();
  console.send(ada, R"({"type":"drive","speed":0.5,"turn":-0.25})");
  EXPECT_EQ(orders(), "Ann drive speed 0.5 turn -0.5");
}

TEST_F(ConsoleSessionTest, OfManyMessagesSendsTheNewestEveryTenMilliseconds) {
  const PageId ada = driver();
  for (int i = 0; i < 20'000; ++i) console.send(ada, R"({"type":"drive","speed":1,"turn":1})");
  console.send(ada, R"({"type":"drive","speed":0})");
  EXPECT_EQ(orders(), "Ann drive speed 1 turn 2");
  console.tick(10ms);
  EXPECT_EQ(orders(), "Ann drive speed 0 turn 2");
  EXPECT_FALSE(console.page(ada).is_leaving);
}

TEST_F(ConsoleSessionTest, SendsNoMotionAfterAStopUntilTheNextMessage) {
  const PageId ada = driver();
  console.send(ada, R"({"type":"accelerate"})");
  console.send(ada, R"({"type":"drive","speed":1})");  // waits for 10 ms
  console.send(ada, R"({"type":"stop"})");
  for (int i = 0; i < 100; ++i) console.tick(50ms);
  EXPECT_EQ(orders(), "Ann accelerate, Ann stop");
  console.send(ada, R"({"type":"turn_left"})");
  EXPECT_EQ(orders(), "Ann turn_left");
}

TEST_F(ConsoleSessionTest, SendsAliveOnlyWhenThePageDoes) {
  const PageId ada = driver();
  console.send(ada, R"({"type":"drive","speed":1})");
  orders();
  for (int i = 0; i < 100; ++i) console.tick(50ms);
  EXPECT_EQ(orders(), "") << "the robot's dead-man timeout must not be reset by the console";
  console.send(ada, R"({"type":"alive"})");
  EXPECT_EQ(orders(), "Ann alive");
}

TEST_F(ConsoleSessionTest, GivesEachOrderOfTheTableToThePrimary) {
  const PageId ada = driver();
  for (const OrderRow& row : kOrders) {
    console.tick(std::chrono::seconds(1));
    const auto actions = console.session.pageMessage(ada, R"({"type":")" + std::string(row.name) + "\"}", console.now);
    const auto given = std::find_if(actions.begin(), actions.end(), [](const ConsoleAction& action) {
      return std::holds_alternative<SendOrder>(action);
    });
    ASSERT_NE(given, actions.end()) << row.name;
    EXPECT_EQ(typeOf(std::get<SendOrder>(*given).order), row.type) << row.name;
    EXPECT_NO_THROW(validate(std::get<SendOrder>(*given).order)) << row.name;
  }
}

TEST_F(ConsoleSessionTest, NamesThePageInTheReasonOfAStop) {
  const PageId ada = driver();
  console.send(ada, R"({"type":"stop","why":"is hidden"})");
  EXPECT_EQ(orders(), "Ann stop: Ada's page is hidden");
}

TEST_F(ConsoleSessionTest, TheEncodedReasonOfAStopNeverExceedsWhatARobotAccepts) {
  std::string name, reason;
  for (int i = 0; i < 30; ++i) name += "ü";
  for (int i = 0; i < 59; ++i) reason += "é";
  const PageId page = driver(name);
  console.send(page, R"({"type":"stop","why":")" + reason + R"(yz"})");  // 120 bytes
  const v1::ControlRequest message = console.takeOrders().back().order;
  EXPECT_NO_THROW(validate(message));
  // "'s page " is 8 bytes: of the reason 52 bytes remain, which are 26 characters.
  std::string remaining;
  for (int i = 0; i < 26; ++i) remaining += "é";
  EXPECT_EQ(message.stop().why(), name + "'s page " + remaining);
}

TEST_F(ConsoleSessionTest, IgnoresSpeedsForARobotThatWasNeverConnected) {
  console.row.front().news.info = nullptr;
  console.row.front().news.is_up = false;
  console.update();
  const PageId ada = driver();
  console.send(ada, R"({"type":"drive","speed":1})");
  EXPECT_EQ(orders(), "");
}

TEST_F(ConsoleSessionTest, SetsTheRobotAutonomousAndBack) {
  const PageId ada = driver();
  console.send(ada, R"({"type":"accelerate"})");
  console.send(ada, R"({"type":"drive","speed":1})");  // waits for 10 ms
  console.send(ada, R"({"type":"autonomous","on":true})");
  console.tick(1s);
  EXPECT_EQ(orders(), "Ann accelerate") << "the waiting order is discarded";
  EXPECT_TRUE(console.row.front().news.state.autonomous());
  console.send(ada, R"({"type":"autonomous","on":false})");
  EXPECT_FALSE(console.row.front().news.state.autonomous());
  EXPECT_TRUE(console.hasLogged("autonomous on Ann (page of Ada)"));
}

// ---- Switching ----

TEST_F(ConsoleSessionTest, SwitchesToTheNextFitRobotAndStopsSteeringTheOldOne) {
  const PageId ada = driver();
  console.row[1].news.is_up = false;
  console.update();
  console.send(ada, R"({"type":"accelerate"})");
  console.send(ada, R"({"type":"drive","speed":1})");  // waits for 10 ms
  console.send(ada, R"({"type":"switch"})");
  console.tick(1s);
  EXPECT_EQ(orders(), "Ann accelerate");
  EXPECT_EQ(console.primary(), "Cid") << "Bob is down";
  EXPECT_TRUE(console.hasLogged("switch to Cid"));
  console.send(ada, R"({"type":"drive","speed":1})");
  EXPECT_EQ(orders(), "Cid drive speed 1");
}

TEST_F(ConsoleSessionTest, SwitchesToANamedRobot) {
  const PageId ada = driver();
  console.send(ada, R"({"type":"switch","robot":"Cid"})");
  EXPECT_EQ(console.primary(), "Cid");
  console.send(ada, R"({"type":"switch","robot":"Cid"})");
  EXPECT_EQ(console.switches, 1u) << "it is the primary";
  console.send(ada, R"({"type":"switch","robot":"Nemo"})");
  EXPECT_TRUE(received(ada, "Nemo cannot be driven now."));
}

TEST_F(ConsoleSessionTest, KeepsThePrimaryWhenNoOtherRobotIsFit) {
  const PageId ada = driver();
  console.row[1].news.is_up = false;
  console.row[2].news.state.set_driver("another console");
  console.update();
  console.send(ada, R"({"type":"switch"})");
  EXPECT_TRUE(received(ada, "No other robot can be driven now."));
  EXPECT_EQ(console.primary(), "Ann");
}

TEST_F(ConsoleSessionTest, ReportsASwitchThatFailed) {
  const PageId ada = driver();
  console.fails_switches = true;
  console.send(ada, R"({"type":"switch"})");
  EXPECT_TRUE(received(ada, "Bob cannot be driven now."));
  console.send(ada, R"({"type":"drive","speed":1})");
  EXPECT_EQ(orders(), "Ann drive speed 1");
}

TEST_F(ConsoleSessionTest, IgnoresDrivingUntilASwitchIsConfirmed) {
  ConsoleSession session{Access()};
  const ConsoleSession::Time now{1h};
  session.update({console.row, nullptr, 0}, now);
  session.pageOpened(1, "peer", now);
  session.pageMessage(1, R"({"type":"hello","protocol":1})", now);
  session.pageMessage(1, R"({"type":"take"})", now);
  session.update({console.row, nullptr, 0}, now);
  session.pageMessage(1, R"({"type":"switch"})", now);
  EXPECT_TRUE(session.pageMessage(1, R"({"type":"drive","speed":1})", now).empty());
  const auto actions = session.pageMessage(1, R"({"type":"stop"})", now);
  ASSERT_EQ(actions.size(), 1u);
  EXPECT_TRUE(std::get<SendOrder>(actions[0]).order.has_stop());
  session.update({console.row, nullptr, 0}, now);
  EXPECT_EQ(session.pageMessage(1, R"({"type":"drive","speed":1})", now).size(), 1u);
}

TEST_F(ConsoleSessionTokensTest, SwitchesOnlyToRobotsThatTheTokenPermits) {
  const PageId ada = driver("Ada", kAnnAndBob);
  console.send(ada, R"({"type":"switch"})");
  EXPECT_EQ(console.primary(), "Bob");
  console.send(ada, R"({"type":"switch"})");
  EXPECT_EQ(console.primary(), "Ann") << "Cid is next in the queue, and the token is not for Cid";
  console.send(ada, R"({"type":"switch","robot":"Cid"})");
  EXPECT_TRUE(received(ada, "Your token is not for Cid."));
  EXPECT_EQ(holder(), ada) << "it may still drive Ann";
}

TEST_F(ConsoleSessionTokensTest, KeepsThePrimaryWhenTheTokenPermitsNoOtherRobot) {
  const PageId ada = driver("Ada", kOnlyAnn);
  console.send(ada, R"({"type":"switch"})");
  EXPECT_TRUE(received(ada, "No other robot can be driven now."));
  EXPECT_EQ(console.primary(), "Ann");
}

// ---- The team: lost links, the end of a run, the winner ----

TEST_F(ConsoleSessionTest, ReportsALostRobotAndItsReturnToAllPages) {
  const PageId ada = driver();
  const PageId bea = console.join("", "Bea");
  console.row[1].news.is_up = false;
  console.row[1].news.problem = "no robot answers";
  console.update();
  console.row[1].news.is_up = true;
  console.update();
  for (const PageId page : {ada, bea}) {
    EXPECT_TRUE(received(page, R"("text":"Bob is down.","warning":true,"detail":"no robot answers")"));
    EXPECT_TRUE(received(page, "Bob is up."));
  }
}

TEST_F(ConsoleSessionTest, KeepsTheControlLockWhenThePrimaryIsLost) {
  const PageId ada = driver();
  console.row.front().news.is_up = false;
  console.row.front().news.is_over = true;
  console.row.front().news.problem = "the run is over";
  console.update();
  EXPECT_TRUE(received(
      ada,
      R"("name":"Ann","address":"127.0.0.1:9","model":"fake","up":false,"over":true,"problem":"the run is over")"));
  EXPECT_EQ(holder(), ada);
  console.send(ada, R"({"type":"switch"})");
  EXPECT_EQ(console.primary(), "Bob");
}

TEST_F(ConsoleSessionTest, ReportsTheWinnerOnceAndCheckWinThatFailed) {
  const PageId ada = driver();
  console.send(ada, R"({"type":"check_win"})");
  EXPECT_EQ(orders(), "Ann check_win");
  EXPECT_TRUE(console.hasLogged("check_win Ann (page of Ada)"));
  console.row.front().news.state.set_win_refusals(console.row.front().news.state.win_refusals() + 1);
  console.update();
  EXPECT_TRUE(received(ada, "Ann is too far from the gold to have won."));
  for (auto& robot : console.row) robot.news.state.set_winner("Ann");
  console.update();
  console.update();
  EXPECT_TRUE(received(ada, R"("winner":"Ann")"));
  EXPECT_EQ(std::count(console.log.begin(), console.log.end(), "Ann has won"), 1);
}

TEST_F(ConsoleSessionTest, StartsTheNextRunOnceAfterTheEndOfTheCurrentOne) {
  const PageId ada = driver();
  console.send(ada, R"({"type":"play_again"})");
  EXPECT_EQ(console.restarts, 0u) << "the run is not over";
  console.run.phase = RunView::Phase::ended;
  console.run.may_restart = true;
  console.update();
  EXPECT_TRUE(received(ada, R"("phase":"ended","problem":"","absent":[],"may_restart":true,"is_restarting":false,)"));
  const PageId bea = console.join("", "Bea");
  console.send(bea, R"({"type":"play_again"})");
  EXPECT_EQ(console.restarts, 0u) << "without the control lock";
  console.send(ada, R"({"type":"play_again"})");
  console.run.is_restarting = true;
  console.update();
  console.send(ada, R"({"type":"play_again"})");
  EXPECT_EQ(console.restarts, 1u);
  EXPECT_TRUE(console.hasLogged("play again (page of Ada)"));
  console.run.is_restarting = false;
  console.run.restart_problem = "the world is invalid";
  console.update();
  for (const PageId page : {ada, bea}) {
    EXPECT_TRUE(
        received(page, R"("The next run could not be started.","warning":true,"detail":"the world is invalid")"));
  }
}

TEST_F(ConsoleSessionTokensTest, StartsTheNextRunOnlyForOperators) {
  console.run.may_restart = true;
  console.update();
  const PageId ada = driver("Ada", kAnnAndBob);
  EXPECT_TRUE(received(ada, R"("may_operate":false)"));
  console.send(ada, R"({"type":"play_again"})");
  EXPECT_TRUE(received(ada, "Your token does not permit starting a run."));
  EXPECT_EQ(console.restarts, 0u);
  EXPECT_EQ(holder(), ada) << "it may still drive";
  console.send(ada, R"({"type":"release"})");
  const PageId olga = driver("Olga", kOperator);
  EXPECT_TRUE(received(olga, R"("may_operate":true)"));
  console.send(olga, R"({"type":"play_again"})");
  EXPECT_EQ(console.restarts, 1u);
}

TEST_F(ConsoleSessionTest, OfTeamsThatAreUpReportsTheWinnerOfTheirRunOnly) {
  const PageId ada = driver();
  for (auto& robot : console.row) {
    robot.news.state.set_winner("Ann");
    robot.news.is_up = false;  // the run is over
  }
  console.update();
  EXPECT_TRUE(received(ada, R"("winner":"Ann")"));
  console.row[1].news.state.clear_winner();
  console.row[1].news.is_up = true;  // in the next run
  console.update();
  console.read(ada);
  EXPECT_NE(console.page(ada).texts.back().find(R"("winner":"")"), std::string::npos);
}

TEST_F(ConsoleSessionTest, ReportsTheEndOfTheRunOnceHoweverItIsObserved) {
  const PageId ada = driver();
  const auto reports = [&] {
    console.read(ada);
    return console.page(ada).countOf("The run is over.");
  };
  console.run.phase = RunView::Phase::ended;
  console.update();
  EXPECT_EQ(reports(), 1u);
  for (auto& robot : console.row) {  // its programs end, too
    robot.news.is_up = false;
    robot.news.is_over = true;
  }
  console.update();
  EXPECT_EQ(reports(), 1u);
  EXPECT_EQ(console.page(ada).countOf("is down"), 0u);
  for (auto& robot : console.row) {
    robot.news.is_up = true;
    robot.news.is_over = false;
  }
  console.run.phase = RunView::Phase::running;  // the next run
  console.update();
  for (auto& robot : console.row) robot.news.is_over = true;  // seen by the robots first
  console.update();
  EXPECT_EQ(reports(), 2u);
}

TEST_F(ConsoleSessionTest, ShowsAnotherDriverOfTheRobot) {
  const PageId ada = console.join();
  console.row.front().news.state.set_driver("another console");
  console.update();
  EXPECT_TRUE(received(ada, R"("driver":"another console","is_yours":false)"));
}

TEST_F(ConsoleSessionTest, SendsARequestedReadingToAllPages) {
  const PageId ada = console.join();
  const PageId bea = console.join();
  for (const char* sensor : {"heat", "laser", "sonar"}) {
    console.send(bea, std::string(R"({"type":"req_)") + sensor + "\"}");
    for (const PageId page : {ada, bea}) {
      EXPECT_TRUE(received(page, std::string(R"({"type":"answer","sensor":")") + sensor)) << sensor;
    }
  }
}

TEST_F(ConsoleSessionTest, SendsAnAnswerOnceThoughItsRobotBecomesThePrimaryAgain) {
  const PageId ada = driver();
  const auto answers = [&] {
    console.read(ada);
    return console.page(ada).countOf(R"("type":"answer")");
  };
  console.send(ada, R"({"type":"req_heat"})");
  EXPECT_EQ(answers(), 1u);
  for (const char* robot : {"Bob", "Ann"})
    console.send(ada, std::string(R"({"type":"switch","robot":")") + robot + "\"}");
  EXPECT_EQ(console.primary(), "Ann");
  EXPECT_EQ(answers(), 1u);
  console.send(ada, R"({"type":"req_heat"})");
  EXPECT_EQ(answers(), 2u);
}

}  // namespace
}  // namespace robosim
