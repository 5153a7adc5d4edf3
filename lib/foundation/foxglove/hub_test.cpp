#include "foxglove/hub.h"

#include <gtest/gtest.h>

#include "foxglove/server.h"

namespace robosim::foxglove {
namespace {

using namespace std::string_literals;

const char* const kTokens =
    "viewer-0123456789abcdef viewer\n"
    "only-bob-0123456789abcdef robot Bob\n"
    "geometry-0123456789abcdef geometry\n";

/// Accepts messages on /Ann/cmd_vel that are not empty.
struct TestHandler final : PublicationHandler {
  std::string advertised(const Client&, const ClientChannel& channel) override {
    return channel.topic == "/Ann/cmd_vel" ? "" : "nothing subscribes to it";
  }
  std::string published(const Client&, const Publication& publication) override {
    if (publication.payload.empty()) return "empty";
    messages.emplace_back(publication.payload);
    return "";
  }
  void withdrawn(const Client& client, const ClientChannel& channel) override {
    gone.push_back(std::to_string(client.id) + channel.topic);
  }
  std::vector<std::string> messages, gone;
};

struct FoxgloveHub : testing::Test {
  TestHandler handler;
  std::optional<Hub> hub;

  void start(const Access& access = {}) {
    hub.emplace(Hub::Options{.access = access, .publications = &handler});
    hub->offer(offer("first"));
  }
  static Hub::Offer offer(const std::string& session) {
    return {{"test", {"time"}, {"cdr"}, session},
            {{"/clock", "cdr", "Clock", "", "ros2msg"}, {"/map", "cdr", "Grid", "", "ros2msg"}},
            {{"/run/pause", "std_srvs/srv/Trigger", "", "bool success"}}};
  }
  void open(PageId page, const std::string& token = "") {
    hub->pageOpened(page, "192.0.2.7", token.empty() ? "/" : "/?token=" + token);
  }
  void subscribe(PageId page, std::uint32_t id, std::uint32_t channel) {
    hub->pageText(page, R"({"op":"subscribe","subscriptions":[{"id":)" + std::to_string(id) + R"(,"channelId":)" +
                            std::to_string(channel) + "}]}");
  }
  void advertise(PageId page, std::uint32_t id, const std::string& topic) {
    hub->pageText(page, R"({"op":"advertise","channels":[{"id":)" + std::to_string(id) + R"(,"topic":")" + topic +
                            R"(","encoding":"cdr","schemaName":"T"}]})");
  }
  static Payload payload(const std::string& text) {
    return std::make_shared<const std::vector<std::uint8_t>>(text.begin(), text.end());
  }
  /// A round in which a channel's message is sent to those who want it. @return whether any did
  bool round(std::size_t channel, Hub::Audience audience, const std::string& text) {
    hub->beginRound();
    const bool is_wanted = hub->wants(channel, audience);
    if (is_wanted) hub->send(channel, audience, 1, payload(text));
    hub->endRound();
    return is_wanted;
  }
  /// What waits for a page: texts as they are, of binary messages what follows the head of 13 bytes.
  std::vector<std::string> received(PageId page) {
    std::vector<std::string> all;
    while (const auto message = hub->nextMessage(page)) {
      all.emplace_back(message->isBinary() ? message->bytes().substr(std::min<std::size_t>(13, message->bytes().size()))
                                           : message->bytes());
    }
    return all;
  }
  std::string last(PageId page) {
    const auto all = received(page);
    return all.empty() ? "" : all.back();
  }
  static std::string status(int level, const std::string& text) {
    return R"({"op":"status","level":)" + std::to_string(level) + R"(,"message":")" + text + "\"}";
  }
};

TEST_F(FoxgloveHub, OffersChannelsAndServicesToANewClient) {
  start();
  open(1);
  const auto texts = received(1);
  ASSERT_EQ(texts.size(), 3u);
  EXPECT_EQ(texts[0].find(R"({"op":"serverInfo","name":"test")"), 0u);
  EXPECT_EQ(texts[1].find(R"({"op":"advertise","channels":[{"id":1,"topic":"/clock")"), 0u);
  EXPECT_EQ(texts[2].find(R"({"op":"advertiseServices","services":[{"id":1,"name":"/run/pause")"), 0u);
}

