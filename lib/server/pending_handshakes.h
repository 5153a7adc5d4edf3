#pragma once
#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>
#include <vector>

#include "server/serving_state.h"

namespace robosim {

/// Calls whose first message has not been received. Clients send it immediately after connecting; calls without it end
/// at ServingState::hello_deadline.
template <typename Stream>
class PendingHandshakes {
 public:
  explicit PendingHandshakes(const ServingState& serving) : serving_(serving) {}

  void add(std::shared_ptr<Stream> stream) { all_.emplace_back(serving_.now(), std::move(stream)); }
  void remove(const Stream& stream) {
    std::erase_if(all_, [&](const auto& pending) { return pending.second.get() == &stream; });
  }
  /// A call beyond its deadline; null when there is none. Remove it before the next call of this function.
  std::shared_ptr<Stream> overdue() const {
    if (all_.empty() || serving_.now() - all_.front().first < serving_.hello_deadline) return nullptr;
    return all_.front().second;
  }
  grpc::Status timeoutStatus() const {
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(serving_.hello_deadline).count();
    return {grpc::StatusCode::DEADLINE_EXCEEDED,
            "no first message within " + std::to_string(ms) + " ms of the call; send it at once, and call again"};
  }

 private:
  const ServingState& serving_;
  std::vector<std::pair<ServingState::Clock::time_point, std::shared_ptr<Stream>>> all_;  ///< by time of arrival
};

}  // namespace robosim
