#include "live_page/live_page_hub.h"

#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace robosim {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

const char* const kTokens =
    "viewer-0123456789abcdef viewer\n"
    "operator-0123456789abcdef operator\n"
    "supervisor-0123456789abcdef supervisor name=anna\n"
    "driver-0123456789abcdef robot Ann\n";

struct LivePageHubTest : testing::Test {
  LivePageHub::Clock::time_point now;
  std::string log;
  std::optional<LivePageHub> hub;

  void start(const Access& access = Access::parse(kTokens, "tokens")) {
    hub.emplace(LivePageHub::Options{.access = access,
                                     .log = [this](const std::string& line) { log += line + "\n"; },
                                     .now = [this] { return now; }});
    hub->begin("7", R"({"type":"run","id":"7"})");
    hub->setControl({});
  }
  /// A page that has sent its hello, and the messages that it receives at once.
  std::vector<json> open(PageId page, const std::string& token, const std::string& more = "") {
    hub->pageOpened(page, "192.0.2.7");
    hub->pageText(page, R"({"type":"hello","token":")" + token + "\"" + more + "}");
    return received(page);
  }
  std::vector<json> received(PageId page) {
    std::vector<json> messages;
    while (const auto message = hub->nextMessage(page)) messages.push_back(json::parse(message->bytes()));
    return messages;
  }
  void addMoment(int number) { hub->add({{std::to_string(number), LiveItemKind::moment}}); }
  json answerTo(PageId page, const std::string& text) {
    hub->pageText(page, text);
    const auto messages = received(page);
    return messages.empty() ? json() : messages.back();
  }
};

constexpr const char* kPlace = R"({"type":"place","id":3,"name":"Ann","x":1,"y":2})";

TEST_F(LivePageHubTest, SendsTheRunSoFarToAPageThatIsOpenedLater) {
  start();
  for (int i = 1; i <= 200; ++i) addMoment(i);
  const auto messages = open(1, "viewer-0123456789abcdef");
  ASSERT_EQ(messages.size(), 3U);
  EXPECT_EQ(messages[0]["type"], "run");
  EXPECT_EQ(messages[1]["type"], "control");
  EXPECT_EQ(messages[2]["items"].size(), 200U);
  EXPECT_EQ(messages[2]["is_present"], true);
}

TEST_F(LivePageHubTest, SendsNothingToAPageWithoutAToken) {
  start();
  hub->pageOpened(1, "192.0.2.7");
  EXPECT_TRUE(received(1).empty());
  EXPECT_TRUE(hub->waitingPages().empty());
  hub->pageText(1, R"({"type":"hello"})");
  const auto messages = received(1);
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(messages[0]["type"], "refused");
  EXPECT_EQ(messages[0]["text"], "This run requires a token; enter yours.");
  EXPECT_EQ(hub->takeLeaving().size(), 1U);
}

TEST_F(LivePageHubTest, SharesOneMessageAmongPagesThatAreAtTheSameItem) {
  start();
  for (const PageId page : {1, 2}) open(page, "viewer-0123456789abcdef");
  addMoment(1);
  const WebMessagePtr message = hub->nextMessage(1);
  ASSERT_TRUE(message);
  EXPECT_EQ(hub->nextMessage(2), message);
  addMoment(2);
  EXPECT_NE(hub->nextMessage(1), message);
}

TEST_F(LivePageHubTest, RefusesTokensThatDoNotPermitWatching) {
  start();
  const auto messages = open(1, "driver-0123456789abcdef");
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(messages[0]["type"], "refused");
  EXPECT_NE(log.find("refused a live page at 192.0.2.7"), std::string::npos);
  EXPECT_EQ(log.find("0123456789abcdef"), std::string::npos) << "no log contains a token";
}

TEST_F(LivePageHubTest, DisconnectsAPageThatSendsNoHello) {
  start();
  hub->pageOpened(1, "192.0.2.7");
  now += LivePageHub::kHelloWithin;
  hub->tick();
  EXPECT_TRUE(hub->takeLeaving().empty());
  now += 1ms;
  hub->tick();
  ASSERT_EQ(hub->takeLeaving().size(), 1U);
}

TEST_F(LivePageHubTest, LetsSupervisorsOnlyPlaceAndOperatorsPause) {
  start();
  for (const auto& [token, may_place, may_pause] :
       {std::tuple("viewer", false, false), std::tuple("operator", false, true),
        std::tuple("supervisor", true, false)}) {
    const PageId page = 1;
    open(page, std::string(token) + "-0123456789abcdef");
    const json place = answerTo(page, kPlace);
    const json pause = answerTo(page, R"({"type":"pause","id":4,"on":true})");
    const auto requests = hub->takeRequests();
    EXPECT_EQ(requests.size(), (may_place ? 1U : 0U) + (may_pause ? 1U : 0U)) << token;
    if (!may_place) {
      EXPECT_EQ(place["id"], 3);
      EXPECT_NE(place["fault"].get<std::string>().find("role"), std::string::npos) << place;
    } else {
      ASSERT_FALSE(requests.empty());
      EXPECT_EQ(requests[0].author, "anna");
      EXPECT_EQ(std::get<PlaceBody>(requests[0].action), (PlaceBody{"Ann", 1, 2}));
      EXPECT_NE(log.find("anna (192.0.2.7): supervise"), std::string::npos) << log;
      hub->answer(requests[0], "it touches a wall");
      EXPECT_EQ(received(page).back()["fault"], "it touches a wall");
    }
    if (!may_pause) {
      EXPECT_FALSE(pause["fault"].get<std::string>().empty()) << token;
    }
    hub->pageClosed(page);
  }
}

