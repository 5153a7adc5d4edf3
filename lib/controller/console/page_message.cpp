#include "console/page_message.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "base/utf8.h"

namespace robosim {
namespace {

using nlohmann::json;
using Page = PageMessageRow::Page;
using Needs = PageMessageRow::Right;

constexpr auto kConsoleRows = std::to_array<PageMessageRow>({
    {ConsoleRequest::hello, "hello", {"protocol", "name", "token"}, Needs::none, Page::any, PrimaryState::any},
    {ConsoleRequest::ack, "ack", {"number"}, Needs::none, Page::admitted, PrimaryState::any},
    {ConsoleRequest::ping, "ping", {"number"}, Needs::none, Page::admitted, PrimaryState::any},
    {ConsoleRequest::live, "live", {"on"}, Needs::none, Page::admitted, PrimaryState::any},
    {ConsoleRequest::map, "map", {"on"}, Needs::look, Page::admitted, PrimaryState::any},
    {ConsoleRequest::take, "take", {}, Needs::drive_primary, Page::admitted, PrimaryState::settled},
    {ConsoleRequest::release, "release", {}, Needs::none, Page::holds_lock, PrimaryState::any},
    {ConsoleRequest::switch_primary,
     "switch",
     {"robot"},
     Needs::drive_primary_and_target,
     Page::holds_lock,
     PrimaryState::settled},
    {ConsoleRequest::play_again, "play_again", {}, Needs::operate, Page::holds_lock, PrimaryState::any},
    {ConsoleRequest::record, "record", {"on"}, Needs::operate, Page::holds_lock, PrimaryState::any},
    {ConsoleRequest::join, "join", {"name", "team"}, Needs::drive_primary, Page::admitted, PrimaryState::any},
    {ConsoleRequest::leave, "leave", {}, Needs::none, Page::admitted, PrimaryState::any},
    {ConsoleRequest::start, "start", {}, Needs::drive_primary, Page::admitted, PrimaryState::any},
    {ConsoleRequest::skip, "skip", {}, Needs::operate, Page::admitted, PrimaryState::any},
});
static_assert(kConsoleRows.size() == kConsoleRequests);

/// Readings of the primary are sent to every page: only an order of a driver requires the control lock and a token for
/// the robot.
constexpr PageMessageRow rowOfOrder(const OrderRow& order) {
  const bool drives = order.right == Right::drive;
  return {order.type,
          order.name,
          order.members,
          drives ? Needs::drive_primary : Needs::none,
          drives ? Page::holds_lock : Page::admitted,
          order.primary};
}

constexpr std::size_t rowIndex(PageMessage::Type type) {
  const auto* request = std::get_if<ConsoleRequest>(&type);
  return request ? static_cast<std::size_t>(*request) : kConsoleRequests + indexOf(std::get<OrderType>(type));
}

constexpr std::array<PageMessageRow, PageMessage::kTypes> kRows = [] {
  std::array<PageMessageRow, PageMessage::kTypes> rows{};
  std::copy(kConsoleRows.begin(), kConsoleRows.end(), rows.begin());
  std::transform(kOrders.begin(), kOrders.end(), rows.begin() + kConsoleRequests, rowOfOrder);
  return rows;
}();

static_assert(std::all_of(kRows.begin(), kRows.end(),
                          [](const PageMessageRow& row) { return &kRows[rowIndex(row.type)] == &row; }),
              "a type's row is at its index");

bool hasMember(const PageMessageRow& row, const std::string& member) {
  return std::any_of(row.members.begin(), row.members.end(), [&](const char* name) { return name && member == name; });
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
  if (member == "team") message.team = textOf(value, member, kMaxDriverBytes);
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

const std::array<PageMessageRow, PageMessage::kTypes>& pageMessageRows() { return kRows; }

const PageMessageRow& rowOf(PageMessage::Type type) { return kRows[rowIndex(type)]; }

PageMessage PageMessage::parse(std::string_view text) {
  const json object = json::parse(text, nullptr, false);
  if (object.is_discarded() || !object.is_object()) throw WireError("a message that is not a JSON object");
  const auto type = object.find("type");
  const std::string name = type != object.end() && type->is_string() ? type->get<std::string>() : "";
  const auto* const row =
      std::find_if(kRows.begin(), kRows.end(), [&](const PageMessageRow& known) { return name == known.name; });
  if (row == kRows.end()) throw WireError("a message without a known type");
  PageMessage message;
  message.type = row->type;
  for (const auto& [member, value] : object.items()) {
    if (member == "type") continue;
    if (!hasMember(*row, member)) {
      throw WireError("a message of the type '" + name + "' with " + inQuotes(member) + ", which it does not have");
    }
    read(member, value, message);
  }
  if (message.type == PageMessage::Type(ConsoleRequest::hello)) checkProtocol(message.protocol);
  return message;
}

}  // namespace robosim
