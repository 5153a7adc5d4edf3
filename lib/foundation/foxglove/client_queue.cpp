#include "foxglove/client_queue.h"

#include <string_view>
#include <utility>

#include "foxglove/server_message.h"

namespace robosim::foxglove {

bool ClientQueue::addControl(WebMessagePtr message) {
  const std::size_t bytes = control_bytes_ + message->bytes().size();
  if (control_.size() >= kMaxControl || bytes > kMaxControlBytes) return false;
  control_bytes_ = bytes;
  control_.push_back(std::move(message));
  return true;
}

std::size_t ClientQueue::addData(std::uint32_t subscription, std::uint64_t time_ns, Payload payload, bool latest_only) {
  const auto& own = of_key_[subscription];
  add(subscription, time_ns, std::move(payload));
  std::size_t dropped = 0;
  const std::size_t most = latest_only ? 1 : kMaxOfSubscription;
  for (; own.size() > most; dropped += latest_only ? 0 : 1) drop(data_.find(own.front()));
  for (; data_bytes_ > kMaxDataBytes && data_.size() > 1; ++dropped) {
    drop(own.size() > 1 ? data_.find(own.front()) : data_.begin());
  }
  return dropped;
}

void ClientQueue::addTime(std::uint64_t time_ns) {
  if (const auto former = of_key_.find(kTime); former != of_key_.end()) drop(data_.find(former->second.front()));
  add(kTime, time_ns, nullptr);
}

void ClientQueue::discard(std::uint32_t subscription) {
  for (auto found = of_key_.find(subscription); found != of_key_.end(); found = of_key_.find(subscription)) {
    drop(data_.find(found->second.front()));
  }
}

std::optional<ClientQueue::Next> ClientQueue::take() {
  if (!control_.empty()) {
    Next next{std::move(control_.front()), 0, 0, nullptr};
    control_.pop_front();
    control_bytes_ -= next.control->bytes().size();
    return next;
  }
  if (data_.empty()) return std::nullopt;
  const auto first = data_.begin();
  Next next{nullptr, static_cast<std::uint32_t>(first->second.key), first->second.time_ns, first->second.payload};
  drop(first);
  return next;
}

WebMessagePtr ClientQueue::Next::message() const {
  if (control) return control;
  if (!payload) return std::make_shared<const WebMessage>(WebMessage::binary(timeMessage(time_ns), {}));
  const std::string_view bytes(reinterpret_cast<const char*>(payload->data()), payload->size());
  return std::make_shared<const WebMessage>(WebMessage::binary(messageDataHead(subscription, time_ns), bytes));
}

void ClientQueue::add(Key key, std::uint64_t time_ns, Payload payload) {
  const auto added = data_.emplace_hint(data_.end(), next_number_, Entry{key, time_ns, std::move(payload)});
  of_key_[key].push_back(next_number_++);
  data_bytes_ += bytesOf(added->second);
}

/// @pre an entry that is the oldest of its key
void ClientQueue::drop(Entries::iterator entry) {
  const auto of_key = of_key_.find(entry->second.key);
  of_key->second.pop_front();
  data_bytes_ -= bytesOf(entry->second);
  data_.erase(entry);
  if (of_key->second.empty()) of_key_.erase(of_key);
}

std::size_t ClientQueue::bytesOf(const Entry& entry) { return entry.payload ? entry.payload->size() : 0; }

}  // namespace robosim::foxglove
