#include "console/order_limiter.h"

#include <utility>

namespace robosim {

std::vector<v1::ControlRequest> OrderLimiter::add(const v1::ControlRequest& order, Time now) {
  const OrderRule rule = rowOf(typeOf(order)).rule;
  if (rule == OrderRule::mode || rule == OrderRule::stop) clear();
  if (rule != OrderRule::set && rule != OrderRule::steer) return {order};
  std::vector<v1::ControlRequest> orders;
  if (waiting_ && waiting_->has_drive() && order.has_drive()) {
    waiting_ = mergeDrive(*std::move(waiting_), order);
  } else {
    // A DRIVE only sets values: it takes effect before the order that follows it.
    if (waiting_ && waiting_->has_drive()) orders.push_back(*waiting_);
    waiting_ = order;
  }
  if (auto next = due(now)) orders.push_back(*std::move(next));
  return orders;
}

std::optional<v1::ControlRequest> OrderLimiter::due(Time now) {
  if (!waiting_ || now - sent_ < kPause) return std::nullopt;
  sent_ = now;
  return std::exchange(waiting_, std::nullopt);
}

}  // namespace robosim
