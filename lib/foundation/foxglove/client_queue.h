#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "web/message.h"

namespace robosim::foxglove {

/// Bytes of an encoded message, which the queues of all its receivers share.
using Payload = std::shared_ptr<const std::vector<std::uint8_t>>;

/// What waits for a client, within bounds: control messages, which are sent first and never dropped, and data. When
/// data wait for longer than the limits permit, the oldest of the same subscription are dropped, so that the client
/// receives the newest state; those of others only when nothing older of it is left.
class ClientQueue {
 public:
  static constexpr std::size_t kMaxControl = 1024;              ///< messages
  static constexpr std::size_t kMaxControlBytes = 64UL << 20U;  ///< the list of thousands of topics has megabytes
  static constexpr std::size_t kMaxDataBytes = 16UL << 20U;
  static constexpr std::size_t kMaxOfSubscription = 32;  ///< messages

  /// @return false, without a change, when there is no room: the client does not read
  [[nodiscard]] bool addControl(WebMessagePtr message);
  /// @param latest_only whether a message makes those before it obsolete @return number of messages dropped
  std::size_t addData(std::uint32_t subscription, std::uint64_t time_ns, Payload payload, bool latest_only = false);
  /// The simulated time; an earlier one that still waits is dropped.
  void addTime(std::uint64_t time_ns);
  /// Drops the data of a subscription that has ended.
  void discard(std::uint32_t subscription);

  /// The next message, taken from the queue, with what is needed to build it elsewhere.
  struct Next {
    WebMessagePtr control;  ///< null: data
    std::uint32_t subscription = 0;
    std::uint64_t time_ns = 0;
    Payload payload;  ///< null: the time alone

    WebMessagePtr message() const;
  };
  std::optional<Next> take();

  bool isEmpty() const { return control_.empty() && data_.empty(); }
  std::size_t dataBytes() const { return data_bytes_; }
  std::size_t dataMessages() const { return data_.size(); }

 private:
  using Key = std::uint64_t;  ///< subscription, or kTime
  static constexpr Key kTime = std::uint64_t{1} << 32U;
  struct Entry {
    Key key;
    std::uint64_t time_ns;
    Payload payload;
  };
  using Entries = std::map<std::uint64_t, Entry>;

  void add(Key key, std::uint64_t time_ns, Payload payload);
  void drop(Entries::iterator entry);
  static std::size_t bytesOf(const Entry& entry);

  std::deque<WebMessagePtr> control_;
  std::size_t control_bytes_ = 0;
  Entries data_;                                               ///< by number, in their order
  std::unordered_map<Key, std::deque<std::uint64_t>> of_key_;  ///< numbers
  std::uint64_t next_number_ = 0;
  std::size_t data_bytes_ = 0;
};

}  // namespace robosim::foxglove
