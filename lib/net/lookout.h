#pragma once
#include <chrono>

#include <grpcpp/grpcpp.h>

namespace robosim {

/// Decides how to wait for a message. A thread that sleeps until it comes leaves its processor idle; where nothing else
/// runs, that goes to sleep as well, and to wake it takes longer than all else in a step (50 µs and more in a virtual
/// machine). So while messages come soon, it pays to look out for them. But looking out takes a processor, and is done
/// no longer than it pays: not once a message has let one wait, nor where others want the processor, for then it does
/// not sleep anyway.
class Lookout {
 public:
  using Duration = std::chrono::nanoseconds;

  static constexpr Duration kPatience = std::chrono::microseconds(300);  ///< to look out for so long, no longer
  static constexpr Duration kSoon = std::chrono::microseconds(300);      ///< one that slept so long was woken soon
  static constexpr Duration kAtOnce = std::chrono::microseconds(5);      ///< it was there already: that tells nothing

  /// Whether to look out for the next message, rather than sleep.
  bool isWorthwhile() const { return soon_in_a_row_ >= kEnough && sleeps_to_come_ == 0; }

  /// A message came so long after one had gone to sleep.
  void slept(Duration wait) {
    if (wait <= kAtOnce) return;
    soon_in_a_row_ = wait <= kSoon ? soon_in_a_row_ + 1 : 0;
    if (sleeps_to_come_ > 0) --sleeps_to_come_;
  }
  /// One has looked out, and the message came.
  void succeeded() {
    if (successes_ < kProof && ++successes_ == kProof) sleeps_next_time_ = kSleepsLeast;
  }
  /// One has looked out, and no message came. The next try is put off; for twice as long as the last time if that was
  /// no good either.
  void failed() {
    sleeps_to_come_ = sleeps_next_time_;
    if (successes_ < kProof && sleeps_next_time_ < kSleepsMost) sleeps_next_time_ *= 2;
    soon_in_a_row_ = successes_ = 0;
  }

 private:
  static constexpr int kEnough = 3;
  static constexpr int kProof = 1000;
  static constexpr int kSleepsLeast = 64;
  static constexpr int kSleepsMost = 8192;

  int soon_in_a_row_ = 0;
  int sleeps_to_come_ = 0;
  int sleeps_next_time_ = kSleepsLeast;
  int successes_ = 0;  ///< since one last failed
};

/// What gRPC's AsyncNext() does: waits for the next event, for which one looks out if that is worthwhile.
bool awaitEvent(grpc::CompletionQueue& queue, Lookout& lookout, gpr_timespec until, void*& tag, bool& ok);

}  // namespace robosim
