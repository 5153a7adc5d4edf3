// ConsoleSession: admission of pages, malformed messages, the map, and bounded outboxes.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "base/temporary_directory.h"
#include "console/testing/console_session_fixture.h"
#include "console/testing/one_robot_map.h"

namespace robosim {
namespace {

using namespace std::chrono_literals;

// ---- Admission ----

TEST_F(ConsoleSessionTest, WelcomesAPageAndSendsTheTeam) {
  const PageId page = console.join("", "Ada");
  EXPECT_TRUE(received(page, R"({"type":"welcome","you":1,"may_operate":true,"has_rounds":false})"));
  EXPECT_TRUE(received(page, R"("control_lock":{"holder":0,"name":""},"pages":1)"));
  EXPECT_TRUE(received(page, R"({"type":"robot","name":"Ann")"));
}

TEST_F(ConsoleSessionTest, RepliesToAPing) {
  const PageId ada = console.join("", "Ada");
  console.send(ada, R"({"type":"ping","number":12})");
  EXPECT_TRUE(received(ada, R"({"type":"pong","number":12})"));
}

TEST_F(ConsoleSessionTest, SendsHeatAndStallAtMostOncePerSecond) {
  const PageId ada = console.join("", "Ada");
  console.tick(1s);
  console.row.back().news.state.set_stalled(true);
  console.tick(900ms);
  EXPECT_FALSE(received(ada, R"("stalled":true)"));
  console.tick(100ms);
  EXPECT_TRUE(received(ada, R"("stalled":true)"));
}

TEST_F(ConsoleSessionTest, SendsNothingBeforeTheHello) {
  const PageId page = console.open();
  console.step();
  EXPECT_EQ(console.read(page), 0u);
}

TEST_F(ConsoleSessionTest, DisconnectsAPageWithoutAHelloAfterTenSeconds) {
  const PageId page = console.open();
  console.tick(10s);
  EXPECT_FALSE(console.page(page).is_leaving);
  console.tick(1ms);
  EXPECT_EQ(console.page(page).why, "no hello within 10 s; the first message must be a hello, sent at once");
}

TEST_F(ConsoleSessionTest, DisconnectsTheOldestOf129PagesWithoutAHello) {
  const PageId admitted = console.join();
  std::vector<PageId> silent;
  for (int i = 0; i < 128; ++i) silent.push_back(console.open());
  EXPECT_FALSE(console.page(silent[0]).is_leaving);
  const PageId newest = console.join();
  EXPECT_TRUE(console.page(silent[0]).is_leaving);
  EXPECT_FALSE(console.page(silent[1]).is_leaving);
  EXPECT_FALSE(console.page(admitted).is_leaving);
  EXPECT_TRUE(received(newest, "welcome"));
}

TEST_F(ConsoleSessionTest, ASecondHelloChangesTheName) {
  const PageId page = console.join("", "Ada");
  console.hello(page, "", "Bea");
  console.send(page, R"({"type":"take"})");
  EXPECT_TRUE(received(page, R"("name":"Bea"},"pages")"));
  EXPECT_EQ(console.page(page).countOf("welcome"), 2u);
}

TEST_F(ConsoleSessionTokensTest, RefusesAPageWithoutAValidToken) {
  for (const auto& [token, why] : {std::pair{"", "This console requires a token."},
                                   {"wrong-0123456789abcdef", "The token is unknown or has expired."}}) {
    const PageId page = console.join(token);
    EXPECT_TRUE(received(page, std::string(R"({"type":"refused","text":")") + why));
    EXPECT_EQ(console.page(page).texts.size(), 1u) << "it receives nothing else";
    EXPECT_EQ(console.page(page).why, why);
  }
  EXPECT_FALSE(console.hasLogged("0123456789abcdef")) << "no log contains a token";
}

TEST_F(ConsoleSessionTokensTest, DisconnectsAnAddressThatGuessesTokens) {
  PageId last = 0;
  for (int i = 0; i < 100; ++i) last = console.join("wrong-0123456789abcdef" + std::to_string(i));
  EXPECT_NE(console.page(last).why.find("too many wrong tokens"), std::string::npos) << console.page(last).why;
  EXPECT_EQ(console.read(last), 0u) << "no refusal: the page reconnects by itself";
}

TEST_F(ConsoleSessionTokensTest, RevokesAnExpiredToken) {
  const PageId driver = this->driver("Ada", kOneDay);
  const PageId viewer = console.join(kViewer);
  console.send(driver, R"({"type":"drive","speed":1})");
  orders();
  for (int i = 0; i < 23 * 60; ++i) {  // both pages acknowledge nothing, and receive no updates
    console.tick(1min);
    ASSERT_EQ(console.page(driver).is_leaving, i + 1 == 23 * 60) << i;
  }
  EXPECT_EQ(orders(), "Ann stop: Ada's token is no longer valid");
  EXPECT_TRUE(received(driver, R"({"type":"refused","text":"Your token is no longer valid."})"));
  EXPECT_FALSE(console.page(viewer).is_leaving);
  EXPECT_EQ(holder(), 0u);
}

TEST_F(ConsoleSessionTest, SendsNoStateToAPageThatIsBeingDisconnected) {
  const PageId page = console.join();
  console.read(page);
  console.send(page, R"({"type":"fly"})");
  console.join();
  console.step();
  EXPECT_EQ(console.read(page), 0u);
}

TEST_F(ConsoleSessionTest, ATokenThatNoLongerPermitsThePrimaryEndsControl) {
  const TemporaryDirectory folder;
  const auto file = folder / "tokens";
  const auto write = [&](const std::string& robot) {
    std::ofstream(file) << kOnlyAnn << " robot " << robot << "\n";
    std::filesystem::permissions(file, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  };
  write("Ann");
  Access::Options options;
  options.is_reload_requested = [] { return true; };
  const Access access = Access::read(file, options);
  ConsoleSession session(access);
  const ConsoleSession::Time now{1h};
  session.update({console.row, nullptr, access.refresh()}, now);
  session.pageOpened(1, "peer", now);
  session.pageMessage(1, std::string(R"({"type":"hello","protocol":1,"token":")") + kOnlyAnn + "\"}", now);
  session.pageMessage(1, R"({"type":"take"})", now);
  session.update({console.row, nullptr, access.refresh()}, now);
  EXPECT_EQ(session.lockHolder(), 1u);
  write("Bob");
  const auto actions = session.update({console.row, nullptr, access.refresh()}, now);
  EXPECT_EQ(session.lockHolder(), 0u);
  const auto stop = std::find_if(actions.begin(), actions.end(),
                                 [](const auto& action) { return std::holds_alternative<SendOrder>(action); });
  ASSERT_NE(stop, actions.end());
  EXPECT_EQ(std::get<SendOrder>(*stop).order.stop().why(), "Page 1's token no longer permits driving");
}

TEST(ConsoleSessionBeforeUpdate, SendsNoTeam) {
  ConsoleSession session{Access()};
  const ConsoleSession::Time now{1h};
  session.pageOpened(1, "peer", now);
  session.pageMessage(1, R"({"type":"hello","protocol":1})", now);
  EXPECT_EQ(session.nextMessage(1, now)->bytes(),
            R"({"type":"welcome","you":1,"may_operate":true,"has_rounds":false})");
  EXPECT_EQ(session.nextMessage(1, now), nullptr);
}

// ---- Malformed messages ----

TEST_F(ConsoleSessionTest, DisconnectsAPageForAMalformedMessageAndNoOther) {
  const PageId driver = this->driver();
  const std::string hello = R"({"type":"hello","protocol":1,"name":"Mallory"})";
  for (const auto& [messages, why] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"hello"}, "a message that is not a JSON object"},
           {{""}, "a message that is not a JSON object"},
           {{"\xff\xfe"}, "a message that is not a JSON object"},
           {{std::string(4000, '[')}, "a message that is not a JSON object"},
           {{R"({"type":"take"})"}, "the first message of a page must be its hello"},
           {{R"({"type":"hello","protocol":2})"}, "version"},
           {{R"({"type":"hello","protocol":1,"name":"a\nb"})"}, "'name' with control characters"},
           {{hello, R"({"type":"fly"})"}, "a message without a known type"},
           {{hello, R"({"type":"take","by":"force"})"}, "which it does not have"},
           {{hello, R"({"type":"drive","speed":1e999})"}, "a message that is not a JSON object"},
           {{hello, R"({"type":"drive","speed":null})"}, "'speed' must be a finite number"},
           {{hello, R"({"type":"ack","number":1000000000})"}, "an ack for an update that was not sent"},
       }) {
    const PageId mallory = console.open();
    for (const auto& message : messages) console.send(mallory, message);
    EXPECT_NE(console.page(mallory).why.find(why), std::string::npos) << console.page(mallory).why;
    EXPECT_TRUE(console.hasLogged("disconnected a page at 127.0.0.1: " + console.page(mallory).why));
    console.send(mallory, R"({"type":"stop"})");  // no effect
    console.close(mallory);
  }
  EXPECT_FALSE(console.page(driver).is_leaving);
  EXPECT_EQ(orders(), "");
  console.send(driver, R"({"type":"drive","speed":1})");
  EXPECT_EQ(orders(), "Ann drive speed 1");
}

TEST_F(ConsoleSessionTest, StopsTheRobotOfADriverThatIsDisconnectedForAMalformedMessage) {
  const PageId driver = this->driver();
  console.send(driver, R"({"type":"drive","speed":1})");
  console.send(driver, "nonsense");
  EXPECT_EQ(orders(), "Ann drive speed 1, Ann stop: Ada's page was disconnected");
  EXPECT_EQ(holder(), 0u);
}

// ---- The map ----

TEST_F(ConsoleSessionTokensTest, ShowsTruePosesOnlyToTokensThatMayWatch) {
  console.map = oneRobotMap();
  for (const char* token : {kAnnAndBob, kOnlyBob}) {
    const PageId page = console.join(token);
    console.send(page, R"({"type":"map","on":true})");
    console.tick(1s);
    EXPECT_TRUE(received(page, "Your token does not permit the map"));
    EXPECT_FALSE(received(page, "12.25")) << "a true pose";
    EXPECT_FALSE(console.is_map_watched);
  }
  for (const char* token : {kViewer, kOperator}) {
    const PageId page = console.join(token);
    console.send(page, R"({"type":"map","on":true})");
    console.tick(1s);
    EXPECT_TRUE(received(page, "12.25"));
    console.close(page);
    EXPECT_FALSE(console.is_map_watched) << "the last page that showed it has disconnected";
  }
}

TEST_F(ConsoleSessionTokensTest, ATokenThatMayNotWatchEndsTheMap) {
  const PageId page = console.join(kOperator);
  console.send(page, R"({"type":"map","on":true})");
  EXPECT_TRUE(console.is_map_watched);
  console.hello(page, kAnnAndBob);
  EXPECT_FALSE(console.is_map_watched);
}

// ---- Bounded outboxes ----

TEST_F(ConsoleSessionTokensTest, DisconnectsAPageThatCausesRepliesAndReadsNone) {
  for (const std::string message : {R"({"type":"take"})", R"({"type":"hello","protocol":1,"name":"Mallory"})"}) {
    const PageId ada = driver("Ada", kAnnAndBob);
    const PageId mallory = console.join(kViewer, "Mallory");
    for (int i = 0; i < 20'000; ++i) console.send(mallory, message);
    EXPECT_EQ(console.page(mallory).why, "too many messages whose replies were not read; wait for each reply");
    EXPECT_EQ(console.session.outboxOf(mallory)->queued(), PageOutbox::kMaxQueued);
    EXPECT_FALSE(console.page(ada).is_leaving);
    console.close(ada);
  }
}

TEST_F(ConsoleSessionTest, KeepsAPageThatOthersFloodWithNotes) {
  const PageId slow = console.join();
  const PageId mallory = console.join();
  for (int i = 0; i < 1000; ++i) {
    console.send(mallory, R"({"type":"req_heat"})");
    console.read(mallory);
  }
  EXPECT_FALSE(console.page(slow).is_leaving);
  EXPECT_EQ(console.session.outboxOf(slow)->queued(), PageOutbox::kMaxNotes);
}

TEST_F(ConsoleSessionTest, DisconnectsAPageThatAcknowledgesNoUpdateForSixSeconds) {
  const PageId ada = driver();
  const PageId slow = console.join();
  for (int i = 0; i < 61; ++i) {
    console.tick(100ms);
    console.step();
    console.read(slow);
    console.read(ada);
    console.acknowledge(ada);
    EXPECT_FALSE(console.page(slow).is_leaving) << i;
  }
  console.tick(100ms);
  EXPECT_EQ(console.page(slow).why, "no update acknowledged for 6 s");
  EXPECT_EQ(console.page(slow).updates, 3u);
  EXPECT_EQ(console.page(ada).updates, 61u);
  EXPECT_FALSE(console.page(ada).is_leaving);
}

TEST_F(ConsoleSessionTest, ASlowDriverThatIsDisconnectedLosesTheControlLock) {
  const PageId ada = driver();
  console.step();
  console.read(ada);
  console.tick(6001ms);
  EXPECT_TRUE(console.page(ada).is_leaving);
  EXPECT_EQ(orders(), "Ann stop: Ada's page was disconnected");
}

TEST_F(ConsoleSessionTest, SendsOnlyTheNewestPictureToASlowPage) {
  const PageId page = console.join();
  for (int i = 0; i < 100; ++i) {
    console.tick(50ms);
    console.step("picture");
  }
  console.read(page);
  EXPECT_EQ(console.page(page).pictures, 1u);
  EXPECT_LE(console.session.outboxOf(page)->queued(), 1u);
}

TEST_F(ConsoleSessionTest, WakesTheHolderOfTheControlLockFirst) {
  console.join();
  const PageId ada = driver();
  console.join();
  auto update = std::make_shared<RobotUpdate>();
  update->readings = blankReadings(*console.row.front().news.info->sensors);
  console.row.front().news.update = update;
  const auto actions = console.session.update({console.row, nullptr, 0}, console.now);
  ASSERT_GE(actions.size(), 3u);
  EXPECT_EQ(std::get<WakePage>(actions[0]).page, ada);
}

}  // namespace
}  // namespace robosim
