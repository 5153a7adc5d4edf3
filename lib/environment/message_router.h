#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "base/sim_time.h"
#include "hardware/command.h"
#include "hardware/inbox_limit.h"
#include "hardware/readings.h"
#include "world/world.h"

namespace robosim {

/// A message that awaits its delivery.
struct PendingMessage {
  std::uint32_t to = 0;  ///< index of the receiver
  std::string text;
  bool operator==(const PendingMessage&) const = default;
};

/// Messages that a robot has sent since the last step, in the order of sending.
struct Outbox {
  std::vector<PendingMessage> messages;  ///< at most kMaxMessagesSent
  std::uint64_t surplus = 0;             ///< number of messages beyond kMaxMessagesSent
  bool operator==(const Outbox&) const = default;
};

/// Delivers messages between the robots of a world: a message sent in one step arrives in the next. The messages are in
/// the outboxes of its caller.
class MessageRouter {
 public:
  MessageRouter(std::vector<std::string> names, const Communication& communication);

  /// By robot.
  const std::vector<std::string>& names() const { return names_; }

  /// Queues a message in the outbox of its sender `from`. May be called for different senders from different threads.
  /// @throws std::invalid_argument for an unknown receiver or a text that is too long
  void send(std::size_t from, const std::string& to, const std::string& text, Outbox& outbox) const;

  struct Delivery {
    std::size_t delivered = 0;
    std::size_t dropped = 0;  ///< messages beyond the limits of their sender or receiver in one step
  };
  /// Moves the messages of all outboxes to the inboxes of their receivers, ordered by sender and then by time of
  /// sending. Messages of and to absent robots, to a robot out of range, or selected by the loss probability, are lost.
  /// Messages beyond the sender's kMaxMessagesSent or the receiver's InboxLimit are dropped.
  /// @param seed of the loss of messages @pre the inboxes are empty
  Delivery deliver(std::uint64_t seed, SimTime now, std::span<const mrpt::math::TPose2D> world_from_robot,
                   std::span<const Activity> activity, std::span<Outbox> outboxes, std::span<Readings> readings);

 private:
  bool arrives(std::uint64_t seed, SimTime now, std::size_t from, std::size_t index, std::size_t to,
               std::span<const mrpt::math::TPose2D> world_from_robot) const;

  std::vector<std::string> names_;
  std::vector<std::uint32_t> by_name_;  ///< indices of robots, sorted by name
  Communication communication_;
  std::vector<InboxLimit> limits_;     ///< by receiver; unused ones between two calls of deliver()
  std::vector<std::uint32_t> filled_;  ///< receivers of messages in this call of deliver()
};

}  // namespace robosim
