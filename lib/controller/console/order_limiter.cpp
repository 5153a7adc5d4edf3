#include "console/order_limiter.h"

#include <utility>

#include "remote/drive_order.h"

namespace robosim {

std::vector<RemoteOrder> OrderLimiter::add(const RemoteOrder& order, Time now) {
  if (order.type == RemoteType::alive || order.type == RemoteType::check_win) return {order};
  if (order.type == RemoteType::stop) {
    clear();
    return {order};
  }
  std::vector<RemoteOrder> orders;
  if (waiting_ && waiting_->type == RemoteType::drive && order.type == RemoteType::drive) {
    waiting_ = mergeDrive(*waiting_, order);
  } else {
    // A DRIVE only sets values: it takes effect before the order that follows it.
    if (waiting_ && waiting_->type == RemoteType::drive) orders.push_back(*waiting_);
    waiting_ = order;
  }
  if (auto next = due(now)) orders.push_back(*std::move(next));
  return orders;
}

std::optional<RemoteOrder> OrderLimiter::due(Time now) {
  if (!waiting_ || now - sent_ < kPause) return std::nullopt;
  sent_ = now;
  return std::exchange(waiting_, std::nullopt);
}

}  // namespace robosim
