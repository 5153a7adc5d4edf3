#include "remote/primary_queue.h"

#include <algorithm>

namespace robosim {

PrimaryQueue::PrimaryQueue(std::size_t robots, std::size_t primary) {
  order_.push_back(primary);
  for (std::size_t robot = 0; robot < robots; ++robot) {
    if (robot != primary) order_.push_back(robot);
  }
}

std::optional<std::size_t> PrimaryQueue::next(const std::function<bool(std::size_t)>& is_fit) const {
  const auto found = std::find_if(order_.begin() + 1, order_.end(), is_fit);
  if (found == order_.end()) return std::nullopt;
  return *found;
}

void PrimaryQueue::switchTo(std::size_t robot) {
  if (robot == primary()) return;
  const auto found = std::find(order_.begin(), order_.end(), robot);
  std::rotate(order_.begin(), found, found + 1);                      // to the head, and all before it back by one
  std::rotate(order_.begin() + 1, order_.begin() + 2, order_.end());  // the old primary, now second, to the tail
}

}  // namespace robosim