TEST_F(LivePageHubTest, StatesWhyNothingCanBeChangedWhateverTheToken) {
  start(Access());
  hub->setControl({.is_over = true, .why_not_operated = "the run is over", .why_not_supervised = "the run is over"});
  const auto messages = open(1, "");
  EXPECT_EQ(messages[1]["why_not_supervised"], "the run is over");
  EXPECT_EQ(answerTo(1, kPlace)["fault"], "the run is over");
}

TEST_F(LivePageHubTest, NeverHoldsMoreForAPageThatDoesNotReadThanTheSharedHistory) {
  start();
  open(1, "viewer-0123456789abcdef");
  for (int i = 1; i <= 100'000; ++i) addMoment(i);
  // It receives the newest moment in one message.
  const auto messages = received(1);
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(messages[0]["items"], json::parse("[100000]"));
}

TEST_F(LivePageHubTest, DisconnectsAPageThatAsksAndDoesNotReadTheAnswers) {
  start();
  open(1, "viewer-0123456789abcdef");
  for (std::size_t i = 0; i < LivePageHub::kMaxReplies; ++i) hub->pageText(1, kPlace);
  EXPECT_TRUE(hub->takeLeaving().empty());
  hub->pageText(1, kPlace);
  EXPECT_EQ(hub->takeLeaving().size(), 1U);
}

TEST_F(LivePageHubTest, RefusesRequestsBeyondTheBound) {
  start(Access());
  open(1, "");
  for (std::size_t i = 0; i < LivePageHub::kMaxRequests; ++i) hub->pageText(1, kPlace);
  EXPECT_NE(answerTo(1, kPlace)["fault"].get<std::string>().find("too many"), std::string::npos);
  EXPECT_EQ(hub->takeRequests().size(), LivePageHub::kMaxRequests);
}

TEST_F(LivePageHubTest, AnswersInvalidValuesAndDisconnectsForUnknownMessages) {
  start(Access());
  open(1, "");
  EXPECT_NE(answerTo(1, R"({"type":"place","id":1,"name":"Ann","x":"a","y":2})")["fault"].get<std::string>(), "");
  EXPECT_NE(answerTo(1, R"({"type":"speed","id":2,"speed":"fast"})")["fault"].get<std::string>(), "");
  EXPECT_TRUE(hub->takeLeaving().empty());
  for (const PageId page : {1, 2, 3}) {
    if (page > 1) open(page, "");
    hub->pageText(page, page == 1 ? "[1" : page == 2 ? R"({"type":"load"})" : "3");
    EXPECT_EQ(hub->takeLeaving().size(), 1U) << page;
  }
}

TEST_F(LivePageHubTest, ContinuesWhereAPageWasWhenItConnectsAgain) {
  start();
  for (int i = 1; i <= 5; ++i) addMoment(i);
  const auto messages = open(1, "viewer-0123456789abcdef", R"(,"run":"7","item":3)");
  ASSERT_EQ(messages.size(), 2U) << "it knows the run";
  EXPECT_EQ(messages[1]["items"], json::parse("[4,5]"));
  const auto of_another = open(2, "viewer-0123456789abcdef", R"(,"run":"6","item":3)");
  EXPECT_EQ(of_another[0]["type"], "run");
  EXPECT_EQ(of_another[2]["items"].size(), 5U);
}

TEST_F(LivePageHubTest, ShowsTheNextRunInsteadOfTheOneBefore) {
  start();
  addMoment(1);
  open(1, "viewer-0123456789abcdef");
  hub->begin("8", R"({"type":"run","id":"8"})");
  addMoment(2);
  const auto messages = received(1);
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[0]["id"], "8");
  EXPECT_EQ(messages[1]["items"], json::parse("[2]"));
}

TEST_F(LivePageHubTest, SendsARecordingInPieces) {
  start();
  LivePageHub recording{{}};
  hub.reset();
  recording.setRecording({{"run", std::string(300'000, 'a')}, {"moments", "b"}});
  recording.pageOpened(1, "192.0.2.7");
  recording.pageText(1, R"({"type":"hello"})");
  std::string run;
  std::vector<std::string> types;
  while (const auto text = recording.nextMessage(1)) {
    const json message = json::parse(text->bytes());
    types.push_back(message["type"]);
    if (message.value("id", "") == "run") run += message["piece"];
  }
  EXPECT_EQ(run.size(), 300'000U);
  // 300,000 bytes in pieces of 32 KiB
  EXPECT_EQ(std::count(types.begin(), types.end(), "block"), 10 + 1);
  EXPECT_EQ(types.back(), "recording");
}

}  // namespace
}  // namespace robosim
