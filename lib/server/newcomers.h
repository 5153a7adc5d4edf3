#pragma once
#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>
#include <vector>

#include "server/lobby.h"

namespace robosim {

/// Connections that have not said hello. Who connects says it at once: the deadline is for slow machines, and for
/// programs that are none of ours. Call with the lobby's mutex held.
template <typename Stream>
class Newcomers {
 public:
  void add(std::shared_ptr<Stream> stream) { all_.emplace_back(Lobby::Clock::now(), std::move(stream)); }
  void remove(const Stream& stream) {
    std::erase_if(all_, [&](const auto& newcomer) { return newcomer.second.get() == &stream; });
  }
  /// One that has let the deadline pass; null when there is none. Remove it before you ask again.
  std::shared_ptr<Stream> overdue() const {
    if (all_.empty() || Lobby::Clock::now() - all_.front().first < kDeadline) return nullptr;
    return all_.front().second;
  }
  static grpc::Status tooLate() {
    return {grpc::StatusCode::DEADLINE_EXCEEDED, "no hello within " + std::to_string(kDeadline.count()) +
                                                     " s of connecting; the first message must be one, at once"};
  }

 private:
  static constexpr std::chrono::seconds kDeadline{10};
  std::vector<std::pair<Lobby::Clock::time_point, std::shared_ptr<Stream>>> all_;  ///< first come first
};

}  // namespace robosim
