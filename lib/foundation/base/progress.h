#pragma once
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>

namespace robosim {

/// Progress on standard error: on a terminal a line that is rewritten in place; else, as in the log of a batch job, one
/// line per minute.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  Progress();
  Progress(std::FILE* out, bool on_terminal, std::function<Clock::time_point()> now);
  ~Progress();  ///< clears a terminal's line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Whether to show again: at most five times per second, or once per minute, so that callers need not format the text
  /// more often.
  bool due();
  /// Without a terminal only after due() has returned true.
  void show(const std::string& text);

 private:
  std::FILE* out_;
  bool on_terminal_;
  std::function<Clock::time_point()> now_;
  Clock::time_point next_;
  bool is_due_ = false;
  std::size_t shown_ = 0;
};

/// Estimate of the time that work takes to its end at the mean speed so far: "90 s left", "3 min left"; empty as long
/// as nothing is done.
/// @param done, total in any unit
std::string remainingTime(double elapsed_s, double done, double total);
/// The same after a comma: ", 3 min left".
std::string commaRemainingTime(double elapsed_s, double done, double total);

}  // namespace robosim
