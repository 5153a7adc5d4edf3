#pragma once
#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "hardware/real_robot.h"

namespace robosim {

/// The end of a log that is replayed.
class ChannelEnd : public RobotLinkError {
 public:
  using RobotLinkError::RobotLinkError;
};

/// Two-way stream of bytes to a robot, with its clock.
class ByteChannel {
 public:
  using Clock = std::chrono::steady_clock;

  virtual ~ByteChannel() = default;
  /// Waits for bytes. @return those that have arrived; empty when none has within the time
  /// @throws RobotLinkError when the connection has ended
  virtual std::string read(Clock::duration timeout) = 0;
  /// @throws RobotLinkError when the connection has ended
  virtual void write(std::string_view bytes) = 0;
  virtual Clock::time_point now() const { return Clock::now(); }
  /// Bytes per second that it carries in each direction; nullopt: more than a robot sends.
  virtual std::optional<double> capacity() const { return std::nullopt; }
  /// "tcp:127.0.0.1:8101", for messages.
  virtual const std::string& name() const = 0;
};

}  // namespace robosim