TEST_F(FoxgloveHub, SendsMessagesOfAChannelToItsSubscribersOnly) {
  start();
  open(1);
  open(2);
  received(1);
  received(2);
  EXPECT_FALSE(round(0, Hub::Audience::all, "none"));
  subscribe(1, 5, 1);
  EXPECT_TRUE(round(0, Hub::Audience::all, "a"));
  EXPECT_FALSE(round(1, Hub::Audience::all, "b"));
  EXPECT_EQ(received(1), std::vector<std::string>{"a"});
  EXPECT_TRUE(received(2).empty());
  hub->pageText(1, R"({"op":"unsubscribe","subscriptionIds":[5]})");
  EXPECT_FALSE(round(0, Hub::Audience::all, "c"));
  subscribe(1, 5, 1);
  hub->pageClosed(1);
  EXPECT_FALSE(round(0, Hub::Audience::all, "d"));
}

TEST_F(FoxgloveHub, SendsThePresentStateToNewSubscriptionsOnly) {
  start();
  open(1);
  open(2);
  received(1);
  received(2);
  subscribe(1, 1, 2);
  EXPECT_TRUE(hub->hasFresh());
  EXPECT_TRUE(round(1, Hub::Audience::fresh, "map"));
  EXPECT_FALSE(hub->hasFresh());
  EXPECT_FALSE(round(1, Hub::Audience::fresh, "again"));
  subscribe(2, 1, 2);
  EXPECT_TRUE(round(1, Hub::Audience::fresh, "map for 2"));
  EXPECT_EQ(received(1), std::vector<std::string>{"map"});
  EXPECT_EQ(received(2), std::vector<std::string>{"map for 2"});
}

TEST_F(FoxgloveHub, LeavesASubscriptionDuringARoundToTheNextOne) {
  start();
  open(1);
  received(1);
  hub->beginRound();
  subscribe(1, 1, 1);
  hub->send(0, Hub::Audience::all, 1, payload("of this round"));
  hub->endRound();
  EXPECT_TRUE(hub->hasFresh());
  EXPECT_TRUE(received(1).empty());
}

TEST_F(FoxgloveHub, AnswersInvalidMessagesWithAStatus) {
  start();
  open(1);
  hub->pageText(1, "x");
  EXPECT_EQ(last(1), status(2, "a text message that is not JSON"));
  subscribe(1, 1, 3);
  EXPECT_EQ(last(1), status(2, "subscribe: channel 3 does not exist"));
  subscribe(1, 1, 0);
  EXPECT_EQ(last(1), status(2, "subscribe: channel 0 does not exist"));
  subscribe(1, 1, 1);
  subscribe(1, 2, 1);
  EXPECT_EQ(last(1), status(1, "subscribe: channel 1 has a subscription already"));
  subscribe(1, 1, 2);
  EXPECT_EQ(last(1), status(2, "subscribe: the subscription 1 exists already"));
  hub->pageBinary(1, "\x01\x07\0\0\0"s);
  EXPECT_EQ(last(1), status(2, "a message of the channel 7, which is not advertised"));
  EXPECT_TRUE(hub->takeLeaving().empty());
}

TEST_F(FoxgloveHub, DisconnectsAClientThatDoesNotReadItsAnswers) {
  start();
  open(1);
  for (std::size_t i = 0; i < ClientQueue::kMaxControl; ++i) hub->pageText(1, "x");
  const auto leaving = hub->takeLeaving();
  ASSERT_EQ(leaving.size(), 1u);
  EXPECT_EQ(leaving[0].second, "too many messages wait; read them");
  EXPECT_TRUE(hub->takeLeaving().empty());
}

