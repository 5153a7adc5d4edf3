#pragma once
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace robosim::dds {

/// Messages that wait for a thread that sends them, in the order in which they came. Of each writer, only the latest
/// ones wait, up to the depth of its history; when all together exceed kMaxBytes, a further one replaces the oldest of
/// its writer, or is dropped if there is none. Thread-safe.
class SendQueue {
 public:
  static constexpr std::size_t kMaxBytes = std::size_t{64} << 20;
  using Message = std::vector<std::uint8_t>;

  /// What of a writer waits.
  class Lane {
   public:
    explicit Lane(std::size_t depth) : depth_(depth) {}

   private:
    friend SendQueue;
    std::size_t depth_;
    std::deque<Message> waiting_;  ///< guarded by the queue's mutex
  };
  struct Next {
    std::shared_ptr<Lane> lane;
    Message message;
  };

  /// @return number of messages that were dropped for it: of the lane's oldest ones, or itself
  std::size_t push(const std::shared_ptr<Lane>& lane, Message message);
  /// Waits for a message. The one before it counts as sent. nullopt: there was none until then, or the queue is closed
  std::optional<Next> pop(std::chrono::steady_clock::time_point until);
  /// Waits until all messages of a writer are sent. @return whether they are; false if not until then, or if the queue
  /// is closed before
  bool awaitSent(const Lane& lane, std::chrono::steady_clock::time_point until);
  /// From now on pop() returns nullopt.
  void close();
  bool isClosed() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable has_message_, was_sent_;
  std::shared_ptr<Lane> sending_;            ///< of the message that pop() returned last; null after it was sent
  std::deque<std::shared_ptr<Lane>> order_;  ///< an entry for each message; more after one was dropped
  std::size_t bytes_ = 0;
  bool is_closed_ = false;
};

}  // namespace robosim::dds
