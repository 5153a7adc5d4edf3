#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <mrpt/math/TPose2D.h>

#include "base/rare.h"
#include "base/sim_time.h"
#include "environment/radio_channel.h"
#include "environment/repeated_values.h"
#include "environment/robot_names.h"
#include "hardware/command.h"
#include "hardware/inbox_limit.h"
#include "hardware/readings.h"
#include "world/world.h"

namespace robosim {

/// PendingMessage::to of a broadcast: every robot of the world but the sender.
constexpr std::uint32_t kEveryOtherRobot = 0xffffffff;

/// A message that awaits its delivery.
struct PendingMessage {
  std::uint32_t to = 0;  ///< index of the receiver, or kEveryOtherRobot
  std::string text;
  bool operator==(const PendingMessage&) const = default;

  bool isBroadcast() const { return to == kEveryOtherRobot; }
  /// Number of robots that it is sent to, in a world of `robots`.
  std::uint64_t receiversOf(std::size_t robots) const { return isBroadcast() ? robots - 1 : 1; }
};

/// Messages that a robot has sent since the last step, in the order of sending. A broadcast is one of them. A robot
/// that has sent none has no outbox.
struct Outbox {
  std::vector<PendingMessage> messages;  ///< at most kMaxMessagesSent
  std::uint64_t surplus = 0;             ///< number of messages beyond kMaxMessagesSent
  bool operator==(const Outbox&) const = default;
};

/// A message on its way to a receiver, delayed by Communication::delay_s.
struct MessageInFlight {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint64_t due_step = 0;  ///< in which it arrives
  std::string text;
  bool operator==(const MessageInFlight&) const = default;
};

/// Numbers of messages that did not arrive, by cause. A broadcast counts once for each receiver.
struct MessageLosses {
  std::uint64_t out_of_range = 0;
  std::uint64_t stopped_by_walls = 0;
  std::uint64_t by_chance = 0;
  std::uint64_t in_bursts = 0;
  std::uint64_t absent = 0;  ///< the receiver is not in the world
  bool operator==(const MessageLosses&) const = default;

  std::uint64_t total() const { return out_of_range + stopped_by_walls + by_chance + in_bursts + absent; }
  void operator+=(const MessageLosses& more) {
    out_of_range += more.out_of_range;
    stopped_by_walls += more.stopped_by_walls;
    by_chance += more.by_chance;
    in_bursts += more.in_bursts;
    absent += more.absent;
  }
};

/// Numbers of messages of a run so far, by their fate. A broadcast counts once for each receiver, unless its sender's
/// limit drops it.
struct MessageCounts {
  std::uint64_t delivered = 0;
  std::uint64_t dropped = 0;  ///< beyond the limits of their sender or receiver in one step
  MessageLosses lost;
};

/// Delivers messages between the robots of a world: a message sent in one step arrives in the next, or later
/// (Communication::delay_s, rate_hz). The messages are in the outboxes and the queue of its caller.
class MessageRouter {
 public:
  /// @param robots must outlive this object
  MessageRouter(std::span<const FleetRobot> robots, const Communication& communication);
  MessageRouter(const MessageRouter&) = delete;  // channel_ refers to communication_
  MessageRouter& operator=(const MessageRouter&) = delete;

  /// Replaces the robots; those with the same index remain the same.
  void setRobots(std::span<const FleetRobot> robots);

  /// Replaces limits and errors of the radio; messages in flight arrive when they were to arrive before.
  void setCommunication(const Communication& communication) { communication_ = communication; }

  const RobotNames& names() const { return names_; }

  /// Queues a message in the outbox of its sender `from`. May be called for different senders from different threads.
  /// @throws std::invalid_argument for an unknown receiver or a text that is too long
  void send(std::size_t from, const std::string& to, const std::string& text, Rare<Outbox>& outbox) const;
  /// The same for one message to every other robot.
  void broadcast(std::size_t from, const std::string& text, Rare<Outbox>& outbox) const;

  /// Inserts a message into those in flight that arrives with the next delivery.
  /// @throws std::invalid_argument for a text that is too long
  void receiveNext(const SimTime& now, std::uint32_t to, std::uint32_t from, const std::string& text,
                   std::vector<MessageInFlight>& in_flight) const;

  /// The robots in a step.
  struct Robots {
    const Scene& scene;  ///< whose moving solids are the robots; a broadcast of limited range finds its receivers in it
    std::span<const mrpt::math::TPose2D> world_from_robot;
    const RepeatedValues<double>& antenna_z_m;  ///< heights of the antennas
    std::span<const Activity> activity;
    /// 0: the robot has no outbox, 1: perhaps. Updated by deliver().
    std::span<std::uint8_t> may_send;

    mrpt::math::TPoint3D antenna(std::size_t robot) const {
      return {world_from_robot[robot].x, world_from_robot[robot].y, antenna_z_m[robot]};
    }
  };
  /// Moves the messages of all outboxes to the inboxes of their receivers, or to those in flight and from there to the
  /// inboxes when they are due, ordered by sender and then by time of sending. Messages of and to absent robots, and
  /// those that the RadioChannel loses, are lost; its errors are those of the step in which a message is sent. Messages
  /// beyond Communication::rate_hz wait in their outbox. Messages beyond the sender's kMaxMessagesSent or the
  /// receiver's InboxLimit are dropped. A broadcast counts once for the limits of its sender, and is received like as
  /// many messages, in the world's order of their receivers.
  /// @param seed of the loss of messages @param in_flight ordered by due_step, then by sender
  /// @pre the inboxes are empty
  MessageCounts deliver(std::uint64_t seed, SimTime now, const Robots& robots, std::span<Rare<Outbox>> outboxes,
                        std::vector<MessageInFlight>& in_flight, std::span<Readings> readings);
  /// The robots into whose inboxes the last call of deliver() has put messages, each once.
  const std::vector<std::uint32_t>& receivers() const { return receivers_; }

 private:
  struct Delivery;
  /// @throws std::invalid_argument for a text that is too long
  void requireShort(std::size_t from, const std::string& to, const std::string& text) const;
  static void queue(PendingMessage message, Rare<Outbox>& outbox);
  /// Moves the messages of one outbox.
  void deliverFrom(std::uint32_t from, Rare<Outbox>& kept, Delivery& delivery);
  /// Sends a broadcast on its way to each receiver. @param index as of transmit(), of the first receiver
  void transmitToAll(std::uint32_t from, std::size_t index, const std::string& text, Delivery& delivery);
  /// Sends a message on its way to one receiver. @param index of the message among those of its sender in this step
  template <typename Text>
  void transmit(std::uint32_t from, std::uint32_t to, std::size_t index, Text&& text, Delivery& delivery);
  /// Puts a message into the inbox of its receiver.
  template <typename Text>
  void receive(std::uint32_t from, std::uint32_t to, Text&& text, Delivery& delivery);

  RobotNames names_;
  Communication communication_;
  RadioChannel channel_{communication_};
  /// By receiver; unused ones between two calls of deliver(), and empty until the first message arrives.
  std::vector<InboxLimit> limits_;
  std::vector<std::uint32_t> receivers_;
  std::vector<std::uint32_t> near_;  ///< memory of transmitToAll()
};

}  // namespace robosim
