#include "foxglove/server_message.h"

#include <bit>

namespace robosim::foxglove {
namespace {

using Json = nlohmann::ordered_json;

/// Opcodes.
constexpr char kSentMessage = 1, kSentTime = 2, kServiceResponse = 3, kPlaybackState = 5;

std::string textOf(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

template <typename Number>
void append(std::string& bytes, Number number) {
  for (std::size_t i = 0; i < sizeof number; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xff);
}

Json idsFrom(std::uint32_t first, std::size_t count) {
  Json ids = Json::array();
  for (std::size_t i = 0; i < count; ++i) ids.push_back(first + i);
  return ids;
}

}  // namespace

std::string serverInfoText(const ServerInfo& info) {
  Json message{{"op", "serverInfo"},
               {"name", info.name},
               {"capabilities", info.capabilities},
               {"supportedEncodings", info.supported_encodings},
               {"metadata", Json::object()},
               {"sessionId", info.session_id}};
  if (info.duration_ns) {
    constexpr std::uint64_t kSecond_ns = 1'000'000'000;
    message["dataStartTime"] = {{"sec", 0}, {"nsec", 0}};
    message["dataEndTime"] = {{"sec", *info.duration_ns / kSecond_ns}, {"nsec", *info.duration_ns % kSecond_ns}};
  }
  return textOf(message);
}

std::string advertiseText(std::span<const Channel> channels, std::uint32_t first_id) {
  Json list = Json::array();
  for (const auto& channel : channels) {
    list.push_back({{"id", first_id + list.size()},
                    {"topic", channel.topic},
                    {"encoding", channel.encoding},
                    {"schemaName", channel.schema_name},
                    {"schema", channel.schema},
                    {"schemaEncoding", channel.schema_encoding}});
  }
  return textOf({{"op", "advertise"}, {"channels", list}});
}

std::string unadvertiseText(std::uint32_t first_id, std::size_t count) {
  return textOf({{"op", "unadvertise"}, {"channelIds", idsFrom(first_id, count)}});
}

std::string advertiseServicesText(std::span<const Service> services, std::uint32_t first_id) {
  Json list = Json::array();
  for (const auto& service : services) {
    list.push_back({{"id", first_id + list.size()},
                    {"name", service.name},
                    {"type", service.type},
                    {"requestSchema", service.request_schema},
                    {"responseSchema", service.response_schema}});
  }
  return textOf({{"op", "advertiseServices"}, {"services", list}});
}

std::string unadvertiseServicesText(std::uint32_t first_id, std::size_t count) {
  return textOf({{"op", "unadvertiseServices"}, {"serviceIds", idsFrom(first_id, count)}});
}

std::string serviceFailureText(std::uint32_t service, std::uint32_t call, const std::string& message) {
  return textOf({{"op", "serviceCallFailure"}, {"serviceId", service}, {"callId", call}, {"message", message}});
}

std::string parameterValuesText(std::span<const Parameter> parameters, const std::optional<std::string>& id) {
  Json list = Json::array();
  for (const auto& parameter : parameters) {
    Json entry{{"name", parameter.name}};
    if (!parameter.value.is_null()) entry["value"] = parameter.value;
    if (!parameter.type.empty()) entry["type"] = parameter.type;
    list.push_back(std::move(entry));
  }
  Json message{{"op", "parameterValues"}, {"parameters", list}};
  if (id) message["id"] = *id;
  return textOf(message);
}

std::string statusText(StatusLevel level, const std::string& message) {
  return textOf({{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message}});
}

std::string messageDataHead(std::uint32_t subscription, std::uint64_t time_ns) {
  std::string bytes(1, kSentMessage);
  append(bytes, subscription);
  append(bytes, time_ns);
  return bytes;
}

std::string timeMessage(std::uint64_t time_ns) {
  std::string bytes(1, kSentTime);
  append(bytes, time_ns);
  return bytes;
}

std::string playbackStateMessage(const PlaybackState& state, const std::string& request) {
  std::string bytes(1, kPlaybackState);
  bytes += static_cast<char>(state.status);
  append(bytes, state.time_ns);
  append(bytes, std::bit_cast<std::uint32_t>(state.speed));
  bytes += static_cast<char>(state.did_seek ? 1 : 0);
  append(bytes, static_cast<std::uint32_t>(request.size()));
  return bytes + request;
}

std::string serviceResponseHead(std::uint32_t service, std::uint32_t call, const std::string& encoding) {
  std::string bytes(1, kServiceResponse);
  append(bytes, service);
  append(bytes, call);
  append(bytes, static_cast<std::uint32_t>(encoding.size()));
  return bytes + encoding;
}

}  // namespace robosim::foxglove
