#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "net/remote_wire.h"

namespace robosim {

/// What a page of the console says: a JSON object, {"type": "drive", "speed": 0.5, "turn": -0.2}. Members that a type
/// does not have are an error, so that a misspelt one is never lost silently.
struct PageMessage {
  enum class Type {
    hello,       ///< protocol, name, token: first of all
    ack,         ///< number: an update has been shown
    take,        ///< the wheel, if nobody has it
    release,     ///< the wheel
    steer,       ///< `order`: accelerate, decelerate, turn_left, turn_right, stop (why), alive, check_win, req_…
    drive,       ///< speed, turn, pan
    autonomous,  ///< on: the primary's own controller is to drive
    switching,   ///< "switch": to `robot`, or to the next
    live,        ///< on: sensors' readings with every update, not only on request
    map,         ///< on: the world from above
  };
  Type type = Type::hello;
  RemoteType order = RemoteType::alive;
  std::uint32_t protocol = 0;
  std::string name, token, robot, why;
  std::uint64_t number = 0;
  std::optional<double> speed;    ///< as a part of the robot's most, [-1, 1]
  std::optional<double> turn;     ///< the same, counter-clockwise
  std::optional<double> pan_rad;  ///< "pan", as a part of 90°, [-1, 1]
  bool on = false;

  /// @throws WireError for what makes no sense.
  static PageMessage parse(std::string_view text);
};

}  // namespace robosim
