#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "hardware/command.h"
#include "net/wire_error.h"
#include "robosim/v1/remote_control.pb.h"

namespace robosim {

/// @file
/// Conversion of the messages between a remote control and a robot (remote_control.proto) between value types and
/// protobuf.

/// Type of an order; named as in 2005 where that system has it.
enum class RemoteType : std::uint8_t {
  init,
  set_mode,  ///< INIT_ACK in 2005
  accelerate,
  decelerate,
  turn_left,
  turn_right,
  req_heat,
  req_laser,
  req_sonar,
  drive,
  stop,
  alive,
  check_win,
  req_all,
};

/// Message from a remote control. `type` determines which other members are used.
struct RemoteOrder {
  RemoteType type = RemoteType::alive;
  std::string robot{}, driver{};         ///< init
  bool autonomous = false;               ///< init, set_mode
  bool only_observe = false;             ///< init
  std::optional<double> speed_mps{};     ///< drive: nullopt keeps the current value
  std::optional<double> turn_radps{};    ///< drive; counter-clockwise
  std::optional<float> laser_pan_rad{};  ///< drive
  std::string why{};                     ///< stop: the reason, if the driver did not request it
};

/// State of a robot as reported to its remote controls.
struct RemoteState {
  bool autonomous = true;  ///< its own controller drives
  std::string driver{};    ///< name of its driver; empty for none
  bool is_yours = false;   ///< whether the receiver of this message is its driver
  double speed_mps = 0;    ///< commanded speeds
  double turn_radps = 0;
  Activity activity = Activity::active;
  std::string why_stopped{};       ///< why its driver's last command is not executed; empty when it is
  std::string winner{};            ///< the robot that has won, upon which all halt; empty while there is none
  std::uint32_t win_refusals = 0;  ///< number of its CheckWin requests made too far from the gold
  bool stalled = false;            ///< its last motion was clipped
  /// Number of its stops with a reason, also of those whose why_stopped a later order has cleared.
  std::uint32_t stops = 0;
  /// Length of its path in this run, by odometry; nullopt for a robot without odometry.
  std::optional<double> driven_m{};
  bool is_stopping = false;  ///< its driver or the driver's absence has stopped it, and it still moves
  bool operator==(const RemoteState&) const = default;
};

/// Maximum length of a driver's name (longer names are refused) and of a reason to stop (longer reasons are truncated
/// at a UTF-8 boundary by sender and receiver).
constexpr std::size_t kMaxDriverBytes = 60;
constexpr std::size_t kMaxWhyBytes = 120;

/// Checks a text that a person entered.
/// @param what description of the text, for errors
/// @throws WireError for a text that is longer than `max_bytes` or has control characters.
void checkText(const std::string& text, std::size_t max_bytes, const char* what);

void encode(const RemoteOrder& order, v1::ControlRequest& out);
/// @throws WireError for an unknown request, another protocol version, a number that is not finite, or too long a name.
RemoteOrder decode(const v1::ControlRequest& in);

/// Name of the requested kind of sensor: "heat", "laser" or "sonar"; null for another type.
const char* requestedKind(RemoteType type);
/// Type of a request for a kind of sensor; nullopt for another kind.
std::optional<RemoteType> requestFor(const std::string& kind);

void encode(const RemoteState& state, v1::RobotState& out);
/// @throws WireError for numbers that are not finite, or an unknown activity.
RemoteState decode(const v1::RobotState& in);

}  // namespace robosim
