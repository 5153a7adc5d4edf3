#include "environment/message_router.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "environment/known_robots.h"

namespace robosim {

MessageRouter::MessageRouter(std::vector<std::string> names, const Communication& communication)
    : names_(std::move(names)), communication_(communication), limits_(names_.size()) {
  by_name_.resize(names_.size());
  std::iota(by_name_.begin(), by_name_.end(), 0U);
  std::sort(by_name_.begin(), by_name_.end(), [&](auto a, auto b) { return names_[a] < names_[b]; });
}

void MessageRouter::send(std::size_t from, const std::string& to, const std::string& text, Outbox& outbox) const {
  const auto found =
      std::lower_bound(by_name_.begin(), by_name_.end(), to,
                       [&](std::uint32_t robot, const std::string& name) { return names_[robot] < name; });
  if (found == by_name_.end() || names_[*found] != to) {
    throw std::invalid_argument("a message from '" + names_[from] + "' to '" + to +
                                "': there is no robot of that name");
  }
  if (text.size() > kMaxMessageBytes) {
    throw std::invalid_argument("a message from '" + names_[from] + "' to '" + to + "' has " +
                                std::to_string(text.size()) + " bytes; the most is " +
                                std::to_string(kMaxMessageBytes));
  }
  if (outbox.messages.size() == kMaxMessagesSent) {
    ++outbox.surplus;
    return;
  }
  outbox.messages.push_back({*found, text});
}

void MessageRouter::receive(std::uint32_t from, std::uint32_t to, std::string&& text, std::span<Readings> readings,
                            MessageCounts& counts) {
  if (!limits_[to].admit(names_[from], names_[to], text)) {
    ++counts.dropped;
    return;
  }
  auto& inbox = readings[to].inbox;
  if (inbox.empty()) receivers_.push_back(to);
  inbox.push_back({names_[from], names_[to], std::move(text)});
  ++counts.delivered;
}

void MessageRouter::deliverFrom(std::uint32_t from, std::uint64_t seed, SimTime now, const Robots& robots,
                                std::span<Outbox> outboxes, std::vector<MessageInFlight>& in_flight,
                                std::span<Readings> readings, MessageCounts& counts) {
  Outbox& outbox = outboxes[from];
  if (robots.activity[from] == Activity::absent) outbox = {};
  counts.dropped += std::exchange(outbox.surplus, 0);
  if (outbox.messages.empty()) return;
  const std::uint64_t delay_steps = delaySteps(communication_, now.period_s);
  const auto sent =
      static_cast<std::size_t>(std::min<std::uint64_t>(outbox.messages.size(), messagesAllowed(communication_, now)));
  for (std::size_t i = 0; i < sent; ++i) {
    auto& message = outbox.messages[i];
    if (robots.activity[message.to] == Activity::absent) {
      ++counts.lost.absent;
      continue;
    }
    switch (channel_.fateOf(seed, now, robots.scene,
                            {from, message.to, i, robots.antenna(from), robots.antenna(message.to)})) {
      case MessageFate::out_of_range:
        ++counts.lost.out_of_range;
        break;
      case MessageFate::stopped_by_walls:
        ++counts.lost.stopped_by_walls;
        break;
      case MessageFate::lost_by_chance:
        ++counts.lost.by_chance;
        break;
      case MessageFate::lost_in_burst:
        ++counts.lost.in_bursts;
        break;
      case MessageFate::arrives:
        if (delay_steps > 0) {
          in_flight.push_back({from, message.to, now.step + delay_steps, std::move(message.text)});
        } else {
          receive(from, message.to, std::move(message.text), readings, counts);
        }
    }
  }
  outbox.messages.erase(outbox.messages.begin(), outbox.messages.begin() + static_cast<std::ptrdiff_t>(sent));
}

MessageCounts MessageRouter::deliver(std::uint64_t seed, SimTime now, const Robots& robots, std::span<Outbox> outboxes,
                                     std::vector<MessageInFlight>& in_flight, std::span<Readings> readings) {
  receivers_.clear();
  MessageCounts counts;
  if (!in_flight.empty()) {
    const auto is_due = [&](const MessageInFlight& message) { return message.due_step <= now.step; };
    const auto due_end = std::find_if_not(in_flight.begin(), in_flight.end(), is_due);
    for (auto message = in_flight.begin(); message != due_end; ++message) {
      if (robots.activity[message->to] == Activity::absent) {
        ++counts.lost.absent;
      } else {
        receive(message->from, message->to, std::move(message->text), readings, counts);
      }
    }
    in_flight.erase(in_flight.begin(), due_end);
  }
  forFlags(robots.may_send, [&](std::size_t from) {
    deliverFrom(static_cast<std::uint32_t>(from), seed, now, robots, outboxes, in_flight, readings, counts);
    robots.may_send[from] = outboxes[from].messages.empty() ? 0 : 1;
  });
  for (const auto robot : receivers_) limits_[robot] = {};
  return counts;
}

}  // namespace robosim
