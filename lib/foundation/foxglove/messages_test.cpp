#include <gtest/gtest.h>

#include "foxglove/client_message.h"
#include "foxglove/request_token.h"
#include "foxglove/server_message.h"

namespace robosim::foxglove {
namespace {

using namespace std::string_literals;

std::string whyInvalid(std::string_view text) {
  try {
    parseText(text);
  } catch (const ClientMessageError& error) {
    return error.what();
  }
  return "";
}

std::string whyInvalidBinary(std::string_view bytes) {
  try {
    parseBinary(bytes);
  } catch (const ClientMessageError& error) {
    return error.what();
  }
  return "";
}

TEST(FoxgloveServerMessage, NumbersChannelsFromTheFirstId) {
  const std::vector<Channel> channels{{"/clock", "cdr", "rosgraph_msgs/msg/Clock", "Time clock", "ros2msg"},
                                      {"/tf", "cdr", "tf2_msgs/msg/TFMessage", "T[] t", "ros2msg"}};
  EXPECT_EQ(
      advertiseText(channels, 7),
      R"({"op":"advertise","channels":[{"id":7,"topic":"/clock","encoding":"cdr","schemaName":"rosgraph_msgs/msg/Clock",)"
      R"("schema":"Time clock","schemaEncoding":"ros2msg"},{"id":8,"topic":"/tf","encoding":"cdr",)"
      R"("schemaName":"tf2_msgs/msg/TFMessage","schema":"T[] t","schemaEncoding":"ros2msg"}]})");
  EXPECT_EQ(unadvertiseText(7, 2), R"({"op":"unadvertise","channelIds":[7,8]})");
}

TEST(FoxgloveServerMessage, ReplacesInvalidUtf8) {
  EXPECT_EQ(statusText(StatusLevel::error, "a\xff"), "{\"op\":\"status\",\"level\":2,\"message\":\"a\xef\xbf\xbd\"}");
}

TEST(FoxgloveServerMessage, OmitsTheIdAndTypeOfParametersWithoutOne) {
  const std::vector<Parameter> parameters{{"/run/paused", true, ""}, {"/run/speed", 1.5, "float64"}, {"/gone", {}, ""}};
  EXPECT_EQ(parameterValuesText(parameters, std::nullopt),
            R"({"op":"parameterValues","parameters":[{"name":"/run/paused","value":true},)"
            R"({"name":"/run/speed","value":1.5,"type":"float64"},{"name":"/gone"}]})");
  EXPECT_EQ(parameterValuesText({}, "a"), R"({"op":"parameterValues","parameters":[],"id":"a"})");
}

TEST(FoxgloveServerMessage, NamesTheTimesOfARecording) {
  EXPECT_EQ(
      serverInfoText({"run", {}, {}, "1", 90'500'000'000}),
      R"({"op":"serverInfo","name":"run","capabilities":[],"supportedEncodings":[],"metadata":{},"sessionId":"1",)"
      R"("dataStartTime":{"sec":0,"nsec":0},"dataEndTime":{"sec":90,"nsec":500000000}})");
}

TEST(FoxgloveServerMessage, WritesBinaryNumbersInLittleEndianOrder) {
  EXPECT_EQ(messageDataHead(0x01020304, 0x1112131415161718), "\x01\x04\x03\x02\x01\x18\x17\x16\x15\x14\x13\x12\x11"s);
  EXPECT_EQ(timeMessage(1), "\x02\x01\0\0\0\0\0\0\0"s);
  EXPECT_EQ(playbackStateMessage({PlaybackStatus::ended, 0x1112131415161718, 2, true}, "id"),
            "\x05\x03\x18\x17\x16\x15\x14\x13\x12\x11\0\0\0\x40\x01\x02\0\0\0id"s)
      << "status, time, the float 2, whether it went elsewhere, and the request";
  EXPECT_EQ(serviceResponseHead(1, 2, "cdr"), "\x03\x01\0\0\0\x02\0\0\0\x03\0\0\0cdr"s);
}

TEST(FoxgloveClientMessage, ParsesSubscriptions) {
  const auto message = std::get<Subscribe>(parseText(R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":3}]})"));
  ASSERT_EQ(message.subscriptions.size(), 1u);
  EXPECT_EQ(message.subscriptions[0].id, 0u);
  EXPECT_EQ(message.subscriptions[0].channel, 3u);
  EXPECT_EQ(std::get<Unsubscribe>(parseText(R"({"op":"unsubscribe","subscriptionIds":[1,2]})")).subscriptions,
            (std::vector<std::uint32_t>{1, 2}));
}

TEST(FoxgloveClientMessage, ParsesPublishedChannels) {
  const auto message = std::get<Advertise>(parseText(
      R"({"op":"advertise","channels":[{"id":1,"topic":"/Ann/cmd_vel","encoding":"cdr","schemaName":"T","x":[]}]})"));
  ASSERT_EQ(message.channels.size(), 1u);
  EXPECT_EQ(message.channels[0].topic, "/Ann/cmd_vel");
  EXPECT_EQ(std::get<Unadvertise>(parseText(R"({"op":"unadvertise","channelIds":[1]})")).channels.size(), 1u);
}

TEST(FoxgloveClientMessage, ParsesParameters) {
  const auto get = std::get<GetParameters>(parseText(R"({"op":"getParameters","parameterNames":["/a"],"id":"1"})"));
  EXPECT_EQ(get.names, std::vector<std::string>{"/a"});
  EXPECT_EQ(get.id, "1");
  const auto set = std::get<SetParameters>(
      parseText(R"({"op":"setParameters","parameters":[{"name":"/a","value":true},{"name":"/b"}]})"));
  EXPECT_EQ(set.parameters, (std::vector<Parameter>{{"/a", true, ""}, {"/b", {}, ""}}));
  EXPECT_FALSE(set.id);
  EXPECT_TRUE(std::get<WatchParameters>(parseText(R"({"op":"subscribeParameterUpdates","parameterNames":[]})")).on);
  EXPECT_FALSE(std::get<WatchParameters>(parseText(R"({"op":"unsubscribeParameterUpdates","parameterNames":[]})")).on);
}

TEST(FoxgloveClientMessage, ExplainsWhatIsInvalid) {
  EXPECT_EQ(whyInvalid("{"), "a text message that is not JSON");
  EXPECT_EQ(whyInvalid("[]"), "a text message that is no JSON object");
  EXPECT_EQ(whyInvalid("{}"), "a message: 'op' is missing");
  EXPECT_EQ(whyInvalid(R"({"op":"fetchAsset"})"), "the operation 'fetchAsset' is not supported");
  EXPECT_EQ(whyInvalid(R"({"op":"subscribe"})"), "subscribe: 'subscriptions' is missing");
  EXPECT_EQ(whyInvalid(R"({"op":"subscribe","subscriptions":[1]})"), "subscribe: 'subscriptions' must contain objects");
  for (const char* id : {"-1", "1.5", "4294967296", "\"1\"", "null"}) {
    EXPECT_EQ(whyInvalid(R"({"op":"unsubscribe","subscriptionIds":[)" + std::string(id) + "]}"),
              "unsubscribe: 'subscriptionIds' must be a whole number from 0 to 4294967295")
        << id;
  }
}

TEST(FoxgloveClientMessage, LimitsTheDepthOfNestedValues) {
  const auto nested = [](std::size_t depth) {
    return R"({"op":"setParameters","parameters":[{"name":"/a","value":)" + std::string(depth, '[') +
           std::string(depth, ']') + "}]}";
  };
  EXPECT_EQ(whyInvalid(nested(10)), "");
  EXPECT_EQ(whyInvalid(nested(100000)), "a message of more than 16 levels");
}

TEST(FoxgloveClientMessage, ParsesPublishedMessagesAndServiceCalls) {
  const auto bytes = "\x01\x02\0\0\0abc"s;
  const auto published = std::get<PublishedMessage>(parseBinary(bytes));
  EXPECT_EQ(published.channel, 2u);
  EXPECT_EQ(published.payload, "abc");
  const auto request = "\x02\x01\0\0\0\x05\0\0\0\x03\0\0\0cdr12"s;
  const auto call = std::get<ServiceCall>(parseBinary(request));
  EXPECT_EQ(call.service, 1u);
  EXPECT_EQ(call.call, 5u);
  EXPECT_EQ(call.encoding, "cdr");
  EXPECT_EQ(call.payload, "12");
}

TEST(FoxgloveClientMessage, ParsesPlaybackControls) {
  const auto seek =
      std::get<PlaybackControl>(parseBinary("\x03\x01\0\0\0\x40\x01\x18\x17\x16\x15\x14\x13\x12\x11\x02\0\0\0id"s));
  EXPECT_FALSE(seek.plays);
  EXPECT_EQ(seek.speed, 2);
  EXPECT_EQ(seek.seek_ns, 0x1112131415161718u);
  EXPECT_EQ(seek.id, "id");
  const auto play = std::get<PlaybackControl>(parseBinary("\x03\0\0\0\x80\x3f\0\0\0\0\0\0\0\0\0\0\0\0\0"s));
  EXPECT_TRUE(play.plays);
  EXPECT_EQ(play.speed, 1);
  EXPECT_EQ(play.seek_ns, std::nullopt);
  EXPECT_EQ(whyInvalidBinary("\x03\x02\0\0\x80\x3f"s), "a playback control of the command 2");
  EXPECT_EQ(whyInvalidBinary("\x03\0\0\0\x80\x3f"s), "a playback control: the message is too short");
}

TEST(FoxgloveClientMessage, RefusesBinaryMessagesThatAreTooShort) {
  EXPECT_EQ(whyInvalidBinary(""), "a binary message: the message is too short");
  EXPECT_EQ(whyInvalidBinary("\x01\x02\0\0"s), "a published message: the message is too short");
  EXPECT_EQ(whyInvalidBinary("\x02\x01\0\0\0\x05\0\0\0\xff\xff\xff\xff"s), "a service call: the message is too short");
  EXPECT_EQ(whyInvalidBinary("\x09"), "binary messages of the opcode 9 are not supported");
}

TEST(FoxgloveRequestToken, IsTheParameterOfTheTarget) {
  EXPECT_EQ(tokenOf("/?token=abc"), "abc");
  EXPECT_EQ(tokenOf("/x?a=b&token=a%2Bb%&c=d"), "a+b%");
  EXPECT_EQ(tokenOf("/"), std::nullopt);
  EXPECT_EQ(tokenOf("/?mytoken=abc"), std::nullopt);
  EXPECT_EQ(tokenOf("/token=abc"), std::nullopt);
}

}  // namespace
}  // namespace robosim::foxglove
