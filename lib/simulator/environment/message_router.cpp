#include "environment/message_router.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "environment/known_robots.h"

namespace robosim {
namespace {

/// Exceeds the rounding errors of a distance [m]: a search with it finds all robots that RadioChannel may reach.
constexpr double kSearchSlack_m = 1e-6;

/// Usually at the end: earlier only when the delay has become shorter, or for MessageRouter::receiveNext().
void insertInOrder(MessageInFlight arriving, std::vector<MessageInFlight>& in_flight) {
  const auto is_before = [](const MessageInFlight& a, const MessageInFlight& b) {
    return std::tie(a.due_step, a.from) < std::tie(b.due_step, b.from);
  };
  const auto place = in_flight.empty() || !is_before(arriving, in_flight.back())
                         ? in_flight.end()
                         : std::upper_bound(in_flight.begin(), in_flight.end(), arriving, is_before);
  in_flight.insert(place, std::move(arriving));
}

}  // namespace

/// One call of deliver().
struct MessageRouter::Delivery {
  std::uint64_t seed;
  SimTime now;
  const Robots& robots;
  std::vector<MessageInFlight>& in_flight;
  std::span<Readings> readings;
  MessageCounts counts = {};
  std::optional<std::size_t> present = std::nullopt;  ///< number of robots; known if it was needed

