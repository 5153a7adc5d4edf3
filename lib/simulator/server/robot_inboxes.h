#pragma once
#include <cstdint>
#include <deque>
#include <vector>

#include "hardware/robot_message.h"

namespace robosim {

/// Messages delivered to networked robots that their processes have not confirmed yet. A process confirms a step by
/// answering it, so that messages are kept for processes that are late or have lost their connection.
class RobotInboxes {
 public:
  /// Bounds per robot, besides the messages of the newest step; beyond them the oldest messages are dropped.
  static constexpr std::size_t kMessagesMax = 1000;
  static constexpr std::size_t kBytesMax = 256 * 1024;  ///< of texts

  void reset(std::size_t robots);
  /// Continues with further robots.
  void addRobots(std::size_t robots) { inboxes_.resize(robots); }
  /// Adds the messages that a step delivered to a robot.
  void add(std::size_t robot, std::uint64_t step, const std::vector<RobotMessage>& messages);
  /// Records that the robot's process has received the readings of all steps up to `step`.
  void confirm(std::size_t robot, std::uint64_t step);
  /// Unconfirmed messages of a robot, the oldest first.
  std::vector<RobotMessage> unconfirmed(std::size_t robot) const;
  std::size_t count(std::size_t robot) const { return inboxes_[robot].items.size(); }
  /// Number of messages dropped, over all robots.
  std::uint64_t dropped() const { return dropped_; }

 private:
  struct Item {
    std::uint64_t step;
    RobotMessage message;
  };
  struct Inbox {
    std::deque<Item> items;
    std::size_t bytes = 0;  ///< of their texts
  };
  static void drop(Inbox& inbox);

  std::vector<Inbox> inboxes_;  ///< by robot
  std::uint64_t dropped_ = 0;
};

}  // namespace robosim
