#include "remote/page_message.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

namespace robosim {
namespace {

using nlohmann::json;
using Type = PageMessage::Type;

struct Kind {
  Type type;
  RemoteType order;
  std::set<std::string> members;  ///< it may have
};

const std::map<std::string, Kind>& kinds() {
  static const std::map<std::string, Kind> all{
      {"hello", {Type::hello, {}, {"protocol", "name", "token"}}},
      {"ack", {Type::ack, {}, {"number"}}},
      {"take", {Type::take, {}, {}}},
      {"release", {Type::release, {}, {}}},
      {"accelerate", {Type::steer, RemoteType::accelerate, {}}},
      {"decelerate", {Type::steer, RemoteType::decelerate, {}}},
      {"turn_left", {Type::steer, RemoteType::turn_left, {}}},
      {"turn_right", {Type::steer, RemoteType::turn_right, {}}},
      {"stop", {Type::steer, RemoteType::stop, {"why"}}},
      {"alive", {Type::steer, RemoteType::alive, {}}},
      {"check_win", {Type::steer, RemoteType::check_win, {}}},
      {"req_heat", {Type::steer, RemoteType::req_heat, {}}},
      {"req_laser", {Type::steer, RemoteType::req_laser, {}}},
      {"req_sonar", {Type::steer, RemoteType::req_sonar, {}}},
      {"drive", {Type::drive, RemoteType::drive, {"speed", "turn", "pan"}}},
      {"autonomous", {Type::autonomous, {}, {"on"}}},
      {"switch", {Type::switching, {}, {"robot"}}},
      {"live", {Type::live, {}, {"on"}}},
      {"map", {Type::map, {}, {"on"}}},
  };
  return all;
}

/// A part of the most: beyond it the nearest end counts.
double part(const json& value, const std::string& member) {
  if (!value.is_number() || !std::isfinite(value.get<double>())) {
    throw WireError("'" + member + "' must be a finite number");
  }
  return std::clamp(value.get<double>(), -1.0, 1.0);
}

std::uint64_t count(const json& value, const std::string& member) {
  if (!value.is_number_unsigned()) throw WireError("'" + member + "' must be a whole number, 0 or more");
  return value.get<std::uint64_t>();
}

std::string words(const json& value, const std::string& member, std::size_t most_bytes) {
  if (!value.is_string()) throw WireError("'" + member + "' must be a text");
  const auto text = value.get<std::string>();
  checkText(text, most_bytes, ("'" + member + "'").c_str());
  return text;
}

void read(const std::string& member, const json& value, PageMessage& message) {
  constexpr std::size_t longest_token = 1024;
  constexpr std::size_t longest_robot = 256;
  if (member == "protocol")
    message.protocol = static_cast<std::uint32_t>(std::min<std::uint64_t>(count(value, member), UINT32_MAX));
  if (member == "number") message.number = count(value, member);
  if (member == "name") message.name = words(value, member, kMaxDriverBytes);
  if (member == "token") message.token = words(value, member, longest_token);
  if (member == "robot") message.robot = words(value, member, longest_robot);
  if (member == "why") message.why = words(value, member, kMaxWhyBytes);
  if (member == "speed") message.speed = part(value, member);
  if (member == "turn") message.turn = part(value, member);
  if (member == "pan") message.pan_rad = part(value, member) * M_PI_2;
  if (member == "on") {
    if (!value.is_boolean()) throw WireError("'on' must be true or false");
    message.on = value.get<bool>();
  }
}

}  // namespace

PageMessage PageMessage::parse(std::string_view text) {
  const json object = json::parse(text, nullptr, false);
  if (object.is_discarded() || !object.is_object()) throw WireError("a message that is no JSON object");
  const auto type = object.find("type");
  const auto kind = type != object.end() && type->is_string() ? kinds().find(type->get<std::string>()) : kinds().end();
  if (kind == kinds().end()) throw WireError("a message without a type that is known here");
  PageMessage message;
  message.type = kind->second.type;
  message.order = kind->second.order;
  for (const auto& [member, value] : object.items()) {
    if (member == "type") continue;
    if (!kind->second.members.contains(member)) {
      throw WireError("a message of the type '" + kind->first + "' with " + inQuotes(member) +
                      ", which it does not have");
    }
    read(member, value, message);
  }
  if (message.type == Type::hello) checkProtocol(message.protocol);
  return message;
}

}  // namespace robosim
