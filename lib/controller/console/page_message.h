#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "net/remote_wire.h"

namespace robosim {

/// Message of a page to the console: a JSON object, {"type": "drive", "speed": 0.5, "turn": -0.2}. Unknown members are
/// an error. Which page may send which message: page_authorization.h.
struct PageMessage {
  enum class Type : std::uint8_t {
    hello,           ///< protocol, name, token: the first message
    ack,             ///< number: an update has been drawn
    ping,            ///< number: requests a pong, to measure the round trip
    live,            ///< on: sensors' readings with every update, not only on request
    map,             ///< on: true poses, seen from above
    req_heat,        ///< requests one reading
    req_laser,       ///< the same
    req_sonar,       ///< the same
    take,            ///< acquires the control lock, if it is free
    release,         ///< releases the control lock
    drive,           ///< speed, turn, pan
    accelerate,      ///< by a tenth of the robot's maximum speed
    decelerate,      ///< the same
    turn_left,       ///< for a moment
    turn_right,      ///< the same
    stop,            ///< why: the reason, if the driver did not request it
    alive,           ///< the driver is present
    check_win,       ///< requests CheckWin
    autonomous,      ///< on: the primary's own controller drives
    switch_primary,  ///< "switch": to `robot`, or to the next
    play_again,      ///< loads and starts the world again after the end of the run
    record,          ///< on: starts or stops the recording of the run
  };
  static constexpr std::size_t kTypes = 22;

  Type type = Type::hello;
  std::uint32_t protocol = 0;
  std::string name, token, robot, why;
  std::uint64_t number = 0;
  std::optional<double> speed;    ///< fraction of the robot's maximum, [-1, 1]
  std::optional<double> turn;     ///< the same, counter-clockwise
  std::optional<double> pan_rad;  ///< "pan", as a fraction of 90°, [-1, 1]
  bool on = false;

  /// @throws WireError for an invalid message.
  static PageMessage parse(std::string_view text);
};

/// The name of a type in JSON, "drive" for example.
const char* nameOf(PageMessage::Type type);

/// All types, in the order of the enumeration.
constexpr std::array<PageMessage::Type, PageMessage::kTypes> pageMessageTypes() {
  std::array<PageMessage::Type, PageMessage::kTypes> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<PageMessage::Type>(i);
  return all;
}

}  // namespace robosim
