#include "environment/mail.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "base/random.h"

namespace robosim {

Mail::Mail(std::vector<std::string> names, const Communication& communication, std::uint64_t seed)
    : names_(std::move(names)), communication_(communication), seed_(seed), sent_by_(names_.size()) {
  by_name_.resize(names_.size());
  std::iota(by_name_.begin(), by_name_.end(), 0U);
  std::sort(by_name_.begin(), by_name_.end(), [&](auto a, auto b) { return names_[a] < names_[b]; });
}

void Mail::send(std::size_t from, const std::string& to, const std::string& text) {
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
  sent_by_[from].push_back({*found, text});
}

bool Mail::arrives(SimTime now, std::size_t from, std::size_t index, std::size_t to,
                   std::span<const mrpt::math::TPose2D> world_from_robot) const {
  const auto& a = world_from_robot[from];
  const auto& b = world_from_robot[to];
  if (communication_.range_m && std::hypot(a.x - b.x, a.y - b.y) > *communication_.range_m) return false;
  if (communication_.loss_probability == 0) return true;
  Rng rng(seed_, RandomPurpose::message_loss, static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(index),
          now.step);
  return rng.uniform() >= communication_.loss_probability;
}

std::size_t Mail::deliver(SimTime now, std::span<const mrpt::math::TPose2D> world_from_robot,
                          std::span<Readings> readings) {
  for (const auto robot : filled_inboxes_) readings[robot].inbox.clear();
  filled_inboxes_.clear();
  std::size_t delivered = 0;
  for (std::size_t from = 0; from < sent_by_.size(); ++from) {
    for (std::size_t i = 0; i < sent_by_[from].size(); ++i) {
      auto& letter = sent_by_[from][i];
      if (!arrives(now, from, i, letter.to, world_from_robot)) continue;
      auto& inbox = readings[letter.to].inbox;
      if (inbox.empty()) filled_inboxes_.push_back(letter.to);
      inbox.push_back({names_[from], names_[letter.to], std::move(letter.text)});
      ++delivered;
    }
    sent_by_[from].clear();
  }
  return delivered;
}

}  // namespace robosim
