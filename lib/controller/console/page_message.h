#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "remote/orders.h"

namespace robosim {

/// Requests of a page to the console itself. All other messages of pages are orders to the primary robot (kOrders).
enum class ConsoleRequest : std::uint8_t {
  hello,           ///< protocol, name, token: the first message
  ack,             ///< number: an update has been drawn
  ping,            ///< number: requests a pong, to measure the round trip
  live,            ///< on: sensors' readings with every update, not only on request
  map,             ///< on: true poses, seen from above
  take,            ///< acquires the control lock, if it is free
  release,         ///< releases the control lock
  switch_primary,  ///< "switch": to `robot`, or to the next
  play_again,      ///< loads and starts the world again after the end of the run
  record,          ///< on: starts or stops the recording of the run
  join,            ///< name, team: a visitor waits for a round
  leave,           ///< the visitor no longer does, or ends the round
  start,           ///< the visitor who was called begins the round
  skip,            ///< ends the round, or calls the next visitor
};
constexpr std::size_t kConsoleRequests = static_cast<std::size_t>(ConsoleRequest::skip) + 1;

/// Message of a page to the console: a JSON object, {"type": "drive", "speed": 0.5, "turn": -0.2}. Unknown members are
/// an error.
struct PageMessage {
  using Type = std::variant<ConsoleRequest, OrderType>;
  static constexpr std::size_t kTypes = kConsoleRequests + kOrders.size();

  Type type = ConsoleRequest::hello;
  std::uint32_t protocol = 0;
  std::string name, token, robot, why, team;
  std::uint64_t number = 0;
  std::optional<double> speed;    ///< fraction of the robot's maximum, [-1, 1]
  std::optional<double> turn;     ///< the same, counter-clockwise
  std::optional<double> pan_rad;  ///< "pan", as a fraction of 90°, [-1, 1]
  bool on = false;

  /// @throws WireError for an invalid message.
  static PageMessage parse(std::string_view text);
};

/// Syntax of a message of pages, and what it requires. No message is handled before its rule was checked
/// (page_authorization.h).
struct PageMessageRow {
  /// Right of the page's token.
  enum class Right : std::uint8_t {
    none,                      ///< moves no robot, and shows only what every page receives
    look,                      ///< true poses: the right to watch the run
    drive_primary,             ///< the right to drive the primary robot
    drive_primary_and_target,  ///< the right to drive the primary robot and the one that becomes primary
    operate,                   ///< the right to control the run
  };
  /// State of the page.
  enum class Page : std::uint8_t {
    any,
    admitted,    ///< its hello was accepted
    holds_lock,  ///< it holds the control lock
  };

  PageMessage::Type type;
  const char* name;
  std::array<const char*, 3> members;  ///< that it may have
  Right right;
  Page page;
  PrimaryState primary;
};

/// Those to the console, then the orders.
const std::array<PageMessageRow, PageMessage::kTypes>& pageMessageRows();
const PageMessageRow& rowOf(PageMessage::Type type);

}  // namespace robosim
