#pragma once
#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>
#include <vector>

#include "server/lobby.h"

namespace robosim {

/// Connections that have not said hello. Who connects says it at once: the deadline is for slow machines, and for
/// programs that are none of ours.
template <typename Stream>
class Newcomers {
 public:
  explicit Newcomers(const Lobby& lobby) : lobby_(lobby) {}

  void add(std::shared_ptr<Stream> stream) { all_.emplace_back(lobby_.now(), std::move(stream)); }
  void remove(const Stream& stream) {
    std::erase_if(all_, [&](const auto& newcomer) { return newcomer.second.get() == &stream; });
  }
  /// One that has let the deadline pass; null when there is none. Remove it before you ask again.
  std::shared_ptr<Stream> overdue() const {
    if (all_.empty() || lobby_.now() - all_.front().first < lobby_.hello_deadline) return nullptr;
    return all_.front().second;
  }
  grpc::Status tooLate() const {
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(lobby_.hello_deadline).count();
    return {grpc::StatusCode::DEADLINE_EXCEEDED,
            "no hello within " + std::to_string(ms) + " ms of connecting; the first message must be one, at once"};
  }

 private:
  const Lobby& lobby_;
  std::vector<std::pair<Lobby::Clock::time_point, std::shared_ptr<Stream>>> all_;  ///< first come first
};

}  // namespace robosim