  std::size_t presentRobots() {
    const auto is_present = [](Activity activity) { return activity != Activity::absent; };
    if (!present) {
      const auto& activity = robots.activity;
      present = static_cast<std::size_t>(std::count_if(activity.begin(), activity.end(), is_present));
    }
    return *present;
  }
};

MessageRouter::MessageRouter(std::span<const FleetRobot> robots, const Communication& communication)
    : names_(robots), communication_(communication) {
  channel_.setRobots(robots.size());
}

void MessageRouter::setRobots(std::span<const FleetRobot> robots) {
  names_.setRobots(robots);
  limits_.clear();
  receivers_.clear();
  channel_.setRobots(robots.size());
}

void MessageRouter::send(std::size_t from, const std::string& to, const std::string& text, Rare<Outbox>& outbox) const {
  const auto found = names_.find(to);
  if (!found) {
    throw std::invalid_argument("a message from '" + names_[from] + "' to '" + to +
                                "': there is no robot of that name");
  }
  requireShort(from, to, text);
  queue({*found, text}, outbox);
}

void MessageRouter::broadcast(std::size_t from, const std::string& text, Rare<Outbox>& outbox) const {
  requireShort(from, "all", text);
  queue({kEveryOtherRobot, text}, outbox);
}

void MessageRouter::receiveNext(const SimTime& now, std::uint32_t to, std::uint32_t from, const std::string& text,
                                std::vector<MessageInFlight>& in_flight) const {
  requireShort(from, names_[to], text);
  insertInOrder({from, to, now.step + 1, text}, in_flight);
}

void MessageRouter::requireShort(std::size_t from, const std::string& to, const std::string& text) const {
  if (text.size() <= kMaxMessageBytes) return;
  throw std::invalid_argument("a message from '" + names_[from] + "' to '" + to + "' has " +
                              std::to_string(text.size()) + " bytes; the most is " + std::to_string(kMaxMessageBytes));
}

void MessageRouter::queue(PendingMessage message, Rare<Outbox>& outbox) {
  if (!outbox) outbox.emplace();
  if (outbox->messages.size() == kMaxMessagesSent) {
    ++outbox->surplus;
    return;
  }
  outbox->messages.push_back(std::move(message));
}

template <typename Text>
void MessageRouter::receive(std::uint32_t from, std::uint32_t to, Text&& text, Delivery& delivery) {
  if (limits_.empty()) limits_.resize(names_.size());  // most runs are without messages
  if (!limits_[to].admit(names_[from], names_[to], text)) {
    ++delivery.counts.dropped;
    return;
  }
  std::vector<RobotMessage>& inbox = delivery.readings[to].inbox.edit();
  if (inbox.empty()) receivers_.push_back(to);
  inbox.push_back({names_[from], names_[to], std::forward<Text>(text)});
  ++delivery.counts.delivered;
}

template <typename Text>
void MessageRouter::transmit(std::uint32_t from, std::uint32_t to, std::size_t index, Text&& text, Delivery& delivery) {
  const Robots& robots = delivery.robots;
  MessageLosses& lost = delivery.counts.lost;
  if (robots.activity[to] == Activity::absent) {
    ++lost.absent;
    return;
  }
  switch (channel_.decideFate(delivery.seed, delivery.now, robots.scene,
                              {from, to, index, robots.antenna(from), robots.antenna(to)})) {
    case MessageFate::out_of_range:
      ++lost.out_of_range;
      break;
    case MessageFate::stopped_by_walls:
      ++lost.stopped_by_walls;
      break;
    case MessageFate::lost_by_chance:
      ++lost.by_chance;
      break;
    case MessageFate::lost_in_burst:
      ++lost.in_bursts;
      break;
    case MessageFate::arrives:
      if (const std::uint64_t delay = delaySteps(communication_, delivery.now.period_s); delay > 0) {
        insertInOrder({from, to, delivery.now.step + delay, std::forward<Text>(text)}, delivery.in_flight);
      } else {
        receive(from, to, std::forward<Text>(text), delivery);
      }
  }
}

void MessageRouter::transmitToAll(std::uint32_t from, std::size_t index, const std::string& text, Delivery& delivery) {
  // The index of a receiver counts the others in the world's order, so that the losses do not depend on the search.
  const auto transmit_to = [&](std::uint32_t to) {
    if (to != from) transmit(from, to, index + to - (to > from ? 1 : 0), text, delivery);
  };
  const auto robots = static_cast<std::uint32_t>(names_.size());
  if (!communication_.range_m) {
    for (std::uint32_t to = 0; to < robots; ++to) transmit_to(to);
    return;
  }
  const auto& pose = delivery.robots.world_from_robot[from];
  delivery.robots.scene.findMoving({pose.x, pose.y}, *communication_.range_m + kSearchSlack_m, names_.size(), near_);
  std::sort(near_.begin(), near_.end());
  const std::size_t present = delivery.presentRobots();
  delivery.counts.lost.absent += robots - present;
  delivery.counts.lost.out_of_range += present - near_.size();
  for (const std::uint32_t to : near_) transmit_to(to);
}

void MessageRouter::deliverFrom(std::uint32_t from, Rare<Outbox>& kept, Delivery& delivery) {
  if (delivery.robots.activity[from] == Activity::absent) kept.reset();
  if (!kept) return;
  Outbox& outbox = *kept;
  delivery.counts.dropped += std::exchange(outbox.surplus, 0);
  const auto sent = static_cast<std::size_t>(
      std::min<std::uint64_t>(outbox.messages.size(), messagesAllowed(communication_, delivery.now)));
  std::size_t index = 0;
  for (std::size_t i = 0; i < sent; ++i) {
    PendingMessage& message = outbox.messages[i];
    if (message.isBroadcast()) {
      transmitToAll(from, index, message.text, delivery);
    } else {
      transmit(from, message.to, index, std::move(message.text), delivery);
    }
    index += message.receiversOf(names_.size());
  }
  outbox.messages.erase(outbox.messages.begin(), outbox.messages.begin() + static_cast<std::ptrdiff_t>(sent));
  if (outbox.messages.empty()) kept.reset();
}

MessageCounts MessageRouter::deliver(std::uint64_t seed, SimTime now, const Robots& robots,
                                     std::span<Rare<Outbox>> outboxes, std::vector<MessageInFlight>& in_flight,
                                     std::span<Readings> readings) {
  receivers_.clear();
  if (in_flight.empty() && !anyFlag(robots.may_send)) return {};
  Delivery delivery{seed, now, robots, in_flight, readings};
  std::vector<MessageInFlight> due;
  if (!in_flight.empty()) {
    const auto is_due = [&](const MessageInFlight& message) { return message.due_step <= now.step; };
    const auto due_end = std::find_if_not(in_flight.begin(), in_flight.end(), is_due);
    due.assign(std::move_iterator(in_flight.begin()), std::move_iterator(due_end));
    in_flight.erase(in_flight.begin(), due_end);
  }
  auto next = due.begin();
  const auto receive_due_from_up_to = [&](std::size_t sender) {
    for (; next != due.end() && next->from <= sender; ++next) {
      if (robots.activity[next->to] == Activity::absent) {
        ++delivery.counts.lost.absent;
      } else {
        receive(next->from, next->to, std::move(next->text), delivery);
      }
    }
  };
  forFlags(robots.may_send, [&](std::size_t from) {
    receive_due_from_up_to(from);
    deliverFrom(static_cast<std::uint32_t>(from), outboxes[from], delivery);
    robots.may_send[from] = outboxes[from] ? 1 : 0;
  });
  receive_due_from_up_to(names_.size());
  for (const auto robot : receivers_) limits_[robot] = {};
  return delivery.counts;
}

}  // namespace robosim
