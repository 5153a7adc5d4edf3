#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "hardware/command.h"
#include "net/remote.pb.h"
#include "net/wire_error.h"

namespace robosim {

/// @file
/// The conversation of a remote control with a robot (remote.proto) between our values and protobuf's.

/// What a message is about; the words are 2005's as far as there were any then. See remote.proto for each.
enum class RemoteType : std::uint8_t {
  init,
  init_ack,
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

/// What a remote control says. Which members count, the type says.
struct RemoteOrder {
  RemoteType type = RemoteType::alive;
  std::string robot{}, driver{};         ///< init
  bool autonomous = false;               ///< init, init_ack
  bool only_watch = false;               ///< init
  std::optional<double> speed_mps{};     ///< drive: nullopt for what it is
  std::optional<double> turn_radps{};    ///< drive; counter-clockwise
  std::optional<float> laser_pan_rad{};  ///< drive
};

/// How a robot stands with its remote controls.
struct RemoteState {
  bool autonomous = true;  ///< its own controller drives
  std::string driver{};    ///< whose robot it is; empty for nobody's
  bool is_yours = false;   ///< whether that is whoever is told this
  double speed_mps = 0;    ///< what it is commanded
  double turn_radps = 0;
  Activity activity = Activity::active;
  std::string why_stopped{};       ///< why it does not do what its driver said last; empty when it does
  std::string winner{};            ///< the robot that has won: all halt; empty for as long as none has
  std::uint32_t win_refusals = 0;  ///< how often it has asked whether it has won, and was too far from the gold
  bool operator==(const RemoteState&) const = default;
};

/// The most of a driver's name.
constexpr std::size_t kMaxDriverBytes = 60;

void encode(const RemoteOrder& order, wire::ToRobot& out);
/// @throws WireError for an unknown type, another protocol, a number that is not finite, or too long a name.
RemoteOrder decode(const wire::ToRobot& in);

void encode(const RemoteState& state, wire::RemoteState& out);
/// @throws WireError for numbers that are not finite, or an unknown activity.
RemoteState decode(const wire::RemoteState& in);

}  // namespace robosim
