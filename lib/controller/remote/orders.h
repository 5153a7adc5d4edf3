#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "hardware/sensor_info.h"
#include "net/token_table.h"
#include "net/wire_error.h"
#include "robosim/v1/remote_control.pb.h"

namespace robosim {

/// @file
/// Orders of a driver to a robot: kOrders has a row for each. The syntax and the rights of a page's messages
/// (console/page_message.h), the list of the page (console/page/orders.js), OrderLimiter, the queues of RobotLink,
/// ResponseOutbox and RemoteControlRobot, and DriveCommandFilter derive from it. An order itself is a
/// v1::ControlRequest, from the console to the robot.

/// Types of orders, in the sequence in which RobotLink sends those that wait. Named as in 2005 where that system has
/// them.
enum class OrderType : std::uint8_t {
  set_mode,  ///< INIT_ACK in 2005
  stop,
  drive,
  accelerate,
  decelerate,
  turn_left,
  turn_right,
  check_win,
  req_heat,
  req_laser,
  req_sonar,
  alive,
};

/// What an order does to others that wait, and how it takes effect.
enum class OrderRule : std::uint8_t {
  mode,     ///< selects autonomous or remote control at once; discards all that would move the robot
  stop,     ///< at once; discards all that would move the robot. No later order supersedes it
  set,      ///< sets values: of successive ones, the newest of each field counts
  steer,    ///< changes the speed or turns by a fixed amount; of several within a step the newest counts
  at_once,  ///< independent of the others
  request,  ///< of a reading: not an input of the driver, so that it neither needs one nor proves that one is present
};

/// State of a console's primary robot that an order of a page requires.
enum class PrimaryState : std::uint8_t {
  any,
  settled,  ///< no switch to another robot is pending
  known,    ///< settled, and it has been connected, so that its limits are known
};

struct OrderRow {
  OrderType type;
  const char* name;                         ///< `type` of a page's message
  std::array<const char*, 3> members;       ///< that a page's message may have
  v1::ControlRequest::RequestCase request;  ///< the message
  OrderRule rule;
  Right right;  ///< of the token
  PrimaryState primary;
  v1::ControlRequest::Steering steering{};  ///< rule `steer`
  int speed_tenths = 0;                     ///< rule `steer`: change of the speed, in tenths of the robot's maximum
  double turn_part = 0;                     ///< rule `steer`: turn for a moment, fraction of the maximum; to the left
  SensorKind sensor = SensorKind::unknown;  ///< rule `request`
};

/// `stop` and `alive` are permitted during a switch, so that no stop is lost.
inline constexpr auto kOrders = [] {
  using Request = v1::ControlRequest;
  using enum OrderRule;
  using enum PrimaryState;
  const auto steering = [](OrderType type, const char* name, Request::Steering of, int speed_tenths, double turn_part) {
    return OrderRow{type, name, {}, Request::kSteer, steer, Right::drive, settled, of, speed_tenths, turn_part};
  };
  const auto reading = [](OrderType type, const char* name, SensorKind sensor) {
    return OrderRow{type, name, {}, Request::kReqReading, request, Right::look, any, {}, 0, 0, sensor};
  };
  return std::to_array<OrderRow>({
      {OrderType::set_mode, "autonomous", {"on"}, Request::kSetMode, mode, Right::drive, settled},
      {OrderType::stop, "stop", {"why"}, Request::kStop, stop, Right::drive, any},
      {OrderType::drive, "drive", {"speed", "turn", "pan"}, Request::kDrive, set, Right::drive, known},
      steering(OrderType::accelerate, "accelerate", Request::STEERING_ACCELERATE, 1, 0),
      steering(OrderType::decelerate, "decelerate", Request::STEERING_DECELERATE, -1, 0),
      steering(OrderType::turn_left, "turn_left", Request::STEERING_TURN_LEFT, 0, 0.5),
      steering(OrderType::turn_right, "turn_right", Request::STEERING_TURN_RIGHT, 0, -0.5),
      {OrderType::check_win, "check_win", {}, Request::kCheckWin, at_once, Right::drive, settled},
      reading(OrderType::req_heat, "req_heat", SensorKind::heat),
      reading(OrderType::req_laser, "req_laser", SensorKind::laser),
      reading(OrderType::req_sonar, "req_sonar", SensorKind::sonar),
      {OrderType::alive, "alive", {}, Request::kAlive, at_once, Right::drive, any},
  });
}();

constexpr std::size_t indexOf(OrderType type) { return static_cast<std::size_t>(type); }
constexpr const OrderRow& rowOf(OrderType type) { return kOrders[indexOf(type)]; }

static_assert(std::all_of(kOrders.begin(), kOrders.end(), [](const OrderRow& row) { return &rowOf(row.type) == &row; }),
              "an order's row is at its index");

/// The requests of readings are successive rows: readings of a robot on request are arrays of kReadings elements.
constexpr std::size_t kReadings = static_cast<std::size_t>(
    std::count_if(kOrders.begin(), kOrders.end(), [](const OrderRow& row) { return row.rule == OrderRule::request; }));
constexpr std::size_t readingIndex(OrderType request) { return indexOf(request) - indexOf(OrderType::req_heat); }
constexpr const OrderRow& readingRow(std::size_t reading) { return kOrders[indexOf(OrderType::req_heat) + reading]; }
static_assert(readingRow(0).rule == OrderRule::request && readingRow(kReadings - 1).rule == OrderRule::request);

/// Whether an order that waits has no effect any more after a newer one of another type.
constexpr bool supersedes(OrderRule newer, OrderRule older) {
  switch (newer) {
    case OrderRule::mode:
    case OrderRule::stop:
      return older == OrderRule::stop || older == OrderRule::set || older == OrderRule::steer;
    case OrderRule::set:
    case OrderRule::steer:
      return older == OrderRule::steer;
    default:
      return false;
  }
}

/// @name Orders as messages
///@{
/// An order whose members, if it has any, are not set.
v1::ControlRequest makeOrder(OrderType type);
/// Absent values are unchanged.
v1::ControlRequest driveOrder(std::optional<double> speed_mps, std::optional<double> turn_radps = {},
                              std::optional<double> laser_pan_rad = {}, std::optional<double> lateral_mps = {});
/// @param why reason, if the driver has not requested the stop; truncated to kMaxWhyBytes
v1::ControlRequest stopOrder(std::string_view why = "");
v1::ControlRequest modeOrder(bool autonomous);

/// @throws WireError for a message that is no order of kOrders, with the types that there are.
OrderType typeOf(const v1::ControlRequest& order);
/// The reason of a STOP, truncated to kMaxWhyBytes; empty for one that the driver has requested.
std::string_view whyOf(const v1::ControlRequest& stop);
/// The DRIVE with the effect of `older` followed by `newer`: what `newer` omits, `older` specifies. Where the newest of
/// several orders counts, an older DRIVE that sets the speed to 0 must not get lost to one that only turns.
/// @pre both are DRIVE orders
v1::ControlRequest mergeDrive(v1::ControlRequest older, const v1::ControlRequest& newer);
///@}

/// Maximum length of a driver's name (longer names are refused) and of a reason to stop (longer reasons are truncated
/// at a UTF-8 boundary by sender and receiver).
constexpr std::size_t kMaxDriverBytes = 60;
constexpr std::size_t kMaxWhyBytes = 120;

/// @name Validation of untrusted input
///@{
/// Checks a text that a person entered.
/// @param what description of the text, for errors
/// @throws WireError for a text that is longer than `max_bytes` or has control characters.
void checkText(std::string_view text, std::size_t max_bytes, const char* what);
/// @throws WireError for an unknown request, another protocol version, a number that is not finite, or too long a name.
void validate(const v1::ControlRequest& request);
/// @throws WireError for numbers that are not finite, or an unknown activity.
void validate(const v1::RobotState& state);
///@}

/// A robot as long as nothing else is known: autonomous and active.
v1::RobotState initialState();

}  // namespace robosim
