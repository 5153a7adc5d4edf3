#include "foxglove/client_message.h"

#include <bit>
#include <limits>

namespace robosim::foxglove {
namespace {

using nlohmann::json;

/// Messages of the protocol have 4 levels; values of parameters may have more.
constexpr int kMaxDepth = 16;
/// Of names and texts that are quoted in answers.
constexpr std::size_t kMaxQuoted = 200;

/// Opcodes.
constexpr unsigned char kReceivedMessage = 1, kServiceRequest = 2, kPlaybackControl = 3;

std::string shortened(std::string_view text) { return std::string(text.substr(0, kMaxQuoted)); }

/// A member of an object. @param of the message, for errors
const json& member(const json& object, const char* name, const std::string& of) {
  const auto found = object.find(name);
  if (found == object.end()) throw ClientMessageError(of + ": '" + name + "' is missing");
  return *found;
}

std::string text(const json& value, const char* name, const std::string& of) {
  if (!value.is_string()) throw ClientMessageError(of + ": '" + name + "' must be a text");
  return value.get<std::string>();
}

std::uint32_t number(const json& value, const char* name, const std::string& of) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::numeric_limits<std::uint32_t>::max()) {
    throw ClientMessageError(of + ": '" + name + "' must be a whole number from 0 to 4294967295");
  }
  return value.get<std::uint32_t>();
}

const json& list(const json& object, const char* name, const std::string& of) {
  const json& value = member(object, name, of);
  if (!value.is_array()) throw ClientMessageError(of + ": '" + name + "' must be an array");
  return value;
}

std::string textIn(const json& object, const char* name, const std::string& of) {
  return text(member(object, name, of), name, of);
}
std::uint32_t numberIn(const json& object, const char* name, const std::string& of) {
  return number(member(object, name, of), name, of);
}

std::vector<std::uint32_t> numbersIn(const json& object, const char* name, const std::string& of) {
  std::vector<std::uint32_t> numbers;
  for (const auto& value : list(object, name, of)) numbers.push_back(number(value, name, of));
  return numbers;
}

std::vector<std::string> textsIn(const json& object, const char* name, const std::string& of) {
  std::vector<std::string> texts;
  for (const auto& value : list(object, name, of)) texts.push_back(text(value, name, of));
  return texts;
}

/// The objects of an array.
const json& objectsIn(const json& object, const char* name, const std::string& of) {
  const json& values = list(object, name, of);
  for (const auto& value : values) {
    if (!value.is_object()) throw ClientMessageError(of + ": '" + name + "' must contain objects");
  }
  return values;
}

std::optional<std::string> idIn(const json& object, const std::string& of) {
  const auto found = object.find("id");
  if (found == object.end() || found->is_null()) return std::nullopt;
  return text(*found, "id", of);
}

Parameter parameterOf(const json& object, const std::string& of) {
  Parameter parameter{textIn(object, "name", of), {}, {}};
  if (const auto value = object.find("value"); value != object.end()) parameter.value = *value;
  if (const auto type = object.find("type"); type != object.end() && !type->is_null()) {
    parameter.type = text(*type, "type", of);
  }
  return parameter;
}

json parseJson(std::string_view text) {
  bool is_too_deep = false;
  const auto check = [&](int depth, json::parse_event_t, json&) {
    is_too_deep = is_too_deep || depth > kMaxDepth;
    return !is_too_deep;
  };
  json parsed = json::parse(text, check, false);
  if (is_too_deep) throw ClientMessageError("a message of more than " + std::to_string(kMaxDepth) + " levels");
  if (parsed.is_discarded()) throw ClientMessageError("a text message that is not JSON");
  if (!parsed.is_object()) throw ClientMessageError("a text message that is no JSON object");
  return parsed;
}

/// Reads the fields of a binary message.
class BinaryReader {
 public:
  explicit BinaryReader(std::string_view bytes) : bytes_(bytes) {}

  template <typename Number = std::uint32_t>
  Number number(const char* of) {
    const std::string_view field = take(sizeof(Number), of);
    Number value = 0;
    for (std::size_t i = field.size(); i-- > 0;) value = value << 8 | static_cast<unsigned char>(field[i]);
    return value;
  }
  std::string_view take(std::size_t size, const char* of) {
    if (size > bytes_.size()) throw ClientMessageError(std::string(of) + ": the message is too short");
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }
  std::string_view rest() const { return bytes_; }

 private:
  std::string_view bytes_;
};

}  // namespace

ClientMessage parseText(std::string_view message) {
  const json object = parseJson(message);
  const std::string op = textIn(object, "op", "a message");
  if (op == "subscribe") {
    Subscribe subscribe;
    for (const auto& entry : objectsIn(object, "subscriptions", op)) {
      subscribe.subscriptions.push_back({numberIn(entry, "id", op), numberIn(entry, "channelId", op)});
    }
    return subscribe;
  }
  if (op == "unsubscribe") return Unsubscribe{numbersIn(object, "subscriptionIds", op)};
  if (op == "advertise") {
    Advertise advertise;
    for (const auto& entry : objectsIn(object, "channels", op)) {
      advertise.channels.push_back({numberIn(entry, "id", op), textIn(entry, "topic", op),
                                    textIn(entry, "encoding", op), textIn(entry, "schemaName", op)});
    }
    return advertise;
  }
  if (op == "unadvertise") return Unadvertise{numbersIn(object, "channelIds", op)};
  if (op == "getParameters") return GetParameters{textsIn(object, "parameterNames", op), idIn(object, op)};
  if (op == "setParameters") {
    SetParameters set{{}, idIn(object, op)};
    for (const auto& entry : objectsIn(object, "parameters", op)) set.parameters.push_back(parameterOf(entry, op));
    return set;
  }
  if (op == "subscribeParameterUpdates") return WatchParameters{true, textsIn(object, "parameterNames", op)};
  if (op == "unsubscribeParameterUpdates") return WatchParameters{false, textsIn(object, "parameterNames", op)};
  throw ClientMessageError("the operation '" + shortened(op) + "' is not supported");
}

ClientMessage parseBinary(std::string_view bytes) {
  BinaryReader reader(bytes);
  const auto opcode = static_cast<unsigned char>(reader.take(1, "a binary message")[0]);
  if (opcode == kReceivedMessage) {
    const std::uint32_t channel = reader.number("a published message");
    return PublishedMessage{channel, reader.rest()};
  }
  if (opcode == kServiceRequest) {
    constexpr const char* kName = "a service call";
    ServiceCall call;
    call.service = reader.number(kName);
    call.call = reader.number(kName);
    call.encoding = reader.take(reader.number(kName), kName);
    call.payload = reader.rest();
    return call;
  }
  if (opcode == kPlaybackControl) {
    constexpr const char* kName = "a playback control";
    const auto byte = [&] { return static_cast<unsigned char>(reader.take(1, kName)[0]); };
    PlaybackControl playback;
    const unsigned command = byte();
    if (command > 1) throw ClientMessageError("a playback control of the command " + std::to_string(command));
    playback.plays = command == 0;
    playback.speed = std::bit_cast<float>(reader.number(kName));
    const bool seeks = byte() != 0;
    const auto seek_ns = reader.number<std::uint64_t>(kName);
    if (seeks) playback.seek_ns = seek_ns;
    playback.id = reader.take(reader.number(kName), kName);
    return playback;
  }
  throw ClientMessageError("binary messages of the opcode " + std::to_string(opcode) + " are not supported");
}

}  // namespace robosim::foxglove
