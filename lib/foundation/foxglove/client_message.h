#pragma once
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "foxglove/server_message.h"

namespace robosim::foxglove {

/// @file
/// Messages of a client (server_message.h). They are untrusted.

/// A message that is invalid, or not supported: the text is for the client.
class ClientMessageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Subscribe {
  struct Subscription {
    std::uint32_t id = 0, channel = 0;  ///< ids, of the client and of the server
  };
  std::vector<Subscription> subscriptions;
};
struct Unsubscribe {
  std::vector<std::uint32_t> subscriptions;
};

/// A topic on which a client publishes.
struct ClientChannel {
  std::uint32_t id = 0;  ///< of the client
  std::string topic, encoding, schema_name;
};
struct Advertise {
  std::vector<ClientChannel> channels;
};
struct Unadvertise {
  std::vector<std::uint32_t> channels;
};

struct GetParameters {
  std::vector<std::string> names;  ///< empty: all
  std::optional<std::string> id;
};
struct SetParameters {
  std::vector<Parameter> parameters;
  std::optional<std::string> id;  ///< absent: no answer is awaited
};
/// Begins or ends updates about changed parameters.
struct WatchParameters {
  bool on = true;
  std::vector<std::string> names;  ///< empty: all
};

struct PublishedMessage {
  std::uint32_t channel = 0;  ///< ClientChannel::id
  std::string_view payload;
};
struct ServiceCall {
  std::uint32_t service = 0, call = 0;
  std::string encoding;
  std::string_view payload;
};

/// Controls the playback of a recording.
struct PlaybackControl {
  bool plays = false;  ///< else it pauses
  float speed = 1;     ///< any number
  std::optional<std::uint64_t> seek_ns;
  std::string id;  ///< of the request
};

using ClientMessage = std::variant<Subscribe, Unsubscribe, Advertise, Unadvertise, GetParameters, SetParameters,
                                   WatchParameters, PublishedMessage, ServiceCall, PlaybackControl>;

/// Parses a text message. Members that are not known are ignored, as the protocol requires.
/// @throws ClientMessageError
ClientMessage parseText(std::string_view text);
/// Parses a binary message; its payload refers to `bytes`. @throws ClientMessageError
ClientMessage parseBinary(std::string_view bytes);

}  // namespace robosim::foxglove
