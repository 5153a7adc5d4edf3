#pragma once
#include <chrono>
#include <functional>
#include <string>

#include "net/dial.h"

namespace robosim {

/// The patience of a client whose connection breaks: it calls again and again, until it is through or has tried for
/// long enough.
class Redial {
 public:
  using Clock = std::chrono::steady_clock;

  /// @param log takes one line
  Redial(std::chrono::duration<double> patience, std::function<void(const std::string&)> log);

  /// Talks over a connection that stands, to the end; when it breaks in between, connects anew and talks on.
  /// @param talk, reconnect throw ConnectionError
  /// @throws such an error when it will not pass by itself, or patience has run out.
  void keepTalking(const std::function<void()>& talk, const std::function<void()>& reconnect);

 private:
  void waitAfter(const ConnectionError& error);

  std::chrono::duration<double> patience_;
  std::function<void(const std::string&)> log_;
  bool is_broken_ = false;
  Clock::time_point broken_since_;
};

}  // namespace robosim
