#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace robosim::foxglove {

/// @file
/// Messages of a server to a client, of Foxglove's WebSocket protocol: texts are JSON objects with a member `op`,
/// binary messages begin with an opcode, numbers in little-endian order. Source: foxglove/ws-protocol, docs/spec.md
/// (v1); foxglove/foxglove-sdk, rust/foxglove/src/websocket/ws_protocol.

/// Subprotocols, the preferred one first. Their messages are the same.
inline constexpr const char* kProtocols[] = {"foxglove.sdk.v1", "foxglove.websocket.v1"};

struct ServerInfo {
  std::string name;
  std::vector<std::string> capabilities;
  std::vector<std::string> supported_encodings;  ///< of messages that clients publish
  std::string session_id;                        ///< another one for each run
  /// Of a recording that is played, whose playback clients control: its last time, from 0 on.
  std::optional<std::uint64_t> duration_ns = {};
};

/// A topic whose messages clients may subscribe to.
struct Channel {
  std::string topic;
  std::string encoding;  ///< of messages: "cdr"
  std::string schema_name;
  std::string schema;
  std::string schema_encoding;  ///< "ros2msg"
};

struct Service {
  std::string name;
  std::string type;             ///< "std_srvs/srv/Trigger"
  std::string request_schema;   ///< as in a .srv
  std::string response_schema;  ///< as in a .srv
};

struct Parameter {
  std::string name;
  nlohmann::json value;  ///< a number, a bool, a string, or arrays and objects of them; null: not set
  std::string type;      ///< "byte_array", "float64", "float64_array"; empty: that of the value
  bool operator==(const Parameter&) const = default;
};

enum class PlaybackStatus : std::uint8_t { playing, paused, buffering, ended };

struct PlaybackState {
  PlaybackStatus status = PlaybackStatus::paused;
  std::uint64_t time_ns = 0;
  float speed = 1;
  bool did_seek = false;
};

enum class StatusLevel { info, warning, error };

/// @name Texts. Characters that are not well-formed UTF-8 are replaced
///@{
std::string serverInfoText(const ServerInfo& info);
/// @param first_id id of the first channel; the others have the ids that follow
std::string advertiseText(std::span<const Channel> channels, std::uint32_t first_id);
std::string unadvertiseText(std::uint32_t first_id, std::size_t count);
std::string advertiseServicesText(std::span<const Service> services, std::uint32_t first_id);
std::string unadvertiseServicesText(std::uint32_t first_id, std::size_t count);
std::string serviceFailureText(std::uint32_t service, std::uint32_t call, const std::string& message);
/// @param id of the request that is answered
std::string parameterValuesText(std::span<const Parameter> parameters, const std::optional<std::string>& id);
std::string statusText(StatusLevel level, const std::string& message);
///@}

/// @name Heads of binary messages, before the payload
///@{
std::string messageDataHead(std::uint32_t subscription, std::uint64_t time_ns);
std::string timeMessage(std::uint64_t time_ns);
/// @param request id of the request that has led to it; empty: none
std::string playbackStateMessage(const PlaybackState& state, const std::string& request);
std::string serviceResponseHead(std::uint32_t service, std::uint32_t call, const std::string& encoding);
///@}

}  // namespace robosim::foxglove
