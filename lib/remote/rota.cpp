#include "remote/rota.h"

#include <algorithm>

namespace robosim {

Rota::Rota(std::size_t robots, std::size_t primary) {
  row_.push_back(primary);
  for (std::size_t robot = 0; robot < robots; ++robot) {
    if (robot != primary) row_.push_back(robot);
  }
}

std::optional<std::size_t> Rota::next(const std::function<bool(std::size_t)>& is_fit) const {
  const auto found = std::find_if(row_.begin() + 1, row_.end(), is_fit);
  if (found == row_.end()) return std::nullopt;
  return *found;
}

void Rota::switchTo(std::size_t robot) {
  if (robot == primary()) return;
  const auto found = std::find(row_.begin(), row_.end(), robot);
  std::rotate(row_.begin(), found, found + 1);  // it comes to the head, and all before it move back by one
  std::rotate(row_.begin() + 1, row_.begin() + 2, row_.end());  // the old primary, second now, goes to the tail
}

}  // namespace robosim
