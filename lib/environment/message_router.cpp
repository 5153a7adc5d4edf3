#include "environment/message_router.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "base/portable_math.h"
#include "base/random.h"

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

bool MessageRouter::arrives(std::uint64_t seed, SimTime now, std::size_t from, std::size_t index, std::size_t to,
                            std::span<const mrpt::math::TPose2D> world_from_robot) const {
  const auto& a = world_from_robot[from];
  const auto& b = world_from_robot[to];
  if (communication_.range_m && portable::hypot(a.x - b.x, a.y - b.y) > *communication_.range_m) return false;
  if (communication_.loss_probability == 0) return true;
  Rng rng(seed, RandomPurpose::message_loss, static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(index),
          now.step);
  return rng.uniform() >= communication_.loss_probability;
}

MessageRouter::Delivery MessageRouter::deliver(std::uint64_t seed, SimTime now,
                                               std::span<const mrpt::math::TPose2D> world_from_robot,
                                               std::span<const Activity> activity, std::span<Outbox> outboxes,
                                               std::span<Readings> readings) {
  Delivery delivery;
  for (std::size_t from = 0; from < outboxes.size(); ++from) {
    Outbox& outbox = outboxes[from];
    if (activity[from] == Activity::absent) outbox = {};
    delivery.dropped += std::exchange(outbox.surplus, 0);
    for (std::size_t i = 0; i < outbox.messages.size(); ++i) {
      auto& message = outbox.messages[i];
      if (activity[message.to] == Activity::absent) continue;
      if (!arrives(seed, now, from, i, message.to, world_from_robot)) continue;
      if (!limits_[message.to].admit(names_[from], names_[message.to], message.text)) {
        ++delivery.dropped;
        continue;
      }
      auto& inbox = readings[message.to].inbox;
      if (inbox.empty()) filled_.push_back(message.to);
      inbox.push_back({names_[from], names_[message.to], std::move(message.text)});
      ++delivery.delivered;
    }
    outbox.messages.clear();
  }
  for (const auto robot : filled_) limits_[robot] = {};
  filled_.clear();
  return delivery;
}

}  // namespace robosim
