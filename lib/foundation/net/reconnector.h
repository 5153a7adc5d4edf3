#pragma once
#include <chrono>
#include <functional>
#include <string>

#include "base/seconds.h"
#include "net/connect.h"

namespace robosim {

/// Retries a client's connection after it is lost, until it succeeds or a timeout has passed.
class Reconnector {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param timeout after the loss of a connection, the time within which a retry must succeed
  /// @param log receives one line
  Reconnector(Seconds timeout, std::function<void(const std::string&)> log);

  /// Calls `communicate` until it returns; after a lost connection calls `reconnect` before it calls it again.
  /// @param communicate, reconnect throw ConnectionError
  /// @throws ConnectionError that is not transient, or after the timeout.
  void run(const std::function<void()>& communicate, const std::function<void()>& reconnect);

 private:
  void waitAfter(const ConnectionError& error);

  Seconds timeout_;
  std::function<void(const std::string&)> log_;
  bool is_broken_ = false;
  Clock::time_point broken_since_;
};

}  // namespace robosim
