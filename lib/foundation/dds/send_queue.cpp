#include "dds/send_queue.h"

#include <utility>

namespace robosim::dds {

std::size_t SendQueue::push(const std::shared_ptr<Lane>& lane, Message message) {
  std::size_t dropped = 0;
  {
    const std::lock_guard lock(mutex_);
    auto& waiting = lane->waiting_;
    while (!waiting.empty() && (waiting.size() >= lane->depth_ || bytes_ + message.size() > kMaxBytes)) {
      bytes_ -= waiting.front().size();
      waiting.pop_front();
      ++dropped;
    }
    if (bytes_ > 0 && bytes_ + message.size() > kMaxBytes) return dropped + 1;
    bytes_ += message.size();
    waiting.push_back(std::move(message));
    // The entries of dropped messages serve for later ones.
    if (dropped == 0) {
      order_.push_back(lane);
    }
  }
  has_message_.notify_one();
  return dropped;
}

std::optional<SendQueue::Next> SendQueue::pop(std::chrono::steady_clock::time_point until) {
  std::unique_lock lock(mutex_);
  sending_.reset();
  was_sent_.notify_all();
  const auto isReady = [this] { return is_closed_ || !order_.empty(); };
  for (;;) {
    if (!has_message_.wait_until(lock, until, isReady) || is_closed_) return std::nullopt;
    const std::shared_ptr<Lane> lane = std::move(order_.front());
    order_.pop_front();
    if (lane->waiting_.empty()) continue;
    Next next{lane, std::move(lane->waiting_.front())};
    lane->waiting_.pop_front();
    bytes_ -= next.message.size();
    sending_ = lane;
    return next;
  }
}

bool SendQueue::awaitSent(const Lane& lane, std::chrono::steady_clock::time_point until) {
  std::unique_lock lock(mutex_);
  const auto is_sent = [&] { return lane.waiting_.empty() && sending_.get() != &lane; };
  was_sent_.wait_until(lock, until, [&] { return is_closed_ || is_sent(); });
  return is_sent();
}

void SendQueue::close() {
  {
    const std::lock_guard lock(mutex_);
    is_closed_ = true;
  }
  has_message_.notify_all();
  was_sent_.notify_all();
}

bool SendQueue::isClosed() const {
  const std::lock_guard lock(mutex_);
  return is_closed_;
}

}  // namespace robosim::dds
