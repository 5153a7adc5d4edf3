#pragma once
#include <cstdint>
#include <vector>

namespace robosim {

/// Takes the messages of a run's topics, and knows which of them have receivers. Messages come in rounds, between two
/// steps. Topics are the indices in TopicFeed::topics().
class TopicOutlet {
 public:
  /// Of a round: all receivers, or those that have come since the last round, which receive the present state.
  enum class Audience { all, fresh };

  virtual ~TopicOutlet() = default;
  /// Whether a topic has a receiver. @pre in a round
  virtual bool wants(std::size_t topic, Audience audience) const = 0;
  /// Whether a topic has a receiver, at any time.
  virtual bool isSubscribed(std::size_t topic) const = 0;
  /// Whether receivers have come since the last round.
  virtual bool hasFresh() const = 0;
  /// @param time_ns simulated time
  virtual void beginRound(std::uint64_t time_ns) = 0;
  /// @param message with the header of CDR
  /// @param latest_only whether the message makes those of the topic before it obsolete
  virtual void send(std::size_t topic, Audience audience, std::uint64_t time_ns, std::vector<std::uint8_t> message,
                    bool latest_only) = 0;
  virtual void endRound() = 0;
};

}  // namespace robosim
