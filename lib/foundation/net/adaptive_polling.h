#pragma once
#include <chrono>

#include <grpcpp/grpcpp.h>

namespace robosim {

/// Chooses between polling for the next message and sleeping until it arrives. Sleeping lets an otherwise idle
/// processor enter a sleep state, from which waking takes longer than the rest of a step (50 µs and more in a virtual
/// machine). Polling avoids this while messages arrive within kShortWait, but occupies a processor. It is enabled after
/// several consecutive short waits and disabled, with exponential back-off, after a poll that times out.
class AdaptivePolling {
 public:
  using Duration = std::chrono::nanoseconds;

  static constexpr Duration kMaxPollTime = std::chrono::microseconds(300);  ///< maximum duration of a poll
  static constexpr Duration kShortWait = std::chrono::microseconds(300);    ///< longest wait that counts as short
  static constexpr Duration kImmediate =
      std::chrono::microseconds(5);  ///< shorter waits are ignored: the message was already there

  /// Whether to poll for the next message instead of sleeping.
  bool shouldPoll() const { return consecutive_short_waits_ >= kMinShortWaits && remaining_sleeps_ == 0; }

  /// Records that a message arrived after sleeping for `wait`.
  void recordSleep(Duration wait) {
    if (wait <= kImmediate) return;
    consecutive_short_waits_ = wait <= kShortWait ? consecutive_short_waits_ + 1 : 0;
    if (remaining_sleeps_ > 0) --remaining_sleeps_;
  }
  /// Records that a message arrived during a poll.
  void recordPollSuccess() {
    if (consecutive_successes_ < kSuccessesToResetBackoff && ++consecutive_successes_ == kSuccessesToResetBackoff)
      backoff_sleeps_ = kMinBackoffSleeps;
  }
  /// Records that no message arrived during a poll. Delays the next poll, twice as long as before unless there were
  /// kSuccessesToResetBackoff successful polls since.
  void recordPollTimeout() {
    remaining_sleeps_ = backoff_sleeps_;
    if (consecutive_successes_ < kSuccessesToResetBackoff && backoff_sleeps_ < kMaxBackoffSleeps) backoff_sleeps_ *= 2;
    consecutive_short_waits_ = consecutive_successes_ = 0;
  }

 private:
  static constexpr int kMinShortWaits = 3;
  static constexpr int kSuccessesToResetBackoff = 1000;
  static constexpr int kMinBackoffSleeps = 64;
  static constexpr int kMaxBackoffSleeps = 8192;

  int consecutive_short_waits_ = 0;
  int remaining_sleeps_ = 0;
  int backoff_sleeps_ = kMinBackoffSleeps;
  int consecutive_successes_ = 0;  ///< since the last timeout
};

/// As gRPC's AsyncNext(): waits for the next event until the deadline, by polling if `polling` recommends it.
bool awaitEvent(grpc::CompletionQueue& queue, AdaptivePolling& polling, gpr_timespec until, void*& tag, bool& ok);

}  // namespace robosim
