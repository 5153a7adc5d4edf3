#pragma once
#include <chrono>
#include <optional>
#include <vector>

#include "remote/orders.h"

namespace robosim {

/// Limits the rate of the orders that steer the primary robot, which executes one per step. Of several orders within
/// kPause the newest is sent, and of successive DRIVE orders the newest value of each field. Orders of every other rule
/// (OrderRule) are sent at once; a STOP or a change of the mode discards what waits. Time is a parameter.
class OrderLimiter {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::chrono::milliseconds kPause{10};

  /// Adds an order. @return the orders to send now, in this sequence
  std::vector<v1::ControlRequest> add(const v1::ControlRequest& order, Time now);
  /// The order that has waited for long enough; nullopt for none.
  std::optional<v1::ControlRequest> due(Time now);
  /// Discards the order that waits.
  void clear() { waiting_.reset(); }

 private:
  std::optional<v1::ControlRequest> waiting_;
  Time sent_;  ///< time of the last order that waited
};

}  // namespace robosim
