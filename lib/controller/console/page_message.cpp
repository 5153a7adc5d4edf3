#include "console/page_message.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include <nlohmann/json.hpp>

#include "base/utf8.h"

namespace robosim {
namespace {

using nlohmann::json;
using Type = PageMessage::Type;

struct Syntax {
  Type type;
  const char* name;
  std::array<const char*, 3> members{};  ///< that it may have
};

constexpr std::array<Syntax, PageMessage::kTypes> kSyntax{{
    {Type::hello, "hello", {"protocol", "name", "token"}},
    {Type::ack, "ack", {"number"}},
    {Type::ping, "ping", {"number"}},
    {Type::live, "live", {"on"}},
    {Type::map, "map", {"on"}},
    {Type::req_heat, "req_heat"},
    {Type::req_laser, "req_laser"},
    {Type::req_sonar, "req_sonar"},
    {Type::take, "take"},
    {Type::release, "release"},
    {Type::drive, "drive", {"speed", "turn", "pan"}},
    {Type::accelerate, "accelerate"},
    {Type::decelerate, "decelerate"},
    {Type::turn_left, "turn_left"},
    {Type::turn_right, "turn_right"},
    {Type::stop, "stop", {"why"}},
    {Type::alive, "alive"},
    {Type::check_win, "check_win"},
    {Type::autonomous, "autonomous", {"on"}},
    {Type::switch_primary, "switch", {"robot"}},
    {Type::play_again, "play_again"},
    {Type::record, "record", {"on"}},
}};

constexpr bool isEntryAtItsIndex() {
  for (std::size_t i = 0; i < kSyntax.size(); ++i) {
    if (static_cast<std::size_t>(kSyntax[i].type) != i) return false;
  }
  return true;
}
static_assert(isEntryAtItsIndex(), "a type's entry is at its index");

bool hasMember(const Syntax& syntax, const std::string& member) {
  return std::any_of(syntax.members.begin(), syntax.members.end(),
                     [&](const char* name) { return name && member == name; });
}

/// A fraction of the robot's maximum, clamped to [-1, 1].
double fraction(const json& value, const std::string& member) {
  if (!value.is_number() || !std::isfinite(value.get<double>())) {
    throw WireError("'" + member + "' must be a finite number");
  }
  return std::clamp(value.get<double>(), -1.0, 1.0);
}

std::uint64_t count(const json& value, const std::string& member) {
  if (!value.is_number_unsigned()) throw WireError("'" + member + "' must be a whole number, 0 or more");
  return value.get<std::uint64_t>();
}

enum class Excess { refuse, truncate };

std::string textOf(const json& value, const std::string& member, std::size_t max_bytes,
                   Excess excess = Excess::refuse) {
  if (!value.is_string()) throw WireError("'" + member + "' must be a text");
  auto text = value.get<std::string>();
  if (excess == Excess::truncate) text = utf8Prefix(text, max_bytes);
  checkText(text, max_bytes, ("'" + member + "'").c_str());
  return text;
}

void read(const std::string& member, const json& value, PageMessage& message) {
  constexpr std::size_t max_token_bytes = 1024;
  constexpr std::size_t max_robot_bytes = 256;
  if (member == "protocol")
    message.protocol = static_cast<std::uint32_t>(std::min<std::uint64_t>(count(value, member), UINT32_MAX));
  if (member == "number") message.number = count(value, member);
  if (member == "name") message.name = textOf(value, member, kMaxDriverBytes);
  if (member == "token") message.token = textOf(value, member, max_token_bytes);
  if (member == "robot") message.robot = textOf(value, member, max_robot_bytes);
  if (member == "why") message.why = textOf(value, member, kMaxWhyBytes, Excess::truncate);
  if (member == "speed") message.speed = fraction(value, member);
  if (member == "turn") message.turn = fraction(value, member);
  if (member == "pan") message.pan_rad = fraction(value, member) * M_PI_2;
  if (member == "on") {
    if (!value.is_boolean()) throw WireError("'on' must be true or false");
    message.on = value.get<bool>();
  }
}

}  // namespace

const char* nameOf(PageMessage::Type type) { return kSyntax[static_cast<std::size_t>(type)].name; }

PageMessage PageMessage::parse(std::string_view text) {
  const json object = json::parse(text, nullptr, false);
  if (object.is_discarded() || !object.is_object()) throw WireError("a message that is not a JSON object");
  const auto type = object.find("type");
  const std::string name = type != object.end() && type->is_string() ? type->get<std::string>() : "";
  const auto* const syntax =
      std::find_if(kSyntax.begin(), kSyntax.end(), [&](const Syntax& known) { return name == known.name; });
  if (syntax == kSyntax.end()) throw WireError("a message without a known type");
  PageMessage message;
  message.type = syntax->type;
  for (const auto& [member, value] : object.items()) {
    if (member == "type") continue;
    if (!hasMember(*syntax, member)) {
      throw WireError("a message of the type '" + name + "' with " + inQuotes(member) + ", which it does not have");
    }
    read(member, value, message);
  }
  if (message.type == Type::hello) checkProtocol(message.protocol);
  return message;
}

}  // namespace robosim