TEST_F(FoxgloveHub, WarnsASlowClientOnce) {
  start();
  open(1);
  received(1);
  subscribe(1, 1, 1);
  for (std::size_t i = 0; i < ClientQueue::kMaxOfSubscription + 5; ++i) {
    round(0, Hub::Audience::all, std::to_string(i));
  }
  const auto all = received(1);
  ASSERT_EQ(all.size(), 1 + ClientQueue::kMaxOfSubscription);
  EXPECT_EQ(all[0].find(R"({"op":"status","level":1,"message":"The connection is slower)"), 0u);
  EXPECT_EQ(all[1], "5");
}

TEST_F(FoxgloveHub, EndsSubscriptionsWithTheRunAndNeverUsesItsIdsAgain) {
  start();
  open(1);
  received(1);
  subscribe(1, 1, 1);
  round(0, Hub::Audience::all, "old");
  hub->offer(offer("second"));
  const auto texts = received(1);
  ASSERT_EQ(texts.size(), 5u);
  EXPECT_EQ(texts[0], R"({"op":"unadvertise","channelIds":[1,2]})");
  EXPECT_EQ(texts[1], R"({"op":"unadvertiseServices","serviceIds":[1]})");
  EXPECT_NE(texts[2].find(R"("sessionId":"second")"), std::string::npos);
  EXPECT_EQ(texts[3].find(R"({"op":"advertise","channels":[{"id":3,)"), 0u);
  EXPECT_FALSE(round(0, Hub::Audience::all, "new"));
  subscribe(1, 1, 1);
  EXPECT_EQ(last(1), status(2, "subscribe: channel 1 does not exist"));
}

TEST_F(FoxgloveHub, SendsChangedParametersToThoseThatWatchThem) {
  start();
  hub->setParameters({{"/a", 1, ""}, {"/b", true, ""}});
  open(1);
  open(2);
  received(1);
  received(2);
  hub->pageText(1, R"({"op":"getParameters","parameterNames":["/b"],"id":"x"})");
  EXPECT_EQ(last(1), R"({"op":"parameterValues","parameters":[{"name":"/b","value":true}],"id":"x"})");
  hub->pageText(1, R"({"op":"subscribeParameterUpdates","parameterNames":["/b"]})");
  hub->setParameters({{"/a", 2, ""}, {"/b", true, ""}});
  EXPECT_TRUE(received(1).empty());
  hub->setParameters({{"/a", 2, ""}, {"/b", false, ""}});
  EXPECT_EQ(last(1), R"({"op":"parameterValues","parameters":[{"name":"/b","value":false}]})");
  EXPECT_TRUE(received(2).empty());
}

TEST_F(FoxgloveHub, PassesRequestsToTheSourceAndAnswersThem) {
  start();
  hub->setParameters({{"/a", 1, ""}});
  open(1);
  received(1);
  hub->pageText(1, R"({"op":"setParameters","parameters":[{"name":"/a","value":2}],"id":"q"})");
  hub->pageBinary(1, "\x02\x01\0\0\0\x05\0\0\0\x03\0\0\0cdrXY"s);
  hub->pageBinary(1, "\x02\x02\0\0\0\x06\0\0\0\x03\0\0\0cdr"s);
  EXPECT_EQ(last(1), R"({"op":"serviceCallFailure","serviceId":2,"callId":6,"message":"there is no such service"})");
  const auto requests = hub->takeRequests();
  ASSERT_EQ(requests.size(), 2u);
  const auto& change = std::get<ParameterChange>(requests[0]);
  EXPECT_EQ(change.parameters[0].value, 2);
  hub->setParameters({{"/a", 2, ""}});
  hub->answer(change);
  EXPECT_EQ(last(1), R"({"op":"parameterValues","parameters":[{"name":"/a","value":2}],"id":"q"})");
  const auto& call = std::get<ServiceRequest>(requests[1]);
  EXPECT_EQ(call.payload, "XY");
  hub->answer(call, std::vector<std::uint8_t>{'o', 'k'});
  EXPECT_EQ(hub->nextMessage(1)->bytes(), "\x03\x01\0\0\0\x05\0\0\0\x03\0\0\0cdrok"s);
}

TEST_F(FoxgloveHub, PassesControlsOfAPlaybackAndInformsAllClientsOfIt) {
  const auto control = "\x03\x01\0\0\x80\x3f\0\0\0\0\0\0\0\0\0\x01\0\0\0q"s;
  start();
  open(1);
  hub->pageBinary(1, control);
  EXPECT_EQ(last(1), status(2, "this server plays no recording"));
  auto recording = offer("recording");
  recording.info.duration_ns = 5;
  hub->offer(recording);
  open(2);
  received(1);
  received(2);
  hub->pageBinary(1, control);
  const auto requests = hub->takeRequests();
  ASSERT_EQ(requests.size(), 1u);
  const auto& request = std::get<PlaybackRequest>(requests[0]);
  const PlaybackState paused{PlaybackStatus::paused, 3, 1, true};
  hub->setPlayback(paused, &request);
  EXPECT_EQ(hub->nextMessage(1)->bytes(), playbackStateMessage(paused, "q"));
  EXPECT_EQ(hub->nextMessage(2)->bytes(), playbackStateMessage(paused, ""));
  open(3);
  std::string latest;
  while (const auto message = hub->nextMessage(3)) latest = message->bytes();
  EXPECT_EQ(latest, playbackStateMessage({PlaybackStatus::paused, 3, 1, false}, "")) << "of a later client";
}

TEST_F(FoxgloveHub, BoundsTheRequestsThatWait) {
  start();
  open(1);
  for (std::size_t i = 0; i <= Hub::kMaxRequests; ++i) hub->pageText(1, R"({"op":"setParameters","parameters":[]})");
  EXPECT_EQ(last(1), status(2, "too many requests wait for the run; send this one again later"));
  EXPECT_EQ(hub->takeRequests().size(), Hub::kMaxRequests);
}

TEST_F(FoxgloveHub, PassesPublishedMessagesToTheirHandler) {
  start();
  open(1);
  received(1);
  advertise(1, 1, "/Ann/cmd_vel");
  EXPECT_TRUE(received(1).empty());
  hub->pageBinary(1, "\x01\x01\0\0\0go"s);
  EXPECT_EQ(handler.messages, std::vector<std::string>{"go"});
  hub->pageBinary(1, "\x01\x01\0\0\0"s);
  EXPECT_EQ(last(1), status(2, "/Ann/cmd_vel: empty"));
  hub->pageBinary(1, "\x01\x01\0\0\0"s);
  EXPECT_EQ(last(1), "") << "the same refusal is sent once";
  hub->pageText(1, R"({"op":"unadvertise","channelIds":[1]})");
  EXPECT_EQ(handler.gone, std::vector<std::string>{"1/Ann/cmd_vel"});
  advertise(1, 1, "/Ann/cmd_vel");
  hub->pageClosed(1);
  EXPECT_EQ(handler.gone.size(), 2u);
}

TEST_F(FoxgloveHub, RefusesTopicsThatNothingSubscribesTo) {
  start();
  open(1);
  received(1);
  advertise(1, 1, "/other");
  EXPECT_EQ(last(1), status(2, "/other: nothing subscribes to it"));
  hub->pageBinary(1, "\x01\x01\0\0\0go"s);
  EXPECT_EQ(last(1), "");
  hub->pageClosed(1);
  EXPECT_TRUE(handler.gone.empty());
}

TEST_F(FoxgloveHub, RequiresATokenThatPermitsWatchingOrDriving) {
  start(Access::parse(kTokens, "tokens"));
  open(1);
  EXPECT_NE(last(1).find(R"("level":2)"), std::string::npos);
  ASSERT_EQ(hub->takeLeaving().size(), 1u);
  open(2, "geometry-0123456789abcdef");
  EXPECT_EQ(last(2), status(2, "the token permits neither watching nor driving; use another"));
  open(3, "viewer-0123456789abcdef");
  subscribe(3, 1, 1);
  EXPECT_TRUE(round(0, Hub::Audience::all, "a"));
  EXPECT_EQ(last(3), "a");
  open(4, "only-bob-0123456789abcdef");
  subscribe(4, 1, 1);
  EXPECT_EQ(last(4), status(2, "subscribe: the token permits driving, not watching, which shows true poses"));
}

TEST(FoxgloveServer, PermitsProgramsAndPagesOfFoxgloveOnly) {
  const char* const here = "127.0.0.1:8765";
  EXPECT_TRUE(mayConnect("", "localhost:8765", here, {}));
  EXPECT_TRUE(mayConnect("https://app.foxglove.dev", "localhost:8765", here, {}));
  EXPECT_TRUE(mayConnect("http://localhost:8765", "localhost:8765", here, {}));
  EXPECT_TRUE(mayConnect("http://localhost:8080", "localhost:8765", here, {"http://localhost:8080"}));
  EXPECT_FALSE(mayConnect("http://localhost:8080", "localhost:8765", here, {}));
  EXPECT_FALSE(mayConnect("https://example.org", "localhost:8765", here, {}));
  EXPECT_FALSE(mayConnect("https://app.foxglove.dev.example.org", "localhost:8765", here, {}));
  EXPECT_FALSE(mayConnect("null", "localhost:8765", here, {}));
  EXPECT_FALSE(mayConnect("", "evil.example:8765", here, {})) << "a name rebound to this machine";
  EXPECT_TRUE(mayConnect("", "sim.example.org:8765", "0.0.0.0:8765", {}));
}

}  // namespace
}  // namespace robosim::foxglove
