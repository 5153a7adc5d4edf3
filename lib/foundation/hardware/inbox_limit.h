#pragma once
#include <cstddef>

#include "hardware/robot_message.h"

namespace robosim {

/// Limits the messages that one robot receives in one step, so that its packet stays below gRPC's maximum message size
/// (4 MiB by default). Messages are admitted in order until one would exceed the limit.
class InboxLimit {
 public:
  static constexpr std::size_t kMaxMessages = 1024;
  static constexpr std::size_t kMaxBytes = 256 * 1024;  ///< of names and texts

  /// Counts a message if it is within the limit. @return whether it is
  bool admit(const std::string& from, const std::string& to, const std::string& text) {
    const std::size_t bytes = bytes_ + from.size() + to.size() + text.size();
    if (messages_ == kMaxMessages || bytes > kMaxBytes) return false;
    ++messages_;
    bytes_ = bytes;
    return true;
  }
  bool admit(const RobotMessage& message) { return admit(message.from, message.to, message.text); }

 private:
  std::size_t messages_ = 0;
  std::size_t bytes_ = 0;
};

/// Maximum number of messages that a robot sends in one step. A broadcast is one message.
constexpr std::size_t kMaxMessagesSent = 1024;

}  // namespace robosim
