#pragma once
#include <string>

namespace robosim {

/// A message between two robots of a world. Delivered in the step after it was sent.
struct RobotMessage {
  std::string from, to;  ///< robots' names; `from` is filled in by the hardware
  std::string text;      ///< any content, at most kMaxMessageBytes
  bool operator==(const RobotMessage&) const = default;
};

constexpr std::size_t kMaxMessageBytes = 4096;

}  // namespace robosim
